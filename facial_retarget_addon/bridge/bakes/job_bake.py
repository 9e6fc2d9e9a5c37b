"""The panel's bake as a job knows it, and back."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from bpy.types import Object, PropertyGroup

from ...core.methods.settings import BakeSettings
from ...core.reduction.bake_keys import RigKeys
from ...core.shapes.shape_set import ShapeSet
from ...files.bake_output import KINDS, BakeOutput, usual_range
from ...files.mesh_file import MeshFile
from ...files.shape_files import add_shapes
from ...files.whole import Aside
from ..heads import Head
from ..settings import read_group, write_group
from ..shape_keys import ensure_key, write_key
from .keyed import rig_keys


class JobBake:
    """What a job does of the panel's bake: nothing where it is of a kind that only Blender has.

    Raises
    ------
    RetargetError : as `rig_keys`, where the bake is onto the rig.
    """

    def __init__(self, task: PropertyGroup, target: Head) -> None:
        self._settings = read_group(BakeSettings, task.bake.how)
        self._neutral = target.file
        self._rig = rig_keys(target) if self._settings.kind == "rig" else None

    def add(self, aside: Aside, beside: Callable[[str], Path]) -> BakeOutput | None:
        """Write the rig among the job's files, where there is one.

        Parameters
        ----------
        beside : where a file of this name lies.
        """
        if self._settings.kind not in KINDS:
            return None
        curves = beside("curves.csv"), beside("curves.json")
        new = self._rig is None or self._settings.residual
        shapes = beside("keys.npz") if new else None
        if self._rig is None:
            return BakeOutput(self._settings, curves, shapes)
        add_shapes(aside, ShapeSet(self._rig.names, self._rig.shapes), beside("rig.npz"), self._neutral)
        return BakeOutput(self._settings, curves, shapes, beside("rig.npz"), _ranges(self._rig))


def _ranges(rig: RigKeys) -> dict[str, tuple[float, float]]:
    """Ranges that are not the usual one, in the fewest digits that mean Blender's float32."""
    ends = {
        name: (float(str(np.float32(low))), float(str(np.float32(high))))
        for name, low, high in zip(rig.names, rig.low, rig.high, strict=True)
    }
    return {name: pair for name, pair in ends.items() if pair != usual_range(name)}


def show_job_bake(
    task: PropertyGroup, target: Object, bake: BakeOutput | None, rig: RigKeys | None, file: MeshFile
) -> None:
    """Let the panel say what a job says of its bake; the rig's shapes become the target's shape keys.

    A job without a bake is one of frames.
    """
    write_group(task.bake.how, BakeSettings() if bake is None else bake.settings)
    if rig is None:
        return
    rest = file.mesh.vertices.astype(np.float32)
    for name, moves, low, high in zip(*rig, strict=True):
        key = ensure_key(target, name)
        write_key(key, rest + moves)
        key.slider_min, key.slider_max = low, high
