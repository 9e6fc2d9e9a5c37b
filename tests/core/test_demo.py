"""The built-in faces: whole surfaces, exact points, acting that moves what it should."""

import numpy as np
import pytest

from facial_retarget_addon import demo


@pytest.fixture(scope="module")
def actor():
    return demo.actor()


@pytest.fixture(scope="module")
def faces(actor):
    return [actor, *demo.targets(), demo.warped_actor(np.random.default_rng(3))]


def skin_of(face):
    """The skin alone, as a mesh."""
    mesh = face.face.mesh
    skin = mesh.faces[(mesh.faces < len(face.places)).all(axis=1)]
    return type(mesh)(mesh.vertices[: len(face.places)], skin)


def test_skins_are_manifold_discs_with_three_openings(faces):
    for face in faces:
        skin = skin_of(face)
        assert skin.is_edge_manifold
        assert skin.components.max() == 0
        assert len(skin.boundary_loops) == 4
        assert len(skin.vertices) - len(skin.edges) + len(skin.faces) == 2 - 4
        corners = face.places[skin.faces]
        areas = np.linalg.det(corners[:, 1:] - corners[:, :1])
        assert areas.min() > 0.01 * np.median(areas)
        assert len(np.unique(skin.boundary_edges[:, 0])) == len(skin.boundary_edges)


def test_the_actor_is_dense_and_the_targets_are_other_meshes(faces):
    actor, *others = faces
    assert len(actor.places) >= 20_000
    for other in others:
        assert len(other.places) != len(actor.places)
        ratio = np.ptp(other.face.mesh.vertices, axis=0) / np.ptp(actor.face.mesh.vertices, axis=0)
        assert np.ptp(ratio) > 0.05 * ratio.mean()
    assert set(np.unique(actor.counts)) == {4}
    assert 3 in others[0].counts


def test_points_of_all_faces_are_the_same_skin(faces):
    names = faces[0].face.points.names
    assert 100 <= len(names) <= 125
    for face in faces:
        points = face.face.points
        assert points.names == names
        np.testing.assert_allclose(points.weights.sum(axis=1), 1.0)
        places = np.einsum("pk,pkc->pc", points.weights, face.places[points.vertices])
        np.testing.assert_allclose(places, list(demo.POINTS.values()), atol=1e-12)


def test_the_performance_starts_and_ends_neutral(actor):
    frames = demo.performance(actor)
    assert len(frames) >= 120
    assert frames.dtype == np.float32
    neutral = actor.face.mesh.vertices
    np.testing.assert_allclose(frames[[0, -1]], np.stack([neutral, neutral]), atol=1e-6)
    assert np.abs(np.diff(frames, axis=0)).max() < 0.15


def test_a_blink_shuts_the_lids(faces):
    for face in faces:
        open_gap, shut_gap = lid_gaps(face)
        assert shut_gap < 0.05 * open_gap


def lid_gaps(face):
    """Greatest distance of an upper lid's rim from the lower one, open and shut, left eye."""
    lens = demo.chart.LEFT_EYE
    places = face.places
    rim = np.flatnonzero(np.abs(lens.distance(places)) < 1e-9)
    upper, lower = (rim[(places[rim, 1] - lens.y) * side >= 0] for side in (1, -1))
    upper, lower = (half[np.argsort(places[half, 0])] for half in (upper, lower))
    positions = face.frames(demo.contractions({}, {"blink": 1.0}))[:, : len(places)].astype(float)
    gaps = []
    for frame in positions:
        x = places[upper, 0]
        below = np.stack([np.interp(x, places[lower, 0], frame[lower, k]) for k in range(3)], axis=1)
        gaps.append(np.linalg.norm(frame[upper] - below, axis=1).max())
    return gaps


def test_everything_is_deterministic():
    first, second = (demo.warped_actor(np.random.default_rng(5)) for _ in range(2))
    np.testing.assert_array_equal(first.face.mesh.vertices, second.face.mesh.vertices)
    np.testing.assert_array_equal(first.corners, second.corners)
