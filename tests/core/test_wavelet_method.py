"""What the wavelet method claims beside the contract: its modes, turned copies, subdivided faces, its levels."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import scipy.sparse as sp

from bench import min_jung
from facial_retarget_addon import demo
from facial_retarget_addon.core.base.base_mesh import base_mesh
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.level_retargeter import LevelRetargeter
from facial_retarget_addon.core.levels.butterfly import butterfly
from facial_retarget_addon.core.levels.normal_mesh import build_normal_mesh
from facial_retarget_addon.core.levels.subdivision import hierarchy
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.methods import hierarchical, wavelet
from facial_retarget_addon.core.methods.settings import SETTINGS, HierarchicalSettings, WaveletSettings, read_settings
from facial_retarget_addon.core.points import FeaturePoints, place_matrix
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.core.retarget import level_motions, retarget
from facial_retarget_addon.core.wavelets.lifting import wavelets
from facial_retarget_addon.core.wavelets.motion import WaveletMotion

from .test_contract import ROTATION, SHIFT, moved_face
from .test_subdivision import papers_counts


@cache
def actor() -> demo.DemoFace:
    return demo.actor(vertices=5_000)


@cache
def target() -> demo.DemoFace:
    return demo.warped_actor(np.random.default_rng(3), vertices=4_000)


def acting() -> np.ndarray:
    return actor().frames(demo.performance_table()[10:90:20])


def plain(face: Face) -> Face:
    return replace(face, examples={})


def relative(found: np.ndarray, wanted: np.ndarray, rest: np.ndarray) -> float:
    return float(np.linalg.norm(found - wanted) / np.linalg.norm(wanted - rest))


def test_the_papers_mode_is_its_own_identity() -> None:
    """T = T_0 + (S_j - S_0) + P2 P1 P0 (M^ - M): details are pasted as they are, only the base is turned and scaled."""
    rng = np.random.default_rng(1)
    faces, count = papers_counts()
    steps = hierarchy(faces, count, 3, butterfly)
    bank = wavelets(faces, count, steps)
    size = steps[-1].vertex_count
    turns = np.linalg.qr(rng.normal(size=(count, 3, 3)))[0]
    unturned = [np.broadcast_to(np.eye(3), (len(step.parents), 3, 3)) for step in steps]
    motion = WaveletMotion(sp.eye(size).tocsr(), np.zeros((size, 3)), bank, [2 * turns, *unturned])
    moved = rng.normal(size=(2, size, 3))
    for frame, found in zip(moved, motion(moved.astype(np.float32)), strict=True):
        base = bank.analyse(frame)[0]
        change = 2 * np.einsum("vij,vj->vi", turns, base) - base
        for step in steps:
            change = step.matrix @ change
        np.testing.assert_allclose(found, frame + change, atol=1e-4)


@pytest.mark.parametrize("levels", [2, 4])
def test_a_turned_and_scaled_copy_does_the_turned_and_scaled_motion(levels: int) -> None:
    source = plain(actor().face)
    copy = moved_face(source, 40.0, ROTATION, SHIFT)
    found = wavelet.fit(Problem(source, copy), WaveletSettings(levels=levels)).frames(acting())
    wanted = 40.0 * acting() @ ROTATION.T + SHIFT
    assert relative(found, wanted, copy.mesh.vertices) < 1e-5


def test_pasted_details_do_not_turn() -> None:
    """The modes differ where they should: on a turned copy only `framed` is right, on a scaled one `scaled` too."""
    source = plain(actor().face)
    errors = {}
    for kind, copy in (
        ("turned", moved_face(source, 1.0, ROTATION, SHIFT)),
        ("scaled", moved_face(source, 3.0, np.eye(3), SHIFT)),
    ):
        turn, scale = (ROTATION, 1.0) if kind == "turned" else (np.eye(3), 3.0)
        wanted = scale * acting() @ turn.T + SHIFT
        for mode in ("framed", "scaled", "paper"):
            found = wavelet.fit(Problem(source, copy), WaveletSettings(levels=3, mode=mode)).frames(acting())
            errors[kind, mode] = relative(found, wanted, copy.mesh.vertices)
    assert errors["turned", "framed"] < 1e-4
    assert errors["turned", "scaled"] > 0.02
    assert errors["scaled", "framed"] < 1e-4
    assert errors["scaled", "scaled"] < 1e-4
    assert errors["scaled", "paper"] > 0.02


@pytest.mark.parametrize("source_mesh", ["matched", "pierced"])
def test_a_face_onto_itself_is_itself(source_mesh: str) -> None:
    source = plain(actor().face)
    settings = WaveletSettings(levels=3, source_mesh=source_mesh)
    found = wavelet.fit(Problem(source, source), settings).frames(acting())
    assert relative(found, acting(), source.mesh.vertices) < 0.03


# ---- faces that are subdivided already ----------------------------------------------------------


def resampled(levels: int) -> tuple[Face, Face, np.ndarray]:
    """Actor and warped actor as meshes of subdivision connectivity on their common points, and the actor's frames."""
    one, other = plain(actor().face), plain(target().face)
    base = base_mesh(one.mesh, one.points, other.mesh, other.points)
    steps = hierarchy(base.faces, len(base.names), levels, butterfly)
    order = np.random.default_rng(0).permutation(steps[-1].vertex_count)
    rank = np.argsort(order)
    made, frames = [], np.empty(0)
    for face, moving in ((one, acting()), (other, None)):
        points = face.points.subset(base.names)
        finest = build_normal_mesh(face.mesh, points, base.loops, steps).levels[-1]
        mesh = TriMesh(finest.positions[order], rank[finest.faces])
        at = np.repeat(rank[: len(base.names)][:, None], 3, axis=1)
        made.append(Face(mesh, FeaturePoints(base.names, at, np.tile([1.0, 0, 0], (len(at), 1)))))
        if moving is not None:
            places = place_matrix(face.mesh.faces[finest.place_face], finest.place_weights, len(face.mesh.vertices))
            frames = np.stack([places @ (frame - face.mesh.vertices) + places @ face.mesh.vertices for frame in moving])
            frames = frames[:, order]
            frames += mesh.vertices - (places @ face.mesh.vertices)[order]
    return made[0], made[1], frames


def test_subdivided_faces_are_recognised_and_not_resampled() -> None:
    source, other, frames = resampled(3)
    fitted = wavelet.fit(Problem(source, other), WaveletSettings(levels=3))
    report = fitted.report
    assert report["base"]["points"] == len(source.points)
    assert [level["vertices"] for level in report["levels"]][-1] == len(source.mesh.vertices)
    assert report["matched"] == pytest.approx(1)
    assert report["subdivided"] == 3
    # The fine mesh is the artist's own, so its motion is the whole motion.
    fine, _ = fitted.detail(frames)
    found = fitted.frames(frames)
    assert np.sort(fine, axis=1) == pytest.approx(np.sort(found, axis=1), abs=1e-5 * other.mesh.size)
    moved = np.linalg.norm(found - other.mesh.vertices, axis=2).max()
    assert moved > 0.02 * other.mesh.size


def test_a_turned_copy_of_a_subdivided_face_is_exact() -> None:
    source, _, frames = resampled(2)
    copy = moved_face(source, 7.0, ROTATION, SHIFT)
    found = wavelet.fit(Problem(source, copy), WaveletSettings(levels=4)).frames(frames)
    assert relative(found, 7.0 * frames @ ROTATION.T + SHIFT, copy.mesh.vertices) < 1e-5


def test_an_artists_own_base_goes_before_recognition() -> None:
    source, other, _ = resampled(1)
    base = base_mesh(source.mesh, source.points, other.mesh, other.points)
    own = tuple((base.names[a], base.names[b], base.names[c]) for a, b, c in base.faces)
    report = wavelet.fit(Problem(source, other, own), WaveletSettings(levels=1, base_points=4)).report
    assert "subdivided" not in report
    assert report["base"]["points"] == len(source.points)


def test_the_papers_setting() -> None:
    """2964 vertices and 5760 triangles over a base of 90, with holes for mouth, eyes and nostrils; three levels."""
    faces, acting = min_jung.setting()
    for face in faces:
        assert (len(face.mesh.vertices), len(face.mesh.faces)) == (min_jung.VERTICES, min_jung.TRIANGLES)
    source, other, _ = faces
    assert len(source.mesh.boundary_loops) == 6
    report = wavelet.fit(Problem(source, other), WaveletSettings(levels=6)).report
    assert (report["base"]["points"], report["base"]["triangles"], len(report["levels"])) == (52, 90, 3)
    found = wavelet.fit(Problem(source, other), WaveletSettings()).frames(acting.astype(np.float32))
    moved = found - other.mesh.vertices
    # The corners of the mouth go up with a smile and down with a cry.
    corners = other.points.subset(["2.4", "2.5"]).positions(moved)[..., 1]
    assert (corners[0] > 0.02 * other.mesh.size).all()
    assert (corners[1] < -0.01 * other.mesh.size).all()


# ---- levels -------------------------------------------------------------------------------------


def fitted(method: str) -> LevelRetargeter:
    problem = Problem(actor().face, target().face)
    if method == "hierarchical":
        return hierarchical.fit(problem, HierarchicalSettings(levels=3))
    if method == "hierarchical paper":
        return hierarchical.fit(problem, HierarchicalSettings(levels=2, variant="paper"))
    return wavelet.fit(problem, WaveletSettings(levels=3))


@pytest.mark.parametrize("method", ["hierarchical", "hierarchical paper", "wavelet"])
def test_what_the_levels_add_is_the_whole_motion(method: str) -> None:
    retargeter = fitted(method)
    parts = retargeter.levels(acting())
    names = [part.name for part in parts]
    assert names[:3] == ["base", "level 1", "level 2"]
    assert "detail" in names
    assert ("examples" in names) == (method != "hierarchical paper")
    whole = retargeter.frames(acting()) - target().face.mesh.vertices.astype(np.float32)
    total = np.sum([part.displacements for part in parts], axis=0)
    np.testing.assert_allclose(total, whole, atol=1e-5 * target().face.mesh.size)
    # The base carries most of it.
    sizes = {part.name: float(np.linalg.norm(part.displacements)) for part in parts}
    assert sizes["base"] > 2 * sizes["level 1"] > 0


def test_gains_take_a_level_out() -> None:
    problem = Problem(plain(actor().face), plain(target().face))
    parts = wavelet.fit(problem, WaveletSettings(levels=2)).levels(acting())
    without = wavelet.fit(problem, WaveletSettings(levels=2, level_gains=(1.0, 0.0))).frames(acting())
    wanted = sum(part.displacements for part in parts if part.name != "level 2") + target().face.mesh.vertices
    np.testing.assert_allclose(without, wanted, atol=1e-5 * target().face.mesh.size)


@pytest.mark.parametrize("method", ["hierarchical", "wavelet"])
def test_one_frame_can_be_taken_apart(method: str) -> None:
    problem = Problem(plain(actor().face), plain(target().face))
    parts = level_motions(method, problem, SETTINGS[method](levels=2), acting()[1])
    assert [part.name for part in parts] == ["base", "level 1", "level 2", "detail"]
    assert parts[0].displacements.shape == (1, *target().face.mesh.vertices.shape)


def test_methods_without_levels_say_so() -> None:
    problem = Problem(plain(actor().face), plain(target().face))
    with pytest.raises(RetargetError, match="'feature_points' has no levels, expected one of hierarchical, wavelet"):
        level_motions("feature_points", problem, SETTINGS["feature_points"](), acting()[0])


# ---- bad input ----------------------------------------------------------------------------------


def test_too_many_levels_are_refused_before_anything_is_made() -> None:
    problem = Problem(plain(actor().face), plain(target().face))
    with pytest.raises(RetargetError, match="level 9 over a base of 500 points"):
        retarget("wavelet", problem, WaveletSettings(levels=9, base_points=500), acting())


@pytest.mark.parametrize(
    ("name", "value", "expected"),
    [
        ("mode", "magic", "one of framed, scaled, paper"),
        ("lifting", "lazy", "one of disc, integral"),
        ("disc", 9, "a whole number from 0 to 3"),
        ("source_mesh", 1, "one of matched, pierced"),
    ],
)
def test_settings_are_checked(name: str, value: object, expected: str) -> None:
    with pytest.raises(RetargetError, match=f"{name} = .*expected {expected}"):
        read_settings("wavelet", {name: value})


def test_too_few_points_are_named() -> None:
    source, other = plain(actor().face), plain(target().face)
    few = [replace(face, points=face.points.subset(source.points.names[:6])) for face in (source, other)]
    with pytest.raises(RetargetError, match=r"6 feature points in common"):
        retarget("wavelet", Problem(*few), WaveletSettings(), acting())
