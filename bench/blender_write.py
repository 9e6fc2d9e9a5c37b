"""How long Blender needs to take a bake: 300 frames of 30 000 vertices as shape keys with their curves.

    python -m bench.blender_write

In the same run: writing the same keys through `key.data`, the documented way.
"""

from __future__ import annotations

import statistics
import time

import bpy
import numpy as np

from facial_retarget_addon.bridge.bake import ensure_key, key_name, write_frames
from facial_retarget_addon.bridge.meshes import new_object

FRAMES, VERTICES, ROUNDS = 300, 30_000, 5


def main() -> None:
    """Print medians of `ROUNDS` rounds."""
    ours: list[float] = []
    documented: list[float] = []
    for _ in range(ROUNDS):
        ours.append(_seconds(_bake))
        documented.append(_seconds(_write_key_data))
    print(
        f"{FRAMES} frames of {VERTICES} vertices as shape keys, median of {ROUNDS} rounds, bpy {bpy.app.version_string}"
    )
    print(f"  bake, with curves     {statistics.median(ours):6.3f} s   (at most 1 s wanted)")
    print(f"  key.data, no curves   {statistics.median(documented):6.3f} s")


def _seconds(write) -> float:
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    rng = np.random.default_rng(1)
    vertices = rng.random((VERTICES, 3), np.float32)
    corners = np.arange(VERTICES)
    thing = new_object("face", vertices, np.full(VERTICES // 3, 3), corners)
    frames = vertices + rng.random((FRAMES, 1, 1), np.float32)
    start = time.perf_counter()
    write(thing, frames)
    return time.perf_counter() - start


def _bake(thing: bpy.types.Object, frames: np.ndarray) -> None:
    write_frames(thing, frames, first=1)


def _write_key_data(thing: bpy.types.Object, frames: np.ndarray) -> None:
    for i, positions in enumerate(frames):
        ensure_key(thing, key_name(i + 1)).data.foreach_set("co", positions.ravel())


if __name__ == "__main__":
    main()
