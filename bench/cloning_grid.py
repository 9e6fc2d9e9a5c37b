"""The paper's grid: each of five built-in faces gives its expressions to each other one, and gets them back.

The pictures go to `build/cloning_grid/`: rows are sources, columns targets, and on the diagonal is each face's own
expression. A face's own version of a key comes from its own muscles, so a column shows one face in five manners.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import permutations
from pathlib import Path

import numpy as np

from facial_retarget_addon import demo
from facial_retarget_addon.core.arrays import FloatArray
from facial_retarget_addon.core.methods.base import Retargeter
from facial_retarget_addon.core.methods.motion_cloning import fit
from facial_retarget_addon.core.methods.settings import MotionCloningSettings
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.files.pages.pictures import Image, contact_sheet, png_bytes, shade

from .timing import Row

FOLDER = Path("build/cloning_grid")
SHOWN = ("surprise", "viseme_oh")
PICTURE = (240, 250)
SETS = ("visemes", "expressions")
MEAN, WORST = 0.10, 0.18
"""Bounds on the drift over all pairs."""


@dataclass(frozen=True, eq=False)
class Actor:
    """A face that acts, and its own version of every key."""

    demo: demo.DemoFace

    @property
    def face(self) -> Face:
        """Mesh and points, without examples."""
        return Face(self.demo.face.mesh, self.demo.face.points)

    @cached_property
    def shapes(self) -> Mapping[str, FloatArray]:
        """Positions (V, 3) by name."""
        return demo.face_shapes(self.demo, SETS)

    @property
    def frames(self) -> FloatArray:
        """(E, V, 3) of all keys."""
        return np.stack(list(self.shapes.values()))

    def drift(self, found: FloatArray) -> FloatArray:
        """(E,) L2 of what frames (E, V, 3) miss of the own keys' motion over L2 of that motion, on the skin."""
        skin = slice(0, len(self.demo.places))
        own = self.frames[:, skin].astype(np.float64)
        missed = np.square(found[:, skin] - own).sum(axis=(1, 2))
        moved = np.square(own - self.demo.face.mesh.vertices[skin]).sum(axis=(1, 2))
        return np.asarray(np.sqrt(missed / moved))

    def picture(self, positions: FloatArray) -> Image:
        """The face in a shape (V, 3)."""
        skin = self.demo.face.mesh.vertices[: len(self.demo.places)]
        faces = self.demo.face.mesh.faces
        return shade(positions.astype(np.float64), faces, PICTURE, frame=skin, colours=self.demo.colours)


def cast() -> dict[str, Actor]:
    """The five faces: meshes of 8 000 to 24 000 vertices, sizes from 0.06 to 40."""
    warped = demo.warped_actor(np.random.default_rng(3), vertices=12_000)
    faces = (demo.actor(vertices=20_000), *demo.targets(), warped, demo.child())
    return {face.name: Actor(face) for face in faces}


def rows() -> Iterator[Row]:
    """Second-generation drift: keys that went from one face to another and back, against the first face's own."""
    actors = cast()
    for variant in ("default", "paper"):
        fitted = {pair: _fit(actors, pair, variant) for pair in permutations(actors, 2)}
        if variant == "default":
            _draw(actors, fitted)
        found = {}
        for first, second in fitted:
            back = fitted[second, first].frames(fitted[first, second].frames(actors[first].frames))
            errors = actors[first].drift(back)
            found[first, second] = float(errors.mean())
            yield Row(f"{variant}: {first} to {second} and back, mean of {len(errors)} keys", errors.mean(), "")
        bounded = variant == "default"
        yield Row(f"{variant}: all pairs, mean", float(np.mean(list(found.values()))), "", MEAN if bounded else None)
        worst = max(found, key=lambda pair: found[pair])
        yield Row(
            f"{variant}: worst pair, {worst[0]} to {worst[1]} and back", found[worst], "", WORST if bounded else None
        )


def _fit(actors: Mapping[str, Actor], pair: tuple[str, str], variant: str) -> Retargeter:
    source, target = (actors[name].face for name in pair)
    # The paper keeps motion in the heads' axes.
    motion = "local" if variant == "default" else "compliant"
    return fit(Problem(source, target), MotionCloningSettings(variant=variant, motion=motion))


def _draw(actors: Mapping[str, Actor], fitted: Mapping[tuple[str, str], Retargeter]) -> None:
    FOLDER.mkdir(parents=True, exist_ok=True)
    for key in SHOWN:
        pictures = []
        for source in actors:
            own = actors[source].shapes[key]
            for target in actors:
                shown = own if source == target else fitted[source, target].frames(own[None])[0]
                pictures.append(actors[target].picture(shown))
        (FOLDER / f"{key}.png").write_bytes(png_bytes(contact_sheet(pictures, len(actors))))
