"""The standard's shapes on the built-in faces: complete, sealed where they should be, each on its own side."""

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mpeg4.sets import SETS
from facial_retarget_addon.core.parts.kinds import NAMED_KINDS
from facial_retarget_addon.demo import chart
from facial_retarget_addon.demo.acting import Acting
from facial_retarget_addon.demo.cast import ACTOR
from facial_retarget_addon.demo.muscles import contractions
from facial_retarget_addon.demo.shape_sets import POSES

SEALED = (
    *("jawForward", "jawLeft", "jawRight", "mouthPucker", "mouthLeft", "mouthRight", "mouthSmileLeft", "cheekPuff"),
    *("mouthFrownLeft", "mouthDimpleLeft", "mouthStretchLeft", "mouthRollLower", "mouthRollUpper", "mouthShrugLower"),
    *("mouthShrugUpper", "mouthPressLeft", "eyeBlinkLeft", "browInnerUp", "viseme_PP", "anger", "sadness"),
)


@pytest.fixture(scope="module")
def actor():
    return demo.actor(vertices=12_000)


@pytest.fixture(scope="module")
def faces(actor):
    return [actor, *demo.targets(), demo.child(), demo.donor()]


@pytest.fixture(scope="module")
def shapes(faces):
    return {face.name: demo.face_shapes(face) for face in faces}


def gaps(face, lens, positions):
    """(n,) heights of an opening above its lower rim along the upper one, in widths of the opening."""
    rim = np.flatnonzero(np.abs(lens.distance(face.places)) < 1e-9)
    upper, lower = (rim[side * (face.places[rim, 1] - lens.y) >= 0] for side in (1, -1))
    lower = lower[np.argsort(face.places[lower, 0])]
    below = np.interp(face.places[upper, 0], face.places[lower, 0], positions[lower, 1])
    return (positions[upper, 1] - below) / np.ptp(positions[rim, 0])


def closed_mouth(face, shapes):
    """Positions with the jaw open and the lips shut."""
    return shapes["jawOpen"] + shapes["mouthClose"] - face.face.mesh.vertices


def test_sets_have_the_standards_names_and_order(shapes):
    for name in POSES:
        assert [*POSES[name]] == [*SETS[name]]
    assert list(shapes["actor"]) == [shape for name in POSES for shape in POSES[name]]


def test_some_sets_alone_and_a_set_that_is_none(actor, shapes):
    visemes = demo.face_shapes(actor, ["visemes"])
    assert [*visemes] == [*POSES["visemes"]]
    np.testing.assert_allclose(visemes["viseme_aa"], shapes["actor"]["viseme_aa"], atol=1e-6)
    with pytest.raises(RetargetError, match=r"have no set 'faps', expected some of arkit, visemes, expressions"):
        demo.face_shapes(actor, ["arkit", "faps"])


def test_shapes_move_every_face_and_break_none(faces, shapes):
    for face in faces:
        mesh = face.face.mesh
        for name, positions in shapes[face.name].items():
            assert positions.dtype == np.float32
            assert np.isfinite(positions).all(), name
            assert np.abs(positions - mesh.vertices).max() > 0.004 * mesh.size, name
            if name == "mouthClose":
                positions = closed_mouth(face, shapes[face.name])
            a, b, c = (positions[mesh.faces[:, k]].astype(float) for k in range(3))
            turned = np.einsum("fi,fi->f", np.cross(b - a, c - a), mesh.face_vectors) < 0
            assert turned.mean() < 0.0006, (face.name, name)


def test_the_expressions_are_the_examples(actor, shapes):
    for name in POSES["expressions"]:
        np.testing.assert_allclose(shapes["actor"][name], actor.face.examples[name], atol=1e-6)


def test_mouth_close_shuts_the_open_jaw(faces, shapes):
    for face in faces:
        own = shapes[face.name]
        assert gaps(face, chart.MOUTH, own["jawOpen"]).max() > 0.3
        both = closed_mouth(face, own)
        assert gaps(face, chart.MOUTH, both).max() < 0.002
        chin = face.face.points.index(["2.1"])
        dropped = [face.face.points.positions(p.astype(float))[chin, 1] for p in (own["jawOpen"], both)]
        np.testing.assert_allclose(*dropped, atol=0.02 * face.face.mesh.size)


def test_lips_stay_sealed_where_they_should(faces, shapes):
    for face in faces:
        for name in SEALED:
            assert gaps(face, chart.MOUTH, shapes[face.name][name]).max() < 0.008, (face.name, name)


def test_a_blink_shuts_one_eye_all_along(faces, shapes):
    for face in faces:
        neutral = face.face.mesh.vertices
        for side, lens, other in (
            ("Left", chart.LEFT_EYE, chart.RIGHT_EYE),
            ("Right", chart.RIGHT_EYE, chart.LEFT_EYE),
        ):
            blink = shapes[face.name][f"eyeBlink{side}"]
            assert np.abs(gaps(face, lens, blink)).max() < 1e-3
            np.testing.assert_allclose(gaps(face, other, blink), gaps(face, other, neutral), atol=1e-6)


def test_lids_follow_the_gaze(actor, shapes):
    own, lens = shapes["actor"], chart.LEFT_EYE
    opening = {name: gaps(actor, lens, positions).max() for name, positions in own.items()}
    neutral = gaps(actor, lens, actor.face.mesh.vertices).max()
    assert opening["eyeLookDownLeft"] < 0.8 * neutral
    assert opening["eyeSquintLeft"] < 0.6 * neutral
    assert opening["eyeWideLeft"] > 1.2 * neutral
    # The ball turns as one about its centre.
    gaze = actor.moving[0]
    for name, way in (("eyeLookUpLeft", (0, 1)), ("eyeLookOutLeft", (1, 0)), ("eyeLookInLeft", (-1, 0))):
        before, after = (positions[gaze.rows].astype(float) for positions in (actor.face.mesh.vertices, own[name]))
        centre = ACTOR.eye_centre(1.0)
        np.testing.assert_allclose(*(np.linalg.norm(p - centre, axis=1) for p in (before, after)), atol=1e-5)
        pupil = before[:, 2].argmax()
        assert (after - before)[pupil, :2] @ way > 0.1


def test_one_sided_shapes_leave_the_other_side_alone(faces, shapes):
    for face in faces:
        right = np.flatnonzero(face.places[:, 0] < -0.3)
        for name, positions in shapes[face.name].items():
            moved = np.linalg.norm(positions - face.face.mesh.vertices, axis=1)
            if name.endswith("Left") and name not in ("jawLeft", "mouthLeft"):
                assert moved[right].max() < 0.05 * moved.max(), name


def test_left_and_right_are_mirror_images():
    half = np.random.default_rng(0).uniform(chart.LOW, chart.HIGH, (4000, 2))
    places = np.concatenate([half, half * [-1, 1]])
    acting = Acting(ACTOR, places, {})
    poses = {name: pose for chosen in POSES.values() for name, pose in chosen.items()}
    moved = dict(zip(poses, acting.displacements(contractions(*poses.values())), strict=True))
    for name, motion in moved.items():
        other = name.replace("Left", "*").replace("Right", "Left").replace("*", "Right")
        mirrored = np.roll(moved[other], len(half), axis=0) * np.float32([-1, 1, 1])
        np.testing.assert_allclose(motion, mirrored, atol=2e-5, err_msg=name)


def test_the_donor_has_a_tongue_and_lower_teeth(faces, shapes):
    donor = faces[-1]
    assert set(donor.face.named_parts) == set(NAMED_KINDS) - {"lashes", "brows", "moustache", "beard", "gums"}
    neutral, own = donor.face.mesh.vertices, shapes["donor"]
    first, last = donor.places.shape[0], len(neutral)
    for name, positions in own.items():
        still = np.setdiff1d(np.arange(first, last), np.concatenate([part.rows for part in donor.moving]))
        np.testing.assert_allclose(positions[still], neutral[still], atol=1e-6, err_msg=name)
    teeth, tongue = (part.rows for part in donor.moving[2:])
    assert (own["jawOpen"] - neutral)[teeth, 1].max() < -0.1
    lips = donor.face.points.positions(own["tongueOut"].astype(float))[donor.face.points.index(["2.3"])]
    assert own["tongueOut"][tongue, 2].max() > lips[0, 2] + 0.15
    assert own["jawOpen"][tongue, 2].max() < lips[0, 2]
