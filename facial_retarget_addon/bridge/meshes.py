"""Mesh objects to arrays, and arrays to mesh objects.

Positions pass the border in *face space*: the object's own coordinates, stretched and mirrored as the
artist sees them where the object is scaled unevenly or mirrored. Rotation, location and even scale
stay out: no method depends on them.
"""

from __future__ import annotations

import bpy
import numpy as np
from bpy.types import Depsgraph, Mesh, Object

from ..core.arrays import FloatArray, IntArray
from ..core.errors import RetargetError
from ..core.mesh import TriMesh
from ..files.mesh_file import MeshFile
from .key_sets import shortened

LONGEST_NAME = 63 if bpy.app.version < (5, 0) else 255
"""Bytes that Blender keeps of a datablock's name."""
EVEN = 1e-4
"""Scales that differ by less, as a share, count as even."""


def stretch(thing: Object) -> FloatArray:
    """(3, 3) matrix S of an object: own coordinates p are S p in face space; its rotation is divided out.

    Raises
    ------
    RetargetError : if the object is scaled to nothing.
    """
    linear = np.array(thing.matrix_world, np.float64)[:3, :3]
    _, scales, axes = np.linalg.svd(linear)
    if scales[2] <= 1e-6 * scales[0]:
        raise RetargetError(f"object {thing.name!r} is scaled to nothing along an axis, expected a scale that is not 0")
    even = scales[0] - scales[2] <= EVEN * scales[0]
    matrix = np.eye(3) if even else axes.T @ (scales[:, None] * axes)
    return matrix * [[-1.0], [1.0], [1.0]] if np.linalg.det(linear) < 0 else matrix


def to_face_space(thing: Object, positions: FloatArray) -> FloatArray:
    """Own coordinates (..., 3) in face space, in their own precision."""
    return _transformed(positions, stretch(thing))


def from_face_space(thing: Object, positions: FloatArray) -> FloatArray:
    """Positions of face space (..., 3) in own coordinates, in their own precision."""
    return _transformed(positions, np.linalg.inv(stretch(thing)))


def _transformed(positions: FloatArray, matrix: FloatArray) -> FloatArray:
    return positions if np.array_equal(matrix, np.eye(3)) else (positions @ matrix.T).astype(positions.dtype)


def read_positions(mesh: Mesh) -> FloatArray:
    """(V, 3) float32 vertex positions of mesh data; its Basis, where it has shape keys."""
    flat = np.empty(3 * len(mesh.vertices), np.float32)
    if mesh.shape_keys is not None:
        mesh.shape_keys.reference_key.points.foreach_get("co", flat)
    elif len(flat):
        # The attribute is copied as a block; mesh.vertices is read one by one, 300 times slower.
        mesh.attributes["position"].data.foreach_get("vector", flat)
    return flat.reshape(-1, 3)


def read_polygons(mesh: Mesh) -> tuple[IntArray, IntArray]:
    """Corners of each polygon (P,), and their vertices (sum,)."""
    counts = np.empty(len(mesh.polygons), np.int32)
    mesh.polygons.foreach_get("loop_total", counts)
    corners = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    return counts.astype(np.int64), corners.astype(np.int64)


def read_face(thing: Object, positions: FloatArray | None = None) -> MeshFile:
    """A face's neutral in face space, with the artist's polygons and UVs.

    Parameters
    ----------
    positions : (V, 3) the neutral in face space; None for the Basis.

    Raises
    ------
    RetargetError : if it is no surface, or a vertex is NaN or infinite.
    """
    if positions is None:
        positions = to_face_space(thing, read_positions(thing.data).astype(np.float64))
    return read_surface(thing, positions, bool(np.linalg.det(stretch(thing)) < 0))


def read_surface(thing: Object, positions: FloatArray, mirrored: bool) -> MeshFile:
    """An object's polygons and UVs on positions (V, 3); where these are mirrored, the polygons are turned around.

    Raises
    ------
    RetargetError : if it is no surface, or a position is NaN or infinite.
    """
    counts, corners = read_polygons(thing.data)
    what = f"object {thing.name!r}"
    if not len(counts):
        raise RetargetError(f"{what} has {len(positions)} vertices and no faces, expected a surface")
    if not np.isfinite(positions).all():
        TriMesh(positions, np.zeros((1, 3), np.int64)).checked(what)
    uvs = _read_uvs(thing.data)
    if mirrored:
        turned = _turned_corners(counts)
        corners, uvs = corners[turned], None if uvs is None else uvs[turned]
    return MeshFile(TriMesh.from_polygons(positions, counts, corners).checked(what), counts, corners, uvs)


def neutral_mesh(thing: Object, positions: FloatArray | None = None) -> TriMesh:
    """A face's neutral in face space, as triangles; see `read_face`."""
    return read_face(thing, positions).mesh


def _read_uvs(mesh: Mesh) -> FloatArray | None:
    """(C, 2) coordinates of the corners in the active UV map, or None without one."""
    if mesh.uv_layers.active is None:
        return None
    flat = np.empty(2 * len(mesh.loops), np.float32)
    mesh.uv_layers.active.uv.foreach_get("vector", flat)
    return flat.reshape(-1, 2)


def _turned_corners(counts: IntArray) -> IntArray:
    """Order of the corners that turns each polygon around, for mirrored faces."""
    end = np.cumsum(counts)
    first, last = np.repeat(end - counts, counts), np.repeat(end - 1, counts)
    return last - (np.arange(end[-1]) - first)


def evaluated_positions(thing: Object, depsgraph: Depsgraph) -> FloatArray:
    """(V, 3) float32 positions of an object as it looks now, in face space.

    Raises
    ------
    RetargetError : if a modifier has changed the number of vertices.
    """
    mesh = thing.evaluated_get(depsgraph).data
    wanted = len(thing.data.vertices)
    if len(mesh.vertices) != wanted:
        shown = ", ".join(repr(modifier.name) for modifier in thing.modifiers if modifier.show_viewport)
        raise RetargetError(
            f"object {thing.name!r} has {len(mesh.vertices)} vertices after its modifiers ({shown}), expected the "
            f"{wanted} of its mesh; turn off the modifier that adds or removes vertices"
        )
    flat = np.empty(3 * wanted, np.float32)
    mesh.attributes["position"].data.foreach_get("vector", flat)
    return to_face_space(thing, flat.reshape(-1, 3))


def name_beside(thing: Object, ending: str) -> str:
    """Name of an object that is made for another one and found again by it: no longer than Blender keeps."""
    return shortened(thing.name, LONGEST_NAME - len(ending)) + ending


def new_object(name: str, vertices: FloatArray, counts: IntArray, corners: IntArray) -> Object:
    """A new mesh object in the scene, in its own coordinates: vertices (V, 3), polygons as in `read_polygons`.

    Raises
    ------
    RetargetError : if Blender cannot hold the polygons; nothing is left behind then.
    """
    mesh = bpy.data.meshes.new(name)
    replace_geometry(mesh, vertices, counts, corners)
    if mesh.validate():
        bpy.data.meshes.remove(mesh)
        raise RetargetError(f"mesh {name!r} has faces that Blender cannot hold: doubled, or with a corner twice")
    made = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(made)
    return made


def new_face(name: str, face: MeshFile) -> Object:
    """A new mesh object in the scene with a face's polygons and UVs; see `new_object`."""
    made = new_object(name, face.mesh.vertices, face.counts, face.corners)
    if face.uvs is not None:
        layer = made.data.uv_layers.new(name="UVMap")
        layer.uv.foreach_set("vector", np.ascontiguousarray(face.uvs, np.float32).ravel())
    made.data.shade_smooth()
    return made


def replace_geometry(mesh: Mesh, vertices: FloatArray, counts: IntArray, corners: IntArray) -> None:
    """Fill mesh data: vertices (V, 3), polygons as in `read_polygons`."""
    mesh.clear_geometry()
    mesh.vertices.add(len(vertices))
    mesh.loops.add(len(corners))
    mesh.polygons.add(len(counts))
    mesh.attributes["position"].data.foreach_set("vector", np.ascontiguousarray(vertices, np.float32).ravel())
    mesh.loops.foreach_set("vertex_index", np.ascontiguousarray(corners, np.int32))
    mesh.polygons.foreach_set("loop_start", np.ascontiguousarray(np.cumsum(counts) - counts, np.int32))
    mesh.update(calc_edges=True)
