"""Predicts where the missing feature points of a face lie, from those that an artist placed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import IntArray
from ..closest_point import Nearest, SurfaceFinder
from ..errors import RetargetError
from ..mesh import TriMesh
from ..mpeg4.regions import OWN_PARTS
from ..points import FeaturePoints
from ..raycast import CasterFactory, EmbreeCaster
from .face_fit import AGREEMENT, REACH, FaceFit, fit_face
from .outside import seen_from_outside
from .template import Template, face_template

LEAST = 3
"""Known points from which others can be predicted."""


class Predictor:
    """Predicts points on one neutral mesh; made once, asked after every click."""

    def __init__(
        self, mesh: TriMesh, template: Template | None = None, make_caster: CasterFactory = EmbreeCaster
    ) -> None:
        """Look at the mesh: which of its surface can be seen from outside.

        Parameters
        ----------
        mesh : the neutral face or head, in any axes and units; eyes, teeth and hair may be parts of it.
        template : the average face; the built-in one if none is given.
        """
        self._mesh = mesh.checked("the face")
        self._template = template or face_template()
        self._outside = seen_from_outside(mesh, make_caster(mesh))
        self._finders: dict[tuple[int, ...], SurfaceFinder] = {}

    def predict(self, known: FeaturePoints, wanted: Sequence[str]) -> FeaturePoints:
        """Places of the wanted points.

        They lie on the connected surface that holds the known points, where it can be seen from outside and looks the
        way that the average face does there.

        Parameters
        ----------
        known : placed points; those whose names the template lacks do not count.
        wanted : names; known ones and those that the template lacks are left out.

        Returns
        -------
        The wanted points in the order asked.

        Raises
        ------
        RetargetError : if fewer than 3 of the known points are the template's, or those lie on one line.
        """
        names = [name for name in wanted if self._template.has(name) and name not in known.names]
        fit, finder = self._fit(known)
        rows = self._template.rows([name for name in names if name not in OWN_PARTS])
        return self._on_surface(fit, rows, finder).subset([name for name in names if name not in OWN_PARTS])

    def _fit(self, known: FeaturePoints) -> tuple[FaceFit, SurfaceFinder]:
        told = known.subset([name for name in known.names if self._template.has(name) and name not in OWN_PARTS])
        if len(told) < LEAST:
            raise RetargetError(
                f"{len(told)} of the {len(known)} placed points are of the average face, expected at least {LEAST} "
                f"such as {', '.join(self._template.names[:3])}, to predict the others"
            )
        finder = self._skin(told)
        places = told.positions(self._mesh.vertices)
        return fit_face(self._template, self._template.rows(told.names), places, finder), finder

    def _skin(self, points: FeaturePoints) -> SurfaceFinder:
        """Finds places on the components that hold the points, where they can be seen."""
        own = tuple(int(label) for label in np.unique(self._mesh.components[points.holders]))
        if own not in self._finders:
            there = np.isin(self._mesh.components[self._mesh.faces[:, 0]], own)
            seen = np.flatnonzero(there & self._outside)
            self._finders[own] = SurfaceFinder(self._mesh, seen if len(seen) else np.flatnonzero(there))
        return self._finders[own]

    def _on_surface(self, fit: FaceFit, rows: IntArray, finder: SurfaceFinder) -> FeaturePoints:
        places, normals = fit.places[rows], fit.normals[rows]
        found = finder.closest(places, normals, AGREEMENT, REACH * fit.pose.scale)
        lost = found.face < 0
        for mine, other in zip(found, finder.closest(places[lost]), strict=True):
            mine[lost] = other
        return _points([fit.template.names[row] for row in rows], self._mesh, found)


def _points(names: Sequence[str], mesh: TriMesh, places: Nearest) -> FeaturePoints:
    return FeaturePoints(tuple(names), mesh.faces[places.face], places.weights)
