"""Normal maps out of whole jobs, with the real method."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from facial_retarget_addon.cli import main
from facial_retarget_addon.core.methods.settings import MapSettings
from facial_retarget_addon.files.job import MapOutput, write_job
from facial_retarget_addon.files.meshes import read_mesh, write_mesh

from .test_images import exr_values, png_values


def with_maps(job, **settings):
    """The job with maps in a folder "maps"."""
    changed = replace(job, normal_maps=MapOutput(job.path.with_name("maps"), MapSettings(**settings)))
    write_job(changed, changed.path)
    return changed


def test_a_job_writes_a_map_of_each_frame_and_replaces_them(job):
    job = with_maps(job, pixels=64, depth="exr")
    for _ in range(2):
        assert main(["run", str(job.path), "--quiet"]) == 0
    files = sorted(job.normal_maps.folder.iterdir())
    assert [file.name for file in files] == ["normal.0001.exr", "normal.0002.exr", "normal.0003.exr"]
    pictures = [2 * exr_values(file.read_bytes()) - 1 for file in files]
    for picture in pictures:
        np.testing.assert_allclose(np.linalg.norm(picture, axis=2), 1, atol=1e-5)
        assert picture[..., 2].min() > 0
    # The bump of the frames grows, and only there.
    changes = [np.abs(picture - pictures[0]) for picture in pictures]
    assert changes[2].max() > changes[1].max() > 0


def test_udim_tiles_have_pictures_of_their_own_and_what_lies_outside_of_them_none(job):
    face = read_mesh(job.target.neutral)
    middle = np.add.reduceat(face.uvs[:, 0], np.cumsum(face.counts) - face.counts) / face.counts
    low, high = np.quantile(middle, [0.2, 0.6])
    step = np.repeat(np.select([middle < low, middle > high], [-1.0, 1.0], 0.0), face.counts)
    write_mesh(replace(face, uvs=face.uvs + np.stack([step, 0 * step], axis=1)), job.target.neutral)
    job = with_maps(job, pixels=64)
    assert main(["run", str(job.path), "--quiet"]) == 0
    names = [f"normal.{udim}.000{frame}.png" for udim in (1001, 1002) for frame in (1, 2, 3)]
    assert sorted(file.name for file in job.normal_maps.folder.iterdir()) == names


def test_texture_coordinates_in_no_tile_are_refused(job, listing, capsys):
    face = read_mesh(job.target.neutral)
    write_mesh(replace(face, uvs=face.uvs - [2.0, 0.0]), job.target.neutral)
    job = with_maps(job, pixels=64)
    before = listing()
    assert main(["run", str(job.path), "--quiet"]) == 2
    assert "lie in no UDIM tile" in capsys.readouterr().err
    assert listing() == before


def test_a_level_has_maps_without_any_texture_coordinates(job):
    face = read_mesh(job.target.neutral)
    write_mesh(replace(face, uvs=None), job.target.neutral)
    job = with_maps(job, pixels=64, depth="png8", level=1)
    assert main(["run", str(job.path), "--quiet"]) == 0
    assert png_values((job.normal_maps.folder / "normal.0003.png").read_bytes()).shape == (64, 64, 3)


@pytest.mark.parametrize("command", ["run", "check"])
def test_a_target_without_texture_coordinates_is_refused(job, listing, capsys, command):
    face = read_mesh(job.target.neutral)
    write_mesh(replace(face, uvs=None), job.target.neutral)
    job = with_maps(job)
    before = listing()
    assert main([command, str(job.path), "--quiet"]) == 2
    said = capsys.readouterr().err
    assert "target.obj has no texture coordinates" in said
    assert said.count("\n") == 1
    assert listing() == before


def test_a_folder_with_other_things_is_refused_and_kept(job, listing, capsys):
    job = with_maps(job)
    job.normal_maps.folder.mkdir()
    (job.normal_maps.folder / "notes.txt").write_text("mine")
    before = listing()
    assert main(["run", str(job.path), "--quiet"]) == 2
    assert "notes.txt" in capsys.readouterr().err
    assert listing() == before
