"""The base mesh: a coarse triangulation of the feature points, the same on both faces.

Points of a standard set get its fixed triangulation, and points between them are inserted into it. The
artist's own triangles are checked and used as they are.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import RetargetError
from ..mesh import TriMesh
from ..points import FeaturePoints, common_names
from ..raycast import CasterFactory, EmbreeCaster
from .insertion import insert_points
from .placed_points import PlacedPoints
from .regions import dual_triangulation
from .triangulations import STANDARD

OUTER = "outer"
_OPENINGS = (
    ("mouth", {"2.2", "2.3", "2.4", "2.5", "2.6", "2.7", "2.8", "2.9"}),
    ("left eye", {"3.1", "3.3", "3.7", "3.11"}),
    ("right eye", {"3.2", "3.4", "3.8", "3.12"}),
)
"""Points of which an opening's loop holds some."""


@dataclass(frozen=True, eq=False)
class BaseLoop:
    """A boundary loop of the base mesh.

    vertices : (n,) rows of the base's points, in the direction of the faces' edges.
    surrounds : "outer" for the border of the face, else "mouth", "left eye", "right eye" or "opening".
    """

    vertices: IntArray
    surrounds: str


@dataclass(frozen=True, eq=False)
class BaseMesh:
    """A manifold triangulation of feature points.

    Attributes
    ----------
    names : (B,) the points used, in the order of the rows.
    faces : (F, 3) rows, counter-clockwise seen from outside.
    loops : boundary loops, the outer one first.
    left_out : common points that are in no triangle: they guide the correspondence only.
    warnings : what an artist should look at: points of an own set left out, triangles that fold over.
    """

    names: tuple[str, ...]
    faces: IntArray
    loops: tuple[BaseLoop, ...]
    left_out: tuple[str, ...]
    warnings: tuple[str, ...]


MINIMUM_POINTS = 24
"""Fewer points give no base mesh that follows a face."""


def base_mesh(
    source_mesh: TriMesh,
    source_points: FeaturePoints,
    target_mesh: TriMesh,
    target_points: FeaturePoints,
    triangles: Sequence[tuple[str, str, str]] | None = None,
    make_caster: CasterFactory = EmbreeCaster,
) -> BaseMesh:
    """Base mesh of the points that both faces have.

    Parameters
    ----------
    triangles : the artist's own base over point names; None to have one made.
    make_caster : makes what casts rays on a mesh; Embree unless another one is given.

    Returns
    -------
    One connectivity for both faces. Where it folds over on one of them, the warnings name the points.

    Raises
    ------
    RetargetError : if no manifold base can be made; it names the points to move.
    """
    names = common_names(source_points, target_points)
    faces_of = [
        PlacedPoints.on(source_mesh, source_points.subset(names)),
        PlacedPoints.on(target_mesh, target_points.subset(names)),
    ]
    warnings: list[str] = []
    if triangles is None and len(names) < MINIMUM_POINTS:
        raise RetargetError(
            f"source and target have {len(names)} feature points in common, "
            f"expected at least {MINIMUM_POINTS} for a base mesh"
        )
    if triangles is not None:
        rows = _rows(triangles, names)
        if np.median(faces_of[0].agreement(rows)) < 0:
            rows = rows[:, ::-1]
    else:
        standard = next((t for t in STANDARD if {n for corner in t for n in corner} <= set(names)), None)
        if standard is None:
            rows = dual_triangulation(source_mesh, source_points.subset(names), make_caster)
            lost = [names[k] for k in np.setdiff1d(np.arange(len(names)), rows)]
            if lost:
                warnings.append(f"feature points {', '.join(lost)} lie outside the base and are not part of it")
        else:
            rows = _rows(standard, names)
            extra = np.setdiff1d(np.arange(len(names)), rows)
            rows = insert_points(rows, extra, faces_of)
    _check_manifold(rows, names)
    used = np.unique(rows)
    compact = np.searchsorted(used, rows)
    kept = tuple(names[k] for k in used)
    left_out = tuple(names[k] for k in np.setdiff1d(np.arange(len(names)), used))
    for face, which in zip(faces_of, ("source", "target"), strict=True):
        warnings += _folds(face, rows, names, which)
    loops = _loops(faces_of[0].positions[used], compact, kept)
    return BaseMesh(kept, compact, loops, left_out, tuple(warnings))


def _rows(triangles: Sequence[tuple[str, str, str]], names: Sequence[str]) -> IntArray:
    row = {name: k for k, name in enumerate(names)}
    missing = sorted({name for corners in triangles for name in corners} - set(row))
    if missing:
        raise RetargetError(
            f"the base mesh uses points {', '.join(map(repr, missing))}, which are not feature points of both faces"
        )
    if not len(triangles):
        raise RetargetError("the base mesh has no triangles, expected at least one")
    return np.array([[row[name] for name in corners] for corners in triangles], np.int64)


def _check_manifold(faces: IntArray, names: Sequence[str]) -> None:
    mesh = TriMesh(np.zeros((len(names), 3)), faces)
    crowded = np.flatnonzero(mesh.edge_face_count > 2)
    if len(crowded):
        a, b = mesh.edges[crowded[0]]
        raise RetargetError(
            f"the base mesh has {mesh.edge_face_count[crowded[0]]} triangles at the edge {names[a]} - {names[b]}, "
            "expected at most 2: move one of these points"
        )
    key = mesh.half_edges @ np.array([len(names), 1])
    value, count = np.unique(key, return_counts=True)
    if (count > 1).any():
        a, b = divmod(int(value[np.argmax(count > 1)]), len(names))
        raise RetargetError(
            f"the triangles on both sides of the edge {names[a]} - {names[b]} of the base mesh face different ways, "
            "expected all of them counter-clockwise seen from outside"
        )
    starts = np.bincount(mesh.boundary_edges[:, 0], minlength=len(names))
    if (starts > 1).any():
        name = names[int(np.argmax(starts > 1))]
        raise RetargetError(f"the base mesh hangs together by the point {name} alone: move it or add points beside it")


def _folds(face: PlacedPoints, rows: IntArray, names: Sequence[str], which: str) -> list[str]:
    folded = rows[face.agreement(rows) < 0]
    if not len(folded):
        return []
    listed = "; ".join(" ".join(names[k] for k in corners) for corners in folded[:8])
    return [f"the base mesh folds over on the {which} in {len(folded)} triangles: move points of {listed}"]


def _loops(positions: FloatArray, faces: IntArray, names: Sequence[str]) -> tuple[BaseLoop, ...]:
    found = TriMesh(positions, faces).boundary_loops
    loops = []
    for k, ring in enumerate(found):
        members = {names[i] for i in ring}
        kind = next((kind for kind, typical in _OPENINGS if typical & members), "opening")
        loops.append(BaseLoop(ring, OUTER if k == 0 else kind))
    return tuple(loops)
