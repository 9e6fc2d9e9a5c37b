"""Real faces: a pair whose truth is known, against the figures of other ways on the same points."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from facial_retarget_addon.core.arrays import BoolArray, FloatArray
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.methods.settings import HierarchicalSettings
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.core.retarget import retarget
from facial_retarget_addon.files.points import read_points

from .timing import Row

DATA = Path(os.environ.get("FACIAL_RETARGET_DATA", Path(__file__).resolve().parents[2] / "shared" / "data"))
FACE_VERTICES = 9_409
"""Source vertices below this belong to the face, the others to neck, scalp and sockets."""


def rows() -> Iterator[Row]:
    """Relative motion errors per expression, no examples: median and 90 % on the face, median over all vertices.

    Yardsticks on the same points: deformation transfer 0.139, non-rigid fit and delta 0.061, perfect
    correspondence 0.039.
    """
    file = DATA / "pair_ict_id02_to_id04_decim.npz"
    if not file.exists():
        print(f"(left out: the real faces are not in {DATA.name})")
        return
    for variant in ("default", "paper"):
        on_face, everywhere, drift = pair_errors(file, variant)
        bound = variant == "default"
        yield Row(f"{variant}: median on the face", float(np.median(on_face)), "", 0.08 if bound else None)
        yield Row(f"{variant}: 90 % on the face", float(np.quantile(on_face, 0.9)), "", 0.14 if bound else None)
        yield Row(f"{variant}: median, all vertices", float(np.median(everywhere)), "", 0.10 if bound else None)
        yield Row(f"{variant}: motion of a still source", drift, "", 1e-6)


def pair_errors(file: Path, variant: str) -> tuple[FloatArray, FloatArray, float]:
    """Relative error per expression on the face and over all vertices, and the motion of a still source."""
    data = np.load(file)
    source = TriMesh(data["src_vertices"], data["src_tris"])
    target = TriMesh(data["tgt_vertices"], data["tgt_tris"])
    problem = Problem(
        Face(source, read_points(file.with_name("pair_source_points.json"), source)),
        Face(target, read_points(file.with_name("pair_target_points.json"), target)),
    )
    motion = np.concatenate([data["src_expr_delta"], np.zeros((1, *source.vertices.shape))])
    frames = (source.vertices + motion).astype(np.float32)
    result = retarget("hierarchical", problem, HierarchicalSettings(variant=variant), frames).frames
    found, truth = result[:-1] - target.vertices, data["gt_expr_delta"]
    face = (data["src_tris"][data["corr_src_face"]] < FACE_VERTICES).all(axis=1)
    drift = np.abs(result[-1] - target.vertices.astype(np.float32)).max() / target.size
    return _relative(found, truth, face), _relative(found, truth, np.ones(len(face), bool)), float(drift)


def _relative(found: FloatArray, truth: FloatArray, where: BoolArray) -> FloatArray:
    error = np.sqrt(np.square(found - truth)[:, where].sum(axis=(1, 2)))
    return error / np.sqrt(np.square(truth)[:, where].sum(axis=(1, 2)))
