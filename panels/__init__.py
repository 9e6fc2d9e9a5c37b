"""The sidebar's Retarget tab, in the order of the work."""

import bpy

from . import examples, faces, feature_points, job, method

CLASSES = (
    faces.FACIAL_RETARGET_PT_faces,
    feature_points.FACIAL_RETARGET_PT_points,
    examples.FACIAL_RETARGET_PT_examples,
    method.FACIAL_RETARGET_PT_retarget,
    method.FACIAL_RETARGET_PT_settings,
    job.FACIAL_RETARGET_PT_job,
)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
