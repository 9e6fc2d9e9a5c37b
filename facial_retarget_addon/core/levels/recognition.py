"""Meshes that are subdivided already: the base and the steps that their faces come from."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import IntArray
from ..mesh import TriMesh
from .half_edges import HalfEdges
from .subdivision import Level, Scheme

_CENTRE = 3
"""Code of a face between three new vertices; others have the corner that is an old vertex."""


@dataclass(frozen=True, eq=False)
class Recognised:
    """A mesh of subdivision connectivity.

    Attributes
    ----------
    order : (N,) the mesh's vertices, in the order of the finest level: the base's first.
    base_faces : (F, 3) over the first base_count of them.
    base_count : number of base vertices.
    steps : one per level, with the same faces as the mesh.
    """

    order: IntArray
    base_faces: IntArray
    base_count: int
    steps: tuple[Level, ...]


def recognise(faces: IntArray, vertex_count: int, levels: int, scheme: Scheme) -> Recognised | None:
    """The base of a mesh whose faces were split in four, once or more, as coarse as can be; None where there is none.

    A face split in four has a centre between three new vertices and three corners with one old vertex each. What one
    face is decides what its neighbours are, so there are four ways at most to read a connected mesh.

    Parameters
    ----------
    faces : (F, 3) of one component.
    vertex_count : of the whole mesh.
    levels : at most so many are undone.
    scheme : of the steps.

    References
    ----------
    Taubin 2002 (Detecting and reconstructing subdivision connectivity), in other words.
    """
    splits = _splits(faces, vertex_count, levels)
    if not splits:
        return None
    order = np.unique(splits[-1].faces)
    base_faces, base_count = np.searchsorted(order, splits[-1].faces), len(order)
    steps: list[Level] = []
    coarse, count = base_faces, base_count
    for split in reversed(splits):
        step = scheme(coarse, count)
        steps.append(step)
        order = np.concatenate([order, split.between(order[step.parents], vertex_count)])
        coarse, count = step.faces, step.vertex_count
    return Recognised(order, base_faces, base_count, tuple(steps))


@dataclass(frozen=True, eq=False)
class _Split:
    """One level undone: coarse faces (F / 4, 3) and the new vertices on their edges ab, bc and ca (F / 4, 3)."""

    faces: IntArray
    middles: IntArray

    def _keys(self, ends: IntArray, vertex_count: int) -> IntArray:
        low, high = ends.min(axis=-1), ends.max(axis=-1)
        keys: IntArray = low * vertex_count + high
        return keys

    def _table(self, vertex_count: int) -> tuple[IntArray, IntArray]:
        """Edges as sorted keys, and their new vertices; an edge of two faces stands there twice."""
        ends = self.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        keys = self._keys(ends, vertex_count)
        order = np.argsort(keys, kind="stable")
        return keys[order], self.middles.ravel()[order]

    def sound(self, vertex_count: int) -> bool:
        """Whether each coarse edge has one new vertex, and each new vertex one coarse edge."""
        keys, middles = self._table(vertex_count)
        same_edge, by_vertex = keys[1:] == keys[:-1], np.argsort(middles, kind="stable")
        same_vertex = middles[by_vertex][1:] == middles[by_vertex][:-1]
        one_vertex = (middles[1:] == middles[:-1])[same_edge].all()
        one_edge = (keys[by_vertex][1:] == keys[by_vertex][:-1])[same_vertex].all()
        return bool(one_vertex and one_edge)

    def between(self, ends: IntArray, vertex_count: int) -> IntArray:
        """(E,) the new vertex on each coarse edge (E, 2)."""
        keys, middles = self._table(vertex_count)
        found: IntArray = middles[np.searchsorted(keys, self._keys(ends, vertex_count))]
        return found


def _splits(faces: IntArray, vertex_count: int, levels: int) -> list[_Split]:
    """As many splits undone as can be, the finest first."""
    if levels == 0 or len(faces) % 4 or not len(faces):
        return []
    mesh = TriMesh(np.zeros((vertex_count, 3)), faces)
    if not mesh.is_edge_manifold:
        return []
    half = HalfEdges(mesh)
    best: list[_Split] = []
    for seed in (_CENTRE, 0, 1, 2):
        split = _undo(faces, half, seed, vertex_count)
        if split is not None:
            found = [split, *_splits(split.faces, vertex_count, levels - 1)]
            best = max(best, found, key=len)
    return best


def _undo(faces: IntArray, half: HalfEdges, seed: int, vertex_count: int) -> _Split | None:
    """The split whose face 0 has the code `seed`; None if some face contradicts it."""
    codes = np.full(len(faces), -1, np.int64)
    codes[0] = seed
    front = np.array([0])
    while len(front):
        sides = (3 * front[:, None] + np.arange(3)).ravel()
        sides = sides[half.twin[sides] >= 0]
        told, across = _codes_across(codes, half, sides), half.twin[sides] // 3
        fresh = codes[across] < 0
        codes[across[fresh]] = told[fresh]
        front = np.unique(across[fresh])
    every = np.arange(3 * len(faces))
    inside = every[half.twin >= 0]
    border = every[half.twin < 0]
    old_end = (codes[border // 3] == border % 3) | (codes[border // 3] == (border % 3 + 1) % 3)
    agrees = _codes_across(codes, half, inside) == codes[half.twin[inside] // 3]
    centres = np.flatnonzero(codes == _CENTRE)
    if (codes < 0).any() or not agrees.all() or not old_end.all() or 4 * len(centres) != len(faces):
        return None
    # Centre (ab, bc, ca): a lies across ca-ab, b across ab-bc, c across bc-ca.
    across = half.opposite(half.twin[3 * centres[:, None] + np.array([2, 0, 1])])
    split = _Split(across, faces[centres])
    old = np.zeros(vertex_count, bool)
    old[across] = True
    clean = not old[faces[centres]].any() and split.sound(vertex_count)
    return split if clean else None


def _codes_across(codes: IntArray, half: HalfEdges, sides: IntArray) -> IntArray:
    """What half-edges and their own faces say about the faces across."""
    own, corner, there = codes[sides // 3], sides % 3, half.twin[sides] % 3
    told = np.where(own == corner, (there + 1) % 3, there)
    told = np.where(own == _CENTRE, (there + 2) % 3, told)
    return np.where(own == (corner + 2) % 3, _CENTRE, told)
