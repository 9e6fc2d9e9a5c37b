"""facial-retarget: do or check a job, play MPEG-4 motion, make or clone shapes, propose points, or see the demo.

Exit status 0 when all went well, 2 with one line on standard error for bad input, 130 for Ctrl-C.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from .core.arrays import Progress, no_progress
from .core.errors import Cancelled, RetargetError
from .core.point_sets import POINT_SETS
from .terminal import clear, progress_on

if TYPE_CHECKING:
    from .files.clone_job import CloneJob
    from .files.mpeg4_face import FapFaceFiles

BAD_INPUT = 2
INTERRUPTED = 130


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command line; returns the exit status."""
    arguments = _parser().parse_args(argv)
    command: Callable[[argparse.Namespace], int] = arguments.command
    try:
        return command(arguments)
    except RetargetError as error:
        _complain(str(error))
        return BAD_INPUT
    except (KeyboardInterrupt, Cancelled):
        kept = "; what was computed is kept, and the same command goes on from there"
        _complain(f"stopped; every file is as it was{kept if getattr(arguments, 'resume', False) else ''}")
        return INTERRUPTED


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("facial-retarget", description="Put the acting of one face onto another face.")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    run = commands.add_parser("run", help="do a job")
    run.add_argument("job", type=Path, help="the job file (TOML)")
    run.add_argument(
        "--resume",
        action="store_true",
        help="keep what is computed until the job is done, and go on from what a run that was stopped has kept",
    )
    run.set_defaults(command=_run)
    check = commands.add_parser("check", help="say everything that is wrong with a job")
    check.add_argument("job", type=Path, help="the job file or clone job (TOML)")
    check.set_defaults(command=_check)
    fap = commands.add_parser(
        "fap", help="play FAPs, ARKit weights or markers on a face, turn them into FAPs, or measure"
    )
    _add_fap_arguments(fap)
    shapes = commands.add_parser("shapes", help="give a face the standard's shapes, from its feature points alone")
    _add_shapes_arguments(shapes)
    clone = commands.add_parser("clone", help="give the shapes of one head to one or many others")
    _add_clone_arguments(clone)
    markers = commands.add_parser("markers", help="begin a marker map: which marker sits on which feature point")
    _add_markers_arguments(markers)
    morph = commands.add_parser("morph", help="make a generic head into another by its feature points alone")
    _add_morph_arguments(morph)
    points = commands.add_parser("points", help="propose the feature points that a face lacks, or guess them all")
    _add_points_arguments(points)
    demo = commands.add_parser("demo", help="write the built-in faces and their jobs, and do them")
    demo.add_argument("folder", type=Path, nargs="?", default=Path("demo"), help="where to (default: demo)")
    demo.set_defaults(command=_demo)
    for command in (run, check, fap, shapes, clone, markers, morph, points, demo):
        command.add_argument("--quiet", action="store_true", default=argparse.SUPPRESS, help="no progress")
    return parser


def _add_fap_arguments(fap: argparse.ArgumentParser) -> None:
    fap.add_argument("motion", type=Path, help=".fap, ARKit .csv, markers (.trc .c3d .bvh .csv), or a face's frames")
    fap.add_argument("--out", type=Path, required=True, help="frames (.npz .pc2 .mdd or a folder), or .fap")
    _add_face_arguments(fap, required=False)
    fap.add_argument(
        "--head", choices=("leave", "turn"), default="leave", help="whether the head turns by FAPs 48 to 50"
    )
    fap.add_argument("--missing", choices=("hold", "zero"), default="hold", help="what FAPs do that a frame leaves out")
    fap.add_argument("--gaps", choices=("fill", "refuse"), default="fill", help="what becomes of hidden markers")
    fap.add_argument("--map", type=Path, help="a marker map, where the markers' names do not say where they sit")
    fap.add_argument("--fps", type=float, help="frames a second, where the motion does not tell")
    fap.add_argument("--frames", default=":", metavar="FIRST:LAST:STEP", help="which frames, from 1 (default: all)")
    fap.set_defaults(command=_fap)


def _add_shapes_arguments(shapes: argparse.ArgumentParser) -> None:
    shapes.add_argument(
        "--set", action="append", required=True, help="expressions, visemes, arkit or faps; may be given several times"
    )
    shapes.add_argument(
        "--out", type=Path, required=True, help="a folder of .obj, or .npz with an array for each shape"
    )
    _add_face_arguments(shapes, required=True)
    shapes.set_defaults(command=_shapes)


def _add_clone_arguments(clone: argparse.ArgumentParser) -> None:
    clone.add_argument("job", type=Path, nargs="?", help="a clone job (TOML), in place of all that follows")
    files = ("NEUTRAL", "POINTS", "SHAPES")
    clone.add_argument("--source", type=Path, nargs=3, metavar=files, help="the head that has the shapes")
    clone.add_argument(
        "--actor",
        action="append",
        metavar="SET",
        help="in place of a source: arkit, visemes or expressions of the built-in actor; may be given several times",
    )
    clone.add_argument(
        "--target",
        type=Path,
        nargs=3,
        metavar=files,
        action="append",
        help="a head that gets them, and where to (a folder, .npz or .json); may be given several times",
    )
    clone.add_argument("--method", help="a method, with its default settings (default: motion_cloning)")
    clone.add_argument("--keep", action="append", metavar="PATTERN", help="shapes that go over, such as 'mouth*'")
    clone.add_argument("--drop", action="append", metavar="PATTERN", help="shapes that do not")
    clone.add_argument(
        "--page", action="store_true", help="a page (.html), a contact sheet (.png) and figures (.report.json) as well"
    )
    clone.add_argument(
        "--resume", action="store_true", help="keep each head that is done, and go on from what a stopped run has kept"
    )
    clone.set_defaults(command=_clone)


def _add_markers_arguments(markers: argparse.ArgumentParser) -> None:
    markers.add_argument("take", type=Path, help="markers (.trc .c3d .bvh .csv), neutral in the first frame")
    markers.add_argument("--out", type=Path, required=True, help="the marker map (.json)")
    markers.add_argument("--face", type=Path, help="a face to compare places with (.obj .ply .npz)")
    markers.add_argument("--points", type=Path, help="its feature points (.json)")
    markers.set_defaults(command=_markers)


def _add_morph_arguments(morph: argparse.ArgumentParser) -> None:
    morph.add_argument("--face", type=Path, required=True, help="the generic head (.obj .ply .npz)")
    morph.add_argument("--points", type=Path, required=True, help="its feature points (.json)")
    morph.add_argument("--to-face", type=Path, required=True, help="the face that the wanted points lie on")
    morph.add_argument("--to-points", type=Path, required=True, help="the wanted points (.json)")
    morph.add_argument("--out", type=Path, required=True, help="the morphed head (.obj .ply .npz)")
    morph.set_defaults(command=_morph)


def _add_points_arguments(points: argparse.ArgumentParser) -> None:
    points.add_argument("--face", type=Path, required=True, help="the neutral face (.obj .ply .npz)")
    points.add_argument("--points", type=Path, help="feature points that it has (.json); guessed without them")
    points.add_argument("--set", choices=[name.lower() for name in POINT_SETS], default="dense", help="what is wanted")
    points.add_argument("--out", type=Path, required=True, help="all points (.json)")
    points.set_defaults(command=_points)


def _add_face_arguments(command: argparse.ArgumentParser, required: bool) -> None:
    command.add_argument("--face", type=Path, required=required, help="the neutral face (.obj .ply .npz)")
    command.add_argument("--points", type=Path, required=required, help="its feature points (.json)")
    command.add_argument("--parts", type=Path, help="what its parts are, such as teeth (.json)")
    command.add_argument("--variant", choices=("default", "paper"), default="default", help="of the points' weights")
    command.add_argument("--report", type=Path, help="where figures go (.json)")
    command.add_argument("--page", type=Path, help="where pictures go (.html)")


def _run(arguments: argparse.Namespace) -> int:
    from .files.run import run_job

    _warn(run_job(arguments.job, _progress(arguments), arguments.resume)["warnings"])
    return 0


def _check(arguments: argparse.Namespace) -> int:
    from .demonstration import acting_donor
    from .files.clone_job import is_clone_job
    from .files.clone_task import check_clone_job
    from .files.run import check_job

    cloning = is_clone_job(arguments.job)
    found = check_clone_job(arguments.job, acting_donor) if cloning else check_job(arguments.job)
    for fault in found.faults:
        _complain(fault)
    _warn(found.warnings)
    if found.faults:
        return BAD_INPUT
    print(f"{arguments.job} is fine")
    return 0


def _fap(arguments: argparse.Namespace) -> int:
    from .files.fap_task import FapTask, run_fap_task
    from .files.frame_range import FrameRange

    task = FapTask(
        arguments.motion,
        arguments.out,
        _optional_face(arguments, arguments.variant, arguments.parts),
        missing=arguments.missing,
        gaps=arguments.gaps,
        marker_map=arguments.map,
        turn_head=arguments.head == "turn",
        fps=arguments.fps,
        chosen=FrameRange.of_text(arguments.frames),
        report=arguments.report,
        page=arguments.page,
    )
    _warn(run_fap_task(task, _progress(arguments))["warnings"])
    return 0


def _optional_face(
    arguments: argparse.Namespace, variant: str = "default", parts: Path | None = None
) -> FapFaceFiles | None:
    from .files.mpeg4_face import FapFaceFiles

    if (arguments.face is None) != (arguments.points is None):
        raise RetargetError("--face and --points go together, but one of them is missing")
    if arguments.face is None and parts is not None:
        raise RetargetError("--parts goes with --face and --points, which are missing")
    return None if arguments.face is None else FapFaceFiles(arguments.face, arguments.points, variant, parts)


def _markers(arguments: argparse.Namespace) -> int:
    from .files.markers_task import run_markers_task

    begun = run_markers_task(arguments.take, arguments.out, _optional_face(arguments))
    for marker, point in begun.placed.items():
        _complain(f"warning: {marker} is put on {point} by its place alone: check it")
    open_ones = [
        name for name in (*begun.named.unknown, *sum(begun.named.doubtful.values(), ())) if name not in begun.placed
    ]
    if open_ones:
        _complain(f"warning: markers without a point, to be added by hand: {', '.join(open_ones)}")
    print(f"{arguments.out}: {len(begun.marker_map.points)} markers")
    return 0


def _shapes(arguments: argparse.Namespace) -> int:
    from .files.mpeg4_face import FapFaceFiles
    from .files.shapes_task import ShapesTask, run_shapes_task

    face = FapFaceFiles(arguments.face, arguments.points, arguments.variant, arguments.parts)
    task = ShapesTask(face, tuple(arguments.set), arguments.out, arguments.report, arguments.page)
    _warn(run_shapes_task(task, _progress(arguments))["warnings"])
    return 0


def _clone(arguments: argparse.Namespace) -> int:
    from .demonstration import acting_donor
    from .files.clone_job import read_clone_job
    from .files.clone_task import run_clone_job

    job = read_clone_job(arguments.job) if arguments.job is not None else None
    flags = [name for name in _CLONE_FLAGS if getattr(arguments, name)]
    if job is not None and flags:
        raise RetargetError(f"a clone job says all by itself, but --{', --'.join(flags)} came with {arguments.job}")
    if job is None:
        job = _clone_job_of(arguments)
    reports = run_clone_job(job, _progress(arguments), acting_donor, arguments.resume)
    for target, report in zip(job.targets, reports, strict=True):
        _warn(f"{target.face.neutral.name}: {text}" for text in report["warnings"])
        print(f"{target.shapes}: {len(report['shapes'])} shapes")
    return 0


_CLONE_FLAGS = ("source", "actor", "target", "method", "keep", "drop", "page")


def _clone_job_of(arguments: argparse.Namespace) -> CloneJob:
    """The clone job that the options say."""
    from .core.methods import METHODS
    from .core.methods.settings import SETTINGS
    from .core.shapes.prepare import Preparation
    from .files.clone_job import METHOD, BuiltInActor, CloneJob, SourceFiles, TargetFiles
    from .files.job import FaceFiles

    method = arguments.method or METHOD
    if method not in METHODS:
        raise RetargetError(f"--method {method} is unknown, expected one of {', '.join(METHODS)}")
    if (arguments.source is None) == (arguments.actor is None) or not arguments.target:
        raise RetargetError("clone expects a job file, or one of --source and --actor and at least one --target")
    targets = []
    for neutral, points, shapes in arguments.target:
        beside = {key: shapes.with_suffix(end) for key, end in _BESIDE.items()} if arguments.page else {}
        targets.append(TargetFiles(FaceFiles(neutral, points), shapes, **beside))
    source: SourceFiles | BuiltInActor
    if arguments.source is None:
        source = BuiltInActor(tuple(arguments.actor))
    else:
        neutral, points, shapes = arguments.source
        source = SourceFiles(FaceFiles(neutral, points), shapes)
    how = Preparation(tuple(arguments.keep or ("*",)), tuple(arguments.drop or ()))
    return CloneJob(source, tuple(targets), how, method, SETTINGS[method]())


_BESIDE = {"page": ".html", "sheet": ".png", "report": ".report.json"}
"""What `clone --page` writes beside the shapes."""


def _morph(arguments: argparse.Namespace) -> int:
    from .files.morph_task import run_morph_task
    from .files.mpeg4_face import FapFaceFiles

    head = FapFaceFiles(arguments.face, arguments.points)
    wanted = FapFaceFiles(arguments.to_face, arguments.to_points)
    _warn(run_morph_task(head, wanted, arguments.out).warnings)
    return 0


def _points(arguments: argparse.Namespace) -> int:
    from .files.points_task import run_points_task

    found = run_points_task(arguments.face, arguments.points, arguments.set.upper(), arguments.out)
    if found.doubtful:
        _warn([f"points {', '.join(found.doubtful)} lie where the others do not expect them"])
    how = "" if found.confidence is None else f", guessed from the mesh alone: {found.confidence:.0%} sure"
    print(f"{arguments.out}: {found.proposed} points proposed{how}")
    return 0


def _demo(arguments: argparse.Namespace) -> int:
    from .demonstration import write_demonstration, write_donor, write_fap_demonstration
    from .files.fap_task import run_fap_task
    from .files.run import run_job

    progress = _progress(arguments)
    for job in write_demonstration(arguments.folder, progress):
        _warn(run_job(job, progress)["warnings"])
        print(f"{job} is done: see {job.with_suffix('') / 'report.html'}")
    task = write_fap_demonstration(arguments.folder)
    _warn(run_fap_task(task, progress)["warnings"])
    print(f"{task.motion} plays on the ape: see {task.page}")
    print(
        f"{write_donor(arguments.folder)} gives the built-in actor's shapes to the ape: facial-retarget clone does it"
    )
    return 0


def _progress(arguments: argparse.Namespace) -> Progress:
    return no_progress if arguments.quiet else progress_on(sys.stderr)


def _warn(warnings: Iterable[str]) -> None:
    for warning in warnings:
        _complain(f"warning: {warning}")


def _complain(text: str) -> None:
    """One line on standard error."""
    clear(sys.stderr)
    print(f"facial-retarget: {' '.join(text.split())}", file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())
