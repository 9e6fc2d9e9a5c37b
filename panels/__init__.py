"""The sidebar's Retarget tab, in the order of the work."""

import bpy

from . import cloning, examples, faces, faps, feature_points, head_parts, job, method, motion

CLASSES = (
    faces.FACIAL_RETARGET_PT_faces,
    feature_points.FACIAL_RETARGET_PT_points,
    head_parts.FACIAL_RETARGET_UL_parts,
    head_parts.FACIAL_RETARGET_PT_parts,
    examples.FACIAL_RETARGET_PT_examples,
    method.FACIAL_RETARGET_PT_retarget,
    method.FACIAL_RETARGET_PT_settings,
    cloning.FACIAL_RETARGET_UL_cloned,
    cloning.FACIAL_RETARGET_PT_cloning,
    cloning.FACIAL_RETARGET_PT_clone_settings,
    cloning.FACIAL_RETARGET_PT_cloned,
    job.FACIAL_RETARGET_PT_job,
    motion.FACIAL_RETARGET_PT_motion,
    faps.FACIAL_RETARGET_PT_faps,
)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
