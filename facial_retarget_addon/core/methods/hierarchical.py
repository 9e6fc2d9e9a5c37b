"""Hierarchical retargeting (Na and Jung 2004), on a base mesh spanned by feature points.

The plain carry takes the source's motion at the counterpart of each target vertex through the
similarity of the two heads; on the normal mesh it splits into levels, each with its strength. The
examples then steer it. `variant = "paper"` is the published method instead.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Progress, no_progress
from ..carry import BlendedMotion, Motion, PiercedMotion
from ..level_retargeter import LevelRetargeter
from ..levels.level_gains import Strengths, scale_fine, scale_levels
from ..pair import Pair, prepare_pair
from ..paper_motion import PaperMotion
from ..parts.carried_parts import carried_parts
from ..problem import Problem
from ..seams.lids import lid_seams
from ..steering.learned import Example
from ..steering.rbf import MultiquadricMaps, fit_multiquadrics
from .settings import HierarchicalSettings

_MERGE = 1e-3
"""Eye separations: the paper's multiquadric centres closer than this are one."""


def fit(problem: Problem, settings: HierarchicalSettings, progress: Progress = no_progress) -> LevelRetargeter:
    """Fit the hierarchical method to a pair of faces.

    Raises
    ------
    RetargetError : if the points do not span a base mesh, or the examples do not fit the faces; names what to change.

    References
    ----------
    Na and Jung 2004, sections 3 and 4.
    """
    pair = prepare_pair(problem, settings.levels, settings.base_points, lambda share, what: progress(0.9 * share, what))
    examples = pair.steering_base.examples(problem)
    progress(0.9, "preparing the motion")
    strengths = Strengths(tuple(settings.gain(level) for level in range(settings.levels + 1)), settings.detail_scale)
    if settings.variant == "paper":
        retargeter = _paper(pair, settings, strengths, examples)
    else:
        retargeter = _default(problem, pair, settings, strengths, examples)
    progress(1.0, "fitted")
    return retargeter


# ---- the default variant ------------------------------------------------------------------------


def _default(
    problem: Problem, pair: Pair, settings: HierarchicalSettings, strengths: Strengths, examples: list[Example]
) -> LevelRetargeter:
    local = settings.frames == "local"

    def fine_motion(strengths: Strengths) -> Motion:
        places = pair.finest.positions
        if settings.read == "track":
            return pair.linear_motion(scale_fine(pair.fine_carry, pair.steps, strengths.gains), places, local)
        turns = pair.turns(places) if local else None
        return PiercedMotion(pair.reader(pierce=True), pair.source_normal, strengths.gains, pair.similarity, turns)

    def motion(strengths: Strengths) -> Motion:
        matrix = pair.carry
        if not strengths.plain:
            ride, inside = pair.binding.matrix, pair.binding.inside
            matrix = scale_levels(matrix, pair.fine_carry, ride, inside, pair.steps, *strengths)
        linear = pair.linear_motion(matrix, pair.target.vertices, local)
        return BlendedMotion(fine_motion(strengths), pair.binding, linear) if settings.read == "pierce" else linear

    # Parts that an example moves are left to the examples.
    parts = carried_parts(problem.source, problem.target, pair.steering_base.moved(examples))
    rotation = pair.turns(pair.target.vertices) if local else pair.similarity.rotation
    turns = np.broadcast_to(pair.similarity.scale * rotation, (len(pair.target.vertices), 3, 3))
    retargeter = LevelRetargeter(pair, motion, strengths, fine_motion, parts, lid_seams(problem, turns))
    retargeter.learn(examples, settings.example_strength)
    return retargeter


# ---- the published variant ----------------------------------------------------------------------


def _paper(
    pair: Pair, settings: HierarchicalSettings, strengths: Strengths, examples: list[Example]
) -> LevelRetargeter:
    reader = pair.reader(settings.read == "pierce")
    maps = _base_maps(pair, examples)
    beyond = pair.linear_motion(pair.carry, pair.target.vertices, local=False)

    def fine_motion(strengths: Strengths) -> Motion:
        return PaperMotion(reader, maps, pair.source_normal, pair.target_normal, strengths.gains)

    def motion(strengths: Strengths) -> Motion:
        return BlendedMotion(fine_motion(strengths), pair.binding, beyond)

    retargeter = LevelRetargeter(pair, motion, strengths, fine_motion)
    retargeter.measure(examples)
    return retargeter


def _base_maps(pair: Pair, examples: list[Example]) -> MultiquadricMaps:
    """Equations (3) and (4) for every base vertex, with neutral among the centres."""
    rotation = pair.similarity.rotation
    centres, values = [np.zeros_like(pair.source_base)], [np.zeros_like(pair.target_base)]
    for example in examples:
        centres.append(pair.source_points.positions(example.source))
        # The maps work in the source's orientation; the heads' rotation follows.
        values.append(pair.target_points.positions(example.target) @ rotation)
    maps = fit_multiquadrics(
        np.stack(centres, axis=1),
        np.stack(values, axis=1),
        _MERGE * pair.source_separation,
        pair.similarity.scale,
        linear=False,
    )
    return maps.turned(rotation)
