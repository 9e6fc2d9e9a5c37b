"""Facial animation tables on disk: for each parameter of a face, how far it takes every vertex that it moves. JSON.

After the tables (FAT) that MPEG-4 sends along with a face: keyed by FAP, viseme, expression or ARKit shape.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from ..core.arrays import FloatArray
from ..core.errors import RetargetError
from ..core.shapes.parameters import KINDS, Parameter, parameter_of
from ..core.shapes.shape_set import ShapeSet
from .documents import Table, fault_sentence, read_json

FORMAT = "facial-retarget/facial-animation-table"
VERSION = 1
FARTHEST = 1e18
"""No vertex moves farther: the square still fits into float32."""


def read_table(path: Path, vertex_count: int) -> ShapeSet:
    """The shapes of a table, for a face of so many vertices.

    Raises
    ------
    RetargetError : if the file cannot be read or is no such document, is of another vertex count, or holds shapes with
        unknown keys, ranges without extent, vertices that the face does not have or that appear twice, displacements
        that are not finite or not as many as the vertices; names the faults.
    """
    shapes, _ = read_table_parameters(path, vertex_count)
    return shapes


def read_table_parameters(path: Path, vertex_count: int) -> tuple[ShapeSet, dict[str, Parameter]]:
    """The shapes of a table, and the parameter that each of them answers to; errors as `read_table`."""
    wrong: list[str] = []
    root = Table(read_json(path), "", wrong)
    root.expect("format", FORMAT)
    root.expect("version", VERSION)
    root.expect("vertices", vertex_count)
    shapes = root.get("shapes", dict)
    root.no_more()
    if not wrong and not shapes:
        wrong.append("the table has no shapes, expected at least one")
    moves = np.zeros((len(shapes) if not wrong else 0, vertex_count, 3), np.float32)
    parameters: dict[str, Parameter] = {}
    for row, (name, values) in enumerate(shapes.items() if not wrong else ()):
        if not name.strip() or not name.isprintable():
            wrong.append(f"a shape is named {name!r:.60}, expected a readable name")
        shape = Table(values, f"shape {name!r:.60}", wrong)
        parameters[name] = _parameter(shape)
        _fill(shape, moves[row])
        shape.no_more()
    if wrong:
        raise RetargetError(fault_sentence(path, wrong))
    return ShapeSet(tuple(shapes), moves), parameters


def write_table(file: BinaryIO, shapes: ShapeSet) -> None:
    """Write shapes as a table, a line for each; positions read back exactly, what does not move is left out."""
    head = {"format": FORMAT, "version": VERSION, "vertices": shapes.displacements.shape[1]}
    file.write(json.dumps(head)[:-1].encode() + b',\n"shapes": {')
    for row, line in enumerate(_lines(shapes)):
        file.write((",\n" if row else "\n").encode() + line.encode("utf-8", "backslashreplace"))
    file.write(b"\n}}\n")


def _lines(shapes: ShapeSet) -> Iterator[str]:
    for name, move in zip(shapes.names, shapes.displacements, strict=True):
        known = parameter_of(name)
        moved = np.flatnonzero(move.any(axis=1))
        values: dict[str, Any] = {"kind": known.kind}
        if known.key:
            values["key"] = known.key
        values |= {"range": [known.low, known.high], "vertices": moved.tolist()}
        yield f"{json.dumps(name, ensure_ascii=False)}: {json.dumps(values)[:-1]}, {_numbers(move[moved])}}}"


def _numbers(move: FloatArray) -> str:
    """Displacements (n, 3) float32 in the fewest digits that read back exactly."""
    texts = move.astype(str).tolist()
    return f'"displacements": [{", ".join(f"[{x}, {y}, {z}]" for x, y, z in texts)}]'


def _parameter(shape: Table) -> Parameter:
    kind = shape.get("kind", str)
    if kind not in KINDS:
        shape.wrong.append(f"{shape.where} kind = {kind!r:.60}, expected one of {', '.join(KINDS)}")
    key: int | str = ""
    if kind in ("fap", "viseme", "expression"):
        key = shape.get("key", int)
        most = {"fap": 68, "viseme": 14, "expression": 6}[kind]
        if not 1 <= key <= most:
            shape.wrong.append(f"{shape.where} key = {key}, expected 1 to {most}")
    elif kind == "arkit":
        key = shape.get("key", str)
    ends = shape.get("range", list)
    low, high = (float(end) for end in ends) if len(ends) == 2 and all(map(_is_number, ends)) else (0.0, 0.0)
    if not low < high:
        shape.wrong.append(f"{shape.where} range = {ends!r:.60}, expected a lowest and a greater highest value")
    return Parameter(kind, key, low, high)


def _fill(shape: Table, move: FloatArray) -> None:
    """Put a shape's displacements into (V, 3) zeros."""
    faults = len(shape.wrong)
    vertices, displacements = shape.get("vertices", list), shape.get("displacements", list)
    if len(shape.wrong) > faults:
        return
    count = len(move)
    if any(type(v) is not int or not 0 <= v < count for v in vertices) or len(set(vertices)) != len(vertices):
        shape.wrong.append(
            f"{shape.where} has vertices {vertices!r:.60}, expected different ones from 0 to {count - 1}"
        )
    elif len(displacements) != len(vertices):
        shape.wrong.append(
            f"{shape.where} has {len(vertices)} vertices and {len(displacements)} displacements, expected one for each"
        )
    elif not all(type(d) is list and len(d) == 3 and all(map(_is_number, d)) for d in displacements):
        shape.wrong.append(f"{shape.where} has displacements that are not three finite numbers each")
    elif vertices:
        move[vertices] = displacements


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < FARTHEST
