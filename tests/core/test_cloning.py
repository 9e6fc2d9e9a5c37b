"""Facial motion cloning: the units of regions, the plane, interpolation over it, and the method as a whole."""

from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.cloning.alignment import align
from facial_retarget_addon.core.cloning.cylinder import MOUTH_ANGLE, Cylinder, Unrolled
from facial_retarget_addon.core.cloning.interpolation import least_excess, outermost
from facial_retarget_addon.core.cloning.lip_regions import lip_outlines, lip_regions
from facial_retarget_addon.core.cloning.normalisation import vertex_lengths
from facial_retarget_addon.core.cloning.plane_map import plane_map
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.methods import motion_cloning
from facial_retarget_addon.core.methods.settings import MotionCloningSettings
from facial_retarget_addon.core.mpeg4.fapu import measure_fapu
from facial_retarget_addon.core.mpeg4.head import head_axes
from facial_retarget_addon.core.mpeg4.mean_face import place_missing
from facial_retarget_addon.core.mpeg4.regions import OWN_PARTS, point_lengths
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.core.raycast import EmbreeCaster
from facial_retarget_addon.files.points import read_points

TURN = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])

ICT_FACE = 9409
"""The first vertices of an ICT head are its face and neck; then come eyes, teeth and the inside of the mouth."""


@pytest.fixture(scope="module")
def actor() -> demo.DemoFace:
    return demo.actor(vertices=5_000)


@pytest.fixture(scope="module")
def other() -> Face:
    return demo.warped_actor(np.random.default_rng(3), vertices=4_000).face


def skin_points(face: Face) -> FeaturePoints:
    return face.points.subset([name for name in face.points.names if name not in OWN_PARTS])


def cylinder_of(names: tuple[str, ...], positions: np.ndarray) -> Cylinder:
    axes = head_axes(names, positions)
    return Cylinder(names, positions, axes, measure_fapu(names, positions, axes))


# ---- units of regions ---------------------------------------------------------------------------


def test_units_of_a_vertex_lie_between_those_of_the_points() -> None:
    rng = np.random.default_rng(0)
    positions, lengths, vertices = rng.normal(size=(9, 3)), rng.uniform(1, 4, (9, 3)), rng.normal(size=(200, 3))
    found = vertex_lengths(vertices, positions, lengths)
    assert (found >= lengths.min(axis=0)).all()
    assert (found <= lengths.max(axis=0)).all()
    np.testing.assert_allclose(vertex_lengths(positions, positions, lengths), lengths, rtol=1e-6)
    np.testing.assert_allclose(vertex_lengths(vertices, positions, np.ones((9, 3))), 1.0)


def test_units_jump_where_regions_meet_in_the_paper_only() -> None:
    positions, lengths = np.array([[-1.0, 0, 0], [1.0, 0, 0]]), np.array([[1.0] * 3, [4.0] * 3])
    beside = np.array([[-1e-4, 0.3, 0], [1e-4, 0.3, 0]])
    np.testing.assert_array_equal(vertex_lengths(beside, positions, lengths, smooth=False), lengths)
    assert np.ptp(vertex_lengths(beside, positions, lengths), axis=0).max() < 1e-2


# ---- the plane ----------------------------------------------------------------------------------


@pytest.mark.parametrize("width", [0.7, 1.0, 1.5])
def test_every_mouth_is_as_wide_and_every_nose_points_to_zero(actor: demo.DemoFace, width: float) -> None:
    names = actor.face.points.names
    positions = actor.face.points.positions(actor.face.mesh.vertices) * (width, 1, 1)
    unrolled = cylinder_of(names, positions).unroll(positions)
    where = dict(zip(names, unrolled.plane, strict=True))
    assert where["8.3"][0] - where["8.4"][0] == pytest.approx(MOUTH_ANGLE, rel=1e-3)
    np.testing.assert_allclose(where["9.3"], 0.0, atol=1e-12)
    assert where["4.3"][1] > 0 > where["2.1"][1]
    assert (unrolled.radius > 0).all()


def test_place_size_and_turn_do_not_matter_to_the_plane(actor: demo.DemoFace) -> None:
    names, positions = actor.face.points.names, actor.face.points.positions(actor.face.mesh.vertices)
    moved = 30.0 * positions @ TURN.T + (5.0, -6.0, 7.0)
    wanted = cylinder_of(names, positions).unroll(positions)
    found = cylinder_of(names, moved).unroll(moved)
    np.testing.assert_allclose(found.plane, wanted.plane, atol=1e-9)
    np.testing.assert_allclose(found.radius, wanted.radius, atol=1e-9)


# ---- interpolation ------------------------------------------------------------------------------


def test_the_outermost_of_overlapping_triangles_counts() -> None:
    square = np.array([[0.0, 0], [1, 0], [0, 1]])
    faces = np.array([[0, 1, 2], [3, 4, 5], [6, 7, 8]])
    layers = Unrolled(np.tile(square, (3, 1)), np.repeat([1.0, 3.0, 2.0], 3))
    places = np.array([[0.2, 0.3], [0.6, 0.1], [2.0, 2.0]])
    face, weights = outermost(places, layers, faces, EmbreeCaster)
    assert face.tolist() == [1, 1, -1]
    np.testing.assert_allclose(weights[:2] @ square, places[:2], atol=1e-6)


def test_least_excess_is_what_trying_every_triangle_gives() -> None:
    rng = np.random.default_rng(1)
    corners, places = rng.normal(size=(12, 3, 2)), 2 * rng.normal(size=(60, 2))
    corners[4] = corners[4, :1]
    face, weights = least_excess(places, corners)
    kept = [k for k in range(12) if k != 4]
    full = np.stack(
        [np.linalg.solve(np.vstack([corners[k].T, np.ones(3)]), np.vstack([places.T, np.ones(60)])).T for k in kept]
    )
    excess = (np.maximum(-full, 0) + np.maximum(full - 1, 0)).sum(axis=2)
    np.testing.assert_allclose(excess[[kept.index(k) for k in face], np.arange(60)], excess.min(axis=0), atol=1e-9)
    np.testing.assert_allclose(weights.sum(axis=1), 1.0)
    assert weights.min() >= 0
    inside = excess.min(axis=0) < 1e-9
    assert inside.any()
    np.testing.assert_allclose(np.einsum("nk,nkc->nc", weights, corners[face])[inside], places[inside], atol=1e-9)


def test_points_land_on_those_of_the_other_face(actor: demo.DemoFace, other: Face) -> None:
    marks = []
    names = skin_points(actor.face).names
    for face in (actor.face, other):
        positions = face.points.subset(names).positions(face.mesh.vertices)
        marks.append(cylinder_of(names, positions).unroll(positions).plane)
    away = np.abs(marks[1] - marks[0]).max()
    pulled = align(names, marks[1], marks[0], marks[1])
    missed = np.abs(pulled - marks[0]).max(axis=1)
    assert np.quantile(missed, 0.9) < 1e-9
    assert missed.max() < away


def test_points_above_one_another_are_refused() -> None:
    line = np.array([[0.0, 0], [0, 1], [0, 2], [0, 3]])
    with pytest.raises(RetargetError, match="4 feature points of both faces span no triangle"):
        align(("2.1", "2.2", "9.3", "11.1"), line, line, line)


def lips_of(face: Face, places: np.ndarray) -> np.ndarray:
    positions = face.points.positions(face.mesh.vertices)
    cylinder = cylinder_of(face.points.names, positions)
    upper, lower = (
        np.array(list(place_missing(face.points.names, positions, outline).values()))
        for outline in lip_outlines(face.points.names)
    )
    return lip_regions(cylinder.unroll(upper).plane, cylinder.unroll(lower).plane, cylinder.unroll(places).plane)


def test_the_sides_of_the_chin_are_used_where_they_are() -> None:
    assert lip_outlines(("2.1", "2.11", "2.12"))[1][-2:] == ("2.12", "2.11")
    assert lip_outlines(("2.1", "2.11"))[1][-3:] == ("2.14", "2.1", "2.13")


def test_lips_are_told_apart(actor: demo.DemoFace) -> None:
    points = actor.face.points
    where = dict(zip(points.names, points.positions(actor.face.mesh.vertices), strict=True))
    up, down = 0.5 * (where["8.1"] + where["2.2"]), 0.5 * (where["8.2"] + where["2.3"])
    found = lips_of(actor.face, np.stack([up, down, where["4.3"], where["5.1"], where["11.1"]]))
    assert found.tolist() == [1, -1, 0, 0, 0]


def test_rounding_does_not_decide_between_lips(other: Face) -> None:
    mesh = other.mesh
    turned = Face(mesh.with_vertices(0.02 * mesh.vertices @ TURN.T + (3.0, -20.0, 7.0)), other.points)
    np.testing.assert_array_equal(lips_of(turned, turned.mesh.vertices), lips_of(other, mesh.vertices))


def test_the_plane_map_keeps_lips_apart_and_means(actor: demo.DemoFace) -> None:
    mesh, points = actor.face.mesh, skin_points(actor.face)
    cylinder = cylinder_of(points.names, points.positions(mesh.vertices))
    matrix = plane_map((mesh, mesh), (points, points), (cylinder, cylinder), EmbreeCaster)
    skin = mesh.components == mesh.components[points.vertices[0, 0]]
    np.testing.assert_allclose(np.asarray(matrix.sum(axis=1)).ravel(), skin.astype(float), atol=1e-9)
    assert matrix.data.min() >= -1e-6
    lips = lips_of(actor.face, mesh.vertices)
    for lip in (-1, 1):
        assert (skin & (lips == lip)).sum() > 20
        assert matrix[skin & (lips == lip)][:, lips == -lip].nnz == 0


# ---- the method ---------------------------------------------------------------------------------


def fapu_motion(face: Face, names: list[str], frames: np.ndarray) -> np.ndarray:
    """Motion of points (F, P, 3) in the axes and units of their own face."""
    points, all_points = face.points.subset(names), face.points
    rest, places = points.positions(face.mesh.vertices), all_points.positions(face.mesh.vertices)
    axes = head_axes(all_points.names, places)
    lengths = point_lengths(names, rest, [measure_fapu(all_points.names, places, axes)])[0]
    return np.stack([points.positions(frame) - rest for frame in frames.astype(float)]) @ axes.T / lengths


@pytest.mark.parametrize(("variant", "tolerance"), [("default", 0.01), ("paper", 0.3)])
def test_points_move_alike_in_the_units_of_each_face(
    actor: demo.DemoFace, other: Face, variant: str, tolerance: float
) -> None:
    frames = actor.frames(demo.performance_table()[10:90:20])
    settings = MotionCloningSettings("compliant", variant, example_strength=0.0)
    fitted = motion_cloning.fit(Problem(actor.face, other), settings)
    names = [name for name in skin_points(actor.face).names if name in skin_points(other).names]
    wanted = fapu_motion(actor.face, names, frames)
    found = fapu_motion(other, names, fitted.frames(frames))
    assert np.linalg.norm(found - wanted) <= tolerance * np.linalg.norm(wanted)


def test_motions_add_up(actor: demo.DemoFace, other: Face) -> None:
    rest = actor.face.mesh.vertices
    one, two = actor.frames(demo.performance_table()[[20, 60]]) - rest
    fitted = motion_cloning.fit(Problem(actor.face, other), MotionCloningSettings(example_strength=0.0))
    neutral = other.mesh.vertices
    first, second, both = fitted.frames(np.stack([rest + one, rest + two, rest + one + two])) - neutral
    np.testing.assert_allclose(both, first + second, atol=1e-5 * other.mesh.size)


def test_a_real_pair_is_cloned(shared_data: Path) -> None:
    pair = np.load(shared_data / "pair_ict_id02_to_id04_decim.npz")
    source, target = (TriMesh(pair[f"{k}_vertices"], pair[f"{k}_tris"]) for k in ("src", "tgt"))
    faces = [
        Face(mesh, read_points(shared_data / f"pair_{which}_points.json", mesh))
        for mesh, which in ((source, "source"), (target, "target"))
    ]
    frames = pair["src_vertices"] + pair["src_expr_delta"]
    face = pair["src_tris"][pair["corr_src_face"]].max(axis=1) < ICT_FACE
    wanted = pair["gt_expr_delta"][:, face]

    def errors(settings: MotionCloningSettings) -> np.ndarray:
        found = motion_cloning.fit(Problem(*faces), settings).frames(frames)[:, face] - target.vertices[face]
        return np.linalg.norm(found - wanted, axis=(1, 2)) / np.linalg.norm(wanted, axis=(1, 2))

    ours, paper = errors(MotionCloningSettings()), errors(MotionCloningSettings(variant="paper"))
    assert np.median(ours) <= 0.11
    assert np.quantile(ours, 0.9) <= 0.13
    assert np.median(ours) <= 0.6 * np.median(paper)
