"""A face that FAPs move, out of its files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..core.acting.fap_face import FapFace, fit_fap_face
from ..core.arrays import Progress, no_progress
from ..core.errors import RetargetError
from ..core.parts.kinds import NO_NAMES, named_faults
from .mesh_file import MeshFile
from .meshes import read_mesh
from .parts import read_parts
from .points import read_points


@dataclass(frozen=True)
class FapFaceFiles:
    """Neutral mesh and feature points of a face, the variant of its weights (see `fit_fap_face`), its named parts."""

    neutral: Path
    points: Path
    variant: str = "default"
    parts: Path | None = None

    def inputs(self) -> dict[str, Path]:
        """What is read: how messages name it -> its path."""
        named = {} if self.parts is None else {"parts": self.parts}
        return {"face": self.neutral, "points": self.points, **named}


def fit_face_files(files: FapFaceFiles, progress: Progress = no_progress) -> tuple[MeshFile, FapFace]:
    """Read a face and fit it.

    Raises
    ------
    RetargetError : as `read_mesh`, `read_points`, `read_parts` and `fit_fap_face`; names the file.
    """
    mesh_file = read_mesh(files.neutral)
    points = read_points(files.points, mesh_file.mesh)
    named = NO_NAMES if files.parts is None else read_parts(files.parts, mesh_file.mesh, files.neutral)
    if wrong := named_faults(mesh_file.mesh, points, named):
        raise RetargetError(f"{files.parts}: {'; '.join(wrong)}")
    try:
        return mesh_file, fit_fap_face(mesh_file.mesh, points, files.variant, progress, named)
    except RetargetError as error:
        raise RetargetError(f"{files.points}: {error}") from error
