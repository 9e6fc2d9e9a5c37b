"""Numbers about a result that need no truth: torn edges, turned triangles, drift."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from .arrays import FloatArray, IntArray, cross
from .mesh import TriMesh

TORN = 3.0
"""An edge is torn where it is stretched beyond this many times its neutral length ..."""
CALM = 1.5
"""... while no source edge around its counterpart is stretched beyond this."""


@dataclass(eq=False)
class Quality:
    """Counts defects of retargeted frames, block by block.

    Parameters
    ----------
    source, target : neutral faces.
    counterpart : (Vt,) the source vertex nearest to each target vertex's counterpart, -1 for none.
    """

    source: TriMesh
    target: TriMesh
    counterpart: IntArray
    torn: list[int] = field(default_factory=list)
    flipped: list[int] = field(default_factory=list)
    largest: list[float] = field(default_factory=list)
    drift: float = 0.0

    def add(self, source_frames: FloatArray, target_frames: FloatArray) -> None:
        """Measure frames (F, Vs, 3) of the source and (F, Vt, 3) of the target."""
        rest = self.target.vertices.astype(np.float32)
        for before, after in zip(source_frames, target_frames, strict=True):
            calm = self._calm(before)
            stretch = _stretch(self.target, after)
            i, j = self.target.edges.T
            self.torn.append(int(((stretch > TORN) & calm[i] & calm[j]).sum()))
            a, b, c = (after[self.target.faces[:, k]] for k in range(3))
            turned = np.einsum("fi,fi->f", cross(b - a, c - a), self._face_vectors) < 0
            a, b, c = (before[self.source.faces[:, k]] for k in range(3))
            source_turned = np.einsum("fi,fi->f", cross(b - a, c - a), self._source_face_vectors) < 0
            corner_turned = np.zeros(len(self.source.vertices) + 1, bool)
            corner_turned[self.source.faces[source_turned]] = True
            also = corner_turned[self.counterpart[self.target.faces]].any(axis=1)
            self.flipped.append(int((turned & ~also).sum()))
            moved = np.sqrt(np.square(after - rest).sum(axis=1).max(initial=0.0))
            self.largest.append(float(moved))
            if np.array_equal(before, self.source.vertices.astype(np.float32)):
                self.drift = max(self.drift, float(moved))

    def __post_init__(self) -> None:
        self._face_vectors = self.target.face_vectors.astype(np.float32)
        self._source_face_vectors = self.source.face_vectors.astype(np.float32)

    def _calm(self, frame: FloatArray) -> FloatArray:
        """(Vt,) whether no edge at the counterpart is stretched; false where there is none."""
        stretch = _stretch(self.source, frame)
        tight = np.ones(len(self.source.vertices) + 1, bool)
        tight[self.source.edges[stretch > CALM].ravel()] = False
        tight[-1] = False
        calm: FloatArray = tight[self.counterpart]
        return calm

    def per_frame(self) -> Mapping[str, Sequence[float]]:
        """What was measured of each frame: name -> a figure for each."""
        return {"torn_edges": self.torn, "flipped_triangles": self.flipped}

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


def _stretch(mesh: TriMesh, positions: FloatArray) -> FloatArray:
    """(E,) edge lengths over their neutral lengths; 1 for an edge without length."""
    i, j = mesh.edges.T
    gap = positions[i] - positions[j]
    length = np.sqrt(np.einsum("ij,ij->i", gap, gap))
    return np.divide(length, mesh.edge_lengths, out=np.ones(len(length)), where=mesh.edge_lengths > 1e-9 * mesh.size)
