"""Measures the average face that `core/placing` predicts from, and prints its table: python -m bench.mean_face."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from facial_retarget_addon import demo
from facial_retarget_addon.core.arrays import FloatArray, unit_vectors
from facial_retarget_addon.core.closest_point import SurfaceFinder
from facial_retarget_addon.core.matching.correspondence import correspond, places_on_source
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.mpeg4.head import head_axes
from facial_retarget_addon.core.placing.template import Template, partner
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.core.rigid import fit_similarity
from facial_retarget_addon.demo.cast import ACTOR
from facial_retarget_addon.files.points import read_points

from .real_pair import DATA

EXTRA = {
    "2.11": (0.36, -1.56),
    "3.9": (0.50, -0.155),
    "3.13": (0.52, 0.145),
    "9.5": (0.155, -0.735),
    "9.7": (0.125, -0.03),
    "9.13": (0.135, -0.27),
}
"""MPEG-4 points of the left half that the donor lacks: by judgement, places on its chart."""
ROUNDS = 4
"""Of the alignment of the heads with their mean."""
CORNERS = ("3.7", "3.11", "3.8", "3.12")
PUPILS = {"3.5": (0.5, 0.0, 0.03, 0.0, 0.0, 1.0), "3.6": (-0.5, 0.0, 0.03, 0.0, 0.0, 1.0)}
"""By judgement: no head's table has them."""
SETS = {
    "ict": ("ict_dev", "ict"),
    "makehuman": ("makehuman_dev", "makehuman"),
    "male_adult_08": ("male_adult_08", "male_adult_08"),
    "johnsmith": ("johnsmith_welded", "johnsmith"),
}
"""Artist's set -> its npz and the stem of its points."""


@dataclass(frozen=True, eq=False)
class KnownHead:
    """A head whose points are known.

    Attributes
    ----------
    name, family : the head's, and that of the set that it belongs to: heads of one family share their topology.
    """

    name: str
    family: str
    mesh: TriMesh
    points: FeaturePoints


@cache
def known_heads() -> tuple[KnownHead, ...]:
    """The human heads of the data beside the project, with all their identities; none where it is not there."""
    heads = []
    for family, (archive, stem) in SETS.items():
        if not (DATA / f"{archive}.npz").exists():
            return ()
        data = np.load(DATA / f"{archive}.npz")
        mesh = TriMesh(data["vertices"], data["tris"])
        points = read_points(DATA / f"{stem}_points.json", mesh)
        heads.append(KnownHead(family, family, mesh, points))
        if "identity_vertices" in data.files:
            for name, vertices in zip(data["identity_names"], data["identity_vertices"], strict=True):
                heads.append(KnownHead(f"{family} {name}", family, mesh.with_vertices(vertices), points))
    return tuple(heads)


def average_face(heads: Iterable[KnownHead]) -> Template:
    """The mean of heads, every family counting as much, symmetric, in eye separations from the eyes' middle.

    Names that only the built-in donor has are carried onto each head through the points that both have.
    """
    names = _names()
    places: dict[str, list[tuple[FloatArray, FloatArray]]] = {}
    for head in heads:
        places.setdefault(head.family, []).append(_measured(head, names))
    mean, normals = next(iter(places.values()))[0]
    for _ in range(ROUNDS):
        sums = np.zeros((2, len(names), 3))
        for family in places.values():
            for there, outwards in family:
                fit = fit_similarity(there, mean)
                sums += np.stack([fit.apply(there), outwards @ fit.rotation.T]) / len(family)
        mean, normals = _upright(names, *_symmetric(names, sums / len(places)))
    rows = {name: (*place, *normal) for name, place, normal in zip(names, mean, normals, strict=True)}
    return Template.from_rows({name: tuple(map(float, row)) for name, row in (rows | PUPILS).items()})


def _names() -> list[str]:
    """Names of the donor's points."""
    return list(_donor()[1].names)


@cache
def _donor() -> tuple[TriMesh, FeaturePoints]:
    """The donor's skin alone, and its points."""
    face = demo.donor().face
    skin = face.mesh.components == face.mesh.components[face.points.holders[0]]
    row = np.cumsum(skin) - 1
    mesh = TriMesh(face.mesh.vertices[skin], row[face.mesh.faces[skin[face.mesh.faces].all(axis=1)]])
    chart = EXTRA | {partner(name): (-x, y) for name, (x, y) in EXTRA.items()}
    found = SurfaceFinder(mesh).closest(ACTOR.surface(np.array(list(chart.values()))))
    extra = FeaturePoints(tuple(chart), mesh.faces[found.face], found.weights)
    return mesh, FeaturePoints(face.points.names, row[face.points.vertices], face.points.weights).joined(extra)


_carried: dict[str, FeaturePoints] = {}


def _measured(head: KnownHead, names: Sequence[str]) -> tuple[FloatArray, FloatArray]:
    """(N, 3) places and (N, 3) normals of the names on a head."""
    if head.name not in _carried:
        donor, points = _donor()
        rest = points.subset([name for name in names if name not in set(head.points.names)])
        found = correspond(head.mesh, head.points, donor, points)
        vertices, weights = places_on_source(found, head.mesh, donor, rest.vertices, rest.weights)
        _carried[head.name] = head.points.joined(FeaturePoints(rest.names, vertices, weights)).subset(names)
    whole = _carried[head.name]
    return whole.positions(head.mesh.vertices), unit_vectors(whole.positions(head.mesh.vertex_normals))


def _symmetric(names: list[str], both: FloatArray) -> FloatArray:
    """Places and normals (2, N, 3), the mean of the left and the right half.

    The middle plane is the one that mirrors the points best onto their partners.
    """
    partners = [names.index(partner(name)) for name in names]
    places = both[0]
    flipped = places[partners] * [-1.0, 1.0, 1.0]
    fit = fit_similarity(flipped, places, scale=False)
    return np.stack(
        [
            0.5 * (places + fit.apply(flipped)),
            unit_vectors(both[1] + (both[1][partners] * [-1.0, 1.0, 1.0]) @ fit.rotation.T),
        ]
    )


def _upright(names: list[str], places: FloatArray, normals: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Turned, moved and scaled: x to the left, chin below brows as `mpeg4.head` leans them, the eyes 1 apart."""
    axes = head_axes(names, places)
    corners = places[[names.index(name) for name in CORNERS]]
    left, right = corners[:2].mean(axis=0), corners[2:].mean(axis=0)
    size = float(np.linalg.norm(left - right))
    turned = (places - 0.5 * (left + right)) @ axes.T / size
    return turned, normals @ axes.T


def main() -> None:
    """Print the table of the left half and the middle, as `core/placing/face_table.py` holds it."""
    template = average_face(known_heads())
    order = np.lexsort((-template.places[:, 2], -template.places[:, 1]))
    for k in order:
        name = template.names[k]
        if partner(name) == name or template.places[k, 0] > 0:
            row = ", ".join(f"{value + 0.0:.3f}" for value in np.round((*template.places[k], *template.normals[k]), 3))
            print(f'    "{name}": ({row}),')


if __name__ == "__main__":
    main()
