"""Gains of regions and masks: where they act, and what they leave as it is."""

from dataclasses import replace

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.face_regions import REGIONS, region_weights
from facial_retarget_addon.core.gains import Gains, Mask
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.methods import METHODS
from facial_retarget_addon.core.methods.settings import LEVELED, SETTINGS, RegionGains
from facial_retarget_addon.core.mpeg4.fdps import FDPS
from facial_retarget_addon.core.parts.kinds import EYEBALL, UPPER
from facial_retarget_addon.core.parts.known_head import know_head
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.core.retarget import level_motions, retarget
from facial_retarget_addon.core.seams.lids import find_eye_margins

INSIDE = {
    "brows": ("4.1", "4.3", "4.4"),
    "eyes": ("3.1", "3.3", "3.2", "3.4", "3.7"),
    "nose": ("9.3", "9.1", "9.15"),
    "cheeks": ("5.1", "5.2", "5.3"),
    "mouth": ("8.1", "8.2", "8.3", "8.4", "2.2", "2.3"),
    "jaw": ("2.1", "2.10"),
}
"""Region -> points that lie in the midst of it."""


@pytest.fixture(scope="module")
def actor() -> demo.DemoFace:
    return demo.actor(9_000)


@pytest.fixture(scope="module")
def problem(actor: demo.DemoFace) -> Problem:
    target = demo.warped_actor(np.random.default_rng(1), 8_000)
    return Problem(*(Face(face.face.mesh, face.face.points) for face in (actor, target)))


@pytest.fixture(scope="module")
def acting(actor: demo.DemoFace) -> np.ndarray:
    return actor.frames(demo.performance_table()[20::40]).astype(np.float32)


def test_weights_are_shares_of_one_whole(actor: demo.DemoFace) -> None:
    for face in (actor.face, demo.targets()[0].face):
        weights = region_weights(face)
        assert weights.shape == (len(face.mesh.vertices), len(REGIONS))
        assert weights.min() >= 0
        assert weights.sum(axis=1).max() <= 1 + 1e-12
        # The back of the head belongs to no region.
        assert weights.sum(axis=1).min() == 0


def test_each_region_has_its_own_points(actor: demo.DemoFace) -> None:
    for face in (actor.face, *(target.face for target in demo.targets())):
        weights = region_weights(face)
        for region, names in INSIDE.items():
            for name in names:
                if name in face.points.names:
                    at_point = face.points.subset([name]).matrix(len(weights)) @ weights
                    assert at_point[0].argmax() == REGIONS.index(region), (name, region, at_point)


def test_both_lips_and_both_lids_have_one_weight(actor: demo.DemoFace) -> None:
    """Else a gain would part lips that are closed, or leave a gap between lids that shut."""
    for face in (actor.face, demo.warped_actor(np.random.default_rng(1), 8_000).face):
        weights = region_weights(face)
        lips = face.points.subset(["2.2", "2.3", "2.4", "2.5", "2.6", "2.7", "2.8", "2.9"])
        np.testing.assert_allclose(lips.matrix(len(weights)) @ weights, np.eye(6)[[4] * 8], atol=1e-9)
        for margins in find_eye_margins(face.mesh, face.points).values():
            for guides in (margins.above, margins.below):
                at_lids = guides.own @ weights
                np.testing.assert_allclose(at_lids[:, REGIONS.index("eyes")], 1.0, atol=0.02)


def test_left_and_right_are_alike(actor: demo.DemoFace) -> None:
    face = actor.face
    mirrored = face.mesh.vertices * [-1, 1, 1]
    mesh = TriMesh(mirrored, face.mesh.faces[:, ::-1].copy(), face.mesh.polygons)
    partner = {name: partner_of(name) for name in face.points.names}
    names = tuple(partner[name] for name in face.points.names)
    points = FeaturePoints(names, face.points.vertices, face.points.weights)
    np.testing.assert_allclose(region_weights(Face(mesh, points)), region_weights(face), atol=1e-9)


def partner_of(name: str) -> str:
    """The point of the other half of the face."""
    return FDPS[name].partner if name in FDPS else f"{name} mirrored"


def test_stiff_parts_have_one_weight(actor: demo.DemoFace) -> None:
    teeth = know_head(actor.face).vertices((UPPER,))
    assert len(teeth)
    for name, wanted in (("upper teeth", np.zeros(6)), ("lower teeth", np.eye(6)[REGIONS.index("jaw")])):
        head = know_head(replace(actor.face, named_parts={name: teeth}))
        weights = region_weights(replace(actor.face, named_parts={name: teeth}))
        assert not weights[head.vertices((EYEBALL,))].any()
        assert np.array_equal(weights[teeth], np.tile(wanted, (len(teeth), 1)))


@pytest.mark.parametrize("method", METHODS)
def test_gains_scale_the_motion_where_they_act(method: str, problem: Problem, acting: np.ndarray) -> None:
    settings, rest = SETTINGS[method](), problem.target.mesh.vertices
    plain = retarget(method, problem, settings, acting).frames
    same = retarget(method, replace(problem, gains=Gains()), settings, acting)
    assert np.array_equal(same.frames, plain)
    assert "gains" not in same.report
    rng = np.random.default_rng(2)
    mask = np.where(rng.random(len(rest)) < 0.5, rng.random(len(rest)), 0.0)
    gains = Gains(RegionGains(brows=0.0, mouth=1.5), {"scar": Mask(mask, 0.25)})
    found = retarget(method, replace(problem, gains=gains), settings, acting)
    weights = region_weights(problem.target)
    strength = (1 - weights[:, 0] + 0.5 * weights[:, 4]) * (1 - 0.75 * mask)
    wanted = rest + strength[:, None] * (plain - rest)
    np.testing.assert_allclose(found.frames, wanted, atol=1e-5 * problem.target.mesh.size)
    still = strength == 1.0
    assert still.any()
    assert np.array_equal(found.frames[:, still], plain[:, still])
    assert found.report["gains"]["masks"] == {"scar": 0.25}
    assert found.report["gains"]["mouth"] == 1.5
    if method in LEVELED:
        levels = level_motions(method, replace(problem, gains=gains), settings, acting[0])
        together = sum(level.displacements[0] for level in levels)
        np.testing.assert_allclose(rest + together, found.frames[0], atol=1e-5 * problem.target.mesh.size)


def test_a_mask_of_another_mesh_is_refused(problem: Problem, acting: np.ndarray) -> None:
    wrong = replace(problem, gains=Gains(masks={"scar": Mask(np.ones(7), 0.5)}))
    with pytest.raises(RetargetError, match=r"mask 'scar' has weights of shape \(7,\)"):
        retarget("feature_points", wrong, SETTINGS["feature_points"](), acting)


def test_regions_need_points_that_tell_them(problem: Problem) -> None:
    nameless = FeaturePoints(("a", "b"), problem.target.points.vertices[:2], problem.target.points.weights[:2])
    with pytest.raises(RetargetError, match="expected these points"):
        region_weights(replace(problem.target, points=nameless))
