"""Normal maps of one frame, of frames that do not move, and of numbers that go beyond 9999."""

import sys
from pathlib import Path

import bpy
import numpy as np
from stage import empty_scene, part

FOLDER = Path(sys.argv[-1])


def textured(face: object, name: str) -> bpy.types.Object:
    """A built-in face as an object with points and UVs."""
    file = part("files.mesh_file").MeshFile(face.face.mesh, face.counts, face.corners, face.uvs[face.corners])
    made = part("bridge.meshes").new_face(name, file)
    part("bridge.points.points").write_points(made, face.face.points)
    return made


def maps(name: str, first: int, frames: list[np.ndarray], light: str = "TARGET") -> bpy.types.Object:
    """Make the maps of a source that shows some frames from a scene frame on; returns the object that has them."""
    task, scene = bpy.context.scene.facial_retarget, bpy.context.scene
    part("bridge.bakes.frames").write_frames(task.source, np.stack(frames).astype(np.float32), first)
    scene.frame_start, scene.frame_end = first, first + len(frames) - 1
    wish = task.normal_maps
    wish.folder, wish.pixels, wish.depth, wish.light, wish.level = str(FOLDER / name), 64, "png8", light, 1
    assert bpy.ops.facial_retarget.make_normal_maps() == {"FINISHED"}
    return task.target if light == "TARGET" else bpy.data.objects[f"{task.target.name} level 1"]


def shown_file(thing: bpy.types.Object, frame: int) -> str:
    """Name of the picture that an object's material shows at a scene frame."""
    bpy.context.scene.frame_set(frame)
    (node,) = (node for node in thing.data.materials[0].node_tree.nodes if node.type == "TEX_IMAGE")
    node.image_user.frame_current = frame
    return Path(node.image.filepath_from_user(image_user=node.image_user)).name


def pictures(name: str) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted((FOLDER / name).iterdir())}


empty_scene()
actor = part("demo").actor(1_500)
rest, joy = actor.face.mesh.vertices, actor.face.examples["joy"]
task = bpy.context.scene.facial_retarget
task.source, task.target = textured(actor, "source"), textured(actor, "target")
task.hierarchical.levels = 2

# One frame is a picture, no sequence.
target = maps("single", 7, [joy])
assert list(pictures("single")) == ["normal.0007.png"]
assert [shown_file(target, frame) for frame in (1, 7, 90)] == 3 * ["normal.0007.png"]

# What does not move has the same picture again and again.
maps("still", 1, [rest, rest, rest])
assert len(pictures("still")) == 3
assert len(set(pictures("still").values())) == 1

# Beyond 9999 each scene frame shows its own picture, on the target and on a level of it.
for light in ("TARGET", "LEVEL"):
    thing = maps(light, 9_998, [rest, joy, rest, joy], light)
    held = pictures(light)
    assert set(held) == {f"normal.{frame:04d}.png" for frame in range(9_998, 10_002)}
    assert held["normal.9998.png"] == held["normal.10000.png"] != held["normal.9999.png"] == held["normal.10001.png"]
    for frame in range(9_998, 10_002):
        assert shown_file(thing, frame) == f"normal.{frame:04d}.png", (frame, shown_file(thing, frame))
