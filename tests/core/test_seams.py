"""Lids and lips: margins with guides, lids that close as far as the source's, gaps, folds, and coarse sources."""

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.acting.eyeballs import EYES
from facial_retarget_addon.core.defects import Defects
from facial_retarget_addon.core.matching.coarse_source import smooth_coarse_source
from facial_retarget_addon.core.matching.correspondence import correspond
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.methods import motion_cloning
from facial_retarget_addon.core.methods.base import fit
from facial_retarget_addon.core.methods.settings import SETTINGS, MotionCloningSettings
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.core.seams.gaps import GAPES, SeamGaps
from facial_retarget_addon.core.seams.lids import GUIDES, LidSeams, find_eye_margins
from facial_retarget_addon.core.seams.margins import on_rim
from facial_retarget_addon.core.unfolding import Unfolding


@pytest.fixture(scope="module")
def actor() -> demo.DemoFace:
    return demo.actor(vertices=6_000)


@pytest.fixture(scope="module")
def child() -> Face:
    """A head whose eyes are half as open again as the actor's, for its size."""
    actor = demo.actor(vertices=5_000).face
    places = actor.points.positions(actor.mesh.vertices)
    moved = actor.mesh.vertices.copy()
    for names in EYES.values():
        upper, lower = (places[actor.points.names.index(name)] for name in names[:2])
        middle, half = 0.5 * (upper + lower), 0.5 * np.linalg.norm(upper - lower)
        away = moved - middle
        near = np.exp(-0.5 * np.square(np.linalg.norm(away * (0.4, 1, 0.4), axis=1) / (2 * half)) ** 2)
        moved[:, 1] += 0.5 * near * away[:, 1]
    return Face(actor.mesh.with_vertices(1.7 * moved), actor.points)


def blink(actor: demo.DemoFace, share: float = 1.0) -> np.ndarray:
    return actor.frames(demo.contractions({"blink": share}))


# ---- margins ------------------------------------------------------------------------------------


def test_guides_stand_on_the_margins_from_corner_to_corner(actor: demo.DemoFace) -> None:
    mesh, points = actor.face.mesh, actor.face.points
    found = find_eye_margins(mesh, points)
    assert set(found) == {"left", "right"}
    for side, eye in found.items():
        corners = points.subset([EYES[side][2], EYES[side][3]]).holders
        middles = points.subset(EYES[side][:2]).holders
        for margin, middle in zip((eye.upper, eye.lower), middles, strict=True):
            assert margin.vertices[[0, -1]].tolist() == corners.tolist()
            guides = margin.guides @ mesh.vertices
            assert len(guides) == 2 * GUIDES + 1
            np.testing.assert_allclose(guides[GUIDES], mesh.vertices[middle], atol=1e-9)
            # Values at the guides come back at the vertices: their own places, up to the bends between guides.
            back = margin.spread @ guides
            width = np.linalg.norm(guides[0] - guides[-1])
            assert np.linalg.norm(back - mesh.vertices[margin.vertices], axis=1).max() < 0.06 * width
            np.testing.assert_allclose(np.asarray(margin.spread.sum(axis=1)).ravel(), 1.0)


def test_a_face_without_lids_points_has_no_margins(actor: demo.DemoFace) -> None:
    points = actor.face.points
    one_eyed = points.subset([name for name in points.names if name != "3.1"])
    assert set(find_eye_margins(actor.face.mesh, one_eyed)) == {"right"}
    assert find_eye_margins(actor.face.mesh, points.subset(["2.1", "9.3", "8.3", "8.4"])) == {}


def test_a_point_behind_the_rim_is_led_out_to_it(actor: demo.DemoFace) -> None:
    mesh, points = actor.face.mesh, actor.face.points
    true = find_eye_margins(mesh, points)["left"].upper
    here = points.subset(["3.1"]).holders[0]
    # Behind the rim: a vertex of the lid's inner side, which looks at the eyeball.
    behind = [v for v in np.flatnonzero(mesh.graph[here].toarray().ravel()) if v not in true.vertices]
    inner = max(behind, key=lambda v: -mesh.vertices[v, 2])
    steps = mesh.graph.copy().tolil()
    steps[inner] *= 20
    steps[:, inner] *= 20
    ends = (int(true.vertices[0]), int(true.vertices[-1]))
    found = on_rim(mesh, steps.tocsr(), ends, int(inner), 0.5)
    assert found != inner
    assert on_rim(mesh, mesh.graph, ends, int(here), 0.5) == here


# ---- lids ---------------------------------------------------------------------------------------


def left_over(face: Face, positions: np.ndarray) -> float:
    """The lids' opening as a share of the neutral one, the mean of both eyes."""
    shares = []
    for eye in find_eye_margins(face.mesh, face.points).values():
        neutral, now = eye.above.openings(face.mesh.vertices), eye.above.openings(positions)
        size = np.linalg.norm(neutral, axis=1)
        shares.append(np.einsum("gi,gi->g", now, neutral / np.maximum(size, 1e-300)[:, None]).sum() / size.sum())
    return float(np.mean(shares))


def test_a_lid_that_shuts_on_the_source_shuts_on_wider_eyes(actor: demo.DemoFace, child: Face) -> None:
    frames = blink(actor)
    shut = left_over(actor.face, frames[0].astype(float))
    problem = Problem(Face(actor.face.mesh, actor.face.points), child)
    whole = motion_cloning.fit(problem, MotionCloningSettings())
    moved = whole.plain(frames.astype(np.float32))
    closed = left_over(child, child.mesh.vertices + moved[0])
    whole._seams = None
    without = left_over(child, child.mesh.vertices + whole.plain(frames.astype(np.float32))[0])
    assert abs(shut) < 0.1
    assert without > shut + 0.2, "the carried motion alone leaves a slit on wider eyes"
    assert closed == pytest.approx(shut, abs=0.04)


@pytest.mark.parametrize("method", ["hierarchical", "wavelet"])
def test_lids_shut_at_every_strength_of_the_levels(method: str, actor: demo.DemoFace, child: Face) -> None:
    frames = blink(actor).astype(np.float32)
    shut = left_over(actor.face, frames[0].astype(float))
    settings = {"levels": 2, "base_points": 105}
    whole = fit(method, Problem(Face(actor.face.mesh, actor.face.points), child), SETTINGS[method](**settings))
    whole_lids = left_over(child, whole.frames(frames)[0].astype(float))
    assert whole_lids == pytest.approx(shut, abs=0.04)
    levels = sum(level.displacements for level in whole.levels(frames))
    np.testing.assert_allclose(child.mesh.vertices + levels, whole.frames(frames), atol=1e-5 * child.mesh.size)
    smooth = whole.adjusted(SETTINGS[method](**settings, detail_scale=0.999))
    assert left_over(child, smooth.frames(frames)[0].astype(float)) == pytest.approx(shut, abs=0.04)
    # Half of the coarse motion, all of the finer one: a lid stops on its way.
    half = whole.adjusted(SETTINGS[method](**settings, base_gain=0.5))
    assert 0.3 < left_over(child, half.frames(frames)[0].astype(float)) < 0.6
    fine, _ = whole.detail(frames)
    still, _ = whole.detail(actor.face.mesh.vertices[None])
    assert np.abs(fine - still).max() > 0.5 * np.abs(levels).max()


def test_lids_of_a_face_onto_itself_are_left_as_they_are(actor: demo.DemoFace) -> None:
    mesh = actor.face.mesh
    eyes = find_eye_margins(mesh, actor.face.points)
    each = np.broadcast_to(np.eye(3), (len(mesh.vertices), 3, 3))
    seams = LidSeams(eyes, eyes, (mesh, mesh), each, each)
    acted = (blink(actor, 0.7) - mesh.vertices).astype(np.float32)
    corrected = seams.correct(acted.copy(), acted)
    assert np.abs(corrected - acted).max() < 1e-5 * mesh.size
    assert not seams.correct(np.zeros_like(acted), np.zeros_like(acted)).any()


def test_gaps_are_whole_in_the_neutral_and_gone_in_a_blink(actor: demo.DemoFace, child: Face) -> None:
    gaps = SeamGaps(Problem(actor.face, child))
    neutral = actor.face.mesh.vertices.astype(np.float32)
    frames = np.stack([neutral, blink(actor)[0], actor.frames(demo.contractions({"jaw": 1.0}))[0]])
    still = np.repeat(child.mesh.vertices[None].astype(np.float32), 3, axis=0)
    found = gaps.measured(frames, still)
    assert found["source_lid_gap_percent"][0] == pytest.approx(100, abs=0.1)
    assert found["source_lid_gap_percent"][1] < 12
    np.testing.assert_allclose(found["lid_gap_percent"], 100, atol=0.1)
    assert found["source_lip_gap_percent"][:2] == pytest.approx([0, 0], abs=0.5)
    assert found["source_lip_gap_percent"][2] > 20
    np.testing.assert_allclose(found["lip_gap_percent"], 0, atol=0.01)


def test_lips_whose_inner_points_are_one_place_are_measured_outside(actor: demo.DemoFace) -> None:
    points = actor.face.points
    row = {name: k for k, name in enumerate(points.names)}
    vertices, weights = points.vertices.copy(), points.weights.copy()
    for upper, lower in (("2.2", "2.3"), ("2.6", "2.8"), ("2.7", "2.9")):
        vertices[row[lower]], weights[row[lower]] = vertices[row[upper]], weights[row[upper]]
    welded = Face(actor.face.mesh, FeaturePoints(points.names, vertices, weights))
    opened = actor.frames(demo.contractions({"jaw": 1.0}))
    found = SeamGaps(Problem(actor.face, welded)).measured(opened, opened)
    assert found["lip_gap_percent"] == found["source_lip_gap_percent"]
    assert found["lip_gap_percent"][0] > 20


def test_gaping_is_where_lips_and_lids_are_open_wider_than_the_source(actor: demo.DemoFace, child: Face) -> None:
    gaps, mesh = SeamGaps(Problem(actor.face, child)), child.mesh
    neutral = actor.face.mesh.vertices.astype(np.float32)
    frames = np.stack([neutral, blink(actor)[0], actor.frames(demo.contractions({"jaw": 1.0}))[0], neutral])
    moved = np.repeat(mesh.vertices[None].astype(np.float32), 4, axis=0)
    between = child.points.subset(["2.2", "2.3"]).positions(mesh.vertices)[:, 1].mean()
    moved[3, mesh.vertices[:, 1] < between, 1] -= 0.05 * mesh.size
    gaping, found = gaps.gaping(frames, moved), gaps.measured(frames, moved)
    for what, each in (("lip", [one.lips for one in gaping]), ("lid", [one.lids for one in gaping])):
        more = np.subtract(found[f"{what}_gap_percent"], found[f"source_{what}_gap_percent"])
        assert [len(vertices) > 0 for vertices in each] == (more >= GAPES).tolist()
    eye = find_eye_margins(mesh, child.points)
    margins = np.concatenate([[*one.upper.vertices, *one.lower.vertices] for one in eye.values()])
    assert np.isin(gaping[1].lids, margins).all()
    assert len(gaping[1].lids) > 0.7 * len(np.unique(margins)), "of both eyes"
    open_lips = mesh.vertices[gaping[3].lips]
    corners = child.points.subset(["8.3", "8.4"]).positions(mesh.vertices)
    assert np.isin(child.points.subset(["2.2", "2.3"]).holders, gaping[3].lips).all()
    assert open_lips[:, 0].min() >= corners[:, 0].min()
    assert open_lips[:, 0].max() <= corners[:, 0].max()
    assert np.linalg.norm(open_lips - corners.mean(axis=0), axis=1).max() < np.linalg.norm(corners[0] - corners[1])


def test_a_face_gapes_nowhere_against_itself(actor: demo.DemoFace) -> None:
    acted = actor.frames(demo.contractions({"jaw": 1.0}))
    for found in SeamGaps(Problem(actor.face, actor.face)).gaping(acted, acted):
        assert not len(found.lips)
        assert not len(found.lids)


# ---- folds --------------------------------------------------------------------------------------


def grid(count: int = 24) -> TriMesh:
    x, y = np.meshgrid(np.arange(count, dtype=float), np.arange(count, dtype=float), indexing="ij")
    first = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
    faces = np.concatenate(
        [np.stack([first, first + count, first + 1], 1), np.stack([first + count, first + count + 1, first + 1], 1)]
    )
    return TriMesh(np.stack([x.ravel(), y.ravel(), np.zeros(count * count)], axis=1), faces)


def test_a_fold_that_the_source_lacks_is_smoothed_away_and_nothing_else_moves() -> None:
    mesh = grid()
    every = np.arange(len(mesh.vertices))
    calm = mesh.vertices[None].astype(np.float32)
    moved = np.zeros_like(calm)
    moved[0, 300] = (1.6, 0.0, 0.0)
    defects = Defects(mesh, mesh, every)
    assert defects.turned(mesh.vertices + moved[0]).any()
    mended = Unfolding(mesh, mesh, every).mend(moved.copy(), calm)
    assert not defects.turned(mesh.vertices + mended[0]).any()
    far = np.linalg.norm(mesh.vertices - mesh.vertices[300], axis=1) > 4
    assert not mended[0, far].any()


def test_a_fold_that_the_source_has_is_left() -> None:
    mesh = grid()
    every = np.arange(len(mesh.vertices))
    moved = np.zeros((1, len(mesh.vertices), 3), np.float32)
    moved[0, mesh.vertices[:, 0] > 12] = (0.0, 0.0, 0.0)
    rolled = mesh.vertices[:, 0] > 12
    moved[0, rolled, 0] = (2 * (12 - mesh.vertices[rolled, 0])).astype(np.float32)
    mended = Unfolding(mesh, mesh, every).mend(moved.copy(), mesh.vertices.astype(np.float32) + moved)
    np.testing.assert_allclose(mended, moved, atol=2.0)
    turned = Defects(mesh, mesh, every).turned(mesh.vertices + mended[0])
    assert turned.sum() > 0.3 * len(mesh.faces)


def test_a_lip_that_goes_through_the_other_is_no_mere_fold() -> None:
    mesh = grid()
    every = np.arange(len(mesh.vertices))
    moved = np.zeros((1, len(mesh.vertices), 3), np.float32)
    middle = np.linalg.norm(mesh.vertices - mesh.vertices[300], axis=1) < 3
    moved[0, middle] = (14.0, 0.0, 0.0)
    mended = Unfolding(mesh, mesh, every).mend(moved.copy(), mesh.vertices[None].astype(np.float32))
    np.testing.assert_array_equal(mended, moved)


# ---- coarse sources -----------------------------------------------------------------------------


def carry_of(source: Face, target: Face) -> np.ndarray:
    return correspond(source.mesh, source.points, target.mesh, target.points).matrix(
        source.mesh.faces, len(source.mesh.vertices)
    )


def test_a_source_as_fine_as_the_target_is_left_alone(actor: demo.DemoFace) -> None:
    mesh = actor.face.mesh
    matrix = carry_of(actor.face, actor.face)
    smoothing, carry = smooth_coarse_source(matrix, mesh, mesh, 1.0)
    assert smoothing is None
    assert carry is matrix


def test_a_coarse_source_loses_its_kinks_and_no_shift() -> None:
    coarse, fine = demo.actor(vertices=1_200).face, demo.actor(vertices=8_000).face
    matrix = carry_of(coarse, fine)
    smoothing, carry = smooth_coarse_source(matrix, coarse.mesh, fine.mesh, 1.0)
    assert smoothing is not None
    ones = np.ones(len(coarse.mesh.vertices))
    np.testing.assert_allclose(carry @ (smoothing @ ones), matrix @ ones, atol=1e-9)
    noise = np.random.default_rng(0).normal(size=(len(ones), 3))
    i, j = fine.mesh.edges.T
    before, after = matrix @ noise, carry @ (smoothing @ noise)
    assert np.square(after[i] - after[j]).sum() < 0.1 * np.square(before[i] - before[j]).sum()


def test_points_alone_are_enough(actor: demo.DemoFace, child: Face) -> None:
    """Free names serve where no unit of a region is asked for."""

    def renamed(face: Face) -> Face:
        kept = [name for name in face.points.names if not name.startswith(("3.5", "3.6", "6.", "9.8", "9.9", "9.1"))]
        points = face.points.subset(kept)
        return Face(face.mesh, FeaturePoints(tuple(f"p{k}" for k in range(len(kept))), points.vertices, points.weights))

    fitted = motion_cloning.fit(Problem(renamed(actor.face), renamed(child)), MotionCloningSettings())
    found = fitted.frames(blink(actor).astype(np.float32))
    assert np.isfinite(found).all()
    assert fitted.report["lids"] == []
