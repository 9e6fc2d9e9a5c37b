"""What a bake will cost, before it starts: for the panel, without bpy and NumPy."""

from __future__ import annotations

from dataclasses import dataclass

from .core.methods.settings import CACHES

PLENTY = 10_000_000
"""Vertex-frames from which shape keys for every frame are a burden: 120 MB in the file, as much again for each step of
undo, and relative ones play slowly."""
MANY_CURVES = 2_000
"""Shape keys with a curve each from which a scene plays slower than seven frames a second: Blender looks the key of
every curve up by its name, which takes 40 ms a frame for a thousand and seconds for ten thousand."""
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
    burden = vertices * baked > PLENTY or (kind == "frames" and baked > MANY_CURVES)
    advice = "For so much, Compact Shape Keys or a cache fit better" if burden else ""
    return Cost(whole, 0.0, advice)
