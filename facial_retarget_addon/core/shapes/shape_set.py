"""A set of shapes of one head: names, and how far each one takes every vertex."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import RetargetError


@dataclass(frozen=True, eq=False)
class ShapeSet:
    """Named shapes at full strength.

    Attributes
    ----------
    names : (E,) unique.
    displacements : (E, V, 3) float32 from the neutral face, in the object's units.
    """

    names: tuple[str, ...]
    displacements: FloatArray

    def __post_init__(self) -> None:
        names, moves = tuple(self.names), np.asarray(self.displacements, np.float32)
        if moves.ndim != 3 or moves.shape[2] != 3 or len(moves) != len(names):
            raise RetargetError(
                f"shapes: {len(names)} names and displacements of shape {moves.shape} arrived, "
                f"expected displacements of shape ({len(names)}, V, 3)"
            )
        seen: set[str] = set()
        for name, move in zip(names, moves, strict=True):
            if name in seen:
                raise RetargetError(f"shape {name!r} appears twice, expected unique names")
            seen.add(name)
            bad = np.flatnonzero(~np.isfinite(move).all(axis=1))
            if len(bad):
                raise RetargetError(
                    f"shape {name!r} has {len(bad)} vertices that are NaN or infinite, the first is vertex {bad[0]}; "
                    "expected finite positions"
                )
        object.__setattr__(self, "names", names)
        object.__setattr__(self, "displacements", moves)

    @classmethod
    def of_positions(cls, neutral: FloatArray, shapes: Mapping[str, FloatArray]) -> ShapeSet:
        """Shapes given as positions (V, 3) by name, of a neutral face (V, 3).

        A vertex that stands where the neutral's does, as float32, does not move at all.

        Raises
        ------
        RetargetError : for a shape of another vertex count; names it.
        """
        rest = np.asarray(neutral).astype(np.float32)
        for name, positions in shapes.items():
            if np.shape(positions) != rest.shape:
                raise RetargetError(f"shape {name!r} has shape {np.shape(positions)}, expected {rest.shape}")
        moves = np.empty((len(shapes), *rest.shape), np.float32)
        for row, positions in enumerate(shapes.values()):
            moves[row] = np.asarray(positions).astype(np.float32) - rest
        return cls(tuple(shapes), moves)

    def __len__(self) -> int:
        return len(self.names)

    def __getitem__(self, name: str) -> FloatArray:
        """(V, 3) displacements of one shape."""
        moves: FloatArray = self.displacements[self.rows([name])[0]]
        return moves

    def rows(self, names: Sequence[str]) -> IntArray:
        """Row of each name; RetargetError names those that are missing."""
        row = {name: i for i, name in enumerate(self.names)}
        missing = [name for name in names if name not in row]
        if missing:
            raise RetargetError(f"shapes {', '.join(map(repr, missing))} are missing")
        return np.array([row[name] for name in names], np.int64)

    def subset(self, names: Sequence[str]) -> ShapeSet:
        """The shapes of these names, in this order."""
        return ShapeSet(tuple(names), self.displacements[self.rows(names)])

    def joined(self, other: ShapeSet) -> ShapeSet:
        """These shapes, then the other's; RetargetError for a name that both have, or for another vertex count."""
        if self.displacements.shape[1:] != other.displacements.shape[1:]:
            raise RetargetError(
                f"shapes of {self.displacements.shape[1]} and of {other.displacements.shape[1]} vertices arrived, "
                "expected the same face"
            )
        return ShapeSet(self.names + other.names, np.concatenate([self.displacements, other.displacements]))

    def with_shapes(self, other: ShapeSet) -> ShapeSet:
        """These shapes, those that `other` has too replaced by its own."""
        moves = self.displacements.copy()
        for row, name in enumerate(self.names):
            if name in other.names:
                moves[row] = other[name]
        return ShapeSet(self.names, moves)

    def positions(self, neutral: FloatArray) -> FloatArray:
        """(E, V, 3) float32 positions on a neutral face (V, 3)."""
        return np.asarray(neutral).astype(np.float32) + self.displacements

    def largest(self) -> FloatArray:
        """(E,) the farthest that any vertex moves in each shape."""
        squared = np.square(self.displacements, dtype=np.float64).sum(axis=2)
        farthest: FloatArray = np.sqrt(squared.max(axis=1, initial=0.0))
        return farthest
