"""Figures of each vertex of a face as it looks now, for the heat map."""

from __future__ import annotations

from typing import Any

import numpy as np
from bpy.types import Depsgraph, Mesh, Object, PropertyGroup

from ...core.arrays import FloatArray, IntArray
from ...core.errors import RetargetError
from ...core.vertex_figures import Compared, vertex_stretch
from ..heads import head_now, head_parts, read_head
from ..meshes import neutral_mesh, to_face_space
from ..points.base_lines import shape_stamp
from ..points.point_places import shown_vertices
from .findings import unpacked


class HeatFigures:
    """The figures of one face, by the states of the meshes that they are made from: these are read only once.

    Raises
    ------
    RetargetError : where a kind cannot be shown; says why.
    """

    def __init__(self) -> None:
        self._known: dict[str, tuple[Any, Any]] = {}

    def values(self, task: PropertyGroup, thing: Object, kind: str, depsgraph: Depsgraph) -> FloatArray:
        """(V,) figures of an object's vertices; NaN where there is none.

        Parameters
        ----------
        kind : "STRETCH", "BEYOND" or "MOTION", see `core.vertex_figures`; the latter two compare with the source.
        """
        if kind == "STRETCH":
            mesh = self._kept("neutral", shape_stamp(thing), lambda: neutral_mesh(thing))
            return vertex_stretch(mesh, shown_in_face_space(thing, depsgraph))
        source = _source(task, thing)
        heads = [(face, *head_parts(face)) for face in (source, thing)]
        state = (*(shape_stamp(one) for head in heads for one in head), hash(thing.facial_retarget.counterpart))
        compared = self._kept("compared", state, lambda: _compared(source, thing))
        now = [head_now(head, depsgraph) for head in heads]
        figures = compared.stretch_beyond if kind == "BEYOND" else compared.motion_difference
        return figures(*now)[: len(thing.data.vertices)]

    def triangles(self, thing: Object) -> IntArray:
        """(T, 3) int32 an object's own triangles."""
        return self._kept("triangles", shape_stamp(thing), lambda: _triangles(thing.data))

    def _kept(self, what: str, state: Any, make: Any) -> Any:
        if what not in self._known or self._known[what][0] != state:
            self._known[what] = (state, make())
        return self._known[what][1]


def shown_in_face_space(thing: Object, depsgraph: Depsgraph) -> FloatArray:
    """(V, 3) positions of an object's own vertices as they look now, in face space.

    Raises
    ------
    RetargetError : if a modifier has renumbered the vertices.
    """
    world = shown_vertices(thing, depsgraph)
    if world is None:
        raise RetargetError(
            f"object {thing.name!r} has a modifier that renumbers its vertices; turn it off in the viewport"
        )
    matrix = np.array(thing.matrix_world, np.float64)
    return to_face_space(thing, (world - matrix[:3, 3]) @ np.linalg.inv(matrix[:3, :3]).T)


def _triangles(mesh: Mesh) -> IntArray:
    mesh.calc_loop_triangles()
    flat = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", flat)
    return flat.reshape(-1, 3)


def _source(task: PropertyGroup, thing: Object) -> Object:
    face = thing.facial_retarget
    if not face.counterpart or face.findings_source is None:
        raise RetargetError(f"object {thing.name!r} is to be compared with its source: retarget first")
    if task.source_neutral == "FRAME" and task.source == face.findings_source:
        raise RetargetError("the source's neutral is a frame: the map compares with its Basis alone")
    return face.findings_source


def _compared(source: Object, thing: Object) -> Compared:
    ours, theirs = read_head(source).face.mesh, read_head(thing).face.mesh
    counterpart = unpacked(thing.facial_retarget.counterpart)
    if len(counterpart) != len(theirs.vertices) or counterpart.max(initial=-1) >= len(ours.vertices):
        raise RetargetError("source or target have other vertices than when they were retargeted: retarget again")
    return Compared(ours, theirs, counterpart)
