"""Curves on a face along the base mesh's boundary loops: lips, lids, the border of the face."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline

from .arrays import FloatArray, IntArray, unit_vectors
from .closest_point import Nearest, SurfaceFinder
from .mesh import TriMesh

_SAMPLES = 64
_SHARP = np.radians(75)
"""A loop that turns by more than this at a point has a corner there (corners of mouth and eyes)."""
_ON_BORDER = 0.25
"""A loop lies on a boundary of the mesh if its points are nearer to it than this share of their spacing."""
_AGREEMENT = 0.2


def boundary_places(
    mesh: TriMesh, finder: SurfaceFinder, points: FloatArray, normals: FloatArray, parameters: FloatArray
) -> Nearest:
    """Places on a face along a closed loop of feature points.

    Where the mesh has a boundary loop through the points, the places lie on it; else on a spline through
    the points, moved to the closest place of the surface whose normal agrees with the points' normals, so that
    closed lips stay apart. Equal parameters on two faces are the same place of lip or lid.

    Parameters
    ----------
    points : (n, 3) the loop's points in order, on the surface.
    normals : (n, 3) unit surface normals there.
    parameters : (m,) in [0, n): k is point k, the fraction is a share of the arc length to the next point.
    """
    border = _mesh_border(mesh, points)
    curve = _spline(points) if border is None else border
    at = _along(curve, parameters)
    if border is not None:
        return finder.closest(at)
    share = np.mod(parameters, 1.0)[:, None]
    first = np.floor(parameters).astype(np.int64) % len(points)
    facing = unit_vectors((1 - share) * normals[first] + share * normals[(first + 1) % len(points)])
    places = finder.closest(at, facing, _AGREEMENT)
    lost = places.face < 0
    if not lost.any():
        return places
    plain = finder.closest(at[lost])
    for mine, other in zip(places, plain, strict=True):
        mine[lost] = other
    return places


def _along(pieces: list[FloatArray], parameters: FloatArray) -> FloatArray:
    """Points (m, 3) at parameters, by arc length within each piece (polyline (s, 3) from point k to k + 1)."""
    at = np.empty((len(parameters), 3))
    first = np.floor(parameters).astype(np.int64) % len(pieces)
    for k, piece in enumerate(pieces):
        mine = first == k
        length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(piece, axis=0), axis=1))])
        wanted = np.mod(parameters[mine], 1.0) * length[-1]
        at[mine] = np.stack([np.interp(wanted, length, piece[:, c]) for c in range(3)], axis=1)
    return at


def _spline(points: FloatArray) -> list[FloatArray]:
    """Cubic pieces through a closed loop of points, centripetal, broken at sharp corners."""
    count = len(points)
    leaving = unit_vectors(np.roll(points, -1, axis=0) - points)
    turn = np.arccos(np.clip(np.einsum("ij,ij->i", np.roll(leaving, 1, axis=0), leaving), -1, 1))
    sharp = np.flatnonzero(turn > _SHARP)
    pieces: list[FloatArray] = [np.empty((0, 3))] * count
    if not len(sharp):
        _fill_pieces(points, np.arange(count + 1) % count, "periodic", pieces)
    for k, start in enumerate(sharp):
        stop = sharp[k + 1] if k + 1 < len(sharp) else sharp[0] + count
        _fill_pieces(points, np.arange(start, stop + 1) % count, "natural", pieces)
    return pieces


def _fill_pieces(points: FloatArray, arc: IntArray, ends: str, pieces: list[FloatArray]) -> None:
    through = points[arc]
    knots = np.concatenate([[0.0], np.cumsum(np.sqrt(np.linalg.norm(np.diff(through, axis=0), axis=1)) + 1e-300)])
    spline = CubicSpline(knots, through, bc_type=ends)
    for k in range(len(arc) - 1):
        pieces[arc[k]] = spline(np.linspace(knots[k], knots[k + 1], _SAMPLES))


def _mesh_border(mesh: TriMesh, points: FloatArray) -> list[FloatArray] | None:
    """The pieces of the mesh's boundary loop between points, if one passes all of them in their order."""
    spacing = float(np.linalg.norm(points - np.roll(points, -1, axis=0), axis=1).mean())
    for ring in mesh.boundary_loops:
        corners = mesh.vertices[ring]
        place, gap = _project(corners, points)
        if gap.max() > _ON_BORDER * spacing:
            continue
        ahead = np.mod(np.roll(place, -1) - place, len(ring))
        if not np.isclose(ahead.sum(), len(ring)) or (ahead <= 0).any():
            continue
        return [_stretch(corners, start, start + step) for start, step in zip(place, ahead, strict=True)]
    return None


def _project(corners: FloatArray, points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Where on a closed polyline (corner index plus fraction) points come nearest, and how near."""
    step = np.roll(corners, -1, axis=0) - corners
    offset = points[:, None] - corners
    squared = np.maximum(np.einsum("ij,ij->i", step, step), 1e-300)
    share = np.clip(np.einsum("nij,ij->ni", offset, step) / squared, 0, 1)
    gap = np.linalg.norm(offset - share[..., None] * step, axis=2)
    best = gap.argmin(axis=1)
    row = np.arange(len(points))
    return best + share[row, best], gap[row, best]


def _stretch(corners: FloatArray, start: float, stop: float) -> FloatArray:
    """The polyline from one place of a closed polyline forward to another."""
    inner = np.arange(np.floor(start) + 1, np.ceil(stop))
    where = np.concatenate([[start], inner, [stop]])
    first = np.floor(where).astype(np.int64)
    share = (where - first)[:, None]
    count = len(corners)
    piece: FloatArray = (1 - share) * corners[first % count] + share * corners[(first + 1) % count]
    return piece
