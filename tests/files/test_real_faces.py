"""The command line on real faces: a dense head onto another artist's head and onto a one-eyed ogre."""

import json
from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.cli import main

OGRE_POINTS = Path(__file__).resolve().parents[1] / "data" / "ogre_points.json"
EXPRESSIONS = ("eyeBlink_L", "jawOpen", "mouthSmile_L", "browInnerUp_L", "noseSneer_R", "mouthPucker", "mouthFrown_L")


def write_job(folder: Path, data: Path, target: str, points: Path) -> Path:
    """ICT's own expressions, then its neutral, onto a target."""
    source, goal = np.load(data / "ict_dev.npz"), np.load(data / f"{target}.npz")
    names = [str(name) for name in source["expr_names"]]
    moves = [source["expr_delta"][names.index(name)] for name in EXPRESSIONS] + [0 * source["vertices"]]
    np.savez(folder / "source.npz", vertices=source["vertices"], faces=source["tris"])
    np.savez(folder / "target.npz", vertices=goal["vertices"], faces=goal["tris"])
    np.savez(folder / "frames.npz", frames=(source["vertices"] + np.stack(moves)).astype(np.float32))
    (folder / "source_points.json").write_text((data / "ict_points.json").read_text())
    (folder / "target_points.json").write_text(points.read_text())
    job = folder / "job.toml"
    job.write_text(
        'version = 1\nmethod = "hierarchical"\n'
        '[source]\nneutral = "source.npz"\nframes = "frames.npz"\npoints = "source_points.json"\n'
        '[target]\nneutral = "target.npz"\npoints = "target_points.json"\n'
        '[output]\nframes = "out.npz"\nreport = "report.json"\n'
    )
    return job


@pytest.mark.parametrize("target", ["makehuman_dev", "ogre"])
def test_a_dense_head_acts_on_another(target: str, tmp_path: Path, shared_data: Path) -> None:
    points = OGRE_POINTS if target == "ogre" else shared_data / "makehuman_points.json"
    job = write_job(tmp_path, shared_data, target, points)
    assert main(["--quiet", "run", str(job)]) == 0
    frames = np.load(tmp_path / "out.npz")["frames"]
    rest = np.load(tmp_path / "target.npz")["vertices"].astype(np.float32)
    size = np.ptp(rest, axis=0).max()
    np.testing.assert_array_equal(frames[-1], rest)
    moved = np.linalg.norm(frames[:-1] - rest, axis=2).max(axis=1)
    blinks = 0 if target == "ogre" else 1  # his one eye has points of its own, which ICT lacks
    assert (moved[1 - blinks :] > 0.005 * size).all()
    assert moved.max() < 0.35 * size
    report = json.loads((tmp_path / "report.json").read_text())
    assert report["quality"]["torn_edges_per_million"] < 60
    assert report["quality"]["neutral_drift"] == 0
