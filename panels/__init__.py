"""The sidebar's Retarget tab, in the order of the work."""

import bpy

from . import examples, faces, feature_points, job, method

CLASSES = (
    faces.FACIALRETARGET_PT_faces,
    feature_points.FACIALRETARGET_UL_points,
    feature_points.FACIALRETARGET_PT_points,
    examples.FACIALRETARGET_PT_examples,
    method.FACIALRETARGET_PT_retarget,
    method.FACIALRETARGET_PT_settings,
    job.FACIALRETARGET_PT_job,
)


def register() -> None:
    """Make the panels known to Blender."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    """Take them away again."""
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
