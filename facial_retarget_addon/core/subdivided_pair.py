"""Two faces that share their topology and are subdivided already: nothing is matched, nothing pierced."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
import scipy.sparse as sp

from .arrays import BoolArray, FloatArray, IntArray
from .base.base_mesh import BaseMesh
from .base.regions import eye_separation
from .binding import Binding
from .levels.normal_mesh import NormalLevel, NormalMesh
from .levels.recognition import Recognised, recognise
from .levels.subdivision import Scheme
from .matching.correspondence import Correspondence
from .mesh import TriMesh
from .pair import Pair
from .points import FeaturePoints, common_names, place_matrix
from .problem import Face, Problem
from .rigid import fit_similarity


class SubdividedPair(Pair):
    """A pair whose finest level is the artist's own mesh: vertex i of one face is vertex i of the other."""

    @cached_property
    def fine_carry(self) -> sp.csr_matrix:
        """(N, Vs) takes source displacements to the finest level."""
        finest = self.source_normal.levels[-1]
        return place_matrix(self.source.faces[finest.place_face], finest.place_weights, len(self.source.vertices))

    @cached_property
    def binding(self) -> Binding:
        """The target's vertices on its finest level: each is one of its vertices."""
        places = self.fine_places
        count = len(self.target.vertices)
        inside = np.asarray(places.sum(axis=0)).ravel()
        offset = np.zeros((count, 3), np.float32)
        corners = np.zeros((count, 3), np.int64)
        neutral = self.finest.positions.astype(np.float32)
        return Binding(places.T.tocsr().astype(np.float32), corners, offset, inside, neutral)

    def report(self) -> dict[str, Any]:
        """As `Pair.report`, and how often the faces had been subdivided."""
        return {**super().report(), "subdivided": len(self.steps)}


def subdivided_pair(problem: Problem, levels: int, scheme: Scheme) -> Pair | None:
    """The pair of two faces whose skins have the same faces and come from one base by subdivision; else None.

    None, too, where the artist made a base or the faces have no point in common.

    Parameters
    ----------
    levels : at most so many are undone.
    scheme : of the steps.
    """
    common = common_names(problem.source.points, problem.target.points)
    if problem.base is not None or not common:
        return None
    source, target = problem.source.mesh, problem.target.mesh
    on_source, on_target = (_skin(face) for face in (problem.source, problem.target))
    faces = source.faces[on_source[source.faces[:, 0]]]
    if not np.array_equal(faces, target.faces[on_target[target.faces[:, 0]]]):
        return None
    found = recognise(faces, len(source.vertices), levels, scheme)
    if found is None:
        return None
    base_vertices = found.order[: found.base_count]
    names = tuple(f"vertex {vertex}" for vertex in base_vertices)
    points = FeaturePoints(names, np.repeat(base_vertices[:, None], 3, axis=1), np.tile([1.0, 0, 0], (len(names), 1)))
    separations = [eye_separation(face.mesh, face.points.subset(common)) for face in (problem.source, problem.target)]
    return SubdividedPair(
        source,
        target,
        points,
        points,
        BaseMesh(names, found.base_faces, (), (), ()),
        _same_vertices(source, target, on_target),
        fit_similarity(source.vertices[found.order], target.vertices[found.order]),
        separations[0],
        separations[1],
        found.steps,
        _levels(source, found),
        _levels(target, found),
        problem.make_caster,
    )


def _skin(face: Face) -> BoolArray:
    """(V,) vertices of the component that holds most points."""
    labels = face.mesh.components
    held = np.bincount(labels[face.points.holders])
    skin: BoolArray = labels == held.argmax()
    return skin


def _places(mesh: TriMesh, vertices: IntArray) -> tuple[IntArray, FloatArray]:
    """A face that holds each vertex (N,), and the weights (N, 3) that put it there."""
    holder = np.zeros(len(mesh.vertices), np.int64)
    holder[mesh.faces.ravel()] = np.repeat(np.arange(len(mesh.faces)), 3)
    face = holder[vertices]
    return face, (mesh.faces[face] == vertices[:, None]).astype(np.float64)


def _same_vertices(source: TriMesh, target: TriMesh, skin: BoolArray) -> Correspondence:
    """Each vertex of the skin corresponds to the source's vertex of the same number."""
    vertices = np.flatnonzero(skin)
    count = len(target.vertices)
    face, weights = np.full(count, -1, np.int64), np.zeros((count, 3))
    face[vertices], weights[vertices] = _places(source, vertices)
    warped = target.vertices.copy()
    warped[vertices] = source.vertices[vertices]
    labels = target.components
    still = tuple(np.flatnonzero(labels == k) for k in np.unique(labels[~skin]))
    own = sp.diags(skin.astype(np.float64)).tocsr()
    return Correspondence(face, weights, skin.astype(np.float64), warped, still, own)


def _levels(mesh: TriMesh, found: Recognised) -> NormalMesh:
    """The mesh's own vertices as the levels of a normal mesh on which nothing was pierced."""
    levels = []
    for step in found.steps:
        vertices = found.order[: step.vertex_count]
        count = len(vertices)
        nothing = np.zeros(0, np.int64)
        face, weights = _places(mesh, vertices)
        levels.append(
            NormalLevel(
                positions=mesh.vertices[vertices],
                faces=step.faces,
                offsets=np.zeros(count),
                boundary=nothing,
                displacement=np.zeros((0, 3)),
                spread=sp.csr_matrix((count, 0)),
                second_looks=(),
                failed=np.zeros(count, bool),
                fill=sp.csr_matrix((0, count)),
                correction=np.zeros((0, 3)),
                place_face=face,
                place_weights=weights,
            )
        )
    return NormalMesh(mesh.vertices[found.order[: found.base_count]], found.steps, tuple(levels))
