"""Blender's own rays hit what Embree's hit: the extension works where Embree has no wheel."""

import numpy as np
from stage import enable, part

enable()
BVHCaster, raycast = part("bridge.raycast").BVHCaster, part("core.raycast")
mesh = part("demo").targets()[1].face.mesh
rng = np.random.default_rng(5)
faces = rng.choice(len(mesh.faces), 4000)
aims = np.einsum("nk,nkc->nc", rng.dirichlet(np.ones(3), len(faces)), mesh.vertices[mesh.faces[faces]])
directions = rng.normal(size=aims.shape)
directions /= np.linalg.norm(directions, axis=1, keepdims=True)
origins = aims - 0.1 * mesh.size * directions
directions[::2] *= -1  # every other ray flies away from its aim
ours, embree = BVHCaster(mesh), raycast.EmbreeCaster(mesh)

for limit in (np.inf, 0.05 * mesh.size, np.linspace(0.0, 0.3, len(faces)) * mesh.size):
    hits, expected = ours.nearest(origins, directions, limit), embree.nearest(origins, directions, limit)
    # A ray through an edge may be lost by one of them.
    assert np.mean(hits.found == expected.found) > 0.999
    both = hits.found & expected.found
    assert both.any()
    assert not both.all()
    apart = np.abs(hits.distance - expected.distance)[both]
    assert np.mean(apart < 1e-5 * mesh.size) > 0.999, apart.max()
    assert (hits.distance[hits.found] <= np.broadcast_to(limit, hits.found.shape)[hits.found] * (1 + 1e-5)).all()
    corners = mesh.vertices[mesh.faces[hits.face[both]]]
    places = np.einsum("nk,nkc->nc", hits.weights[both], corners)
    np.testing.assert_allclose(places, (origins + hits.distance[:, None] * directions)[both], atol=1e-5 * mesh.size)
    assert np.isinf(hits.distance[~hits.found]).all()
    assert (hits.face[~hits.found] == -1).all()
assert len(ours.nearest(np.empty((0, 3)), np.empty((0, 3))).face) == 0
