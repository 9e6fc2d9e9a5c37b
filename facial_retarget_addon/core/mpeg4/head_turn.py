"""The turn of the head: rotation matrices to FAPs 48 to 50 (pitch, yaw, roll) and back."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray
from .fapu import ANGLE


def head_angles(rotations: FloatArray, axes: FloatArray) -> FloatArray:
    """Values of FAPs 48, 49 and 50 that turn a head as these rotations do.

    Pitch is positive when the face looks down, yaw when it looks to the subject's left, roll when the head tilts to the
    subject's right. The standard gives no order; here the head rolls first, then pitches, then yaws:
    R = Ry(yaw) Rx(pitch) Rz(roll) in the head's axes. Where the face looks straight up or down, yaw and roll turn about
    one line, and only their sum or difference means something.

    Parameters
    ----------
    rotations : (F, 3, 3) rotations from the neutral head, in the object's axes.
    axes : (3, 3) rows: the head's left, up and forward in the object's axes; unit vectors at right angles.

    Returns
    -------
    (F, 3) pitch, yaw and roll in units of 1e-5 radians; pitch within a quarter turn, the others within half a turn.
    """
    turn = axes @ rotations @ axes.T
    pitch = np.arcsin(np.clip(-turn[:, 1, 2], -1, 1))
    yaw = np.arctan2(turn[:, 0, 2], turn[:, 2, 2])
    roll = np.arctan2(turn[:, 1, 0], turn[:, 1, 1])
    return np.stack([pitch, yaw, roll], axis=1) / ANGLE


def rotation_of_angles(values: FloatArray, axes: FloatArray) -> FloatArray:
    """Rotations of the head, from the values of FAPs 48, 49 and 50; undoes `head_angles`.

    Parameters
    ----------
    values : (F, 3) pitch, yaw and roll in units of 1e-5 radians.
    axes : (3, 3) rows: the head's left, up and forward in the object's axes; unit vectors at right angles.

    Returns
    -------
    (F, 3, 3) rotations from the neutral head, in the object's axes.
    """
    (sp, sy, sr), (cp, cy, cr) = (part(np.asarray(values).T * ANGLE) for part in (np.sin, np.cos))
    turn = np.array(
        [
            [cy * cr + sy * sp * sr, -cy * sr + sy * sp * cr, sy * cp],
            [cp * sr, cp * cr, -sp],
            [-sy * cr + cy * sp * sr, sy * sr + cy * sp * cr, cy * cp],
        ]
    )
    return axes.T @ np.moveaxis(turn, 2, 0) @ axes
