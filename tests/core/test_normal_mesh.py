"""Normal meshes: on the surface, rebuilt exactly, openings open, few piercing errors."""

from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.core.base.base_mesh import BaseMesh, base_mesh
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.levels.butterfly import butterfly
from facial_retarget_addon.core.levels.normal_mesh import NormalMesh, build_normal_mesh
from facial_retarget_addon.core.levels.normal_synthesis import NormalSynthesis
from facial_retarget_addon.core.levels.piercing import outliers, pierce
from facial_retarget_addon.core.levels.subdivision import Scheme, boundary_parameters, hierarchy, loop
from facial_retarget_addon.core.levels.vertex_neighbours import adjacency, mean_of_known, neighbour_median
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.core.raycast import EmbreeCaster
from facial_retarget_addon.files.points import read_points

from .test_base_mesh import dome, spread


def resampled(mesh: TriMesh, points: FeaturePoints, levels: int, scheme: Scheme = loop) -> tuple[BaseMesh, NormalMesh]:
    base = base_mesh(mesh, points, mesh, points)
    steps = hierarchy(base.faces, len(base.names), levels, scheme)
    return base, build_normal_mesh(mesh, points.subset(base.names), base.loops, steps)


@pytest.fixture(scope="module")
def bumpy() -> TriMesh:
    mesh = dome(81)
    return mesh.with_vertices(mesh.vertices * (1 + 0.03 * np.sin(9 * mesh.vertices).prod(axis=1))[:, None])


@pytest.fixture(scope="module", params=[loop, butterfly], ids=["loop", "butterfly"])
def scheme(request: pytest.FixtureRequest) -> Scheme:
    chosen: Scheme = request.param
    return chosen


@pytest.fixture(scope="module")
def made(bumpy: TriMesh, scheme: Scheme) -> tuple[BaseMesh, NormalMesh]:
    return resampled(bumpy, spread(bumpy, 40), 4, scheme)


def test_old_vertices_of_the_butterfly_stay(bumpy: TriMesh) -> None:
    made = resampled(bumpy, spread(bumpy, 40), 3, butterfly)[1]
    positions = made.base
    for level in made.levels:
        assert np.abs(level.positions[: len(positions)] - positions).max() < 1e-9
        assert not level.offsets[: len(positions)].any()
        positions = level.positions


def test_every_vertex_lies_where_it_says(bumpy: TriMesh, made: tuple[BaseMesh, NormalMesh]) -> None:
    for level in made[1].levels:
        assert (level.place_face >= 0).all()
        assert np.allclose(level.place_weights.sum(axis=1), 1)
        there = np.einsum("nk,nkc->nc", level.place_weights, bumpy.vertices[bumpy.faces[level.place_face]])
        assert np.abs(there - level.positions).max() < 1e-5
        assert (TriMesh(level.positions, level.faces).face_normals[:, 2] > 0).all()


def test_a_simple_face_has_no_piercing_errors(made: tuple[BaseMesh, NormalMesh]) -> None:
    assert made[1].piercing_errors == [0, 0, 0, 0]


def test_finer_levels_come_nearer(bumpy: TriMesh, made: tuple[BaseMesh, NormalMesh]) -> None:
    """The offsets that are left shrink like the squared edge."""
    sizes = [np.abs(level.offsets).mean() for level in made[1].levels]
    assert sizes[3] < sizes[2] / 2.5 < sizes[1] / 6


def test_synthesis_gives_the_face_back(made: tuple[BaseMesh, NormalMesh]) -> None:
    normal_mesh = made[1]
    frames = NormalSynthesis(normal_mesh).frames(np.repeat(normal_mesh.base[None], 3, axis=0))
    assert frames.dtype == np.float32
    assert frames.shape == (3, *normal_mesh.levels[-1].positions.shape)
    assert np.abs(frames - normal_mesh.levels[-1].positions).max() < 5e-6


def test_offsets_may_differ_by_frame(made: tuple[BaseMesh, NormalMesh]) -> None:
    normal_mesh = made[1]
    synthesis = NormalSynthesis(normal_mesh)
    base = np.repeat(normal_mesh.base[None], 2, axis=0)
    varied = [np.stack([level.offsets, 1.5 * level.offsets]) for level in normal_mesh.levels]
    frames = synthesis.frames(base, varied)
    assert np.array_equal(frames[0], synthesis.frames(base)[0])
    stronger = [1.5 * level.offsets for level in normal_mesh.levels]
    assert np.array_equal(frames[1], synthesis.frames(base[:1], stronger)[0])
    assert np.abs(frames[0] - frames[1]).max() > 1e-3
    with pytest.raises(RetargetError, match="offsets of level 4"):
        synthesis.frames(base, [*varied[:3], varied[3][:, 1:]])


def test_a_turned_and_scaled_face_gives_the_same_places(
    bumpy: TriMesh, made: tuple[BaseMesh, NormalMesh], scheme: Scheme
) -> None:
    turn = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    other = bumpy.with_vertices(7 * bumpy.vertices @ turn.T + [3, -4, 5])
    points = spread(bumpy, 40)
    again = resampled(other, points, 3, scheme)[1]
    assert np.abs(again.levels[2].positions - (7 * made[1].levels[2].positions @ turn.T + [3, -4, 5])).max() < 1e-3


def test_a_border_of_the_mesh_is_kept() -> None:
    whole = dome(41)
    keep = (np.linalg.norm(whole.vertices[whole.faces].mean(axis=1)[:, :2], axis=1) > 0.25) & (
        whole.vertices[whole.faces][:, :, 2] > 0.35
    ).all(axis=1)
    mesh = TriMesh(whole.vertices, whole.faces[keep])
    rings = [ring[:: max(1, len(ring) // 10)] for ring in mesh.boundary_loops]
    inner = [v for v in np.unique(mesh.faces) if not mesh.boundary_vertices[v] and v % 23 == 0]
    vertices = np.array([*rings[0], *rings[1], *inner])
    names = tuple(f"free_{v}" for v in vertices)
    points = FeaturePoints(names, np.repeat(vertices[:, None], 3, axis=1), np.tile([1.0, 0, 0], (len(vertices), 1)))
    base, normal_mesh = resampled(mesh, points, 3)
    assert len(base.loops) == 2
    edges = mesh.vertices[mesh.boundary_edges]
    finest = normal_mesh.levels[-1]
    at = finest.positions[finest.boundary]
    along = edges[:, 1] - edges[:, 0]
    share = np.einsum("nei,ei->ne", at[:, None] - edges[:, 0], along) / np.einsum("ei,ei->e", along, along)
    nearest = edges[:, 0] + np.clip(share, 0, 1)[..., None] * along
    gap = np.linalg.norm(at[:, None] - nearest, axis=2).min(axis=1)
    on_border = mesh.boundary_vertices[points.subset(base.names).vertices[:, 0]]
    steps = boundary_parameters([ring.vertices for ring in base.loops], normal_mesh.steps)[-1]
    checked = 0
    for ring, (vertices, parameters) in zip(base.loops, steps, strict=True):
        kept = on_border[ring.vertices] & np.roll(on_border[ring.vertices], -1)
        mine = kept[np.floor(parameters).astype(int)]
        rows = np.searchsorted(finest.boundary, vertices[mine])
        assert gap[rows].max() < 1e-6
        checked += len(rows)
    assert checked > 100


def test_hits_of_other_sheets_do_not_count() -> None:
    near = dome(21)
    back = TriMesh(
        np.concatenate([near.vertices, near.vertices - [0, 0, 0.05]]),
        np.concatenate([near.faces, near.faces[:, ::-1] + len(near.vertices)]),
    )
    top = np.array([[0.0, 0.0, 0.96]])
    up = np.array([[0.0, 0.0, 1.0]])
    found = pierce(back, EmbreeCaster(back), top, up, np.array([0.1]))
    assert found.face[0] < len(near.faces)
    assert found.offset[0] == pytest.approx(0.04, abs=1e-3)
    assert pierce(back, EmbreeCaster(back), top, up, np.array([0.01])).face[0] == -1
    assert pierce(back, EmbreeCaster(back), top, -up, np.array([0.1])).face[0] >= len(near.faces)


def test_outliers_and_means_of_neighbours() -> None:
    mesh = dome(9)
    neighbours = adjacency(mesh)
    offsets = 0.01 * mesh.vertices[:, 0]
    hit = np.ones(len(offsets), bool)
    offsets[40] = 5.0
    far = outliers(neighbours, offsets, hit, np.full(len(offsets), 0.3))
    assert np.flatnonzero(far).tolist() == [40]
    assert np.isnan(neighbour_median(neighbours, offsets, ~hit)).all()
    unknown = np.array([39, 40, 41])
    fill = mean_of_known(neighbours, unknown)
    assert np.allclose(fill.sum(axis=1), 1)
    assert fill[:, unknown].nnz == 0
    values = mesh.vertices[:, 1].copy()
    values[unknown] = fill @ values
    assert np.allclose(values[unknown], (neighbours[unknown] @ values) / neighbours[unknown].sum(axis=1).A1)


def test_a_hierarchy_of_another_base_is_refused(bumpy: TriMesh, made: tuple[BaseMesh, NormalMesh]) -> None:
    base, normal_mesh = made
    with pytest.raises(RetargetError, match=r"starts from \d+ base vertices, but 10 points"):
        build_normal_mesh(bumpy, spread(bumpy, 10), base.loops, normal_mesh.steps)


@pytest.fixture(scope="module")
def ict(shared_data: Path) -> tuple[BaseMesh, NormalMesh]:
    """A real head: pockets behind lips and lids, closed lips, closed behind."""
    archive = np.load(shared_data / "ict_dev.npz")
    skin = np.isin(archive["vert_part"], np.arange(6))
    mesh = TriMesh(archive["vertices"], archive["tris"][skin[archive["tris"]].all(axis=1)])
    return resampled(mesh, read_points(shared_data / "ict_points.json", mesh), 4)


def test_piercing_errors_of_a_real_head_are_the_papers(ict: tuple[BaseMesh, NormalMesh]) -> None:
    assert ict[1].levels[-1].failed.mean() <= 0.0008


def test_a_real_head_has_no_spikes(ict: tuple[BaseMesh, NormalMesh]) -> None:
    finest = ict[1].levels[-1]
    mesh = TriMesh(finest.positions, finest.faces)
    around = adjacency(mesh)
    mean = (around @ finest.positions) / np.diff(around.indptr)[:, None]
    away = np.linalg.norm(finest.positions - mean, axis=1) / mesh.vertex_edge_length
    assert (away[~mesh.boundary_vertices] > 1.5).mean() < 0.001


def test_synthesis_gives_a_real_head_back(ict: tuple[BaseMesh, NormalMesh]) -> None:
    normal_mesh = ict[1]
    assert sum(normal_mesh.second_looks) > 0
    frames = NormalSynthesis(normal_mesh).frames(normal_mesh.base[None])
    size = np.ptp(normal_mesh.base, axis=0).max()
    assert np.abs(frames[0] - normal_mesh.levels[-1].positions).max() < 1e-5 * size


def test_lips_stay_apart(ict: tuple[BaseMesh, NormalMesh]) -> None:
    """Along the mouth's border the upper lip never runs below the lower one by more than a lip's roll."""
    base, normal_mesh = ict
    mouth = next(loop for loop in base.loops if loop.surrounds == "mouth")
    ((vertices, parameters),) = boundary_parameters([mouth.vertices], normal_mesh.steps)[-1]
    names = [base.names[k] for k in mouth.vertices]
    border = normal_mesh.levels[-1].positions[vertices]
    corners = sorted(names.index(name) for name in ("2.4", "2.5"))
    first = (parameters > corners[0]) & (parameters < corners[1])
    second = (parameters > corners[1]) | (parameters < corners[0])
    upper, lower = (first, second) if names.index("2.2") in range(*corners) else (second, first)
    order = np.argsort(border[lower, 0])
    below = np.interp(border[upper, 0], border[lower, 0][order], border[lower, 1][order])
    width = np.ptp(border[:, 0])
    assert (border[upper, 1] - below > -0.01 * width).all()
    assert np.mean(border[upper, 1] - below) > 0
