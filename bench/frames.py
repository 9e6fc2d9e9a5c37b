"""Frames: rebuilding a fine normal mesh against memory bandwidth, and retargeting against deformation transfer."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from facial_retarget_addon import demo
from facial_retarget_addon.core.levels.normal_synthesis import NormalSynthesis
from facial_retarget_addon.core.methods import hierarchical
from facial_retarget_addon.core.methods.settings import HierarchicalSettings
from facial_retarget_addon.core.pair import prepare_pair

from .deformation_transfer import DeformationTransfer
from .faces import pair, problem
from .timing import Row, medians

BLOCK = 16


def rows() -> Iterator[Row]:
    """Milliseconds a frame and their ratios."""
    yield from _reconstruction()
    yield from _retargeting()


def _reconstruction() -> Iterator[Row]:
    fitted = prepare_pair(problem(), levels=5, base_points=4)
    normal = fitted.target_normal
    synthesis = NormalSynthesis(normal)
    base = np.repeat(normal.base[None], 4, axis=0).astype(np.float32)
    count = len(normal.levels[-1].positions)
    # What one frame has to move, float32: per level the subdivision matrix with its indices, positions in and out,
    # the corners gathered for the normals, the normals, and the offsets.
    moved = 0
    for step, level in zip(normal.steps, normal.levels, strict=True):
        size = len(level.positions)
        moved += 8 * step.matrix.nnz + 12 * (step.matrix.shape[1] + size)
        moved += len(level.faces) * (3 * 8 + 3 * 12 + 12) + 8 * level.faces.size + size * (12 + 12 + 4)
    block = np.ones(moved // 4, np.float32)
    sink = np.empty_like(block)
    times = medians({"frames": lambda: synthesis.frames(base), "copy": lambda: np.copyto(sink, block)}, 9)
    # A copy reads and writes each byte: it moves twice its length.
    bound = times["copy"] / 2
    yield Row("vertices of level 5", count, "")
    yield Row("bytes a frame has to move", moved / 1e6, "MB")
    yield Row("rebuilding a frame", 1e3 * times["frames"] / len(base), "ms")
    yield Row("memory bound of a frame", 1e3 * bound, "ms")
    yield Row("rebuilding over its bound", times["frames"] / len(base) / bound, "x", 12.0)


def _retargeting() -> Iterator[Row]:
    task = problem()
    source, _ = pair()
    frames = source.frames(demo.performance_table()[:BLOCK])
    retargeter = hierarchical.fit(task, HierarchicalSettings())
    target = task.target.mesh
    # The peer gets the same correspondence, through the middle vertex of each target triangle.
    counterpart = retargeter.counterpart
    face_of = np.zeros(len(task.source.mesh.vertices), np.int64)
    face_of[task.source.mesh.faces] = np.arange(len(task.source.mesh.faces))[:, None]
    peer = DeformationTransfer(task.source.mesh, target, face_of[counterpart[target.faces[:, 0]]])
    times = medians({"ours": lambda: retargeter.frames(frames), "peer": lambda: peer.frame(frames[0])})
    ours = times["ours"] / BLOCK
    yield Row(f"retargeting a frame to {len(target.vertices)} vertices", 1e3 * ours, "ms")
    yield Row("deformation transfer, factored once", 1e3 * times["peer"], "ms")
    yield Row("deformation transfer takes longer by", times["peer"] / ours, "x", 1.0, at_least=True)
