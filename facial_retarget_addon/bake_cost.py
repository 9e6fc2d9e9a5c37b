"""What a bake will cost, before it starts: for the panel, without bpy and NumPy."""

from __future__ import annotations

from dataclasses import dataclass

from .core.methods.settings import CACHES

PLENTY = 10_000_000
"""Vertex-frames from which shape keys for every frame are a burden: 120 MB in the file, as much again for each step of
undo, and relative ones play slowly."""
FEW_KEYS = 60
"""Shape keys that a compact bake makes at most of most performances."""


@dataclass(frozen=True)
class Cost:
    """Megabytes that the .blend and memory grow by, and on disk beside it; advice, empty for none.

    Both texts are to be translated before their {fields} are filled in.
    """

    file: float
    disk: float
    advice: str = ""


def bake_cost(kind: str, vertices: int, frames: int, step: float = 1.0) -> Cost:
    """What a bake of so many frames of a face costs.

    Parameters
    ----------
    kind : of `BakeSettings`.
    vertices, frames : of the target, and scene frames of the range.
    step : scene frames from one baked frame to the next.
    """
    baked = int(frames / step) or 1
    whole = 12 * vertices * baked / 1e6
    if kind in CACHES:
        return Cost(0.0, whole)
    if kind == "compact":
        return Cost(12 * vertices * min(FEW_KEYS, baked) / 1e6, 0.0)
    if kind == "rig":
        return Cost(0.0, 0.0)
    advice = "For so much, Compact Shape Keys or a cache fit better" if vertices * baked > PLENTY else ""
    return Cost(whole, 0.0, advice)
