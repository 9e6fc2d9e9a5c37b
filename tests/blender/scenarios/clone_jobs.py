"""What the panel clones, saved as a job: the command line then makes the same shapes, corrections kept."""

import sys
from pathlib import Path

import bpy
import numpy as np
from stage import demo_object, donor_pair, empty_scene, key_shape, part, refused

folder = Path(sys.argv[1])
empty_scene()
context = bpy.context
operators = bpy.ops.facial_retarget
task = context.scene.facial_retarget
cloning = task.cloning
heads, jobs, run = part("bridge.heads"), part("files.clone_job"), part("files.clone_task").run_clone_file
read_shapes = part("files.shape_files").read_shapes
assert not operators.save_clone_job.poll()


def same(thing: bpy.types.Object, path: Path, names: list[str], loose: float = 2e-4) -> None:
    """A head's keys must be the shapes of a file, as far as the mesh files' digits go."""
    head = heads.read_head(thing)
    read = read_shapes(path, head.face.mesh)
    assert sorted(read.names) == sorted(names), read.names
    ours = head.displacements(list(read.names))
    np.testing.assert_allclose(ours, read.displacements, atol=loose * head.face.mesh.size, err_msg=path.name)
    assert all(np.abs(move).max() > 1e-3 * head.face.mesh.size for move in ours)


# One source, two heads of which one has parts; filters and halves.
task.source, first = donor_pair()
second = demo_object(part("demo").warped_actor(np.random.default_rng(2), 4_500), "second", pieces=True)
second.facial_retarget.parts[0].role = "left eyeball"
for thing in bpy.data.objects:
    thing.select_set(thing in (first, second))
cloning.targets, cloning.keep, cloning.drop, cloning.sides, cloning.feather = (
    "SELECTED",
    "*",
    "fear, anger",
    "SPLIT",
    0.3,
)
operators.save_clone_job(filepath=str(folder / "two.toml"))
job = jobs.read_clone_job(folder / "two.toml")
assert job.preparation.drop == ("fear", "anger")
assert job.preparation.feather == 0.3
assert [target.face.parts is not None for target in job.targets] == [True, False]
run(folder / "two.toml")
operators.clone_shapes()
halves = [f"{name}_{side}" for name in ("joy", "sadness", "disgust", "surprise") for side in "LR"]
same(second, folder / "two_target_1_shapes.json", halves)
same(first, folder / "two_target_2_shapes.json", halves)

# Corrections go along, from the built-in actor too.
cloning.donor, cloning.targets, cloning.sides, cloning.existing = "ACTOR", "TARGET", "AS_THEY_ARE", "SUFFIX"
cloning.actor_sets, cloning.keep, cloning.drop = {"expressions", "arkit"}, "jawOpen, mouthClose, mouth*Left, joy", ""
task.target = first
operators.clone_shapes()
keys = first.data.shape_keys.key_blocks
basis = key_shape(first, "Basis")
part("bridge.shape_keys").write_key(keys["joy"], basis + 1.4 * (key_shape(first, "joy") - basis))
operators.save_clone_job(filepath=str(folder / "actor.toml"))
assert jobs.read_clone_job(folder / "actor.toml").source == jobs.BuiltInActor(("arkit", "expressions"))


def built_in(sets: tuple[str, ...]) -> tuple[object, object]:
    """The actor's face and shapes, as the command line makes them."""
    donor = part("bridge.background").finished(part("bridge.cloning.donors").actor_steps(sets))
    return donor.face, donor.all_shapes


run(folder / "actor.toml", make_actor=built_in)
operators.resolve_shapes()
found = read_shapes(folder / "actor_target_1_shapes.json", heads.read_head(first).face.mesh)
assert set(found.names) <= set(part("bridge.key_sets").key_names(first))
same(first, folder / "actor_target_1_corrected.json", ["joy"], 1e-6)
np.testing.assert_allclose(found["joy"], key_shape(first, "joy") - basis, atol=1e-6)

# What is wrong is said, and no file is left.
before = sorted(path.name for path in folder.iterdir())
cloning.keep = "nobody"
with refused("'nobody'"):
    operators.save_clone_job(filepath=str(folder / "wrong.toml"))
cloning.donor, cloning.keep = "SOURCE", "*"
task.source = second
part("bridge.key_sets").ensure_basis(second)
for name in part("bridge.key_sets").key_names(second):
    second.shape_key_remove(second.data.shape_keys.key_blocks[name])
with refused("'second'", "no shape keys"):
    operators.save_clone_job(filepath=str(folder / "wrong.toml"))
with refused("no folder"):
    task.source, task.target = first, second
    operators.save_clone_job(filepath=str(folder / "no" / "wrong.toml"))
assert sorted(path.name for path in folder.iterdir()) == before
