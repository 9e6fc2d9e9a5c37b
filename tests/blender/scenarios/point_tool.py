"""The operators of the feature-point tool, as scripts call them."""

import bpy
import numpy as np
from mathutils import Matrix
from stage import actor_face, demo_object, empty_scene, grid, part, refused

empty_scene()
operators, places = bpy.ops.facial_retarget, part("bridge.points.point_places")
task = bpy.context.scene.facial_retarget


def world(thing: bpy.types.Object) -> dict[str, np.ndarray]:
    return dict(zip(*places.world_places(thing, bpy.context.evaluated_depsgraph_get()), strict=True))


# Without a face every operator says so.
for operator in (operators.place_point, operators.drop_point, operators.skip_point):
    with refused("no mesh object is active"):
        operator()

# A point goes where the surface, as it is shown, is closest; a name places another one than that whose turn it is.
face = grid("face", 21)
bpy.context.view_layer.objects.active = face
stored = face.facial_retarget
face.shape_key_add(name="Basis", from_mix=False)
raised = face.shape_key_add(name="raised", from_mix=False)
raised.points.foreach_set("co", (part("bridge.meshes").read_positions(face.data) + np.float32([0, 0, 5])).ravel())
raised.value = 1.0
face.matrix_world = Matrix.Translation((5, 6, 7)) @ Matrix.Rotation(1, 4, "X") @ Matrix.Diagonal((-2, 3, 0.5, 1))
bpy.context.view_layer.update()
wanted = np.array(face.matrix_world) @ [*face.data.vertices[33].co[:2], face.data.vertices[33].co.z + 5, 1]
first = stored.turn
assert operators.place_point(location=wanted[:3].tolist()) == {"FINISHED"}
np.testing.assert_allclose(world(face)[first], wanted[:3], atol=1e-5)
assert stored.points[first].vertices[np.argmax(stored.points[first].weights)] == 33
assert stored.turn != first
operators.place_point(name="mole", location=(0, 0, 0))
assert stored.points.keys() == [first, "mole"]
assert stored.points[stored.active_point].name == "mole"
operators.place_point(name=first, location=(0, 0, 0))
np.testing.assert_allclose(world(face)[first], world(face)["mole"])

# Skipping passes the turn on, and going back returns it.
second = stored.turn
operators.skip_point()
assert stored.turn not in (first, second)
assert stored.skipped.keys() == [second]
operators.skip_point(back=True)
assert stored.turn == second
with refused("no point", "skipped"):
    operators.skip_point(back=True)

operators.drop_point(name="mole")
assert stored.points.keys() == [first]
with refused("'mole'", "no feature point"):
    operators.drop_point(name="mole")

face.matrix_world = Matrix.Identity(4)
raised.value = 0.0

# Added vertices do not matter, renumbered ones are refused with the reason.
smooth = face.modifiers.new("smooth", "SUBSURF")
bpy.context.view_layer.update()
operators.place_point(name="9.3", location=(0.4, 0.4, 2))
np.testing.assert_allclose(world(face)["9.3"][:2], [0.4, 0.4], atol=0.2)
face.modifiers.remove(smooth)
face.modifiers.new("coarse", "DECIMATE").ratio = 0.5
bpy.context.view_layer.update()
with refused("'face'", "modifier"):
    operators.place_point(name="9.3", location=(0, 0, 2))

# In Edit Mode they cannot run. Every point of the set placed: no turn is left.
bpy.ops.object.mode_set(mode="EDIT")
assert not operators.place_point.poll()
bpy.ops.object.mode_set(mode="OBJECT")
actor = actor_face()
actor.facial_retarget.point_set = "MINIMAL"
assert actor.facial_retarget.turn == ""
with refused("all points of the set"):
    operators.place_point(location=(0, 0, 0))

# With X Mirror a point's partner comes, follows and goes with it; one on the middle line stays alone.
truth, stored = world(actor), actor.facial_retarget
stored.points.clear()
task.mirror_points = True
for name, partner in (("8.3", "8.4"), ("8.4", "8.3"), ("3.7", "3.12")):
    operators.place_point(name=name, location=truth[name])
    assert stored.points[stored.active_point].name == name
    np.testing.assert_allclose(world(actor)[partner], truth[partner], atol=0.02)
operators.place_point(name="9.3", location=truth["9.3"])
assert set(stored.points.keys()) == {"8.3", "8.4", "3.7", "3.12", "9.3"}
assert len(stored.proposals) == 10, stored.proposals.keys()
operators.drop_point(name="8.4")
assert set(stored.points.keys()) == {"3.7", "3.12", "9.3"}
assert {"8.3", "8.4"} <= set(stored.proposals.keys())

# Halves that differ in shape: the partner is found through the surface, not by the coordinate.
warped = demo_object(part("demo").warped_actor(np.random.default_rng(1), 4_500), "warped")
bpy.context.view_layer.objects.active = warped
bpy.context.view_layer.update()
told = world(warped)
eyes = np.linalg.norm(told["3.7"] - told["3.12"])
warped.facial_retarget.points.clear()
for name in ("9.3", "2.1", "3.7", "8.3", "4.3"):
    operators.place_point(name=name, location=told[name])
found = world(warped)
for name in ("3.12", "8.4", "4.4"):
    off = np.linalg.norm(found[name] - told[name]) / eyes
    assert off < 0.1, (name, off)
bpy.context.view_layer.objects.active = actor
task.mirror_points = False

# Return accepts the proposal of the point whose turn it is.
accepted = stored.turn
operators.accept_hovered()
assert accepted in stored.points
assert accepted not in stored.proposals
stored.proposals.clear()
with refused(stored.turn, "not proposed"):
    operators.accept_hovered()

# Esc puts everything back, bit by bit.
memory = part("bridge.points.point_memory")
kept = memory.remember_points(actor)
operators.place_point(name="9.3", location=(0, 0, 0))
operators.drop_point(name="2.1")
assert memory.remember_points(actor) != kept
memory.put_back_points(actor, kept)
assert memory.remember_points(actor) == kept

# A predictor that is made beside is the one that is asked then; who mirrors before it is there waits for it.
preparation, prediction = part("bridge.points.point_preparation"), part("bridge.points.point_prediction")
fresh = demo_object(part("demo").actor(3_000), "fresh")
bpy.context.view_layer.objects.active = fresh
bpy.context.view_layer.update()
truth = world(fresh)
fresh.facial_retarget.points.clear()
preparation.prepare_predictions(fresh)
assert preparation.is_preparing(fresh)
task.mirror_points = True
operators.place_point(name="8.3", location=truth["8.3"])
assert not preparation.is_preparing(fresh)
np.testing.assert_allclose(world(fresh)["8.4"], truth["8.4"], atol=0.02)
made = prediction.kept_predictor(fresh)
assert made is not None
preparation.prepare_predictions(fresh)
assert not preparation.is_preparing(fresh)
assert prediction.predictor_of(fresh) is made

# A point of the skin goes through lashes close before it; through nothing that is large or far from it, nor else.
surface, view, meshes = part("bridge.points.shown_surface"), part("core.view_rays").View, part("bridge.meshes")
skin, plates = grid("skin", 21), []
for x, z, half in ((-0.6, 0.9, 0.05), (0.0, 1.05, 0.3), (0.6, 2.0, 0.05)):  # lashes, an eyeball, a light far before it
    plates += [(x - half, -half, z), (x + half, -half, z), (x, half, z)]
covered = meshes.new_object(
    "covered",
    np.concatenate([meshes.read_positions(skin.data), plates]),
    np.array([4] * 400 + [3] * 3),
    np.concatenate([[loop.vertex_index for loop in skin.data.loops], 441 + np.arange(9)]),
)
bpy.context.view_layer.update()
above = view(np.array([100.0, 100.0]), np.array(Matrix.Translation((0, 0, -5))), np.diag([1.0, 1.0, -0.1, 1.0]))
shown = surface.ShownSurface(covered, bpy.context.evaluated_depsgraph_get())
for x, on_skin, height in (
    (-0.6, False, 0.9),
    (-0.6, True, 0.86),
    (0.0, True, 1.05),
    (0.6, True, 2.0),
    (0.3, True, 0.96),
):
    (pixel,) = above.pixels(np.array([[x, 0.0, 0.0]]))
    np.testing.assert_allclose(shown.under(above, pixel, on_skin).position, (x, 0, height), atol=0.01)
