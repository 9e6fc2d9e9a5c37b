"""Round-robin timing, and rows to print."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from statistics import median
from time import perf_counter


class LeftOut(Exception):
    """A section needs something that is not here; says what."""


@dataclass(frozen=True)
class Row:
    """One figure, and the bound it is held against: met where `value <= bound`, or >= with `at_least`."""

    what: str
    value: float
    unit: str
    bound: float | None = None
    at_least: bool = False

    @property
    def met(self) -> bool:
        """Whether the bound, if there is one, holds."""
        if self.bound is None:
            return True
        return self.value >= self.bound if self.at_least else self.value <= self.bound

    def __str__(self) -> str:
        """The row of a table."""
        sign = "" if self.bound is None else f"{'>=' if self.at_least else '<='} {self.bound:g} {self.unit}"
        return f"| {self.what} | {self.value:.4g} {self.unit} | {sign} | {'' if self.met else 'MISSED'} |"


def medians(peers: Mapping[str, Callable[[], object]], rounds: int = 5) -> dict[str, float]:
    """Median seconds of each peer, run in turn, the first round left out."""
    times: dict[str, list[float]] = {name: [] for name in peers}
    for round_ in range(rounds + 1):
        for name, run in peers.items():
            start = perf_counter()
            run()
            if round_:
                times[name].append(perf_counter() - start)
    return {name: median(values) for name, values in times.items()}
