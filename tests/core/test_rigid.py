"""Rigid motions and similarities."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.rigid import fit_rigid, fit_similarity

SEEDS = st.integers(0, 10_000)


def random_rotation(rng: np.random.Generator) -> np.ndarray:
    q = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    return q * np.sign(np.linalg.det(q))


@given(SEEDS, st.integers(3, 40), st.floats(1e-3, 1e3))
def test_a_similarity_is_found_again(seed: int, count: int, scale: float) -> None:
    rng = np.random.default_rng(seed)
    points, rotation, translation = rng.normal(size=(count, 3)), random_rotation(rng), rng.normal(size=3)
    found = fit_similarity(points, scale * points @ rotation.T + translation)
    assert found.scale == pytest.approx(scale, rel=1e-6)
    np.testing.assert_allclose(found.rotation, rotation, atol=1e-5)
    np.testing.assert_allclose(
        found.apply(points), scale * points @ rotation.T + translation, atol=1e-6 * max(scale, 1)
    )


@given(SEEDS)
def test_the_inverse_leads_back(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(9, 3))
    found = fit_similarity(points, 3 * points @ random_rotation(rng).T + 1)
    np.testing.assert_allclose(found.inverse.apply(found.apply(points)), points, atol=1e-9)


def test_a_mirror_image_gives_a_rotation() -> None:
    points = np.random.default_rng(1).normal(size=(12, 3))
    assert np.linalg.det(fit_similarity(points, points * [-1, 1, 1]).rotation) == pytest.approx(1)


def test_a_head_motion_keeps_its_size() -> None:
    points = np.random.default_rng(2).normal(size=(12, 3))
    found = fit_rigid(points, 2 * points)
    assert found.scale == 1
    np.testing.assert_allclose(found.rotation, np.eye(3), atol=1e-12)


def test_displacements_are_turned_and_not_moved() -> None:
    rng = np.random.default_rng(3)
    points, motion = rng.normal(size=(7, 3)), rng.normal(size=(2, 7, 3))
    found = fit_similarity(points, 0.5 * points @ random_rotation(rng).T + 4)
    np.testing.assert_allclose(found.turn(motion), found.apply(points + motion) - found.apply(points), atol=1e-12)


@pytest.mark.parametrize(
    ("source", "target", "message"),
    [
        (np.eye(3)[:2], np.eye(3)[:2], "at least 3"),
        (np.eye(3), np.eye(3)[:2], "shape"),
        (np.outer(np.arange(5.0), [1, 2, 3]), np.random.default_rng(0).normal(size=(5, 3)), "source positions lie"),
        (np.random.default_rng(0).normal(size=(5, 3)), np.ones((5, 3)), "target positions lie"),
        (np.full((4, 3), np.nan), np.eye(4)[:, :3], "NaN"),
    ],
)
def test_bad_positions_are_refused(source: np.ndarray, target: np.ndarray, message: str) -> None:
    with pytest.raises(RetargetError, match=message):
        fit_similarity(source, target)
