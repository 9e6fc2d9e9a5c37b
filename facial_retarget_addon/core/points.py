"""Feature points: named places on a surface."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from .arrays import FloatArray, IntArray
from .errors import RetargetError


@dataclass(frozen=True, eq=False)
class FeaturePoints:
    """Named places on a surface: MPEG-4 FDP numbers where one exists, free names otherwise.

    Attributes
    ----------
    names : (P,) unique names.
    vertices : (P, 3) int64, the vertices that hold each point.
    weights : (P, 3) float64, their barycentric weights, each row adding up to 1.
    """

    names: tuple[str, ...]
    vertices: IntArray
    weights: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "names", tuple(self.names))
        object.__setattr__(self, "vertices", np.asarray(self.vertices, np.int64).reshape(-1, 3))
        object.__setattr__(self, "weights", np.asarray(self.weights, np.float64).reshape(-1, 3))
        if not len(self.names) == len(self.vertices) == len(self.weights):
            raise RetargetError(
                f"feature points: {len(self.names)} names, {len(self.vertices)} places and "
                f"{len(self.weights)} weights arrived, expected as many of each"
            )
        seen: set[str] = set()
        for name in self.names:
            if name in seen:
                raise RetargetError(f"feature point {name!r} appears twice, expected unique names")
            seen.add(name)

    @classmethod
    def none(cls) -> FeaturePoints:
        """No points."""
        return cls((), np.empty((0, 3), np.int64), np.empty((0, 3)))

    def __len__(self) -> int:
        return len(self.names)

    @property
    def holders(self) -> IntArray:
        """(P,) the vertex nearest to each point: of those that hold it, the one with the most weight."""
        holders: IntArray = self.vertices[np.arange(len(self)), self.weights.argmax(axis=1)]
        return holders

    def index(self, names: Iterable[str]) -> IntArray:
        """Row of each name; RetargetError names those that are missing."""
        row = {name: i for i, name in enumerate(self.names)}
        wanted = list(names)
        missing = [name for name in wanted if name not in row]
        if missing:
            raise RetargetError(f"feature points {', '.join(map(repr, missing))} are missing")
        return np.array([row[name] for name in wanted], np.int64)

    def subset(self, names: Sequence[str]) -> FeaturePoints:
        """The points of these names, in this order."""
        rows = self.index(names)
        return FeaturePoints(tuple(names), self.vertices[rows], self.weights[rows])

    def joined(self, other: FeaturePoints) -> FeaturePoints:
        """These points, then the other's."""
        return FeaturePoints(
            self.names + other.names,
            np.concatenate([self.vertices, other.vertices]),
            np.concatenate([self.weights, other.weights]),
        )

    def matrix(self, vertex_count: int) -> sp.csr_matrix:
        """(P, vertex_count) matrix that takes vertex values to point values."""
        return place_matrix(self.vertices, self.weights, vertex_count)

    def positions(self, vertices: FloatArray) -> FloatArray:
        """Places of the points on positions (..., V, 3), as (..., P, 3)."""
        places: FloatArray = np.einsum("pk,...pkc->...pc", self.weights, vertices[..., self.vertices, :])
        return places


def place_matrix(corners: IntArray, weights: FloatArray, vertex_count: int) -> sp.csr_matrix:
    """(N, vertex_count) matrix that takes vertex values to values at N places.

    Parameters
    ----------
    corners : (N, K) vertices of each place.
    weights : (N, K) their weights.
    """
    rows = np.repeat(np.arange(len(corners)), corners.shape[1])
    shape = (len(corners), vertex_count)
    matrix = sp.csr_matrix((weights.ravel(), (rows, corners.ravel())), shape=shape)
    matrix.sum_duplicates()
    return matrix


def common_names(source: FeaturePoints, target: FeaturePoints) -> list[str]:
    """Names that both faces have, in the source's order."""
    on_target = set(target.names)
    return [name for name in source.names if name in on_target]
