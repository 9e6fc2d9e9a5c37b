"""Surface distance and regions."""

import numpy as np

from facial_retarget_addon.core.geodesic import distances_between, nearest_regions, shortcut_graph, surface_distances
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.points import FeaturePoints


def plane(size: int = 21) -> TriMesh:
    x, y = np.meshgrid(np.arange(float(size)), np.arange(float(size)))
    corner = np.add.outer(np.arange(size - 1) * size, np.arange(size - 1)).ravel()
    lower = np.stack([corner, corner + 1, corner + size + 1], axis=1)
    upper = np.stack([corner, corner + size + 1, corner + size], axis=1)
    return TriMesh(np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1), np.concatenate([lower, upper]))


def places(mesh: TriMesh, seed: int = 0, count: int = 5) -> FeaturePoints:
    rng = np.random.default_rng(seed)
    faces = rng.choice(len(mesh.faces), count, replace=False)
    names = tuple(f"p{k}" for k in range(count))
    return FeaturePoints(names, mesh.faces[faces], rng.dirichlet([1, 1, 1], count))


def test_edge_paths_from_places_inside_faces() -> None:
    mesh = plane()
    points = places(mesh)
    straight = np.linalg.norm(points.positions(mesh.vertices)[:, None] - mesh.vertices, axis=2)
    found = surface_distances(mesh, points)
    assert (found >= straight - 1e-9).all()
    assert (found <= np.sqrt(2) * straight + 2).all()
    at_corners = np.take_along_axis(found, points.vertices, axis=1)
    assert np.allclose(at_corners, np.take_along_axis(straight, points.vertices, axis=1))


def test_shortcuts_come_nearer_to_straight_lines() -> None:
    mesh = plane()
    points = places(mesh)
    straight = np.linalg.norm(points.positions(mesh.vertices)[:, None] - mesh.vertices, axis=2)
    edges = surface_distances(mesh, points)
    shorter = surface_distances(mesh, points, graph=shortcut_graph(mesh))
    assert (shorter >= straight - 1e-9).all()
    assert (shorter <= edges + 1e-9).all()
    assert (shorter - straight).mean() < 0.5 * (edges - straight).mean()


def test_limit_and_other_components() -> None:
    mesh = plane()
    above = mesh.vertices + [0, 0, 1]
    two = TriMesh(np.concatenate([mesh.vertices, above]), np.concatenate([mesh.faces, mesh.faces + 441]))
    points = places(mesh)
    every = surface_distances(two, points)
    assert np.isinf(every[:, 441:]).all()
    assert np.isfinite(every[:, :441]).all()
    near = surface_distances(two, points, limit=5.0)
    assert np.array_equal(np.isfinite(near), every <= 5.0)
    assert np.array_equal(near[np.isfinite(near)], every[every <= 5.0])


def test_regions_are_the_nearest_places() -> None:
    mesh = plane()
    points = places(mesh)
    every = surface_distances(mesh, points)
    regions = nearest_regions(mesh, points, limit=6.0)
    reached = every.min(axis=0) <= 6.0
    assert np.array_equal(regions.label >= 0, reached)
    assert np.allclose(regions.distance[reached], every.min(axis=0)[reached])
    assert np.allclose(every[regions.label[reached], np.flatnonzero(reached)], regions.distance[reached])


def test_distances_between_places_are_symmetric() -> None:
    mesh = plane()
    points = places(mesh)
    between = distances_between(surface_distances(mesh, points), mesh, points)
    positions = points.positions(mesh.vertices)
    straight = np.linalg.norm(positions[:, None] - positions, axis=2)
    assert np.array_equal(between, between.T)
    assert np.isinf(np.diag(between)).all()
    away = ~np.eye(len(points), dtype=bool)
    assert (between[away] >= straight[away] - 1e-9).all()
    assert (between[away] <= 1.5 * straight[away] + 2).all()
