"""Everything that is wrong with a retargeting problem, said at once, before any work is done.

A *fault* breaks a method; a *warning* is survived and may look wrong. A few bad faces of a real head are
survived: they count as piercing errors and are filled. More of them than a hundredth of the skin are a fault.
The skin is the connected component that holds most feature points; eyes, teeth and hair do not count.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from .arrays import BoolArray, FloatArray, IntArray
from .errors import RetargetError
from .example_states import STILL, same_shapes
from .gained_face import GainedFace
from .methods.settings import LEAST_POINTS, LevelSettings, Settings, least_points
from .mpeg4.regions import OWN_PARTS
from .parts.kinds import named_faults
from .parts.lacking import lacking_parts
from .points import FeaturePoints, common_names
from .problem import Face, Problem
from .rigid import fit_rigid

BAD_SHARE = 0.01
"""Bad faces of the skin that a method survives."""
NO_AREA = 1e-12
"""A face has no area below this, times the square of the mesh's size."""
MOST_VERTICES = 5_000_000
"""Vertices that the finest level may have."""
RIGID = 1e-4
"""Motion that is left below this, times the mesh's size, when the head's motion is taken out, is none."""
NEUTRAL = "neutral"
"""The example that may equal the neutral face."""
_BLOCK = 16
_LISTED = 6


def faults(problem: Problem, frames: FloatArray | None, settings: Settings) -> list[str]:
    """What a method cannot work with, one clause for each fault.

    Parameters
    ----------
    frames : (F, Vs, 3) of the source, or None where none are to be retargeted.
    """
    found: list[str] = []
    for side, face in _sides(problem):
        found += _unusable(side, face) or [
            *_bad_faces(side, face, True),
            *_stray_points(side, face),
            *(f"{side}: {fault}" for fault in named_faults(face.mesh, face.points, face.named_parts)),
        ]
    found += _missing_points(problem, least_points(type(settings)))
    found += _example_faults(problem)
    if isinstance(settings, LevelSettings):
        found += _level_faults(problem, settings)
    if not found:
        found += _gain_faults(problem)
    if frames is not None:
        found += _frame_faults(problem.source, frames)
        if not found and _moves_rigidly(problem.source, frames):
            found.append(
                "the source moves rigidly: its frames are head motion only, expected a face that acts "
                "(was the face baked, or only the head that carries it?)"
            )
    return found


def warnings(problem: Problem, frames: FloatArray | None, settings: Settings) -> list[str]:
    """What a method survives and an artist should know; for a problem without faults."""
    found: list[str] = []
    for side, face in _sides(problem):
        found += _bad_faces(side, face, False)
    names = {side: set(face.points.names) for side, face in _sides(problem)}
    for side, other in (("source", "target"), ("target", "source")):
        single = [name for name in getattr(problem, side).points.names if name not in names[other]]
        if single:
            found.append(f"points that only the {side} has are not used: {_listed(single)}")
    for name, other in _same_examples(problem.target):
        found.append(f"examples {name!r} and {other!r} are identical on the target")
    if frames is not None and not _moves(problem.source, frames):
        found.append("the source does not move: all its frames are the neutral face")
    if frames is not None:
        found += lacking_parts(problem.source, problem.target, frames)
    return found


def _sides(problem: Problem) -> tuple[tuple[str, Face], tuple[str, Face]]:
    return ("source", problem.source), ("target", problem.target)


def _listed(names: list[str]) -> str:
    more = f" and {len(names) - _LISTED} more" if len(names) > _LISTED else ""
    return ", ".join(names[:_LISTED]) + more


# ---- meshes -------------------------------------------------------------------------------------
def _unusable(side: str, face: Face) -> list[str]:
    """Faults that leave nothing else to look at."""
    try:
        face.mesh.checked(f"{side} neutral")
    except RetargetError as error:
        return [str(error)]
    points = face.points
    outside = ((points.vertices < 0) | (points.vertices >= len(face.mesh.vertices))).any(axis=1)
    if outside.any():
        names = [points.names[row] for row in np.flatnonzero(outside)]
        return [f"{side} points {_listed(names)} lie on vertices that the {len(face.mesh.vertices)} do not include"]
    bad = ~np.isfinite(points.weights).all(axis=1)
    return [f"{side} points {_listed([points.names[row] for row in np.flatnonzero(bad)])} are NaN"] if bad.any() else []


def _point_components(face: Face) -> IntArray:
    """(P,) the component that holds each point."""
    components: IntArray = face.mesh.components[face.points.holders]
    return components


def _skin(face: Face) -> BoolArray:
    """(F,) the faces of the component with most points; the largest one where there are no points."""
    labels = face.mesh.components
    held = _point_components(face) if len(face.points) else labels[face.mesh.faces[:, 0]]
    skin: BoolArray = labels[face.mesh.faces[:, 0]] == np.argmax(np.bincount(held))
    return skin


def _bad_faces(side: str, face: Face, faulty: bool) -> list[str]:
    """Bad faces of the skin: the kinds that are faults, or the kinds that are warnings."""
    mesh = face.mesh
    skin = _skin(face)
    found: list[str] = []
    kinds = (
        ("meet at edges of more than two faces", (mesh.edge_face_count > 2)[mesh.face_edges].any(axis=1)),
        ("have no area", mesh.face_areas <= NO_AREA * mesh.size**2),
        ("are flipped against their neighbours", _turned(face)),
    )
    for what, bad in kinds:
        count, limit = int((bad & skin).sum()), BAD_SHARE * skin.sum()
        if count and (count > limit) == faulty:
            first = int(np.argmax(bad & skin))
            expected = f"expected at most {int(limit)}" if faulty else "they are left to their neighbours"
            found.append(f"{side}: {count} of {skin.sum()} faces {what}, the first is face {first}; {expected}")
    if faulty and _inside_out(face, skin):
        found.append(f"{side}: the faces look inwards, expected normals that point out of the head")
    return found


def _turned(face: Face) -> BoolArray:
    """(F,) faces whose direction disagrees with most of the surface that they are part of.

    Found on the orientation double cover: every face once as it is and once turned. Neighbours that agree across
    their edge are joined as they are, others with one of them turned; then each sheet is one consistent direction.
    """
    mesh = face.mesh
    order = np.argsort(mesh.face_edges.ravel(), kind="stable")
    edge = mesh.face_edges.ravel()[order]
    pair = np.flatnonzero((edge[1:] == edge[:-1]) & (mesh.edge_face_count[edge[:-1]] == 2))
    first, second = order[pair], order[pair + 1]
    disagree = mesh.half_edges[first, 0] == mesh.half_edges[second, 0]
    one, other, count = first // 3, second // 3, len(mesh.faces)
    rows = np.concatenate([one, one + count])
    columns = np.concatenate([other + count * disagree, other + count * ~disagree])
    joined = sp.coo_matrix((np.ones(len(rows)), (rows, columns)), shape=(2 * count, 2 * count))
    sheet = connected_components(joined, directed=False)[1]
    supporters = np.bincount(sheet[:count], minlength=sheet.max() + 1)
    turned: BoolArray = supporters[sheet[:count]] < supporters[sheet[count:]]
    return turned


def _inside_out(face: Face, skin: BoolArray) -> bool:
    """Whether the skin's area looks, on the whole, towards its middle."""
    mesh = face.mesh
    centres = mesh.vertices[mesh.faces[skin]].mean(axis=1)
    middle = np.average(centres, axis=0, weights=mesh.face_areas[skin] + 1e-300)
    return bool(np.einsum("fi,fi->", centres - middle, mesh.face_vectors[skin]) < 0)


# ---- points -------------------------------------------------------------------------------------
def stray_points(face: Face) -> list[str]:
    """Names of the points of the skin that lie on another component than the most; at least one point must be there."""
    components = _point_components(face)
    most = np.argmax(np.bincount(components))
    names = [face.points.names[row] for row in np.flatnonzero(components != most)]
    return [name for name in names if name not in OWN_PARTS]


def _stray_points(side: str, face: Face) -> list[str]:
    """Points on another component than the most, and points in one place."""
    if not len(face.points):
        return []
    found: list[str] = []
    stray = stray_points(face)
    if stray:
        found.append(
            f"{side}: points {_listed(stray)} lie on another part of the mesh than the others, such as lashes; move "
            "them onto the skin"
        )
    same = _same_places(face.points, len(face.mesh.vertices))
    if same:
        pairs = [f"{a} and {b}" for a, b in same]
        found.append(f"{side}: points {_listed(pairs)} lie in the same place; move or remove one of each")
    return found


def _same_places(points: FeaturePoints, vertex_count: int) -> list[tuple[str, str]]:
    matrix = points.matrix(vertex_count)
    matrix.data = np.round(matrix.data, 6)
    matrix.eliminate_zeros()
    matrix.sort_indices()
    first: dict[bytes, str] = {}
    same: list[tuple[str, str]] = []
    for row, name in enumerate(points.names):
        entry = matrix[row]
        key = entry.indices.tobytes() + entry.data.tobytes()
        if key in first:
            same.append((first[key], name))
        first.setdefault(key, name)
    return same


def _missing_points(problem: Problem, least: int) -> list[str]:
    if problem.base is not None:
        names = list(dict.fromkeys(name for triangle in problem.base for name in triangle))
        missing = {
            side: [name for name in names if name not in set(face.points.names)] for side, face in _sides(problem)
        }
        return [f"the base mesh uses points that the {side} lacks: {_listed(m)}" for side, m in missing.items() if m]
    common = len(common_names(problem.source.points, problem.target.points))
    if common >= least:
        return []
    base = " or a base mesh of your own" if least == LEAST_POINTS else ""
    return [
        f"source and target have {common} feature points in common (of {len(problem.source.points)} and "
        f"{len(problem.target.points)}), expected at least {least}{base}"
    ]


# ---- examples -----------------------------------------------------------------------------------
def _gain_faults(problem: Problem) -> list[str]:
    try:
        GainedFace(problem.target, problem.gains)
    except RetargetError as error:
        return [f"target: {error}"]
    return []


def _example_faults(problem: Problem) -> list[str]:
    found: list[str] = []
    for (side, face), (other, mate) in zip(_sides(problem), reversed(_sides(problem)), strict=True):
        found += [f"example {name!r} is missing on the {other}" for name in face.examples if name not in mate.examples]
        for name, positions in face.examples.items():
            found += _shape_faults(f"example {name!r} of the {side}", face, positions)
    if found:
        return found
    source = problem.source
    found += [f"examples {a!r} and {b!r} are identical on the source, remove one" for a, b in _same_examples(source)]
    found += [
        f"example {name!r} does not move the source: it is the neutral face"
        for name, positions in source.examples.items()
        if name != NEUTRAL and not _moves(source, positions[None])
    ]
    return found


def _shape_faults(what: str, face: Face, positions: FloatArray) -> list[str]:
    if np.shape(positions) != face.mesh.vertices.shape:
        return [f"{what} has shape {np.shape(positions)}, expected {face.mesh.vertices.shape} as its neutral"]
    bad = np.flatnonzero(~np.isfinite(positions).all(axis=1))
    if len(bad):
        return [f"{what} has {len(bad)} vertices that are NaN or infinite, the first is vertex {bad[0]}"]
    return []


def _same_examples(face: Face) -> list[tuple[str, str]]:
    return same_shapes(face.examples, STILL * face.mesh.size)


# ---- levels and frames --------------------------------------------------------------------------
def _level_faults(problem: Problem, settings: LevelSettings) -> list[str]:
    """A triangulation of n points has about n * 4**level vertices after that many subdivisions."""
    if problem.base is not None:
        points = len({name for triangle in problem.base for name in triangle})
    else:
        points = max(settings.base_points, len(common_names(problem.source.points, problem.target.points)))
    vertices = points * 4**settings.levels
    if vertices <= MOST_VERTICES:
        return []
    return [
        f"level {settings.levels} over a base of {points} points means about {vertices:,} vertices, "
        f"expected at most {MOST_VERTICES:,}; use fewer levels"
    ]


def _frame_faults(source: Face, frames: FloatArray) -> list[str]:
    expected = source.mesh.vertices.shape
    if frames.ndim != 3 or frames.shape[1:] != expected:
        return [f"source frames have shape {frames.shape}, expected (frames, {expected[0]}, 3) as the neutral"]
    for start in range(0, len(frames), _BLOCK):
        bad = np.argwhere(~np.isfinite(frames[start : start + _BLOCK]).all(axis=2))
        if len(bad):
            frame, vertex = bad[0].tolist()
            which = f"source frame {start + frame + 1} of {len(frames)}"
            return [f"{which} has a NaN or infinite vertex, the first is vertex {vertex}"]
    return []


def _moves(face: Face, frames: FloatArray) -> bool:
    """Whether any vertex leaves its neutral place in frames (F, V, 3)."""
    blocks = (frames[start : start + _BLOCK] for start in range(0, len(frames), _BLOCK))
    return any(np.abs(block - face.mesh.vertices).max(initial=0.0) > STILL * face.mesh.size for block in blocks)


def _moves_rigidly(source: Face, frames: FloatArray) -> bool:
    """Whether the skin moves, and every frame of it is the neutral, turned and shifted."""
    skin = np.unique(source.mesh.faces[_skin(source)])
    neutral = source.mesh.vertices[skin]
    moves = False
    for frame in frames:
        positions = np.asarray(frame[skin], np.float64)
        if np.abs(positions - neutral).max() < RIGID * source.mesh.size:
            continue
        moves = True
        left = positions - fit_rigid(neutral, positions).apply(neutral)
        if np.abs(left).max() > RIGID * source.mesh.size:
            return False
    return moves
