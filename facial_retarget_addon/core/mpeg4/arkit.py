"""ARKit's 52 face shapes as FAPs. Left is the subject's left.

No public table says what an ARKit weight is in FAPs, so this one is ours. Which FAPs a shape moves, and which way,
follows from the muscles behind it. How far is measured: the feature points of three heads whose artists sculpted the
shapes (ICT-FaceKit, a Rocketbox character, a low-polygon character) were read as FAPs, and the values here lie near
the medians, rounded; the turns of the eyes are those that Live Link Face records beside its weights. What no FAP can
say, such as the chin's way back when the jaw opens, is left out.
"""

from __future__ import annotations

from .recipes import Recipe, mirrored, symmetric

_LIPS_OF_THE_JAW: Recipe = {5: -1500, 10: -1320, 12: -280, 52: -1500, 57: -1080, 59: -320}
"""What an opening jaw takes along of the lips' left half and middle: FAP 3 by itself leaves them behind."""

_MIDDLE: dict[str, Recipe] = {
    "jawForward": symmetric({14: 330, 16: 330}),
    "jawOpen": symmetric({3: 1150} | _LIPS_OF_THE_JAW),
    "mouthClose": symmetric({number: -value for number, value in _LIPS_OF_THE_JAW.items()}),
    "mouthFunnel": symmetric(
        {4: -180, 5: -360, 6: -65, 8: -90, 10: -250, 16: 300, 17: 265, 51: -180, 52: -360, 53: -70, 55: -50, 57: -185}
    ),
    "mouthPucker": symmetric({6: -130, 16: 320, 17: 290, 51: -60, 52: -60, 53: -140}),
    "mouthRollLower": symmetric({5: 80, 10: 80, 16: -400, 52: 200, 57: 110}),
    "mouthRollUpper": symmetric({4: 60, 8: 60, 17: -280, 51: 150, 55: 100}),
    "mouthShrugLower": symmetric({5: 230, 10: 170, 16: 180, 18: 380, 52: 300, 57: 200}),
    "mouthShrugUpper": symmetric({4: -230, 8: -170, 17: 50, 51: -230, 55: -100}),
    "browInnerUp": symmetric({31: 170, 33: 50}),
    "cheekPuff": symmetric({16: 100, 17: 120, 39: 130}),
    "tongueOut": {45: 700},
}
"""Shapes of both halves."""

_LEFT: dict[str, Recipe] = {
    "eyeBlink": {19: 900, 21: 124},
    "eyeLookDown": {19: 420, 21: -180, 25: 60000},
    "eyeLookIn": {23: -60000},
    "eyeLookOut": {23: 60000},
    "eyeLookUp": {19: -290, 21: 120, 25: -50000},
    "eyeSquint": {19: 60, 21: 240},
    "eyeWide": {19: -320},
    "jaw": {6: 75, 7: -60, 15: -180, 53: 90, 54: -70},
    "mouth": {6: 100, 7: -110, 8: -60, 10: 60, 12: 120, 53: 105, 54: -115, 55: -80, 57: 80, 59: 140},
    "mouthSmile": {
        **{4: -60, 5: 60, 6: 110, 8: -180, 10: 180, 12: 400},
        **{41: 60, 51: -60, 52: 60, 53: 120, 55: -280, 57: 280, 59: 440},
    },
    "mouthFrown": {8: 50, 10: -50, 12: -200, 55: 110, 57: -125, 59: -235},
    "mouthDimple": {6: 65, 8: -30, 10: 30, 12: 70, 53: 80, 55: -40, 57: 50, 59: 85},
    "mouthStretch": {6: 90, 8: 50, 10: -50, 12: -115, 53: 100, 55: 60, 57: -80, 59: -145},
    "mouthPress": {5: 20, 8: -50, 10: 80, 12: 110, 52: 50, 55: -30, 57: 160, 59: 130},
    "mouthLowerDown": {5: -150, 10: -200, 11: -60, 52: -150, 57: -190, 58: -40},
    "mouthUpperUp": {4: -150, 8: -230, 9: -60, 12: 80, 51: -160, 55: -290, 59: 80},
    "browDown": {31: -60, 33: -95, 35: -75, 37: 50},
    "browOuterUp": {33: 100, 35: 105},
    "cheekSquint": {19: 40, 21: 160, 41: 90},
    "noseSneer": {4: -80, 8: -150, 21: 60, 31: -50, 41: 60, 51: -100, 55: -250, 61: 50, 63: 30},
}
"""Shapes of the left half, and those that lead to the left; the right ones are their mirror images."""

ARKIT_NAMES: tuple[str, ...] = (
    *("eyeBlinkLeft", "eyeLookDownLeft", "eyeLookInLeft", "eyeLookOutLeft", "eyeLookUpLeft", "eyeSquintLeft"),
    *("eyeWideLeft", "eyeBlinkRight", "eyeLookDownRight", "eyeLookInRight", "eyeLookOutRight", "eyeLookUpRight"),
    *("eyeSquintRight", "eyeWideRight", "jawForward", "jawRight", "jawLeft", "jawOpen", "mouthClose", "mouthFunnel"),
    *("mouthPucker", "mouthRight", "mouthLeft", "mouthSmileLeft", "mouthSmileRight", "mouthFrownLeft"),
    *("mouthFrownRight", "mouthDimpleLeft", "mouthDimpleRight", "mouthStretchLeft", "mouthStretchRight"),
    *("mouthRollLower", "mouthRollUpper", "mouthShrugLower", "mouthShrugUpper", "mouthPressLeft", "mouthPressRight"),
    *("mouthLowerDownLeft", "mouthLowerDownRight", "mouthUpperUpLeft", "mouthUpperUpRight", "browDownLeft"),
    *("browDownRight", "browInnerUp", "browOuterUpLeft", "browOuterUpRight", "cheekPuff", "cheekSquintLeft"),
    *("cheekSquintRight", "noseSneerLeft", "noseSneerRight", "tongueOut"),
)
"""In the order of Live Link Face's columns."""

_SHAPES = (
    _MIDDLE
    | {f"{name}Left": recipe for name, recipe in _LEFT.items()}
    | {f"{name}Right": mirrored(recipe) for name, recipe in _LEFT.items()}
)

ARKIT: dict[str, Recipe] = {name: _SHAPES[name] for name in ARKIT_NAMES}
"""Name -> its FAPs at weight 1."""
