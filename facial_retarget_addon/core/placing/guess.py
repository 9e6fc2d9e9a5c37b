"""Where the face of a head is, found from its surface alone: no points, any axes, any unit."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..points import FeaturePoints
from ..raycast import CasterFactory
from ..rigid import Similarity, fit_similarity
from .face_fit import AGREEMENT, CLEAR, FaceFit, fit_face
from .front import Stand, find_stands
from .openings import NEARBY, WIDE, believed_landmarks
from .skin import Skin
from .template import Template

STANDS = 5
"""Of the stands of the average face that are found, those that are looked at closely."""
MUCH_WORSE = 1.5
"""A stand that is this many times as unlike as the best one is not looked at."""
SAME_TURN, SAME_SIZE = np.cos(np.radians(9.0)), 1.1
"""Stands that differ by less are one: the cosine of a turn, and a ratio of sizes."""
ROUNDS = 4
"""Of laying the average face on the surface without bending it."""
LOOKS = (WIDE, WIDE, WIDE, NEARBY)
"""Where landmarks are looked for, time after time; bending to them shows more."""
NEAR = 0.25
"""Places of the surface count for that if they are nearer than this, in eye separations."""
FAR = 0.1
"""Distance from the surface, after bending, that counts as not alike."""
BENT = 1.0
"""How much the bending counts, beside distances and normals."""
SEEN = 0.03
"""How much each eye and each part of the line between the lips counts that is seen where it should be."""
GROUPS = 5
"""Landmarks that a face can have: two eyes, three places of the lips."""


class FoundFace(NamedTuple):
    """The average face on a head, the landmarks seen on it, and how unlike the two are: 0 for itself, some 0.1
    for human heads, 0.35 and more for what is no face.
    """

    fit: FaceFit
    landmarks: FeaturePoints
    unlike: float


def find_face(template: Template, skin: Skin, make_caster: CasterFactory) -> FoundFace:
    """The best fit of the average face to a surface.

    Planes of symmetry give where left and right may be; in each, the relief of the average face is compared with what
    is seen along all ways up and forward, at all sizes and heights; the most alike are fitted to the surface.
    """
    mesh = skin.surface
    caster = make_caster(mesh)
    stands = [stand for plane in skin.mirrors for stand in find_stands(template, mesh, caster, plane)]
    found = [_settled(template, stand.pose, skin) for stand in _different(stands)]
    return min(found, key=lambda face: face.unlike)


def _different(stands: list[Stand]) -> list[Stand]:
    """The best stands that are not nearly the same."""
    kept: list[Stand] = []
    stands = sorted(stands, key=lambda stand: stand.unlike)
    for stand in stands:
        if stand.unlike > MUCH_WORSE * stands[0].unlike:
            break
        if len(kept) < STANDS and not any(_same(stand.pose, other.pose) for other in kept):
            kept.append(stand)
    return kept


def _same(first: Similarity, second: Similarity) -> bool:
    turn = 0.5 * (float(np.trace(first.rotation.T @ second.rotation)) - 1)
    ratio = first.scale / second.scale
    apart = float(np.linalg.norm(first.translation - second.translation))
    return turn > SAME_TURN and 1 / SAME_SIZE < ratio < SAME_SIZE and apart < NEAR * first.scale


def _settled(template: Template, pose: Similarity, skin: Skin) -> FoundFace:
    """The average face laid on the surface from a stand nearby, then bent to it and to the landmarks seen."""
    for _ in range(ROUNDS):
        there = skin.samples.beside(pose.apply(template.places), template.normals @ pose.rotation.T, AGREEMENT)
        met = there.distance < NEAR * pose.scale
        if met.sum() < 0.5 * len(met):
            break
        pose = fit_similarity(template.places[met], there.place[met])
    landmarks, groups = FeaturePoints.none(), 0
    fit = _bent(template, pose, landmarks, skin)
    for search in LOOKS:
        seen = believed_landmarks(skin.view, fit, search)
        landmarks, groups = _all(seen), len(seen)
        pose = fit_similarity(template.places, _bent(template, pose, landmarks, skin).places)
        fit = _bent(template, pose, landmarks, skin)
    return FoundFace(fit, landmarks, unlikeness(fit, skin) + SEEN * (GROUPS - groups))


def _bent(template: Template, pose: Similarity, landmarks: FeaturePoints, skin: Skin) -> FaceFit:
    """The average face bent to the surface and to landmarks on it."""
    rows, places = template.rows(landmarks.names), landmarks.positions(skin.surface.vertices)
    return fit_face(template, pose, rows, places, np.full(len(rows), CLEAR), skin.samples)


def _all(groups: Sequence[FeaturePoints]) -> FeaturePoints:
    """The points of all groups."""
    whole = FeaturePoints.none()
    for group in groups:
        whole = whole.joined(group)
    return whole


def unlikeness(fit: FaceFit, skin: Skin) -> float:
    """How unlike the surface a fitted face is: by distances, by normals, and by how far it had to be bent."""
    there = skin.samples.beside(fit.places, fit.normals, AGREEMENT)
    away = np.minimum(there.distance / (FAR * fit.pose.scale), 1.0)
    turned = 0.5 * (1 - np.einsum("ni,ni->n", there.normal, fit.normals))
    return float(np.mean(0.5 * away + 0.5 * turned)) + BENT * fit.bending
