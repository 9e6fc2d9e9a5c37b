"""Streams of FAPs, their high-level ones resolved, and streams out of other things than `.fap` files."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..errors import RetargetError
from .arkit import ARKIT
from .arkit_take import ArkitTake
from .expressions import EXPRESSIONS
from .faps import FAPS, HEAD_TURNS
from .fapu import ANGLE, PARTS
from .recipes import Recipe
from .stream import FapStream
from .visemes import VISEMES

FULL = 63
"""Blend and intensity of FAPs 1 and 2 at their most."""

_EYES = ((23, 0, -1), (25, 1, 1), (24, 3, -1), (26, 4, 1))
"""FAP, column of the take's angles of the eyes, sign."""


def low_level(stream: FapStream, missing: str = "hold") -> FloatArray:
    """FAPs (F, 68) with everything that the stream says put into the low-level ones; columns 0 and 1 are 0.

    FAP 1 is b/63 of its first viseme and 1 - b/63 of its second, FAP 2 the sum of its two expressions, each by its
    intensity out of 63; the recipes are added to what the low-level FAPs say. A frame whose viseme_def or
    expression_def is set brings that shape in its low-level FAPs, and no recipe is added for it.

    Parameters
    ----------
    stream : of F frames.
    missing : "hold" keeps what a FAP, of either level, said last, and 0 before it has said anything; "zero" takes 0
        wherever a frame does not use it.

    Raises
    ------
    RetargetError : if `missing` is neither, or a frame selects a viseme or an expression that does not exist.

    References
    ----------
    MPEG-4 FBA, FAPs 1 and 2; that FAP 1 blends linearly is the common reading.
    """
    used = stream.used
    if missing == "hold":
        frames = np.maximum.accumulate(np.where(used, np.arange(len(stream))[:, None], -1), axis=0)
    elif missing == "zero":
        frames = np.where(used, np.arange(len(stream))[:, None], -1)
    else:
        raise RetargetError(f"unused FAPs are to be treated as {missing!r}, expected 'hold' or 'zero'")
    said = frames >= 0
    values: FloatArray = np.where(said, np.take_along_axis(stream.values, np.maximum(frames, 0), axis=0), 0.0)
    values[:, :2] = 0.0

    first, second, blend, defined = stream.viseme[frames[:, 0]].T
    weights = np.stack([blend, FULL - blend], axis=1) / FULL * (said[:, 0] & (defined == 0))[:, None]
    recipes = recipe_matrix(viseme.recipe for viseme in VISEMES.values())
    values += _mixed(stream, "viseme", np.stack([first, second], axis=1), weights, recipes)

    one, intensity, other, other_intensity, _, defined = stream.expression[frames[:, 1]].T
    weights = np.stack([intensity, other_intensity], axis=1) / FULL * (said[:, 1] & (defined == 0))[:, None]
    recipes = recipe_matrix(expression.recipe for expression in EXPRESSIONS.values())
    values += _mixed(stream, "expression", np.stack([one, other], axis=1), weights, recipes)
    return values


def faps_of_arkit(take: ArkitTake) -> FapStream:
    """FAPs of a take of ARKit weights: each shape's recipe times its weight.

    Lids that blink, look down and squint at once would cross: the upper one stops at the lower one. Where the take has
    the angles of the eyes, they and not the eyeLook shapes turn the eyes; angles of the head give FAPs 48 to 50. Angles
    that are 0 in every frame were not recorded: many tools write such columns.

    Live Link Face records radians, positive where the gaze goes to the subject's right (yaw) and down (pitch), and
    where the head leans to the subject's left (roll). For the eyes of recorded takes this is measured: yaw and pitch
    follow the eyeLook weights (correlation 0.98 to 1), and roll is the product of the two within a few percent, as it
    must be with this sign for an eye that rises about a level axis, in Unreal's order of angles. The head's angles are
    taken to follow the same rule; the takes at hand do not move the head.
    """
    weights = np.asarray(take.weights, np.float64)
    recipes = recipe_matrix(ARKIT.values())
    values: FloatArray = weights @ recipes
    used = recipes.any(axis=0)
    if take.eyes is not None and take.eyes.any():
        for number, column, sign in _EYES:
            values[:, number - 1] = sign * take.eyes[:, column] / ANGLE
    if take.head is not None and take.head.any():
        yaw, pitch, roll = np.asarray(take.head, np.float64).T
        values[:, HEAD_TURNS] = np.stack([pitch, -yaw, -roll], axis=1) / ANGLE
        used[HEAD_TURNS] = True
    for upper, lower in ((19, 21), (20, 22)):
        values[:, upper - 1] = np.minimum(values[:, upper - 1], PARTS - values[:, lower - 1])
    return stream_of_values(take.name, take.fps, values, used)


def stream_of_values(name: str, fps: float, values: FloatArray, used: BoolArray | None = None) -> FapStream:
    """A stream of low-level FAPs.

    Parameters
    ----------
    name : of the take.
    fps : frames a second.
    values : (F, 68), column n - 1 is FAP n.
    used : (68,) the FAPs that every frame states, all low-level ones by default; the others' values do not count.

    Raises
    ------
    RetargetError : if `values` have another shape.
    """
    if np.ndim(values) != 2 or np.shape(values)[1] != len(FAPS):
        raise RetargetError(f"FAP values of {name!r} have shape {np.shape(values)}, expected (frames, {len(FAPS)})")
    stated = np.ones(len(FAPS), bool) if used is None else np.array(used, bool)
    stated[:2] = False
    frames = len(values)
    return FapStream(
        name,
        fps,
        np.where(stated, values, 0.0),
        np.tile(stated, (frames, 1)),
        np.zeros((frames, 4), np.int64),
        np.zeros((frames, 6), np.int64),
    )


def recipe_matrix(recipes: Iterable[Recipe]) -> FloatArray:
    """(N, 68) FAPs of N recipes."""
    rows = list(recipes)
    matrix = np.zeros((len(rows), len(FAPS)))
    for row, recipe in enumerate(rows):
        for number, value in recipe.items():
            matrix[row, number - 1] = value
    return matrix


def _mixed(stream: FapStream, what: str, selected: IntArray, weights: FloatArray, recipes: FloatArray) -> FloatArray:
    """(F, 68) two selected (F, 2) recipes of (N, 68) by their weights (F, 2); selection 0 is the neutral face."""
    wrong = np.argwhere((weights != 0) & ((selected < 0) | (selected > len(recipes))))
    if len(wrong):
        frame, side = wrong[0]
        raise RetargetError(
            f"frame {frame} of {stream.name!r} selects {what} {selected[frame, side]}, expected 0 to {len(recipes)}"
        )
    shares = np.zeros((len(weights), len(recipes) + 1))
    np.add.at(shares, (np.arange(len(weights))[:, None], np.where(weights != 0, selected, 0)), weights)
    mixed: FloatArray = shares[:, 1:] @ recipes
    return mixed
