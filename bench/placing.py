"""Points proposed on heads whose points are known: distance in eye separations, after 0, 5 and 10 placed ones.

Every human head is predicted by the average of the other artists' heads, never by one that it is part of. Points that
were given are not measured. A face that lacks one of the first points gets the next ones of the set.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from facial_retarget_addon import demo
from facial_retarget_addon.core.arrays import FloatArray
from facial_retarget_addon.core.base.regions import eye_separation
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.placing.predictor import Predictor
from facial_retarget_addon.core.placing.template import Template, face_template
from facial_retarget_addon.core.point_sets import POINT_SETS
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.core.rigid import fit_similarity
from facial_retarget_addon.files.points import read_points

from .mean_face import KnownHead, average_face, known_heads
from .real_pair import DATA, read_pair
from .timing import Row, medians

ORDER = [info.name for info in POINT_SETS["DENSE"]]
HUMAN, OGRE = 0.08, 0.15
"""Bounds of the median after five points."""
CLICK = 0.05
"""Seconds that a click may take at 30 000 vertices."""
OGRE_POINTS = Path(__file__).resolve().parents[1] / "tests" / "data" / "ogre_points.json"


def rows() -> Iterator[Row]:
    """Median and 90 % of every head, then all together, then the time of a click and of a guess."""
    heads = [*known_heads(), *_pair_heads()]
    every: dict[int, list[FloatArray]] = {0: [], 5: [], 10: []}
    templates: dict[str, Template] = {}
    for head in heads:
        if head.family not in templates:
            templates[head.family] = average_face(other for other in known_heads() if other.family != head.family)
        predictor = Predictor(head.mesh, templates[head.family])
        for count in every:
            errors = proposal_errors(predictor, head, count)
            every[count].append(errors)
            yield from _figures(head.name, count, errors, HUMAN)
    for count, some in every.items():
        if some:
            everything = np.concatenate(some)
            yield Row(f"all human heads after {count}: median", float(np.median(everything)), "")
            yield Row(f"all human heads after {count}: 90 %", float(np.quantile(everything, 0.9)), "")
    for head in (*_ogre(), *_built_in()):
        predictor = Predictor(head.mesh)
        for count in every if head.family != "ogre" else (5, 10):
            yield from _figures(head.name, count, proposal_errors(predictor, head, count), OGRE)
    yield from _times()


def proposal_errors(predictor: Predictor, head: KnownHead, count: int) -> FloatArray:
    """(N,) distances of the points proposed once the first `count` are placed, in eye separations."""
    first = [name for name in ORDER if name in head.points.names][:count]
    rest = [name for name in head.points.names if name not in first]
    known = head.points.subset(first)
    found = predictor.predict(known, rest) if count else predictor.guess(rest).points
    gaps = found.positions(head.mesh.vertices) - head.points.subset(found.names).positions(head.mesh.vertices)
    distances: FloatArray = np.linalg.norm(gaps, axis=1) / _separation(head)
    return distances


def _figures(name: str, count: int, errors: FloatArray, bound: float) -> Iterator[Row]:
    yield Row(f"{name} after {count}: median", float(np.median(errors)), "", bound if count == 5 else None)
    if count == 5:
        yield Row(f"{name} after {count}: 90 %", float(np.quantile(errors, 0.9)), "")


def _separation(head: KnownHead) -> float:
    """Distance of the eyes' middles; with one eye, what the average face's is once it is laid on all points."""
    if {"3.7", "3.11", "3.8", "3.12"} <= set(head.points.names):
        return eye_separation(head.mesh, head.points)
    template = face_template()
    names = [name for name in head.points.names if template.has(name)]
    there = head.points.subset(names).positions(head.mesh.vertices)
    return fit_similarity(template.places[template.rows(names)], there).scale


def _pair_heads() -> list[KnownHead]:
    """The pair of heads, the target of another topology; their points that have MPEG-4 names."""
    pair = read_pair()
    if pair is None:
        return []
    heads = []
    for name, face in (("pair's source", pair.problem.source), ("pair's target", pair.problem.target)):
        points = face.points.subset([point for point in face.points.names if face_template().has(point)])
        heads.append(KnownHead(name, "ict", face.mesh, points))
    return heads


def _ogre() -> list[KnownHead]:
    if not (DATA / "ogre.npz").exists():
        return []
    data = np.load(DATA / "ogre.npz")
    mesh = TriMesh(data["vertices"], data["tris"])
    return [KnownHead("ogre", "ogre", mesh, read_points(OGRE_POINTS, mesh))]


def _built_in() -> list[KnownHead]:
    faces = (demo.actor(), *demo.targets(), demo.child())
    return [KnownHead(face.name, "built-in", face.face.mesh, face.face.points) for face in faces]


def _times() -> Iterator[Row]:
    """Seconds at 30 000 vertices: looking at the mesh, a click, a mirrored point, a guess."""
    face = demo.actor(30_000).face
    names: Sequence[str] = face.points.names
    known: FeaturePoints = face.points.subset(ORDER[:5])
    predictor = Predictor(face.mesh)
    seconds = medians(
        {
            "click": lambda: predictor.predict(known, names),
            "mirror": lambda: predictor.mirrored(known, ["3.7"]),
            "doubts": lambda: predictor.doubtful(face.points),
            "build": lambda: Predictor(face.mesh),
            "guess": lambda: Predictor(face.mesh).guess(names),
        },
        rounds=3,
    )
    yield Row("a click, 30 000 vertices", seconds["click"], "s", CLICK)
    yield Row("a mirrored point", seconds["mirror"], "s", CLICK)
    yield Row("doubts, all points", seconds["doubts"], "s", CLICK)
    yield Row("made once per mesh", seconds["build"], "s", 1.0)
    yield Row("a guess from nothing", seconds["guess"], "s", 5.0)
