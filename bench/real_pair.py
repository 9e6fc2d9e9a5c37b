"""The pair of real heads whose truth is known."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from facial_retarget_addon.core.arrays import BoolArray, FloatArray, IntArray
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.files.points import read_points

DATA = Path(os.environ.get("FACIAL_RETARGET_DATA", Path(__file__).resolve().parents[2] / "shared" / "data"))
PAIR = DATA / "pair_ict_id02_to_id04_decim.npz"
FACE_VERTICES = 9_409
"""Source vertices below this belong to the face, the others to neck, scalp and sockets."""


@dataclass(frozen=True, eq=False)
class RealPair:
    """Two heads and what each expression of the source truly is on the target.

    Attributes
    ----------
    names : of the E expressions.
    motion : (E, Vs, 3) of the source.
    truth : (E, Vt, 3) of the target.
    counterpart : (Vt,) nearest source vertex of each target vertex's true counterpart.
    on_face : (Vt,) whether it lies on the face.
    """

    problem: Problem
    names: tuple[str, ...]
    motion: FloatArray
    truth: FloatArray
    counterpart: IntArray
    on_face: BoolArray

    @property
    def frames(self) -> FloatArray:
        """(E, Vs, 3) float32 positions of the source."""
        return (self.problem.source.mesh.vertices + self.motion).astype(np.float32)

    def errors(self, motion: FloatArray, where: BoolArray | slice = slice(None)) -> FloatArray:
        """(E,) L2 of what a motion (E, Vt, 3) misses over L2 of the truth, over some of the vertices."""
        missed = np.sqrt(np.square(motion - self.truth)[:, where].sum(axis=(1, 2)))
        shares: FloatArray = missed / np.sqrt(np.square(self.truth)[:, where].sum(axis=(1, 2)))
        return shares


def read_pair() -> RealPair | None:
    """The pair, or None where the data is absent."""
    if not PAIR.exists():
        print(f"(left out: the real faces are not in {DATA.name})")
        return None
    with np.load(PAIR) as data:
        source = TriMesh(data["src_vertices"], data["src_tris"])
        target = TriMesh(data["tgt_vertices"], data["tgt_tris"])
        corners = data["src_tris"][data["corr_src_face"]].astype(np.int64)
        return RealPair(
            Problem(
                Face(source, read_points(DATA / "pair_source_points.json", source)),
                Face(target, read_points(DATA / "pair_target_points.json", target)),
            ),
            tuple(map(str, data["expr_names"])),
            data["src_expr_delta"],
            data["gt_expr_delta"],
            corners[np.arange(len(corners)), data["corr_bary"].argmax(axis=1)],
            (corners < FACE_VERTICES).all(axis=1),
        )
