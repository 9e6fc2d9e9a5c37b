"""A recorded performance as few shape keys, and as the curves of a rig: Live Link onto the ICT head, onto MakeHuman."""

from __future__ import annotations

import json
from collections.abc import Iterator
from time import perf_counter
from typing import Any

import numpy as np

from facial_retarget_addon.core.arrays import FloatArray
from facial_retarget_addon.core.base.regions import eye_separation
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.methods.base import fit
from facial_retarget_addon.core.methods.settings import BakeSettings, MotionCloningSettings
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.core.reduction.compact import compact
from facial_retarget_addon.core.reduction.rig_fit import fit_to_keys, residual_keys
from facial_retarget_addon.files.points import read_points

from .real_pair import DATA
from .timing import Row

HOW, BLOCK = BakeSettings(), 64
"""The defaults; frames that go through at once."""


def rows() -> Iterator[Row]:
    """Keys, size and error of the compact bake; error of the fit to the head's own units."""
    if not (DATA / "livelink_alex_rom_3.npz").exists():
        return
    source, shapes, names = read_set("ict_dev", "ict_points")
    target, units, _ = read_set("makehuman_dev", "makehuman_points")
    frames = Recorded(source.mesh, shapes, names)
    retargeter = fit("motion_cloning", Problem(source, target), MotionCloningSettings())
    rest = target.mesh.vertices.astype(np.float32)
    motion = np.concatenate([retargeter.frames(frames[k : k + BLOCK]) - rest for k in range(0, len(frames), BLOCK)])
    unit = eye_separation(target.mesh, target.points)
    start = perf_counter()
    keyed = compact(motion, target.mesh.vertices, HOW.tolerance * unit, unit, np.random.default_rng(0))
    seconds = perf_counter() - start
    size, whole = (keyed.shapes.nbytes + keyed.curves.nbytes) / 1e6, motion.nbytes / 1e6
    yield Row("frames, each a key otherwise", len(motion), "")
    yield Row("shape keys at 0.5 % of the eye separation", len(keyed.shapes), "")
    yield Row("largest error of a frame, of the tolerance", float(keyed.errors.max() / (HOW.tolerance * unit)), "", 1.0)
    yield Row("worst vertex of all frames, of the eye separation", 100 * float(keyed.worst.max() / unit), "%")
    yield Row("size", size, "MB")
    yield Row("size of a key per frame", whole, "MB")
    yield Row("smaller by", whole / size, "x")
    yield Row("time", seconds, "s")
    start = perf_counter()
    low, high = np.zeros(len(units)), np.ones(len(units))
    fitted = fit_to_keys(motion, units, low, high, HOW.smoothness, HOW.sparsity)
    yield Row(f"fitted to {len(units)} own units: time", perf_counter() - start, "s")
    dense = fit_to_keys(motion, units, low, high, HOW.smoothness)
    yield Row("their values together, of those without sparsity", float(fitted.curves.sum() / dense.curves.sum()), "")
    yield Row("error, of that without sparsity", float(fitted.errors.mean() / dense.errors.mean()), "", 1.03)
    for share in (0.5, 0.95):
        what = f"error of {100 * share:.0f} % of the frames, of the eye separation"
        yield Row(f"own units: {what}", 100 * float(np.quantile(fitted.errors, share) / unit), "%")
    ranges = [slice(first, first + 300) for first in range(0, len(motion), 300)]
    more = residual_keys(motion, fitted, ranges)
    yield Row(
        "own units and a key per 300 frames: error of 95 % of the frames",
        100 * float(np.quantile(more.errors, 0.95) / unit),
        "%",
    )


def read_set(name: str, points: str) -> tuple[Face, FloatArray, list[str]]:
    """A head of the data with its points, its shapes (E, V, 3) and their names."""
    held = np.load(DATA / f"{name}.npz", allow_pickle=True)
    mesh = TriMesh.from_polygons(
        held["vertices"].astype(np.float64), held["face_counts"].astype(np.int64), held["face_indices"].astype(np.int64)
    )
    face = Face(mesh, read_points(DATA / f"{points}.json", mesh), {})
    return face, held["expr_delta"], held["expr_names"].tolist()


class Recorded:
    """Frames (F, V, 3) of the recording on a head, made as they are asked for: `files.frames.FrameBlocks`."""

    def __init__(self, mesh: TriMesh, shapes: FloatArray, names: list[str], step: int = 1) -> None:
        take = np.load(DATA / "livelink_alex_rom_3.npz", allow_pickle=True)
        known: dict[str, Any] = json.loads((DATA / "arkit_name_map.json").read_text())["map"]["ict_facekit/ict"]
        weights = take["weights"][::step]
        self._weights = np.zeros((len(weights), len(names)), np.float32)
        for column, name in enumerate(take["names"].tolist()):
            theirs = known.get(name) or []
            for shape in [theirs] if isinstance(theirs, str) else theirs:
                self._weights[:, names.index(shape)] += weights[:, column]
        self._shapes, self._rest = shapes.reshape(len(shapes), -1), mesh.vertices.astype(np.float32)
        self.shape = (len(weights), *mesh.vertices.shape)

    def __len__(self) -> int:
        return len(self._weights)

    def __getitem__(self, frames: slice, /) -> FloatArray:
        rows = self._weights[frames]
        return (rows @ self._shapes).reshape(len(rows), -1, 3) + self._rest
