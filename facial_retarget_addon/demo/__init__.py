"""The built-in faces: an actor and targets made by code alone. No download, no asset, no bpy.

All faces are functions over one chart (`chart`), shaped by `sculpt`, moved by `muscles`. Units: the
actor's eyes are 1 apart; the targets have other sizes on purpose. +Y is up, faces look along +Z.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray, IntArray
from ..core.mesh import TriMesh
from ..core.methods.base import Face
from ..core.points import FeaturePoints
from .chart import Layout, ringed_layout, scattered_layout
from .expressions import EXPRESSIONS, performance_table
from .landmarks import POINTS, point_places
from .muscles import Acting, contractions
from .paint import skin_colours
from .parts import parts
from .sculpt import Sculpture, Shape

__all__ = ["DemoFace", "actor", "contractions", "performance", "performance_table", "targets", "warped_actor"]

Warp = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, eq=False)
class DemoFace:
    """A built-in face: skin first, then eyeballs, teeth and the mouth's back wall, which stay put.

    Attributes
    ----------
    name : what to call it in files and scenes.
    counts : (P,) corners of each polygon.
    corners : (sum of counts,) vertex indices, polygon after polygon.
    uvs : (V, 2) one texture place for each vertex.
    colours : (V, 3) linear colours from 0 to 1.
    face : neutral mesh, feature points, the seven examples.
    places : (N, 2) chart places of the skin's vertices, which are the first N: equal places are the same skin.
    """

    name: str
    counts: IntArray
    corners: IntArray
    uvs: FloatArray
    colours: FloatArray
    face: Face
    places: FloatArray
    _acting: Acting
    _warp: Warp

    def frames(self, table: FloatArray) -> FloatArray:
        """Positions (F, V, 3) float32 under contractions (F, A), as `contractions` makes them."""
        still = self.face.mesh.vertices[len(self.places) :].astype(np.float32)
        skin = self._warp(self._acting.frames(table))
        return np.concatenate([skin, np.broadcast_to(still, (len(skin), *still.shape))], axis=1, dtype=np.float32)


def actor() -> DemoFace:
    """The actor: a human face of quads in rings around eyes and mouth."""
    return _build("actor", Shape(), ringed_layout(180, 190, 14), {})


def performance(face: DemoFace) -> FloatArray:
    """(F, V, 3) float32: the built-in performance, 24 frames a second, neutral at both ends."""
    return face.frames(performance_table())


def targets() -> list[DemoFace]:
    """Two faces of other topology, density, size and proportions, with examples in their own manner."""
    ape = Shape(
        scale=9.0,
        brow=2.6,
        socket=1.15,
        cheekbone=0.8,
        nose=0.36,
        nose_width=1.35,
        muzzle=3.4,
        lips=0.9,
        chin=0.1,
        profile=(
            (1.05, -0.12, -0.30, 0.92),
            (0.55, -0.06, -0.13, 0.96),
            (0.25, 0.0, 0.02, 1.0),
            (0.0, 0.0, 0.0, 1.0),
            (-0.5, -0.02, 0.05, 1.02),
            (-1.05, -0.12, 0.14, 1.18),
            (-1.6, -0.12, 0.06, 1.15),
            (-2.5, 0.0, 0.0, 1.1),
        ),
    )
    skull = Shape(
        scale=0.06,
        brow=1.3,
        socket=1.45,
        cheekbone=1.9,
        hollow=3.4,
        nose=0.6,
        nose_width=0.85,
        lips=0.5,
        chin=1.3,
        eye=1.05,
        profile=(
            (1.05, 0.18, 0.02, 1.16),
            (0.55, 0.08, 0.03, 1.10),
            (0.0, 0.0, 0.0, 1.0),
            (-0.6, 0.04, -0.04, 0.92),
            (-1.1, 0.08, -0.04, 0.80),
            (-1.7, 0.06, 0.0, 0.72),
            (-2.5, 0.06, -0.05, 0.66),
        ),
    )
    return [
        _build("ape", ape, scattered_layout(0.028, np.random.default_rng(7)), _APE_MANNER),
        _build("skull", skull, ringed_layout(118, 132, 9), _SKULL_MANNER),
    ]


_APE_MANNER = {"zygomatic": 0.8, "jaw": 1.15, "levator": 1.2, "frontalis_outer": 0.8, "pucker": 1.4}
_SKULL_MANNER = {"zygomatic": 1.2, "risorius": 1.2, "jaw": 1.1, "frontalis_inner": 0.8, "corrugator": 1.1}
"""An artist's own taste in the target's examples: factors on the contractions."""


def warped_actor(rng: np.random.Generator) -> DemoFace:
    """The actor through a smooth invertible warp, on scattered triangles: a target whose truth is known.

    Its frames are the warp of the actor's, so under equal contractions `frames` is the truth for any
    method that carries the actor's frames onto it.
    """
    return _build("warped_actor", Shape(), scattered_layout(0.021, rng), {}, _smooth_warp(rng))


def _unwarped(positions: FloatArray) -> FloatArray:
    return positions


def _smooth_warp(rng: np.random.Generator) -> Warp:
    """A warp whose gradient stays within 0.45 of the identity's stretch, so it cannot fold."""
    stretch = np.array([1.12, 0.92, 1.05])
    waves = rng.normal(size=(6, 3))
    waves *= 2.2 / np.linalg.norm(waves, axis=1, keepdims=True)
    ways = rng.normal(size=(6, 3))
    ways *= 0.03 / np.linalg.norm(ways, axis=1, keepdims=True)
    phases = rng.uniform(0, 2 * np.pi, 6)

    def warp(positions: FloatArray) -> FloatArray:
        return positions * stretch + np.sin(positions @ waves.T + phases) @ ways

    return warp


def _build(name: str, shape: Shape, layout: Layout, strength: dict[str, float], warp: Warp = _unwarped) -> DemoFace:
    layout, vertices = layout.pinned(point_places())
    sculpture = Sculpture(shape)
    acting = Acting(sculpture, layout.places, strength)
    behind = parts(sculpture)
    positions = [warp(acting.neutral), *(warp(part.vertices) for part in behind)]
    polygons = [layout.polygons]
    first = len(layout.places)
    for part in behind:
        polygons.append(part.quads + first)
        first += len(part.vertices)
    counts = np.concatenate([np.full(len(p), p.shape[1], np.int64) for p in polygons])
    corners = np.concatenate([p.ravel() for p in polygons])
    low, high = layout.places.min(axis=0), layout.places.max(axis=0)
    uvs = 0.12 + 0.86 * (layout.places - low) / (high - low)
    points = FeaturePoints(
        tuple(POINTS), np.repeat(vertices[:, None], 3, axis=1), np.tile([1.0, 0.0, 0.0], (len(POINTS), 1))
    )
    mesh = TriMesh.from_polygons(np.concatenate(positions), counts, corners)
    neutral = DemoFace(
        name,
        counts,
        corners,
        np.concatenate([uvs, *(part.uvs for part in behind)]),
        np.concatenate([skin_colours(layout.places), *(part.colours for part in behind)]),
        Face(mesh, points),
        layout.places,
        acting,
        warp,
    )
    examples = neutral.frames(contractions(*EXPRESSIONS.values())).astype(np.float64)
    examples[0] = mesh.vertices
    face = Face(mesh, points, dict(zip(EXPRESSIONS, examples, strict=True)))
    return DemoFace(**{**neutral.__dict__, "face": face})
