"""Feature points and base meshes on disk."""

from __future__ import annotations

import json

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.files.base_mesh import read_base_mesh, write_base_mesh
from facial_retarget_addon.files.points import read_points, write_points

from .conftest import dome

MESH = dome(7).mesh


@pytest.fixture
def place(tmp_path):
    """Writes a points file with one place and reads it."""

    def read(text: str, name: str = "a"):
        path = tmp_path / "points.json"
        path.write_text(f'{{"format": "facial-retarget/feature-points", "version": 1, "points": {{"{name}": {text}}}}}')
        return read_points(path, MESH)

    return read


def test_writing_and_reading_gives_the_same_points(tmp_path):
    rng = np.random.default_rng(1)
    weights = rng.dirichlet([1, 1, 1], 20)
    points = FeaturePoints(tuple(f"ü{i}.{i}" for i in range(20)), MESH.faces[rng.integers(0, 72, 20)], weights)
    write_points(points, tmp_path / "points.json")
    again = read_points(tmp_path / "points.json", MESH)
    assert again.names == points.names
    np.testing.assert_array_equal(again.vertices, points.vertices)
    np.testing.assert_allclose(again.weights, points.weights, rtol=1e-15)


def test_a_point_on_a_vertex_is_written_as_one(tmp_path):
    points = FeaturePoints(("a",), np.array([[3, 4, 5]]), np.array([[0.0, 1.0, 0.0]]))
    write_points(points, tmp_path / "points.json")
    assert json.loads((tmp_path / "points.json").read_text())["points"] == {"a": {"vertex": 4}}
    again = read_points(tmp_path / "points.json", MESH)
    np.testing.assert_array_equal(again.positions(MESH.vertices), points.positions(MESH.vertices))


def test_points_of_another_mesh_are_refused(tmp_path):
    points = FeaturePoints(("a",), np.array([[3, 4, 5]]), np.array([[0.0, 1.0, 0.0]]))
    path = tmp_path / "points.json"
    write_points(points, path, len(MESH.vertices))
    assert read_points(path, MESH).vertices.tolist() == [[4, 4, 4]]
    with pytest.raises(RetargetError, match=r"points.json: its points lie on a mesh of 49 vertices, .* has 64"):
        read_points(path, dome(8).mesh)


def test_a_position_is_snapped_to_the_surface(place):
    above = MESH.vertices[MESH.faces[20]].mean(axis=0)
    points = place(json.dumps({"position": (above + 0.05 * MESH.face_normals[20]).tolist()}))
    np.testing.assert_allclose(points.positions(MESH.vertices)[0], above, atol=1e-9)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('{"vertex": 49}', "expected vertices from 0 to 48"),
        ('{"vertex": -1}', "expected vertices from 0 to 48"),
        ('{"vertex": 1.0}', "expected a whole number"),
        ('{"vertex": true}', "expected a whole number"),
        ('{"vertex": 1, "weight": 2}', "weight is unknown"),
        ('{"vertex": 1, "position": [0, 0, 0]}', "position is unknown"),
        ('{"vertices": [0, 1, 2]}', "weights is missing"),
        ('{"vertices": [0, 1], "weights": [0.5, 0.5, 0]}', "expected vertices"),
        ('{"vertices": [0, 1, 99], "weights": [0.5, 0.5, 0]}', "expected vertices"),
        ('{"vertices": [0, 1, 2], "weights": [0.5, 0.5, 0.5]}', "the sum 1.5"),
        ('{"vertices": [0, 1, 2], "weights": [1.5, -0.5, 0]}', "none below 0"),
        ('{"vertices": [0, 1, 2], "weights": [NaN, 0, 1]}', "NaN is no number"),
        ('{"vertices": [0, 1, 2], "weights": [1e999, 0, 1]}', "three finite numbers"),
        ('{"position": [0, 0]}', "three finite numbers"),
        ('{"position": [0, 0, 9]}', "away from the surface"),
        ('{"position": "here"}', "expected a list"),
        ("{}", "has no place"),
        ("[1]", "expected a table"),
        ('{"vertex": 1}, "a": {"vertex": 2}', "'a' appears twice"),
    ],
)
def test_a_place_that_is_wrong(place, text, expected):
    with pytest.raises(RetargetError, match=r"points.json") as error:
        place(text)
    assert expected in str(error.value)


@pytest.mark.parametrize("name", ["", "  ", "\\u0007", "\\ud800"])
def test_a_name_that_nobody_can_read(place, name):
    with pytest.raises(RetargetError, match="expected a readable name"):
        place('{"vertex": 1}', name)


@pytest.mark.parametrize(
    "text", ["[]", "{}", '{"format": "x", "version": 1, "points": {}}', '{"format": "facial-retarget/feature-points"}']
)
def test_another_document(tmp_path, text):
    (tmp_path / "points.json").write_text(text)
    with pytest.raises(RetargetError, match="expected"):
        read_points(tmp_path / "points.json", MESH)


def test_a_long_list_of_faults_is_cut(tmp_path):
    path = tmp_path / "points.json"
    points = {f"p{i}": {"vertex": 1000 + i} for i in range(30)}
    path.write_text(json.dumps({"format": "facial-retarget/feature-points", "version": 1, "points": points}))
    with pytest.raises(RetargetError, match="and 18 more"):
        read_points(path, MESH)


def test_a_base_mesh_comes_back(tmp_path):
    base = (("2.1", "2.10", "8.2"), ("2.1", "8.2", "ü"))
    write_base_mesh(base, tmp_path / "base.json")
    assert read_base_mesh(tmp_path / "base.json") == base


@pytest.mark.parametrize(
    ("triangles", "expected"),
    [
        ([], "there are no triangles"),
        ([["a", "b"]], "triangle 1"),
        ([["a", "b", "c"], ["a", "b", "a"]], "triangle 2"),
        ([["a", "b", 3]], "three different point names"),
        ("abc", "expected a list"),
    ],
)
def test_a_base_mesh_that_is_wrong(tmp_path, triangles, expected):
    path = tmp_path / "base.json"
    path.write_text(json.dumps({"format": "facial-retarget/base-mesh", "version": 1, "triangles": triangles}))
    with pytest.raises(RetargetError) as error:
        read_base_mesh(path)
    assert expected in str(error.value)
