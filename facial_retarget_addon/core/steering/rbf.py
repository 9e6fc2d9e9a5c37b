"""Hardy's multiquadrics: one small map per base vertex, all evaluated in one batch."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import RetargetError


def multiquadric(distance: FloatArray, locality: FloatArray | float) -> FloatArray:
    """h(r) = sqrt(r² + c²); the paper's basis function (Na and Jung 2004, 4.1; Hardy 1971)."""
    values: FloatArray = np.sqrt(distance * distance + np.square(locality))
    return values


@dataclass(frozen=True, eq=False)
class MultiquadricMaps:
    """N maps from displacements to displacements.

    Attributes
    ----------
    centres : (N, M, 3) in source units. Centres that were merged into another keep weight 0.
    locality : (N,) the paper's c, in source units.
    rbf_weights : (N, M, 3) in target units per source unit.
    constant : (N, 3) in target units.
    linear : (N, 3, 3) target displacement = source displacement @ linear.
    """

    centres: FloatArray
    locality: FloatArray
    rbf_weights: FloatArray
    constant: FloatArray
    linear: FloatArray

    def __call__(self, displacements: FloatArray) -> FloatArray:
        """Target displacements (F, N, 3) of source displacements (F, N, 3)."""
        distance = np.linalg.norm(displacements[:, :, None] - self.centres, axis=3)
        h = multiquadric(distance, self.locality[:, None])
        mapped: FloatArray = np.einsum("fnm,nmc->fnc", h, self.rbf_weights)
        mapped += np.einsum("fnk,nkc->fnc", displacements, self.linear) + self.constant
        return mapped

    def turned(self, rotation: FloatArray) -> MultiquadricMaps:
        """These maps, then a rotation (3, 3)."""
        return replace(
            self,
            rbf_weights=self.rbf_weights @ rotation.T,
            constant=self.constant @ rotation.T,
            linear=self.linear @ rotation.T,
        )


def fit_multiquadrics(
    centres: FloatArray, values: FloatArray, tolerance: float, fallback_scale: float, linear: bool = True
) -> MultiquadricMaps:
    """Multiquadric maps that take every example's source displacement to its target displacement.

    The published system (equation 4) lacks the centres and has rank 1; this is Hardy's form, with
    h(|S_k[i] - S_j[i]|). Real example sets nearly always hold coinciding centres on a line or a
    plane, so centres are merged, projected on their span, and solved by SVD.

    Parameters
    ----------
    centres : (N, M, 3) source displacements of the M examples at N base vertices, in source units.
    values : (N, M, 3) target displacements of the same examples, in target units.
    tolerance : centres closer than this, in source units, are one; their values are averaged.
    fallback_scale : target units per source unit: the map of a vertex that no example moves is this
        times the displacement.
    linear : add a linear term in the span of the centres (exact on linear maps); the paper has none.

    Returns
    -------
    MultiquadricMaps. A neutral centre (0) must be among the examples for 0 to be kept at 0.

    Raises
    ------
    RetargetError : if the shapes disagree; the message names both.

    References
    ----------
    Na and Jung 2004, equations (3) and (4); Hardy 1971; Micchelli 1986 on solvability.
    """
    centres, values = np.asarray(centres, np.float64), np.asarray(values, np.float64)
    if centres.shape != values.shape or centres.ndim != 3 or centres.shape[2] != 3:
        raise RetargetError(
            f"multiquadric centres have shape {centres.shape} and values {values.shape}, expected (N, M, 3) twice"
        )
    count, size, _ = centres.shape
    maps = MultiquadricMaps(
        centres, np.zeros(count), np.zeros((count, size, 3)), np.zeros((count, 3)), np.zeros((count, 3, 3))
    )
    for i in range(count):
        _fit_one(maps, i, values[i], tolerance, fallback_scale, linear)
    return maps


def _fit_one(
    maps: MultiquadricMaps, i: int, values: FloatArray, tolerance: float, fallback_scale: float, linear: bool
) -> None:
    """Solve the map of one base vertex into row i."""
    keep, cluster = merge_centres(maps.centres[i], tolerance)
    if len(keep) == 1:
        maps.linear[i] = fallback_scale * np.eye(3)
        return
    count = np.bincount(cluster)
    merged = np.stack([np.bincount(cluster, values[:, k]) / count for k in range(3)], axis=1)
    points = maps.centres[i, keep]
    distance = np.linalg.norm(points[:, None] - points[None], axis=2)
    locality = 0.815 * (distance + np.where(np.eye(len(keep), dtype=bool), np.inf, 0.0)).min(axis=1).mean()
    h = multiquadric(distance, locality)
    if linear:
        span = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)
        axes = span[2][span[1] > tolerance]
        tail = np.concatenate([np.ones((len(keep), 1)), points @ axes.T], axis=1)
        h -= 1e-6 * locality * len(keep) * np.eye(len(keep))
        width = tail.shape[1]
        system = np.block([[h, tail], [tail.T, np.zeros((width, width))]])
        solved = np.linalg.pinv(system, rcond=1e-10) @ np.concatenate([merged, np.zeros((width, 3))])
        maps.constant[i] = solved[len(keep)]
        maps.linear[i] = axes.T @ solved[len(keep) + 1 :]
        solved = solved[: len(keep)]
    else:
        solved = np.linalg.pinv(h, rcond=1e-10) @ merged
    maps.locality[i] = locality
    maps.rbf_weights[i, keep] = solved


def merge_centres(centres: FloatArray, tolerance: float) -> tuple[IntArray, IntArray]:
    """Centres (M, 3) that stand for all, and the cluster (M,) of each.

    A centre joins the first kept one within `tolerance`; kept ones are rows of `centres`.
    """
    keep: list[int] = []
    cluster = np.empty(len(centres), np.int64)
    for m, centre in enumerate(centres):
        near = [k for k, j in enumerate(keep) if np.linalg.norm(centres[j] - centre) <= tolerance]
        if near:
            cluster[m] = near[0]
        else:
            cluster[m] = len(keep)
            keep.append(m)
    return np.array(keep, np.int64), cluster
