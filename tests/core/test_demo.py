"""The built-in faces: whole surfaces, exact points, acting that moves what it should."""

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.demo import chart


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
        rims = skin.boundary_loops[1:]
        for lens in chart.OPENINGS:
            off = [np.abs(lens.distance(face.places[rim])).max() for rim in rims]
            assert min(off) < 1e-9


def test_the_actor_is_dense_and_the_targets_are_other_meshes(faces):
    actor, *others = faces
    assert len(actor.places) >= 20_000
    for other in others:
        assert len(other.places) != len(actor.places)
        ratio = np.ptp(other.face.mesh.vertices, axis=0) / np.ptp(actor.face.mesh.vertices, axis=0)
        assert np.ptp(ratio) > 0.05 * ratio.mean()
    assert set(np.unique(actor.counts)) == {4}
    assert 3 in others[0].counts


def test_every_vertex_has_its_place_and_colour(faces):
    for face in faces:
        for values, width in ((face.uvs, 2), (face.colours, 3)):
            assert values.shape == (len(face.face.mesh.vertices), width)
            assert values.min() >= 0.0
            assert values.max() <= 1.0
        _, twins = np.unique(face.uvs.round(9), axis=0, return_counts=True)
        assert twins.max() == 1


def test_faces_come_in_other_densities(faces):
    names = faces[0].face.points.names
    for face in (demo.actor(vertices=26_000), demo.warped_actor(np.random.default_rng(3), vertices=20_000)):
        wanted = 26_000 if face.name == "actor" else 20_000
        assert abs(len(face.face.mesh.vertices) - wanted) < 0.1 * wanted
        assert face.face.points.names == names
        assert skin_of(face).is_edge_manifold
    with pytest.raises(RetargetError, match="too coarse"):
        demo.actor(vertices=400)


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
    np.testing.assert_array_equal(frames[[0, -1]], np.stack([neutral, neutral]))
    assert np.abs(np.diff(frames, axis=0)).max() < 0.15


def test_a_blink_shuts_the_lids(faces):
    for face in faces:
        open_gap, shut_gap = lid_gaps(face)
        assert shut_gap < 0.05 * open_gap


def lid_gaps(face):
    """Greatest distance of an upper lid's rim from the lower one, open and shut, left eye."""
    lens = chart.LEFT_EYE
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


def region(face, x, y, width, height):
    """Vertices of the skin inside a box of the chart around (x, y)."""
    return np.flatnonzero((np.abs(face.places[:, 0] - x) < width) & (np.abs(face.places[:, 1] - y) < height))


def test_expressions_move_what_they_should(faces):
    """Mean displacement, in face heights, of a few regions: corner of the mouth, brow, chin, in each expression."""
    for face in faces[:3]:
        neutral = face.face.mesh.vertices
        unit = np.ptp(neutral[: len(face.places), 1])
        moved = {name: (positions - neutral) / unit for name, positions in face.face.examples.items()}
        corner, inner_brow, chin = (
            region(face, *box) for box in ((0.40, -1.07, 0.03, 0.03), (0.2, 0.25, 0.06, 0.06), (0.0, -1.6, 0.1, 0.08))
        )
        assert set(moved) == {"neutral", "joy", "sadness", "anger", "fear", "disgust", "surprise"}
        assert not moved["neutral"].any()
        assert moved["joy"][corner, 1].mean() > 0.02
        assert moved["joy"][corner, 0].mean() > 0.02
        assert moved["sadness"][corner, 1].mean() < -0.01
        assert moved["surprise"][inner_brow, 1].mean() > 0.015
        assert moved["anger"][inner_brow, 1].mean() < -0.008
        assert moved["surprise"][chin, 1].mean() < -0.05
        assert np.abs(moved["anger"][chin]).max() < 0.03


def test_acting_stays_on_its_side_and_leaves_the_border_still(actor):
    left, right = actor.frames(
        demo.contractions({"zygomatic_l": 1.0, "blink_l": 1.0}, {"zygomatic_r": 1.0, "blink_r": 1.0})
    )
    neutral = actor.face.mesh.vertices
    skin = slice(0, len(actor.places))
    far = np.flatnonzero(actor.places[:, 0] < -0.45)
    assert np.abs(left - neutral)[far].max() < 1e-6
    assert np.isclose(np.abs(left - neutral)[skin].max(), np.abs(right - neutral)[skin].max(), rtol=1e-3)
    everything = np.stack(list(actor.face.examples.values())) - neutral
    assert np.abs(everything[:, len(actor.places) :]).max() == 0.0
    border = skin_of(actor).boundary_loops[0]
    assert np.abs(everything[:, border]).max() < 0.03


def test_lips_part_when_the_jaw_opens(faces):
    for face in faces:
        points = face.face.points
        upper, lower = points.index(["2.2", "2.3"])
        open_mouth = points.positions(face.frames(demo.contractions({}, {"jaw": 1.0})).astype(float))
        gap = np.linalg.norm(open_mouth[:, upper] - open_mouth[:, lower], axis=1)
        assert gap[1] > 0.2 * np.ptp(face.face.mesh.vertices[:, 0]) / 2.2
        assert gap[0] < 0.05 * gap[1]


def test_wrinkles_are_fine_and_grow_with_the_contraction(actor):
    forehead = region(actor, 0.4, 0.62, 0.2, 0.2)
    heights = []
    for contraction in (0.0, 0.5, 1.0):
        table = demo.contractions({"frontalis_inner": contraction, "frontalis_outer": contraction})
        folded, smooth = actor.frames(table), actor.frames(table, wrinkles=0.0)
        heights.append(np.linalg.norm((folded - smooth)[0, forehead], axis=1).std())
    assert heights[0] == 0.0
    assert heights[2] > 2.0 * heights[1] > 0.002
    # Along an upright line, furrows follow each other within a twentieth of the face's width.
    line = forehead[np.argsort(actor.places[forehead, 1])]
    line = line[np.abs(actor.places[line, 0] - 0.4) < 0.01]
    depth = (folded - smooth)[0, line, 2].astype(float)
    crossings = np.flatnonzero(np.diff(np.sign(depth - depth.mean())))
    wavelength = 2 * np.diff(actor.places[line, 1][crossings]).mean()
    assert wavelength < 0.05 * np.ptp(actor.face.mesh.vertices[:, 0])


def test_the_warp_keeps_every_face_upright(actor):
    """The warped actor's skin is the actor's, seen through the warp: nothing folds, and the same places correspond."""
    warped = demo.warped_actor(np.random.default_rng(11))
    shifts = 1e-5 * np.eye(3)
    positions = warped.acting.neutral.astype(float)
    jacobian = np.stack([warped.warp(positions + s) - warped.warp(positions - s) for s in shifts], axis=-1) / 2e-5
    assert np.linalg.det(jacobian).min() > 0.3
    table = demo.contractions({"jaw": 0.7, "zygomatic": 0.8})
    mine = actor.face.points.positions(actor.frames(table).astype(float))
    theirs = warped.face.points.positions(warped.frames(table).astype(float))
    np.testing.assert_allclose(theirs, warped.warp(mine), atol=2e-3)


def test_everything_is_deterministic():
    first, second = (demo.warped_actor(np.random.default_rng(5)) for _ in range(2))
    np.testing.assert_array_equal(first.face.mesh.vertices, second.face.mesh.vertices)
    np.testing.assert_array_equal(first.corners, second.corners)
