"""Numbers about a result that need no truth: torn edges, turned triangles, drift."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from .arrays import FloatArray, IntArray
from .defects import Defects
from .mesh import TriMesh
from .seams.gaps import Gaping, SeamGaps


class Spots(NamedTuple):
    """Where a frame is in trouble: the vertices (n,) of its torn edges, those of its turned triangles, and those of
    lips and of lids where they gape wider than the source's.
    """

    torn: IntArray
    turned: IntArray
    lips: IntArray
    lids: IntArray


@dataclass(eq=False)
class Quality:
    """Counts defects of retargeted frames, block by block.

    Parameters
    ----------
    source, target : neutral faces.
    counterpart : (Vt,) the source vertex nearest to each target vertex's counterpart, -1 for none.
    seams : measures how far lips and lids are open, where the faces have the points for it.
    """

    source: TriMesh
    target: TriMesh
    counterpart: IntArray
    seams: SeamGaps | None = None
    torn: list[int] = field(default_factory=list)
    flipped: list[int] = field(default_factory=list)
    largest: list[float] = field(default_factory=list)
    gaps: dict[str, list[float]] = field(default_factory=dict)
    spots: list[Spots] = field(default_factory=list)
    drift: float = 0.0

    def add(self, source_frames: FloatArray, target_frames: FloatArray) -> dict[str, Any]:
        """Measure frames (F, Vs, 3) of the source and (F, Vt, 3) of the target; returns plain data for `add_known`."""
        rest, still = self.target.vertices.astype(np.float32), self.source.vertices.astype(np.float32)
        found: dict[str, Any] = {"torn": [], "flipped": [], "spots": [], "largest": [], "drift": 0.0}
        gaping = self._gaping(source_frames, target_frames)
        for before, after, gaps in zip(source_frames, target_frames, gaping, strict=True):
            torn = self._defects.torn(after, self._defects.calm(before))
            also = self._defects.turned_at_counterpart(before)[self.target.faces].any(axis=1)
            turned = self._defects.turned(after) & ~also
            found["torn"].append(int(torn.sum()))
            found["flipped"].append(int(turned.sum()))
            spots = Spots(np.unique(self.target.edges[torn]), np.unique(self.target.faces[turned]), *gaps)
            found["spots"].append([vertices.tolist() for vertices in spots])
            moved = float(np.sqrt(np.square(after - rest).sum(axis=1).max(initial=0.0)))
            found["largest"].append(moved)
            if np.array_equal(before, still):
                found["drift"] = max(found["drift"], moved)
        found["gaps"] = {} if self.seams is None else dict(self.seams.measured(source_frames, target_frames))
        self.add_known(found)
        return found

    def add_known(self, found: Mapping[str, Any]) -> None:
        """Add the next frames by what `add` has returned for them."""
        self.torn += found["torn"]
        self.flipped += found["flipped"]
        self.largest += found["largest"]
        self.spots += [Spots(*(np.array(part, np.int64) for part in spots)) for spots in found["spots"]]
        self.drift = max(self.drift, found["drift"])
        for name, values in found["gaps"].items():
            self.gaps.setdefault(name, []).extend(values)

    def __post_init__(self) -> None:
        self._defects = Defects(self.source, self.target, self.counterpart)

    def _gaping(self, source_frames: FloatArray, target_frames: FloatArray) -> Sequence[Gaping]:
        if self.seams is None:
            return [Gaping(np.empty(0, np.int64), np.empty(0, np.int64))] * len(source_frames)
        return self.seams.gaping(source_frames, target_frames)

    def per_frame(self) -> Mapping[str, Sequence[float]]:
        """What was measured of each frame: name -> a figure for each."""
        return {"torn_edges": self.torn, "flipped_triangles": self.flipped, **self.gaps}

    def summary(self) -> dict[str, float | int]:
        """Plain figures over all frames; frames are counted from 1."""
        frames = max(len(self.torn), 1)
        trouble = np.array(self.torn) + np.array(self.flipped)
        return {
            "frames": len(self.torn),
            "torn_edges": int(sum(self.torn)),
            "torn_edges_per_million": 1e6 * sum(self.torn) / (frames * max(len(self.target.edges), 1)),
            "flipped_triangles": int(sum(self.flipped)),
            "flipped_triangles_per_million": 1e6 * sum(self.flipped) / (frames * max(len(self.target.faces), 1)),
            "neutral_drift": self.drift,
            "largest_displacement": max(self.largest, default=0.0),
            "worst_frame": int(trouble.argmax()) + 1 if len(trouble) else 0,
        }
