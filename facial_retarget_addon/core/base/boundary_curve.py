"""Curves on a face along the base mesh's boundary loops: lips, lids, the border of the face."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline

from ..arrays import FloatArray, IntArray, unit_vectors
from ..closest_point import Nearest, SurfaceFinder, closest_agreeing, some_places
from ..levels.piercing import AGREEMENT
from ..mesh import TriMesh
from ..surface_path import SurfacePaths, line_length, resample

_SAMPLES = 48
_SHARP = np.radians(75)
"""A loop that turns by more than this at a point has a corner there (corners of mouth and eyes)."""
_ON_BORDER = 0.25
"""A point lies on a boundary of the mesh if it is nearer to it than this share of the points' spacing."""
_EXACTLY = 0.01
_MOST = 0.75
"""Two neighbours on a boundary of the mesh are joined along it if that is less than this share of its way round."""
_JUMP = 4.0
"""A projected curve whose step is this many times longer than the mean step has left its side of the lip."""
_DETOUR = 2.0
"""A path along the surface does not replace a curve that is this many times shorter: a point lies in a pocket."""


class BoundaryCurves:
    """Places on one face along closed loops of feature points.

    Where two neighbours lie on a boundary of the mesh, the places between lie on it. Elsewhere they lie on a spline
    through the points, moved to the closest place of the surface whose normal agrees with the points' normals, so
    that closed lips stay apart; and where that would jump from one lip to the other, on the shortest path along the
    surface. Equal parameters on two faces are the same place of lip or lid.
    """

    def __init__(self, mesh: TriMesh, finder: SurfaceFinder) -> None:
        self._mesh, self._finder = mesh, finder
        self._paths = SurfacePaths(mesh)

    def places(self, points: FloatArray, normals: FloatArray, parameters: FloatArray) -> Nearest:
        """Places at parameters of one loop.

        Parameters
        ----------
        points : (n, 3) the loop's points in order, on the surface.
        normals : (n, 3) unit surface normals there.
        parameters : (m,) in [0, n): k is point k, the fraction is a share of the arc length to the next point.
        """
        count = len(points)
        borders = self._mesh_borders(points)
        splines = _spline(points)
        found = Nearest(
            np.zeros(len(parameters)),
            np.zeros(len(parameters), np.int64),
            np.zeros((len(parameters), 3)),
            np.zeros((len(parameters), 3)),
        )
        first = np.floor(parameters).astype(np.int64) % count
        for k, (border, spline) in enumerate(zip(borders, splines, strict=True)):
            mine = np.flatnonzero(first == k)
            share = np.mod(parameters[mine], 1.0)
            if border is not None:
                near = self._finder.closest(resample(border, share))
            else:
                near = self._on_surface(spline, normals[k], normals[(k + 1) % count], share)
            for whole, part in zip(found, near, strict=True):
                whole[mine] = part
        return found

    def _mesh_borders(self, points: FloatArray) -> list[FloatArray | None]:
        """For each point the mesh's boundary from there to the next point, None where they do not lie on one."""
        spacing = float(np.linalg.norm(points - np.roll(points, -1, axis=0), axis=1).mean())
        pieces: list[FloatArray | None] = [None] * len(points)
        for ring in self._mesh.boundary_loops:
            place, gap = _project(self._mesh.vertices[ring], points)
            # A loop that as a whole runs beside the boundary follows it; else only pieces whose ends lie on it do.
            share = _ON_BORDER if (gap < _ON_BORDER * spacing).all() else _EXACTLY
            near = gap < share * spacing
            ahead = np.mod(np.roll(place, -1) - place, len(ring))
            for k in np.flatnonzero(near & np.roll(near, -1) & (ahead > 0) & (ahead < _MOST * len(ring))):
                pieces[k] = _stretch(self._mesh.vertices[ring], place[k], place[k] + ahead[k])
        return pieces

    def _on_surface(self, piece: FloatArray, start: FloatArray, stop: FloatArray, share: FloatArray) -> Nearest:
        """Places at shares of one piece between two points with normals `start` and `stop`."""
        every = np.concatenate([np.linspace(0, 1, _SAMPLES), share])
        facing = unit_vectors((1 - every[:, None]) * start + every[:, None] * stop)
        near = closest_agreeing(self._finder, resample(piece, every), facing, AGREEMENT)
        length = line_length(piece)
        step = np.linalg.norm(np.diff(near.point[:_SAMPLES], axis=0), axis=1)
        if step.max() > _JUMP * length / (_SAMPLES - 1):
            ends = self._finder.closest(piece[[0, -1]])
            line, strip = self._paths.path(some_places(ends, [0]), some_places(ends, [1]))
            if line_length(line) < _DETOUR * length:
                return strip.closest(resample(line, share))
        return some_places(near, np.arange(_SAMPLES, len(every)))


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
