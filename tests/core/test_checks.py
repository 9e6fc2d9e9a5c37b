"""Checks: what breaks a method is a fault, what it survives a warning, and a sound problem has neither."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from facial_retarget_addon.core.checks import faults, warnings
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.methods.settings import HierarchicalSettings
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.core.problem import Face, Problem

SETTINGS = HierarchicalSettings(levels=2)


def sheet(side: int) -> Face:
    """A bulging sheet with 36 points and two examples, looking along +Z."""
    x, y = np.meshgrid(np.linspace(-1, 1, side), np.linspace(-1, 1, side))
    vertices = np.stack([x, y, 1 - 0.4 * (x**2 + y**2)], axis=-1).reshape(-1, 3)
    grid = np.arange(side * side).reshape(side, side)
    a, b, c, d = grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]
    faces = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    at = np.linspace(0, side - 1, 6).astype(int)
    held = (at[:, None] * side + at).ravel()
    points = FeaturePoints(
        tuple(f"p{i}" for i in range(36)), np.repeat(held[:, None], 3, axis=1), np.tile([1.0, 0, 0], (36, 1))
    )
    mesh = TriMesh(vertices, faces)
    return Face(mesh, points, {"joy": bump(mesh, -0.3), "anger": bump(mesh, 0.3)})


def bump(mesh: TriMesh, place: float) -> np.ndarray:
    moved = mesh.vertices.copy()
    moved[:, 2] += 0.1 * np.exp(-10 * ((moved[:, 0] - place) ** 2 + moved[:, 1] ** 2))
    return moved


@pytest.fixture
def problem() -> Problem:
    return Problem(sheet(21), sheet(16))


@pytest.fixture
def frames(problem) -> np.ndarray:
    return np.stack([problem.source.mesh.vertices, bump(problem.source.mesh, 0.0)]).astype(np.float32)


def with_faces(face: Face, faces: np.ndarray) -> Face:
    return replace(face, mesh=TriMesh(face.mesh.vertices, faces))


def with_vertices(face: Face, change: Callable[[np.ndarray], None]) -> Face:
    vertices = face.mesh.vertices.copy()
    change(vertices)
    return replace(face, mesh=face.mesh.with_vertices(vertices), examples={})


def with_points(face: Face, points: FeaturePoints) -> Face:
    return replace(face, points=points)


def with_eye(mesh: TriMesh) -> TriMesh:
    """The mesh and a triangle of its own beside it."""
    eye = np.array([[5.0, 0, 0], [5.1, 0, 0], [5, 0.1, 0]])
    corners = np.arange(3)[None] + len(mesh.vertices)
    return TriMesh(np.concatenate([mesh.vertices, eye]), np.concatenate([mesh.faces, corners]))


def one(found: list[str]) -> str:
    assert len(found) == 1, found
    return found[0]


def test_a_sound_problem(problem, frames):
    assert faults(problem, frames, SETTINGS) == []
    assert faults(problem, None, SETTINGS) == []
    assert warnings(problem, frames, SETTINGS) == []


# ---- meshes -------------------------------------------------------------------------------------
@pytest.mark.parametrize("count", [3, 40])
def test_bad_faces_are_a_fault_when_they_are_many_and_a_warning_when_they_are_few(problem, frames, count):
    faces = problem.target.mesh.faces.copy()
    few = count < 4.5
    turned = faces.copy()
    turned[:count] = turned[:count, ::-1]
    double = np.concatenate([faces, faces[: (count + 3) // 4]])
    for bad, what in ((turned, "are flipped against their neighbours"), (double, "edges of more than two faces")):
        changed = replace(problem, target=with_faces(problem.target, bad))
        found = warnings(changed, frames, SETTINGS) if few else faults(changed, frames, SETTINGS)
        assert what in one(found)
        assert (faults(changed, frames, SETTINGS) == []) == few


@pytest.mark.parametrize(("stretch", "few"), [(2, True), (12, False)])
def test_faces_without_area(problem, frames, stretch, few):
    def collapse(vertices: np.ndarray) -> None:
        vertices[34 : 34 + stretch] = vertices[34]

    changed = Problem(replace(problem.source, examples={}), with_vertices(problem.target, collapse))
    found = warnings(changed, frames, SETTINGS) if few else faults(changed, frames, SETTINGS)
    assert any("have no area" in text for text in found)
    assert (faults(changed, frames, SETTINGS) == []) == few


def test_faces_that_are_flipped_among_flipped_ones_are_sound(problem, frames):
    """A ring of flipped faces is counted, and not what it encloses."""
    face = problem.target
    middle = face.mesh.vertices[face.mesh.faces].mean(axis=1)[:, :2]
    radius = np.linalg.norm(middle, axis=1)
    ring = (radius > 0.4) & (radius < 0.7)
    faces = face.mesh.faces.copy()
    faces[ring] = faces[ring, ::-1]
    text = one(faults(replace(problem, target=with_faces(face, faces)), frames, SETTINGS))
    assert f"target: {ring.sum()} of {len(faces)} faces are flipped" in text


def test_a_mesh_that_is_inside_out(problem, frames):
    changed = replace(problem, source=with_faces(problem.source, problem.source.mesh.faces[:, ::-1]))
    assert "source: the faces look inwards" in one(faults(changed, frames, SETTINGS))


def test_what_is_wrong_with_the_eyes_is_nobodys_business(problem, frames):
    """Bad faces count only on the component that holds the points."""
    face = problem.target
    eye = np.array([[5.0, 0, 0], [5, 1, 0], [5, 0, 0], [5, 0, 1]])
    first = len(face.mesh.vertices)
    corners = np.array([[0, 1, 2], [0, 1, 3], [1, 0, 3], [0, 1, 2]]) + first
    mesh = TriMesh(np.concatenate([face.mesh.vertices, eye]), np.concatenate([face.mesh.faces, corners]))
    changed = Problem(replace(problem.source, examples={}), Face(mesh, face.points))
    assert faults(changed, frames, SETTINGS) == []
    assert warnings(changed, frames, SETTINGS) == []


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_vertex_that_is_not_finite(problem, frames, value):
    def spoil(vertices: np.ndarray) -> None:
        vertices[9, 1] = value

    changed = Problem(replace(problem.source, examples={}), with_vertices(problem.target, spoil))
    assert "target neutral has 1 vertices that are NaN or infinite, the first is vertex 9" in one(
        faults(changed, frames, SETTINGS)
    )


def test_an_empty_mesh_and_a_face_index_out_of_range(problem, frames):
    empty = replace(problem, target=with_faces(problem.target, np.empty((0, 3), np.int64)))
    assert "0 faces" in one(faults(empty, frames, SETTINGS))
    beyond = replace(problem, target=with_faces(problem.target, np.array([[0, 1, 256]])))
    assert "vertex 256, expected 0 to 255" in one(faults(beyond, frames, SETTINGS))


# ---- points -------------------------------------------------------------------------------------
def test_points_on_another_component(problem, frames):
    face = problem.source
    stray = FeaturePoints(("pupil",), np.full((1, 3), len(face.mesh.vertices)), np.array([[1.0, 0, 0]]))
    source = Face(with_eye(face.mesh), face.points.joined(stray))
    changed = Problem(source, replace(problem.target, examples={}))
    assert "source: points pupil lie on another part" in one(faults(changed, None, SETTINGS))


def test_points_of_eyes_tongue_and_teeth_may_lie_on_parts_of_their_own(problem: Problem) -> None:
    face = problem.source
    for name in ("3.5", "6.1", "9.10"):
        own = FeaturePoints((name,), np.full((1, 3), len(face.mesh.vertices)), np.array([[1.0, 0, 0]]))
        changed = replace(problem, source=Face(with_eye(face.mesh), face.points.joined(own)))
        assert not [fault for fault in faults(changed, None, SETTINGS) if "another part" in fault]


@pytest.mark.parametrize(
    ("named", "expected"),
    [
        ({"teef": [256]}, "target: a part is named 'teef', expected one of left eyeball"),
        ({"tongue": [259]}, "target: part 'tongue' has vertices that the 259 do not include"),
        ({"tongue": [-1]}, "target: part 'tongue' has vertices that the 259 do not include"),
        ({"tongue": []}, "target: part 'tongue' has float64 (0,), expected a list of vertices"),
        ({"tongue": [257.0]}, "target: part 'tongue' has float64 (1,), expected a list of vertices"),
        ({"tongue": [257, 3]}, "target: part 'tongue' and the skin are one connected piece, expected separate ones"),
        ({"tongue": [257], "still": [256]}, "target: part 'still' and tongue are one connected piece"),
    ],
)
def test_named_parts(problem: Problem, named: dict[str, list[float]], expected: str) -> None:
    face = problem.target
    parts = {name: np.array(vertices) for name, vertices in named.items()}
    with_part = Face(with_eye(face.mesh), face.points, named_parts=parts)
    changed = Problem(replace(problem.source, examples={}), with_part)
    assert expected in one(faults(changed, None, SETTINGS))
    sound = replace(with_part, named_parts={"tongue": np.array([257])})
    assert not faults(replace(changed, target=sound), None, SETTINGS)


def test_points_in_one_place(problem, frames):
    held = problem.target.points.vertices[4, 0]
    twin = FeaturePoints(("twin",), np.array([[0, held, 1]]), np.array([[0.0, 1.0, 0.0]]))
    changed = replace(problem, target=with_points(problem.target, problem.target.points.joined(twin)))
    assert "target: points p4 and twin lie in the same place" in one(faults(changed, frames, SETTINGS))


def test_points_beyond_the_vertices(problem, frames):
    far = FeaturePoints(("far",), np.full((1, 3), 10_000), np.array([[1.0, 0, 0]]))
    changed = replace(problem, target=with_points(problem.target, problem.target.points.joined(far)))
    assert "target points far lie on vertices" in one(faults(changed, frames, SETTINGS))


def test_too_few_common_points_unless_there_is_a_base(problem, frames):
    few = problem.target.points.subset([f"p{i}" for i in range(10)])
    changed = replace(problem, target=with_points(problem.target, few))
    assert "10 feature points in common (of 36 and 10), expected at least 30" in one(faults(changed, frames, SETTINGS))
    assert faults(replace(changed, base=(("p0", "p1", "p7"),)), frames, SETTINGS) == []
    text = one(faults(replace(changed, base=(("p0", "p1", "p35"),)), frames, SETTINGS))
    assert "the target lacks: p35" in text


def test_names_on_one_side_only(problem, frames):
    some = problem.target.points.subset([f"p{i}" for i in range(33)])
    changed = replace(problem, target=with_points(problem.target, some))
    assert "only the source has are not used: p33, p34, p35" in one(warnings(changed, frames, SETTINGS))


# ---- examples -----------------------------------------------------------------------------------
def examples(problem: Problem, source: dict, target: dict) -> Problem:
    return Problem(replace(problem.source, examples=source), replace(problem.target, examples=target))


def test_an_example_on_one_side_only(problem, frames):
    changed = examples(problem, {}, dict(problem.target.examples))
    found = faults(changed, frames, SETTINGS)
    assert found == ["example 'joy' is missing on the source", "example 'anger' is missing on the source"]


def test_an_example_of_another_vertex_count_or_not_finite(problem, frames):
    bad = problem.target.examples["joy"].copy()
    bad[3] = np.nan
    changed = examples(problem, dict(problem.source.examples), {"joy": bad, "anger": np.zeros((5, 3))})
    found = faults(changed, frames, SETTINGS)
    assert len(found) == 2
    assert "example 'joy' of the target has 1 vertices that are NaN or infinite, the first is vertex 3" in found
    assert "(5, 3), expected (256, 3)" in found[1]


def test_identical_examples(problem, frames):
    source, target = dict(problem.source.examples), dict(problem.target.examples)
    text = one(faults(examples(problem, source | {"anger": source["joy"]}, target), frames, SETTINGS))
    assert "'joy' and 'anger' are identical on the source" in text
    same_target = examples(problem, source, target | {"anger": target["joy"]})
    assert faults(same_target, frames, SETTINGS) == []
    assert "identical on the target" in one(warnings(same_target, frames, SETTINGS))


def test_only_the_neutral_example_may_be_neutral(problem, frames):
    source, target = dict(problem.source.examples), dict(problem.target.examples)
    still = problem.source.mesh.vertices
    sound = examples(problem, source | {"neutral": still}, target | {"neutral": problem.target.mesh.vertices})
    assert faults(sound, frames, SETTINGS) == []
    vain = examples(problem, source | {"fear": still}, target | {"fear": target["joy"] * 1.1})
    assert "'fear' does not move the source" in one(faults(vain, frames, SETTINGS))


# ---- levels and frames --------------------------------------------------------------------------
def test_a_huge_level(problem, frames):
    text = one(faults(problem, frames, HierarchicalSettings(levels=12)))
    assert "level 12" in text
    assert "expected at most 5,000,000; use fewer levels" in text
    assert faults(problem, frames, HierarchicalSettings(levels=6)) == []


def test_frames_of_another_vertex_count(problem):
    text = one(faults(problem, np.zeros((4, 7, 3)), SETTINGS))
    assert "(4, 7, 3), expected (frames, 441, 3)" in text


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_frame_that_is_not_finite(problem, frames, value):
    many = np.repeat(frames, 20, axis=0)
    many[33, 5, 2] = value
    text = one(faults(problem, many, SETTINGS))
    assert "source frame 34 of 40" in text
    assert "vertex 5" in text


def turned(vertices: np.ndarray, angle: float) -> np.ndarray:
    turn = np.array([[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]])
    return vertices @ turn.T + [0, angle, 0]


def test_a_source_that_moves_rigidly(problem, frames):
    neutral = problem.source.mesh.vertices
    nodding = np.stack([turned(neutral, angle) for angle in (0, 0.1, 1.0, 3.0)]).astype(np.float32)
    assert "the source moves rigidly" in one(faults(problem, nodding, SETTINGS))
    acting = np.concatenate([nodding, [turned(bump(problem.source.mesh, 0.0), 0.5)]])
    assert faults(problem, acting, SETTINGS) == []


def test_eyes_that_turn_in_a_rigid_head_are_not_acting(problem):
    """The skin decides: what other components do is no expression of the face."""
    face = problem.source
    mesh = with_eye(face.mesh)
    moved = np.concatenate([turned(face.mesh.vertices, 0.3), mesh.vertices[-3:] + 1])
    changed = Problem(Face(mesh, face.points), replace(problem.target, examples={}))
    assert "the source moves rigidly" in one(faults(changed, moved[None], SETTINGS))


def test_a_source_that_does_not_move(problem, frames):
    still = np.repeat(frames[:1], 3, axis=0)
    assert faults(problem, still, SETTINGS) == []
    assert "the source does not move" in one(warnings(problem, still, SETTINGS))


def test_everything_at_once(problem):
    source = with_faces(problem.source, problem.source.mesh.faces[:, ::-1])
    changed = Problem(source, with_points(problem.target, problem.target.points.subset(["p0"])))
    found = faults(changed, np.zeros((1, 2, 3)), HierarchicalSettings(levels=20))
    assert len(found) == 4


def test_the_shared_faces_have_no_fault(shared_data):
    """Real heads: a few bad faces of one of them are warnings."""
    from facial_retarget_addon.files.meshes import read_mesh
    from facial_retarget_addon.files.points import read_points

    faces = {}
    files = {"ict": "ict_dev", "makehuman": "makehuman_dev", "male_adult_08": "male_adult_08"}
    files["johnsmith"] = "johnsmith_welded"
    for name, file in files.items():
        mesh = read_mesh(shared_data / f"{file}.npz").mesh
        faces[name] = Face(mesh, read_points(shared_data / f"{name}_points.json", mesh))
    for name, face in faces.items():
        assert faults(Problem(faces["ict"], face), None, SETTINGS) == []
        expected = 2 if name == "johnsmith" else 0
        assert len(warnings(Problem(faces["ict"], face), None, SETTINGS)) == expected
