"""Sets of shapes on disk: folders, arrays, and facial animation tables."""

import json
from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mpeg4.arkit import ARKIT_NAMES
from facial_retarget_addon.core.mpeg4.sets import SETS
from facial_retarget_addon.core.shapes.parameters import KINDS, Parameter, parameter_of
from facial_retarget_addon.core.shapes.shape_set import ShapeSet
from facial_retarget_addon.files.animation_table import FORMAT, read_table, read_table_parameters
from facial_retarget_addon.files.meshes import write_mesh
from facial_retarget_addon.files.shape_files import add_shapes, read_shapes
from facial_retarget_addon.files.whole import written_whole

from .conftest import dome

DOME = dome(6)
NAMES = ("jawOpen", "viseme_PP", "joy", "open_jaw", "a smirk")


@pytest.fixture
def shapes() -> ShapeSet:
    moves = np.random.default_rng(2).normal(size=(len(NAMES), 36, 3)).astype(np.float32)
    moves[:, ::3] = 0
    return ShapeSet(NAMES, moves)


def write(shapes: ShapeSet, out: Path) -> None:
    with written_whole() as aside:
        add_shapes(aside, shapes, out, DOME)


@pytest.mark.parametrize("out", ["folder", "shapes.npz", "table.json"])
def test_shapes_come_back(out: str, tmp_path: Path, shapes: ShapeSet) -> None:
    write(shapes, tmp_path / out)
    back = read_shapes(tmp_path / out, DOME.mesh)
    for name in NAMES:
        np.testing.assert_allclose(back[name], shapes[name], atol=1e-6)
        assert (back[name][::3] == 0).all()
    assert back.names == (tuple(sorted(NAMES)) if out == "folder" else NAMES)


def test_a_table_keeps_every_bit(tmp_path: Path, shapes: ShapeSet) -> None:
    write(shapes, tmp_path / "table.json")
    np.testing.assert_array_equal(read_table(tmp_path / "table.json", 36).displacements, shapes.displacements)


def test_a_table_says_what_each_shape_answers_to(tmp_path: Path, shapes: ShapeSet) -> None:
    write(shapes, tmp_path / "table.json")
    _, parameters = read_table_parameters(tmp_path / "table.json", 36)
    assert parameters == {
        "jawOpen": Parameter("arkit", "jawOpen", 0.0, 1.0),
        "viseme_PP": Parameter("viseme", 1, 0.0, 63.0),
        "joy": Parameter("expression", 1, 0.0, 63.0),
        "open_jaw": Parameter("fap", 3, 0.0, 1024.0),
        "a smirk": Parameter("free", "", 0.0, 1.0),
    }
    document = json.loads((tmp_path / "table.json").read_text())
    assert document["shapes"]["jawOpen"]["vertices"] == [v for v in range(36) if v % 3]


def test_every_shape_of_the_standard_has_its_parameter() -> None:
    kinds = {"faps": "fap", "visemes": "viseme", "expressions": "expression", "arkit": "arkit"}
    assert set(kinds.values()) | {"free"} == set(KINDS)
    for name, shapes in SETS.items():
        assert {parameter_of(shape).kind for shape in shapes} == {kinds[name]}
    assert [parameter_of(name).key for name in ARKIT_NAMES] == list(ARKIT_NAMES)
    assert parameter_of("AK_25_JawOpen").key == "jawOpen"
    low = {parameter_of(name).low for name in ("open_jaw", "raise_b_midlip")}
    assert low == {0.0, -1024.0}


SOUND = {
    "format": FORMAT,
    "version": 1,
    "vertices": 36,
    "shapes": {"a": {"kind": "free", "range": [0, 1], "vertices": [3, 1], "displacements": [[1, 2, 3], [0.5, 0, 0]]}},
}


def changed(**values: object) -> dict[str, object]:
    return SOUND | {"shapes": {"a": {**SOUND["shapes"]["a"], **values}}}  # type: ignore[index]


def test_a_table_written_by_hand(tmp_path: Path) -> None:
    (tmp_path / "t.json").write_text(json.dumps(SOUND))
    found = read_table(tmp_path / "t.json", 36)
    assert found["a"][3].tolist() == [1, 2, 3]
    assert found["a"][1].tolist() == [0.5, 0, 0]
    assert np.abs(found["a"]).sum() == 6.5


@pytest.mark.parametrize(
    ("document", "said"),
    [
        (SOUND | {"vertices": 35}, "vertices = 35, expected 36"),
        (SOUND | {"version": 2}, "version = 2, expected 1"),
        (SOUND | {"shapes": {}}, "no shapes"),
        (SOUND | {"colour": 1}, "colour is unknown"),
        (changed(kind="smile"), "kind = 'smile', expected one of fap"),
        (changed(kind="fap"), "key is missing"),
        (changed(kind="viseme", key=15), "key = 15, expected 1 to 14"),
        (changed(range=[1, 1]), "expected a lowest and a greater highest"),
        (changed(range=["0", 1]), "expected a lowest and a greater highest"),
        (changed(vertices=[1, 1]), "expected different ones from 0 to 35"),
        (changed(vertices=[1, 36]), "expected different ones from 0 to 35"),
        (changed(vertices=[True, 3]), "expected different ones"),
        (changed(vertices=[1]), "1 vertices and 2 displacements"),
        (changed(displacements=[[1, 2, 3], [0, 0]]), "not three finite numbers"),
        (changed(displacements=[[1, 2, 3], [0, 0, 10**400]]), "not three finite numbers"),
        (changed(weight=2), "weight is unknown"),
    ],
)
def test_what_is_wrong_with_a_table_is_said(document: object, said: str, tmp_path: Path) -> None:
    (tmp_path / "t.json").write_text(json.dumps(document))
    with pytest.raises(RetargetError, match=said):
        read_table(tmp_path / "t.json", 36)


def test_what_is_no_set_is_refused(tmp_path: Path, shapes: ShapeSet) -> None:
    with pytest.raises(RetargetError, match="is no set of shapes, expected a folder"):
        read_shapes(tmp_path / "gone", DOME.mesh)
    (tmp_path / "empty").mkdir()
    with pytest.raises(RetargetError, match=r"holds no .obj or .ply files"):
        read_shapes(tmp_path / "empty", DOME.mesh)
    np.savez(tmp_path / "bad.npz", smile=np.zeros((35, 3)))
    with pytest.raises(RetargetError, match=r"shape 'smile' has positions \(35, 3\), expected \(36, 3\)$"):
        read_shapes(tmp_path / "bad.npz", DOME.mesh)
    np.savez(tmp_path / "nan.npz", smile=np.full((36, 3), np.nan))
    with pytest.raises(RetargetError, match="shape 'smile' has vertices that are NaN"):
        read_shapes(tmp_path / "nan.npz", DOME.mesh)
    write_mesh(DOME, tmp_path / "empty" / "smile.obj")
    write_mesh(DOME, tmp_path / "empty" / "smile.ply")
    with pytest.raises(RetargetError, match="two meshes of shape 'smile'"):
        read_shapes(tmp_path / "empty", DOME.mesh)
    np.savez(tmp_path / "none.npz")
    with pytest.raises(RetargetError, match="holds no arrays"):
        read_shapes(tmp_path / "none.npz", DOME.mesh)


@pytest.mark.parametrize(("names", "said"), [(("a/b",), "cannot be a file"), (("A", "a"), "would be one file")])
def test_names_that_cannot_be_files(names: tuple[str, ...], said: str, tmp_path: Path) -> None:
    shapes = ShapeSet(names, np.zeros((len(names), 36, 3)))
    with pytest.raises(RetargetError, match=said):
        write(shapes, tmp_path / "out")
    assert not list(tmp_path.iterdir())
    write(shapes, tmp_path / "out.npz")
    assert read_shapes(tmp_path / "out.npz", DOME.mesh).names == names
