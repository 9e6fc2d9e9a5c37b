"""Points that the placing room proposes: where they go, and what they must not depend on."""

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from facial_retarget_addon import demo
from facial_retarget_addon.core.arrays import unit_vectors
from facial_retarget_addon.core.base.regions import eye_separation
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.placing.predictor import Predictor, guess_points
from facial_retarget_addon.core.placing.template import face_template, partner
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.core.problem import Face
from facial_retarget_addon.core.rigid import fit_similarity
from facial_retarget_addon.files.points import read_points

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


def test_every_point_of_the_average_face_has_its_partner() -> None:
    template = face_template()
    flipped = template.places[template.rows([partner(name) for name in template.names])] * [-1, 1, 1]
    np.testing.assert_allclose(flipped, template.places)


def turned(mesh: TriMesh, seed: int) -> TriMesh:
    """The mesh in other axes, another unit and another place."""
    axes = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    axes *= np.sign(np.linalg.det(axes))
    return mesh.with_vertices(40.0 * mesh.vertices @ axes.T + [300.0, -20.0, 7.0])


class TestGuess:
    """Points from nothing but the mesh."""

    @pytest.mark.parametrize("name", FACES)
    def test_the_face_is_found(self, name: str) -> None:
        face = built_in(name)
        found = predictor(name).guess(face.points.names)
        assert set(found.points.names) == set(face.points.names)
        assert np.median(errors(face, found.points)) < BOUNDS[name]
        assert 0 < found.confidence < 1

    def test_axes_and_unit_do_not_matter(self) -> None:
        face = built_in("actor")
        found = guess_points(turned(face.mesh, 3), face.points.names)
        assert np.median(errors(face, found.points)) < 0.10

    def test_it_is_looked_for_once(self) -> None:
        predictor = Predictor(built_in("child").mesh)
        assert not predictor.has_looked
        predictor.prepare()
        assert predictor.has_looked

    def test_one_or_two_points_stand_on_the_guess(self) -> None:
        face = built_in("actor")
        found = predictor("actor").predict(face.points.subset(["9.3"]), face.points.names)
        assert np.median(errors(face, found)) < 0.10

    def test_what_is_no_face_is_refused(self) -> None:
        rng = np.random.default_rng(1)
        around = rng.normal(size=(2000, 3))
        around /= np.linalg.norm(around, axis=1, keepdims=True)
        ball = TriMesh(around * [1.0, 1.3, 0.9], outwards(around))
        predictor = Predictor(ball)
        for known in (FeaturePoints.none(), FeaturePoints(("9.3",), ball.faces[:1], np.full((1, 3), 1 / 3))):
            with pytest.raises(RetargetError, match="no face was found"):
                predictor.predict(known, ["8.3"])
        with pytest.raises(RetargetError, match="place at least 3 points by hand"):
            predictor.guess(["9.3"])


class TestBadInput:
    """One sentence says what arrived and what was wanted."""

    def test_points_on_one_line(self) -> None:
        face = built_in("child")
        place = face.points.subset(["9.3"])
        known = FeaturePoints(FIVE[:3], place.vertices[[0, 0, 0]], place.weights[[0, 0, 0]])
        with pytest.raises(RetargetError, match="on one line or in one place"):
            predictor("child").predict(known, ["8.4"])

    def test_a_surface_without_area(self) -> None:
        with pytest.raises(RetargetError, match="all 1 faces of the face are without area"):
            Predictor(TriMesh(np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]]), np.array([[0, 1, 2]])))

    def test_a_plane_is_no_face(self) -> None:
        corners = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
        with pytest.raises(RetargetError, match="no face was found"):
            guess_points(TriMesh(corners, np.array([[0, 1, 2], [0, 2, 3]])), ["9.3"])


def outwards(around: np.ndarray) -> np.ndarray:
    """Faces (F, 3) of the convex hull of places (N, 3) about the origin, seen from outside."""
    faces = ConvexHull(around).simplices.astype(np.int64)
    a, b, c = around[faces].transpose(1, 0, 2)
    inside = np.einsum("fi,fi->f", np.cross(b - a, c - a), a + b + c) < 0
    faces[inside] = faces[inside][:, ::-1]
    return faces


class TestMirrored:
    """Partners across the face."""

    def test_twice_is_the_same_on_a_symmetric_mesh(self) -> None:
        face = built_in("child")
        known = face.points.subset(["8.3", "3.7", "cheek_l_1", "2.2", "upper_lid_l_1"])
        there = predictor("child").mirrored(known, known.names)
        assert there.names == ("8.4", "3.12", "cheek_r_1", "upper_lid_r_1")
        back = predictor("child").mirrored(there, there.names)
        assert errors(face, back).max() < 1e-3
        assert errors(face, there).max() < 1e-3

    def test_other_topology_and_shape_of_the_halves(self) -> None:
        face = demo.warped_actor(np.random.default_rng(3), 9_000).face
        lefts = [name for name in face.points.names if template_x(name) > 0 and partner(name) in face.points.names]
        alone = Predictor(face.mesh).mirrored(face.points.subset(lefts), lefts)
        pairs = ("3.7", "3.12", "8.3", "8.4", "9.3", "2.1", "11.1", "4.5", "4.6", "2.13", "2.14")
        rest = [name for name in lefts if name not in pairs]
        helped = Predictor(face.mesh).mirrored(face.points.subset([*pairs, *rest]), rest)
        assert np.median(errors(face, alone)) < 0.12
        assert np.median(errors(face, helped)) < 0.03

    def test_nothing_to_mirror(self) -> None:
        face = built_in("child")
        assert predictor("child").mirrored(face.points.subset(["9.3"]), ["9.3"]).names == ()


def template_x(name: str) -> float:
    template = face_template()
    return float(template.places[template.rows([name])[0], 0])


class TestPieces:
    """Heads come in pieces."""

    def test_vertices_that_are_not_welded(self) -> None:
        face = built_in("actor")
        corners = face.mesh.faces.ravel()
        mesh = TriMesh(face.mesh.vertices[corners], np.arange(len(corners)).reshape(-1, 3))
        first = np.full(len(face.mesh.vertices), -1)
        first[corners[::-1]] = np.arange(len(corners))[::-1]
        apart = FeaturePoints(face.points.names, first[face.points.vertices], face.points.weights)
        found = Predictor(mesh).predict(apart.subset(FIVE), apart.names)
        there = predictor("actor").predict(face.points.subset(FIVE), face.points.names)
        gaps = np.linalg.norm(found.positions(mesh.vertices) - there.positions(face.mesh.vertices), axis=1)
        assert np.median(gaps) < 0.01 * eye_separation(face.mesh, face.points)

    def test_hair_over_the_head(self) -> None:
        face = built_in("actor")
        around = np.random.default_rng(2).normal(size=(3000, 3))
        around /= np.linalg.norm(around, axis=1, keepdims=True)
        faces = outwards(around)
        faces = faces[(around[faces].mean(axis=1) @ [0.0, 1.0, -1.0]) > 0.1]
        hair = around * 1.5 + [0.0, 0.3, -0.5]
        mesh = TriMesh(
            np.concatenate([face.mesh.vertices, hair]),
            np.concatenate([face.mesh.faces, faces + len(face.mesh.vertices)]),
        )
        found = guess_points(mesh, face.points.names)
        assert np.median(errors(Face(mesh, face.points), found.points)) < 0.10


class TestRealHeads:
    """Heads by several artists; the average face was measured on them, so that the bench leaves each out in turn."""

    @pytest.fixture(params=["ict", "makehuman", "male_adult_08", "johnsmith"])
    def head(self, request: pytest.FixtureRequest, shared_data: Path) -> Face:
        archive = {"ict": "ict_dev", "makehuman": "makehuman_dev", "johnsmith": "johnsmith_welded"}
        data = np.load(shared_data / f"{archive.get(request.param, request.param)}.npz")
        mesh = TriMesh(data["vertices"], data["tris"])
        return Face(mesh, read_points(shared_data / f"{request.param}_points.json", mesh))

    def test_five_points_or_none(self, head: Face) -> None:
        predictor = Predictor(head.mesh)
        five = predictor.predict(head.points.subset(FIVE), head.points.names)
        assert np.median(errors(head, five)) < 0.08
        guessed = predictor.guess(head.points.names)
        assert np.median(errors(head, guessed.points)) < 0.08
        assert guessed.confidence > 0.5

    def test_nothing_is_doubtful(self, head: Face) -> None:
        assert Predictor(head.mesh).doubtful(head.points) == ()

    def test_any_axes(self, head: Face) -> None:
        found = guess_points(turned(head.mesh, 8), head.points.names)
        assert np.median(errors(head, found.points)) < 0.08


def test_the_ogre_has_one_eye(shared_data: Path) -> None:
    data = np.load(shared_data / "ogre.npz")
    mesh = TriMesh(data["vertices"], data["tris"])
    points = read_points(Path(__file__).parents[1] / "data" / "ogre_points.json", mesh)
    found = Predictor(mesh).predict(points.subset(["9.3", "2.1", "8.3", "8.4", "8.1"]), points.names)
    gaps = np.linalg.norm(found.positions(mesh.vertices) - points.subset(found.names).positions(mesh.vertices), axis=1)
    names = [name for name in points.names if face_template().has(name)]
    template = face_template().places[face_template().rows(names)]
    unit = fit_similarity(template, points.subset(names).positions(mesh.vertices)).scale
    assert np.median(gaps) < 0.15 * unit


class TestDoubtful:
    """Points that the others contradict."""

    @pytest.mark.parametrize("name", FACES)
    def test_no_false_alarm(self, name: str) -> None:
        points = built_in(name).points
        for known in (points.names, (*FIVE, "8.4"), (*FIVE, "8.4", "8.1", "8.2", "4.3", "4.4")):
            assert predictor(name).doubtful(points.subset(known)) == ()

    @pytest.mark.parametrize("name", FACES)
    @pytest.mark.parametrize(("one", "other"), [("8.3", "8.4"), ("8.1", "8.2"), ("3.7", "3.11")])
    def test_swapped_points(self, name: str, one: str, other: str) -> None:
        points = built_in(name).points.subset((*FIVE, "8.4", "8.1", "8.2", "3.11", "3.8", "4.3", "4.4"))
        swap = {one: other, other: one}
        wrong = points.subset([swap.get(point, point) for point in points.names])
        found = predictor(name).doubtful(FeaturePoints(points.names, wrong.vertices, wrong.weights))
        assert set(found) == {one, other}

    @pytest.mark.parametrize("name", FACES)
    def test_a_corner_of_the_mouth_on_the_cheek(self, name: str) -> None:
        points = built_in(name).points
        cheek = points.subset(["cheek_l_3"])
        rest = points.subset([*[point for point in FIVE if point != "8.3"], "8.4", "8.1", "8.2"])
        found = predictor(name).doubtful(rest.joined(FeaturePoints(("8.3",), cheek.vertices, cheek.weights)))
        assert found[0] == "8.3"


class TestPlaces:
    """What a predicted point lies on."""

    @pytest.mark.parametrize("name", FACES)
    def test_lips_on_their_own_side(self, name: str) -> None:
        face = built_in(name)
        found = predictor(name).predict(face.points.subset(FIVE), ("2.2", "2.3", "8.1", "8.2"))
        upper, lower = unit_vectors(found.positions(face.mesh.vertex_normals))[:2, 1]
        assert upper < lower
        heights = found.positions(face.mesh.vertices)[:, 1]
        assert heights[2] > max(heights[:2]) >= min(heights[:2]) > heights[3]

    def test_pupils_on_the_eyeballs(self) -> None:
        face = built_in("actor")
        found = predictor("actor").predict(face.points.subset(FIVE), ("3.5", "3.6"))
        assert found.names == ("3.5", "3.6")
        components = face.mesh.components
        assert len(set(components[found.holders]) | {components[face.points.holders[0]]}) == 3

    def test_no_pupils_without_eyeballs(self) -> None:
        face = built_in("actor")
        skin = face.mesh.components == face.mesh.components[face.points.holders[0]]
        mesh = TriMesh(face.mesh.vertices, face.mesh.faces[skin[face.mesh.faces].all(axis=1)])
        assert Predictor(mesh).predict(face.points.subset(FIVE), ("3.5", "3.6")).names == ()
