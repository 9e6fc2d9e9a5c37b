"""A face that FAPs move: they come back off it, lids shut, lips leave each other alone, in whatever pose and size."""

import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

from facial_retarget_addon import demo
from facial_retarget_addon.core.acting.eyeballs import EYES, Eyeball
from facial_retarget_addon.core.acting.fap_face import FapFace, fit_fap_face
from facial_retarget_addon.core.acting.point_deformer import fit_deformer
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.mpeg4.conversions import recipe_matrix
from facial_retarget_addon.core.mpeg4.faps import FAPS
from facial_retarget_addon.core.mpeg4.fdps import FDPS
from facial_retarget_addon.core.mpeg4.head_turn import head_angles, rotation_of_angles
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.core.raycast import EmbreeCaster
from facial_retarget_addon.files.points import read_points

OGRE_POINTS = Path(__file__).parents[1] / "data" / "ogre_mpeg4_points.json"
LOWER_LIP = {5: -1000, 10: -1000, 11: -1000, 52: -1000, 57: -1000, 58: -1000}
UPPER = ("2.2", "2.6", "2.7", "8.1", "8.5", "8.6")
LOWER = ("2.3", "2.8", "2.9", "8.2", "8.7", "8.8")


@pytest.fixture(scope="module")
def actor() -> FapFace:
    face = demo.actor(vertices=6000).face
    return fit_fap_face(face.mesh, face.points)


@pytest.fixture(scope="module")
def ict(shared_data: Path) -> FapFace:
    with np.load(shared_data / "ict_dev.npz") as data:
        mesh = TriMesh(data["vertices"], data["tris"])
    return fit_fap_face(mesh, read_points(shared_data / "ict_points.json", mesh))


@pytest.fixture(scope="module")
def ogre(shared_data: Path) -> FapFace:
    with np.load(shared_data / "ogre.npz") as data:
        mesh = TriMesh(data["vertices"], data["tris"])
    return fit_fap_face(mesh, read_points(OGRE_POINTS, mesh))


@pytest.fixture(params=["actor", "ict", "ogre"])
def face(request: pytest.FixtureRequest) -> FapFace:
    """Each of the three."""
    return request.getfixturevalue(request.param)


@pytest.fixture(params=["actor", "ict"])
def two_eyed(request: pytest.FixtureRequest) -> FapFace:
    """Heads with two eyes and eyeballs."""
    return request.getfixturevalue(request.param)


def realistic(rng: np.random.Generator, frames: int) -> np.ndarray:
    """FAPs (F, 68) of the size that recorded streams have, lids between wide open and shut."""
    values = rng.uniform(-500, 500, (frames, len(FAPS)))
    values[:, :2] = 0
    values[:, 18:22] = rng.uniform(-300, 1024, (frames, 4))
    one_way = [fap.number - 1 for fap in FAPS if fap.one_way]
    values[:, one_way] = np.abs(values[:, one_way])
    angles = [fap.number - 1 for fap in FAPS if fap.unit == "AU"]
    values[:, angles] *= 60
    return values


def posed(face: FapFace, faps: Mapping[int, float]) -> np.ndarray:
    """(V, 3) float64 of one frame."""
    return face.frames(recipe_matrix([dict(faps)]))[0].astype(np.float64)


def moved_points(face: FapFace, frame: np.ndarray) -> dict[str, np.ndarray]:
    """Displacement of each point, in the head's axes."""
    moved = (face.points.positions(frame) - face.points.positions(face.mesh.vertices)) @ face.axes.T
    return dict(zip(face.points.names, moved, strict=True))


def heights(face: FapFace, frame: np.ndarray, *names: str) -> np.ndarray:
    return face.points.subset(names).positions(frame) @ face.axes[1]


def sideways(face: FapFace) -> np.ndarray:
    """(V,) how far to the subject's left of the nose's tip each vertex lies."""
    tip = face.points.subset(["9.3"]).positions(face.mesh.vertices)[0]
    return (face.mesh.vertices - tip) @ face.axes[0]


def test_faps_come_back_off_the_mesh(face: FapFace) -> None:
    values = realistic(np.random.default_rng(0), 60)
    found = face.measure(face.frames(values))
    off = np.abs(found - values * face.measurable).max(axis=0)
    assert off.max() < 1, FAPS[int(off.argmax())].name
    assert face.measurable.sum() >= 44


def test_the_neutral_comes_out_as_it_went_in(face: FapFace) -> None:
    still = face.frames(np.zeros((2, len(FAPS))), turn_head=True)
    assert still.dtype == np.float32
    np.testing.assert_array_equal(still[0], face.mesh.vertices.astype(np.float32))
    np.testing.assert_array_equal(face.measure(still), 0)


def test_every_playable_fap_moves_the_face_and_the_others_do_not(face: FapFace) -> None:
    full = np.diag([20_000.0 if fap.unit == "AU" else 500.0 for fap in FAPS])
    moved = np.abs(face.frames(full, turn_head=True) - face.mesh.vertices).max(axis=(1, 2)) / face.mesh.size
    assert moved[face.playable].min() > 1e-4
    assert moved[~face.playable].max() < 1e-6
    assert set(face.report["faps_without_points"]) == {
        fap.name for fap in FAPS[2:] if not face.playable[fap.number - 1]
    }


def test_pose_and_size_change_nothing(actor: FapFace) -> None:
    rng = np.random.default_rng(1)
    values = realistic(rng, 6)
    expected = actor.frames(values, turn_head=True)
    for size in (0.01, 300.0):
        turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        turn *= np.sign(np.linalg.det(turn))
        offset = size * rng.normal(size=3) * 2
        other = fit_fap_face(TriMesh(size * actor.mesh.vertices @ turn.T + offset, actor.mesh.faces), actor.points)
        frames = other.frames(values, turn_head=True)
        undone = (frames - offset) @ turn / size
        assert np.abs(undone - expected).max() < 1e-4 * actor.mesh.size
        np.testing.assert_allclose(other.measure(other.frames(values)), values * other.measurable, atol=1)


def test_channels_are_the_frames_again(face: FapFace) -> None:
    values = realistic(np.random.default_rng(2), 8)
    shapes = face.channel_shapes()
    assert shapes.shape == (len(face.channels), *face.mesh.vertices.shape)
    assert len(set(face.channels)) == len(face.channels)
    neutral = face.mesh.vertices.astype(np.float32)
    again = neutral + np.tensordot(face.channel_values(values), shapes - neutral, axes=1)
    assert np.abs(again - face.frames(values)).max() < 1e-6 * face.mesh.size


def test_blocks_of_any_length_are_the_same_frames(actor: FapFace) -> None:
    values = realistic(np.random.default_rng(3), 9)
    whole = actor.frames(values)
    np.testing.assert_allclose(np.concatenate([actor.frames(row[None]) for row in values]), whole, atol=1e-6)
    assert actor.frames(values[:0]).shape == (0, *actor.mesh.vertices.shape)


def margin_gap(face: FapFace, frame: np.ndarray, side: str) -> float:
    """How far the lids' guides still stand apart, at most, as a share of the neutral eye's opening.

    Each upper guide's height is compared with the lower margin's below it.
    """
    upper, lower, outer, inner, _ = EYES[side]
    lids = {lid.middle: lid for lid in face.deformer.lids}
    margins = []
    for name in (upper, lower):
        ends = face.points.subset([name, outer, inner]).positions(frame)
        places = np.concatenate([frame[lids[name].vertices], ends]) @ face.axes.T
        margins.append(places[np.argsort(places[:, 0])])
    above, below = margins
    gaps = above[:, 1] - np.interp(above[:, 0], below[:, 0], below[:, 1])
    open_now = heights(face, face.mesh.vertices, upper, lower)
    return float(gaps.max() / (open_now[0] - open_now[1]))


@pytest.mark.parametrize(("upper", "lower", "bound"), [(1024, 0, 0.05), (700, 324, 0.05), (0, 1024, 0.08)])
def test_an_eye_shuts_along_its_whole_width(face: FapFace, upper: float, lower: float, bound: float) -> None:
    assert margin_gap(face, face.mesh.vertices, "left") > 0.9
    assert margin_gap(face, posed(face, {19: upper, 21: lower}), "left") < bound


def test_the_other_eye_stays_open(two_eyed: FapFace) -> None:
    moved = np.linalg.norm(posed(two_eyed, {19: 1024, 21: 200}) - two_eyed.mesh.vertices, axis=1)
    lids = [lid for lid in two_eyed.deformer.lids if lid.side == "right"]
    assert len(lids) == 2
    for lid in lids:
        assert moved[lid.vertices].max() < 1e-3 * moved.max()


def still_seen(face: FapFace, frame: np.ndarray, side: str) -> float:
    """Of rays from the front that hit an eyeball between the lids, the share that still does.

    Only the skin and the eyeball are there: fluids and lashes before an eye hide nothing.
    """
    mesh, ball = face.mesh, face.deformer.eyeballs[side]
    skin = np.bincount(mesh.components[face.points.vertices.ravel()]).argmax()
    there = mesh.components == skin
    there[ball.vertices] = True
    faces = mesh.faces[there[mesh.faces].all(axis=1)]
    on_ball = np.isin(faces[:, 0], ball.vertices)
    corners = face.points.subset(EYES[side][:4]).positions(mesh.vertices) @ face.axes.T
    low, high = corners.min(axis=0), corners.max(axis=0)
    across, up = np.meshgrid(np.linspace(low[0], high[0], 80), np.linspace(low[1], high[1], 50))
    ahead = np.full(across.size, (mesh.vertices @ face.axes[2]).max() + mesh.size)
    origins = np.stack([across.ravel(), up.ravel(), ahead], axis=1) @ face.axes

    def seen(vertices: np.ndarray) -> np.ndarray:
        hits = EmbreeCaster(TriMesh(vertices, faces)).nearest(origins, np.tile(-face.axes[2], (len(origins), 1)))
        return hits.found & on_ball[hits.face]

    before = seen(mesh.vertices)
    assert before.mean() > 0.4
    return float((before & seen(frame)).sum() / before.sum())


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize(("upper", "lower"), [(1024, 0), (0, 1024), (700, 324), (512, 512)])
def test_shut_lids_lie_before_the_eyeball(two_eyed: FapFace, side: str, upper: float, lower: float) -> None:
    frame = posed(two_eyed, {19: upper, 20: upper, 21: lower, 22: lower})
    assert still_seen(two_eyed, frame, side) < 0.025


def test_a_lid_on_half_the_way_hides_half_the_eye(two_eyed: FapFace) -> None:
    assert 0.3 < still_seen(two_eyed, posed(two_eyed, {19: 512}), "left") < 0.7


def test_eyeballs_turn_as_they_are(two_eyed: FapFace) -> None:
    yaw, pitch = 30_000.0, 15_000.0
    frame = posed(two_eyed, {23: yaw, 25: pitch})
    ball, other = two_eyed.deformer.eyeballs["left"], two_eyed.deformer.eyeballs["right"]
    turn = rotation_of_angles(np.array([[pitch, yaw, 0]]), two_eyed.axes)
    expected = ball.turned(two_eyed.mesh.vertices, turn)[0]
    np.testing.assert_allclose(frame[ball.vertices], expected, atol=1e-6 * two_eyed.mesh.size)
    still = np.setdiff1d(np.arange(len(frame)), ball.vertices)
    assert set(other.vertices) <= set(still)
    np.testing.assert_array_equal(frame[still], two_eyed.mesh.vertices.astype(np.float32)[still])
    front = ball.vertices[((two_eyed.mesh.vertices[ball.vertices] - ball.centre) @ two_eyed.axes[2]).argmax()]
    gaze = (frame[front] - ball.centre) @ two_eyed.axes.T
    assert gaze[0] > 0
    assert gaze[1] < 0


def test_eyeballs_come_forward_and_pupils_widen(actor: FapFace) -> None:
    ball: Eyeball = actor.deformer.eyeballs["right"]
    before = (actor.mesh.vertices[ball.vertices] - ball.centre) @ actor.axes.T
    forward = posed(actor, {28: 100})[ball.vertices] - actor.mesh.vertices[ball.vertices]
    np.testing.assert_allclose(forward @ actor.axes.T, [[0, 0, 100 * actor.fapu.unit("ES")]] * len(before), atol=1e-6)
    grown = (posed(actor, {30: 200})[ball.vertices] - ball.centre) @ actor.axes.T - before
    outwards = np.einsum("vi,vi->v", grown[:, :2], before[:, :2]) / np.maximum(np.hypot(*before[:, :2].T), 1e-9)
    beside = np.hypot(*before[:, :2].T)
    rim = actor.fapu.irisd / 6
    assert outwards.max() == pytest.approx(0.5 * 200 * actor.fapu.unit("IRISD"), rel=0.15)
    assert abs(beside[outwards.argmax()] - rim) < 0.2 * rim
    np.testing.assert_allclose(grown[(beside > 0.5 * actor.fapu.irisd) | (before[:, 2] < 0)], 0, atol=1e-6)


@pytest.mark.parametrize("jaw", [0, 800])
def test_the_lower_lip_does_not_drag_the_upper(face: FapFace, jaw: float) -> None:
    frame = posed(face, LOWER_LIP | {3: jaw})
    moved = {name: float(np.linalg.norm(move)) for name, move in moved_points(face, frame).items()}
    falls = max(moved[name] for name in LOWER if name in moved)
    rows = face.points.index([name for name in UPPER if name in moved])
    assert falls > 0.9 * face.fapu.mns
    assert max(moved[name] for name in UPPER if name in moved) < 0.02 * falls
    holders = np.unique(face.points.vertices[rows][face.points.weights[rows] > 0])
    beside = np.unique(face.mesh.edges[np.isin(face.mesh.edges, holders).any(axis=1)])
    assert np.linalg.norm(frame - face.mesh.vertices, axis=1)[beside].max() < 0.10 * falls


def test_the_jaw_does_not_open_the_lips(face: FapFace) -> None:
    moved = moved_points(face, posed(face, {3: 800}))
    chin = -moved["2.1"][1]
    assert chin == pytest.approx(800 * face.fapu.unit("MNS"), rel=1e-3)
    assert max(np.linalg.norm(moved[name]) for name in (*UPPER, *LOWER) if name in moved) < 0.02 * chin


def test_the_left_half_does_not_move_the_right(two_eyed: FapFace) -> None:
    far = sideways(two_eyed) < -0.65 * two_eyed.fapu.es
    left = [fap for fap in FAPS if "_l_" in fap.name and fap.unit != "AU" and two_eyed.playable[fap.number - 1]]
    assert len(left) >= 15
    for fap in left:
        moved = np.linalg.norm(posed(two_eyed, {fap.number: 600}) - two_eyed.mesh.vertices, axis=1)
        assert moved[far].max() < 0.02 * moved.max(), fap.name


def mirrored(values: np.ndarray) -> np.ndarray:
    """FAPs (F, 68) of the other half of the face."""
    swapped = np.zeros_like(values)
    for fap in FAPS[2:]:
        swapped[:, fap.mirror - 1] = fap.mirror_sign * values[:, fap.number - 1]
    return swapped


def test_mirrored_faps_make_the_mirrored_face(actor: FapFace) -> None:
    """On the mirror image of the mesh the frames are the mirror images, whatever the mesh."""
    mirror = np.array([-1.0, 1, 1])
    partners = tuple(FDPS[name].partner for name in actor.known.names)
    points = FeaturePoints(partners, actor.known.vertices, actor.known.weights)
    image = fit_fap_face(TriMesh(actor.mesh.vertices * mirror, actor.mesh.faces[:, ::-1]), points)
    values = realistic(np.random.default_rng(4), 6)
    expected = actor.frames(values, turn_head=True) * mirror
    assert np.abs(image.frames(mirrored(values), turn_head=True) - expected).max() < 1e-4 * actor.mesh.size


def test_a_symmetric_face_acts_symmetrically(actor: FapFace) -> None:
    """The actor is symmetric, its triangles are not quite: a vertex is held against the one nearest to its image."""
    mirror = np.array([-1.0, 1, 1])
    away, partner = cKDTree(actor.mesh.vertices).query(actor.mesh.vertices * mirror)
    near = away < 1e-6
    assert near.mean() > 0.5
    values = realistic(np.random.default_rng(4), 6)
    one, other = actor.frames(values), actor.frames(mirrored(values))
    off = np.linalg.norm(other[:, partner] * mirror - one, axis=2)[:, near]
    moved = np.linalg.norm(one - actor.mesh.vertices, axis=2).max()
    assert off.max() < 0.06 * moved


def test_the_head_turns_as_one(actor: FapFace) -> None:
    values = realistic(np.random.default_rng(5), 4)
    straight, turned = actor.frames(values).astype(np.float64), actor.frames(values, turn_head=True)
    turns = rotation_of_angles(values[:, 47:50], actor.axes)
    pivot = actor.head_pivot
    expected = (straight - pivot) @ turns.transpose(0, 2, 1) + pivot
    np.testing.assert_allclose(turned, expected, atol=2e-6 * actor.mesh.size)
    np.testing.assert_allclose(head_angles(turns, actor.axes), values[:, 47:50], atol=1e-6)
    ears = actor.points.subset(["2.13", "2.14"]).positions(actor.mesh.vertices)
    assert pivot @ actor.axes[2] < (ears @ actor.axes[2]).max()


def flat_lattice() -> tuple[TriMesh, FeaturePoints]:
    """A flat grid with nine points ten edges apart."""
    size = 41
    x, y = np.meshgrid(np.arange(float(size)), np.arange(float(size)))
    corner = np.add.outer(np.arange(size - 1) * size, np.arange(size - 1)).ravel()
    lower = np.stack([corner, corner + 1, corner + size + 1], axis=1)
    upper = np.stack([corner, corner + size + 1, corner + size], axis=1)
    mesh = TriMesh(np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1), np.concatenate([lower, upper]))
    held = np.array([column + size * row for row in (10, 20, 30) for column in (10, 20, 30)])
    weights = np.tile([1.0, 0, 0], (9, 1))
    return mesh, FeaturePoints(tuple(f"p{k}" for k in range(9)), np.repeat(held[:, None], 3, axis=1), weights)


def test_motion_is_continuous_and_the_papers_is_not() -> None:
    mesh, points = flat_lattice()
    jumps = {}
    for variant in ("default", "paper"):
        fitted = fit_deformer(mesh, points, np.eye(3), np.ones((9, 3), bool), variant)
        sent = np.zeros((9, 9, 3))
        sent[np.arange(9), np.arange(9), 2] = 1
        height = fitted.displacements(sent)[:, :, 2]
        np.testing.assert_allclose(height[:, points.vertices[:, 0]], np.eye(9), atol=2e-3)
        jumps[variant] = np.abs(height[:, mesh.edges[:, 0]] - height[:, mesh.edges[:, 1]]).max()
    assert jumps["paper"] > 0.95
    assert jumps["default"] < 0.4


def test_the_papers_weights_play_too(actor: FapFace) -> None:
    paper = fit_fap_face(actor.mesh, actor.points, variant="paper")
    values = realistic(np.random.default_rng(6), 10)
    frames = paper.frames(values)
    np.testing.assert_array_equal(paper.frames(0 * values[:1])[0], actor.mesh.vertices.astype(np.float32))
    assert np.isfinite(frames).all()
    # Points of the actor sit inside its triangles, whose corners the paper lets lag behind.
    off = np.abs(paper.measure(frames) - values * paper.measurable)
    assert np.median(off.max(axis=0)[paper.measurable]) < 100
    assert paper.report["variant"] == "paper"
    assert not paper.deformer.lids


def test_the_report_is_plain_and_says_what_was_found(face: FapFace) -> None:
    report = json.loads(json.dumps(face.report))
    assert report["variant"] == "default"
    assert report["fapu"]["MW"] == face.fapu.mw
    assert set(report["fapu_taken"]) == {"IRISD", "ES", "ENS", "MNS", "MW"}
    assert set(report["eyeballs"]) <= {"left", "right"}
    assert 1 < report["weights_per_vertex"] < 60


def test_a_deformer_is_linear_in_its_points() -> None:
    mesh, points = flat_lattice()
    turn = np.linalg.qr(np.random.default_rng(7).normal(size=(3, 3)))[0]
    fitted = fit_deformer(mesh, points, turn * np.sign(np.linalg.det(turn)), np.ones((9, 3), bool))
    one, other = np.random.default_rng(8).normal(size=(2, 4, 9, 3))
    both = fitted.displacements(2 * one - other)
    np.testing.assert_allclose(both, 2 * fitted.displacements(one) - fitted.displacements(other), atol=1e-5)
    np.testing.assert_allclose(points.positions(both), 2 * one - other, atol=0.02)


def test_free_names_do_not_count(actor: FapFace) -> None:
    only = actor.points.subset([name for name in actor.points.names if name in FDPS])
    assert len(only) < len(actor.points)
    values = realistic(np.random.default_rng(8), 2)
    np.testing.assert_array_equal(fit_fap_face(actor.mesh, only).frames(values), actor.frames(values))


def test_a_face_of_a_few_points_plays_what_they_can(actor: FapFace) -> None:
    few = fit_fap_face(actor.mesh, actor.points.subset(["2.1", "2.2", "2.3", "8.3", "8.4", "9.3", "9.15"]))
    assert few.measurable[[2, 3, 4, 11 - 1, 52, 53]].tolist() == [True, True, True, False, True, True]
    values = realistic(np.random.default_rng(9), 5)
    np.testing.assert_allclose(few.measure(few.frames(values)), values * few.measurable, atol=1)
    assert "close_t_l_eyelid" in few.report["faps_without_points"]


def test_points_without_mpeg4_names_give_one_sentence(actor: FapFace) -> None:
    free = FeaturePoints(("tip", "chin"), actor.points.vertices[:2], actor.points.weights[:2])
    with pytest.raises(RetargetError, match=r"none of the 2 feature points has an MPEG-4 name, expected names such as"):
        fit_fap_face(actor.mesh, free)


def test_a_mesh_with_nan_gives_one_sentence(actor: FapFace) -> None:
    broken = actor.mesh.vertices.copy()
    broken[7] = np.nan
    with pytest.raises(RetargetError, match="the face"):
        fit_fap_face(TriMesh(broken, actor.mesh.faces), actor.points)


def test_points_beyond_the_mesh_give_one_sentence(actor: FapFace) -> None:
    beyond = FeaturePoints(actor.points.names, actor.points.vertices + 10**6, actor.points.weights)
    with pytest.raises(RetargetError, match=r"vertices that the face's \d+ do not include"):
        fit_fap_face(actor.mesh, beyond)


@pytest.mark.parametrize("shape", [(3, 67), (68,), (2, 3, 68)])
def test_values_of_another_width_give_one_sentence(actor: FapFace, shape: tuple[int, ...]) -> None:
    with pytest.raises(RetargetError, match=r"FAPs have shape .* expected \(F, 68\)"):
        actor.frames(np.zeros(shape))
    with pytest.raises(RetargetError, match=r"FAPs have shape .* expected \(F, 68\)"):
        actor.channel_values(np.zeros(shape))


def test_frames_of_another_mesh_give_one_sentence(actor: FapFace) -> None:
    with pytest.raises(RetargetError, match=r"frames have shape \(2, 5, 3\), expected \(F, \d+, 3\)"):
        actor.measure(np.zeros((2, 5, 3)))


def test_an_unknown_variant_gives_one_sentence(actor: FapFace) -> None:
    with pytest.raises(RetargetError, match=r"'papr'.*default.*paper"):
        fit_fap_face(actor.mesh, actor.points, variant="papr")
