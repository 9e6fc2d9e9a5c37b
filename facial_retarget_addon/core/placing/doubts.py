"""Placed points that all the others contradict: swapped sides, the wrong lip, a corner of the mouth on the cheek."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray, IntArray
from ..rigid import fit_similarity
from .template import Template, likeness

LEAST = 6
"""Points from which on one of them can be doubted."""
SLACK = 0.04
"""How exactly points are usually placed, in eye separations."""
DOUBTFUL = 2.6
"""A point is doubtful if it lies this many times as far from where the others expect it as is usual."""
APART = 0.12
"""Points nearer to one another than this, in eye separations, may change sides."""
BACKWARDS = -0.1
"""A way leads backwards if its share along the expected one is below this."""
TRUSTED = 0.7
"""Share of the points that says how the head stands: those that agree best."""


def doubtful_rows(template: Template, rows: IntArray, places: FloatArray) -> list[int]:
    """Which of the points contradict the others, worst first.

    First those that lie on the wrong side of another one; then each is compared with what the others predict, the worst
    is set aside, and the rest are compared again.

    Parameters
    ----------
    rows : (P,) of the points in the template.
    places : (P, 3).

    Returns
    -------
    Indices into the points.

    References
    ----------
    Rasmussen and Williams 2006, equations (5.10) to (5.12): leaving one out.
    """
    left = list(range(len(rows)))
    doubtful: list[int] = []
    while len(left) >= LEAST:
        there = _in_template(template, rows[left], places[left])
        against = contradictions(template.places[rows[left]], there)
        scores = surprises(template, rows[left], there)
        if against.any():
            worst = np.flatnonzero(against == against.max())
        elif scores.max() >= DOUBTFUL:
            worst = np.array([scores.argmax()])
        else:
            break
        doubtful += [left[k] for k in worst[np.argsort(-scores[worst], kind="stable")]]
        left = [k for k in left if k not in doubtful]
    return doubtful


def contradictions(expected: FloatArray, there: FloatArray) -> IntArray:
    """(P,) with how many others each point has changed sides: the way from one to the other leads backwards.

    expected, there : (P, 3) in the template's axes and units.
    """
    ways, found = (places[:, None] - places for places in (expected, there))
    apart = np.linalg.norm(ways, axis=2) > APART
    backwards = np.einsum("pqi,pqi->pq", ways, found) < BACKWARDS * np.einsum("pqi,pqi->pq", ways, ways)
    count: IntArray = (apart & backwards).sum(axis=1).astype(np.int64)
    return count


def surprises(template: Template, rows: IntArray, there: FloatArray) -> FloatArray:
    """(P,) how far each point lies from where the others expect it, in how far it usually does.

    there : (P, 3) in the template's axes and units.
    """
    differences = (there - template.places[rows]).ravel()
    system = likeness(template.places[rows], template.places[rows], alike=0.0)
    precision = np.linalg.inv(system + SLACK**2 * np.eye(len(system)))
    blocks = precision.reshape(len(rows), 3, len(rows), 3)[np.arange(len(rows)), :, np.arange(len(rows))]
    weighted = (precision @ differences).reshape(-1, 3)
    # The gap left out is Q_ii^-1 q, and its covariance Q_ii^-1.
    squared = np.einsum("pi,pi->p", weighted, np.linalg.solve(blocks, weighted[..., None])[..., 0])
    surprise: FloatArray = np.sqrt(np.maximum(squared, 0.0) / 3)
    return surprise


def _in_template(template: Template, rows: IntArray, places: FloatArray) -> FloatArray:
    """Places (P, 3) in the template's axes and units, by the points that agree best."""
    pose = fit_similarity(template.places[rows], places)
    for _ in range(2):
        gaps = np.linalg.norm(pose.inverse.apply(places) - template.places[rows], axis=1)
        trusted = np.argsort(gaps, kind="stable")[: max(LEAST - 1, round(TRUSTED * len(rows)))]
        pose = fit_similarity(template.places[rows[trusted]], places[trusted])
    return pose.inverse.apply(places)
