"""Figures of each vertex of a face that moves: what a heat map shows."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .arrays import FloatArray, IntArray
from .defects import edge_stretch
from .mesh import TriMesh
from .rigid import Similarity, fit_similarity


def vertex_stretch(mesh: TriMesh, positions: FloatArray) -> FloatArray:
    """(V,) how many times its neutral length the most stretched edge at each vertex has; 1 where none is stretched.

    Parameters
    ----------
    positions : (V, 3) of the moved face.
    """
    most = np.ones(len(mesh.vertices))
    stretch = edge_stretch(mesh, positions)
    for end in mesh.edges.T:
        np.maximum.at(most, end, stretch)
    return most


@dataclass(frozen=True, eq=False)
class Compared:
    """A target that moves beside its source.

    Attributes
    ----------
    source, target : neutral faces.
    counterpart : (Vt,) the source vertex nearest to each target vertex's counterpart, -1 for none.
    """

    source: TriMesh
    target: TriMesh
    counterpart: IntArray

    @cached_property
    def similarity(self) -> Similarity:
        """What takes the source's neutral to the target's: size and direction of the heads.

        Raises
        ------
        RetargetError : where fewer than 3 vertices have a counterpart, or they lie on one line.
        """
        known = self.counterpart >= 0
        return fit_similarity(self.source.vertices[self.counterpart[known]], self.target.vertices[known])

    def stretch_beyond(self, source: FloatArray, target: FloatArray) -> FloatArray:
        """(Vt,) stretch of the target over the source's at the counterpart, 1 where it is not more; NaN without one.

        Parameters
        ----------
        source, target : positions (Vs, 3) and (Vt, 3) at the same moment.
        """
        ours = vertex_stretch(self.source, source)[self.counterpart]
        beyond: FloatArray = np.maximum(vertex_stretch(self.target, target) / ours, 1.0)
        return np.where(self.counterpart >= 0, beyond, np.nan)

    def motion_difference(self, source: FloatArray, target: FloatArray) -> FloatArray:
        """(Vt,) how far a vertex is from where its counterpart's motion, turned and scaled as the heads are, would take
        it, in percent of the target's size; NaN without a counterpart.

        A method that fits the motion to other proportions differs on purpose: this is a difference, not an error.
        The parameters are those of `stretch_beyond`.
        """
        wanted = self.similarity.turn((source - self.source.vertices)[self.counterpart])
        gap = np.linalg.norm(target - self.target.vertices - wanted, axis=1)
        return np.where(self.counterpart >= 0, 100 * gap / self.target.size, np.nan)
