"""The methods that work level by level, on the same points of a pair whose truth is known: error by level, and time."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import accumulate
from typing import cast

import numpy as np

from facial_retarget_addon import demo
from facial_retarget_addon.core.level_retargeter import LevelRetargeter
from facial_retarget_addon.core.methods.base import fit
from facial_retarget_addon.core.methods.settings import HierarchicalSettings, Settings, WaveletSettings
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.core.seams.gaps import SeamGaps

from .real_pair import RealPair, read_pair
from .timing import Row, medians

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
ON_WARPS = ("hierarchical", "hierarchical, global", "wavelet", "wavelet, scaled", "wavelet, paper")
SEEDS = (3, 7, 11)
BOUNDS = {"hierarchical": 0.08, "wavelet": 0.12}
"""Median error on the face, all levels, as the issues of the methods ask for it."""


def rows() -> Iterator[Row]:
    """Median relative error on the face of 53 expressions without examples, with the levels added one by one."""
    pair = read_pair()
    if pair is None:
        return
    fitted: dict[str, LevelRetargeter] = {}
    for name, method, settings in WAYS:
        fitted[name] = cast(LevelRetargeter, fit(method, pair.problem, settings))
        yield from _errors(name, pair, fitted[name])
        found = fitted[name].frames(pair.frames)
        errors = pair.errors(found - pair.problem.target.mesh.vertices, pair.on_face)
        yield Row(f"{name}: all, 90 %", float(np.quantile(errors, 0.9)), "")
    yield from _on_warps()
    yield from _lids()
    frames = pair.frames
    timed = [(name, method, settings) for name, method, settings in WAYS if name in BOUNDS]
    fits = medians({name: partial(fit, method, pair.problem, settings) for name, method, settings in timed}, 2)
    moves = medians({name: partial(fitted[name].frames, frames) for name in BOUNDS})
    yield Row("wavelet: fit", fits["wavelet"] / fits["hierarchical"], "times hierarchical's")
    yield Row(f"wavelet: {len(frames)} frames", moves["wavelet"] / moves["hierarchical"], "times hierarchical's")
    yield Row("wavelet: frames", len(frames) / moves["wavelet"], "a second")


def _on_warps() -> Iterator[Row]:
    """Median error over all vertices of a performance on strongly warped copies of the built-in actor."""
    actor = demo.actor(vertices=8_000)
    table = demo.performance_table()[::16]
    acting = actor.frames(table)
    targets = [demo.warped_actor(np.random.default_rng(seed), vertices=6_000) for seed in SEEDS]
    for name, method, settings in WAYS:
        if name not in ON_WARPS:
            continue
        found = []
        for target in targets:
            rest, truth = target.face.mesh.vertices, target.frames(table)
            problem = Problem(*(Face(face.mesh, face.points) for face in (actor.face, target.face)))
            missed = fit(method, problem, settings).frames(acting) - truth
            error, size = (np.linalg.norm(part.reshape(len(table), -1), axis=1) for part in (missed, truth - rest))
            moves = size > 0.05 * size.max()
            found.append(np.median(error[moves] / size[moves]))
        yield Row(f"{name}: on {len(SEEDS)} warps of the built-in actor", float(np.mean(found)), "")


def _lids() -> Iterator[Row]:
    """How much wider than the actor's the lids of a child with large eyes are, at the worst of a performance."""
    actor, child = demo.actor(), demo.child()
    problem = Problem(actor.face, child.face)
    frames, gaps = demo.performance(actor)[::3], SeamGaps(problem)
    for name in ON_WARPS:
        method, settings = next((method, settings) for known, method, settings in WAYS if known == name)
        found = gaps.measured(frames, fit(method, problem, settings).frames(frames))
        wider = np.subtract(found["lid_gap_percent"], found["source_lid_gap_percent"]).max()
        bound = None if name.endswith("paper") else 1.0
        yield Row(f"{name}: a child's lids, of the eye's opening", float(wider), "%", bound)


def _errors(name: str, pair: RealPair, retargeter: LevelRetargeter) -> Iterator[Row]:
    parts = retargeter.levels(pair.frames)
    wholes = accumulate(part.displacements for part in parts)
    for part, whole in zip(parts, wholes, strict=True):
        error = float(np.median(pair.errors(whole, pair.on_face)))
        last = part is parts[-1]
        yield Row(f"{name}: up to {part.name}", error, "", BOUNDS.get(name) if last else None)
