"""PLY: ASCII, or binary of either byte order."""

from __future__ import annotations

import struct
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from ..core.arrays import FloatArray, IntArray
from ..core.errors import RetargetError
from .documents import read_bytes
from .mesh_file import MeshFile

_TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4",
    "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4",
    "float": "f4", "double": "f8", "float32": "f4", "float64": "f8",
}  # fmt: skip
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_CORNERS = ("vertex_indices", "vertex_index")
_VERTEX_UVS = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"))


@dataclass
class _Element:
    """An element of the header: its properties as (name, type, type of the list's length or '')."""

    name: str
    count: int
    properties: list[tuple[str, str, str]] = field(default_factory=list)


@dataclass
class _List:
    """A list property: the lengths (N,), and the values one after the other."""

    counts: IntArray
    values: FloatArray


class _MalformedError(Exception):
    """The file is no PLY file that we can read; says why."""


def read_ply(path: Path) -> MeshFile:
    """Read a PLY file; UVs of its corners (texcoord) or vertices (s, t) come along.

    Raises
    ------
    RetargetError : if it cannot be read or is malformed, an index is out of range, or the mesh is empty.
    """
    try:
        tables = _read(read_bytes(path))
        vertex, face = tables.get("vertex", {}), tables.get("face", {})
        vertices = np.stack([_scalar(vertex, axis) for axis in "xyz"], axis=1)
        polygons = next((face[name] for name in _CORNERS if isinstance(face.get(name), _List)), None)
        if polygons is None:
            raise _MalformedError("it has no faces with vertex_indices")
        if len(polygons.values) and not np.abs(polygons.values).max() < 2**53:
            raise _MalformedError("a face has a vertex that is no number")
        corners = polygons.values.astype(np.int64)
        uvs = _uvs(vertex, face.get("texcoord"), polygons.counts, corners)
    except _MalformedError as error:
        raise RetargetError(f"{path} is no PLY mesh: {error}") from error
    return MeshFile.from_polygons(path, vertices, polygons.counts, corners, uvs)


def _uvs(vertex: dict[str, Any], texture: object, counts: IntArray, corners: IntArray) -> FloatArray | None:
    """UVs of the corners, if the faces or the vertices have any."""
    if isinstance(texture, _List) and np.array_equal(texture.counts, 2 * counts):
        return texture.values.reshape(-1, 2)
    names = next((pair for pair in _VERTEX_UVS if set(pair) <= vertex.keys()), None)
    if names is None:
        return None
    coordinates = np.stack([_scalar(vertex, name) for name in names], axis=1)
    in_range = len(corners) and corners.min() >= 0 and corners.max() < len(coordinates)
    return coordinates[corners] if in_range else None


def write_ply(file: BinaryIO, mesh_file: MeshFile) -> None:
    """Write a mesh, binary little-endian; positions read back exactly."""
    counts, corners = mesh_file.counts, mesh_file.corners
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(mesh_file.mesh.vertices)}"]
    header += [f"property double {axis}" for axis in "xyz"]
    header += [f"element face {len(counts)}", "property list int int vertex_indices"]
    if mesh_file.uvs is not None:
        header.append("property list int double texcoord")
    file.write("\n".join([*header, "end_header", ""]).encode())
    file.write(np.ascontiguousarray(mesh_file.mesh.vertices, "<f8").tobytes())
    starts = np.cumsum(counts) - counts
    length = 4 + 4 * counts if mesh_file.uvs is None else 8 + 20 * counts
    place = np.cumsum(length) - length
    body = np.zeros(int(length.sum()), np.uint8)
    for size in np.unique(counts):
        which = np.flatnonzero(counts == size)
        span = starts[which][:, None] + np.arange(size)
        parts = [("n", "<i4"), ("corners", "<i4", (size,))]
        if mesh_file.uvs is not None:
            parts += [("m", "<i4"), ("uvs", "<f8", (2 * size,))]
        records = np.zeros(len(which), np.dtype(parts))
        records["n"], records["corners"] = size, corners[span]
        if mesh_file.uvs is not None:
            records["m"], records["uvs"] = 2 * size, mesh_file.uvs[span].reshape(len(which), -1)
        body[place[which][:, None] + np.arange(records.itemsize)] = records.view(np.uint8).reshape(len(which), -1)
    file.write(body.tobytes())


def _scalar(table: dict[str, Any], name: str) -> FloatArray:
    column = table.get(name)
    if not isinstance(column, np.ndarray):
        raise _MalformedError(f"its vertices have no {name}")
    return column.astype(np.float64)


def _read(content: bytes) -> dict[str, dict[str, Any]]:
    """Element name -> property name -> (N,) values, or a _List."""
    order, elements, body = _header(content)
    tables: dict[str, dict[str, Any]] = {}
    words = body.split() if not order else []
    place = 0
    for element in elements:
        if not element.properties:
            continue
        if order:
            tables[element.name], place = _binary(body, place, element, order)
        else:
            tables[element.name], place = _ascii(words, place, element)
    return tables


def _header(content: bytes) -> tuple[str, list[_Element], bytes]:
    """Byte order ('' for ASCII), elements, and what follows the header."""
    end = content.find(b"end_header")
    if not content.startswith(b"ply") or end < 0:
        raise _MalformedError("it does not start with a PLY header")
    after = content[end + len(b"end_header") :]
    body = after[2:] if after.startswith(b"\r\n") else after[1:]
    order: str | None = None
    elements: list[_Element] = []
    for line in content[:end].decode("latin-1").splitlines()[1:]:
        match line.split():
            case ["format", kind, _] if kind in _ORDERS:
                order = _ORDERS[kind]
            case ["element", name, count] if count.isascii() and count.isdigit() and len(count) < 16:
                elements.append(_Element(name, int(count)))
            case ["property", "list", length, kind, name] if elements and length in _TYPES and kind in _TYPES:
                elements[-1].properties.append((name, _TYPES[kind], _TYPES[length]))
            case ["property", kind, name] if elements and kind in _TYPES:
                elements[-1].properties.append((name, _TYPES[kind], ""))
            case [] | ["comment" | "obj_info", *_]:
                pass
            case _:
                raise _MalformedError(f"its header has the line {line!r:.60}")
    if order is None:
        raise _MalformedError("its header names no format")
    return order, elements, body


def _ascii(words: list[bytes], place: int, element: _Element) -> tuple[dict[str, Any], int]:
    """The table of an element whose words start at `place`, and where they end."""
    width = len(element.properties)
    if element.count * width > len(words) - place:
        raise _MalformedError(f"it ends before its {element.count} {element.name} entries do")
    try:
        if not any(length for _, _, length in element.properties):
            end = place + element.count * width
            block = np.array([float(word) for word in words[place:end]]).reshape(element.count, width)
            return {name: block[:, k] for k, (name, _, _) in enumerate(element.properties)}, end
        columns: list[list[float]] = [[] for _ in element.properties]
        counts: list[list[int]] = [[] for _ in element.properties]
        for _ in range(element.count):
            for column, count, (_, _, length) in zip(columns, counts, element.properties, strict=True):
                size = int(words[place]) if length else 1
                place += 1 if length else 0
                column.extend(map(float, words[place : place + max(size, 0)]))
                count.append(size)
                place += max(size, 0)
        if place > len(words):
            raise _MalformedError(f"it ends before its {element.count} {element.name} entries do")
    except (ValueError, IndexError, OverflowError) as error:
        raise _MalformedError(f"its {element.name} entries are malformed: {error}") from error
    return _columns(element, columns, counts), place


def _columns(element: _Element, columns: list[list[float]], counts: list[list[int]]) -> dict[str, Any]:
    table: dict[str, Any] = {}
    for (name, _, length), column, count in zip(element.properties, columns, counts, strict=True):
        values = np.array(column, np.float64)
        table[name] = _List(np.array(count, np.int64), values) if length else values
    return table


def _binary(body: bytes, place: int, element: _Element, order: str) -> tuple[dict[str, Any], int]:
    """The table of an element whose bytes start at `place`, and where they end."""
    smallest = sum(np.dtype(length or kind).itemsize for _, kind, length in element.properties)
    if element.count * smallest > len(body) - place:
        raise _MalformedError(f"it ends before its {element.count} {element.name} entries do")
    _, counts, _ = _entries(body, place, element, order, min(element.count, 1))
    sizes = [count[0] if count else 0 for count in counts]
    record = _record(element, sizes, order)
    if element.count * record.itemsize <= len(body) - place:
        rows = np.frombuffer(body, record, element.count, place)
        lists = [k for k, (_, _, length) in enumerate(element.properties) if length]
        if all((rows[f"n{k}"] == sizes[k]).all() for k in lists):
            return _uniform(element, rows, sizes), place + element.count * record.itemsize
    columns, counts, place = _entries(body, place, element, order, element.count)
    return _columns(element, columns, counts), place


def _record(element: _Element, sizes: list[int], order: str) -> np.dtype[Any]:
    """The layout of an entry whose lists have these sizes: n0 and p0 are the length and values of property 0."""
    parts: list[Any] = []
    for k, (_, kind, length) in enumerate(element.properties):
        if length:
            parts += [(f"n{k}", order + length), (f"p{k}", order + kind, (sizes[k],))]
        else:
            parts.append((f"p{k}", order + kind))
    return np.dtype(parts)


def _uniform(element: _Element, rows: Any, sizes: list[int]) -> dict[str, Any]:
    table: dict[str, Any] = {}
    for k, (name, _, length) in enumerate(element.properties):
        values = rows[f"p{k}"].astype(np.float64)
        counts = np.full(element.count, sizes[k], np.int64)
        table[name] = _List(counts, values.ravel()) if length else values
    return table


def _entries(
    body: bytes, place: int, element: _Element, order: str, count: int
) -> tuple[list[list[float]], list[list[int]], int]:
    """Values and lengths by property of `count` entries that may differ in length, and where they end."""
    columns: list[list[float]] = [[] for _ in element.properties]
    counts: list[list[int]] = [[] for _ in element.properties]
    heads = [struct.Struct(order + np.dtype(length or "u1").char) for _, _, length in element.properties]
    kinds = [(np.dtype(kind).char, np.dtype(kind).itemsize, bool(length)) for _, kind, length in element.properties]
    try:
        for _ in range(count):
            for column, lengths, head, (kind, width, is_list) in zip(columns, counts, heads, kinds, strict=True):
                size = 1
                if is_list:
                    size = int(head.unpack_from(body, place)[0])
                    place += head.size
                column.extend(struct.unpack_from(f"{order}{size}{kind}", body, place))
                lengths.append(size)
                place += size * width
    except (struct.error, ValueError, OverflowError) as error:
        raise _MalformedError(f"its {element.name} entries are malformed: {error}") from error
    return columns, counts, place
