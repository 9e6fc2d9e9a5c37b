"""Targets of a clone job that are done, kept beside their places: a run that was stopped goes on with the next one."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Any

from ..core.errors import RetargetError
from .clone_job import OPTIONAL_OUTPUTS, BuiltInActor, CloneJob, TargetFiles
from .documents import Table, fault_sentence, read_json
from .kept_run import ENDING, check_same, fingerprints, program
from .pages.report import report_json
from .whole import Aside, Suffixes, flush, remove, write_whole


class KeptTarget(Aside):
    """Places for what a target gets. They last until the job is done, with a record of all that they depend on.

    Parameters
    ----------
    aside : what appears when the job is done; what is kept appears with it.

    Attributes
    ----------
    report : of the target as an earlier run has left it; None where none has.

    Raises
    ------
    RetargetError : if what is kept depends on anything else, which names the differences, or cannot be read.
    """

    def __init__(self, job: CloneJob, number: int, aside: Aside) -> None:
        super().__init__()
        self._aside = aside
        self._record = _record(job.targets[number])
        self._made_with = _made_with(job, number)
        self._places: list[tuple[Path, Path, Suffixes]] = []
        self.report: dict[str, Any] | None = None
        if not self._record.exists():
            return
        wrong: list[str] = []
        kept = Table(read_json(self._record), "", wrong)
        check_same(kept.get("made_with", dict), self._made_with, self._record)
        places, self.report = kept.get("places", list), kept.get("report", dict)
        if wrong:
            raise RetargetError(fault_sentence(self._record, wrong))
        for made, path, suffixes in places:
            aside.adopt(Path(made), Path(path), tuple(suffixes))

    def place(self, path: Path, replaces: Suffixes = "") -> Path:
        """As `Aside.place`; what an earlier run has left there half written is removed."""
        made = path.with_name(f".{path.stem}{ENDING}{path.suffix}")
        self._aside.adopt(made, path, replaces)
        self._places.append((made, path, replaces))
        remove(made)
        return made

    def done(self, report: dict[str, Any]) -> None:
        """Keep what was written, and the target's report; RetargetError if the system refuses."""
        for made, _, _ in self._places:
            flush(made)
        places = [
            (str(made), str(path), [replaces] if isinstance(replaces, str) else list(replaces))
            for made, path, replaces in self._places
        ]
        record = {"made_with": self._made_with, "report": report, "places": places}
        write_whole(self._record, report_json(record))

    def vanish(self) -> None:
        """Remove what was written for a target that is not done."""
        for made, _, _ in self._places:
            remove(made)


def forget_targets(job: CloneJob) -> None:
    """Remove what was kept of a job that is done; RetargetError if a record cannot be read."""
    for record in map(_record, job.targets):
        if record.exists():
            for made, _, _ in Table(read_json(record), "", []).get("places", list):
                remove(Path(made))
            remove(record)


def _record(files: TargetFiles) -> Path:
    return files.shapes.with_name(f"{files.shapes.name}{ENDING}.json")


def _made_with(job: CloneJob, number: int) -> dict[str, str]:
    """All that a target's outputs depend on: what a message calls it -> its value, or its fingerprint."""
    files = job.targets[number]
    values: dict[str, object] = {"method": job.method, "preparation": asdict(job.preparation)}
    values |= {f"[settings] {name}": value for name, value in asdict(job.settings).items()}
    if isinstance(job.source, BuiltInActor):
        values["actor"] = job.source.sets
    if files.wrinkles is not None:
        values["wrinkle kit"] = asdict(job.wrinkle_kit)
    values |= {key: getattr(files, key) for key in ("shapes", *OPTIONAL_OUTPUTS)}
    other = tuple(f"[[targets]] {n} " for n in range(1, len(job.targets) + 1) if n != number + 1)
    inputs = {name: path for name, path in job.inputs().items() if not name.startswith((*other, "the job file"))}
    return {name: str(value) for name, value in values.items()} | program() | fingerprints(inputs)
