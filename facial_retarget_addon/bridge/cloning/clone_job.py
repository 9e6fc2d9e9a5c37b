"""What the panel clones as a clone job, with all that it needs beside it: for the command line, here or elsewhere."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from bpy.types import Context, PropertyGroup

from ...core.arrays import Progress
from ...core.errors import RetargetError
from ...core.shapes.shape_set import ShapeSet
from ...demo.shape_sets import POSES
from ...files.clone_job import BuiltInActor, CloneJob, SourceFiles, TargetFiles, write_clone_job
from ...files.shape_files import add_shapes
from ...files.whole import Aside, appear_whole, written_aside
from ..background import Steps, in_thread, part
from ..beside import Beside
from ..heads import Head, read_head
from ..maps.map_output import job_kit
from ..settings import read_method_settings
from .clone_wishes import Origin, origins, preparation, wanted_names
from .cloning import target_faces
from .donors import read_source_head
from .head_shapes import read_shapes_steps
from .resolving import cloned_origins, find_corrected


class _Shaped(NamedTuple):
    """A head and some shapes of it."""

    head: Head
    shapes: ShapeSet


def save_clone_job_steps(context: Context, path: Path) -> Steps[None]:
    """Save what the panel clones: a clone job, its heads, shapes and corrections beside it, together or not at all.

    Raises
    ------
    RetargetError : for anything that the cloning lacks, or if the system refuses to write.
    """
    cloning = context.scene.facial_retarget.cloning
    settings, method = read_method_settings(context.scene.facial_retarget, cloning.method), cloning.method
    heads = [read_head(face) for face in target_faces(context)]
    source = yield from part(_source(context.scene.facial_retarget), 0.0, 0.4)
    names = _actor_names(source) if isinstance(source, BuiltInActor) else list(source.shapes.names)
    how = preparation(cloning)
    kit = job_kit(context.scene.facial_retarget, method)
    made = {origin: name for name, origin in origins(wanted_names(names, cloning), how).items()}
    targets = [_Shaped(head, _corrections(head, made)) for head in heads]

    def write(progress: Progress) -> Aside:
        with written_aside() as aside:
            files = _HeadFiles(path, aside)
            progress(0.0, "Writing")
            given = source if isinstance(source, BuiltInActor) else files.source(source)
            wanted = []
            for number, target in enumerate(targets, start=1):
                progress(number / (len(targets) + 1), f"Writing head {number} of {len(targets)}")
                wanted.append(files.target(target, f"target_{number}", kit is not None))
            job = CloneJob(given, tuple(wanted), how, method, settings, path)
            write_clone_job(job if kit is None else replace(job, wrinkle_kit=kit), aside.place(path))
            progress(1.0, "Writing")
        return aside

    # Nothing appears before the artist can no longer stop it.
    appear_whole((yield from part(in_thread(write, Aside.vanish), 0.4, 0.6)))


class _HeadFiles(Beside):
    """The files of a clone job's heads."""

    def __init__(self, job: Path, aside: Aside) -> None:
        super().__init__(job, aside)
        self._aside = aside

    def source(self, source: _Shaped) -> SourceFiles:
        """Write a head that gives its shapes."""
        return SourceFiles(self.head("source", source.head), self._shapes("source_shapes.json", source))

    def target(self, target: _Shaped, role: str, wrinkles: bool) -> TargetFiles:
        """Write a head that gets shapes, maybe with a wrinkle kit, and its corrections."""
        corrected = self._shapes(f"{role}_corrected.json", target) if len(target.shapes) else None
        return TargetFiles(
            self.head(role, target.head),
            self.path(f"{role}_shapes.json"),
            corrected=corrected,
            report=self.path(f"{role}_report.json"),
            sheet=self.path(f"{role}_sheet.png"),
            wrinkles=self.path(f"{role}_wrinkles") if wrinkles else None,
        )

    def _shapes(self, name: str, shaped: _Shaped) -> Path:
        add_shapes(self._aside, shaped.shapes, self.path(name), shaped.head.file)
        return self.path(name)


def _source(task: PropertyGroup) -> Steps[_Shaped | BuiltInActor]:
    """Where the job's shapes come from."""
    if task.cloning.donor == "ACTOR":
        return BuiltInActor(tuple(sorted(task.cloning.actor_sets)))
    head = read_source_head(task)
    return _Shaped(head, (yield from read_shapes_steps(head, head.key_names())))


def _actor_names(actor: BuiltInActor) -> list[str]:
    """The names of the built-in actor's shapes; RetargetError if no set of them is chosen."""
    if not actor.sets:
        raise RetargetError("no set of the built-in actor is chosen, expected ARKit, visemes or expressions")
    return [name for chosen in actor.sets for name in POSES[chosen]]


def _corrections(head: Head, made: Mapping[Origin, str]) -> ShapeSet:
    """What the artist has corrected of a head's shapes, under the names that the job makes them by."""
    origin = cloned_origins(head)
    corrected = {made[origin[key]]: key for key in find_corrected(head) if origin[key] in made}
    return ShapeSet(tuple(corrected), head.displacements(list(corrected.values())))
