"""Left and right halves of shapes, with a soft border along the middle of the face, and wholes out of halves."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ..arrays import FloatArray
from ..base.regions import eye_separation
from ..errors import RetargetError
from ..mesh import TriMesh
from ..mpeg4.fdps import FDPS
from ..mpeg4.head import LEFT, head_axes
from ..points import FeaturePoints
from .names import arkit_whole
from .shape_set import ShapeSet

FEATHER = 0.25
"""Half of the border's width, in eye separations."""


class SideNames(NamedTuple):
    """What is put behind a shape's name for its left and its right half."""

    left: str
    right: str


ARKIT_SIDES = SideNames("Left", "Right")
BLENDER_SIDES = SideNames("_L", "_R")
_STYLES = (ARKIT_SIDES, BLENDER_SIDES, SideNames(".L", ".R"), SideNames("_l", "_r"), SideNames("_left", "_right"))
_SIDED = re.compile(r"(left|right)(?![a-z])|(?<=[a-z])(Left|Right)|(^|[_. -])[LRlr]($|[_. -])|(?<=[a-z])[LR]$")


def has_side(name: str) -> bool:
    """Whether a name says left or right, as in browDownLeft, jawLeft, blink_L, AU_02_L_OuterBrowRaiser, left-eye."""
    return _SIDED.search(name) is not None


def side_names(names: Sequence[str]) -> SideNames:
    """The pair of endings that most of some names have, `BLENDER_SIDES` where none has any."""
    counts = [sum(name.endswith(tuple(style)) for name in names) for style in _STYLES]
    return _STYLES[int(np.argmax(counts))] if any(counts) else BLENDER_SIDES


def left_share(mesh: TriMesh, points: FeaturePoints, feather: float = FEATHER) -> FloatArray:
    """(V,) how much of a shape its left half has at each vertex: 1 on the left, 0 on the right, between them smooth.

    The middle lies half way between the points of both sides; a mirrored face has the mirrored shares.

    Parameters
    ----------
    points : those with MPEG-4 names count; at least one pair of left and right.
    feather : half of the border's width, in eye separations; 0 for a hard border.

    Raises
    ------
    RetargetError : if there is no pair of points, or the border is below 0.
    """
    if not feather >= 0:
        raise RetargetError(f"the border between left and right is {feather:g} wide, expected 0 or more")
    known = points.subset([name for name in points.names if name in FDPS])
    places = known.positions(mesh.vertices)
    where = dict(zip(known.names, places, strict=True))
    left = head_axes(known.names, places)[0]
    pairs = [(name, FDPS[name].partner) for name in where if name in LEFT and FDPS[name].partner in where]
    middle = np.mean([0.5 * (where[one] + where[other]) @ left for one, other in pairs])
    across = (mesh.vertices @ left - middle) / max(feather * eye_separation(mesh, known), 1e-9 * mesh.size)
    t = np.clip(0.5 + 0.5 * across, 0.0, 1.0)
    share: FloatArray = t * t * (3 - 2 * t)
    return share


def split(
    shapes: ShapeSet, share: FloatArray, endings: SideNames | None = None, cut: Sequence[str] | None = None
) -> ShapeSet:
    """Shapes cut in left and right halves; the two add up to the whole exactly.

    Shapes whose name has a side already stay as they are.

    Parameters
    ----------
    share : (V,) of `left_share`.
    endings : of the halves' names; as the set's own names have them if None.
    cut : names of the shapes that are cut; all if None.

    Raises
    ------
    RetargetError : if a half has the name of another shape.
    """
    endings = endings or side_names(shapes.names)
    names: list[str] = []
    moves: list[FloatArray] = []
    mostly_left = (share >= 0.5)[:, None]
    larger = np.maximum(share, 1 - share).astype(np.float32)[:, None]
    for name, whole in zip(shapes.names, shapes.displacements, strict=True):
        if has_side(name) or (cut is not None and name not in cut):
            names.append(name)
            moves.append(whole)
            continue
        # The difference of numbers that are within a factor of two is exact, so the halves add up without rounding.
        most = larger * whole
        rest = whole - most
        names += [name + endings.left, name + endings.right]
        moves += [np.where(mostly_left, most, rest), np.where(mostly_left, rest, most)]
    return ShapeSet(tuple(names), np.stack(moves) if moves else shapes.displacements)


def merged(shapes: ShapeSet, recipes: Mapping[str, Sequence[str]]) -> ShapeSet:
    """Shapes added up to new ones, which stand where the first part stood; the parts go.

    Parameters
    ----------
    recipes : new name -> names to add up. A part may serve several.

    Raises
    ------
    RetargetError : if a part is missing, nothing is to be added up, or a new name is taken by a shape that stays.
    """
    gone = {part for parts in recipes.values() for part in parts}
    empty = [name for name, parts in recipes.items() if not parts]
    if empty:
        raise RetargetError(f"{empty[0]!r} has nothing to be added up, expected names of shapes")
    added = {name: shapes.displacements[shapes.rows(parts)].sum(axis=0) for name, parts in recipes.items()}
    first = {name: min(shapes.rows(parts)) for name, parts in recipes.items()}
    names: list[str] = []
    moves: list[FloatArray] = []
    for row, name in enumerate(shapes.names):
        for new in [new for new, place in first.items() if place == row]:
            names.append(new)
            moves.append(added[new])
        if name not in gone:
            names.append(name)
            moves.append(shapes.displacements[row])
    return ShapeSet(tuple(names), np.stack(moves) if moves else shapes.displacements)


def arkit_merges(names: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """Recipes for `merged` that give ARKit its wholes out of halves: browInnerUp of browInnerUp_L and browInnerUp_R."""
    halves: dict[str, list[str]] = {}
    for name in names:
        whole = arkit_whole(name)
        if whole is not None and whole not in names:
            halves.setdefault(whole, []).append(name)
    return {whole: tuple(parts) for whole, parts in halves.items() if len(parts) == 2}
