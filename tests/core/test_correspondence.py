"""Correspondence on a made face with a mouth slit, whose truth is known, and on real heads."""

from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.matching.correspondence import correspond, places_on_source, predict_points
from facial_retarget_addon.core.matching.smooth_warp import fit_smooth_warp
from facial_retarget_addon.core.matching.surface_fill import HarmonicFill
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.mpeg4.regions import OWN_PARTS
from facial_retarget_addon.core.points import FeaturePoints, common_names
from facial_retarget_addon.core.rigid import fit_similarity
from facial_retarget_addon.files.points import read_points

# A face of two units: parameters u across, v upwards; the mouth is a slit from (-0.35, -0.4) to (0.35, -0.4).
MOUTH = -0.4
CORNER = 0.35
PLACES = {
    **{f"rim_{k}": (0.95 * np.cos(k * np.pi / 6), 0.95 * np.sin(k * np.pi / 6)) for k in range(12)},
    "nose": (0.0, 0.0),
    "nose_l": (0.18, -0.08),
    "nose_r": (-0.18, -0.08),
    "brow_l": (0.4, 0.5),
    "brow_r": (-0.4, 0.5),
    "eye_l": (0.4, 0.25),
    "eye_r": (-0.4, 0.25),
    "corner_l": (CORNER, MOUTH),
    "corner_r": (-CORNER, MOUTH),
    "upper": (0.0, MOUTH + 1e-6),
    "lower": (0.0, MOUTH - 1e-6),
    "chin": (0.0, -0.75),
}


def shape(uv: np.ndarray) -> np.ndarray:
    u, v = uv.T
    nose = 0.35 * np.exp(-(u**2 + (v + 0.02) ** 2) / 0.02)
    lips = 0.12 * np.exp(-(u**2 / 0.08 + (v - MOUTH) ** 2 / 0.01))
    return np.stack([u, v, 0.8 * np.sqrt(np.maximum(2.2 - u**2 - v**2, 0)) + nose + lips], axis=1)


def other_shape(xyz: np.ndarray) -> np.ndarray:
    """A smooth change of proportions by up to a quarter."""
    x, y, z = xyz.T
    return np.stack([x * (1 + 0.2 * y), 1.15 * y + 0.12 * np.cos(1.5 * x), z * (1 + 0.15 * x * x) + 0.1 * y], axis=1)


def parameters(side: int) -> tuple[np.ndarray, np.ndarray]:
    """Grid (V, 2) cut open along the mouth, and its faces."""
    line = np.linspace(-1, 1, side)
    on_mouth = round((MOUTH + 1) / 2 * (side - 1))
    u, v = np.meshgrid(line, np.interp(np.arange(side), [0, on_mouth, side - 1], [-1, MOUTH, 1]))
    uv = np.stack([u.ravel(), v.ravel()], axis=1)
    slit = np.flatnonzero((np.abs(uv[:, 1] - MOUTH) < 1e-9) & (np.abs(uv[:, 0]) < CORNER - 1e-9))
    first = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    faces = np.concatenate(
        [np.stack([first, first + 1, first + side + 1], 1), np.stack([first, first + side + 1, first + side], 1)]
    )
    below = uv[faces].mean(axis=1)[:, 1] < MOUTH
    lower = np.arange(len(uv))
    lower[slit] = len(uv) + np.arange(len(slit))
    faces[below] = lower[faces[below]]
    uv[slit, 1] += 1e-6
    return np.concatenate([uv, uv[slit] - [0, 2e-6]]), faces


def made_points(uv: np.ndarray, faces: np.ndarray) -> FeaturePoints:
    """PLACES as exact barycentric places in the parameter plane."""
    found, weights = [], []
    for place in PLACES.values():
        a, b, c = uv[faces[:, 0]], uv[faces[:, 1]], uv[faces[:, 2]]
        basis = np.linalg.inv(np.stack([b - a, c - a], axis=2))
        bary = np.einsum("fij,fj->fi", basis, np.asarray(place) - a)
        full = np.concatenate([1 - bary.sum(axis=1, keepdims=True), bary], axis=1)
        best = full.min(axis=1).argmax()
        found.append(faces[best])
        weights.append(full[best])
    return FeaturePoints(tuple(PLACES), np.array(found), np.array(weights))


class Made:
    """The made face on a grid, as it is or with its proportions changed, with its exact points."""

    def __init__(self, side: int, changed: bool) -> None:
        self.uv, faces = parameters(side)
        vertices = shape(self.uv)
        self.mesh = TriMesh(other_shape(vertices) if changed else vertices, faces)
        self.points = made_points(self.uv, faces)


@pytest.fixture(scope="module")
def source() -> Made:
    return Made(81, False)


@pytest.fixture(scope="module")
def target() -> Made:
    return Made(60, True)


@pytest.fixture(scope="module")
def carried(source: Made, target: Made) -> np.ndarray:
    """The source's parameters as the target's vertices receive them."""
    found = correspond(source.mesh, source.points, target.mesh, target.points)
    return np.asarray(found.matrix(source.mesh.faces, len(source.mesh.vertices)) @ source.uv)


def rows(made_source: Made, made_target: Made) -> np.ndarray:
    found = correspond(made_source.mesh, made_source.points, made_target.mesh, made_target.points)
    return np.asarray(found.matrix(made_source.mesh.faces, len(made_source.mesh.vertices)).todense())


def test_a_smooth_change_of_proportions_is_undone(carried: np.ndarray, target: Made) -> None:
    error = np.linalg.norm(carried - target.uv, axis=1)[np.linalg.norm(target.uv, axis=1) < 0.95]
    assert np.median(error) < 0.01
    assert np.quantile(error, 0.99) < 0.05


def test_it_is_no_worse_than_the_warp_through_the_points(carried: np.ndarray, source: Made, target: Made) -> None:
    here, there = target.points.positions(target.mesh.vertices), source.points.positions(source.mesh.vertices)
    warp = fit_smooth_warp(here + 1e-5 * np.arange(len(here))[:, None], there)
    inside = np.linalg.norm(target.uv, axis=1) < 0.95
    warped = warp.apply(target.mesh.vertices)[:, :2]
    error = [np.linalg.norm((x - target.uv)[inside]) for x in (carried, warped)]
    assert error[0] < 1.1 * error[1]


def test_lips_stay_on_their_sides(carried: np.ndarray, source: Made, target: Made) -> None:
    upper_lip = source.uv[:, 1] > MOUTH
    found = correspond(source.mesh, source.points, target.mesh, target.points)
    matrix = found.matrix(source.mesh.faces, len(source.mesh.vertices))
    near = (np.abs(target.uv[:, 1] - MOUTH) < 0.05) & (np.abs(target.uv[:, 0]) < 0.45 * CORNER)
    upper = near & (target.uv[:, 1] > MOUTH)
    share = np.asarray(matrix @ upper_lip.astype(float)).ravel()
    assert upper.sum() > 10
    assert (near & ~upper).sum() > 10
    assert share[upper].min() > 0.95
    assert share[near & ~upper].max() < 0.05


@pytest.mark.parametrize("changed", [False, True])
def test_a_face_onto_itself_is_the_identity(changed: bool) -> None:
    made = Made(40, changed)
    np.testing.assert_allclose(rows(made, made), np.eye(len(made.uv)), atol=1e-9)


def test_rows_add_up_to_one(source: Made, target: Made) -> None:
    found = correspond(source.mesh, source.points, target.mesh, target.points)
    matrix = found.matrix(source.mesh.faces, len(source.mesh.vertices))
    inside = np.linalg.norm(target.uv, axis=1) < 0.95
    np.testing.assert_allclose(np.asarray(matrix.sum(axis=1)).ravel()[inside], 1, atol=1e-9)
    assert matrix.min() > -1e-9
    assert matrix.nnz < 20 * len(target.uv)


class TestInvariances:
    """Moved, scaled and renumbered faces give the same correspondence."""

    @pytest.fixture(scope="class")
    @classmethod
    def source(cls) -> Made:
        return Made(41, False)

    @pytest.fixture(scope="class")
    @classmethod
    def target(cls) -> Made:
        return Made(30, True)

    @pytest.fixture(scope="class")
    @classmethod
    def plain(cls, source: Made, target: Made) -> np.ndarray:
        return rows(source, target) @ source.uv

    @pytest.mark.parametrize("moved", ["source", "target"])
    def test_place_size_and_orientation(self, source: Made, target: Made, plain: np.ndarray, moved: str) -> None:
        turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
        turn *= np.linalg.det(turn)
        faces = {"source": source.mesh, "target": target.mesh}
        faces[moved] = faces[moved].with_vertices(250 * faces[moved].vertices @ turn.T + [40, -90, 7])
        found = correspond(faces["source"], source.points, faces["target"], target.points)
        matrix = found.matrix(source.mesh.faces, len(source.uv))
        np.testing.assert_allclose(matrix @ source.uv, plain, atol=2e-3)

    def test_vertex_order(self, source: Made, target: Made, plain: np.ndarray) -> None:
        rng = np.random.default_rng(2)
        order = rng.permutation(len(target.uv))
        rank = np.argsort(order)
        mesh = TriMesh(target.mesh.vertices[order], rank[target.mesh.faces][rng.permutation(len(target.mesh.faces))])
        points = FeaturePoints(target.points.names, rank[target.points.vertices], target.points.weights)
        found = correspond(source.mesh, source.points, mesh, points)
        matrix = found.matrix(source.mesh.faces, len(source.uv))
        np.testing.assert_allclose((matrix @ source.uv)[rank], plain, atol=2e-3)

    def test_the_same_again(self, source: Made, target: Made, plain: np.ndarray) -> None:
        np.testing.assert_array_equal(rows(source, target) @ source.uv, plain)


def test_components_without_points_stay_still(source: Made, target: Made) -> None:
    count = len(target.uv)
    eye = np.array([[0.4, 0.25, 1.2], [0.45, 0.25, 1.2], [0.4, 0.3, 1.2]])
    faces = np.concatenate([target.mesh.faces, [[count, count + 1, count + 2]]])
    mesh = TriMesh(np.concatenate([target.mesh.vertices, eye]), faces)
    found = correspond(source.mesh, source.points, mesh, target.points)
    assert [part.tolist() for part in found.still_components] == [[count, count + 1, count + 2]]
    assert found.matrix(source.mesh.faces, len(source.uv))[count:].nnz == 0


def test_motion_fades_where_the_source_ends(source: Made, target: Made) -> None:
    inner = [name for name in PLACES if not name.startswith("rim")]
    keep = np.linalg.norm(source.uv[source.mesh.faces].mean(axis=1), axis=1) < 0.8
    used, faces = np.unique(source.mesh.faces[keep], return_inverse=True)
    mask = TriMesh(source.mesh.vertices[used], faces.reshape(-1, 3))
    rank = np.full(len(source.uv), -1)
    rank[used] = np.arange(len(used))
    points = source.points.subset(inner)
    points = FeaturePoints(points.names, rank[points.vertices], points.weights)
    found = correspond(mask, points, target.mesh, target.points.subset(inner))
    total = np.asarray(found.matrix(mask.faces, len(used)).sum(axis=1)).ravel()
    radius = np.linalg.norm(target.uv, axis=1)
    np.testing.assert_allclose(total[radius < 0.7], 1, atol=1e-9)
    assert total[radius > 1.3].max() < 0.7
    assert (found.confidence[radius > 1.2] == 0).all()


def test_places_between_vertices_are_carried(source: Made, target: Made) -> None:
    found = correspond(source.mesh, source.points, target.mesh, target.points)
    rng = np.random.default_rng(3)
    face = rng.integers(0, len(target.mesh.faces), 200)
    weights = rng.dirichlet([1, 1, 1], 200)
    corners = target.mesh.faces[face]
    truth = np.einsum("nk,nkc->nc", weights, target.uv[corners])
    vertices, onto = places_on_source(found, source.mesh, target.mesh, corners, weights)
    error = np.linalg.norm(np.einsum("nk,nkc->nc", onto, source.uv[vertices]) - truth, axis=1)
    assert np.median(error[np.linalg.norm(truth, axis=1) < 0.9]) < 0.01


def test_missing_points_are_proposed(source: Made, target: Made) -> None:
    known = target.points.subset([name for name in PLACES if name not in ("nose", "brow_l", "chin")])
    points = predict_points(source.mesh, source.points, target.mesh, known)
    assert set(points.names) == set(PLACES)
    np.testing.assert_array_equal(points.subset(known.names).vertices, known.vertices)
    for name in ("nose", "brow_l", "chin"):
        place = points.subset([name]).positions(np.pad(target.uv, ((0, 0), (0, 1))))[0, :2]
        assert np.linalg.norm(place - PLACES[name]) < 0.06


def test_nothing_missing_changes_nothing(source: Made, target: Made) -> None:
    assert predict_points(source.mesh, source.points, target.mesh, target.points) is target.points


class TestBadInput:
    """One sentence says what arrived and what was wanted."""

    def test_too_few_common_points(self, source: Made, target: Made) -> None:
        with pytest.raises(RetargetError, match="3 feature points in common"):
            correspond(source.mesh, source.points, target.mesh, target.points.subset(["nose", "chin", "upper"]))

    def test_points_in_one_place(self, source: Made, target: Made) -> None:
        names = ["nose", "chin", "brow_l", "brow_r", "corner_l", "corner_r"]
        twice = source.points.subset(names)
        vertices, weights = twice.vertices.copy(), twice.weights.copy()
        vertices[1], weights[1] = vertices[0], weights[0]
        with pytest.raises(RetargetError, match="same place"):
            correspond(source.mesh, FeaturePoints(tuple(names), vertices, weights), target.mesh, target.points)

    def test_points_in_one_plane(self, source: Made) -> None:
        flat = source.mesh.with_vertices(source.mesh.vertices * [1, 1, 0])
        with pytest.raises(RetargetError, match="one plane"):
            correspond(source.mesh, source.points, flat, source.points)

    def test_points_on_one_line(self, source: Made) -> None:
        line = source.mesh.with_vertices(source.mesh.vertices * [0, 1, 0])
        with pytest.raises(RetargetError, match="one line"):
            correspond(source.mesh, source.points, line, source.points)

    def test_points_on_another_component(self, source: Made) -> None:
        count = len(source.uv)
        mesh = TriMesh(
            np.concatenate([source.mesh.vertices, np.eye(3)]),
            np.concatenate([source.mesh.faces, [[count, count + 1, count + 2]]]),
        )
        vertices = source.points.vertices.copy()
        vertices[source.points.index(["nose"])] = count
        stray = FeaturePoints(source.points.names, vertices, source.points.weights)
        with pytest.raises(RetargetError, match="target: feature points 'nose' lie on another component"):
            correspond(source.mesh, source.points, mesh, stray)


class TestHarmonicFill:
    """Values where they are unknown, from where they are known."""

    def test_linear_values_come_back_on_a_line(self) -> None:
        """A strip whose two ends are known: harmonic is linear."""
        x = np.arange(11.0)
        vertices = np.concatenate([np.stack([x, 0 * x, 0 * x], 1), np.stack([x, 0 * x + 1, 0 * x], 1)])
        k = np.arange(10)
        faces = np.concatenate([np.stack([k, k + 1, k + 12], 1), np.stack([k, k + 12, k + 11], 1)])
        mesh = TriMesh(vertices, faces)
        fill = HarmonicFill(mesh, np.isin(vertices[:, 0], [0, 10]), np.zeros(22))
        values = np.stack([vertices[:, 0], np.ones(22)], axis=1)
        filled = fill.values(values)
        np.testing.assert_allclose(filled[:, 1], 1)
        assert np.abs(filled[:, 0] - vertices[:, 0]).max() < 0.5
        np.testing.assert_allclose(fill.matrix(cut=0) @ values, filled, atol=1e-12)

    def test_the_matrix_is_what_the_values_say(self, target: Made) -> None:
        rng = np.random.default_rng(4)
        known = rng.random(len(target.uv)) < 0.3
        decay = rng.random(len(known)) * 0.1
        fill = HarmonicFill(target.mesh, known, decay)
        np.testing.assert_allclose(fill.matrix(cut=0) @ target.uv, fill.values(target.uv), atol=1e-9)
        total = np.asarray(fill.matrix(cut=0.1).sum(axis=1)).ravel()
        np.testing.assert_allclose(total, fill.values(np.ones((len(known), 1)))[:, 0], atol=1e-9)

    def test_what_nothing_reaches_is_zero(self, target: Made) -> None:
        fill = HarmonicFill(target.mesh, np.zeros(len(target.uv), bool), np.zeros(len(target.uv)))
        assert fill.matrix().nnz == 0


def test_the_warp_goes_through_its_points() -> None:
    rng = np.random.default_rng(6)
    points, images = rng.normal(size=(2, 30, 3))
    np.testing.assert_allclose(fit_smooth_warp(points, images).apply(points), images, atol=1e-9)
    affine = points @ rng.normal(size=(3, 3)) + 5
    elsewhere = rng.normal(size=(9, 3))
    warp = fit_smooth_warp(np.concatenate([points, elsewhere]), np.concatenate([affine, elsewhere * 0 + 1]) * 0 + 1)
    np.testing.assert_allclose(warp.apply(elsewhere), 1, atol=1e-9)


def test_a_real_pair_is_met(shared_data: Path) -> None:
    data = np.load(shared_data / "pair_ict_id02_to_id04_decim.npz")
    source = TriMesh(data["src_vertices"], data["src_tris"])
    target = TriMesh(data["tgt_vertices"], data["tgt_tris"])
    source_points = read_points(shared_data / "pair_source_points.json", source)
    target_points = read_points(shared_data / "pair_target_points.json", target)
    matrix = correspond(source, source_points, target, target_points).matrix(source.faces, len(source.vertices))
    similarity = fit_similarity(
        source_points.positions(source.vertices), target_points.subset(source_points.names).positions(target.vertices)
    )
    truth = data["gt_expr_delta"].astype(float)
    found = np.stack([similarity.turn(matrix @ motion) for motion in data["src_expr_delta"].astype(float)])
    face = (source.faces[data["corr_src_face"]] < 9409).all(axis=1)
    error = np.linalg.norm((found - truth)[:, face], axis=(1, 2)) / np.linalg.norm(truth[:, face], axis=(1, 2))
    assert np.median(error) < 0.065
    assert np.quantile(error, 0.9) < 0.11
    whole = np.linalg.norm(found - truth, axis=(1, 2)) / np.linalg.norm(truth, axis=(1, 2))
    assert np.median(whole) < 0.08


def test_a_real_head_onto_itself(shared_data: Path) -> None:
    archive = np.load(shared_data / "ict_dev.npz")
    mesh = TriMesh(archive["vertices"], archive["tris"])
    points = read_points(shared_data / "ict_points.json", mesh)
    found = correspond(mesh, points, mesh, points)
    skin = np.setdiff1d(np.arange(len(mesh.vertices)), np.concatenate(found.still_components))
    motion = archive["expr_delta"].astype(float)
    moved = found.matrix(mesh.faces, len(mesh.vertices)) @ motion[:, :, 0].T
    np.testing.assert_allclose(moved[skin], motion[:, skin, 0].T, atol=1e-6 * mesh.size)


def test_rounding_does_not_decide_on_faces_that_mirror_themselves() -> None:
    source, target = demo.actor(vertices=3_000).face, demo.targets()[1].face
    names = [name for name in common_names(source.points, target.points) if name not in OWN_PARTS]
    ours, theirs = source.points.subset(names), target.points.subset(names)
    wanted = correspond(source.mesh, ours, target.mesh, theirs).warped
    rounded = target.mesh.with_vertices(
        target.mesh.vertices * (1 + 1e-15 * np.random.default_rng(0).normal(size=target.mesh.vertices.shape))
    )
    found = correspond(source.mesh, ours, rounded, theirs).warped
    assert np.abs(found - wanted).max() < 1e-9 * source.mesh.size
