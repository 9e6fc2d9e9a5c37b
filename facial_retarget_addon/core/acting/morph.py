"""A generic head made into another by its feature points alone."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from ..arrays import FloatArray
from ..errors import RetargetError
from ..mesh import TriMesh
from ..mpeg4.head import head_axes
from ..points import FeaturePoints
from ..rigid import Similarity, fit_similarity
from .point_deformer import fit_deformer

LEAST = 4
"""Points that a head needs to be turned, scaled and morphed."""


class Morph(NamedTuple):
    """A morphed head: positions (V, 3), how the head as a whole was placed, and what an artist should know."""

    positions: FloatArray
    placed: Similarity
    warnings: tuple[str, ...]


def morph_to_points(mesh: TriMesh, points: FeaturePoints, wanted: Mapping[str, FloatArray]) -> Morph:
    """Deform a head so that its feature points arrive at given places.

    The head is first turned, scaled and moved as a whole; what is left moves the points, and they the surface.

    Parameters
    ----------
    mesh, points : the generic head.
    wanted : name -> (3,) place; names that the head lacks do not count.

    Raises
    ------
    RetargetError : if fewer than four points are in common, or a place is not finite.

    References
    ----------
    Kshirsagar, Garchery and Magnenat-Thalmann 2003, section 3.1 and figure 3.
    """
    names = [name for name in points.names if name in wanted]
    if len(names) < LEAST:
        raise RetargetError(
            f"{len(names)} of the {len(wanted)} wanted places have a point of the same name on the head, "
            f"expected at least {LEAST}"
        )
    common = points.subset(names)
    goal = np.array([wanted[name] for name in names], np.float64).reshape(-1, 3)
    placed = fit_similarity(common.positions(mesh.vertices), goal)
    there = mesh.with_vertices(placed.apply(mesh.vertices))
    start = common.positions(there.vertices)
    acting = np.ones((len(names), 3), bool)
    deformer = fit_deformer(there, common, head_axes(names, start), acting, shut_lids=False)
    moved = deformer.displacements((goal - start)[None])[0]
    return Morph(there.vertices + moved, placed, deformer.warnings)
