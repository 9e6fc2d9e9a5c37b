"""Every real face brought to subdivision connectivity, taken apart into wavelets, and put together again."""

from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.core.base.base_mesh import base_mesh
from facial_retarget_addon.core.levels.butterfly import butterfly
from facial_retarget_addon.core.levels.normal_mesh import build_normal_mesh
from facial_retarget_addon.core.levels.subdivision import hierarchy
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.core.wavelets.lifting import wavelets
from facial_retarget_addon.files.points import read_points

FACES = {
    "ict_dev.npz": "ict_points.json",
    "makehuman_dev.npz": "makehuman_points.json",
    "male_adult_08.npz": "male_adult_08_points.json",
    "johnsmith_welded.npz": "johnsmith_points.json",
    "ogre.npz": Path(__file__).parent.parent / "data" / "ogre_points.json",
    "robot.npz": None,
    "canonical.npz": None,
}
"""Face -> its points; None: places far from each other in front."""
LEVELS = 3


def read(folder: Path, name: str) -> tuple[TriMesh, FeaturePoints]:
    with np.load(folder / name) as data:
        mesh = TriMesh(data["vertices"], data["tris"])
    points = FACES[name]
    return mesh, in_front(mesh, 30) if points is None else read_points(folder / points, mesh)


def in_front(mesh: TriMesh, count: int) -> FeaturePoints:
    """Vertices of the largest component that looks forward, each as far as can be from those before."""
    largest = np.bincount(mesh.components[mesh.faces[:, 0]]).argmax()
    allowed = np.flatnonzero((mesh.components == largest) & (mesh.vertex_normals[:, 2] > 0.3))
    chosen, gap = [allowed[0]], np.full(len(allowed), np.inf)
    for _ in range(count - 1):
        gap = np.minimum(gap, np.linalg.norm(mesh.vertices[allowed] - mesh.vertices[chosen[-1]], axis=1))
        chosen.append(allowed[gap.argmax()])
    names = tuple(f"p{k}" for k in range(count))
    return FeaturePoints(names, np.repeat(np.array(chosen)[:, None], 3, axis=1), np.tile([1.0, 0, 0], (count, 1)))


@pytest.mark.parametrize("name", FACES)
def test_faces_are_reconstructed(shared_data: Path, name: str) -> None:
    mesh, points = read(shared_data, name)
    base = base_mesh(mesh, points, mesh, points)
    steps = hierarchy(base.faces, len(base.names), LEVELS, butterfly)
    fine = build_normal_mesh(mesh, points.subset(base.names), base.loops, steps).levels[-1].positions
    bank = wavelets(base.faces, len(base.names), steps)
    parts = bank.analyse(fine)
    assert np.abs(bank.synthesise(parts) - fine).max() < 1e-6 * mesh.size
    single = bank.single()
    assert np.abs(single.synthesise(single.analyse(fine.astype(np.float32))) - fine).max() < 1e-6 * mesh.size
    # Coefficients are what subdivision does not foretell: small beside the base, smaller on finer levels.
    sizes = [np.sqrt(np.square(part).sum(axis=1).mean()) for part in parts[1:]]
    assert sizes[-1] < 0.5 * sizes[0] < 0.1 * mesh.size
