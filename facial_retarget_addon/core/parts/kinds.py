"""What the parts of a head can be, and what an artist calls them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from ..arrays import IntArray
from ..mesh import TriMesh

EYEBALL, AROUND_EYE = "eyeball", "around an eye"
UPPER, LOWER, BOTH = "upper part of the mouth", "lower part of the mouth", "inside of the mouth"
TONGUE = "tongue"
BROW, MOUSTACHE, BEARD = "brow", "moustache", "beard"
ACROSS, OTHER = "behind the mouth", "other"

NAMED_KINDS = MappingProxyType(
    {
        "left eyeball": EYEBALL,
        "right eyeball": EYEBALL,
        "lashes": AROUND_EYE,
        "brows": BROW,
        "moustache": MOUSTACHE,
        "beard": BEARD,
        "upper teeth": UPPER,
        "lower teeth": LOWER,
        "tongue": TONGUE,
        "gums": BOTH,
        "still": OTHER,
    }
)
"""What an artist may call a part -> its kind. Gums are those of both rows in one piece; what is still never moves."""

NamedParts = Mapping[str, IntArray]
"""What an artist calls a part -> vertices (n,), at least one on each of its components."""

NO_NAMES: NamedParts = MappingProxyType({})


def named_vertices(mesh: TriMesh, named: NamedParts) -> dict[str, IntArray]:
    """The vertices (n,) of all components that hold any of a part's vertices, by what the artist calls it."""
    return {
        name: np.flatnonzero(np.isin(mesh.components, mesh.components[vertices])) for name, vertices in named.items()
    }


def eyeball_name(side: str) -> str:
    """What an artist calls the eyeball of a side, left or right."""
    return f"{side} eyeball"
