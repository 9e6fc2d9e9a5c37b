"""A place slides along the surface that it lies on: not through it, not onto another sheet."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.core.arrays import FloatArray
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.raycast import EmbreeCaster
from facial_retarget_addon.core.sliding import Place, Slide
from facial_retarget_addon.core.view_rays import View
from facial_retarget_addon.files.points import read_points

SIZE = np.array([400.0, 400.0])
VIEW = np.eye(4)
VIEW[2, 3] = -10.0
WINDOW = np.diag([0.5, 0.5, -0.02, 1.0])
"""Orthographic, from +z: 100 pixels are 1 unit, the middle is pixel (200, 200)."""


class Scene:
    """A mesh in the view."""

    def __init__(self, mesh: TriMesh, view: View | None = None) -> None:
        self.mesh, self.view, self._caster = mesh, view or View(SIZE, VIEW, WINDOW), EmbreeCaster(mesh)

    def hit(self, pixel: FloatArray) -> Place | None:
        origin, direction = self.view.ray(pixel)
        hits = self._caster.nearest(origin[None], direction[None])
        if not hits.found[0]:
            return None
        corners = self.mesh.faces[hits.face[0]]
        return Place(corners, hits.weights[0], hits.weights[0] @ self.mesh.vertices[corners])

    def slide(self, x: float, y: float) -> Slide:
        place = self.hit(np.array([x, y]))
        assert place is not None
        return Slide(self.view, self.hit, self.mesh.graph, place)

    def seen(self, place: Place) -> FloatArray:
        return self.view.pixels(place.position[None])[0]


def height_field(side: int, height: object, extent: float = 1.8) -> TriMesh:
    axis = np.linspace(-extent, extent, side)
    x, y = (part.ravel() for part in np.meshgrid(axis, axis))
    first = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    quads = first[:, None] + [0, 1, side + 1, side]
    return TriMesh.from_polygons(
        np.stack([x, y, height(x, y)], axis=1),  # type: ignore[operator]
        np.full(len(quads), 4),
        quads.ravel(),
    )


def turned(radius: FloatArray, height: FloatArray, side: int = 60) -> TriMesh:
    """A profile turned around the z axis, outermost first seen from above: its rings joined by quads."""
    turn = np.linspace(0, 2 * np.pi, side, endpoint=False)
    vertices = np.stack(
        [radius[:, None] * np.cos(turn), radius[:, None] * np.sin(turn), np.repeat(height[:, None], side, axis=1)],
        axis=2,
    )
    row, column = (part.ravel() for part in np.meshgrid(np.arange(len(radius) - 1), np.arange(side), indexing="ij"))
    after = (column + 1) % side
    quads = np.stack([row * side + column, row * side + after, (row + 1) * side + after, (row + 1) * side + column])
    return TriMesh.from_polygons(vertices.reshape(-1, 3), np.full(quads.shape[1], 4), quads.T.ravel())


def ball() -> TriMesh:
    """A ball of radius 1."""
    angle = np.linspace(np.pi - 0.01, 0.01, 60)
    return turned(np.sin(angle), np.cos(angle))


def throat() -> TriMesh:
    """A plane with an opening of radius 0.3, and a wider room of depth 1 behind it."""
    corners = np.array([[1.8, 0.0], [0.3, 0.0], [0.5, -0.3], [0.5, -1.0], [0.01, -1.0]])
    profile = np.concatenate([np.linspace(a, b, 12, endpoint=False) for a, b in pairwise(corners)])
    return turned(*np.concatenate([profile, corners[-1:]]).T)


def lips(side: int = 37, half: float = 0.4) -> TriMesh:
    """A plane with a slit along y = 0 from x = -half to half: both lips touch, and only around its ends one leads to
    the other.
    """
    flat = height_field(side, lambda x, y: 0 * x)
    vertices, faces = flat.vertices, flat.faces.copy()
    on_slit = np.flatnonzero((abs(vertices[:, 1]) < 1e-9) & (abs(vertices[:, 0]) < half))
    lower = vertices[faces].mean(axis=1)[:, 1] < 0
    copy = np.arange(len(vertices))
    copy[on_slit] = len(vertices) + np.arange(len(on_slit))
    faces[lower] = copy[faces[lower]]
    return TriMesh(np.concatenate([vertices, vertices[on_slit]]), faces)


def test_the_place_follows_the_mouse_to_the_pixel() -> None:
    scene = Scene(height_field(40, lambda x, y: 0.3 * np.sin(3 * x) * np.cos(2 * y)))
    slide, rng = scene.slide(200, 200), np.random.default_rng(0)
    for goal in rng.uniform(60, 340, (20, 2)):
        np.testing.assert_allclose(scene.seen(slide.to(goal)), goal, atol=1e-3)


def test_a_wall_that_is_nearly_seen_edge_on_is_followed() -> None:
    scene = Scene(height_field(80, lambda x, y: 2.0 * np.tanh(12 * x)))
    slide = scene.slide(120, 200)
    for x in (150, 190, 200, 203, 240, 201, 150):
        np.testing.assert_allclose(scene.seen(slide.to(np.array([x, 210.0]))), [x, 210], atol=1e-3)


def test_beside_the_surface_the_place_stays_on_the_nearest_outline() -> None:
    scene = Scene(ball())
    slide = scene.slide(220, 210)
    for angle in np.linspace(0, 2 * np.pi, 24):
        way = np.array([np.cos(angle), np.sin(angle)])
        place = slide.to(200 + 150 * way)
        np.testing.assert_allclose(scene.seen(place), 200 + 100 * way, atol=5)
        assert np.linalg.norm(scene.seen(place) - (200 + 150 * way)) < 50.5
        assert place.position[2] > -0.02
    np.testing.assert_allclose(scene.seen(slide.to(np.array([180.0, 230.0]))), [180, 230], atol=1e-3)


def test_a_place_does_not_cross_from_lip_to_lip() -> None:
    scene = Scene(lips())
    slide = scene.slide(200, 230)
    for y in (199.0, 195.0, 190.0):
        place = slide.to(np.array([203.0, y]))
        assert place.position[1] > -1e-6, y
        np.testing.assert_allclose(scene.seen(place), [203, 200], atol=2)
    # Far beyond the lip the artist means the other side; around the corner it always was one surface.
    np.testing.assert_allclose(scene.seen(slide.to(np.array([203.0, 110.0]))), [203, 110], atol=1e-3)
    slide = scene.slide(200, 230)
    for goal in ([270.0, 230.0], [270.0, 170.0], [200.0, 170.0]):
        np.testing.assert_allclose(scene.seen(slide.to(np.array(goal))), goal, atol=1e-3)


def test_a_place_does_not_jump_through_an_opening_onto_what_lies_behind() -> None:
    scene = Scene(throat())
    slide = scene.slide(260, 200)
    for x in (240.0, 228.0, 215.0, 200.0):
        place = slide.to(np.array([x, 200.0]))
        assert place.position[2] > -1e-6, x
        np.testing.assert_allclose(scene.seen(place), [max(x, 230), 200], atol=1)
    np.testing.assert_allclose(scene.seen(slide.to(np.array([260.0, 240.0]))), [260, 240], atol=1e-3)


@pytest.mark.parametrize("opened", [False, True])
def test_on_a_real_head_a_place_stays_on_its_lip(shared_data: Path, opened: bool) -> None:
    archive = np.load(shared_data / "ict_dev.npz")
    vertices = archive["vertices"].astype(float)
    if opened:
        vertices += archive["expr_delta"][list(archive["expr_names"]).index("jawOpen")]
    mesh = TriMesh(vertices, archive["tris"])
    points = read_points(shared_data / "ict_points.json", mesh)
    place = dict(zip(points.names, points.positions(vertices), strict=True))
    view = np.eye(4)
    view[:3, 3] = -0.5 * (place["8.3"] + place["8.4"]) - [0, 0, 2 * mesh.size]
    across = 1 / (3 * np.linalg.norm(place["8.3"] - place["8.4"]))
    scene = Scene(mesh, View(SIZE, view, np.diag([across, across, -0.25 / mesh.size, 1.0])))
    upper, below, lower, inside = (scene.view.pixels(place[name][None])[0] for name in ("8.1", "2.2", "8.2", "2.3"))
    slide = scene.slide(*(upper + [0, 6]))
    for share in np.linspace(0, 1, 8):
        # Down over the lip's edge, into the open mouth or onto the other lip: it stays at the edge.
        goal = (1 - share) * below + share * (0.7 * below + 0.3 * inside if opened else lower)
        reached = slide.to(goal)
        assert scene.seen(reached)[1] > below[1] - 2, share
        assert abs(reached.position[2] - place["2.2"][2]) < 0.2 * np.linalg.norm(place["8.3"] - place["8.4"])
    # The artist who goes on to the chin means the chin.
    chin = lower - [0, 40]
    np.testing.assert_allclose(scene.seen(slide.to(chin)), chin, atol=1e-3)
