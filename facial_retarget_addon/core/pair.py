"""Two faces on one base: what every multiresolution method starts from."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import scipy.sparse as sp

from .arrays import FloatArray, IntArray, Progress, no_progress, unit_vectors
from .base.base_mesh import BaseMesh, base_mesh
from .base.refinement import inside_base, refine_base
from .base.regions import eye_separation
from .binding import Binding, bind
from .carry import LinearMotion, local_turns
from .levels.normal_mesh import NormalLevel, NormalMesh, build_normal_mesh
from .levels.subdivision import Level, Scheme, hierarchy, loop
from .matching.correspondence import Correspondence, correspond, places_on_source
from .mesh import TriMesh
from .mpeg4.regions import OWN_PARTS
from .points import FeaturePoints, common_names, place_matrix
from .problem import Problem
from .raycast import CasterFactory
from .rigid import Similarity, fit_similarity
from .source_reader import SourceReader
from .steering.learned import SteeringBase

_REACH = 0.5
"""Eye separations beyond the base's border over which its own motion fades into the carried one."""

_AGREEMENT = 0.3
"""Normals of matched places whose dot product is below this say nothing about how the surface turns."""


@dataclass(frozen=True, eq=False)
class Pair:
    """Two faces, their correspondence, and their normal meshes over one base.

    Attributes
    ----------
    source_points, target_points : the base's points, in the base's order.
    similarity : source to target.
    source_separation, target_separation : distance of the eyes, in each face's units.
    steps : subdivision steps of the base, one per level.
    """

    source: TriMesh
    target: TriMesh
    source_points: FeaturePoints
    target_points: FeaturePoints
    base: BaseMesh
    correspondence: Correspondence
    similarity: Similarity
    source_separation: float
    target_separation: float
    steps: Sequence[Level]
    source_normal: NormalMesh
    target_normal: NormalMesh
    make_caster: CasterFactory

    @property
    def source_base(self) -> FloatArray:
        """(B, 3) neutral base vertices of the source."""
        return self.source_normal.base

    @property
    def target_base(self) -> FloatArray:
        """(B, 3) neutral base vertices of the target."""
        return self.target_normal.base

    @property
    def finest(self) -> NormalLevel:
        """The target's finest level."""
        return self.target_normal.levels[-1]

    @cached_property
    def carry(self) -> sp.csr_matrix:
        """(Vt, Vs) takes source displacements to the target's vertices."""
        return self.correspondence.matrix(self.source.faces, len(self.source.vertices))

    @cached_property
    def fine_places(self) -> sp.csr_matrix:
        """(N, Vt) takes values of the target's vertices to the places of its finest level."""
        corners = self.target.faces[self.finest.place_face]
        return place_matrix(corners, self.finest.place_weights, len(self.target.vertices))

    @cached_property
    def fine_carry(self) -> sp.csr_matrix:
        """(N, Vs) takes source displacements to the target's finest level, each vertex at its own counterpart."""
        corners, weights = places_on_source(
            self.correspondence,
            self.source,
            self.target,
            self.target.faces[self.finest.place_face],
            self.finest.place_weights,
        )
        return place_matrix(corners, weights, len(self.source.vertices))

    @cached_property
    def binding(self) -> Binding:
        """The target's vertices riding on its finest level."""
        carrier = TriMesh(self.finest.positions, self.finest.faces)
        return bind(self.target, self.correspondence.face >= 0, carrier, _REACH * self.target_separation)

    @cached_property
    def counterpart(self) -> IntArray:
        """(Vt,) nearest source vertex of each target vertex's counterpart, -1 for none."""
        found = self.correspondence
        corner = self.source.faces[found.face][np.arange(len(found.face)), found.weights.argmax(axis=1)]
        return np.where((found.face >= 0) & (found.confidence > 0), corner, -1)

    @cached_property
    def steering_base(self) -> SteeringBase:
        """Where examples are told apart."""
        points, separations = (self.source_points, self.target_points), (self.source_separation, self.target_separation)
        return SteeringBase(self.source, self.target, *points, *separations)

    def linear_motion(self, matrix: sp.csr_matrix, places: FloatArray, local: bool) -> LinearMotion:
        """Motion of target places (V, 3) that a matrix (V, Vs) takes from the source.

        local : turn with the surface around each place, not with the heads as a whole.
        """
        return LinearMotion(matrix, self.source.vertices, self.similarity, self.turns(places) if local else None)

    def turns(self, places: FloatArray) -> FloatArray:
        """(V, 3, 3) rotations of the motion at places (V, 3) of the target."""
        rotation = self.similarity.rotation
        before = unit_vectors(self.carry @ self.source.vertex_normals) @ rotation.T
        after = self.target.vertex_normals
        agree = np.einsum("vi,vi->v", before, after) > _AGREEMENT
        trust = self.target.vertex_areas * (agree & (self.correspondence.confidence > 0.5))
        turns = local_turns(
            before, after, self.target.vertices, trust, self.target_base, self.target_separation, places
        )
        return turns @ rotation

    def reader(self, pierce: bool) -> SourceReader:
        """Reads the source's frames; `pierce` pierces every one anew."""
        return SourceReader(
            self.source,
            self.source_points,
            self.base.loops,
            self.steps,
            self.source_normal,
            pierce,
            self.make_caster,
        )

    def report(self) -> dict[str, Any]:
        """Figures of the fit, as plain data."""
        areas = self.target.vertex_areas
        covered = inside_base(self.base, self.target, self.target_points)
        levels = [
            {
                "level": level + 1,
                "vertices": len(ours.positions),
                "source_piercing_errors": ours.piercing_errors,
                "target_piercing_errors": theirs.piercing_errors,
            }
            for level, (ours, theirs) in enumerate(
                zip(self.source_normal.levels, self.target_normal.levels, strict=True)
            )
        ]
        return {
            "source": {"vertices": len(self.source.vertices), "faces": len(self.source.faces)},
            "target": {"vertices": len(self.target.vertices), "faces": len(self.target.faces)},
            "scale": self.similarity.scale,
            "base": {
                "points": len(self.base.names),
                "triangles": len(self.base.faces),
                "points_outside": list(self.base.left_out),
            },
            "coverage": float(areas @ covered / areas.sum()),
            "matched": float(areas @ (self.correspondence.confidence > 0) / areas.sum()),
            "levels": levels,
            "warnings": list(self.base.warnings),
        }


def prepare_pair(
    problem: Problem,
    levels: int,
    base_points: int,
    progress: Progress = no_progress,
    scheme: Scheme = loop,
) -> Pair:
    """Correspondence, base mesh and normal meshes of two faces.

    Parameters
    ----------
    levels : of the normal meshes.
    base_points : wanted in the base; what the given points lack is added between them.
    scheme : subdivision that predicts each level.

    Raises
    ------
    RetargetError : if the points do not span a base mesh; names what to change.
    """
    source, target = problem.source.mesh, problem.target.mesh
    common = common_names(problem.source.points, problem.target.points)
    names = [name for name in common if name not in OWN_PARTS]
    on_source, on_target = problem.source.points.subset(names), problem.target.points.subset(names)
    found = correspond(source, on_source, target, on_target, lambda share, what: progress(0.5 * share, what))
    similarity = fit_similarity(on_source.positions(source.vertices), on_target.positions(target.vertices))
    separations = eye_separation(source, on_source), eye_separation(target, on_target)
    progress(0.5, "making the base mesh")
    base = base_mesh(source, on_source, target, on_target, problem.base, problem.make_caster)
    base, on_source, on_target = refine_base(base, source, on_source, target, on_target, found, base_points)
    steps = hierarchy(base.faces, len(base.names), levels, scheme)
    progress(0.7, "piercing both faces")
    with ThreadPoolExecutor(2) as both:
        source_normal, target_normal = both.map(
            lambda mesh, points: build_normal_mesh(mesh, points, base.loops, steps, problem.make_caster),
            (source, target),
            (on_source, on_target),
        )
    return Pair(
        source,
        target,
        on_source,
        on_target,
        base,
        found,
        similarity,
        *separations,
        steps,
        source_normal,
        target_normal,
        problem.make_caster,
    )
