"""FAP controls on an object: custom properties, and shape keys that follow them by drivers."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from bpy.types import Depsgraph, Object

from ...core.acting.expression_sets import expression_shapes
from ...core.acting.fap_face import FapFace
from ...core.arrays import BoolArray, FloatArray, Progress
from ...core.mpeg4.faps import FAPS, HEAD_TURNS
from ...fap_controls import CONTROLS, DRIVES, REACH, Control, Drive
from ..background import Steps, in_thread, part
from ..curves import find_curves, remove_curves
from ..shape_keys import find_key, remove_keys, value_path
from .fap_faces import fit_steps, write_shapes


@dataclass(frozen=True)
class Shape:
    """What a face shows of a drive: positions (V, 3) in face space, and the driver's expression."""

    positions: FloatArray
    expression: str


Shapes = dict[str, Shape]
"""Key of a drive -> shape, for the drives that a face can show."""


def make_controls_steps(thing: Object) -> Steps[list[str]]:
    """Give a face its controls, or make those that it has anew; returns the names of the FAPs that it cannot show.

    Raises
    ------
    RetargetError : as `fit_steps`.
    """
    face = yield from part(fit_steps(thing), 0.0, 0.8)
    shapes = yield from part(shape_steps(face), 0.8, 0.15)
    yield 0.95, "Writing"
    write_controls(thing, shapes)
    return [control.fap.name for control in CONTROLS if control.key not in shapes]


def shape_steps(face: FapFace) -> Steps[Shapes]:
    """The shapes of the controls."""

    def shape(progress: Progress) -> Shapes:
        own = expression_shapes(face, ("faps",))
        neutral = face.mesh.vertices.astype(np.float32)
        parts = dict(zip(face.channels, face.channel_shapes() - neutral, strict=True))
        found: Shapes = {}
        for drive in DRIVES:
            name = drive.controls["fap"].fap.name if "fap" in drive.controls else ""
            if not drive.channels and name in own:
                found[drive.key] = Shape(own[name], drive.expression)
            elif drive.channels and drive.channels.keys() <= parts.keys():
                moved = sum(factor * parts[channel] for channel, factor in drive.channels.items())
                found[drive.key] = Shape(neutral + moved, drive.expression.format(shut=_shut_at(face, drive)))
        return found

    return (yield from in_thread(shape))


def write_controls(thing: Object, shapes: Shapes) -> None:
    """Set up all controls of a face. Properties keep the values that they have; keys that it cannot show now go."""
    _remove_driven(thing, [drive.key for drive in DRIVES if drive.key not in shapes])
    for control in CONTROLS:
        _write_property(thing, control)
    write_shapes(thing, {key: shape.positions for key, shape in shapes.items()})
    for drive in DRIVES:
        if drive.key in shapes:
            _write_driver(thing, drive, shapes[drive.key].expression)


def has_controls(thing: Object) -> bool:
    """Whether an object has FAP controls."""
    return any(control.name in thing for control in CONTROLS)


def shown_faps(thing: Object) -> BoolArray:
    """(68,) FAPs that the face's controls show; the head's turns are always among them."""
    shown = np.zeros(len(FAPS), bool)
    shown[HEAD_TURNS] = True
    for control in CONTROLS:
        shown[control.fap.number - 1] = find_key(thing, control.key) is not None
    return shown


def read_controls(thing: Object, depsgraph: Depsgraph) -> FloatArray:
    """(68,) what the controls stand at now."""
    evaluated, values = thing.evaluated_get(depsgraph), np.zeros(len(FAPS))
    for control in CONTROLS:
        values[control.fap.number - 1] = evaluated.get(control.name, 0.0)
    return values


def remove_controls(thing: Object) -> None:
    """Take the controls off again: shape keys, drivers, properties and their curves."""
    _remove_driven(thing, [drive.key for drive in DRIVES])
    bag = find_curves(thing)
    if bag is not None:
        remove_curves(bag, {control.path for control in CONTROLS})
    for control in CONTROLS:
        if control.name in thing:
            del thing[control.name]
    thing.data.update()


def _remove_driven(thing: Object, names: Iterable[str]) -> None:
    """Remove shape keys and what drives them, where they are there."""
    there = [name for name in names if find_key(thing, name) is not None]
    for name in there:
        thing.data.shape_keys.driver_remove(value_path(name))
    remove_keys(thing, there)


def _shut_at(face: FapFace, drive: Drive) -> float | None:
    """The FAP at which a lid is shut, by its arc on a quarter of the way; None if the drive is no lid's."""
    if "{shut}" not in drive.expression:
        return None
    (channel,) = drive.channels
    control = drive.controls["fap"]
    values = np.zeros((1, len(FAPS)))
    values[0, control.fap.number - 1] = 0.25 * control.full
    arc = face.channel_values(values)[0, face.channels.index(channel)]
    return 0.25 * control.full / (0.5 - 0.5 * np.sqrt(1 - arc))


def _write_property(thing: Object, control: Control) -> None:
    thing[control.name] = float(thing.get(control.name, 0.0))
    thing.property_overridable_library_set(control.path, True)
    limit = float(REACH * control.full)
    thing.id_properties_ui(control.name).update(
        description=f"FAP {control.fap.number}: {control.fap.meaning}",
        default=0.0,
        min=-limit,
        max=limit,
        soft_min=0.0 if control.fap.one_way else -float(control.full),
        soft_max=float(control.full),
        step=float(control.full),
        precision=0,
    )


def _write_driver(thing: Object, drive: Drive, expression: str) -> None:
    key = find_key(thing, drive.key)
    key.slider_min, key.slider_max = -REACH, REACH
    keys = thing.data.shape_keys
    keys.driver_remove(value_path(drive.key))
    curve = keys.driver_add(value_path(drive.key))
    # The straight line that a new driver passes through costs digits: keyframes from 5.0 on, a modifier before.
    curve.keyframe_points.clear()
    for modifier in list(curve.modifiers):
        curve.modifiers.remove(modifier)
    driver = curve.driver
    driver.type = "SCRIPTED"
    for name, control in drive.controls.items():
        variable = driver.variables.new()
        variable.name = name
        variable.targets[0].id = thing
        variable.targets[0].data_path = control.path
    driver.expression = expression
