"""The light and the fine mesh with a shape key at full strength: out of a retargeting, or of keys that both have."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple, Protocol

import numpy as np

from ..arrays import FloatArray
from ..shapes.combinations import Corrective, combined, complete
from ..shapes.shape_set import ShapeSet


class Pose(NamedTuple):
    """Positions of the light mesh (V, 3) and of the fine one (N, 3), in the same space."""

    light: FloatArray
    fine: FloatArray


class KeyPoses(NamedTuple):
    """A shape key at full strength, and what it is seen against: the neutral, or the keys that it corrects."""

    pose: Pose
    start: Pose


class Posed(Protocol):
    """What poses both meshes by a frame of the source: `FrameMaps`."""

    def pose(self, source: FloatArray) -> Pose:
        """Both meshes of a source frame (Vs, 3)."""
        ...


class KeysPosed(NamedTuple):
    """The neutral, and what gives the poses of each key: they are made anew each time, a set of them is large."""

    neutral: Pose
    keys: Mapping[str, Callable[[], KeyPoses]]


def retargeted_poses(
    posed: Posed, source: FloatArray, shapes: ShapeSet, names: Sequence[str], correctives: Sequence[Corrective] = ()
) -> KeysPosed:
    """Poses of shapes of the source, retargeted.

    A corrective goes over together with the shapes that it needs, and is seen against these.

    Parameters
    ----------
    source : (Vs, 3) the source's neutral. shapes : of the source, with all that the correctives need.
    names : of the shapes that get poses.
    """
    rest = source.astype(np.float32)
    whole = complete(correctives, shapes.names)
    needs = {one.name: one.needs for one in whole}
    seen = ShapeSet(shapes.names, combined(shapes, whole))
    neutral = posed.pose(rest)

    def poses(name: str) -> KeyPoses:
        start = neutral
        if name in needs:
            start = posed.pose(rest + shapes.displacements[shapes.rows(needs[name])].sum(axis=0))
        return KeyPoses(posed.pose(rest + seen[name]), start)

    return KeysPosed(neutral, {name: _bound(poses, name) for name in names})


def sculpted_poses(neutral: Pose, light: ShapeSet, fine: ShapeSet) -> KeysPosed:
    """Poses of the keys that both meshes have, by their names."""

    def poses(name: str) -> KeyPoses:
        return KeyPoses(Pose(neutral.light + light[name], neutral.fine + fine[name]), neutral)

    return KeysPosed(neutral, {name: _bound(poses, name) for name in light.names if name in fine.names})


def _bound(poses: Callable[[str], KeyPoses], name: str) -> Callable[[], KeyPoses]:
    return lambda: poses(name)
