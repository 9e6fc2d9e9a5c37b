"""Pictures of meshes without Blender: for reports, and for our own eyes.

An image is an (h, w, 3) uint8 array, top row first. Rays go through Embree, light is a key from the
side, a fill and a rim, so that wrinkles cast their shading.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.arrays import FloatArray, IntArray, unit_vectors
from ...core.errors import RetargetError
from ...core.mesh import TriMesh
from ...core.raycast import CasterFactory, EmbreeCaster, RayCaster

Image = npt.NDArray[np.uint8]

BACKGROUND = np.array([0.80, 0.80, 0.81])
SKIN = np.array([0.74, 0.62, 0.55])
INSIDE = 0.35
"""How bright a face is that is seen from behind."""

_LIGHTS: tuple[tuple[tuple[float, float, float], float, tuple[float, float, float]], ...] = (
    ((-0.75, 0.45, 0.50), 0.98, (1.00, 0.97, 0.92)),
    ((0.80, 0.05, 0.60), 0.30, (0.85, 0.92, 1.00)),
    ((0.10, 1.00, 0.10), 0.14, (1.00, 1.00, 1.00)),
)
"""Key, fill and sky: direction in camera axes (right, up, towards the eye), strength, colour."""
_AMBIENT = 0.10
_RIM = 0.22
_WRAP = 0.15
_DISTANCE = 5.0
"""How far the eye stands from the middle of the frame, in frame radii: a portrait lens."""


@dataclass(frozen=True, eq=False)
class Camera:
    """A camera that looks at the middle of a box; keep one for many frames and nothing jumps.

    Attributes
    ----------
    eye : (3,) place of the eye, in the mesh's units.
    axes : (3, 3) rows right, up, towards the eye.
    distance : from the eye to the middle of the box.
    pixel : width of a pixel there, in the mesh's units.
    size : width and height of the picture in pixels.
    """

    eye: FloatArray
    axes: FloatArray
    distance: float
    pixel: float
    size: tuple[int, int]

    @classmethod
    def framing(cls, frame: FloatArray, size: tuple[int, int], turn: float = 0.0, tilt: float = 0.0) -> Camera:
        """The camera that shows all of a box.

        Parameters
        ----------
        frame : (N, 3) positions whose bounding box is shown; NaN and infinite rows do not count.
        size : width and height of the picture in pixels.
        turn : degrees that the eye walks to the face's left (+X) around the up axis; 0 looks at its front (+Z).
        tilt : degrees that the eye rises.

        Raises
        ------
        RetargetError : if no position is finite, or the size is not positive.
        """
        frame = np.asarray(frame, np.float64).reshape(-1, 3)
        frame = frame[np.isfinite(frame).all(axis=1)]
        if not len(frame):
            raise RetargetError("a picture needs finite positions to frame, but none arrived")
        if min(size) < 1:
            raise RetargetError(f"a picture of {size[0]} x {size[1]} pixels was asked for, expected at least 1 x 1")
        low, high = frame.min(axis=0), frame.max(axis=0)
        turn, tilt = np.radians(turn), np.radians(tilt)
        towards = np.array([np.sin(turn) * np.cos(tilt), np.sin(tilt), np.cos(turn) * np.cos(tilt)])
        right = np.array([np.cos(turn), 0.0, -np.sin(turn)])
        axes = np.stack([right, np.cross(towards, right), towards])
        half = 0.5 * np.abs(axes) @ (high - low)
        radius = max(float(np.linalg.norm(high - low)) / 2, 1e-12)
        distance = _DISTANCE * radius
        # The part of the box that is nearer to the eye looks larger.
        margin = 1.04 * distance / (distance - half[2])
        pixel = 2 * margin * max(half[0] / size[0], half[1] / size[1], 1e-12 * radius)
        return cls(0.5 * (low + high) + distance * towards, axes, distance, pixel, size)

    def rays(self, columns: FloatArray, rows: FloatArray) -> FloatArray:
        """Unit directions (N, 3) from the eye through places of the picture, in pixels from its top left corner."""
        x = (np.asarray(columns, np.float64) - 0.5 * self.size[0]) * self.pixel
        y = (0.5 * self.size[1] - np.asarray(rows, np.float64)) * self.pixel
        return unit_vectors(np.stack([x, y, np.full_like(x, -self.distance)], axis=-1) @ self.axes)

    def project(self, positions: FloatArray) -> FloatArray:
        """(N, 2) column and row of positions (N, 3), in pixels from the picture's top left corner."""
        seen = (np.asarray(positions, np.float64) - self.eye) @ self.axes.T
        scale = -self.distance / (seen[:, 2] * self.pixel)
        return np.stack([0.5 * self.size[0] + seen[:, 0] * scale, 0.5 * self.size[1] - seen[:, 1] * scale], axis=1)


def shade(
    vertices: FloatArray,
    faces: IntArray,
    size: tuple[int, int] = (400, 400),
    view: tuple[float, float] = (0.0, 0.0),
    frame: FloatArray | None = None,
    colours: FloatArray | None = None,
    make_caster: CasterFactory = EmbreeCaster,
) -> Image:
    """A picture of a mesh, smooth and lit from the side.

    Parameters
    ----------
    vertices : (V, 3), +Y up, the face looking along +Z.
    faces : (F, 3) triangles.
    size : width and height in pixels.
    view : turn and tilt of the camera in degrees, as in `Camera.framing`.
    frame : (N, 3) positions that the camera frames, so that it stands still over many pictures; the vertices if None.
    colours : (V, 3) colours from 0 to 1, linear; skin if None.
    make_caster : makes what casts the rays.
    """
    mesh = TriMesh(vertices, faces).checked("the mesh of a picture")
    camera = Camera.framing(mesh.vertices[np.unique(mesh.faces)] if frame is None else frame, size, *view)
    columns, rows = _covered(camera, mesh.vertices)
    # Four rays a pixel, in a 2 x 2 grid: the picture is made at twice the size and averaged.
    offsets = np.array([0.25, 0.75])
    x, y = np.meshgrid((columns[:, None] + offsets).ravel(), (rows[:, None] + offsets).ravel())
    light = _trace(mesh, make_caster(mesh), camera, x.ravel(), y.ravel(), colours).reshape(
        len(rows), 2, len(columns), 2, 3
    )
    picture = np.empty((size[1], size[0], 3))
    picture[:] = BACKGROUND**2.2
    if len(rows) and len(columns):
        picture[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1] = light.mean(axis=(1, 3))
    return _to_bytes(picture)


def mark(image: Image, places: FloatArray, colour: tuple[int, int, int] = (220, 30, 30), radius: int = 2) -> Image:
    """The image with a square dot at each place (N, 2), column and row as `Camera.project` gives them."""
    marked = image.copy()
    for column, row in np.floor(places).astype(int):
        top, left = max(row - radius, 0), max(column - radius, 0)
        marked[top : max(row + radius + 1, 0), left : max(column + radius + 1, 0)] = colour
    return marked


def contact_sheet(pictures: Sequence[Image], columns: int, gap: int = 4) -> Image:
    """Pictures of one size in rows of `columns`, with a white gap of pixels between them.

    Raises
    ------
    RetargetError : if there is no picture, or their sizes differ.
    """
    shapes = {picture.shape for picture in pictures}
    if len(shapes) != 1:
        raise RetargetError(f"a contact sheet needs pictures of one size, but {sorted(shapes)} arrived")
    height, width, _ = shapes.pop()
    lines = -(-len(pictures) // columns)
    sheet = np.full((lines * (height + gap) - gap, columns * (width + gap) - gap, 3), 255, np.uint8)
    for i, picture in enumerate(pictures):
        top, left = (i // columns) * (height + gap), (i % columns) * (width + gap)
        sheet[top : top + height, left : left + width] = picture
    return sheet


def _covered(camera: Camera, vertices: FloatArray) -> tuple[IntArray, IntArray]:
    """Pixel columns and rows that the mesh may cover: nothing is cast elsewhere."""
    places = camera.project(vertices)
    low = np.clip(np.floor(places.min(axis=0)), 0, camera.size).astype(np.int64)
    high = np.clip(np.ceil(places.max(axis=0)), 0, camera.size).astype(np.int64)
    return np.arange(low[0], high[0]), np.arange(low[1], high[1])


def _trace(
    mesh: TriMesh, caster: RayCaster, camera: Camera, x: FloatArray, y: FloatArray, colours: FloatArray | None
) -> FloatArray:
    """Linear light (N, 3) that reaches the eye through places of the picture."""
    directions = camera.rays(x, y)
    hits = caster.nearest(np.broadcast_to(camera.eye, directions.shape), directions)
    light = np.broadcast_to(BACKGROUND**2.2, directions.shape).copy()
    found = hits.found
    corners, weights, towards = mesh.faces[hits.face[found]], hits.weights[found], -directions[found]
    normals = unit_vectors(np.einsum("nk,nkc->nc", weights, mesh.vertex_normals[corners]))
    flat = mesh.face_normals[hits.face[found]]
    behind = np.einsum("ni,ni->n", flat, towards) < 0
    normals[behind] *= -1
    skin: Any = SKIN if colours is None else np.einsum("nk,nkc->nc", weights, np.asarray(colours)[corners])
    light[found] = _lit(normals @ camera.axes.T, towards @ camera.axes.T, skin)
    light[np.flatnonzero(found)[behind]] *= INSIDE
    return light


def _lit(normals: FloatArray, towards: FloatArray, skin: FloatArray) -> FloatArray:
    """Light (N, 3) of a matt surface with a soft sheen; normals and directions to the eye in camera axes."""
    diffuse = np.full(normals.shape, _AMBIENT)
    sheen = np.zeros(len(normals))
    for direction, strength, tint in _LIGHTS:
        beam = unit_vectors(np.array(direction))
        half = unit_vectors(beam + towards)
        # The light wraps a little around the edge, as from a lamp of some size.
        diffuse += strength * np.clip((normals @ beam + _WRAP) / (1 + _WRAP), 0.0, None)[:, None] * np.array(tint)
        sheen += 0.10 * strength * np.clip(np.einsum("ni,ni->n", normals, half), 0.0, None) ** 24
    grazing = np.clip(1.0 - np.einsum("ni,ni->n", normals, towards), 0.0, 1.0)
    light: FloatArray = skin * (diffuse + _RIM * grazing[:, None] ** 3) + sheen[:, None]
    return light


def _to_bytes(light: FloatArray) -> Image:
    image: Image = np.rint(255 * np.clip(light, 0.0, 1.0) ** (1 / 2.2)).astype(np.uint8)
    return image
