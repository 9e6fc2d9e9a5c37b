"""Enabling is light, clean, and can be undone."""

import os
import sys

import bpy
from stage import disable, enable, part, policy_warnings

for _ in range(2):
    enable()
    assert hasattr(bpy.types.Scene, "facial_retarget")
    assert hasattr(bpy.types, "FACIAL_RETARGET_OT_retarget")
    heavy = sorted({name.partition(".")[0] for name in sys.modules} & {"scipy", "embreex"})
    assert not heavy, f"enabling has imported {heavy}"
    assert not policy_warnings(), policy_warnings()
    disable()
    assert not hasattr(bpy.types.Scene, "facial_retarget")
    assert not hasattr(bpy.types.Object, "facial_retarget")
    left = [name for name in dir(bpy.types) if name.startswith("FACIAL_RETARGET")]
    assert not left, f"disabling has left {left}"

# When everything is loaded, the wheels come from the zip, and still nothing is where it does not belong.
enable()
for name in ("core.closest_point", "core.raycast", "bridge.job", "bridge.retargeting"):
    part(name)
import embreex  # noqa: E402
import scipy  # noqa: E402

for module in (scipy, embreex):
    assert os.environ["BLENDER_USER_RESOURCES"] in module.__file__, module.__file__
assert not policy_warnings(), policy_warnings()
