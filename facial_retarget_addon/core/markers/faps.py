"""Tracked markers as FAPs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..arrays import BoolArray, FloatArray
from ..errors import RetargetError
from ..mpeg4.channels import PointChannels
from ..mpeg4.conversions import stream_of_values
from ..mpeg4.faps import FAPS, HEAD_TURNS
from ..mpeg4.fapu import ANGLE, Fapu, measure_fapu
from ..mpeg4.head import head_axes
from ..mpeg4.head_turn import head_angles
from ..mpeg4.mean_face import MEAN_FACE
from ..mpeg4.stream import FapStream
from ..rigid import closest_rotations
from .assignment import MarkerMap
from .lips import with_inner_lips, without_swing
from .motion import PointMotion, marker_displacements
from .take import MarkerTake

UPPER_LIDS = (19, 20)
"""FAPs that close the upper lids."""
MIRRORED = 0.01
"""An average face's mirror image fits better by this share of its extent where the sides are swapped, not by noise."""
LIDS_APART = 0.25
"""Lid markers farther apart than this share of the eyes' distance lie beside the lids' edges; open lids are at 0.16."""


def marker_faps(
    take: MarkerTake, marker_map: MarkerMap, head: str = "kabsch", trim: bool = False
) -> tuple[FapStream, dict[str, Any]]:
    """FAPs that move an actor's feature points as the markers moved, measured in the actor's own units.

    Each translation FAP is read off its point's motion in the neutral head's axes, FAPs 48 to 50 off the turn of the
    head. The lips' inner points follow the outer ones, see `marker_lips`. FAPs without a marker are not used. Those
    that have no meaning below zero are held at zero.

    Parameters
    ----------
    take, head, trim : see `marker_motion.marker_displacements`.
    marker_map : points that are no FDPs count neither for the axes of the head nor for FAPs. Its gains multiply.

    Returns
    -------
    The stream, and a plain table: points (point -> marker), followed (inner point of the lips -> outer point), head
    (rigid markers, whether they were found here, the residual of the fit in the take's units, the range of the turn in
    degrees), fapu (lengths in the take's units, and the points that gave them), faps (name -> largest value without its
    sign), clamped (name -> frames, lowest value), and warnings (sentences).

    Raises
    ------
    RetargetError : as `marker_displacements`; if the points are too few for axes or units of the head; if left and
        right seem to be swapped; if a gain is for a FAP that no marker measures.

    References
    ----------
    Kshirsagar et al., section 4; ISO/IEC 14496-2 for the units and the one-way FAPs.
    """
    motion = marker_displacements(take, marker_map, head, trim)
    _check_sides(motion)
    axes = head_axes(motion.names, motion.neutral)
    fapu = measure_fapu(motion.names, motion.neutral, axes)
    full, followed = with_inner_lips(motion, axes[1])
    full = without_swing(full, followed, axes[2])
    channels = PointChannels(full.names, full.neutral, axes, fapu)
    used = channels.measurable.copy()
    values = channels.values(full.displacements) * _gains(marker_map.gains, used)
    clamped = _clamp(values)
    lids = [fap for fap in UPPER_LIDS if used[fap - 1] and fap not in marker_map.gains]
    values[:, HEAD_TURNS] = head_angles(motion.head.rotations, axes)
    used[HEAD_TURNS] = True
    report = {
        "points": {point: marker for marker, point in marker_map.points.items()},
        "followed": followed,
        "head": _head_report(motion, values, head, found=not marker_map.rigid),
        "fapu": {unit: {"length": fapu.length(unit), "taken": taken} for unit, taken in fapu.taken.items()},
        "faps": {FAPS[column].name: float(np.abs(values[:, column]).max()) for column in np.flatnonzero(used)},
        "clamped": clamped,
        "warnings": _lid_warnings(fapu, values, lids),
    }
    return stream_of_values(take.name, take.fps, values, used), report


def _check_sides(motion: PointMotion) -> None:
    """Left and right points that changed places make the average face's mirror image fit better."""
    known = [row for row, name in enumerate(motion.names) if name in MEAN_FACE]
    if len(known) <= 3:
        return  # as good as their mirror image
    mean = np.array([MEAN_FACE[motion.names[row]] for row in known])
    actor = motion.neutral[known]
    mean, actor = mean - mean.mean(axis=0), actor - actor.mean(axis=0)
    _, singular = closest_rotations(actor.T @ mean)
    if singular[2] < -MIRRORED * singular[0]:
        raise RetargetError(
            "markers: left and right seem to be swapped, the face would look backwards; expected left points on the "
            "actor's left"
        )


def _gains(gains: Mapping[int, float], measured: BoolArray) -> FloatArray:
    """(68,) what each FAP is multiplied by."""
    factors = np.ones(len(FAPS))
    for number, gain in gains.items():
        if not (1 <= number <= len(FAPS) and measured[number - 1] and np.isfinite(gain)):
            raise RetargetError(
                f"markers: FAP {number} has the gain {gain!r}, expected a finite gain of a FAP that a marker measures"
            )
        factors[number - 1] = gain
    return factors


def _clamp(values: FloatArray) -> dict[str, dict[str, float]]:
    """Hold one-way FAPs at zero, in place; name -> how many frames lay below and how low, where that can be seen."""
    clamped = {}
    for fap in FAPS:
        column = values[:, fap.number - 1]
        if fap.one_way and column.min() <= -0.5:
            clamped[fap.name] = {"frames": int((column <= -0.5).sum()), "lowest": float(column.min())}
        if fap.one_way:
            np.maximum(column, 0, out=column)
    return clamped


def _head_report(motion: PointMotion, values: FloatArray, method: str, found: bool) -> dict[str, Any]:
    residual = motion.head.residual
    degrees = np.degrees(values[:, HEAD_TURNS] * ANGLE)
    return {
        "method": method,
        "rigid": list(motion.rigid),
        "found": found,
        "residual": float(np.sqrt((residual**2).mean())),
        "worst_residual": float(residual.max()),
        "worst_frame": int(residual.argmax()) + 1,
        "degrees": {
            name: [float(angle.min()), float(angle.max())]
            for name, angle in zip(("pitch", "yaw", "roll"), degrees.T, strict=True)
        },
    }


def _lid_warnings(fapu: Fapu, values: FloatArray, lids: list[int]) -> list[str]:
    """Markers above the edges of the upper lids move less than these."""
    if not lids or fapu.irisd < LIDS_APART * fapu.es:
        return []
    most = ", ".join(f"FAP {number} {values[:, number - 1].max():.0f}" for number in lids)
    return [
        f"the lid markers are {fapu.irisd / fapu.es:.2f} of the eyes' distance apart, open lids about 0.16: they sit "
        f"beside the lids' edges and move less than these; the largest values are {most}, where 1024 shuts the eye. "
        "Give these FAPs a gain"
    ]
