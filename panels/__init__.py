"""The sidebar's Retarget tab, in the order of the work."""

import bpy

from . import (
    bake_export,
    cloning,
    examples,
    faces,
    faps,
    feature_points,
    head_parts,
    method,
    more,
    motion,
    next_step,
    normal_maps,
    overlay,
    preview,
    report,
    wrinkle_kit,
)

CLASSES = (
    next_step.FACIAL_RETARGET_PT_next,
    faces.FACIAL_RETARGET_PT_faces,
    feature_points.FACIAL_RETARGET_UL_points,
    feature_points.FACIAL_RETARGET_PT_points,
    feature_points.FACIAL_RETARGET_PT_base,
    head_parts.FACIAL_RETARGET_UL_parts,
    head_parts.FACIAL_RETARGET_PT_parts,
    overlay.FACIAL_RETARGET_PT_shown,
    overlay.FACIAL_RETARGET_PT_overlay,
    examples.FACIAL_RETARGET_UL_examples,
    examples.FACIAL_RETARGET_PT_examples,
    method.FACIAL_RETARGET_PT_retarget,
    method.FACIAL_RETARGET_PT_bake,
    preview.FACIAL_RETARGET_UL_masks,
    preview.FACIAL_RETARGET_PT_preview,
    preview.FACIAL_RETARGET_PT_compare,
    preview.FACIAL_RETARGET_PT_gains,
    method.FACIAL_RETARGET_PT_settings,
    bake_export.FACIAL_RETARGET_PT_export,
    normal_maps.FACIAL_RETARGET_PT_normal_maps,
    wrinkle_kit.FACIAL_RETARGET_PT_wrinkle_kit,
    bake_export.FACIAL_RETARGET_PT_job,
    report.FACIAL_RETARGET_UL_findings,
    report.FACIAL_RETARGET_PT_report,
    more.FACIAL_RETARGET_PT_more,
    cloning.FACIAL_RETARGET_UL_cloned,
    cloning.FACIAL_RETARGET_PT_cloning,
    cloning.FACIAL_RETARGET_PT_clone_settings,
    cloning.FACIAL_RETARGET_PT_cloned,
    motion.FACIAL_RETARGET_PT_motion,
    faps.FACIAL_RETARGET_PT_faps,
)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
