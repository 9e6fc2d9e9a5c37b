"""The panel's settings and the job file convert into each other, both ways."""

import sys
from dataclasses import asdict
from pathlib import Path

import bpy
import numpy as np
from stage import empty_scene, grid, part, refused, wave

folder = Path(sys.argv[1])
empty_scene()
bake, examples, points, base_object = (
    part(f"bridge.{name}") for name in ("bakes.frames", "examples.examples", "points.points", "points.base_object")
)
jobs, core_points = part("files.job"), part("core.points")
task = bpy.context.scene.facial_retarget
task.source, task.target = grid("source"), grid("target", 8)
for thing, places in ((task.source, [0, 5, 35, 30]), (task.target, [0, 7, 63, 56])):
    corners, weights = np.repeat(np.array(places)[:, None], 3, axis=1), np.tile([0.7, 0.2, 0.1], (4, 1))
    points.write_points(thing, core_points.FeaturePoints(("a", "b", "c", "d"), corners, weights))
    basis = part("bridge.meshes").read_positions(thing.data)
    for name in ("joy", "a/b"):
        examples.write_example(thing, name, basis * 1.25)
task.source.data.uv_layers.new(name="UVMap")
frames = wave(task.source, 3)
bake.write_frames(task.source, frames, 21)
for name in ("joy", "a/b"):
    task.examples.add().name = name
triangles = (("a", "b", "c"), ("c", "d", "a"))
task.base = base_object.show_triangles(task.source, triangles)
task.use_scene_range, task.frame_start, task.frame_end = False, 21, 23
settings = task.hierarchical
settings.levels, settings.variant, settings.read = 3, "paper", "pierce"
settings.base_gain, settings.detail_scale = 0.7, 1.9
settings.level_gains[1] = 0.3
task.regions.mouth, task.regions.jaw = 0.7, 1.2
for name, weight, gain in (("scar", 1.0, 0.3), ("left half", 0.25, 2.0)):
    task.target.vertex_groups.new(name=name).add([3, 5, 9], weight, "REPLACE")
    bpy.ops.facial_retarget.add_mask()
    task.masks[-1].gain = gain
how = task.bake.how
how.kind, how.tolerance, how.smoothness, how.residual = "rig", 0.01, 0.3, 2
task.target.data.shape_keys.key_blocks["joy"].slider_max = 1.3
bpy.context.scene.render.fps = 30
task.output = str(folder / "out.pc2")
task.report = str(folder / "report.json")

bpy.ops.facial_retarget.save_job(filepath=str(folder / "first.toml"))
first = jobs.read_job(folder / "first.toml")
assert first.settings.level_gains == (1.0, 0.3), first.settings
assert (first.settings.base_gain, first.settings.detail_scale) == (0.7, 1.9), first.settings
assert first.output == jobs.OutputFiles(folder / "out.pc2", folder / "report.json", None), first.output
assert [example.name for example in first.examples] == ["joy", "a/b"]
assert (first.bake.settings.kind, first.bake.settings.tolerance, first.bake.settings.residual) == ("rig", 0.01, 2)
assert (first.bake.rig, first.bake.ranges) == (folder / "first_rig.npz", {"joy": (0.0, 1.3)})
assert first.bake.outputs().keys() == {"[bake] curves 1", "[bake] curves 2", "[bake] shapes"}, first.bake
assert (first.fps, first.chosen.whole) == (30.0, True)
assert asdict(first.regions) == {"brows": 1.0, "eyes": 1.0, "nose": 1.0, "cheeks": 1.0, "mouth": 0.7, "jaw": 1.2}
assert [(mask.name, mask.gain) for mask in first.masks] == [("scar", 0.3), ("left half", 2.0)]

empty_scene()
bpy.ops.facial_retarget.load_job(filepath=str(folder / "first.toml"))
task = bpy.context.scene.facial_retarget
assert base_object.read_base(task.base) == triangles
assert task.source.data.uv_layers.active is not None
assert task.target.data.uv_layers.active is None
assert (task.bake.how.kind, task.bake.how.residual) == ("rig", 2)
np.testing.assert_allclose(task.target.data.shape_keys.key_blocks["joy"].slider_max, 1.3)
bpy.context.scene.render.fps = 30
masks = part("bridge.task").read_problem(bpy.context).gains.masks
assert list(masks) == ["scar", "left half"]
assert np.array_equal(masks["left half"].weights.nonzero()[0], [3, 5, 9])
assert np.array_equal(masks["left half"].weights[[3, 5, 9]], [0.25] * 3)
read = part("bridge.performance").read_frames(bpy.context, task.source, part("bridge.task").frame_times(bpy.context))
np.testing.assert_allclose(part("bridge.background").finished(read), frames, atol=2e-7)

bpy.ops.facial_retarget.save_job(filepath=str(folder / "second.toml"))
second = jobs.read_job(folder / "second.toml")
assert asdict(second.settings) == asdict(first.settings), (first.settings, second.settings)
assert (second.method, second.output) == (first.method, first.output)
assert asdict(second.regions) == asdict(first.regions)
assert [(mask.name, mask.gain) for mask in second.masks] == [(mask.name, mask.gain) for mask in first.masks]
assert list(second.inputs()) == list(first.inputs())
assert (second.bake.settings, second.bake.ranges) == (first.bake.settings, first.bake.ranges)
for path, again in zip(first.inputs().values(), second.inputs().values(), strict=True):
    if path.suffix != ".npz":
        assert path.read_bytes() == again.read_bytes(), f"{again.name} is not what {path.name} was"
    else:
        one, other = np.load(path), np.load(again)
        assert all(np.allclose(one[name], other[name], atol=2e-7) for name in one.files), path.name

# Compact keys need no rig, and kinds that Blender alone has are no bake of a job; loading such a job means frames.
task = bpy.context.scene.facial_retarget
for kind in ("compact", "absolute"):
    task.bake.how.kind, task.bake.step = kind, 0.5
    bpy.ops.facial_retarget.save_job(filepath=str(folder / f"{kind}.toml"))
    saved = jobs.read_job(folder / f"{kind}.toml")
    assert saved.fps == 60.0
    if kind == "compact":
        assert (saved.bake.rig, saved.bake.shapes) == (None, folder / "compact_keys.npz")
    else:
        assert saved.bake is None
bpy.ops.facial_retarget.load_job(filepath=str(folder / "absolute.toml"))
assert bpy.context.scene.facial_retarget.bake.how.kind == "frames"
empty_scene()
bpy.ops.facial_retarget.load_job(filepath=str(folder / "first.toml"))
bpy.context.scene.render.fps = 30
bpy.ops.facial_retarget.save_job(filepath=str(folder / "second.toml"))

# A bad job leaves the scene as it was.
text = (folder / "first.toml").read_text()
part("files.base_mesh").write_base_mesh((("a", "b", "nowhere"),), folder / "strange_base.json")
for number, (old, new, *words) in enumerate(
    (
        ("levels = 3", "levels = 99", "levels", "99"),
        ("first_source.obj", "missing.obj", "missing.obj"),
        ("first_example_1_target.npz", "first_example_1_source.npz", "'joy'", "36", "64"),
        ("first_source_frames.npz", "first_example_1_source.npz", "'frames'"),
        ("first_base.json", "strange_base.json", "'nowhere'"),
        ("first_rig.npz", "first_example_1_source.npz", "shape 'vertices'", "64"),
    )
):
    assert old in text, old
    (folder / f"bad{number}.toml").write_text(text.replace(old, new))
    with refused(*words):
        bpy.ops.facial_retarget.load_job(filepath=str(folder / f"bad{number}.toml"))
with refused("no/such"):
    bpy.ops.facial_retarget.save_job(filepath=str(folder / "no/such/folder/job.toml"))

# A disk that refuses leaves nothing behind, and an earlier job as it was.
before = {path.name: path.read_bytes() for path in folder.iterdir()}
(folder / "second_target_points.json").unlink()
(folder / "second_target_points.json").mkdir()
bpy.context.scene.facial_retarget.hierarchical.levels = 1
with refused("second_target_points.json"):
    bpy.ops.facial_retarget.save_job(filepath=str(folder / "second.toml"))
(folder / "second_target_points.json").rmdir()
del before["second_target_points.json"]
assert {path.name: path.read_bytes() for path in folder.iterdir()} == before
