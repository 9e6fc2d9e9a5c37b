"""Borders of the texture: what a shader sees on either side of them."""

from typing import NamedTuple

import numpy as np
import pytest

from facial_retarget_addon.core.arrays import unit_vectors
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.normal_maps.encoding import as_picture
from facial_retarget_addon.core.normal_maps.normal_map import NormalMap, fit_normal_map
from facial_retarget_addon.core.normal_maps.surface import TexturedSurface
from facial_retarget_addon.core.normal_maps.tangents import TangentSpace
from facial_retarget_addon.core.normal_maps.texels import rasterise, ring

SIZE = 256
QUARTER = ((0.27, 0.27), (0.73, 0.27), (0.27, 0.73), (0.73, 0.73))
"""Middles of the four islands."""


def waves(side: int, height: float, even: bool = False) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices, corners (Q, 4), grid coordinates of a wavy bowl of side * side vertices; even: alike left and right."""
    x, y = np.meshgrid(np.linspace(-1, 1, side), np.linspace(-1, 1, side))
    along = 3 * x * x if even else x
    z = np.sqrt(4 - x * x - y * y) + height * np.sin(9 * along + 4 * y) * np.cos(7 * y - 2 * along)
    grid = np.arange(side * side).reshape(side, side)
    quads = np.stack([grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]], axis=-1).reshape(-1, 4)
    return np.stack([x, y, z], axis=-1).reshape(-1, 3), quads, np.stack([x, y], axis=-1).reshape(-1, 2)


def turned(degrees: float) -> np.ndarray:
    angle = np.radians(degrees)
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def cut_in_four() -> TexturedSurface:
    """The bowl, cut in the texture: a quarter as it is, one turned by 90 degrees, one mirrored, one aslant."""
    vertices, quads, grid = waves(17, 0.0)
    quarter = (grid[quads].mean(axis=1) > 0) @ [1, 2]
    uvs = np.empty((*quads.shape, 2))
    ways = np.eye(2), turned(90), np.diag([-1.0, 1.0]), 0.7 * turned(30)
    for number, (way, middle) in enumerate(zip(ways, QUARTER, strict=True)):
        mine = quarter == number
        centre = grid[quads[mine]].reshape(-1, 2).mean(axis=0)
        uvs[mine] = (grid[quads[mine]] - centre) @ way.T * 0.37 + middle
    return surface_of(vertices, quads, uvs)


def surface_of(vertices: np.ndarray, quads: np.ndarray, uvs: np.ndarray) -> TexturedSurface:
    counts, corners = np.full(len(quads), 4), quads.ravel()
    return TexturedSurface(TriMesh.from_polygons(vertices, counts, corners), counts, corners, uvs.reshape(-1, 2))


def folded() -> TexturedSurface:
    """The bowl, its right half folded over its left one in the texture."""
    vertices, quads, grid = waves(17, 0.0)
    uvs = grid[quads] * 0.48 + 0.5
    uvs[..., 0] = 0.5 - np.abs(uvs[..., 0] - 0.5)
    return surface_of(vertices, quads, uvs)


def fine_mesh(even: bool = False) -> TriMesh:
    vertices, quads, _ = waves(161, 0.02, even)
    return TriMesh.from_polygons(vertices, np.full(len(quads), 4), quads.ravel())


class Side(NamedTuple):
    """Places (P,) on triangles, and their weights (P, 3)."""

    face: np.ndarray
    weights: np.ndarray


def borders(surface: TexturedSurface) -> tuple[Side, Side]:
    """Five places on each edge that is cut or folded in the texture, as each of its two triangles sees them."""
    faces, uvs = surface.mesh.faces, surface.triangle_uvs
    sign = TangentSpace(faces, uvs).sign
    rows = {(int(faces[f, k]), int(faces[f, (k + 1) % 3])): (f, k) for f in range(len(faces)) for k in range(3)}
    sides: tuple[list, list] = [], []
    for (start, end), (f, k) in rows.items():
        other = rows.get((end, start))
        if other is None or start > end:
            continue
        g, m = other
        here, there = uvs[f, [k, (k + 1) % 3]], uvs[g, [(m + 1) % 3, m]]
        if np.abs(here - there).max() < 1e-9 and sign[f] == sign[g]:
            continue
        for share in np.arange(0.1, 1, 0.2):
            for side, face, first, last in ((sides[0], f, k, (k + 1) % 3), (sides[1], g, (m + 1) % 3, m)):
                weights = np.zeros(3)
                weights[first], weights[last] = 1 - share, share
                side.append((face, weights))
    one, two = (Side(np.array([f for f, _ in side]), np.array([w for _, w in side])) for side in sides)
    return one, two


def looked_up(image: np.ndarray, uvs: np.ndarray) -> np.ndarray:
    """What a bilinear look-up that repeats gives at texture coordinates (P, 2)."""
    size = len(image)
    low = np.floor(uvs * size - 0.5).astype(int)
    share = uvs * size - 0.5 - low
    parts = [
        (np.abs(1 - step[0] - share[:, 0]) * np.abs(1 - step[1] - share[:, 1]))[:, None]
        * image[(low[:, 1] + step[1]) % size, (low[:, 0] + step[0]) % size]
        for step in ((0, 0), (0, 1), (1, 0), (1, 1))
    ]
    return np.sum(parts, axis=0)


def seen(surface: TexturedSurface, positions: np.ndarray, image: np.ndarray, side: Side) -> np.ndarray:
    """(P, 3) unit normals that a renderer shades places with: T, B and N between the corners, times the pixel."""
    space = TangentSpace(surface.mesh.faces, surface.triangle_uvs)
    normals = surface.normals(positions)
    tangents = space.tangents(positions, normals)[space.group[side.face]]
    normal = np.einsum("pk,pki->pi", side.weights, normals[surface.mesh.faces[side.face]])
    tangent = np.einsum("pk,pki->pi", side.weights, tangents)
    bitangent = space.sign[side.face][:, None] * np.cross(normal, tangent)
    pixel = looked_up(image, np.einsum("pk,pki->pi", side.weights, surface.triangle_uvs[side.face]))
    return unit_vectors(pixel[:, :1] * tangent + pixel[:, 1:2] * bitangent + pixel[:, 2:] * normal)


def apart(one: np.ndarray, two: np.ndarray) -> np.ndarray:
    return np.degrees(np.arccos(np.clip(np.einsum("pi,pi->p", one, two), -1, 1)))


def bent(mesh: TriMesh) -> np.ndarray:
    """A frame: the bowl is stretched and bent, as much on the left as on the right."""
    return mesh.vertices * [1.0, 1.2, 0.8] + 0.2 * np.sin(2 * mesh.vertices[:, [0, 2, 1]])


def seam(surface: TexturedSurface, made: NormalMap, fine: TriMesh, bits: int | None = None) -> np.ndarray:
    """(P,) degrees between what is seen from both sides of the borders; the pixels are floats, or have some bits."""
    image = made.vectors(bent(surface.mesh), bent(fine))
    if bits is not None:
        image = 2 * np.rint(as_picture(image)[::-1] * (2**bits - 1)) / (2**bits - 1) - 1
    return apart(*(seen(surface, bent(surface.mesh), image, side) for side in borders(surface)))


@pytest.mark.parametrize(("bits", "degrees"), [(None, 0.1), (16, 0.1), (8, 0.6)])
def test_no_seam_shows_between_islands(bits: int | None, degrees: float) -> None:
    surface, fine = cut_in_four(), fine_mesh()
    for width in (1, 8):
        made = fit_normal_map(surface, fine, SIZE, margin_width=width)
        # A grey of 8 bits has no middle: 0.22 degrees along u and v, on both sides.
        assert seam(surface, made, fine, bits).max() < degrees


def test_a_seam_would_show_without_a_margin_or_with_its_pixels_copied(monkeypatch: pytest.MonkeyPatch) -> None:
    surface, fine = cut_in_four(), fine_mesh()
    assert np.quantile(seam(surface, fit_normal_map(surface, fine, SIZE, margin_width=0), fine), 0.95) > 2
    monkeypatch.setattr("facial_retarget_addon.core.normal_maps.normal_map.ring", lambda *_: None)
    assert np.quantile(seam(surface, fit_normal_map(surface, fine, SIZE), fine), 0.95) > 0.5


def test_a_seam_would_show_if_a_mirrored_island_were_shaded_as_the_others(monkeypatch: pytest.MonkeyPatch) -> None:
    surface, fine = cut_in_four(), fine_mesh()
    made = fit_normal_map(surface, fine, SIZE)
    plain = TangentSpace.__init__

    def unsigned(self: TangentSpace, *given: np.ndarray) -> None:
        plain(self, *given)
        self.sign = np.abs(self.sign)

    monkeypatch.setattr(TangentSpace, "__init__", unsigned)
    assert seam(surface, made, fine).max() > 5


def test_a_folded_texture_shades_both_halves_as_their_own_and_no_crease_along_the_fold() -> None:
    surface, fine = folded(), fine_mesh(even=True)
    made = fit_normal_map(surface, fine, SIZE)
    assert seam(surface, made, fine).max() < 0.1
    assert len(seam(surface, made, fine)) == 5 * 16
    # The same places left and right of the fold, as they are seen.
    image = made.vectors(bent(surface.mesh), bent(fine))
    rng = np.random.default_rng(2)
    faces = surface.mesh.faces
    places = surface.mesh.vertices[faces].mean(axis=1)
    left = np.flatnonzero(places[:, 0] < 0)
    mirrored = np.argmin(np.linalg.norm(places[left][:, None] * [-1, 1, 1] - places[None], axis=2), axis=1)
    assert np.abs(places[left] * [-1, 1, 1] - places[mirrored]).max() < 0.05
    some = rng.integers(0, len(left), 200)
    middle = np.full((200, 3), 1 / 3)
    one, two = (seen(surface, bent(surface.mesh), image, Side(part[some], middle)) for part in (left, mirrored))
    assert np.median(apart(one * [-1, 1, 1], two)) < 1


def test_pixels_around_are_those_that_a_look_up_inside_mixes_in() -> None:
    surface = cut_in_four()
    uvs = surface.triangle_uvs
    covered = rasterise(uvs, 64).pixel
    around = ring(uvs, 64, (0, 0), covered)
    assert not np.intersect1d(around.pixel, covered).size
    assert (np.diff(around.pixel) > 0).all()
    rng = np.random.default_rng(4)
    face = rng.integers(0, len(uvs), 20_000)
    places = np.einsum("pk,pki->pi", rng.dirichlet([0.3, 0.3, 0.3], len(face)), uvs[face])
    low = np.floor(places * 64 - 0.5).astype(int)
    mixed = np.unique([(low[:, 1] + dy) * 64 + low[:, 0] + dx for dx in (0, 1) for dy in (0, 1)])
    assert np.isin(mixed, np.union1d(covered, around.pixel)).all()
    # Their weights are theirs: the plane of the triangle goes on to the pixel's centre.
    centres = np.stack([around.pixel % 64 + 0.5, around.pixel // 64 + 0.5], axis=1) / 64
    np.testing.assert_allclose(np.einsum("pk,pki->pi", around.beyond, uvs[around.face]), centres, atol=1e-9)
    assert (around.edge >= 0).all()
    assert (around.beyond.min(axis=1) < 0).all()


def test_a_texture_without_area_has_no_pixels_around() -> None:
    line = np.array([[[0.2, 0.2], [0.5, 0.5], [0.8, 0.8]]])
    assert not len(ring(line, 32, (0, 0), np.empty(0, int)).pixel)
