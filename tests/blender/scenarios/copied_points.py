"""Feature points go from one object to others: bit by bit on the same topology, through the fit elsewhere."""

import bpy
import numpy as np
from stage import demo_object, empty_scene, grid, part, refused

empty_scene()
points, meshes = part("bridge.points.points"), part("bridge.meshes")
demo, sets = part("demo"), part("core.point_sets")
actor = demo_object(demo.actor(2_000), "actor")
built = demo.warped_actor(np.random.default_rng(1), 4_500)
warped = demo_object(built, "warped")
truth = points.read_points(warped)
copy = bpy.ops.facial_retarget.copy_points


def choose(active: bpy.types.Object | None, *others: bpy.types.Object) -> None:
    """Select objects, one of them active."""
    for thing in bpy.data.objects:
        thing.select_set(thing in (active, *others))
    bpy.context.view_layer.objects.active = active


def stored(thing: bpy.types.Object) -> list[tuple[object, ...]]:
    return [(point.name, *point.vertices, *point.weights) for point in thing.facial_retarget.points]


# The same topology, moved: all points, exactly; the target's own others stay.
twin = bpy.data.objects.new("twin", actor.data.copy())
bpy.context.scene.collection.objects.link(twin)
for vertex in twin.data.vertices:
    vertex.co *= 1.7
points.place_point(twin, "wart", [5, 5, 5], [1.0, 0.0, 0.0])
choose(actor, twin)
assert copy() == {"FINISHED"}
assert stored(twin)[1:] == stored(actor)
assert stored(twin)[0][0] == "wart"

# Another topology: refused without points of its own, found through the fit with five; these stay.
warped.facial_retarget.points.clear()
choose(actor, warped)
with refused("'warped'", "0 feature points in common", "at least 5"):
    copy()
points.write_points(warped, truth.subset(sets.FIRST_FIVE))
before = stored(warped)
bpy.ops.ed.undo_push(message="before")
assert copy() == {"FINISHED"}
bpy.ops.ed.undo_push(message="after")
assert stored(warped)[:5] == before
copied = points.read_points(warped)
assert set(copied.names) == set(points.read_points(actor).names)
positions = meshes.read_positions(warped.data).astype(float)
eyes = truth.subset(["3.7", "3.12"]).positions(positions)
off = np.linalg.norm(copied.positions(positions) - truth.subset(copied.names).positions(positions), axis=1)
assert np.median(off) < 0.03 * np.linalg.norm(eyes[0] - eyes[1]), np.median(off)
assert not len(warped.facial_retarget.proposals)
bpy.ops.ed.undo()
assert stored(bpy.data.objects["warped"]) == before

# Several at once; where one of them cannot be, none is changed.
actor, twin, warped = (bpy.data.objects[name] for name in ("actor", "twin", "warped"))
twin.facial_retarget.points.clear()
plain = grid("plain")
choose(actor, twin, plain)
with refused("'plain'", "another topology"):
    copy()
assert not len(twin.facial_retarget.points)
choose(actor, twin, warped)
assert copy() == {"FINISHED"}
assert stored(twin) == stored(actor)
assert len(warped.facial_retarget.points) == len(actor.facial_retarget.points)

# A pupil lies on an eye, not on the skin that is fitted: it is not copied to another topology.
points.place_point(actor, "3.5", [0, 0, 0], [1.0, 0.0, 0.0])
points.write_points(warped, truth.subset(sets.FIRST_FIVE))
assert copy() == {"FINISHED"}
assert "3.5" not in warped.facial_retarget.points
assert "3.5" in twin.facial_retarget.points

# The button says what it wants.
choose(actor)
assert not copy.poll()
choose(plain, actor)
assert not copy.poll()
choose(None)
assert not copy.poll()
