"""Points that the placing room proposes: where they go, and what they must not depend on."""

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.base.regions import eye_separation
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.placing.predictor import Predictor
from facial_retarget_addon.core.placing.template import face_template, partner
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.core.problem import Face

FIVE = ("3.7", "3.12", "9.3", "2.1", "8.3")
FACES: dict[str, Callable[[], demo.DemoFace]] = {
    "actor": lambda: demo.actor(8_000),
    "ape": lambda: demo.targets()[0],
    "skull": lambda: demo.targets()[1],
    "child": demo.child,
}
BOUNDS = {"actor": 0.06, "ape": 0.15, "skull": 0.15, "child": 0.10}
"""Median distance after five points, in eye separations."""


@cache
def built_in(name: str) -> Face:
    return FACES[name]().face


@cache
def predictor(name: str) -> Predictor:
    return Predictor(built_in(name).mesh)


def errors(face: Face, found: FeaturePoints) -> np.ndarray:
    gaps = found.positions(face.mesh.vertices) - face.points.subset(found.names).positions(face.mesh.vertices)
    return np.linalg.norm(gaps, axis=1) / eye_separation(face.mesh, face.points)


@pytest.mark.parametrize("name", FACES)
def test_five_points_predict_the_others(name: str) -> None:
    face = built_in(name)
    found = predictor(name).predict(face.points.subset(FIVE), face.points.names)
    assert set(found.names) == set(face.points.names) - set(FIVE)
    assert np.median(errors(face, found)) < BOUNDS[name]


@pytest.mark.parametrize("name", FACES)
def test_more_points_predict_better(name: str) -> None:
    face = built_in(name)
    more = (*FIVE, "8.4", "8.1", "8.2", "4.3", "4.4", "11.1", "2.13", "2.14", "3.11", "3.8")
    rest = [other for other in face.points.names if other not in more]
    few, many = (
        errors(face, predictor(name).predict(face.points.subset(known), rest)).mean() for known in (FIVE, more)
    )
    assert many < few


def test_unit_and_axes_do_not_matter() -> None:
    face = built_in("child")
    turn = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    mesh = face.mesh.with_vertices(0.01 * face.mesh.vertices @ turn.T + [5.0, -3.0, 1.0])
    there = Predictor(mesh).predict(face.points.subset(FIVE), face.points.names)
    here = predictor("child").predict(face.points.subset(FIVE), face.points.names)
    gap = np.linalg.norm(there.positions(face.mesh.vertices) - here.positions(face.mesh.vertices), axis=1)
    assert gap.max() < 0.02 * eye_separation(face.mesh, face.points)


def test_the_order_of_the_vertices_does_not_matter() -> None:
    face = built_in("child")
    order = np.random.default_rng(5).permutation(len(face.mesh.vertices))
    place = np.argsort(order)
    mesh = TriMesh(face.mesh.vertices[order], place[face.mesh.faces][::-1])
    known = face.points.subset(FIVE)
    moved = FeaturePoints(known.names, place[known.vertices], known.weights)
    there = Predictor(mesh).predict(moved, face.points.names).positions(mesh.vertices)
    here = predictor("child").predict(known, face.points.names).positions(face.mesh.vertices)
    assert np.linalg.norm(there - here, axis=1).max() < 0.02 * eye_separation(face.mesh, face.points)


def test_names_that_are_known_or_strange_are_left_out() -> None:
    face = built_in("child")
    found = predictor("child").predict(face.points.subset(FIVE), ["8.4", "9.3", "wart", "4.1"])
    assert found.names == ("8.4", "4.1")


def test_too_few_points_are_refused() -> None:
    face = built_in("child")
    with pytest.raises(RetargetError, match="2 of the 2 placed points"):
        predictor("child").predict(face.points.subset(FIVE[:2]), ["4.1"])


def test_every_point_of_the_average_face_has_its_partner() -> None:
    template = face_template()
    flipped = template.places[template.rows([partner(name) for name in template.names])] * [-1, 1, 1]
    np.testing.assert_allclose(flipped, template.places)
