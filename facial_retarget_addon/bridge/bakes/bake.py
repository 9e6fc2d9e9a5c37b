"""The bake that the artist chose, out of one block of frames."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import bpy
from bpy.types import PropertyGroup

from ...core.arrays import FloatArray, Progress
from ...core.errors import RetargetError
from ...core.methods.settings import CACHES, BakeSettings
from ...core.reduction.bake_keys import BakedKeys, compact_keys, onto_rig
from ...files.whole import Aside, check_place
from ..background import Steps, in_thread
from ..heads import Head
from ..paths import chosen_path
from ..settings import read_group
from .cache import add_caches, cache_places, play_caches, with_suffix
from .frames import check_frames, write_head_frames
from .kept import free_file, keep_bake
from .keyed import check_keyed, rig_keys, write_keyed


class Wish(NamedTuple):
    """What the artist wants of a bake: its settings, the pattern of frames' names, where a cache goes.

    keep : whether the bake that the head plays now stays, turned off.
    """

    settings: BakeSettings
    pattern: str
    cache: str
    keep: bool = False

    def cache_path(self) -> Path:
        """The cache's file, absolute, with the kind's suffix.

        Raises
        ------
        RetargetError : as `chosen_path`, and if this Blender cannot write the kind.
        """
        kind = self.settings.kind
        if not getattr(bpy.app.build_options, kind, True):
            raise RetargetError(f"this Blender was built without {kind}, expected another kind of bake")
        return with_suffix(chosen_path(self.cache, "file", "cache", "Bake"), kind)


def read_wish(task: PropertyGroup) -> Wish:
    """The panel's; RetargetError at once, before anything is computed, if a cache has no file or no exporter."""
    bake = task.bake
    wish = Wish(read_group(BakeSettings, bake.how), bake.pattern, bake.cache, bake.earlier == "keep")
    if wish.settings.kind in CACHES:
        check_place(wish.cache_path())
    return wish


class PreparedBake(NamedTuple):
    """A bake of which nothing is written yet.

    figures : for the report. files : that it will write. add_files : writes them among others that appear together.
    write : changes the scene.
    """

    figures: dict[str, Any]
    files: list[Path]
    add_files: Callable[[Aside], None]
    write: Callable[[], None]


def bake_steps(head: Head, unit: float, frames: FloatArray, times: Sequence[float], wish: Wish) -> Steps[PreparedBake]:
    """Prepare a bake of frames (F, V, 3) of a head as the wish has it; it replaces or keeps an earlier one of any kind.

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
    if kind in CACHES:
        places = cache_places(head, free_file(head.things, wish.cache_path(), wish.keep), frames)
        files = sorted({place.path for place in places.values()})
        figures["files"] = [str(path) for path in files]
        return PreparedBake(
            figures,
            files,
            lambda aside: add_caches(aside, head, places, frames, times),
            lambda: _write(head, wish, lambda: play_caches(head, places, times)),
        )
    if kind in ("compact", "rig"):
        baked = yield from _keyed_steps(head, unit, frames, wish.settings)
        check_keyed(head, baked)
        figures |= baked.figures(unit)
        return PreparedBake(figures, [], _no_files, lambda: _write(head, wish, lambda: write_keyed(head, baked, times)))
    check_frames(head, frames, times, wish.pattern, absolute=kind == "absolute")
    figures["keys"] = len(frames)
    return PreparedBake(
        figures,
        [],
        _no_files,
        lambda: _write(head, wish, lambda: write_head_frames(head, frames, times, wish.pattern, kind == "absolute")),
    )


def _no_files(_: Aside) -> None:
    """Nothing on disk."""


def _write(head: Head, wish: Wish, write: Callable[[], None]) -> None:
    if wish.keep:
        keep_bake(head.things)
    write()
    head.things[0].facial_retarget.bake = wish.settings.kind


def _keyed_steps(head: Head, unit: float, frames: FloatArray, settings: BakeSettings) -> Steps[BakedKeys]:
    rig = rig_keys(head) if settings.kind == "rig" else None

    def work(progress: Progress) -> BakedKeys:
        if rig is not None:
            return onto_rig(head.face, rig, frames, settings, progress)
        return compact_keys(head.face, unit, frames, settings, progress)

    return (yield from in_thread(work))
