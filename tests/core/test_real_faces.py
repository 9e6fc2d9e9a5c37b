"""What the methods that work level by level must reach on a real pair of heads whose truth is known."""

from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.methods.settings import SETTINGS
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.core.retarget import Result, retarget
from facial_retarget_addon.files.points import read_points

FACE_VERTICES = 9_409
BOUNDS = {"hierarchical": (0.08, 0.14, 0.10), "wavelet": (0.08, 0.14, 0.10)}
"""Method -> median and 90 % of the relative motion errors on the face, and their median on the whole head."""


@pytest.fixture(scope="module", params=BOUNDS)
def method(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def data(shared_data: Path) -> dict[str, np.ndarray]:
    archive = np.load(shared_data / "pair_ict_id02_to_id04_decim.npz")
    return {name: archive[name] for name in archive.files}


@pytest.fixture(scope="module")
def source(shared_data: Path, data: dict[str, np.ndarray]) -> Face:
    mesh = TriMesh(data["src_vertices"], data["src_tris"])
    return Face(mesh, read_points(shared_data / "pair_source_points.json", mesh))


@pytest.fixture(scope="module")
def target(shared_data: Path, data: dict[str, np.ndarray]) -> Face:
    mesh = TriMesh(data["tgt_vertices"], data["tgt_tris"])
    return Face(mesh, read_points(shared_data / "pair_target_points.json", mesh))


@pytest.fixture(scope="module")
def result(method: str, source: Face, target: Face, data: dict[str, np.ndarray]) -> Result:
    """All expressions, then a frame of no motion."""
    motion = np.concatenate([data["src_expr_delta"], np.zeros((1, *source.mesh.vertices.shape))])
    frames = (source.mesh.vertices + motion).astype(np.float32)
    return retarget(method, Problem(source, target), SETTINGS[method](), frames)


def relative_errors(found: np.ndarray, truth: np.ndarray) -> np.ndarray:
    error = np.linalg.norm((found - truth).reshape(len(truth), -1), axis=1)
    return error / np.linalg.norm(truth.reshape(len(truth), -1), axis=1)


def test_the_face_is_met(method: str, result: Result, target: Face, data: dict[str, np.ndarray]) -> None:
    face = (data["src_tris"][data["corr_src_face"]] < FACE_VERTICES).all(axis=1)
    found = result.frames[:-1, face] - target.mesh.vertices[face]
    errors = relative_errors(found, data["gt_expr_delta"][:, face])
    assert np.median(errors) <= BOUNDS[method][0]
    assert np.quantile(errors, 0.9) <= BOUNDS[method][1]


def test_the_whole_head_is_met(method: str, result: Result, target: Face, data: dict[str, np.ndarray]) -> None:
    errors = relative_errors(result.frames[:-1] - target.mesh.vertices, data["gt_expr_delta"])
    assert np.median(errors) <= BOUNDS[method][2]


def test_no_motion_is_no_motion(result: Result, target: Face) -> None:
    np.testing.assert_array_equal(result.frames[-1], target.mesh.vertices.astype(np.float32))


def test_nothing_tears(result: Result) -> None:
    assert result.report["quality"]["torn_edges_per_million"] <= 15


def test_a_face_onto_itself_is_itself(method: str, source: Face, data: dict[str, np.ndarray]) -> None:
    motion = data["src_expr_delta"][::6]
    frames = (source.mesh.vertices + motion).astype(np.float32)
    found = retarget(method, Problem(source, source), SETTINGS[method](), frames).frames
    assert relative_errors(found - source.mesh.vertices, motion).max() <= 0.03
