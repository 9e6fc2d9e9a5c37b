"""Proposals for the feature points that a face lacks."""

from __future__ import annotations

from zlib import crc32

from bpy.types import Object

from ..core.errors import RetargetError
from ..core.mesh import TriMesh
from ..core.placing.predictor import Predictor
from ..core.point_sets import POINT_INFOS, POINT_SETS
from ..core.points import FeaturePoints
from .meshes import neutral_mesh, read_positions, stretch
from .points import place_points, read_points, read_proposals, write_proposals
from .raycast import available_caster
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


def wanted_names(thing: Object) -> list[str]:
    """Names of the object's set that are neither placed nor skipped, in the set's order."""
    face = thing.facial_retarget
    done = {*face.points.keys(), *face.skipped.keys()}
    return [info.name for info in POINT_SETS[face.point_set] if info.name not in done]


def update_predictions(thing: Object) -> None:
    """Propose what the placed points tell of the missing ones.

    To be called after points were placed, moved, removed or skipped. While the placed points are too few to tell
    anything, proposals stay as they are. On a mesh that has changed nothing is touched until the points are refreshed.
    """
    if has_stale_points(thing) or thing.data.is_editmode:
        return
    wanted, known, proposals = wanted_names(thing), read_points(thing), _still_wanted(thing)
    try:
        predicted = predictor_of(thing).predict(known, wanted) if wanted else known.subset([])
    except RetargetError:
        # Too few points, or all on one line: Guess Points, which the artist asks for, says so.
        predicted = known.subset([])
    others = proposals.subset([name for name in proposals.names if name not in predicted.names])
    write_proposals(thing, predicted.joined(others))


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


def chosen_proposal(thing: Object) -> str:
    """The name of the proposal that is chosen in the list; RetargetError if none is."""
    face = thing.facial_retarget
    if face.active_proposal not in range(len(face.proposals)):
        raise RetargetError(f"no proposed point of object {thing.name!r} is chosen, expected one of the list")
    return str(face.proposals[face.active_proposal].name)


def _still_wanted(thing: Object) -> FeaturePoints:
    """The proposals that there are, but for those that the set no longer wants; it has no say in names of one's own."""
    proposals, face = read_proposals(thing), thing.facial_retarget
    unwanted = (POINT_INFOS.keys() - wanted_names(thing)) | {*face.points.keys(), *face.skipped.keys()}
    return proposals.subset([name for name in proposals.names if name not in unwanted])
