"""Methods compared: figures of the same frames as the report's, and a fit to go on with."""

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.comparison import compare_method
from facial_retarget_addon.core.gains import Gains, Mask
from facial_retarget_addon.core.methods.settings import SETTINGS
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.core.retarget import retarget
from facial_retarget_addon.core.seams.gaps import SeamGaps


@pytest.mark.parametrize("method", ["feature_points", "motion_cloning"])
def test_figures_are_those_of_the_report(method: str) -> None:
    actor, target = demo.actor(8_000), demo.warped_actor(np.random.default_rng(1), 8_000)
    frames = actor.frames(demo.performance_table()[10:90:16]).astype(np.float32)
    mask = np.ones(len(target.face.mesh.vertices))
    gains = Gains(masks={"all": Mask(mask, 1.3)})
    problem = Problem(*(Face(face.face.mesh, face.face.points) for face in (actor, target)), gains=gains)
    settings = SETTINGS[method]()
    retargeter, figures = compare_method(method, problem, settings, frames, SeamGaps(problem))
    result = retarget(method, problem, settings, frames)
    found = result.per_frame
    assert figures.torn_edges == np.mean(found["torn_edges"])
    assert figures.turned_triangles == np.mean(found["flipped_triangles"])
    for name, figure in (("lip_gap_percent", figures.lip_gap), ("lid_gap_percent", figures.lid_gap)):
        wanted = np.abs(np.subtract(found[name], found[f"source_{name}"])).mean()
        assert figure == pytest.approx(wanted, abs=1e-3)
    assert figures.fit_seconds > figures.frame_seconds > 0
    rest = target.face.mesh.vertices
    moved = rest + 1.3 * (retargeter.frames(frames) - rest)
    np.testing.assert_allclose(moved, result.frames, atol=1e-5 * target.face.mesh.size)


def test_faces_without_lids_and_lips_have_no_gaps() -> None:
    actor = demo.actor(8_000)
    names = [name for name in actor.face.points.names if name.split(".")[0] not in ("2", "3", "8")]
    face = Face(actor.face.mesh, actor.face.points.subset(names))
    frames = actor.frames(demo.performance_table()[40:41]).astype(np.float32)
    problem = Problem(face, face)
    _, figures = compare_method("motion_cloning", problem, SETTINGS["motion_cloning"](), frames, SeamGaps(problem))
    assert figures.lip_gap is None
    assert figures.lid_gap is None
