"""A surface bent onto another one, smoothly, with some of its places given."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from scipy.spatial import cKDTree

from ..arrays import FloatArray, IntArray
from ..closest_point import SurfaceFinder
from ..mesh import TriMesh
from .control_nodes import control_nodes, spread_nodes

_NODES = 400
_SAMPLES = 800
_STIFFNESS = (10.0, 3.0, 1.0, 0.3, 0.1)
"""Weight of the bending against the samples, pass by pass: the surface comes stiff and softens."""
_POINT_WEIGHT = 2.0
"""Weight of one given place against one sample: artists place points to a few per cent of the eye separation."""
_DOUBT = 5.0
"""A sample this many times farther away than the median counts half."""
_AGREEMENT = 0.3
_REACH = 0.3


def fit_surface(
    mesh: TriMesh,
    active: IntArray,
    points: sp.csr_matrix,
    images: FloatArray,
    finder: SurfaceFinder,
    extent: float,
    lean: FloatArray,
) -> FloatArray:
    """Positions (V, 3) of a mesh bent onto a surface.

    The displacement follows a few hundred nodes. Its bending energy counts against the distance of sample vertices
    to their closest places with agreeing normals, found anew in each pass, and against the given places.

    Parameters
    ----------
    mesh : the surface to bend, already near to the other one.
    active : vertices to sample: those of the component that holds the points.
    points : (P, V) matrix that takes vertex values to the points.
    images : (P, 3) where the points belong.
    finder : finds places on the other surface.
    extent : size of the region that holds the points; places farther away than 0.3 of it are not followed.
    lean : (V, 3) next to nothing: decides what is as near to one side as to the other.

    References
    ----------
    After Amberg, Romdhani and Vetter 2007 (optimal-step non-rigid ICP: a stiffness that falls) and Sumner, Schmid
    and Pauly 2007 (few nodes carry many vertices).
    """
    near = cKDTree(images).query(mesh.vertices[active], k=min(3, len(images)))[0]
    spacing = np.full(len(mesh.vertices), 0.5 * extent)
    spacing[active] = np.clip(near.reshape(len(active), -1)[:, -1], 0.08 * extent, 0.5 * extent)
    first = np.asarray(points.argmax(axis=1), np.int64).ravel()
    leaning = mesh.with_vertices(mesh.vertices + lean)
    samples = spread_nodes(leaning, spacing, active, first, _SAMPLES)
    nodes = control_nodes(mesh, samples[:_NODES], leaning.graph)
    bending = (nodes.bending.T @ nodes.bending).toarray() * (len(samples) / len(nodes.vertices))
    held = (points @ nodes.weights).toarray()
    given = _POINT_WEIGHT * held.T
    goal = images - points @ mesh.vertices
    follow = nodes.weights[samples].toarray()
    start = mesh.vertices[samples]
    ridge = 1e-8 * np.eye(len(nodes.vertices))
    position = mesh.vertices
    for stiffness in _STIFFNESS:
        normals = mesh.with_vertices(position).vertex_normals[samples]
        near = finder.closest((position + lean)[samples], normals, _AGREEMENT, _REACH * extent)
        found = finder.on_faces(position[samples], near.face)
        hit = found.face >= 0
        typical = max(float(np.median(found.distance[hit])) if hit.any() else 0.0, 1e-3 * extent)
        trust = np.zeros(len(samples))
        trust[hit] = 1 / (1 + (found.distance[hit] / (_DOUBT * typical)) ** 2)
        pull = (follow * trust[:, None]).T
        wanted = np.where(hit[:, None], found.point - start, 0.0)
        system = stiffness * bending + pull @ follow + given @ held + ridge
        position = mesh.vertices + nodes.weights @ np.linalg.solve(system, pull @ wanted + given @ goal)
    return position
