"""The bake that the artist chose, out of one block of frames."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from bpy.types import PropertyGroup

from ...core.arrays import FloatArray, Progress
from ...core.face_regions import REGIONS, region_weights
from ...core.methods.settings import BakeSettings
from ...core.mpeg4.head import gives_axes, head_axes
from ...core.reduction.compact import compact
from ...core.reduction.keyed import KeyedMotion
from ...core.reduction.naming import region_names
from ...core.reduction.rig_fit import fit_to_keys, residual_keys
from ...files.whole import Aside
from ..background import Steps, in_thread
from ..heads import Head
from ..paths import chosen_path
from ..settings import read_group
from .cache import add_caches, cache_paths, play_caches, stop_caches
from .frames import check_frames, write_head_frames
from .keyed import RigKeys, rig_keys, write_keyed

PREFIX = "retargeted_"
"""What the names of a compact bake's keys start with."""


class Wish(NamedTuple):
    """What the artist wants of a bake: its settings, the pattern of frames' names, and where a cache goes."""

    settings: BakeSettings
    pattern: str
    cache: str

    def cache_path(self) -> Path:
        """The cache's file, absolute, with the kind's suffix.

        Raises
        ------
        RetargetError : as `chosen_path`.
        """
        return chosen_path(self.cache, "file", "cache", "Bake and Export").with_suffix(f".{self.settings.kind}")


def read_wish(task: PropertyGroup) -> Wish:
    """The panel's."""
    return Wish(read_group(BakeSettings, task.bake.how), task.bake.pattern, task.bake.cache)


class PreparedBake(NamedTuple):
    """A bake of which nothing is written yet.

    figures : for the report. add_files : writes its files among others that appear together. write : changes the scene.
    """

    figures: dict[str, Any]
    add_files: Callable[[Aside], None]
    write: Callable[[], None]


def bake_steps(head: Head, unit: float, frames: FloatArray, times: Sequence[float], wish: Wish) -> Steps[PreparedBake]:
    """Prepare a bake of frames (F, V, 3) of a head as the wish has it; it will replace an earlier one of any kind.

    Parameters
    ----------
    unit : distance between the eyes, in the head's coordinates.

    Raises
    ------
    RetargetError : for bad input; says what, and on which object.
    """
    kind = wish.settings.kind
    figures: dict[str, Any] = {"kind": kind, "frames": len(frames)}
    yield 0.0, "Preparing the bake"
    if kind in ("pc2", "mdd"):
        paths = cache_paths(head, wish.cache_path(), frames)
        return PreparedBake(
            figures,
            lambda aside: add_caches(aside, head, paths, frames),
            lambda: _write(head, kind, lambda: play_caches(paths, times)),
        )
    if kind in ("compact", "rig"):
        keyed, names, made = yield from _keyed_steps(head, unit, frames, wish.settings)
        figures |= _keyed_figures(keyed, unit, len(names), made, frames)
        return PreparedBake(
            figures, _no_files, lambda: _write(head, kind, lambda: write_keyed(head, names, keyed, times, made))
        )
    check_frames(head, frames, times, wish.pattern, absolute=kind == "absolute")
    figures["keys"] = len(frames)
    return PreparedBake(
        figures,
        _no_files,
        lambda: _write(head, kind, lambda: write_head_frames(head, frames, times, wish.pattern, kind == "absolute")),
    )


def _no_files(_: Aside) -> None:
    """Nothing on disk."""


def _write(head: Head, kind: str, write: Callable[[], None]) -> None:
    stop_caches(head.things)
    write()
    head.things[0].facial_retarget.bake = kind


def _keyed_figures(keyed: KeyedMotion, unit: float, keys: int, made: int, frames: FloatArray) -> dict[str, Any]:
    return {
        "keys": keys,
        "new_keys": made,
        "error": float(keyed.errors.max(initial=0.0) / unit),
        "worst": float(keyed.worst.max(initial=0.0) / unit),
        "bytes": int(keyed.shapes[keys - made :].nbytes + keyed.curves.nbytes),
        "bytes_as_frames": int(4 * frames.size),
        "per_frame": {"error": (keyed.errors / unit).tolist(), "worst": (keyed.worst / unit).tolist()},
    }


def _keyed_steps(
    head: Head, unit: float, frames: FloatArray, settings: BakeSettings
) -> Steps[tuple[KeyedMotion, list[str], int]]:
    """The motion as shape keys, their names, and how many of them are new: the last ones."""
    rest = head.face.mesh.vertices
    moves = np.asarray(frames, np.float32) - rest.astype(np.float32)
    rig = rig_keys(head) if settings.kind == "rig" else None

    def work(progress: Progress) -> tuple[KeyedMotion, list[str], int]:
        if rig is not None:
            return _onto_rig(moves, rig, settings, progress)
        keyed = compact(moves, rest, settings.tolerance * unit, unit, np.random.default_rng(0), progress)
        return keyed, _compact_names(head, keyed.shapes), len(keyed.shapes)

    return (yield from in_thread(work))


def _compact_names(head: Head, shapes: FloatArray) -> list[str]:
    """Names of shapes after the regions of the face; numbers where its points do not tell them."""
    points = head.face.points
    if not gives_axes(points.names):
        return [f"{PREFIX}{number}" for number in range(1, len(shapes) + 1)]
    rest = head.face.mesh.vertices
    places = points.positions(rest)
    left = (rest - places.mean(axis=0)) @ head_axes(points.names, places)[0]
    return [PREFIX + name for name in region_names(shapes, region_weights(head.face), REGIONS, left)]


def _onto_rig(
    moves: FloatArray, rig: RigKeys, settings: BakeSettings, progress: Progress
) -> tuple[KeyedMotion, list[str], int]:
    keyed = fit_to_keys(moves, rig.shapes, rig.low, rig.high, settings.smoothness, progress)
    ranges = [slice(first, first + settings.residual) for first in range(0, len(moves), max(settings.residual, 1))]
    if not settings.residual:
        return keyed, list(rig.names), 0
    more = residual_keys(moves, keyed, ranges)
    return more, [*rig.names, *(f"{PREFIX}residual_{number}" for number in range(1, len(ranges) + 1))], len(ranges)
