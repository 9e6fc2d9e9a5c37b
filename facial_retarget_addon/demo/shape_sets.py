"""The standard's shape sets, acted by the built-in faces: what an artist would sculpt, as contractions of muscles.

Names are those of `core.mpeg4.sets`; "left" is the face's left.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ..core.arrays import FloatArray
from ..core.errors import RetargetError
from ..core.mpeg4.arkit import ARKIT_NAMES
from ..core.mpeg4.visemes import VISEMES
from .expressions import EXPRESSIONS
from .face import DemoFace
from .muscles import contractions

Pose = Mapping[str, float]
MOUTH_CLOSE = "mouthClose"
"""The shape that means something only with the jaw open: its pose has both."""

_WHOLE: dict[str, Pose] = {
    "jawForward": {"jaw_forward": 1.0},
    "jawLeft": {"jaw_aside": 1.0},
    "jawRight": {"jaw_aside": -1.0},
    "jawOpen": {"jaw": 1.0},
    MOUTH_CLOSE: {"jaw": 1.0, "seal": 1.0},
    "mouthFunnel": {"funnel": 1.0, "jaw": 0.10},
    "mouthPucker": {"pucker": 1.0},
    "mouthLeft": {"mouth_aside": 1.0, "zygomatic_l": 0.12, "buccinator_l": 0.35},
    "mouthRight": {"mouth_aside": -1.0, "zygomatic_r": 0.12, "buccinator_r": 0.35},
    "mouthRollLower": {"roll_lower": 1.0},
    "mouthRollUpper": {"roll_upper": 1.0},
    "mouthShrugLower": {"shrug_lower": 1.0, "mentalis": 0.5, "depressor_anguli": 0.15},
    "mouthShrugUpper": {"shrug_upper": 1.0},
    "browInnerUp": {"frontalis_inner": 1.0},
    "cheekPuff": {"puff": 1.0, "press": 0.35},
    "tongueOut": {"tongue_out": 1.0, "jaw": 0.5, "lower_down": 0.5, "upper_up": 0.2},
}
_LEFT: dict[str, Pose] = {
    "eyeBlink": {"blink_l": 1.0},
    "eyeLookDown": {"look_up_l": -1.0},
    "eyeLookIn": {"look_aside_l": -1.0},
    "eyeLookOut": {"look_aside_l": 1.0},
    "eyeLookUp": {"look_up_l": 1.0},
    "eyeSquint": {"tighten_l": 0.85, "squint_l": 0.35},
    "eyeWide": {"widen_l": 1.0},
    "mouthSmile": {"zygomatic_l": 0.85, "squint_l": 0.2},
    "mouthFrown": {"depressor_anguli_l": 1.0},
    "mouthDimple": {"buccinator_l": 1.0, "press_l": 0.2},
    "mouthStretch": {"risorius_l": 1.0, "depressor_anguli_l": 0.4},
    "mouthPress": {"press_l": 1.4, "zygomatic_l": 0.12},
    "mouthLowerDown": {"lower_down_l": 1.0, "depressor_labii_l": 0.1},
    "mouthUpperUp": {"upper_up_l": 1.0, "levator_l": 0.4},
    "browDown": {"corrugator_l": 0.85, "depressor_supercilii_l": 1.0},
    "browOuterUp": {"frontalis_outer_l": 0.85},
    "cheekSquint": {"squint_l": 1.0, "zygomatic_l": 0.1},
    "noseSneer": {"nasalis_l": 1.0, "levator_l": 0.3, "corrugator_l": 0.2},
}
"""Shapes of the left half; the right ones are their mirror images."""

_VISEMES: dict[str, Pose] = {
    "viseme_PP": {"press": 1.0, "roll_upper": 0.25, "roll_lower": 0.25},
    "viseme_FF": {"roll_lower": 0.9, "upper_up": 0.9, "levator": 0.15, "shrug_lower": 0.3},
    "viseme_TH": {"jaw": 0.24, "lower_down": 0.2, "upper_up": 0.25, "tongue_out": 0.45},
    "viseme_DD": {"jaw": 0.13, "lower_down": 0.4, "upper_up": 0.3, "risorius": 0.1},
    "viseme_kk": {"jaw": 0.20, "lower_down": 0.25, "upper_up": 0.25},
    "viseme_CH": {"jaw": 0.06, "funnel": 0.85, "pucker": 0.15},
    "viseme_SS": {"jaw": 0.04, "lower_down": 0.55, "upper_up": 0.4, "risorius": 0.35},
    "viseme_nn": {"jaw": 0.10, "lower_down": 0.3, "upper_up": 0.2},
    "viseme_RR": {"jaw": 0.08, "funnel": 0.35, "pucker": 0.35},
    "viseme_aa": {"jaw": 0.75, "upper_up": 0.2},
    "viseme_E": {"jaw": 0.34, "risorius": 0.30, "upper_up": 0.25, "lower_down": 0.2},
    "viseme_ih": {"jaw": 0.18, "risorius": 0.40, "upper_up": 0.3, "lower_down": 0.3},
    "viseme_oh": {"jaw": 0.48, "pucker": 0.45, "funnel": 0.20},
    "viseme_ou": {"jaw": 0.12, "pucker": 0.85, "funnel": 0.35},
}


def _mirrored(pose: Pose) -> Pose:
    """The pose of the mirrored face."""
    sides = {"l": "r", "r": "l"}
    turned = {}
    for name, value in pose.items():
        stem, _, side = name.rpartition("_")
        turned[f"{stem}_{sides[side]}" if side in sides else name] = -value if stem == "look_aside" else value
    return turned


_ARKIT: dict[str, Pose] = (
    _WHOLE
    | {f"{name}Left": pose for name, pose in _LEFT.items()}
    | {f"{name}Right": _mirrored(pose) for name, pose in _LEFT.items()}
)

POSES: dict[str, dict[str, Pose]] = {
    "arkit": {name: _ARKIT[name] for name in ARKIT_NAMES},
    "visemes": {name: _VISEMES[name] for name in VISEMES},
    "expressions": {name: pose for name, pose in EXPRESSIONS.items() if pose},
}
"""Set -> shape -> contractions, in the standard's order."""


def face_shapes(face: DemoFace, sets: Sequence[str] = tuple(POSES)) -> dict[str, FloatArray]:
    """Positions (V, 3) float32 of the shapes of one or several sets, by name, in the standard's order.

    Only the donor has a tongue: on the others tongueOut parts the lips alone. As in the standard's set, mouthClose
    undoes what jawOpen does to the lips: alone it pushes one through the other.

    Parameters
    ----------
    face : a built-in face: all can act.
    sets : some of "arkit", "visemes", "expressions".

    Raises
    ------
    RetargetError : for a set that the built-in faces do not have.
    """
    unknown = [name for name in sets if name not in POSES]
    if unknown:
        raise RetargetError(
            f"the built-in faces have no set {', '.join(map(repr, unknown))}, expected some of {', '.join(POSES)}"
        )
    poses = {name: pose for chosen in sets for name, pose in POSES[chosen].items()}
    shapes = dict(zip(poses, face.frames(contractions(*poses.values())), strict=True))
    if MOUTH_CLOSE in shapes:
        opened = face.frames(contractions(POSES["arkit"]["jawOpen"]))[0]
        shapes[MOUTH_CLOSE] += face.face.mesh.vertices.astype(np.float32) - opened
    return shapes
