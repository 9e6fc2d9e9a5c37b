"""What the list of examples shows: read off the shape keys when they may have changed, and kept until then."""

from __future__ import annotations

from zlib import crc32

import numpy as np
from bpy.types import Object, PropertyGroup

from ...core.arrays import FloatArray
from ...core.example_states import ExampleState, ShownExamples, example_states
from ..meshes import read_positions
from ..points.geometry_watch import changes
from ..shape_keys import find_key, key_displacement

_known: dict[tuple[object, ...], tuple[dict[str, ExampleState], str]] = {}
"""The examples that were read last, and when -> their states and their stamp."""


def states_of(task: PropertyGroup) -> dict[str, ExampleState]:
    """The state of each example on the task's list; none while source or target is not chosen."""
    return _read(task)[0]


def stamp_of(task: PropertyGroup) -> str:
    """Tells whether the examples or the method have changed since figures were taken."""
    return f"{task.method} {_read(task)[1]}"


def _read(task: PropertyGroup) -> tuple[dict[str, ExampleState], str]:
    if task.source is None or task.target is None:
        return {}, ""
    names = tuple(example.name for example in task.examples)
    key = (changes(), task.source.session_uid, task.target.session_uid, names)
    if key not in _known:
        faces = [_shown(thing, names) for thing in (task.source, task.target)]
        stamp = 0
        for face in faces:
            for moves in face.moves.values():
                stamp = crc32(b"none" if moves is None else np.ascontiguousarray(moves), stamp)
        _known.clear()
        _known[key] = example_states(names, *faces), f"{stamp:08x}"
    return _known[key]


def _shown(face: Object, names: tuple[str, ...]) -> ShownExamples:
    """What the objects of a head show, each in its own coordinates."""
    parts = (part.thing for part in face.facial_retarget.parts if part.thing is not None)
    things = list(dict.fromkeys((face, *parts)))
    size = float(np.ptp(read_positions(face.data), axis=0).max(initial=0.0)) if len(face.data.vertices) else 0.0
    return ShownExamples(face.name, size, {name: _moves(things, name) for name in names})


def _moves(things: list[Object], name: str) -> FloatArray | None:
    keys = [find_key(thing, name) for thing in things]
    if not any(keys):
        return None
    return np.concatenate(
        [
            np.zeros((len(thing.data.vertices), 3)) if key is None else key_displacement(key)
            for thing, key in zip(things, keys, strict=True)
        ]
    )
