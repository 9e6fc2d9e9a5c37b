"""Proposals for the feature points that a face lacks, and doubts about those that it has."""

from __future__ import annotations

from zlib import crc32

import numpy as np
from bpy.types import Object

from ...core.arrays import Progress
from ...core.checks import stray_points
from ...core.doubts import doubts
from ...core.errors import RetargetError
from ...core.mesh import TriMesh
from ...core.placing.predictor import LEAST, Guess, Predictor
from ...core.point_sets import POINT_INFOS, POINT_SETS, partner_of, side_of
from ...core.points import FeaturePoints
from ...core.problem import Face
from ..background import Steps, in_thread
from ..meshes import neutral_mesh, read_positions, stretch
from ..raycast import available_caster
from .points import place_points, read_points, read_proposals, write_proposals
from .topology import has_stale_points, topology_of

KEPT = 4
"""Faces whose predictor is kept: source, target, and a pair that the artist worked on before."""


Key = tuple[object, ...]
"""What tells one neutral from another."""

_predictors: dict[int, tuple[Key, Predictor]] = {}
"""Object -> the neutral that was read, and its predictor; the one used last stands last."""


def predictor_of(thing: Object) -> Predictor:
    """The predictor of an object's neutral, made anew when its shape or topology has changed.

    Raises
    ------
    RetargetError : if the object is no surface.
    """
    predictor = kept_predictor(thing) or new_predictor(neutral_mesh(thing))
    keep_predictor(thing.session_uid, key_of(thing), predictor)
    return predictor


def kept_predictor(thing: Object) -> Predictor | None:
    """The predictor of an object's neutral as it is now, if there is one."""
    key, predictor = _predictors.get(thing.session_uid, (None, None))
    return predictor if key == key_of(thing) else None


def new_predictor(mesh: TriMesh) -> Predictor:
    """A predictor of a neutral."""
    return Predictor(mesh, make_caster=available_caster())


def keep_predictor(uid: int, key: Key, predictor: Predictor) -> None:
    """Keep a predictor for the object of this session's number, and forget the one that was used longest ago."""
    _predictors.pop(uid, None)
    _predictors[uid] = key, predictor
    while len(_predictors) > KEPT:
        del _predictors[next(iter(_predictors))]


def key_of(thing: Object) -> Key:
    """What tells an object's neutral from another."""
    return topology_of(thing.data), crc32(read_positions(thing.data).tobytes()), stretch(thing).tobytes()


def update_predictions(thing: Object) -> None:
    """Propose what the placed points tell of the missing ones, and note which placed points are doubtful.

    To be called after points were placed, moved, removed or skipped. While the placed points are too few to tell
    anything, proposals stay as they are. On a mesh that has changed nothing is touched until the points are refreshed,
    and nothing where points or mesh are broken: what works with them says so.
    """
    if has_stale_points(thing) or thing.data.is_editmode:
        return
    try:
        points, there = read_points(thing), _still_wanted(thing)
        predicted, doubtful = _predicted(thing, points, wanted_names(thing)), _doubts(thing, points)
    except RetargetError:
        return
    others = there.subset([name for name in there.names if name not in predicted.names])
    write_proposals(thing, predicted.joined(others))
    for point in thing.facial_retarget.points:
        point.doubt = doubtful.get(point.name, "")


def guess_steps(thing: Object) -> Steps[float]:
    """Propose all missing points of the object's set: by the placed ones where these tell enough, else from nothing.

    Returns how sure it is that the mesh shows a face, from 0 to 1; 1 where the placed points tell enough.

    Raises
    ------
    RetargetError : if the mesh shows no face, or no point is missing.
    """
    points, wanted = read_points(thing), wanted_names(thing)
    if not wanted:
        raise RetargetError(f"object {thing.name!r} lacks no point of its set, expected one that is to be guessed")
    if _telling(points) >= LEAST:
        update_predictions(thing)
        return 1.0

    predictor, doing = predictor_of(thing), f"looking for a face on {thing.name}"

    def look(progress: Progress) -> Guess:
        progress(0.0, doing)
        return predictor.guess(wanted)

    guess = yield from in_thread(look)
    write_proposals(thing, guess.points)
    update_predictions(thing)
    return guess.confidence


def accept_proposals(thing: Object, names: list[str] | None = None) -> int:
    """Place proposed points: those of these names, or all. Returns how many.

    Raises
    ------
    RetargetError : if a name is not proposed.
    """
    proposals = read_proposals(thing)
    chosen = proposals if names is None else proposals.subset(names)
    place_points(thing, chosen)
    update_predictions(thing)
    return len(chosen)


def mirror_points(thing: Object, names: list[str]) -> tuple[str, ...]:
    """Place the partners of points on the other half of the face, through its surface; returns the partners' names.

    Where the partners were before has no say: it may be what the artist wants to get rid of.

    Parameters
    ----------
    names : of placed points; those without a partner are left out.

    Raises
    ------
    RetargetError : if none of them has a partner.
    """
    sided = [name for name in names if partner_of(name)]
    if not sided:
        raise RetargetError(
            f"object {thing.name!r} has no feature point to mirror among {', '.join(names) or 'those of that half'}, "
            "expected one that has a partner on the other half of the face"
        )
    points, anew = read_points(thing), {partner_of(name) for name in sided} - set(sided)
    believed = points.subset([name for name in points.names if name not in anew])
    partners = predictor_of(thing).mirrored(believed, sided)
    place_points(thing, partners)
    update_predictions(thing)
    return partners.names


def names_to_mirror(thing: Object, which: str) -> list[str]:
    """Placed points to mirror: those of the half "LEFT" or "RIGHT", or "CHOSEN", the one chosen in the list."""
    face = thing.facial_retarget
    if which == "CHOSEN":
        return [point.name for point in face.points[face.active_point : face.active_point + 1]]
    return [point.name for point in face.points if side_of(point.name) == which.lower()]


def chosen_proposal(thing: Object) -> str:
    """The name of the proposal that is chosen in the list; RetargetError if none is."""
    face = thing.facial_retarget
    if face.active_proposal not in range(len(face.proposals)):
        raise RetargetError(f"no proposed point of object {thing.name!r} is chosen, expected one of the list")
    return str(face.proposals[face.active_proposal].name)


def wanted_names(thing: Object) -> list[str]:
    """Names of the object's set that are neither placed nor skipped, in the set's order."""
    face = thing.facial_retarget
    done = {*face.points.keys(), *face.skipped.keys()}
    return [info.name for info in POINT_SETS[face.point_set] if info.name not in done]


def _telling(points: FeaturePoints) -> int:
    """How many of the points the average face has."""
    return len(POINT_INFOS.keys() & set(points.names))


def _predicted(thing: Object, points: FeaturePoints, wanted: list[str]) -> FeaturePoints:
    """The wanted points, or none while nothing tells where they are."""
    if not wanted or not len(thing.data.polygons):
        return FeaturePoints.none()
    predictor = predictor_of(thing)
    if _telling(points) < LEAST and not predictor.has_looked:
        return FeaturePoints.none()
    try:
        return predictor.predict(points, wanted)
    except RetargetError:
        # All on one line: Guess Points, which the artist asks for, says so.
        return FeaturePoints.none()


def _still_wanted(thing: Object) -> FeaturePoints:
    """The proposals that there are, but for those that the set no longer wants; it has no say in names of one's own."""
    proposals, face = read_proposals(thing), thing.facial_retarget
    unwanted = (POINT_INFOS.keys() - wanted_names(thing)) | {*face.points.keys(), *face.skipped.keys()}
    return proposals.subset([name for name in proposals.names if name not in unwanted])


def _doubts(thing: Object, points: FeaturePoints) -> dict[str, str]:
    """Why points are doubtful: how they lie against one another, and on an average face."""
    if not len(points):
        return {}
    places = points.positions(read_positions(thing.data).astype(np.float64))
    if _telling(points) < LEAST:
        return doubts(points.names, places)
    predictor = predictor_of(thing)
    strange = dict.fromkeys(predictor.doubtful(points), "far from where the other points expect it")
    stray = dict.fromkeys(stray_points(Face(predictor.mesh, points)), "on another part of the mesh, such as lashes")
    return strange | stray | doubts(points.names, places)
