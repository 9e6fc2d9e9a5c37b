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


def register() -> None:
    """Make the panels known to Blender."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    """Take them away again."""
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
