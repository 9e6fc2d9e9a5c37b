"""The scene's task as a job file with everything it needs beside it, and back."""

from __future__ import annotations

from math import radians
from pathlib import Path

import bpy
from bpy.types import Context, Object

from ..core.errors import RetargetError
from ..core.methods.base import Face
from ..files.base_mesh import write_base_mesh
from ..files.frames import write_frames as write_frames_file
from ..files.job import ExampleFiles, FaceFiles, Job, OutputFiles, read_job, write_job
from ..files.mesh_file import MeshFile
from ..files.meshes import write_mesh
from ..files.points import write_points as write_points_file
from ..files.run import read_inputs
from .background import Steps, part
from .bake import write_frames
from .base_object import show_triangles
from .examples import write_example
from .meshes import new_face, read_face
from .performance import read_frames
from .points import write_points
from .settings import read_task_settings, write_task_settings
from .task import frame_range, read_problem


def save_job_steps(context: Context, path: Path) -> Steps[None]:
    """Save the scene's task: faces, points, examples and frames first, the job file last.

    Raises
    ------
    RetargetError : for anything that the task lacks, or if the system refuses to write.
    """
    task = context.scene.facial_retarget
    problem = read_problem(context)
    settings = read_task_settings(task)
    frames = yield from part(read_frames(context, task.source, frame_range(context)), 0.0, 0.8)
    yield 0.8, "Writing"

    def beside(name: str) -> Path:
        return path.with_name(f"{path.stem}_{name}")

    faces = {}
    for role, thing, face in (("source", task.source, problem.source), ("target", task.target, problem.target)):
        files = faces[role] = FaceFiles(beside(f"{role}.obj"), beside(f"{role}_points.json"))
        write_mesh(read_face(thing, face.mesh.vertices), files.neutral)
        write_points_file(face.points, files.points)
    moving = FaceFiles(faces["source"].neutral, faces["source"].points, beside("source_frames.npz"))
    write_frames_file(frames, moving.frames)
    base = None
    if problem.base is not None:
        base = beside("base.json")
        write_base_mesh(problem.base, base)
    examples = []
    for number, name in enumerate(problem.source.examples, start=1):
        files = ExampleFiles(name, beside(f"example_{number}_source.npz"), beside(f"example_{number}_target.npz"))
        _write_example(problem.source, name, files.source)
        _write_example(problem.target, name, files.target)
        examples.append(files)
    output = OutputFiles(_chosen(task.output) or beside("target_frames.npz"), _chosen(task.report), _chosen(task.page))
    write_job(Job(task.method, moving, faces["target"], tuple(examples), settings, output, base, path), path)


def _write_example(face: Face, name: str, path: Path) -> None:
    write_mesh(MeshFile.from_mesh(face.mesh.with_vertices(face.examples[name])), path)


def _chosen(path: str) -> Path | None:
    """A path of the panel, or None where none is set; // means beside the .blend."""
    return Path(bpy.path.abspath(path)) if path else None


def load_job(context: Context, path: Path, up: str) -> None:
    """Make a job the scene's task: its faces become new objects, source frames and examples their shape keys.

    Parameters
    ----------
    up : "Y" or "Z", the axis along which the files' faces stand.

    Raises
    ------
    RetargetError : for a job or file that is bad; everything is read before anything is made.
    """
    job = read_job(path)
    inputs = read_inputs(job)
    problem = inputs.problem
    for face in (problem.source, problem.target):
        _check_examples(face)

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
    task.output, task.report, task.page = (
        "" if file is None else str(file) for file in (job.output.frames, job.output.report, job.output.page)
    )
    task.base = None if problem.base is None else show_triangles(task.source, problem.base)
    context.view_layer.update()


def _check_examples(face: Face) -> None:
    for name, positions in face.examples.items():
        if positions.shape != face.mesh.vertices.shape:
            raise RetargetError(
                f"example {name!r} has {len(positions)} vertices, expected its neutral's {len(face.mesh.vertices)}"
            )


def _make_face(name: str, file: MeshFile, face: Face, up: str) -> Object:
    """A new object with its points, and its examples as shape keys."""
    thing = new_face(name, file)
    thing.rotation_euler.x = radians(90) if up == "Y" else 0.0
    write_points(thing, face.points)
    for example, positions in face.examples.items():
        write_example(thing, example, positions)
    return thing
