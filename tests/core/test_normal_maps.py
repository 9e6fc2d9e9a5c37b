"""Normal maps: texels, tangents, and what a shader makes of them."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.gains import Gains, Mask
from facial_retarget_addon.core.level_retargeter import LevelRetargeter
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.methods.base import fit
from facial_retarget_addon.core.methods.settings import HierarchicalSettings, MapSettings
from facial_retarget_addon.core.normal_maps.chart import disc_chart
from facial_retarget_addon.core.normal_maps.frame_maps import FrameMaps
from facial_retarget_addon.core.normal_maps.normal_map import fit_normal_map
from facial_retarget_addon.core.normal_maps.strain import ramp, strain
from facial_retarget_addon.core.normal_maps.surface import TexturedSurface, shaded_triangles
from facial_retarget_addon.core.normal_maps.tangents import TangentSpace
from facial_retarget_addon.core.normal_maps.texels import margin, rasterise, tiles
from facial_retarget_addon.core.problem import Problem

SQUARE = np.array([[[0, 0], [1, 0], [1, 1]], [[0, 0], [1, 1], [0, 1]]], float)


def cap(side: int, mirrored: bool = False) -> TexturedSurface:
    """A cap of the unit sphere of side * side vertices; its texture is the grid, its right half mirrored if asked."""
    x, y = np.meshgrid(np.linspace(-1, 1, side), np.linspace(-1, 1, side))
    places = np.stack([x, y, np.ones_like(x)], axis=-1).reshape(-1, 3)
    places /= np.linalg.norm(places, axis=1, keepdims=True)
    grid = np.arange(side * side).reshape(side, side)
    quads = np.stack([grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]], axis=-1).reshape(-1, 4)
    counts, corners = np.full(len(quads), 4), quads.ravel()
    uvs = np.stack([x, y], axis=-1).reshape(-1, 2)[corners] * 0.49 + 0.5
    if mirrored:
        uvs[:, 0] = 0.5 - np.abs(uvs[:, 0] - 0.5)
    return TexturedSurface(TriMesh.from_polygons(places, counts, corners), counts, corners, uvs)


def shaded(surface: TexturedSurface, positions: np.ndarray, face: int, weights: np.ndarray, pixel: np.ndarray):
    """What a shader makes of a pixel: the frame's columns T, B, N at the place, times the pixel."""
    space = TangentSpace(surface.mesh.faces, surface.triangle_uvs)
    normals = surface.normals(positions)
    normal = weights @ normals[surface.mesh.faces[face]]
    tangent = weights @ space.tangents(positions, normals)[space.group[face]]
    made = pixel[0] * tangent + pixel[1] * space.sign[face] * np.cross(normal, tangent) + pixel[2] * normal
    return made / np.linalg.norm(made)


def test_texels_cover_every_centre_once_and_lie_where_they_say() -> None:
    texels = rasterise(SQUARE, 16)
    np.testing.assert_array_equal(texels.pixel, np.arange(256))
    places = np.einsum("tk,tki->ti", texels.weights, SQUARE[texels.face])
    wanted = np.stack([texels.pixel % 16 + 0.5, texels.pixel // 16 + 0.5], axis=1) / 16
    np.testing.assert_allclose(places, wanted, atol=1e-12)


def test_of_triangles_in_one_place_the_last_has_the_pixels() -> None:
    twice = np.concatenate([SQUARE, SQUARE[1:]])
    texels = rasterise(twice, 8)
    assert set(texels.face) == {0, 2}


def test_quads_are_cut_as_blender_cuts_them() -> None:
    """From the first corner to the third, although the other cut is shorter; the other way where that would fold."""
    long = [[0, 0, 0], [1, 0, 0], [3, 0.5, 0], [0, 1, 0]]
    dart = [[4, 0, 0], [5, 2, 0], [4, 0.5, 0], [3, 2, 0]]
    places = np.array([*long, *np.roll(dart, -1, axis=0), [4, 3, 0], [5, 3, 0], [5, 4, 0]], float)
    counts, corners = np.array([4, 4, 3]), np.arange(11)
    cut = shaded_triangles(TriMesh.from_polygons(places, counts, corners), counts, corners)
    assert cut.faces.tolist() == [[0, 1, 2], [0, 2, 3], [4, 5, 7], [5, 6, 7], [8, 9, 10]]
    assert cut.polygons.tolist() == [0, 0, 1, 1, 2]


def test_blocks_of_any_size_give_the_same_texels(monkeypatch: pytest.MonkeyPatch) -> None:
    uvs = cap(9).triangle_uvs
    whole = rasterise(uvs, 64)
    monkeypatch.setattr("facial_retarget_addon.core.normal_maps.texels._BLOCK", 50)
    for one, other in zip(whole, rasterise(uvs, 64), strict=True):
        np.testing.assert_array_equal(one, other)


def test_tiles_are_udim_tiles_and_only_their_own_triangles_are_in_them() -> None:
    shifted = np.concatenate([SQUARE, SQUARE[:1] * 0.999 + [2.0, 1.0]])
    assert tiles(shifted) == [(0, 0), (2, 1)]
    assert set(rasterise(shifted, 8, (2, 1)).face) == {2}


def test_what_lies_outside_of_the_udim_tiles_has_none() -> None:
    outside = [SQUARE + move for move in ([-1.0, 0.0], [0.0, -1.0], [10.0, 0.0], [0.0, 100.0])]
    assert tiles(np.concatenate([*outside, SQUARE + [9.0, 3.0]])) == [(9, 3)]
    # A half that lies a tile to the left of the other takes no pixel from it.
    assert set(rasterise(np.concatenate([SQUARE, SQUARE - [1.0, 0.0]]), 8).face) == {0, 1}


def test_the_margin_copies_the_nearest_pixel() -> None:
    covered = np.array([3 * 8 + 3, 3 * 8 + 4])
    around, nearest = margin(covered, 8, 1)
    assert sorted(around.tolist()) == [19, 20, 26, 29, 35, 36]
    assert nearest[around.tolist().index(26)] == 0
    assert nearest[around.tolist().index(29)] == 1
    assert not len(margin(covered, 8, 0)[0])


def test_tangents_run_along_u_and_mirrored_ones_have_a_sign() -> None:
    surface = cap(9, mirrored=True)
    space = TangentSpace(surface.mesh.faces, surface.triangle_uvs)
    normals = surface.normals(surface.mesh.vertices)
    tangents = space.tangents(surface.mesh.vertices, normals)
    right = surface.mesh.vertices[surface.mesh.faces].mean(axis=1)[:, 0] > 0
    np.testing.assert_array_equal(space.sign, np.where(right, -1, 1))
    assert (tangents[space.group][~right][..., 0] > 0.6).all()
    assert (tangents[space.group][right][..., 0] < -0.6).all()
    np.testing.assert_allclose(np.einsum("gi,gi->g", tangents, normals[space.vertex]), 0, atol=1e-12)
    # On the middle line the two halves share vertices, and no tangents.
    assert space.count > len(surface.mesh.vertices)


@pytest.mark.parametrize("mirrored", [False, True])
def test_a_shader_gets_the_fine_mesh_back(mirrored: bool) -> None:
    light, fine = cap(9, mirrored), cap(65).mesh
    made = fit_normal_map(light, fine, 128)
    assert made.missed == 0
    # A frame: the cap bulges unevenly and turns.
    turn = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))

    def frame(mesh: TriMesh) -> np.ndarray:
        return (mesh.vertices * [1.0, 1.3, 0.8]) @ turn.T

    pixels = made.vectors(frame(light.mesh), frame(fine)).reshape(-1, 3)
    np.testing.assert_allclose(np.linalg.norm(pixels, axis=1), 1, atol=1e-5)
    texels = rasterise(light.triangle_uvs, 128)
    truth = fine.with_vertices(frame(fine)).vertex_normals
    off = []
    for row in np.random.default_rng(1).integers(0, len(texels.pixel), 200):
        face, weights = texels.face[row], texels.weights[row]
        seen = shaded(light, frame(light.mesh), face, weights, pixels[texels.pixel[row]])
        place = weights @ light.mesh.vertices[light.mesh.faces[face]]
        nearest = np.argmin(np.linalg.norm(fine.vertices - place / np.linalg.norm(place), axis=1))
        off.append(np.degrees(np.arccos(np.clip(seen @ truth[nearest], -1, 1))))
    # The nearest fine vertex is up to half an edge away: 1.1 degrees of the sphere.
    assert max(off) < 1.8, max(off)
    assert np.median(off) < 0.8


def test_a_mesh_on_itself_is_flat_and_so_is_what_has_nothing_above_it() -> None:
    light = cap(9)
    made = fit_normal_map(light, light.mesh, 64)
    pixels = made.vectors(light.mesh.vertices, light.mesh.vertices)
    assert pixels[..., 2].min() > 0.999  # polygons weigh by angle on the one side, triangles by area on the other
    away = fit_normal_map(light, light.mesh.with_vertices(light.mesh.vertices + [0, 0, 9.0]), 64)
    assert away.missed == len(away.pixel)
    np.testing.assert_array_equal(away.vectors(light.mesh.vertices, light.mesh.vertices + 9), [[[0, 0, 1]] * 64] * 64)


def test_texture_coordinates_outside_the_tile_are_refused() -> None:
    light = cap(5)
    with pytest.raises(RetargetError, match=r"from \(0.01, 0.01\) to \(0.99, 0.99\) cover no pixel of UDIM tile 1012"):
        fit_normal_map(light, light.mesh, 32, tile=(1, 1))
    with pytest.raises(RetargetError, match=r"shape \(3, 2\), expected \(64, 2\)"):
        TexturedSurface(light.mesh, light.counts, light.corners, np.zeros((3, 2)))


def test_a_chart_of_a_surface_with_holes_has_no_overlaps() -> None:
    whole = cap(17).mesh
    middle = whole.vertices[whole.faces].mean(axis=1)
    kept = np.linalg.norm(middle[:, :2] - [0.3, 0.2], axis=1) > 0.15
    holed = TriMesh(whole.vertices, whole.faces[kept])
    uvs = disc_chart(holed)[holed.faces]
    one, two = uvs[:, 1] - uvs[:, 0], uvs[:, 2] - uvs[:, 0]
    area = one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]
    assert area.min() > 0
    assert 0 < uvs.min() < uvs.max() < 1
    assert area.sum() / 2 < np.pi / 4
    with pytest.raises(RetargetError, match="0 borders"):
        disc_chart(TriMesh(np.eye(4)[:, :3], np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])))


def test_strain_is_the_share_of_length_that_skin_loses_or_gains() -> None:
    mesh = cap(17).mesh
    middle = np.linalg.norm(mesh.vertices[:, :2], axis=1) < 0.15
    for factor, wanted in ((0.7, 0.3), (1.25, 0.2)):
        found = strain(mesh, mesh.vertices * [factor, 1.0, 1.0] - mesh.vertices)
        np.testing.assert_allclose(found[middle], wanted, atol=0.02)
    # Turned and moved, nothing changes; grown, all of it.
    turn = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    np.testing.assert_allclose(strain(mesh, mesh.vertices @ turn.T + 5 - mesh.vertices), 0, atol=1e-9)
    np.testing.assert_allclose(strain(mesh, mesh.vertices), 0.5, atol=1e-9)


def test_a_mask_rises_smoothly_from_nothing_to_full() -> None:
    mask = ramp(np.linspace(0, 0.3, 301), 0.02, 0.15)
    assert mask[20] == 0
    assert mask[151] == 1
    np.testing.assert_allclose(mask[85], 0.5, atol=1e-9)
    assert (np.diff(mask) >= 0).all()


class Fitted(NamedTuple):
    """A fitted pair, its performance, and its target."""

    retargeter: LevelRetargeter
    problem: Problem
    performance: np.ndarray
    child: demo.DemoFace


@pytest.fixture(scope="module")
def fitted() -> Fitted:
    """The built-in actor onto the child, and the actor's performance."""
    actor, child = demo.actor(6_000), demo.child()
    problem = Problem(actor.face, child.face)
    return Fitted(fit("hierarchical", problem, HierarchicalSettings(levels=3)), problem, demo.performance(actor), child)


def skin_surface(face: demo.DemoFace) -> TexturedSurface:
    """A built-in face as an artist's mesh with its texture coordinates."""
    return TexturedSurface(face.face.mesh, face.counts, face.corners, face.uvs[face.corners])


def test_a_performance_becomes_maps_of_the_artists_mesh(fitted: Fitted) -> None:
    retargeter, problem, performance, child = fitted
    made = FrameMaps(retargeter, problem, skin_surface(child), MapSettings(pixels=128))
    assert list(made.maps) == [(0, 0)]
    light, tiles = made.frame(performance[0])
    still = tiles[0, 0]
    np.testing.assert_array_equal(light, child.face.mesh.vertices.astype(np.float32))
    liveliest = performance[np.abs(performance - performance[0]).max(axis=(1, 2)).argmax()]
    lively = made.frame(liveliest)[1][0, 0]
    np.testing.assert_allclose(np.linalg.norm(lively, axis=2), 1, atol=1e-5)
    assert np.abs(lively - still).max() > 0.05
    again = made.frame(performance[0])[1][0, 0]
    np.testing.assert_array_equal(still, again)


def test_eyes_over_the_skin_in_the_texture_take_no_pixel_of_it(fitted: Fitted) -> None:
    _, problem, performance, child = fitted
    mesh, ball = child.face.mesh, cap(5)
    count = len(mesh.vertices)
    vertices = np.concatenate([mesh.vertices, ball.mesh.vertices * 5 + mesh.vertices.mean(axis=0)])
    corners = np.concatenate([child.corners, ball.corners + count])
    counts = np.concatenate([child.counts, ball.counts])
    uvs = np.concatenate([child.uvs[child.corners], ball.uvs])
    whole = TexturedSurface(TriMesh.from_polygons(vertices, counts, corners), counts, corners, uvs)
    headed = Problem(replace(problem.source, examples={}), replace(problem.target, mesh=whole.mesh, examples={}))
    fitted_head = fit("hierarchical", headed, HierarchicalSettings(levels=3))
    assert isinstance(fitted_head, LevelRetargeter)
    assert fitted_head.skin[child.face.points.vertices].all()
    assert not fitted_head.skin[count:].any()
    settings = MapSettings(pixels=64)
    with_ball = FrameMaps(fitted_head, headed, whole, settings)
    bare = Problem(headed.source, replace(problem.target, examples={}))
    alone = FrameMaps(fit("hierarchical", bare, HierarchicalSettings(levels=3)), bare, skin_surface(child), settings)
    assert len(with_ball.frame(performance[0])[0]) == len(vertices)
    np.testing.assert_array_equal(with_ball.mapped.mesh.faces, alone.mapped.mesh.faces)
    shown = with_ball.mapped.shown_polygons
    assert shown is not None
    assert not shown[len(child.counts) :].any()
    assert shown.sum() == len(np.unique(alone.mapped.mesh.polygons))
    assert with_ball.surface.shown_polygons is None
    one, two = (maps.frame(performance[9])[1][0, 0] for maps in (with_ball, alone))
    np.testing.assert_allclose(one, two, atol=1e-3)


def test_a_level_gets_a_chart_and_its_maps(fitted: Fitted) -> None:
    retargeter, problem, performance, _ = fitted
    made = FrameMaps(retargeter, problem, None, MapSettings(level=1, pixels=64))
    assert len(made.surface.mesh.faces) == len(retargeter.level_faces(1))
    assert made.maps[0, 0].missed < 0.01 * len(made.maps[0, 0].pixel)
    light, tiles = made.frame(performance[0])
    assert tiles[0, 0].shape == (64, 64, 3)
    assert len(light) == len(made.surface.mesh.vertices)
    with pytest.raises(RetargetError, match="level 4 was asked for, and the method has levels 1 to 3"):
        FrameMaps(retargeter, problem, None, MapSettings(level=4, pixels=64))


def test_a_face_whose_motion_is_turned_off_keeps_its_maps(fitted: Fitted) -> None:
    retargeter, problem, performance, child = fitted
    masked = replace(problem, gains=Gains(masks={"all": Mask(np.ones(len(child.face.mesh.vertices)), 0.0)}))
    made = FrameMaps(retargeter, masked, skin_surface(child), MapSettings(pixels=64))
    still, lively = (made.frame(frame)[1][0, 0] for frame in (performance[0], performance[len(performance) // 2]))
    np.testing.assert_allclose(lively, still, atol=1e-5)
