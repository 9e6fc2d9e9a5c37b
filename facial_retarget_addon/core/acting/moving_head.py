"""FAPs of a face whose head moves while it acts."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray
from ..errors import RetargetError
from ..markers.head_motion import FEWEST, HeadMotion, head_motion
from ..mpeg4.faps import HEAD_TURNS
from ..mpeg4.fdps import FDPS
from ..mpeg4.head_turn import head_angles
from .fap_face import FapFace


def measure_moving_head(face: FapFace, frames: FloatArray) -> tuple[FloatArray, HeadMotion]:
    """FAPs (F, 68) of frames (F, V, 3), the head's motion taken out and its turn put into FAPs 48 to 50.

    The head is found by the face's anchored points, those that sit on bone or on a rim and that no FAP moves.

    Raises
    ------
    RetargetError : if the face has fewer than three such points, or if they lie on one line.

    References
    ----------
    Kshirsagar et al., section 4.1; Kabsch 1976.
    """
    anchored = [name for name in face.known.names if FDPS[name].anchored]
    if len(anchored) < FEWEST:
        raise RetargetError(
            f"the head's motion needs {FEWEST} points that no FAP moves, such as corners of the eyes and hairline, but "
            f"the face has {len(anchored)}"
        )
    rigid = face.known.index(anchored)
    places = face.known.positions(frames).astype(np.float64)
    motion = head_motion(face.known.positions(face.mesh.vertices)[rigid], places[:, rigid])
    values = face.measure_points(motion.removed(places))
    values[:, HEAD_TURNS] = head_angles(motion.rotations, face.axes)
    return values, motion
