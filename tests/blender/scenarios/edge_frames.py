"""Every kind of bake of one frame, of frames that do not move, and of ten thousand."""

import json
import sys
from pathlib import Path

import bpy
import numpy as np
from stage import bake_as, empty_scene, grid, key_shape, part, shown

FOLDER = Path(sys.argv[-1])
SUFFIXES = {"pc2": "pc2", "mdd": "mdd", "alembic": "abc", "usd": "usdc"}
KINDS = ("frames", "absolute", "compact", "rig", *SUFFIXES)
MANY, FIRST = 10_000, 7


def head(kind: str, side: int = 6) -> bpy.types.Object:
    """A face with a part; for a bake onto its own keys it has one that lifts it and one that is of no use."""
    empty_scene()
    face, other = grid("face", side), grid("part", 3)
    face.facial_retarget.parts.add().thing = other
    if kind == "rig":
        for thing in (face, other):
            thing.shape_key_add(name="Basis", from_mix=False)
            rest = part("bridge.meshes").read_positions(thing.data)
            for name, axis in (("lift", 2), ("aside", 0)):
                part("bridge.shape_keys").write_key(
                    part("bridge.shape_keys").ensure_key(thing, name), rest + np.eye(3, dtype=np.float32)[axis]
                )
    return face


def rest_of(face: bpy.types.Object) -> np.ndarray:
    """(V, 3) float32 the head as it lies."""
    return part("bridge.heads").read_head(face).face.mesh.vertices.astype(np.float32)


def played(face: bpy.types.Object, time: float) -> np.ndarray:
    """(V, 3) the head at a scene frame."""
    bpy.context.scene.frame_set(int(time // 1), subframe=time % 1)
    return np.concatenate([shown(thing) for thing in (face, *part("bridge.heads").head_parts(face))])


def lifted(face: bpy.types.Object, heights: np.ndarray) -> np.ndarray:
    """(F, V, 3) the whole head lifted."""
    frames = np.repeat(rest_of(face)[None], len(heights), axis=0)
    frames[..., 2] += heights.astype(np.float32)[:, None]
    return frames


def few_frames_and_still_ones() -> None:
    """What plays is what was baked; where nothing moves, what is not asked for frame by frame makes no key."""
    for kind in KINDS:
        for number, heights in enumerate(([0.4], [0.0], [0.0, 0.0, 0.0])):
            face = head(kind)
            frames = lifted(face, np.array(heights))
            times = [FIRST + i for i in range(len(frames))]
            cache = FOLDER / f"few_{number}.{SUFFIXES.get(kind, '')}"
            figures = bake_as(face, kind, frames, times, cache, smoothness=0.0, sparsity=0.0)
            json.dumps(figures, allow_nan=False)
            assert figures["frames"] == len(frames)
            for time, frame in zip(times, frames, strict=True):
                np.testing.assert_allclose(played(face, time), frame, atol=1e-5 if kind != "compact" else 0.02)
            if not any(heights) and kind == "compact":
                assert face.data.shape_keys is None
            if not any(heights) and kind == "rig":
                played(face, FIRST)
                assert not [key.name for key in face.data.shape_keys.key_blocks[1:] if key.value]


def ten_thousand_frames() -> None:
    """Frame for frame what was baked, on both sides of frame 9999; names are unique and in order."""
    wave = np.sin(np.arange(MANY) * 0.37)
    for kind in KINDS:
        face = head(kind, side=20)
        frames = lifted(face, 0.5 + 0.5 * wave)
        frames[:, 0, 0] += 0.1 * wave.astype(np.float32)
        times = part("bridge.bakes.times").FrameTimes(FIRST, FIRST + MANY - 1)
        bake_as(face, kind, frames, times, FOLDER / f"many.{SUFFIXES.get(kind, '')}", smoothness=0.0, sparsity=0.0)
        # Blender takes seconds for a frame of ten thousand keys with a curve each: the keys themselves are looked at.
        looked = () if kind == "frames" else (FIRST, FIRST + 1, 9999, 10_000, FIRST + MANY - 1)
        most = {"compact": 0.03, "rig": 0.11}.get(kind, 2e-5)
        for time in looked:
            np.testing.assert_allclose(played(face, time), frames[time - FIRST], atol=most, err_msg=f"{kind} {time}")
        if kind in ("frames", "absolute"):
            names = face.data.shape_keys.key_blocks.keys()[1:]
            assert names == [f"frame_{time:04d}" for time in times]
        if kind == "frames":
            curves = part("bridge.curves").find_curves(face.data.shape_keys).fcurves
            ends = [[key.co[0] for key in curve.keyframe_points] for curve in (curves[0], curves[-1])]
            assert ends == [[FIRST - 1, FIRST, FIRST + 1], [times[-1] - 1, times[-1], times[-1] + 1]], ends
            assert len(curves) == MANY
            for name, row in ((names[0], 0), ("frame_9999", 9999 - FIRST), (names[-1], -1)):
                np.testing.assert_allclose(key_shape(face, name), frames[row, : 20 * 20], atol=1e-6)


def keys_play_across_frame_9999() -> None:
    """A key per frame, where their numbers get a digit more."""
    face = head("frames")
    times = range(9_500, 10_500)
    frames = lifted(face, np.sin(np.arange(len(times)) * 0.37))
    bake_as(face, "frames", frames, times)
    for time in (times[0], 9_999, 10_000, times[-1]):
        np.testing.assert_allclose(played(face, time), frames[time - times[0]], atol=1e-5, err_msg=str(time))


def the_panel_warns_of_thousands_of_keys() -> None:
    """However few vertices each of them has: Blender plays so many curves slowly. Absolute keys have one."""
    cost = part("bake_cost").bake_cost
    assert "fit better" in cost("frames", 400, MANY).advice
    assert not cost("frames", 400, 1_000).advice
    assert not cost("absolute", 400, MANY).advice


few_frames_and_still_ones()
keys_play_across_frame_9999()
the_panel_warns_of_thousands_of_keys()
ten_thousand_frames()
