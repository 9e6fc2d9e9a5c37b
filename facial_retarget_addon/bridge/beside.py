"""Files beside a job file, named after it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from ..core.parts.kinds import NamedParts
from ..core.points import FeaturePoints
from ..files.job import FaceFiles
from ..files.meshes import write_mesh
from ..files.parts import write_parts
from ..files.points import write_points
from ..files.whole import Aside
from .heads import Head

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

    def head(self, role: str, head: Head) -> FaceFiles:
        """Write a head's neutral, points and named parts."""

        def parts(named: NamedParts, place: Path) -> None:
            write_parts(named, head.face.mesh, place)

        def points(placed: FeaturePoints, place: Path) -> None:
            write_points(placed, place, len(head.face.mesh.vertices))

        named = head.face.named_parts
        return FaceFiles(
            self.add(f"{role}.obj", write_mesh, head.file),
            self.add(f"{role}_points.json", points, head.face.points),
            parts=self.add(f"{role}_parts.json", parts, named) if named else None,
        )
