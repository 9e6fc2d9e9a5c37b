"""Levels with strengths, vertices riding on a mesh, motions blended, and the numbers about a result."""

import numpy as np
import pytest
import scipy.sparse as sp

from facial_retarget_addon.core.binding import apply_matrix, bind
from facial_retarget_addon.core.carry import BlendedMotion, LinearMotion, local_turns
from facial_retarget_addon.core.levels.level_gains import scale_levels
from facial_retarget_addon.core.levels.subdivision import Level, hierarchy
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.quality import Quality
from facial_retarget_addon.core.rigid import Similarity


def sheet(side: int) -> TriMesh:
    """A flat square of 2 (side - 1)² triangles facing +z."""
    x, y = np.meshgrid(np.linspace(-1, 1, side), np.linspace(-1, 1, side), indexing="ij")
    vertices = np.stack([x.ravel(), y.ravel(), np.zeros(side * side)], axis=1)
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    a, b, c, d = corner, corner + side, corner + side + 1, corner + 1
    return TriMesh(vertices, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]))


def turned(angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(5)


class TestLevels:
    """A base of 16 vertices, two levels, 30 source vertices, 40 target vertices."""

    @pytest.fixture
    def steps(self) -> list[Level]:
        base = sheet(4)
        return hierarchy(base.faces, 16, 2)

    @pytest.fixture
    def parts(self, steps: list[Level], rng: np.random.Generator) -> tuple[sp.csr_matrix, ...]:
        fine_count = steps[-1].vertex_count
        shapes = ((40, 30), (fine_count, 30), (40, fine_count))
        return tuple(sp.random(*shape, 0.2, "csr", rng=rng) for shape in shapes)

    def test_strengths_of_one_change_nothing(self, steps: list[Level], parts: tuple[sp.csr_matrix, ...]) -> None:
        scaled = scale_levels(*parts, np.linspace(0, 1, 40), steps, [1, 1, 1], 1.0)
        np.testing.assert_allclose(scaled.toarray(), parts[0].toarray(), atol=1e-12)

    def test_equal_strengths_scale_everything(self, steps: list[Level], parts: tuple[sp.csr_matrix, ...]) -> None:
        scaled = scale_levels(*parts, np.linspace(0, 1, 40), steps, [0.3, 0.3, 0.3], 0.3)
        np.testing.assert_allclose(scaled.toarray(), 0.3 * parts[0].toarray(), atol=1e-12)

    def test_levels_add_up(self, steps: list[Level], parts: tuple[sp.csr_matrix, ...]) -> None:
        one_each = [
            scale_levels(*parts, np.ones(40), steps, np.eye(4)[k, :3].tolist(), float(np.eye(4)[k, 3]))
            for k in range(4)
        ]
        np.testing.assert_allclose(sum(part.toarray() for part in one_each), parts[0].toarray(), atol=1e-12)

    def test_away_from_the_base_all_motion_is_base_motion(
        self, steps: list[Level], parts: tuple[sp.csr_matrix, ...]
    ) -> None:
        scaled = scale_levels(*parts, np.zeros(40), steps, [2.0, 0.0, 0.0], 0.0)
        np.testing.assert_allclose(scaled.toarray(), 2 * parts[0].toarray())


def flakes(places: np.ndarray, up: float = 1.0) -> TriMesh:
    """A tiny triangle at each place, facing +z, or -z for `up` -1: vertex 3 i is place i."""
    corners = places[:, None] + 1e-3 * np.array([[0, 0, 0], [1, 0, 0], [0, up, 0]])
    return TriMesh(corners.reshape(-1, 3), np.arange(3 * len(places)).reshape(-1, 3))


def everyone(mesh: TriMesh) -> np.ndarray:
    return np.ones(len(mesh.vertices), bool)


class TestBinding:
    """Vertices around a flat carrier."""

    def test_vertices_follow_an_affine_carrier(self, rng: np.random.Generator) -> None:
        carrier = sheet(6)
        places = np.concatenate([rng.uniform(-0.9, 0.9, (30, 2)), rng.uniform(-0.02, 0.02, (30, 1))], axis=1)
        mesh = flakes(places)
        bound = bind(mesh, everyone(mesh), carrier, 0.5)
        rotation = turned(0.7)
        moved = bound.displacements((carrier.vertices @ rotation.T - carrier.vertices)[None].astype(np.float32))
        np.testing.assert_allclose(moved[0], mesh.vertices @ rotation.T - mesh.vertices, atol=1e-5)

    def test_inside_is_one_and_fades_beyond_the_border(self) -> None:
        places = np.array([[0, 0, 0.01], [1.2, 0, 0], [1.6, 0, 0]])
        mesh = flakes(places)
        inside = bind(mesh, everyone(mesh), sheet(6), 0.5).inside[::3]
        assert inside[0] == 1
        assert 0 < inside[1] < 1
        assert inside[2] == 0

    def test_the_other_side_is_not_ridden_on(self) -> None:
        mesh = flakes(np.array([[0, 0, -0.01]]), up=-1.0)
        assert not bind(mesh, everyone(mesh), sheet(6), 0.5).inside.any()

    def test_who_may_not_ride_does_not(self) -> None:
        mesh = flakes(np.array([[0, 0, 0.01], [0.5, 0, 0.01]]))
        inside = bind(mesh, np.arange(6) < 3, sheet(6), 0.5).inside
        assert inside.tolist() == [1, 1, 1, 0, 0, 0]


def test_apply_matrix_works_on_every_frame(rng: np.random.Generator) -> None:
    matrix, values = rng.normal(size=(4, 7)), rng.normal(size=(3, 7, 3))
    np.testing.assert_allclose(apply_matrix(sp.csr_matrix(matrix), values), np.einsum("mn,fnc->fmc", matrix, values))


def test_a_linear_motion_scales_and_turns(rng: np.random.Generator) -> None:
    rest = rng.normal(size=(9, 3))
    motion = LinearMotion(sp.eye(9).tocsr(), rest, Similarity(2.0, turned(0.4), np.zeros(3)))
    frames = rest + rng.normal(size=(2, 9, 3))
    np.testing.assert_allclose(motion(frames.astype(np.float32)), 2 * (frames - rest) @ turned(0.4).T, atol=1e-5)
    assert not motion(rest.astype(np.float32)[None]).any()


def random_normals(rng: np.random.Generator, count: int) -> np.ndarray:
    vectors = rng.normal(size=(count, 3))
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def test_local_turns_of_a_turned_surface_are_that_turn(rng: np.random.Generator) -> None:
    vertices, base, places = (rng.normal(size=(count, 3)) for count in (200, 60, 20))
    before = random_normals(rng, 200)
    found = local_turns(before, before @ turned(0.9).T, vertices, np.ones(200), base, 1.0, places)
    np.testing.assert_allclose(found, np.broadcast_to(turned(0.9), (20, 3, 3)), atol=1e-9)


def test_vertices_without_trust_do_not_turn_anything(rng: np.random.Generator) -> None:
    vertices, base = rng.normal(size=(200, 3)), rng.normal(size=(60, 3))
    before = random_normals(rng, 200)
    after = np.where(np.arange(200)[:, None] < 100, before, random_normals(rng, 200))
    found = local_turns(before, after, vertices, (np.arange(200) < 100) * 1.0, base, 1.0, base)
    np.testing.assert_allclose(found, np.broadcast_to(np.eye(3), (60, 3, 3)), atol=1e-9)


def test_a_blend_is_the_ride_inside_and_the_other_motion_outside() -> None:
    carrier = sheet(6)
    places = np.array([[0, 0, 0.0], [3, 0, 0]])
    mesh = flakes(places)
    bound = bind(mesh, everyone(mesh), carrier, 0.5)
    blend = BlendedMotion(
        lambda frames: np.ones((len(frames), 36, 3), np.float32),
        bound,
        lambda frames: np.full((len(frames), 6, 3), 5, np.float32),
    )
    blended = blend(np.zeros((1, 1, 3)))[0]
    np.testing.assert_allclose(blended[:3], 1, atol=1e-6)
    np.testing.assert_allclose(blended[3:], 5, atol=1e-6)


class TestQuality:
    """A sheet onto itself with damage done on purpose."""

    @pytest.fixture
    def mesh(self) -> TriMesh:
        return sheet(8)

    def summary(self, mesh: TriMesh, frame: np.ndarray) -> dict[str, float | int]:
        quality = Quality(mesh, mesh, np.arange(len(mesh.vertices)))
        rest = mesh.vertices.astype(np.float32)
        quality.add(np.stack([rest, rest]), np.stack([rest, frame]).astype(np.float32))
        return quality.summary()

    def test_nothing_is_wrong_with_the_neutral(self, mesh: TriMesh) -> None:
        found = self.summary(mesh, mesh.vertices)
        assert found["torn_edges"] == found["flipped_triangles"] == found["neutral_drift"] == 0

    def test_torn_edges_are_counted_and_the_frame_named(self, mesh: TriMesh) -> None:
        frame = mesh.vertices.copy()
        frame[27, 2] += 3.0
        found = self.summary(mesh, frame)
        assert found["torn_edges"] == (mesh.edges == 27).any(axis=1).sum()
        assert found["worst_frame"] == 2
        assert found["neutral_drift"] == pytest.approx(3.0)

    def test_turned_triangles_are_counted(self, mesh: TriMesh) -> None:
        frame = mesh.vertices * [-1, 1, 1]
        assert self.summary(mesh, frame)["flipped_triangles"] == len(mesh.faces)
