"""Wavefront OBJ: vertices, polygons and UVs; everything else in the file is passed over."""

from __future__ import annotations

from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

import numpy as np
import numpy.typing as npt

from ..core.arrays import FloatArray, IntArray
from ..core.errors import RetargetError
from .documents import read_bytes
from .mesh_file import MeshFile

Words = npt.NDArray[np.bytes_]

LONGEST_WORD = 64
"""Bytes; a longer number or corner is no OBJ file's."""


class _Statements(NamedTuple):
    """All lines of one keyword.

    words : (W,) their words, keywords included.
    first : (N,) where each line's words start.
    counts : (N,) words of each line after the keyword.
    lines : (N,) which line of the file each one is.
    """

    words: Words
    first: IntArray
    counts: IntArray
    lines: IntArray


def read_obj(path: Path) -> MeshFile:
    """Read an OBJ file: positive and negative indices, with or without UVs and normals.

    Raises
    ------
    RetargetError : if it cannot be read, a line is malformed, an index is out of range, or the mesh is empty.
    """
    lines, starts = _lines(path)
    faces = _statements(path, lines, starts, b"f")
    places = np.delete(faces.words, faces.first)
    at_vertex = _statements(path, lines, starts, b"v")
    corners = _indices(path, faces, _part(places, 0), at_vertex)
    uvs = None
    texture = _part(places, 1)
    if len(texture) and _filled(texture):
        at_texture = _statements(path, lines, starts, b"vt")
        uvs = _numbers(path, at_texture, 2)[_indices(path, faces, texture, at_texture)]
    return MeshFile.from_polygons(path, _numbers(path, at_vertex, 3), faces.counts, corners, uvs)


def read_obj_vertices(path: Path) -> FloatArray:
    """The vertices (V, 3) of an OBJ file; RetargetError if it cannot be read or a line is malformed."""
    return _numbers(path, _statements(path, *_lines(path), b"v"), 3)


def read_obj_groups(path: Path) -> dict[str, IntArray]:
    """The vertices (n,) of the faces below each name that an o, g or usemtl line gives; RetargetError as `read_obj`.

    A name that comes again goes on; a g line may have several names.
    """
    lines, starts = _lines(path)
    faces = _statements(path, lines, starts, b"f")
    places = np.delete(faces.words, faces.first)
    corners = _indices(path, faces, _part(places, 0), _statements(path, lines, starts, b"v"))
    ends = np.cumsum(faces.counts)
    groups: dict[str, list[IntArray]] = {}
    for keyword in (b"o ", b"g ", b"usemtl "):
        named = np.array([k for k in np.flatnonzero(starts == keyword[:2]) if lines[k].startswith(keyword)], np.int64)
        first = np.searchsorted(faces.lines, named)
        for line, start, end in zip(named, first, np.append(first[1:], len(faces.lines)), strict=False):
            held = corners[ends[start] - faces.counts[start] : ends[end - 1]] if start < end else corners[:0]
            text = lines[line].partition(b" ")[2].strip().decode(errors="replace")
            for name in text.split() if keyword == b"g " else [text]:
                groups.setdefault(name, []).append(held)
    return {name: np.unique(np.concatenate(held)) for name, held in groups.items()}


def write_obj(file: BinaryIO, mesh_file: MeshFile) -> None:
    """Write a mesh; positions read back exactly."""
    file.write(_format_rows("v %.17g %.17g %.17g\n", mesh_file.mesh.vertices))
    corner_numbers = (mesh_file.corners + 1).tolist()
    words = [b"%d" % v for v in corner_numbers]
    if mesh_file.uvs is not None:
        coordinates, which = np.unique(mesh_file.uvs, axis=0, return_inverse=True)
        file.write(_format_rows("vt %.17g %.17g\n", coordinates))
        pairs = zip(corner_numbers, (which.ravel() + 1).tolist(), strict=True)
        words = [b"%d/%d" % pair for pair in pairs]
    write_obj_faces(file, mesh_file.counts, words)


def write_obj_faces(file: BinaryIO, counts: IntArray, words: list[bytes]) -> None:
    """Write the polygons whose corners are the words, one after the other."""
    end = np.cumsum(counts)
    spans = zip((end - counts).tolist(), end.tolist(), strict=True)
    file.write(b"".join(b"f " + b" ".join(words[first:last]) + b"\n" for first, last in spans))


def write_obj_vertices(file: BinaryIO, vertices: FloatArray) -> None:
    """Write the vertices (V, 3) of a frame; float32 positions read back exactly."""
    file.write(_format_rows("v %.9g %.9g %.9g\n", vertices))


def _format_rows(pattern: str, numbers: FloatArray) -> bytes:
    return ((pattern * len(numbers)) % tuple(numbers.ravel().tolist())).encode()


def _lines(path: Path) -> tuple[list[bytes], Words]:
    """The file's lines without comments, and how each one starts; lines that a backslash continues are one."""
    content = read_bytes(path).replace(b"\t", b" ")
    if b"\\" in content:
        content = content.replace(b"\\\r\n", b" ").replace(b"\\\n", b" ")
    lines = [line.strip() for line in content.splitlines()]
    if b"#" in content:
        lines = [line.partition(b"#")[0] for line in lines]
    return lines, np.array([line[:2] for line in lines], "S2")


def _statements(path: Path, lines: list[bytes], starts: Words, keyword: bytes) -> _Statements:
    chosen = np.flatnonzero((starts == keyword) | (starts == keyword + b" "))
    words = b" ".join([lines[number] for number in chosen.tolist()]).split()
    longest = max(map(len, words), default=0)
    table = np.array(words if longest <= LONGEST_WORD else [], "S")
    first = np.flatnonzero(table == keyword)
    if len(first) != len(chosen):
        raise RetargetError(f"{path}: a {keyword.decode()} line is malformed, expected numbers after its keyword")
    counts = np.diff(np.append(first, len(words))) - 1
    return _Statements(table, first, counts, chosen)


def _numbers(path: Path, statements: _Statements, size: int) -> FloatArray:
    """(N, size) the first numbers of each line."""
    if statements.counts.min(initial=size) < size:
        short = int(np.argmin(statements.counts))
        words = statements.words[statements.first[short] :][: statements.counts[short] + 1].tolist()
        line = b" ".join(words).decode(errors="replace")
        raise RetargetError(f"{path}: line {line!r} has {statements.counts[short]} numbers, expected {size}")
    chosen = statements.words[statements.first[:, None] + np.arange(1, size + 1)]
    numbers: FloatArray = _converted(path, chosen, np.float64)
    return numbers


def _part(places: Words, number: int) -> Words:
    """What stands between the slashes of corners such as 3/4/5, with blanks around; blank where there is nothing."""
    if not len(places):
        return places
    letters = places.view(np.uint8).reshape(len(places), -1)
    slash = letters == ord("/")
    inside = (np.cumsum(slash, axis=1, dtype=np.int8) == number) & ~slash
    return np.where(inside, letters, ord(" ")).astype(np.uint8).view(places.dtype).ravel()


def _filled(words: Words) -> bool:
    """Whether no word is blank."""
    return bool((words.view(np.uint8).reshape(len(words), -1) > ord(" ")).any(axis=1).all())


def _indices(path: Path, faces: _Statements, words: Words, meant: _Statements) -> IntArray:
    """(C,) which of the meant lines the words say: from 1, or from -1 backwards from where the face stands."""
    number = _converted(path, words, np.int64)
    before = np.repeat(np.searchsorted(meant.lines, faces.lines), faces.counts)
    index = np.where(number < 0, before + number, number - 1)
    bad = np.flatnonzero((index < 0) | (index >= len(meant.lines)))
    if len(bad):
        raise RetargetError(
            f"{path}: a face has the index {number[bad[0]]}, but there are {len(meant.lines)}; "
            f"expected 1 to {len(meant.lines)}"
        )
    return index


def _converted(path: Path, words: Words, kind: Any) -> Any:
    try:
        return words.astype(kind)
    except (ValueError, OverflowError) as error:
        raise RetargetError(f"{path} is malformed: {error}") from error
