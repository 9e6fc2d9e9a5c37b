"""How the parts of a head follow its skin: one sparse matrix on the skin's displacements."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.spatial import cKDTree

from ..arrays import BoolArray, FloatArray, IntArray
from ..matching.surface_fill import HarmonicFill
from ..mpeg4.mean_face import place_missing
from .find import Part
from .kinds import BOTH, LOWER, TONGUE, UPPER
from .known_head import KnownHead
from .riding import ride

WITH_JAW = (LOWER, TONGUE, BOTH)
"""Kinds that the jaw takes along, whole or their lower half."""
LEVER = 1.2
"""What lies before the chin drops by at most this many times the chin's drop."""
AT_TEETH = 0.02
"""Gums hold a row of teeth where they are as near to it as they are anywhere, and this much, in eye separations."""
WELD = 0.25
"""Half the width of the change from upper to lower half, as a share of the way between the rows."""
BAND = 0.1
"""The same across the lips' line where there are no rows, in eye separations."""


@dataclass(frozen=True, eq=False)
class Following:
    """What the skin's motion does to the parts; linear.

    Attributes
    ----------
    axes : (3, 3) of the head.
    riders : (n,) vertices that follow. carriers : (m,) vertices that they follow.
    matrix : (3n, 3m) csr float32, from the carriers' displacements to the riders', both in those axes.
    """

    axes: FloatArray
    riders: IntArray
    carriers: IntArray
    matrix: sp.csr_matrix

    def add_to(self, displacements: FloatArray) -> FloatArray:
        """Displacements (F, V, 3) in the object's axes with what the skin's do to the parts added, in place."""
        axes = self.axes.astype(displacements.dtype)
        carried = displacements[:, self.carriers] @ axes.T
        moved = self.matrix @ carried.reshape(len(carried), -1).T
        displacements[:, self.riders] += np.ascontiguousarray(moved.T).reshape(len(carried), -1, 3) @ axes
        return displacements

    def extend(self, basis: sp.csr_matrix) -> sp.csr_matrix:
        """A basis (3V, C) of the skin's displacements in the head's axes, with the parts' rows added."""
        rows, columns = (interleaved(vertices) for vertices in (self.riders, self.carriers))
        entries = self.matrix.tocoo()
        square = (basis.shape[0],) * 2
        follows = sp.csr_matrix((entries.data, (rows[entries.row], columns[entries.col])), shape=square)
        return (basis + follows @ basis).tocsr()


def fit_following(head: KnownHead, parts: Sequence[Part]) -> Following:
    """Let the parts follow the skin.

    What is around the eyes, and hair on the face, rides on the skin: see `ride`. The lower parts of the mouth go where
    the bottom of the chin (FDP 2.1) goes, and drop the less, the nearer they are to the jaw's hinge: a chin that goes
    straight down takes the teeth straight down, which a turn about the hinge would push through the lip. All other
    parts stay.

    Parameters
    ----------
    parts : those of the head that shall follow.
    """
    follows = ride(head, parts).matrix()
    if head.shown and any(part.kind in WITH_JAW for part in parts):
        follows = follows + _with_chin(head, parts)
    return following_of(follows, head.axes)


def following_of(follows: sp.spmatrix, axes: FloatArray) -> Following:
    """Without the empty rows and columns of a matrix (3V, 3V)."""
    entries = follows.tocoo()
    entries.eliminate_zeros()
    used = np.zeros((2, follows.shape[0] // 3), bool)
    used[0, entries.row // 3] = used[1, entries.col // 3] = True
    riders, carriers = (np.flatnonzero(one) for one in used)
    matrix = follows.tocsr()[interleaved(riders)][:, interleaved(carriers)].astype(np.float32)
    return Following(axes, riders, carriers, matrix)


def interleaved(vertices: IntArray) -> IntArray:
    """(3n,) rows of x, y, z of vertices (n,)."""
    rows: IntArray = (3 * vertices[:, None] + np.arange(3)).ravel()
    return rows


def jaw_share(head: KnownHead, parts: Sequence[Part]) -> FloatArray:
    """(V,) how much of the jaw's motion each vertex takes: from 0 to 1.

    A part that lies across both halves of the mouth is split: along its surface, between where it holds a row of teeth
    and the other, or without them by the lips' line.

    Parameters
    ----------
    parts : those that may move.
    """
    share = _members(head, parts, (LOWER, TONGUE)).astype(float)
    split = _members(head, parts, (BOTH,))
    if split.any():
        upper, lower = (head.places[head.vertices((kind,))] for kind in (UPPER, LOWER))
        if len(upper) and len(lower):
            share[split] = _step((_between_rows(head, split, upper, lower)[split] - 0.5) / WELD)
        else:
            lips = place_missing(head.points.names, head.points.positions(head.places), ("2.2", "2.3"))
            below = 0.5 * (lips["2.2"] + lips["2.3"])[1] - head.places[split, 1]
            share[split] = _step(below / (BAND * head.unit))
    return share


def _members(head: KnownHead, parts: Sequence[Part], kinds: Sequence[str]) -> BoolArray:
    """(V,) vertices of the parts of these kinds."""
    mask = np.zeros(len(head.mesh.vertices), bool)
    for part in parts:
        mask[part.vertices] |= part.kind in kinds
    return mask


def _with_chin(head: KnownHead, parts: Sequence[Part]) -> sp.csr_matrix:
    """(3V, 3V) displacements of the chin to those of the parts that go with the jaw, in the head's axes."""
    share, count = jaw_share(head, parts), len(head.mesh.vertices)
    # The top of the spine lies a little behind the jaw's hinge.
    where = place_missing(head.points.names, head.points.positions(head.places), ("2.1", "7.1"))
    lever = np.clip((head.places[:, 2] - where["7.1"][2]) / (where["2.1"][2] - where["7.1"][2]), 0.0, LEVER)
    chin = head.points.subset(["2.1"]).matrix(count)
    factors = share[:, None] * np.stack([np.ones_like(lever), lever, np.ones_like(lever)], axis=1)
    follow = sp.csr_matrix((share > 0).astype(float)[:, None]) @ chin
    return (sp.diags(factors.ravel()) @ sp.kron(follow, sp.identity(3))).tocsr()


def _between_rows(head: KnownHead, split: BoolArray, upper: FloatArray, lower: FloatArray) -> FloatArray:
    """(V,) from 0 at the upper row of teeth to 1 at the lower one, harmonically along what is split (V,).

    upper, lower : (m, 3) places of the rows.
    """
    up, down = (cKDTree(row).query(head.places)[0] for row in (upper, lower))
    known = ~split
    values = np.zeros((len(split), 1))
    for component in np.unique(head.mesh.components[split]):
        own = head.mesh.components == component
        at_upper = own & (up <= up[own].min() + AT_TEETH * head.unit) & (up < down)
        at_lower = own & (down <= down[own].min() + AT_TEETH * head.unit) & (down <= up)
        known |= at_upper | at_lower
        values[at_lower] = 1.0
    return HarmonicFill(head.mesh, known, np.zeros(len(split))).values(values)[:, 0]


def _step(off: FloatArray) -> FloatArray:
    """From 0 where off (n,) is -1 or less to 1 where it is 1 or more, smoothly."""
    step = np.clip(0.5 + 0.5 * off, 0.0, 1.0)
    smooth: FloatArray = step * step * (3 - 2 * step)
    return smooth
