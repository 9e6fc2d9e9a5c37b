"""A surface that follows its feature points: one sparse matrix, so that a frame is a product.

The weights of Kshirsagar et al. (`point_weights`), then three things of our own, in the default variant: lids close
along their whole width and over the eyeball, the shares are evened out along the surface, and every point arrives
exactly where it is sent.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from ..arrays import BoolArray, FloatArray
from ..mesh import TriMesh
from ..parts.kinds import NO_NAMES, NamedParts
from ..points import FeaturePoints
from .eyeballs import Eyeball, find_eyeballs
from .eyelids import Lid, around_the_ball, find_lids, half_shut
from .point_weights import point_weights
from .refined_shares import FAINT, refine_shares, smoothing

LID_REACH = 0.75
"""How far a lid reaches towards the nearest brow, as a share of the way."""
LID_GAPS = 1.5
"""How far a lid reaches on a face without brow points, in gaps between the lids."""
ROUNDS = 4
"""How often what a lid's guides miss of their way is sent after them."""


@dataclass(frozen=True, eq=False)
class PointDeformer:
    """A surface's displacement for any displacement of its points; linear.

    Attributes
    ----------
    axes : (3, 3) rows: the axes that the weights were found for.
    matrix : (3V, 3P) csr float32, from the points' displacements to the vertices', both in those axes.
    arcs : (3V, L) csr float32, what lifts each lid's skin over the eyeball when the lid is half shut, in those axes.
    eyeballs : by side.
    lids : whose margins were found.
    lid_rows : the point in the middle of each.
    warnings : what an artist should know.
    """

    axes: FloatArray
    matrix: sp.csr_matrix
    arcs: sp.csr_matrix
    eyeballs: dict[str, Eyeball]
    lids: tuple[Lid, ...]
    lid_rows: tuple[int, ...]
    warnings: tuple[str, ...]

    def displacements(self, points: FloatArray) -> FloatArray:
        """Displacements (F, V, 3) float32 of the vertices for (F, P, 3) of the points, in the object's axes."""
        points = np.asarray(points, np.float64)
        turned = (points @ self.axes.T).astype(np.float32)
        moved: FloatArray = self.matrix @ turned.reshape(len(turned), -1).T
        if self.lids:
            moved += self.arcs @ self.half_shut(points).T.astype(np.float32)
        back: FloatArray = np.ascontiguousarray(moved.T).reshape(len(turned), -1, 3) @ self.axes.astype(np.float32)
        return back

    def half_shut(self, points: FloatArray) -> FloatArray:
        """(F, L) how near each lid is to half the way, for displacements (F, P, 3) of the points."""
        shares = [half_shut(lid.shut(points[:, row])) for row, lid in zip(self.lid_rows, self.lids, strict=True)]
        return np.stack(shares, axis=1) if shares else np.zeros((len(points), 0))


def fit_deformer(
    mesh: TriMesh,
    points: FeaturePoints,
    axes: FloatArray,
    acting: BoolArray,
    variant: str = "default",
    shut_lids: bool = True,
    named: NamedParts = NO_NAMES,
) -> PointDeformer:
    """Weights of a surface's points.

    Parameters
    ----------
    mesh : V vertices.
    points : P places on it.
    axes : (3, 3) rows left, up, forward of the head.
    acting : (P, 3) whether a point moves or holds the surface along an axis.
    variant : default, or paper for the weights as published and nothing else.
    shut_lids : whether the points of lids close them, as in acting; otherwise they are points as others are.
    named : parts that the artist named.

    Raises
    ------
    RetargetError : for faces or places that do not fit.
    """
    eyeballs = find_eyeballs(mesh, points, axes, named)
    acting = acting & ~_on_eyeballs(mesh, points, eyeballs)[:, None]
    if variant == "paper":
        blocks = point_weights(mesh, points, acting, variant)
        arcs = sp.csr_matrix((3 * len(mesh.vertices), 0), dtype=np.float32)
        return PointDeformer(axes, _interleaved(blocks).astype(np.float32), arcs, eyeballs, (), (), ())
    margins = find_lids(mesh, points, eyeballs) if shut_lids else []
    lids = [lid for lid in margins if acting[points.index([lid.middle])[0]].any()]
    joined = points.joined(_guides(lids))
    owner = points.index([lid.middle for lid in lids for _ in lid.vertices])
    acts = np.concatenate([acting, acting[owner]])
    weights = point_weights(mesh, joined, acts, variant, _farthest(mesh, points, lids))
    smooth = smoothing(points.positions(mesh.vertices) @ axes.T)
    blocks, warnings = refine_shares(mesh, joined, len(points), acts, weights, smooth)
    straight = _interleaved(blocks)
    sent = _sent_after(straight, _folded(len(points), lids, points, axes), lids)
    bends, arcs = _around_the_balls(mesh, points, straight, sent, lids, eyeballs, axes)
    matrix = straight @ sent + bends
    rows = tuple(int(row) for row in points.index([lid.middle for lid in lids]))
    return PointDeformer(
        axes, matrix.astype(np.float32), arcs.astype(np.float32), eyeballs, tuple(lids), rows, tuple(warnings)
    )


def _on_eyeballs(mesh: TriMesh, points: FeaturePoints, eyeballs: dict[str, Eyeball]) -> BoolArray:
    """(P,) points that lie on an eyeball: it turns as a whole."""
    ball = np.zeros(len(mesh.vertices), bool)
    for eye in eyeballs.values():
        ball[eye.vertices] = True
    on: BoolArray = ball[points.holders]
    return on


def _guides(lids: list[Lid]) -> FeaturePoints:
    """The lids' guides as points on single vertices."""
    vertices = np.concatenate([lid.vertices for lid in lids] or [np.empty(0, np.int64)])
    names = tuple(f"{lid.middle} guide {k}" for lid in lids for k in range(len(lid.vertices)))
    return FeaturePoints(names, np.repeat(vertices[:, None], 3, axis=1), np.tile([1.0, 0.0, 0.0], (len(vertices), 1)))


def _farthest(mesh: TriMesh, points: FeaturePoints, lids: list[Lid]) -> FloatArray:
    """(P + G,) where the reach of points and guides ends: a lid does not drag the brow."""
    where = points.positions(mesh.vertices)
    farthest = np.full(len(points) + sum(len(lid.vertices) for lid in lids), np.inf)
    brows = where[[row for row, name in enumerate(points.names) if name.startswith("4.")]]
    first = len(points)
    for lid in lids:
        middle = int(points.index([lid.middle])[0])
        away = np.linalg.norm(brows - where[middle], axis=1).min(initial=np.inf)
        end = min(LID_REACH * away, LID_GAPS * float(np.linalg.norm(lid.gap)))
        farthest[middle] = farthest[first : first + len(lid.vertices)] = end
        first += len(lid.vertices)
    return farthest


def _interleaved(blocks: tuple[sp.csr_matrix, ...]) -> sp.csr_matrix:
    """(3V, 3P) from three (V, P): x, y, z of each vertex one after the other."""
    parts = [part.tocoo() for part in blocks]
    rows = np.concatenate([3 * part.row.astype(np.int64) + axis for axis, part in enumerate(parts)])
    columns = np.concatenate([3 * part.col.astype(np.int64) + axis for axis, part in enumerate(parts)])
    shape = 3 * blocks[0].shape[0], 3 * blocks[0].shape[1]
    return sp.csr_matrix((np.concatenate([part.data for part in parts]), (rows, columns)), shape=shape)


def _folded(count: int, lids: list[Lid], points: FeaturePoints, axes: FloatArray) -> sp.csr_matrix:
    """(3 (P + G), 3P) what points and guides do when the points move, in the head's axes."""
    rows, columns, values = [np.arange(3 * count)], [np.arange(3 * count)], [np.ones(3 * count)]
    first = count
    for lid in lids:
        middle = int(points.index([lid.middle])[0])
        turned = axes @ lid.guidance() @ axes.T
        guide, row, column = np.indices(turned.shape)
        rows.append((3 * (first + guide) + row).ravel())
        columns.append((3 * middle + column).ravel())
        values.append(turned.ravel())
        first += len(lid.vertices)
    entries = np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))
    return sp.csr_matrix(entries, shape=(3 * first, 3 * count))


def _sent_after(straight: sp.csr_matrix, sent: sp.csr_matrix, lids: list[Lid]) -> sp.csr_matrix:
    """What is sent, (3 (P + G), 3P), with what the guides miss of it sent after them: a lid shuts along its margin.

    Guides arrive only nearly where each of them is sent. What a whole lid's guides miss together is smooth, so that a
    few rounds bring them there without wild motion beside them.
    """
    wanted = sent[sent.shape[1] :]
    guides = np.concatenate([lid.vertices for lid in lids] or [np.empty(0, np.int64)])
    arriving = straight[(3 * guides[:, None] + np.arange(3)).ravel()]
    for _ in range(ROUNDS):
        missed = wanted - arriving @ sent
        sent = sent + sp.vstack([sp.csr_matrix((sent.shape[1], sent.shape[1])), missed], format="csr")
    return sent


def _around_the_balls(
    mesh: TriMesh,
    points: FeaturePoints,
    straight: sp.csr_matrix,
    sent: sp.csr_matrix,
    lids: list[Lid],
    eyeballs: dict[str, Eyeball],
    axes: FloatArray,
) -> tuple[sp.csr_matrix, sp.csr_matrix]:
    """(3V, 3P) what bends closing lids around the eyeballs, and (3V, L) the rest of it that only half the way needs.

    straight : (3V, 3 (P + G)) the motion of points and guides, in the head's axes.
    sent : (3 (P + G), 3P) what points and guides are sent when the points move.
    """
    middles = points.index([lid.middle for lid in lids])
    others = np.setdiff1d(np.arange(len(points)), middles)
    lid_points, held = (np.unique(points.vertices[rows][points.weights[rows] > 0]) for rows in (middles, others))
    bends = sp.lil_matrix((straight.shape[0], 3 * len(points)))
    arcs = sp.lil_matrix((straight.shape[0], len(lids)))
    first = len(points)
    for column, lid in enumerate(lids):
        ball, middle = eyeballs[lid.side], int(points.index([lid.middle])[0])
        senders = np.array([middle, *range(first, first + len(lid.vertices))])
        first += len(lid.vertices)
        shut = (straight @ (sent[:, 3 * middle : 3 * middle + 3] @ (axes @ lid.gap))).reshape(-1, 3) @ axes
        # How far a vertex rises is shared out as its motion upwards is.
        rise = straight[1::3][:, 3 * senders + 1] @ np.array([lid.rise, *lid.rises])
        skin = np.flatnonzero(np.linalg.norm(shut, axis=1) > FAINT * np.linalg.norm(lid.gap))
        # Every point stays where it is sent, a lid's own along its height, which it is measured by.
        free = np.repeat(~np.isin(skin, held)[:, None], 3, axis=1)
        free[:, 1] &= ~np.isin(skin, lid_points)
        whole, half = (
            free
            * ((around_the_ball(mesh, ball, skin, part * shut[skin], part * rise[skin]) - part * shut[skin]) @ axes.T)
            for part in (1.0, 0.5)
        )
        rows, gap = (3 * skin[:, None] + np.arange(3)).ravel(), axes @ lid.gap
        bends[rows, 3 * middle : 3 * middle + 3] = np.outer(whole.ravel(), gap / (gap @ gap))
        arcs[rows, column] = (half - 0.5 * whole).reshape(-1, 1)
    return bends.tocsr(), arcs.tocsr()
