"""Mirroring a face on its surface: exact where the polygons mirror themselves, whatever the shape; near elsewhere."""

from dataclasses import replace

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.mirroring.mirror import WAYS, Mirror, fit_mirror
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.demo import DemoFace, actor, child, targets

NOTHING = FeaturePoints((), np.empty((0, 3), int), np.empty((0, 3)))


@pytest.fixture(scope="module")
def face() -> DemoFace:
    return child()


@pytest.fixture(scope="module")
def mirror(face) -> Mirror:
    return fit(face)


def fit(face: DemoFace, vertices: np.ndarray | None = None, points: FeaturePoints | None = None) -> Mirror:
    mesh = face.face.mesh if vertices is None else face.face.mesh.with_vertices(vertices)
    return fit_mirror(mesh, face.counts, face.corners, face.face.points if points is None else points)


def bent(vertices: np.ndarray) -> np.ndarray:
    """An asymmetric face: the left half wider, the chin to one side."""
    moved = vertices.copy()
    moved[:, 0] += 0.08 * np.maximum(vertices[:, 0], 0) + 2e-4 * (vertices[:, 1] - vertices[:, 1].mean()) ** 2
    return moved


def random_moves(face: DemoFace) -> np.ndarray:
    return np.random.default_rng(3).normal(size=face.face.mesh.vertices.shape)


def test_flipping_twice_changes_nothing(face, mirror):
    moves = random_moves(face)
    assert mirror.exact.all()
    np.testing.assert_allclose(mirror.flipped(mirror.flipped(moves)), moves, atol=1e-12)


def test_twins_do_not_depend_on_the_shape(face, mirror):
    for points in (None, NOTHING):
        found = fit(face, bent(face.face.mesh.vertices), points)
        assert found.exact.all()
        assert (found.matrix != mirror.matrix).nnz == 0


def test_twins_do_not_depend_on_the_order_of_polygons_and_vertices(face, mirror):
    rng = np.random.default_rng(4)
    order = rng.permutation(len(face.face.mesh.vertices))
    new = np.argsort(order)
    starts = np.cumsum(face.counts) - face.counts
    shuffled = rng.permutation(len(face.counts))
    corners = np.concatenate([face.corners[starts[p] : starts[p] + face.counts[p]] for p in shuffled])
    counts, vertices = face.counts[shuffled], face.face.mesh.vertices[order]
    points = replace(face.face.points, vertices=new[face.face.points.vertices])
    found = fit_mirror(TriMesh.from_polygons(vertices, counts, new[corners]), counts, new[corners], points)
    assert (found.matrix != mirror.matrix[order][:, order]).nnz == 0


@pytest.mark.parametrize("way", ["LEFT_TO_RIGHT", "RIGHT_TO_LEFT", "BOTH"])
def test_what_is_mirrored_is_symmetric(face, way):
    mirror = fit(face, bent(face.face.mesh.vertices))
    made = mirror.shape(random_moves(face), way)
    np.testing.assert_allclose(mirror.flipped(made), made, atol=1e-12)


def test_the_half_that_gives_stays(face, mirror):
    moves = random_moves(face)
    for way, gives in (("LEFT_TO_RIGHT", 1.0), ("RIGHT_TO_LEFT", 0.0)):
        kept = mirror.left_share == gives
        assert 0.2 < kept.mean() < 0.5
        np.testing.assert_array_equal(mirror.shape(moves, way)[kept], moves[kept])
    places = dict(zip(face.face.points.names, face.face.points.matrix(len(moves)) @ mirror.left_share, strict=True))
    assert places["8.3"] == 1.0  # the left corner of the lips
    assert places["8.4"] == 0.0


def test_a_wink_changes_eyes(face, mirror):
    eyes = {
        name: face.face.points.positions(face.face.mesh.vertices)[i] for i, name in enumerate(face.face.points.names)
    }
    near = np.linalg.norm(face.face.mesh.vertices - eyes["3.1"], axis=1) < 15
    moves = np.where(near[:, None], [0.0, -3.0, 1.0], 0.0)
    flipped = np.abs(mirror.flipped(moves)).max(axis=1) > 1
    middle = face.face.mesh.vertices[flipped].mean(axis=0)
    assert np.linalg.norm(middle - eyes["3.2"]) < 10 < np.linalg.norm(middle - eyes["3.1"])


def test_scattered_triangles_are_mirrored_by_their_points():
    ape = next(face for face in targets() if face.name == "ape")
    mirror = fit(ape)
    assert not mirror.exact.any()
    for name in ("joy", "fear", "surprise"):
        moves = ape.face.examples[name] - ape.face.mesh.vertices
        assert np.linalg.norm(mirror.flipped(moves) - moves) < 0.02 * np.linalg.norm(moves), name
        assert np.linalg.norm(mirror.shape(moves, "LEFT_TO_RIGHT") - moves) < 0.02 * np.linalg.norm(moves), name
    with pytest.raises(RetargetError, match="pairs of left and right"):
        fit(ape, points=NOTHING)


def test_the_place_and_the_size_of_a_head_play_no_part(face, mirror):
    turn = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    moved = fit(face, 0.01 * face.face.mesh.vertices @ turn.T + [5, -3, 2])
    assert (moved.matrix != mirror.matrix).nnz == 0
    np.testing.assert_allclose(moved.plane.left, turn @ mirror.plane.left, atol=1e-9)
    np.testing.assert_allclose(moved.left_share, mirror.left_share, atol=1e-9)


def test_an_unknown_way(face, mirror):
    with pytest.raises(RetargetError, match=r"'UP'.*LEFT_TO_RIGHT"):
        mirror.shape(random_moves(face), "UP")
    assert len(WAYS) == 4


def test_the_eyes_are_each_others_image():
    built = actor(4_500)
    mirror = fit(built)
    assert mirror.exact.all()
    mesh = built.face.mesh
    image = mesh.components[mirror.matrix.indices]
    eyes = [
        k for k in np.unique(mesh.components) if abs(mesh.vertices[mesh.components == k, 0].mean()) > 0.1 * mesh.size
    ]
    assert len(eyes) >= 2
    for eye in eyes:
        opposite = np.unique(image[mesh.components == eye])
        assert len(opposite) == 1
        assert opposite[0] in eyes
        assert opposite[0] != eye


@pytest.mark.parametrize(("head", "most"), [("makehuman", 0.05), ("ict", 0.06)])
def test_heads_of_other_artists_have_twins_in_every_part(head, most, shared_data):
    """What these heads' left half does is what their right half does in the partner shape, as their artists made it."""
    data = np.load(shared_data / f"{head}_dev.npz", allow_pickle=True)
    counts, corners = (data[name].astype(np.int64) for name in ("face_counts", "face_indices"))
    mesh = TriMesh.from_polygons(data["vertices"].astype(float), counts, corners)
    names = [str(name) for name in data["expr_names"]]
    mirror = fit_mirror(mesh, counts, corners, NOTHING)
    assert mirror.exact.all()
    swapped = {name: name.replace("_L", "_R").replace("left", "right") for name in names}
    pairs = [(name, other) for name, other in swapped.items() if name != other and other in names]
    assert len(pairs) > 8
    for name, other in pairs:
        moves, image = (data["expr_delta"][names.index(one)].astype(float) for one in (name, other))
        assert np.linalg.norm(mirror.flipped(moves) - image) < most * np.linalg.norm(image), name
