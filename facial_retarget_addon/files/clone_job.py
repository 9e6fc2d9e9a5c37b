"""Clone jobs: a set of shapes and the heads that get it, in TOML. The panel saves them, the command line runs them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path

from ..core.errors import RetargetError
from ..core.methods.settings import (
    LEVELED,
    LevelSettings,
    MotionCloningSettings,
    Settings,
    WrinkleSettings,
    read_values,
)
from ..core.shapes.prepare import Preparation
from ..core.shapes.sides import SideNames
from .documents import Table, fault_sentence, read_toml
from .job import FaceFiles
from .job_values import (
    check_method,
    read_method_settings,
    read_optional_path,
    read_path,
    read_texts,
    relative,
    toml,
)
from .whole import overwritten, write_whole

VERSION = 1
METHOD = "motion_cloning"
"""The method where the job names none."""
OPTIONAL_OUTPUTS = ("report", "page", "sheet", "wrinkles")
"""What a target may have beside its shapes."""


@dataclass(frozen=True)
class TargetFiles:
    """A head that gets the shapes.

    Attributes
    ----------
    face : its neutral, points and named parts.
    shapes : where its shapes go, see `add_shapes`.
    corrected : shapes of it that the artist corrected, see `read_shapes`; the others learn from them.
    report, page, sheet : where figures (JSON), pictures with figures (HTML) and one contact sheet (PNG) go.
    wrinkles : the folder that a wrinkle kit for them becomes.
    """

    face: FaceFiles
    shapes: Path
    corrected: Path | None = None
    report: Path | None = None
    page: Path | None = None
    sheet: Path | None = None
    wrinkles: Path | None = None


@dataclass(frozen=True)
class SourceFiles:
    """A head that has the shapes.

    Attributes
    ----------
    face : its neutral, points and named parts.
    shapes : see `read_shapes`.
    """

    face: FaceFiles
    shapes: Path

    @property
    def name(self) -> str:
        """What reports call it."""
        return self.face.neutral.name


@dataclass(frozen=True)
class BuiltInActor:
    """The built-in actor, in place of files.

    Attributes
    ----------
    sets : of its shapes: some of arkit, visemes, expressions.
    """

    sets: tuple[str, ...]

    @property
    def name(self) -> str:
        """What reports call it."""
        return "the built-in actor"


@dataclass(frozen=True)
class CloneJob:
    """Shapes of one head for one or many others. Its paths are absolute; in the file they are relative to its folder.

    Attributes
    ----------
    source : where the shapes come from.
    targets : the heads that get them.
    preparation : which shapes, and what is made of them before they go over.
    path : the job file itself, None for a job of the command line's own.
    wrinkle_kit : how wrinkle kits are made, for targets that get one.
    """

    source: SourceFiles | BuiltInActor
    targets: tuple[TargetFiles, ...]
    preparation: Preparation = field(default_factory=Preparation)
    method: str = METHOD
    settings: Settings = field(default_factory=MotionCloningSettings)
    path: Path | None = None
    wrinkle_kit: WrinkleSettings = field(default_factory=WrinkleSettings)

    def inputs(self) -> dict[str, Path]:
        """What is read: how the job file names it -> its path."""
        named: dict[str, Path | None] = {"the job file": self.path}
        if isinstance(self.source, SourceFiles):
            named |= {"[source] shapes": self.source.shapes} | _face_paths("[source]", self.source.face)
        for number, target in enumerate(self.targets, start=1):
            named |= _face_paths(_where(number), target.face)
            named[f"{_where(number)} corrected"] = target.corrected
        return {name: path for name, path in named.items() if path is not None}

    def outputs(self) -> dict[str, Path]:
        """What is written: how the job file names it -> its path."""
        named = {
            f"{_where(number)} {key}": getattr(target, key)
            for number, target in enumerate(self.targets, start=1)
            for key in ("shapes", *OPTIONAL_OUTPUTS)
        }
        return {name: path for name, path in named.items() if path is not None}


def _where(number: int) -> str:
    return f"[[targets]] {number}"


def _face_paths(where: str, face: FaceFiles) -> dict[str, Path | None]:
    return {f"{where} {key}": getattr(face, key) for key in ("neutral", "points", "parts")}


def is_clone_job(path: Path) -> bool:
    """Whether a job file is a clone job's: it has targets. RetargetError if it is no TOML document."""
    return "targets" in read_toml(path)


def read_clone_job(path: Path) -> CloneJob:
    """Read a clone job.

    Raises
    ------
    RetargetError : if it cannot be read, or has missing or unknown keys, wrong types or values; names all of them.
    """
    path = path.absolute()
    wrong: list[str] = []
    root = Table(read_toml(path), "", wrong)
    root.expect("version", VERSION)
    method = root.optional("method", str) or METHOD
    check_method(method, wrong)
    source = root.table("source")
    job = CloneJob(
        source=_read_source(source, path.parent),
        targets=_read_targets(root, path.parent),
        preparation=_read_preparation(root),
        method=method,
        settings=read_method_settings(method, root),
        path=path,
        wrinkle_kit=_read_wrinkle_kit(root),
    )
    wrong += _kit_faults(job)
    source.no_more()
    root.no_more()
    if not wrong:
        wrong += overwritten(job.inputs(), job.outputs())
    if wrong:
        raise RetargetError(fault_sentence(path, wrong))
    return job


def _read_source(table: Table, folder: Path) -> SourceFiles | BuiltInActor:
    sets = read_texts(table, "actor")
    if sets is not None:
        return BuiltInActor(sets)
    return SourceFiles(_read_face(table, folder), read_path(table, "shapes", folder))


def _read_face(table: Table, folder: Path) -> FaceFiles:
    return FaceFiles(
        read_path(table, "neutral", folder),
        read_path(table, "points", folder),
        parts=read_optional_path(table, "parts", folder),
    )


def _read_targets(root: Table, folder: Path) -> tuple[TargetFiles, ...]:
    targets: list[TargetFiles] = []
    faults = len(root.wrong)
    for number, values in enumerate(root.get("targets", list), start=1):
        table = Table(values, _where(number), root.wrong)
        optional = {key: read_optional_path(table, key, folder) for key in ("corrected", *OPTIONAL_OUTPUTS)}
        targets.append(TargetFiles(_read_face(table, folder), read_path(table, "shapes", folder), **optional))
        table.no_more()
    if not targets and len(root.wrong) == faults:
        root.wrong.append("targets is empty, expected at least one [[targets]]")
    return tuple(targets)


def _read_wrinkle_kit(root: Table) -> WrinkleSettings:
    try:
        return read_values(WrinkleSettings, root.optional("wrinkle_kit", dict) or {}, "[wrinkle_kit]")
    except RetargetError as error:
        root.wrong.append(str(error))
        return WrinkleSettings()


def _kit_faults(job: CloneJob) -> list[str]:
    """What the method cannot do for the wrinkle kits."""
    named = [f"{_where(number)} wrinkles" for number, target in enumerate(job.targets, start=1) if target.wrinkles]
    if not named:
        return []
    if not isinstance(job.settings, LevelSettings):
        return [f"{named[0]} needs a method with levels, expected one of {', '.join(LEVELED)}, not {job.method}"]
    if job.wrinkle_kit.level > job.settings.levels:
        return [
            f"[wrinkle_kit] level = {job.wrinkle_kit.level}, expected one of the {job.settings.levels} in [settings], "
            "or 0"
        ]
    return []


def _read_preparation(root: Table) -> Preparation:
    values = root.optional("shapes", dict)
    if values is None:
        return Preparation()
    table, default = Table(values, "[shapes]", root.wrong), Preparation()
    keep, drop, split, sides = (read_texts(table, key) for key in ("keep", "drop", "split", "sides"))
    if sides is not None and (len(sides) != 2 or sides[0] == sides[1]):
        table.wrong.append(f"[shapes] sides = {list(sides)!r:.60}, expected the left and the right half's ending")
        sides = None
    feather = table.optional("feather", float)
    found = Preparation(
        keep=default.keep if keep is None else keep,
        drop=drop or (),
        arkit_wholes=table.optional("arkit_wholes", bool) or False,
        merge=_read_lists(table, "merge"),
        split=split or (),
        feather=default.feather if feather is None else feather,
        sides=None if sides is None else SideNames(*sides),
        arkit_names=table.optional("arkit_names", bool) or False,
        correctives=_read_lists(table, "correctives"),
    )
    table.no_more()
    return found


def _read_lists(table: Table, key: str) -> dict[str, tuple[str, ...]]:
    """A table of lists of texts; empty where it is missing."""
    inner = Table(table.optional(key, dict) or {}, f"{table.where[:-1]}.{key}]", table.wrong)
    return {name: read_texts(inner, name) or () for name in inner.names()}


def write_clone_job(job: CloneJob, path: Path) -> None:
    """Write a clone job, whole or not at all; paths inside its folder are written relative to it.

    `read_clone_job` gives the same job back, but for its `path`.

    Raises
    ------
    RetargetError : if the system refuses to write, or a name or path is no Unicode text.
    """
    folder = path.absolute().parent
    lines = [f"version = {VERSION}", f"method = {toml(job.method)}", "", "[source]"]
    if isinstance(job.source, BuiltInActor):
        lines.append(f"actor = {toml(job.source.sets)}")
    else:
        lines += _path_lines({"shapes": job.source.shapes} | _face_files(job.source.face), folder)
    lines += _preparation_lines(job.preparation)
    for target in job.targets:
        own = {key: getattr(target, key) for key in ("shapes", "corrected", *OPTIONAL_OUTPUTS)}
        lines += ["", "[[targets]]", *_path_lines(_face_files(target.face) | own, folder)]
    kit = [f"{f.name} = {toml(getattr(job.wrinkle_kit, f.name))}" for f in fields(WrinkleSettings)]
    lines += ["", "[wrinkle_kit]", *kit] if any(target.wrinkles for target in job.targets) else []
    lines += ["", "[settings]"]
    lines += [f"{field.name} = {toml(getattr(job.settings, field.name))}" for field in fields(job.settings)]
    write_whole(path, ("\n".join(lines) + "\n").encode())


def _face_files(face: FaceFiles) -> dict[str, Path | None]:
    return {"neutral": face.neutral, "points": face.points, "parts": face.parts}


def _path_lines(files: Mapping[str, Path | None], folder: Path) -> list[str]:
    return [f"{key} = {toml(relative(file, folder))}" for key, file in files.items() if file is not None]


def _preparation_lines(how: Preparation) -> list[str]:
    """The [shapes] of a job: what differs from the default."""
    default = Preparation()
    lines = ["", "[shapes]"]
    for key in ("keep", "drop", "arkit_wholes", "split", "feather", "arkit_names"):
        if getattr(how, key) != getattr(default, key):
            lines.append(f"{key} = {toml(getattr(how, key))}")
    if how.sides is not None:
        lines.append(f"sides = {toml(tuple(how.sides))}")
    for key, lists in (("merge", how.merge), ("correctives", how.correctives)):
        if lists:
            lines += ["", f"[shapes.{key}]", *(f"{toml(name)} = {toml(tuple(parts))}" for name, parts in lists.items())]
    return lines if len(lines) > 2 else []
