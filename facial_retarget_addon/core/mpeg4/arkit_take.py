"""A take of ARKit's 52 face weights, frame by frame."""

from __future__ import annotations

from dataclasses import dataclass

from ..arrays import FloatArray


@dataclass(frozen=True, eq=False)
class ArkitTake:
    """ARKit face weights over time, as a Live Link Face file holds them.

    Attributes
    ----------
    name : of the take.
    fps : frames a second.
    weights : (F, 52), in the order of `arkit.ARKIT`, from 0 to 1.
    head : (F, 3) yaw, pitch, roll of the head in radians as recorded, or None.
    eyes : (F, 6) yaw, pitch, roll of the left eye, then of the right eye, in radians as recorded, or None.
    timecodes : (F,) as in the file, or empty.
    filled : the frames that the recording left out and that lie on straight lines between their neighbours.
    """

    name: str
    fps: float
    weights: FloatArray
    head: FloatArray | None
    eyes: FloatArray | None
    timecodes: tuple[str, ...] = ()
    filled: tuple[int, ...] = ()

    def __len__(self) -> int:
        return len(self.weights)
