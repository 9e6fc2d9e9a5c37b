"""The curves of a head's shape keys as a file that other programs read."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from bpy.types import Context, Object

from ...core.errors import RetargetError
from ...files.curves import Curves, check_curves_place, write_curves
from ..background import Steps, part
from ..heads import head_parts
from ..key_sets import check_relative, key_names
from ..performance import scene_rate
from ..shape_keys import find_key
from .key_values import key_value_steps
from .motion_export import Exported


def export_curves_steps(context: Context, face: Object, path: Path, frames: Sequence[float]) -> Steps[Exported]:
    """Write what the shape keys of a face and the parts of its head stand at: `.csv` or `.json`, see `add_curves`.

    Keys that are muted are left out. A key that several objects have is that of the first of them.

    Parameters
    ----------
    frames : scene frames at equal steps.

    Raises
    ------
    RetargetError : for another suffix, absolute keys, an object that is hidden, or where there is no key.
    """
    check_curves_place(path)
    keys: dict[str, Object] = {}
    for thing in (face, *head_parts(face)):
        check_relative(thing)
        for name in key_names(thing):
            if not find_key(thing, name).mute:
                keys.setdefault(name, thing)
    if not keys:
        raise RetargetError(f"object {face.name!r} has no shape key, expected some whose curves could be exported")
    wanted = [(thing, name) for name, thing in keys.items()]
    values = yield from part(key_value_steps(context, wanted, frames), 0.0, 0.9)
    yield 0.9, "Writing"
    write_curves(Curves(tuple(keys), frames, values, scene_rate(context.scene)), path)
    return Exported(len(frames), f"{len(keys)} shape keys", [])
