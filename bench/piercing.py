"""Piercing queries: Embree against a pruned Python loop over Blender's BVHTree, the same rays."""

from __future__ import annotations

from collections.abc import Iterator

import bpy  # noqa: F401  (brings mathutils)
import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree

from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.pair import prepare_pair
from facial_retarget_addon.core.raycast import EmbreeCaster

from .faces import problem
from .timing import Row, medians


def rows() -> Iterator[Row]:
    """Seconds for both directions of every vertex of level 4, and their ratio."""
    pair = prepare_pair(problem(), levels=4, base_points=105)
    mesh = pair.source
    normal = pair.source_normal
    predicted = normal.steps[-1].matrix @ normal.levels[-2].positions
    level = TriMesh(predicted, normal.steps[-1].faces)
    origins, directions = level.vertices, level.vertex_normals
    limit = 2.5 * level.vertex_edge_length
    caster = EmbreeCaster(mesh)
    tree = BVHTree.FromPolygons(mesh.vertices.tolist(), mesh.faces.tolist(), all_triangles=True)
    # Blender's vectors are made beforehand: the loop is timed, not the conversion.
    vectors = [(Vector(o), Vector(d)) for o, d in zip(origins.tolist(), directions.tolist(), strict=True)]
    reach = limit.tolist()

    def embree() -> None:
        caster.nearest(origins, directions, limit)
        caster.nearest(origins, -directions, limit)

    def loop() -> None:
        for (origin, direction), far in zip(vectors, reach, strict=True):
            hit = tree.ray_cast(origin, direction, far)[3]
            tree.ray_cast(origin, -direction, far if hit is None else hit)

    times = medians({"embree": embree, "loop": loop})
    yield Row("rays", 2 * len(origins), "")
    yield Row("Embree", 1e3 * times["embree"], "ms")
    yield Row("BVHTree loop", 1e3 * times["loop"], "ms")
    yield Row("Embree is faster by", times["loop"] / times["embree"], "x", 3.0, at_least=True)
    found = caster.nearest(origins, directions, limit).distance
    other = [tree.ray_cast(origin, direction, far)[3] for (origin, direction), far in zip(vectors, reach, strict=True)]
    ours, theirs = np.isfinite(found), np.array([hit is not None for hit in other])
    yield Row("rays on which the two disagree", 100 * float((ours != theirs).mean()), "%", 0.1)
