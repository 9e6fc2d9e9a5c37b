"""Eyeballs: which parts of a head they are, and how they turn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..mesh import TriMesh
from ..mpeg4.regions import OWN_PARTS
from ..parts.kinds import NO_NAMES, NamedParts, eyeball_name, named_vertices
from ..points import FeaturePoints

EYES: dict[str, tuple[str, str, str, str, str]] = {
    "left": ("3.1", "3.3", "3.7", "3.11", "3.5"),
    "right": ("3.2", "3.4", "3.12", "3.8", "3.6"),
}
"""Eye -> FDPs of its upper lid, lower lid, outer corner, inner corner, pupil."""
RADIUS = 0.56
"""Of an eyeball, in widths of its eye: where none is found, and to know one when it is."""
ROUND = 0.12
"""A part is an eyeball if its vertices' distances from the middle vary by less than this, as a share of the radius."""
WRAPS = 0.65
"""Radii from the middle of an eyeball's sphere to its vertices' mean, at most: half a sphere has 0.5, a strip more."""


class Eyeball(NamedTuple):
    """An eyeball in the object's axes and units.

    vertices : (n,) of the parts that turn with it; none where the head has no eyeball of its own there.
    centre : (3,). radius : a length.
    """

    side: str
    vertices: IntArray
    centre: FloatArray
    radius: float

    def turned(self, positions: FloatArray, rotations: FloatArray) -> FloatArray:
        """Positions (F, n, 3) of its vertices, from neutral positions (V, 3) and rotations (F, 3, 3)."""
        away = positions[self.vertices] - self.centre
        turned: FloatArray = np.einsum("fij,nj->fni", rotations, away) + self.centre
        return turned


def find_eyeballs(
    mesh: TriMesh, points: FeaturePoints, axes: FloatArray, named: NamedParts = NO_NAMES
) -> dict[str, Eyeball]:
    """The eyeballs behind the lids, by side; one that the head lacks is guessed from the lids, without vertices.

    An eyeball is what the artist calls one. Otherwise it is made of round parts, other than the skin, whose middle lies
    where the lids let it be. What is not round, such as lashes, does not belong to it.

    Parameters
    ----------
    points : an eye is looked for where its lids and corners are among them.
    axes : (3, 3) of the head.
    named : parts that the artist named.
    """
    called = named_vertices(mesh, named)
    where = dict(zip(points.names, points.positions(mesh.vertices), strict=True))
    on_skin = points.subset([name for name in points.names if name not in OWN_PARTS])
    taken = mesh.components[np.concatenate([on_skin.holders, *called.values()])]
    found: dict[str, Eyeball] = {}
    for side, (upper, lower, outer, inner, _) in EYES.items():
        if eyeball_name(side) in called:
            vertices = called[eyeball_name(side)]
            found[side] = Eyeball(side, vertices, *fit_sphere(mesh.vertices[vertices]))
            continue
        if not all(name in where for name in (upper, lower, outer, inner)):
            continue
        width = float(np.linalg.norm(where[outer] - where[inner]))
        radius = RADIUS * width
        guess = 0.5 * (where[upper] + where[lower])
        guess = guess - axes[2] * _depth(where, (upper, lower), radius)
        parts = _round_parts(mesh, taken, guess, radius)
        if parts.any():
            vertices = np.flatnonzero(parts)
            centre, radius = fit_sphere(mesh.vertices[vertices])
            found[side] = Eyeball(side, vertices, centre, radius)
        else:
            found[side] = Eyeball(side, np.empty(0, np.int64), guess, radius)
    return found


def fit_sphere(positions: FloatArray) -> tuple[FloatArray, float]:
    """Centre (3,) and radius of the sphere nearest to positions (n, 3), in least squares of squared distances."""
    middle = positions.mean(axis=0)
    p = positions - middle
    solution = np.linalg.lstsq(np.column_stack([2 * p, np.ones(len(p))]), np.einsum("ij,ij->i", p, p), rcond=None)[0]
    centre = solution[:3]
    return middle + centre, float(np.sqrt(max(solution[3] + centre @ centre, 0.0)))


def _depth(where: dict[str, FloatArray], lids: Sequence[str], radius: float) -> float:
    """How far behind the middle of the lids' margins a ball's centre lies whose surface holds both margins."""
    half = 0.5 * float(np.linalg.norm(where[lids[0]] - where[lids[1]]))
    return float(np.sqrt(max(radius**2 - half**2, 0.0)))


def _round_parts(mesh: TriMesh, taken: IntArray, centre: FloatArray, radius: float) -> BoolArray:
    """(V,) vertices of the round components around a place, other than those taken."""
    chosen = np.zeros(len(mesh.vertices), bool)
    far = np.linalg.norm(mesh.vertices - centre, axis=1)
    near = np.unique(mesh.components[far < 2 * radius])
    for component in near:
        own = mesh.components == component
        if component in taken or own.sum() < 12 or far[own].max() > 3 * radius:
            continue
        middle, size = fit_sphere(mesh.vertices[own])
        spread = np.linalg.norm(mesh.vertices[own] - middle, axis=1).std()
        wraps = np.linalg.norm(mesh.vertices[own].mean(axis=0) - middle) < WRAPS * size
        fits = np.linalg.norm(middle - centre) < radius and 0.5 * radius < size < 1.6 * radius
        if wraps and fits and spread < ROUND * size:
            chosen[own] = True
    return chosen
