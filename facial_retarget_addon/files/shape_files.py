"""Sets of shapes on disk: a folder with a mesh for each, an NPZ file with an array for each, or an animation table."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

import numpy as np

from ..core.arrays import FloatArray
from ..core.errors import RetargetError
from ..core.mesh import TriMesh
from ..core.shapes.shape_set import ShapeSet
from .animation_table import read_table, write_table
from .mesh_file import FARTHEST, MeshFile
from .meshes import read_positions
from .npz import array_names, read_arrays, write_arrays
from .obj import write_obj
from .whole import Aside, check_place

FOLDER_OF = ".obj"
_MESHES = (".obj", ".ply")
_FORBIDDEN = set('/\\:*?"<>|\0')
"""What a file's name cannot hold on some system."""


def read_shapes(path: Path, neutral: TriMesh) -> ShapeSet:
    """Read the shapes of a face.

    Parameters
    ----------
    path : a folder of .obj and .ply files, one for each shape and named after it; an .npz with an array of positions
        (V, 3) for each; or a facial animation table (.json).
    neutral : of the same vertices.

    Raises
    ------
    RetargetError : for another suffix, or if anything cannot be read, is malformed or of another vertex count.
    """
    if path.suffix.lower() == ".json":
        return read_table(path, len(neutral.vertices))
    if path.suffix.lower() == ".npz":
        shapes = _read_npz(path)
    elif path.is_dir():
        shapes = _read_folder(path)
    else:
        raise RetargetError(f"{path} is no set of shapes, expected a folder of .obj or .ply files, an .npz or a .json")
    for name, positions in shapes.items():
        if positions.shape != neutral.vertices.shape:
            raise RetargetError(
                f"{path}: shape {name!r} has positions {positions.shape}, expected {neutral.vertices.shape}"
            )
        if positions.dtype.kind not in "fiu" or not (np.abs(positions) < FARTHEST).all():
            raise RetargetError(f"{path}: shape {name!r} has vertices that are NaN, infinite or far away")
    return ShapeSet.of_positions(neutral.vertices, shapes)


def _read_npz(path: Path) -> dict[str, FloatArray]:
    names = array_names(path)
    if not names:
        raise RetargetError(f"{path} holds no arrays, expected positions (V, 3) for each shape")
    return read_arrays(path, *names)


def _read_folder(path: Path) -> dict[str, FloatArray]:
    try:
        files = sorted(file for file in path.iterdir() if file.suffix.lower() in _MESHES)
    except OSError as error:
        raise RetargetError(f"{path} cannot be read: {error.strerror or error}") from error
    if not files:
        raise RetargetError(f"folder {path} holds no {' or '.join(_MESHES)} files, expected one for each shape")
    names = [file.stem for file in files]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise RetargetError(f"folder {path} holds two meshes of shape {twice[0]!r}, expected one")
    return {file.stem: read_positions(file) for file in files}


def check_shapes_place(path: Path) -> None:
    """RetargetError if shapes cannot be written there."""
    suffix = path.suffix.lower()
    if suffix not in ("", *_WRITERS) and not path.is_dir():
        raise RetargetError(
            f"shapes {path} would be a {suffix}, expected a folder of {FOLDER_OF} files, an .npz or a .json"
        )
    check_place(path, "" if suffix in _WRITERS else FOLDER_OF)


def add_shapes(aside: Aside, shapes: ShapeSet, out: Path, neutral: MeshFile) -> None:
    """Write shapes among outputs that appear together: a folder of .obj files, an .npz, or a table (.json).

    Parameters
    ----------
    neutral : whose polygons and UVs the .obj files get.

    Raises
    ------
    RetargetError : if the place will not do, or a shape's name cannot be a file's.
    """
    check_shapes_place(out)
    writer = _WRITERS.get(out.suffix.lower())
    if writer is not None:
        with open(aside.place(out), "xb") as file:
            writer(file, shapes, neutral)
        return
    _check_names(shapes, out)
    place = aside.place(out, replaces=FOLDER_OF)
    place.mkdir()
    for name, positions in zip(shapes.names, _positions(shapes, neutral), strict=True):
        mesh = neutral.mesh.with_vertices(positions)
        with open(place / f"{name}{FOLDER_OF}", "xb") as file:
            write_obj(file, MeshFile(mesh, neutral.counts, neutral.corners, neutral.uvs))


def _check_names(shapes: ShapeSet, out: Path) -> None:
    seen: dict[str, str] = {}
    for name in shapes.names:
        if not name.strip(" .") or name.startswith(".") or not name.isprintable() or _FORBIDDEN & set(name):
            raise RetargetError(f"shape {name!r} cannot be a file in {out}; write an .npz or a .json instead")
        if name.lower() in seen:
            raise RetargetError(
                f"shapes {seen[name.lower()]!r} and {name!r} would be one file in {out} on some systems; "
                "write an .npz or a .json instead"
            )
        seen[name.lower()] = name


def _positions(shapes: ShapeSet, neutral: MeshFile) -> FloatArray:
    return shapes.positions(neutral.mesh.vertices)


def _write_npz(file: BinaryIO, shapes: ShapeSet, neutral: MeshFile) -> None:
    write_arrays(file, dict(zip(shapes.names, _positions(shapes, neutral), strict=True)))


def _write_json(file: BinaryIO, shapes: ShapeSet, neutral: MeshFile) -> None:
    write_table(file, shapes)


_WRITERS: dict[str, Callable[[BinaryIO, ShapeSet, MeshFile], None]] = {".npz": _write_npz, ".json": _write_json}
