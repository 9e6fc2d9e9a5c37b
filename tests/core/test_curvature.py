"""Principal curvatures against known surfaces, and the rotations between two faces."""

import numpy as np
import pytest

from facial_retarget_addon.core.curvature import frame_rotations, principal_frames
from facial_retarget_addon.core.levels.butterfly import butterfly
from facial_retarget_addon.core.levels.subdivision import hierarchy
from facial_retarget_addon.core.mesh import TriMesh

# fmt: off
OCTAHEDRON = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])
# fmt: on


def surface(columns: int, rows: int, radius: float = 2.0, tube: float = 0.7) -> tuple[TriMesh, np.ndarray]:
    """A torus with one direction of diagonals, faces outward, and the angle around the tube of each vertex."""
    u, v = np.meshgrid(2 * np.pi * np.arange(columns) / columns, 2 * np.pi * np.arange(rows) / rows, indexing="ij")
    ring = radius + tube * np.cos(v)
    places = np.stack([ring * np.cos(u), ring * np.sin(u), tube * np.sin(v)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij")
    corner = [((i + a) % columns * rows + (j + b) % rows).ravel() for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
    faces = np.concatenate([np.stack([corner[k] for k in way], axis=1) for way in ((0, 1, 2), (0, 2, 3))])
    return TriMesh(places, faces), v.ravel()


def errors(mesh: TriMesh, angle: np.ndarray, estimator: str) -> tuple[float, float]:
    """Worst error of the curvatures, mean error of the directions in degrees, against the torus's own."""
    found = principal_frames(mesh, estimator)
    tube = np.full(len(angle), -1 / 0.7)
    around = -np.cos(angle) / (2 + 0.7 * np.cos(angle))
    wanted = np.sort(np.stack([tube, around], axis=1), axis=1)[:, ::-1]
    u = np.arctan2(mesh.vertices[:, 1], mesh.vertices[:, 0])
    # The tube is the more convex direction everywhere: the larger curvature runs around the axis.
    along = np.stack([-np.sin(u), np.cos(u), np.zeros_like(u)], axis=1)
    cosine = np.abs(np.einsum("vi,vi->v", found.axes[:, 1], along)).clip(0, 1)
    return np.abs(found.curvatures - wanted).max(), float(np.degrees(np.arccos(cosine)).mean())


def test_least_squares_converge_with_the_square_of_the_edge() -> None:
    coarse, fine = (errors(*surface(size, size // 2), "least_squares") for size in (60, 120))
    assert coarse[0] < 0.02
    assert coarse[1] < 0.4
    assert fine[0] < 0.3 * coarse[0]
    assert fine[1] < 0.3 * coarse[1]


def test_taubin_is_faithful_to_its_own_error() -> None:
    """On one direction of diagonals it stays about ten degrees off, however fine the mesh."""
    for size in (60, 120):
        assert 9 < errors(*surface(size, size // 2), "taubin")[1] < 12


@pytest.mark.parametrize("estimator", ["least_squares", "taubin"])
def test_a_round_ball_is_equally_curved_and_convex(estimator: str) -> None:
    places, faces = np.array([[1.0, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]), OCTAHEDRON
    for step in hierarchy(faces, 6, 4, butterfly):
        places, faces = np.concatenate([places, places[step.parents].mean(axis=1)]), step.faces
        places /= np.linalg.norm(places, axis=1, keepdims=True)
    found = principal_frames(TriMesh(3 * places, faces), estimator)
    np.testing.assert_allclose(found.curvatures.mean(axis=1), -1 / 3, atol=0.03)
    assert np.median(found.anisotropy) < (0.05 if estimator == "least_squares" else 0.3)


def test_an_ellipsoids_ends_have_their_known_curvatures() -> None:
    a, b, c = 1.0, 2.0, 3.0
    ball = patch_of_a_ball(121, 2)
    mesh = ball.with_vertices(ball.vertices * [a, b, c])
    tip = int(np.linalg.norm(mesh.vertices - [a, 0, 0], axis=1).argmin())
    found = principal_frames(mesh)
    np.testing.assert_allclose(found.curvatures[tip], [-a / c**2, -a / b**2], atol=2e-3)
    assert abs(found.axes[tip, 1] @ [0, 0, 1]) > 0.999
    assert abs(found.axes[tip, 2] @ [0, 1, 0]) > 0.999


def patch_of_a_ball(size: int, width: float) -> TriMesh:
    """Vertices, size x size, of the unit ball around +x."""
    theta, phi = np.meshgrid(np.linspace(0.5, 2.6, size), np.linspace(-width / 2, width / 2, size), indexing="ij")
    places = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=-1)
    corner = np.add.outer(size * np.arange(size - 1), np.arange(size - 1)).ravel()
    after, over = corner + size, corner + size + 1
    faces = np.concatenate([np.stack([corner, after, over], 1), np.stack([corner, over, corner + 1], 1)])
    return TriMesh(places.reshape(-1, 3), faces)


def bumpy(rng: np.random.Generator) -> TriMesh:
    mesh, _ = surface(40, 24)
    return mesh.with_vertices(mesh.vertices + 0.01 * rng.normal(size=mesh.vertices.shape))


ROTATION = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])


@pytest.mark.parametrize("estimator", ["least_squares", "taubin"])
def test_a_mesh_onto_itself_does_not_turn(estimator: str, rng: np.random.Generator) -> None:
    mesh = bumpy(rng)
    found = frame_rotations(mesh, mesh.with_vertices(mesh.vertices), estimator)
    np.testing.assert_allclose(found, np.broadcast_to(np.eye(3), found.shape), atol=1e-12)


@pytest.mark.parametrize("estimator", ["least_squares", "taubin"])
def test_a_turned_and_scaled_mesh_gives_its_turn(estimator: str, rng: np.random.Generator) -> None:
    mesh = bumpy(rng)
    found = frame_rotations(mesh, mesh.with_vertices(5 * mesh.vertices @ ROTATION.T + [1, 2, 3]), estimator)
    np.testing.assert_allclose(found, np.broadcast_to(ROTATION, found.shape), atol=1e-9)


def test_normals_are_taken_to_normals_by_rotations(rng: np.random.Generator) -> None:
    source, target = bumpy(rng), bumpy(rng)
    found = frame_rotations(source, target)
    np.testing.assert_allclose(
        np.einsum("vij,vkj->vik", found, found), np.broadcast_to(np.eye(3), found.shape), atol=1e-9
    )
    np.testing.assert_allclose(np.linalg.det(found), 1, atol=1e-9)
    taken = np.einsum("vij,vj->vi", found, source.vertex_normals)
    np.testing.assert_allclose(taken, target.vertex_normals, atol=1e-9)


def test_signs_and_noise_do_not_flip_anything(rng: np.random.Generator) -> None:
    """Near a ball, where directions mean nothing, a little noise must not turn frames about."""
    ball = patch_of_a_ball(30, 2)
    one, other = (ball.with_vertices(ball.vertices + 1e-4 * rng.normal(size=ball.vertices.shape)) for _ in range(2))
    found = frame_rotations(one, other)[~ball.boundary_vertices]
    angle = np.degrees(np.arccos(np.clip((np.trace(found, axis1=1, axis2=2) - 1) / 2, -1, 1)))
    axes = principal_frames(one).axes[:, 1], principal_frames(other).axes[:, 1]
    free = np.degrees(np.arccos(np.abs(np.einsum("vi,vi->v", *axes)).clip(0, 1)))[~ball.boundary_vertices]
    assert free.max() > 45  # the directions themselves do turn
    assert angle.max() < 10
    assert np.median(angle) < 1


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(6)
