"""Lashes ride on their lids, lower teeth go with the chin, upper teeth stay: the parts of one mesh."""

from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.core.acting.eyeballs import find_eyeballs
from facial_retarget_addon.core.acting.fap_face import FapFace, fit_fap_face
from facial_retarget_addon.core.closest_point import SurfaceFinder
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.methods.base import fit
from facial_retarget_addon.core.methods.settings import (
    FeaturePointSettings,
    HierarchicalSettings,
    MotionCloningSettings,
)
from facial_retarget_addon.core.mpeg4.fdps import FDPS
from facial_retarget_addon.core.mpeg4.head import head_axes
from facial_retarget_addon.core.parts.carried_parts import carried_parts
from facial_retarget_addon.core.parts.eyes import pair_eyeballs
from facial_retarget_addon.core.parts.find import Part, find_parts
from facial_retarget_addon.core.parts.follow import Following, fit_following
from facial_retarget_addon.core.parts.jaw import ChinReader, hinge_of
from facial_retarget_addon.core.parts.kinds import (
    ACROSS,
    AROUND_EYE,
    BOTH,
    BROW,
    EYEBALL,
    LOWER,
    OTHER,
    TONGUE,
    UPPER,
)
from facial_retarget_addon.core.parts.known_head import know_head, scale_between
from facial_retarget_addon.core.parts.lacking import lacking_parts
from facial_retarget_addon.core.parts.riding import ride
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.core.rigid import fit_rigid
from facial_retarget_addon.files.parts import read_parts
from facial_retarget_addon.files.points import read_points

TRUTH = {
    "sclera_L": {EYEBALL},
    "iris_L": {EYEBALL},
    "sclera_R": {EYEBALL},
    "iris_R": {EYEBALL},
    "eye_L": {EYEBALL},
    "eye_R": {EYEBALL},
    **{f"{what}_{side}": {AROUND_EYE} for what in ("lashes", "lacrimal", "eyeocc", "eyeblend") for side in "LR"},
    "teeth": {UPPER, LOWER},
    "teeth_upper": {UPPER},
    "teeth_lower": {LOWER},
    "tongue": {TONGUE},
    "gums_tongue": {BOTH},
}
"""Name that an artist gave -> kinds that it may be; gums and tongue of the one head are welded."""


class Head:
    """A real head with its artist's part names."""

    def __init__(self, folder: Path, name: str) -> None:
        short = name.split("_")[0] if name != "male_adult_08" else name
        archive = np.load(folder / f"{name}.npz")
        self.mesh = TriMesh(archive["vertices"], archive["tris"])
        points = read_points(folder / f"{short}_points.json", self.mesh)
        self.all_points = points
        self.points = points.subset([name for name in points.names if name in FDPS])
        self.names = archive["part_names"][archive["vert_part"]]
        self.moves = dict(zip(archive["expr_names"].tolist(), archive["expr_delta"], strict=True))
        self.known = know_head(Face(self.mesh, self.points))
        self.parts = self.known.parts

    def vertices(self, kind: str) -> np.ndarray:
        return np.concatenate([part.vertices for part in self.parts if part.kind == kind])


def axes_of(mesh: TriMesh, points: FeaturePoints) -> np.ndarray:
    return head_axes(points.names, points.positions(mesh.vertices))


def parts_of(mesh: TriMesh, points: FeaturePoints) -> tuple[Part, ...]:
    return know_head(Face(mesh, points)).parts


def following_of(mesh: TriMesh, points: FeaturePoints) -> Following:
    head = know_head(Face(mesh, points))
    return fit_following(head, head.parts)


@pytest.fixture(scope="module")
def ict(shared_data: Path) -> Head:
    return Head(shared_data, "ict_dev")


@pytest.fixture(scope="module")
def makehuman(shared_data: Path) -> Head:
    return Head(shared_data, "makehuman_dev")


@pytest.fixture(scope="module", params=["ict", "makehuman"])
def head(request: pytest.FixtureRequest) -> Head:
    return request.getfixturevalue(request.param)


@pytest.fixture(scope="module")
def following(makehuman: Head) -> Following:
    return fit_following(makehuman.known, makehuman.parts)


@pytest.fixture(scope="module")
def playing(ict: Head) -> FapFace:
    return fit_fap_face(ict.mesh, ict.points)


def faps(**values: float) -> np.ndarray:
    """One frame of FAPs, such as fap_19=1024."""
    frame = np.zeros((1, 68))
    for name, value in values.items():
        frame[0, int(name.removeprefix("fap_")) - 1] = value
    return frame


def skin_motion(head: Head, rng: np.random.Generator) -> np.ndarray:
    moved = rng.normal(size=(3, *head.mesh.vertices.shape))
    moved[:, head.mesh.components != head.mesh.components[head.points.vertices[0, 0]]] = 0.0
    return moved


# ---- finding ------------------------------------------------------------------------------------


def test_every_part_of_a_real_head_is_what_its_artist_called_it(head: Head) -> None:
    assert len(head.parts) > 6
    for part in head.parts:
        assert part.kind in set.intersection(*(TRUTH[name] for name in np.unique(head.names[part.vertices])))
    parts = np.sort(np.concatenate([part.vertices for part in head.parts]))
    skin = head.mesh.components == head.mesh.components[head.points.vertices[0, 0]]
    np.testing.assert_array_equal(parts, np.flatnonzero(~skin))


def test_each_tooth_is_in_its_row(ict: Head) -> None:
    teeth = [part for part in ict.parts if part.kind in (UPPER, LOWER)]
    assert len(teeth) == 32
    falls = [np.linalg.norm(ict.moves["jawOpen"][part.vertices], axis=1).mean() for part in teeth]
    assert [part.kind == LOWER for part in teeth] == [fall > 0.1 for fall in falls]


def test_hair_on_the_head_is_not_hair_on_the_face(shared_data: Path) -> None:
    head = Head(shared_data, "male_adult_08")
    assert {part.kind for part in head.parts} == {EYEBALL, OTHER}
    assert set(head.names[head.vertices(OTHER)]) == {"m014_opacity"}


def test_without_chin_and_brows_nothing_is_known(makehuman: Head) -> None:
    few = makehuman.points.subset(["3.1", "8.3", "8.4", "9.3"])
    parts = find_parts(makehuman.mesh, few, np.eye(3), {})
    assert {part.kind for part in parts} == {OTHER}
    own = np.zeros(len(makehuman.mesh.vertices), bool)
    face = Face(makehuman.mesh, few)
    assert not carried_parts(face, face, own).moves.any()


def with_component(head: Head, vertices: np.ndarray, faces: np.ndarray) -> TriMesh:
    count = len(head.mesh.vertices)
    return TriMesh(np.concatenate([head.mesh.vertices, vertices]), np.concatenate([head.mesh.faces, count + faces]))


CARD = np.array([[-1.0, -0.2, 0.0], [1.0, -0.2, 0.0], [1.0, 0.2, 0.0], [-1.0, 0.2, 0.0]])
CARD_FACES = np.array([[0, 1, 2], [0, 2, 3]])


def test_a_card_on_the_brow_rides_on_it(makehuman: Head) -> None:
    brow = makehuman.points.subset(["4.3"]).positions(makehuman.mesh.vertices)[0]
    mesh = with_component(makehuman, brow + [0.0, 0.0, 0.03] + 0.04 * CARD, CARD_FACES)
    last = parts_of(mesh, makehuman.points)[-1]
    assert last.kind == BROW
    faces = fit_fap_face(mesh, makehuman.points).frames(faps(fap_33=300))
    risen = (faces[0] - mesh.vertices)[last.vertices]
    there = makehuman.points.subset(["4.3"]).positions((faces[0] - mesh.vertices)[None])[0, 0]
    assert there[1] > 0
    np.testing.assert_allclose(risen.mean(axis=0), there, atol=0.3 * np.linalg.norm(there))


def test_vertices_without_faces_are_no_teeth(makehuman: Head) -> None:
    bare = TriMesh(makehuman.mesh.vertices, makehuman.mesh.faces[makehuman.names[makehuman.mesh.faces[:, 0]] == "skin"])
    parts = parts_of(bare, makehuman.points)
    assert [part.kind for part in parts] == [OTHER]
    np.testing.assert_array_equal(parts[0].vertices, np.flatnonzero(makehuman.names != "skin"))


def test_teeth_with_points_are_told_by_them(makehuman: Head) -> None:
    lower = np.flatnonzero(makehuman.names == "teeth_lower")
    for names, kind in ((("9.8", "9.10"), UPPER), (("9.8", "9.11"), BOTH)):
        on_teeth = FeaturePoints(names, np.repeat(lower[:2, None], 3, axis=1), np.tile([1.0, 0.0, 0.0], (2, 1)))
        parts = parts_of(makehuman.mesh, makehuman.points.joined(on_teeth))
        found = next(part for part in parts if lower[0] in part.vertices)
        assert found.kind == kind


def test_a_sheet_behind_a_mouth_without_lower_teeth_stays(makehuman: Head) -> None:
    mesh, names = makehuman.mesh, makehuman.names
    gone = np.isin(names, ["teeth_lower", "tongue"])
    lips = makehuman.points.subset(["2.2"]).positions(mesh.vertices)[0]
    sheet = lips + [0.0, 0.0, -0.4] + np.array([0.2, 0.9, 1.0]) * CARD
    bare = TriMesh(mesh.vertices, mesh.faces[~gone[mesh.faces[:, 0]]])
    both = TriMesh(
        np.concatenate([bare.vertices, sheet]), np.concatenate([bare.faces, len(bare.vertices) + CARD_FACES])
    )
    part = parts_of(both, makehuman.points)[-1]
    assert part.kind == ACROSS
    frames = fit_fap_face(both, makehuman.points).frames(faps(fap_3=500))
    np.testing.assert_array_equal(frames[0, part.vertices], both.vertices[part.vertices].astype(np.float32))


def test_a_named_part_is_what_its_name_says(makehuman: Head) -> None:
    names = makehuman.names
    tongue, teeth, lash = (np.flatnonzero(names == name) for name in ("tongue", "teeth_upper", "lashes_L"))
    named = {"still": tongue[:1], "lower teeth": teeth[3:5], "left eyeball": lash}
    axes = axes_of(makehuman.mesh, makehuman.points)
    eyeballs = find_eyeballs(makehuman.mesh, makehuman.points, axes, named)
    np.testing.assert_array_equal(eyeballs["left"].vertices, lash)
    np.testing.assert_array_equal(eyeballs["right"].vertices, np.flatnonzero(names == "eye_R"))
    parts = find_parts(makehuman.mesh, makehuman.points, axes, eyeballs, named)
    kinds = {int(part.vertices.min()): (part.kind, part.reason) for part in parts}
    assert kinds[tongue.min()] == (OTHER, "named still")
    assert kinds[teeth.min()] == (LOWER, "named lower teeth")
    assert kinds[lash.min()] == (EYEBALL, "named left eyeball")
    assert len(parts) == len(makehuman.parts)
    together = np.sort(np.concatenate([part.vertices for part in parts]))
    np.testing.assert_array_equal(together, np.flatnonzero(names != "skin"))


def test_named_parts_are_known_without_chin_and_brows(makehuman: Head) -> None:
    few = makehuman.points.subset(["3.1", "8.3", "8.4", "9.3"])
    lash, teeth = (np.flatnonzero(makehuman.names == name) for name in ("lashes_L", "teeth_lower"))
    face = Face(makehuman.mesh, few, named_parts={"lashes": lash, "lower teeth": teeth[:1]})
    moves = carried_parts(face, face, np.zeros(len(makehuman.names), bool)).moves
    np.testing.assert_array_equal(np.flatnonzero(moves), lash)


def test_an_eyeball_with_a_pupil_s_point_is_found(makehuman: Head) -> None:
    ball = np.flatnonzero(makehuman.names == "eye_L")
    front = ball[makehuman.mesh.vertices[ball, 2].argmax()]
    pupil = FeaturePoints(("3.5",), np.full((1, 3), front), np.array([[1.0, 0.0, 0.0]]))
    axes = axes_of(makehuman.mesh, makehuman.points)
    found = find_eyeballs(makehuman.mesh, makehuman.points.joined(pupil), axes)
    np.testing.assert_array_equal(found["left"].vertices, ball)


def test_a_face_that_faps_move_hears_the_names(makehuman: Head) -> None:
    teeth = np.flatnonzero(makehuman.names == "teeth_lower")
    face = fit_fap_face(makehuman.mesh, makehuman.points, named={"still": teeth[:1]})
    frame = face.frames(faps(fap_3=500))[0]
    np.testing.assert_array_equal(frame[teeth], makehuman.mesh.vertices[teeth].astype(np.float32))


# ---- following ----------------------------------------------------------------------------------


def test_what_follows_does_not_lead(following: Following) -> None:
    assert not np.intersect1d(following.riders, following.carriers).size


def test_following_is_linear_and_nothing_without_motion(makehuman: Head, following: Following) -> None:
    a, b = skin_motion(makehuman, np.random.default_rng(1)), skin_motion(makehuman, np.random.default_rng(2))
    whole = following.add_to(2 * a - b)
    np.testing.assert_allclose(whole, 2 * following.add_to(a) - following.add_to(b), atol=1e-5)
    np.testing.assert_array_equal(following.add_to(np.zeros_like(a)), 0.0)


def test_a_skin_that_moves_as_one_takes_the_parts_along(makehuman: Head, following: Following) -> None:
    moved = np.where(skin_motion(makehuman, np.random.default_rng(1)) == 0.0, 0.0, [0.3, 0.0, -0.2])
    found = following.add_to(moved)
    wanted = np.tile([0.3, 0.0, -0.2], (len(following.riders), 1))
    level = axes_of(makehuman.mesh, makehuman.points) @ [0.3, 0.0, -0.2]
    np.testing.assert_allclose(found[0, following.riders], wanted, atol=1.5 * abs(level[1]) + 1e-5)


def test_the_order_of_vertices_does_not_matter(makehuman: Head, following: Following) -> None:
    order = np.random.default_rng(4).permutation(len(makehuman.mesh.vertices))
    rank = np.argsort(order)
    mesh = TriMesh(makehuman.mesh.vertices[order], rank[makehuman.mesh.faces])
    points = FeaturePoints(makehuman.points.names, rank[makehuman.points.vertices], makehuman.points.weights)
    parts = parts_of(mesh, points)
    assert sorted(part.kind for part in parts) == sorted(part.kind for part in makehuman.parts)
    # Motion that is smooth over the skin: which of two faces holds a place on their edge does not matter.
    skin = np.isin(np.arange(len(order)), makehuman.vertices(AROUND_EYE), invert=True)
    moved = np.sin(3 * makehuman.mesh.vertices)[None] * skin[:, None]
    wanted = following.add_to(moved.copy())
    found = following_of(mesh, points).add_to(moved[:, order].copy())
    np.testing.assert_allclose(found, wanted[:, order], atol=1e-4)


def test_place_size_and_turn_do_not_matter(makehuman: Head, following: Following) -> None:
    turn = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
    mesh = makehuman.mesh.with_vertices(20 * makehuman.mesh.vertices @ turn.T + [3.0, -20.0, 7.0])
    moved = skin_motion(makehuman, np.random.default_rng(5))
    wanted = following.add_to(moved.copy())
    found = following_of(mesh, makehuman.points).add_to(moved @ turn.T)
    np.testing.assert_allclose(found, wanted @ turn.T, atol=2e-3)


# ---- a face that FAPs move ----------------------------------------------------------------------


def test_lashes_ride_with_the_lid_that_closes(ict: Head, playing: FapFace) -> None:
    mesh, frame = ict.mesh, playing.frames(faps(fap_19=1024))[0].astype(float)
    lid = np.linalg.norm(ict.points.subset(["3.1"]).positions(frame - mesh.vertices))
    lashes = np.flatnonzero(ict.names == "lashes_L")
    skin = np.flatnonzero((mesh.components == 0)[mesh.faces[:, 0]])
    rest = SurfaceFinder(mesh, skin).closest(mesh.vertices[lashes]).distance
    roots = rest < 0.02 * lid
    assert roots.sum() > 100
    shut = SurfaceFinder(mesh.with_vertices(frame), skin).closest(frame[lashes[roots]]).distance
    assert shut.max() < 0.05 * lid
    travelled = np.linalg.norm(frame - mesh.vertices, axis=1)
    assert travelled[lashes].max() > 0.9 * lid
    # Nothing of the other eye moves.
    assert travelled[ict.names == "lashes_R"].max() < 0.02 * lid


def test_a_lash_keeps_its_shape(ict: Head, playing: FapFace) -> None:
    mesh, frame = ict.mesh, playing.frames(faps(fap_19=1024))[0].astype(float)
    edges = mesh.edges[(ict.names[mesh.edges] == "lashes_L").all(axis=1)]
    before, after = (np.linalg.norm(p[edges[:, 0]] - p[edges[:, 1]], axis=1) for p in (mesh.vertices, frame))
    stretch = after / before
    assert np.quantile(np.abs(np.log(stretch)), 0.9) < np.log(1.5)
    assert 0.4 < stretch.min() < stretch.max() < 2.5


def test_lower_teeth_go_with_the_chin_and_upper_teeth_stay(ict: Head, playing: FapFace) -> None:
    moved = playing.frames(faps(fap_3=600))[0] - ict.mesh.vertices.astype(np.float32)
    chin = ict.points.subset(["2.1"]).positions(moved)[0]
    lower, forward = ict.vertices(LOWER), ict.mesh.vertices[:, 2]
    front = lower[forward[lower] > np.quantile(forward[lower], 0.8)]
    np.testing.assert_allclose(moved[front].mean(axis=0), chin, atol=0.1 * np.linalg.norm(chin))
    # Nearer to the hinge they drop less.
    back = lower[forward[lower] < np.quantile(forward[lower], 0.2)]
    assert 0.3 * chin[1] > moved[back, 1].mean() > 0.8 * chin[1]
    assert (moved[ict.vertices(UPPER)] == 0).all()
    assert (moved[ict.vertices(EYEBALL)] == 0).all()


def test_welded_gums_part_between_the_rows(ict: Head, playing: FapFace) -> None:
    moved = playing.frames(faps(fap_3=600))[0] - ict.mesh.vertices.astype(np.float32)
    gums = ict.vertices(BOTH)
    falls = np.linalg.norm(ict.moves["jawOpen"][gums], axis=1) > 0.1
    follows = np.abs(moved[gums]).max(axis=1) > 0.3 * np.abs(moved[gums]).max()
    assert (falls == follows).mean() > 0.9


def test_the_parts_are_in_every_channel_and_the_report(ict: Head, playing: FapFace) -> None:
    shapes = playing.channel_shapes()[playing.channels.index("2.1 y")] - ict.mesh.vertices.astype(np.float32)
    assert np.abs(shapes[ict.vertices(LOWER)]).max() > 0.5
    does = {row["kind"]: row["does"] for row in playing.report["parts"]}
    assert does == {
        EYEBALL: "has motion of its own",
        AROUND_EYE: "rides on the skin of the lids",
        UPPER: "stays",
        LOWER: "goes with the chin",
        BOTH: "its lower half goes with the chin",
    }
    assert sum(row["vertices"] for row in playing.report["parts"]) == (ict.mesh.components != 0).sum()


def test_the_published_weights_leave_the_parts_where_they_are(makehuman: Head) -> None:
    face = fit_fap_face(makehuman.mesh, makehuman.points, "paper")
    moved = face.frames(faps(fap_3=500, fap_19=1024))[0] - makehuman.mesh.vertices.astype(np.float32)
    assert (moved[makehuman.names == "teeth_lower"] == 0).all()
    assert (moved[np.char.startswith(makehuman.names, "lashes")] == 0).all()
    assert face.report["parts"] == []


# ---- methods ------------------------------------------------------------------------------------


def on_itself(head: Head, shape: str, skin_alone: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """What the parts do when the source is the target and its skin is met exactly, and what they did: (V, 3) both."""
    face, rest = Face(head.mesh, head.points), head.mesh.vertices.astype(np.float32)
    skin = (head.mesh.components == head.mesh.components[head.points.vertices[0, 0]])[:, None]
    moved = head.moves[shape] * skin if skin_alone else head.moves[shape]
    frames = (head.mesh.vertices + moved).astype(np.float32)[None]
    carried = carried_parts(face, face, np.zeros(len(rest), bool))
    return carried.add_to((frames - rest) * skin, frames)[0], head.moves[shape]


def replace_moves(head: Head, part: np.ndarray, by: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """As `on_itself`, for an open mouth whose part went elsewhere."""
    face, rest = Face(head.mesh, head.points), head.mesh.vertices.astype(np.float32)
    wanted = np.where(part[:, None], by, head.moves["mouth-open"])
    frames = (head.mesh.vertices + wanted).astype(np.float32)[None]
    carried = carried_parts(face, face, np.zeros(len(rest), bool))
    skin = (head.names == "skin")[:, None]
    return carried.add_to((frames - rest) * skin, frames)[0], wanted


def error_on(mask: np.ndarray, found: np.ndarray, wanted: np.ndarray) -> float:
    return float(np.linalg.norm((found - wanted)[mask]) / np.linalg.norm(wanted[mask]))


def test_the_source_s_parts_drive_the_target_s(ict: Head) -> None:
    opened = on_itself(ict, "jawOpen")
    assert error_on(ict.names == "teeth", *opened) < 0.01
    assert error_on(ict.names == "gums_tongue", *opened) < 0.14
    blink = on_itself(ict, "eyeBlink_L")
    assert error_on(ict.names == "lashes_L", *blink) < 0.22
    assert error_on(ict.names == "lacrimal_L", *blink) < 0.15
    assert error_on(ict.names == "lashes_L", *on_itself(ict, "eyeLookDown_L")) < 0.12
    # A source whose lashes stay where they are leaves them to the lid, unturned.
    assert error_on(ict.names == "lashes_L", *on_itself(ict, "eyeBlink_L", skin_alone=True)) < 0.5


def test_lashes_turn_with_the_lid(ict: Head) -> None:
    lashes, following = ict.names == "lashes_L", fit_following(ict.known, ict.parts)
    skin = (ict.mesh.components == ict.mesh.components[ict.points.vertices[0, 0]])[:, None]
    moved = following.add_to(np.float32(ict.moves["eyeBlink_L"] * skin)[None])[0]
    assert error_on(lashes, moved, ict.moves["eyeBlink_L"]) < 0.38
    # A head that is carried away turns no lash.
    shift = np.float32([[1.0, -2.0, 3.0]])
    carried = following.add_to((skin * shift)[None].copy())[0]
    np.testing.assert_allclose(carried[lashes], np.repeat(shift, lashes.sum(), axis=0), atol=1e-4)


def test_what_rests_does_not_move_at_all(ict: Head, makehuman: Head) -> None:
    rest = ict.mesh.vertices.astype(np.float32)[None]
    carried = carried_parts(Face(ict.mesh, ict.points), Face(makehuman.mesh, makehuman.points), no_one(makehuman))
    moved = carried.add_to(np.zeros((1, *makehuman.mesh.vertices.shape), np.float32), rest)
    np.testing.assert_array_equal(moved, 0.0)


def no_one(head: Head) -> np.ndarray:
    return np.zeros(len(head.mesh.vertices), bool)


def test_teeth_of_a_source_that_stay_behind_its_chin_are_not_followed(makehuman: Head) -> None:
    found, wanted = on_itself(makehuman, "mouth-open", skin_alone=True)
    lower = makehuman.names == "teeth_lower"
    assert error_on(lower, found, wanted) < 0.35
    met = on_itself(makehuman, "mouth-open")[0]
    assert error_on(lower, met, wanted) < 0.03
    # Teeth that drop without a turn are followed as they are.
    fallen = replace_moves(makehuman, lower, [0.0, -0.27 * makehuman.known.unit, 0.0] @ makehuman.known.axes)
    assert error_on(lower, *fallen) < 0.01


def test_the_chin_shows_how_the_jaw_moves(ict: Head) -> None:
    known, lower = ict.known, ict.vertices(LOWER)
    hinge = hinge_of(known)
    reader = ChinReader(known, hinge)

    def shown(shape: str) -> np.ndarray:
        moved = (ict.moves[shape][reader.vertices] @ known.axes.T)[None]
        return reader.motion(moved).displacements(known.places[lower] - hinge)[0] @ known.axes

    opened = ict.moves["jawOpen"][lower]
    for shape, most in (("jawOpen", 0.15), ("jawLeft", 0.25), ("jawRight", 0.25), ("jawForward", 0.25)):
        wanted = ict.moves[shape][lower]
        assert np.linalg.norm(shown(shape) - wanted) < most * np.linalg.norm(wanted)
    # Muscles that raise the chin or shut the lips move no bone.
    for shape, most in (("mouthShrugLower", 0.2), ("mouthClose", 0.1), ("mouthFunnel", 0.1), ("mouthPucker", 0.05)):
        assert np.linalg.norm(shown(shape)) < most * np.linalg.norm(opened)


def test_lower_teeth_turn_about_the_target_s_own_hinge(ict: Head, makehuman: Head) -> None:
    carried = carried_parts(Face(ict.mesh, ict.points), Face(makehuman.mesh, makehuman.points), no_one(makehuman))
    frame = (ict.mesh.vertices + ict.moves["jawOpen"]).astype(np.float32)[None]
    moved = carried.add_to(np.zeros((1, *makehuman.mesh.vertices.shape), np.float32), frame)[0]
    lower = makehuman.names == "teeth_lower"
    here = makehuman.mesh.vertices[lower]
    rigid = fit_rigid(here, here + moved[lower])
    np.testing.assert_allclose(rigid.apply(here), here + moved[lower], atol=1e-5)
    turn = makehuman.known.axes @ rigid.rotation @ makehuman.known.axes.T
    assert abs(np.degrees(np.arcsin(-turn[1, 2])) - 25.3) < 1.0
    assert (moved[makehuman.names == "teeth_upper"] == 0).all()


def tongue_out(head: Head) -> np.ndarray:
    """(V, 3) a tongue that comes out, the more the nearer to its tip, and lifts it."""
    tongue = head.names == "tongue"
    places = head.known.places
    depth = (places[:, 2] - places[tongue, 2].min()) / np.ptp(places[tongue, 2])
    return tongue[:, None] * np.clip(depth, 0, 1)[:, None] ** 2 * ([0.0, 0.1, 0.5] @ head.known.axes)


def test_a_tongue_acts_as_the_source_s_does(makehuman: Head) -> None:
    mesh, tongue = makehuman.mesh, makehuman.names == "tongue"
    jaw = makehuman.moves["mouth-open"]
    frames = (mesh.vertices + tongue_out(makehuman) + [[[0.0]], [[1.0]]] * jaw).astype(np.float32)
    small = mesh.with_vertices(0.5 * mesh.vertices)
    skin = (makehuman.names == "skin")[:, None]
    carried = carried_parts(Face(mesh, makehuman.points), Face(small, makehuman.points), no_one(makehuman))
    moved = carried.add_to(0.5 * (frames - mesh.vertices.astype(np.float32)) * skin, frames)
    wanted = 0.5 * (frames - mesh.vertices)
    assert error_on(tongue, moved[0], wanted[0]) < 1e-4
    # The artist's tongue did not go with the teeth in all.
    assert error_on(tongue, moved[1], wanted[1]) < 1e-4
    assert carried.rows[0]["does"].startswith("acts as the source's does")


def carried_over(source: Face, target: Face, frames: np.ndarray, skin: np.ndarray) -> np.ndarray:
    """(F, V, 3) what the target's parts do, where its skin moves as skin (F, V, 3)."""
    carried = carried_parts(source, target, np.zeros(len(target.mesh.vertices), bool))
    return carried.add_to(skin.astype(np.float32), frames.astype(np.float32))


def test_order_place_size_and_turn_of_both_heads_do_not_matter(ict: Head, makehuman: Head) -> None:
    moves = np.stack([ict.moves[name] for name in ("jawOpen", "jawLeft", "eyeBlink_L", "mouthSmile_L")])
    frames = ict.mesh.vertices + moves
    rng = np.random.default_rng(6)
    smooth = 0.1 * np.sin(makehuman.mesh.vertices[None] * rng.uniform(1, 2, (len(frames), 1, 3)))
    skin = smooth * (makehuman.names == "skin")[:, None]
    source, target = Face(ict.mesh, ict.points), Face(makehuman.mesh, makehuman.points)
    wanted = carried_over(source, target, frames, skin)
    turn, shift = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]]), [3.0, -20.0, 7.0]
    for size, head in ((0.2, ict), (30.0, makehuman)):
        placed = Face(head.mesh.with_vertices(size * head.mesh.vertices @ turn.T + shift), head.points)
        if head is ict:
            found = carried_over(placed, target, size * frames @ turn.T + shift, skin)
        else:
            found = carried_over(source, placed, frames, size * skin @ turn.T) @ turn / size
        np.testing.assert_allclose(found, wanted, atol=1e-3 * makehuman.known.unit)
    ours, theirs = (rng.permutation(len(head.names)) for head in (ict, makehuman))
    mixed = [
        Face(
            TriMesh(head.mesh.vertices[order], np.argsort(order)[head.mesh.faces]),
            FeaturePoints(head.points.names, np.argsort(order)[head.points.vertices], head.points.weights),
        )
        for head, order in ((ict, ours), (makehuman, theirs))
    ]
    found = carried_over(*mixed, frames[:, ours], skin[:, theirs])
    np.testing.assert_allclose(found, wanted[:, theirs], atol=2e-3 * makehuman.known.unit)


def test_a_head_that_is_carried_away_takes_its_parts_along(ict: Head, makehuman: Head) -> None:
    turn = np.array([[0.96, 0.0, 0.28], [0.0, 1.0, 0.0], [-0.28, 0.0, 0.96]])
    shift = np.array([20.0, -5.0, 8.0])
    frame = (ict.mesh.vertices @ turn.T + shift).astype(np.float32)[None]
    rest = makehuman.mesh.vertices
    size = scale_between(ict.known, makehuman.known)
    across = makehuman.known.axes.T @ ict.known.axes
    # What the skin does: each place moves as its counterpart, scaled and turned as the heads are.
    middle = [head.points.positions(head.mesh.vertices).mean(axis=0) for head in (ict, makehuman)]
    here = across @ turn @ across.T
    wanted = (rest - middle[1]) @ (here - np.eye(3)).T
    wanted = wanted + size * (across @ ((turn - np.eye(3)) @ middle[0] + shift))
    skin = (makehuman.names == "skin")[:, None]
    carried = carried_parts(Face(ict.mesh, ict.points), Face(makehuman.mesh, makehuman.points), no_one(makehuman))
    moved = carried.add_to(np.float32(wanted * skin)[None], frame)[0]
    off = np.linalg.norm(moved - wanted, axis=1) / makehuman.known.unit
    assert np.linalg.norm(wanted, axis=1).min() > 2 * makehuman.known.unit
    assert off[makehuman.names != "skin"].max() < 0.15


def test_the_parts_follow_a_retargeted_skin(makehuman: Head) -> None:
    mesh, settings = makehuman.mesh, HierarchicalSettings(levels=1)
    skin = (makehuman.names == "skin")[:, None]
    source = (mesh.vertices + skin * makehuman.moves["mouth-open"]).astype(np.float32)[None]
    face = Face(mesh, makehuman.all_points)
    fitted = fit("hierarchical", Problem(face, face), settings)
    moved = fitted.frames(source)[0] - mesh.vertices.astype(np.float32)
    chin = makehuman.points.subset(["2.1"]).positions(moved)[0]
    assert moved[makehuman.names == "teeth_lower", 1].min() < 0.8 * chin[1]
    assert (moved[makehuman.names == "teeth_upper"] == 0).all()
    assert not fitted.report["still_components"]


def test_what_an_example_moves_is_left_to_the_examples(makehuman: Head) -> None:
    own = makehuman.names == "teeth_lower"
    face = Face(makehuman.mesh, makehuman.all_points)
    found = carried_parts(face, face, own)
    assert not found.moves[own].any()
    assert found.moves[makehuman.names == "tongue"].all()
    assert "has motion of its own" in {row["does"] for row in found.rows}


TURN = np.array([[0.96, -0.28, 0.0], [0.28, 0.96, 0.0], [0.0, 0.0, 1.0]])
"""A turn about forward; about 16 degrees."""


def looking(head: Head, turn: np.ndarray, shift: float = 0.0) -> np.ndarray:
    """A frame whose left eyeball is turned in the object's axes, and shifted up by a share of its radius."""
    frame = head.mesh.vertices.copy()
    axes = axes_of(head.mesh, head.points)
    eye = find_eyeballs(head.mesh, head.points, axes)["left"]
    frame[eye.vertices] = eye.turned(head.mesh.vertices, turn[None])[0] + shift * eye.radius * axes[1]
    return frame[None].astype(np.float32)


@pytest.mark.parametrize("settings", [FeaturePointSettings(), FeaturePointSettings(motion="faps")], ids=str)
def test_eyeballs_turn_as_the_source_s_do(ict: Head, makehuman: Head, settings: FeaturePointSettings) -> None:
    source, target = Face(ict.mesh, ict.points), Face(makehuman.mesh, makehuman.points)
    fitted = fit("feature_points", Problem(source, target), settings)
    theirs, ours = axes_of(makehuman.mesh, makehuman.points), axes_of(ict.mesh, ict.points)
    found = fitted.frames(looking(ict, ours.T @ TURN @ ours))[0]
    wanted = looking(makehuman, theirs.T @ TURN @ theirs)[0]
    np.testing.assert_allclose(found, wanted, atol=1e-5 * makehuman.mesh.size)
    rest = makehuman.mesh.vertices.astype(np.float32)
    assert np.abs(wanted - rest).max() > 0.01
    still = fitted.frames(ict.mesh.vertices.astype(np.float32)[None])[0]
    np.testing.assert_array_equal(still[makehuman.vertices(EYEBALL)], rest[makehuman.vertices(EYEBALL)])


def test_eyeballs_shift_in_the_target_s_size(ict: Head, makehuman: Head) -> None:
    own = np.zeros(len(makehuman.mesh.vertices), bool)
    eyes = pair_eyeballs(ict.known, makehuman.known, own)
    moved = eyes.add_to(np.zeros((1, len(own), 3), np.float32), looking(ict, np.eye(3), 0.5))[0]
    eye = find_eyeballs(makehuman.mesh, makehuman.points, axes_of(makehuman.mesh, makehuman.points))["left"]
    radius = find_eyeballs(ict.mesh, ict.points, axes_of(ict.mesh, ict.points))["left"].radius
    wanted = np.tile(0.5 * radius * eyes.scale * axes_of(makehuman.mesh, makehuman.points)[1], (len(eye.vertices), 1))
    np.testing.assert_allclose(moved[eye.vertices], wanted, atol=1e-5)
    assert np.abs(np.delete(moved, eye.vertices, axis=0)).max() < 1e-9


def test_the_published_method_turns_no_eyeball(makehuman: Head) -> None:
    face = Face(makehuman.mesh, makehuman.points)
    fitted = fit("feature_points", Problem(face, face), FeaturePointSettings(variant="paper"))
    found = fitted.frames(looking(makehuman, TURN))[0]
    np.testing.assert_allclose(found, makehuman.mesh.vertices, atol=1e-5)
    assert len(fitted.report["still_components"]) == len({*makehuman.mesh.components}) - 1


# ---- what is not there --------------------------------------------------------------------------


def test_what_the_target_lacks_is_named_if_the_source_moves_it(ict: Head, makehuman: Head) -> None:
    gone = np.isin(makehuman.names, ["tongue", "teeth_lower", "lashes_L", "lashes_R"])
    bare = makehuman.mesh.faces[~gone[makehuman.mesh.faces[:, 0]]]
    without = Face(TriMesh(makehuman.mesh.vertices, bare), makehuman.points)
    source = Face(ict.mesh, ict.points)
    opened, blink = ((ict.mesh.vertices + ict.moves[name])[None] for name in ("jawOpen", "eyeBlink_L"))
    ends = "was found on the target: what the source's does has no counterpart"
    assert lacking_parts(source, without, opened) == [f"no lower row of teeth {ends}"]
    assert lacking_parts(source, without, blink) == [f"no part around the eyes (lashes) {ends}"]
    assert lacking_parts(source, Face(makehuman.mesh, makehuman.points), np.concatenate([opened, blink])) == []
    speaks = Face(makehuman.mesh, makehuman.points)
    out = (makehuman.mesh.vertices + tongue_out(makehuman))[None]
    assert lacking_parts(speaks, without, out) == [f"no tongue {ends}"]
    gums = np.flatnonzero(makehuman.names == "teeth_upper")
    welded = Face(without.mesh, makehuman.points, named_parts={"gums": gums[:1]})
    assert lacking_parts(speaks, welded, out) == []


def test_the_robot_and_the_ogre_are_survived(shared_data: Path, ict: Head) -> None:
    for name in ("robot", "ogre"):
        archive = np.load(shared_data / f"{name}.npz")
        mesh = TriMesh(archive["vertices"], archive["tris"])
        marks = FeaturePoints(("9.3",), np.zeros((1, 3), int), np.array([[1.0, 0.0, 0.0]]))
        carried = carried_parts(Face(ict.mesh, ict.points), Face(mesh, marks), np.zeros(len(mesh.vertices), bool))
        rest = ict.mesh.vertices.astype(np.float32)[None]
        moved = carried.add_to(np.zeros((1, *mesh.vertices.shape), np.float32), rest)
        np.testing.assert_array_equal(moved, 0.0)
        assert {row["kind"] for row in carried.rows} <= {OTHER}


def test_a_named_eyeball_turns_on_a_head_without_a_mouth(shared_data: Path) -> None:
    """The robot's points are its brows' alone; its eyes were named."""
    own = Path(__file__).resolve().parents[1] / "data"
    faces = []
    for name, file, folder in (("makehuman", "makehuman_dev", shared_data), ("robot", "robot", own)):
        points = folder / f"{name}_points.json"
        with np.load(shared_data / f"{file}.npz") as data:
            mesh = TriMesh.from_polygons(data["vertices"], data["face_counts"], data["face_indices"])
        parts = read_parts(own / "robot_parts.json", mesh) if name == "robot" else {}
        faces.append(Face(mesh, read_points(points, mesh), named_parts=parts))
    source, target = map(know_head, faces)
    still = np.zeros(len(target.mesh.vertices), bool)
    eyes = pair_eyeballs(source, target, still)
    assert [theirs.side for _, theirs in eyes.pairs] == ["left", "right"]
    frames = source.mesh.vertices[None].copy()
    ball = source.eyeballs["left"]
    c, s = np.cos(np.radians(20)), np.sin(np.radians(20))
    turn = source.axes.T @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]]) @ source.axes
    frames[0, ball.vertices] = ball.turned(source.mesh.vertices, turn[None])[0]
    moved = eyes.add_to(np.zeros((1, len(still), 3)), frames)[0]
    assert (moved[target.eyeballs["right"].vertices] == 0).all()
    front = target.eyeballs["left"].vertices[(target.places[target.eyeballs["left"].vertices, 2]).argmax()]
    # The pupil sinks and the ball keeps its size.
    assert (moved[front] @ target.axes.T)[1] < -0.2 * target.eyeballs["left"].radius
    away = (target.mesh.vertices + moved)[target.eyeballs["left"].vertices] - target.eyeballs["left"].centre
    rest = target.mesh.vertices[target.eyeballs["left"].vertices] - target.eyeballs["left"].centre
    np.testing.assert_allclose(np.linalg.norm(away, axis=1), np.linalg.norm(rest, axis=1), atol=1e-3 * target.mesh.size)


def test_lashes_keep_their_lengths_in_a_blink(ict: Head, makehuman: Head) -> None:
    source, target = Face(ict.mesh, ict.points), Face(makehuman.mesh, makehuman.points)
    fitted = fit("motion_cloning", Problem(source, target), MotionCloningSettings())
    frames = (ict.mesh.vertices + np.stack([ict.moves["eyeBlink_L"], 0 * ict.mesh.vertices])).astype(np.float32)
    blink, still = fitted.frames(frames)
    np.testing.assert_array_equal(still, makehuman.mesh.vertices.astype(np.float32))
    head = know_head(target)
    riding = ride(head, head.parts)
    for eye in riding.tips:
        held = eye.vertices[np.abs(eye.lid) > 0.99]
        assert len(held) > 10
        before, after = (
            np.linalg.norm(places[held] - riding.spread[held] @ places, axis=1)
            for places in (makehuman.mesh.vertices, blink.astype(np.float64))
        )
        np.testing.assert_allclose(after, before, rtol=0.03)
