"""Small capital letters for pictures, so that a sheet says what it shows."""

from __future__ import annotations

import numpy as np

from .pictures import Image

_ROWS = 5
_CHARACTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.,:+/()%"
_DOTS = (
    "257556565634443655567464774644345535575572227"
    "111525565544447577557555525552656442557365655"
    "3421672222555575555255775552555522271247"
    "75557262277174771717557117471774757711227575775717"
    "00007007000000200024020200272011244244422111251245"
)
_GLYPHS = {character: _DOTS[_ROWS * k : _ROWS * (k + 1)] for k, character in enumerate(_CHARACTERS)}
"""Character -> its five rows from the top, each three pixels as an octal digit."""


def lettered(image: Image, text: str, scale: int = 1, colour: tuple[int, int, int] = (40, 40, 44)) -> Image:
    """The image with a line of text over its top left corner; what has no letter is a gap, what is too long is cut.

    Parameters
    ----------
    image : (h, w, 3).
    text : shown in capitals.
    scale : pixels of each dot.
    """
    marked = image.copy()
    top, left = 2 * scale, 2 * scale
    for character in text.upper():
        dots = _dots(character)
        tall, wide = (side * scale for side in dots.shape)
        if left + wide > image.shape[1] or top + tall > image.shape[0]:
            break
        marked[top : top + tall, left : left + wide][np.kron(dots, np.ones((scale, scale), bool))] = colour
        left += 4 * scale
    return marked


def _dots(character: str) -> np.ndarray[tuple[int, int], np.dtype[np.bool_]]:
    """(5, 3) which pixels a character has."""
    rows = [int(digit) for digit in _GLYPHS.get(character, "0" * _ROWS)]
    return np.array([[bool(row & bit) for bit in (4, 2, 1)] for row in rows])
