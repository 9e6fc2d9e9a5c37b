"""Every output of the command line where the disk is full, the folder read-only, the place taken or the name strange.

And out of a performance that is still, has one frame, or thousands. It is made, or refused in one sentence with every
file as it was.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from facial_retarget_addon import demo, demonstration
from facial_retarget_addon.cli import main
from facial_retarget_addon.core import retarget as core_retarget
from facial_retarget_addon.core.arrays import Progress
from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.methods.base import Retargeter
from facial_retarget_addon.core.methods.settings import (
    BakeSettings,
    HierarchicalSettings,
    MapSettings,
    Settings,
    WrinkleSettings,
)
from facial_retarget_addon.core.mpeg4.arkit import ARKIT_NAMES
from facial_retarget_addon.core.mpeg4.arkit_take import ArkitTake
from facial_retarget_addon.core.mpeg4.conversions import stream_of_values
from facial_retarget_addon.core.problem import Problem
from facial_retarget_addon.core.shapes.shape_set import ShapeSet
from facial_retarget_addon.files.bake_output import BakeOutput
from facial_retarget_addon.files.clone_job import CloneJob, SourceFiles, TargetFiles, write_clone_job
from facial_retarget_addon.files.frames import read_frames, write_frames
from facial_retarget_addon.files.job import FaceFiles, Job, MapOutput, OutputFiles, write_job
from facial_retarget_addon.files.mesh_file import MeshFile
from facial_retarget_addon.files.meshes import read_mesh, write_mesh
from facial_retarget_addon.files.motion.arkit_csv import read_arkit_csv, write_arkit_csv
from facial_retarget_addon.files.motion.fap import read_fap, write_fap
from facial_retarget_addon.files.points import write_points
from facial_retarget_addon.files.shape_files import add_shapes, read_shapes
from facial_retarget_addon.files.whole import written_whole

from .conftest import SIDES, bump, dome, dome_points
from .test_images import png_values

resource = pytest.importorskip("resource", reason="limits, users and mounts are those of POSIX")

FAPS = 68
MANY = 10_000
STEM = "out"


class Kit(NamedTuple):
    """What the commands read, in a folder that any user may read; `jobs` is for the jobs that tests write."""

    folder: Path

    @property
    def face(self) -> list[str]:
        return ["--face", str(self.folder / "actor.obj"), "--points", str(self.folder / "actor.json")]

    def job(
        self, frames: str, output: OutputFiles, maps: MapOutput | None = None, bake: BakeOutput | None = None
    ) -> Path:
        """A job over the two domes."""
        faces = {name: FaceFiles(self.folder / f"{name}.obj", self.folder / f"{name}_points.json") for name in SIDES}
        source = replace(faces["source"], frames=self.folder / frames)
        path = self.folder / "job.toml"
        settings = HierarchicalSettings(levels=1)
        given = ("hierarchical", source, faces["target"], (), settings, output, None, path)
        write_job(Job(*given, normal_maps=maps, bake=bake), path)
        return path


def wave(count: int, height: float = 0.1) -> np.ndarray:
    """(count, V, 3) a bump of the source dome that rises and sinks, flat in the first frame and in the last."""
    mesh = dome(SIDES["source"]).mesh
    rise = height * np.sin(np.linspace(0, np.pi, count)) if count > 1 else [height]
    return np.stack([bump(mesh, 0.1, float(share)) for share in rise])


_fitted: dict[str, Retargeter] = {}


@pytest.fixture(autouse=True)
def fitted_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """The jobs of this module are about two faces: the method is fitted to them once."""
    fit = core_retarget.fit

    def remembered(method: str, problem: Problem, settings: Settings, progress: Progress) -> Retargeter:
        key = f"{method} {settings} {len(problem.source.mesh.vertices)} {len(problem.target.mesh.vertices)}"
        if key not in _fitted:
            _fitted[key] = fit(method, problem, settings, progress)
        return _fitted[key]

    monkeypatch.setattr(core_retarget, "fit", remembered)


@pytest.fixture(scope="module")
def kit() -> Iterator[Kit]:
    folder = Path(tempfile.mkdtemp(prefix="facial_retarget_kit_"))
    folder.chmod(0o755)
    for number, (name, side) in enumerate(SIDES.items()):
        write_mesh(dome(side, 1.0 + number), folder / f"{name}.obj")
        write_points(dome_points(side), folder / f"{name}_points.json")
    write_frames(wave(4), folder / "moving.npz")
    target = dome(SIDES["target"], 2.0)
    rig = ShapeSet.of_positions(target.mesh.vertices, {"bump": bump(target.mesh, 0.0, 0.1)})
    with written_whole() as aside:
        add_shapes(aside, rig, folder / "rig.npz", target)
    source = dome(SIDES["source"])
    folds = ShapeSet.of_positions(source.mesh.vertices, {"fold": bump(source.mesh, 0.0, 0.1)})
    with written_whole() as aside:
        add_shapes(aside, folds, folder / "folds.npz", source)
    actor = demo.actor(vertices=1500)
    neutral = MeshFile(actor.face.mesh, actor.counts, actor.corners, actor.uvs[actor.corners])
    write_mesh(neutral, folder / "actor.obj")
    write_points(actor.face.points, folder / "actor.json")
    values = np.zeros((4, FAPS))
    values[1:3, 2] = 500
    write_fap(stream_of_values("take", 25.0, values, values.any(axis=0)), folder / "take.fap")
    shown = {name: places for name, places in actor.face.examples.items() if name in ("joy", "anger")}
    with written_whole() as aside:
        add_shapes(aside, ShapeSet.of_positions(actor.face.mesh.vertices, shown), folder / "shapes.npz", neutral)
    write_frames(np.stack(list(shown.values())), folder / "acted.npz")
    chin = actor.face.points.subset(["2.1"]).positions(actor.face.mesh.vertices)[0]
    rows = ["time,chin_x,chin_y,chin_z", *(",".join(map(repr, [i / 25, *chin.tolist()])) for i in range(3))]
    (folder / "markers.csv").write_text("\n".join(rows) + "\n")
    yield Kit(folder)
    shutil.rmtree(folder)


Command = Callable[[Kit, Path, str], list[object]]
"""Arguments of a command that puts its outputs, all of one stem, into a folder."""


def _run(suffix: str, **others: str) -> Command:
    def command(kit: Kit, out: Path, stem: str) -> list[object]:
        places = {key: out / f"{stem}{end}" for key, end in others.items() if key != "maps"}
        maps = (
            MapOutput(out / f"{stem}_maps", MapSettings(pixels=64, depth=others["maps"])) if "maps" in others else None
        )
        return ["run", kit.job("moving.npz", OutputFiles(out / f"{stem}{suffix}", **places), maps)]

    return command


def _bake(kind: str, *more: str) -> Command:
    def command(kit: Kit, out: Path, stem: str) -> list[object]:
        shapes = f"_shapes{'.npz' if kind == 'compact' else ''}"
        residual = 0 if kind == "compact" else 2
        settings = BakeSettings(kind=kind, residual=residual)
        curves = out / f"{stem}_curves.csv", out / f"{stem}_curves.json"
        rig = None if kind == "compact" else kit.folder / "rig.npz"
        bake = BakeOutput(settings, curves, out / f"{stem}{shapes}", rig)
        return ["run", kit.job("moving.npz", OutputFiles(out / f"{stem}.npz"), bake=bake), *more]

    return command


def _fap(suffix: str, motion: str = "take.fap", *more: str) -> Command:
    def command(kit: Kit, out: Path, stem: str) -> list[object]:
        ends = {"--report": ".report.json", "--page": ".html"} if suffix == ".npz" else {}
        beside = [text for flag, end in ends.items() for text in (flag, out / f"{stem}{end}")]
        return ["fap", kit.folder / motion, *kit.face, "--out", out / f"{stem}{suffix}", *more, *beside]

    return command


def _shapes(suffix: str) -> Command:
    def command(kit: Kit, out: Path, stem: str) -> list[object]:
        beside = ["--report", out / f"{stem}.report.json", "--page", out / f"{stem}.html"] if suffix == ".npz" else []
        return ["shapes", *kit.face, "--set", "expressions", "--out", out / f"{stem}{suffix}", *beside]

    return command


def _clone(suffix: str) -> Command:
    def command(kit: Kit, out: Path, stem: str) -> list[object]:
        head = [kit.folder / "actor.obj", kit.folder / "actor.json"]
        page = ["--page"] if suffix == ".npz" else []
        shapes = out / f"{stem}{suffix}"
        return ["clone", "--source", *head, kit.folder / "shapes.npz", "--target", *head, shapes, *page]

    return command


def _wrinkles(kit: Kit, out: Path, stem: str) -> list[object]:
    faces = [FaceFiles(kit.folder / f"{name}.obj", kit.folder / f"{name}_points.json") for name in SIDES]
    target = TargetFiles(faces[1], out / f"{stem}.npz", wrinkles=out / f"{stem}_kit")
    settings, how = HierarchicalSettings(levels=1), WrinkleSettings(pixels=64, least=0.0)
    source = SourceFiles(faces[0], kit.folder / "folds.npz")
    path = kit.folder / "clone.toml"
    job = CloneJob(source, (target,), method="hierarchical", settings=settings, path=path, wrinkle_kit=how)
    write_clone_job(job, path)
    return ["clone", path]


def _morph(suffix: str) -> Command:
    def command(kit: Kit, out: Path, stem: str) -> list[object]:
        to = ["--to-face", kit.folder / "actor.obj", "--to-points", kit.folder / "actor.json"]
        return ["morph", *kit.face, *to, "--out", out / f"{stem}{suffix}"]

    return command


COMMANDS: dict[str, Command] = {
    "run npz report page": _run(".npz", report=".json", page=".html"),
    "run pc2": _run(".pc2"),
    "run mdd": _run(".mdd"),
    "run folder": _run(""),
    "run maps png8": _run(".npz", maps="png8"),
    "run maps png16": _run(".npz", maps="png16"),
    "run maps exr": _run(".npz", maps="exr"),
    "run bake compact": _bake("compact"),
    "run bake rig folder": _bake("rig"),
    "fap npz report page": _fap(".npz"),
    "fap pc2": _fap(".pc2"),
    "fap mdd": _fap(".mdd"),
    "fap folder": _fap(""),
    "fap fap": _fap(".fap", "acted.npz", "--fps", "25"),
    "shapes npz report page": _shapes(".npz"),
    "shapes json": _shapes(".json"),
    "shapes folder": _shapes(""),
    "clone npz page": _clone(".npz"),
    "clone json": _clone(".json"),
    "clone folder": _clone(""),
    "clone npz wrinkle kit": _wrinkles,
    "markers": lambda kit, out, stem: ["markers", kit.folder / "markers.csv", "--out", out / f"{stem}.json"],
    "morph obj": _morph(".obj"),
    "morph ply": _morph(".ply"),
    "morph npz": _morph(".npz"),
    "points": lambda kit, out, stem: ["points", *kit.face, "--set", "minimal", "--out", out / f"{stem}.json"],
}

every_command = pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS)


def line(command: Command, kit: Kit, out: Path, stem: str = STEM) -> list[str]:
    """The arguments; a job is written while nothing is in the way yet."""
    return [*map(str, command(kit, out, stem)), "--quiet"]


def held(folder: Path) -> dict[str, bytes | None]:
    """Everything in a folder, hidden or not; None stands for a folder."""
    return {str(p.relative_to(folder)): None if p.is_dir() else p.read_bytes() for p in sorted(folder.rglob("*"))}


def refused(capsys: pytest.CaptureFixture[str], status: int, *expected: str) -> None:
    """The status of bad input, and one line on standard error."""
    said = capsys.readouterr()
    assert status == 2, said.err
    assert said.err.count("\n") == 1, said.err
    assert "Traceback" not in said.err
    assert "partial" not in said.err, said.err
    for text in expected:
        assert text in said.err


def mounted(place: Path, size: int) -> bool:
    """Whether a file system of so many bytes is mounted there now: root may, where the machine lets it."""
    if os.geteuid() or shutil.which("mount") is None:
        return False
    return not subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", place], check=False).returncode


PAGE, DISK = 4096, 1 << 24


class Scarce(NamedTuple):
    """A folder to write into, and a context in which only so many bytes go into it.

    words : what the system says then.
    """

    folder: Path
    left: Callable[[int], AbstractContextManager[None]]
    words: str


@pytest.fixture(params=["disk", "limit"])
def scarce(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Scarce]:
    """A small disk that is full but for some bytes; without a disk of its own a limit on every single file."""
    folder = tmp_path / "small"
    folder.mkdir()
    if request.param == "limit":
        yield Scarce(folder, files_of, "File too large")
        return
    if not mounted(folder, DISK):
        pytest.skip("a disk of some megabytes needs root, and a machine that lets it mount one")
    try:
        yield Scarce(folder, lambda size: full_but(folder, size), "the disk is full")
    finally:
        subprocess.run(["umount", "-l", folder], check=True)


@contextmanager
def files_of(most: int) -> Iterator[None]:
    """No file may become longer than this."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@contextmanager
def full_but(folder: Path, left: int) -> Iterator[None]:
    """Fill a disk but for some bytes, in whole pages, with a file beside the folder's outputs."""
    filler = folder / "filler"
    room = os.statvfs(folder)
    with open(filler, "wb") as file:
        os.posix_fallocate(file.fileno(), 0, room.f_bavail * room.f_frsize - PAGE * (left // PAGE))
    try:
        yield
    finally:
        filler.unlink()


@every_command
def test_a_full_disk(command: Command, kit: Kit, scarce: Scarce, capsys: pytest.CaptureFixture[str]) -> None:
    """Whichever output it is that finds no room, the earlier ones stay what they were."""
    arguments = line(command, kit, scarce.folder)
    assert main(arguments) == 0
    before = held(scarce.folder)
    sizes = sorted({len(content) for content in before.values() if content is not None})
    capsys.readouterr()
    # A limit meets the smallest file and the largest, a disk all of them. Reports hold times, which vary in length.
    for left in {sizes[0] * 9 // 10, sizes[-1] * 9 // 10} if "large" in scarce.words else {sizes[-1] // 2}:
        with scarce.left(left):
            status = main(arguments)
        refused(capsys, status, str(scarce.folder / STEM), f"cannot be written: {scarce.words}")
        assert held(scarce.folder) == before


def test_what_a_full_disk_has_stopped_goes_on_once_there_is_room(
    kit: Kit, scarce: Scarce, capsys: pytest.CaptureFixture[str]
) -> None:
    """The frames that were kept stay whole, or there are none of them."""
    arguments = [*line(COMMANDS["run maps exr"], kit, scarce.folder), "--resume"]
    for left in (0, 10_000, 30_000):
        with scarce.left(left):
            status = main(arguments)
        refused(capsys, status, str(scarce.folder / STEM), "cannot be written")
        assert not [name for name in held(scarce.folder) if not Path(name).parts[0].endswith(".unfinished")]
    assert main(arguments) == 0
    resumed = held(scarce.folder)
    assert main(arguments[:-1]) == 0
    assert held(scarce.folder) == resumed


@pytest.mark.parametrize("left", [0, 20_000, 300_000])
def test_a_demo_on_a_full_disk(
    left: int, scarce: Scarce, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It writes many files: those that are there are whole."""
    monkeypatch.setattr(demonstration, "targets", lambda: demo.targets()[:1])
    with scarce.left(left):
        status = main(["demo", str(scarce.folder / "demo"), "--quiet"])
    refused(capsys, status, str(scarce.folder / "demo"), scarce.words)
    assert not [name for name in held(scarce.folder) if Path(name).name.startswith(".")]


@contextmanager
def locked_folder(folder: Path) -> Iterator[None]:
    """A folder whose rights forbid writing; root, whom rights do not bind, is somebody else meanwhile."""
    folder.chmod(0o555)
    root = os.geteuid() == 0
    if root:
        os.setresuid(65534, 65534, 0)
    try:
        yield
    finally:
        if root:
            os.setresuid(0, 0, 0)
        folder.chmod(0o755)


@contextmanager
def locked_disk(folder: Path) -> Iterator[None]:
    """A disk that is mounted read-only."""
    subprocess.run(["mount", "-o", "remount,ro", folder], check=True)
    try:
        yield
    finally:
        subprocess.run(["mount", "-o", "remount,rw", folder], check=True)


@pytest.fixture(params=["rights", "mount"])
def locked(request: pytest.FixtureRequest) -> Iterator[tuple[Path, Callable[[Path], AbstractContextManager[None]]]]:
    """A folder, and a context in which it is read-only."""
    folder = Path(tempfile.mkdtemp(prefix="facial_retarget_locked_"))
    folder.chmod(0o755)
    mount = request.param == "mount"
    try:
        if mount and not mounted(folder, DISK):
            pytest.skip("a disk that is read-only needs root, and a machine that lets it mount one")
        yield folder, locked_disk if mount else locked_folder
    finally:
        if mount and os.path.ismount(folder):
            subprocess.run(["umount", "-l", folder], check=True)
        shutil.rmtree(folder)


@every_command
def test_a_read_only_folder(command: Command, kit: Kit, locked, capsys: pytest.CaptureFixture[str]) -> None:
    folder, lock = locked
    # What is imported on the way must be there before: who has no rights may not read Python's own files.
    assert main(line(command, kit, folder / "gone")) == 2
    capsys.readouterr()
    arguments = line(command, kit, folder)
    (folder / "diary.txt").write_text("dear diary")
    before = held(folder)
    with lock(folder):
        status = main(arguments)
    refused(capsys, status, str(folder / STEM), f"the folder {folder} may not be changed")
    assert held(folder) == before


@every_command
def test_a_folder_that_is_not_there(
    command: Command, kit: Kit, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As on a drive that is gone."""
    status = main(line(command, kit, tmp_path / "gone"))
    refused(capsys, status, "there is no folder", str(tmp_path / "gone"))
    assert held(tmp_path) == {}


@every_command
def test_a_place_where_a_folder_of_other_things_is(
    command: Command, kit: Kit, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Every single output in turn: nothing of the folder goes, and nothing else appears."""
    arguments = line(command, kit, tmp_path)
    assert main(arguments) == 0
    names = sorted(entry.name for entry in tmp_path.iterdir())
    for name in names:
        shutil.rmtree(tmp_path)
        (tmp_path / name).mkdir(parents=True)
        (tmp_path / name / "diary.txt").write_text("dear diary")
        capsys.readouterr()
        status = main(arguments)
        refused(capsys, status, str(tmp_path / name))
        assert held(tmp_path) == {name: None, str(Path(name) / "diary.txt"): b"dear diary"}


STRANGE = {
    "quotes": 'it\'s "said"',
    "letters of the world": "Gesicht äöü 顔 😀",
    "signs": "a.b%20 #1 [2] $(x) back\\slash",
    "long": 110 * "ä",
}


def names(command: Command) -> list[str]:
    """Every kind of name for one command of each writer, and the worst of all for the others."""
    return (
        [*STRANGE.values()]
        if command in (COMMANDS["fap pc2"], COMMANDS["clone folder"])
        else [" ".join(STRANGE.values())[:80]]
    )


@pytest.mark.parametrize(
    ("command", "name"),
    [
        pytest.param(command, name, id=f"{key} {row}")
        for key, command in COMMANDS.items()
        for row, name in enumerate(names(command))
    ],
)
def test_strange_names(command: Command, name: str, kit: Kit, tmp_path: Path, request: pytest.FixtureRequest) -> None:
    """Of the folder and of the files: what is written is what it is under any other name."""
    if "folder" in request.node.name:  # which has no suffix
        name = name.replace(".", "_")
    folder, plain = tmp_path / name, tmp_path / "plain"
    for place, stem in ((folder, name), (plain, STEM)):
        place.mkdir()
        assert main(line(command, kit, place, stem)) == 0
    written = {key.replace(name, STEM, 1): content for key, content in held(folder).items()}
    expected = held(plain)
    assert written.keys() == expected.keys()
    for key, content in written.items():
        if not key.endswith((".json", ".html", ".fap")):  # which hold names and times
            assert content == expected[key], key


def no_constant(name: str) -> float:
    raise AssertionError(f"the report holds {name}")


def figures(path: Path) -> dict[str, object]:
    """A report; what it holds are numbers."""
    found: dict[str, object] = json.loads(path.read_text(), parse_constant=no_constant)
    return found


@pytest.mark.parametrize("frames", ["still", "single", "single still"])
@pytest.mark.parametrize("suffix", [".npz", ".pc2", ".mdd", ""])
def test_a_job_of_one_frame_and_one_that_does_not_move(
    suffix: str, frames: str, kit: Kit, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    moves = 0.0 if "still" in frames else 0.1
    write_frames(wave(1 if "single" in frames else 3, moves), kit.folder / "few.npz")
    out, report, page = tmp_path / f"out{suffix}", tmp_path / "report.json", tmp_path / "page.html"
    maps = MapOutput(tmp_path / "maps", MapSettings(pixels=32, depth="png8"))
    assert main(["run", str(kit.job("few.npz", OutputFiles(out, report, page), maps)), "--quiet"]) == 0
    rest = dome(SIDES["target"], 2.0).mesh.vertices.astype(np.float32)
    made = read_frames(out, len(rest))
    assert len(made) == (1 if "single" in frames else 3)
    if moves:
        assert 0.1 < np.abs(made - rest).max() < 0.5
    else:
        np.testing.assert_allclose(made, np.repeat(rest[None], len(made), axis=0), atol=1e-6)
    assert ("does not move" in capsys.readouterr().err) == (not moves)
    assert figures(report)["quality"]["frames"] == len(made)
    assert "nan" not in re.sub('data:image/png;base64,[^"]*', "", page.read_text()).lower()
    pictures = [png_values(file.read_bytes()) for file in sorted((tmp_path / "maps").iterdir())]
    assert len(pictures) == len(made)
    for picture in pictures:
        np.testing.assert_array_equal(picture, pictures[0])


@pytest.mark.parametrize("frames", [1, 3, MANY])
@pytest.mark.parametrize("moves", [0.0, 0.1])
@pytest.mark.parametrize("kind", ["compact", "rig"])
def test_bakes_of_few_frames_of_many_and_of_none_that_moves(
    kind: str, moves: float, frames: int, kit: Kit, tmp_path: Path
) -> None:
    """Curves times shapes are the frames, within the tolerance; a face that is still has curves that are 0, or none."""
    write_frames(np.resize(wave(min(frames, 50), moves), (frames, SIDES["source"] ** 2, 3)), kit.folder / "few.npz")
    out, report, shapes = tmp_path / "out.npz", tmp_path / "report.json", tmp_path / "shapes.npz"
    curves = tmp_path / "curves.csv", tmp_path / "curves.json"
    compact = kind == "compact"
    settings = BakeSettings(kind=kind, tolerance=0.01)
    bake = BakeOutput(settings, curves, shapes if compact else None, None if compact else kit.folder / "rig.npz")
    assert main(["run", str(kit.job("few.npz", OutputFiles(out, report), bake=bake)), "--quiet"]) == 0
    said = figures(report)["bake"]
    rows = [line.split(",") for line in curves[0].read_text().splitlines()]
    values = np.array(rows[1:], float)
    assert len(values) == frames
    json.loads(curves[1].read_text(), parse_constant=no_constant)
    if not moves:
        assert said["worst"] < 1e-6
        assert not values[:, -said["keys"] :].any() if said["keys"] else True
    elif compact:
        target = dome(SIDES["target"], 2.0).mesh
        keys = read_shapes(shapes, target)
        columns = [rows[0].index(name) for name in keys.names]
        played = target.vertices + np.einsum("fk,kvi->fvi", values[:, columns], keys.displacements)
        assert np.abs(played - read_frames(out, len(target.vertices))).max() < 0.1
        assert 1 <= said["keys"] <= 3


@pytest.mark.parametrize("values", [np.zeros((3, FAPS)), np.zeros((1, FAPS)), np.eye(1, FAPS, 2) * 500])
def test_a_take_of_one_frame_and_one_that_does_not_move(values: np.ndarray, kit: Kit, tmp_path: Path) -> None:
    """Played, and measured again."""
    write_fap(stream_of_values("take", 25.0, values, values.any(axis=0)), tmp_path / "take.fap")
    arguments = ["fap", tmp_path / "take.fap", *kit.face, "--out", tmp_path / "out.npz"]
    beside = ["--report", tmp_path / "report.json", "--page", tmp_path / "page.html", "--quiet"]
    assert main([*map(str, arguments + beside)]) == 0
    assert figures(tmp_path / "report.json")["motion"]["frames"] == len(values)
    back = ["fap", tmp_path / "out.npz", *kit.face, "--fps", "25", "--out", tmp_path / "back.fap", "--quiet"]
    assert main([*map(str, back)]) == 0
    measured = read_fap(tmp_path / "back.fap").values
    assert len(measured) == len(values)
    assert abs(measured[:, 2] - values[:, 2]).max() <= 5
    if not values.any():
        assert not measured.any()


def test_weights_of_a_single_frame_are_read_again_where_the_rate_is_told(tmp_path: Path) -> None:
    weights = np.linspace(0, 1, len(ARKIT_NAMES))[None]
    write_arkit_csv(ArkitTake("take", 30.0, weights, None, None), tmp_path / "take.csv")
    found = read_arkit_csv(tmp_path / "take.csv", 30.0)
    assert found.fps == 30
    np.testing.assert_allclose(found.weights, weights, atol=1e-9)
    with pytest.raises(RetargetError, match="has 1 frames"):
        read_arkit_csv(tmp_path / "take.csv")


def test_a_shape_that_moves_nothing_is_cloned_as_one(kit: Kit, tmp_path: Path) -> None:
    actor = read_mesh(kit.folder / "actor.obj")
    still = ShapeSet.of_positions(actor.mesh.vertices, {"still": actor.mesh.vertices})
    with written_whole() as aside:
        add_shapes(aside, still, tmp_path / "still.npz", actor)
    head = [kit.folder / "actor.obj", kit.folder / "actor.json"]
    ways = ["--source", *head, tmp_path / "still.npz", "--target", *head, tmp_path / "out.npz", "--page", "--quiet"]
    assert main(["clone", *map(str, ways)]) == 0
    (made,) = read_shapes(tmp_path / "out.npz", actor.mesh).displacements
    assert np.abs(made).max() < 1e-6
    figures(tmp_path / "out.report.json")


@pytest.mark.parametrize("suffix", [".npz", ".pc2", ".mdd", ""])
def test_ten_thousand_frames_on_disk(suffix: str, tmp_path: Path) -> None:
    frames = np.arange(MANY * 9 * 3, dtype=np.float32).reshape(MANY, 9, 3) / 1024
    out = tmp_path / f"out{suffix}"
    write_frames(frames, out)
    np.testing.assert_array_equal(read_frames(out, 9), frames)
    if not suffix:
        names = sorted(file.name for file in out.iterdir())
        assert (names[0], names[-1]) == ("frame_00001.obj", "frame_10000.obj")


def test_a_job_of_ten_thousand_frames(kit: Kit, tmp_path: Path) -> None:
    write_frames(np.tile(wave(100), (MANY // 100, 1, 1)), kit.folder / "many.npz")
    out, report, page = tmp_path / "out.npz", tmp_path / "report.json", tmp_path / "page.html"
    assert main(["run", str(kit.job("many.npz", OutputFiles(out, report, page))), "--quiet"]) == 0
    made = read_frames(out, SIDES["target"] ** 2)
    assert len(made) == MANY
    np.testing.assert_array_equal(made[-100:], made[:100])
    assert figures(report)["quality"]["frames"] == MANY
    assert page.stat().st_size < 1 << 20
