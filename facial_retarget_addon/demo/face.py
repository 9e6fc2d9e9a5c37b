"""A built-in face as a mesh: skin over the chart, and the parts behind it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from ..core.arrays import FloatArray, IntArray
from ..core.mesh import TriMesh
from ..core.points import FeaturePoints
from ..core.problem import Face
from .acting import Acting
from .expressions import EXPRESSIONS
from .landmarks import POINTS
from .layouts import Layout
from .moving_parts import Gaze, MovingPart, OnJaw
from .muscles import contractions
from .paint import Palette, skin_colours
from .parts import Part, jaw_parts, skull_parts
from .sculpt import Sculpture

Warp = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, eq=False)
class DemoFace:
    """A built-in face: skin first, then what lies behind it.

    Attributes
    ----------
    name : what to call it in files and scenes.
    counts : (P,) corners of each polygon.
    corners : (sum of counts,) vertex indices, polygon after polygon.
    uvs : (V, 2) one texture place for each vertex.
    colours : (V, 3) linear colours from 0 to 1.
    face : neutral mesh, feature points, the seven examples.
    places : (N, 2) chart places of the skin's vertices, which are the first N: equal places are the same skin.
    acting : moves the skin, before the warp.
    moving : the parts that act, eyeballs first, before the warp.
    warp : what the finished positions go through.
    """

    name: str
    counts: IntArray
    corners: IntArray
    uvs: FloatArray
    colours: FloatArray
    face: Face
    places: FloatArray
    acting: Acting
    moving: tuple[MovingPart, ...]
    warp: Warp

    def frames(self, table: FloatArray, wrinkles: float = 1.0) -> FloatArray:
        """Positions (F, V, 3) float32 under contractions (F, A), as `contractions` makes them.

        wrinkles : factor on the height of the wrinkles; 0 for the same acting on skin that never folds.
        """
        moved = self.acting.displacements(table, wrinkles)
        moved += self.acting.neutral
        frames = np.repeat(self.face.mesh.vertices[None].astype(np.float32), len(table), axis=0)
        frames[:, : len(self.places)] = self.warp(moved)
        table = self.acting.felt(table)
        for part in self.moving:
            acting = np.flatnonzero(table[:, part.columns].any(axis=1))
            frames[np.ix_(acting, part.rows)] = self.warp(part.positions(table[acting]))
        return frames


def unwarped(positions: FloatArray) -> FloatArray:
    """The positions as they are."""
    return positions


def build_face(
    name: str,
    sculpture: Sculpture,
    layout: Layout,
    palette: Palette,
    manner: Mapping[str, float],
    warp: Warp = unwarped,
    with_jaw: bool = False,
    named: bool = False,
) -> DemoFace:
    """Mesh a sculpture.

    Parameters
    ----------
    name : what to call the face.
    sculpture : its shape.
    layout : mesh of the chart; the nearest vertices are moved onto the feature points.
    palette : its colours.
    manner : action name without side -> factor on its contraction.
    warp : what all positions go through, for a face that no sculpture makes.
    with_jaw : whether it has lower teeth and a tongue.
    named : whether its parts are named, as an artist may do.
    """
    layout, vertices = layout.pinned(np.array(list(POINTS.values())))
    acting = Acting(sculpture, layout.places, manner)
    low, high = layout.places.min(axis=0), layout.places.max(axis=0)
    skin = Part(
        acting.neutral,
        layout.polygons,
        0.12 + 0.86 * (layout.places - low) / (high - low),
        skin_colours(layout.places, palette),
    )
    behind = skull_parts(sculpture) | (jaw_parts(sculpture) if with_jaw else {})
    pieces = [skin, *behind.values()]
    first = np.cumsum([0, *(len(piece.vertices) for piece in pieces)])
    rows = {part: np.arange(*first[k : k + 2]) for k, part in enumerate(behind, start=1)}
    moving: list[MovingPart] = [
        Gaze(sculpture, side[0], behind[f"{side} eyeball"], rows[f"{side} eyeball"]) for side in ("left", "right")
    ]
    moving += [OnJaw(sculpture, part, behind[part], rows[part]) for part in ("lower teeth", "tongue") if part in rows]
    counts = np.concatenate([np.full(len(piece.polygons), piece.polygons.shape[1]) for piece in pieces])
    corners = np.concatenate([(piece.polygons + at).ravel() for piece, at in zip(pieces, first[:-1], strict=True)])
    # In float32, so that the frames, which are float32, start from exactly this neutral.
    positions = warp(np.concatenate([piece.vertices for piece in pieces])).astype(np.float32)
    mesh = TriMesh.from_polygons(positions, counts, corners)
    corner_weights = np.tile([1.0, 0.0, 0.0], (len(POINTS), 1))
    points = FeaturePoints(tuple(POINTS), np.repeat(vertices[:, None], 3, axis=1), corner_weights)
    names = {part: held[:1] for part, held in rows.items()} if named else {}
    face = DemoFace(
        name=name,
        counts=counts.astype(np.int64),
        corners=corners,
        uvs=np.concatenate([piece.uvs for piece in pieces]),
        colours=np.concatenate([piece.colours for piece in pieces]),
        face=Face(mesh, points, named_parts=names),
        places=layout.places,
        acting=acting,
        moving=tuple(moving),
        warp=warp,
    )
    examples = face.frames(contractions(*EXPRESSIONS.values())).astype(np.float64)
    return replace(face, face=replace(face.face, examples=dict(zip(EXPRESSIONS, examples, strict=True))))
