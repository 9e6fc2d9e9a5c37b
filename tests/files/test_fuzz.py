"""Any bytes at all: a reader gives a sound object or a RetargetError of one line, and never anything else."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.shapes.shape_set import ShapeSet
from facial_retarget_addon.files.base_mesh import read_base_mesh, write_base_mesh
from facial_retarget_addon.files.clone_job import read_clone_job
from facial_retarget_addon.files.frames import read_frames, write_frames
from facial_retarget_addon.files.job import read_job
from facial_retarget_addon.files.meshes import read_mesh, write_mesh
from facial_retarget_addon.files.parts import read_parts, write_parts
from facial_retarget_addon.files.points import read_points, write_points
from facial_retarget_addon.files.shape_files import add_shapes, read_shapes
from facial_retarget_addon.files.whole import written_whole

from .conftest import dome, dome_points

SIDE = 6
MESH = dome(SIDE)
FRAMES = np.stack([MESH.mesh.vertices, 1.1 * MESH.mesh.vertices])
JOB = b"""version = 1
method = "hierarchical"
base = "b.json"
[source]
neutral = "s.obj"
frames = "f.npz"
[target]
neutral = "t.obj"
points = "p.json"
[[examples]]
name = "joy"
source = "a.obj"
target = "b.obj"
[settings]
levels = 3
level_gains = [1, 0.5]
[output]
frames = "out.npz"
"""
CLONE_JOB = b"""version = 1
method = "motion_cloning"
[source]
neutral = "s.obj"
points = "s.json"
shapes = "s"
[shapes]
keep = ["mouth*"]
split = ["jaw*"]
feather = 0.5
sides = ["_L", "_R"]
merge.brow = ["a", "b"]
[[targets]]
neutral = "t.obj"
points = "t.json"
shapes = "t.npz"
"""
ASCII_PLY = b"""ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
3 0 1 2
"""


def read_any_mesh(path: Path) -> None:
    found = read_mesh(path)
    assert len(found.mesh.faces)
    assert np.isfinite(found.mesh.vertices).all()
    assert found.mesh.faces.min() >= 0
    assert found.mesh.faces.max() < len(found.mesh.vertices)
    assert found.counts.sum() == len(found.corners)
    assert found.uvs is None or found.uvs.shape == (len(found.corners), 2)


def read_any_frames(path: Path) -> None:
    frames = read_frames(path, SIDE * SIDE)
    assert frames.shape[1:] == (SIDE * SIDE, 3)
    assert frames.dtype == np.float32
    np.isfinite(frames).all()


def read_any_points(path: Path) -> None:
    points = read_points(path, MESH.mesh)
    assert np.isfinite(points.positions(MESH.mesh.vertices)).all()


def read_any_parts(path: Path) -> None:
    assert all(MESH.mesh.vertices[vertices].size for vertices in read_parts(path, MESH.mesh).values())


def read_any_shapes(path: Path) -> None:
    assert np.isfinite(read_shapes(path, MESH.mesh).displacements).all()


READERS: dict[str, Callable[[Path], object]] = {
    "mesh.obj": read_any_mesh,
    "mesh.ply": read_any_mesh,
    "ascii.ply": read_any_mesh,
    "mesh.npz": read_any_mesh,
    "small.npz": read_any_mesh,
    "frames.npz": read_any_frames,
    "frames.pc2": read_any_frames,
    "frames.mdd": read_any_frames,
    "points.json": read_any_points,
    "parts.json": read_any_parts,
    "base.json": read_base_mesh,
    "table.json": read_any_shapes,
    "shapes.npz": read_any_shapes,
    "job.toml": read_job,
    "clone.toml": read_clone_job,
}
WORDS = st.sampled_from(
    [
        b"nan",
        b"-1",
        b"0",
        b"1e999",
        b"9" * 30,
        b"\0" * 4,
        b"\xff" * 4,
        b"null",
        b"true",
        b"[" * 50,
        b"{",
        b'"',
        b"/",
        b"\n",
    ]
)


def sound(folder: Path, name: str) -> bytes:
    """The bytes of a sound file."""
    path = folder / name
    match name:
        case "job.toml":
            return JOB
        case "clone.toml":
            return CLONE_JOB
        case "ascii.ply":
            return ASCII_PLY
        case "small.npz":
            packed = io.BytesIO()
            np.savez_compressed(packed, vertices=MESH.mesh.vertices, faces=MESH.mesh.faces)
            return packed.getvalue()
        case "points.json":
            write_points(dome_points(SIDE), path)
        case "parts.json":
            write_parts({"tongue": np.array([3]), "lashes": np.array([7])}, MESH.mesh, path)
        case "table.json" | "shapes.npz":
            shapes = ShapeSet.of_positions(MESH.mesh.vertices, {"jawOpen": FRAMES[1], "smirk": FRAMES[0]})
            with written_whole() as aside:
                add_shapes(aside, shapes, path, MESH)
        case "base.json":
            write_base_mesh((("a", "b", "c"),), path)
        case _:
            write_mesh(MESH, path) if name.startswith("mesh") else write_frames(FRAMES, path)
    return path.read_bytes()


def survives(name: str, path: Path, content: bytes) -> None:
    path.write_bytes(content)
    said = ""
    try:
        READERS[name](path)
    except RetargetError as error:
        said = str(error)
    assert "\n" not in said


@pytest.mark.parametrize("name", READERS)
@settings(max_examples=50, deadline=5000, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(content=st.binary(max_size=200))
def test_any_bytes(tmp_path, name, content):
    survives(name, tmp_path / name, content)


@pytest.mark.parametrize("name", READERS)
@settings(max_examples=150, deadline=5000, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_a_sound_file_with_a_few_changes(tmp_path, name, data):
    content = bytearray(sound(tmp_path, name))
    for _ in range(data.draw(st.integers(1, 3))):
        start = data.draw(st.integers(0, len(content)))
        end = data.draw(st.integers(start, min(start + 6, len(content))))
        content[start:end] = data.draw(st.binary(max_size=4) | WORDS)
    survives(name, tmp_path / name, bytes(content))


@pytest.mark.parametrize("name", READERS)
def test_a_sound_file_is_sound(tmp_path, name):
    (tmp_path / name).write_bytes(sound(tmp_path, name))
    READERS[name](tmp_path / name)


@pytest.mark.parametrize("name", ["points.json", "base.json", "table.json", "job.toml", "clone.toml"])
def test_a_document_that_nests_too_deep(tmp_path, name):
    survives(name, tmp_path / name, b"a = " * name.endswith(".toml") + b"[" * 100_000)
    survives(name, tmp_path / name, b'{"a":' * 100_000)
