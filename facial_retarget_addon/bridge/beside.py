"""Files beside a job file, named after it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from ..files.whole import Aside

T = TypeVar("T")


class Beside:
    """Writes files that appear together with their job.

    Parameters
    ----------
    job : the job file.
    """

    def __init__(self, job: Path, aside: Aside) -> None:
        self._job, self._aside = job, aside

    def path(self, name: str) -> Path:
        """Where the file of this name lies."""
        return self._job.with_name(f"{self._job.stem}_{name}")

    def add(self, name: str, write: Callable[[T, Path], None], content: T) -> Path:
        """Write one file; returns where it will appear."""
        write(content, self._aside.place(self.path(name)))
        return self.path(name)
