"""Meshes that are subdivided already are recognised, whatever the order of their vertices, faces and corners."""

import numpy as np
import pytest

from facial_retarget_addon.core.levels.butterfly import butterfly
from facial_retarget_addon.core.levels.recognition import recognise
from facial_retarget_addon.core.levels.subdivision import hierarchy

from .test_subdivision import fan, grid, papers_counts

BASES = {"with holes": papers_counts(), "fan": (fan(5), 6), "triangle": (np.array([[0, 1, 2]]), 3)}


def turned(faces: np.ndarray) -> set[tuple[int, ...]]:
    """Faces as a set, each from its lowest corner on."""
    return {tuple(np.roll(face, -face.argmin()).tolist()) for face in faces}


@pytest.mark.parametrize("name", BASES)
@pytest.mark.parametrize("levels", [1, 2, 3])
def test_a_shuffled_mesh_is_recognised(name: str, levels: int, rng: np.random.Generator) -> None:
    base, count = BASES[name]
    finest = hierarchy(base, count, levels, butterfly)[-1]
    rank = rng.permutation(finest.vertex_count)
    faces = rank[finest.faces][rng.permutation(len(finest.faces))]
    corner = rng.integers(0, 3, len(faces))
    faces = np.stack([faces[np.arange(len(faces)), (corner + k) % 3] for k in range(3)], axis=1)
    found = recognise(faces, finest.vertex_count, 6, butterfly)
    assert found is not None
    assert (found.base_count, len(found.base_faces), len(found.steps)) == (count, len(base), levels)
    assert np.array_equal(np.sort(found.order), np.arange(finest.vertex_count))
    assert turned(found.order[found.steps[-1].faces]) == turned(faces)


def test_no_more_levels_are_undone_than_asked_for() -> None:
    base, count = papers_counts()
    finest = hierarchy(base, count, 3, butterfly)[-1]
    found = recognise(finest.faces, finest.vertex_count, 2, butterfly)
    assert found is not None
    assert len(found.steps) == 2
    assert found.base_count == 306


def test_one_turned_edge_is_enough_to_refuse() -> None:
    base, count = papers_counts()
    finest = hierarchy(base, count, 1, butterfly)[-1]
    faces = finest.faces.copy()
    a, b, c = faces[2]  # a face beside its centre, faces[3]
    d = next(v for v in faces[3] if v not in (a, b, c))
    shared = [v for v in (a, b, c) if v in faces[3]]
    apex = next(v for v in (a, b, c) if v not in shared)
    faces[2], faces[3] = [apex, shared[0], d], [apex, d, shared[1]]
    assert recognise(faces, finest.vertex_count, 1, butterfly) is None


def test_meshes_of_no_such_connectivity_are_refused() -> None:
    base, count = papers_counts()
    assert recognise(base, count, 4, butterfly) is None
    assert recognise(np.array([[0, 1, 2], [0, 1, 3], [1, 0, 4], [0, 1, 5]]), 6, 4, butterfly) is None
    assert recognise(fan(8), 9, 4, butterfly) is None


def test_a_grid_is_read_from_its_corners() -> None:
    found = recognise(grid(9, 9), 81, 6, butterfly)
    assert found is not None
    assert len(found.steps) == 3
    assert found.base_count == 4


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(8)
