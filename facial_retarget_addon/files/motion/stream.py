"""Any file of facial motion as a stream of FAPs, with what was found in it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from ...core.errors import RetargetError
from ...core.markers.assignment import MarkerMap, by_name
from ...core.markers.faps import marker_faps
from ...core.markers.gaps import fill_gaps
from ...core.markers.take import MarkerTake
from ...core.mpeg4.arkit_take import ArkitTake
from ...core.mpeg4.conversions import faps_of_arkit
from ...core.mpeg4.stream import FapStream
from .marker_map import read_marker_map
from .read import Motion, read_motion


def read_stream(
    path: Path, fps: float | None = None, gaps: str = "fill", marker_map: Path | None = None
) -> tuple[FapStream, dict[str, Any]]:
    """Read a file of facial motion as FAPs.

    Parameters
    ----------
    fps : frames a second of a table that does not know it.
    gaps, marker_map : see `stream_of_motion`.

    Returns
    -------
    As `stream_of_motion`.

    Raises
    ------
    RetargetError : as `read_motion` and `stream_of_motion`.
    """
    return stream_of_motion(read_motion(path, fps), path, gaps, marker_map)


def stream_of_motion(
    motion: Motion, path: Path, gaps: str = "fill", marker_map: Path | None = None
) -> tuple[FapStream, dict[str, Any]]:
    """A `.fap` stream, ARKit weights, or optical markers, as FAPs.

    Parameters
    ----------
    motion : what `path` holds.
    gaps : what becomes of markers that were hidden, see `marker_gaps.fill_gaps`.
    marker_map : which marker sits on which point, and where the face is neutral; without it the markers' names say
        which, and the first frame is the neutral one.

    Returns
    -------
    The stream, and plain data: format, name, frames, fps, for markers what `marker_faps` reports, and warnings.

    Raises
    ------
    RetargetError : if the marker map is malformed; for markers, if the names of none say a point, or as in `fill_gaps`
        and `marker_faps`; if there is a marker map, but there are no markers.
    """
    if marker_map is not None and not isinstance(motion, MarkerTake):
        raise RetargetError(f"{path} holds no markers, so that the marker map {marker_map} says nothing about it")
    facts: dict[str, Any] = {"frames": len(motion), "fps": motion.fps, "name": motion.name}
    match motion:
        case FapStream():
            return motion, {"format": "FAPs", **facts, "warnings": []}
        case ArkitTake():
            left_out = f"{len(motion.filled)} frames that the recording left out are filled along straight lines"
            warnings = [left_out] if motion.filled else []
            return faps_of_arkit(motion), {"format": "ARKit weights", **facts, "warnings": warnings}
        case _:
            stream, found = _marker_stream(path, motion, gaps, marker_map)
            return stream, {"format": "markers", **facts, "units": motion.units, **found}


def _marker_stream(
    path: Path, take: MarkerTake, gaps: str, marker_map: Path | None
) -> tuple[FapStream, dict[str, Any]]:
    settled, doubts = (read_marker_map(marker_map), []) if marker_map else _by_name(path, take)
    filled, made_up = fill_gaps(take.subset(settled.points), gaps)
    positions = take.positions.copy()
    positions[:, take.index(settled.points)] = filled.positions
    stream, report = marker_faps(replace(take, positions=positions), settled)
    return stream, {"markers": report, "gaps": made_up, "warnings": [*doubts, *report.pop("warnings")]}


def _by_name(path: Path, take: MarkerTake) -> tuple[MarkerMap, list[str]]:
    """What the markers' names say, and a sentence about those that say nothing."""
    named = by_name(take.names)
    doubtful = [marker for markers in named.doubtful.values() for marker in markers]
    unused = [*named.unknown, *doubtful]
    if not named.points:
        raise RetargetError(
            f"{path}: none of the {len(take.names)} markers is named after a feature point, such as {take.names[0]!r}; "
            "expected names such as 8.3, L_brow_inner or mouth_corner_r, or a marker map"
        )
    doubt = f"{len(unused)} of {len(take.names)} markers do not say by their names where they sit: {', '.join(unused)}"
    return MarkerMap(named.points), [doubt] if unused else []
