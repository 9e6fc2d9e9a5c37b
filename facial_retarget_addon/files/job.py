"""Job files: a whole retargeting task in TOML. The panel saves them, the command line runs them."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

from ..core.errors import RetargetError
from ..core.methods.settings import LEVELED, MASK_GAIN, LevelSettings, MapSettings, RegionGains, Settings, read_values
from .bake_output import BakeOutput, bake_lines, read_bake
from .documents import Table, fault_sentence, read_toml
from .frame_range import EVERY_FRAME, FrameRange
from .frames import FPS
from .job_values import check_method, read_method_settings, read_optional_path, read_path, relative, toml
from .motion.rates import FASTEST
from .whole import overwritten, write_whole

VERSION = 1


@dataclass(frozen=True)
class FaceFiles:
    """Files of one face: its neutral mesh, its feature points, the frames it acts (the source's), its named parts."""

    neutral: Path
    points: Path | None = None
    frames: Path | None = None
    parts: Path | None = None


@dataclass(frozen=True)
class ExampleFiles:
    """One example expression: the same moment on both faces, as meshes."""

    name: str
    source: Path
    target: Path


@dataclass(frozen=True)
class MaskFile:
    """A painted mask of the target, and how strong the motion is where it is 1."""

    name: str
    weights: Path
    gain: float


@dataclass(frozen=True)
class OutputFiles:
    """Where the results go: the target's frames, the figures (JSON), the page to look at (HTML).

    frames : None for a job of bakes or normal maps alone.
    """

    frames: Path | None = None
    report: Path | None = None
    page: Path | None = None


@dataclass(frozen=True)
class MapOutput:
    """The folder that the normal maps become, and how they are made."""

    folder: Path
    settings: MapSettings


@dataclass(frozen=True)
class Job:
    """A retargeting task. Its paths are absolute; in the file they are relative to the file's folder.

    base : a base mesh of the artist's own, or None.
    path : the job file itself.
    regions, masks : how strong the motion is at each place of the target.
    normal_maps, bake : None for none.
    chosen : which of the source's frames. fps : how many of them, chosen or not, there are a second.
    """

    method: str
    source: FaceFiles
    target: FaceFiles
    examples: tuple[ExampleFiles, ...]
    settings: Settings
    output: OutputFiles
    base: Path | None
    path: Path
    regions: RegionGains = field(default_factory=RegionGains)
    masks: tuple[MaskFile, ...] = ()
    normal_maps: MapOutput | None = None
    bake: BakeOutput | None = None
    chosen: FrameRange = EVERY_FRAME
    fps: float = FPS

    @property
    def main_output(self) -> Path:
        """What the job is about: its frames, or else its bake's curves, or its normal maps."""
        if self.output.frames is not None:
            return self.output.frames
        if self.bake is not None:
            return self.bake.curves[0]
        assert self.normal_maps is not None
        return self.normal_maps.folder

    def inputs(self) -> dict[str, Path]:
        """What is read: how the job file names it -> its path."""
        named = {
            "base": self.base,
            "[source] neutral": self.source.neutral,
            "[source] points": self.source.points,
            "[source] parts": self.source.parts,
            "[source] frames": self.source.frames,
            "[target] neutral": self.target.neutral,
            "[target] points": self.target.points,
            "[target] parts": self.target.parts,
        }
        for example in self.examples:
            named[f"example {example.name!r} source"] = example.source
            named[f"example {example.name!r} target"] = example.target
        named |= {f"mask {mask.name!r}": mask.weights for mask in self.masks}
        named["[bake] rig"] = None if self.bake is None else self.bake.rig
        return {name: path for name, path in named.items() if path is not None}

    def outputs(self) -> dict[str, Path]:
        """What is written: how the job file names it -> its path."""
        named = {"frames": self.output.frames, "report": self.output.report, "page": self.output.page}
        written = {f"[output] {name}": path for name, path in named.items() if path is not None}
        if self.normal_maps is not None:
            written["[normal_maps] folder"] = self.normal_maps.folder
        return written if self.bake is None else written | self.bake.outputs()


def read_job(path: Path) -> Job:
    """Read a job file.

    Raises
    ------
    RetargetError : if it cannot be read, or has missing or unknown keys, wrong types or values; names all of them.
    """
    path = path.absolute()
    wrong: list[str] = []
    root = Table(read_toml(path), "", wrong)
    root.expect("version", VERSION)
    method = root.get("method", str)
    check_method(method, wrong)
    source = root.table("source")
    chosen, fps = _read_timing(source)
    job = Job(
        method=method,
        source=_read_face(source, path.parent, ("points", "parts"), ("frames",)),
        target=_read_face(root.table("target"), path.parent, ("points", "parts"), ()),
        examples=_read_examples(root, path.parent),
        settings=read_method_settings(method, root),
        output=_read_output(root, path.parent),
        base=read_optional_path(root, "base", path.parent),
        path=path,
        regions=_read_regions(root),
        masks=_read_masks(root, path.parent),
        normal_maps=_read_normal_maps(root, path.parent),
        bake=read_bake(root, path.parent),
        chosen=chosen,
        fps=fps,
    )
    if job.normal_maps is not None:
        wrong += _map_faults(job.normal_maps, method, job.settings)
    root.no_more()
    if not wrong:
        wrong += overwritten({"the job file": job.path, **job.inputs()}, job.outputs())
    if wrong:
        raise RetargetError(fault_sentence(path, wrong))
    return job


def _read_face(table: Table, folder: Path, optional: tuple[str, ...], required: tuple[str, ...]) -> FaceFiles:
    found: dict[str, Any] = {key: read_path(table, key, folder) for key in ("neutral", *required)}
    found |= {key: read_optional_path(table, key, folder) for key in optional}
    table.no_more()
    return FaceFiles(**found)


def _read_timing(source: Table) -> tuple[FrameRange, float]:
    """Which frames of the source are wanted, and how many there are a second."""
    text, fps = source.optional("range", str), source.optional("fps", float)
    if fps is not None and not 0 < fps <= FASTEST:
        source.wrong.append(f"{source.where} fps = {fps:g}, expected a number above 0, at most {FASTEST:g}")
    try:
        chosen = EVERY_FRAME if text is None else FrameRange.of_text(text)
    except RetargetError as error:
        source.wrong.append(f"{source.where} range: {error}")
        chosen = EVERY_FRAME
    return chosen, FPS if fps is None else fps


def _read_examples(root: Table, folder: Path) -> tuple[ExampleFiles, ...]:
    examples: list[ExampleFiles] = []
    for number, values in enumerate(root.optional("examples", list) or [], start=1):
        table = Table(values, f"[[examples]] {number}", root.wrong)
        name = table.get("name", str)
        if any(name == other.name for other in examples):
            root.wrong.append(f"{table.where} name {name!r} appears twice, expected unique names")
        examples.append(ExampleFiles(name, read_path(table, "source", folder), read_path(table, "target", folder)))
        table.no_more()
    return tuple(examples)


def _read_regions(root: Table) -> RegionGains:
    try:
        return read_values(RegionGains, root.optional("regions", dict) or {}, "[regions]")
    except RetargetError as error:
        root.wrong.append(str(error))
        return RegionGains()


def _read_masks(root: Table, folder: Path) -> tuple[MaskFile, ...]:
    masks: list[MaskFile] = []
    for number, values in enumerate(root.optional("masks", list) or [], start=1):
        table = Table(values, f"[[masks]] {number}", root.wrong)
        mask = MaskFile(table.get("name", str), read_path(table, "weights", folder), table.get("gain", float))
        if any(mask.name == other.name for other in masks):
            root.wrong.append(f"{table.where} name {mask.name!r} appears twice, expected unique names")
        if not MASK_GAIN["low"] <= mask.gain <= MASK_GAIN["high"]:
            limits = f"a number from {MASK_GAIN['low']} to {MASK_GAIN['high']}"
            root.wrong.append(f"{table.where} gain = {mask.gain!r}, expected {limits}")
        masks.append(mask)
        table.no_more()
    return tuple(masks)


def _read_normal_maps(root: Table, folder: Path) -> MapOutput | None:
    values = root.optional("normal_maps", dict)
    if values is None:
        return None
    table = Table(values, "[normal_maps]", root.wrong)
    place = read_path(table, "folder", folder)
    try:
        rest = {name: value for name, value in values.items() if name != "folder"}
        return MapOutput(place, read_values(MapSettings, rest, "[normal_maps]"))
    except RetargetError as error:
        root.wrong.append(str(error))
        return None


def _map_faults(maps: MapOutput, method: str, settings: Settings) -> list[str]:
    """What the method cannot do for the maps."""
    if not isinstance(settings, LevelSettings):
        return [f"[normal_maps] need a method with levels, expected one of {', '.join(LEVELED)}, not {method}"]
    if maps.settings.level > settings.levels:
        return [
            f"[normal_maps] level = {maps.settings.level}, expected one of the {settings.levels} in [settings], or 0"
        ]
    return []


def _read_output(root: Table, folder: Path) -> OutputFiles:
    table = Table(root.optional("output", dict) or {}, "[output]", root.wrong)
    output = OutputFiles(
        read_optional_path(table, "frames", folder),
        read_optional_path(table, "report", folder),
        read_optional_path(table, "page", folder),
    )
    table.no_more()
    if output.frames is None and not {"bake", "normal_maps"} & set(root.names()):
        root.wrong.append("[output] frames is missing, expected a path, since there is no [bake] and no [normal_maps]")
    return output


def write_job(job: Job, path: Path) -> None:
    """Write a job file, whole or not at all; paths inside its folder are written relative to it.

    `read_job` gives the same job back, but for its `path`.

    Raises
    ------
    RetargetError : if the system refuses to write, or a name or path is no Unicode text.
    """
    folder = path.absolute().parent
    lines = [f"version = {VERSION}", f"method = {toml(job.method)}"]
    if job.base is not None:
        lines.append(f"base = {toml(relative(job.base, folder))}")
    lines += _face_lines("source", job.source, folder)
    lines += [] if job.chosen.whole else [f"range = {toml(str(job.chosen))}"]
    lines += [] if job.fps == FPS else [f"fps = {toml(job.fps)}"]
    lines += _face_lines("target", job.target, folder)
    for example in job.examples:
        lines += ["", "[[examples]]", f"name = {toml(example.name)}"]
        lines += [f"{key} = {toml(relative(getattr(example, key), folder))}" for key in ("source", "target")]
    gains = {f.name: getattr(job.regions, f.name) for f in fields(RegionGains)}
    if job.regions != RegionGains():
        lines += ["", "[regions]", *(f"{name} = {toml(gain)}" for name, gain in gains.items() if gain != 1.0)]
    for mask in job.masks:
        weights = toml(relative(mask.weights, folder))
        lines += ["", "[[masks]]", f"name = {toml(mask.name)}", f"weights = {weights}", f"gain = {toml(mask.gain)}"]
    if job.normal_maps is not None:
        lines += ["", "[normal_maps]", f"folder = {toml(relative(job.normal_maps.folder, folder))}"]
        lines += [f"{f.name} = {toml(getattr(job.normal_maps.settings, f.name))}" for f in fields(MapSettings)]
    lines += [] if job.bake is None else bake_lines(job.bake, folder)
    lines += ["", "[settings]"]
    lines += [f"{field.name} = {toml(getattr(job.settings, field.name))}" for field in fields(job.settings)]
    lines += ["", "[output]"]
    files = {"frames": job.output.frames, "report": job.output.report, "page": job.output.page}
    lines += [f"{key} = {toml(relative(file, folder))}" for key, file in files.items() if file is not None]
    write_whole(path, ("\n".join(lines) + "\n").encode())


def _face_lines(name: str, face: FaceFiles, folder: Path) -> list[str]:
    files = {"neutral": face.neutral, "points": face.points, "parts": face.parts, "frames": face.frames}
    return ["", f"[{name}]"] + [
        f"{key} = {toml(relative(file, folder))}" for key, file in files.items() if file is not None
    ]
