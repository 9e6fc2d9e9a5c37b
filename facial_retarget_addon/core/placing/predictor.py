"""Predicts where the missing feature points of a face lie, from those that an artist placed."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ..acting.eyeballs import fit_sphere
from ..arrays import FloatArray, IntArray, unit_vectors
from ..closest_point import SurfaceFinder
from ..errors import RetargetError
from ..mesh import TriMesh
from ..points import FeaturePoints
from ..raycast import CasterFactory, EmbreeCaster
from ..rigid import fit_similarity
from .doubts import doubtful_rows
from .face_fit import CLEAR, EXACT, VAGUE, FaceFit, fit_face
from .guess import FoundFace, find_face
from .openings import believed_landmarks
from .outside import is_ball, seen_from_outside
from .partners import across, closest_mirror
from .pieces import members, pieces_of
from .skin import Skin, closest_looking
from .template import Template, face_template, partner

SYMMETRIC = 0.003
"""Halves that differ by less, in eye separations, are mirror images."""
SIZE = 0.25
"""An eye separation, as a share of the mesh's size, where too few points tell it."""
LEAST = 3
"""Known points from which others can be predicted without looking for the face."""
NO_FACE = 0.34
"""A surface that is this unlike the average face is none."""
MOST_SKINS, LEAST_SKIN = 3, 0.1
"""Pieces on which a face is looked for: how many of the largest, and the least share of the mesh's area."""
PUPILS = ("3.5", "3.6")
LARGEST = 0.3
"""An eyeball is smaller than this share of the mesh's size."""
BALL, BALL_OFF, BALL_SIZES = 0.2, 0.25, (0.1, 0.5)
"""Of eyeballs: how far behind the pupil the centre is expected, how far it may be off, and which radii count."""
CORNERS = ("3.7", "3.11", "3.12", "3.8")
DISPUTED = 0.08
"""Landmarks farther than this from a placed point of the same name are not believed, nor is the rest of their eye."""


class Guess(NamedTuple):
    """Points guessed from nothing, and how sure: from 0, where no face is found, to 1 for the average face."""

    points: FeaturePoints
    confidence: float


class Predictor:
    """Predicts points on one neutral mesh; made once, asked after every click."""

    def __init__(
        self, mesh: TriMesh, template: Template | None = None, make_caster: CasterFactory = EmbreeCaster
    ) -> None:
        """Look at the mesh: which of its surface can be seen from outside.

        Parameters
        ----------
        mesh : the neutral face or head, in any axes and units; eyes, teeth and hair may be parts of it.
        template : the average face; the built-in one if none is given.

        Raises
        ------
        RetargetError : if the mesh has no faces, no area, or vertices that are not finite.
        """
        self._mesh = mesh.checked("the face")
        if not mesh.area > 0:
            raise RetargetError(f"all {len(mesh.faces)} faces of the face are without area, expected a surface")
        self._template = template or face_template()
        self._make_caster = make_caster
        self._pieces = pieces_of(mesh)
        self._outside = seen_from_outside(mesh, self._pieces, make_caster)
        self._skins: dict[tuple[int, ...], Skin] = {}

    def prepare(self) -> None:
        """Work out beforehand what the first prediction and the first mirroring on the largest piece would wait for."""
        areas = np.bincount(self._pieces, self._mesh.vertex_areas)
        skin = self._skin(np.array([areas.argmax()]))
        for _ in (skin.finder, skin.whole, skin.view, skin.samples, skin.exact_mirrors, self._best_face):
            pass

    @property
    def mesh(self) -> TriMesh:
        """The neutral."""
        return self._mesh

    @property
    def has_looked(self) -> bool:
        """Whether the face was looked for from nothing, which takes a second or more."""
        return "_best_face" in self.__dict__

    def predict(self, known: FeaturePoints, wanted: Sequence[str]) -> FeaturePoints:
        """Places of the wanted points.

        They lie on the connected surface that holds the known points, where it can be seen from outside and looks the
        way that the average face does there. With fewer than 3 points known, the face is looked for as `guess` does.

        Parameters
        ----------
        known : placed points; those whose names the template lacks do not count.
        wanted : names; known ones and those that the template lacks are left out, and pupils where no eyeball is.

        Returns
        -------
        The wanted points in the order asked.

        Raises
        ------
        RetargetError : if the known points lie on one line, or if they are fewer than 3 and no face is found.
        """
        fit, landmarks, skin = self._fit(known)
        return self._proposed(fit, landmarks, skin, [name for name in wanted if name not in known.names])

    def guess(self, wanted: Sequence[str]) -> Guess:
        """Places of the wanted points from nothing but the mesh.

        Raises
        ------
        RetargetError : if no face is found.
        """
        face, skin = self._face
        return Guess(self._proposed(face.fit, face.landmarks, skin, wanted), 1 - face.unlike / NO_FACE)

    def mirrored(self, known: FeaturePoints, names: Sequence[str]) -> FeaturePoints:
        """Places of the partners of known points, on the other half of the face.

        Through the surface: across the plane of its symmetry, then as the pairs that are known differ from mirror
        images, then onto the surface that looks the same way. The halves may differ in shape and in topology: the
        average face bent to both tells how, as far as too few pairs are known.

        Parameters
        ----------
        known : placed points, those of the middle line and whole pairs among them.
        names : of the known points to mirror; those without a partner are left out.

        Returns
        -------
        The partners, by their own names, where they may stand already too.

        Raises
        ------
        RetargetError : if a name is not among the known points.
        """
        names = [name for name in names if partner(name) != name]
        if not names:
            return FeaturePoints.none()
        sources = known.subset(names)
        on_skin = known.subset([name for name in known.names if name not in PUPILS] or known.names)
        skin = self._skin(np.unique(self._pieces[on_skin.holders]))
        where = dict(zip(known.names, known.positions(self._mesh.vertices), strict=True))
        unit = self._unit(on_skin)
        mirror = closest_mirror(skin.exact_mirrors, where)
        if mirror.misfit > SYMMETRIC * unit and len(self._told(known)) >= LEAST:
            fit = self._fit(known)[0]
            where = dict(zip(fit.template.names, fit.places, strict=True)) | where
        places = np.array([across(mirror, where, name, unit) for name in names]).reshape(-1, 3)
        normals = mirror.turn(unit_vectors(sources.positions(self._mesh.vertex_normals)))
        found = []
        for name, place, normal in zip(names, places, normals, strict=True):
            finder = self._whole if name in PUPILS else skin.whole
            found.append(closest_looking(finder, place[None], normal[None], unit))
        faces = np.array([int(there.face[0]) for there in found], np.int64)
        weights = np.array([there.weights[0] for there in found]).reshape(-1, 3)
        return FeaturePoints(tuple(map(partner, names)), self._mesh.faces[faces], weights)

    def doubtful(self, known: FeaturePoints) -> tuple[str, ...]:
        """Names of the placed points that the others contradict, worst first; none among fewer than 6.

        Raises
        ------
        RetargetError : if all points lie on one line.
        """
        told = self._told(known)
        rows = self._template.rows(told.names)
        worst = doubtful_rows(self._template, rows, told.positions(self._mesh.vertices))
        return tuple(told.names[k] for k in worst)

    def _told(self, known: FeaturePoints) -> FeaturePoints:
        """Those of the points that the template has, without the pupils."""
        return known.subset([name for name in known.names if self._template.has(name) and name not in PUPILS])

    def _unit(self, known: FeaturePoints) -> float:
        """About one eye separation."""
        told = self._told(known)
        if len(told) < LEAST:
            return SIZE * self._mesh.size
        places = told.positions(self._mesh.vertices)
        return fit_similarity(self._template.places[self._template.rows(told.names)], places).scale

    @cached_property
    def _whole(self) -> SurfaceFinder:
        return SurfaceFinder(self._mesh)

    def _proposed(self, fit: FaceFit, landmarks: FeaturePoints, skin: Skin, wanted: Sequence[str]) -> FeaturePoints:
        """Points of the wanted names, as far as the template has them."""
        names = [name for name in wanted if self._template.has(name)]
        on_skin = self._on_skin(fit, landmarks, skin, [name for name in names if name not in PUPILS])
        found = on_skin.joined(self._pupils(fit, [name for name in names if name in PUPILS]))
        return found.subset([name for name in names if name in set(found.names)])

    def _fit(self, known: FeaturePoints) -> tuple[FaceFit, FeaturePoints, Skin]:
        """The average face on this one, the landmarks that were found and believed, and the skin."""
        template = self._template
        told = self._told(known)
        rows, places = template.rows(told.names), told.positions(self._mesh.vertices)
        if len(told) < LEAST:
            face, skin = self._face
            pose, rough = face.fit.pose, face.fit
        else:
            skin = self._skin(np.unique(self._pieces[told.holders]))
            pose = fit_similarity(template.places[rows], places)
            rough = fit_face(template, pose, rows, places, np.full(len(rows), EXACT), skin.samples)
        pose = fit_similarity(template.places, rough.places)
        landmarks = self._undisputed(rough, told, believed_landmarks(skin.view, rough))
        rows = np.concatenate([rows, template.rows(landmarks.names)])
        places = np.concatenate([places, landmarks.positions(self._mesh.vertices)])
        slack = [VAGUE if name in CORNERS else CLEAR for name in landmarks.names]
        exactness = np.concatenate([np.full(len(told), EXACT), slack])
        return fit_face(template, pose, rows, places, exactness, skin.samples), landmarks, skin

    def _undisputed(self, fit: FaceFit, told: FeaturePoints, groups: Sequence[FeaturePoints]) -> FeaturePoints:
        """New landmarks of the groups that agree with the points placed."""
        placed = dict(zip(told.names, told.positions(self._mesh.vertices), strict=True))
        found = FeaturePoints.none()
        for group in groups:
            where = zip(group.names, group.positions(self._mesh.vertices), strict=True)
            same = [(place, placed[name]) for name, place in where if name in placed and name not in CORNERS]
            if all(_apart(one, other) <= DISPUTED * fit.pose.scale for one, other in same):
                found = found.joined(group.subset([name for name in group.names if name not in placed]))
        return found

    @property
    def _face(self) -> tuple[FoundFace, Skin]:
        """The face found from nothing, and the skin that it lies on."""
        face, skin = self._best_face
        if face.unlike >= NO_FACE:
            raise RetargetError(
                f"no face was found on the mesh: the average face differs from it by {face.unlike:.2f}, expected "
                f"less than {NO_FACE}; place at least {LEAST} points by hand"
            )
        return face, skin

    @cached_property
    def _best_face(self) -> tuple[FoundFace, Skin]:
        """What is most like a face, however little."""
        mesh = self._mesh
        areas = np.bincount(self._pieces, mesh.vertex_areas)
        large = np.argsort(-areas, kind="stable")[:MOST_SKINS]
        skins = [self._skin(np.array([one])) for one in large if areas[one] >= LEAST_SKIN * areas.sum()]
        found = [(find_face(self._template, skin, self._make_caster), skin) for skin in skins]
        return min(found, key=lambda pair: pair[0].unlike)

    def _skin(self, pieces: IntArray) -> Skin:
        """Of some pieces of the mesh, by their labels."""
        key = tuple(int(piece) for piece in pieces)
        if key not in self._skins:
            faces = np.flatnonzero(np.isin(self._pieces[self._mesh.faces[:, 0]], pieces))
            balls = np.concatenate([np.empty(0, np.int64), *(ball.faces for ball in self._balls)])
            balls = np.setdiff1d(balls, faces)
            self._skins[key] = Skin(self._mesh, faces, self._outside, balls, self._make_caster)
        return self._skins[key]

    def _on_skin(self, fit: FaceFit, landmarks: FeaturePoints, skin: Skin, names: Sequence[str]) -> FeaturePoints:
        """Points of these names: the landmarks where they are sharp, otherwise the best place of the skin."""
        sharp = landmarks.subset([name for name in landmarks.names if name in names and name not in CORNERS])
        rest = [name for name in names if name not in sharp.names]
        rows = fit.template.rows(rest)
        found = skin.closest(fit.places[rows], fit.normals[rows], fit.pose.scale)
        return sharp.joined(FeaturePoints(tuple(rest), self._mesh.faces[found.face], found.weights))

    def _pupils(self, fit: FaceFit, names: Sequence[str]) -> FeaturePoints:
        """The foremost places of the eyeballs behind the pupils of these names; none where there is no eyeball."""
        mesh, unit, forward = self._mesh, fit.pose.scale, fit.pose.rotation[:, 2]
        found = FeaturePoints.none()
        for name in names:
            expected = fit.places[fit.template.rows([name])[0]] - BALL * unit * forward
            balls = [ball for ball in self._balls if _apart(ball.centre, expected) < BALL_OFF * unit]
            balls = [ball for ball in balls if BALL_SIZES[0] * unit < ball.radius < BALL_SIZES[1] * unit]
            if balls:
                ball = max(balls, key=lambda one: one.radius)
                there = SurfaceFinder(mesh, ball.faces).closest((ball.centre + 1.5 * ball.radius * forward)[None])
                found = found.joined(FeaturePoints((name,), mesh.faces[there.face], there.weights))
        return found

    @cached_property
    def _balls(self) -> list[_Ball]:
        """Pieces that are round as eyeballs are."""
        mesh = self._mesh
        owner = self._pieces[mesh.faces[:, 0]]
        return [
            _Ball(*fit_sphere(mesh.vertices[own]), np.flatnonzero(owner == piece))
            for piece, own in enumerate(members(self._pieces))
            if is_ball(mesh.vertices[own]) and np.ptp(mesh.vertices[own], axis=0).max() < LARGEST * mesh.size
        ]


def guess_points(mesh: TriMesh, wanted: Sequence[str], make_caster: CasterFactory = EmbreeCaster) -> Guess:
    """Places of the wanted points on a head, from nothing but its mesh; see `Predictor.guess`."""
    return Predictor(mesh, make_caster=make_caster).guess(wanted)


class _Ball(NamedTuple):
    """An eyeball: centre (3,), radius, and its faces."""

    centre: FloatArray
    radius: float
    faces: IntArray


def _apart(first: FloatArray, second: FloatArray) -> float:
    return float(np.linalg.norm(first - second))
