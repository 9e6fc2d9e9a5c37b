"""Seals: whether lips and lids that come together in the truth do so in a result."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from scipy.spatial import cKDTree

from facial_retarget_addon.core.arrays import FloatArray, IntArray, unit_vectors
from facial_retarget_addon.core.mesh import TriMesh

BLINKS = ("eyeBlink_L", "eyeBlink_R")
REACH = 0.5
"""Vertices touch that are not farther apart than this many mean edges ..."""
APART = 2.0
"""... and they face one another over an opening that parts them by this many times as much."""


def lid_error(mesh: TriMesh, motion: Mapping[str, FloatArray], truth: Mapping[str, FloatArray]) -> float:
    """Mean error of the gap between the lids when they blink, in % of the eye's opening.

    Parameters
    ----------
    motion, truth : expression -> displacements (V, 3).
    """
    rest = np.zeros_like(mesh.vertices)
    return float(np.mean([_gap_error(mesh, motion[name], truth[name], rest) for name in BLINKS]))


def lip_error(mesh: TriMesh, motion: Mapping[str, FloatArray], truth: Mapping[str, FloatArray]) -> float:
    """Mean error of the gap between the lips of an open jaw with a closed mouth, in % of the open jaw's.

    mouthClose means something together with jawOpen only. See `lid_error` for the parameters.
    """
    ours, theirs = (one["jawOpen"] + one["mouthClose"] for one in (motion, truth))
    return _gap_error(mesh, ours, theirs, truth["jawOpen"])


def contacts(shut: FloatArray, opened: FloatArray, reach: float) -> IntArray:
    """(N, 2) vertices at most `reach` apart when shut, and more than `APART` times that when opened.

    Parameters
    ----------
    shut, opened : (V, 3) positions.
    """
    pairs = cKDTree(shut).query_pairs(reach, output_type="ndarray").astype(np.int64)
    gap = np.linalg.norm(opened[pairs[:, 0]] - opened[pairs[:, 1]], axis=1)
    facing: IntArray = pairs[gap > APART * reach]
    return facing


def _gap_error(mesh: TriMesh, found: FloatArray, shut: FloatArray, opened: FloatArray) -> float:
    """Mean error of the gaps, along the directions in which the contacts open, in % of their mean opening."""
    reach = REACH * float(mesh.edge_lengths.mean())
    upper, lower = contacts(mesh.vertices + shut, mesh.vertices + opened, reach).T
    opening = (mesh.vertices + opened)[upper] - (mesh.vertices + opened)[lower]
    wrong = (found - shut)[upper] - (found - shut)[lower]
    missed = np.abs(np.einsum("ni,ni->n", wrong, unit_vectors(opening)))
    return 100 * float(missed.mean() / np.linalg.norm(opening, axis=1).mean())
