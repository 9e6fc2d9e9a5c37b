"""The target of a live preview: the methods that were fitted to it, and how it is made to look."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from time import perf_counter

import numpy as np
from bpy.types import Depsgraph, Object, PropertyGroup, Scene

from ...core.arrays import FloatArray, IntArray
from ...core.errors import RetargetError
from ...core.gained_face import GainedFace
from ...core.methods.base import Retargeter
from ...core.methods.settings import Settings, without_strengths
from ...preview_state import STATE
from ..gains import read_gains
from ..heads import Head, head_now, read_head
from ..meshes import from_face_space, read_positions
from ..performance import check_visible
from ..settings import read_method_settings
from ..shape_keys import PREVIEW_KEY, find_key
from .preview_keys import keep_own_keys, write_preview
from .preview_origin import origin_of, whole_head


@dataclass(eq=False)
class Fit:
    """A method fitted with some settings."""

    settings: Settings
    retargeter: Retargeter


class PreviewTarget:
    """A scene's target with the methods that were fitted to it.

    Objects are looked up anew at each use: a step of undo replaces them.

    Parameters
    ----------
    scene : with the task. origin : what the fits came from. head : the target's, as it is now.
    gained : its gains. masks : weights (Vt,) of the masks as they were read.
    """

    def __init__(
        self, scene: Scene, origin: dict[str, int], head: Head, gained: GainedFace, masks: dict[str, FloatArray]
    ) -> None:
        self.scene: int = scene.session_uid
        self.origin = origin
        self.fits: dict[str, Fit] = {}
        self.method: str = scene.facial_retarget.method
        self._starts: IntArray = head.starts
        self._to_own: FloatArray = np.linalg.inv(head.linear)
        self._rest = head.face.mesh.vertices.astype(np.float32)
        self._gained, self._masks = gained, masks
        self._shown: FloatArray | None = None
        self._moved: FloatArray | None = None

    def forget_shown(self) -> None:
        """Let the next update show the source although it does what it did."""
        self._shown = None

    def update(self, scene: Scene, depsgraph: Depsgraph) -> None:
        """Show what the source does now."""
        start = perf_counter()
        STATE.trouble = ""
        try:
            frame = _source_now(scene.facial_retarget, depsgraph)
            if self._shown is not None and np.array_equal(frame, self._shown):
                return
            self._moved = self.fits[self.method].retargeter.frames(frame[None])
            self._write(scene, depsgraph)
        except RetargetError as error:
            STATE.trouble = str(error)
            return
        self._shown = frame
        STATE.milliseconds = 1e3 * (perf_counter() - start)

    def changed(self, task: PropertyGroup) -> list[str]:
        """What has changed since the fit of the task's method, by what the artist calls it."""
        found = [what for what, value in origin_of(task).items() if value != self.origin[what]]
        if task.method not in self.fits:
            return ["method", *found]
        now, then = read_method_settings(task, task.method), self.fits[task.method].settings
        return ["settings", *found] if without_strengths(now) != without_strengths(then) else found

    def adjust(self, task: PropertyGroup) -> None:
        """Take over the task's method where it is fitted, and strengths that have changed."""
        fit = self.fits.get(task.method)
        if fit is None:
            return
        self.method = STATE.method = task.method
        settings = read_method_settings(task, task.method)
        if settings != fit.settings and without_strengths(settings) == without_strengths(fit.settings):
            fit.retargeter, fit.settings = fit.retargeter.adjusted(settings), settings

    def set_gains(self, scene: Scene, depsgraph: Depsgraph, painted: bool = False) -> None:
        """Take over gains of regions and masks that have changed; `painted` : the masks' weights too."""
        task, masks = scene.facial_retarget, {} if painted else self._masks
        STATE.trouble = ""
        try:
            new = any(mask.name not in masks for mask in task.masks)
            gains = read_gains(task, read_head(task.target) if new else None, masks)
            self._gained.set(gains)
            self._masks = {name: mask.weights for name, mask in gains.masks.items()}
            self._write(scene, depsgraph)
        except RetargetError as error:
            STATE.trouble = str(error)

    def _write(self, scene: Scene, depsgraph: Depsgraph) -> None:
        """Show what the method has made, as strong as the gains say."""
        if self._moved is None:
            return
        things = whole_head(scene.facial_retarget.target)
        self._check(things)
        positions = self._gained.scale(self._moved.copy())[0]
        for row, (thing, first, last) in enumerate(zip(things, self._starts, self._starts[1:], strict=False)):
            if thing.mode == "EDIT" or find_key(thing, PREVIEW_KEY) is None:
                continue
            keep_own_keys(thing)
            if row == 0:
                own = from_face_space(thing, positions[first:last])
            else:
                moves = positions[first:last] - self._rest[first:last]
                own = read_positions(thing.data) + (moves @ self._to_own[row].T).astype(np.float32)
            write_preview(thing, own, depsgraph)

    def _check(self, things: Sequence[Object]) -> None:
        if [len(thing.data.vertices) for thing in things] != np.diff(self._starts).tolist():
            raise RetargetError("the target's vertices are not those that were fitted, expected a refresh")
        for thing in things:
            for modifier in thing.modifiers:
                if modifier.type == "MESH_CACHE" and modifier.show_viewport:
                    raise RetargetError(
                        f"modifier {modifier.name!r} of object {thing.name!r} plays a cache over the preview, "
                        "expected it off"
                    )


def _source_now(task: PropertyGroup, depsgraph: Depsgraph) -> FloatArray:
    """(V, 3) float32 the source's head as it looks now.

    Raises
    ------
    RetargetError : if it is hidden, or its vertices have changed in number.
    """
    things = whole_head(task.source)
    check_visible(things, depsgraph.view_layer)
    if depsgraph.mode == "RENDER":
        hidden = [thing.name for thing in things if thing.hide_render]
        if hidden:
            raise RetargetError(f"object {hidden[0]!r} is hidden in renders, expected it visible: it is not evaluated")
    return head_now(things, depsgraph)
