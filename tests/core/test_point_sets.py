"""The sets of feature points: complete, mirrored, in an order that makes sense."""

import subprocess
import sys

import pytest

from facial_retarget_addon.core.mpeg4.fdps import FDPS
from facial_retarget_addon.core.mpeg4.mean_face import MEAN_FACE
from facial_retarget_addon.core.mpeg4.regions import OWN_PARTS
from facial_retarget_addon.core.point_sets import (
    DIAGRAM_HIGH,
    DIAGRAM_LOW,
    FIRST_FIVE,
    POINT_INFOS,
    POINT_SETS,
    next_point,
    partner_of,
    point_label,
    point_meaning,
    side_of,
)
from facial_retarget_addon.demo.landmarks import POINTS


def names(set_name: str) -> list[str]:
    return [info.name for info in POINT_SETS[set_name]]


def test_the_sets_hold_one_another_and_no_point_twice() -> None:
    assert [len(POINT_SETS[name]) for name in ("MINIMAL", "FMC", "DENSE")] == [15, 48, 124]
    for small, large in (("MINIMAL", "FMC"), ("FMC", "DENSE")):
        assert names(large)[: len(POINT_SETS[small])] == names(small)
    for chosen in POINT_SETS:
        assert len(set(names(chosen))) == len(POINT_SETS[chosen])
        assert names(chosen)[:5] == list(FIRST_FIVE)


def test_mpeg4s_set_is_what_the_average_face_has_on_its_skin() -> None:
    assert set(names("FMC")) == set(MEAN_FACE) - set(OWN_PARTS) - {"7.1"}


def test_the_dense_set_is_what_the_built_in_faces_have() -> None:
    assert set(names("DENSE")) == set(POINTS)


@pytest.mark.parametrize("chosen", POINT_SETS)
def test_partners_are_mutual_and_in_the_same_set(chosen: str) -> None:
    for info in POINT_SETS[chosen]:
        if info.partner:
            partner = POINT_INFOS[info.partner]
            assert partner.partner == info.name
            assert info.partner in names(chosen)
            assert partner.diagram == (-info.diagram[0], info.diagram[1])
            assert {info.label.split()[0], partner.label.split()[0]} == {"Left", "Right"}
            assert info.label.split()[1:] == partner.label.split()[1:]
            assert (info.diagram[0] > 0) == info.label.startswith("Left")
        else:
            assert info.diagram[0] == 0


def test_mpeg4s_points_have_the_standards_meaning_and_partner() -> None:
    for name in set(POINT_INFOS) & set(FDPS):
        assert POINT_INFOS[name].meaning == FDPS[name].meaning
        assert (POINT_INFOS[name].partner or name) == FDPS[name].partner


def test_every_point_says_what_it_is_and_has_its_own_place_on_the_diagram() -> None:
    assert all(info.label and info.meaning and "{" not in info.meaning for info in POINT_INFOS.values())
    assert all(info.name == name for name, info in POINT_INFOS.items())
    assert len({info.label for info in POINT_INFOS.values()}) == len(POINT_INFOS)
    assert len({info.meaning for info in POINT_INFOS.values()}) == len(POINT_INFOS)
    places = [info.diagram for info in POINT_INFOS.values()]
    for i, (x, y) in enumerate(places):
        assert DIAGRAM_LOW[0] < x < DIAGRAM_HIGH[0]
        assert DIAGRAM_LOW[1] < y < DIAGRAM_HIGH[1]
        assert all((x - u) ** 2 + (y - v) ** 2 > 0.03**2 for u, v in places[:i])


def test_the_diagram_lies_as_the_built_in_faces_do() -> None:
    for name, (x, y) in POINTS.items():
        u, v = POINT_INFOS[name].diagram
        assert abs(u - x) < 0.05
        assert abs(v - y) < 0.05


def test_the_next_point_is_the_first_that_is_neither_placed_nor_skipped() -> None:
    assert next_point("MINIMAL", (), ()) == FIRST_FIVE[0]
    assert next_point("MINIMAL", FIRST_FIVE[:2], {FIRST_FIVE[2]}) == FIRST_FIVE[3]
    assert next_point("MINIMAL", names("MINIMAL")[:-1], ()) == names("MINIMAL")[-1]
    assert next_point("MINIMAL", names("MINIMAL"), ()) is None
    assert next_point("DENSE", names("FMC"), ()) == names("DENSE")[48]


def test_every_name_has_a_label() -> None:
    assert point_meaning("cheek_l_1") == "left cheek beside the nose"
    assert point_meaning("10.5") == "left ear lobe, bottom"
    assert point_meaning("wart") == ""
    assert point_label("8.3") == "Left Mouth Corner"
    assert point_label("10.5") == "Left ear lobe, bottom"
    assert point_label("wart") == "wart"


@pytest.mark.parametrize("name", {**POINT_INFOS, **FDPS})
def test_partners_lie_on_different_sides(name: str) -> None:
    sides = {side_of(name), side_of(partner_of(name))} if partner_of(name) else {side_of(name)}
    assert sides == ({"left", "right"} if partner_of(name) else {""})


def test_partners_are_known_beyond_the_sets() -> None:
    assert partner_of("8.3") == "8.4"
    assert partner_of("10.5") == "10.6"
    assert [partner_of(name) for name in ("9.3", "7.1", "wart")] == ["", "", ""]


def test_the_sets_load_without_numpy() -> None:
    program = """
import sys
import facial_retarget_addon.core.point_sets
sys.exit(", ".join(sorted({"numpy", "scipy", "embreex"} & set(sys.modules))) or None)
"""
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
