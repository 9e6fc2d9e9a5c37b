"""FAP streams on disk: what is written is read back, and every habit of other tools is met or named."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mpeg4.stream import FapStream
from facial_retarget_addon.files.motion.fap import read_fap, write_fap

XFACE_TAKES = ("anger", "beg", "disgust", "fear", "happy_for", "hate", "joy", "pride")


def mask(*faps: int) -> str:
    return " ".join("1" if number in faps else "0" for number in range(1, 69))


def stream(frames: int = 5, seed: int = 1, name: str = "AU 12 and 6") -> FapStream:
    """A stream whose masks change every frame, FAP 1 and 2 included."""
    random = np.random.default_rng(seed)
    used = random.random((frames, 68)) < 0.5
    used[0], used[1, :] = True, False
    values = np.where(used, random.integers(-2000, 2000, (frames, 68)), 0).astype(float)
    values[:, :2] = 0
    viseme = np.where(used[:, :1], random.integers(0, (15, 15, 64, 2), (frames, 4)), 0)
    expression = np.where(used[:, 1:2], random.integers(0, (7, 64, 7, 64, 2, 2), (frames, 6)), 0)
    return FapStream(name, 25.0, values, used, viseme, expression)


def written(path: Path, text: str) -> Path:
    path.write_bytes(text.encode())
    return path


def assert_equal(a: FapStream, b: FapStream) -> None:
    assert (a.name, a.fps, len(a)) == (b.name, b.fps, len(b))
    for part in ("values", "used", "viseme", "expression"):
        np.testing.assert_array_equal(getattr(a, part), getattr(b, part), err_msg=part)


@pytest.mark.parametrize("name", ["joy", "anger"])
def test_real_files_come_back_as_they_were(shared_data, tmp_path, name):
    read = read_fap(shared_data / f"{name}.fap")
    takes = np.load(shared_data / "mpeg4_fap_xface.npz")
    np.testing.assert_array_equal(read.values, takes[name])
    np.testing.assert_array_equal(read.used, takes[f"{name}_mask"].astype(bool))
    assert read.fps == takes["fps"]
    assert read.name.endswith("TempFile")
    write_fap(read, tmp_path / "again.fap")
    assert_equal(read_fap(tmp_path / "again.fap"), read)


@pytest.mark.parametrize("name", XFACE_TAKES)
def test_takes_of_another_tool_come_back_as_they_were(shared_data, tmp_path, name):
    takes = np.load(shared_data / "mpeg4_fap_xface.npz")
    used = takes[f"{name}_mask"].astype(bool)
    none = np.zeros((len(used), 4), np.int64), np.zeros((len(used), 6), np.int64)
    take = FapStream(name, float(takes["fps"]), takes[name].astype(float), used, *none)
    write_fap(take, tmp_path / "take.fap")
    assert_equal(read_fap(tmp_path / "take.fap"), take)


@pytest.mark.parametrize("name", ["take", "a name with 25 and 10", "", "C:\\faces\\joy"])
def test_a_stream_with_changing_masks_visemes_and_expressions(tmp_path, name):
    take = stream(name=name)
    write_fap(take, tmp_path / "take.fap")
    assert_equal(read_fap(tmp_path / "take.fap"), take)


def test_a_rate_that_is_no_whole_number(tmp_path):
    take = stream()
    write_fap(FapStream("t", 29.97, take.values, take.used, take.viseme, take.expression), tmp_path / "t.fap")
    assert read_fap(tmp_path / "t.fap").fps == 29.97


def test_values_are_rounded(tmp_path):
    take = stream()
    nudged = take.values + np.where(take.values != 0, 0.4, 0)
    write_fap(FapStream(take.name, 25.0, nudged, take.used, take.viseme, take.expression), tmp_path / "t.fap")
    assert_equal(read_fap(tmp_path / "t.fap"), take)


def test_habits_of_other_tools(tmp_path):
    plain = stream()
    write_fap(plain, tmp_path / "plain.fap")
    lines = (tmp_path / "plain.fap").read_text().splitlines()
    habits = {
        "crlf": "\r\n".join(lines) + "\r\n",
        "tabs": "\n".join(line.replace(" ", "\t") + " \t" if i else line for i, line in enumerate(lines)) + "\n",
        "open end": "\n".join(lines),
        "comments": "# made by hand\n\n" + "\n# a frame\n".join(lines) + "\n",
        "69 digits": "\n".join(line + " 0" if i % 2 else line for i, line in enumerate(lines)),
        "dense masks": "\n".join(line.replace(" ", "") if i % 2 else line for i, line in enumerate(lines)),
        "byte order mark": "\ufeff" + "\n".join(lines),
    }
    for habit, text in habits.items():
        assert_equal(read_fap(written(tmp_path / f"{habit}.fap", text)), plain)


def test_frames_may_be_numbered_from_any_number(tmp_path):
    text = f"2.1 a 25 2\n{mask(3)}\n1 40\n{mask(3)}\n2 50\n"
    assert read_fap(written(tmp_path / "t.fap", text)).values[:, 2].tolist() == [40, 50]


def test_tools_that_write_fap_1_and_2_as_one_number(tmp_path):
    text = f"2.1 a 25 3\n{mask(1, 2, 3)}\n0 4 2 7\n{mask(1, 3)}\n1 5 8\n{mask(1, 2, 3)}\n2 1 2 30 0 1 9 2 63 0 0 9\n"
    read = read_fap(written(tmp_path / "t.fap", text))
    assert read.viseme.tolist() == [[4, 0, 63, 0], [5, 0, 63, 0], [1, 2, 30, 0]]
    assert read.expression.tolist() == [[2, 63, 0, 0, 0, 0], [0] * 6, [1, 9, 2, 63, 0, 0]]
    assert read.values[:, 2].tolist() == [7, 8, 9]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "is empty"),
        ("# nothing else\n", "starts with '', expected a version"),
        ("PK\x03\x04\0\0\0", "is not a FAP stream"),
        ("hello there\n", "starts with 'hello there'"),
        ("2.1 a 25 0\n", "expected a version"),
        (f"2.1 a 0 1\n{mask(3)}\n0 1\n", "'0' frames a second"),
        (f"2.1 a -25 1\n{mask(3)}\n0 1\n", "'-25' frames a second"),
        (f"2.1 a nan 1\n{mask(3)}\n0 1\n", "'nan' frames a second"),
        (f"2.1 a 10001 1\n{mask(3)}\n0 1\n", "'10001' frames a second"),
        (f"2.1 a 25 1000000000\n{mask(3)}\n0 1\n", "says 1000000000 frames, but 1 whole ones follow"),
        (f"2.1 a 25 2\n{mask(3)}\n0 1\n{mask(3)}\n", "says 2 frames, but 1 whole ones follow"),
        (f"2.1 a 25 1\n{mask(3)[:-2]}\n0 1\n", "line 2 is .* expected a mask of 68 digits"),
        (f"2.1 a 25 1\n{mask(3)} 0 0\n0 1\n", "line 2 is .* expected a mask of 68 digits"),
        (f"2.1 a 25 1\n{mask(3, 4)}\n0 1\n", "line 3 has 1 values after the frame's number, but .* wants 2"),
        (f"2.1 a 25 1\n{mask(1, 2)}\n0 1 2 3\n", "line 3 has 3 values .* wants 10"),
        (f"2.1 a 25 1\n{mask(1)}\n0 15 0 0 0\n", "line 3 has .15, 0, 0, 0. for FAP 1 or 2"),
        (f"2.1 a 25 1\n{mask(3)}\n0 much\n", "line 3 has 'much', expected a number"),
        (f"2.1 a 25 1\n{mask(3)}\n0 1e30\n", "line 3 has 1e.30, expected at most"),
        (f"2.1 a 25 1\n{mask(3)}\n0 nan\n", "line 3 has a value that is no number"),
        (f"2.1 a 25 1\n{mask(3)}\nzero 1\n", "line 3 starts with 'zero'"),
        (f"2.1 a 25 2\n{mask(3)}\n0 1\n{mask(3)}\n2 1\n", "line 5 starts with '2', expected the frame's number 1"),
    ],
)
def test_malformed_files_are_named_in_one_sentence(tmp_path, text, said):
    with pytest.raises(RetargetError, match=said) as caught:
        read_fap(written(tmp_path / "t.fap", text))
    assert "\n" not in str(caught.value)


def test_a_stream_that_cannot_be_written_leaves_the_file_alone(tmp_path):
    take = stream()
    write_fap(take, tmp_path / "t.fap")
    before = (tmp_path / "t.fap").read_bytes()
    take.values[2, 9] = np.nan
    with pytest.raises(RetargetError, match="frame 2 has a value that is not finite"):
        write_fap(take, tmp_path / "t.fap")
    assert (tmp_path / "t.fap").read_bytes() == before
