"""The paper's grid: each of five faces gives its expressions to each other one, and gets them back.

The pictures go to `build/cloning_grid/`: rows are sources, columns targets, and on the diagonal is each face's own
expression. A face's own version of a key comes from its own muscles or its own artist, so a column shows one face in
five manners. The same once more with real heads among the five, where their data is there.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import permutations
from pathlib import Path

import numpy as np

from facial_retarget_addon import demo
from facial_retarget_addon.core.arrays import BoolArray, FloatArray
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.methods.base import Retargeter
from facial_retarget_addon.core.methods.motion_cloning import fit
from facial_retarget_addon.core.methods.settings import MotionCloningSettings
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.files.images import png_bytes
from facial_retarget_addon.files.pages.pictures import Image, contact_sheet, shade
from facial_retarget_addon.files.points import read_points

from .real_pair import DATA
from .timing import Row

FOLDER = Path("build/cloning_grid")
PICTURE = (240, 250)
SHOWN = ("surprise", "viseme_oh")
COMBINED: Mapping[str, Mapping[str, float]] = {
    "surprise": {
        **{"browInnerUp": 1.0, "browOuterUpLeft": 1.0, "browOuterUpRight": 1.0},
        **{"eyeWideLeft": 1.0, "eyeWideRight": 1.0, "jawOpen": 0.7},
    },
    "viseme_oh": {"jawOpen": 0.45, "mouthFunnel": 0.6},
}
"""The shown keys out of ARKit's, where a head has no others."""
REAL = {
    "ict_dev": "ict_facekit/ict",
    "male_adult_08": "rocketbox/male_adult_08",
    "johnsmith_welded": "johnsmith/johnsmith",
}
"""Real heads that have ARKit's shapes -> how the map of names calls their set."""
MEAN, WORST = 0.11, 0.18
"""Bounds on the drift over all pairs of built-in faces."""


@dataclass(frozen=True, eq=False)
class Actor:
    """A face that acts.

    Attributes
    ----------
    face : mesh, points and named parts.
    shapes : its own version of every key, (V, 3) positions by name.
    skin : (V,) which vertices count.
    colours : (V, 3), or None.
    """

    face: Face
    shapes: Mapping[str, FloatArray]
    skin: BoolArray
    colours: FloatArray | None

    @classmethod
    def built_in(cls, made: demo.DemoFace, sets: Sequence[str]) -> Actor:
        """A built-in face with some sets of shapes."""
        mesh = made.face.mesh
        skin = np.arange(len(mesh.vertices)) < len(made.places)
        return cls(replace(made.face, examples={}), demo.face_shapes(made, sets), skin, made.colours)

    @property
    def frames(self) -> FloatArray:
        """(E, V, 3) of all keys."""
        return np.stack(list(self.shapes.values()))

    def drift(self, found: FloatArray) -> FloatArray:
        """(E,) L2 of what frames (E, V, 3) miss of the own keys' motion over L2 of that motion, on the skin."""
        own = self.frames[:, self.skin].astype(np.float64)
        missed = np.square(found[:, self.skin] - own).sum(axis=(1, 2))
        moved = np.square(own - self.face.mesh.vertices[self.skin]).sum(axis=(1, 2))
        return np.asarray(np.sqrt(missed / moved))

    def picture(self, positions: FloatArray) -> Image:
        """The face in a shape (V, 3), framed by its points."""
        places = self.face.points.positions(self.face.mesh.vertices)
        low, high = places.min(axis=0), places.max(axis=0)
        frame = np.stack([low, high]) + 0.12 * (high[1] - low[1]) * np.array([[-1.0], [1.0]])
        return shade(positions.astype(np.float64), self.face.mesh.faces, PICTURE, frame=frame, colours=self.colours)


def built_in_cast() -> dict[str, Actor]:
    """Five built-in faces: meshes of 8 000 to 24 000 vertices, sizes from 0.06 to 40."""
    warped = demo.warped_actor(np.random.default_rng(3), vertices=12_000)
    faces = (demo.actor(vertices=20_000), *demo.targets(), warped, demo.child())
    return {face.name: Actor.built_in(face, ("visemes", "expressions")) for face in faces}


def real_cast() -> dict[str, Actor]:
    """Three real heads and two built-in faces, with the shown keys made of ARKit's; none where the data is absent."""
    if not (DATA / "ict_dev.npz").exists():
        print(f"(left out: the real heads are not in {DATA.name})")
        return {}
    names = json.loads((DATA / "arkit_name_map.json").read_text())["map"]
    built = {face.name: Actor.built_in(face, ("arkit",)) for face in (demo.actor(vertices=20_000), demo.child())}
    heads = built | {name: _real(name, names[of]) for name, of in REAL.items()}
    return {name: replace(head, shapes=_combined(head)) for name, head in heads.items()}


def _real(name: str, own_names: Mapping[str, Sequence[str]]) -> Actor:
    with np.load(DATA / f"{name}.npz") as data:
        mesh = TriMesh(data["vertices"], data["tris"])
        moves = dict(zip(map(str, data["expr_names"]), data["expr_delta"], strict=True))
    points = read_points(DATA / f"{name.removesuffix('_dev').removesuffix('_welded')}_points.json", mesh)
    shapes = {key: mesh.vertices + sum(moves[own] for own in made_of) for key, made_of in own_names.items()}
    return Actor(Face(mesh, points), shapes, np.ones(len(mesh.vertices), bool), None)


def _combined(head: Actor) -> dict[str, FloatArray]:
    rest = head.face.mesh.vertices
    return {
        key: (rest + sum(share * (head.shapes[part] - rest) for part, share in parts.items())).astype(np.float32)
        for key, parts in COMBINED.items()
    }


def rows() -> Iterator[Row]:
    """Second-generation drift: keys that went from one face to another and back, against the first face's own.

    Of the built-in faces only: a real head moves neck and mouth inside, which not every head has to give them back.
    """
    actors = built_in_cast()
    for variant in ("default", "paper"):
        fitted = _fitted(actors, variant)
        if variant == "default":
            _draw(actors, fitted, "built_in")
        found = {}
        for first, second in fitted:
            there = fitted[first, second].frames(actors[first].frames)
            errors = actors[first].drift(fitted[second, first].frames(there))
            found[first, second] = float(errors.mean())
            yield Row(f"{variant}: {first} to {second} and back, mean of {len(errors)} keys", errors.mean(), "")
        bounded = variant == "default"
        yield Row(f"{variant}: all pairs, mean", float(np.mean(list(found.values()))), "", MEAN if bounded else None)
        first, second = max(found, key=lambda pair: found[pair])
        what = f"{variant}: worst pair, {first} to {second} and back"
        yield Row(what, found[first, second], "", WORST if bounded else None)
    heads = real_cast()
    if heads:
        _draw(heads, _fitted(heads, "default"), "real")


def _fitted(actors: Mapping[str, Actor], variant: str) -> dict[tuple[str, str], Retargeter]:
    return {pair: _fit(actors, pair, variant) for pair in permutations(actors, 2)}


def _fit(actors: Mapping[str, Actor], pair: tuple[str, str], variant: str) -> Retargeter:
    source, target = (actors[name].face for name in pair)
    # The paper keeps motion in the heads' axes.
    motion = "local" if variant == "default" else "compliant"
    return fit(Problem(source, target), MotionCloningSettings(variant=variant, motion=motion))


def _draw(actors: Mapping[str, Actor], fitted: Mapping[tuple[str, str], Retargeter], what: str) -> None:
    FOLDER.mkdir(parents=True, exist_ok=True)
    for key in SHOWN:
        pictures = []
        for source in actors:
            own = actors[source].shapes[key]
            for target in actors:
                shown = own if source == target else fitted[source, target].frames(own[None])[0]
                pictures.append(actors[target].picture(shown))
        (FOLDER / f"{what}_{key}.png").write_bytes(png_bytes(contact_sheet(pictures, len(actors))))
