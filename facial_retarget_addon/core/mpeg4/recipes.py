"""Recipes: a shape of the face as FAPs at its full strength."""

from __future__ import annotations

from .faps import FAPS

Recipe = dict[int, int]
"""FAP number -> its value at the shape's full strength."""


def mirrored(recipe: Recipe) -> Recipe:
    """The recipe of the mirrored face: a left smile's is the right smile's."""
    turned = {FAPS[number - 1].mirror: value * FAPS[number - 1].mirror_sign for number, value in recipe.items()}
    return dict(sorted(turned.items()))


def symmetric(half: Recipe) -> Recipe:
    """A recipe out of its left half and its middle line."""
    return dict(sorted((half | mirrored(half)).items()))
