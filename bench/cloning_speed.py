"""Cloning 53 keys onto a head of 20 000 vertices: fit and transfer together, beside deformation transfer's.

The peer is timed with the correspondence that it needs and, which is harder to beat, with one that it is given: what
remains is to invert the source's triangles, to factor the target's system, and to solve 53 times.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from facial_retarget_addon import demo
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.methods.base import fit
from facial_retarget_addon.core.methods.settings import MotionCloningSettings
from facial_retarget_addon.core.problem import Face, Problem

from .deformation_transfer import DeformationTransfer, matched_faces
from .faces import pair, problem
from .timing import Row, medians

KEYS = 53


def rows() -> Iterator[Row]:
    """Seconds of either way's parts, and ours over the peer's."""
    task = problem()
    keys = np.stack(list(demo.face_shapes(pair()[0]).values()))[:KEYS]
    faces = matched_faces(task)
    settings = MotionCloningSettings()

    def ours() -> object:
        return fit("motion_cloning", _fresh(task), settings).frames(keys)

    def peer() -> object:
        again = _fresh(task)
        transfer = DeformationTransfer(again.source.mesh, again.target.mesh, faces)
        return [transfer.frame(key) for key in keys]

    fitted = fit("motion_cloning", task, settings)
    seconds = medians(
        {
            "motion cloning: fit and keys": ours,
            "motion cloning: keys": lambda: fitted.frames(keys),
            "deformation transfer: setup and solves": peer,
            "deformation transfer: correspondence": lambda: matched_faces(_fresh(task)),
        },
        rounds=3,
    )
    yield Row("source vertices", len(task.source.mesh.vertices), "")
    yield Row("target vertices", len(task.target.mesh.vertices), "")
    yield Row("keys", len(keys), "")
    for what, value in seconds.items():
        yield Row(what, value, "s")
    own, setup, matching = (
        seconds[name]
        for name in (
            "motion cloning: fit and keys",
            "deformation transfer: setup and solves",
            "deformation transfer: correspondence",
        )
    )
    yield Row("motion cloning over deformation transfer", own / (setup + matching), "")
    yield Row("the same, its correspondence left out", own / setup, "", 1.0)


def _fresh(task: Problem) -> Problem:
    """The task on meshes that remember nothing of their connectivity."""
    faces = []
    for face in (task.source, task.target):
        mesh = face.mesh
        faces.append(Face(TriMesh(mesh.vertices, mesh.faces, mesh.polygons), face.points))
    return Problem(*faces)
