"""How the parts of a head follow its skin: one sparse matrix on the skin's displacements."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.spatial import cKDTree

from ..arrays import BoolArray, FloatArray, IntArray
from ..base.regions import eye_separation
from ..closest_point import SurfaceFinder
from ..matching.surface_fill import HarmonicFill
from ..mesh import TriMesh
from ..mpeg4.mean_face import place_missing
from ..mpeg4.regions import OWN_PARTS
from ..points import FeaturePoints, place_matrix
from .find import NEEDED, Part
from .kinds import AROUND_EYE, BEARD, BOTH, BROW, LOWER, MOUSTACHE, TONGUE, UPPER

ON_SKIN = (AROUND_EYE, BROW, MOUSTACHE, BEARD)
"""Kinds of parts that ride on the skin."""
WITH_JAW = (LOWER, TONGUE, BOTH)
"""Kinds that the jaw takes along, whole or their lower half."""
ROOTS = 0.015
"""A part is rooted where it comes as near to the skin as it does anywhere, and this much, in eye separations."""
LEVER = 1.2
"""What lies before the chin drops by at most this many times the chin's drop."""
BAND = 0.1
"""Half the width of the change from upper to lower half: a share of the way between the rows, or eye separations."""


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
        rows, columns = (_interleaved(vertices) for vertices in (self.riders, self.carriers))
        entries = self.matrix.tocoo()
        square = (basis.shape[0],) * 2
        follows = sp.csr_matrix((entries.data, (rows[entries.row], columns[entries.col])), shape=square)
        return (basis + follows @ basis).tocsr()


def fit_following(mesh: TriMesh, points: FeaturePoints, axes: FloatArray, parts: Sequence[Part]) -> Following:
    """Let the parts follow the skin.

    What is around the eyes, and hair on the face, is rooted where it is nearest to the skin; its roots go where the
    skin there goes, and the rest of it goes with the roots: harmonically, so that a sheet between two lids is squeezed
    and a lash keeps its shape. The lower parts of the mouth go where the bottom of the chin (FDP 2.1) goes, and drop
    the less, the nearer they are to the jaw's hinge. A part that lies across both halves is split: by the rows of
    teeth that it is nearer to, or without them by the lips' line. All other parts stay.

    Parameters
    ----------
    points : at least one on the skin.
    axes : (3, 3) of the head.
    parts : those that shall follow.
    """
    count = len(mesh.vertices)
    with_skin = _on_skin(mesh, points, parts)
    follows = sp.kron(with_skin, sp.identity(3), format="csr")
    if set(points.names) >= NEEDED and any(part.kind in WITH_JAW for part in parts):
        follows = follows + _with_jaw(mesh, points, axes, parts)
    entries = follows.tocoo()
    entries.eliminate_zeros()
    used = np.zeros((2, count), bool)
    used[0, entries.row // 3] = used[1, entries.col // 3] = True
    riders, carriers = (np.flatnonzero(one) for one in used)
    matrix = follows[_interleaved(riders)][:, _interleaved(carriers)].astype(np.float32)
    return Following(axes, riders, carriers, matrix)


def _interleaved(vertices: IntArray) -> IntArray:
    """(3n,) rows of x, y, z of vertices (n,)."""
    rows: IntArray = (3 * vertices[:, None] + np.arange(3)).ravel()
    return rows


def _members(mesh: TriMesh, parts: Sequence[Part], kinds: Sequence[str]) -> BoolArray:
    """(V,) vertices of the parts of these kinds."""
    mask = np.zeros(len(mesh.vertices), bool)
    for part in parts:
        mask[part.vertices] |= part.kind in kinds
    return mask


def _on_skin(mesh: TriMesh, points: FeaturePoints, parts: Sequence[Part]) -> sp.csr_matrix:
    """(V, V) displacements of the skin to those of the parts that ride on it."""
    count = len(mesh.vertices)
    riding = [part for part in parts if part.kind in ON_SKIN]
    if not riding:
        return sp.csr_matrix((count, count))
    names = [name for name in points.names if name not in OWN_PARTS]
    skin = np.isin(mesh.components, mesh.components[points.subset(names).vertices[:, 0]])
    asked = np.concatenate([part.vertices for part in riding])
    found = SurfaceFinder(mesh, np.flatnonzero(skin[mesh.faces[:, 0]])).closest(mesh.vertices[asked])
    owner = np.repeat(np.arange(len(riding)), [len(part.vertices) for part in riding])
    nearest = np.full(len(riding), np.inf)
    np.minimum.at(nearest, owner, found.distance)
    rooted = found.distance <= nearest[owner] + ROOTS * eye_separation(mesh, points)
    roots = asked[rooted]
    corners, weights = np.zeros((count, 3), np.int64), np.zeros((count, 3))
    corners[roots], weights[roots] = mesh.faces[found.face[rooted]], found.weights[rooted]
    known = np.ones(count, bool)
    known[asked] = False
    known[roots] = True
    spread = HarmonicFill(mesh, known, np.zeros(count)).matrix()
    return (spread @ place_matrix(corners, weights, count)).tocsr()


def _with_jaw(mesh: TriMesh, points: FeaturePoints, axes: FloatArray, parts: Sequence[Part]) -> sp.csr_matrix:
    """(3V, 3V) displacements of the chin to those of the parts that go with the jaw, in the head's axes."""
    places = mesh.vertices @ axes.T
    # The top of the spine lies a little behind the jaw's hinge.
    where = place_missing(points.names, points.positions(places), ("2.1", "2.2", "2.3", "7.1"))
    lips = 0.5 * (where["2.2"] + where["2.3"])
    share = _members(mesh, parts, (LOWER, TONGUE)).astype(float)
    split = _members(mesh, parts, (BOTH,))
    if split.any():
        rows = [places[_members(mesh, parts, (kind,))] for kind in (UPPER, LOWER)]
        height = (lips[1] - places[split, 1]) / eye_separation(mesh, points)
        share[split] = _lower_half(places[split], height, *rows)
    lever = np.clip((places[:, 2] - where["7.1"][2]) / (where["2.1"][2] - where["7.1"][2]), 0.0, LEVER)
    chin = points.subset(["2.1"]).matrix(len(mesh.vertices))
    factors = share[:, None] * np.stack([np.ones_like(lever), lever, np.ones_like(lever)], axis=1)
    follow = sp.csr_matrix(np.ones((len(mesh.vertices), 1))) @ chin
    follow = sp.diags((share > 0).astype(float)) @ follow
    return (sp.diags(factors.ravel()) @ sp.kron(follow, sp.identity(3))).tocsr()


def _lower_half(places: FloatArray, below: FloatArray, upper: FloatArray, lower: FloatArray) -> FloatArray:
    """(n,) how far places (n, 3) belong to the lower half: from 0 to 1.

    below : (n,) how far they lie below the lips' line, in eye separations.
    upper, lower : (m, 3) places of the rows of teeth; where both are there, they decide.
    """
    off = below
    if len(upper) and len(lower):
        away, near = (cKDTree(row).query(places)[0] for row in (upper, lower))
        off = away / np.maximum(away + near, 1e-300) - 0.5
    step = np.clip(0.5 + 0.5 * off / BAND, 0.0, 1.0)
    smooth: FloatArray = step * step * (3 - 2 * step)
    return smooth
