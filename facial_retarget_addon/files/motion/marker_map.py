"""Marker maps on disk: JSON, the feature point of each marker, the rigid markers, the frames of the neutral face."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ...core.errors import RetargetError
from ...core.markers.assignment import MarkerMap
from ...core.markers.head_motion import FEWEST
from ...core.mpeg4.faps import FAPS
from ..documents import Table, fault_sentence, json_bytes, read_json
from ..whole import write_whole

FORMAT = "facial-retarget/marker-map"
VERSION = 1
MOST_GAIN = 1000.0
"""Gains stay below this."""


def read_marker_map(path: Path) -> MarkerMap:
    """Read a marker map: markers, and if they are there rigid, neutral_frame, neutral_last_frame, and gains.

    Gains are keyed by the names of the FAPs.

    Raises
    ------
    RetargetError : if the file cannot be read or is no such document, if a marker or a point appears twice, if fewer
        than three rigid markers are named, if frames are no frames, or if gains are no numbers of FAPs; names all
        faults.
    """
    wrong: list[str] = []
    root = Table(read_json(path), "", wrong)
    root.expect("format", FORMAT)
    root.expect("version", VERSION)
    points = _points(root)
    rigid = _rigid(root)
    neutral_frames = _neutral_frames(root)
    gains = _gains(root)
    root.no_more()
    if wrong:
        raise RetargetError(fault_sentence(path, wrong))
    return MarkerMap(points, rigid, neutral_frames, gains)


def write_marker_map(marker_map: MarkerMap, path: Path) -> None:
    """Write a marker map, whole or not at all; RetargetError if the system refuses."""
    first, last = marker_map.neutral_frames
    document: dict[str, Any] = {
        "format": FORMAT,
        "version": VERSION,
        "markers": marker_map.points,
        "rigid": list(marker_map.rigid),
        "neutral_frame": first,
    }
    if last != first:
        document["neutral_last_frame"] = last
    if marker_map.gains:
        document["gains"] = {FAPS[number - 1].name: gain for number, gain in marker_map.gains.items()}
    write_whole(path, json_bytes(document))


def _points(root: Table) -> dict[str, str]:
    markers = root.get("markers", dict)
    claimed: dict[str, str] = {}
    for marker, point in markers.items():
        if type(point) is not str or not point.strip():
            root.wrong.append(f"marker {marker!r} sits on {point!r:.60}, expected the name of a feature point")
        elif point in claimed:
            root.wrong.append(
                f"markers {claimed[point]!r} and {marker!r} both sit on {point!r}, expected one marker to a point"
            )
        else:
            claimed[point] = marker
    return {marker: point for point, marker in claimed.items()}


def _rigid(root: Table) -> tuple[str, ...]:
    names = root.optional("rigid", list) or []
    if any(type(name) is not str for name in names) or len(set(map(str, names))) != len(names):
        root.wrong.append(f"rigid = {names!r:.60}, expected names of markers, each once")
    elif 0 < len(names) < FEWEST:
        root.wrong.append(f"rigid names {len(names)} markers, expected at least {FEWEST}, or none to have them found")
    return tuple(names)


def _neutral_frames(root: Table) -> tuple[int, int]:
    given = root.optional("neutral_frame", int)
    first = 1 if given is None else given
    given = root.optional("neutral_last_frame", int)
    last = first if given is None else given
    if not 1 <= first <= last:
        root.wrong.append(
            f"neutral_frame = {first} and neutral_last_frame = {last}, expected frames counted from 1, in this order"
        )
    return first, last


def _gains(root: Table) -> dict[int, float]:
    numbers = {fap.name: fap.number for fap in FAPS}
    gains: dict[int, float] = {}
    for name, gain in (root.optional("gains", dict) or {}).items():
        if name not in numbers:
            root.wrong.append(f"gains has {name!r:.60}, expected the name of a FAP such as 'close_t_l_eyelid'")
        elif type(gain) not in (int, float) or not abs(gain) < MOST_GAIN:
            root.wrong.append(f"the gain of {name!r} is {gain!r:.60}, expected a number below {MOST_GAIN:g}")
        else:
            gains[numbers[name]] = float(gain)
    return gains
