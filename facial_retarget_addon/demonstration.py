"""The built-in faces as files, with a job for each target, and a take of FAPs for one of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from .core.arrays import Progress, no_progress
from .core.errors import RetargetError
from .core.methods.settings import HierarchicalSettings
from .core.problem import Face
from .core.shapes.shape_set import ShapeSet
from .demo import DemoFace, actor, donor, face_shapes, performance, targets
from .demo.fap_take import fap_take
from .files.clone_job import CloneJob, SourceFiles, TargetFiles, write_clone_job
from .files.fap_task import FapTask
from .files.frames import write_frames
from .files.job import ExampleFiles, FaceFiles, Job, OutputFiles, write_job
from .files.mesh_file import MeshFile
from .files.meshes import write_mesh
from .files.motion.fap import write_fap
from .files.mpeg4_face import FapFaceFiles
from .files.parts import write_parts
from .files.points import write_points
from .files.shape_files import add_shapes
from .files.whole import written_whole


def write_demonstration(folder: Path, progress: Progress = no_progress) -> list[Path]:
    """Write the actor, its performance, the targets and their examples; returns the job files, one for each target.

    Raises
    ------
    RetargetError : if the system refuses to write.
    """
    folder = folder.absolute()
    progress(0.0, "Making the built-in faces")
    source = actor()
    acting = FaceFiles(*_write_face(source, folder), folder / source.name / "performance.npz")
    write_frames(performance(source), folder / source.name / "performance.npz")
    jobs = []
    for target in targets():
        files = FaceFiles(*_write_face(target, folder))
        examples = tuple(
            ExampleFiles(name, _example(folder, source, name), _example(folder, target, name))
            for name in source.face.examples
            if name in target.face.examples
        )
        place = folder / target.name
        output = OutputFiles(place / "frames.npz", place / "report.json", place / "report.html")
        path = folder / f"{target.name}.toml"
        write_job(Job("hierarchical", acting, files, examples, HierarchicalSettings(), output, None, path), path)
        jobs.append(path)
    progress(1.0, "Done")
    return jobs


def write_donor(folder: Path) -> Path:
    """Write the built-in actor that lends its shapes, all of them, and a clone job that gives them to the ape.

    Returns
    -------
    The job file.

    Raises
    ------
    RetargetError : if the system refuses to write.
    """
    folder = folder.absolute()
    made = donor()
    mesh, ape = made.face.mesh, folder / "ape"
    plain = replace(made, face=replace(made.face, examples={}))
    files = FaceFiles(*_write_face(plain, folder), parts=folder / made.name / "parts.json")
    write_parts(made.face.named_parts, mesh, folder / made.name / "parts.json")
    shapes = SourceFiles(files, folder / made.name / "shapes.npz")
    with written_whole() as aside:
        found = ShapeSet.of_positions(mesh.vertices, face_shapes(made))
        add_shapes(aside, found, shapes.shapes, MeshFile.from_mesh(mesh))
    target = TargetFiles(
        FaceFiles(ape / "neutral.obj", ape / "points.json"), ape / "shapes.npz", sheet=ape / "shapes.png"
    )
    path = folder / "ape_shapes.toml"
    write_clone_job(CloneJob(shapes, (target,)), path)
    return path


def write_fap_demonstration(folder: Path) -> FapTask:
    """Write the built-in take of FAPs beside the faces of `write_demonstration`; returns what plays it on the ape.

    Raises
    ------
    RetargetError : if the system refuses to write.
    """
    motion, ape = folder.absolute() / "expressions.fap", folder.absolute() / "ape"
    write_fap(fap_take(), motion)
    face = FapFaceFiles(ape / "neutral.obj", ape / "points.json")
    return FapTask(motion, ape / "expressions.npz", face, page=ape / "expressions.html")


def acting_donor(sets: Sequence[str]) -> tuple[Face, ShapeSet]:
    """The built-in actor and its shapes of some sets, for heads that have none.

    Raises
    ------
    RetargetError : without sets, or for one that it does not have.
    """
    if not sets:
        raise RetargetError("no set of the built-in actor is chosen, expected some of arkit, visemes, expressions")
    made = donor()
    face = replace(made.face, examples={})
    return face, ShapeSet.of_positions(face.mesh.vertices, face_shapes(made, sets))


def _write_face(face: DemoFace, folder: Path) -> tuple[Path, Path]:
    """Write a face's neutral, points and examples; returns the paths of the first two."""
    place = folder / face.name
    try:
        place.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise RetargetError(f"the folder {place} cannot be made: {error.strerror or error}") from error
    neutral = MeshFile(face.face.mesh, face.counts, face.corners, face.uvs[face.corners])
    write_mesh(neutral, place / "neutral.obj")
    write_points(face.face.points, place / "points.json")
    for name, positions in face.face.examples.items():
        write_mesh(MeshFile.from_mesh(face.face.mesh.with_vertices(positions)), _example(folder, face, name))
    return place / "neutral.obj", place / "points.json"


def _example(folder: Path, face: DemoFace, name: str) -> Path:
    return folder / face.name / f"{name}.npz"
