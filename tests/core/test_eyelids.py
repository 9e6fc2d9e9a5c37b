"""Eyeballs are found and turn as one; lids know their margins and close around them."""

from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.acting.eyeballs import EYES, Eyeball, find_eyeballs, fit_sphere
from facial_retarget_addon.core.acting.eyelids import Lid, around_the_ball, find_lids, half_shut
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.mpeg4.fdps import FDPS
from facial_retarget_addon.core.mpeg4.head import head_axes
from facial_retarget_addon.core.mpeg4.head_turn import rotation_of_angles
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.core.problem import Face
from facial_retarget_addon.files.points import read_points


def mpeg4(face: Face) -> FeaturePoints:
    return face.points.subset([name for name in face.points.names if name in FDPS])


def eyeballs_of(mesh: TriMesh, points: FeaturePoints) -> dict[str, Eyeball]:
    return find_eyeballs(mesh, points, head_axes(points.names, points.positions(mesh.vertices)))


def joined(*meshes: TriMesh) -> TriMesh:
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    faces = [mesh.faces + start for mesh, start in zip(meshes, starts, strict=False)]
    return TriMesh(np.concatenate([mesh.vertices for mesh in meshes]), np.concatenate(faces))


def sphere(centre: np.ndarray, radius: float, rows: int = 24) -> TriMesh:
    """A closed sphere of rings."""
    polar, turn = np.meshgrid(np.linspace(0, np.pi, rows + 1)[1:-1], np.arange(2 * rows) * np.pi / rows, indexing="ij")
    ring = np.stack([np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.cos(polar)], axis=-1)
    index = np.arange(polar.size).reshape(polar.shape)
    a, b = index[:-1].ravel(), np.roll(index[:-1], -1, axis=1).ravel()
    c, d = index[1:].ravel(), np.roll(index[1:], -1, axis=1).ravel()
    top, bottom = polar.size, polar.size + 1
    caps = [np.stack([np.full(2 * rows, top), index[0], np.roll(index[0], -1)], axis=1)]
    caps += [np.stack([np.full(2 * rows, bottom), np.roll(index[-1], -1), index[-1]], axis=1)]
    faces = np.concatenate([np.stack([a, c, d], axis=1), np.stack([a, d, b], axis=1), *caps])
    unit = np.concatenate([ring.reshape(-1, 3), [[0, 0, 1], [0, 0, -1]]])
    return TriMesh(centre + radius * unit, faces)


@pytest.fixture(scope="module")
def actor() -> Face:
    return demo.actor(vertices=6000).face


@pytest.fixture(scope="module")
def skin(actor: Face) -> TriMesh:
    """The actor without eyeballs and teeth; the skin's vertices come first."""
    faces = actor.mesh.faces[actor.mesh.components[actor.mesh.faces[:, 0]] == 0]
    return TriMesh(actor.mesh.vertices[: faces.max() + 1], faces)


@pytest.fixture(scope="module")
def balls(actor: Face) -> dict[str, Eyeball]:
    return eyeballs_of(actor.mesh, mpeg4(actor))


@pytest.fixture(scope="module")
def lids(actor: Face, balls: dict[str, Eyeball]) -> dict[str, Lid]:
    return {lid.middle: lid for lid in find_lids(actor.mesh, mpeg4(actor), balls)}


def test_a_sphere_is_fitted_to_a_part_of_one() -> None:
    ball = sphere(np.array([3.0, -2, 50]), 0.7)
    centre, radius = fit_sphere(ball.vertices[ball.vertices[:, 2] > 50.3])
    np.testing.assert_allclose(centre, [3, -2, 50], atol=1e-8)
    assert radius == pytest.approx(0.7)


def test_the_actors_eyeballs_are_found_whole(actor: Face, balls: dict[str, Eyeball]) -> None:
    assert list(balls) == ["left", "right"]
    for side, sign in (("left", 1), ("right", -1)):
        ball = balls[side]
        component = np.unique(actor.mesh.components[ball.vertices])
        assert len(component) == 1
        assert len(ball.vertices) == (actor.mesh.components == component[0]).sum()
        assert sign * ball.centre[0] > 0
    assert balls["left"].radius == pytest.approx(balls["right"].radius)


def test_a_head_without_eyeballs_has_guessed_ones(actor: Face, skin: TriMesh, balls: dict[str, Eyeball]) -> None:
    guessed = eyeballs_of(skin, mpeg4(actor))
    for side, ball in balls.items():
        assert len(guessed[side].vertices) == 0
        assert np.linalg.norm(guessed[side].centre - ball.centre) < 0.5 * ball.radius
        assert guessed[side].radius == pytest.approx(ball.radius, rel=0.3)


def test_an_eye_without_lids_among_the_points_is_not_looked_for(actor: Face) -> None:
    names = [name for name in mpeg4(actor).names if name != "3.3"]
    assert list(eyeballs_of(actor.mesh, actor.points.subset(names))) == ["right"]


def test_round_parts_belong_to_the_eye_and_others_do_not(actor: Face, skin: TriMesh, balls: dict[str, Eyeball]) -> None:
    """An eyeball of two shells is found whole, lashes in front of it and an earring are left alone."""
    left = balls["left"]
    shells = sphere(left.centre, left.radius), sphere(left.centre, 1.05 * left.radius, 16)
    x = np.linspace(-1, 1, 20)
    strip = np.stack([np.concatenate([x, x]), np.repeat([0.0, 0.15], 20), np.full(40, 1.1)], axis=1)
    quads = np.arange(19)
    lashes = TriMesh(
        left.centre + left.radius * strip,
        np.concatenate(
            [np.stack([quads, quads + 1, quads + 21], axis=1), np.stack([quads, quads + 21, quads + 20], axis=1)]
        ),
    )
    earring = sphere(left.centre + 6 * left.radius, left.radius)
    mesh = joined(skin, *shells, lashes, earring)
    found = eyeballs_of(mesh, mpeg4(actor))
    first = len(skin.vertices)
    wanted = np.arange(first, first + sum(len(shell.vertices) for shell in shells))
    np.testing.assert_array_equal(found["left"].vertices, wanted)
    np.testing.assert_allclose(found["left"].centre, left.centre, atol=0.02 * left.radius)
    assert len(found["right"].vertices) == 0


def test_eyeballs_of_a_real_head_and_none_on_a_scan(shared_data: Path) -> None:
    with np.load(shared_data / "ict_dev.npz") as data:
        mesh, part, names = TriMesh(data["vertices"], data["tris"]), data["vert_part"], data["part_names"].tolist()
    points = read_points(shared_data / "ict_points.json", mesh)
    found = eyeballs_of(mesh, points.subset([name for name in points.names if name in FDPS]))
    for side, letter in (("left", "L"), ("right", "R")):
        turning = {names[k] for k in np.unique(part[found[side].vertices])}
        assert turning == {f"sclera_{letter}", f"iris_{letter}"}
    with np.load(shared_data / "ogre.npz") as data:
        ogre = TriMesh(data["vertices"], data["tris"])
    one = eyeballs_of(ogre, read_points(Path(__file__).parents[1] / "data" / "ogre_mpeg4_points.json", ogre))
    assert {side: len(ball.vertices) for side, ball in one.items()} == {"left": 0}


def test_an_eyeball_turns_about_its_centre(actor: Face, balls: dict[str, Eyeball]) -> None:
    ball = balls["left"]
    turns = rotation_of_angles(np.array([[0.0, 0, 0], [20_000, -30_000, 0]]), np.eye(3))
    turned = ball.turned(actor.mesh.vertices, turns)
    before = actor.mesh.vertices[ball.vertices]
    np.testing.assert_allclose(turned[0], before, atol=1e-12)
    np.testing.assert_allclose(
        np.linalg.norm(turned - ball.centre, axis=2),
        np.tile(np.linalg.norm(before - ball.centre, axis=1), (2, 1)),
        atol=1e-12,
    )
    # Pitch 0.2 looks down, yaw -0.3 to the subject's right.
    front = turned[1, before[:, 2].argmax()] - ball.centre
    assert front[0] < 0
    assert front[1] < 0


def test_margins_run_along_the_openings_rim(actor: Face, lids: dict[str, Lid]) -> None:
    """On the actor the skin ends at the lids, so that margins are known: its border."""
    border = np.unique(actor.mesh.edges[actor.mesh.edge_face_count == 1])
    where = dict(zip(actor.points.names, actor.points.positions(actor.mesh.vertices), strict=True))
    assert set(lids) == {"3.1", "3.2", "3.3", "3.4"}
    for name, lid in lids.items():
        assert np.isin(lid.vertices, border).all()
        assert len(lid.vertices) == len(np.unique(lid.vertices)) >= 8
        across = actor.mesh.vertices[lid.vertices, 0]
        _, _, outer, inner, _ = EYES[lid.side]
        assert (
            min(where[inner][0], where[outer][0]) < across.min() < across.max() < max(where[inner][0], where[outer][0])
        )
        sign = -1 if name in ("3.1", "3.2") else 1
        assert (sign * lid.gaps[:, 1] > 0).all()
        assert sign * lid.gap[1] > 0


def test_margins_of_a_real_head_stay_out_of_its_sockets(shared_data: Path) -> None:
    """Behind its lids the skin of this head goes on into the sockets and looks at the eyeball there."""
    with np.load(shared_data / "ict_dev.npz") as data:
        mesh = TriMesh(data["vertices"], data["tris"])
    named = read_points(shared_data / "ict_points.json", mesh)
    points = named.subset([name for name in named.names if name in FDPS])
    found = eyeballs_of(mesh, points)
    for lid in find_lids(mesh, points, found):
        away = mesh.vertices[lid.vertices] - found[lid.side].centre
        cosine = np.einsum("gi,gi->g", mesh.vertex_normals[lid.vertices], away) / np.linalg.norm(away, axis=1)
        assert cosine.min() > -0.2, lid.middle


def test_gaps_end_on_the_other_margin(actor: Face, lids: dict[str, Lid]) -> None:
    border = np.unique(actor.mesh.edges[actor.mesh.edge_face_count == 1])
    edge = np.median(actor.mesh.edge_lengths[np.isin(actor.mesh.edges, border).all(axis=1)])
    for name, lid in lids.items():
        ends = actor.mesh.vertices[lid.vertices] + lid.gaps
        away = np.linalg.norm(ends[:, None] - actor.mesh.vertices[border], axis=2).min(axis=1)
        assert away.max() < edge, name
    np.testing.assert_allclose(lids["3.1"].gap[1], -lids["3.3"].gap[1], rtol=0.05)


def test_guides_close_by_the_share_that_the_middle_closes(lids: dict[str, Lid]) -> None:
    for lid in lids.values():
        guidance = lid.guidance()
        np.testing.assert_allclose(guidance @ (0.3 * lid.gap), 0.3 * lid.gaps, atol=1e-12)
        across = np.cross(lid.gap, [0.0, 0, 1])
        sizes = np.linalg.norm(lid.gaps, axis=1) / np.linalg.norm(lid.gap)
        np.testing.assert_allclose(guidance @ across, sizes[:, None] * across, atol=1e-12)


def test_how_far_a_lid_is_shut(lids: dict[str, Lid]) -> None:
    lid = lids["3.1"]
    shares = lid.shut(np.array([0.0, 0.5, 1.0, -0.4])[:, None] * lid.gap)
    np.testing.assert_allclose(shares, [0, 0.5, 1, -0.4])
    np.testing.assert_allclose(half_shut(np.array([-1, 0, 0.25, 0.5, 1, 2])), [0, 0, 0.75, 1, 0, 0])


def test_both_eyes_have_the_same_lids(lids: dict[str, Lid]) -> None:
    for left, right in (("3.1", "3.2"), ("3.3", "3.4")):
        mirrored = lids[left].gaps * [-1, 1, 1]
        found = lids[right].gaps
        near = np.linalg.norm(mirrored[:, None] - found, axis=2).min(axis=1)
        assert near.max() < 0.02 * np.linalg.norm(lids[left].gap)


def test_a_lid_goes_around_a_ball_and_not_through_it() -> None:
    ball_mesh = sphere(np.zeros(3), 1.0, 40)
    angle = np.radians(np.linspace(20, 60, 9))
    skin = np.stack([0 * angle, np.sin(angle), np.cos(angle)], axis=1) * 1.03
    mesh = TriMesh(
        np.concatenate([ball_mesh.vertices, skin]),
        np.concatenate([ball_mesh.faces, len(ball_mesh.vertices) + np.array([[k, k + 1, k + 2] for k in range(7)])]),
    )
    ball = Eyeball("left", np.arange(len(ball_mesh.vertices)), np.zeros(3), 1.0)
    rows = len(ball_mesh.vertices) + np.arange(9)
    down = np.tile([0.0, -0.9, 0], (9, 1))
    arrived = skin + around_the_ball(mesh, ball, rows, down, np.zeros(9))
    np.testing.assert_allclose(np.linalg.norm(arrived, axis=1), 1.03, atol=0.005)
    straight = (skin + down) / np.linalg.norm(skin + down, axis=1)[:, None]
    np.testing.assert_allclose(arrived / np.linalg.norm(arrived, axis=1)[:, None], straight, atol=1e-9)
    risen = skin + around_the_ball(mesh, ball, rows, down, np.full(9, 0.1))
    np.testing.assert_allclose(np.linalg.norm(risen, axis=1), 1.13, atol=0.005)


def test_skin_rises_over_a_cornea() -> None:
    ball_mesh = sphere(np.zeros(3), 1.0, 40)
    bulged = ball_mesh.vertices.copy()
    front = bulged[:, 2] > np.cos(np.radians(25))
    bulged[front] *= 1.12
    skin = np.array([[0, np.sin(np.radians(65)), np.cos(np.radians(65))]]) * 1.03
    mesh = TriMesh(np.concatenate([bulged, skin]), ball_mesh.faces)
    ball = Eyeball("left", np.arange(len(bulged)), np.zeros(3), 1.0)
    arrived = skin + around_the_ball(mesh, ball, np.array([len(bulged)]), np.array([[0, 0, 1.03]]) - skin, np.zeros(1))
    assert 1.12 < np.linalg.norm(arrived) < 1.17
