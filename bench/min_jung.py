"""The setting of Min and Jung 2005 on the built-in faces: 2964 vertices, 5760 triangles, three levels; smile and cry.

.venv/bin/python -m bench.min_jung picture.png          # or: picture.png paper
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from facial_retarget_addon import demo
from facial_retarget_addon.core.arrays import FloatArray
from facial_retarget_addon.core.base.base_mesh import base_mesh
from facial_retarget_addon.core.base.triangulations import FACE_57
from facial_retarget_addon.core.levels.butterfly import butterfly
from facial_retarget_addon.core.levels.normal_mesh import build_normal_mesh
from facial_retarget_addon.core.levels.subdivision import hierarchy
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.methods import wavelet
from facial_retarget_addon.core.methods.settings import WaveletSettings
from facial_retarget_addon.core.points import FeaturePoints, place_matrix
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.files.images import png_bytes
from facial_retarget_addon.files.pages.pictures import Image, contact_sheet, shade

LEVELS = 3
VERTICES, TRIANGLES = 2964, 5760
MOTIONS = {"smile": "joy", "cry": "sadness"}
"""The paper's motions -> the built-in actor's expressions."""

_MORE = ("nostril_l", "nostril_r", "nose_wing_l", "nose_wing_r", "nose_ridge")
_NOSTRILS = ({"nostril_l", "nose_wing_l", "9.1"}, {"nostril_r", "nose_wing_r", "9.2"})
_MERGED = {
    **{"4.5": "11.3", "4.6": "11.2", "5.3": "2.13", "5.4": "2.14"},
    **{"2.6": "2.2", "2.7": "2.2", "2.8": "2.3", "2.9": "2.3"},
    **{"3.3": "3.11", "3.4": "3.8"},
}
"""Points of the outer border, of the mouth and of the lids -> the neighbour on their loop that they become one with."""

Triangles = tuple[tuple[str, str, str], ...]


def papers_base(source: Face, target: Face) -> Triangles:
    """The base that the paper's counts ask for: 52 vertices, 90 triangles, holes for mouth, eyes and nostrils.

    The standard base with five points more at the nose, a triangle taken out for each nostril, and ten points of the
    other loops merged into their neighbours.
    """
    names = [*dict.fromkeys(name for corners in FACE_57 for name in corners), *_MORE]
    points = [face.points.subset(names) for face in (source, target)]
    base = base_mesh(source.mesh, points[0], target.mesh, points[1])
    triangles = []
    for corners in base.faces:
        named = [base.names[corner] for corner in corners]
        merged = [_MERGED.get(name, name) for name in named]
        if set(named) not in _NOSTRILS and len(set(merged)) == 3:
            triangles.append((merged[0], merged[1], merged[2]))
    return tuple(triangles)


def subdivided(
    faces: Sequence[Face], triangles: Triangles, frames: Sequence[FloatArray]
) -> tuple[list[Face], list[FloatArray]]:
    """Faces as meshes of the same subdivision connectivity, as a designer would have made them, and their frames.

    frames : for each face, (F, V, 3) of the face's own vertices.
    """
    names = tuple(dict.fromkeys(name for corners in triangles for name in corners))
    made, moved = [], []
    for face, own in zip(faces, frames, strict=True):
        points = face.points.subset(names)
        base = base_mesh(faces[0].mesh, faces[0].points.subset(names), face.mesh, points, triangles)
        steps = hierarchy(base.faces, len(base.names), LEVELS, butterfly)
        finest = build_normal_mesh(face.mesh, points.subset(base.names), base.loops, steps).levels[-1]
        places = place_matrix(face.mesh.faces[finest.place_face], finest.place_weights, len(face.mesh.vertices))
        corners = np.repeat(np.arange(len(base.names))[:, None], 3, axis=1)
        at_base = FeaturePoints(base.names, corners, np.tile([1.0, 0.0, 0.0], (len(corners), 1)))
        made.append(Face(TriMesh(places @ face.mesh.vertices, finest.faces), at_base))
        moved.append(
            np.stack([places @ frame for frame in own]) if len(own) else np.empty((0, *finest.positions.shape))
        )
    return made, moved


def setting() -> tuple[list[Face], FloatArray]:
    """The source and two targets, and the source's smile and cry (2, V, 3)."""
    actor = demo.actor()
    others = [demo.warped_actor(np.random.default_rng(3)), demo.targets()[0]]
    faces = [actor.face, *(other.face for other in others)]
    acting = np.stack([actor.face.examples[name] for name in MOTIONS.values()])
    made, moved = subdivided(faces, papers_base(actor.face, others[0].face), [acting, (), ()])
    return made, moved[0]


def picture(faces: Sequence[Face], acting: FloatArray, settings: WaveletSettings) -> Image:
    """A row for each face, the source first: neutral, smile, cry."""
    source = faces[0]
    rows = [[source.mesh.vertices, *acting]]
    for target in faces[1:]:
        retargeter = wavelet.fit(Problem(source, target), settings)
        rows.append([target.mesh.vertices, *retargeter.frames(acting.astype(np.float32))])
    return contact_sheet(
        [
            shade(vertices, face.mesh.faces, (400, 440), (18.0, 4.0), frame=face.mesh.vertices)
            for face, row in zip(faces, rows, strict=True)
            for vertices in row
        ],
        columns=1 + len(MOTIONS),
    )


def main(path: str, mode: str = "framed") -> None:
    """Write the picture, and say what stands in it."""
    faces, acting = setting()
    mesh = faces[0].mesh
    print(f"{len(mesh.vertices)} vertices, {len(mesh.faces)} triangles, {LEVELS} levels, mode {mode}: {path}")
    Path(path).write_bytes(png_bytes(picture(faces, acting, WaveletSettings(levels=LEVELS, mode=mode))))


if __name__ == "__main__":
    main(*sys.argv[1:])
