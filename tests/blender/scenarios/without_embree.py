"""Where Embree has no wheel, everything works through Blender's own rays."""

import runpy
import sys
from pathlib import Path

import bpy
import numpy as np
from stage import empty_scene, part

folder = Path(sys.argv[1])
sys.modules["embreex"] = None  # what an import finds where the wheel is missing
empty_scene()
runpy.run_path(str(Path(__file__).resolve().parents[3] / "docs" / "samples" / "02_retarget.py"))
task = bpy.context.scene.facial_retarget
task.frame_start, task.frame_end = 4, 5
task.page = str(folder / "page.html")
bpy.ops.facial_retarget.retarget()
bpy.ops.facial_retarget.show_base()
assert (folder / "page.html").stat().st_size > 10_000
assert not [name for name in sys.modules if name.startswith("embreex.")]


def baked() -> np.ndarray:
    """(2, 3 V) how far the baked keys move the target."""
    basis, *keys = task.target.data.shape_keys.key_blocks
    places = np.empty((3, 3 * len(task.target.data.vertices)), np.float32)
    for key, flat in zip((basis, *keys), places, strict=True):
        key.points.foreach_get("co", flat)
    return places[1:] - places[0]


by_blender = baked()
del sys.modules["embreex"]
assert part("bridge.raycast").available_caster() is part("core.raycast").EmbreeCaster
bpy.ops.facial_retarget.retarget()
by_embree = baked()
moved = np.abs(by_embree).max()
assert moved > 0.05, moved
assert np.percentile(np.abs(by_blender - by_embree), 99) < 1e-3 * moved
