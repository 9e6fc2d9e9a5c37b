"""How the jaw of a head moves, and what goes with it.

A jaw turns about its hinge, up and down and sideways, and slides sideways and forward; its drop is the turn's.
Everything is in the axes of the head.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..arrays import FloatArray, IntArray
from ..mpeg4.mean_face import place_missing
from ..rigid import closest_rotations
from .known_head import KnownHead

CHIN_REACH = 0.2
"""Around the bottom of the chin, in eye separations: skin that shows how the jaw moves."""
CHIN_END = 3.0
"""Skin is not looked at beyond this many times `CHIN_REACH`."""
STEADY = 1e-4
"""Of the least squares: how little a jaw that the chin hardly shows to move does, as a square of eye separations."""
FLAT = 1e-3
"""A part shows how it turns if it is wider than this share of its length."""


class RigidMotion(NamedTuple):
    """Turns (F, 3, 3) about the hinge, then shifts (F, 3), in the head's axes and the object's units."""

    turns: FloatArray
    shifts: FloatArray

    def displacements(self, away: FloatArray) -> FloatArray:
        """(F, n, 3) of what lies away (n, 3), or in each frame (F, n, 3), from the hinge."""
        moved: FloatArray = away @ (self.turns - np.eye(3)).transpose(0, 2, 1) + self.shifts[:, None]
        return moved

    def undone(self, away: FloatArray, displacements: FloatArray) -> FloatArray:
        """Displacements (F, n, 3) of what lies away (n, 3) from the hinge, as the moving part sees them."""
        left: FloatArray = (away + displacements - self.shifts[:, None]) @ self.turns - away
        return left

    def towards(self, other: RigidMotion, share: FloatArray) -> RigidMotion:
        """Between this and another motion: this one where the share (F,) is 0, the other where it is 1."""
        part = share[:, None]
        turns = closest_rotations(self.turns + part[:, None] * (other.turns - self.turns))[0]
        return RigidMotion(turns, self.shifts + part * (other.shifts - self.shifts))


class BoneReader:
    """Reads the motion of what is as stiff as bone, such as teeth.

    Parameters
    ----------
    vertices : (n,) not on one line. places : (V, 3) and hinge (3,) in the head's axes.
    """

    def __init__(self, vertices: IntArray, places: FloatArray, hinge: FloatArray) -> None:
        self.vertices = vertices
        self._away = places[vertices] - hinge

    @property
    def middle(self) -> FloatArray:
        """(1, 3) how far the middle of the part lies from the hinge."""
        middle: FloatArray = self._away.mean(axis=0, keepdims=True)
        return middle

    def motion(self, moved: FloatArray) -> RigidMotion:
        """The rigid motion nearest to displacements (F, n, 3) of the vertices, in the head's axes."""
        middle, shift = self.middle[0], moved.mean(axis=1)
        now = self._away - middle + moved - shift[:, None]
        turns = closest_rotations(np.einsum("fni,nj->fij", now, self._away - middle))[0]
        # What rests must not turn by rounding.
        turns[~moved.any(axis=(1, 2))] = np.eye(3)
        return RigidMotion(turns, shift - (turns - np.eye(3)) @ middle)


class ChinReader:
    """Reads the motion of the jaw off the skin below the chin, in least squares.

    Parameters
    ----------
    head : with the bottom of the chin (FDP 2.1). hinge : (3,) in its axes.
    """

    def __init__(self, head: KnownHead, hinge: FloatArray) -> None:
        chin = head.points.subset(["2.1"]).positions(head.places)[0]
        far = np.linalg.norm(head.places[head.skin] - chin, axis=1) / (CHIN_REACH * head.unit)
        near = far < max(CHIN_END, 2 * far.min())
        self.vertices = head.skin[near]
        # Muscles move the front of the chin; what looks down goes with the bone.
        down = 0.5 * (1 - head.mesh.vertex_normals[self.vertices] @ head.axes[1])
        weight = head.mesh.vertex_areas[self.vertices] * np.exp(-0.5 * far[near] ** 2) * down**4
        weight /= weight.sum()
        shows = _turning(head.places[self.vertices] - hinge)
        square = np.einsum("n,nij,nik->jk", weight, shows, shows) + STEADY * head.unit**2 * np.eye(4)
        right = np.einsum("n,nij->jni", weight, shows).reshape(4, -1)
        self._measure = np.linalg.solve(square, right)

    def motion(self, moved: FloatArray) -> RigidMotion:
        """The turns and shifts nearest to displacements (F, n, 3) of the vertices, in the head's axes."""
        aside, forward, pitch, yaw = self._measure @ moved.reshape(len(moved), -1).T
        nothing = np.zeros_like(aside)
        turns = _rotations(np.stack([pitch, yaw, nothing], axis=1))
        return RigidMotion(turns, np.stack([aside, nothing, forward], axis=1))


JawReader = BoneReader | ChinReader


def shows_turns(places: FloatArray) -> bool:
    """Whether places (n, 3) do not lie on one line."""
    if len(places) < 3:
        return False
    spread = np.linalg.svd(places - places.mean(axis=0), compute_uv=False)
    return bool(spread[1] > FLAT * spread[0])


def _turning(away: FloatArray) -> FloatArray:
    """(n, 3, 4) what a shift aside, one forward, a little pitch and a little yaw do at places (n, 3) from the hinge."""
    columns = np.zeros((len(away), 3, 4))
    columns[:, 0, 0] = columns[:, 2, 1] = 1.0
    columns[:, 1, 2], columns[:, 2, 2] = -away[:, 2], away[:, 1]
    columns[:, 0, 3], columns[:, 2, 3] = away[:, 2], -away[:, 0]
    return columns


def _rotations(vectors: FloatArray) -> FloatArray:
    """(F, 3, 3) turns about vectors (F, 3) by their lengths, in radians."""
    x, y, z = vectors.T
    o = np.zeros_like(x)
    crossed = np.stack([o, -z, y, z, o, -x, -y, x, o], axis=1).reshape(-1, 3, 3)
    angle = np.linalg.norm(vectors, axis=1)[:, None, None]
    turns: FloatArray = (
        np.eye(3) + np.sinc(angle / np.pi) * crossed + 0.5 * np.sinc(angle / (2 * np.pi)) ** 2 * (crossed @ crossed)
    )
    return turns


def hinge_of(head: KnownHead) -> FloatArray:
    """(3,) what the jaw turns about, in the head's axes: the top of the spine (FDP 7.1) lies a little behind it."""
    return place_missing(head.points.names, head.points.positions(head.places), ["7.1"])["7.1"]
