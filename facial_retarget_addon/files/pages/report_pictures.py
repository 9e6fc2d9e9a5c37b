"""The pictures of a report: a face from in front, moment by moment."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...core.arrays import FloatArray
from ...core.level_retargeter import LevelsOf
from ...core.mesh import TriMesh
from ...core.points import FeaturePoints
from ...core.problem import Face, Problem
from ...core.raycast import CasterFactory, EmbreeCaster
from ..frames import FrameBlocks
from ..images import png_bytes
from .pictures import SKIN, Camera, Image, mark, shade

PICTURE_SIZE = (360, 360)
MARGIN = 0.12
"""Around the feature points, as a share of their extent: shows the face and not the shoulders."""
_BLOCK = 16
_MOVED = np.array([0.80, 0.08, 0.04])
"""Colour, linear, of the place that a level moves most."""


@dataclass(frozen=True)
class Moment:
    """One frame, by its number from 0, as PNG files of source and target."""

    frame: int
    source: bytes
    target: bytes


class LevelPictures(NamedTuple):
    """One frame, by its number from 0; per level its name, a PNG file, and how far it moves a vertex at most."""

    frame: int
    levels: tuple[tuple[str, bytes, float], ...]


def moments(
    problem: Problem, source_frames: FloatArray, target_frames: FloatArray, chosen: Iterable[int]
) -> list[Moment]:
    """Pictures of the chosen frames (from 0) out of (F, Vs, 3) and (F, Vt, 3)."""
    source, target = (
        Portrait(face.mesh, face.points, upright(face), make_caster=problem.make_caster)
        for face in (problem.source, problem.target)
    )
    return [
        Moment(frame, png_bytes(source.picture(source_frames[frame])), png_bytes(target.picture(target_frames[frame])))
        for frame in chosen
    ]


def level_pictures(problem: Problem, source_frames: FloatArray, levels: LevelsOf) -> LevelPictures:
    """The liveliest of the source's frames (F, Vs, 3) on the target, level upon level.

    Each picture holds what has been added so far; the redder a place, the more its own level moves it.
    """
    frame = liveliest(problem.source.mesh.vertices, source_frames, 1)[0]
    face = problem.target
    portrait = Portrait(face.mesh, face.points, upright(face), make_caster=problem.make_caster)
    position = face.mesh.vertices.copy()
    pictures = []
    for level in levels(np.asarray(source_frames[frame])[None]):
        position += level.displacements[0]
        length = np.linalg.norm(level.displacements[0], axis=1)
        most = float(length.max())
        heat = (length / most if most > 0 else length)[:, None]
        pictures.append((level.name, png_bytes(portrait.picture(position, SKIN + heat * (_MOVED - SKIN))), most))
    return LevelPictures(frame, tuple(pictures))


def liveliest(neutral: FloatArray, frames: FrameBlocks, count: int = 6) -> list[int]:
    """The frame with the most motion from each of `count` equal spans of time."""
    motion = np.concatenate(
        [np.abs(frames[start : start + _BLOCK] - neutral).mean(axis=(1, 2)) for start in range(0, len(frames), _BLOCK)]
    )
    spans = np.array_split(np.arange(len(frames)), min(count, len(frames)))
    return [int(span[np.argmax(motion[span])]) for span in spans]


class Portrait:
    """Takes pictures of one face from in front, all framed alike.

    Parameters
    ----------
    mesh : of the neutral face.
    points : that the pictures are framed around; the whole mesh if there are none.
    axes : (3, 3) rows right (in the picture), up, towards the eye.
    size : width and height in pixels.
    make_caster : makes what casts the rays.
    colours : (V, 3) colours of the vertices from 0 to 1, linear; skin if None.
    """

    def __init__(
        self,
        mesh: TriMesh,
        points: FeaturePoints,
        axes: FloatArray,
        size: tuple[int, int] = PICTURE_SIZE,
        make_caster: CasterFactory = EmbreeCaster,
        colours: FloatArray | None = None,
    ) -> None:
        self._colours = colours
        self._faces, self._points, self._axes = mesh.faces, points, axes
        self._size, self._make_caster = size, make_caster
        places = points.positions(mesh.vertices) if len(points) else mesh.vertices[np.unique(mesh.faces)]
        seen = places @ self._axes.T
        margin = MARGIN * np.ptp(seen, axis=0).max() * np.array([1.0, 1.0, 0.0])
        self._frame = np.stack([seen.min(axis=0) - margin, seen.max(axis=0) + margin])

    def picture(self, vertices: FloatArray, colours: FloatArray | None = None) -> Image:
        """The face with its vertices (V, 3) at these positions, in colours (V, 3), linear; its own if None."""
        upright = vertices @ self._axes.T
        return shade(
            upright,
            self._faces,
            self._size,
            frame=self._frame,
            colours=self._colours if colours is None else colours,
            make_caster=self._make_caster,
        )

    def marked(self, vertices: FloatArray) -> Image:
        """The same with a dot at each feature point, seen through the surface."""
        places = self._points.positions(vertices) @ self._axes.T
        return mark(self.picture(vertices), Camera.framing(self._frame, self._size).project(places))


def upright(face: Face) -> FloatArray:
    """(3, 3) rows right, up, forward of a face: where its points look, Z up where that is along Y, else Y up."""
    mesh = face.mesh
    normals = face.points.positions(mesh.vertex_normals) if len(face.points) else np.array([[0.0, 0.0, 1.0]])
    mean = normals.mean(axis=0)
    axis = int(np.argmax(np.abs(mean)))
    forward = np.eye(3)[axis] * np.sign(mean[axis] or 1.0)
    up = np.eye(3)[2 if axis == 1 else 1]
    return np.stack([np.cross(up, forward), up, forward])
