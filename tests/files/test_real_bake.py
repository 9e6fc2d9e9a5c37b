"""A recorded performance on another person's head, as few keys and as curves of its own units, by the command line."""

import csv
import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from bench.bakes import Recorded, read_set
from facial_retarget_addon.cli import main
from facial_retarget_addon.core.base.regions import eye_separation
from facial_retarget_addon.files.frames import read_frames, write_frames
from facial_retarget_addon.files.mesh_file import MeshFile
from facial_retarget_addon.files.meshes import write_mesh
from facial_retarget_addon.files.npz import array_names, write_arrays
from facial_retarget_addon.files.shape_files import read_shapes

STEP = 20
"""Of the recording's frames; `bench bakes` has all of them."""
JOB = """
version = 1
method = "motion_cloning"
[source]
neutral = "ict.npz"
points = "ict.json"
frames = "recorded.pc2"
fps = 3.0
[target]
neutral = "makehuman.npz"
points = "makehuman.json"
[output]
frames = "frames.npz"
report = "report.json"
[bake]
curves = ["curves.csv"]
"""


@pytest.fixture(scope="module")
def folder(shared_data: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The ICT head with the recording, and MakeHuman's with its units, as files of ours."""
    if not (shared_data / "livelink_alex_rom_3.npz").exists():
        pytest.skip("the recording is not there")
    folder = tmp_path_factory.mktemp("recorded")
    for name in ("ict", "makehuman"):
        face, shapes, names = read_set(f"{name}_dev", f"{name}_points")
        write_mesh(MeshFile.from_mesh(face.mesh), folder / f"{name}.npz")
        shutil.copy(shared_data / f"{name}_points.json", folder / f"{name}.json")
        if name == "ict":
            write_frames(Recorded(face.mesh, shapes, names, STEP), folder / "recorded.pc2")
        else:
            with open(folder / "units.npz", "xb") as file:
                write_arrays(file, dict(zip(names, face.mesh.vertices + shapes, strict=True)))
    return folder


def baked(folder: Path, lines: str) -> tuple[dict, list[str], np.ndarray]:
    """Figures of a bake, its keys' names and their curves."""
    (folder / "job.toml").write_text(f"{JOB}{lines}\n")
    assert main(["run", str(folder / "job.toml"), "--quiet"]) == 0
    with open(folder / "curves.csv", encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    return json.loads((folder / "report.json").read_text())["bake"], head[2:], np.array(rows, np.float32)[:, 2:]


def test_a_recorded_performance_becomes_few_keys_within_half_a_percent(folder: Path) -> None:
    figures, names, curves = baked(folder, 'kind = "compact"\ntolerance = 0.005\nshapes = "keys.npz"')
    face, _, _ = read_set("makehuman_dev", "makehuman_points")
    rest, unit = face.mesh.vertices, eye_separation(face.mesh, face.points)
    keys, frames = read_shapes(folder / "keys.npz", face.mesh), read_frames(folder / "frames.npz", len(rest))
    assert tuple(names) == keys.names
    assert len(names) < len(frames) / 5
    assert figures["bytes"] < figures["bytes_as_frames"] / 5
    assert {name.split("_")[1].split(".")[0] for name in names} >= {"mouth", "brows"}
    away = np.linalg.norm(rest + np.tensordot(curves, keys.displacements, axes=1) - frames, axis=2) / unit
    moving = np.linalg.norm(frames - rest, axis=2).max(axis=0) > 0.005 * unit
    errors = np.sqrt((away[:, moving] ** 2).mean(axis=1))
    assert errors.max() <= 0.005 * (1 + 1e-3)
    np.testing.assert_allclose(errors, figures["per_frame"]["error"], rtol=0.02, atol=1e-5)


def test_it_is_fitted_to_the_heads_own_units_and_a_residual_takes_what_they_cannot(folder: Path) -> None:
    alone, names, curves = baked(folder, 'kind = "rig"\nrig = "units.npz"')
    assert alone["keys"] == len(names) > 30
    assert alone["new_keys"] == 0
    assert 0 <= curves.min() < curves.max() <= 1
    # Its units have no jaw that drops so far: most frames are met, not all.
    assert np.median(alone["per_frame"]["error"]) < 0.04
    more, names, _ = baked(folder, 'kind = "rig"\nrig = "units.npz"\nresidual = 15\nshapes = "residuals.npz"')
    added = array_names(folder / "residuals.npz")
    assert names[-len(added) :] == added
    assert more["new_keys"] == len(added) == -(-more["frames"] // 15)
    assert np.quantile(more["per_frame"]["error"], 0.95) < 0.5 * np.quantile(alone["per_frame"]["error"], 0.95)
