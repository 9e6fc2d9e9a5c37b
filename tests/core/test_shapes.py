"""Sets of shapes: choosing, halving, joining, combining them, and taking them to another head."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.acting.expression_sets import expression_shapes
from facial_retarget_addon.core.acting.fap_face import fit_fap_face
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.methods.settings import MotionCloningSettings
from facial_retarget_addon.core.mpeg4.arkit import ARKIT_NAMES
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.core.shapes.choose import chosen
from facial_retarget_addon.core.shapes.clone import clone_shapes
from facial_retarget_addon.core.shapes.combinations import combined, complete, find_correctives, taken_apart
from facial_retarget_addon.core.shapes.counterparts import Features, feature_of, missing
from facial_retarget_addon.core.shapes.names import arkit_name, arkit_whole
from facial_retarget_addon.core.shapes.prepare import Preparation, prepare_shapes
from facial_retarget_addon.core.shapes.resolve import resolve_shapes
from facial_retarget_addon.core.shapes.shape_set import ShapeSet
from facial_retarget_addon.core.shapes.sides import (
    BLENDER_SIDES,
    SideNames,
    arkit_merges,
    has_side,
    left_share,
    merged,
    side_names,
    split,
)
from facial_retarget_addon.files.points import read_points

RNG = np.random.default_rng(5)


def some_shapes(*names: str, vertices: int = 7) -> ShapeSet:
    return ShapeSet(names, RNG.normal(size=(len(names), vertices, 3)).astype(np.float32))


# ---- the set ------------------------------------------------------------------------------------


def test_a_set_says_what_is_wrong_with_it() -> None:
    with pytest.raises(RetargetError, match=r"2 names and displacements of shape \(1, 7, 3\)"):
        ShapeSet(("a", "b"), np.zeros((1, 7, 3)))
    with pytest.raises(RetargetError, match="'a' appears twice"):
        some_shapes("a", "a")
    with pytest.raises(RetargetError, match="'b' has 1 vertices that are NaN"):
        ShapeSet(("a", "b"), np.array([[[0, 0, 0]], [[0, np.nan, 0]]]))
    with pytest.raises(RetargetError, match="'c', 'd' are missing"):
        some_shapes("a", "b").subset(["c", "a", "d"])
    with pytest.raises(RetargetError, match=r"'a' has shape \(2, 3\), expected \(7, 3\)"):
        ShapeSet.of_positions(np.zeros((7, 3)), {"a": np.zeros((2, 3))})


def test_positions_and_back() -> None:
    neutral = RNG.normal(size=(7, 3))
    shapes = some_shapes("a", "b")
    back = ShapeSet.of_positions(neutral, dict(zip("ab", shapes.positions(neutral), strict=True)))
    np.testing.assert_allclose(back.displacements, shapes.displacements, atol=1e-6)
    still = ShapeSet.of_positions(neutral, {"rest": neutral})
    assert (still.displacements == 0).all()


def test_sets_are_joined_and_replaced() -> None:
    one, other = some_shapes("a", "b"), some_shapes("c", "b")
    with pytest.raises(RetargetError, match="'b' appears twice"):
        one.joined(other)
    assert one.joined(other.subset(["c"])).names == ("a", "b", "c")
    mixed = one.with_shapes(other)
    np.testing.assert_array_equal(mixed["a"], one["a"])
    np.testing.assert_array_equal(mixed["b"], other["b"])
    with pytest.raises(RetargetError, match="of 7 and of 3 vertices"):
        one.joined(some_shapes("c", vertices=3))


# ---- choosing -----------------------------------------------------------------------------------


def test_patterns_keep_and_drop() -> None:
    names = ("jawOpen", "mouthClose", "mouthLeft", "browDown_L")
    assert chosen(names) == names
    assert chosen(names, ("mouth*", "brow*"), ("*Left",)) == ("mouthClose", "browDown_L")
    with pytest.raises(RetargetError, match=r"no shape is called 'Mouth\*' or 'tongue\?'"):
        chosen(names, ("Mouth*",), ("tongue?",))
    with pytest.raises(RetargetError, match="no shape is left of 4"):
        chosen(names, ("jaw*",), ("*Open",))


# ---- names --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "known"),
    [
        ("browDown_L", "browDownLeft"),
        ("AK_27_MouthClose", "mouthClose"),
        ("AK_01_BrowDownLeft", "browDownLeft"),
        ("mouthClosed", "mouthClose"),
        ("mouthFromRight", "mouthFrownRight"),
        ("eyeBlink.R", "eyeBlinkRight"),
        ("eye_blink_left", "eyeBlinkLeft"),
        ("JawLeft", "jawLeft"),
        ("jawOpen", "jawOpen"),
        ("browInnerUp_L", None),
        ("eyeBlink", None),
        ("mouth", None),
        ("AU_26_JawDrop", None),
        ("", None),
    ],
)
def test_arkit_names_in_other_spellings(name: str, known: str | None) -> None:
    assert arkit_name(name) == known


def test_arkit_names_stand_for_themselves() -> None:
    assert [arkit_name(name) for name in ARKIT_NAMES] == list(ARKIT_NAMES)
    assert [arkit_whole(name) for name in ("browInnerUp_L", "cheekPuffRight", "browDown_L", "jawLeft")] == [
        "browInnerUp",
        "cheekPuff",
        None,
        None,
    ]


def test_the_shared_sets_names_are_known(shared_data) -> None:
    for file, count in (("ict_dev", 49), ("male_adult_08", 52), ("johnsmith_welded", 50)):
        with np.load(shared_data / f"{file}.npz") as data:
            found = [arkit_name(str(name)) for name in data["expr_names"]]
        assert len({name for name in found if name}) == count


# ---- sides --------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def actor() -> demo.DemoFace:
    return demo.actor(vertices=4_000)


@pytest.mark.parametrize(
    "name", ["browDownLeft", "blink_L", "a.r", "AU_02_L_OuterBrowRaiser", "eye-left-slit", "jawLeft"]
)
def test_names_with_a_side(name: str) -> None:
    assert has_side(name)


@pytest.mark.parametrize(
    "name", ["browInnerUp", "mouthClose", "AL", "leftover", "smile", "viseme_RR", "AU_11_Nasolabial"]
)
def test_names_without_a_side(name: str) -> None:
    assert not has_side(name)


def test_halves_add_up_to_the_whole_exactly(actor: demo.DemoFace) -> None:
    mesh, points = actor.face.mesh, actor.face.points
    share = left_share(mesh, points)
    shapes = some_shapes("smile", "blinkLeft", vertices=len(mesh.vertices))
    halves = split(shapes, share)
    assert halves.names == ("smileLeft", "smileRight", "blinkLeft")
    np.testing.assert_array_equal(halves["smileLeft"] + halves["smileRight"], shapes["smile"])
    np.testing.assert_array_equal(halves["blinkLeft"], shapes["blinkLeft"])
    left = mesh.vertices[:, 0] > 0.3
    right = mesh.vertices[:, 0] < -0.3
    np.testing.assert_array_equal(halves["smileLeft"][left], shapes["smile"][left])
    assert (halves["smileLeft"][right] == 0).all()
    np.testing.assert_array_equal(merged(halves, {"smile": ("smileLeft", "smileRight")})["smile"], shapes["smile"])


def test_the_border_is_soft_and_mirrors(actor: demo.DemoFace) -> None:
    mesh, points = actor.face.mesh, actor.face.points
    share = left_share(mesh, points)
    order = np.argsort(mesh.vertices[:, 0])
    assert (np.diff(share[order]) >= -1e-6).all()
    across = np.abs(share[mesh.edges[:, 0]] - share[mesh.edges[:, 1]])
    assert across.max() < 0.6
    hard = left_share(mesh, points, feather=0.0)
    assert set(np.round(hard, 6).tolist()) <= {0.0, 0.5, 1.0}
    turn = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    moved = left_share(mesh.with_vertices(7 * mesh.vertices @ turn.T + [3, 4, 5]), points)
    np.testing.assert_allclose(moved, share, atol=1e-6)
    with pytest.raises(RetargetError, match="expected 0 or more"):
        left_share(mesh, points, -1.0)


def test_endings_follow_the_set() -> None:
    assert side_names(["a.L", "b.R", "c_L"]) == SideNames(".L", ".R")
    assert side_names(["browDownLeft", "jawOpen"]) == SideNames("Left", "Right")
    assert side_names(["smile"]) == BLENDER_SIDES
    halves = split(some_shapes("smile"), np.full(7, 0.5), SideNames("_links", "_rechts"))
    assert halves.names == ("smile_links", "smile_rechts")
    with pytest.raises(RetargetError, match="'smile_L' appears twice"):
        split(some_shapes("smile", "smile_L"), np.full(7, 0.5))


def test_merging_keeps_the_place_and_says_what_is_wrong() -> None:
    shapes = some_shapes("jawOpen", "browInnerUp_L", "x", "browInnerUp_R")
    recipes = arkit_merges(shapes.names)
    assert recipes == {"browInnerUp": ("browInnerUp_L", "browInnerUp_R")}
    whole = merged(shapes, recipes)
    assert whole.names == ("jawOpen", "browInnerUp", "x")
    np.testing.assert_array_equal(whole["browInnerUp"], shapes["browInnerUp_L"] + shapes["browInnerUp_R"])
    with pytest.raises(RetargetError, match="'y' are missing"):
        merged(shapes, {"new": ("x", "y")})
    with pytest.raises(RetargetError, match="'jawOpen' appears twice"):
        merged(shapes, {"jawOpen": ("x",)})
    with pytest.raises(RetargetError, match="'new' has nothing"):
        merged(shapes, {"new": ()})


# ---- combinations -------------------------------------------------------------------------------


def test_correctives_are_known_in_any_spelling() -> None:
    found = find_correctives(["AK_25_JawOpen", "AK_27_MouthClose", "x"])
    assert [(one.name, one.needs) for one in found] == [("AK_27_MouthClose", ("AK_25_JawOpen",))]
    assert find_correctives(["jawOpen", "mouthClose"], {"mouthClose": ()}) == ()
    own = find_correctives(["smile", "blink", "both"], {"both": ("smile", "blink"), "gone": ("smile",)})
    assert [(one.name, one.needs) for one in own] == [("both", ("smile", "blink"))]
    assert complete(find_correctives(["mouthClose"]), ["mouthClose"]) == ()


def test_a_combination_less_its_needs_is_the_corrective() -> None:
    shapes = some_shapes("fix", "jawOpen", "second", "mouthClose")
    correctives = find_correctives(shapes.names, {"fix": ("mouthClose", "second")})
    seen = ShapeSet(shapes.names, combined(shapes, correctives))
    np.testing.assert_allclose(seen["mouthClose"], shapes["mouthClose"] + shapes["jawOpen"])
    back = taken_apart(seen, correctives)
    for name in ("jawOpen", "second", "mouthClose"):
        np.testing.assert_allclose(back[name], shapes[name], atol=1e-6)
    # What a rig adds up is what was seen: the fix is seen on top of both shapes as they are by themselves.
    np.testing.assert_allclose(back["fix"] + back["mouthClose"] + back["second"], seen["fix"], atol=1e-6)


# ---- cloning ------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def problem(actor: demo.DemoFace) -> Problem:
    target = demo.warped_actor(np.random.default_rng(3), vertices=3_000)
    return Problem(replace(actor.face, examples={}), replace(target.face, examples={}))


@pytest.fixture(scope="module")
def arkit(problem: Problem) -> ShapeSet:
    face = fit_fap_face(problem.source.mesh, problem.source.points)
    return ShapeSet.of_positions(problem.source.mesh.vertices, expression_shapes(face, ["arkit"]))


def test_a_set_goes_over_whole(problem: Problem, arkit: ShapeSet) -> None:
    cloned = clone_shapes("motion_cloning", problem, MotionCloningSettings(), arkit, find_correctives(arkit.names))
    assert cloned.shapes.names == arkit.names == tuple(row["name"] for row in cloned.rows)
    assert cloned.shapes.displacements.shape == (len(arkit), len(problem.target.mesh.vertices), 3)
    row = next(row for row in cloned.rows if row["name"] == "mouthClose")
    assert row["with"] == "jawOpen"
    smile = next(row for row in cloned.rows if row["name"] == "mouthSmileLeft")
    assert 0.5 < smile["share_of_source"] < 2
    np.testing.assert_allclose(smile["largest_motion"], np.linalg.norm(cloned.shapes["mouthSmileLeft"], axis=1).max())
    assert {"torn_edges", "flipped_triangles"} <= smile.keys()
    assert cloned.only(["jawOpen"]).shapes.names == ("jawOpen",)


def test_a_corrective_without_its_needs_is_said(problem: Problem, arkit: ShapeSet) -> None:
    alone = arkit.subset(["mouthClose", "mouthSmileLeft"])
    cloned = clone_shapes("motion_cloning", problem, MotionCloningSettings(), alone, find_correctives(alone.names))
    assert any("mouthClose means something only together with jawOpen" in text for text in cloned.report["warnings"])
    assert "with" not in cloned.rows[0]


def without(face: Face, *features: str) -> Face:
    """A face that has no point of some features."""
    kept = [name for name in face.points.names if not name[0].isdigit() or feature_of(name) not in features]
    return replace(face, points=face.points.subset(kept))


def test_what_a_head_lacks_stays_still_and_is_named(problem: Problem, arkit: ShapeSet) -> None:
    shapes = arkit.subset(["mouthPucker", "browInnerUp", "eyeBlinkLeft"])
    mouthless = replace(problem, target=without(problem.target, "mouth"))
    cloned = clone_shapes("motion_cloning", mouthless, MotionCloningSettings(), shapes)
    assert list(cloned.without_counterpart) == ["mouthPucker"]
    assert "mouth, which the target lacks" in cloned.without_counterpart["mouthPucker"]
    assert (cloned.shapes["mouthPucker"] == 0).all()
    assert cloned.shapes.largest()[1:].min() > 0
    assert any("no counterpart for mouthPucker" in text for text in cloned.report["warnings"])


def test_areas_without_points_are_no_loss(problem: Problem, arkit: ShapeSet) -> None:
    shapes = arkit.subset(["cheekPuff", "cheekSquintLeft", "browInnerUp", "jawOpen"])
    bare = replace(problem, target=without(problem.target, "cheek", "forehead", "ear", "neck"))
    assert clone_shapes("motion_cloning", bare, MotionCloningSettings(), shapes).without_counterpart == {}


def test_a_corrective_stays_still_with_what_it_needs(problem: Problem, arkit: ShapeSet) -> None:
    shapes = arkit.subset(["eyeBlinkLeft", "mouthSmileLeft"])
    correctives = find_correctives(shapes.names, {"mouthSmileLeft": ("eyeBlinkLeft",)})
    blind = replace(problem, target=without(problem.target, "left eye", "left eyeball"))
    cloned = clone_shapes("motion_cloning", blind, MotionCloningSettings(), shapes, correctives)
    assert set(cloned.without_counterpart) == set(shapes.names)
    assert cloned.without_counterpart["mouthSmileLeft"] == "needs eyeBlinkLeft, which has no counterpart"
    assert (cloned.shapes.displacements == 0).all()


def test_features_share_the_motion_out(problem: Problem, arkit: ShapeSet) -> None:
    features = Features(problem.source)
    shares = features.shares(arkit["eyeBlinkRight"])
    assert next(iter(shares)) == "right eye"
    np.testing.assert_allclose(sum(shares.values()), 1.0)
    assert missing(shares, features.has) == []
    assert missing(shares, features.has - {"right eye"}) == ["right eye"]
    assert features.shares(np.zeros_like(arkit["jawOpen"])) == {}


def test_shapes_of_another_head_are_refused(problem: Problem) -> None:
    with pytest.raises(RetargetError, match=f"have 7 vertices, expected {len(problem.source.mesh.vertices)}"):
        clone_shapes("motion_cloning", problem, MotionCloningSettings(), some_shapes("a"))
    empty = ShapeSet((), np.empty((0, len(problem.source.mesh.vertices), 3)))
    with pytest.raises(RetargetError, match="no shapes arrived"):
        clone_shapes("motion_cloning", problem, MotionCloningSettings(), empty)


# ---- learning from the artist -------------------------------------------------------------------


def stronger(shapes: ShapeSet, factor: float) -> ShapeSet:
    return ShapeSet(shapes.names, factor * shapes.displacements)


def test_corrected_shapes_come_back_as_they_are_and_teach_the_others(problem: Problem, arkit: ShapeSet) -> None:
    names = ["mouthSmileLeft", "mouthSmileRight", "mouthDimpleLeft", "jawOpen", "mouthClose", "browInnerUp"]
    shapes = arkit.subset(names)
    correctives = find_correctives(names)
    settings = MotionCloningSettings()
    plain = clone_shapes("motion_cloning", problem, settings, shapes, correctives)
    corrected = stronger(plain.shapes.subset(["mouthSmileLeft", "mouthClose"]), 1.4)
    again = resolve_shapes("motion_cloning", problem, settings, shapes, corrected, correctives)
    assert again.shapes.names == shapes.names
    for name in corrected.names:
        np.testing.assert_array_equal(again.shapes[name], corrected[name])
    # What is like the corrected smile grows as it did; what has nothing to do with it stays nearly as it was.
    growth = {name: again.shapes.largest()[k] / plain.shapes.largest()[k] for k, name in enumerate(names)}
    assert growth["mouthDimpleLeft"] > 1.15
    assert abs(growth["browInnerUp"] - 1) < 0.1
    assert [row["name"] for row in again.rows if row.get("corrected")] == list(corrected.names)
    figures = {figure["name"]: figure for figure in again.report["examples"]}
    assert set(figures) == set(corrected.names)
    assert all({"fit", "leave_one_out"} <= figure.keys() for figure in figures.values())


def test_nothing_corrected_changes_nothing(problem: Problem, arkit: ShapeSet) -> None:
    shapes = arkit.subset(["mouthSmileLeft", "browInnerUp"])
    plain = clone_shapes("motion_cloning", problem, MotionCloningSettings(), shapes)
    again = resolve_shapes("motion_cloning", problem, MotionCloningSettings(), shapes, plain.shapes.subset([]))
    np.testing.assert_array_equal(again.shapes.displacements, plain.shapes.displacements)


def test_corrections_that_fit_nothing_are_refused(problem: Problem, arkit: ShapeSet) -> None:
    shapes, settings = arkit.subset(["jawOpen"]), MotionCloningSettings()
    count = len(problem.target.mesh.vertices)
    with pytest.raises(RetargetError, match="corrected shapes smile are not among the source's jawOpen"):
        resolve_shapes("motion_cloning", problem, settings, shapes, some_shapes("smile", vertices=count))
    with pytest.raises(RetargetError, match=f"have 7 vertices, expected {count} as the target"):
        resolve_shapes("motion_cloning", problem, settings, shapes, some_shapes("jawOpen"))


def test_a_correction_that_shows_at_no_point_teaches_nothing(problem: Problem, arkit: ShapeSet) -> None:
    still = ShapeSet(("wiggle",), np.zeros((1, *arkit.displacements.shape[1:])))
    shapes = arkit.subset(["jawOpen"]).joined(still)
    corrected = some_shapes("wiggle", vertices=len(problem.target.mesh.vertices))
    again = resolve_shapes("motion_cloning", problem, MotionCloningSettings(), shapes, corrected)
    np.testing.assert_array_equal(again.shapes["wiggle"], corrected["wiggle"])
    assert again.report["examples"] == []
    assert any("teach nothing: wiggle" in text for text in again.report["warnings"])


# ---- preparing ----------------------------------------------------------------------------------


def test_a_set_is_prepared_in_order() -> None:
    shapes = some_shapes("browInnerUp_L", "browInnerUp_R", "AK_25_JawOpen", "mouthClosed", "smile", "x")
    how = Preparation(drop=("x", "AK_25*"), arkit_wholes=True, split=("s*",), merge={"y": ("smile",)}, arkit_names=True)
    with pytest.raises(RetargetError, match=r"no shape is called 's\*'"):
        prepare_shapes(shapes, how, np.ones(7))
    ready = prepare_shapes(shapes, replace(how, merge={}), np.ones(7))
    assert ready.wanted == ("browInnerUp", "mouthClose", "smile_L", "smile_R")
    # The jaw was dropped, but its corrective cannot go over without it.
    assert ready.shapes.names == (*ready.wanted, "jawOpen")
    assert [(one.name, one.needs) for one in ready.correctives] == [("mouthClose", ("jawOpen",))]
    np.testing.assert_array_equal(ready.shapes["smile_L"], shapes["smile"])


def test_halves_of_a_corrective_are_correctives() -> None:
    found = find_correctives(["jawOpen", "mouthClose_L", "mouthClose_R"])
    assert [(one.name, one.needs) for one in found] == [
        ("mouthClose_L", ("jawOpen",)),
        ("mouthClose_R", ("jawOpen",)),
    ]


def test_names_that_become_one_are_refused() -> None:
    with pytest.raises(RetargetError, match="'eyeBlinkLeft' appears twice"):
        prepare_shapes(some_shapes("eyeBlink_L", "eyeBlinkLeft"), Preparation(arkit_names=True))


TAUGHT = ("mouthSmile_L", "jawOpen", "browInnerUp_L", "eyeBlink_L", "mouthPucker", "noseSneer_R")
ICT_FACE = 9_409


def test_six_corrected_keys_bring_the_others_nearer_to_the_truth(shared_data: Path) -> None:
    pair = np.load(shared_data / "pair_ict_id02_to_id04_decim.npz")
    source, target = (TriMesh(pair[f"{which}_vertices"], pair[f"{which}_tris"]) for which in ("src", "tgt"))
    real = Problem(
        Face(source, read_points(shared_data / "pair_source_points.json", source)),
        Face(target, read_points(shared_data / "pair_target_points.json", target)),
    )
    names = tuple(str(name) for name in pair["expr_names"])
    shapes, truth = ShapeSet(names, pair["src_expr_delta"]), ShapeSet(names, pair["gt_expr_delta"])
    face = pair["src_tris"][pair["corr_src_face"]].max(axis=1) < ICT_FACE
    others = [name for name in names if name not in TAUGHT]

    def error(found: ShapeSet) -> float:
        wanted = truth.subset(others).displacements[:, face]
        miss = np.linalg.norm(found.subset(others).displacements[:, face] - wanted, axis=(1, 2))
        return float(np.median(miss / np.linalg.norm(wanted, axis=(1, 2))))

    # Units of regions leave more to learn: these two heads move alike though their eyes lie differently far apart.
    settings, correctives = MotionCloningSettings("regional"), find_correctives(names)
    plain = clone_shapes("motion_cloning", real, settings, shapes, correctives)
    taught = resolve_shapes("motion_cloning", real, settings, shapes, truth.subset(TAUGHT), correctives)
    assert error(taught.shapes) < 0.9 * error(plain.shapes)
    assert max(figure["fit"] for figure in taught.report["examples"]) < 0.02
