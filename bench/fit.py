"""Fitting a pair of faces: 26 000 source vertices, 20 000 target vertices, 100 points, level 4."""

from __future__ import annotations

from collections.abc import Iterator

from facial_retarget_addon.core.arrays import no_progress
from facial_retarget_addon.core.methods import hierarchical
from facial_retarget_addon.core.methods.settings import HierarchicalSettings

from .faces import problem
from .timing import Row, medians


def rows() -> Iterator[Row]:
    """Seconds of a whole fit, and of its parts."""
    task, settings = problem(), HierarchicalSettings()
    yield Row("source vertices", len(task.source.mesh.vertices), "")
    yield Row("target vertices", len(task.target.mesh.vertices), "")

    def fresh() -> object:
        # Meshes remember their connectivity: a fit is timed on meshes that remember nothing.
        again = problem()
        for face in (again.source, again.target):
            mesh = face.mesh
            for name in [key for key in mesh.__dict__ if key not in ("vertices", "faces", "polygons")]:
                del mesh.__dict__[name]
        return hierarchical.fit(again, settings, no_progress)

    yield Row("fit", medians({"fit": fresh})["fit"], "s", 1.5)
