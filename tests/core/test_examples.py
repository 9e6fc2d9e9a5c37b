"""Example weights: 1 at their own example, 0 at rest, never wild; residuals meet the artist's examples."""

import numpy as np
import pytest
from scipy.optimize import nnls

from facial_retarget_addon import demo
from facial_retarget_addon.core.base.regions import eye_separation
from facial_retarget_addon.core.matching.correspondence import correspond
from facial_retarget_addon.core.steering.base_places import REACH, WANTED, denser_base
from facial_retarget_addon.core.steering.examples import fit_example_weights, non_negative_least_squares
from facial_retarget_addon.core.steering.learned import SteeringBase
from facial_retarget_addon.core.steering.residuals import ExamplePairs, ExampleRegions, spread_matrix


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(3)


@pytest.fixture
def base(rng: np.random.Generator) -> np.ndarray:
    return rng.uniform(-1, 1, size=(40, 3))


@pytest.fixture
def moves(rng: np.random.Generator) -> np.ndarray:
    return rng.normal(size=(6, 40, 3))


def test_an_example_is_recognised_everywhere(base: np.ndarray, moves: np.ndarray) -> None:
    weights = fit_example_weights(base, moves, 1.0)
    for m, motion in enumerate(moves):
        found = weights(motion[None])[0]
        assert np.abs(found[:, m] - 1).max() < 0.1
        assert np.abs(np.delete(found, m, axis=1)).max() < 0.1


def test_no_motion_gives_exactly_no_weight(base: np.ndarray, moves: np.ndarray) -> None:
    assert not fit_example_weights(base, moves, 1.0)(np.zeros((2, 40, 3))).any()


def test_weights_do_not_depend_on_the_unit(base: np.ndarray, moves: np.ndarray, rng: np.random.Generator) -> None:
    motion = rng.normal(size=(3, 40, 3))
    small = fit_example_weights(base, moves, 1.0)(motion)
    large = fit_example_weights(250 * base, 250 * moves, 250.0)(250 * motion)
    np.testing.assert_allclose(large, small, atol=1e-7)


def test_a_region_that_no_example_moves_gets_no_weight(base: np.ndarray, moves: np.ndarray) -> None:
    moves = np.where(base[None, :, :1] > 0, moves, 0.0)
    far = np.array([[-50.0, 0, 0]])
    still = np.concatenate([moves, np.zeros((6, 1, 3))], axis=1)
    weights = fit_example_weights(np.concatenate([base, far]), still, 1.0)
    assert not weights(np.ones((1, 41, 3)))[0, -1].any()


def test_non_negative_fit_agrees_with_scipy(rng: np.random.Generator) -> None:
    vectors = rng.normal(size=(5, 12, 4))
    wanted = rng.normal(size=(3, 5, 12))
    gram = np.einsum("bkm,bkn->bmn", vectors, vectors)
    match = np.einsum("bkm,fbk->fbm", vectors, wanted)
    found = non_negative_least_squares(gram, match)
    for f in range(3):
        for b in range(5):
            np.testing.assert_allclose(found[f, b], nnls(vectors[b], wanted[f, b])[0], atol=1e-4)


def test_spread_adds_up_to_one_and_is_nearly_exact_at_base_vertices(base: np.ndarray) -> None:
    spread = spread_matrix(base, base, 0.02)
    np.testing.assert_allclose(np.asarray(spread.sum(axis=1)).ravel(), 1)
    np.testing.assert_allclose(spread.diagonal(), 1, atol=1e-3)


class TestResiduals:
    """Half of the carried motion is what this artist made of every example."""

    @pytest.fixture
    def target(self, rng: np.random.Generator) -> np.ndarray:
        return rng.uniform(-1, 1, size=(500, 3))

    def fit(self, base: np.ndarray, moves: np.ndarray, target: np.ndarray, wanted: float, trust: float = 1.0):
        carried = spread_matrix(target, base, 0.12) @ moves.transpose(1, 0, 2).reshape(40, -1)
        carried = carried.reshape(500, 6, 3).transpose(1, 0, 2)
        pairs = ExamplePairs(moves, carried, wanted * carried)
        areas = np.ones(500)
        return carried, ExampleRegions(base, 1.0, base, target, areas, 1.0).fit(pairs, trust)

    def test_the_examples_are_met(self, base: np.ndarray, moves: np.ndarray, target: np.ndarray) -> None:
        carried, residuals = self.fit(base, moves, target, 0.5)
        met = residuals.steer(carried.astype(np.float32), moves)
        assert np.linalg.norm(met - 0.5 * carried) < 0.1 * np.linalg.norm(0.5 * carried)

    def test_the_artists_strength_is_learned(self, base: np.ndarray, moves: np.ndarray, target: np.ndarray) -> None:
        assert np.median(self.fit(base, moves, target, 0.5)[1].strength) == pytest.approx(0.5, abs=0.05)

    def test_examples_that_agree_with_the_carry_change_nothing(
        self, base: np.ndarray, moves: np.ndarray, target: np.ndarray, rng: np.random.Generator
    ) -> None:
        _, residuals = self.fit(base, moves, target, 1.0)
        motion = rng.normal(size=(2, 500, 3)).astype(np.float32)
        np.testing.assert_allclose(residuals.steer(motion, rng.normal(size=(2, 40, 3))), motion, atol=1e-5)

    def test_without_trust_the_carry_stays(
        self, base: np.ndarray, moves: np.ndarray, target: np.ndarray, rng: np.random.Generator
    ) -> None:
        _, residuals = self.fit(base, moves, target, 0.5, trust=0.0)
        motion = rng.normal(size=(2, 500, 3)).astype(np.float32)
        np.testing.assert_allclose(residuals.steer(motion, moves[:2]), motion, atol=1e-5)


def test_a_denser_base_has_places_between_the_points_that_belong_together() -> None:
    source = demo.actor(vertices=4_000).face
    target = demo.warped_actor(np.random.default_rng(3), vertices=3_000)
    names = [name for name in source.points.names if name in target.face.points.names][:50]
    points = source.points.subset(names), target.face.points.subset(names)
    separations = eye_separation(source.mesh, source.points), eye_separation(target.face.mesh, target.face.points)
    base = SteeringBase(source.mesh, target.face.mesh, *points, *separations)
    denser = denser_base(base, correspond(source.mesh, points[0], target.face.mesh, points[1]))
    assert len(denser.source_points) == len(denser.target_points) == WANTED
    assert denser.source_points.names[: len(names)] == tuple(names)
    there = denser.target_points.positions(target.face.mesh.vertices)[len(names) :]
    known = points[1].positions(target.face.mesh.vertices)
    gaps = np.linalg.norm(there[:, None] - known, axis=2).min(axis=1)
    assert gaps.min() > 0
    assert gaps.max() < REACH * separations[1]
    # The warped actor is the actor through a known warp: its vertices know their places on him.
    here = denser.source_points.positions(source.mesh.vertices)[len(names) :]
    assert np.median(np.linalg.norm(target.warp(here) - there, axis=1)) < 0.05 * separations[1]


def test_where_examples_hardly_move_weights_stay_small(base: np.ndarray) -> None:
    """A frame that moves a region which no example does must not be many times an example there."""
    shown = np.zeros((1, len(base), 3))
    shown[0, :, 0] = np.exp(-8 * np.square(base - base[0]).sum(axis=1))
    frame = np.zeros((1, len(base), 3))
    far = np.linalg.norm(base - base[0], axis=1) > 1.2
    frame[0, far, 0] = 1.0
    weights = fit_example_weights(base, shown, 0.8).non_negative(frame)
    assert weights.max() < 3
