"""Recorded motion on real faces: FAP takes, Live Link recordings and markers, on a human, a scan and an ogre."""

from __future__ import annotations

import json
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from facial_retarget_addon.cli import main
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.mpeg4.conversions import low_level, stream_of_values
from facial_retarget_addon.core.mpeg4.fdps import FDPS
from facial_retarget_addon.core.mpeg4.head import head_axes
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.files.motion.fap import read_fap, write_fap
from facial_retarget_addon.files.points import read_points

from .conftest import FaceOnDisk

DATA = Path(__file__).resolve().parents[1] / "data"
XFACE = ("anger", "beg", "disgust", "fear", "happy_for", "hate", "joy", "pride")
"""FAP takes, whose mouths all say the same sentence."""
FACES = ("actor", "ict", "ogre")


class RealFace(NamedTuple):
    """A face with the arguments that name its files."""

    mesh: TriMesh
    points: FeaturePoints
    arguments: list[str]

    def places(self, frames: np.ndarray, *names: str) -> np.ndarray:
        """Places (F, N, 3) of points on frames (F, V, 3)."""
        return self.points.subset(names).positions(frames.astype(np.float64))


@pytest.fixture(scope="module")
def faces(shared_data: Path, face: FaceOnDisk, tmp_path_factory: pytest.TempPathFactory) -> dict[str, RealFace]:
    folder = tmp_path_factory.mktemp("faces")
    found = {"actor": RealFace(face.actor.face.mesh, face.actor.face.points, face.arguments)}
    for name, file, points in (
        ("ict", "ict_dev.npz", shared_data / "ict_points.json"),
        ("ogre", "ogre.npz", DATA / "ogre_mpeg4_points.json"),
    ):
        with np.load(shared_data / file) as data:
            mesh = TriMesh(data["vertices"], data["tris"])
        np.savez(folder / f"{name}.npz", vertices=mesh.vertices, faces=mesh.faces)
        arguments = ["--face", str(folder / f"{name}.npz"), "--points", str(points)]
        found[name] = RealFace(mesh, read_points(points, mesh), arguments)
    return found


def play(motion: Path, face: RealFace, folder: Path, *arguments: str) -> tuple[np.ndarray, dict]:
    """Frames (F, V, 3) of a face that plays some motion, and the report."""
    out, report = folder / "out.npz", folder / "report.json"
    said = ["--out", str(out), "--report", str(report), "--quiet"]
    assert main(["fap", str(motion), *face.arguments, *said, *arguments]) == 0
    with np.load(out) as data:
        frames = data["frames"]
    assert np.isfinite(frames).all()
    return frames, json.loads(report.read_text())


def motion_of(frames: np.ndarray, face: RealFace) -> np.ndarray:
    """(F,) the farthest that a vertex has gone from the neutral, as a share of the face's size."""
    return np.abs(frames - face.mesh.vertices.astype(np.float32)).max(axis=(1, 2)) / face.mesh.size


def gap(face: RealFace, frames: np.ndarray, upper: str = "2.2", lower: str = "2.3") -> np.ndarray:
    """(F,) how far a point is above another one, as the head stands."""
    places = face.places(frames, upper, lower)
    known = [name for name in face.points.names if name in FDPS]
    up = head_axes(known, face.places(face.mesh.vertices[None], *known)[0])[1]
    return (places[:, 0] - places[:, 1]) @ up


@pytest.fixture(scope="module")
def every_take(shared_data: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All takes of one tool, one after the other in one `.fap`; two of them are here as their own files too."""
    with np.load(shared_data / "mpeg4_fap_xface.npz") as data:
        values = np.concatenate([np.where(data[f"{name}_mask"], data[name], 0) for name in XFACE])
        path = tmp_path_factory.mktemp("takes") / "all.fap"
        write_fap(stream_of_values("all", float(data["fps"]), values.astype(np.float64)), path)
    return path


@pytest.mark.parametrize("name", FACES)
def test_every_fap_take_plays(name: str, faces: dict[str, RealFace], every_take: Path, tmp_path: Path) -> None:
    face = faces[name]
    values = low_level(read_fap(every_take))[::3]
    frames, _ = play(every_take, face, tmp_path, "--frames", "::3")
    moved = motion_of(frames, face)
    still = ~values.any(axis=1)
    assert (moved[still] == 0).all()
    assert (moved[~still] > 0).all()
    assert 0.02 < moved.max() < 0.2
    # The lower lip never drags the upper one: recorded lips that press overlap a little.
    opened, rest = gap(face, frames), gap(face, face.mesh.vertices[None])
    assert opened.min() > rest - 0.02 * face.mesh.size
    assert opened.max() > rest + 0.03 * face.mesh.size


@pytest.mark.parametrize("take", ["joy", "anger"])
def test_a_recorded_file_is_written_back_equal(take: str, shared_data: Path, tmp_path: Path) -> None:
    assert main(["fap", str(shared_data / f"{take}.fap"), "--out", str(tmp_path / "again.fap"), "--quiet"]) == 0
    before = [line.split() for line in (shared_data / f"{take}.fap").read_text().splitlines()]
    after = [line.split() for line in (tmp_path / "again.fap").read_text().splitlines()]
    assert after == [words for words in before if words]


@pytest.mark.parametrize("name", FACES)
def test_joy_smiles_and_anger_lowers_the_brows(
    name: str, faces: dict[str, RealFace], shared_data: Path, tmp_path: Path
) -> None:
    face = faces[name]
    looked_at, heights = ("8.3", "8.4", "4.1", "4.2"), {}
    for take in ("joy", "anger"):
        frames, _ = play(shared_data / f"{take}.fap", face, tmp_path, "--frames", "20:80:4")
        risen = face.places(frames, *looked_at) - face.places(face.mesh.vertices[None], *looked_at)
        heights[take] = risen.mean(axis=0)[:, 1] / face.mesh.size
    assert (heights["joy"][:2] > 0.004).all()
    assert (heights["joy"][:2] > heights["anger"][:2]).all()
    assert (heights["anger"][2:] < -0.001).all()
    assert (heights["anger"][2:] < heights["joy"][2:]).all()


@pytest.mark.parametrize("name", FACES)
@pytest.mark.parametrize("recording", ["jmtech", "alex_rom_3"])
def test_live_link_recordings_play(
    name: str, recording: str, faces: dict[str, RealFace], shared_data: Path, tmp_path: Path
) -> None:
    face = faces[name]
    frames, report = play(shared_data / f"{recording}.csv", face, tmp_path, "--frames", "::20")
    assert report["motion"]["format"] == "ARKit weights"
    assert report["motion"]["fps"] == pytest.approx({"jmtech": 60, "alex_rom_3": 30}[recording], rel=0.01)
    moved = motion_of(frames, face)
    assert 0.03 < moved.max() < 0.3
    opened = gap(face, frames)
    assert opened.max() - opened.min() > 0.04 * face.mesh.size
    lids = gap(face, frames, "3.1", "3.3")
    rest = gap(face, face.mesh.vertices[None], "3.1", "3.3")[0]
    assert lids.min() < 0.6 * rest
    assert lids.min() > -0.02 * rest


@pytest.mark.parametrize("name", FACES)
def test_recorded_markers_play(name: str, faces: dict[str, RealFace], shared_data: Path, tmp_path: Path) -> None:
    face = faces[name]
    frames, report = play(shared_data / "animface_jaw.trc", face, tmp_path, "--frames", "1::15")
    assert (report["motion"]["format"], report["motion"]["units"]) == ("markers", "mm")
    assert report["markers"]["head"]["residual"] < 1.0
    moved = motion_of(frames, face)
    assert moved[0] < 1e-9  # the first frame is the neutral one
    assert 0.05 < moved.max() < 0.3
    widest = moved.argmax()
    assert gap(face, frames)[widest] > gap(face, frames)[0] + 0.05 * face.mesh.size


@pytest.mark.parametrize("recording", ["jmtech.csv", "animface_jaw.trc"])
def test_recordings_become_faps_that_stay_the_same(recording: str, shared_data: Path, tmp_path: Path) -> None:
    for source, out in ((shared_data / recording, tmp_path / "a.fap"), (tmp_path / "a.fap", tmp_path / "b.fap")):
        assert main(["fap", str(source), "--out", str(out), "--quiet"]) == 0
    assert (tmp_path / "b.fap").read_bytes() == (tmp_path / "a.fap").read_bytes()


@pytest.mark.parametrize("name", FACES)
def test_lids_close_at_1024(name: str, faces: dict[str, RealFace], tmp_path: Path) -> None:
    face = faces[name]
    values = np.zeros((2, 68))
    values[1, 18:20] = 1024
    write_fap(stream_of_values("blink", 25, values), tmp_path / "blink.fap")
    frames, _ = play(tmp_path / "blink.fap", face, tmp_path)
    for upper, lower in (("3.1", "3.3"), ("3.2", "3.4")):
        if upper in face.points.names:
            open_eye, shut_eye = gap(face, frames, upper, lower)
            assert abs(shut_eye) < 0.01 * open_eye
