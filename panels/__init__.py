"""The sidebar's Retarget tab, in the order of the work."""

import bpy

from . import examples, faces, faps, feature_points, job, method, motion

CLASSES = (
    faces.FACIAL_RETARGET_PT_faces,
    feature_points.FACIAL_RETARGET_PT_points,
    examples.FACIAL_RETARGET_PT_examples,
    method.FACIAL_RETARGET_PT_retarget,
    method.FACIAL_RETARGET_PT_settings,
    job.FACIAL_RETARGET_PT_job,
    motion.FACIAL_RETARGET_PT_motion,
    faps.FACIAL_RETARGET_PT_faps,
)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
