"""The methods that work level by level, on the same points of a pair whose truth is known: error by level, and time."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import accumulate
from time import perf_counter
from typing import cast

import numpy as np

from facial_retarget_addon.core.level_retargeter import LevelRetargeter
from facial_retarget_addon.core.methods.base import fit
from facial_retarget_addon.core.methods.settings import HierarchicalSettings, Settings, WaveletSettings

from .real_pair import RealPair, read_pair
from .timing import Row

WAYS: tuple[tuple[str, str, Settings], ...] = (
    ("hierarchical", "hierarchical", HierarchicalSettings()),
    ("hierarchical, global", "hierarchical", HierarchicalSettings(frames="global")),
    ("hierarchical, paper", "hierarchical", HierarchicalSettings(variant="paper")),
    ("wavelet", "wavelet", WaveletSettings()),
    ("wavelet, scaled", "wavelet", WaveletSettings(mode="scaled")),
    ("wavelet, paper", "wavelet", WaveletSettings(mode="paper")),
    ("wavelet, pierced", "wavelet", WaveletSettings(source_mesh="pierced")),
    ("wavelet, k = 0", "wavelet", WaveletSettings(disc=0)),
    ("wavelet, integral", "wavelet", WaveletSettings(lifting="integral")),
)
"""Name of a row, method, settings."""
BOUNDS = {"hierarchical": 0.08, "wavelet": 0.12}
"""Median error on the face, all levels, as the issues of the methods ask for it."""


def rows() -> Iterator[Row]:
    """Median relative error on the face of 53 expressions without examples, with the levels added one by one."""
    pair = read_pair()
    if pair is None:
        return
    seconds: dict[str, tuple[float, float]] = {}
    for name, method, settings in WAYS:
        start = perf_counter()
        retargeter = cast(LevelRetargeter, fit(method, pair.problem, settings))
        fitted = perf_counter()
        found = retargeter.frames(pair.frames)
        seconds[name] = fitted - start, perf_counter() - fitted
        yield from _errors(name, pair, retargeter)
        errors = pair.errors(found - pair.problem.target.mesh.vertices, pair.on_face)
        yield Row(f"{name}: all, 90 %", float(np.quantile(errors, 0.9)), "")
    for name, (fitting, moving) in seconds.items():
        base = seconds["hierarchical"]
        yield Row(f"{name}: fit", fitting / base[0], "times hierarchical's")
        yield Row(f"{name}: {len(pair.frames)} frames", moving / base[1], "times hierarchical's")


def _errors(name: str, pair: RealPair, retargeter: LevelRetargeter) -> Iterator[Row]:
    parts = retargeter.levels(pair.frames)
    wholes = accumulate(part.displacements for part in parts)
    for part, whole in zip(parts, wholes, strict=True):
        error = float(np.median(pair.errors(whole, pair.on_face)))
        last = part is parts[-1]
        yield Row(f"{name}: up to {part.name}", error, "", BOUNDS.get(name) if last else None)
