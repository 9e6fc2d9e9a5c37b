"""The artist's examples steer a plain carry: what they add to it, where, and in what frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import scipy.sparse as sp
from scipy.spatial import cKDTree

from ..arrays import FloatArray
from .examples import ExampleWeights, fit_example_weights

SPREAD = 0.12  # how far a base vertex's weights reach over the target, in eye separations
GAIN_REACH = 0.3  # neighbourhood over which the artist's strength is learned, in eye separations
GAIN_TRUST = 0.03  # energy, as a share of the strongest region's, below which the strength stays 1
STRONGEST = 2.0  # the learned strength's upper bound


class ExamplePairs(NamedTuple):
    """Examples on both faces: base (M, B, 3) source displacements of the base, source displacements
    carried plainly (M, V, 3), and the artist's target displacements (M, V, 3).
    """

    base: FloatArray
    carried: FloatArray
    wanted: FloatArray

    def without(self, m: int) -> ExamplePairs:
        """All but one."""
        return ExamplePairs(*(np.delete(part, m, axis=0) for part in self))


@dataclass(frozen=True, eq=False)
class ExampleResiduals:
    """y = G (p - sum_m W_m p_m) + sum_m W_m t_m: what the examples explain comes from the artist.

    p is the plain carry of a frame, p_m that of source example m, t_m the artist's example, W the
    weights of the examples, and G the strength of the artist's examples against their plain carry:
    what no example explains is as strong as the artist made the rest. No motion gives exactly none.

    Attributes
    ----------
    weights : weights of the examples at the base vertices.
    spread : (V, B) csr float32: base values to the target's vertices, rows adding up to 1.
    strength : (V, 1) float32, G.
    residual : (M, V, 3) float32, t_m - G p_m.
    """

    weights: ExampleWeights
    spread: sp.csr_matrix
    strength: FloatArray
    residual: FloatArray

    def steer(self, carried: FloatArray, base: FloatArray) -> FloatArray:
        """Displacements (F, V, 3) float32 for carried ones (F, V, 3) and the source base's (F, B, 3)."""
        weights = self.weights(base)
        frames, count, size = weights.shape
        at_base = weights.transpose(1, 0, 2).reshape(count, frames * size).astype(np.float32)
        local = (self.spread @ at_base).reshape(-1, frames, size)
        steered: FloatArray = carried * self.strength
        added = np.empty_like(steered)
        for share, residual in zip(np.ascontiguousarray(local.transpose(2, 1, 0)), self.residual, strict=True):
            np.multiply(share[:, :, None], residual, out=added)
            steered += added
        return steered


class ExampleRegions:
    """What stays the same for every set of examples of one pair: neighbourhoods on both faces.

    Parameters
    ----------
    source_base, target_base : (B, 3) neutral base vertices on both faces.
    source_separation, target_separation : between the eyes, in each face's units.
    target, target_areas : (V, 3) neutral vertices and (V,) their areas.
    """

    def __init__(
        self,
        source_base: FloatArray,
        source_separation: float,
        target_base: FloatArray,
        target: FloatArray,
        target_areas: FloatArray,
        target_separation: float,
    ) -> None:
        self._source_base, self._source_separation = source_base, source_separation
        self._areas = target_areas
        self._spread = spread_matrix(target, target_base, SPREAD * target_separation)
        squared = np.square(target_base[:, None] - target).sum(axis=2)
        self._near = np.exp(-squared / (2 * (GAIN_REACH * target_separation) ** 2))

    def fit(self, pairs: ExamplePairs, trust: float = 1.0) -> ExampleResiduals:
        """Learn from examples; `trust` is how far they steer, from 0 (the plain carry) to 1."""
        weights = fit_example_weights(self._source_base, pairs.base, self._source_separation)
        strength = (1 + trust * ((self._spread @ self._strength(pairs)) - 1)).astype(np.float32)[:, None]
        residual = (trust * pairs.wanted + (1 - trust) * pairs.carried - strength * pairs.carried).astype(np.float32)
        return ExampleResiduals(weights, self._spread.astype(np.float32), strength, residual)

    def leave_one_out(self, pairs: ExamplePairs, m: int, trust: float = 1.0) -> FloatArray:
        """(V, 3) what the other examples make of example m."""
        others = self.fit(pairs.without(m), trust)
        predicted: FloatArray = others.steer(pairs.carried[m : m + 1].astype(np.float32), pairs.base[m : m + 1])[0]
        return predicted

    def _strength(self, pairs: ExamplePairs) -> FloatArray:
        """(B,) least-squares factor from carried examples to wanted ones around each base vertex."""
        both = np.einsum("mvc,mvc,v->v", pairs.carried, pairs.wanted, self._areas)
        own = np.einsum("mvc,mvc,v->v", pairs.carried, pairs.carried, self._areas)
        energy, match = self._near @ own, self._near @ both
        prior = GAIN_TRUST * energy.max(initial=0.0)
        if prior <= 0:
            return np.ones(len(energy))
        factor: FloatArray = np.clip((match + prior) / (energy + prior), 0.0, STRONGEST)
        return factor


def spread_matrix(places: FloatArray, base: FloatArray, reach: float) -> sp.csr_matrix:
    """(V, B) Gaussian weights of the nearest base vertices at each place, rows adding up to 1."""
    nearest = min(8, len(base))
    distance, column = cKDTree(base).query(places, k=np.arange(1, nearest + 1))
    weight = np.exp((distance[:, :1] ** 2 - distance**2) / (2 * reach**2))
    weight /= weight.sum(axis=1, keepdims=True)
    row = np.repeat(np.arange(len(places)), nearest)
    return sp.csr_matrix((weight.ravel(), (row, column.ravel())), shape=(len(places), len(base)))
