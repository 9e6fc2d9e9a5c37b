"""Shape keys of the standard's sets, made out of feature points."""

import bpy
import numpy as np
from stage import actor_face, empty_scene, fitted, grid, part, refused

empty_scene()
examples, sets = part("bridge.examples.examples"), part("core.mpeg4.sets").SETS
make_shapes = bpy.ops.facial_retarget.make_shapes

# Without points the button is grey; without MPEG-4 names it says what it wants.
plain = grid("plain")
bpy.context.view_layer.objects.active = plain
assert not make_shapes.poll()
part("bridge.points.points").add_point_at_vertex(plain, "wart", 3)
with refused("MPEG-4"):
    make_shapes()

# What Create Example Shape Keys leaves empty is roughed out.
actor = actor_face()
task = bpy.context.scene.facial_retarget
task.source, task.target = actor, plain
bpy.ops.facial_retarget.create_examples()
keys = actor.data.shape_keys.key_blocks
assert [key.name for key in keys] == ["Basis", *sets["expressions"]]
assert make_shapes() == {"FINISHED"}
assert [key.name for key in keys] == ["Basis", *sets["expressions"]]
face = fitted(actor)
shapes = part("core.acting.expression_sets").expression_shapes(face, ("expressions",))


def shape(name: str) -> np.ndarray:
    """(V, 3) what a key holds."""
    flat = np.empty(3 * len(actor.data.vertices), np.float32)
    keys[name].points.foreach_get("co", flat)
    return flat.reshape(-1, 3)


for name, positions in shapes.items():
    assert np.array_equal(shape(name), positions), name
    assert keys[name].value == 0

# What the artist has sculpted is kept, or replaced if they say so.
sculpted = shape("joy") + 0.1
part("bridge.examples.examples").write_example(actor, "joy", sculpted)
make_shapes(sets={"expressions", "visemes"})
assert np.array_equal(shape("joy"), sculpted)
assert set(sets["visemes"]) < set(keys.keys())
make_shapes(existing="REPLACE")
assert np.array_equal(shape("joy"), shapes["joy"])

# All of them; those that the face has no points for are there and empty.
make_shapes(sets=set(sets))
assert set(keys.keys()) == {"Basis", *(name for shapes in sets.values() for name in shapes)}
assert np.array_equal(shape("tongueOut"), shape("Basis"))
assert all(key.value == 0 for key in keys[1:])

# An object that is scaled unevenly is the face that the artist sees.
other = actor_face()
other.scale = (1, 2, -1)
bpy.context.view_layer.update()
make_shapes(sets={"arkit"})
meshes = part("bridge.meshes")
seen = part("core.acting.expression_sets").expression_shapes(fitted(other), ("arkit",))["jawOpen"]
flat = np.empty(3 * len(other.data.vertices), np.float32)
other.data.shape_keys.key_blocks["jawOpen"].points.foreach_get("co", flat)
np.testing.assert_allclose(meshes.to_face_space(other, flat.reshape(-1, 3)), seen, atol=1e-5)
