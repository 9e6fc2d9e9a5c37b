"""The motion of the whole head, found from markers that sit on it and do not act, and taken away from the others."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray, cross, unit_vectors
from ..errors import RetargetError
from ..rigid import closest_rotations

METHODS = ("kabsch", "linear")

FEWEST = 3
"""Markers that a rotation needs."""
THINNEST = 1e-3
"""Markers whose spread across is below this share of their spread along count as lying on one line."""
FEWEST_CHOSEN = 6
"""Rigid markers that are chosen at least, where there are as many: fewer keep their distances by chance."""
TRIM_ROUNDS = 12
"""Rounds of trimming; each fits again with the weights that the last one gave."""
TRIM_AT = 3.0
"""A marker that is off by this many times the take's noise keeps a quarter of its weight."""
MEDIAN_OF_NOISE = 1.538
"""Median length of a vector of three independent unit normal numbers."""
SAMPLED_FRAMES = 400
"""Frames, evenly spread over a take, that are enough to see which markers keep their distances."""


@dataclass(frozen=True, eq=False)
class HeadMotion:
    """How a head moved: place in frame f = rotations[f] @ place in the neutral head + translations[f].

    Attributes
    ----------
    rotations : (F, 3, 3); proper rotations from "kabsch", nearly so from "linear".
    translations : (F, 3) in the markers' units.
    residual : (F,) root mean square distance of the markers from where the motion puts them, in the markers' units.
    weights : (F, M) what each marker counted, from 0 (not seen) to 1.
    """

    rotations: FloatArray
    translations: FloatArray
    residual: FloatArray
    weights: FloatArray

    def __len__(self) -> int:
        return len(self.rotations)

    def removed(self, positions: FloatArray) -> FloatArray:
        """Positions (F, N, 3) of anything on the head, put where they were had the head kept its neutral place."""
        back: FloatArray = np.einsum(
            "fij,fnj->fni", np.linalg.inv(self.rotations), positions - self.translations[:, None]
        )
        return back


def head_motion(neutral: FloatArray, frames: FloatArray, method: str = "kabsch", trim: bool = False) -> HeadMotion:
    """Motion of the head in every frame, from rigid markers.

    Parameters
    ----------
    neutral : (M, 3) the rigid markers in the neutral frame; NaN leaves a marker out.
    frames : (F, M, 3) the same markers in every frame; NaN leaves a marker out of that frame.
    method : "kabsch" fits a rotation and a translation to all markers with the least squared error; "linear" is the
        paper's way with exactly three markers, whose matrix is a rotation only where there is no noise.
    trim : with "kabsch", whether markers that do not move with the rest count less: in each of 12 rounds a marker that
        is off by r weighs 1 / (1 + (r / 3 s)^2)^2 in that frame, where s is the take's noise, taken from the median of
        all r of the round before.

    Raises
    ------
    RetargetError : if shapes disagree; if a frame shows fewer than three markers, or only markers on one line; for
        "linear" if there are not three markers or one is not seen; if the method is unknown.

    References
    ----------
    Kshirsagar et al., section 4.1, equations (6) to (10) for "linear"; Kabsch 1976 and Umeyama 1991 for "kabsch". The
    weights of `trim` are those of Geman and McClure 1987.
    """
    neutral, frames = np.asarray(neutral, np.float64), np.asarray(frames, np.float64)
    if neutral.ndim != 2 or neutral.shape[1] != 3 or frames.shape[1:] != neutral.shape or not frames.size:
        raise RetargetError(
            f"head motion: neutral markers of shape {neutral.shape} and frames of shape {frames.shape} arrived, "
            "expected (M, 3) and (F, M, 3) with F at least 1"
        )
    seen = np.isfinite(frames).all(axis=2) & np.isfinite(neutral).all(axis=1)
    match method:
        case "kabsch":
            _check_seen(seen)
            return _kabsch(neutral, frames, seen, TRIM_ROUNDS if trim else 0)
        case "linear":
            if len(neutral) != FEWEST:
                raise RetargetError(
                    f"head motion: {len(neutral)} rigid markers arrived, but the linear method takes exactly {FEWEST}"
                )
            _check_seen(seen)
            return _linear(neutral, frames)
        case _:
            raise RetargetError(f"head motion: the method is {method!r}, expected one of {', '.join(METHODS)}")


def rigid_markers(neutral: FloatArray, frames: FloatArray) -> IntArray:
    """Rows of the markers that tell the head's motion best, where nobody has named any.

    The marker whose distances to the others differ most from the neutral's is dropped, again and again. Of the sets on
    this way the one is taken that lets expect the least error over all markers: few markers that sit close together
    may keep their distances well and still say little about a chin far away. It is a guess from the motion alone: a
    brow that never moves in the take is as good as a forehead.

    Parameters
    ----------
    neutral : (M, 3), NaN where a marker was not seen, which leaves it out.
    frames : (F, M, 3), NaN where a marker was not seen; one seen in less than half of the frames is left out.

    Raises
    ------
    RetargetError : if fewer than three markers are left, or if they lie on one line.

    References
    ----------
    Fitzpatrick, West and Maurer 1998, the error of a place from the errors of the markers that a motion was fitted to.
    """
    sample = np.asarray(frames, np.float64)[:: max(len(frames) // SAMPLED_FRAMES, 1)]
    seen = np.isfinite(sample).all(axis=2) & np.isfinite(neutral).all(axis=1)
    left = np.flatnonzero(seen.sum(axis=0) > 0.5 * len(sample))
    if len(left) < FEWEST:
        raise RetargetError(
            f"head motion: {len(left)} of the {sample.shape[1]} markers are seen in the neutral frame and in half of "
            f"the others, expected at least {FEWEST}"
        )
    places = np.asarray(neutral, np.float64)[left]
    if _is_line(places):
        raise RetargetError(f"head motion: the {len(left)} markers of the neutral frame lie on one line")
    change = _distance_change(places, sample[:, left])
    rows, best, least = np.arange(len(left)), left, np.inf
    while len(rows) >= min(FEWEST_CHOSEN, len(left)) and not _is_line(places[rows]):
        among = change[np.ix_(rows, rows)].sum(axis=1)
        error = among.sum() / (len(rows) - 1) * _error_spread(places[rows], places)
        if error < least:
            best, least = left[rows], error
        rows = np.delete(rows, among.argmax())
    return best


def _kabsch(neutral: FloatArray, frames: FloatArray, seen: BoolArray, trim_rounds: int) -> HeadMotion:
    source, target = np.where(np.isfinite(neutral), neutral, 0.0), np.where(seen[..., None], frames, 0.0)
    weights = seen.astype(np.float64)
    motion, distances = _weighted_kabsch(source, target, weights)
    for _ in range(trim_rounds):
        noise = np.median(distances[seen]) / MEDIAN_OF_NOISE
        off = distances / max(TRIM_AT * noise, 1e-12 * float(np.abs(source).max()))
        weights = seen / (1 + off**2) ** 2
        motion, distances = _weighted_kabsch(source, target, weights)
    return motion


def _weighted_kabsch(source: FloatArray, target: FloatArray, weights: FloatArray) -> tuple[HeadMotion, FloatArray]:
    """The motion with the least weighted squared error, and the (F, M) distances that it leaves."""
    shares = (weights / weights.sum(axis=1, keepdims=True))[..., None]
    source_centres, target_centres = (shares * source).sum(axis=1), (shares * target).sum(axis=1)
    centred = source - source_centres[:, None]
    rotations, singular = closest_rotations(np.swapaxes(shares * (target - target_centres[:, None]), 1, 2) @ centred)
    _check_triangle(singular[:, 1] <= THINNEST**2 * singular[:, 0])
    translations = target_centres - np.einsum("fij,fj->fi", rotations, source_centres)
    distances = _distances(rotations, translations, source, target)
    residual = np.sqrt((shares[..., 0] * distances**2).sum(axis=1))
    return HeadMotion(rotations, translations, residual, weights), distances


def _linear(neutral: FloatArray, frames: FloatArray) -> HeadMotion:
    """Two directions between three markers and their cross product are taken to those of each frame: (9) and (10)."""
    _check_triangle(_is_line(neutral[None]), "the neutral frame")
    _check_triangle(_is_line(frames))
    rotations = _directions(frames) @ np.linalg.inv(_directions(neutral))
    translations = (frames - np.einsum("fij,mj->fmi", rotations, neutral)).mean(axis=1)
    distances = _distances(rotations, translations, neutral, frames)
    return HeadMotion(rotations, translations, np.sqrt((distances**2).mean(axis=1)), np.ones(frames.shape[:2]))


def _directions(markers: FloatArray) -> FloatArray:
    """(..., 3, 3) columns: unit vectors from marker 0 to 1 and from 1 to 2, and the direction at right angles."""
    first, second = (unit_vectors(markers[..., k + 1, :] - markers[..., k, :]) for k in range(2))
    return np.stack([first, second, unit_vectors(cross(first, second))], axis=-1)


def _distances(rotations: FloatArray, translations: FloatArray, source: FloatArray, target: FloatArray) -> FloatArray:
    moved = np.einsum("fij,mj->fmi", rotations, source) + translations[:, None]
    distances: FloatArray = np.linalg.norm(moved - target, axis=2)
    return distances


def _distance_change(neutral: FloatArray, frames: FloatArray) -> FloatArray:
    """(M, M) mean squared change of the distances between markers from the neutral's; the largest where unknown."""
    change = np.full((len(neutral),) * 2, np.nan)
    for marker, place in enumerate(neutral):
        off = np.linalg.norm(frames - frames[:, marker, None], axis=2) - np.linalg.norm(neutral - place, axis=1)
        known = np.isfinite(off)
        np.divide(
            (np.where(known, off, 0.0) ** 2).sum(axis=0), known.sum(axis=0), change[marker], where=known.any(axis=0)
        )
    return np.where(np.isnan(change), np.nanmax(change), change)


def _error_spread(markers: FloatArray, places: FloatArray) -> float:
    """Mean squared error over places, as a share of the squared error of the markers that a motion is fitted to.

    References
    ----------
    Fitzpatrick, West and Maurer 1998: (1 + sum_k d_k^2 / 3 f_k^2) / N, with d_k the distance of a place and f_k the
    root mean square distance of the N markers from their principal axis k.
    """
    centre = markers.mean(axis=0)
    _, spread, axes = np.linalg.svd(markers - centre, full_matrices=False)
    along = ((places - centre) @ axes.T) ** 2
    away = along.sum(axis=1, keepdims=True) - along
    marker_along = spread**2 / len(markers)
    return float((1 + (away / (marker_along.sum() - marker_along)).sum(axis=1) / 3).mean() / len(markers))


def _is_line(positions: FloatArray) -> BoolArray:
    """(...) whether positions (..., P, 3) lie on one line."""
    spread = np.linalg.svd(positions - positions.mean(axis=-2, keepdims=True), compute_uv=False)
    on_line: BoolArray = spread[..., 1] <= THINNEST * spread[..., 0]
    return on_line


def _check_triangle(on_line: BoolArray, where: str = "") -> None:
    bad = np.flatnonzero(on_line)
    if len(bad):
        raise RetargetError(
            f"head motion: the rigid markers in {where or f'frame {bad[0] + 1}'} lie on one line or in one place, "
            "which leaves the head's turn open; expected three that span a triangle"
        )


def _check_seen(seen: BoolArray) -> None:
    counts = seen.sum(axis=1)
    few = np.flatnonzero(counts < FEWEST)
    if len(few):
        raise RetargetError(
            f"head motion: frame {few[0] + 1} shows {counts[few[0]]} of the {seen.shape[1]} rigid markers, "
            f"expected at least {FEWEST}"
        )
