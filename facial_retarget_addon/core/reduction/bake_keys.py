"""A performance as the shape keys that a bake asks for: as few as a tolerance allows, or the ones that are there."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..arrays import FloatArray, Progress, no_progress
from ..errors import RetargetError
from ..face_regions import REGIONS, region_weights
from ..methods.settings import BakeSettings
from ..mpeg4.head import gives_axes, head_axes
from ..problem import Face
from .compact import compact
from .keyed import FromNeutral, KeyedMotion
from .naming import region_names
from .rig_fit import fit_to_keys, residual_keys

PREFIX = "retargeted_"
"""What the names of new keys start with."""
_RESIDUAL = f"{PREFIX}residual_"


class RigKeys(NamedTuple):
    """The shape keys of a head that frames can be fitted to.

    names : (K,). shapes : (K, V, 3) float32 displacements at 1, in the head's coordinates. low, high : (K,) ranges.
    """

    names: tuple[str, ...]
    shapes: FloatArray
    low: FloatArray
    high: FloatArray


class BakedKeys(NamedTuple):
    """A performance as shape keys with curves.

    names : (K,). made : the last so many of them are new, the others were there.
    """

    names: tuple[str, ...]
    keyed: KeyedMotion
    made: int

    def figures(self, unit: float) -> dict[str, Any]:
        """Plain data for a report: how many keys, their size against a key per frame, and the errors.

        Parameters
        ----------
        unit : what errors are measured in, such as the distance between the eyes; in the shapes' units.
        """
        keyed, new = self.keyed, len(self.names) - self.made
        return {
            "keys": len(self.names),
            "new_keys": self.made,
            "error": float(keyed.errors.max(initial=0.0) / unit),
            "worst": float(keyed.worst.max(initial=0.0) / unit),
            "bytes": int(keyed.shapes[new:].nbytes + keyed.curves.nbytes),
            "bytes_as_frames": int(4 * len(keyed.curves) * np.prod(keyed.shapes.shape[1:])),
            "per_frame": {"error": (keyed.errors / unit).tolist(), "worst": (keyed.worst / unit).tolist()},
        }


def compact_keys(
    face: Face, unit: float, frames: FloatArray, settings: BakeSettings, progress: Progress = no_progress
) -> BakedKeys:
    """As few new keys as the settings' tolerance allows, named after the regions of the face that they move.

    Parameters
    ----------
    face : whose points tell the regions; where they do not, the keys are numbered.
    unit : the distance between its eyes.
    frames : (F, V, 3) positions of its vertices.

    Raises
    ------
    RetargetError : as `compact`.
    """
    rest = face.mesh.vertices
    keyed = compact(
        FromNeutral(frames, rest), rest, settings.tolerance * unit, unit, np.random.default_rng(0), progress
    )
    return BakedKeys(_region_names(face, keyed.shapes), keyed, len(keyed.shapes))


def onto_rig(
    face: Face, rig: RigKeys, frames: FloatArray, settings: BakeSettings, progress: Progress = no_progress
) -> BakedKeys:
    """Curves of the keys that are there, and as many new keys for what they leave as the settings ask for.

    Parameters
    ----------
    frames : (F, V, 3) positions of the face's vertices.

    Raises
    ------
    RetargetError : as `fit_to_keys` and `check_rig`.
    """
    check_rig(rig, settings)
    moves = FromNeutral(frames, face.mesh.vertices)
    ranges: list[slice] = []
    if settings.residual:
        ranges = [slice(first, first + settings.residual) for first in range(0, len(moves), settings.residual)]
    new = tuple(f"{_RESIDUAL}{number}" for number in range(1, len(ranges) + 1))
    keyed = fit_to_keys(moves, rig.shapes, rig.low, rig.high, settings.smoothness, settings.sparsity, progress)
    return BakedKeys((*rig.names, *new), residual_keys(moves, keyed, ranges) if ranges else keyed, len(ranges))


def check_rig(rig: RigKeys, settings: BakeSettings) -> None:
    """RetargetError if frames cannot be fitted to a rig: nothing moves, or a key has the name of a residual one."""
    if not rig.shapes.any():
        raise RetargetError(f"none of the rig's {len(rig.names)} shapes moves a vertex, expected some that do")
    taken = sorted(name for name in rig.names if name.startswith(_RESIDUAL)) if settings.residual else []
    if taken:
        raise RetargetError(f"the rig has a shape {taken[0]!r}, expected another name than those of residual keys")


def _region_names(face: Face, shapes: FloatArray) -> tuple[str, ...]:
    points = face.points
    if not gives_axes(points.names):
        return tuple(f"{PREFIX}{number}" for number in range(1, len(shapes) + 1))
    rest = face.mesh.vertices
    places = points.positions(rest)
    left = (rest - places.mean(axis=0)) @ head_axes(points.names, places)[0]
    return tuple(PREFIX + name for name in region_names(shapes, region_weights(face), REGIONS, left))
