"""More places that tell examples apart, between the feature points."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ..base.refinement import farthest_vertices
from ..matching.correspondence import Correspondence, places_on_source
from ..points import FeaturePoints
from .learned import SteeringBase

WANTED = 105
"""Places that a base has."""
REACH = 0.5
"""Nowhere farther from a feature point than this, in eye separations."""


def denser_base(base: SteeringBase, correspondence: Correspondence) -> SteeringBase:
    """A base with vertices of the target between its points, and their places on the source.

    Parameters
    ----------
    correspondence : of the two faces.
    """
    target, points = base.target, base.target_points.positions(base.target.vertices)
    near = cKDTree(points).query(target.vertices)[0] < REACH * base.target_separation
    candidates = np.flatnonzero(near & (correspondence.confidence > 0.5))
    added = farthest_vertices(target.vertices, candidates, points, WANTED - len(points))
    corners, weights = np.repeat(added[:, None], 3, axis=1), np.tile([1.0, 0.0, 0.0], (len(added), 1))
    names = tuple(f"between {k}" for k in range(1, len(added) + 1))
    matched = places_on_source(correspondence, base.source, target, corners, weights)
    return SteeringBase(
        base.source,
        target,
        base.source_points.joined(FeaturePoints(names, *matched)),
        base.target_points.joined(FeaturePoints(names, corners, weights)),
        base.source_separation,
        base.target_separation,
    )
