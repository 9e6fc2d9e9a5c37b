"""A built-in take of FAPs: the six expressions, then a few visemes, with blinks between them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..core.arrays import FloatArray, IntArray
from ..core.mpeg4.conversions import FULL
from ..core.mpeg4.expressions import EXPRESSIONS
from ..core.mpeg4.faps import FAPS
from ..core.mpeg4.stream import FapStream
from ..core.mpeg4.visemes import VISEMES
from .smooth import step

FPS = 25.0
ACTED, SPOKEN = tuple(EXPRESSIONS), ("viseme_aa", "viseme_PP", "viseme_oh", "viseme_E", "viseme_FF", "viseme_ou")
ACTED_FRAMES, SPOKEN_FRAMES = 16, 6
"""From one expression or viseme to the next."""
BLINKS = (14, 62, 110)
"""First frame of each blink."""
SHUT = (400, 1024, 1024, 500)
"""FAPs 19 and 20 in a blink, frame by frame."""


def fap_take() -> FapStream:
    """FAP 2 goes through every expression, FAP 1 says a word, FAPs 19 and 20 blink; neutral at both ends."""
    acted = _fades([EXPRESSIONS[name].number for name in ACTED], ACTED_FRAMES)
    spoken = _fades([VISEMES[name].number for name in SPOKEN], SPOKEN_FRAMES)
    count = len(acted) + len(spoken)
    values, used = np.zeros((count, len(FAPS))), np.zeros((count, len(FAPS)), bool)
    used[:, [0, 1, 18, 19]] = True
    for first in BLINKS:
        values[first : first + len(SHUT), 18:20] = np.array(SHUT)[:, None]
    viseme, expression = np.zeros((count, 4), np.int64), np.zeros((count, 6), np.int64)
    before, after, share = acted.T
    expression[: len(acted), :4] = np.stack([before, FULL - share, after, share], axis=1)
    before, after, share = spoken.T
    viseme[len(acted) :, :3] = np.stack([after, before, share], axis=1)
    return FapStream("built-in", FPS, values, used, viseme, expression)


def _fades(numbers: Sequence[int], frames: int) -> IntArray:
    """(F, 3) selection before, selection after, share of the latter out of 63: from neutral through all and back."""
    stops = np.array([0, *numbers, 0])
    share: FloatArray = step(np.arange(frames) / frames, 0.1, 0.7)
    pairs = np.repeat(np.stack([stops[:-1], stops[1:]], axis=1), frames, axis=0)
    shares = np.tile(np.rint(FULL * share).astype(np.int64), len(stops) - 1)
    return np.column_stack([pairs, shares])
