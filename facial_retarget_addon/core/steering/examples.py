"""Which example expressions a frame is made of, vertex by vertex of the base mesh.

The displacement of one vertex does not tell which expression it belongs to; that of its
neighbourhood does. So the input at base vertex i is the whole base mesh's motion, weighted by a
Gaussian around i, and the distance between two such inputs is
|q_i - z_i|² = sum_j g_ij |d_j - s_j|²: one product with the matrix g.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from .rbf import multiquadric

NEIGHBOURHOOD = 0.35  # standard deviation of the neighbourhood, in eye separations
LOCALITY = 1.0  # multiquadric c, as a share of the mean distance between the examples
SMOOTHING = 0.01  # how far the maps may miss an example, as a share of c
RIDGE = 0.02  # cost of a weight in the non-negative fit, as a share of the examples' mean energy
LEAST_ENERGY = 0.1  # energy, as a share of the strongest region's, that the ridge is made for at least
SWEEPS = 40  # coordinate-descent sweeps of the non-negative fit


@dataclass(frozen=True, eq=False)
class ExampleWeights:
    """Weights of M examples at B base vertices for any motion of the base.

    Attributes
    ----------
    gaussian : (B, B) g, rows adding up to 1.
    examples : (M, B, 3) source displacements of the base in the examples; neutral is not among them.
    locality : (B,) multiquadric c at each base vertex, in source units.
    solve : (B, M + 1, M) from multiquadrics to cardinal weights.
    at_rest : (B, M) cardinal weights at no motion, to be taken off.
    gram : (B, M, M) inner products of the examples, ridge included.
    """

    gaussian: FloatArray
    examples: FloatArray
    locality: FloatArray
    solve: FloatArray
    at_rest: FloatArray
    gram: FloatArray

    def __call__(self, displacements: FloatArray) -> FloatArray:
        """Weights (F, B, M) of base displacements (F, B, 3) in source units; exactly 0 for no motion.

        The mean of two ways: multiquadric cardinal functions, which meet single expressions best,
        and a non-negative fit, which does not run wild on long performances.
        """
        weights: FloatArray = 0.5 * (self.cardinal(displacements) + self.non_negative(displacements))
        weights[~displacements.any(axis=(1, 2))] = 0.0
        return weights

    def cardinal(self, displacements: FloatArray) -> FloatArray:
        """Multiquadric cardinal weights (F, B, M): 1 at their own example, 0 at the others and at rest."""
        centres = np.concatenate([np.zeros_like(self.examples[:1]), self.examples])
        squared = np.square(displacements[:, None] - centres).sum(axis=3)
        distance = np.sqrt(np.einsum("ij,fmj->fim", self.gaussian, squared, optimize=True))
        h = multiquadric(distance, self.locality[:, None])
        weights: FloatArray = np.einsum("fbk,bkm->fbm", h, self.solve) - self.at_rest
        return weights

    def non_negative(self, displacements: FloatArray) -> FloatArray:
        """Weights (F, B, M) >= 0 of the examples that together come closest to the motion."""
        match = np.einsum("fjc,mjc->fmj", displacements, self.examples, optimize=True)
        match = np.einsum("ij,fmj->fim", self.gaussian, match, optimize=True)
        return non_negative_least_squares(self.gram, match)


def fit_example_weights(base: FloatArray, examples: FloatArray, eye_separation: float) -> ExampleWeights:
    """Prepare example weights.

    Parameters
    ----------
    base : (B, 3) neutral base vertices of the source.
    examples : (M, B, 3) displacements of the base in the examples, in source units.
    eye_separation : in source units.

    References
    ----------
    Na and Jung 2004, 4.1, with neighbourhoods in place of single vertices; Pyun et al. 2003 for cardinal weights.
    """
    squared = np.square(base[:, None] - base).sum(axis=2)
    gaussian = np.exp(-squared / (2 * (NEIGHBOURHOOD * eye_separation) ** 2))
    gaussian /= gaussian.sum(axis=1, keepdims=True)

    centres = np.concatenate([np.zeros_like(examples[:1]), examples])
    count = len(centres)
    between = np.square(centres[:, None] - centres).sum(axis=3)
    distance = np.sqrt(np.einsum("ij,mnj->imn", gaussian, between))
    mean_distance = distance.sum(axis=(1, 2)) / max(count * (count - 1), 1)
    # A region that no example moves gets weights 0: its locality only has to be a positive length.
    still = mean_distance <= 1e-6 * eye_separation
    locality = LOCALITY * np.where(still, eye_separation, mean_distance)
    h = multiquadric(distance, locality[:, None, None])
    rest = h[:, 0].copy()
    system = np.zeros((len(base), count + 1, count + 1))
    system[:, :count, :count] = h - SMOOTHING * locality[:, None, None] * np.eye(count)
    system[:, :count, count] = system[:, count, :count] = locality[:, None]
    inverse = np.linalg.pinv(system, rcond=1e-6)
    # Row k of `solve`: what basis function k gives to each example; the constant cancels against rest.
    solve = np.where(still[:, None, None], 0.0, inverse[:, :count, 1:count])
    at_rest = np.einsum("bk,bkm->bm", rest, solve)

    gram = np.einsum("ij,mjc,njc->imn", gaussian, examples, examples, optimize=True)
    energy = np.einsum("imm->i", gram) / max(len(examples), 1)
    # Where the examples hardly move, a frame that moves must not be made of many times an example.
    ridge = RIDGE * np.maximum(energy, LEAST_ENERGY * energy.max(initial=0.0))
    gram = gram + ridge[:, None, None] * np.eye(len(examples))
    return ExampleWeights(gaussian, examples, locality, solve, at_rest, gram)


def non_negative_least_squares(gram: FloatArray, match: FloatArray) -> FloatArray:
    """Minimise ½ w'Gw - m'w over w >= 0, for every frame and vertex at once, by coordinate descent.

    Parameters
    ----------
    gram : (B, M, M) symmetric positive (semi-)definite.
    match : (F, B, M).

    Returns
    -------
    (F, B, M). A coordinate without energy (gram diagonal 0) gets 0.
    """
    # Example by example in memory, and nothing made anew: a frame alone is so small that this takes half the time.
    by_example = np.ascontiguousarray(np.moveaxis(match, 2, 0))
    weights, gradient = np.zeros_like(by_example), -by_example
    diagonal = np.einsum("bmm->mb", gram)
    minus_step = np.divide(-1.0, diagonal, out=np.zeros_like(diagonal), where=diagonal > 0)
    rows = np.ascontiguousarray(gram.transpose(1, 2, 0))[:, :, None]
    slope, change, least = np.empty_like(by_example), np.empty(match.shape[:2]), np.empty(match.shape[:2])
    for _ in range(SWEEPS):
        for weight, downhill, step, row in zip(weights, gradient, minus_step, rows, strict=True):
            np.multiply(downhill, step, out=change)
            np.negative(weight, out=least)
            np.maximum(change, least, out=change)
            weight += change
            np.multiply(row, change, out=slope)
            gradient += slope
    return np.ascontiguousarray(np.moveaxis(weights, 0, 2))
