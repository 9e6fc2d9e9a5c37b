"""Lashes, brows and beards ride on the skin that they are rooted in."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import scipy.sparse as sp
from scipy.spatial import cKDTree

from ..acting.eyeballs import EYES
from ..arrays import BoolArray, FloatArray, IntArray
from ..closest_point import SurfaceFinder
from ..matching.surface_fill import HarmonicFill
from ..points import place_matrix
from .find import Part
from .kinds import AROUND_EYE, BEARD, BROW, MOUSTACHE
from .known_head import KnownHead

ON_SKIN = (AROUND_EYE, BROW, MOUSTACHE, BEARD)
"""Kinds of parts that ride on the skin."""
ROOTS = 0.015
"""A part is rooted where it comes as near to the skin as it does anywhere, and this much, in eye separations."""


class Riding(NamedTuple):
    """How parts ride on the skin, in the head's axes.

    riders : (n,) vertices of the parts.
    spread : (V, V) how much of each root a vertex takes; 1 on the diagonal for roots and all that does not ride.
    place : (V, V) the roots' places on the skin.
    turns : (3V, 3V) what the skin's displacements add by turning what is around an eye.
    """

    riders: IntArray
    spread: sp.csr_matrix
    place: sp.csr_matrix
    turns: sp.csr_matrix

    def matrix(self) -> sp.csr_matrix:
        """(3V, 3V) displacements of the skin to those of the parts."""
        return (sp.kron(self.spread @ self.place, sp.identity(3)) + self.turns).tocsr()


def ride(head: KnownHead, parts: Sequence[Part]) -> Riding:
    """Let parts ride on the skin.

    They are rooted where they are nearest to the skin; the roots go where the skin there goes, and the rest goes with
    the roots: harmonically, so that a sheet between two lids is squeezed and a lash keeps its shape. Around an eye it
    also turns with the roots, which slide around the eyeball.

    Parameters
    ----------
    parts : those of the head that shall ride; of other kinds than `ON_SKIN` none does.
    """
    mesh, count = head.mesh, len(head.mesh.vertices)
    riding = [part for part in parts if part.kind in ON_SKIN]
    if not riding:
        nothing = sp.csr_matrix((count, count)), sp.csr_matrix((3 * count, 3 * count))
        return Riding(np.empty(0, np.int64), sp.identity(count, format="csr"), *nothing)
    skin = np.zeros(count, bool)
    skin[head.skin] = True
    asked = np.concatenate([part.vertices for part in riding])
    found = SurfaceFinder(mesh, np.flatnonzero(skin[mesh.faces[:, 0]])).closest(mesh.vertices[asked])
    owner = np.repeat(np.arange(len(riding)), [len(part.vertices) for part in riding])
    nearest = np.full(len(riding), np.inf)
    np.minimum.at(nearest, owner, found.distance)
    rooted = found.distance <= nearest[owner] + ROOTS * head.unit
    roots = asked[rooted]
    corners, weights = np.zeros((count, 3), np.int64), np.zeros((count, 3))
    corners[roots], weights[roots] = mesh.faces[found.face[rooted]], found.weights[rooted]
    known = np.ones(count, bool)
    known[asked] = False
    known[roots] = True
    spread = HarmonicFill(mesh, known, np.zeros(count)).matrix()
    place = place_matrix(corners, weights, count)
    lashes = np.zeros(count, bool)
    lashes[[vertex for part in riding if part.kind == AROUND_EYE for vertex in part.vertices]] = True
    return Riding(np.sort(asked), spread, place, _turned_by_lids(head, lashes & ~known, spread, place))


def _turned_by_lids(head: KnownHead, lashes: BoolArray, spread: sp.csr_matrix, place: sp.csr_matrix) -> sp.csr_matrix:
    """(3V, 3V) what the skin's displacements add to the lashes' by turning them, in the head's axes.

    A root at r from the middle of the eyeball that goes by d, as seen from the corners of the eye, turns by r x d / r².
    What hangs on it turns about it; the less, the more it hangs on both lids. An eye without points at its corners
    turns nothing.

    Parameters
    ----------
    lashes : (V,) vertices that shall turn. spread, place : as in `Riding`.
    """
    places, count = head.places, len(lashes)
    corners = {side: EYES[side][2:4] for side in head.eyeballs if set(EYES[side][2:4]) <= set(head.points.names)}
    added = sp.csr_matrix((3 * count, 3 * count))
    if not corners:
        return added
    centres = np.stack([head.axes @ head.eyeballs[side].centre for side in corners])
    hangs = (sp.diags(lashes.astype(float)) @ spread).tocsr()
    hangs.eliminate_zeros()
    hangs = hangs.tocoo()
    eye = cKDTree(centres).query(places[hangs.row])[1]
    for k, names in enumerate(corners.values()):
        tip, root, share = hangs.row[eye == k], hangs.col[eye == k], hangs.data[eye == k]
        on_skin = (place @ places)[root]
        share = share * _on_one_lid(head.points.subset(names).positions(places), on_skin, tip, share, count)
        away, radius = places[tip] - places[root], on_skin - centres[k]
        # (r x d) x u = (r . u) d - r (u . d)
        along = np.einsum("ni,ni->n", radius, away)[:, None, None] * np.eye(3)
        turns = along - radius[:, :, None] * away[:, None, :]
        turns *= (share / np.einsum("ni,ni->n", radius, radius))[:, None, None]
        rows, columns = np.broadcast_arrays(
            3 * tip[:, None, None] + np.arange(3)[:, None], 3 * root[:, None, None] + np.arange(3)
        )
        turning = sp.csr_matrix((turns.ravel(), (rows.ravel(), columns.ravel())), shape=added.shape)
        rooted = np.zeros(count)
        rooted[root] = 1.0
        still = sp.csr_matrix(head.points.subset(names).matrix(count).mean(axis=0))
        seen = place - sp.csr_matrix(rooted[:, None]) @ still
        added = added + turning @ sp.kron(seen, sp.identity(3), format="csr")
    return added.tocsr()


def _on_one_lid(corners: FloatArray, roots: FloatArray, tips: IntArray, share: FloatArray, count: int) -> FloatArray:
    """(n,) 1 where a tip hangs on one lid alone, 0 where it hangs on both alike, between them a square.

    Parameters
    ----------
    corners : (2, 3) of the eye, in the head's axes. roots : (n, 3) where each tip (n,) hangs by its share (n,).
    """
    (x, y), (across, rise) = corners[0, :2], corners[1, :2] - corners[0, :2]
    upper = np.where(across * (roots[:, 1] - y) > rise * (roots[:, 0] - x), 1.0, -1.0)
    balance = np.bincount(tips, share * upper, count).astype(np.float64)[tips]
    square: FloatArray = np.square(balance)
    return square
