"""Any motion file at all: a reader gives a sound take or a RetargetError of one line, and never anything else."""

from __future__ import annotations

import io
import subprocess
import sys
import time
import tracemalloc
import zipfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.markers.take import MarkerTake
from facial_retarget_addon.core.mpeg4.arkit_take import ArkitTake
from facial_retarget_addon.core.mpeg4.stream import FapStream
from facial_retarget_addon.files.motion.arkit_csv import WEIGHTS, write_arkit_csv
from facial_retarget_addon.files.motion.fap import write_fap
from facial_retarget_addon.files.motion.read import read_motion
from facial_retarget_addon.files.motion.text import LARGEST

from .test_arkit_csv import take
from .test_fap import stream
from .test_markers import ARM, c3d, table, trc

pytestmark = pytest.mark.filterwarnings("ignore:No analog data:UserWarning")

NAMES = ("stream.fap", "weights.csv", "plain.csv", "take.csv", "take.trc", "take.c3d", "arm.bvh")
KINDS = {"stream.fap": FapStream, "weights.csv": ArkitTake, "plain.csv": ArkitTake, "jmtech.csv": ArkitTake}
CHANGES = st.sampled_from(
    [
        b"nan",
        b"-1",
        b"0",
        b"inf",
        b"1e999",
        b"9" * 30,
        b"\0" * 4,
        b"\xff" * 4,
        b"\n",
        b"\t",
        b",",
        b'"',
        b"{",
        b"}",
        b" ",
    ]
)
FILES = settings(deadline=5000, suppress_health_check=[HealthCheck.function_scoped_fixture])


def sound(folder: Path, name: str) -> bytes:
    """The bytes of a sound file."""
    path = folder / name
    match name:
        case "stream.fap":
            write_fap(stream(3), path)
        case "weights.csv":
            write_arkit_csv(take(4), path)
        case "plain.csv":
            rows = [f"{i / 30},{','.join(['0.5'] * 52)}" for i in range(4)]
            path.write_text("\n".join([",".join(("time", *WEIGHTS)), *rows]))
        case "take.csv":
            table(path)
        case "take.trc":
            trc(path)
        case "take.c3d":
            c3d(path)
        case _:
            path.write_text(ARM)
    return path.read_bytes()


def said_about(path: Path, content: bytes) -> str:
    """The sentence that a file gets, "" if it was read; a take that was read is sound."""
    path.write_bytes(content)
    try:
        read = read_motion(path)
    except RetargetError as error:
        said = str(error)
        assert said
        assert "\n" not in said
        assert len(said) < 400 + len(str(path))
        return said
    assert isinstance(read, KINDS.get(path.name, MarkerTake))
    assert 1 <= read.fps <= 10000
    assert len(read) >= 1
    match read:
        case FapStream():
            assert np.isfinite(read.values).all()
            assert not read.values[~read.used].any()
        case ArkitTake():
            assert np.isfinite(read.weights).all()
        case MarkerTake():
            assert read.positions.shape == (len(read), len(read.names), 3)
            assert not np.isinf(read.positions).any()
    return ""


@pytest.mark.parametrize("name", NAMES)
def test_a_sound_file_is_read(tmp_path, name):
    assert not said_about(tmp_path / name, sound(tmp_path, name))


@pytest.mark.parametrize("name", NAMES)
def test_a_file_that_was_cut_off_anywhere(tmp_path, name):
    content = sound(tmp_path, name)
    end = len(content) - (512 if name.endswith(".c3d") else 16)  # C3D fills its last block up
    lengths = range(0, end, max(1, len(content) // 400))
    said = [said_about(tmp_path / name, content[:length]) for length in lengths]
    if name.endswith(".csv"):
        assert not all(said), "a table that ends with a row is a whole one"
    else:
        assert all(said), "part of a file was taken for all of it"


@pytest.mark.parametrize("name", ["joy.fap", "jmtech.csv", "animface_jaw.trc"])
def test_a_real_file_that_was_cut_off_anywhere(shared_data, tmp_path, name):
    content = (shared_data / name).read_bytes()[:200_000]
    for length in range(0, len(content), len(content) // 40):
        assert said_about(tmp_path / name, content[:length]) or name == "jmtech.csv", "no other format may end early"


@pytest.mark.parametrize("name", NAMES)
@settings(FILES, max_examples=50)
@given(content=st.binary(max_size=200))
def test_any_bytes(tmp_path, name, content):
    said_about(tmp_path / name, content)


@pytest.mark.parametrize("name", NAMES)
@settings(FILES, max_examples=150)
@given(data=st.data())
def test_a_sound_file_with_a_few_changes(tmp_path, name, data):
    content = bytearray(sound(tmp_path, name))
    for _ in range(data.draw(st.integers(1, 3))):
        start = data.draw(st.integers(0, len(content)))
        end = data.draw(st.integers(start, min(start + 6, len(content))))
        content[start:end] = data.draw(st.binary(max_size=4) | CHANGES)
    said_about(tmp_path / name, bytes(content))


@pytest.mark.parametrize("name", NAMES)
def test_mislabelled_files(tmp_path, name):
    """Another format's content under this name."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("joy.fap", sound(tmp_path, "stream.fap"))
    others = {other: sound(tmp_path, other) for other in NAMES if Path(other).suffix != Path(name).suffix}
    others |= {
        "zip": packed.getvalue(),
        "rubbish": np.random.default_rng(1).bytes(5000),
        "blank": b"\n \n",
        "empty": b"",
    }
    for other, content in others.items():
        assert said_about(tmp_path / name, content), f"{other} was read as {name}"


@pytest.mark.parametrize("name", NAMES)
def test_what_is_no_file(tmp_path, name):
    (tmp_path / "folder" / name).mkdir(parents=True)
    with pytest.raises(RetargetError, match="is no file"):
        read_motion(tmp_path / "folder" / name)
    with pytest.raises(RetargetError, match="cannot be read: No such file"):
        read_motion(tmp_path / "missing" / name)


@pytest.mark.parametrize("name", NAMES)
def test_huge_files_and_claims_cost_neither_time_nor_memory(tmp_path, name):
    with open(tmp_path / name, "wb") as file:
        file.truncate(LARGEST + 1)  # a sparse file
    huge = tmp_path / name
    binary = tmp_path / f"binary{huge.suffix}"
    with open(binary, "wb") as file:
        file.truncate(LARGEST - 1)
    tracemalloc.start()
    started = time.perf_counter()
    for path, said in ((huge, r"has 1\.0 GiB, expected"), (binary, "starts with .* so it is not")):
        with pytest.raises(RetargetError, match=said):
            read_motion(path)
    assert time.perf_counter() - started < 1
    assert tracemalloc.get_traced_memory()[1] < 2**20
    tracemalloc.stop()


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(
    "line", ["a" + " " * 300_000 + "b", "a _" * 100_000, "1 " * 100_000, "0" * 300_000, "x," * 65_000]
)
def test_endless_lines_are_refused_at_once(tmp_path, name, line):
    head = sound(tmp_path, name).decode("latin-1")[:300].rpartition("\n")[0]
    started = time.perf_counter()
    for text in (line, f"{head}\n{line}\n"):
        assert said_about(tmp_path / name, text.encode("latin-1"))
    assert time.perf_counter() - started < 5


def test_suffixes_and_tables_that_hold_no_motion(tmp_path):
    with pytest.raises(RetargetError, match=r"is a \.fbx, expected one of \.fap, \.trc, \.c3d, \.bvh, \.csv"):
        read_motion(tmp_path / "a.fbx")
    (tmp_path / "a.csv").write_text("name,age\nAnna,4\n")
    with pytest.raises(RetargetError, match="neither ARKit weights nor markers"):
        read_motion(tmp_path / "a.csv")


def test_the_rate_of_a_table_that_does_not_tell_it(tmp_path):
    (tmp_path / "a.csv").write_text("chin_x,chin_y,chin_z\n1,2,3\n")
    assert read_motion(tmp_path / "a.csv", fps=24).fps == 24
    for fps in (0, -1, float("nan"), 1e5):
        with pytest.raises(RetargetError, match="expected a number from 1 to 10000"):
            read_motion(tmp_path / "a.csv", fps=fps)


def test_a_missing_c3d_package_is_a_bug_and_not_a_malformed_file(tmp_path):
    c3d(tmp_path / "take.c3d")
    program = f"""
import sys
sys.modules["c3d"] = None
from pathlib import Path
from facial_retarget_addon.files.motion.read import read_motion
read_motion(Path({str(tmp_path / "take.c3d")!r}))
"""
    run = subprocess.run([sys.executable, "-c", program], cwd=Path(__file__).parents[2], capture_output=True, text=True)
    assert "ModuleNotFoundError" in run.stderr.splitlines()[-1]
