"""Expression sets for any face, from its feature points alone."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray
from ..errors import RetargetError
from ..mpeg4.conversions import recipe_matrix
from ..mpeg4.sets import SETS
from .fap_face import FapFace


def expression_shapes(face: FapFace, sets: Sequence[str]) -> dict[str, FloatArray]:
    """Positions (V, 3) float32 of the shapes of one or several sets, by name.

    A shape of which this face can show nothing is left out; `still_shapes` names those.

    Raises
    ------
    RetargetError : for a set that does not exist.
    """
    recipes = {name: recipe for name, recipe in _recipes(sets).items() if _shows(face, recipe)}
    if not recipes:
        return {}
    return dict(zip(recipes, face.frames(recipe_matrix(recipes.values())), strict=True))


def still_shapes(face: FapFace, sets: Sequence[str]) -> list[str]:
    """Names of the shapes that this face cannot show: none of the points that they move is on it."""
    return [name for name, recipe in _recipes(sets).items() if not _shows(face, recipe)]


def _recipes(sets: Sequence[str]) -> dict[str, dict[int, int]]:
    unknown = [name for name in sets if name not in SETS]
    if unknown:
        raise RetargetError(f"there is no set {', '.join(map(repr, unknown))}, expected some of {', '.join(SETS)}")
    return {shape: dict(recipe) for name in sets for shape, recipe in SETS[name].items()}


def _shows(face: FapFace, recipe: dict[int, int]) -> bool:
    return bool(np.any(face.playable[[number - 1 for number in recipe]]))
