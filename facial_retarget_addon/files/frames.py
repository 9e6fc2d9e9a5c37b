"""Frames on disk: where each vertex is, frame by frame. NPZ, PC2, MDD, or a folder of OBJ files."""

from __future__ import annotations

import re
import struct
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Protocol

import numpy as np

from ..core.arrays import FloatArray, IntArray
from ..core.errors import RetargetError
from .npz import read_arrays, write_blocks
from .obj import read_obj_vertices, write_obj_faces, write_obj_vertices
from .whole import Aside, check_place, written_whole

BLOCK = 16
"""Frames that are converted at once while writing."""
_PC2 = struct.Struct("<12siiffi")
"""Signature, version, vertices, first frame, frames per sample, samples."""
_PC2_SIGNATURE = b"POINTCACHE2\0"
_MDD = struct.Struct(">ii")
"""Frames, vertices; then the frames' times."""
FPS = 24.0
"""Frames a second of frames of which nobody says otherwise."""


Corners = tuple[IntArray, IntArray] | None
"""Corners of each polygon (P,), and their vertices (C,)."""


class FrameBlocks(Protocol):
    """Frames (F, V, 3) that are asked for a few at once: an array, or what makes them as they are asked for."""

    @property
    def shape(self) -> tuple[int, ...]:
        """(F, V, 3)."""

    def __len__(self) -> int: ...

    def __getitem__(self, frames: slice, /) -> FloatArray: ...


def read_frames(path: Path, vertex_count: int) -> FloatArray:
    """Read the frames of a mesh.

    Parameters
    ----------
    path : .npz with an array `frames` (F, V, 3), .pc2, .mdd, or a folder of .obj files in natural order.
    vertex_count : V that the frames must have.

    Returns
    -------
    (F, V, 3) float32; mapped from the file, read-only, where that holds float32 as it is.

    Raises
    ------
    RetargetError : for another suffix, if something cannot be read or is malformed, if there are no frames, or if
        they have another vertex count.
    """
    frames = _format(path)[0](path)
    if frames.ndim != 3 or frames.shape[1:] != (vertex_count, 3) or not len(frames):
        raise RetargetError(f"{path}: frames have shape {frames.shape}, expected (frames, {vertex_count}, 3)")
    return frames


def write_frames(frames: FrameBlocks, path: Path, corners: Corners = None, fps: float = FPS) -> None:
    """Write frames (F, V, 3), whole or not at all.

    Parameters
    ----------
    path : .npz, .pc2, .mdd, or no suffix for a folder of OBJ files, which replaces one that holds nothing else.
    corners : for the OBJ files' faces.
    fps : frames a second, for the times in an MDD file.

    Raises
    ------
    RetargetError : for another suffix, or if the system refuses, such as on a full disk.
    """
    with written_whole() as aside:
        add_frames(aside, frames, path, corners, fps)


def add_frames(aside: Aside, frames: FrameBlocks, path: Path, corners: Corners = None, fps: float = FPS) -> None:
    """Write frames among outputs that appear together; the rest as in `write_frames`."""
    writer = _format(path)[1]
    writer(aside.place(path, replaces=".obj"), frames, corners, fps)


def check_frames_place(path: Path) -> None:
    """RetargetError if `write_frames` would refuse the path."""
    _format(path)
    check_place(path, replaces=".obj")


def _read_npz(path: Path) -> FloatArray:
    arrays = read_arrays(path, "frames")
    if "frames" not in arrays:
        raise RetargetError(f"{path} has no array 'frames', expected one of shape (frames, vertices, 3)")
    with np.errstate(over="ignore"):
        return np.asanyarray(arrays["frames"], np.float32)


def _write_npz(path: Path, frames: FrameBlocks, corners: Corners, fps: float) -> None:
    with open(path, "xb") as file:
        write_blocks(file, "frames", frames.shape, _blocks(frames, "<f4"))


def _read_pc2(path: Path) -> FloatArray:
    head = _head(path, _PC2.size)
    signature, version, vertices, _, _, samples = _PC2.unpack(head)
    if signature != _PC2_SIGNATURE or version != 1:
        raise RetargetError(f"{path} is no PC2 file: it starts with {head[:16]!r}")
    return _mapped(path, "<f4", _PC2.size, samples, vertices)


def _write_pc2(path: Path, frames: FrameBlocks, corners: Corners, fps: float) -> None:
    head = _PC2.pack(_PC2_SIGNATURE, 1, frames.shape[1], 1.0, 1.0, len(frames))
    _write_raw(path, head, frames, "<f4")


def _read_mdd(path: Path) -> FloatArray:
    samples, vertices = _MDD.unpack(_head(path, _MDD.size))
    return np.array(_mapped(path, ">f4", _MDD.size + 4 * max(samples, 0), samples, vertices), np.float32)


def _write_mdd(path: Path, frames: FrameBlocks, corners: Corners, fps: float) -> None:
    times = np.arange(len(frames)) / fps
    _write_raw(path, _MDD.pack(len(frames), frames.shape[1]) + times.astype(">f4").tobytes(), frames, ">f4")


def _head(path: Path, size: int) -> bytes:
    try:
        with open(path, "rb") as file:
            head = file.read(size)
    except OSError as error:
        raise RetargetError(f"{path} cannot be read: {error.strerror or error}") from error
    if len(head) < size:
        raise RetargetError(f"{path} ends after {len(head)} bytes, inside its header")
    return head


def _mapped(path: Path, kind: str, offset: int, samples: int, vertices: int) -> FloatArray:
    """(samples, vertices, 3) numbers of a file, mapped."""
    expected = offset + 12 * samples * vertices
    try:
        arrived = path.stat().st_size
        if samples < 0 or vertices < 0 or arrived < expected:
            raise RetargetError(
                f"{path} holds {arrived} bytes, expected {expected} for {samples} frames of {vertices} vertices"
            )
        if not samples * vertices:
            return np.empty((samples, vertices, 3), np.float32)
        return np.memmap(path, kind, "r", offset, (samples, vertices, 3))
    except OSError as error:
        raise RetargetError(f"{path} cannot be read: {error.strerror or error}") from error


def _write_raw(path: Path, head: bytes, frames: FrameBlocks, kind: str) -> None:
    with open(path, "xb") as file:
        file.write(head)
        for block in _blocks(frames, kind):
            file.write(block.tobytes())


def _blocks(frames: FrameBlocks, kind: str) -> Iterator[FloatArray]:
    """The frames, a few at once, as contiguous numbers of a kind."""
    for start in range(0, len(frames), BLOCK):
        yield np.ascontiguousarray(frames[start : start + BLOCK], kind)


def _read_folder(path: Path) -> FloatArray:
    try:
        files = sorted((file for file in path.iterdir() if file.suffix.lower() == ".obj"), key=_natural)
    except OSError as error:
        raise RetargetError(f"{path} cannot be read: {error.strerror or error}") from error
    if not files:
        raise RetargetError(f"folder {path} holds no .obj files, expected one for each frame")
    frames: FloatArray | None = None
    for number, file in enumerate(files):
        vertices = read_obj_vertices(file)
        if frames is None:
            frames = np.empty((len(files), *vertices.shape), np.float32)
        if vertices.shape != frames.shape[1:]:
            raise RetargetError(
                f"{file} has {len(vertices)} vertices, expected {frames.shape[1]} as in {files[0].name}"
            )
        with np.errstate(over="ignore"):
            frames[number] = vertices
    assert frames is not None
    return frames


def _natural(path: Path) -> list[tuple[int, str]]:
    """A sort key by which frame 9 comes before frame 10."""
    return [(int(part), "") if part.isdecimal() else (-1, part) for part in re.split(r"(\d+)", path.name)]


def _write_folder(path: Path, frames: FrameBlocks, corners: Corners, fps: float) -> None:
    path.mkdir()
    words = [b"%d" % v for v in (corners[1] + 1).tolist()] if corners else []
    every = (frame for block in _blocks(frames, "<f4") for frame in block)
    digits = max(4, len(str(len(frames))))  # so that any order of names is that of the frames
    for number, frame in enumerate(every, start=1):
        with open(path / f"frame_{number:0{digits}d}.obj", "xb") as file:
            write_obj_vertices(file, frame)
            if corners:
                write_obj_faces(file, corners[0], words)


_Reader = Callable[[Path], FloatArray]
_Writer = Callable[[Path, FrameBlocks, Corners, float], None]
_FORMATS: dict[str, tuple[_Reader, _Writer]] = {
    ".npz": (_read_npz, _write_npz),
    ".pc2": (_read_pc2, _write_pc2),
    ".mdd": (_read_mdd, _write_mdd),
    "": (_read_folder, _write_folder),
}


SUFFIXES = tuple(_FORMATS)
"""Of files that hold frames; "" for a folder."""


def _format(path: Path) -> tuple[_Reader, _Writer]:
    suffix = "" if path.is_dir() else path.suffix.lower()
    if suffix not in _FORMATS:
        raise RetargetError(f"frames {path} are a {suffix}, expected one of .npz, .pc2, .mdd or a folder of .obj files")
    return _FORMATS[suffix]
