"""Margins of the eyes and the line between the lips, as they are seen from the front of a face."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.ndimage import label

from ..arrays import BoolArray, FloatArray, IntArray
from ..mesh import TriMesh
from ..points import FeaturePoints
from ..raycast import CasterFactory, RayCaster
from .face_fit import FaceFit

EYES = (
    ("3.7", "3.11", "3.1", "3.3", "upper_lid_l_1", "upper_lid_l_2", "lower_lid_l_1", "lower_lid_l_2"),
    ("3.12", "3.8", "3.2", "3.4", "upper_lid_r_1", "upper_lid_r_2", "lower_lid_r_1", "lower_lid_r_2"),
)
"""Of each eye: outer corner, inner corner, middles of upper and lower lid, their inner and outer quarters."""
LID_PLACES = ((0.5, True), (0.5, False), (0.2, True), (0.8, True), (0.2, False), (0.8, False))
"""Of the lids' points: share of the way from the inner corner to the outer one, and whether it is the upper lid."""
EYE_COLUMNS, EYE_ROWS = 61, 81
EYE_WIDTHS, EYE_HEIGHT = (0.18, 0.70), 0.03
"""Widths that the opening of an eye may have, and its least height."""
DEEP = 0.15
"""What lies this far behind the lids lies inside the eye."""
LIPS = (("2.2", "2.3"), ("2.6", "2.8"), ("2.7", "2.9"))
"""Points of the upper and of the lower lip's inner edge that face one another."""
LIP_ROWS = 97
LIP_TURN = 0.25
"""Least turn of the normal, up or down, from one lip to the other, across so many rows: the sine of some 15 degrees."""
LIP_STEP = 4
_BEFORE = 1.0


class Search(NamedTuple):
    """Where landmarks are looked for, in eye separations about where the average face expects them.

    eye : half the width and half the height of an eye's window. lips : half the height of the lips'.
    believed : landmarks farther away are something else.
    """

    eye: tuple[float, float]
    lips: float
    believed: float


NEARBY = Search((0.42, 0.30), 0.13, 0.25)
"""For a face that is fitted to some points."""
WIDE = Search((0.55, 0.45), 0.25, 0.4)
"""For one that is only guessed."""


@dataclass(frozen=True, eq=False)
class FrontView:
    """The skin of a head, seen along the axes of a fitted face.

    Attributes
    ----------
    mesh : the head.
    faces : (S,) of the skin, all of them.
    outside : (S,) which of them can be seen from outside the head.
    caster : casts rays on these faces alone. balls : on the eyeballs, None where there are none.
    """

    mesh: TriMesh
    faces: IntArray
    outside: BoolArray
    caster: RayCaster
    balls: RayCaster | None

    @classmethod
    def of(
        cls, mesh: TriMesh, faces: IntArray, outside: BoolArray, balls: IntArray, make_caster: CasterFactory
    ) -> FrontView:
        """Of some faces (S,) of a mesh, and those of its eyeballs (B,); outside (F,)."""
        skin = make_caster(TriMesh(mesh.vertices, mesh.faces[faces]))
        eyes = make_caster(TriMesh(mesh.vertices, mesh.faces[balls])) if len(balls) else None
        return cls(mesh, faces, outside[faces], skin, eyes)

    def points(self, seen: Seen, names: tuple[str, ...], rows: IntArray) -> FeaturePoints:
        """Points of these names at some rows of what was seen; those off the skin are left out."""
        good = seen.skin[rows]
        kept = tuple(name for name, keep in zip(names, good, strict=True) if keep)
        return FeaturePoints(kept, self.mesh.faces[seen.face[rows[good]]], seen.weights[rows[good]])

    def look(self, fit: FaceFit, x: FloatArray, y: FloatArray, z: float) -> Seen:
        """What straight lines from before the face meet at places (N,), (N,) of the template's axes.

        z : how far forward the surface is expected.
        """
        origins = fit.pose.apply(np.stack([x, y, np.full_like(x, z + _BEFORE)], axis=1))
        forward = fit.pose.rotation[:, 2]
        directions = np.broadcast_to(-forward, origins.shape)
        hits = self.caster.nearest(origins, directions)
        own = self.faces[hits.face]
        normals = self.mesh.face_normals[own] @ fit.pose.rotation
        depth = hits.distance / fit.pose.scale - _BEFORE
        skin = hits.found & self.outside[hits.face] & (normals[:, 2] > 0) & (depth < DEEP)
        if self.balls is not None:
            skin &= self.balls.nearest(origins, directions).distance > hits.distance
        return Seen(skin, own, hits.weights, normals)


class Seen(NamedTuple):
    """Skin (N,) true where it was met, its face (N,), weights (N, 3), and normals (N, 3) in the template's axes."""

    skin: BoolArray
    face: IntArray
    weights: FloatArray
    normals: FloatArray


def find_landmarks(view: FrontView, fit: FaceFit, search: Search) -> list[FeaturePoints]:
    """The margins of each eye that is open, and the line between the lips, as groups of points; what is not clearly
    there is left out.
    """
    where = dict(zip(fit.template.names, fit.template.places + fit.differences, strict=True))
    groups = [_eye(view, fit, np.array([where[name] for name in names]), names, search.eye) for names in EYES]
    groups += [
        _lips(view, fit, 0.5 * (where[upper] + where[lower]), (upper, lower), search.lips) for upper, lower in LIPS
    ]
    return [group for group in groups if group is not None]


def believed_landmarks(view: FrontView, fit: FaceFit, search: Search = NEARBY) -> list[FeaturePoints]:
    """Those of the landmarks that lie about where the average face expects them."""
    expected = dict(zip(fit.template.names, fit.places, strict=True))
    groups = find_landmarks(view, fit, search)
    return [
        group
        for group in groups
        if all(
            np.linalg.norm(place - expected[name]) <= search.believed * fit.pose.scale
            for name, place in zip(group.names, group.positions(view.mesh.vertices), strict=True)
        )
    ]


def _eye(
    view: FrontView, fit: FaceFit, expected: FloatArray, names: tuple[str, ...], half: tuple[float, float]
) -> FeaturePoints | None:
    """Margins of an eye: the border of what is not skin around its middle.

    expected : (8, 3) in the template's axes. half : of the window that it is looked for in.
    """
    middle = expected[:4].mean(axis=0)
    x = middle[0] + np.linspace(-half[0], half[0], EYE_COLUMNS)
    y = middle[1] + np.linspace(half[1], -half[1], EYE_ROWS)
    columns, rows = np.meshgrid(x, y)
    seen = view.look(fit, columns.ravel(), rows.ravel(), float(middle[2]))
    opening = _opening(~seen.skin.reshape(columns.shape))
    if opening is None:
        return None
    there = np.flatnonzero(opening.any(axis=0))
    first, last = int(there[0]), int(there[-1])
    width, height = x[last] - x[first], np.ptp(y[opening.any(axis=1)])
    if not (EYE_WIDTHS[0] < width < EYE_WIDTHS[1] and height > EYE_HEIGHT):
        return None
    outer, inner = (last, first) if expected[0, 0] > expected[1, 0] else (first, last)
    outwards = int(np.sign(outer - inner))
    cells = [(_middle_row(opening[:, outer]), outer + outwards), (_middle_row(opening[:, inner]), inner - outwards)]
    for share, upper in LID_PLACES:
        column = round(inner + share * (outer - inner))
        open_rows = np.flatnonzero(opening[:, column])
        cells.append((int(open_rows[0]) - 1 if upper else int(open_rows[-1]) + 1, column))
    return view.points(seen, names, np.array([row * EYE_COLUMNS + column for row, column in cells]))


def _middle_row(column: BoolArray) -> int:
    rows = np.flatnonzero(column)
    return int(rows[len(rows) // 2])


def _opening(hollow: BoolArray) -> BoolArray | None:
    """The connected part of a picture that is largest and does not touch its border; None where there is none."""
    labels, count = label(hollow)
    border = np.unique(np.concatenate([labels[0], labels[-1], labels[:, 0], labels[:, -1]]))
    sizes = np.bincount(labels.ravel(), minlength=count + 1)
    sizes[0] = 0
    sizes[border] = 0
    if not sizes.any():
        return None
    chosen: BoolArray = labels == sizes.argmax()
    return chosen


def _lips(
    view: FrontView, fit: FaceFit, middle: FloatArray, names: tuple[str, str], reach: float
) -> FeaturePoints | None:
    """Edges of both lips on a line up and down: where the surface turns from looking down to looking up.

    middle : (3,) between the points, in the template's axes. reach : how far above and below it.
    """
    y = middle[1] + np.linspace(reach, -reach, LIP_ROWS)
    seen = view.look(fit, np.full(LIP_ROWS, middle[0]), y, float(middle[2]))
    hollow = np.flatnonzero(~seen.skin)
    if len(hollow):
        above, below = int(hollow[0]) - 1, int(hollow[-1]) + 1
    else:
        turn = seen.normals[LIP_STEP:, 1] - seen.normals[:-LIP_STEP, 1]
        half = LIP_STEP // 2
        near = 1 - 0.5 * np.abs(y[half:-half] - middle[1]) / reach
        best = int((turn * near).argmax())
        if turn[best] < LIP_TURN:
            return None
        above, below = best + half - 1, best + half + 1
    if above < 0 or below >= LIP_ROWS:
        return None
    return view.points(seen, names, np.array([above, below]))
