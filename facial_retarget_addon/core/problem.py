"""What goes into a method: two faces, and how to work on them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from .arrays import FloatArray
from .gains import Gains
from .mesh import TriMesh
from .parts.kinds import NamedParts
from .points import FeaturePoints
from .raycast import CasterFactory, EmbreeCaster


@dataclass(frozen=True, eq=False)
class Face:
    """A neutral face, its feature points, and the examples that it was given.

    examples : name -> (V, 3) positions of the same vertices.
    named_parts : what the artist calls a part, one of `parts.kinds.NAMED_KINDS` -> vertices (n,), at least one on each
        of its components; other components are told by where they lie.
    """

    mesh: TriMesh
    points: FeaturePoints
    examples: Mapping[str, FloatArray] = field(default_factory=dict)
    named_parts: NamedParts = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Problem:
    """A source face, a target face, and the base mesh if the artist made one.

    base : triangles over point names, counter-clockwise seen from outside; None to have one made.
    gains : how strong the motion is at each place of the target.
    make_caster : makes what casts rays on a mesh: Embree, or Blender's BVHTree where no Embree wheel exists.
    """

    source: Face
    target: Face
    base: tuple[tuple[str, str, str], ...] | None = None
    gains: Gains = field(default_factory=Gains)
    make_caster: CasterFactory = EmbreeCaster
