"""The standard's shapes on a face that has nothing but feature points."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from facial_retarget_addon import demo
from facial_retarget_addon.core.acting.expression_sets import expression_shapes, still_shapes
from facial_retarget_addon.core.acting.fap_face import FapFace, fit_fap_face
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mpeg4.recipes import mirrored
from facial_retarget_addon.core.mpeg4.sets import SETS

ALL = tuple(SETS)
SYMMETRIC = [name for shapes in SETS.values() for name, recipe in shapes.items() if recipe == mirrored(recipe)]


@pytest.fixture(scope="module")
def face() -> FapFace:
    actor = demo.actor(vertices=6000).face
    return fit_fap_face(actor.mesh, actor.points)


@pytest.fixture(scope="module")
def shapes(face: FapFace) -> dict[str, np.ndarray]:
    return expression_shapes(face, ALL)


def moved(face: FapFace, shape: np.ndarray, *names: str) -> np.ndarray:
    """Displacements (N, 3) of points along left, up and forward, in units of the face's length between the pupils."""
    points = face.points.subset(names)
    change = points.positions(shape.astype(np.float64)) - points.positions(face.mesh.vertices)
    return change @ face.axes.T / face.fapu.es


def gap(face: FapFace, shape: np.ndarray, upper: str, lower: str) -> float:
    """Height between two points, as a share of the length between the pupils."""
    high, low = face.points.subset([upper, lower]).positions(shape.astype(np.float64)) @ face.axes[1]
    return float(high - low) / face.fapu.es


def test_every_set_has_the_standards_names(face: FapFace, shapes: dict[str, np.ndarray]) -> None:
    for name, table in SETS.items():
        still = still_shapes(face, [name])
        assert [*expression_shapes(face, [name])] == [shape for shape in table if shape not in still]
    assert len(SETS["expressions"]) == 6
    assert len(SETS["visemes"]) == 14
    assert len(SETS["arkit"]) == 52
    assert set(shapes) == {shape for table in SETS.values() for shape in table} - set(still_shapes(face, ALL))


def test_shapes_move_the_face_and_nothing_is_broken(face: FapFace, shapes: dict[str, np.ndarray]) -> None:
    neutral = face.mesh.vertices.astype(np.float32)
    for name, shape in shapes.items():
        assert shape.shape == neutral.shape
        assert shape.dtype == np.float32
        assert np.isfinite(shape).all(), name
        moves = np.linalg.norm(shape - neutral, axis=1).max()
        assert 1e-3 < moves / face.fapu.es < 3, name


def test_shapes_that_no_point_carries_are_named(face: FapFace) -> None:
    """The actor has no tongue and no points on its ears."""
    still = still_shapes(face, ALL)
    assert "tongueOut" in still
    assert {"raise_l_ear", "pull_r_ear", "shift_tongue_tip", "tongue_roll"} <= set(still)
    assert not set(still) & set(SETS["expressions"]) | set(still) & set(SETS["visemes"])


def test_symmetric_recipes_make_symmetric_shapes(face: FapFace, shapes: dict[str, np.ndarray]) -> None:
    """The actor's triangles are not quite symmetric: a vertex is held against its image where there is one."""
    mirror = np.array([-1.0, 1, 1])
    away, partner = cKDTree(face.mesh.vertices).query(face.mesh.vertices * mirror)
    near = away < 1e-6
    assert near.mean() > 0.5
    found = [name for name in SYMMETRIC if name in shapes]
    assert len(found) > 35
    for name in found:
        change = shapes[name] - face.mesh.vertices
        off = np.linalg.norm(change[partner] * mirror - change, axis=1)[near]
        assert off.max() < 0.06 * np.linalg.norm(change, axis=1).max(), name


def test_left_and_right_shapes_are_mirror_images(face: FapFace, shapes: dict[str, np.ndarray]) -> None:
    mirror = np.array([-1.0, 1, 1])
    for name in SETS["arkit"]:
        other = name.replace("Left", "Right")
        if other == name or name not in shapes:
            continue
        pairs = [("8.3", "8.4"), ("4.1", "4.2"), ("4.5", "4.6"), ("3.1", "3.2"), ("9.1", "9.2"), ("5.3", "5.4")]
        left, right = zip(*(pairs + [(b, a) for a, b in pairs]), strict=True)
        np.testing.assert_allclose(
            moved(face, shapes[name], *left), moved(face, shapes[other], *right) * mirror, atol=2e-3, err_msg=name
        )


def test_joy_smiles(face: FapFace, shapes: dict[str, np.ndarray]) -> None:
    left, right = moved(face, shapes["joy"], "8.3", "8.4")
    assert min(left[1], right[1]) > 0.08
    assert left[0] > 0.03
    assert right[0] < -0.03
    assert (moved(face, shapes["joy"], "5.3", "5.4")[:, 1] > 0.02).all()


def test_anger_lowers_and_joins_the_brows(face: FapFace, shapes: dict[str, np.ndarray]) -> None:
    left, right = moved(face, shapes["anger"], "4.1", "4.2")
    assert max(left[1], right[1]) < -0.05
    assert left[0] < -0.05
    assert right[0] > 0.05
    assert gap(face, shapes["anger"], "3.1", "3.3") > gap(face, face.mesh.vertices, "3.1", "3.3")


def test_sadness_raises_the_brows_at_the_nose_and_lowers_the_corners(
    face: FapFace, shapes: dict[str, np.ndarray]
) -> None:
    inner, outer, corner = moved(face, shapes["sadness"], "4.1", "4.5", "8.3")
    assert inner[1] > 0.05 > 0 > outer[1]
    assert corner[1] < -0.02


def test_surprise_opens_mouth_and_eyes(face: FapFace, shapes: dict[str, np.ndarray]) -> None:
    shape, neutral = shapes["surprise"], face.mesh.vertices
    assert gap(face, shape, "2.2", "2.3") > gap(face, neutral, "2.2", "2.3") + 0.2
    for upper, lower in (("3.1", "3.3"), ("3.2", "3.4")):
        assert gap(face, shape, upper, lower) > 1.2 * gap(face, neutral, upper, lower)
    assert (moved(face, shape, "4.1", "4.2", "4.3", "4.4", "4.5", "4.6")[:, 1] > 0.1).all()
    assert moved(face, shape, "2.1")[0, 1] < -0.15


def test_disgust_curls_the_upper_lip(face: FapFace, shapes: dict[str, np.ndarray]) -> None:
    assert (moved(face, shapes["disgust"], "8.1", "8.5", "8.6")[:, 1] > 0.05).all()


def test_visemes_open_and_shut_the_lips(face: FapFace, shapes: dict[str, np.ndarray]) -> None:
    opened = {name: gap(face, shapes[name], "2.2", "2.3") for name in SETS["visemes"]}
    assert max(opened, key=lambda name: opened[name]) == "viseme_aa"
    assert opened["viseme_aa"] > opened["viseme_E"] > opened["viseme_ih"] > opened["viseme_PP"]
    assert opened["viseme_PP"] <= gap(face, face.mesh.vertices, "2.2", "2.3")
    corners = {name: np.ptp(moved(face, shapes[name], "8.3", "8.4")[:, 0]) for name in ("viseme_ou", "viseme_ih")}
    assert corners["viseme_ou"] > 0.05
    assert moved(face, shapes["viseme_ou"], "8.3")[0, 0] < 0 < moved(face, shapes["viseme_ih"], "8.3")[0, 0]


def test_blinking_shuts_one_eye(face: FapFace, shapes: dict[str, np.ndarray]) -> None:
    neutral = gap(face, face.mesh.vertices, "3.1", "3.3")
    assert abs(gap(face, shapes["eyeBlinkLeft"], "3.1", "3.3")) < 0.05 * neutral
    assert gap(face, shapes["eyeBlinkLeft"], "3.2", "3.4") == pytest.approx(neutral, rel=1e-2)


def test_mouth_close_shuts_what_the_jaw_opened(face: FapFace, shapes: dict[str, np.ndarray]) -> None:
    neutral = face.mesh.vertices
    both = shapes["jawOpen"].astype(np.float64) + shapes["mouthClose"] - neutral
    for upper, lower in (("2.2", "2.3"), ("2.6", "2.8"), ("2.7", "2.9")):
        assert gap(face, shapes["jawOpen"], upper, lower) > gap(face, neutral, upper, lower) + 0.2
        assert gap(face, both, upper, lower) == pytest.approx(gap(face, neutral, upper, lower), abs=1e-3)
    assert moved(face, both, "2.1")[0, 1] < -0.2


def test_a_face_without_lids_and_brows_has_the_rest(face: FapFace) -> None:
    mouth = [name for name in face.points.names if name.split(".")[0] in ("2", "8", "9") or name == "3.1"]
    corners = ["3.7", "3.8", "3.11", "3.12", "3.3"]
    fewer = fit_fap_face(face.mesh, face.points.subset([*mouth, *corners]))
    still = still_shapes(fewer, ["arkit"])
    assert {"browInnerUp", "browOuterUpLeft", "eyeBlinkRight", "cheekPuff"} - set(still) <= {"cheekPuff"}
    assert "jawOpen" not in still
    assert "eyeBlinkLeft" not in still
    made = expression_shapes(fewer, ["arkit", "expressions"])
    assert not set(made) & set(still)
    assert {"jawOpen", "joy", "anger"} <= set(made)


def test_no_set_and_nothing_to_show_give_nothing(face: FapFace) -> None:
    assert expression_shapes(face, []) == {}
    assert still_shapes(face, []) == []


def test_an_unknown_set_is_one_sentence(face: FapFace) -> None:
    for function in (expression_shapes, still_shapes):
        with pytest.raises(RetargetError, match=r"there is no set 'smiles', expected some of expressions, visemes"):
            function(face, ["arkit", "smiles"])
