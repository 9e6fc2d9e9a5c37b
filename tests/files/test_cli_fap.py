"""facial-retarget fap: motion onto a face, into FAPs, and back out of a face's frames."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.cli import main
from facial_retarget_addon.core.acting.fap_face import fit_fap_face
from facial_retarget_addon.core.errors import Cancelled, RetargetError
from facial_retarget_addon.core.markers.assignment import MarkerMap
from facial_retarget_addon.core.mpeg4.arkit import ARKIT_NAMES
from facial_retarget_addon.core.mpeg4.arkit_take import ArkitTake
from facial_retarget_addon.core.mpeg4.conversions import faps_of_arkit, low_level, stream_of_values
from facial_retarget_addon.core.mpeg4.stream import FapStream
from facial_retarget_addon.files.fap_task import FapTask, run_fap_task
from facial_retarget_addon.files.frame_range import FrameRange
from facial_retarget_addon.files.frames import read_frames
from facial_retarget_addon.files.motion.arkit_csv import write_arkit_csv
from facial_retarget_addon.files.motion.fap import read_fap, write_fap
from facial_retarget_addon.files.motion.marker_map import write_marker_map
from facial_retarget_addon.files.mpeg4_face import FapFaceFiles

from .conftest import FaceOnDisk

FRAMES, FPS = 20, 25.0


def take() -> FapStream:
    """A smile, a jaw that opens, a blink and a turn of the head; neutral at both ends."""
    values = np.zeros((FRAMES, 68))
    for fap, most in {3: 700, 5: -600, 12: 150, 13: 150, 19: 1024, 20: 1024, 31: -90, 49: 30000, 59: 160}.items():
        values[:, fap - 1] = np.round(most * np.sin(np.linspace(0, np.pi, FRAMES)))
    values[-1] = 0
    return stream_of_values("a take", FPS, values, values.any(axis=0))


@pytest.fixture
def motion(tmp_path: Path) -> Path:
    write_fap(take(), tmp_path / "take.fap")
    return tmp_path / "take.fap"


def fap(motion: Path, out: Path, *arguments: object) -> int:
    return main(["fap", str(motion), "--out", str(out), "--quiet", *map(str, arguments)])


def played(face: FaceOnDisk, path: Path) -> np.ndarray:
    return np.asarray(read_frames(path, len(face.actor.face.mesh.vertices)))


@pytest.mark.parametrize("name", ["out.npz", "out.pc2", "out.mdd", "out"])
def test_a_take_plays_into_every_kind_of_frames(name: str, face: FaceOnDisk, motion: Path, tmp_path: Path) -> None:
    assert fap(motion, tmp_path / name, *face.arguments) == 0
    fitted = fit_fap_face(face.actor.face.mesh, face.actor.face.points)
    frames = played(face, tmp_path / name)
    np.testing.assert_allclose(frames, fitted.frames(take().values), atol=1e-6)
    rest = face.actor.face.mesh.vertices.astype(np.float32)
    np.testing.assert_array_equal(frames[[0, -1]], [rest, rest])
    assert np.abs(frames[10] - rest).max() > 0.1


def test_what_is_said_about_it(face: FaceOnDisk, motion: Path, tmp_path: Path) -> None:
    report, page = tmp_path / "report.json", tmp_path / "page.html"
    assert fap(motion, tmp_path / "out.npz", *face.arguments, "--report", report, "--page", page) == 0
    said = json.loads(report.read_text())
    assert said["motion"] == {"file": "take.fap", "format": "FAPs", "frames": 20, "fps": 25, "name": "a take"}
    rows = {row["fap"]: row for row in said["faps"]}
    assert set(rows) == set(np.flatnonzero(take().values.any(axis=0)) + 1)
    assert rows[5] == {"fap": 5, "name": "raise_b_midlip", "lowest": rows[5]["lowest"], "highest": 0, "shown": True}
    assert not rows[49]["shown"]  # the head is left alone
    assert said["face"]["file"] == "neutral.obj"
    assert said["face"]["fapu"]["MW"] > 0
    assert set(said["seconds"]) == {"read and fit", "write"}
    text = page.read_text()
    assert text.count("data:image/png;base64,") == 1 + 12
    for word in ("take.fap", "raise_b_midlip", "Neutral", "<figcaption>Frame 2</figcaption>"):
        assert word in text


def test_a_face_gives_back_the_take_that_it_played(face: FaceOnDisk, motion: Path, tmp_path: Path) -> None:
    assert fap(motion, tmp_path / "out.npz", *face.arguments) == 0
    assert fap(tmp_path / "out.npz", tmp_path / "again.fap", *face.arguments, "--fps", 25) == 0
    again = read_fap(tmp_path / "again.fap")
    shown = take().values.copy()
    shown[:, 48] = 0  # the head did not turn
    np.testing.assert_array_equal(again.values, shown)
    assert (again.fps, len(again)) == (FPS, FRAMES)
    assert again.used[0].sum() > 40


def test_a_face_whose_head_turned_gives_back_its_turn_too(face: FaceOnDisk, motion: Path, tmp_path: Path) -> None:
    assert fap(motion, tmp_path / "out.npz", *face.arguments, "--head", "turn") == 0
    measure = (tmp_path / "out.npz", tmp_path / "again.fap", *face.arguments, "--fps", 25, "--head", "turn")
    assert fap(*measure, "--report", tmp_path / "r.json") == 0
    again = read_fap(tmp_path / "again.fap")
    np.testing.assert_allclose(again.values, take().values, atol=1)
    assert again.values[:, 48].max() > 29000
    assert json.loads((tmp_path / "r.json").read_text())["motion"]["head_residual"] < 1e-6


def test_a_take_is_written_back_equal(motion: Path, tmp_path: Path) -> None:
    assert fap(motion, tmp_path / "again.fap") == 0
    assert (tmp_path / "again.fap").read_bytes() == motion.read_bytes()


def test_some_frames_of_a_take(face: FaceOnDisk, motion: Path, tmp_path: Path) -> None:
    assert fap(motion, tmp_path / "some.fap", "--frames", "2:12:5") == 0
    some = read_fap(tmp_path / "some.fap")
    np.testing.assert_array_equal(some.values, take().values[[1, 6, 11]])
    assert some.fps == FPS / 5
    page = tmp_path / "page.html"
    assert fap(motion, tmp_path / "some.npz", *face.arguments, "--frames", "2:12:5", "--page", page) == 0
    assert len(played(face, tmp_path / "some.npz")) == 3
    assert "<figcaption>Frame 7</figcaption>" in page.read_text()


@pytest.mark.parametrize(
    ("text", "rows"),
    [(":", range(9)), ("3:", range(2, 9)), (":4", range(4)), ("::4", (0, 4, 8)), ("2:7:3", (1, 4)), ("5", (4,))],
)
def test_frames_are_counted_from_one_and_the_last_is_among_them(text: str, rows: range) -> None:
    assert list(range(9)[FrameRange.of_text(text).rows(9)]) == list(rows)


@pytest.mark.parametrize("text", ["", "0:3", "4:2", "1:9:0", "1:2:3:4", "-1:", "a", "1.5:2", "9" * 5000 + ":"])
def test_what_are_no_frames(text: str) -> None:
    with pytest.raises(RetargetError, match="frames are"):
        FrameRange.of_text(text)


def test_a_mask_holds_or_lets_go(face: FaceOnDisk, tmp_path: Path) -> None:
    stream = take()
    stream.used[10:] = False
    write_fap(stream, tmp_path / "cut.fap")
    ends = {}
    for missing in ("hold", "zero"):
        assert fap(tmp_path / "cut.fap", tmp_path / "o.npz", *face.arguments, "--missing", missing) == 0
        ends[missing] = played(face, tmp_path / "o.npz")
    np.testing.assert_array_equal(ends["hold"][-1], ends["hold"][9])
    np.testing.assert_array_equal(ends["zero"][-1], ends["zero"][0])


def test_the_head_turns_only_when_it_is_told_to(face: FaceOnDisk, motion: Path, tmp_path: Path) -> None:
    crown = face.actor.face.mesh.vertices[:, 1].argmax()
    moved = {}
    for head in ("leave", "turn"):
        assert fap(motion, tmp_path / "o.npz", *face.arguments, "--head", head) == 0
        frames = played(face, tmp_path / "o.npz")
        moved[head] = np.linalg.norm(frames[10, crown] - frames[0, crown])
    assert moved["leave"] < 1e-3 < 0.05 < moved["turn"]


def test_the_papers_variant_is_another_one(face: FaceOnDisk, motion: Path, tmp_path: Path) -> None:
    for variant in ("default", "paper"):
        assert fap(motion, tmp_path / f"{variant}.npz", *face.arguments, "--variant", variant) == 0
    assert np.abs(played(face, tmp_path / "default.npz") - played(face, tmp_path / "paper.npz")).max() > 1e-3


@pytest.fixture
def arkit(tmp_path: Path) -> tuple[ArkitTake, Path]:
    weights = np.zeros((8, 52))
    weights[:, ARKIT_NAMES.index("jawOpen")] = np.linspace(0, 1, 8)
    weights[:, ARKIT_NAMES.index("tongueOut")] = 0.5
    arkit_take = ArkitTake("phone", 30.0, weights, None, None)
    write_arkit_csv(arkit_take, tmp_path / "phone.csv")
    return arkit_take, tmp_path / "phone.csv"


def test_arkit_weights_play(
    face: FaceOnDisk, arkit: tuple[ArkitTake, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert fap(arkit[1], tmp_path / "o.npz", *face.arguments) == 0
    chin = face.actor.face.points.subset(["2.1"]).positions(played(face, tmp_path / "o.npz"))[:, 0, 1]
    assert (np.diff(chin) < 0).all()
    warning = capsys.readouterr().err
    assert "has no points for: 45 thrust_tongue_tip" in warning
    assert warning.count("\n") == 1


def test_arkit_weights_become_faps(arkit: tuple[ArkitTake, Path], tmp_path: Path) -> None:
    assert fap(arkit[1], tmp_path / "o.fap") == 0
    stream = read_fap(tmp_path / "o.fap")
    np.testing.assert_allclose(low_level(stream), low_level(faps_of_arkit(arkit[0])), atol=0.5)
    assert stream.fps == 30


def write_markers(face: FaceOnDisk, path: Path, names: Callable[[str], str], hidden: slice | None = None) -> np.ndarray:
    """A table of markers on the FDPs of a face that plays the take, its head turning and drifting."""
    fitted = fit_fap_face(face.actor.face.mesh, face.actor.face.points)
    fdps = [name for name in fitted.points.names if name[0].isdigit()]
    frames = fitted.frames(take().values, turn_head=True) + np.linspace(0, 0.3, FRAMES)[:, None, None]
    places = fitted.points.subset(fdps).positions(frames.astype(np.float64))
    columns = [f"{names(name)}_{axis}" for name in fdps for axis in "xyz"]
    cells = [[f"{x:.9f}" for x in row] for row in places.reshape(FRAMES, -1)]
    if hidden is not None:
        for row in cells[hidden]:
            row[:3] = ["", "", ""]
    lines = [["time", *columns], *([f"{i / FPS}", *row] for i, row in enumerate(cells))]
    path.write_text("\n".join(map(",".join, lines)))
    return fitted.measurable


def test_markers_become_faps(face: FaceOnDisk, tmp_path: Path) -> None:
    measured = write_markers(face, tmp_path / "m.csv", lambda name: f"fdp_{name.replace('.', '_')}")
    assert fap(tmp_path / "m.csv", tmp_path / "o.fap", "--report", tmp_path / "r.json") == 0
    stream = read_fap(tmp_path / "o.fap")
    assert stream.used[0][measured].all()
    np.testing.assert_allclose(stream.values[:, measured], take().values[:, measured], atol=1)
    np.testing.assert_allclose(stream.values[:, 48], take().values[:, 48], atol=30)  # a thousandth of a radian is 100
    said = json.loads((tmp_path / "r.json").read_text())
    assert said["motion"]["format"] == "markers"
    assert said["gaps"]["gaps"] == 0
    assert said["markers"]["head"]["residual"] < 1e-5
    assert said["warnings"] == []


def test_a_marker_map_says_what_names_do_not(
    face: FaceOnDisk, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_markers(face, tmp_path / "m.csv", lambda name: f"m{name.replace('.', '0')}")
    assert fap(tmp_path / "m.csv", tmp_path / "o.fap") == 2
    assert "marker map" in capsys.readouterr().err
    known = {name: f"m{name.replace('.', '0')}" for name in face.actor.face.points.names if name[0].isdigit()}
    write_marker_map(MarkerMap({marker: name for name, marker in known.items()}), tmp_path / "map.json")
    assert fap(tmp_path / "m.csv", tmp_path / "o.fap", "--map", tmp_path / "map.json") == 0
    np.testing.assert_allclose(read_fap(tmp_path / "o.fap").values[:, 4], take().values[:, 4], atol=1)


def test_hidden_markers_are_filled_or_refused(
    face: FaceOnDisk, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_markers(face, tmp_path / "m.csv", lambda name: name, hidden=slice(5, 9))
    assert fap(tmp_path / "m.csv", tmp_path / "o.npz", *face.arguments, "--report", tmp_path / "r.json") == 0
    gaps = json.loads((tmp_path / "r.json").read_text())["gaps"]
    assert (gaps["gaps"], gaps["frames"]) == (1, 4)
    capsys.readouterr()
    assert fap(tmp_path / "m.csv", tmp_path / "o.fap", "--gaps", "refuse") == 2
    assert "1 gaps, expected none" in capsys.readouterr().err


def refused(capsys: pytest.CaptureFixture[str], *arguments: object) -> str:
    """The one line that a command is refused with."""
    capsys.readouterr()
    assert main(["--quiet", *map(str, arguments)]) == 2
    error = capsys.readouterr().err
    assert error.startswith("facial-retarget: ")
    assert error.count("\n") == 1
    return error


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["take.fap", "--out", "o.npz"], "without a face"),
        (["take.fap", "--out", "o.npz", "--face", "{neutral}"], "go together"),
        (["take.fap", "--out", "o.fap", "--face", "{neutral}", "--points", "{points}"], "without a face"),
        (["take.fap", "--out", "o.fap", "--page", "p.html"], "without a face"),
        (["take.fap", "--out", "o.csv"], "would be a .csv, expected .fap"),
        (["take.fap", "--out", "take.fap"], "out and motion are one file"),
        (["take.fap", "--out", "o.fap", "--report", "o.fap"], "report and out are one file"),
        (["take.fap", "--out", "nowhere/o.fap"], "there is no folder"),
        (["take.fap", "--out", "."], "expected a new folder"),
        (["take.fap", "--out", "o.fap", "--frames", "5:99"], "the take has 20"),
        (["take.fap", "--out", "o.fap", "--map", "map.json"], "holds no markers"),
        (["missing.fap", "--out", "o.fap"], "missing.fap cannot be read"),
        (["take.mp4", "--out", "o.fap"], "expected one of .fap"),
        (["broken.fap", "--out", "o.fap"], "0 whole ones follow"),
        (["frames.npz", "--out", "o.fap", "--face", "{neutral}", "--points", "{points}"], "frames a second"),
        (["frames.npz", "--out", "o.fap", "--fps", "25"], "without a face"),
        (
            ["frames.npz", "--out", "o.npz", "--fps", "25", "--face", "{neutral}", "--points", "{points}"],
            "a job for retargeting",
        ),
        (
            ["frames.npz", "--out", "o.fap", "--fps", "25", "--face", "{neutral}", "--points", "{points}"],
            "frames have shape (2, 3, 3)",
        ),
        (["take.fap", "--out", "o.npz", "--face", "no.obj", "--points", "{points}"], "no.obj cannot be read"),
        (["take.fap", "--out", "o.npz", "--face", "{neutral}", "--points", "no.json"], "no.json cannot be read"),
        (["take.fap", "--out", "o.npz", "--face", "{neutral}", "--points", "bare.json"], "has an MPEG-4 name"),
        (["take.fap", "--out", "o.npz", "--face", "{neutral}", "--points", "middle.json"], "left and right"),
        (["take.fap", "--out", "o.npz", "--face", "{points}", "--points", "{points}"], "expected one of .obj"),
    ],
)
def test_bad_input_is_one_sentence_and_nothing_is_written(
    arguments: list[str],
    said: str,
    face: FaceOnDisk,
    motion: Path,
    tmp_path: Path,
    listing: Callable[[], dict[str, bytes]],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "broken.fap").write_text("2.1 broken 25 2\n")
    (tmp_path / "take.mp4").write_bytes(b"")
    write_marker_map(MarkerMap({"a": "2.1"}), tmp_path / "map.json")
    np.savez(tmp_path / "frames.npz", frames=np.zeros((2, 3, 3), np.float32))
    for name, points in {"bare": {"nose": {"vertex": 0}}, "middle": {"2.1": {"vertex": 0}}}.items():
        document = {"format": "facial-retarget/feature-points", "version": 1, "points": points}
        (tmp_path / f"{name}.json").write_text(json.dumps(document))
    before = listing()
    places = {"neutral": face.neutral, "points": face.points}
    assert said in refused(capsys, "fap", *(argument.format(**places) for argument in arguments))
    assert listing() == before


def test_a_folder_that_holds_an_input_is_not_replaced(
    face: FaceOnDisk, motion: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "faces").mkdir()
    neutral = tmp_path / "faces" / "neutral.obj"
    neutral.write_bytes(face.neutral.read_bytes())
    error = refused(capsys, "fap", motion, "--out", tmp_path / "faces", "--face", neutral, "--points", face.points)
    assert "face lies in out" in error
    assert neutral.exists()


def test_stopping_leaves_every_file_as_it_was(
    face: FaceOnDisk, motion: Path, tmp_path: Path, listing: Callable[[], dict[str, bytes]]
) -> None:
    (tmp_path / "o.npz").write_text("old")
    before = listing()

    def stop(share: float, what: str) -> None:
        if what.startswith("frame 17"):
            raise Cancelled

    files = FapFaceFiles(face.neutral, face.points)
    with pytest.raises(Cancelled):
        run_fap_task(FapTask(motion, tmp_path / "o.npz", files, page=tmp_path / "p.html"), stop)
    assert listing() == before


def test_frames_are_made_a_few_at_a_time(face: FaceOnDisk, motion: Path, tmp_path: Path) -> None:
    told: list[str] = []
    files = FapFaceFiles(face.neutral, face.points)
    run_fap_task(FapTask(motion, tmp_path / "o.npz", files), lambda share, what: told.append(what))
    assert [what for what in told if what.startswith("frame")] == ["frame 1 of 20", "frame 17 of 20"]
