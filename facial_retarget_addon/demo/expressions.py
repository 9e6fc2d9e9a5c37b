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
_SPEECH = (80, 112)


def performance_table() -> FloatArray:
    """(F, A) contractions of a performance that starts and ends neutral: expressions, blinks, speech."""
    frame = np.arange(_KEYS[-1][0] + 1)
    names = tuple(EXPRESSIONS)
    keys = np.array([at for at, _, _ in _KEYS])
    levels = np.array([[value * (name == wanted) for wanted in names] for _, name, value in _KEYS])
    span = np.clip(np.searchsorted(keys, frame, side="right") - 1, 0, len(keys) - 2)
    t = np.clip((frame - keys[span]) / (keys[span + 1] - keys[span]), 0.0, 1.0)
    ease = (t * t * (3 - 2 * t))[:, None]
    table = (levels[span] + ease * (levels[span + 1] - levels[span])) @ contractions(*EXPRESSIONS.values())
    start, end = _SPEECH
    s = np.clip((frame - start) / (end - start), 0.0, 1.0)
    envelope = np.sin(np.pi * s) ** 0.5
    syllable = 2 * np.pi * (frame - start) / 24.0
    speech = {
        "jaw": 0.22 * np.sin(2.1 * syllable) ** 2,
        "pucker": 0.55 * np.clip(np.sin(1.3 * syllable + 0.6), 0.0, None),
        "press": 0.5 * np.clip(np.cos(3.1 * syllable), 0.0, None) ** 3,
        "depressor_labii": 0.35 * np.sin(1.7 * syllable) ** 2,
        "frontalis_outer": 0.25 * np.clip(np.sin(0.8 * syllable), 0.0, None),
    }
    for name, value in speech.items():
        table += (envelope * value)[:, None] * contractions({name: 1.0})
    closed = np.max([np.clip(1.0 - np.abs(frame - at) / 3.0, 0.0, 1.0) for at in _BLINKS], axis=0)
    lids = contractions({"blink": 1.0})
    shut = (closed * closed * (3 - 2 * closed))[:, None]
    return np.asarray(table + shut * np.maximum(lids - table * (lids > 0), 0.0))
