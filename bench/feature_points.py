"""FAP frames: playing a face by its feature points, against the paper's speed, the memory bound, and its jumps."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from time import perf_counter

import numpy as np

from facial_retarget_addon.core.acting.fap_face import FapFace, fit_fap_face
from facial_retarget_addon.core.acting.point_deformer import fit_deformer
from facial_retarget_addon.core.arrays import FloatArray
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.mpeg4.faps import FAPS
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.files.points import read_points

from .faces import skin
from .real_pair import DATA
from .timing import Row, medians

BLOCK = 16
PAPER = 29.0
"""Frames a second of the paper's face, which has 1257 vertices."""
SIZES = {1_257: 10_000, 30_000: 1_000, 100_000: 300}
"""Vertices -> frames a second, at least."""
GAP = 10
"""Edges between the points of the lattice that shows jumps."""


def rows() -> Iterator[Row]:
    """Frames a second by size, what bounds them, the fit, and the jumps of both variants."""
    for vertices, bound in SIZES.items():
        yield from _playing(*skin(vertices), "actor", bound)
    if (DATA / "ict_dev.npz").exists():
        for file, points in (("ict_dev", "ict_points"), ("makehuman_dev", "makehuman_points")):
            yield from _playing(*_stored(DATA / f"{file}.npz", DATA / f"{points}.json"), file.split("_")[0])
    else:
        print(f"(left out: the real faces are not in {DATA.name})")
    yield from _jumps()


def _stored(mesh_file: Path, points_file: Path) -> tuple[TriMesh, FeaturePoints]:
    with np.load(mesh_file) as data:
        mesh = TriMesh(data["vertices"], data["tris"])
    return mesh, read_points(points_file, mesh)


def _playing(mesh: TriMesh, points: FeaturePoints, name: str, bound: float | None = None) -> Iterator[Row]:
    start = perf_counter()
    fitted = fit_fap_face(mesh, points)
    fitting = perf_counter() - start
    values = np.random.default_rng(0).uniform(-300, 300, (BLOCK, len(FAPS)))
    blocks, ones = (_copy_bound(fitted, count) for count in (BLOCK, 1))
    times = medians(
        {
            "block": lambda: fitted.frames(values),
            "one": lambda: fitted.frames(values[:1]),
            "block bound": blocks,
            "one bound": ones,
        },
        rounds=15,
    )
    size = f"{name}, {len(mesh.vertices)} vertices:"
    speed = BLOCK / times["block"]
    yield Row(f"{size} fit", fitting, "s")
    yield Row(f"{size} blocks of {BLOCK}", speed, "frames/s", bound, at_least=True)
    yield Row(f"{size} one by one", 1 / times["one"], "frames/s")
    # A copy reads and writes each byte: it moves twice its length.
    yield Row(f"{size} memory bound, blocks of {BLOCK}", 2 * BLOCK / times["block bound"], "frames/s")
    yield Row(f"{size} memory bound, one by one", 2 / times["one bound"], "frames/s")
    yield Row(f"{size} over the paper's {PAPER:g} frames a second", speed / PAPER, "x", 1.0, at_least=True)


def _copy_bound(face: FapFace, frames: int) -> Callable[[], None]:
    """What copies as many bytes as some frames have to move.

    Float32: the matrix with its indices once, each frame's positions written, and the neutral read for each frame.
    """
    moved = 8 * face.report["weights_per_vertex"] * len(face.mesh.vertices) + frames * 2 * face.mesh.vertices.size * 4
    block = np.ones(int(moved) // 4, np.float32)
    sink = np.empty_like(block)
    return lambda: np.copyto(sink, block)


def _jumps() -> Iterator[Row]:
    """The largest change of a point's share from a vertex to the next, as a share of its motion."""
    mesh, points = _lattice()
    count = len(points)
    sent = np.zeros((count, count, 3))
    sent[np.arange(count), np.arange(count), 2] = 1.0
    for variant in ("default", "paper"):
        fitted = fit_deformer(mesh, points, np.eye(3), np.ones((count, 3), bool), variant)
        height: FloatArray = fitted.displacements(sent)[:, :, 2]
        jump = np.abs(height[:, mesh.edges[:, 0]] - height[:, mesh.edges[:, 1]]).max()
        bound = 0.5 if variant == "default" else None
        yield Row(f"{variant}: largest jump across an edge, {GAP} edges from point to point", float(jump), "", bound)


def _lattice() -> tuple[TriMesh, FeaturePoints]:
    """A flat grid with nine points, as far from its border as from each other."""
    size = 4 * GAP + 1
    x, y = np.meshgrid(np.arange(float(size)), np.arange(float(size)))
    corner = np.add.outer(np.arange(size - 1) * size, np.arange(size - 1)).ravel()
    lower = np.stack([corner, corner + 1, corner + size + 1], axis=1)
    upper = np.stack([corner, corner + size + 1, corner + size], axis=1)
    mesh = TriMesh(np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1), np.concatenate([lower, upper]))
    held = np.add.outer(np.arange(GAP, size - 1, GAP) * size, np.arange(GAP, size - 1, GAP)).ravel()
    names = tuple(f"p{k}" for k in range(len(held)))
    return mesh, FeaturePoints(names, np.repeat(held[:, None], 3, axis=1), np.tile([1.0, 0, 0], (len(held), 1)))
