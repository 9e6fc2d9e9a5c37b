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


class Tips(NamedTuple):
    """What hangs on the lids of an eye and is no root.

    vertices : (n,). lever : (n, 3) from its roots, in the head's axes.
    lid : (n,) 1 for what hangs on the upper lid, -1 on the lower, between for both.
    along : (n,) from 0 at the eye's outer corner to 1 at its inner one.
    """

    side: str
    vertices: IntArray
    lever: FloatArray
    lid: FloatArray
    along: FloatArray


class Riding(NamedTuple):
    """How parts ride on the skin, in the head's axes.

    riders : (n,) vertices of the parts.
    spread : (V, V) how much of each root a vertex takes; 1 on the diagonal for roots and all that does not ride.
    place : (V, V) the roots' places on the skin.
    turns : (3V, 3V) what the skin's displacements add by turning what is around an eye.
    tips : of each eye.
    """

    riders: IntArray
    spread: sp.csr_matrix
    place: sp.csr_matrix
    turns: sp.csr_matrix
    tips: tuple[Tips, ...]

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
        return Riding(np.empty(0, np.int64), sp.identity(count, format="csr"), *nothing, ())
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
    hairs = _hairs(head, lashes & ~known, spread, place)
    return Riding(np.sort(asked), spread, place, _turned_by_lids(head, hairs, place), tuple(map(_tips, hairs)))


class _Hairs(NamedTuple):
    """What hangs on the lids of an eye, tip by root.

    tip, root : (n,) vertices. share : (n,) how much the tip takes of the root.
    away : (n, 3) from root to tip. radius : (n, 3) from the eyeball's middle to the root's place on the skin.
    lid : (n,) 1 for the upper, -1 for the lower, between where a tip hangs on both.
    along : (n,) where the root lies, from 0 at the eye's outer corner to 1 at its inner one.
    """

    side: str
    tip: IntArray
    root: IntArray
    share: FloatArray
    away: FloatArray
    radius: FloatArray
    lid: FloatArray
    along: FloatArray


def _hairs(head: KnownHead, lashes: BoolArray, spread: sp.csr_matrix, place: sp.csr_matrix) -> list[_Hairs]:
    """What hangs on each eye that has points at its corners.

    Parameters
    ----------
    lashes : (V,) vertices that hang. spread, place : as in `Riding`.
    """
    sides = [side for side in head.eyeballs if set(EYES[side][2:4]) <= set(head.points.names)]
    if not sides:
        return []
    centres = np.stack([head.axes @ head.eyeballs[side].centre for side in sides])
    hangs = (sp.diags(lashes.astype(float)) @ spread).tocsr()
    hangs.eliminate_zeros()
    hangs = hangs.tocoo()
    eye = cKDTree(centres).query(head.places[hangs.row])[1]
    on_skin = place @ head.places
    found = []
    for k, side in enumerate(sides):
        tip, root, share = hangs.row[eye == k], hangs.col[eye == k], hangs.data[eye == k]
        outer, inner = head.points.subset(EYES[side][2:4]).positions(head.places)
        across, down = inner - outer, on_skin[root] - outer
        above = np.where((down[:, 1] * across[0] - down[:, 0] * across[1]) * across[0] > 0, 1.0, -1.0)
        lid = np.bincount(tip, share * above, len(lashes)).astype(np.float64)[tip]
        along = np.clip(down @ across / (across @ across), 0.0, 1.0)
        away = head.places[tip] - head.places[root]
        found.append(_Hairs(side, tip, root, share, away, on_skin[root] - centres[k], lid, along))
    return found


def _tips(hairs: _Hairs) -> Tips:
    """Roots of each tip taken together."""
    vertices, of = np.unique(hairs.tip, return_inverse=True)
    total = np.bincount(of, hairs.share)
    lever = np.stack([np.bincount(of, hairs.share * x) for x in hairs.away.T], axis=1).astype(np.float64)
    along = np.bincount(of, hairs.share * hairs.along) / total
    lid = np.bincount(of, hairs.share * hairs.lid) / total
    return Tips(hairs.side, vertices, lever, lid, along)


def _turned_by_lids(head: KnownHead, hairs: Sequence[_Hairs], place: sp.csr_matrix) -> sp.csr_matrix:
    """(3V, 3V) what the skin's displacements add to the lashes' by turning them, in the head's axes.

    A root at r from the middle of the eyeball that goes by d, as seen from the corners of the eye, turns by r x d / r².
    What hangs on it turns about it; the less, the more it hangs on both lids.
    """
    count = place.shape[0]
    added = sp.csr_matrix((3 * count, 3 * count))
    for eye in hairs:
        # (r x d) x u = (r . u) d - r (u . d)
        along = np.einsum("ni,ni->n", eye.radius, eye.away)[:, None, None] * np.eye(3)
        turns = along - eye.radius[:, :, None] * eye.away[:, None, :]
        turns *= (eye.share * eye.lid**2 / np.einsum("ni,ni->n", eye.radius, eye.radius))[:, None, None]
        rows, columns = np.broadcast_arrays(
            3 * eye.tip[:, None, None] + np.arange(3)[:, None], 3 * eye.root[:, None, None] + np.arange(3)
        )
        turning = sp.csr_matrix((turns.ravel(), (rows.ravel(), columns.ravel())), shape=added.shape)
        rooted = np.zeros(count)
        rooted[eye.root] = 1.0
        still = sp.csr_matrix(head.points.subset(EYES[eye.side][2:4]).matrix(count).mean(axis=0))
        seen = place - sp.csr_matrix(rooted[:, None]) @ still
        added = added + turning @ sp.kron(seen, sp.identity(3), format="csr")
    return added.tocsr()
