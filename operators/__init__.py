"""What an artist does: one module each."""

import bpy

from . import (
    add_actor,
    add_faces,
    add_point,
    choose_face,
    clone_shapes,
    create_examples,
    export_gltf,
    fap_controls,
    head_parts,
    jobs,
    list_examples,
    make_shapes,
    motion,
    points_files,
    remove_point,
    retarget,
    shape_files,
    show_base,
    show_levels,
)

CLASSES = (
    choose_face.FACIAL_RETARGET_OT_choose_face,
    add_faces.FACIAL_RETARGET_OT_add_faces,
    points_files.FACIAL_RETARGET_OT_load_points,
    points_files.FACIAL_RETARGET_OT_save_points,
    add_point.FACIAL_RETARGET_OT_add_point,
    remove_point.FACIAL_RETARGET_OT_remove_point,
    head_parts.FACIAL_RETARGET_OT_add_parts,
    head_parts.FACIAL_RETARGET_OT_remove_part,
    show_base.FACIAL_RETARGET_OT_show_base,
    create_examples.FACIAL_RETARGET_OT_create_examples,
    list_examples.FACIAL_RETARGET_OT_add_example,
    list_examples.FACIAL_RETARGET_OT_remove_example,
    retarget.FACIAL_RETARGET_OT_retarget,
    show_levels.FACIAL_RETARGET_OT_show_levels,
    export_gltf.FACIAL_RETARGET_OT_export_gltf,
    add_actor.FACIAL_RETARGET_OT_add_actor,
    clone_shapes.FACIAL_RETARGET_OT_clone_shapes,
    clone_shapes.FACIAL_RETARGET_OT_find_corrected,
    clone_shapes.FACIAL_RETARGET_OT_resolve_shapes,
    jobs.FACIAL_RETARGET_OT_load_job,
    jobs.FACIAL_RETARGET_OT_save_job,
    jobs.FACIAL_RETARGET_OT_save_clone_job,
    make_shapes.FACIAL_RETARGET_OT_make_shapes,
    shape_files.FACIAL_RETARGET_OT_load_shapes,
    shape_files.FACIAL_RETARGET_OT_save_shapes,
    fap_controls.FACIAL_RETARGET_OT_make_controls,
    fap_controls.FACIAL_RETARGET_OT_remove_controls,
    motion.FACIAL_RETARGET_OT_import_motion,
    motion.FACIAL_RETARGET_OT_export_motion,
)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
