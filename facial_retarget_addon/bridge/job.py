"""The scene's task as a job file with everything it needs beside it, and back."""

from __future__ import annotations

from math import radians
from pathlib import Path

import bpy
from bpy.types import Context, Object

from ..core.arrays import FloatArray
from ..core.errors import RetargetError
from ..core.methods.base import Face
from ..files.base_mesh import read_base_mesh, write_base_mesh
from ..files.frames import read_frames as read_frames_file
from ..files.frames import write_frames as write_frames_file
from ..files.job import ExampleFiles, FaceFiles, Job, OutputFiles, read_job, write_job
from ..files.mesh_file import MeshFile
from ..files.meshes import read_mesh, write_mesh
from ..files.points import read_points as read_points_file
from ..files.points import write_points as write_points_file
from .background import Steps, part
from .bake import write_frames
from .base_object import show_base
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
    faces = {"source": read_mesh(job.source.neutral), "target": read_mesh(job.target.neutral)}
    files = {"source": job.source, "target": job.target}
    points = {role: _read_points(files[role], face, role) for role, face in faces.items()}
    frames = read_frames_file(job.source.frames, len(faces["source"].mesh.vertices))
    examples = [
        (example.name, role, _read_example(file, faces[role]))
        for example in job.examples
        for role, file in (("source", example.source), ("target", example.target))
    ]
    base = None if job.base is None else read_base_mesh(job.base)

    things: dict[str, Object] = {}
    for role, face in faces.items():
        thing = things[role] = new_face(files[role].neutral.stem, face)
        thing.rotation_euler.x = radians(90) if up == "Y" else 0.0
        write_points(thing, points[role])
    for name, role, positions in examples:
        write_example(things[role], name, positions)
    write_frames(things["source"], frames, first=1)

    task = context.scene.facial_retarget
    task.source, task.target = things["source"], things["target"]
    task.source_neutral = "BASIS"
    task.use_scene_range, task.frame_start, task.frame_end = False, 1, len(frames)
    task.examples.clear()
    for example in job.examples:
        task.examples.add().name = example.name
    write_task_settings(task, job.method, job.settings)
    task.output, task.report, task.page = (
        "" if file is None else str(file) for file in (job.output.frames, job.output.report, job.output.page)
    )
    task.base = None if base is None else _show_own_base(things["source"], base)
    context.view_layer.update()


def _read_points(files: FaceFiles, face: MeshFile, role: str):
    if files.points is None:
        raise RetargetError(f"the job has no [{role}] points, expected feature points")
    return read_points_file(files.points, face.mesh)


def _read_example(path: Path, neutral: MeshFile) -> FloatArray:
    vertices = read_mesh(path).mesh.vertices
    if len(vertices) != len(neutral.mesh.vertices):
        raise RetargetError(f"{path} has {len(vertices)} vertices, expected the neutral's {len(neutral.mesh.vertices)}")
    return vertices


def _show_own_base(thing: Object, triangles: tuple[tuple[str, str, str], ...]) -> Object:
    names = tuple(dict.fromkeys(name for corners in triangles for name in corners))
    row = {name: i for i, name in enumerate(names)}
    import numpy as np

    return show_base(thing, names, np.array([[row[name] for name in corners] for corners in triangles], np.int64))
