"""What the panel clones as a clone job, with all that it needs beside it: for the command line, here or elsewhere."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from bpy.types import Context, PropertyGroup

from ...core.errors import RetargetError
from ...core.shapes.shape_set import ShapeSet
from ...demo.shape_sets import POSES
from ...files.clone_job import BuiltInActor, CloneJob, SourceFiles, TargetFiles, write_clone_job
from ...files.shape_files import add_shapes
from ...files.whole import Aside, written_whole
from ..beside import Beside
from ..heads import Head, read_head
from ..settings import read_method_settings
from .clone_wishes import Origin, origins, preparation, wanted_names
from .cloning import target_faces
from .donors import read_source_head
from .resolving import cloned_origins, find_corrected


def save_clone_job(context: Context, path: Path) -> None:
    """Save what the panel clones: a clone job, its heads, shapes and corrections beside it, together or not at all.

    Raises
    ------
    RetargetError : for anything that the cloning lacks, or if the system refuses to write.
    """
    task = context.scene.facial_retarget
    settings = read_method_settings(task, task.cloning.method)
    heads = [read_head(face) for face in target_faces(context)]
    with written_whole() as aside:
        files = _HeadFiles(path, aside)
        source, names = _source(task, files)
        how = preparation(task.cloning)
        made = {origin: name for name, origin in origins(wanted_names(names, task.cloning), how).items()}
        targets = tuple(_target(head, made, f"target_{number}", files) for number, head in enumerate(heads, start=1))
        job = CloneJob(source, targets, how, task.cloning.method, settings, path)
        write_clone_job(job, aside.place(path))


class _HeadFiles(Beside):
    """The files of a clone job's heads."""

    def __init__(self, job: Path, aside: Aside) -> None:
        super().__init__(job, aside)
        self._aside = aside

    def shapes(self, name: str, shapes: ShapeSet, head: Head) -> Path:
        """Write shapes of a head."""
        add_shapes(self._aside, shapes, self.path(name), head.file)
        return self.path(name)


def _source(task: PropertyGroup, files: _HeadFiles) -> tuple[SourceFiles | BuiltInActor, list[str]]:
    """Where the job's shapes come from, and the names of all of them."""
    if task.cloning.donor == "ACTOR":
        sets = tuple(sorted(task.cloning.actor_sets))
        if not sets:
            raise RetargetError("no set of the built-in actor is chosen, expected ARKit, visemes or expressions")
        return BuiltInActor(sets), [name for chosen in sets for name in POSES[chosen]]
    head = read_source_head(task)
    names = head.key_names()
    shapes = ShapeSet(tuple(names), head.displacements(names))
    return SourceFiles(files.head("source", head), files.shapes("source_shapes.json", shapes, head)), names


def _target(head: Head, made: Mapping[Origin, str], role: str, files: _HeadFiles) -> TargetFiles:
    """A head that gets the shapes, made from their origins, and its corrections of them."""
    origin = cloned_origins(head)
    corrected = {made[origin[key]]: key for key in find_corrected(head) if origin[key] in made}
    shapes = ShapeSet(tuple(corrected), head.displacements(list(corrected.values())))
    return TargetFiles(
        files.head(role, head),
        files.path(f"{role}_shapes.json"),
        corrected=files.shapes(f"{role}_corrected.json", shapes, head) if corrected else None,
        report=files.path(f"{role}_report.json"),
        sheet=files.path(f"{role}_sheet.png"),
    )
