"""How feature points share a surface: exact at the points, continuous between them, and as published on demand."""

import heapq
from itertools import pairwise

import numpy as np
import pytest

from facial_retarget_addon.core.acting.point_weights import point_weights
from facial_retarget_addon.core.geodesic import shortcut_graph, surface_distances
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.points import FeaturePoints

SIZE = 41
GAP = 10
"""Edges between neighbouring points of the lattice."""
LATTICE = [(column, row) for row in (10, 20, 30) for column in (10, 20, 30)]


def grid(size: int = SIZE) -> TriMesh:
    """A flat grid of unit squares around the origin, its diagonals mirrored at the middle column."""
    steps = np.arange(size) - (size - 1) / 2
    x, y = np.meshgrid(steps, steps)
    corner = np.add.outer(np.arange(size - 1) * size, np.arange(size - 1)).ravel()
    a, b, c, d = corner, corner + 1, corner + size, corner + size + 1
    left = x.ravel()[corner] < 0
    halves = [
        np.where(left[:, None], np.stack(one, axis=1), np.stack(other, axis=1))
        for one, other in (((a, b, d), (a, b, c)), ((a, d, c), (b, d, c)))
    ]
    return TriMesh(np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1), np.concatenate(halves))


def at(*vertices: int) -> FeaturePoints:
    """Points on single vertices."""
    places = np.repeat(np.array(vertices)[:, None], 3, axis=1)
    return FeaturePoints(tuple(f"p{k}" for k in range(len(vertices))), places, np.tile([1.0, 0, 0], (len(vertices), 1)))


def on_lattice() -> FeaturePoints:
    return at(*(column + SIZE * row for column, row in LATTICE))


def shares(mesh: TriMesh, points: FeaturePoints, variant: str = "default", **more: np.ndarray) -> np.ndarray:
    """(V, P) weights where every point acts along every axis, which gives each axis the same."""
    blocks = point_weights(mesh, points, np.ones((len(points), 3), bool), variant, **more)
    first, *others = (block.toarray() for block in blocks)
    for other in others:
        np.testing.assert_array_equal(first, other)
    return first


def largest_jump(mesh: TriMesh, weights: np.ndarray) -> float:
    return float(np.abs(weights[mesh.edges[:, 0]] - weights[mesh.edges[:, 1]]).max())


@pytest.mark.parametrize("variant", ["default", "paper"])
def test_a_points_vertex_goes_with_it_alone(variant: str) -> None:
    mesh, points = grid(), on_lattice()
    found = shares(mesh, points, variant)
    np.testing.assert_allclose(found[points.vertices[:, 0]], np.eye(len(points)), atol=1e-3)
    assert found.min() >= 0
    assert found.sum(axis=1).max() <= 1 + 1e-9


def test_between_points_the_shares_add_up_to_one_and_fade_outside() -> None:
    mesh, points = grid(), on_lattice()
    total = shares(mesh, points).sum(axis=1)
    reach = np.abs(mesh.vertices).max(axis=1)
    assert total[reach <= GAP].min() > 0.95
    assert total[reach == reach.max()].max() == 0
    # Outwards through the middle of a side, through a point and through a corner the sum falls and never leaps.
    table = total.reshape(SIZE, SIZE)
    for way in (table[20, 30:], table[25, 30:], np.diagonal(table)[30:]):
        assert np.diff(way).max() <= 1e-9
    assert np.abs(np.diff(table, axis=0)).max() < 0.45


def test_the_default_does_not_leap_and_the_paper_does() -> None:
    mesh, points = grid(), on_lattice()
    assert largest_jump(mesh, shares(mesh, points)) < 0.35
    assert largest_jump(mesh, shares(mesh, points, "paper")) > 0.95


def test_the_leap_of_the_default_shrinks_with_the_edges() -> None:
    jumps = []
    for fineness in (1, 2, 4):
        mesh = grid(10 * fineness + 1)
        inner = [5 * fineness + dx * 2 * fineness for dx in (-1, 1)]
        points = at(*(column + (10 * fineness + 1) * row for row in inner for column in inner))
        jumps.append(largest_jump(mesh, shares(mesh, points)))
    assert all(finer < 0.7 * coarser for coarser, finer in pairwise(jumps))


def crumpled(rng: np.random.Generator) -> tuple[TriMesh, FeaturePoints]:
    """A small uneven surface without equal distances, and seven points on it, most of them inside faces."""
    mesh = grid(13)
    moved = mesh.vertices + rng.uniform(-0.25, 0.25, mesh.vertices.shape)
    moved[:, 2] += 0.05 * (moved[:, :2] ** 2).sum(axis=1)
    mesh = TriMesh(moved, mesh.faces)
    faces = rng.choice(len(mesh.faces), 7, replace=False)
    weights = rng.dirichlet([1, 1, 1], 7)
    weights[0] = 1, 0, 0
    return mesh, FeaturePoints(tuple(f"p{k}" for k in range(7)), mesh.faces[faces], weights)


def literal_distances(mesh: TriMesh, points: FeaturePoints) -> np.ndarray:
    """(P, V) shortest edge paths, one heap at a time."""
    beside: list[list[tuple[int, float]]] = [[] for _ in mesh.vertices]
    for a, b in mesh.edges.tolist():
        length = float(np.linalg.norm(mesh.vertices[a] - mesh.vertices[b]))
        beside[a].append((b, length))
        beside[b].append((a, length))
    found = np.full((len(points), len(mesh.vertices)), np.inf)
    places = points.positions(mesh.vertices)
    for row, (corners, weights) in enumerate(zip(points.vertices, points.weights, strict=True)):
        heap = [
            (float(np.linalg.norm(mesh.vertices[c] - places[row])), int(c))
            for c, w in zip(corners, weights, strict=True)
            if w > 0
        ]
        heapq.heapify(heap)
        while heap:
            distance, vertex = heapq.heappop(heap)
            if distance < found[row, vertex]:
                found[row, vertex] = distance
                for other, length in beside[vertex]:
                    heapq.heappush(heap, (distance + length, other))
    return found


def literal_shares(mesh: TriMesh, points: FeaturePoints) -> tuple[np.ndarray, dict[int, int]]:
    """(V, P) shares by equations (1) to (5), vertex after vertex; and how often 0, 1 or 2 neighbours gave d."""
    distance = literal_distances(mesh, points)
    region = distance.argmin(axis=0)
    neighbours: list[set[int]] = [set() for _ in range(len(points))]
    for a, b in region[mesh.edges].tolist():
        if a != b:
            neighbours[a].add(b)
            neighbours[b].add(a)
    places = points.positions(mesh.vertices)
    between = np.array(
        [
            [
                min(
                    distance[i, c] + np.linalg.norm(mesh.vertices[c] - places[j])
                    for c, w in zip(points.vertices[j], points.weights[j], strict=True)
                    if w > 0
                )
                for j in range(len(points))
            ]
            for i in range(len(points))
        ]
    )
    between = np.minimum(between, between.T)
    cases = {0: 0, 1: 0, 2: 0}
    found = np.zeros((len(mesh.vertices), len(points)))
    for v, place in enumerate(mesh.vertices):
        pulls = np.zeros(len(points))
        on_point = [i for i in range(len(points)) if distance[i, v] < 1e-9]
        for i in range(len(points)):
            # theta is the angle at the point between the vertex and each neighbour.
            facing = []
            for j in neighbours[i]:
                one, other = place - places[i], places[j] - places[i]
                size = np.linalg.norm(one) * np.linalg.norm(other)
                cosine = float(one @ other / size) if size > 0 else 0.0
                if cosine > 0:
                    facing.append((cosine, between[i, j]))
            facing = sorted(facing, reverse=True)[:2]
            if len(facing) == 2:
                d = sum(c * gap for c, gap in facing) / sum(c for c, _ in facing)
            elif len(facing) == 1:
                d = facing[0][1] / facing[0][0]
            else:
                d = min(between[i, j] for j in neighbours[i])
            if distance[i, v] < d:
                cases[len(facing)] += 1
                pulls[i] = np.sin(np.pi / 2 * (1 - distance[i, v] / d)) / max(distance[i, v], 1e-9) ** 2
        if on_point:
            found[v, on_point] = 1 / len(on_point)
        elif pulls.sum() > 0:
            found[v] = pulls / pulls.sum()
    return found, cases


@pytest.mark.parametrize("seed", range(3))
def test_the_paper_variant_is_its_equations(seed: int) -> None:
    mesh, points = crumpled(np.random.default_rng(seed))
    expected, cases = literal_shares(mesh, points)
    assert min(cases.values()) > 5
    np.testing.assert_allclose(shares(mesh, points, "paper"), expected, atol=2e-4)


def test_a_point_acts_along_an_axis_only_where_it_is_constrained() -> None:
    mesh, points = grid(), on_lattice()
    acting = np.zeros((len(points), 3), bool)
    acting[:, 0] = True
    acting[[0, 2, 6, 8], 1] = True
    x, y, z = (block.toarray() for block in point_weights(mesh, points, acting))
    np.testing.assert_array_equal(x, shares(mesh, points))
    assert not z.any()
    corners = points.subset(["p0", "p2", "p6", "p8"])
    np.testing.assert_array_equal(y[:, [0, 2, 6, 8]], shares(mesh, corners))
    assert not y[:, [1, 3, 4, 5, 7]].any()
    # A point that does not act along an axis goes along it with the others.
    assert y[points.vertices[4, 0]].sum() > 0.9


@pytest.mark.parametrize("variant", ["default", "paper"])
def test_points_on_another_component_keep_to_it(variant: str) -> None:
    one = grid(21)
    count = len(one.vertices)
    # The second sheet lies so near that a straight line would be shorter than any edge.
    two = TriMesh(
        np.concatenate([one.vertices, one.vertices + [0, 0, 0.01]]), np.concatenate([one.faces, one.faces + count])
    )
    here = [5 + 21 * 5, 15 + 21 * 5, 10 + 21 * 15]
    found = shares(two, at(*here, count + 10 + 21 * 10), variant)
    np.testing.assert_array_equal(found[:count, :3], shares(one, at(*here), variant))
    assert not found[:count, 3].any()
    assert not found[count:, :3].any()
    assert found[count + 10 + 21 * 10, 3] == 1


def test_a_lone_point_fades_towards_the_far_end() -> None:
    mesh = grid(21)
    found = shares(mesh, at(0))[:, 0]
    order = np.argsort(surface_distances(mesh, at(0), graph=shortcut_graph(mesh))[0])
    assert found[0] == 1
    assert found[-1] < 0.01
    assert largest_jump(mesh, found[:, None]) < 0.15
    assert np.diff(found[order]).max() <= 1e-9


def test_a_reach_can_be_ended() -> None:
    mesh, points = grid(), on_lattice()
    farthest = np.full(len(points), np.inf)
    farthest[4] = 4.0
    found = shares(mesh, points, farthest=farthest)
    away = np.linalg.norm(mesh.vertices, axis=1)
    assert not found[away > 4.0, 4].any()
    assert found[away < 2.0, 4].min() > 0.5
    assert shares(mesh, points)[(away > 4.0) & (away < 6.0), 4].min() > 0


@pytest.mark.parametrize("variant", ["default", "paper"])
def test_mirrored_points_have_mirrored_weights(variant: str) -> None:
    mesh = grid()
    left = [6 + SIZE * 9, 11 + SIZE * 23, 15 + SIZE * 33]
    mirror = np.arange(SIZE * SIZE).reshape(SIZE, SIZE)[:, ::-1].ravel()
    middle = [20 + SIZE * 5, 20 + SIZE * 28]
    found = shares(mesh, at(*left, *mirror[left], *middle), variant)
    np.testing.assert_allclose(found[mirror][:, [3, 4, 5, 0, 1, 2, 6, 7]], found, atol=1e-9)


@pytest.mark.parametrize("variant", ["default", "paper"])
def test_two_points_on_one_vertex_move_it_by_halves(variant: str) -> None:
    mesh, points = grid(), on_lattice()
    twice = at(*points.vertices[:, 0], points.vertices[4, 0])
    found = shares(mesh, twice, variant)
    np.testing.assert_allclose(found[points.vertices[4, 0], [4, 9]], 0.5, atol=1e-6)
    assert np.isfinite(found).all()
    np.testing.assert_allclose(found[points.vertices[:4, 0], :4], np.eye(4), atol=1e-3)
    # Neither reaches farther than it would alone.
    alone = shares(mesh, points, variant)[:, 4] > 0
    assert not found[:, [4, 9]][~alone].any()


def test_no_points_move_nothing() -> None:
    mesh = grid(5)
    assert all(block.nnz == 0 and block.shape == (25, 0) for block in point_weights(mesh, at(), np.zeros((0, 3), bool)))
