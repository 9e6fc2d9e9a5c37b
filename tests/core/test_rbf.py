"""Multiquadric maps: exact at their examples, exact on linear maps, solvable where the paper's form is not."""

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.steering.rbf import fit_multiquadrics, merge_centres, multiquadric


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(7)


def with_neutral(centres: np.ndarray) -> np.ndarray:
    return np.concatenate([np.zeros_like(centres[:, :1]), centres], axis=1)


@pytest.mark.parametrize("linear", [True, False])
def test_every_example_is_met(rng: np.random.Generator, linear: bool) -> None:
    centres = with_neutral(rng.normal(size=(5, 6, 3)))
    values = with_neutral(rng.normal(size=(5, 6, 3)))
    maps = fit_multiquadrics(centres, values, 1e-6, 1.0, linear)
    for m in range(7):
        np.testing.assert_allclose(maps(centres[None, :, m]), values[None, :, m], atol=3e-4)


def test_a_linear_map_is_met_everywhere(rng: np.random.Generator) -> None:
    matrix = rng.normal(size=(3, 3))
    centres = with_neutral(rng.normal(size=(4, 6, 3)))
    maps = fit_multiquadrics(centres, centres @ matrix, 1e-6, 1.0)
    far = 3 * rng.normal(size=(10, 4, 3))
    np.testing.assert_allclose(maps(far), far @ matrix, atol=1e-3)


def test_coinciding_centres_are_merged_and_averaged(rng: np.random.Generator) -> None:
    centres = with_neutral(rng.normal(size=(1, 3, 3)))
    twice = np.concatenate([centres, centres[:, 1:2] + 1e-9], axis=1)
    values = with_neutral(rng.normal(size=(1, 4, 3)))
    maps = fit_multiquadrics(twice, values, 1e-6, 1.0)
    expected = 0.5 * (values[:, 1] + values[:, 4])
    np.testing.assert_allclose(maps(centres[None, :, 1])[0], expected, atol=1e-4)


def test_examples_on_a_line_give_no_wild_motion_across_it(rng: np.random.Generator) -> None:
    line = np.linspace(0, 1, 7)[None, :, None] * np.array([1.0, 0, 0])
    maps = fit_multiquadrics(line, 2 * line, 1e-6, 1.0)
    across = np.array([[[0.5, 0.3, 0.0]]])
    assert np.linalg.norm(maps(across)) < 3 * np.linalg.norm(across)


def test_a_vertex_that_no_example_moves_follows_the_heads_scale() -> None:
    still = np.zeros((2, 7, 3))
    maps = fit_multiquadrics(still, still, 1e-3, 2.5)
    motion = np.ones((1, 2, 3))
    np.testing.assert_allclose(maps(motion), 2.5 * motion)


def test_the_printed_system_has_rank_one(rng: np.random.Generator) -> None:
    """Equation (4) without centres: every column holds the same values, so it cannot be solved as printed."""
    distance = np.linalg.norm(rng.normal(size=(7, 3)), axis=1)
    printed = np.tile(multiquadric(distance, 1.0)[:, None], (1, 7))
    assert np.linalg.matrix_rank(printed) == 1


def test_shapes_that_differ_are_named() -> None:
    with pytest.raises(RetargetError, match=r"\(2, 7, 3\).*\(2, 6, 3\)"):
        fit_multiquadrics(np.zeros((2, 7, 3)), np.zeros((2, 6, 3)), 1e-3, 1.0)


def test_clusters_are_named_by_their_first_centre() -> None:
    keep, cluster = merge_centres(np.array([[0.0, 0, 0], [1, 0, 0], [1e-5, 0, 0]]), 1e-3)
    assert keep.tolist() == [0, 1]
    assert cluster.tolist() == [0, 1, 0]
