"""Steer the result with example expressions: shape keys of one name on both faces.

Needs the two faces of 02_retarget.py, which it runs first.
"""

import runpy
from pathlib import Path

import bpy

runpy.run_path(str(Path(__file__).with_name("02_retarget.py")))
task = bpy.context.scene.facial_retarget

# Seven examples, the Basis being the neutral one. What you have not sculpted yet is left out.
bpy.ops.facial_retarget.create_examples()

# Here `surprise` is sculpted by code: the source lifts its brows, the target moves them half as far and forward.
surprise = task.source.data.shape_keys.key_blocks["surprise"]
brows = task.source.data.shape_keys.key_blocks["brows"]
for key, lifted in zip(surprise.points, brows.points, strict=True):
    key.co = lifted.co
basis = task.target.data.shape_keys.reference_key
for key, still in zip(task.target.data.shape_keys.key_blocks["surprise"].points, basis.points, strict=True):
    lift = max(0.0, still.co.z - 0.3) if still.co.y < -0.5 else 0.0
    key.co = (still.co.x, still.co.y - 0.2 * lift, still.co.z + 0.2 * lift)

# Retargeting again replaces the frames that were baked before.
bpy.ops.facial_retarget.retarget()

# Or have them made roughly: joy on both faces out of the source's feature points, then cloned from there.
bpy.ops.facial_retarget.rough_out(example="joy", side="SOURCE", way="POINTS")
bpy.ops.facial_retarget.rough_out(example="joy", side="TARGET", way="CLONE")
bpy.ops.facial_retarget.mirror_example(example="joy", side="TARGET", way="LEFT_TO_RIGHT")
bpy.ops.facial_retarget.scale_example(example="joy", side="TARGET", factor=0.8)

# How well each one is met, and how much of it would be missing if only the others were known.
bpy.ops.facial_retarget.check_examples()
for example in task.examples:
    if example.checked:
        print(f"{example.name}: {example.fit:.1%} missed, {example.leave_one_out:.0%} without it")
