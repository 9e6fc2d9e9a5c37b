"""Feature points on disk: JSON, a name and a place on the surface for each."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ..core.arrays import FloatArray, IntArray
from ..core.closest_point import SurfaceFinder
from ..core.errors import RetargetError
from ..core.mesh import TriMesh
from ..core.points import FeaturePoints
from .documents import Table, fault_sentence, json_bytes, read_json
from .whole import write_whole

FORMAT = "facial-retarget/feature-points"
VERSION = 1
FARTHEST = 0.1
"""A position may lie this far from the surface, as a share of the mesh's size; farther away it is a mistake."""
WEIGHT_TOLERANCE = 1e-4
"""Weights may miss a sum of 1 by this much (they were rounded); they are then divided by their sum."""


def read_points(path: Path, mesh: TriMesh) -> FeaturePoints:
    """Read the feature points of a mesh.

    Each one is a `vertex`, or three `vertices` with `weights`, or a `position` in the mesh's units, which
    is snapped to the surface.

    Raises
    ------
    RetargetError : if the file cannot be read or is no such document, if a name appears twice, or if a place
        is not one of the three kinds, has vertices that the mesh does not have, numbers that are not finite,
        weights that are negative or do not add up to 1, or a position far away, or if the file names another number of
        vertices than the mesh has; names all faults.
    """
    wrong: list[str] = []
    root = Table(read_json(path), "", wrong)
    root.expect("format", FORMAT)
    root.expect("version", VERSION)
    points = root.get("points", dict)
    count = root.optional("mesh_vertices", int)
    if count not in (None, len(mesh.vertices)):
        wrong.append(f"its points lie on a mesh of {count} vertices, and the one that arrived has {len(mesh.vertices)}")
    root.no_more()
    names = [str(name) for name in points]
    vertices = np.zeros((len(names), 3), np.int64)
    weights = np.tile([1.0, 0.0, 0.0], (len(names), 1))
    positions = np.full((len(names), 3), np.nan)
    for row, name in enumerate(names):
        if not name.strip() or not name.isprintable():
            wrong.append(f"a point is named {name!r}, expected a readable name")
        place = Table(points[name], f"point {name!r}", wrong)
        faults = len(wrong)
        match _kind(points[name]):
            case "vertex":
                vertices[row] = _vertex_list(place, [place.get("vertex", int)], len(mesh.vertices))
            case "vertices":
                vertices[row] = _vertex_list(place, place.get("vertices", list), len(mesh.vertices))
                weights[row] = _weights(place)
            case "position":
                positions[row] = _numbers(place, "position")
            case _:
                place.wrong.append(f"{place.where} has no place, expected vertex, vertices and weights, or position")
        if len(wrong) == faults:
            place.no_more()
    if not wrong:
        _snap(mesh, names, positions, vertices, weights, wrong)
    if wrong:
        raise RetargetError(fault_sentence(path, wrong))
    return FeaturePoints(tuple(names), vertices, weights)


def write_points(points: FeaturePoints, path: Path, mesh_vertices: int | None = None) -> None:
    """Write feature points, whole or not at all; RetargetError if the system refuses.

    Parameters
    ----------
    mesh_vertices : vertices of the mesh, so that no other mesh takes them; None to leave that open.
    """
    places = {
        name: _place(vertices, weights)
        for name, vertices, weights in zip(points.names, points.vertices.tolist(), points.weights.tolist(), strict=True)
    }
    count = {} if mesh_vertices is None else {"mesh_vertices": mesh_vertices}
    write_whole(path, json_bytes({"format": FORMAT, "version": VERSION, **count, "points": places}))


def _place(vertices: list[int], weights: list[float]) -> dict[str, Any]:
    return {"vertex": vertices[weights.index(1.0)]} if 1.0 in weights else {"vertices": vertices, "weights": weights}


def _kind(place: object) -> str:
    kinds = [kind for kind in ("vertex", "vertices", "position") if isinstance(place, dict) and kind in place]
    return kinds[0] if kinds else ""


def _vertex_list(place: Table, vertices: list[Any], count: int) -> list[int]:
    if len(vertices) not in (1, 3) or any(type(v) is not int or not 0 <= v < count for v in vertices):
        place.wrong.append(f"{place.where} is at {vertices!r:.60}, expected vertices from 0 to {count - 1}")
        return [0, 0, 0]
    return vertices * 3 if len(vertices) == 1 else vertices


def _numbers(place: Table, key: str) -> FloatArray:
    numbers = place.get(key, list)
    if len(numbers) != 3 or any(type(x) not in (int, float) or not abs(x) < 1e30 for x in numbers):
        place.wrong.append(f"{place.where} has {key} {numbers!r:.60}, expected three finite numbers")
        return np.zeros(3)
    return np.array(numbers, np.float64)


def _weights(place: Table) -> FloatArray:
    faults = len(place.wrong)
    weights = _numbers(place, "weights")
    total = float(weights.sum())
    if len(place.wrong) > faults:
        return weights
    if weights.min() < 0 or abs(total - 1) > WEIGHT_TOLERANCE:
        place.wrong.append(
            f"{place.where} has weights {weights.tolist()} with the sum {total:g}, expected none below 0 and a sum of 1"
        )
        return weights
    return weights / total


def _snap(
    mesh: TriMesh,
    names: list[str],
    positions: FloatArray,
    vertices: IntArray,
    weights: FloatArray,
    wrong: list[str],
) -> None:
    """Put the points that were given as positions on the surface."""
    rows = np.flatnonzero(np.isfinite(positions[:, 0]))
    if not len(rows):
        return
    nearest = SurfaceFinder(mesh).closest(positions[rows])
    vertices[rows], weights[rows] = mesh.faces[nearest.face], nearest.weights
    wrong += [
        f"point {names[row]!r} lies {distance:.3g} away from the surface, expected at most {FARTHEST * mesh.size:.3g}"
        for row, distance in zip(rows, nearest.distance, strict=True)
        if distance > FARTHEST * mesh.size
    ]
