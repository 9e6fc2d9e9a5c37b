"""Marker files: the same take comes out of every format, with its gaps."""

from __future__ import annotations

import struct
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from c3d import Writer

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.markers.take import MarkerTake
from facial_retarget_addon.files.motion.markers import read_markers

pytestmark = pytest.mark.filterwarnings("ignore:No analog data:UserWarning")

NAMES = ("LBrow", "chin middle", "Nose")
FRAMES, FPS = 9, 50.0


def positions() -> np.ndarray:
    """Motion with gaps, on the grid of a number that every format can hold."""
    found = np.random.default_rng(5).integers(-2000, 2000, (FRAMES, len(NAMES), 3)) / 4.0
    found[3, 1] = found[4, 1] = found[8, 0] = found[0, 2] = np.nan
    return found


def cells(row: np.ndarray) -> list[str]:
    return ["" if np.isnan(x) else f"{x:.3f}" for x in row.ravel()]


def trc(path: Path, end: str = "\n", units: str = "mm") -> None:
    times = np.arange(FRAMES) / FPS
    lines = [
        ["PathFileType", "4", "(X/Y/Z)", path.name],
        ["DataRate", "CameraRate", "NumFrames", "NumMarkers", "Units"],
        [f"{FPS:g}", f"{FPS:g}", str(FRAMES), str(len(NAMES)), units],
        ["Frame#", "Time", *(cell for name in NAMES for cell in (f" {name} ", "", ""))],
        ["", "", *(f"{axis}{number}" for number in (1, 2, 3) for axis in "XYZ")],
        [],
        *([str(number + 1), f"{times[number]:.5f}", *cells(row)] for number, row in enumerate(positions())),
    ]
    path.write_bytes((end.join("\t".join(line) for line in lines) + end).encode())


def c3d(path: Path, scale: float = -1.0, units: str = "mm") -> None:
    writer = Writer(point_rate=FPS, analog_rate=0, point_scale=scale, point_units=units)
    for row in positions():
        seen = np.isfinite(row).all(axis=1)
        points = np.zeros((len(NAMES), 5), np.float32)
        points[seen, :3], points[~seen, 3] = row[seen], -1
        writer.add_frames((points, np.zeros((0, 0))))
    writer.set_point_labels([*NAMES])
    writer.set_analog_labels([""])
    with open(path, "wb") as file:
        writer.write(file)


def table(path: Path, form: str = "{}_{}", separator: str = ",", settings: str = "units, mm\n") -> None:
    header = ["Frame", "Time", *(form.format(name, axis) for name in NAMES for axis in "xyz")]
    rows = [[str(i), f"{i / FPS:.6f}", *cells(row)] for i, row in enumerate(positions())]
    text = "\n".join(separator.join(row) for row in [header, *rows])
    path.write_text(settings + (text.replace(".", ",") if separator == ";" else text))


def assert_is_the_take(read: MarkerTake, units: str = "mm") -> None:
    assert (read.name, read.names, read.fps, read.units, len(read)) == ("take", NAMES, FPS, units, FRAMES)
    np.testing.assert_array_equal(read.positions, positions())


WRITERS: dict[str, Callable[[Path], None]] = {"take.trc": trc, "take.c3d": c3d, "take.csv": table}


@pytest.mark.parametrize("name", WRITERS)
def test_every_format_gives_the_same_take(tmp_path, name):
    WRITERS[name](tmp_path / name)
    assert_is_the_take(read_markers(tmp_path / name))


def test_variants_of_the_formats(tmp_path):
    trc(tmp_path / "take.trc", end="\r\n")
    assert_is_the_take(read_markers(tmp_path / "take.trc"))
    trc(tmp_path / "take.trc", end="\t\n")
    assert_is_the_take(read_markers(tmp_path / "take.trc"))
    c3d(tmp_path / "take.c3d", scale=0.25, units="cm")
    assert_is_the_take(read_markers(tmp_path / "take.c3d"), "cm")
    for form, separator in (("{}.{}", ","), ("{}:{}", ";"), ("{} {}", "\t")):
        table(tmp_path / "take.csv", form, separator)
        assert_is_the_take(read_markers(tmp_path / "take.csv"))


def test_a_real_take(shared_data):
    read, known = read_markers(shared_data / "animface_jaw.trc"), np.load(shared_data / "animface_jaw.npz")
    assert (read.names, read.fps, read.units) == (tuple(known["markers"]), known["fps"], "mm")
    np.testing.assert_allclose(read.positions, 10 * known["positions"], atol=1e-3)  # kept in centimetres


def test_markers_without_a_label(tmp_path):
    c3d(tmp_path / "take.c3d")
    content = (tmp_path / "take.c3d").read_bytes()
    (tmp_path / "take.c3d").write_bytes(content.replace(b"chin middle", b" " * 11))
    assert read_markers(tmp_path / "take.c3d").names == ("LBrow", "marker 2", "Nose")


def test_rows_that_a_table_leaves_out_are_gaps(tmp_path):
    table(tmp_path / "take.csv")
    lines = (tmp_path / "take.csv").read_text().splitlines()
    (tmp_path / "take.csv").write_text("\n".join(lines[:4] + lines[5:]))
    read = read_markers(tmp_path / "take.csv")
    assert len(read) == FRAMES
    assert np.isnan(read.positions[2]).all()
    np.testing.assert_array_equal(np.delete(read.positions, 2, axis=0), np.delete(positions(), 2, axis=0))


def test_rates_of_tables_without_times(tmp_path):
    text = "chin_x,chin_y,chin_z\n1,2,3\n4,5,6\n"
    for setting in ("# fps: 120\n", "DataRate,120\n", "frame rate = 120\n", '"FPS","120"\n'):
        (tmp_path / "take.csv").write_text(setting + text)
        read = read_markers(tmp_path / "take.csv")
        assert (read.fps, read.names) == (120, ("chin",))
    (tmp_path / "take.csv").write_text(text)
    with pytest.raises(RetargetError, match="no times, expected a column of seconds or the frames a second"):
        read_markers(tmp_path / "take.csv")


ARM = """HIERARCHY
ROOT Hips
{
  OFFSET 9 9 9
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Left Arm {
    OFFSET 0 2 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 0 3
    }
  }
  JOINT Ball
  {
    OFFSET 1 0 0
    CHANNELS 1 Yposition
    End Site
    {
      OFFSET 0 1 0
    }
  }
}
MOTION
Frames: 4
Frame Time: 0.0333333
0 0 0 0 0 0 0 0 0 0
1 2 3 0 0 0 0 0 0 5
0 0 0 90 0 0 0 90 0 0
0 0 0 90 90 0 0 0 90 0
"""


def test_joints_are_where_their_channels_turn_them(tmp_path):
    (tmp_path / "arm.bvh").write_text(ARM)
    read = read_markers(tmp_path / "arm.bvh")
    assert (read.fps, read.names) == (30, ("Hips", "Left Arm", "Left Arm end", "Ball", "Ball end"))
    expected = [
        # at rest: the root where its channels say, not at its offset
        [[0, 0, 0], [0, 2, 0], [0, 2, 3], [1, 0, 0], [1, 1, 0]],
        # moved; the ball's position channel replaces its offset on that axis alone
        [[1, 2, 3], [1, 4, 3], [1, 4, 6], [2, 7, 3], [2, 8, 3]],
        # z by a quarter turn: up goes to -x; then the arm about its own x: forward goes to -y, which is +x outside
        [[0, 0, 0], [-2, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 1, 0]],
        # z, then x about the turned axis: up goes forward; then the arm about its own y: forward goes to its x
        [[0, 0, 0], [0, 0, 2], [0, 3, 2], [0, 1, 0], [0, 1, 1]],
    ]
    np.testing.assert_allclose(read.positions, expected, atol=1e-9)


def cut(text: str, old: str, new: str) -> str:
    assert old in text
    return text.replace(old, new, 1)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("HIERARCHY", "SKELETON", "is no BVH file"),
        ("MOTION", "MOTIONS", "is no BVH file"),
        ("Frames: 4", "Frames: 1000000000", "says 1000000000 frames, but 4 follow"),
        ("Frames: 4", "Frames: many", "does not start with 'Frames:"),
        ("0.0333333", "0", "does not start with 'Frames:"),
        ("0.0333333", "-1", "does not start with 'Frames:"),
        ("0.0333333", "nan", "does not start with 'Frames:"),
        ("0.0333333", "1e-9", "expected a number from 1 to 10000"),
        ("CHANNELS 3", "CHANNELS 2", "line 8 has 'CHANNELS 2"),
        ("Zrotation", "Wrotation", "line 5 has the channel 'Wrotation', expected a position or rotation"),
        ("OFFSET 1 0 0", "CHANNELS 1 Xposition", "line 17 has 'CHANNELS 1 Yposition'"),
        ("JOINT Ball", "JOINT Hips", "'Hips' appears twice"),
        ("OFFSET 0 2 0", "OFFSET 0 two 0", "line 7 has 'two'"),
        ("}\nMOTION", "MOTION", "ends inside joint 'Hips'"),
        ("1 2 3 0 0 0", "1 2 3 0 0", "has 9 values, expected 10"),
        ("1 2 3 0 0 0", "1 2 inf 0 0 0", "line 28 has inf"),
        ("1 2 3 0 0 0", "1 2 nan 0 0 0", "has an offset or a channel that is no number"),
        ("OFFSET 0 2 0", "OFFSET 0 nan 0", "has an offset or a channel that is no number"),
    ],
)
def test_malformed_skeletons(tmp_path, old, new, said):
    (tmp_path / "arm.bvh").write_text(cut(ARM, old, new))
    with pytest.raises(RetargetError, match=said) as caught:
        read_markers(tmp_path / "arm.bvh")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("name", "old", "new", "said"),
    [
        ("take.trc", "PathFileType", "File", "is no TRC file"),
        ("take.trc", f"\t{FRAMES}\t", "\t1000000000\t", "says '1000000000' frames, but 9 follow"),
        ("take.trc", "\t3\tmm", "\t4\tmm", "says '4' markers, but 3 follow"),
        ("take.trc", "\n50\t", "\n0\t", "'0' frames a second"),
        ("take.trc", "\n50\t", "\n-50\t", "'-50' frames a second"),
        ("take.trc", "\n50\t", "\nnan\t", "'nan' frames a second"),
        ("take.trc", "\n50\t", "\n20000\t", "'20000' frames a second"),
        ("take.trc", "\n50\t", "\n60\t", "says 60 frames a second, but its 9 frames last 0.16 s .* expected 0.133"),
        ("take.trc", "0.04000", "zero", "line 9 has 'zero', expected a number"),
        ("take.trc", "0.16000", "", "says 50 frames a second"),
        ("take.trc", "LBrow", "Nose", "'Nose' appears twice"),
        ("take.trc", "0.04000\t", "0.04000\t1\t", "line 9 has 12 values, expected 11"),
        ("take.csv", "Nose_x", "Nose", "marker 'Nose' has no column for x"),
        ("take.csv", "Nose_x", "Nose.y", "column 'Nose_y' twice"),
        ("take.csv", "0.040000", "0.000000", "the time of frame 3 is not after"),
        ("take.csv", "0.160000", "1.600000", "frames are missing between 9"),
        ("take.csv", "units, mm\n", "fps, 60\n", "says 60 frames a second, but its times are those of 50"),
        ("take.csv", "0.040000,", "0.040000,1,", "line 5 has 12 cells, expected 11"),
    ],
)
def test_malformed_tables(tmp_path, name, old, new, said):
    WRITERS[name](tmp_path / name)
    (tmp_path / name).write_text(cut((tmp_path / name).read_text(), old, new))
    with pytest.raises(RetargetError, match=said) as caught:
        read_markers(tmp_path / name)
    assert "\n" not in str(caught.value)


def test_a_coordinate_that_is_infinite(tmp_path):
    (tmp_path / "take.csv").write_text("fps,30\nchin_x,chin_y,chin_z\n1,2,3\n4,1e999,6\n")
    with pytest.raises(RetargetError, match="line 4 has inf, expected at most"):
        read_markers(tmp_path / "take.csv")


def test_c3d_files_that_claim_too_much(tmp_path):
    c3d(tmp_path / "take.c3d")
    content = bytearray((tmp_path / "take.c3d").read_bytes())
    (tmp_path / "take.c3d").write_bytes(content[:-512])
    with pytest.raises(RetargetError, match="says 9 frames of 3 markers, but ends before them"):
        read_markers(tmp_path / "take.c3d")
    at = content.index(b"ACTUAL_END_FIELD") + 21
    content[at : at + 4] = b"\xff" * 4
    (tmp_path / "take.c3d").write_bytes(content)
    with pytest.raises(RetargetError, match="says 4294967295 frames of 3 markers, but ends before them"):
        read_markers(tmp_path / "take.c3d")


def numbered(path: Path, first: int, last: int, more: int = 0) -> None:
    """A C3D file whose frames have other numbers, and room for more of them."""
    c3d(path)
    content = bytearray(path.read_bytes())
    content[6:10] = struct.pack("<HH", min(first, 65535), min(last, 65535))
    for name, number in ((b"ACTUAL_START_FIELD", first), (b"ACTUAL_END_FIELD", last)):
        at = content.index(name) + len(name) + 5
        content[at : at + 4] = struct.pack("<I", number)
    path.write_bytes(bytes(content) + bytes(more * len(NAMES) * 16))


def test_c3d_files_of_long_takes(tmp_path):
    for first in (1, 60000, 70000, 200000):
        numbered(tmp_path / "take.c3d", first, first + FRAMES - 1)
        assert_is_the_take(read_markers(tmp_path / "take.c3d"))
    numbered(tmp_path / "take.c3d", 1, 65535, 65600)
    with pytest.raises(RetargetError, match="has more frames than the 65535 that its header can say"):
        read_markers(tmp_path / "take.c3d")
    numbered(tmp_path / "take.c3d", 1, 65600, 65600)
    assert len(read_markers(tmp_path / "take.c3d")) == 65600


def with_other_numbers(path: Path, old: float, new: float) -> None:
    """A C3D file in which a number has another value wherever it stands."""
    c3d(path)
    content = path.read_bytes()
    assert struct.pack("<f", old) in content
    path.write_bytes(content.replace(struct.pack("<f", old), struct.pack("<f", new)))


@pytest.mark.parametrize("fps", [0.0, -50.0, float("nan"), float("inf"), 20000.0])
def test_c3d_files_of_a_wrong_rate(tmp_path, fps):
    with_other_numbers(tmp_path / "take.c3d", FPS, fps)
    with pytest.raises(RetargetError, match=r"frames a second, expected a number from 1 to 10000|inconsistent .* rate"):
        read_markers(tmp_path / "take.c3d")


def test_a_marker_that_is_too_far_away(tmp_path):
    with_other_numbers(tmp_path / "take.c3d", float(positions()[1, 2, 0]), 1e30)
    with pytest.raises(RetargetError, match=r"marker 'Nose' is farther than 1e\+15 away in frame 2"):
        read_markers(tmp_path / "take.c3d")


def test_another_suffix(tmp_path):
    with pytest.raises(RetargetError, match=r"are a \.fbx, expected \.trc, \.c3d, \.bvh, \.csv"):
        read_markers(tmp_path / "take.fbx")
