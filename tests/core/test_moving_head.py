"""FAPs of a face whose head moves: acting and head come apart."""

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.acting.fap_face import FapFace, fit_fap_face
from facial_retarget_addon.core.acting.moving_head import measure_moving_head
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mpeg4.fdps import FDPS
from facial_retarget_addon.core.mpeg4.head_turn import rotation_of_angles


@pytest.fixture(scope="module")
def face() -> FapFace:
    actor = demo.actor(vertices=6000)
    return fit_fap_face(actor.face.mesh, actor.face.points)


def test_acting_and_head_come_apart(face):
    rng = np.random.default_rng(3)
    values = np.where(face.measurable, rng.integers(-80, 80, (6, 68)), 0)
    values[0] = 0
    turns = rng.integers(-40_000, 40_000, (6, 3))
    still = face.frames(values).astype(np.float64)
    moved = np.einsum("fij,fvj->fvi", rotation_of_angles(turns, face.axes), still) + rng.normal(size=(6, 1, 3))
    found, motion = measure_moving_head(face, moved)
    np.testing.assert_allclose(found[:, face.measurable], values[:, face.measurable], atol=0.05)
    np.testing.assert_allclose(found[:, 47:50], turns, atol=1)
    assert motion.residual.max() < 1e-5
    assert np.abs(face.measure(moved) - values).max() > 100  # which is why the head is taken out


def test_a_face_without_points_that_hold_still(face):
    acting = [name for name in face.known.names if not FDPS[name].anchored]
    bare = fit_fap_face(face.mesh, face.points.subset(acting))
    with pytest.raises(RetargetError, match="needs 3 points that no FAP moves"):
        measure_moving_head(bare, face.mesh.vertices[None])
