"""Figures of each vertex, and where a frame is in trouble."""

import numpy as np
import pytest

from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.quality import Quality
from facial_retarget_addon.core.vertex_figures import Compared, vertex_stretch

SIDE = 6


def grid() -> TriMesh:
    """A curved square of 6 x 6 vertices."""
    x, y = np.meshgrid(np.arange(SIDE, dtype=float), np.arange(SIDE, dtype=float))
    first = (np.arange(SIDE - 1)[:, None] * SIDE + np.arange(SIDE - 1)).ravel()
    faces = np.concatenate([first[:, None] + [0, 1, SIDE + 1], first[:, None] + [0, SIDE + 1, SIDE]])
    return TriMesh(np.stack([x, y, 0.1 * (x**2 - y**2)], axis=2).reshape(-1, 3), faces)


def turned(positions: np.ndarray) -> np.ndarray:
    """In another place, three times as large, a quarter turn around Z."""
    return 3 * positions @ np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]]) + [5, 6, 7]


@pytest.fixture
def mesh() -> TriMesh:
    return grid()


def test_nothing_is_stretched_at_rest_or_when_the_face_moves_as_a_whole(mesh: TriMesh) -> None:
    assert np.allclose(vertex_stretch(mesh, mesh.vertices), 1)
    assert np.allclose(vertex_stretch(mesh, mesh.vertices + [1, 2, 3]), 1)
    assert np.allclose(vertex_stretch(mesh, 0.5 * mesh.vertices), 1), "squeezing is no stretch"


def test_a_pulled_vertex_stretches_itself_and_its_neighbours_alone(mesh: TriMesh) -> None:
    moved = mesh.vertices.copy()
    moved[14] += [0, 0, 4]
    stretch = vertex_stretch(mesh, moved)
    near = np.unique(mesh.edges[(mesh.edges == 14).any(axis=1)])
    assert (stretch[near] > 2).all()
    assert np.allclose(np.delete(stretch, near), 1)
    longest = max(
        np.linalg.norm(moved[a] - moved[b]) / np.linalg.norm(mesh.vertices[a] - mesh.vertices[b])
        for a, b in mesh.edges
        if 14 in (a, b)
    )
    assert stretch[14] == pytest.approx(longest)


@pytest.fixture
def pair(mesh: TriMesh) -> Compared:
    """A face and the same elsewhere, larger and turned; the last vertex has no counterpart."""
    counterpart = np.arange(SIDE**2)
    counterpart[-1] = -1
    return Compared(mesh, mesh.with_vertices(turned(mesh.vertices)), counterpart)


def test_the_same_motion_differs_nowhere(pair: Compared) -> None:
    moved = pair.source.vertices + 0.3 * np.random.default_rng(1).standard_normal(pair.source.vertices.shape)
    assert np.nanmax(pair.motion_difference(moved, turned(moved))) < 1e-9
    assert np.nanmax(pair.stretch_beyond(moved, turned(moved))) == pytest.approx(1)
    assert np.isnan(pair.motion_difference(moved, turned(moved))[-1])
    assert np.isnan(pair.stretch_beyond(moved, turned(moved))[-1])


def test_a_difference_is_a_share_of_the_targets_size(pair: Compared) -> None:
    late = turned(pair.source.vertices)
    late[7] += [0, 0, 0.01 * pair.target.size]
    found = pair.motion_difference(pair.source.vertices, late)
    assert found[7] == pytest.approx(1.0)
    assert np.nanmax(np.delete(found, 7)) < 1e-9


def test_what_the_source_stretches_as_well_is_not_beyond_it(pair: Compared) -> None:
    moved = pair.source.vertices.copy()
    moved[14] += [0, 0, 4]
    beyond = pair.stretch_beyond(pair.source.vertices, turned(moved))
    assert beyond[14] > 2
    assert np.nanmax(pair.stretch_beyond(moved, turned(moved))) == pytest.approx(1)


def test_the_spots_of_a_frame_are_the_vertices_of_its_torn_edges_and_turned_triangles(mesh: TriMesh) -> None:
    quality = Quality(mesh, mesh, np.arange(SIDE**2))
    torn, folded = mesh.vertices.copy(), mesh.vertices.copy()
    torn[14] += [0, 0, 9]
    folded[14] += [-1.7, 0, 0]
    rest = np.repeat(mesh.vertices[None].astype(np.float32), 3, axis=0)
    quality.add(rest, np.stack([mesh.vertices, torn, folded]).astype(np.float32))
    calm, pulled, turned_over = quality.spots
    assert not len(calm.torn)
    assert not len(calm.turned)
    around = np.unique(mesh.edges[(mesh.edges == 14).any(axis=1)])
    assert np.array_equal(pulled.torn, around)
    assert quality.torn == [0, len(around) - 1, quality.torn[2]]
    assert 14 in turned_over.turned
    assert len(turned_over.turned) >= 3
    assert quality.flipped[2] > 0
