"""Frames become shape keys that play back exactly, and survive saving."""

import sys
from pathlib import Path

import bpy
import numpy as np
from stage import empty_scene, enable, grid, part, refused, shown, wave

FIRST = 7


def plays(thing: bpy.types.Object, frames: np.ndarray, first: int) -> None:
    """At each frame the object shows exactly that frame; beside them its Basis."""
    basis = thing.data.shape_keys.reference_key
    for frame in range(first - 2, first + len(frames) + 2):
        bpy.context.scene.frame_set(frame)
        inside = 0 <= frame - first < len(frames)
        expected = frames[frame - first] if inside else np.array([point.co for point in basis.points], np.float32)
        np.testing.assert_allclose(shown(thing), expected, atol=2e-7)
        values = {key.name: key.value for key in thing.data.shape_keys.key_blocks if key.value != 0 and key != basis}
        assert values == ({f"frame_{frame:04d}": 1.0} if inside else {}), values


empty_scene()
bake, shape_keys = part("bridge.bakes.frames"), part("bridge.shape_keys")
face = grid("face")

# An artist's own animated key stays what it was.
shape_keys.ensure_basis(face)
smile = face.shape_key_add(name='smile "x"', from_mix=False)
smile.value = 0.0
smile.keyframe_insert("value", frame=100)
own_curve = shape_keys.value_path(smile.name)

frames = wave(face, 12)
bake.write_frames(face, frames, FIRST)
plays(face, frames, FIRST)

# Half-way between two frames, half of each.
bpy.context.scene.frame_set(FIRST, subframe=0.5)
np.testing.assert_allclose(shown(face), 0.5 * (frames[0] + frames[1]), atol=5e-7)

# A second bake replaces the first one.
shorter = 2 * wave(face, 5)
bake.write_frames(face, shorter, FIRST + 3)
plays(face, shorter, FIRST + 3)
names = [key.name for key in face.data.shape_keys.key_blocks]
assert names == ["Basis", 'smile "x"', *(f"frame_{i:04d}" for i in range(FIRST + 3, FIRST + 8))], names
action = face.data.shape_keys.animation_data.action
curves = [curve.data_path for curve in action.layers[0].strips[0].channelbags[0].fcurves]
assert len(curves) == 6, curves
assert own_curve in curves, curves

with refused("35 vertices", "'face'", "36"):
    bake.write_frames(face, frames[:, :-1], FIRST)

path = Path(sys.argv[1]) / "baked.blend"
bpy.ops.wm.save_as_mainfile(filepath=str(path))
bpy.ops.wm.open_mainfile(filepath=str(path))
enable()
plays(bpy.data.objects["face"], shorter, FIRST + 3)
