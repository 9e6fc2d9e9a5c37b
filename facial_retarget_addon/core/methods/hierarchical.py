"""Hierarchical retargeting (Na and Jung 2004), on a base mesh spanned by feature points.

The plain carry takes the source's motion at the counterpart of each target vertex through the
similarity of the two heads; on the normal mesh it splits into levels, each with its strength. The
examples then steer it. `variant = "paper"` is the published method instead.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray, IntArray, Progress, no_progress, unit_vectors
from ..base_mesh import BaseMesh, base_mesh
from ..base_refinement import refine_base
from ..base_regions import eye_separation
from ..binding import Binding, apply_matrix, bind
from ..carry import BlendedMotion, LinearMotion, Motion, PiercedMotion, local_turns
from ..correspondence import Correspondence, correspond, places_on_source
from ..errors import RetargetError
from ..example_residuals import ExamplePairs, ExampleResiduals, fit_example_residuals, leave_one_out
from ..level_gains import scale_levels
from ..mesh import TriMesh
from ..normal_mesh import NormalLevel, NormalMesh, build_normal_mesh
from ..paper_motion import PaperMotion
from ..points import FeaturePoints, common_names, place_matrix
from ..raycast import CasterFactory
from ..rbf import MultiquadricMaps, fit_multiquadrics
from ..rigid import Similarity, fit_similarity
from ..source_reader import SourceReader
from ..subdivision import Level, hierarchy
from .base import Problem
from .settings import HierarchicalSettings

_REACH = 0.5
"""Eye separations beyond the base's border over which its own motion fades into the carried one."""
_STILL = 1e-6
"""Eye separations: an example whose base moves less is the neutral."""
_MERGE = 1e-3
"""Eye separations: the paper's multiquadric centres closer than this are one."""


class Example(NamedTuple):
    """An example's displacements: source (Vs, 3), target (Vt, 3)."""

    name: str
    source: FloatArray
    target: FloatArray


@dataclass(frozen=True, eq=False)
class Pair:
    """Two faces on one base: what every variant of the method starts from.

    Attributes
    ----------
    source_points, target_points : the base's points, in the base's order.
    source_separation, target_separation : distance of the eyes, in each face's units.
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
    steps: list[Level]
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


@dataclass(frozen=True, eq=False)
class HierarchicalRetargeter:
    """A fitted pair of faces.

    Attributes
    ----------
    report : figures of the fit, as plain data.
    counterpart : (Vt,) nearest source vertex of each target vertex's counterpart, -1 for none.
    """

    report: Mapping[str, Any]
    counterpart: IntArray
    _target: FloatArray
    _source: FloatArray
    _motion: Motion
    _fine_motion: Motion
    _finest: NormalLevel
    _base: sp.csr_matrix
    _residuals: ExampleResiduals | None

    def frames(self, source: FloatArray) -> FloatArray:
        """Target positions (F, Vt, 3) float32 of source frames (F, Vs, 3)."""
        frames = self._checked(source)
        moved = self._motion(frames)
        if self._residuals is not None:
            moved = self._residuals.steer(moved, apply_matrix(self._base, frames - self._source))
        moved += self._target
        return moved

    def detail(self, source: FloatArray) -> tuple[FloatArray, IntArray]:
        """The finest normal mesh of source frames (F, Vs, 3): positions (F, N, 3) float32, faces (M, 3)."""
        fine = self._fine_motion(self._checked(source))
        fine += self._finest.positions.astype(np.float32)
        return fine, self._finest.faces

    def _checked(self, source: FloatArray) -> FloatArray:
        if source.ndim != 3 or source.shape[1:] != self._source.shape:
            raise RetargetError(f"source frames have shape {source.shape}, expected (F, {len(self._source)}, 3)")
        return np.asarray(source, np.float32)


def fit(problem: Problem, settings: HierarchicalSettings, progress: Progress = no_progress) -> HierarchicalRetargeter:
    """Fit the hierarchical method to a pair of faces.

    Raises
    ------
    RetargetError : if the points do not span a base mesh, or the examples do not fit the faces; names what to change.

    References
    ----------
    Na and Jung 2004, sections 3 and 4.
    """
    pair = prepare_pair(problem, settings, progress)
    examples = read_examples(problem, pair)
    progress(0.8, "preparing the motion")
    binding = bind(
        pair.target,
        pair.correspondence.face >= 0,
        TriMesh(pair.finest.positions, pair.finest.faces),
        _REACH * pair.target_separation,
    )
    if settings.variant == "paper":
        motion, fine_motion, figures = _paper(pair, settings, binding, examples)
        residuals = None
    else:
        motion, fine_motion = _plain(pair, settings, binding)
        residuals, figures = _steering(pair, examples, motion, settings.example_strength)
    progress(1.0, "fitted")
    return HierarchicalRetargeter(
        {**_report(pair, binding), "examples": figures},
        _counterpart(pair),
        pair.target.vertices.astype(np.float32),
        pair.source.vertices.astype(np.float32),
        motion,
        fine_motion,
        pair.finest,
        pair.source_points.matrix(len(pair.source.vertices)).astype(np.float32),
        residuals,
    )


def prepare_pair(problem: Problem, settings: HierarchicalSettings, progress: Progress = no_progress) -> Pair:
    """Correspondence, base mesh and normal meshes of two faces."""
    source, target = problem.source.mesh, problem.target.mesh
    names = common_names(problem.source.points, problem.target.points)
    on_source, on_target = problem.source.points.subset(names), problem.target.points.subset(names)
    found = correspond(source, on_source, target, on_target, lambda share, what: progress(0.4 * share, what))
    similarity = fit_similarity(on_source.positions(source.vertices), on_target.positions(target.vertices))
    separations = eye_separation(source, on_source), eye_separation(target, on_target)
    progress(0.4, "making the base mesh")
    base = base_mesh(source, on_source, target, on_target, problem.base, problem.make_caster)
    base, on_source, on_target = refine_base(base, source, on_source, target, on_target, found, settings.base_points)
    steps = hierarchy(base.faces, len(base.names), settings.levels)
    progress(0.5, "piercing the source")
    source_normal = build_normal_mesh(source, on_source, base.loops, steps, problem.make_caster)
    progress(0.65, "piercing the target")
    target_normal = build_normal_mesh(target, on_target, base.loops, steps, problem.make_caster)
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


def read_examples(problem: Problem, pair: Pair) -> list[Example]:
    """The problem's examples as displacements, without those that are the neutral on both faces.

    Raises
    ------
    RetargetError : for an example on one face only, of another vertex count, or that moves the target alone.
    """
    here, there = problem.source.examples, problem.target.examples
    found = []
    for name in [*here, *(name for name in there if name not in here)]:
        if name not in here or name not in there:
            missing = "source" if name not in here else "target"
            raise RetargetError(f"example {name!r} is missing on the {missing}, expected one on each face")
        for which, positions, mesh in (("source", here[name], pair.source), ("target", there[name], pair.target)):
            if np.shape(positions) != mesh.vertices.shape:
                raise RetargetError(
                    f"example {name!r} of the {which} has shape {np.shape(positions)}, "
                    f"expected {mesh.vertices.shape} like its neutral"
                )
        example = Example(name, here[name] - pair.source.vertices, there[name] - pair.target.vertices)
        base_motion = np.abs(pair.source_points.positions(example.source)).max(initial=0.0)
        if base_motion > _STILL * pair.source_separation:
            found.append(example)
        elif np.abs(example.target).max(initial=0.0) > _STILL * pair.target_separation:
            raise RetargetError(
                f"example {name!r} moves the target but not the source's feature points, expected motion on both"
            )
    return found


# ---- the default variant ------------------------------------------------------------------------


def _plain(pair: Pair, settings: HierarchicalSettings, binding: Binding) -> tuple[Motion, Motion]:
    """Motion of the target's vertices and of its finest level."""
    matrix = pair.correspondence.matrix(pair.source.faces, len(pair.source.vertices))
    corners, weights = places_on_source(
        pair.correspondence,
        pair.source,
        pair.target,
        pair.target.faces[pair.finest.place_face],
        pair.finest.place_weights,
    )
    fine = place_matrix(corners, weights, len(pair.source.vertices))
    gains = [settings.gain(level) for level in range(settings.levels + 1)]
    scaled = scale_levels(matrix, fine, binding.matrix, binding.inside, pair.steps, gains, settings.detail_scale)
    rest = pair.source.vertices
    turns, fine_turns = None, None
    if settings.frames == "local":
        turns, fine_turns = _local_turns(pair, pair.target.vertices), _local_turns(pair, pair.finest.positions)
    motion: Motion = LinearMotion(scaled, rest, pair.similarity, turns)
    fine_motion: Motion = LinearMotion(fine, rest, pair.similarity, fine_turns)
    if settings.read == "pierce":
        reader = SourceReader(
            pair.source, pair.source_points, pair.base.loops, pair.steps, pair.source_normal, True, pair.make_caster
        )
        fine_motion = PiercedMotion(reader, pair.source_normal, gains, pair.similarity, fine_turns)
        motion = BlendedMotion(fine_motion, binding, motion)
    return motion, fine_motion


def _local_turns(pair: Pair, places: FloatArray) -> FloatArray:
    """(V, 3, 3) rotations of the motion at places of the target."""
    before = unit_vectors(pair.source_points.positions(pair.source.vertex_normals))
    after = unit_vectors(pair.target_points.positions(pair.target.vertex_normals))
    return local_turns(before, after, pair.target_base, pair.target_separation, places, pair.similarity.rotation)


def _steering(
    pair: Pair, examples: list[Example], motion: Motion, trust: float
) -> tuple[ExampleResiduals | None, list[dict[str, Any]]]:
    """What the examples add to a motion, and how well they are met."""
    if not examples or trust == 0:
        return None, []
    source = np.stack([example.source for example in examples])
    base = np.stack([pair.source_points.positions(displacement) for displacement in source])
    carried = motion((pair.source.vertices + source).astype(np.float32))
    pairs = ExamplePairs(base, carried, np.stack([example.target for example in examples]))
    face = (
        pair.source_base,
        pair.source_separation,
        pair.target_base,
        pair.target.vertices,
        pair.target.vertex_areas,
        pair.target_separation,
        trust,
    )
    residuals = fit_example_residuals(pairs, *face)
    figures = []
    for m, example in enumerate(examples):
        met = residuals.steer(carried[m : m + 1], base[m : m + 1])[0]
        figure = {"name": example.name, "fit": _relative_error(pair, met, example.target)}
        if len(examples) > 1:
            figure["leave_one_out"] = _relative_error(pair, leave_one_out(pairs, m, *face), example.target)
        figures.append(figure)
    return residuals, figures


# ---- the published variant ----------------------------------------------------------------------


def _paper(
    pair: Pair, settings: HierarchicalSettings, binding: Binding, examples: list[Example]
) -> tuple[Motion, Motion, list[dict[str, Any]]]:
    """Motion of the target's vertices and of its finest level, and how well the examples are met."""
    reader = SourceReader(
        pair.source,
        pair.source_points,
        pair.base.loops,
        pair.steps,
        pair.source_normal,
        settings.read == "pierce",
        pair.make_caster,
    )
    gains = [settings.gain(level) for level in range(settings.levels + 1)]
    paper = PaperMotion(reader, _base_maps(pair, examples), pair.source_normal, pair.target_normal, gains)
    matrix = pair.correspondence.matrix(pair.source.faces, len(pair.source.vertices))
    beyond = LinearMotion(matrix, pair.source.vertices, pair.similarity)
    motion = BlendedMotion(paper, binding, beyond)
    figures = []
    for example in examples:
        moved = motion((pair.source.vertices + example.source).astype(np.float32)[None])[0]
        figures.append({"name": example.name, "fit": _relative_error(pair, moved, example.target)})
    return motion, paper, figures


def _base_maps(pair: Pair, examples: list[Example]) -> MultiquadricMaps:
    """Equations (3) and (4) for every base vertex, with neutral among the centres."""
    still = (np.zeros_like(pair.source_base), np.zeros_like(pair.target_base))
    centres, values = [still[0]], [still[1]]
    for example in examples:
        centres.append(pair.source_points.positions(example.source))
        # The maps work in the source's orientation, as the similarity turns the rest of the motion.
        values.append(pair.target_points.positions(example.target) @ pair.similarity.rotation)
    maps = fit_multiquadrics(
        np.stack(centres, axis=1),
        np.stack(values, axis=1),
        _MERGE * pair.source_separation,
        pair.similarity.scale,
        linear=False,
    )
    return maps.turned(pair.similarity.rotation)


# ---- figures ------------------------------------------------------------------------------------


def _relative_error(pair: Pair, moved: FloatArray, wanted: FloatArray) -> float:
    """Norm of the error over the norm of the wanted motion, weighted by area."""
    areas = pair.target.vertex_areas
    error, size = (float(areas @ np.square(values).sum(axis=1)) for values in (moved - wanted, wanted))
    return float(np.sqrt(error / size)) if size > 0 else 0.0


def _counterpart(pair: Pair) -> IntArray:
    found = pair.correspondence
    corner = pair.source.faces[found.face][np.arange(len(found.face)), found.weights.argmax(axis=1)]
    return np.where((found.face >= 0) & (found.confidence > 0), corner, -1)


def _report(pair: Pair, binding: Binding) -> dict[str, Any]:
    """Figures of the fit, as plain data."""
    areas = pair.target.vertex_areas
    levels = [
        {
            "level": level + 1,
            "vertices": len(ours.positions),
            "source_piercing_errors": ours.piercing_errors,
            "target_piercing_errors": theirs.piercing_errors,
        }
        for level, (ours, theirs) in enumerate(zip(pair.source_normal.levels, pair.target_normal.levels, strict=True))
    ]
    still = [
        {"vertices": len(component), "first_vertex": int(component[0])}
        for component in pair.correspondence.still_components
    ]
    warnings = list(pair.base.warnings)
    if still:
        total = sum(part["vertices"] for part in still)
        warnings.append(f"{len(still)} parts of the target ({total} vertices) hold no feature point and stay put")
    return {
        "source": {"vertices": len(pair.source.vertices), "faces": len(pair.source.faces)},
        "target": {"vertices": len(pair.target.vertices), "faces": len(pair.target.faces)},
        "scale": pair.similarity.scale,
        "base": {
            "points": len(pair.base.names),
            "triangles": len(pair.base.faces),
            "points_outside": list(pair.base.left_out),
        },
        "coverage": float(areas @ (binding.inside >= 1) / areas.sum()),
        "matched": float(areas @ (pair.correspondence.confidence > 0) / areas.sum()),
        "levels": levels,
        "still_components": still,
        "warnings": warnings,
    }
