"""Analysis and synthesis by subdivision wavelets: predict new vertices from old ones, then update the old ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray, IntArray
from ..binding import multiply
from ..errors import RetargetError
from ..levels.subdivision import Level
from ..levels.vertex_neighbours import adjacency
from ..mesh import TriMesh
from .inner_products import inner_products

DISC = 2
"""Edges around a new vertex's edge whose scaling functions its wavelet is made orthogonal to."""

_BATCH = 4096


class Filters(NamedTuple):
    """Analysis filters a (V, V'), b (E, V') and synthesis filters p (V', V), q (V', E), all csr."""

    a: sp.csr_matrix
    b: sp.csr_matrix
    p: sp.csr_matrix
    q: sp.csr_matrix


@dataclass(frozen=True, eq=False)
class Lift:
    """One level: V' = V + E fine vertices, the old ones first.

    Attributes
    ----------
    predict : (E, V) csr, N: new vertices from old ones.
    update : (V, E) csr, alpha: what the coefficients give back to the old vertices.

    References
    ----------
    Min and Jung 2005, equation (1), read as P = (I; N), Q = (-alpha; I - N alpha); Sweldens 1996 for the lifting.
    """

    predict: sp.csr_matrix
    update: sp.csr_matrix

    def analyse(self, fine: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Coarse values (V, K) and coefficients (E, K) of fine values (V + E, K)."""
        old, new = fine[: self.predict.shape[1]], fine[self.predict.shape[1] :]
        coefficients = new - multiply(self.predict, old)
        return old + multiply(self.update, coefficients), coefficients

    def synthesise(self, coarse: FloatArray, coefficients: FloatArray) -> FloatArray:
        """Fine values (V + E, K) of coarse values (V, K) and coefficients (E, K)."""
        old = coarse - multiply(self.update, coefficients)
        return np.concatenate([old, coefficients + multiply(self.predict, old)])

    @property
    def filters(self) -> Filters:
        """The four filters as matrices: to look at, since lifting never forms them."""
        predict, update = self.predict, self.update
        old, new = sp.eye(predict.shape[1]), sp.eye(predict.shape[0])
        return Filters(
            sp.hstack([old - update @ predict, update]).tocsr(),
            sp.hstack([-predict, new]).tocsr(),
            sp.vstack([old, predict]).tocsr(),
            sp.vstack([-update, new - predict @ update]).tocsr(),
        )


class Wavelets:
    """Analysis and synthesis over all levels of a base.

    Parameters
    ----------
    lifts : one per level, coarse to fine.
    """

    def __init__(self, lifts: Sequence[Lift]) -> None:
        self.lifts = tuple(lifts)

    def analyse(self, fine: FloatArray) -> list[FloatArray]:
        """Base values (V_0, K) and the coefficients of each level (E_j, K), of values on the finest level (N, K)."""
        parts: list[FloatArray] = []
        for lift in reversed(self.lifts):
            fine, coefficients = lift.analyse(fine)
            parts.append(coefficients)
        return [fine, *reversed(parts)]

    def synthesise(self, parts: Sequence[FloatArray]) -> FloatArray:
        """Values on the finest level (N, K) of a base and coefficients as `analyse` returns them."""
        values = parts[0]
        for lift, coefficients in zip(self.lifts, parts[1:], strict=True):
            values = lift.synthesise(values, coefficients)
        return values

    def single(self) -> Wavelets:
        """The same in single precision, for many frames."""
        return Wavelets([Lift(lift.predict.astype(np.float32), lift.update.astype(np.float32)) for lift in self.lifts])


def wavelets(faces: IntArray, vertex_count: int, steps: Sequence[Level], disc: int = DISC) -> Wavelets:
    """Wavelets that are nearly orthogonal to the scaling functions of their level.

    A new vertex's wavelet is its scaling function minus those of the old vertices within `disc` edges of the ends of
    its edge, so that it is orthogonal to these. The exact wavelet would take all of them, and be dense.

    Parameters
    ----------
    faces, vertex_count : of the base.
    steps : its steps under an interpolating scheme.

    Raises
    ------
    RetargetError : for a scheme that moves old vertices.

    References
    ----------
    Lounsbery, DeRose and Warren 1997, sections 6 and 7.
    """
    _refuse_approximating(steps)
    products = inner_products(faces, vertex_count, steps)
    lifts = []
    for step, coarse, fine in zip(steps, products[:-1], products[1:], strict=True):
        mesh = TriMesh(np.zeros((vertex_count, 3)), faces)
        # Row e: <phi_coarse, phi_fine of new vertex e> for every coarse vertex.
        mixed = (fine[vertex_count:] @ step.matrix).tocsr()
        update = _disc_update(adjacency(mesh), step.parents, coarse, mixed, disc)
        lifts.append(Lift(step.matrix[vertex_count:], update))
        faces, vertex_count = step.faces, step.vertex_count
    return Wavelets(lifts)


def integral_wavelets(faces: IntArray, vertex_count: int, steps: Sequence[Level]) -> Wavelets:
    """Wavelets whose integral is 0, for comparison: the two ends of an edge take back half of it each.

    Raises
    ------
    RetargetError : for a scheme that moves old vertices.

    References
    ----------
    Schroeder and Sweldens 1995.
    """
    _refuse_approximating(steps)
    products = inner_products(faces, vertex_count, steps)
    lifts = []
    for step, coarse, fine in zip(steps, products[:-1], products[1:], strict=True):
        # The scaling functions add up to 1.
        own, new = (np.asarray(one.sum(axis=1)).ravel() for one in (coarse, fine[step.coarse_count :]))
        rows, columns = step.parents.ravel(), np.repeat(np.arange(len(new)), 2)
        values = new[columns] / (2 * own[rows])
        update = sp.csr_matrix((values, (rows, columns)), shape=(step.coarse_count, len(new)))
        lifts.append(Lift(step.matrix[step.coarse_count :], update))
    return Wavelets(lifts)


def _refuse_approximating(steps: Sequence[Level]) -> None:
    if not all(step.interpolating for step in steps):
        raise RetargetError("the subdivision scheme moves old vertices, expected one that keeps them for wavelets")


def _disc_update(
    neighbours: sp.csr_matrix, ends: IntArray, gram: sp.csr_matrix, mixed: sp.csr_matrix, disc: int
) -> sp.csr_matrix:
    """(V, E) csr alpha: column e solves the Gram system of the vertices within `disc` edges of the ends of edge e."""
    count, edges = neighbours.shape[0], len(ends)
    rows = np.repeat(np.arange(edges), 2)
    near = sp.csr_matrix((np.ones(2 * edges), (rows, ends.ravel())), shape=(edges, count))
    for _ in range(disc):
        near = near + near @ neighbours
    near.sort_indices()
    size = np.diff(near.indptr)
    values = np.empty(near.nnz)
    for width in np.unique(size):
        some = np.flatnonzero(size == width)
        for batch in np.array_split(some, -(-len(some) // _BATCH)):
            place = near.indptr[batch][:, None] + np.arange(width)
            members = near.indices[place]
            pairs = np.broadcast_arrays(members[:, :, None], members[:, None, :])
            square = np.asarray(gram[pairs[0].ravel(), pairs[1].ravel()]).reshape(-1, width, width)
            right = np.asarray(mixed[np.repeat(batch, width), members.ravel()]).reshape(-1, width, 1)
            values[place] = np.linalg.solve(square, right)[:, :, 0]
    return sp.csr_matrix((values, near.indices, near.indptr), shape=near.shape).T.tocsr()
