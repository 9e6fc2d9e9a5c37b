"""Sets of shapes that any face can be given from its feature points alone."""

from __future__ import annotations

from .arkit import ARKIT
from .expressions import EXPRESSIONS
from .faps import FAPS, HEAD_TURNS
from .recipes import Recipe
from .visemes import VISEMES

SETS: dict[str, dict[str, Recipe]] = {
    "expressions": {name: expression.recipe for name, expression in EXPRESSIONS.items()},
    "visemes": {name: viseme.recipe for name, viseme in VISEMES.items()},
    "arkit": ARKIT,
    "faps": {
        fap.name: {fap.number: 50000 if fap.unit == "AU" else 1024}
        for fap in FAPS
        if fap.unit and fap not in FAPS[HEAD_TURNS]
    },
}
"""Set -> shape -> recipe. In "faps" a FAP of length moves its whole length, an angle turns by half a radian."""
