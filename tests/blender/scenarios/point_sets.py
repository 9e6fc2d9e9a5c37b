"""Placed, proposed and skipped points of a face, and where they are as the object looks now."""

import bpy
import numpy as np
from mathutils import Matrix
from stage import empty_scene, grid, part, refused

empty_scene()
points, places, core = part("bridge.points.points"), part("bridge.points.point_places"), part("core.points")
thing = grid("face", 8)
face = thing.facial_retarget
bpy.context.view_layer.objects.active = thing

# A set; a point is placed, proposed or skipped, never two of these.
assert face.point_set == "FMC"
identifiers = [item.identifier for item in face.bl_rna.properties["point_set"].enum_items]
assert identifiers == list(part("core.point_sets").POINT_SETS), identifiers
points.place_point(thing, "3.7", (0, 1, 9), (0.25, 0.5, 0.25))
some = core.FeaturePoints(
    ("3.7", "8.3", "9.3"), np.array([[5, 5, 5], [6, 6, 6], [7, 7, 7]]), np.tile([1.0, 0, 0], (3, 1))
)
points.write_proposals(thing, some)
assert face.proposals.keys() == ["8.3", "9.3"], face.proposals.keys()
points.skip_point(thing, "9.3")
points.skip_point(thing, "9.3")
assert face.proposals.keys() == ["8.3"]
assert face.skipped.keys() == ["9.3"]
points.place_point(thing, "8.3", [6, 6, 6], [1.0, 0.0, 0.0])
points.place_point(thing, "9.3", [7, 7, 7], [1.0, 0.0, 0.0])
assert not len(face.proposals)
assert not len(face.skipped)
assert face.points.keys() == ["3.7", "8.3", "9.3"]
assert face.active_point == 2

# Placing again moves, and makes it the active one.
points.place_point(thing, "3.7", [3, 3, 3], [1.0, 0.0, 0.0])
assert face.points.keys() == ["3.7", "8.3", "9.3"]
assert face.active_point == 0
assert points.read_points(thing).holders.tolist() == [3, 6, 7]
with refused("no name"):
    points.place_point(thing, "", [3, 3, 3], [1.0, 0.0, 0.0])
with refused("'chin'", "remove"):
    points.remove_point(thing, "chin")
points.remove_point(thing, "3.7")
assert face.points.keys() == ["8.3", "9.3"]
assert face.active_point == 0


# Where they are in the world: keys, modifiers and the object's own place count.
def world(which: str = "points") -> np.ndarray:
    return places.world_places(thing, bpy.context.evaluated_depsgraph_get(), which)[1]


points.place_point(thing, "3.7", [0, 1, 9], [0.25, 0.5, 0.25])
points.write_proposals(thing, core.FeaturePoints(("2.1",), np.array([[10, 10, 10]]), np.array([[1.0, 0, 0]])))
rest = np.array([vertex.co for vertex in thing.data.vertices])
expected = np.array([rest[6], rest[7], 0.25 * rest[0] + 0.5 * rest[1] + 0.25 * rest[9]])
np.testing.assert_allclose(world(), expected, atol=1e-6)
thing.shape_key_add(name="Basis")
key = thing.shape_key_add(name="up", from_mix=False)
for point in key.points:
    point.co.z += 0.5
key.value = 1.0
thing.matrix_world = Matrix.Translation((1, 2, 3)) @ Matrix.Rotation(1, 4, "X") @ Matrix.Diagonal((-2, 3, 0.5, 1))
matrix = np.array(thing.matrix_world)
moved = (expected + [0, 0, 0.5]) @ matrix[:3, :3].T + matrix[:3, 3]
bpy.context.view_layer.update()
np.testing.assert_allclose(world(), moved, atol=1e-5)
np.testing.assert_allclose(world("proposals"), [(rest[10] + [0, 0, 0.5]) @ matrix[:3, :3].T + matrix[:3, 3]], atol=1e-5)

# A subdivision keeps the vertices' order; a decimation does not, and the closest place is taken.
subdivision = thing.modifiers.new("smooth", "SUBSURF")
subdivision.subdivision_type = "SIMPLE"
np.testing.assert_allclose(world(), moved, atol=1e-5)
thing.modifiers.remove(subdivision)
thing.modifiers.new("light", "DECIMATE").ratio = 0.6
key.value = 0.0
thing.matrix_world = Matrix()
assert np.linalg.norm(world() - expected, axis=1).max() < 0.1
bpy.ops.object.mode_set(mode="EDIT")
assert world().shape == (0, 3)
bpy.ops.object.mode_set(mode="OBJECT")
assert world().shape == (3, 3)
thing.facial_retarget.points.clear()
assert world().shape == (0, 3)
