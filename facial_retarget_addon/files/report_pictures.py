"""The pictures of a report: the same moments of source and target, side by side."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray
from ..core.problem import Face, Problem
from ..core.raycast import CasterFactory
from .pictures import png_bytes, shade

PICTURE_SIZE = (360, 360)
MARGIN = 0.12
"""Around the feature points, as a share of their extent: shows the face and not the shoulders."""
_BLOCK = 16


@dataclass(frozen=True)
class Moment:
    """One frame, by its number from 0, as PNG files of source and target."""

    frame: int
    source: bytes
    target: bytes


def moments(
    problem: Problem, source_frames: FloatArray, target_frames: FloatArray, chosen: Iterable[int]
) -> list[Moment]:
    """Pictures of the chosen frames (from 0) out of (F, Vs, 3) and (F, Vt, 3)."""
    source, target = (_Portrait(face, problem.make_caster) for face in (problem.source, problem.target))
    return [
        Moment(frame, source.picture(source_frames[frame]), target.picture(target_frames[frame])) for frame in chosen
    ]


def liveliest(neutral: FloatArray, frames: FloatArray, count: int = 6) -> list[int]:
    """The frame with the most motion from each of `count` equal spans of time."""
    motion = np.concatenate(
        [np.abs(frames[start : start + _BLOCK] - neutral).mean(axis=(1, 2)) for start in range(0, len(frames), _BLOCK)]
    )
    spans = np.array_split(np.arange(len(frames)), min(count, len(frames)))
    return [int(span[np.argmax(motion[span])]) for span in spans]


class _Portrait:
    """Takes pictures of one face from in front, all framed alike."""

    def __init__(self, face: Face, make_caster: CasterFactory) -> None:
        self._make_caster = make_caster
        mesh = face.mesh
        self._faces = mesh.faces
        self._axes = _upright(face)
        places = face.points.positions(mesh.vertices) if len(face.points) else mesh.vertices[np.unique(mesh.faces)]
        seen = places @ self._axes.T
        margin = MARGIN * np.ptp(seen, axis=0).max() * np.array([1.0, 1.0, 0.0])
        self._frame = np.stack([seen.min(axis=0) - margin, seen.max(axis=0) + margin])

    def picture(self, vertices: FloatArray) -> bytes:
        upright = vertices @ self._axes.T
        return png_bytes(shade(upright, self._faces, PICTURE_SIZE, frame=self._frame, make_caster=self._make_caster))


def _upright(face: Face) -> FloatArray:
    """(3, 3) rows right, up, forward of a face: where its points look, Z up where that is along Y, else Y up."""
    mesh = face.mesh
    normals = face.points.positions(mesh.vertex_normals) if len(face.points) else np.array([[0.0, 0.0, 1.0]])
    mean = normals.mean(axis=0)
    axis = int(np.argmax(np.abs(mean)))
    forward = np.eye(3)[axis] * np.sign(mean[axis] or 1.0)
    up = np.eye(3)[2 if axis == 1 else 1]
    return np.stack([np.cross(up, forward), up, forward])
