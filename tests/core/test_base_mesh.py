"""Base meshes: the standard sets, inserted points, the artist's own, and the dual of regions."""

from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.core.base.base_mesh import BaseMesh, base_mesh
from facial_retarget_addon.core.base.insertion import insert_points
from facial_retarget_addon.core.base.manifold_part import manifold_part
from facial_retarget_addon.core.base.placed_points import PlacedPoints
from facial_retarget_addon.core.base.triangulations import STANDARD, mirrored_name
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.files.points import read_points

Head = tuple[TriMesh, FeaturePoints]


def dome(side: int = 41) -> TriMesh:
    """Half of an ellipsoid over a square of vertices, seen from +z."""
    u, v = np.meshgrid(np.linspace(-1, 1, side), np.linspace(-1, 1, side))
    x, y = u * np.sqrt(1 - v**2 / 2), v * np.sqrt(1 - u**2 / 2)
    z = np.sqrt(np.maximum(1 - x**2 - y**2, 0))
    corner = np.add.outer(np.arange(side - 1) * side, np.arange(side - 1)).ravel()
    lower = np.stack([corner, corner + 1, corner + side + 1], axis=1)
    upper = np.stack([corner, corner + side + 1, corner + side], axis=1)
    return TriMesh(np.stack([x.ravel(), 1.3 * y.ravel(), z.ravel()], axis=1), np.concatenate([lower, upper]))


def on_vertices(mesh: TriMesh, vertices: np.ndarray) -> FeaturePoints:
    names = tuple(f"free_{v}" for v in vertices)
    return FeaturePoints(names, np.repeat(vertices[:, None], 3, axis=1), np.tile([1.0, 0, 0], (len(vertices), 1)))


def spread(mesh: TriMesh, count: int) -> FeaturePoints:
    """Farthest points of a dome, away from its border."""
    allowed = np.flatnonzero(mesh.vertices[:, 2] > 0.3)
    chosen = [int(allowed[0])]
    gap = np.full(len(allowed), np.inf)
    for _ in range(count - 1):
        gap = np.minimum(gap, np.linalg.norm(mesh.vertices[allowed] - mesh.vertices[chosen[-1]], axis=1))
        chosen.append(int(allowed[gap.argmax()]))
    return on_vertices(mesh, np.array(chosen))


def as_mesh(base: BaseMesh, head: Head) -> TriMesh:
    mesh, points = head
    return TriMesh(points.subset(base.names).positions(mesh.vertices), base.faces)


def assert_clean(base: BaseMesh) -> None:
    mesh = TriMesh(np.zeros((len(base.names), 3)), base.faces)
    assert mesh.is_edge_manifold
    assert mesh.components.max() == 0
    assert np.array_equal(np.unique(base.faces), np.arange(len(base.names)))
    edges = mesh.boundary_edges[:, 0]
    assert len(np.unique(edges)) == len(edges)
    assert sum(len(loop.vertices) for loop in base.loops) == len(edges)
    assert [loop.surrounds for loop in base.loops].count("outer") == 1
    assert base.loops[0].surrounds == "outer"


@pytest.fixture(scope="module")
def ict(shared_data: Path) -> Head:
    archive = np.load(shared_data / "ict_dev.npz")
    skin = np.isin(archive["vert_part"], np.arange(6))
    mesh = TriMesh(archive["vertices"], archive["tris"][skin[archive["tris"]].all(axis=1)])
    return mesh, read_points(shared_data / "ict_points.json", mesh)


@pytest.fixture(scope="module")
def makehuman(shared_data: Path) -> Head:
    archive = np.load(shared_data / "makehuman_dev.npz")
    mesh = TriMesh(archive["vertices"], archive["tris"])
    return mesh, read_points(shared_data / "makehuman_points.json", mesh)


def nameless(head: Head, without: tuple[str, ...] = ()) -> Head:
    mesh, points = head
    left = points.subset([name for name in points.names if name not in without])
    return mesh, FeaturePoints(tuple(f"free {name}" for name in left.names), left.vertices, left.weights)


@pytest.mark.parametrize("triangles", STANDARD)
def test_standard_sets_are_clean_and_symmetric(triangles: tuple[tuple[str, str, str], ...]) -> None:
    names = sorted({name for corners in triangles for name in corners})
    faces = np.array([[names.index(name) for name in corners] for corners in triangles])
    mesh = TriMesh(np.zeros((len(names), 3)), faces)
    assert mesh.is_edge_manifold
    assert len(mesh.boundary_loops) == 4
    assert len(names) - len(mesh.edges) + len(faces) == -2
    turned = {frozenset(corners) for corners in triangles}
    assert turned == {frozenset(map(mirrored_name, corners)) for corners in triangles}


def test_standard_points_of_real_heads(ict: Head, makehuman: Head) -> None:
    base = base_mesh(*ict, *makehuman)
    assert_clean(base)
    assert (len(base.names), len(base.faces), base.warnings) == (57, 92, ())
    assert {loop.surrounds: len(loop.vertices) for loop in base.loops} == {
        "outer": 10,
        "mouth": 8,
        "left eye": 4,
        "right eye": 4,
    }


def test_points_without_names_find_the_same_openings(ict: Head) -> None:
    free = nameless(ict)
    base = base_mesh(*free, *free)
    assert_clean(base)
    assert base.warnings == ()
    assert len(base.names) == 57
    loops = [{base.names[k].removeprefix("free ") for k in loop.vertices} for loop in base.loops[1:]]
    assert {"2.2", "2.3", "2.4", "2.5", "2.6", "2.7", "2.8", "2.9"} in loops
    assert {"3.1", "3.3", "3.7", "3.11"} in loops
    assert {"3.2", "3.4", "3.8", "3.12"} in loops


def test_one_eye_is_enough(ict: Head) -> None:
    head = nameless(ict, without=("3.2", "3.4", "3.8", "3.12"))
    assert_clean(base_mesh(*head, *head))


def test_free_points_of_a_real_pair(shared_data: Path) -> None:
    archive = np.load(shared_data / "pair_ict_id02_to_id04_decim.npz")
    source = TriMesh(archive["src_vertices"], archive["src_tris"])
    target = TriMesh(archive["tgt_vertices"], archive["tgt_tris"])
    base = base_mesh(
        source,
        read_points(shared_data / "pair_source_points.json", source),
        target,
        read_points(shared_data / "pair_target_points.json", target),
    )
    assert_clean(base)
    assert sorted(loop.surrounds for loop in base.loops) == ["left eye", "mouth", "outer", "right eye"]
    assert len(base.names) >= 100


def test_points_between_are_inserted_and_openings_stay(ict: Head) -> None:
    mesh, points = ict
    middles = points.positions(mesh.vertices)[np.array([0, 4, 5, 10, 19, 35])] * 0.5
    middles += points.positions(mesh.vertices)[points.index(["2.10", "9.15", "2.10", "11.1", "5.1", "cheek_l_2"])] * 0.5
    vertices = np.linalg.norm(mesh.vertices[:, None] - middles, axis=2).argmin(axis=0)
    more = points.joined(on_vertices(mesh, np.unique(vertices)))
    plain, base = base_mesh(*ict, *ict), base_mesh(mesh, more, mesh, more)
    assert_clean(base)
    assert set(base.names) == set(more.names)
    assert len(base.faces) == len(plain.faces) + 2 * len(np.unique(vertices))
    before = [{plain.names[k] for k in loop.vertices} for loop in plain.loops]
    assert [{base.names[k] for k in loop.vertices} for loop in base.loops] == before


def test_inserted_points_make_a_delaunay_triangulation_of_a_plane() -> None:
    rng = np.random.default_rng(3)
    flat = np.concatenate([[[0, 0], [1, 0], [1, 1], [0, 1]], rng.uniform(0.1, 0.9, (30, 2))])
    positions = np.concatenate([flat, np.zeros((34, 1))], axis=1)
    placed = PlacedPoints(positions, np.tile([0.0, 0, 1], (34, 1)))
    faces = insert_points(np.array([[0, 1, 2], [0, 2, 3]]), np.arange(4, 34), [placed, placed])
    assert (TriMesh(positions, faces).face_normals[:, 2] > 0).all()
    assert len(faces) == 62
    a, b, c = (flat[faces[:, k]] for k in range(3))
    for point in flat:
        rows = [np.concatenate([p - point, ((p - point) ** 2).sum(axis=1, keepdims=True)], axis=1) for p in (a, b, c)]
        assert (np.linalg.det(np.stack(rows, axis=1)) < 1e-9).all()


def test_the_dual_of_a_dome_is_a_disc() -> None:
    mesh = dome()
    points = spread(mesh, 40)
    base = base_mesh(mesh, points, mesh, points)
    assert_clean(base)
    assert len(base.loops) == 1
    assert base.warnings == ()
    assert (as_mesh(base, (mesh, points)).face_normals[:, 2] > 0).all()


def test_the_artists_triangles_are_used_and_turned_outwards() -> None:
    mesh = dome()
    points = spread(mesh, 40)
    made = base_mesh(mesh, points, mesh, points)
    named = [tuple(made.names[k] for k in corners) for corners in made.faces]
    for triangles in (named, [corners[::-1] for corners in named]):
        base = base_mesh(mesh, points, mesh, points, triangles)
        assert {frozenset(base.names[k] for k in corners) for corners in base.faces} == set(map(frozenset, named))
        assert (as_mesh(base, (mesh, points)).face_normals[:, 2] > 0).all()


@pytest.mark.parametrize(
    ("triangles", "message"),
    [
        ([("a", "b", "nobody")], "'nobody'"),
        ([("a", "b", "c"), ("a", "b", "d"), ("b", "a", "e")], "edge a - b"),
        ([("a", "b", "c"), ("a", "b", "d")], "face different ways"),
        ([("a", "b", "c"), ("a", "d", "e")], "point a alone"),
        ([], "no triangles"),
    ],
)
def test_wrong_triangles_are_refused(triangles: list[tuple[str, str, str]], message: str) -> None:
    mesh = dome()
    points = spread(mesh, 5)
    points = FeaturePoints(("a", "b", "c", "d", "e"), points.vertices, points.weights)
    with pytest.raises(RetargetError, match=message):
        base_mesh(mesh, points, mesh, points, triangles)


def test_too_few_points_are_refused() -> None:
    mesh = dome()
    points = spread(mesh, 10)
    with pytest.raises(RetargetError, match="10 feature points in common"):
        base_mesh(mesh, points, mesh, points)


def test_folds_on_the_target_are_named() -> None:
    mesh = dome()
    points = spread(mesh, 40)
    middle = np.abs(points.positions(mesh.vertices)[:, :2]).sum(axis=1).argsort()[:2]
    swapped = points.vertices.copy()
    swapped[middle] = swapped[middle[::-1]]
    base = base_mesh(mesh, points, mesh, FeaturePoints(points.names, swapped, points.weights))
    (warning,) = base.warnings
    assert "folds over on the target" in warning
    assert points.names[middle[0]] in warning


def test_the_best_manifold_part() -> None:
    faces = np.array([[0, 1, 2], [0, 2, 3], [0, 1, 4], [3, 5, 6], [7, 8, 9]])
    part = manifold_part(faces, np.array([0.0, 0, 1, 0, 0]), 10)
    assert {tuple(sorted(face)) for face in part.tolist()} == {(0, 1, 2), (0, 2, 3)}
