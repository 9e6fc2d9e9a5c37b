"""The scene's task as a job file with everything it needs beside it, and back."""

from __future__ import annotations

from dataclasses import replace
from math import radians
from pathlib import Path

from bpy.types import Context, Object

from ..core.arrays import Progress
from ..core.errors import RetargetError
from ..core.gains import Mask
from ..core.problem import Face, Problem
from ..files.base_mesh import write_base_mesh
from ..files.frames import write_frames as write_frames_file
from ..files.job import ExampleFiles, Job, MaskFile, OutputFiles, read_job, write_job
from ..files.masks import write_mask
from ..files.mesh_file import MeshFile
from ..files.meshes import write_mesh
from ..files.run import Inputs, read_inputs
from ..files.whole import Aside, appear_whole, written_aside
from .background import Steps, in_thread, part
from .bakes.frames import write_frames
from .bakes.job_bake import JobBake, show_job_bake
from .beside import Beside
from .examples.examples import write_example
from .gains import write_gains
from .heads import write_named_parts
from .maps.map_output import map_output, show_map_output
from .meshes import new_face
from .paths import optional_path
from .performance import read_frames, scene_rate
from .points.base_object import show_triangles
from .points.points import write_points
from .settings import read_task_settings, write_task_settings
from .task import frame_times, read_heads, read_problem


def save_job_steps(context: Context, path: Path) -> Steps[None]:
    """Save the scene's task: a job file with its faces, points, examples and frames beside it, together or not at all.

    Raises
    ------
    RetargetError : for anything that the task lacks, or if the system refuses to write.
    """
    task = context.scene.facial_retarget
    problem, settings, heads = read_problem(context), read_task_settings(task), read_heads(context)
    frames = yield from part(read_frames(context, task.source, frame_times(context)), 0.0, 0.8)
    maps, bake = map_output(task), JobBake(task, heads[1])
    rate = scene_rate(context.scene) / task.bake.step
    method = task.method
    wanted = [optional_path(path, "file", "job", "Report") for path in (task.output, task.report, task.page)]

    def write(progress: Progress) -> Aside:
        progress(0.0, "Writing")
        with written_aside() as aside:
            files = _ExampleFiles(path, aside)
            source, target = (files.head(role, head) for role, head in zip(("source", "target"), heads, strict=True))
            base = None if problem.base is None else files.add("base.json", write_base_mesh, problem.base)
            job = Job(
                method,
                replace(source, frames=files.add("source_frames.npz", write_frames_file, frames)),
                target,
                tuple(files.example(problem, name) for name in problem.source.examples),
                settings,
                OutputFiles(wanted[0] or files.path("target_frames.npz"), *wanted[1:]),
                base,
                path,
                problem.gains.regions,
                tuple(
                    files.mask(name, number, mask) for number, (name, mask) in enumerate(problem.gains.masks.items(), 1)
                ),
                maps,
                bake.add(aside, files.path),
                fps=rate,
            )
            write_job(job, aside.place(path))
            progress(1.0, "Writing")
        return aside

    # Nothing appears before the artist can no longer stop it.
    appear_whole((yield from part(in_thread(write, Aside.vanish), 0.8, 0.2)))


class _ExampleFiles(Beside):
    """The files of a task's heads, examples and masks."""

    def mask(self, name: str, number: int, mask: Mask) -> MaskFile:
        """Write the weights of a mask."""
        return MaskFile(name, self.add(f"mask_{number}.npz", write_mask, mask.weights), mask.gain)

    def example(self, problem: Problem, name: str) -> ExampleFiles:
        """Write an example of both faces."""
        number = 1 + list(problem.source.examples).index(name)
        source, target = (
            self.add(
                f"example_{number}_{role}.npz",
                write_mesh,
                MeshFile.from_mesh(face.mesh.with_vertices(face.examples[name])),
            )
            for role, face in (("source", problem.source), ("target", problem.target))
        )
        return ExampleFiles(name, source, target)


def load_job_steps(context: Context, path: Path, up: str) -> Steps[None]:
    """Make a job the scene's task: its faces become new objects, source frames and examples their shape keys.

    Parameters
    ----------
    up : "Y" or "Z", the axis along which the files' faces stand.

    Raises
    ------
    RetargetError : for a job or file that is bad; everything is read before anything is made.
    """

    def read(progress: Progress) -> tuple[Job, Inputs]:
        progress(0.0, "Reading")
        job = read_job(path)
        return job, read_inputs(job)

    job, inputs = yield from part(in_thread(read), 0.0, 0.8)
    yield 0.8, "Writing"
    problem = inputs.problem
    for face in (problem.source, problem.target):
        _check_examples(face)
        face.points.index({name for corners in problem.base or () for name in corners})

    task = context.scene.facial_retarget
    task.source = _make_face(job.source.neutral.stem, inputs.source, problem.source, up)
    task.target = _make_face(job.target.neutral.stem, inputs.target, problem.target, up)
    write_frames(task.source, inputs.frames, first=1)
    task.source_neutral = "BASIS"
    task.use_scene_range, task.frame_start, task.frame_end = False, 1, len(inputs.frames)
    task.examples.clear()
    for example in job.examples:
        task.examples.add().name = example.name
    write_task_settings(task, job.method, job.settings)
    write_gains(task, task.target, problem.gains)
    task.output, task.report, task.page = (
        "" if file is None else str(file) for file in (job.output.frames, job.output.report, job.output.page)
    )
    show_map_output(task.normal_maps, job.normal_maps)
    show_job_bake(task, task.target, job.bake, inputs.rig, inputs.target)
    task.base = None if problem.base is None else show_triangles(task.source, problem.base)
    context.view_layer.update()


def _check_examples(face: Face) -> None:
    for name, positions in face.examples.items():
        if positions.shape != face.mesh.vertices.shape:
            raise RetargetError(
                f"example {name!r} has {len(positions)} vertices, expected its neutral's {len(face.mesh.vertices)}"
            )


def _make_face(name: str, file: MeshFile, face: Face, up: str) -> Object:
    """A new object with its points, its named parts as vertex groups, and its examples as shape keys."""
    thing = new_face(name, file)
    thing.rotation_euler.x = radians(90) if up == "Y" else 0.0
    write_points(thing, face.points)
    write_named_parts(thing, face.named_parts)
    for example, positions in face.examples.items():
        write_example(thing, example, positions)
    return thing
