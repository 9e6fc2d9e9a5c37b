"""Bake a performance without a window, each way that fits, and take its curves out.

    blender --background --python 11_bakes.py

Where no bake is possible the operator raises RuntimeError with the reason. Needs the two faces of 02_retarget.py, which
it runs first.
"""

import csv
import json
import runpy
import tempfile
from pathlib import Path

import bpy

runpy.run_path(str(Path(__file__).with_name("02_retarget.py")))
task = bpy.context.scene.facial_retarget

with tempfile.TemporaryDirectory() as folder:
    # As few shape keys as half a percent of the eye separation allows, with a curve each; the report has the figures.
    task.bake.how.kind, task.bake.how.tolerance = "compact", 0.005
    task.report = str(Path(folder, "report.json"))
    bpy.ops.facial_retarget.retarget()
    bake = json.loads(Path(task.report).read_text())["bake"]
    print(f"{bake['keys']} keys for {bake['frames']} frames, at most {bake['error']:.2%} off")

    # Their curves as a table: a line for each frame, a column for each key.
    table = str(Path(folder, "curves.csv"))
    bpy.ops.facial_retarget.export_curves(filepath=table, frame_start=1, frame_end=8)
    with open(table, newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    print(names, "peaks at", max(float(row[2]) for row in rows))

    # A cache in place of them, every half frame. It replaces the keys; a saved .blend plays it.
    task.bake.how.kind, task.bake.step = "pc2", 0.5
    task.bake.cache = str(Path(folder, "performance.pc2"))
    bpy.ops.facial_retarget.retarget()
    print(Path(task.bake.cache).stat().st_size, "bytes,", [modifier.type for modifier in task.target.modifiers])

    # A job does the same without Blender: facial-retarget run job.toml --resume
    task.bake.how.kind, task.bake.step = "compact", 1.0
    bpy.ops.facial_retarget.save_job(filepath=str(Path(folder, "job.toml")))
    print(Path(folder, "job.toml").read_text().partition("[bake]")[2].partition("[settings]")[0])
