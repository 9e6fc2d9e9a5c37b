"""The bench's peers and measures on cases whose answer is known: a peer that is wrong would flatter ours."""

from collections.abc import Callable

import numpy as np
import pytest

from bench.cloning import PEERS, Cloner
from bench.expression_cloning import align_lips, lip_of
from bench.seals import contacts, lid_error, lip_error
from facial_retarget_addon import demo
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.problem import Face, Problem

TURN = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])


@pytest.fixture(scope="module")
def actor() -> demo.DemoFace:
    return demo.actor(vertices=5_000)


@pytest.fixture(scope="module")
def frames(actor: demo.DemoFace) -> np.ndarray:
    return actor.frames(demo.performance_table()[40:200:40]).astype(np.float64)


def relative_error(found: np.ndarray, expected: np.ndarray, rest: np.ndarray) -> float:
    return float(np.linalg.norm(found - expected) / np.linalg.norm(expected - rest))


@pytest.mark.parametrize("make", PEERS.values(), ids=PEERS)
def test_a_face_gives_its_motion_to_itself(
    make: Callable[[Problem], Cloner], actor: demo.DemoFace, frames: np.ndarray
) -> None:
    found = make(Problem(actor.face, actor.face)).frames(frames)
    assert relative_error(found, frames, actor.face.mesh.vertices) < 1e-3


@pytest.mark.parametrize("make", PEERS.values(), ids=PEERS)
def test_a_turned_larger_face_takes_the_motion_turned_and_larger(
    make: Callable[[Problem], Cloner], actor: demo.DemoFace, frames: np.ndarray
) -> None:
    def moved(places: np.ndarray) -> np.ndarray:
        return 3 * places @ TURN.T + [5.0, -2.0, 1.0]

    mesh = actor.face.mesh
    target = Face(mesh.with_vertices(moved(mesh.vertices)), actor.face.points)
    found = make(Problem(actor.face, target)).frames(frames)
    assert relative_error(found, moved(frames), target.mesh.vertices) < 1e-3


@pytest.mark.parametrize("make", PEERS.values(), ids=PEERS)
def test_a_still_source_leaves_the_target_still(make: Callable[[Problem], Cloner], actor: demo.DemoFace) -> None:
    target = demo.warped_actor(np.random.default_rng(3), vertices=4_000).face
    names = [name for name in actor.face.points.names if name in target.points.names][:100]
    problem = Problem(*(Face(face.mesh, face.points.subset(names)) for face in (actor.face, target)))
    found = make(problem).frames(actor.face.mesh.vertices[None])
    np.testing.assert_allclose(found[0], target.mesh.vertices, atol=1e-6 * target.mesh.size)


def test_a_vertex_that_landed_on_the_other_lip_goes_to_its_own(actor: demo.DemoFace) -> None:
    mesh = actor.face.mesh
    lip = lip_of(actor.face)
    assert 0 < (lip > 0).sum() < len(lip) / 2
    assert 0 < (lip < 0).sum() < len(lip) / 2
    upper = np.flatnonzero(lip > 0)
    face = np.zeros(len(lip), np.int64)
    face[mesh.faces] = np.arange(len(mesh.faces))[:, None]
    right = face.copy()
    face[upper] = np.flatnonzero((lip[mesh.faces] < 0).all(axis=1))[0]
    weights = (mesh.faces[right] == np.arange(len(lip))[:, None]).astype(float)
    align_lips(Problem(actor.face, actor.face), mesh, face, weights)
    assert (lip[mesh.faces[face[upper]]] > 0).all()
    others = lip <= 0
    np.testing.assert_array_equal(face[others], right[others])


@pytest.fixture
def strips() -> TriMesh:
    """Two strips of three squares each, one above the other, a quarter apart."""
    x, y = np.meshgrid(np.arange(4.0), [-1.0, 0.0, 0.25, 1.25])
    corner = np.concatenate([np.arange(3), np.arange(3) + 8])
    faces = [np.stack([corner, corner + 1, corner + 5], 1), np.stack([corner, corner + 5, corner + 4], 1)]
    return TriMesh(np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1), np.concatenate(faces))


def raised(strips: TriMesh, height: float) -> np.ndarray:
    motion = np.zeros_like(strips.vertices)
    motion[8:, 1] = height
    return motion


def test_contacts_are_what_meets_over_the_opening(strips: TriMesh) -> None:
    found = contacts(strips.vertices, strips.vertices + raised(strips, 1.0), 0.5)
    assert {tuple(sorted(pair)) for pair in found.tolist()} == {(4, 8), (5, 9), (6, 10), (7, 11)}


def test_lips_that_miss_half_the_closing_have_half_the_error(strips: TriMesh) -> None:
    truth = {"jawOpen": raised(strips, 1.75), "mouthClose": raised(strips, -1.75)}
    half = {"jawOpen": raised(strips, 1.75), "mouthClose": raised(strips, -0.75)}
    assert lip_error(strips, truth, truth) == 0
    assert lip_error(strips, half, truth) == pytest.approx(50)


def test_lids_that_overlap_are_as_wrong_as_lids_that_gape(strips: TriMesh) -> None:
    opened = strips.with_vertices(strips.vertices + raised(strips, 1.75))
    truth, gaping, overlapping = (
        {name: raised(strips, height) for name in ("eyeBlink_L", "eyeBlink_R")} for height in (-1.75, -1.55, -1.95)
    )
    assert lid_error(opened, gaping, truth) == pytest.approx(10)
    assert lid_error(opened, overlapping, truth) == pytest.approx(10)
