"""ARKit face weights on disk: Live Link Face's recordings and plain tables."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mpeg4.arkit_take import ArkitTake
from facial_retarget_addon.files.motion.arkit_csv import WEIGHTS, read_arkit_csv, write_arkit_csv
from facial_retarget_addon.files.motion.stream import read_stream
from facial_retarget_addon.files.motion.timecode import Clock, timecode_seconds

RECORDINGS = {"alex_rom_3.csv": "livelink_alex_rom_3.npz", "jmtech.csv": "livelink_jmiller.npz"}
PATH = Path("take.csv")


def take(frames: int = 7, fps: float = 30.0, timecodes: tuple[str, ...] = ()) -> ArkitTake:
    random = np.random.default_rng(4)
    values = random.random((frames, 61)).round(10)
    return ArkitTake("take", fps, values[:, :52], values[:, 52:55], values[:, 55:], timecodes)


def plain(names: list[str], rows: np.ndarray) -> str:
    return "\n".join([",".join(names), *(",".join(f"{x:.9f}" for x in row) for row in rows)]) + "\n"


def assert_equal(a: ArkitTake, b: ArkitTake) -> None:
    assert a.fps == pytest.approx(b.fps, rel=1e-6)
    for part in ("weights", "head", "eyes"):
        np.testing.assert_allclose(getattr(a, part), getattr(b, part), atol=1e-10, rtol=0, err_msg=part)


@pytest.mark.parametrize("name", RECORDINGS)
def test_the_columns_are_those_of_real_recordings(shared_data, tmp_path, name):
    write_arkit_csv(take(), tmp_path / PATH)
    headers = [path.read_text().partition("\n")[0].strip() for path in (tmp_path / PATH, shared_data / name)]
    assert headers[0] == headers[1]


@pytest.mark.parametrize("name", RECORDINGS)
def test_real_recordings(shared_data, tmp_path, name):
    known = np.load(shared_data / RECORDINGS[name])
    read = read_arkit_csv(shared_data / name)
    there = np.delete(np.arange(len(read)), read.filled)
    assert [read.timecodes[frame] for frame in there] == known["timecode"].tolist()
    np.testing.assert_allclose(read.weights[there], known["weights"], atol=1e-7)
    np.testing.assert_allclose(np.concatenate([read.head, read.eyes], axis=1)[there], known["rot"], atol=1e-7)
    assert read.fps == pytest.approx(float(known["fps"]), rel=1e-6)
    # Real clocks miss the standard rate a little: half a frame in two minutes.
    np.testing.assert_allclose(there / read.fps, known["time"], atol=0.02)
    write_arkit_csv(read, tmp_path / name)
    again = read_arkit_csv(tmp_path / name)
    assert_equal(again, read)
    assert (again.timecodes, again.filled) == (read.timecodes, ())


def test_frames_that_a_recording_left_out(shared_data):
    filled = read_arkit_csv(shared_data / "alex_rom_3.csv")
    kept = read_arkit_csv(shared_data / "alex_rom_3.csv", gaps="keep")
    assert (len(filled), len(filled.filled), len(kept), len(kept.filled)) == (4033, 3, 4030, 0)
    first = filled.filled[0]
    np.testing.assert_allclose(filled.weights[first], filled.weights[[first - 1, first + 1]].mean(axis=0), atol=1e-12)
    assert filled.timecodes[first - 1 : first + 2] == ("13:13:24:21.492", "13:13:24:23.492", "13:13:24:25.491")
    _, report = read_stream(shared_data / "alex_rom_3.csv")
    assert report["warnings"] == ["3 frames that the recording left out are filled along straight lines"]


@pytest.mark.parametrize("fps", [24, 25, 30000 / 1001, 30, 60000 / 1001, 60, 120])
def test_a_take_without_timecodes_keeps_its_rate(tmp_path, fps):
    for frames in (2, 200):
        write_arkit_csv(take(frames, fps), tmp_path / PATH)
        assert_equal(read_arkit_csv(tmp_path / PATH), take(frames, fps))


def test_a_take_without_rotations(tmp_path):
    bare = ArkitTake("bare", 60.0, take().weights, None, None)
    write_arkit_csv(bare, tmp_path / PATH)
    read = read_arkit_csv(tmp_path / PATH)
    np.testing.assert_array_equal(read.weights, bare.weights)
    assert not read.head.any()


def test_a_plain_table_in_any_order_and_case(tmp_path):
    weights = take().weights
    order = np.random.default_rng(3).permutation(52)
    names = [WEIGHTS[i].upper() if i % 2 else WEIGHTS[i][0].lower() + WEIGHTS[i][1:] for i in order]
    times = np.arange(len(weights)) / 50
    (tmp_path / PATH).write_text(
        plain(["Time (s)", "note", *names], np.column_stack([times, times, weights[:, order]]))
    )
    read = read_arkit_csv(tmp_path / PATH)
    assert (read.fps, read.head, read.eyes, read.timecodes) == (50, None, None, ())
    np.testing.assert_allclose(read.weights, weights, atol=1e-9)


def test_a_plain_table_without_times_needs_a_rate(tmp_path):
    weights = take().weights
    text = plain([*WEIGHTS], weights)
    (tmp_path / PATH).write_text(text)
    with pytest.raises(RetargetError, match="has no times, expected a column of seconds"):
        read_arkit_csv(tmp_path / PATH)
    assert read_arkit_csv(tmp_path / PATH, fps=48).fps == 48
    (tmp_path / PATH).write_text("# fps: 24\n" + text)
    assert read_arkit_csv(tmp_path / PATH).fps == 24


def test_semicolons_with_decimal_commas(tmp_path):
    weights = take().weights
    (tmp_path / PATH).write_text(plain([*WEIGHTS], weights).replace(",", ";").replace(".", ","))
    np.testing.assert_allclose(read_arkit_csv(tmp_path / PATH, fps=30).weights, weights, atol=1e-9)


def test_frame_numbers_tell_what_is_missing(tmp_path):
    weights = take(4).weights
    (tmp_path / PATH).write_text(plain(["Frame", *WEIGHTS], np.column_stack([[10, 11, 13, 14], weights])))
    read = read_arkit_csv(tmp_path / PATH, fps=30)
    assert read.filled == (2,)
    np.testing.assert_allclose(read.weights, np.insert(weights, 2, weights[1:3].mean(axis=0), axis=0), atol=1e-9)


def test_a_face_out_of_sight(tmp_path):
    write_arkit_csv(take(), tmp_path / PATH)
    lines = (tmp_path / PATH).read_text().splitlines()
    lines[4] = lines[4].split(",")[0] + ",0" + "," * 61
    (tmp_path / PATH).write_text("\n".join(lines))
    read = read_arkit_csv(tmp_path / PATH)
    assert read.filled == (3,)
    np.testing.assert_allclose(read.weights[3], take().weights[[2, 4]].mean(axis=0), atol=1e-9)


@pytest.mark.parametrize("clock", [Clock(24), Clock(30), Clock(60), Clock(30, True), Clock(60, True)])
def test_timecodes_and_seconds_are_the_same_thing(clock):
    seconds = np.concatenate([s + np.arange(200) / clock.rate for s in (0, 59, 599, 3600 * 5 + 61, 23 * 3600)])
    timecodes = [clock.text(second) for second in seconds]
    assert len(set(timecodes)) == len(seconds)
    back, found = timecode_seconds(PATH, timecodes)
    assert found == clock
    np.testing.assert_allclose(back, seconds, atol=1e-3 / clock.base)


def test_the_drop_frame_clock_leaves_numbers_out():
    clock = Clock(30, drop=True)
    assert clock.text(1799 * 1.001 / 30) == "00:00:59;29.000"
    assert clock.text(1800 * 1.001 / 30) == "00:01:00;02.000"
    assert clock.text(17982 * 1.001 / 30) == "00:10:00;00.000"


def test_midnight(tmp_path):
    clock = Clock(60)
    codes = tuple(clock.text(24 * 3600 - 0.1 + i / 30) for i in range(7))
    write_arkit_csv(take(timecodes=codes), tmp_path / PATH)
    read = read_arkit_csv(tmp_path / PATH)
    assert (read.fps, read.timecodes) == (30, codes)


def table(**changes: str) -> str:
    """A sound table of three frames with some words replaced."""
    weights = np.full((3, 52), 0.5)
    text = plain(["time", *WEIGHTS], np.column_stack([[0, 0.02, 0.04], weights]))
    for old, new in changes.items():
        text = text.replace(old, new)
    return text


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "is empty"),
        ("\n\n", "has no header"),
        ("a,b\n1,2\n", "none of its columns is named like one of the 52 weights"),
        (table(JawOpen="jaw", TongueOut="tongue"), "has no column JawOpen, TongueOut$"),
        (table().replace("time,", "HeadYaw,"), "has no column HeadPitch, HeadRoll"),
        (table().splitlines()[0], "has no frames"),
        (table().replace("0.040000000", "0.020000000"), "time of frame 3 is not after"),
        (table().replace("0.040000000", "nan"), "time of frame 3 is not after"),
        (table().replace("0.040000000", "1e9"), "frames are missing between 3"),
        (table().replace("0.040000000", "inf"), "line 4 has inf, expected at most"),
        (table().replace("0.02", "0.00001").replace("0.04", "0.00002"), "expected a number from 1 to 10000"),
        (table().replace("0.5", "50."), "expected weights from 0 to 1"),
        (table().replace("0.500000000\n", "nan\n", 1), "line 2 has a value that is missing"),
        (table().replace("0.500000000\n", "half\n", 1), "line 2 has 'half', expected a number"),
        (table().replace("0.500000000\n", "0.5,1\n", 1), "line 2 has 54 cells, expected 53"),
        (table().replace("time", "Timecode"), "has the timecode '0.000000000'"),
        ("\n".join(table().splitlines()[:2]), "has 1 frames, expected at least two"),
    ],
)
def test_malformed_files_are_named_in_one_sentence(tmp_path, text, said):
    (tmp_path / PATH).write_text(text)
    with pytest.raises(RetargetError, match=said) as caught:
        read_arkit_csv(tmp_path / PATH)
    assert "\n" not in str(caught.value)


def test_a_take_that_cannot_be_written(tmp_path):
    broken = take()
    broken.weights[3, 4] = np.inf
    with pytest.raises(RetargetError, match="not finite"):
        write_arkit_csv(broken, tmp_path / PATH)
    assert not (tmp_path / PATH).exists()
