"""Rigid motions and similarities between matched points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import FloatArray
from .errors import RetargetError


@dataclass(frozen=True, eq=False)
class Similarity:
    """The map x -> scale * rotation @ x + translation.

    Attributes
    ----------
    scale : target units per source unit, greater than zero.
    rotation : (3, 3) proper rotation.
    translation : (3,) in target units.
    """

    scale: float
    rotation: FloatArray
    translation: FloatArray

    def apply(self, points: FloatArray) -> FloatArray:
        """Positions (..., 3) mapped."""
        mapped: FloatArray = self.turn(points) + self.translation
        return mapped

    def turn(self, displacements: FloatArray) -> FloatArray:
        """Displacements (..., 3) turned and scaled, not moved."""
        turned: FloatArray = np.asarray(displacements) @ (self.scale * self.rotation).T
        return turned

    @property
    def inverse(self) -> Similarity:
        """The map back."""
        rotation = self.rotation.T
        return Similarity(1 / self.scale, rotation, -(rotation @ self.translation) / self.scale)


def fit_similarity(source_positions: FloatArray, target_positions: FloatArray, scale: bool = True) -> Similarity:
    """Similarity that takes source positions to target positions with the least squared error.

    Parameters
    ----------
    source_positions, target_positions : (P, 3) matched positions, at least 3 of them, not on one line.
    scale : whether the size may change; otherwise the scale is 1.

    Raises
    ------
    RetargetError : for fewer than 3 positions, shapes that differ, values that are not finite, or positions on one
        line, which leave the rotation open.

    References
    ----------
    Umeyama 1991, equations (40) to (42); Kabsch 1976.
    """
    source = np.asarray(source_positions, np.float64)
    target = np.asarray(target_positions, np.float64)
    if source.shape != target.shape or source.ndim != 2 or source.shape[1] != 3 or len(source) < 3:
        raise RetargetError(
            f"alignment: positions of shape {source.shape} and {target.shape} arrived, "
            "expected two of (P, 3) with P at least 3"
        )
    if not (np.isfinite(source).all() and np.isfinite(target).all()):
        raise RetargetError("alignment: some positions are NaN or infinite, expected finite positions")
    p, q = source - source.mean(axis=0), target - target.mean(axis=0)
    for what, centred in (("source", p), ("target", q)):
        spread = np.linalg.svd(centred, compute_uv=False)
        if spread[1] <= 1e-6 * max(spread[0], 1e-300):
            raise RetargetError(
                f"alignment: the {len(centred)} {what} positions lie on one line or in one place, "
                "expected positions spread over a face"
            )
    rotation, singular = closest_rotations(q.T @ p)
    size = float(singular.sum() / np.einsum("ij,ij->", p, p)) if scale else 1.0
    return Similarity(size, rotation, target.mean(axis=0) - size * rotation @ source.mean(axis=0))


def closest_rotations(correlations: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Rotations R that make the traces of R^T C as large as they can be.

    Parameters
    ----------
    correlations : (..., 3, 3) sums over matched positions of target times source, each about its centre.

    Returns
    -------
    (..., 3, 3) proper rotations that take the source to the target, and the (..., 3) singular values of the
    correlations, largest first, the last one negative where a mirror image fits better. Where the second is zero, the
    positions lie on one line and the rotation is open.

    References
    ----------
    Umeyama 1991, equation (40); Kabsch 1976.
    """
    u, singular, vt = np.linalg.svd(correlations)
    sign = np.ones_like(singular)
    sign[..., 2] = np.sign(np.linalg.det(u) * np.linalg.det(vt))
    return (u * sign[..., None, :]) @ vt, singular * sign


def fit_rigid(source_positions: FloatArray, target_positions: FloatArray) -> Similarity:
    """Rotation and translation that take source positions to target positions: the motion of a head.

    See `fit_similarity`; the scale is 1.
    """
    return fit_similarity(source_positions, target_positions, scale=False)
