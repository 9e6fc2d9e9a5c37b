"""What the parts of a head can be, and what an artist calls them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from ..arrays import IntArray
from ..mesh import TriMesh
from ..mpeg4.regions import OWN_PARTS
from ..points import FeaturePoints

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


def skin_components(mesh: TriMesh, points: FeaturePoints) -> list[int]:
    """The components that hold points of the skin: those that do not lie on eyes, teeth or tongue."""
    on_skin = points.subset([name for name in points.names if name not in OWN_PARTS])
    components: list[int] = np.unique(mesh.components[on_skin.holders]).tolist()
    return components


def named_faults(mesh: TriMesh, points: FeaturePoints, named: NamedParts) -> list[str]:
    """Parts that nobody knows, on vertices that do not exist, on the skin, or under two names: one clause for each.

    Parameters
    ----------
    points : those that do not lie on eyes, teeth or tongue show which components are the skin.
    """
    count, labels = len(mesh.vertices), mesh.components
    found: list[str] = []
    holds = dict.fromkeys(skin_components(mesh, points), "the skin")
    for name, held in named.items():
        vertices = np.asarray(held)
        if name not in NAMED_KINDS:
            found.append(f"a part is named {name!r}, expected one of {', '.join(NAMED_KINDS)}")
        elif vertices.ndim != 1 or vertices.dtype.kind not in "iu" or not len(vertices):
            found.append(f"part {name!r} has {vertices.dtype} {vertices.shape}, expected a list of vertices")
        elif vertices.min() < 0 or vertices.max() >= count:
            found.append(f"part {name!r} has vertices that the {count} do not include")
        else:
            for component in np.unique(labels[vertices]).tolist():
                if (other := holds.setdefault(component, name)) != name:
                    found.append(f"part {name!r} and {other} are one connected piece, expected separate ones")
                    break
    return found
