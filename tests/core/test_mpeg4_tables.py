"""The tables of MPEG-4: complete, numbered, and the same on both halves of the face."""

import re
from collections import Counter
from itertools import chain
from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.core.mpeg4.arkit import ARKIT
from facial_retarget_addon.core.mpeg4.expressions import EXPRESSIONS
from facial_retarget_addon.core.mpeg4.faps import FAPS, Fap, X, Y, Z
from facial_retarget_addon.core.mpeg4.fdps import FDPS
from facial_retarget_addon.core.mpeg4.recipes import Recipe, mirrored
from facial_retarget_addon.core.mpeg4.sets import SETS
from facial_retarget_addon.core.mpeg4.visemes import VISEMES

RECIPES = {f"{group} {name}": recipe for group, shapes in SETS.items() for name, recipe in shapes.items()}
MOUTHS = {name: recipe for name, recipe in RECIPES.items() if not name.startswith("faps")}
LIPS = ((4, 5), (8, 10), (9, 11))
"""FAPs of the inner upper and lower lip, one above the other: the upper counts downwards, the lower upwards."""


def other_side(text: str) -> str:
    return re.sub("left|right", lambda side: {"left": "right", "right": "left"}[side.group()], text)


def lip_gap(recipe: Recipe) -> list[int]:
    return [-recipe.get(upper, 0) - recipe.get(lower, 0) for upper, lower in LIPS]


def summed(*recipes: Recipe) -> Recipe:
    total = Counter[int]()
    for recipe in recipes:
        total.update(recipe)
    return dict(total)


def on_other_side(name: str) -> str:
    return re.sub("Left$|Right$", lambda side: {"Left": "Right", "Right": "Left"}[side.group()], name)


# ---- feature points ---------------------------------------------------------------------------------
def test_the_84_points_are_numbered_in_ten_groups() -> None:
    sizes = {2: 14, 3: 14, 4: 6, 5: 4, 6: 4, 7: 1, 8: 10, 9: 15, 10: 10, 11: 6}
    assert list(FDPS) == [f"{group}.{number}" for group, size in sizes.items() for number in range(1, size + 1)]
    assert all(name == point.name for name, point in FDPS.items())


def test_points_and_partners_are_each_others_mirror_image() -> None:
    for point in FDPS.values():
        partner = FDPS[point.partner]
        assert partner.partner == point.name
        assert partner.meaning == (point.meaning if partner is point else other_side(point.meaning))
        assert partner.anchored == point.anchored
        assert partner.rides_on == (FDPS[point.rides_on].partner if point.rides_on else "")


def test_every_point_says_where_it_lies_and_no_two_the_same() -> None:
    meanings = [point.meaning for point in FDPS.values()]
    assert all(meanings)
    assert len(set(meanings)) == len(meanings)


def test_places_name_points_and_their_x_is_mirrored() -> None:
    for point in FDPS.values():
        clauses = {clause[0]: re.findall(r"\d+\.\d+", clause) for clause in point.place.split("; ") if clause}
        assert set(clauses) <= set("xyz")
        assert all(name in FDPS and name != point.name for name in chain.from_iterable(clauses.values()))
        mirror = [clause for clause in FDPS[point.partner].place.split("; ") if clause.startswith("x")]
        assert bool(mirror) == ("x" in clauses)
        if mirror:
            assert {FDPS[name].partner for name in clauses["x"]} == set(re.findall(r"\d+\.\d+", mirror[0]))


def test_anchored_points_are_moved_by_no_fap_and_riders_ride_on_a_point_that_is() -> None:
    moved = {name for fap in FAPS for name in fap.points}
    assert not moved & {name for name, point in FDPS.items() if point.anchored}
    assert {point.rides_on for point in FDPS.values()} - {""} <= moved


# ---- FAPs -------------------------------------------------------------------------------------------
def test_the_68_faps_are_numbered_and_named() -> None:
    assert [fap.number for fap in FAPS] == list(range(1, 69))
    assert len({fap.name for fap in FAPS}) == 68
    assert all(fap.meaning for fap in FAPS)
    assert [fap.name for fap in FAPS if fap.kind == "high_level"] == ["viseme", "expression"]


def test_units_kinds_and_one_way_faps_are_the_standards() -> None:
    units = Counter(fap.unit for fap in FAPS)
    assert units == {"MNS": 23, "ENS": 16, "AU": 8, "MW": 7, "IRISD": 6, "ES": 6, "": 2}
    assert {fap.number for fap in FAPS if fap.one_way} == {3, 14, 41, 42, 47}
    kinds = Counter(fap.kind for fap in FAPS)
    assert kinds == {"translation": 56, "rotation": 7, "scale": 2, "roll": 1, "high_level": 2}
    assert all((fap.unit == "AU") == (fap.kind in ("rotation", "roll")) for fap in FAPS)


def test_faps_act_on_points_that_exist_and_no_two_alike() -> None:
    assert all(name in FDPS for fap in FAPS for name in fap.points)
    assert all(bool(fap.points) != (fap.kind == "high_level") for fap in FAPS)
    assert all((fap.axis in (X, Y, Z)) == (fap.kind in ("translation", "rotation")) for fap in FAPS)
    acts = [(fap.kind, fap.points, fap.axis) for fap in FAPS if fap.points]
    assert len(set(acts)) == len(acts)


def test_a_fap_and_its_mirror_move_mirrored_points_in_mirrored_directions() -> None:
    for fap in FAPS:
        mirror = FAPS[fap.mirror - 1]
        assert mirror.mirror == fap.number
        assert {FDPS[name].partner for name in fap.points} == set(mirror.points)
        same = ("unit", "kind", "axis", "one_way", "mirror_sign")
        assert all(getattr(mirror, field) == getattr(fap, field) for field in same)
        # A mirror turns round what goes along x, and what turns about y and z.
        turned = fap.axis == X if fap.kind == "translation" else fap.kind == "rotation" and fap.axis != X
        assert mirror.sign == (-1 if turned else 1) * fap.sign * fap.mirror_sign
        if mirror is not fap and fap.mirror_sign == 1:
            assert mirror.meaning == other_side(fap.meaning)


# ---- recipes ----------------------------------------------------------------------------------------
def test_expressions_and_visemes_are_numbered_as_faps_1_and_2_select_them() -> None:
    assert [(one.number, one.name) for one in EXPRESSIONS.values()] == [
        (1, "joy"), (2, "sadness"), (3, "anger"), (4, "fear"), (5, "disgust"), (6, "surprise")
    ]  # fmt: skip
    assert [one.number for one in VISEMES.values()] == list(range(1, 15))
    phonemes = " ".join(chain.from_iterable(one.phonemes for one in VISEMES.values()))
    assert phonemes == "p b m f v T D t d k g tS dZ S s z n l r A: e I Q U"
    assert all(name == one.name and one.meaning for table in (EXPRESSIONS, VISEMES) for name, one in table.items())


def test_arkit_is_in_the_order_of_live_link_face(shared_data: Path) -> None:
    with np.load(shared_data / "livelink_jmiller.npz") as take:
        assert list(ARKIT) == take["names"].tolist()
    assert len(ARKIT) == 52


def test_sets_are_whole() -> None:
    assert {name: len(shapes) for name, shapes in SETS.items()} == {
        "expressions": 6, "visemes": 14, "arkit": 52, "faps": 63
    }  # fmt: skip
    assert set(SETS["faps"]) == {fap.name for fap in FAPS} - {
        "viseme", "expression", "head_pitch", "head_yaw", "head_roll"
    }  # fmt: skip
    assert len(RECIPES) == len({name for shapes in SETS.values() for name in shapes})


@pytest.mark.parametrize("name", RECIPES)
def test_a_recipe_names_low_level_faps_and_one_way_faps_do_not_go_back(name: str) -> None:
    recipe = RECIPES[name]
    assert recipe
    assert all(3 <= number <= 68 and value for number, value in recipe.items())
    assert all(value > 0 for number, value in recipe.items() if FAPS[number - 1].one_way)
    assert mirrored(mirrored(recipe)) == recipe


def test_expressions_visemes_and_shapes_without_a_side_are_symmetric() -> None:
    for name, recipe in MOUTHS.items():
        if name == on_other_side(name):
            assert mirrored(recipe) == recipe, name


def test_the_right_shape_is_the_left_ones_mirror_image() -> None:
    sided = [name for name in ARKIT if name != on_other_side(name)]
    assert len(sided) == 40
    for name in sided:
        assert mirrored(ARKIT[name]) == ARKIT[on_other_side(name)], name


def test_left_shapes_act_on_the_subjects_left() -> None:
    for name, recipe in ARKIT.items():
        if name.endswith("Left") and name not in ("jawLeft", "mouthLeft"):
            strength = {number: abs(value) for number, value in recipe.items()}
            right = {number: abs(value) for number, value in mirrored(recipe).items()}
            for fap in (FAPS[number - 1] for number in recipe):
                if fap.points[0] in ("2.4", "2.6", "2.8", "3.1", "3.3", "3.5", "4.1", "4.3", "4.5", "8.3", "9.1"):
                    assert strength[fap.number] > right.get(fap.number, 0), (name, fap.name)


def test_a_blink_shuts_the_eye_exactly() -> None:
    assert ARKIT["eyeBlinkLeft"][19] + ARKIT["eyeBlinkLeft"][21] == 1024
    assert ARKIT["eyeBlinkRight"][20] + ARKIT["eyeBlinkRight"][22] == 1024


def test_the_lips_stay_when_the_jaw_opens_and_the_mouth_closes() -> None:
    jaw = {number for number, value in summed(ARKIT["jawOpen"], ARKIT["mouthClose"]).items() if value}
    assert jaw == {3}


def test_lips_meet_where_the_mouth_is_shut() -> None:
    shut = ("Smile", "Frown", "Dimple", "Stretch")
    for name, recipe in ARKIT.items():
        if any(word in name for word in shut) or name in ("mouthPucker", "mouthLeft", "mouthRight", "cheekPuff"):
            assert lip_gap(recipe) == [0, 0, 0], name
    assert lip_gap(summed(ARKIT["mouthShrugUpper"], ARKIT["mouthShrugLower"])) == [0, 0, 0]
    assert max(lip_gap(VISEMES["viseme_PP"].recipe)) < 0
    assert max(lip_gap(EXPRESSIONS["anger"].recipe)) < 0


def test_mouths_open_in_their_order() -> None:
    order = ("viseme_PP", "viseme_FF", "viseme_SS", "viseme_ih", "viseme_E", "viseme_oh", "viseme_aa")
    gaps = [lip_gap(VISEMES[name].recipe)[0] for name in order]
    assert gaps == sorted(gaps)
    assert gaps[-1] < lip_gap(ARKIT["jawOpen"])[0]


def test_a_lip_keeps_its_skin() -> None:
    """What the lips' inner edge does, the outer does too, so that no recipe turns the lips inside out."""
    inner_to_outer = {4: 51, 5: 52, 6: 53, 7: 54, 8: 55, 9: 56, 10: 57, 11: 58, 12: 59, 13: 60}
    for name, recipe in MOUTHS.items():
        for inner, outer in inner_to_outer.items():
            if abs(recipe.get(inner, 0)) > 100:
                assert recipe[inner] * recipe.get(outer, 0) > 0, (name, inner)


def test_expressions_show_what_the_standard_says_of_them() -> None:
    brows_up, brows_down = {31: 1, 33: 1, 35: 1}, {31: -1, 33: -1}
    brows_at_rest, lids_at_rest = {31: 0, 33: 0, 35: 0, 37: 0}, {19: 0}
    signs = {
        "joy": brows_at_rest | {6: 1, 12: 1, 41: 1, 53: 1, 59: 1},
        "sadness": {31: 1, 35: -1, 19: 1, 3: 0},
        "anger": brows_down | {37: 1, 19: -1, 3: 0},
        "fear": brows_up | {37: 1, 19: -1},
        "disgust": brows_at_rest | lids_at_rest | {4: -1, 8: -1, 51: -1, 55: -1},
        "surprise": brows_up | {19: -1, 21: 0, 3: 1},
    }
    for name, wanted in signs.items():
        recipe = EXPRESSIONS[name].recipe
        assert {number: np.sign(recipe.get(number, 0)) for number in wanted} == wanted, name
    assert EXPRESSIONS["fear"].recipe[31] > EXPRESSIONS["fear"].recipe[35]
    assert all(min(lip_gap(EXPRESSIONS[name].recipe)) > 0 for name in ("joy", "surprise"))


# ---- the page ---------------------------------------------------------------------------------------
def acts(fap: Fap) -> str:
    if fap.axis is None:
        return {"scale": "size", "roll": "edges turn"}.get(fap.kind, "")
    return f"{'turns about ' if fap.kind == 'rotation' else ''}{'+' if fap.sign > 0 else '-'}{'xyz'[fap.axis]}"


def amounts(recipe: Recipe) -> str:
    """Of a symmetric recipe the left half and the middle."""
    symmetric = mirrored(recipe) == recipe
    shown = {number: value for number, value in recipe.items() if not symmetric or number <= FAPS[number - 1].mirror}
    return ", ".join(f"{number}: {value}" for number, value in shown.items())


def documented_tables() -> dict[str, list[list[str]]]:
    """Heading of each table of the page -> its rows."""
    moved = {name: [str(fap.number) for fap in FAPS if name in fap.points] for name in FDPS}
    return {
        "| point | where it lies | the standard's place | moved by FAPs | here |": [
            [
                point.name,
                point.meaning,
                point.place,
                ", ".join(moved[point.name]),
                "anchored" if point.anchored else point.rides_on and f"rides on {point.rides_on}",
            ]
            for point in FDPS.values()
        ],
        "| FAP | name | what moves: where to | unit | points | acts | one way | mirror |": [
            [
                str(fap.number),
                f"`{fap.name}`",
                fap.meaning,
                fap.unit,
                ", ".join(fap.points),
                acts(fap),
                "yes" if fap.one_way else "",
                f"{'-' if fap.mirror_sign < 0 else ''}{fap.mirror}",
            ]
            for fap in FAPS
        ],
        "| number | expression | what shows | FAPs, left half and middle |": [
            [str(one.number), one.name, one.meaning, amounts(one.recipe)] for one in EXPRESSIONS.values()
        ],
        "| number | viseme | phonemes (SAMPA) | what the mouth does | FAPs, left half and middle |": [
            [str(one.number), f"`{one.name}`", " ".join(one.phonemes), one.meaning, amounts(one.recipe)]
            for one in VISEMES.values()
        ],
        "| ARKit shape | FAPs at weight 1 |": [
            [f"`{name}`", amounts(recipe)] for name, recipe in ARKIT.items() if not name.endswith("Right")
        ],
    }


def test_the_page_shows_the_tables_as_they_are() -> None:
    page = (Path(__file__).parents[2] / "docs" / "mpeg4.md").read_text()
    for heading, rows in documented_tables().items():
        table = page.partition(heading)[2].lstrip("\n").split("\n\n")[0].splitlines()[1:]
        assert [[cell.strip() for cell in line.strip("|").split("|")] for line in table] == rows, heading
