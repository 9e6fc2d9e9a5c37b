"""The base mesh as a wire object, whose vertices know their feature points."""

from __future__ import annotations

import bpy
import numpy as np
from bpy.types import Object

from ...core.arrays import IntArray
from ...core.errors import RetargetError
from ..meshes import name_beside, new_object, read_polygons, replace_geometry
from ..scene.local_views import show_with
from .points import point_positions, read_points

Triangles = tuple[tuple[str, str, str], ...]

ATTRIBUTE = "feature_point"
"""A text for each vertex: its point's name. It survives editing in Edit Mode."""


def show_base(thing: Object, names: tuple[str, ...], faces: IntArray) -> Object:
    """Show a base mesh (F, 3 rows of `names`) on a face; an earlier one of this face is replaced."""
    rows = read_points(thing).index(names)
    vertices = point_positions(thing)[rows]
    counts = np.full(len(faces), 3, np.int64)
    label = name_beside(thing, " base")
    made = bpy.data.objects.get(label)
    if made is None or made.type != "MESH":
        made = new_object(label, vertices, counts, faces.ravel())
    else:
        replace_geometry(made.data, vertices, counts, faces.ravel())
    made.matrix_world = thing.matrix_world
    made.display_type = "WIRE"
    made.show_in_front = True
    show_with(made, thing)
    written = made.data.attributes.get(ATTRIBUTE) or made.data.attributes.new(ATTRIBUTE, "STRING", "POINT")
    for entry, name in zip(written.data, names, strict=True):
        entry.value = name.encode()
    return made


def show_triangles(thing: Object, triangles: Triangles) -> Object:
    """Show an artist's own base, triangles over point names, on a face; see `show_base`."""
    names = tuple(dict.fromkeys(name for corners in triangles for name in corners))
    row = {name: i for i, name in enumerate(names)}
    return show_base(thing, names, np.array([[row[name] for name in corners] for corners in triangles], np.int64))


def read_base(thing: Object) -> Triangles:
    """The triangles of a base object over point names.

    Raises
    ------
    RetargetError : if its vertices do not know their points, or a polygon is no triangle.
    """
    attribute = thing.data.attributes.get(ATTRIBUTE)
    if attribute is None or attribute.data_type != "STRING" or attribute.domain != "POINT":
        raise RetargetError(
            f"object {thing.name!r} has no text attribute {ATTRIBUTE!r} on its vertices, "
            "expected an object that Show Base Mesh has made"
        )
    counts, corners = read_polygons(thing.data)
    if (counts != 3).any():
        raise RetargetError(f"base object {thing.name!r} has polygons of {counts.max()} corners, expected triangles")
    names = [entry.value.decode() for entry in attribute.data]
    if nameless := [i for i in set(corners.tolist()) if not names[i]]:
        raise RetargetError(f"vertex {nameless[0]} of base object {thing.name!r} has no feature point, expected a name")
    return tuple((names[a], names[b], names[c]) for a, b, c in corners.reshape(-1, 3).tolist())
