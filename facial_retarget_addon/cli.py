"""facial-retarget: do a job, check a job, or see the built-in demonstration.

Exit status 0 when all went well, 2 with one line on standard error for bad input, 130 for Ctrl-C.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from .core.arrays import Progress, no_progress
from .core.errors import Cancelled, RetargetError
from .terminal import clear, progress_on

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
        _complain("stopped; every file is as it was")
        return INTERRUPTED


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("facial-retarget", description="Put the acting of one face onto another face.")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    run = commands.add_parser("run", help="do a job")
    run.add_argument("job", type=Path, help="the job file (TOML)")
    run.set_defaults(command=_run)
    check = commands.add_parser("check", help="say everything that is wrong with a job")
    check.add_argument("job", type=Path, help="the job file (TOML)")
    check.set_defaults(command=_check)
    demo = commands.add_parser("demo", help="write the built-in faces and their jobs, and do them")
    demo.add_argument("folder", type=Path, nargs="?", default=Path("demo"), help="where to (default: demo)")
    demo.set_defaults(command=_demo)
    for command in (run, check, demo):
        command.add_argument("--quiet", action="store_true", default=argparse.SUPPRESS, help="no progress")
    return parser


def _run(arguments: argparse.Namespace) -> int:
    from .files.run import run_job

    _warn(run_job(arguments.job, _progress(arguments))["warnings"])
    return 0


def _check(arguments: argparse.Namespace) -> int:
    from .files.run import check_job

    found = check_job(arguments.job)
    for fault in found.faults:
        _complain(fault)
    _warn(found.warnings)
    if found.faults:
        return BAD_INPUT
    print(f"{arguments.job} is fine")
    return 0


def _demo(arguments: argparse.Namespace) -> int:
    from .demonstration import write_demonstration
    from .files.run import run_job

    progress = _progress(arguments)
    for job in write_demonstration(arguments.folder, progress):
        _warn(run_job(job, progress)["warnings"])
        print(f"{job} is done: see {job.with_suffix('') / 'report.html'}")
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
