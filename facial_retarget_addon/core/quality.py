"""Numbers about a result that need no truth: torn edges, turned triangles, drift."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

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

    def add(self, source_frames: FloatArray, target_frames: FloatArray) -> None:
        """Measure frames (F, Vs, 3) of the source and (F, Vt, 3) of the target."""
        rest = self.target.vertices.astype(np.float32)
        gaping = self._gaping(source_frames, target_frames)
        for before, after, gaps in zip(source_frames, target_frames, gaping, strict=True):
            torn = self._defects.torn(after, self._defects.calm(before))
            also = self._defects.turned_at_counterpart(before)[self.target.faces].any(axis=1)
            turned = self._defects.turned(after) & ~also
            self.torn.append(int(torn.sum()))
            self.flipped.append(int(turned.sum()))
            self.spots.append(Spots(np.unique(self.target.edges[torn]), np.unique(self.target.faces[turned]), *gaps))
            moved = np.sqrt(np.square(after - rest).sum(axis=1).max(initial=0.0))
            self.largest.append(float(moved))
            if np.array_equal(before, self.source.vertices.astype(np.float32)):
                self.drift = max(self.drift, float(moved))
        if self.seams is not None:
            for name, values in self.seams.measured(source_frames, target_frames).items():
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
