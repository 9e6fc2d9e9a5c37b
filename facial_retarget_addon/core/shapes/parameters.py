"""Which parameter of which standard a shape shows, by its name."""

from __future__ import annotations

from typing import NamedTuple

from ..mpeg4.expressions import EXPRESSIONS
from ..mpeg4.faps import FAPS
from ..mpeg4.sets import SETS
from ..mpeg4.visemes import VISEMES
from .names import arkit_name

KINDS = ("fap", "viseme", "expression", "arkit", "free")
MOST = 63
"""The greatest intensity of a viseme or an expression in MPEG-4."""


class Parameter(NamedTuple):
    """What a shape answers to.

    kind : one of `KINDS`.
    key : number of the FAP, the viseme of FAP 1 or the expression of FAP 2, ARKit's name, or "" for a free shape.
    low, high : the values that the parameter may have; at `high` the shape is as it is given.
    """

    kind: str
    key: int | str
    low: float
    high: float


_FAPS = {fap.name: fap for fap in FAPS}


def parameter_of(name: str) -> Parameter:
    """The parameter of a shape with this name; the shapes of `SETS` and ARKit's in any common spelling are known."""
    if name in SETS["faps"]:
        fap = _FAPS[name]
        (full,) = SETS["faps"][name].values()
        return Parameter("fap", fap.number, 0.0 if fap.one_way else -float(full), float(full))
    if name in VISEMES:
        return Parameter("viseme", VISEMES[name].number, 0.0, MOST)
    if name in EXPRESSIONS:
        return Parameter("expression", EXPRESSIONS[name].number, 0.0, MOST)
    known = arkit_name(name)
    return Parameter("arkit", known, 0.0, 1.0) if known else Parameter("free", "", 0.0, 1.0)
