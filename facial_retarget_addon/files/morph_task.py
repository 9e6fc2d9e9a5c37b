"""A generic head morphed to another face's feature points. For the command line and scripts."""

from __future__ import annotations

from pathlib import Path

from ..core.acting.morph import Morph, morph_to_points
from ..core.errors import RetargetError
from .mesh_file import MeshFile
from .meshes import read_mesh, write_mesh
from .mpeg4_face import FapFaceFiles
from .points import read_points
from .whole import overwritten


def run_morph_task(head: FapFaceFiles, wanted: FapFaceFiles, out: Path) -> Morph:
    """Write a head whose points have arrived at the other face's points of the same names, in that face's place.

    Parameters
    ----------
    head : the generic head, whose topology and UVs the result has.
    wanted : the face whose points are wanted.
    out : a mesh (.obj .ply .npz).

    Raises
    ------
    RetargetError : for files that cannot be used, too few points in common, or an output that would replace an input.
    """
    inputs = {
        f"{what} {name}": path
        for what, face in (("the head's", head), ("the wanted", wanted))
        for name, path in face.inputs().items()
    }
    if wrong := overwritten(inputs, {"out": out}):
        raise RetargetError("; ".join(wrong))
    generic, other = read_mesh(head.neutral), read_mesh(wanted.neutral)
    points, goal = read_points(head.points, generic.mesh), read_points(wanted.points, other.mesh)
    places = dict(zip(goal.names, goal.positions(other.mesh.vertices), strict=True))
    morph = morph_to_points(generic.mesh, points, places)
    morphed = generic.mesh.with_vertices(morph.positions)
    write_mesh(MeshFile(morphed, generic.counts, generic.corners, generic.uvs), out)
    return morph
