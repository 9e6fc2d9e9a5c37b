"""The animation of a face as a motion file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from bpy.types import Context, Object

from ..core.errors import RetargetError
from ..core.mpeg4.arkit import ARKIT_NAMES
from ..core.mpeg4.arkit_take import ArkitTake
from ..core.mpeg4.conversions import stream_of_values
from ..core.mpeg4.faps import FAPS
from ..files.arkit_csv import write_arkit_csv
from ..files.fap import write_fap
from .arkit_keys import find_arkit_keys
from .background import Steps, part
from .controls import has_controls, read_controls, shown_faps
from .fap_faces import fit_steps
from .head_empty import HEAD, read_head
from .performance import each_frame, read_frame, scene_rate


@dataclass(frozen=True)
class Exported:
    """What was exported: frames, where the motion was read, and sentences that an artist should read."""

    count: int
    source: str
    warnings: list[str]


def export_motion_steps(context: Context, thing: Object, path: Path, frames: range, measure: bool) -> Steps[Exported]:
    """Write a face's motion at the scene's rate: `.fap`, or `.csv` with ARKit's weights as Live Link Face writes them.

    FAPs come from the face's controls, or off its mesh where it has none; weights from the shape keys that bear
    ARKit's names. All is taken as evaluated, so that drivers and the NLA count.

    Parameters
    ----------
    frames : scene frames.
    measure : whether FAPs are read off the mesh even if there are controls.

    Raises
    ------
    RetargetError : for another suffix, or where there is nothing to read.
    """
    match path.suffix.lower():
        case ".fap":
            return (yield from _faps_steps(context, thing, path, frames, measure or not has_controls(thing)))
        case ".csv":
            return (yield from _weights_steps(context, thing, path, frames))
        case suffix:
            raise RetargetError(f"motion {path} is a {suffix or 'file without a suffix'}, expected .fap or .csv")


def _faps_steps(context: Context, thing: Object, path: Path, frames: range, measure: bool) -> Steps[Exported]:
    face = (yield from part(fit_steps(thing), 0.0, 0.3)) if measure else None
    values = np.zeros((len(frames), len(FAPS)))
    used = shown_faps(thing) if face is None else face.measurable.copy()

    def read(i: int, frame: int) -> None:
        if face is None:
            context.scene.frame_set(frame)
            values[i] = read_controls(thing, context.evaluated_depsgraph_get())
        else:
            values[i] = face.measure(read_frame(context, thing, frame)[None])[0]
        values[i, HEAD] = read_head(thing, context.evaluated_depsgraph_get())

    yield from part(each_frame(context.scene, frames, read), 0.3, 0.6)
    used |= values.any(axis=0)
    used[HEAD] = thing.facial_retarget.head is not None
    yield 0.9, "Writing"
    write_fap(stream_of_values(path.stem, scene_rate(context.scene), values, used), path)
    return Exported(len(frames), "its FAP controls" if face is None else "its mesh", [])


def _weights_steps(context: Context, thing: Object, path: Path, frames: range) -> Steps[Exported]:
    keys = find_arkit_keys(thing)
    if not keys:
        raise RetargetError(f"object {thing.name!r} has no shape key with an ARKit name, expected some such as jawOpen")
    columns = [(ARKIT_NAMES.index(name), key) for name, key in keys.items()]
    weights = np.zeros((len(frames), len(ARKIT_NAMES)))

    def read(i: int, frame: int) -> None:
        context.scene.frame_set(frame)
        blocks = thing.data.shape_keys.evaluated_get(context.evaluated_depsgraph_get()).key_blocks
        for column, key in columns:
            weights[i, column] = blocks[key].value

    yield from part(each_frame(context.scene, frames, read), 0.0, 0.9)
    yield 0.9, "Writing"
    write_arkit_csv(ArkitTake(path.stem, scene_rate(context.scene), weights, None, None), path)
    missing = [name for name in ARKIT_NAMES if name not in keys]
    lack = f"{len(missing)} ARKit shapes have no shape key and are 0: {', '.join(missing)}"
    return Exported(len(frames), f"{len(keys)} shape keys", [lack] if missing else [])
