"""What a run has computed so far, kept beside its outputs: one that was stopped goes on where it stood."""

from __future__ import annotations

import hashlib
import io
import json
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from ..core.arrays import FloatArray
from ..core.errors import RetargetError
from .documents import json_bytes, read_json
from .images import suffix_of
from .job import Job
from .npz import read_arrays, write_arrays
from .whole import check_place, write_whole

ENDING = ".unfinished"
"""Behind an output's name: the folder of what is kept of it."""
_PICTURES = f".pictures{ENDING}"
"""The same of normal maps, where the job makes nothing else."""
_RECORD = "made_with.json"
_CODE = [Path(__file__).resolve().parents[1] / room for room in ("core", "demo", "files")]
_CHUNK = 1 << 20


class KeptRun:
    """Frames, block by block, and normal maps of a job, each of them whole as soon as it is there.

    A folder beside the job's main output holds the blocks and a record of all that they depend on: the job's method,
    settings, gains and range, what its input files hold, and this program. One beside its normal maps holds pictures.

    Raises
    ------
    RetargetError : if something was kept that depends on anything else, which names the differences; if the system
        refuses.
    """

    def __init__(self, job: Job) -> None:
        self._folder, self.pictures = kept_folders(job)
        wanted, record = made_with(job), self._folder / _RECORD
        if self.pictures is not None and job.normal_maps is not None:
            check_place(self.pictures, suffix_of(job.normal_maps.settings.depth))
        with _told(self._folder):
            self._folder.mkdir(exist_ok=True)
            _remove_parts(self._folder)
            if record.exists():
                check_same(read_json(record), wanted, self._folder)
            else:
                _check_empty(self._folder)
                write_whole(record, json_bytes(wanted))
            if self.pictures is not None:
                self.pictures.mkdir(exist_ok=True)
                _remove_parts(self.pictures)

    def read(self, rows: slice) -> tuple[FloatArray, dict[str, Any]] | None:
        """See `core.retarget.KeptBlocks`; RetargetError for a block that cannot be read."""
        path = self._block(rows)
        if not path.exists():
            return None
        try:
            held = read_arrays(path, "frames", "figures")
            frames, figures = held["frames"], json.loads(held["figures"].tobytes())
        except (RetargetError, KeyError, ValueError) as error:
            raise RetargetError(f"{path} is no block of frames; remove {self._folder} to start anew") from error
        return frames, figures

    def keep(self, rows: slice, frames: FloatArray, figures: dict[str, Any]) -> None:
        """See `core.retarget.KeptBlocks`; RetargetError if the system refuses."""
        held = io.BytesIO()
        write_arrays(held, {"frames": frames, "figures": np.frombuffer(json.dumps(figures).encode(), np.uint8)})
        write_whole(self._block(rows), held.getvalue())

    def _block(self, rows: slice) -> Path:
        return self._folder / f"frames_{rows.start + 1:06d}.npz"


def kept_folders(job: Job) -> tuple[Path, Path | None]:
    """Where a job keeps its frames, and its normal maps, None where it makes none."""
    frames = job.main_output.with_name(f"{job.main_output.name}{ENDING}")
    if job.normal_maps is None:
        return frames, None
    folder = job.normal_maps.folder
    # Pictures appear as a folder of their own: blocks cannot lie among them.
    return frames, folder.with_name(f"{folder.name}{ENDING if folder != job.main_output else _PICTURES}")


def forget(job: Job) -> None:
    """Remove what was kept of a job that is done; RetargetError if the system refuses."""
    frames, pictures = kept_folders(job)
    if not (frames / _RECORD).is_file():
        return
    with _told(frames):
        for folder in (pictures, frames):
            if folder is not None and folder.is_dir():
                shutil.rmtree(folder)


def made_with(job: Job) -> dict[str, str]:
    """All that frames and normal maps of a job depend on: what a message calls it -> its value, or its fingerprint.

    Raises
    ------
    RetargetError : if an input cannot be read.
    """
    values: dict[str, object] = {
        **program(),
        "method": job.method,
        "[source] range": job.chosen,
        "the names of the examples": [example.name for example in job.examples],
    }
    values |= {f"[settings] {name}": value for name, value in asdict(job.settings).items()}
    values |= {f"[regions] {name}": value for name, value in asdict(job.regions).items()}
    values |= {f"the gain of mask {mask.name!r}": mask.gain for mask in job.masks}
    if job.normal_maps is not None:
        values |= {f"[normal_maps] {name}": value for name, value in asdict(job.normal_maps.settings).items()}
    inputs = {name: path for name, path in job.inputs().items() if not name.startswith("[bake]")}
    return {name: str(value) for name, value in values.items()} | fingerprints(inputs)


def program() -> dict[str, str]:
    """What this program is made of, for a record."""
    code = sorted(path for room in _CODE for path in room.rglob("*.py"))
    return {"version of this program": _fingerprint(code), "NumPy": np.__version__, "SciPy": version("scipy")}


def fingerprints(inputs: Mapping[str, Path]) -> dict[str, str]:
    """What input files or folders hold, for a record; RetargetError if one cannot be read."""
    return {name: f"{path.suffix} {_fingerprint(_files(path))}" for name, path in inputs.items()}


def _remove_parts(folder: Path) -> None:
    """Remove files that were being written when an earlier run was stopped."""
    for part in folder.glob(".*-partial.*"):
        part.unlink()


def _check_empty(folder: Path) -> None:
    other = next(folder.iterdir(), None)
    if other is not None:
        raise RetargetError(f"{folder} holds {other.name!r}, which no run has kept; expected no such folder")


def _files(path: Path) -> list[Path]:
    return sorted(part for part in path.iterdir() if part.is_file()) if path.is_dir() else [path]


def _fingerprint(files: list[Path]) -> str:
    """SHA-256 of what files hold, and of their names where there are several."""
    digest = hashlib.sha256()
    for path in files:
        if len(files) > 1:
            digest.update(path.name.encode("utf-8", "surrogateescape") + b"\0")
        try:
            with open(path, "rb") as file:
                while chunk := file.read(_CHUNK):
                    digest.update(chunk)
        except OSError as error:
            raise RetargetError(f"{path} cannot be read: {error.strerror or error}") from error
    return digest.hexdigest()


def check_same(kept: object, wanted: Mapping[str, str], place: Path) -> None:
    """RetargetError if what a place keeps was made with anything else; names the differences."""
    before = kept if isinstance(kept, dict) else {}
    differing = [name for name in {**before, **wanted} if before.get(name) != wanted.get(name)]
    if differing:
        raise RetargetError(
            f"{place} keeps a run that was made with another {', another '.join(differing)}; expected the same as "
            "then, or remove it to start anew"
        )


@contextmanager
def _told(folder: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise RetargetError(f"{folder} cannot be written: {error.strerror or error}") from error
