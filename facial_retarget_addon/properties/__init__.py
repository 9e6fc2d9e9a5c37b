"""Property groups: what the artist sets, kept in the .blend, and where it hangs; a module for each capability."""

import bpy
from bpy.props import PointerProperty
from bpy.types import Object, Scene, WindowManager

from . import (
    bakes,
    cloning,
    examples,
    export,
    face,
    findings,
    kept_bakes,
    methods,
    normal_maps,
    overlay,
    parts,
    points,
    task,
    work,
)

MODULES = (
    points,
    parts,
    cloning,
    kept_bakes,
    findings,
    face,
    examples,
    methods,
    bakes,
    export,
    normal_maps,
    overlay,
    task,
    work,
)
"""Every module comes after those whose groups it holds."""

_register_classes, _unregister_classes = bpy.utils.register_classes_factory(
    [group for module in MODULES for group in module.CLASSES]
)


def register() -> None:
    """Hang the groups on objects, scenes and the window manager."""
    _register_classes()
    Object.facial_retarget = PointerProperty(type=face.FACIAL_RETARGET_PG_face)
    Scene.facial_retarget = PointerProperty(type=task.FACIAL_RETARGET_PG_task)
    WindowManager.facial_retarget = PointerProperty(type=work.FACIAL_RETARGET_PG_work, options={"SKIP_SAVE"})


def unregister() -> None:
    """Take the groups off again; their data stays in the .blend."""
    del WindowManager.facial_retarget
    del Scene.facial_retarget
    del Object.facial_retarget
    _unregister_classes()
