"""A face of the scene as an MPEG-4 face."""

from __future__ import annotations

from bpy.types import Object

from ...core.acting.fap_face import FapFace, fit_fap_face
from ...core.arrays import FloatArray, Progress
from ..background import Steps, in_thread
from ..meshes import from_face_space, neutral_mesh
from ..points.points import read_points
from ..shape_keys import ensure_basis, ensure_key, write_key


def fit_steps(thing: Object) -> Steps[FapFace]:
    """Fit an object's neutral and feature points.

    Raises
    ------
    RetargetError : if the object is no surface, or its points cannot be used; see `fit_fap_face`.
    """
    mesh, points = neutral_mesh(thing), read_points(thing)

    def fit(progress: Progress) -> FapFace:
        return fit_fap_face(mesh, points, progress=progress)

    return (yield from in_thread(fit))


def write_shapes(thing: Object, shapes: dict[str, FloatArray]) -> None:
    """Set the shape keys of these names, made where they are missing: positions (V, 3) in face space."""
    basis = ensure_basis(thing)
    for name, positions in shapes.items():
        key = ensure_key(thing, name)
        key.relative_key = basis
        write_key(key, from_face_space(thing, positions))
    thing.data.update()
