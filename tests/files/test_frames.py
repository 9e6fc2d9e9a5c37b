"""Frames on disk: every format gives back what it was given."""

from __future__ import annotations

import struct

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.files.frames import read_frames, write_frames
from facial_retarget_addon.files.meshes import read_mesh

from .conftest import dome

NAMES = ["frames.npz", "frames.pc2", "frames.mdd", "frames"]


def some_frames(count: int = 37, vertices: int = 11) -> np.ndarray:
    return np.random.default_rng(2).normal(size=(count, vertices, 3)).astype(np.float32)


@pytest.mark.parametrize("name", NAMES)
def test_writing_and_reading_gives_the_same_frames(tmp_path, name):
    frames = some_frames()
    write_frames(frames, tmp_path / name)
    again = read_frames(tmp_path / name, 11)
    assert again.dtype == np.float32
    np.testing.assert_array_equal(again, frames)


@pytest.mark.parametrize("name", ["frames.npz", "frames.pc2"])
def test_frames_of_single_precision_are_mapped_and_read_only(tmp_path, name):
    write_frames(some_frames(), tmp_path / name)
    frames = read_frames(tmp_path / name, 11)
    assert isinstance(frames, np.memmap)
    assert not frames.flags.writeable


def test_frames_of_double_precision_and_compressed_ones_are_read(tmp_path):
    frames = some_frames().astype(np.float64)
    np.savez(tmp_path / "a.npz", frames=frames)
    np.savez_compressed(tmp_path / "b.npz", frames=np.asfortranarray(frames), other=frames)
    for name in ("a.npz", "b.npz"):
        np.testing.assert_array_equal(read_frames(tmp_path / name, 11), frames.astype(np.float32))


def test_the_bytes_of_a_pc2_file(tmp_path):
    write_frames(np.array([[[1, 2, 3]], [[4, 5, 6]]]), tmp_path / "f.pc2")
    assert (tmp_path / "f.pc2").read_bytes() == b"POINTCACHE2\0" + struct.pack("<iiffi6f", 1, 1, 1, 1, 2, *range(1, 7))


def test_the_bytes_of_an_mdd_file(tmp_path):
    write_frames(np.array([[[1, 2, 3]], [[4, 5, 6]]]), tmp_path / "f.mdd")
    assert (tmp_path / "f.mdd").read_bytes() == struct.pack(">ii2f6f", 2, 1, 0, 1 / 24, *range(1, 7))
    write_frames(np.zeros((2, 1, 3)), tmp_path / "f.mdd", fps=50)
    assert struct.unpack(">2f", (tmp_path / "f.mdd").read_bytes()[8:16]) == pytest.approx((0, 0.02))


def test_the_same_frames_give_the_same_bytes(tmp_path):
    for name in ("a.npz", "b.npz"):
        write_frames(some_frames(), tmp_path / name)
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()


def test_a_folder_is_read_in_natural_order(tmp_path):
    (tmp_path / "take").mkdir()
    for number in (10, 9, 2):
        (tmp_path / "take" / f"head{number}.OBJ").write_text(f"v {number} 0 0\nf 1 1 1\n")
    (tmp_path / "take" / "notes.txt").write_text("not a frame")
    assert read_frames(tmp_path / "take", 1)[:, 0, 0].tolist() == [2, 9, 10]


def test_frames_in_a_folder_can_carry_the_faces(tmp_path):
    mesh = dome(4)
    write_frames(mesh.mesh.vertices[None], tmp_path / "take", (mesh.counts, mesh.corners))
    np.testing.assert_array_equal(read_mesh(tmp_path / "take" / "frame_0001.obj").corners, mesh.corners)


@pytest.mark.parametrize("name", NAMES)
def test_another_vertex_count(tmp_path, name):
    write_frames(some_frames(), tmp_path / name)
    with pytest.raises(RetargetError, match=r"shape \(37, 11, 3\), expected \(frames, 12, 3\)"):
        read_frames(tmp_path / name, 12)


def test_a_frame_of_a_folder_with_another_vertex_count(tmp_path):
    write_frames(some_frames(3), tmp_path / "take")
    (tmp_path / "take" / "frame_0002.obj").write_text("v 0 0 0\n")
    with pytest.raises(RetargetError, match=r"frame_0002.obj has 1 vertices, expected 11 as in frame_0001.obj"):
        read_frames(tmp_path / "take", 11)


@pytest.mark.parametrize("name", NAMES[:3])
def test_a_file_that_was_cut_off(tmp_path, name):
    write_frames(some_frames(), tmp_path / name)
    whole = (tmp_path / name).read_bytes()
    for length in (0, 7, 60, len(whole) - 40):
        (tmp_path / name).write_bytes(whole[:length])
        with pytest.raises(RetargetError, match=name):
            read_frames(tmp_path / name, 11)


def test_no_frames_at_all(tmp_path):
    (tmp_path / "take").mkdir()
    with pytest.raises(RetargetError, match=r"holds no .obj files"):
        read_frames(tmp_path / "take", 11)
    write_frames(np.empty((0, 11, 3)), tmp_path / "f.npz")
    with pytest.raises(RetargetError, match=r"\(0, 11, 3\)"):
        read_frames(tmp_path / "f.npz", 11)


def test_another_suffix(tmp_path):
    with pytest.raises(RetargetError, match=r"frames .* are a .abc, expected one of .npz, .pc2, .mdd or a folder"):
        read_frames(tmp_path / "f.abc", 3)
    with pytest.raises(RetargetError, match="expected one of"):
        write_frames(some_frames(), tmp_path / "f.abc")
