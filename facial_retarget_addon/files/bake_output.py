"""The performance as few shape keys with curves: what a job says of it, what is read for it, what is written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

import numpy as np

from ..core.arrays import FloatArray, Progress, no_progress
from ..core.base.regions import eye_separation
from ..core.errors import RetargetError
from ..core.methods.settings import BakeSettings, read_values
from ..core.mpeg4.conversions import stream_of_values
from ..core.mpeg4.faps import FAPS
from ..core.mpeg4.stream import FapStream
from ..core.problem import Face
from ..core.reduction.bake_keys import BakedKeys, RigKeys, check_rig, compact_keys, onto_rig
from ..core.shapes.parameters import parameter_of
from ..core.shapes.shape_set import ShapeSet
from .curves import Curves, add_curves, check_curves_place
from .documents import Table
from .job_values import read_optional_path, read_texts, relative, toml
from .mesh_file import MeshFile
from .motion.fap import add_fap
from .motion.rates import checked_rate
from .shape_files import add_shapes, check_shapes_place, read_shapes
from .whole import Aside, check_place

KINDS = ("compact", "rig")
"""Bakes that a job can do; frames themselves are its [output] frames."""
NUMBERS = tuple(f for f in fields(BakeSettings) if f.name != "kind")
"""The settings of a bake besides its kind."""
_FAP = ".fap"
"""Curves as the FAPs that the shapes of a rig are."""
_PATHS = ("curves", "shapes", "rig", "ranges")
"""What the table has besides the settings."""


@dataclass(frozen=True)
class BakeOutput:
    """What a job says of a bake.

    Attributes
    ----------
    settings : of a kind among `KINDS`.
    curves : where the curves of all keys go, .csv or .json; .fap where the rig's shapes are FAPs.
    shapes : where the new keys go; None where there are none.
    rig : the target's own shapes, which kind rig moves.
    ranges : shape of the rig -> its lowest and highest value, where that is not its `usual_range`.
    """

    settings: BakeSettings
    curves: tuple[Path, ...]
    shapes: Path | None = None
    rig: Path | None = None
    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict)

    def outputs(self) -> dict[str, Path]:
        """What is written: how the job file names it -> its path."""
        named = {f"[bake] curves {number}": path for number, path in enumerate(self.curves, start=1)}
        return named if self.shapes is None else {**named, "[bake] shapes": self.shapes}


def usual_range(name: str) -> tuple[float, float]:
    """Values that a shape of a rig may have, unless the job says otherwise: 0 to 1, a FAP of both ways -1 to 1."""
    known = parameter_of(name)
    return (known.low / known.high, 1.0)


def read_bake(root: Table, folder: Path) -> BakeOutput | None:
    """The [bake] of a job, None where it has none; faults are collected."""
    if (values := root.optional("bake", dict)) is None:
        return None
    table = Table(values, "[bake]", root.wrong)
    if table.get("kind", str) not in KINDS:
        root.wrong.append(f"[bake] can be of kind {' or '.join(KINDS)}; the frames themselves are [output] frames")
        return None
    curves = tuple(folder / text for text in read_texts(table, "curves") or ())
    if not curves or folder in curves:
        root.wrong.append("[bake] curves names no files, expected a list of paths")
    shapes, rig = read_optional_path(table, "shapes", folder), read_optional_path(table, "rig", folder)
    ranges = _read_ranges(table)
    settings = {name: value for name, value in values.items() if name not in _PATHS}
    try:
        how = read_values(BakeSettings, settings, "[bake]")
    except RetargetError as error:
        root.wrong.append(str(error))
        return None
    output = BakeOutput(how, curves, shapes, rig, ranges)
    root.wrong += _contradictions(output)
    return output


def _read_ranges(table: Table) -> dict[str, tuple[float, float]]:
    ranges: dict[str, tuple[float, float]] = {}
    for name, ends in (table.optional("ranges", dict) or {}).items():
        plain = isinstance(ends, list) and len(ends) == 2 and all(type(end) in (int, float) for end in ends)
        if not plain or not -np.inf < ends[0] < ends[1] < np.inf:
            table.wrong.append(f"[bake] ranges {name!r} = {ends!r:.60}, expected a lowest and a greater highest value")
        else:
            ranges[name] = float(ends[0]), float(ends[1])
    return ranges


def _contradictions(output: BakeOutput) -> list[str]:
    kind, residual = output.settings.kind, output.settings.residual
    wrong = []
    if (output.rig is None) == (kind == "rig"):
        state = "is missing, expected the target's own shapes" if kind == "rig" else "says nothing"
        wrong.append(f"[bake] rig {state} where kind = {kind!r}")
    if output.ranges and kind != "rig":
        wrong.append(f"[bake] ranges says nothing where kind = {kind!r}")
    makes = kind == "compact" or residual > 0
    if makes and output.shapes is None:
        wrong.append("[bake] shapes is missing, expected a path for the new keys")
    if not makes and output.shapes is not None:
        wrong.append("[bake] shapes would hold nothing: kind = 'rig' has new keys where residual is above 0 alone")
    faps = [path for path in output.curves if path.suffix.lower() == _FAP]
    if faps and kind != "rig":
        wrong.append(f"[bake] curves has {faps[0].name!r}, but kind = {kind!r} has no FAPs")
    elif makes and faps == list(output.curves):
        wrong.append("[bake] curves is FAPs alone, which leave out the new keys; expected a .csv or .json as well")
    return wrong


def bake_lines(output: BakeOutput, folder: Path) -> list[str]:
    """The [bake] of a job file in a folder."""
    paths = {"rig": output.rig, "shapes": output.shapes}
    lines = ["", "[bake]", f"kind = {toml(output.settings.kind)}"]
    lines += [f"{key} = {toml(relative(path, folder))}" for key, path in paths.items() if path is not None]
    lines.append(f"curves = {toml(tuple(relative(path, folder) for path in output.curves))}")
    lines += [f"{f.name} = {toml(getattr(output.settings, f.name))}" for f in NUMBERS]
    if output.ranges:
        lines += ["", "[bake.ranges]"]
        lines += [f"{toml(name)} = {toml(ends)}" for name, ends in output.ranges.items()]
    return lines


def check_bake_places(output: BakeOutput, fps: float) -> None:
    """RetargetError for the first output that cannot be written where the job says, at so many frames a second."""
    for path in output.curves:
        if path.suffix.lower() == _FAP:
            check_place(path)
            checked_rate(path, fps)
        else:
            check_curves_place(path)
    if output.shapes is not None:
        check_shapes_place(output.shapes)


def read_rig(output: BakeOutput, target: MeshFile) -> RigKeys | None:
    """The shapes that a bake moves, None where it makes its own.

    Raises
    ------
    RetargetError : as `read_shapes` and `check_rig`; for a range of a shape that is not among them; for a shape that is
        no FAP where curves go to a .fap.
    """
    if output.rig is None:
        return None
    shapes = read_shapes(output.rig, target.mesh)
    unknown = sorted(set(output.ranges) - set(shapes.names))
    if unknown:
        raise RetargetError(f"[bake] ranges has a shape {unknown[0]!r}, which {output.rig} lacks")
    others = [name for name in shapes.names if parameter_of(name).kind != "fap"]
    if others and any(path.suffix.lower() == _FAP for path in output.curves):
        raise RetargetError(f"{output.rig}: shape {others[0]!r} is no FAP, expected such alone for curves in a {_FAP}")
    ends = np.array([output.ranges.get(name, usual_range(name)) for name in shapes.names])
    rig = RigKeys(shapes.names, shapes.displacements, ends[:, 0], ends[:, 1])
    try:
        check_rig(rig, output.settings)
    except RetargetError as error:
        raise RetargetError(f"{output.rig}: {error}") from error
    return rig


def bake_frames(
    output: BakeOutput, rig: RigKeys | None, target: Face, frames: FloatArray, progress: Progress = no_progress
) -> tuple[BakedKeys, dict[str, Any]]:
    """Frames (F, V, 3) of the target as keys, and figures for the report.

    Raises
    ------
    RetargetError : as `compact_keys` and `onto_rig`.
    """
    unit = eye_separation(target.mesh, target.points)
    if rig is None:
        baked = compact_keys(target, unit, frames, output.settings, progress)
    else:
        baked = onto_rig(target, rig, frames, output.settings, progress)
    return baked, {"kind": output.settings.kind, "frames": len(frames), **baked.figures(unit)}


def add_bake(aside: Aside, output: BakeOutput, baked: BakedKeys, neutral: MeshFile, frames: range, fps: float) -> None:
    """Write curves and new keys among outputs that appear together.

    Parameters
    ----------
    frames : numbers of the frames. fps : frame numbers a second.
    """
    curves = Curves(baked.names, frames, baked.keyed.curves, fps)
    for path in output.curves:
        if path.suffix.lower() == _FAP:
            add_fap(aside, _faps(path.stem, baked, fps / frames.step), path)
        else:
            add_curves(aside, curves, path)
    if output.shapes is not None:
        first = len(baked.names) - baked.made
        new = ShapeSet(baked.names[first:], baked.keyed.shapes[first:])
        add_shapes(aside, new, output.shapes, neutral)


def _faps(name: str, baked: BakedKeys, fps: float) -> FapStream:
    """The curves of a rig of FAPs as a stream."""
    values, used = np.zeros((len(baked.keyed.curves), len(FAPS))), np.zeros(len(FAPS), bool)
    for shape, curve in zip(baked.names[: len(baked.names) - baked.made], baked.keyed.curves.T, strict=False):
        parameter = parameter_of(shape)
        column = int(parameter.key) - 1
        values[:, column], used[column] = parameter.high * curve, True
    return stream_of_values(name, fps, values, used)
