"""The feature points that a face lacks, proposed. For the command line and scripts."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..core.errors import RetargetError
from ..core.placing.predictor import Predictor
from ..core.point_sets import POINT_SETS
from ..core.points import FeaturePoints
from .meshes import read_mesh
from .points import read_points, write_points
from .whole import overwritten


@dataclass(frozen=True)
class ProposedPoints:
    """What was proposed.

    Attributes
    ----------
    points : the points that were there, then those proposed.
    proposed : how many those are.
    doubtful : names of points that were there and that the others contradict.
    confidence : how sure a guess from nothing is, 0 to 1; None where points were there.
    """

    points: FeaturePoints
    proposed: int
    doubtful: tuple[str, ...]
    confidence: float | None


def run_points_task(neutral: Path, points: Path | None, point_set: str, out: Path) -> ProposedPoints:
    """Complete the feature points of a face, and write them all.

    Parameters
    ----------
    neutral : its mesh. points : those that it has; None to guess from the mesh alone.
    point_set : of `POINT_SETS`, whose points are wanted.
    out : where the points go (.json).

    Raises
    ------
    RetargetError : for files that cannot be used, an output that would replace an input, or no face on the mesh.
    """
    inputs = {"the face": neutral} | ({"the points": points} if points else {})
    if wrong := overwritten(inputs, {"the proposed points": out}):
        raise RetargetError("; ".join(wrong))
    mesh = read_mesh(neutral).mesh
    known = read_points(points, mesh) if points else FeaturePoints.none()
    wanted = [info.name for info in POINT_SETS[point_set] if info.name not in known.names]
    predictor = Predictor(mesh)
    confidence = None
    if len(known):
        found = predictor.predict(known, wanted)
    else:
        found, confidence = predictor.guess(wanted)
    whole = known.joined(found)
    write_points(whole, out, len(mesh.vertices))
    return ProposedPoints(whole, len(found), predictor.doubtful(known), confidence)
