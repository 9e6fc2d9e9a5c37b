"""A head of which is known what its parts are."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..acting.eyeballs import Eyeball, find_eyeballs
from ..arrays import FloatArray, IntArray
from ..base.regions import eye_separation
from ..mesh import TriMesh
from ..mpeg4.fdps import FDPS
from ..mpeg4.head import gives_axes, head_axes
from ..mpeg4.regions import OWN_PARTS
from ..points import FeaturePoints, common_names
from ..problem import Face
from ..rigid import fit_similarity
from .find import NEEDED, Part, find_parts


@dataclass(frozen=True, eq=False)
class KnownHead:
    """A face, its axes and parts.

    Attributes
    ----------
    mesh : the neutral.
    points : those with MPEG-4 names.
    axes : (3, 3) of the head; the object's own where its points give none.
    eyeballs : by side.
    parts : all of them.
    """

    mesh: TriMesh
    points: FeaturePoints
    axes: FloatArray
    eyeballs: Mapping[str, Eyeball]
    parts: tuple[Part, ...]

    @property
    def shown(self) -> bool:
        """Whether the points show where eyes and mouth are."""
        return set(self.points.names) >= NEEDED

    @cached_property
    def places(self) -> FloatArray:
        """(V, 3) the neutral in the head's axes."""
        places: FloatArray = self.mesh.vertices @ self.axes.T
        return places

    @cached_property
    def skin(self) -> IntArray:
        """(n,) vertices of the components that hold points of the skin."""
        on_skin = self.points.subset([name for name in self.points.names if name not in OWN_PARTS])
        held = self.mesh.components[on_skin.vertices[:, 0]]
        return np.flatnonzero(np.isin(self.mesh.components, held))

    @cached_property
    def unit(self) -> float:
        """Distance of the eyes."""
        return eye_separation(self.mesh, self.points)

    def vertices(self, kinds: Collection[str]) -> IntArray:
        """(n,) vertices of the parts of these kinds, in order."""
        found = [part.vertices for part in self.parts if part.kind in kinds]
        return np.sort(np.concatenate([np.empty(0, np.int64), *found]))


def know_head(face: Face) -> KnownHead:
    """Find out what the parts of a face are; without `NEEDED` points nothing is known but what is named."""
    known = face.points.subset([name for name in face.points.names if name in FDPS])
    axes = np.eye(3)
    if gives_axes(known.names):
        axes = head_axes(known.names, known.positions(face.mesh.vertices))
    eyeballs = find_eyeballs(face.mesh, known, axes, face.named_parts)
    parts = find_parts(face.mesh, known, axes, eyeballs, face.named_parts)
    return KnownHead(face.mesh, known, axes, eyeballs, parts)


def scale_between(source: KnownHead, target: KnownHead) -> float:
    """Target units per source unit, by the points that both skins have: as the methods scale the skin's motion."""
    names = [name for name in common_names(source.points, target.points) if name not in OWN_PARTS]
    ours, theirs = (head.points.subset(names).positions(head.places) for head in (source, target))
    return fit_similarity(ours, theirs).scale
