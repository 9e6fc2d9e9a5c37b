"""Finds the front of a head: how the average face stands in it, from its relief alone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..arrays import FloatArray, cross, unit_vectors
from ..mesh import TriMesh
from ..raycast import RayCaster
from ..rigid import Similarity
from .symmetry import Mirror
from .template import Template

TURNS = 24
"""Ways up that are tried around the axis from left to right, for either side as the left one."""
COLUMNS, ROWS = 25, 128
"""Of a relief: straight lines from the front, over one half of the face and its mirror image."""
HALF_WIDTH = 0.75
"""Eye separations from the middle within which the average face is compared."""
SIZES = np.geomspace(0.11, 0.48, 20)
"""Eye separations tried, as shares of the mesh's size: from a bust to a mask."""
TILT = 0.25
"""How far the relief may lean, as a slope, before it counts against it: half of one of the `TURNS`, and the heads'."""
UNLIKE = 0.15
"""A difference in depth from which on places are unlike, in eye separations."""


class Stand(NamedTuple):
    """A pose of the average face, and how unlike the relief there is: 0 the same, 1 nothing alike."""

    pose: Similarity
    unlike: float


@dataclass(frozen=True, eq=False)
class _Relief:
    """Depths seen along an axis.

    Attributes
    ----------
    depths : (ROWS, COLUMNS) mean of left and right half, forward, NaN where nothing was met; row 0 on top.
    axes : (3, 3) rows left, up, forward. origin : (3,) of the plane that the depths count from, at the lowest row.
    step : between rows and columns.
    """

    depths: FloatArray
    axes: FloatArray
    origin: FloatArray
    step: float


def find_stands(template: Template, mesh: TriMesh, caster: RayCaster, mirror: Mirror) -> list[Stand]:
    """The best stand for every way up about a plane of symmetry, best first."""
    stands = []
    for side in (1.0, -1.0):
        left = side * mirror.normal
        first = unit_vectors(cross(left[None], np.eye(3)[[np.abs(left).argmin()]]))[0]
        second = cross(left[None], first[None])[0]
        for turn in 2 * np.pi * np.arange(TURNS) / TURNS:
            up = np.cos(turn) * first + np.sin(turn) * second
            axes = np.stack([left, up, cross(left[None], up[None])[0]])
            relief = _relief(mesh, caster, axes, side * mirror.distance)
            stands.append(_best_stand(template, relief, mesh.size))
    return sorted(stands, key=lambda stand: stand.unlike)


def _relief(mesh: TriMesh, caster: RayCaster, axes: FloatArray, middle: float) -> _Relief:
    """What is seen along the forward axis. middle : where the plane of symmetry lies along the left axis."""
    seen = mesh.vertices[np.unique(mesh.faces)] @ axes.T
    low, high = seen.min(axis=0), seen.max(axis=0)
    step = float(high[1] - low[1]) / ROWS
    heights = high[1] - step * (np.arange(ROWS) + 0.5)
    across = HALF_WIDTH * SIZES[-1] * mesh.size / (COLUMNS - 1) * np.arange(COLUMNS)
    both = []
    for side in (1.0, -1.0):
        x, y = np.meshgrid(middle + side * across, heights)
        start = np.stack([x.ravel(), y.ravel(), np.full(x.size, high[2] + 0.01 * mesh.size)], axis=1) @ axes
        hits = caster.nearest(start, np.broadcast_to(-axes[2], start.shape))
        both.append(np.where(hits.found, high[2] + 0.01 * mesh.size - hits.distance, np.nan).reshape(x.shape))
    halves = np.stack(both)
    there = np.isfinite(halves)
    depths = np.where(there, halves, 0.0).sum(axis=0) / np.maximum(there.sum(axis=0), 1)
    depths[~there.any(axis=0)] = np.nan
    origin = np.array([middle, heights[0], 0.0])
    return _Relief(depths, axes, origin, step)


def _best_stand(template: Template, relief: _Relief, size: float) -> Stand:
    """The size and height at which the relief is most like the average face's."""
    half = (template.places[:, 0] > -1e-6) & (template.places[:, 0] < HALF_WIDTH) & (template.normals[:, 2] > 0.3)
    x, y, z = template.places[half].T
    across = HALF_WIDTH * SIZES[-1] * size / (COLUMNS - 1)
    best = Stand(Similarity(1.0, np.eye(3), np.zeros(3)), np.inf)
    for share in SIZES:
        unit = float(share * size)
        columns = np.round(unit * x / across).astype(np.int64)
        rows = np.round(-unit * y / relief.step).astype(np.int64)
        found = np.arange(ROWS)[:, None] + rows
        inside = (found >= 0) & (found < ROWS)
        depths = np.where(inside, relief.depths[np.clip(found, 0, ROWS - 1), columns], np.nan) / unit
        unlike, offset, slope = _unlikeness(depths - z, y)
        row = int(unlike.argmin())
        if unlike[row] < best.unlike:
            pose = _pose(relief, unit, row, float(offset[row]), float(slope[row]))
            best = Stand(pose, float(unlike[row]))
    return best


def _pose(relief: _Relief, unit: float, row: int, offset: float, slope: float) -> Similarity:
    """The pose that puts the eyes' middle at a row of a relief, so far forward and leaning so."""
    lean = np.arctan(slope)
    turn = np.array([[1.0, 0, 0], [0, np.cos(lean), np.sin(lean)], [0, -np.sin(lean), np.cos(lean)]])
    place = relief.origin + np.array([0.0, -row * relief.step, unit * offset])
    return Similarity(unit, relief.axes.T @ turn.T, relief.axes.T @ place)


def _unlikeness(gaps: FloatArray, heights: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """(R,) how unlike depths are whose differences (R, P) from the average face are given, at heights (P,) of it.

    Also (R,) and (R,) the offset and slope that are left aside: where the face stands, and how it leans.
    """
    there = np.isfinite(gaps)
    count = np.maximum(there.sum(axis=1), 1)
    values = np.where(there, gaps, 0.0)
    mean, height = values.sum(axis=1) / count, (there * heights).sum(axis=1) / count
    away = np.where(there, heights - height[:, None], 0.0)
    slope = (values * away).sum(axis=1) / np.maximum((away**2).sum(axis=1), 1e-12)
    offset = mean - slope * height
    rest = np.abs(gaps - offset[:, None] - slope[:, None] * heights)
    unlike = np.where(there, np.minimum(rest / UNLIKE, 1.0), 1.0).mean(axis=1)
    return unlike + np.maximum(np.abs(slope) - TILT, 0.0), offset, slope
