"""The expressions of a built-in face, and a performance, as contractions over time."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..core.arrays import FloatArray
from .muscles import contractions

EXPRESSIONS: dict[str, Mapping[str, float]] = {
    "neutral": {},
    "joy": {"zygomatic": 1.0, "squint": 0.8, "jaw": 0.1, "levator": 0.4, "depressor_labii": 0.15},
    "sadness": {
        "frontalis_inner": 1.0,
        "corrugator": 0.5,
        "depressor_anguli": 0.9,
        "mentalis": 0.5,
        "blink": 0.25,
    },
    "anger": {
        "corrugator": 1.1,
        "squint": 0.45,
        "press": 0.8,
        "levator": 0.35,
        "depressor_anguli": 0.25,
        "mentalis": 0.3,
    },
    "fear": {
        "frontalis_inner": 1.0,
        "frontalis_outer": 0.5,
        "corrugator": 0.4,
        "widen": 0.9,
        "risorius": 1.0,
        "depressor_labii": 0.5,
        "jaw": 0.25,
    },
    "disgust": {
        "levator": 1.1,
        "corrugator": 0.6,
        "squint": 0.6,
        "depressor_anguli": 0.35,
        "mentalis": 0.5,
        "blink": 0.15,
    },
    "surprise": {"frontalis_inner": 1.0, "frontalis_outer": 1.0, "widen": 1.0, "jaw": 0.75, "pucker": 0.15},
}
"""The default set of seven (Ekman's six, and neutral)."""

_KEYS: tuple[tuple[int, str, float], ...] = (
    (0, "neutral", 0.0),
    (6, "neutral", 0.0),
    (20, "joy", 1.0),
    (28, "joy", 0.9),
    (40, "surprise", 1.0),
    (48, "surprise", 0.9),
    (60, "anger", 1.0),
    (70, "anger", 1.0),
    (80, "neutral", 0.0),
    (112, "neutral", 0.0),
    (122, "disgust", 1.0),
    (129, "disgust", 0.9),
    (140, "sadness", 1.0),
    (150, "sadness", 1.0),
    (161, "fear", 1.0),
    (168, "fear", 1.0),
    (182, "neutral", 0.0),
    (185, "neutral", 0.0),
)
"""Frame, expression and its strength, at 24 frames a second."""

_BLINKS = (4, 33, 76, 94, 134, 176)
"""Frames at which the lids are shut."""
_SPEECH = (80, 112)
"""First and last frame of the talking."""


def performance_table() -> FloatArray:
    """(F, A) contractions of a performance that starts and ends neutral: expressions, speech, blinks."""
    frame = np.arange(_KEYS[-1][0] + 1, dtype=np.float64)
    table = _expressions(frame) + _speech(frame)
    lids = contractions({"blink": 1.0})
    # A blink shuts the lids from wherever the expression holds them.
    table += _blinks(frame)[:, None] * np.maximum(lids - table * (lids > 0), 0.0)
    return table


def _expressions(frame: FloatArray) -> FloatArray:
    """Eased blends from key to key."""
    names = tuple(EXPRESSIONS)
    keys = np.array([at for at, _, _ in _KEYS])
    levels = np.array([[strength * (name == wanted) for wanted in names] for _, name, strength in _KEYS])
    span = np.clip(np.searchsorted(keys, frame, side="right") - 1, 0, len(keys) - 2)
    ease = _eased((frame - keys[span]) / (keys[span + 1] - keys[span]))[:, None]
    blend: FloatArray = (levels[span] + ease * (levels[span + 1] - levels[span])) @ contractions(*EXPRESSIONS.values())
    return blend


def _speech(frame: FloatArray) -> FloatArray:
    """Jaw and lips as if talking; not in step with each other, as in speech."""
    start, end = _SPEECH
    beat = 2 * np.pi * (frame - start) / 24.0
    share = np.clip((frame - start) / (end - start), 0.0, 1.0)
    envelope = np.sqrt(4 * share * (1 - share))
    talk = {
        "jaw": 0.22 * np.sin(2.1 * beat) ** 2,
        "pucker": 0.55 * np.maximum(np.sin(1.3 * beat + 0.6), 0.0),
        "press": 0.5 * np.maximum(np.cos(3.1 * beat), 0.0) ** 3,
        "depressor_labii": 0.35 * np.sin(1.7 * beat) ** 2,
        "frontalis_outer": 0.25 * np.maximum(np.sin(0.8 * beat), 0.0),
    }
    strength = np.stack([envelope * value for value in talk.values()], axis=1)
    table: FloatArray = strength @ contractions(*({name: 1.0} for name in talk))
    return table


def _blinks(frame: FloatArray) -> FloatArray:
    """How far the lids are shut, (F,) from 0 to 1."""
    return _eased(np.max([1.0 - np.abs(frame - at) / 3.0 for at in _BLINKS], axis=0))


def _eased(t: FloatArray) -> FloatArray:
    """A slow start and a slow end between 0 and 1."""
    s = np.clip(t, 0.0, 1.0)
    eased: FloatArray = s * s * (3 - 2 * s)
    return eased
