"""Predicts where the missing feature points of a face lie, from those that an artist placed."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ..acting.eyeballs import fit_sphere
from ..arrays import FloatArray, IntArray
from ..closest_point import SurfaceFinder
from ..errors import RetargetError
from ..mesh import TriMesh
from ..points import FeaturePoints
from ..raycast import CasterFactory, EmbreeCaster
from ..rigid import fit_similarity
from .face_fit import EXACT, FaceFit, fit_face
from .openings import find_landmarks
from .outside import is_ball, seen_from_outside
from .skin import Skin
from .template import Template, face_template

LEAST = 3
"""Known points from which others can be predicted."""
CLEAR, VAGUE = 0.05, 0.1
"""How exact landmarks are, in eye separations: margins of lids and lips, and corners of eyes."""
PUPILS = ("3.5", "3.6")
BALL, BALL_OFF, BALL_SIZES = 0.2, 0.25, (0.1, 0.5)
"""Of eyeballs: how far behind the pupil the centre is expected, how far it may be off, and which radii count."""
CORNERS = ("3.7", "3.11", "3.12", "3.8")
BELIEVED = 0.2
"""Landmarks farther than this from where the average face expects them are something else."""
DISPUTED = 0.08
"""Landmarks farther than this from a placed point of the same name are not believed, nor is the rest of their eye."""


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
        RetargetError : if the mesh has no faces, or vertices that are not finite.
        """
        self._mesh = mesh.checked("the face")
        self._template = template or face_template()
        self._make_caster = make_caster
        self._outside = seen_from_outside(mesh, make_caster)
        self._skins: dict[tuple[int, ...], Skin] = {}

    def predict(self, known: FeaturePoints, wanted: Sequence[str]) -> FeaturePoints:
        """Places of the wanted points.

        They lie on the connected surface that holds the known points, where it can be seen from outside and looks the
        way that the average face does there.

        Parameters
        ----------
        known : placed points; those whose names the template lacks do not count.
        wanted : names; known ones and those that the template lacks are left out.

        Returns
        -------
        The wanted points in the order asked.

        Raises
        ------
        RetargetError : if fewer than 3 of the known points are the template's, or those lie on one line.
        """
        names = [name for name in wanted if self._template.has(name) and name not in known.names]
        fit, landmarks, skin = self._fit(known)
        on_skin = self._on_skin(fit, landmarks, skin, [name for name in names if name not in PUPILS])
        found = on_skin.joined(self._pupils(fit, [name for name in names if name in PUPILS]))
        return found.subset([name for name in names if name in set(found.names)])

    def _fit(self, known: FeaturePoints) -> tuple[FaceFit, FeaturePoints, Skin]:
        """The average face on this one, the landmarks that were found and believed, and the skin."""
        template = self._template
        told = known.subset([name for name in known.names if template.has(name) and name not in PUPILS])
        if len(told) < LEAST:
            raise RetargetError(
                f"{len(told)} of the {len(known)} placed points are of the average face, expected at least {LEAST} "
                f"such as {', '.join(template.names[:3])}, to predict the others"
            )
        skin = self._skin(told)
        rows, places = template.rows(told.names), told.positions(self._mesh.vertices)
        pose = fit_similarity(template.places[rows], places)
        exactness = np.full(len(rows), EXACT)
        rough = fit_face(template, pose, rows, places, exactness, skin.finder)
        landmarks = self._believed(rough, told, find_landmarks(skin.view, rough))
        new = landmarks.subset([name for name in landmarks.names if name not in told.names])
        rows = np.concatenate([rows, template.rows(new.names)])
        places = np.concatenate([places, new.positions(self._mesh.vertices)])
        exactness = np.concatenate([exactness, [VAGUE if name in CORNERS else CLEAR for name in new.names]])
        return fit_face(template, pose, rows, places, exactness, skin.finder), new, skin

    def _believed(self, fit: FaceFit, told: FeaturePoints, landmarks: Sequence[FeaturePoints]) -> FeaturePoints:
        """The groups of landmarks that agree with the average face and with the points placed."""
        expected = dict(zip(fit.template.names, fit.places, strict=True))
        placed = dict(zip(told.names, told.positions(self._mesh.vertices), strict=True))
        found = FeaturePoints((), np.empty((0, 3), np.int64), np.empty((0, 3)))
        for group in landmarks:
            where = dict(zip(group.names, group.positions(self._mesh.vertices), strict=True))
            strange = any(_apart(where[name], expected[name]) > BELIEVED * fit.pose.scale for name in where)
            disputed = any(
                _apart(where[name], placed[name]) > DISPUTED * fit.pose.scale
                for name in where.keys() & placed.keys() - set(CORNERS)
            )
            if not strange and not disputed:
                found = found.joined(group)
        return found

    def _skin(self, points: FeaturePoints) -> Skin:
        """The components that hold the points."""
        own = np.unique(self._mesh.components[points.holders])
        key = tuple(int(component) for component in own)
        if key not in self._skins:
            self._skins[key] = Skin(self._mesh, own, self._outside, self._make_caster)
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
        found = FeaturePoints((), np.empty((0, 3), np.int64), np.empty((0, 3)))
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
        """Components that are round as eyeballs are."""
        mesh = self._mesh
        owner = mesh.components[mesh.faces[:, 0]]
        balls = []
        for component in np.unique(owner):
            own = np.flatnonzero(mesh.components == component)
            if is_ball(mesh.vertices[own]):
                balls.append(_Ball(*fit_sphere(mesh.vertices[own]), np.flatnonzero(owner == component)))
        return balls


class _Ball(NamedTuple):
    """An eyeball: centre (3,), radius, and its faces."""

    centre: FloatArray
    radius: float
    faces: IntArray


def _apart(first: FloatArray, second: FloatArray) -> float:
    return float(np.linalg.norm(first - second))
