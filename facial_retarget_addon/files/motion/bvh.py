"""BVH skeletons in motion: every joint is a marker at its place."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ...core.arrays import FloatArray
from ...core.errors import RetargetError
from ...core.markers.take import MarkerTake
from .marker_take import marker_take
from .number_rows import Row, numbers, of_width, whole_number
from .rates import measured_rate
from .text import read_motion_lines

_CHANNEL = re.compile(r"([XYZ])(position|rotation)", re.IGNORECASE)


@dataclass
class _Joint:
    """A joint of the skeleton.

    parent : its place in the list of joints, which comes before its own, or None.
    offset : (3,) from the parent, where no position channel says otherwise.
    channels : axis and kind of each, in the order of the file.
    first : the column of the first one.
    """

    name: str
    parent: int | None
    offset: FloatArray = field(default_factory=lambda: np.zeros(3))
    channels: list[tuple[int, str]] = field(default_factory=list)
    first: int = 0


def read_bvh(path: Path) -> MarkerTake:
    """Read a BVH file: where its joints are in each frame, and the ends of its chains as "<joint> end".

    Rotations are taken in the order of a joint's channels, in degrees; a position channel replaces the offset on its
    axis, as in the exports of today's programs.

    Raises
    ------
    RetargetError : if the file cannot be read or is malformed, or other frames follow than it says.
    """
    lines = [*enumerate(read_motion_lines(path, "a BVH file"), 1)]
    start = next((place for place, (_, line) in enumerate(lines) if line.strip().upper() == "MOTION"), None)
    if start is None or lines[0][1].strip().upper() != "HIERARCHY":
        raise RetargetError(f"{path} is no BVH file: expected a HIERARCHY and then a MOTION, each on a line of its own")
    joints = _joints(path, lines[1:start])
    frames, fps, rows = _motion(path, lines[start + 1 :])
    width = sum(len(joint.channels) for joint in joints)
    if len(rows) != frames:
        raise RetargetError(f"{path} says {frames} frames, but {len(rows)} follow")
    values = numbers(path, of_width(path, rows, width)).reshape(len(rows), width)
    if np.isnan(values).any() or any(np.isnan(joint.offset).any() for joint in joints):
        raise RetargetError(f"{path} has an offset or a channel that is no number")
    return marker_take(path, fps, [joint.name for joint in joints], _places(joints, values))


def _joints(path: Path, lines: Iterable[tuple[int, str]]) -> list[_Joint]:
    """The joints of a hierarchy, parents first."""
    joints: list[_Joint] = []
    open_joints: list[int] = []
    columns = 0
    for line, words in _statements(lines):
        match [words[0].upper(), *words[1:]]:
            case ["ROOT" | "JOINT", _, *_]:
                joints.append(_Joint(" ".join(words[1:]), open_joints[-1] if open_joints else None))
            case ["END", "Site" | "SITE" | "site"] if open_joints:
                joints.append(_Joint(f"{joints[open_joints[-1]].name} end", open_joints[-1]))
            case ["{"] if joints:
                open_joints.append(len(joints) - 1)
            case ["}"] if open_joints:
                open_joints.pop()
            case ["OFFSET", _, _, _] if open_joints:
                joints[open_joints[-1]].offset = numbers(path, [(line, words[1:])])
            case ["CHANNELS", count, *names] if (
                open_joints and not joints[open_joints[-1]].channels and whole_number(count) == len(names)
            ):
                joints[open_joints[-1]].first = columns
                joints[open_joints[-1]].channels = [_channel(path, line, name) for name in names]
                columns += len(names)
            case _:
                raise RetargetError(
                    f"{path}: line {line} has {' '.join(words)!r:.60}, which no BVH hierarchy has there"
                )
    if open_joints:
        raise RetargetError(f"{path}: the hierarchy ends inside joint {joints[open_joints[-1]].name!r:.60}")
    return joints


def _statements(lines: Iterable[tuple[int, str]]) -> Iterable[Row]:
    """Number and words of each statement; braces may stand on lines of their own or behind others."""
    for line, text in lines:
        for part in re.sub(r"([{}])", r"\n\1\n", text).split("\n"):
            if part.strip():
                yield line, part.split()


def _channel(path: Path, line: int, name: str) -> tuple[int, str]:
    """Axis and kind of a channel."""
    found = _CHANNEL.fullmatch(name)
    if found is None:
        raise RetargetError(f"{path}: line {line} has the channel {name!r:.60}, expected a position or rotation")
    return "XYZ".index(found[1].upper()), found[2].lower()


def _motion(path: Path, lines: list[tuple[int, str]]) -> tuple[int, float, list[Row]]:
    """Count of frames, frames a second, and the rows of the frames."""
    given = [(line, text.split()) for line, text in lines if text.strip()]
    match given[:2]:
        case [(_, [frames, count]), (_, [frame, time, seconds])] if (frames.lower(), frame.lower(), time.lower()) == (
            "frames:",
            "frame",
            "time:",
        ):
            step = numbers(path, [(given[1][0], [seconds])])[0]
            known = whole_number(count)
            if known is not None and step > 0:
                return known, measured_rate(path, 1 / step), list(given[2:])
    raise RetargetError(f"{path}: its MOTION does not start with 'Frames: <count>' and 'Frame Time: <seconds>'")


def _places(joints: list[_Joint], values: FloatArray) -> FloatArray:
    """(F, J, 3) places of the joints for channels (F, C)."""
    places = np.empty((len(values), len(joints), 3))
    turns: list[FloatArray] = []
    for number, joint in enumerate(joints):
        local = np.tile(joint.offset, (len(values), 1))
        turn = np.eye(3)
        for column, (axis, kind) in enumerate(joint.channels, joint.first):
            if kind == "position":
                local[:, axis] = values[:, column]
            else:
                turn = turn @ _rotations(axis, np.radians(values[:, column]))
        if joint.parent is None:
            places[:, number] = local
        else:
            places[:, number] = places[:, joint.parent] + (turns[joint.parent] @ local[..., None])[..., 0]
            turn = turns[joint.parent] @ turn
        turns.append(turn)
    return places


def _rotations(axis: int, angles: FloatArray) -> FloatArray:
    """(F, 3, 3) right-handed rotations about an axis, by radians (F,)."""
    second, third = (axis + 1) % 3, (axis + 2) % 3
    turns = np.tile(np.eye(3), (len(angles), 1, 1))
    turns[:, second, second] = turns[:, third, third] = np.cos(angles)
    turns[:, third, second] = np.sin(angles)
    turns[:, second, third] = -turns[:, third, second]
    return turns
