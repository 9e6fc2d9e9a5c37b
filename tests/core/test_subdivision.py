"""Loop subdivision: counts, masks, limits, boundaries."""

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.levels.subdivision import boundary_parameters, hierarchy, loop
from facial_retarget_addon.core.mesh import TriMesh


def grid(width: int, height: int) -> np.ndarray:
    """Faces of a grid of width x height vertices."""
    corner = np.add.outer(np.arange(height - 1) * width, np.arange(width - 1)).ravel()
    lower = np.stack([corner, corner + 1, corner + width + 1], axis=1)
    upper = np.stack([corner, corner + width + 1, corner + width], axis=1)
    return np.concatenate([lower, upper])


def fan(spokes: int) -> np.ndarray:
    """Faces around vertex 0; vertices 1.. are the rim."""
    rim = 1 + np.arange(spokes)
    return np.stack([np.zeros(spokes, int), rim, np.roll(rim, -1)], axis=1)


def papers_counts() -> tuple[np.ndarray, int]:
    """A disc with 3 holes, 85 vertices, 134 faces and 40 boundary edges, like the base mesh of Na and Jung."""
    faces = grid(9, 9)
    keep = np.ones(len(faces), bool)
    keep[[10, 30, 50]] = False
    corner = np.flatnonzero((faces == 8).any(axis=1))
    keep[corner] = False
    faces = faces[keep]
    used, faces = np.unique(faces, return_inverse=True)
    faces = faces.reshape(-1, 3)
    count = len(used)
    for k in range(85 - count):
        a, b, c = faces[k]
        faces = np.concatenate([faces[:k], faces[k + 1 :], [[a, b, count], [b, c, count], [c, a, count]]])
        count += 1
    return faces, count


def test_vertex_counts_of_the_papers_table() -> None:
    faces, count = papers_counts()
    base = TriMesh(np.zeros((count, 3)), faces)
    assert (count, len(faces), len(base.boundary_edges)) == (85, 134, 40)
    steps = hierarchy(faces, count, 5)
    assert [step.vertex_count for step in steps] == [306, 1150, 4446, 17470, 69246]
    assert len(steps[-1].faces) == 137_216


def test_rows_add_up_to_one_and_orientation_stays(rng: np.random.Generator) -> None:
    faces, count = papers_counts()
    for step in hierarchy(faces, count, 3):
        assert np.allclose(step.matrix.sum(axis=1), 1, atol=1e-14)
        assert TriMesh(rng.normal(size=(step.vertex_count, 3)), step.faces).is_edge_manifold


@pytest.mark.parametrize("spokes", range(3, 13))
def test_interior_limit_mask_is_the_left_eigenvector(spokes: int) -> None:
    step = loop(fan(spokes), spokes + 1)
    spoke = np.array([np.flatnonzero((step.parents == [0, 1 + k]).all(axis=1))[0] for k in range(spokes)])
    local = step.matrix.toarray()[np.concatenate([[0], spokes + 1 + spoke])]
    beta = (0.625 - (0.375 + np.cos(2 * np.pi / spokes) / 4) ** 2) / spokes
    share = 1 / (spokes + 3 / (8 * beta))
    limit = np.concatenate([[1 - spokes * share], np.full(spokes, share)])
    assert np.allclose(limit @ local, limit, atol=1e-14)


def test_regular_vertex_and_edges() -> None:
    matrix = loop(fan(6), 7).matrix.toarray()
    assert np.allclose(matrix[0], [0.625] + [0.0625] * 6)
    edges = {tuple(np.round(np.sort(row[row > 0]), 12)) for row in matrix[7:]}
    assert edges == {(0.5, 0.5), (0.125, 0.125, 0.375, 0.375)}


def test_boundary_is_a_curve_of_its_own(rng: np.random.Generator) -> None:
    faces = fan(6)
    step = loop(faces, 7)
    positions = rng.normal(size=(7, 3))
    moved = positions.copy()
    moved[0] += 1.0
    fine, other = step.matrix @ positions, step.matrix @ moved
    on_boundary = TriMesh(fine, step.faces).boundary_vertices
    assert np.array_equal(fine[on_boundary], other[on_boundary])
    assert not np.allclose(fine[~on_boundary], other[~on_boundary])
    rim = positions[1:]
    assert np.allclose(fine[1:7], 0.75 * rim + 0.125 * (np.roll(rim, 1, axis=0) + np.roll(rim, -1, axis=0)))


def test_regular_lattice_keeps_linear_functions(rng: np.random.Generator) -> None:
    faces = grid(9, 9)
    x, y = np.meshgrid(np.arange(9.0), np.arange(9.0))
    positions = np.stack([x.ravel(), y.ravel(), np.zeros(81)], axis=1)
    step = loop(faces, 81)
    expected = np.concatenate([positions, positions[step.parents].mean(axis=1)])
    inner = ~TriMesh(expected, step.faces).boundary_vertices
    assert np.allclose((step.matrix @ positions)[inner], expected[inner])


def test_boundary_parameters_are_dyadic_and_in_order() -> None:
    faces, count = papers_counts()
    loops = TriMesh(np.random.default_rng(0).normal(size=(count, 3)), faces).boundary_loops
    assert len(loops) == 4
    steps = hierarchy(faces, count, 3)
    for number, (step, rings) in enumerate(zip(steps, boundary_parameters(loops, steps), strict=True)):
        fine = TriMesh(np.zeros((step.vertex_count, 3)), step.faces)
        following = {tuple(edge) for edge in fine.boundary_edges.tolist()}
        assert sum(len(vertices) for vertices, _ in rings) == len(following)
        for ring, (vertices, parameters) in zip(loops, rings, strict=True):
            assert np.allclose(parameters, np.arange(len(parameters)) / 2 ** (number + 1))
            assert np.array_equal(vertices[:: 2 ** (number + 1)], ring)
            assert set(zip(vertices.tolist(), np.roll(vertices, -1).tolist(), strict=True)) <= following


def test_non_manifold_base_is_refused() -> None:
    with pytest.raises(RetargetError, match="manifold"):
        loop(np.array([[0, 1, 2], [0, 1, 3], [1, 0, 4]]), 5)


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(1)
