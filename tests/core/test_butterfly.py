"""Modified butterfly subdivision: what it reproduces, every rule by its printed weights, smooth limits."""

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.levels.butterfly import butterfly, extraordinary_weights
from facial_retarget_addon.core.levels.subdivision import Level, hierarchy, loop
from facial_retarget_addon.core.mesh import TriMesh

from .test_subdivision import fan, grid, papers_counts


def weights_of(step: Level, a: int, b: int) -> dict[int, float]:
    """Weights of the new vertex on the edge a b."""
    edge = np.flatnonzero((step.parents == sorted((a, b))).all(axis=1))[0]
    row = step.matrix[step.coarse_count + edge]
    return dict(zip(row.indices.tolist(), row.data.tolist(), strict=True))


def two_rings(spokes: int) -> np.ndarray:
    """Vertex 0 of some valence, its ring 1.., and regular surroundings: the fan subdivided twice."""
    return hierarchy(fan(spokes), spokes + 1, 2, butterfly)[-1].faces


def test_old_vertices_stay_and_rows_add_up_to_one() -> None:
    faces, count = papers_counts()
    for step in hierarchy(faces, count, 3, butterfly):
        assert step.interpolating
        assert np.allclose(step.matrix.sum(axis=1), 1, atol=1e-14)
    assert not loop(faces, count).interpolating


def test_both_schemes_make_the_same_faces() -> None:
    faces, count = papers_counts()
    ours, theirs = butterfly(faces, count), loop(faces, count)
    assert np.array_equal(ours.faces, theirs.faces)
    assert np.array_equal(ours.parents, theirs.parents)
    assert np.array_equal(ours.parent_on_boundary, theirs.parent_on_boundary)


def test_cubics_are_reproduced_on_regular_parts(rng: np.random.Generator) -> None:
    x, y = (part.ravel() for part in np.meshgrid(np.arange(9.0), np.arange(9.0)))
    coefficients = rng.normal(size=(4, 4))

    def cubic(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        return sum(coefficients[i, j] * x**i * y**j for i in range(4) for j in range(4 - i))

    step = butterfly(grid(9, 9), 81)
    middle_x, middle_y = x[step.parents].mean(axis=1), y[step.parents].mean(axis=1)
    inner = (np.minimum(middle_x, middle_y) >= 2) & (np.maximum(middle_x, middle_y) <= 6)
    found = (step.matrix @ cubic(x, y))[81:]
    assert inner.sum() > 40
    np.testing.assert_allclose(found[inner], cubic(middle_x, middle_y)[inner], rtol=1e-12)


def test_linear_functions_are_reproduced_up_to_the_boundary() -> None:
    x, y = (part.ravel() for part in np.meshgrid(np.arange(7.0), np.arange(7.0)))
    positions = np.stack([x, y], axis=1)
    step = butterfly(grid(7, 7), 49)
    # At the two corners where the boundary turns, the curve of the boundary is not straight.
    ends = np.abs(positions[step.parents] - [[[3, 3]]]).max(axis=2).min(axis=1)
    off_corner = ~step.parent_on_boundary | (ends < 3) | (np.abs(positions[step.parents].mean(1) - 3).min(axis=1) < 2)
    wanted = positions[step.parents].mean(axis=1)
    np.testing.assert_allclose((step.matrix @ positions)[49:][off_corner], wanted[off_corner], atol=1e-13)


def test_any_affine_map_goes_through(rng: np.random.Generator) -> None:
    faces, count = papers_counts()
    step = butterfly(faces, count)
    positions, turn, shift = rng.normal(size=(count, 3)), rng.normal(size=(3, 3)), rng.normal(size=3)
    np.testing.assert_allclose(step.matrix @ (positions @ turn + shift), step.matrix @ positions @ turn + shift)


def test_the_regular_mask() -> None:
    step = butterfly(grid(7, 7), 49)
    found = weights_of(step, 24, 25)
    ends, corners = {24: 1 / 2, 25: 1 / 2}, {32: 1 / 8, 17: 1 / 8}
    assert {vertex: found[vertex] for vertex in ends | corners} == ends | corners
    assert sorted(value for vertex, value in found.items() if vertex not in ends | corners) == [-1 / 16] * 4


@pytest.mark.parametrize(
    ("spokes", "ring"), [(3, [5 / 12, -1 / 12, -1 / 12]), (4, [3 / 8, 0, -1 / 8, 0]), (5, None), (7, None), (9, None)]
)
def test_the_mask_beside_an_extraordinary_vertex(spokes: int, ring: list[float] | None) -> None:
    weights = extraordinary_weights(spokes)
    assert weights.sum() == pytest.approx(0.25, abs=1e-15)
    if ring is not None:
        np.testing.assert_allclose(weights, ring)
    faces = two_rings(spokes)
    step = butterfly(faces, faces.max() + 1)
    mesh = TriMesh(np.zeros((faces.max() + 1, 3)), faces)
    neighbours = mesh.edges[(mesh.edges == 0).any(axis=1)].max(axis=1)
    for other in neighbours.tolist():
        found = weights_of(step, 0, other)
        assert found[0] == pytest.approx(0.75)
        assert found[other] == pytest.approx(weights[0])
        assert set(found) <= {0, *neighbours.tolist()}
        assert sorted(found[v] for v in found if v != 0) == pytest.approx(sorted(w for w in weights if w))


def test_between_two_extraordinary_vertices_stands_the_mean() -> None:
    # An octahedron: every vertex has valence 4.
    faces = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])
    found = weights_of(butterfly(faces, 6), 0, 2)
    # 3/4 + 3/8 on each end, -1/8 on what lies opposite to each end, all halved.
    assert found == pytest.approx({0: 9 / 16, 2: 9 / 16, 1: -1 / 16, 3: -1 / 16})


def test_the_boundary_is_a_curve_of_its_own() -> None:
    step = butterfly(fan(6), 7)
    assert weights_of(step, 1, 2) == pytest.approx({6: -1 / 16, 1: 9 / 16, 2: 9 / 16, 3: -1 / 16})


def test_missing_corners_are_reflected() -> None:
    # Two triangles: all four corners beyond the edge 0 2 are missing.
    step = butterfly(np.array([[0, 1, 2], [0, 2, 3]]), 4)
    # The reflections cancel what the two corners give.
    assert weights_of(step, 0, 2) == {0: 1 / 2, 2: 1 / 2}


def test_a_single_triangle_and_ears_are_allowed() -> None:
    step = butterfly(np.array([[0, 1, 2]]), 3)
    assert weights_of(step, 0, 1) == pytest.approx({0: 9 / 16, 1: 9 / 16, 2: -1 / 8})


def test_where_boundaries_touch_they_end() -> None:
    # Two triangles that hang together by vertex 0.
    step = butterfly(np.array([[0, 1, 2], [0, 3, 4]]), 5)
    assert weights_of(step, 0, 1) == pytest.approx({0: 7 / 16, 1: 10 / 16, 2: -1 / 16})


@pytest.mark.parametrize("spokes", [3, 4, 5, 7, 9])
def test_the_limit_is_smooth_at_extraordinary_vertices(spokes: int) -> None:
    """Normals of the faces around the vertex close up to one plane, level by level."""
    faces = two_rings(spokes)
    count = faces.max() + 1
    steps = hierarchy(faces, count, 5, butterfly)
    flat = lay_out(spokes, count)
    positions = np.column_stack([flat, 0.3 * flat[:, 0] ** 2 - 0.2 * flat[:, 0] * flat[:, 1]])
    spreads = []
    for step in steps:
        positions = step.matrix @ positions
        mesh = TriMesh(positions, step.faces)
        around = mesh.face_normals[(mesh.faces == 0).any(axis=1)]
        spreads.append(1 - (around @ around.T).min())
    assert spreads[-1] < 2e-4
    assert spreads[-1] < 0.1 * spreads[0]


def lay_out(spokes: int, count: int) -> np.ndarray:
    """(count, 2) places of the twice-subdivided fan in the plane."""
    angle = 2 * np.pi * np.arange(spokes) / spokes
    places = np.concatenate([[[0, 0]], np.stack([np.cos(angle), np.sin(angle)], axis=1)])
    for step in hierarchy(fan(spokes), spokes + 1, 2, butterfly):
        places = np.concatenate([places, places[step.parents].mean(axis=1)])
    return places[:count]


def test_non_manifold_faces_are_refused() -> None:
    with pytest.raises(RetargetError, match="manifold"):
        butterfly(np.array([[0, 1, 2], [0, 1, 3], [1, 0, 4]]), 5)


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(2)
