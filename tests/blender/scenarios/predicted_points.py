"""Missing points are proposed from those that are placed, accepted one by one or all, and never overwrite one."""

import bpy
import numpy as np
from stage import actor_face, empty_scene, part, refused

empty_scene()
points, prediction, sets = part("bridge.points.points"), part("bridge.points.point_prediction"), part("core.point_sets")
operators = bpy.ops.facial_retarget
thing = actor_face()
face = thing.facial_retarget
truth = points.read_points(thing)
FMC = [info.name for info in sets.POINT_SETS["FMC"]]


def place(*names: str) -> None:
    """Place points where the actor has them, as the tool does."""
    for name in names:
        points.place_points(thing, truth.subset([name]))
        prediction.update_predictions(thing)


def placed() -> dict[str, tuple[object, ...]]:
    return {point.name: (*point.vertices, *point.weights) for point in face.points}


def undoable(operator: object, **options: object) -> None:
    """One undo step takes back what an operator does."""
    before = placed(), face.proposals.keys(), face.skipped.keys()
    bpy.ops.ed.undo_push(message="before")
    assert operator(**options) == {"FINISHED"}
    after = placed(), face.proposals.keys(), face.skipped.keys()
    assert after != before
    bpy.ops.ed.undo_push(message="after")
    bpy.ops.ed.undo()
    again()
    assert (placed(), face.proposals.keys(), face.skipped.keys()) == before
    bpy.ops.ed.redo()
    again()
    assert (placed(), face.proposals.keys(), face.skipped.keys()) == after


def again() -> None:
    """Undo makes the objects anew."""
    global thing, face
    thing = bpy.data.objects["actor"]
    face = thing.facial_retarget


# Nothing is told by too few; then everything of the set is proposed, in the set's order.
face.points.clear()
place("3.7", "3.12")
assert not len(face.proposals)
place("9.3", "2.1", "8.3")
assert face.points.keys() == list(sets.FIRST_FIVE)
assert face.proposals.keys() == FMC[5:]
assert (face.placed_of_set, face.set_size, face.placed_beyond) == (5, 48, 0)
positions = part("bridge.meshes").read_positions(thing.data).astype(float)
told = points.read_proposals(thing)
off = np.linalg.norm(told.positions(positions) - truth.subset(told.names).positions(positions), axis=1)
eyes = truth.subset(["3.7", "3.12"]).positions(positions)
assert np.median(off) < 0.1 * np.linalg.norm(eyes[0] - eyes[1]), np.median(off)

# They follow what is placed, and never overwrite it; what is skipped is not proposed.
before = points.read_proposals(thing).subset(["8.4"]).positions(positions)
points.place_points(thing, part("core.points").FeaturePoints(("8.3",), truth.subset(["5.1"]).vertices, [[1.0, 0, 0]]))
prediction.update_predictions(thing)
after = points.read_proposals(thing).subset(["8.4"]).positions(positions)
assert np.linalg.norm(after - before) > 0.02, "the proposals did not follow"
place("8.3")
points.skip_point(thing, "11.1")
prediction.update_predictions(thing)
assert "11.1" not in face.proposals
assert face.set_size == 47
undoable(operators.want_point, name="11.1")
assert "11.1" in face.proposals

# The set says what is proposed.
face.point_set = "MINIMAL"
assert face.proposals.keys() == FMC[5:15]
face.point_set = "FMC"
assert face.proposals.keys() == FMC[5:]

# One is accepted where it is proposed, by name or as chosen in the list; then the others.
there = points.read_proposals(thing).subset(["8.4"])
undoable(operators.accept_point, name="8.4")
assert placed()["8.4"][:3] == tuple(there.vertices[0])
assert "8.4" not in face.proposals
face.active_proposal = 1
name = face.proposals[1].name
undoable(operators.accept_point)
assert name in face.points
with refused("'wart'"):
    operators.accept_point(name="wart")
kept = {name: placed()[name] for name in sets.FIRST_FIVE}
undoable(operators.clear_proposals)
assert not operators.accept_points.poll()
assert not operators.clear_proposals.poll()
face.active_point = face.points.find("8.4")
operators.remove_point()
assert "8.4" in face.proposals
count = len(face.proposals)
assert count == 48 - len(face.points)
undoable(operators.accept_points)
assert set(face.points.keys()) == set(FMC)
assert not len(face.proposals)
assert {name: placed()[name] for name in kept} == kept
assert (face.placed_of_set, face.set_size) == (48, 48)

# What was placed keeps when the mesh is cut, and proposals are made again with the refreshed points.
face.points.clear()
place(*FMC[:6])
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.select_all(action="SELECT")
bpy.ops.mesh.subdivide()
bpy.ops.object.mode_set(mode="OBJECT")
assert face.stale_points
assert points.read_proposals(thing).names == ()
operators.refresh_points()
assert not face.stale_points
assert points.read_proposals(thing).names == tuple(FMC[6:])

# Names of one's own stay; a mesh without points has no say.
points.place_point(thing, "wart", [3, 3, 3], [1.0, 0.0, 0.0])
prediction.update_predictions(thing)
assert face.proposals.keys() == FMC[6:]
assert [point.title for point in face.points][-2:] == ["8.4  Right Mouth Corner", "wart"]

assert (face.placed_of_set, face.set_size, face.placed_beyond) == (6, 48, 1)

# Guessed from nothing: the face is found by its shape alone, and one point placed moves the others.
face.points.clear()
face.proposals.clear()
place("9.3")
assert not len(face.proposals), "nobody waits for a guess that was not asked for"
face.points.clear()
undoable(operators.guess_points)
assert face.proposals.keys() == FMC
assert not len(face.points)
positions = part("bridge.meshes").read_positions(thing.data).astype(float)


def errors(names: list[str]) -> np.ndarray:
    """How far proposals are off, in distances between the outer corners of the eyes."""
    told, known = points.read_proposals(thing).subset(names), dict(zip(truth.names, at, strict=True))
    gaps = told.positions(positions) - [known[name] for name in names]
    return np.linalg.norm(gaps, axis=1) / np.linalg.norm(known["3.7"] - known["3.12"])


at = truth.positions(part("bridge.meshes").read_positions(actor_face().data).astype(float))
bpy.context.view_layer.objects.active = thing
assert np.median(errors(FMC)) < 0.1, np.median(errors(FMC))
nose = points.read_proposals(thing).subset(["9.3"])
points.place_points(thing, nose)
prediction.update_predictions(thing)
assert face.proposals.keys() == [name for name in FMC if name != "9.3"]
operators.accept_points()
with refused("lacks no point"):
    operators.guess_points()
assert not any(point.doubt for point in face.points), [point.doubt for point in face.points]

# Nothing that looks like a face.
bpy.ops.mesh.primitive_cube_add()
with refused("no face"):
    operators.guess_points()
bpy.ops.object.delete()
bpy.context.view_layer.objects.active = thing

# Mirrored through the surface: to the place of the partner; the middle line has none.
before = dict(zip(face.points.keys(), points.read_points(thing).positions(positions), strict=True))
for name in [name for name in FMC if sets.side_of(name) == "right"]:
    points.remove_point(thing, name)
undoable(operators.mirror_points, which="LEFT")
after = dict(zip(face.points.keys(), points.read_points(thing).positions(positions), strict=True))
assert set(after) == set(FMC)
left = [name for name in FMC if sets.side_of(name) == "left"]
across = np.array([after[sets.partner_of(name)] - after[name] for name in left])
across /= np.linalg.norm(across, axis=1)[:, None]
assert (np.abs(across @ across.mean(axis=0)) > 0.98).all(), "the mirrored points are not across from their partners"
assert all(np.array_equal(after[name], before[name]) for name in FMC if sets.side_of(name) != "right")
points.place_point(thing, "8.4", [3, 3, 3], [1.0, 0.0, 0.0])
operators.mirror_points(which="LEFT")
again_after = dict(zip(face.points.keys(), points.read_points(thing).positions(positions), strict=True))
assert all(np.allclose(again_after[name], after[name], atol=1e-4) for name in after), "a wrong partner had a say"
face.active_point = face.points.find("8.4")
points.remove_point(thing, "8.3")
face.active_point = face.points.find("8.4")
undoable(operators.mirror_points, which="CHOSEN")
assert "8.3" in face.points
face.active_point = face.points.find("9.3")
with refused("9.3", "partner"):
    operators.mirror_points(which="CHOSEN")

# Doubts: swapped points say so, until they are put right.
stored = points.read_points(thing)
swapped = {"8.3": "8.4", "8.4": "8.3"}
for name, other in swapped.items():
    points.place_point(thing, name, stored.subset([other]).vertices[0], stored.subset([other]).weights[0])
prediction.update_predictions(thing)
assert {point.name for point in face.points if point.doubt} == {"8.3", "8.4"}, [
    (point.name, point.doubt) for point in face.points if point.doubt
]
assert "wrong side" in face.points["8.3"].doubt
points.place_points(thing, stored.subset(["8.3", "8.4"]))
prediction.update_predictions(thing)
assert not any(point.doubt for point in face.points)
points.place_points(thing, part("core.points").FeaturePoints(("9.3",), stored.subset(["11.1"]).vertices, [[1.0, 0, 0]]))
prediction.update_predictions(thing)
assert face.points["9.3"].doubt, "a nose on the forehead"
pieces = part("bridge.meshes").neutral_mesh(thing).components
elsewhere = int(np.flatnonzero(pieces != pieces[truth.subset(["9.3"]).holders[0]])[0])
on_part = part("core.points").FeaturePoints(("9.3",), np.full((1, 3), elsewhere), np.array([[1.0, 0, 0]]))
points.place_points(thing, on_part)
prediction.update_predictions(thing)
assert "another part of the mesh" in face.points["9.3"].doubt
