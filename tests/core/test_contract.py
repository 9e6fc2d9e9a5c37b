"""The contract that every method keeps: what goes in, what comes out, and what must not matter."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.arrays import no_progress
from facial_retarget_addon.core.errors import Cancelled, RetargetError
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.methods import METHODS
from facial_retarget_addon.core.methods.base import Retargeter, fit
from facial_retarget_addon.core.methods.settings import SETTINGS, Settings, without_strengths
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.core.retarget import retarget

RESOLUTION = {"hierarchical": 0.03, "wavelet": 0.03, "feature_points": 0.35, "motion_cloning": 0.001}
"""Method -> relative error of a face onto itself that it states as its own; points do not carry what lies between."""

QUICK: dict[str, dict[str, object]] = {
    "hierarchical": {"levels": 2},
    "wavelet": {"levels": 2},
    "feature_points": {},
    "motion_cloning": {},
}
"""Method -> settings that are quick to fit."""

STEERED = ("hierarchical", "wavelet", "motion_cloning")
"""Methods that examples steer; the others say that they do not use them."""

VARIANTS = [
    ("hierarchical", {"levels": 3}),
    ("hierarchical", {"levels": 2, "base_gain": 0.8, "level_gains": (0.5,), "detail_scale": 0.3}),
    ("hierarchical", {"levels": 2, "frames": "global", "read": "pierce"}),
    ("hierarchical", {"levels": 2, "variant": "paper"}),
    ("wavelet", {"levels": 3}),
    ("wavelet", {"levels": 2, "base_gain": 0.8, "level_gains": (0.5,), "detail_scale": 0.3, "source_mesh": "pierced"}),
    ("wavelet", {"levels": 2, "mode": "scaled", "lifting": "integral"}),
    ("wavelet", {"levels": 2, "mode": "paper", "disc": 0}),
    ("feature_points", {}),
    ("feature_points", {"variant": "paper"}),
    ("feature_points", {"motion": "faps"}),
    ("motion_cloning", {}),
    ("motion_cloning", {"motion": "compliant"}),
    ("motion_cloning", {"variant": "paper"}),
    ("motion_cloning", {"variant": "paper", "motion": "compliant"}),
]


def settings_of(method: str, values: dict[str, object]) -> Settings:
    return SETTINGS[method](**values)


@pytest.fixture(scope="module")
def actor() -> demo.DemoFace:
    return demo.actor(vertices=7_000)


@pytest.fixture(scope="module")
def target() -> demo.DemoFace:
    return demo.warped_actor(np.random.default_rng(3), vertices=5_000)


@pytest.fixture(scope="module")
def problem(actor: demo.DemoFace, target: demo.DemoFace) -> Problem:
    return Problem(actor.face, target.face)


@pytest.fixture(scope="module")
def frames(actor: demo.DemoFace) -> np.ndarray:
    return actor.frames(demo.performance_table()[10:90:10])


@pytest.fixture(scope="module", params=range(len(VARIANTS)), ids=lambda k: f"{VARIANTS[k][0]} {VARIANTS[k][1]}")
def variant(request: pytest.FixtureRequest) -> tuple[str, Settings]:
    method, values = VARIANTS[request.param]
    return method, settings_of(method, values)


@pytest.fixture(scope="module")
def fitted(variant: tuple[str, Settings], problem: Problem) -> Retargeter:
    return fit(variant[0], problem, variant[1])


@pytest.fixture(scope="module")
def result(fitted: Retargeter, frames: np.ndarray) -> np.ndarray:
    return fitted.frames(frames)


def close(found: np.ndarray, wanted: np.ndarray, size: float, tolerance: float = 1e-4) -> None:
    assert np.abs(found - wanted).max() <= tolerance * size


def test_every_method_is_under_contract() -> None:
    assert set(METHODS) == set(SETTINGS) == set(RESOLUTION) == {method for method, _ in VARIANTS}


def test_shapes_types_and_finiteness(result: np.ndarray, frames: np.ndarray, problem: Problem) -> None:
    assert result.shape == (len(frames), *problem.target.mesh.vertices.shape)
    assert result.dtype == np.float32
    assert np.isfinite(result).all()


def test_adjusted_strengths_are_those_of_a_new_fit(
    variant: tuple[str, Settings], fitted: Retargeter, problem: Problem, frames: np.ndarray
) -> None:
    method, settings = variant
    others = {"base_gain": 0.8, "level_gains": (0.5, 2.0), "detail_scale": 0.3, "example_strength": 0.6}
    changed = replace(settings, **{name: value for name, value in others.items() if hasattr(settings, name)})
    assert without_strengths(changed) == without_strengths(settings)
    found, wanted = fitted.adjusted(changed), fit(method, problem, changed)
    close(found.frames(frames), wanted.frames(frames), problem.target.mesh.size, 1e-6)
    for ours, theirs in zip(found.report["examples"], wanted.report["examples"], strict=True):
        assert ours == pytest.approx(theirs, abs=1e-5)
    if changed == settings:
        assert np.array_equal(found.frames(frames), fitted.frames(frames))


def test_neutral_in_neutral_out(fitted: Retargeter, problem: Problem) -> None:
    rest = problem.source.mesh.vertices.astype(np.float32)
    found = fitted.frames(np.stack([rest, rest]))
    wanted = problem.target.mesh.vertices.astype(np.float32)
    close(found, wanted, problem.target.mesh.size, 1e-6)


def test_the_target_acts_as_much_as_the_source(result: np.ndarray, frames: np.ndarray, problem: Problem) -> None:
    ours = np.linalg.norm(frames - problem.source.mesh.vertices, axis=2).max(axis=1) / problem.source.mesh.size
    theirs = np.linalg.norm(result - problem.target.mesh.vertices, axis=2).max(axis=1) / problem.target.mesh.size
    assert ours.max() > 0.05
    assert (theirs >= 0.4 * ours).all()
    assert (theirs <= 2.0 * ours).all()


def test_the_fine_mesh_moves_as_well(fitted: Retargeter, frames: np.ndarray, problem: Problem) -> None:
    positions, faces = fitted.detail(frames[:2])
    assert positions.shape[0] == 2
    assert faces.max() == positions.shape[1] - 1
    assert np.isfinite(positions).all()
    assert np.abs(positions[1] - positions[0]).max() > 1e-3 * problem.target.mesh.size


def test_the_same_twice(
    variant: tuple[str, Settings], problem: Problem, frames: np.ndarray, result: np.ndarray
) -> None:
    again = fit(variant[0], problem, variant[1]).frames(frames)
    np.testing.assert_array_equal(again, result)


def test_a_block_has_the_same_bits_whatever_came_before(fitted: Retargeter, frames: np.ndarray) -> None:
    """What lets a run that was stopped go on: see `core.retarget.KeptBlocks`."""
    fitted.frames(frames[:3])
    after = fitted.frames(frames[3:6])
    fitted.frames(frames[6:])
    np.testing.assert_array_equal(fitted.frames(frames[3:6]), after)


def test_blocks_do_not_matter(fitted: Retargeter, frames: np.ndarray, result: np.ndarray, problem: Problem) -> None:
    singly = np.concatenate([fitted.frames(frame[None]) for frame in frames])
    close(singly, result, problem.target.mesh.size, 1e-5)


def moved_face(face: Face, scale: float, rotation: np.ndarray, shift: np.ndarray) -> Face:
    def move(positions: np.ndarray) -> np.ndarray:
        return scale * positions @ rotation.T + shift

    mesh = face.mesh
    return Face(
        TriMesh(move(mesh.vertices), mesh.faces, mesh.polygons),
        face.points,
        {name: move(positions) for name, positions in face.examples.items()},
    )


ROTATION = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
SHIFT = np.array([3.0, -20.0, 7.0])


@pytest.fixture(scope="module")
def plain(problem: Problem) -> Problem:
    """Without examples: one fit is then all that a placement can change."""
    return replace(problem, source=replace(problem.source, examples={}), target=replace(problem.target, examples={}))


@pytest.mark.parametrize("method", METHODS)
def test_place_size_and_turn_of_the_source_do_not_matter(method: str, plain: Problem, frames: np.ndarray) -> None:
    settings = settings_of(method, QUICK[method])
    wanted = fit(method, plain, settings).frames(frames)
    turned = replace(plain, source=moved_face(plain.source, 40.0, ROTATION, SHIFT))
    found = fit(method, turned, settings).frames(40.0 * frames @ ROTATION.T + SHIFT)
    close(found, wanted, plain.target.mesh.size, 2e-3)


@pytest.mark.parametrize("method", METHODS)
def test_place_size_and_turn_of_the_target_do_not_matter(method: str, plain: Problem, frames: np.ndarray) -> None:
    settings = settings_of(method, QUICK[method])
    wanted = fit(method, plain, settings).frames(frames)
    turned = replace(plain, target=moved_face(plain.target, 0.02, ROTATION, SHIFT))
    found = fit(method, turned, settings).frames(frames)
    close(found, 0.02 * wanted @ ROTATION.T + SHIFT, 0.02 * plain.target.mesh.size, 2e-3)


def shuffled(face: Face, order: np.ndarray) -> Face:
    rank = np.argsort(order)
    points = face.points
    mesh = TriMesh(face.mesh.vertices[order], rank[face.mesh.faces], face.mesh.polygons)
    return Face(mesh, FeaturePoints(points.names, rank[points.vertices], points.weights), {})


@pytest.mark.parametrize("method", METHODS)
def test_the_order_of_vertices_does_not_matter(method: str, plain: Problem, frames: np.ndarray) -> None:
    rng = np.random.default_rng(11)
    settings = settings_of(method, QUICK[method])
    wanted = fit(method, plain, settings).frames(frames)
    ours = rng.permutation(len(plain.source.mesh.vertices))
    theirs = rng.permutation(len(plain.target.mesh.vertices))
    mixed = Problem(shuffled(plain.source, ours), shuffled(plain.target, theirs))
    found = fit(method, mixed, settings).frames(frames[:, ours])
    close(found, wanted[:, theirs], plain.target.mesh.size, 2e-3)


@pytest.mark.parametrize("method", METHODS)
def test_a_face_onto_itself_is_itself(method: str, plain: Problem, frames: np.ndarray) -> None:
    itself = replace(plain, target=plain.source)
    found = fit(method, itself, settings_of(method, QUICK[method])).frames(frames)
    rest = plain.source.mesh.vertices
    error = np.linalg.norm(found - frames) / np.linalg.norm(frames - rest)
    assert error <= RESOLUTION[method]


@pytest.mark.parametrize("method", STEERED)
def test_examples_are_met(method: str, problem: Problem, actor: demo.DemoFace) -> None:
    fitted = fit(method, problem, settings_of(method, QUICK[method]))
    for example in fitted.report["examples"]:
        assert example["fit"] < 0.3
    source = actor.face.examples["joy"].astype(np.float32)[None]
    wanted = problem.target.examples["joy"]
    rest = problem.target.mesh.vertices
    assert np.linalg.norm(fitted.frames(source)[0] - wanted) < 0.3 * np.linalg.norm(wanted - rest)


@pytest.mark.parametrize("method", sorted(set(METHODS) - set(STEERED)))
def test_examples_that_are_not_used_are_named(method: str, problem: Problem) -> None:
    fitted = fit(method, problem, settings_of(method, QUICK[method]))
    assert fitted.report["examples"] == []
    assert "examples are not used by this method" in fitted.report["warnings"]


@pytest.mark.parametrize("method", METHODS)
def test_what_stays_put_is_named_and_what_rests_rests(method: str, problem: Problem, frames: np.ndarray) -> None:
    run = retarget(method, problem, settings_of(method, QUICK[method]), frames)
    still = run.report["still_components"]
    warned = [warning for warning in run.report["warnings"] if "stay put" in warning]
    assert "behind the mouth" in warned[0]
    mesh = problem.target.mesh
    moved = np.abs(run.frames - mesh.vertices.astype(np.float32)).max(axis=(0, 2))
    stays = np.isin(mesh.components, [mesh.components[part["first_vertex"]] for part in still])
    assert stays.sum() == sum(part["vertices"] for part in still)
    assert (moved[stays] == 0).all()
    does = {row["kind"]: row["does"] for row in run.report["parts"]}
    assert set(does) == {"eyeball", "upper part of the mouth", "behind the mouth"}
    assert does["behind the mouth"] == "stays"
    # Eyeballs and upper teeth move as the source's do, which do not.
    assert (moved[mesh.components > 0] == 0).all()


@pytest.mark.parametrize("method", METHODS)
def test_stopping_is_heard(method: str, plain: Problem, frames: np.ndarray) -> None:
    def stop_at(limit: float) -> Iterator[float]:
        def progress(share: float, what: str) -> None:
            assert what
            if share >= limit:
                raise Cancelled

        with pytest.raises(Cancelled):
            retarget(method, plain, settings_of(method, QUICK[method]), frames, progress)
        yield limit

    assert [limit for at in (0.0, 0.2, 0.6) for limit in stop_at(at)] == [0.0, 0.2, 0.6]


@pytest.mark.parametrize("method", METHODS)
def test_frames_of_another_vertex_count_are_refused(method: str, plain: Problem, frames: np.ndarray) -> None:
    with pytest.raises(RetargetError, match=rf"{frames.shape[1] - 1}.*expected \(F, {frames.shape[1]}, 3\)"):
        retarget(method, plain, settings_of(method, QUICK[method]), frames[:, 1:], no_progress)


def test_unknown_methods_are_named(plain: Problem) -> None:
    with pytest.raises(RetargetError, match=r"'magic' is unknown, expected one of hierarchical, feature_points"):
        fit("magic", plain, SETTINGS["hierarchical"]())
