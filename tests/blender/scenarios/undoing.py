"""One undo step takes back what an operator made on an MPEG-4 face."""

import sys
from pathlib import Path

import bpy
import numpy as np
from stage import actor_face, empty_scene, part, snapshot

path = Path(sys.argv[1]) / "take.fap"
empty_scene()
actor_face()
values = np.full((3, 68), 100.0)
values[:, :2] = 0
part("files.motion.fap").write_fap(part("core.mpeg4.conversions").stream_of_values("take", 24.0, values), path)
operators = bpy.ops.facial_retarget
for operator, options in (
    (operators.make_shapes, {"sets": {"arkit"}}),
    (operators.make_controls, {}),
    (operators.import_motion, {"filepath": str(path), "way": "CONTROLS", "head": "EMPTY"}),
    (operators.import_motion, {"filepath": str(path), "way": "POINTS"}),
    (operators.import_motion, {"filepath": str(path), "way": "FRAMES"}),
):
    # In background Blender makes no undo steps by itself.
    bpy.ops.ed.undo_push(message="before")
    before = snapshot()
    assert operator(**options) == {"FINISHED"}
    assert snapshot() != before, operator
    bpy.ops.ed.undo_push(message="after")
    bpy.ops.ed.undo()
    assert snapshot() == before, operator
