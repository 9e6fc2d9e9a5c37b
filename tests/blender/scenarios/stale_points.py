"""Points hold to the surface when the mesh below them is cut, merged, renumbered, sculpted or deleted."""

import sys
from collections.abc import Callable, Iterable
from pathlib import Path

import bpy
import numpy as np
from stage import empty_scene, enable, grid, part, refused

folder = Path(sys.argv[1])
points, anchors, core = part("bridge.points.points"), part("bridge.points.point_anchors"), part("core.points")
SIDE = 9
VERTICES = (12, 30, 40, 50, 68)
EDGE = 0.25


def new_face(name: str = "face") -> bpy.types.Object:
    """A curved surface with five points on vertices and one amid a face."""
    empty_scene()
    thing = grid(name, SIDE)
    bpy.context.view_layer.objects.active = thing
    thing.select_set(True)
    names = (*(f"at {vertex}" for vertex in VERTICES), "amid")
    corners = np.array([*([vertex] * 3 for vertex in VERTICES), [20, 21, 29]])
    weights = np.array([*([1.0, 0, 0] for _ in VERTICES), [0.2, 0.5, 0.3]])
    points.write_points(thing, core.FeaturePoints(names, corners, weights))
    return thing


def places(thing: bpy.types.Object) -> dict[str, np.ndarray]:
    """Where the points are on the Basis."""
    read = points.read_points(thing)
    return dict(zip(read.names, read.positions(positions(thing)), strict=True))


def positions(thing: bpy.types.Object) -> np.ndarray:
    return part("bridge.meshes").read_positions(thing.data).astype(float)


def edit(vertices: Iterable[int] | None, work: Callable[[], object]) -> None:
    """In Edit Mode, with these vertices selected (None for all)."""
    thing = bpy.context.active_object
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_mode(type="VERT")
    bpy.ops.mesh.select_all(action="SELECT" if vertices is None else "DESELECT")
    if vertices is not None:
        bpy.ops.object.mode_set(mode="OBJECT")
        for vertex in vertices:
            thing.data.vertices[vertex].select = True
        bpy.ops.object.mode_set(mode="EDIT")
    work()
    bpy.ops.object.mode_set(mode="OBJECT")


def delete() -> None:
    bpy.ops.mesh.delete(type="VERT")


def subdivide() -> None:
    bpy.ops.mesh.subdivide(number_cuts=2)


def same(found: dict[str, np.ndarray], expected: dict[str, np.ndarray], tolerance: float = 1e-5) -> None:
    assert found.keys() == expected.keys(), (found.keys(), expected.keys())
    for name, place in expected.items():
        np.testing.assert_allclose(found[name], place, atol=tolerance, err_msg=name)


def stored(thing: bpy.types.Object) -> list[tuple[object, ...]]:
    return [(p.name, *p.vertices, *p.weights, p.topology) for p in thing.facial_retarget.points]


# A vertex deleted elsewhere: the numbers move, the points do not. Reading writes nothing; Refresh Points does.
for work, selected in (
    (delete, [0]),
    (subdivide, None),
    (lambda: bpy.ops.mesh.sort_elements(type="REVERSE", elements={"VERT"}), None),
    (lambda: bpy.ops.mesh.flip_normals() and bpy.ops.mesh.flip_normals(), None),
    (lambda: bpy.ops.mesh.quads_convert_to_tris(), None),
    (lambda: bpy.ops.mesh.dissolve_verts(), [24, 60]),
    (lambda: bpy.ops.mesh.remove_doubles(threshold=0.4), [0, 1]),
    (lambda: bpy.ops.mesh.delete(type="VERT") or bpy.ops.mesh.select_all(action="SELECT") or subdivide(), [80, 79]),
):
    thing = new_face()
    before, kept = places(thing), stored(thing)
    edit(selected, work)
    same(places(thing), before)
    assert stored(thing) == kept, "reading wrote"
    assert points.settled_points(thing).lost == ()
    assert points.settled_points(thing).moved == {}, points.settled_points(thing).moved
    assert bpy.ops.facial_retarget.refresh_points() == {"FINISHED"}
    same(places(thing), before)
    topology = part("bridge.points.topology").topology_of(thing.data)
    assert all(point.topology == topology for point in thing.facial_retarget.points)
    assert len({tuple(point.vertices) for point in thing.facial_retarget.points}) == len(before)
    on_vertex = [point for point in thing.facial_retarget.points if point.name != "amid"]
    assert all(point.weights[:] == (1.0, 0.0, 0.0) for point in on_vertex), [p.weights[:] for p in on_vertex]

# Sculpted after the points were placed, then cut: they are where the sculpted surface is, not where it was.
thing = new_face()
moved = positions(thing) + [0.0, 0.3, 0.5]
thing.data.vertices.foreach_set("co", moved.astype(np.float32).ravel())
thing.data.update()
before = places(thing)
edit(None, subdivide)
edit([0, 5], delete)
same(places(thing), before)
bpy.ops.facial_retarget.refresh_points()
same(places(thing), before)

# The same with shape keys, whose Basis counts.
thing = new_face()
thing.shape_key_add(name="Basis")
thing.shape_key_add(name="smile", from_mix=False).points[40].co.z += 1.0
before = places(thing)
edit(None, subdivide)
same(places(thing), before)

# Fewer vertices: points move with the surface, by less than its edges, and Refresh Points says which.
thing = new_face()
edit(None, subdivide)
before = places(thing)
bpy.ops.facial_retarget.refresh_points()
thing.modifiers.new("light", "DECIMATE").ratio = 0.06
bpy.ops.object.modifier_apply(modifier="light")
settled = points.settled_points(thing)
assert settled.moved, "a decimated surface lies elsewhere"
assert set(settled.moved).isdisjoint(settled.lost)
read = settled.points.positions(positions(thing))
for name, place in zip(settled.points.names, read, strict=True):
    if name not in settled.lost:
        assert np.linalg.norm(place - before[name]) < 0.1, (name, place, before[name])

# The surface below a point deleted: never a silent wrong place. It is proposed at the nearest one.
thing = new_face()
before = places(thing)
edit([50, 51, 59], delete)
with refused("'at 50'", "gone", "Refresh Points"):
    points.read_points(thing)
with refused("'at 50'", "gone"):
    bpy.ops.facial_retarget.save_points(filepath=str(folder / "lost.json"))
assert not (folder / "lost.json").exists()
with refused("'at 50'", "Refresh Points"):
    points.place_point(thing, "new", [1, 1, 1], [1.0, 0.0, 0.0])
# Placed anew it is where the artist says.
target = thing.data.vertices[10].co.copy()
points.place_point(thing, "at 50", [10, 10, 10], [1.0, 0.0, 0.0])
del before["at 50"]
found = places(thing)
np.testing.assert_allclose(found.pop("at 50"), target, atol=1e-6)
same(found, before)

thing = new_face()
before = places(thing)
edit([50], delete)
bpy.ops.ed.undo_push(message="deleted")
assert bpy.ops.facial_retarget.refresh_points() == {"FINISHED"}
bpy.ops.ed.undo_push(message="refreshed")
del before["at 50"]
same(places(thing), before)
assert thing.facial_retarget.proposals.keys() == ["at 50"]
assert points.read_proposals(thing).names == ("at 50",)
bpy.ops.ed.undo()
thing = bpy.data.objects["face"]
assert "at 50" in thing.facial_retarget.points
assert not len(thing.facial_retarget.proposals)
bpy.ops.ed.redo()
thing = bpy.data.objects["face"]
assert "at 50" not in thing.facial_retarget.points

# Undo of the edit itself: as if nothing had been.
thing = new_face()
before = places(thing)
bpy.ops.ed.undo_push(message="placed")
edit([0, 50], delete)
bpy.ops.ed.undo_push(message="deleted")
bpy.ops.facial_retarget.refresh_points()
bpy.ops.ed.undo_push(message="refreshed")
bpy.ops.ed.undo()
bpy.ops.ed.undo()
thing = bpy.data.objects["face"]
same(places(thing), before)
assert not len(thing.facial_retarget.proposals)


# By script, with the attribute and without it.
def delete_by_script(mesh: bpy.types.Mesh, vertices: Iterable[int]) -> None:
    import bmesh  # Exists once bpy is imported.

    work = bmesh.new()
    work.from_mesh(mesh)
    work.verts.ensure_lookup_table()
    bmesh.ops.delete(work, geom=[work.verts[vertex] for vertex in vertices])
    work.to_mesh(mesh)
    work.free()


thing = new_face()
before = places(thing)
delete_by_script(thing.data, [0, 3])
same(places(thing), before)
thing = new_face()
before = places(thing)
meshes = part("bridge.meshes")
counts, corners = meshes.read_polygons(thing.data)
order = np.random.default_rng(1).permutation(SIDE**2)
rest = positions(thing)
shuffled = np.empty_like(rest)
shuffled[order] = rest
meshes.replace_geometry(thing.data, shuffled, counts, order[corners])
assert anchors.REST not in thing.data.attributes
same(places(thing), before)
bpy.ops.facial_retarget.refresh_points()
same(places(thing), before)

# Two objects of one mesh: refreshing one leaves the other whole.
thing = new_face()
twin = bpy.data.objects.new("twin", thing.data)
bpy.context.scene.collection.objects.link(twin)
points.write_points(twin, points.read_points(thing))
before = places(thing)
edit([0], delete)
points.refresh_points(thing)
edit([79], delete)
same(places(thing), before)
same(places(twin), before)

# Saved and opened again.
bpy.ops.wm.save_as_mainfile(filepath=str(folder / "stale.blend"))
bpy.ops.wm.open_mainfile(filepath=str(folder / "stale.blend"))
enable()
for name in ("face", "twin"):
    same(places(bpy.data.objects[name]), before)

# Placed in Edit Mode: kept while the topology is, anchored at the next chance, and lost aloud in between.
thing = new_face()
before = places(thing)
edit([44], lambda: bpy.ops.facial_retarget.add_point(name="chin", place="VERTEX"))
before["chin"] = np.array(thing.data.vertices[44].co)
same(places(thing), before)
edit([0], delete)
with refused("'chin'", "gone"):
    points.read_points(thing)
thing = new_face()
edit([44], lambda: bpy.ops.facial_retarget.add_point(name="chin", place="VERTEX"))
before = places(thing)
bpy.ops.facial_retarget.refresh_points()
edit([0], delete)
same(places(thing), before)

# While it is being changed nothing is believed.
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.select_all(action="SELECT")
bpy.ops.mesh.subdivide()
thing.update_from_editmode()
with refused("Edit Mode"):
    points.read_points(thing)
bpy.ops.object.mode_set(mode="OBJECT")
same(places(thing), before)

# Points of files from before anchors count as they stand, and are anchored with the first that is placed.
thing = new_face()
for point in thing.facial_retarget.points:
    point.topology, point.anchored = "", False
before = places(thing)
points.place_point(thing, "new", [1, 1, 1], [1.0, 0.0, 0.0])
before["new"] = np.array(thing.data.vertices[1].co)
edit([0], delete)
same(places(thing), before)

# What Esc puts back holds to the surface as before.
thing = new_face()
before = places(thing)
memory = part("bridge.points.point_memory")
kept = memory.remember_points(thing)
points.place_point(thing, "at 40", [1, 1, 1], [1.0, 0.0, 0.0])
memory.put_back_points(thing, kept)
edit([0], delete)
same(places(thing), before)

# Broken points hinder neither the set from being chosen nor other points from being removed.
thing = new_face()
thing.facial_retarget.points["at 40"].vertices = (999, 999, 999)
thing.facial_retarget.point_set = "DENSE"
thing.facial_retarget.active_point = thing.facial_retarget.points.find("at 40")
assert bpy.ops.facial_retarget.remove_point() == {"FINISHED"}
assert len(places(thing)) == 5

# A mesh of another file is not changed for good, and bears points all the same.
thing = new_face()
bpy.data.libraries.write(str(folder / "library.blend"), {thing.data})
empty_scene()
with bpy.data.libraries.load(str(folder / "library.blend"), link=True) as (there, here):
    here.meshes = there.meshes[:1]
linked = bpy.data.objects.new("linked", here.meshes[0])
bpy.context.scene.collection.objects.link(linked)
points.place_point(linked, "at 40", [40, 40, 40], [1.0, 0.0, 0.0])
assert points.read_points(linked).vertices.tolist() == [[40, 40, 40]]
bpy.context.view_layer.objects.active = linked
assert bpy.ops.facial_retarget.refresh_points() == {"FINISHED"}
assert points.read_points(linked).vertices.tolist() == [[40, 40, 40]]
