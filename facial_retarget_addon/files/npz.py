"""Arrays in NPZ files: mapped into memory where they are stored as they are, never unpickled."""

from __future__ import annotations

import math
import struct
import zipfile
import zlib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import IO, Any, BinaryIO, Literal

import numpy as np
import numpy.typing as npt

from ..core.errors import RetargetError

Array = npt.NDArray[Any]

_format: Any = np.lib.format
"""Documented, but without types."""

_HEADERS = {(1, 0): _format.read_array_header_1_0, (2, 0): _format.read_array_header_2_0}
_LOCAL_HEADER = struct.Struct("<26xHH")
"""Of a zip entry: the lengths of its name and of its extra field, which stand before the data."""
_UNREADABLE = (
    ValueError, EOFError, KeyError, TypeError, SyntaxError, OverflowError, MemoryError, RecursionError,
    NotImplementedError, RuntimeError, struct.error, zlib.error, zipfile.BadZipFile,
)  # fmt: skip
"""What NumPy and zipfile raise on bytes that are no NPZ file."""


def array_names(path: Path) -> list[str]:
    """Names of the arrays that a file has, in its order; RetargetError as in `read_arrays`."""
    try:
        with zipfile.ZipFile(path) as archive:
            return [name.removesuffix(".npy") for name in archive.namelist() if name.endswith(".npy")]
    except OSError as error:
        raise RetargetError(f"{path} cannot be read: {error.strerror or error}") from error
    except _UNREADABLE as error:
        raise RetargetError(f"{path} is no NPZ file of plain numbers: {error}") from error


def read_arrays(path: Path, *names: str) -> dict[str, Array]:
    """Those of the named arrays that a file has; arrays that are not compressed are mapped, read-only.

    Raises
    ------
    RetargetError : if the file cannot be read, or is no NPZ file of plain numbers.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            present = {info.filename: info for info in archive.infolist()}
            return {name: _read(path, archive, present[f"{name}.npy"]) for name in names if f"{name}.npy" in present}
    except OSError as error:
        raise RetargetError(f"{path} cannot be read: {error.strerror or error}") from error
    except _UNREADABLE as error:
        raise RetargetError(f"{path} is no NPZ file of plain numbers: {error}") from error


def _read(path: Path, archive: zipfile.ZipFile, info: zipfile.ZipInfo) -> Array:
    with archive.open(info) as stream:
        version = _format.read_magic(stream)
        if version not in _HEADERS:
            raise ValueError(f"{info.filename} has format version {version}")
        shape, fortran, dtype = _HEADERS[version](stream)
        start = stream.tell()
        if dtype.kind not in "fiub" or min(shape, default=0) < 0:
            raise ValueError(f"{info.filename} holds {dtype} {shape}")
        size = math.prod(shape) * dtype.itemsize
        if size != info.file_size - start:
            raise ValueError(f"{info.filename} should hold {size} bytes and holds {info.file_size - start}")
        order: Literal["C", "F"] = "F" if fortran else "C"
        if info.compress_type == zipfile.ZIP_STORED and size:
            return np.memmap(path, dtype, "r", _data_offset(path, info) + start, shape, order)
        return np.ndarray(shape, dtype, stream.read(size), order=order)


def _data_offset(path: Path, info: zipfile.ZipInfo) -> int:
    with open(path, "rb") as file:
        file.seek(info.header_offset)
        name, extra = _LOCAL_HEADER.unpack(file.read(_LOCAL_HEADER.size))
    return int(info.header_offset + _LOCAL_HEADER.size + name + extra)


def write_arrays(file: BinaryIO, arrays: Mapping[str, Array]) -> None:
    """Write arrays as an NPZ file, not compressed; the same arrays give the same bytes."""
    with zipfile.ZipFile(file, "w", zipfile.ZIP_STORED) as archive:
        for name, array in arrays.items():
            with _member(archive, name) as member:
                _format.write_array(member, np.asanyarray(array), allow_pickle=False)


def write_blocks(file: BinaryIO, name: str, shape: tuple[int, ...], blocks: Iterable[Array]) -> None:
    """Write one float32 array as an NPZ file, not compressed; its blocks of rows need not exist at once."""
    with zipfile.ZipFile(file, "w", zipfile.ZIP_STORED) as archive, _member(archive, name) as member:
        _format.write_array_header_1_0(member, {"descr": "<f4", "fortran_order": False, "shape": shape})
        for block in blocks:
            member.write(block.tobytes())


def _member(archive: zipfile.ZipFile, name: str) -> IO[bytes]:
    return archive.open(zipfile.ZipInfo(f"{name}.npy"), "w", force_zip64=True)
