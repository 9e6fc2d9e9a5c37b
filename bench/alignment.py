"""Two heads laid on one another by their common points: what every peer starts from."""

from __future__ import annotations

from facial_retarget_addon.core.arrays import FloatArray
from facial_retarget_addon.core.points import common_names
from facial_retarget_addon.core.problem import Problem
from facial_retarget_addon.core.rigid import Similarity, fit_similarity

AGREEMENT = 0.3
"""Smallest dot product of the normals of two places that correspond."""


def common_places(problem: Problem) -> tuple[FloatArray, FloatArray]:
    """(P, 3) places of the common points on the source and on the target."""
    names = common_names(problem.source.points, problem.target.points)
    faces = problem.source, problem.target
    source, target = (face.points.subset(names).positions(face.mesh.vertices) for face in faces)
    return source, target


def head_similarity(problem: Problem) -> Similarity:
    """The similarity that takes the source's points to the target's."""
    return fit_similarity(*common_places(problem))
