"""The shape keys of a head as a facial animation table and as arrays, and back onto the same head."""

import json
import sys
from pathlib import Path

import bpy
import numpy as np
from stage import demo_object, empty_scene, grid, key_shape, part, refused

folder = Path(sys.argv[1])
empty_scene()
context = bpy.context
operators = bpy.ops.facial_retarget
heads = part("bridge.heads")
actor = part("demo").donor(4_500)


def active(thing: bpy.types.Object) -> bpy.types.Object:
    """Make an object the one that operators work on."""
    context.view_layer.objects.active = thing
    return thing


face = active(demo_object(actor, "face"))
with refused("'face'", "no shape keys"):
    operators.save_shapes(filepath=str(folder / "none.json"))
operators.make_shapes(sets={"faps", "visemes"})
names = part("bridge.key_sets").key_names(face)
moves = heads.read_head(face).displacements(names)

# What is written is what the command line reads, and FAPs and visemes are told.
for name in ("shapes.json", "shapes.npz"):
    operators.save_shapes(filepath=str(folder / name))
    read = part("files.shape_files").read_shapes(folder / name, actor.face.mesh)
    assert list(read.names) == names
    np.testing.assert_allclose(read.displacements, moves, atol=1e-6)
table = json.loads((folder / "shapes.json").read_text())["shapes"]
assert (table["open_jaw"]["kind"], table["open_jaw"]["key"]) == ("fap", 3)
assert table["viseme_aa"]["kind"] == "viseme"

# Onto a head of the same vertices in several objects, a part gets what moves it.
apart = active(demo_object(actor, "apart", pieces=True))
assert operators.load_shapes(filepath=str(folder / "shapes.json")) == {"FINISHED"}
assert part("bridge.key_sets").key_names(apart) == names
np.testing.assert_allclose(heads.read_head(apart).displacements(names), moves, atol=2e-6)
keys = apart.data.shape_keys.key_blocks
assert (keys["open_jaw"].slider_min, keys["open_jaw"].slider_max) == (0, 1)
assert (keys["shift_jaw"].slider_min, keys["shift_jaw"].slider_max) == (-1, 1)
assert all(key.value == 0 for key in keys[1:])
parts = [entry.thing for entry in apart.facial_retarget.parts]
assert any(thing.data.shape_keys is not None for thing in parts)
assert any(thing.data.shape_keys is None for thing in parts)

# Existing keys.
sculpted = key_shape(apart, "open_jaw") + np.float32(0.1)
part("bridge.shape_keys").write_key(keys["open_jaw"], sculpted)
operators.load_shapes(filepath=str(folder / "shapes.npz"))
assert np.array_equal(key_shape(apart, "open_jaw"), sculpted)
operators.load_shapes(filepath=str(folder / "shapes.npz"), existing="SUFFIX")
assert "open_jaw.001" in keys
operators.load_shapes(filepath=str(folder / "shapes.npz"), existing="REPLACE")
assert not np.array_equal(key_shape(apart, "open_jaw"), sculpted)

# Another head, and files that are none.
active(grid("other"))
for name in ("shapes.json", "shapes.npz"):
    with refused("36"):
        operators.load_shapes(filepath=str(folder / name))
active(apart)
with refused("missing.json"):
    operators.load_shapes(filepath=str(folder / "missing.json"))
(folder / "broken.json").write_text("{")
with refused("broken.json"):
    operators.load_shapes(filepath=str(folder / "broken.json"))
with refused("no folder"):
    operators.save_shapes(filepath=str(folder / "no" / "shapes.json"))
