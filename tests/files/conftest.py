"""A small job on disk, and a stand-in for the method where only files are looked at."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.methods.settings import HierarchicalSettings
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.files.frames import write_frames
from facial_retarget_addon.files.job import ExampleFiles, FaceFiles, Job, OutputFiles, write_job
from facial_retarget_addon.files.mesh_file import MeshFile
from facial_retarget_addon.files.meshes import write_mesh
from facial_retarget_addon.files.points import write_points

POINTS = 6


def dome(side: int, size: float = 1.0) -> MeshFile:
    """A bulging sheet of quads, side * side vertices, that looks along +Z."""
    x, y = np.meshgrid(np.linspace(-1, 1, side), np.linspace(-1, 1, side))
    vertices = size * np.stack([x, y, 1 - 0.4 * (x**2 + y**2)], axis=-1).reshape(-1, 3)
    grid = np.arange(side * side).reshape(side, side)
    quads = np.stack([grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]], axis=-1).reshape(-1, 4)
    uvs = (vertices[:, :2] / size + 1) / 2
    counts = np.full(len(quads), 4, np.int64)
    return MeshFile.from_polygons(Path("dome"), vertices, counts, quads.ravel(), uvs[quads.ravel()])


def dome_points(side: int) -> FeaturePoints:
    """A grid of named points on a dome."""
    at = np.linspace(0, side - 1, POINTS).astype(int)
    vertices = (at[:, None] * side + at).ravel()
    names = tuple(f"p{i}" for i in range(len(vertices)))
    return FeaturePoints(names, np.repeat(vertices[:, None], 3, axis=1), np.tile([1.0, 0.0, 0.0], (len(names), 1)))


def bump(mesh: TriMesh, place: float, height: float) -> np.ndarray:
    """(V, 3) positions of a dome with a bump."""
    x, y = mesh.vertices[:, 0] / mesh.size - place, mesh.vertices[:, 1] / mesh.size
    moved = mesh.vertices.copy()
    moved[:, 2] += height * mesh.size * np.exp(-20 * (x**2 + y**2))
    return moved


SIDES = {"source": 21, "target": 16}


@pytest.fixture
def job(tmp_path: Path) -> Job:
    """A sound job with two examples in a folder of its own."""
    faces = {}
    for number, (name, side) in enumerate(SIDES.items()):
        face = dome(side, 1.0 + number)
        write_mesh(face, tmp_path / f"{name}.obj")
        write_points(dome_points(side), tmp_path / f"{name}_points.json")
        for example, place in (("joy", -0.2), ("anger", 0.2)):
            moved = face.mesh.with_vertices(bump(face.mesh, place, 0.1))
            write_mesh(MeshFile(moved, face.counts, face.corners), tmp_path / f"{name}_{example}.obj")
        faces[name] = FaceFiles(tmp_path / f"{name}.obj", tmp_path / f"{name}_points.json")
        if name == "source":
            frames = np.stack([bump(face.mesh, 0.1, height) for height in (0.0, 0.05, 0.1)])
            write_frames(frames, tmp_path / "source_frames.npz")
    described = Job(
        method="hierarchical",
        source=FaceFiles(faces["source"].neutral, faces["source"].points, tmp_path / "source_frames.npz"),
        target=faces["target"],
        examples=tuple(
            ExampleFiles(name, tmp_path / f"source_{name}.obj", tmp_path / f"target_{name}.obj")
            for name in ("joy", "anger")
        ),
        settings=HierarchicalSettings(levels=2),
        output=OutputFiles(tmp_path / "out.npz", tmp_path / "report.json", tmp_path / "report.html"),
        base=None,
        path=tmp_path / "job.toml",
    )
    write_job(described, described.path)
    return described


class StandIn:
    """A fitted method that holds the target still, with a report of the real one's form."""

    def __init__(self, method, problem, settings, progress) -> None:
        progress(0.5, "frame 1 of 3")
        self.rest = problem.target.mesh.vertices.astype(np.float32)
        self.counterpart = np.full(len(self.rest), -1)
        self.report = {
            "scale": 2.0,
            "levels": [{"level": 1, "vertices": 9, "source_piercing_errors": 0, "target_piercing_errors": 1}],
            "examples": [{"name": "joy", "fit": 0.01, "leave_one_out": float("nan")}],
            "warnings": ["the stand-in does nothing"],
        }

    def frames(self, source: np.ndarray) -> np.ndarray:
        return np.repeat(self.rest[None], len(source), axis=0)


@pytest.fixture
def no_method(monkeypatch: pytest.MonkeyPatch) -> None:
    """Only files and checks are looked at: the method is a stand-in."""
    monkeypatch.setattr("facial_retarget_addon.core.retarget.fit", StandIn)


class FaceOnDisk(NamedTuple):
    """A small built-in face with MPEG-4 points: what it is, and its files."""

    actor: demo.DemoFace
    neutral: Path
    points: Path

    @property
    def arguments(self) -> list[str]:
        return ["--face", str(self.neutral), "--points", str(self.points)]


@pytest.fixture(scope="session")
def face(tmp_path_factory: pytest.TempPathFactory) -> FaceOnDisk:
    """The built-in actor on few vertices, as files."""
    actor, folder = demo.actor(vertices=6000), tmp_path_factory.mktemp("face")
    uvs = actor.uvs[actor.corners]
    write_mesh(MeshFile(actor.face.mesh, actor.counts, actor.corners, uvs), folder / "neutral.obj")
    write_points(actor.face.points, folder / "points.json")
    return FaceOnDisk(actor, folder / "neutral.obj", folder / "points.json")


@pytest.fixture
def listing(tmp_path: Path) -> Callable[[], dict[str, bytes]]:
    """What the folder holds, to compare before and after."""
    return lambda: {str(p.relative_to(tmp_path)): p.read_bytes() for p in tmp_path.rglob("*") if p.is_file()}
