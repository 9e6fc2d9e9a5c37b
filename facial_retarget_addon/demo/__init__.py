"""The built-in faces: an actor and targets made by code alone. No download, no asset, no bpy.

All faces are functions over one chart (`chart`), shaped by `sculpt`, moved by `acting`. Units: the
actor's eyes are 1 apart; the targets have other sizes on purpose. +Y is up, faces look along +Z.
"""

from __future__ import annotations

import numpy as np

from ..core.arrays import FloatArray
from .cast import (
    ACTOR,
    APE,
    APE_MANNER,
    BONE,
    CHERUB,
    CHILD,
    CHILD_MANNER,
    FUR,
    HUMAN,
    SKULL,
    SKULL_MANNER,
    childlike,
    smooth_warp,
)
from .expressions import performance_table
from .face import DemoFace, build_face
from .landmarks import POINTS
from .layouts import ringed_layout, scattered_layout
from .muscles import contractions
from .shape_sets import face_shapes

__all__ = [
    "POINTS",
    "DemoFace",
    "actor",
    "ape",
    "child",
    "contractions",
    "donor",
    "face_shapes",
    "performance",
    "performance_table",
    "targets",
    "warped_actor",
]


def actor(vertices: int = 42_000) -> DemoFace:
    """The actor: a human face of quads in rings around eyes and mouth.

    Parameters
    ----------
    vertices : about how many there shall be.

    Raises
    ------
    RetargetError : if they are too few for the feature points.
    """
    return _human("actor", vertices, with_jaw=False)


def donor(vertices: int = 12_000) -> DemoFace:
    """The actor with lower teeth and a tongue, all parts named: whom heads without shapes of their own get them from.

    Parameters and errors as `actor`.
    """
    return _human("donor", vertices, with_jaw=True)


def _human(name: str, vertices: int, with_jaw: bool) -> DemoFace:
    fineness = np.sqrt(vertices / 42_000)
    columns, rows, rings = (round(count * fineness) for count in (180, 200, 14))
    return build_face(name, ACTOR, ringed_layout(columns, rows, rings), HUMAN, {}, with_jaw=with_jaw, named=with_jaw)


def performance(face: DemoFace) -> FloatArray:
    """(F, V, 3) float32: the built-in performance, 24 frames a second, neutral at both ends."""
    return face.frames(performance_table())


def targets() -> list[DemoFace]:
    """Two faces of other topology, density, size and proportions, with examples in an artist's own manner."""
    return [
        ape(),
        build_face("skull", SKULL, ringed_layout(118, 132, 9), BONE, SKULL_MANNER),
    ]


def ape(spacing: float = 0.028) -> DemoFace:
    """The ape, on scattered triangles.

    Parameters
    ----------
    spacing : distance between neighbours in chart units; the actor's eyes are 1 apart.
    """
    return build_face("ape", APE, scattered_layout(spacing, np.random.default_rng(7)), FUR, APE_MANNER)


def child() -> DemoFace:
    """A light mesh of quads with a child's proportions and named parts: a third face to give motion or get it."""
    return build_face("child", CHILD, ringed_layout(64, 72, 6), CHERUB, CHILD_MANNER, childlike, named=True)


def warped_actor(rng: np.random.Generator, vertices: int = 40_000) -> DemoFace:
    """The actor through a smooth invertible warp, on scattered triangles: a target whose truth is known.

    Its frames are the warp of the actor's, so under equal contractions `frames` is the truth for any
    method that carries the actor's frames onto it.

    Parameters
    ----------
    rng : where the scatter and the warp come from.
    vertices : about how many there shall be.

    Raises
    ------
    RetargetError : if they are too few for the feature points.
    """
    spacing = 0.021 * np.sqrt(40_000 / vertices)
    return build_face("warped_actor", ACTOR, scattered_layout(spacing, rng), HUMAN, {}, smooth_warp(rng))
