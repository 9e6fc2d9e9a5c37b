"""Closest points against trying every triangle."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from facial_retarget_addon.core.closest_point import Nearest, SurfaceFinder, closest_on_triangles
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mesh import TriMesh


def soup(rng: np.random.Generator, faces: int) -> TriMesh:
    """Triangles of very different sizes, some without area."""
    sizes = 10 ** rng.uniform(-3, 0.5, (faces, 1, 1))
    corners = rng.normal(size=(faces, 1, 3)) + sizes * rng.normal(size=(faces, 3, 3))
    corners[: faces // 20, 1] = corners[: faces // 20, 2]
    return TriMesh(corners.reshape(-1, 3), np.arange(3 * faces).reshape(-1, 3))


def tried_all(
    mesh: TriMesh, points: np.ndarray, normals: np.ndarray | None, agreement: float, limit: float
) -> tuple[np.ndarray, np.ndarray]:
    """Distances and whether there is a place, without any search structure."""
    corners = mesh.vertices[mesh.faces]
    weights = closest_on_triangles(points[:, None], corners[None])
    gap = np.linalg.norm(np.einsum("nfk,fkc->nfc", weights, corners) - points[:, None], axis=2)
    if normals is not None:
        gap[normals @ mesh.face_normals.T < agreement] = np.inf
    gap[gap >= limit] = np.inf
    return gap.min(axis=1), np.isfinite(gap.min(axis=1))


@settings(max_examples=30, deadline=None)
@example(seed=0, faces=245, agreement=None, limited=True)  # two nearest pieces beyond the limit, the third within
@given(st.integers(0, 10_000), st.integers(1, 300), st.sampled_from([None, -0.5, 0.2, 0.9]), st.booleans())
def test_the_search_is_exact(seed: int, faces: int, agreement: float | None, limited: bool) -> None:
    rng = np.random.default_rng(seed)
    mesh, points = soup(rng, faces), rng.normal(size=(60, 3)) * 2
    normals = None
    if agreement is not None:
        normals = rng.normal(size=(60, 3))
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    limit = 0.7 if limited else np.inf
    found = SurfaceFinder(mesh).closest(points, normals, agreement if agreement is not None else -1.0, limit)
    distance, there = tried_all(mesh, points, normals, agreement if agreement is not None else -1.0, limit)
    np.testing.assert_array_equal(found.face >= 0, there)
    np.testing.assert_allclose(found.distance[there], distance[there], atol=1e-12)
    check_places(mesh, points, found)


def check_places(mesh: TriMesh, points: np.ndarray, found: Nearest) -> None:
    there = found.face >= 0
    place = np.einsum("nk,nkc->nc", found.weights[there], mesh.vertices[mesh.faces[found.face[there]]])
    np.testing.assert_allclose(place, found.point[there], atol=1e-12)
    np.testing.assert_allclose(found.weights[there].sum(axis=1), 1)
    assert (found.weights >= -1e-12).all()
    np.testing.assert_allclose(np.linalg.norm(found.point - points, axis=1)[there], found.distance[there])
    assert np.isinf(found.distance[~there]).all()


def test_only_the_given_faces_are_searched() -> None:
    rng = np.random.default_rng(4)
    mesh, points = soup(rng, 100), rng.normal(size=(50, 3))
    some = np.arange(0, 100, 7)
    found = SurfaceFinder(mesh, some).closest(points)
    assert np.isin(found.face, some).all()
    part = TriMesh(mesh.vertices, mesh.faces[some])
    np.testing.assert_allclose(found.distance, SurfaceFinder(part).closest(points).distance)


def test_no_point_and_no_face() -> None:
    mesh = soup(np.random.default_rng(5), 10)
    assert len(SurfaceFinder(mesh).closest(np.empty((0, 3))).face) == 0
    with pytest.raises(RetargetError, match="without faces"):
        SurfaceFinder(mesh, np.empty(0, np.int64))
