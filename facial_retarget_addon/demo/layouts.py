"""Meshes laid over the chart: rings of quads, or scattered triangles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.spatial import Delaunay, cKDTree

from ..core.arrays import BoolArray, FloatArray, IntArray
from ..core.errors import RetargetError
from .chart import HIGH, LOW, MOUTH, OPENINGS, Lens, rounded
from .smooth import along, step

_MARGINS = (0.135, 0.135, 0.20)
"""How far the ring zone reaches around each opening."""


@dataclass(frozen=True, eq=False)
class Layout:
    """A mesh of the chart.

    Attributes
    ----------
    places : (V, 2) chart places of the vertices.
    polygons : (P, 3 or 4) corners, counter-clockwise.
    """

    places: FloatArray
    polygons: IntArray

    def pinned(self, places: FloatArray) -> tuple[Layout, IntArray]:
        """Return this mesh with a vertex on each of some places (N, 2), and those vertices (N,).

        The nearest vertex is moved there; on an opening's rim, the nearest one of the rim.

        Raises
        ------
        RetargetError : if two places want the same vertex, or a polygon folds over.
        """
        rim = _on_rim(self.places)
        wanted = _on_rim(places)
        vertices = np.empty(len(places), np.int64)
        for kind in (True, False):
            free = np.flatnonzero(rim == kind)
            vertices[wanted == kind] = free[cKDTree(self.places[free]).query(places[wanted == kind])[1]]
        moved = self.places.copy()
        moved[vertices] = places
        moved = self._relaxed(moved, vertices)
        if len(np.unique(vertices)) < len(vertices) or _areas(moved, self.polygons).min() <= 0:
            raise RetargetError(f"a face of {len(moved)} vertices is too coarse for {len(places)} feature points")
        return Layout(moved, self.polygons), vertices

    def _relaxed(self, places: FloatArray, pinned: IntArray) -> FloatArray:
        """Places after the neighbours of the pinned vertices have made room."""
        links = _links(self.polygons, len(places))
        near = np.zeros(len(places), bool)
        near[pinned] = True
        near = links @ (links @ (links @ near)) > 0
        near[pinned] = False
        near[_on_rim(places)] = False
        near[_border(self.polygons)] = False
        rows = np.flatnonzero(near)
        mean = sp.diags(1.0 / links.sum(axis=1).A1) @ links
        for _ in range(10):
            places[rows] = (mean @ places)[rows]
        return places


def _on_rim(places: FloatArray) -> BoolArray:
    """(N,) true for places on the rim of an opening."""
    rim: BoolArray = np.min([np.abs(lens.distance(places)) for lens in OPENINGS], axis=0) < 1e-6
    return rim


def _areas(places: FloatArray, polygons: IntArray) -> FloatArray:
    """Areas (P,) on the chart, negative where a polygon is turned over."""
    x, y = np.moveaxis(places[polygons], -1, 0)
    areas: FloatArray = 0.5 * (x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum(axis=1)
    return areas


def _links(polygons: IntArray, count: int) -> sp.csr_matrix:
    """(V, V) matrix of ones where an edge joins two vertices."""
    start, end = polygons.ravel(), np.roll(polygons, -1, axis=1).ravel()
    one_way = sp.coo_matrix((np.ones(len(start)), (start, end)), shape=(count, count))
    return ((one_way + one_way.T) > 0).astype(np.float64).tocsr()


def _border(polygons: IntArray) -> IntArray:
    """Vertices on edges of one polygon only."""
    edges = np.sort(np.stack([polygons, np.roll(polygons, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    border: IntArray = np.unique(unique[count == 1])
    return border


def ringed_layout(columns: int, rows: int, rings: int) -> Layout:
    """A grid of quads whose lines run in rings around the openings.

    Parameters
    ----------
    columns, rows : quads of the grid across and along the whole chart.
    rings : quads between an opening's rim and the grid.
    """
    x = _lines(columns, 0, (-1.15, 1.15))
    y = _lines(rows, 1, (-1.40, 0.95))
    places = [rounded(np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2))]
    index = np.arange((rows + 1) * (columns + 1)).reshape(rows + 1, columns + 1)
    keep = np.ones((rows, columns), bool)
    quads = []
    count = index.size
    for lens, margin in zip(OPENINGS, _MARGINS, strict=True):
        left, right = (_nearest(x, lens.x + s * (lens.half_width + margin)) for s in (-1.0, 1.0))
        bottom, top = _nearest(y, lens.y - lens.lower - margin), _nearest(y, lens.y + lens.upper + margin)
        keep[bottom:top, left:right] = False
        loop, upper = _block_loop(index, left, right, bottom, top, _nearest(y, lens.y))
        rim = _rim(lens, upper, len(loop) - upper)
        outer = places[0][loop]
        # Rings lie closer together near the rim, where the lid or lip rolls in.
        share = (np.arange(1, rings + 1) / rings)[:, None, None] ** 1.4
        inner = rim + (outer - rim) * np.concatenate([np.zeros((1, 1, 1)), share[:-1]])
        ring = np.concatenate([count + np.arange(rings * len(loop)).reshape(rings, -1), loop[None]])
        after = np.roll(ring, -1, axis=1)
        quads.append(np.stack([ring[:-1], ring[1:], after[1:], after[:-1]], axis=-1).reshape(-1, 4))
        places.append(inner.reshape(-1, 2))
        count += rings * len(loop)
    cells = np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], axis=-1)
    return _compact(np.concatenate(places), np.concatenate([cells[keep], *quads]))


def scattered_layout(spacing: float, rng: np.random.Generator) -> Layout:
    """Triangles over scattered vertices, without lines or rings.

    Parameters
    ----------
    spacing : distance between neighbours in chart units.
    rng : where the scatter comes from.
    """
    scatter, border = _scatter(spacing, rng)
    # Two more loops around each rim hold the lids' and lips' edges.
    loops, opening_of = [], []
    for opening, lens in enumerate(OPENINGS):
        around = round(2.4 * lens.half_width / spacing)
        for out in (0.0, 0.35 * spacing, 0.9 * spacing):
            loops.append(_rim(lens.grown(out), around, around))
            opening_of.append(np.full(2 * around, -1 if out else opening))
    clear = np.min([lens.distance(scatter) for lens in OPENINGS], axis=0) > 1.4 * spacing
    places = np.concatenate([*loops, scatter[clear]])
    rim_of = np.concatenate([*opening_of, np.full(clear.sum(), -1)])
    on_border = np.concatenate([np.zeros(len(places) - clear.sum(), bool), border[clear]])
    triangles = Delaunay(_mouth_opened(places)).simplices.astype(np.int64)
    area = np.linalg.det(places[triangles[:, 1:]] - places[triangles[:, :1]])
    triangles[area < 0] = triangles[area < 0][:, ::-1]
    # An opening is convex: a triangle whose corners all lie on its rim lies in it.
    first, second, third = rim_of[triangles].T
    in_opening = (first >= 0) & (first == second) & (first == third)
    sliver = on_border[triangles].all(axis=1) & (np.abs(area) < 0.02 * spacing**2)
    return _compact(places, triangles[~in_opening & ~sliver])


def _scatter(spacing: float, rng: np.random.Generator) -> tuple[FloatArray, BoolArray]:
    """Places (N, 2) in shaken rows all over the chart, and which of them (N,) make its border."""
    columns, rows = np.ceil((HIGH - LOW) / (spacing * np.array([1.0, np.sqrt(0.75)]))).astype(int)
    column, row = (index.ravel() for index in np.meshgrid(np.arange(columns + 1), np.arange(rows + 1)))
    grid = np.stack([(column + 0.5 * (row % 2)) / (columns + 0.5), row / rows], axis=1)
    grid[column == 0, 0], grid[column == columns, 0] = 0.0, 1.0
    border = (column == 0) | (column == columns) | (row == 0) | (row == rows)
    grid[~border] += rng.uniform(-0.22, 0.22, ((~border).sum(), 2)) / np.array([columns, rows])
    return rounded(LOW + grid * (HIGH - LOW)), border


def _mouth_opened(places: FloatArray) -> FloatArray:
    """Places with the lips moved apart, so that no triangle prefers the other lip to its own."""
    across = np.clip(1.0 - ((places[:, 0] - MOUTH.x) / MOUTH.half_width) ** 2, 0.0, 1.0) ** 0.75
    apart = 0.045 * across * MOUTH.side(places) * (1.0 - step(MOUTH.distance(places), 0.0, 0.40))
    opened: FloatArray = places + apart[:, None] * np.array([0.0, 1.0])
    return opened


def _lines(count: int, axis: int, dense: tuple[float, float]) -> FloatArray:
    """(count + 1,) grid lines across the chart, twice as close where the face acts."""
    fine = np.linspace(LOW[axis], HIGH[axis], 2001)
    density = 0.5 + 0.5 * along(fine, *dense, 0.25)
    share = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]))])
    lines: FloatArray = np.interp(np.linspace(0.0, share[-1], count + 1), share, fine)
    return lines


def _nearest(lines: FloatArray, value: float) -> int:
    return int(np.argmin(np.abs(lines - value)))


def _block_loop(index: IntArray, left: int, right: int, bottom: int, top: int, middle: int) -> tuple[IntArray, int]:
    """Vertices around a block of the grid, counter-clockwise from the middle of its left (+x) side.

    Also the number of steps from there over the top to the other side's middle.
    """
    loop = np.concatenate(
        [
            index[middle:top, right],
            index[top, right:left:-1],
            index[top:bottom:-1, left],
            index[bottom, left:right],
            index[bottom:middle, right],
        ]
    )
    return loop, 2 * (top - middle) + right - left


def _rim(lens: Lens, upper: int, lower: int) -> FloatArray:
    """Places around an opening: `upper` steps from the left (+x) corner over the upper arc, `lower` back."""
    over, back = (_spread(np.linspace(-1.0, 1.0, count + 1)[:-1]) for count in (upper, lower))
    return np.concatenate([lens.arc(-over, True), lens.arc(back, False)])


def _spread(t: FloatArray) -> FloatArray:
    """Places from -1 to 1, closer together at both ends."""
    spread: FloatArray = 0.5 * (t + np.sin(0.5 * np.pi * t))
    return spread


def _compact(places: FloatArray, polygons: IntArray) -> Layout:
    used, corners = np.unique(polygons, return_inverse=True)
    return Layout(places[used], corners.reshape(polygons.shape).astype(np.int64))
