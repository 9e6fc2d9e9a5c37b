"""How far each example has come on both faces, and what is wrong with it in the artist's words."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from .arrays import FloatArray

STILL = 1e-6
"""Motion below this, times the face's size, is none."""
MISSING, EMPTY, SCULPTED = "MISSING", "EMPTY", "SCULPTED"
"""What an example can be on a face."""


class ShownExamples(NamedTuple):
    """What a face shows.

    name : of the face.
    size : of the face, in its own units.
    moves : example -> displacements (V, 3), None for an example that the face has no shape key of.
    """

    name: str
    size: float
    moves: Mapping[str, FloatArray | None]

    def state(self, example: str) -> str:
        """What an example is on the face."""
        moved = self.moves[example]
        if moved is None:
            return MISSING
        return SCULPTED if is_sculpted(moved, self.size) else EMPTY


class ExampleState(NamedTuple):
    """What an example is on each face, and a sentence for the artist if something is wrong with it, else ""."""

    source: str
    target: str
    warning: str


def is_sculpted(moves: FloatArray, size: float) -> bool:
    """Whether displacements (V, 3) move a face of some size at all; vertices that are NaN count as moved."""
    return not np.abs(moves).max(initial=0.0) <= STILL * size


def same_shapes(shapes: Mapping[str, FloatArray], tolerance: float) -> list[tuple[str, str]]:
    """Pairs of shapes, (V, 3) each, that are less than a tolerance apart at every vertex."""
    largest = {name: np.abs(shape).max(initial=0.0) for name, shape in shapes.items()}
    return [
        (a, b)
        for (a, one), (b, other) in combinations(shapes.items(), 2)
        # Shapes cannot be near if their largest numbers are not, which is cheap to see.
        if np.shape(one) == np.shape(other)
        and abs(largest[a] - largest[b]) < tolerance
        and np.abs(one - other).max(initial=0.0) < tolerance
    ]


def example_states(names: Sequence[str], source: ShownExamples, target: ShownExamples) -> dict[str, ExampleState]:
    """The state of each example, in the order given."""
    twins: dict[str, str] = {}
    for face in (source, target):
        sculpted = {name: face.moves[name] for name in names if face.state(name) == SCULPTED}
        for pair in same_shapes({n: moves for n, moves in sculpted.items() if moves is not None}, STILL * face.size):
            for name, twin in (pair, pair[::-1]):
                twins.setdefault(
                    name, f"The same as {twin} on {face.name}: it teaches nothing; sculpt one of them otherwise"
                )
    return {
        name: ExampleState(
            source.state(name), target.state(name), _unfinished(name, source, target) or twins.get(name, "")
        )
        for name in names
    }


def _unfinished(name: str, source: ShownExamples, target: ShownExamples) -> str:
    """What keeps an example from being used, though it was begun."""
    lacking = [face.name for face in (source, target) if face.state(name) == MISSING]
    if lacking:
        return f"No shape key {name} on {' and '.join(lacking)}: create it, or take the example off the list"
    sculpted = [face for face in (source, target) if face.state(name) == SCULPTED]
    if len(sculpted) == 1:
        other = target if sculpted[0] is source else source
        return f"Sculpted on {sculpted[0].name} alone: sculpt it on {other.name} too, or rough it out there"
    return ""
