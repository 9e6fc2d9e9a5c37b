"""What the scenarios play with: the installed extension's modules, and small built-in faces."""

from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import numpy as np
from drive import override

NAME = "bl_ext.user_default.facial_retarget"


def part(name: str) -> ModuleType:
    """A module of the installed extension, such as "bridge.bakes.frames"."""
    return import_module(f"{NAME}.facial_retarget_addon.{name}")


FACES = ("actor", "ape", "skull", "child", "Suzanne")
"""The built-in faces, and Blender's own."""


def small_face(name: str) -> Any:
    """A built-in face as `demo.DemoFace`, of some thousand vertices."""
    demo, cast, layouts = part("demo"), part("demo.cast"), part("demo.layouts")
    layout = layouts.ringed_layout(60, 66, 5)
    if name == "ape":
        return part("demo.face").build_face(name, cast.APE, layout, cast.FUR, cast.APE_MANNER)
    if name == "skull":
        return part("demo.face").build_face(name, cast.SKULL, layout, cast.BONE, cast.SKULL_MANNER)
    return demo.child() if name == "child" else demo.actor(5_000)


def add_suzanne() -> bpy.types.Object:
    """Blender's monkey, finer, with the feature points of the samples; active and selected."""
    bpy.ops.mesh.primitive_monkey_add()
    made = bpy.context.view_layer.objects.active
    with override():
        made.modifiers.new("Finer", "SUBSURF").levels = 2
        bpy.ops.object.modifier_apply(modifier="Finer")
    made.data.shade_smooth()
    file = Path(__file__).resolve().parents[2] / "docs" / "samples" / "suzanne_points.json"
    points = part("files.points").read_points(file, part("bridge.meshes").neutral_mesh(made))
    part("bridge.points.points").write_points(made, points)
    choose(made)
    remember()
    return made


def clear() -> None:
    """An empty scene in the window that is open."""
    bpy.data.batch_remove([*bpy.data.objects, *bpy.data.meshes])
    bpy.context.view_layer.update()


def add_face(built: Any, name: str, place: float = 0.0, points: bool = True) -> bpy.types.Object:
    """A built-in face (`demo.DemoFace`) that stands upright, 2 high, `place` along X, active and selected."""
    file = part("files.mesh_file").MeshFile(built.face.mesh, built.counts, built.corners, built.uvs[built.corners])
    made = part("bridge.meshes").new_face(name, file)
    low, high = built.face.mesh.vertices.min(axis=0), built.face.mesh.vertices.max(axis=0)
    middle, size = 0.5 * (low + high), 2.0 / (high[1] - low[1])
    made.rotation_euler.x = part("bridge.cloning.donors").STANDING
    made.scale = (size,) * 3
    made.location = (place - size * middle[0], size * middle[2], -size * middle[1])
    if points:
        part("bridge.points.points").write_points(made, built.face.points)
    choose(made)
    remember()
    return made


def remember() -> None:
    """Make the scene as it is a step of the undo history: Ctrl Z goes back to steps, and what a script does is none."""
    with override():
        bpy.ops.ed.undo_push(message="Stage")


def choose(thing: bpy.types.Object) -> None:
    """Make an object the active and the only selected one."""
    bpy.context.view_layer.update()
    for other in bpy.context.view_layer.objects:
        other.select_set(other == thing)
    bpy.context.view_layer.objects.active = thing


def shown(thing: bpy.types.Object) -> np.ndarray:
    """(V, 3) positions of an object as it looks at the scene's frame, in its own coordinates."""
    mesh = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    flat = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", flat)
    return flat.reshape(-1, 3)


def snapshot() -> dict[str, object]:
    """What an operator that is stopped or undone must not have changed."""
    scene = bpy.context.scene
    return {
        "frame": (scene.frame_current, scene.frame_subframe),
        "objects": sorted(thing.name for thing in bpy.data.objects),
        "meshes": sorted(mesh.name for mesh in bpy.data.meshes),
        "actions": sorted(action.name for action in bpy.data.actions),
        "keys": {
            f"{key.name}/{block.name}": (block.value, np.array([point.co for point in block.points]).sum())
            for key in bpy.data.shape_keys
            for block in key.key_blocks
        },
        "texts": sorted(text.name for text in bpy.data.texts),
        "points": {
            f"{thing.name}/{point.name}": (*point.vertices, *point.weights)
            for thing in bpy.data.objects
            for point in thing.facial_retarget.points
        },
        "examples": [example.name for example in scene.facial_retarget.examples],
    }


def check_unchanged(before: dict[str, object]) -> None:
    """Fail if the scene is not what `snapshot` has told before."""
    now = snapshot()
    for name, was in before.items():
        assert name == "keys" or now[name] == was, f"{name}: {str(was)[:300]} -> {str(now[name])[:300]}"
    changed = set(before["keys"].items()) ^ set(now["keys"].items())
    assert not changed, f"keys: {sorted(changed)[:9]}"


def point_places(thing: bpy.types.Object) -> dict[str, np.ndarray]:
    """Name -> (3,) place in the scene of each of an object's feature points, on its neutral."""
    points = part("bridge.points.points")
    world = np.array(thing.matrix_world)
    own = points.point_positions(thing)
    names = [point.name for point in thing.facial_retarget.points]
    return dict(zip(names, own @ world[:3, :3].T + world[:3, 3], strict=True))
