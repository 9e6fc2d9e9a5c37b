"""The average face laid on a head: turned, scaled and bent to the points that are known and to the surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray
from ..rigid import Similarity
from .samples import SurfaceSamples
from .template import Template

EXACT = 0.005
"""How exact a point is that an artist placed, in eye separations."""
CLEAR, VAGUE = 0.05, 0.1
"""How exact landmarks are: margins of lids and lips, and corners of eyes."""
SLACK = 0.07
"""How exactly the average face, once bent, meets the surface."""
ROUNDS = 3
"""Of looking for the nearest surface."""
AGREEMENT = 0.4
"""Smallest dot product of two normals that agree."""
REACH = 0.3
"""How far the surface may be, in eye separations."""
EASE = 0.01
"""Differences of so many eye separations are no bending."""
TRUSTED = 0.1
"""Distance at which a place of the surface counts half."""


@dataclass(frozen=True, eq=False)
class FaceFit:
    """Where the points of a template lie on a head, before they are put on its surface.

    Attributes
    ----------
    pose : takes the template to the head.
    differences : (N, 3) by which the head differs from the template, in the template's axes and units.
    """

    template: Template
    pose: Similarity
    differences: FloatArray

    @property
    def places(self) -> FloatArray:
        """(N, 3) on the head."""
        return self.pose.apply(self.template.places + self.differences)

    @property
    def bending(self) -> float:
        """Mean square of the differences, in those usual among faces: 0 for the average face, hardly above 0.1."""
        flat = self.differences.ravel()
        system = self.template.covariance + EASE**2 * np.eye(len(flat))
        return float(flat @ np.linalg.solve(system, flat)) / len(self.differences)

    @property
    def normals(self) -> FloatArray:
        """(N, 3) outwards, on the head."""
        return self.template.normals @ self.pose.rotation.T


def fit_face(
    template: Template,
    pose: Similarity,
    rows: IntArray,
    places: FloatArray,
    exactness: FloatArray,
    samples: SurfaceSamples,
) -> FaceFit:
    """Lay a template on a head: a Gaussian process whose observations are the known points and the surface.

    Known points give all three coordinates; every other point tells only how far the surface lies from it along its
    normal, with less weight the farther it is.

    Parameters
    ----------
    pose : takes the template to the head.
    rows : (P,) of the known points in the template.
    places : (P, 3) where they are.
    exactness : (P,) how far they may be off, in eye separations.
    samples : of the head's skin.

    References
    ----------
    Rasmussen and Williams 2006, equations (2.25) and (2.26); Luethi et al. 2017 for faces.
    """
    known = pose.inverse.apply(places) - template.places[rows]
    columns = (3 * rows[:, None] + np.arange(3)).ravel()
    among = template.covariance[np.ix_(columns, columns)]
    exact = np.repeat(exactness**2, 3)
    differences = _condition(template.covariance[:, columns], among, exact, known.ravel())
    fit = FaceFit(template, pose, differences)
    free = np.setdiff1d(np.arange(len(template.names)), rows)
    for _ in range(ROUNDS):
        fit = FaceFit(template, pose, _towards_surface(fit, free, columns, known, exact, samples))
    return fit


def _condition(cross_covariance: FloatArray, covariance: FloatArray, slack: FloatArray, seen: FloatArray) -> FloatArray:
    """(N, 3) the mean of the differences once some have been seen: K* (K + slack)^-1 y."""
    solved = np.linalg.solve(covariance + np.diag(slack), seen)
    mean: FloatArray = (cross_covariance @ solved).reshape(-1, 3)
    return mean


def _towards_surface(
    fit: FaceFit,
    free: IntArray,
    columns: IntArray,
    known: FloatArray,
    exact: FloatArray,
    samples: SurfaceSamples,
) -> FloatArray:
    """(N, 3) differences that know where the surface lies next to the points that are free."""
    template, pose = fit.template, fit.pose
    found = samples.ahead(fit.places[free], fit.normals[free], AGREEMENT, REACH * pose.scale)
    rows, outwards = free[found.met], template.normals[free[found.met]]
    away = found.offset[found.met] / pose.scale
    seen = np.einsum("pi,pi->p", fit.differences[rows], outwards) + away
    # Columns of the covariance that belong to what is seen: the known coordinates, then along the normals.
    count = len(template.names)
    along = np.einsum("npk,pk->np", template.covariance.reshape(3 * count, count, 3)[:, rows], outwards)
    cross_covariance = np.concatenate([template.covariance[:, columns], along], axis=1)
    of_normals = np.einsum("pkn,pk->pn", cross_covariance.reshape(count, 3, -1)[rows], outwards)
    covariance = np.concatenate([cross_covariance[columns], of_normals])
    slack = np.concatenate([exact, SLACK**2 * (1 + (away / TRUSTED) ** 2)])
    return _condition(cross_covariance, covariance, slack, np.concatenate([known.ravel(), seen]))
