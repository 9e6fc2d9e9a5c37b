"""The base mesh as lines on a surface."""

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.base.base_mesh import base_mesh
from facial_retarget_addon.core.base.surface_lines import PIECES, surface_lines
from facial_retarget_addon.core.closest_point import SurfaceFinder
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.points import FeaturePoints


@pytest.fixture(scope="module")
def actor() -> demo.DemoFace:
    return demo.actor(6_000)


def base_of(mesh: TriMesh, points: FeaturePoints) -> tuple[FeaturePoints, np.ndarray]:
    base = base_mesh(mesh, points, mesh, points)
    return points.subset(base.names), base.faces


def test_lines_lie_on_the_surface_from_point_to_point(actor: demo.DemoFace) -> None:
    mesh = actor.face.mesh
    points, faces = base_of(mesh, actor.face.points)
    lines = surface_lines(mesh, points, faces)
    places = lines.places(mesh.vertices)
    edges = TriMesh(np.zeros((len(points), 3)), faces).edges
    assert lines.pieces.shape == (PIECES * len(edges), 2)
    assert SurfaceFinder(mesh).closest(places).distance.max() < 1e-9 * mesh.size
    np.testing.assert_allclose(places[: len(points)], points.positions(mesh.vertices), atol=1e-12)
    ends = np.bincount(lines.pieces.ravel())
    assert (ends[len(points) :] == 2).all(), "a place inside a line has two pieces"
    assert np.array_equal(ends[: len(points)], np.bincount(edges.ravel()))


def test_lines_move_with_the_surface(actor: demo.DemoFace) -> None:
    mesh = actor.face.mesh
    lines = surface_lines(mesh, *base_of(mesh, actor.face.points))
    turn = np.array([[0.0, -2, 0], [2, 0, 0], [0, 0, 2]])
    np.testing.assert_allclose(lines.places(mesh.vertices @ turn), lines.places(mesh.vertices) @ turn, atol=1e-9)


def test_folded_triangles_are_named(actor: demo.DemoFace) -> None:
    mesh, sound = actor.face.mesh, actor.face.points
    points, faces = base_of(mesh, sound)
    assert not surface_lines(mesh, points, faces).folded_names
    one, other = points.index(["5.1", "9.1"])
    vertices = points.vertices.copy()
    vertices[[one, other]] = vertices[[other, one]]
    swapped = surface_lines(mesh, FeaturePoints(points.names, vertices, points.weights), faces)
    assert {"5.1", "9.1"} <= swapped.folded_names
    assert len(swapped.folded)
