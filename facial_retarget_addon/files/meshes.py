"""Mesh files of any of the formats: OBJ, PLY and NPZ."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

import numpy as np

from ..core.arrays import FloatArray, IntArray
from ..core.errors import RetargetError
from .mesh_file import MeshFile
from .npz import read_arrays, write_arrays
from .obj import read_obj, read_obj_vertices, write_obj
from .ply import read_ply, write_ply
from .whole import written_whole


def read_mesh(path: Path) -> MeshFile:
    """Read a mesh: .obj, .ply, or .npz with `vertices` and `faces` (or `face_counts`, `face_indices`).

    Raises
    ------
    RetargetError : for another suffix, if the file cannot be read or is malformed, or if the mesh is empty, has
        vertices that are not finite or face indices out of range.
    """
    return _READERS[_suffix(path)](path)


def read_positions(path: Path) -> FloatArray:
    """The vertices (V, 3) of a mesh file alone, such as an example's; RetargetError as in `read_mesh`."""
    return read_obj_vertices(path) if _suffix(path) == ".obj" else read_mesh(path).mesh.vertices


def write_mesh(mesh_file: MeshFile, path: Path) -> None:
    """Write a mesh as .obj, .ply or .npz, whole or not at all.

    Raises
    ------
    RetargetError : for another suffix, or if the system refuses.
    """
    writer = _WRITERS[_suffix(path)]
    with written_whole() as aside, open(aside.place(path), "xb") as file:
        writer(file, mesh_file)


def _suffix(path: Path) -> str:
    suffix = path.suffix.lower()
    if suffix not in _READERS:
        raise RetargetError(
            f"mesh {path} is a {suffix or 'file without suffix'}, expected one of {', '.join(_READERS)}"
        )
    return suffix


def _read_npz(path: Path) -> MeshFile:
    arrays = read_arrays(path, "vertices", "faces", "face_counts", "face_indices", "uvs")
    vertices = _shaped(path, arrays.get("vertices"), "vertices", 3).astype(np.float64)
    if "face_counts" in arrays:
        counts = _indices(path, arrays["face_counts"], "face_counts")
        corners = _indices(path, arrays.get("face_indices"), "face_indices")
    else:
        faces = _indices(path, _shaped(path, arrays.get("faces"), "faces", 3), "faces")
        counts, corners = np.full(len(faces) // 3, 3, np.int64), faces
    uvs = arrays.get("uvs")
    if uvs is not None:
        uvs = _shaped(path, uvs, "uvs", 2).astype(np.float64)
        if len(uvs) != len(corners):
            raise RetargetError(f"{path}: uvs have shape {uvs.shape}, expected one for each of {len(corners)} corners")
    return MeshFile.from_polygons(path, vertices, counts, corners, uvs)


def _write_npz(file: BinaryIO, mesh_file: MeshFile) -> None:
    arrays = {"vertices": mesh_file.mesh.vertices, "faces": mesh_file.mesh.faces}
    if (mesh_file.counts != 3).any():
        arrays |= {"face_counts": mesh_file.counts, "face_indices": mesh_file.corners}
    if mesh_file.uvs is not None:
        arrays["uvs"] = mesh_file.uvs
    write_arrays(file, arrays)


def _shaped(path: Path, array: FloatArray | None, name: str, columns: int) -> FloatArray:
    if array is None:
        raise RetargetError(f"{path} has no array {name!r}, expected one of shape (N, {columns})")
    if array.ndim != 2 or array.shape[1] != columns:
        raise RetargetError(f"{path}: {name} have shape {array.shape}, expected (N, {columns})")
    return array


def _indices(path: Path, array: FloatArray | None, name: str) -> IntArray:
    if array is None or array.dtype.kind not in "iu":
        arrived = "is missing" if array is None else f"holds {array.dtype}"
        raise RetargetError(f"{path}: {name} {arrived}, expected whole numbers")
    return array.astype(np.int64).ravel()


_READERS: dict[str, Callable[[Path], MeshFile]] = {".obj": read_obj, ".ply": read_ply, ".npz": _read_npz}
_WRITERS: dict[str, Callable[[BinaryIO, MeshFile], None]] = {".obj": write_obj, ".ply": write_ply, ".npz": _write_npz}
