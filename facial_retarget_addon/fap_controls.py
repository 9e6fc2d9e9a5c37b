"""FAP controls, by which an artist moves an MPEG-4 face: what they are called, and what they drive. Plain data.

A control is a custom property of the face's object, in units of its FAP. Shape keys follow it by drivers whose
expressions Blender evaluates by itself, so that they work without Python and without this extension.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from .core.mpeg4.faps import FAPS, Fap
from .core.mpeg4.sets import SETS

REACH = 10
"""Controls go this many times as far as full: Blender lets no shape key go farther."""


@dataclass(frozen=True)
class Control:
    """A custom property.

    Attributes
    ----------
    fap : the FAP that it holds.
    full : its value at full strength.
    """

    fap: Fap
    full: int

    @property
    def name(self) -> str:
        """Name of the custom property."""
        return f"fap_{self.fap.name}"

    @property
    def path(self) -> str:
        """Data path of the custom property."""
        return f'["{self.name}"]'

    @property
    def key(self) -> str:
        """Name of the shape key that shows the FAP, or the first part of it."""
        return f"FAP {self.fap.number} {self.fap.name}"


@dataclass(frozen=True)
class Drive:
    """A shape key that follows controls.

    Attributes
    ----------
    key : its name.
    expression : its value, of the variables and with what Blender's own expressions know; {shut} stands for the FAP's
        value that shuts the lid.
    controls : variable -> control.
    channels : what the shape adds up: channel of `FapFace` -> factor. Empty for the FAP's own shape at full strength.
    """

    key: str
    expression: str
    controls: dict[str, Control]
    channels: dict[str, float] = field(default_factory=dict)


CONTROLS: tuple[Control, ...] = tuple(
    Control(fap, SETS["faps"][fap.name][fap.number]) for fap in FAPS if fap.name in SETS["faps"]
)
"""One for each FAP that has a shape, in their order. The head's turn is no shape: an empty shows it."""

_BY_NUMBER = {control.fap.number: control for control in CONTROLS}
_LAST = {
    "Jaw and Inner Lips": 18,
    "Eyes": 30,
    "Brows": 38,
    "Cheeks": 42,
    "Tongue": 47,
    "Outer Lips": 60,
    "Nose": 64,
    "Ears": 68,
}
"""Group of the standard -> its last FAP."""


def _group(fap: Fap) -> str:
    return next(group for group, last in _LAST.items() if fap.number <= last)


GROUPS: dict[str, tuple[Control, ...]] = {
    group: tuple(control for control in CONTROLS if _group(control.fap) == group) for group in _LAST
}
"""Group -> its controls."""

_LIDS = {"3.1": 19, "3.2": 20, "3.3": 21, "3.4": 22}
"""Middle of a lid -> the FAP that shuts it."""
_EYES = {"left": (25, 23), "right": (26, 24)}
"""Eye -> the FAPs of its pitch and yaw."""


def _own(control: Control) -> Drive:
    return Drive(control.key, f"fap / {control.full}", {"fap": control})


def _lid(middle: str, control: Control) -> Drive:
    """What lifts a lid over the eyeball on its way: 1 for a lid that is half shut."""
    share = "min(max(fap / {shut}, 0), 1)"
    return Drive(f"{control.key} half shut", f"4 * {share} * (1 - {share})", {"fap": control}, {f"{middle} arc": 1.0})


def _eye(side: str, pitch: Control, yaw: Control) -> list[Drive]:
    """An eye's rotation Ry(yaw) Rx(pitch) less the identity, as a sum of sines, cosines less 1, and their products."""
    p, y = "pitch / 100000", "yaw / 100000"
    parts: tuple[tuple[str, str, dict[str, float]], ...] = (
        (yaw.key, f"sin({y})", {"xz": 1, "zx": -1}),
        (f"{yaw.key} inwards", f"cos({y}) - 1", {"xx": 1, "zz": 1}),
        (pitch.key, f"sin({p})", {"zy": 1, "yz": -1}),
        (f"{pitch.key} inwards", f"cos({p}) - 1", {"yy": 1, "zz": 1}),
        (f"{yaw.key} and pitch 1", f"sin({y}) * sin({p})", {"xy": 1}),
        (f"{yaw.key} and pitch 2", f"sin({y}) * (cos({p}) - 1)", {"xz": 1}),
        (f"{yaw.key} and pitch 3", f"(cos({y}) - 1) * sin({p})", {"zy": 1}),
        (f"{yaw.key} and pitch 4", f"(cos({y}) - 1) * (cos({p}) - 1)", {"zz": 1}),
    )
    variables = {"pitch": pitch, "yaw": yaw}
    return [
        Drive(
            key,
            expression,
            {name: control for name, control in variables.items() if name in expression},
            {f"eye {side} turn {entry}": float(factor) for entry, factor in entries.items()},
        )
        for key, expression, entries in parts
    ]


_TURNS = {number for pair in _EYES.values() for number in pair}

DRIVES: tuple[Drive, ...] = (
    *(_own(control) for control in CONTROLS if control.fap.number not in _TURNS),
    *(_lid(middle, _BY_NUMBER[number]) for middle, number in _LIDS.items()),
    *(drive for side, faps in _EYES.items() for drive in _eye(side, *(_BY_NUMBER[number] for number in faps))),
)
"""The shape keys of a face that has every point."""
