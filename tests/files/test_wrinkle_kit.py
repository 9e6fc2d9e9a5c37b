"""Wrinkle kits out of clone jobs: what an engine reads back is what was meant."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from facial_retarget_addon.cli import main
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.methods.base import fit
from facial_retarget_addon.core.methods.settings import HierarchicalSettings, MotionCloningSettings, WrinkleSettings
from facial_retarget_addon.core.normal_maps.frame_maps import FrameMaps
from facial_retarget_addon.core.normal_maps.key_poses import retargeted_poses
from facial_retarget_addon.core.normal_maps.wrinkle_kit import WrinkleKit, fit_wrinkle_kit
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.core.shapes.shape_set import ShapeSet
from facial_retarget_addon.files.clone_job import CloneJob, SourceFiles, TargetFiles, read_clone_job, write_clone_job
from facial_retarget_addon.files.job import FaceFiles
from facial_retarget_addon.files.meshes import read_mesh, write_mesh
from facial_retarget_addon.files.normal_map_files import textured
from facial_retarget_addon.files.points import read_points, write_points
from facial_retarget_addon.files.shape_files import add_shapes, read_shapes
from facial_retarget_addon.files.whole import written_whole
from facial_retarget_addon.files.wrinkle_kit_files import check_kit_place

from .conftest import dome, dome_points
from .test_images import exr_values, png_values

SIDES = {"source": 81, "target": 16}
LEVELS = HierarchicalSettings(levels=4)


def folds(vertices: np.ndarray, middle: float) -> np.ndarray:
    """Displacements (V, 3) of a dome's skin that is pushed together around a place, and folds there."""
    x, y = vertices[:, 0] - middle, vertices[:, 1]
    near = np.clip(1 - (x * x + y * y) / 0.15, 0, None) ** 2
    return np.stack([0 * x, -0.15 * y * near, 0.02 * np.sin(25 * y) * near], axis=1)


@pytest.fixture
def job(tmp_path: Path) -> CloneJob:
    """A clone job in a folder of its own: one key that folds on either side, one that does not, and a kit."""
    files = {}
    for name, side in SIDES.items():
        face = dome(side)
        write_mesh(face, tmp_path / f"{name}.obj")
        write_points(dome_points(side), tmp_path / f"{name}.json")
        files[name] = FaceFiles(tmp_path / f"{name}.obj", tmp_path / f"{name}.json")
    source = read_mesh(files["source"].neutral)
    rest = source.mesh.vertices
    moves = [folds(rest, -0.45), folds(rest, 0.45), np.tile([0.0, 0.0, 0.1], (len(rest), 1))]
    with written_whole() as aside:
        add_shapes(aside, ShapeSet(("left", 'the "right"', "lift"), np.stack(moves)), tmp_path / "shapes.npz", source)
    target = TargetFiles(
        files["target"], tmp_path / "out.npz", report=tmp_path / "report.json", wrinkles=tmp_path / "kit"
    )
    described = CloneJob(
        SourceFiles(files["source"], tmp_path / "shapes.npz"),
        (target,),
        method="hierarchical",
        settings=LEVELS,
        path=tmp_path / "clone.toml",
        wrinkle_kit=WrinkleSettings(pixels=96),
    )
    write_clone_job(described, tmp_path / "clone.toml")
    return described


def with_kit(job: CloneJob, **settings: Any) -> CloneJob:
    """The job with other settings of its kit."""
    changed = replace(job, wrinkle_kit=replace(job.wrinkle_kit, **settings))
    write_clone_job(changed, changed.path or Path())
    return changed


def run(job: CloneJob) -> int:
    return main(["clone", str(job.path), "--quiet"])


def made_by_hand(job: CloneJob) -> WrinkleKit:
    """The kit of a job's files, without the job."""
    faces = []
    for files in (job.source.face, job.targets[0].face):
        mesh = read_mesh(files.neutral)
        faces.append((mesh, Face(mesh.mesh, read_points(files.points, mesh.mesh))))
    (source, one), (target, other) = faces
    problem = Problem(one, other)
    surface = None if job.wrinkle_kit.level else textured(target, "target")
    maps = FrameMaps(fit(job.method, problem, job.settings), problem, surface, job.wrinkle_kit)
    shapes = read_shapes(job.source.shapes, source.mesh)
    return fit_wrinkle_kit(maps, retargeted_poses(maps, source.mesh.vertices, shapes, shapes.names), 3.0)


def shown(folder: Path, values: dict[str, float]) -> np.ndarray:
    """Unit normals (H, W, 3), row 0 at the bottom, green up, that an engine makes of a folder as its document says."""
    said = json.loads((folder / "wrinkles.json").read_text())
    assert (said["format"], said["version"]) == ("facial-retarget/wrinkle-kit", 1)

    def picture(name: str) -> np.ndarray:
        data = (folder / name).read_bytes()
        if name.endswith("exr"):
            return exr_values(data)
        found = png_values(data)
        return found / np.iinfo(found.dtype).max

    neutral = 2 * picture(said["neutral"]) - 1
    slope = neutral[..., :2] / np.maximum(neutral[..., 2:], 0.1)
    for key in said["keys"]:
        channels = ["RGBA".index(channel) for channel in key["wrinkle"]["channels"]]
        d = 2 * picture(key["wrinkle"]["file"])[..., channels] - 1
        weight = values.get(key["name"], 0.0) * picture(key["mask"]["file"])[..., "RGBA".index(key["mask"]["channel"])]
        slope += (weight / np.sqrt(np.maximum(1 - (d * d).sum(axis=-1), 0.01)))[..., None] * d
    normal = np.concatenate([slope, np.ones_like(slope[..., :1])], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    return (normal * [1, -1 if said["green"] == "down" else 1, 1])[::-1]


@pytest.mark.parametrize(
    ("settings", "most"),
    [
        ({"depth": "exr"}, 0.05),
        ({"depth": "png16", "convention": "directx"}, 0.06),
        ({"depth": "png8"}, 2.0),
        ({"depth": "png16", "level": 2}, 0.06),
    ],
)
def test_an_engine_reads_back_the_normals_that_were_meant(job: CloneJob, settings: dict[str, Any], most: float) -> None:
    job = with_kit(job, **settings)
    assert run(job) == 0
    kit = made_by_hand(job)
    assert [key.name for key in kit.keys] == ["left", 'the "right"']
    for values in ({}, {"left": 1.0}, {"left": 0.4, 'the "right"': 0.9}):
        wanted = kit.blended(values, (0, 0))
        found = shown(job.targets[0].wrinkles or Path(), values)
        off = np.degrees(np.arccos(np.clip(np.einsum("...i,...i->...", found, wanted), -1, 1)))
        assert off.max() < most, values
    changed = np.einsum("...i,...i->...", kit.blended({"left": 1.0}, (0, 0)), kit.neutral((0, 0)))
    assert np.degrees(np.arccos(changed.min())) > 10


def test_the_report_says_what_has_a_map_and_what_has_none(job: CloneJob, tmp_path: Path) -> None:
    assert run(job) == 0
    said = json.loads((tmp_path / "report.json").read_text())["wrinkle_kit"]
    document = json.loads((tmp_path / "kit" / "wrinkles.json").read_text())
    assert [key["name"] for key in said["keys"]] == ["left", 'the "right"']
    assert list(said["dropped"]) == list(document["dropped"]) == ["lift"]
    # Keys on either side share a picture: three pictures in all.
    assert said["pictures"] == 3
    assert sorted(path.name for path in (tmp_path / "kit").iterdir()) == [
        "mask_1.png",
        "neutral.png",
        "wrinkle_1.png",
        "wrinkles.json",
    ]
    assert (document["mesh"], document["udim"], document["colour_space"]) == ("target.obj", [1001], "linear")


def test_a_kit_replaces_a_kit_and_nothing_else(job: CloneJob, tmp_path: Path, capsys: Any, listing: Any) -> None:
    assert run(with_kit(job, depth="exr")) == 0
    assert run(with_kit(job, depth="png8")) == 0
    assert not list((tmp_path / "kit").glob("*.exr"))
    (tmp_path / "kit" / "skin.png").write_bytes(b"mine")
    before = listing()
    for command in ("clone", "check"):
        assert main([command, str(job.path), "--quiet"]) == 2
        assert "holds 'skin.png'" in capsys.readouterr().err
    assert listing() == before
    with pytest.raises(RetargetError, match="expected a new folder, or one that holds a wrinkle kit"):
        check_kit_place(tmp_path / "kit")


def test_a_job_comes_back_with_its_kit(job: CloneJob) -> None:
    job = with_kit(job, least=1.5, level=2, margin=3, convention="directx")
    assert job.path is not None
    assert read_clone_job(job.path) == job


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"method": "motion_cloning", "settings": MotionCloningSettings()}, "wrinkles needs a method with levels"),
        ({"wrinkle_kit": WrinkleSettings(level=5)}, r"\[wrinkle_kit\] level = 5, expected one of the 4"),
        ({"wrinkle_kit": WrinkleSettings(least=91)}, r"\[wrinkle_kit\] least = 91: expected a number from 0.0 to 90.0"),
    ],
)
def test_what_is_wrong_with_a_kit_is_said(job: CloneJob, change: dict[str, Any], said: str) -> None:
    assert job.path is not None
    write_clone_job(replace(job, **change), job.path)
    with pytest.raises(RetargetError, match=said):
        read_clone_job(job.path)


def test_a_target_without_texture_coordinates_and_keys_without_wrinkles_are_refused(
    job: CloneJob, capsys: Any, listing: Any
) -> None:
    before = listing()
    assert run(with_kit(job, least=80)) == 2
    assert "turns normals by 80 degrees" in capsys.readouterr().err
    write_mesh(replace(read_mesh(job.targets[0].face.neutral), uvs=None), job.targets[0].face.neutral)
    assert main(["check", str(with_kit(job).path)]) == 2
    assert "has no texture coordinates" in capsys.readouterr().err
    assert listing().keys() == before.keys()
