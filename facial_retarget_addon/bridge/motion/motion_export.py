"""The animation of a face as a motion file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from bpy.types import Context, Object

from ...core.acting.moving_head import measure_moving_head
from ...core.errors import RetargetError
from ...core.mpeg4.arkit import ARKIT_NAMES
from ...core.mpeg4.arkit_take import ArkitTake
from ...core.mpeg4.conversions import stream_of_values
from ...core.mpeg4.faps import FAPS, HEAD_TURNS
from ...files.motion.arkit_csv import write_arkit_csv
from ...files.motion.fap import write_fap
from ..background import Steps, part
from ..performance import check_range, each_frame, read_frame, scene_rate
from .arkit_keys import find_arkit_halves, find_arkit_keys
from .controls import has_controls, read_controls, shown_faps
from .fap_faces import fit_steps
from .head_empty import find_head, read_head
from .key_values import key_value_steps


@dataclass(frozen=True)
class Exported:
    """What was exported: frames, where the motion was read, and sentences that an artist should read."""

    count: int
    source: str
    warnings: list[str]


def export_motion_steps(context: Context, thing: Object, path: Path, frames: range, source: str) -> Steps[Exported]:
    """Write a face's motion at the scene's rate: `.fap`, or `.csv` with ARKit's weights as Live Link Face writes them.

    FAPs come from the face's controls, or off its mesh where it has none; weights from the shape keys that bear
    ARKit's names. All is taken as evaluated, so that drivers and the NLA count.

    Parameters
    ----------
    frames : scene frames.
    source : of FAPs: AUTO as above; MESH measures even if there are controls; MOVING too, and takes the head's motion,
        which lies in the vertices, for FAPs 48 to 50. Otherwise these come from the face's empty.

    Raises
    ------
    RetargetError : for another suffix, or where there is nothing to read.
    """
    check_range(frames)
    match path.suffix.lower():
        case ".fap":
            return (yield from _faps_steps(context, thing, path, frames, source))
        case ".csv":
            return (yield from _weights_steps(context, thing, path, frames))
        case suffix:
            raise RetargetError(f"motion {path} is a {suffix or 'file without a suffix'}, expected .fap or .csv")


def _faps_steps(context: Context, thing: Object, path: Path, frames: range, source: str) -> Steps[Exported]:
    values = np.zeros((len(frames), len(FAPS)))
    controlled = source == "AUTO" and has_controls(thing)
    if controlled:
        used = shown_faps(thing)
    else:
        face = yield from part(fit_steps(thing), 0.0, 0.3)
        used = face.measurable.copy()

    def read(i: int, frame: int) -> None:
        if controlled:
            context.scene.frame_set(frame)
            values[i] = read_controls(thing, context.evaluated_depsgraph_get())
        elif source == "MOVING":
            values[i] = measure_moving_head(face, read_frame(context, (thing,), frame)[None])[0][0]
        else:
            values[i] = face.measure(read_frame(context, (thing,), frame)[None])[0]
        if source != "MOVING":
            values[i, HEAD_TURNS] = read_head(thing, context.evaluated_depsgraph_get())

    yield from part(each_frame(context.scene, frames, read), 0.3, 0.6)
    used |= values.any(axis=0)
    used[HEAD_TURNS] = source == "MOVING" or find_head(thing) is not None
    yield 0.9, "Writing"
    write_fap(stream_of_values(path.stem, scene_rate(context.scene), values, used), path)
    return Exported(len(frames), "its FAP controls" if controlled else "its mesh", [])


def _weights_steps(context: Context, thing: Object, path: Path, frames: range) -> Steps[Exported]:
    keys = {name: (key,) for name, key in find_arkit_keys(thing).items()} | find_arkit_halves(thing)
    if not keys:
        raise RetargetError(f"object {thing.name!r} has no shape key with an ARKit name, expected some such as jawOpen")
    weights = np.zeros((len(frames), len(ARKIT_NAMES)))
    each = [(name, key) for name, some in keys.items() for key in some]
    held = yield from part(key_value_steps(context, [(thing, key) for _, key in each], frames), 0.0, 0.9)
    for (name, _), values in zip(each, held.T, strict=True):  # of two halves their mean
        weights[:, ARKIT_NAMES.index(name)] += values / len(keys[name])
    yield 0.9, "Writing"
    write_arkit_csv(ArkitTake(path.stem, scene_rate(context.scene), weights, None, None), path)
    missing = [name for name in ARKIT_NAMES if name not in keys]
    lack = f"{len(missing)} ARKit shapes have no shape key and are 0: {', '.join(missing)}"
    return Exported(len(frames), f"{len(each)} shape keys", [lack] if missing else [])
