"""A face that FAPs move: any mesh with MPEG-4 feature points."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np
import scipy.sparse as sp

from ..arrays import BoolArray, FloatArray, Progress, no_progress
from ..closest_point import SurfaceFinder
from ..errors import RetargetError
from ..mesh import TriMesh
from ..mpeg4.channels import PointChannels
from ..mpeg4.faps import FAPS, HEAD_TURNS
from ..mpeg4.fapu import Fapu, measure_fapu
from ..mpeg4.fdps import FDPS
from ..mpeg4.head import head_axes
from ..mpeg4.head_turn import rotation_of_angles
from ..mpeg4.mean_face import place_missing
from ..parts.acting_parts import with_parts
from ..parts.kinds import NO_NAMES, NamedParts, named_faults
from ..points import FeaturePoints
from .eyeballs import Eyeball
from .point_deformer import PointDeformer, fit_deformer

EYE_COLUMNS = {"left": (24, 22, 26, 28), "right": (25, 23, 27, 29)}
"""Columns of the FAPs of an eyeball: pitch, yaw, thrust, dilation."""
FACING = 0.3
"""The nose's root looks forwards by more than this cosine."""
ON_EDGE = 1e-6
"""Weights of the nose root's place below this are none."""
VARIANTS = ("default", "paper")
PUPIL = 1 / 6
"""Radius of a neutral pupil, as a share of the iris' diameter."""


class FapFace:
    """A fitted face. Its motion is linear in its channels, which are functions of the FAPs.

    The channels are the displacement of each point along the head's axes, how far each lid is half shut, and for each
    eyeball the nine entries of its rotation, its thrust and its pupil.

    Attributes
    ----------
    mesh, points : what was fitted.
    known : those of the points that have MPEG-4 names.
    axes : (3, 3) rows left, up, forward of the head.
    fapu : the face's units.
    deformer : the surface's weights.
    playable : (68,) FAPs that this face can show; the head's turns are always among them.
    measurable : (68,) FAPs that `measure` finds.
    channels : names of the channels, C of them.
    """

    def __init__(self, mesh: TriMesh, points: FeaturePoints, variant: str, named: NamedParts = NO_NAMES) -> None:
        """Fit; see `fit_fap_face`."""
        self.mesh, self.points, self._variant = mesh, points, variant
        known = points.subset([name for name in points.names if name in FDPS])
        places = known.positions(mesh.vertices)
        self.axes = head_axes(known.names, places)
        self.fapu: Fapu = measure_fapu(known.names, places, self.axes)
        self._motion = PointChannels(known.names, places, self.axes, self.fapu)
        holds = np.array([FDPS[name].anchored for name in known.names], bool)
        acting = self._motion.acting | holds[:, None]
        root = _nose_root(mesh, known, self.axes)
        held = np.concatenate([acting, np.ones((len(root), 3), bool)])
        self.deformer: PointDeformer = fit_deformer(mesh, known.joined(root), self.axes, held, variant, named=named)
        self.known = known
        self._moving = np.flatnonzero(self._motion.acting.ravel())
        self._eyes = [eye for eye in self.deformer.eyeballs.values() if len(eye.vertices)]
        self._parts: list[dict[str, Any]] = []
        if variant == "default":
            turning = np.zeros(len(mesh.vertices), bool)
            turning[[vertex for eye in self._eyes for vertex in eye.vertices]] = True
            self.deformer, self._parts = with_parts(mesh, known, self.deformer, turning, named)
        self.playable = self._playable()
        self.measurable: BoolArray = self._motion.measurable
        self.channels = self._names()
        self._neutral = mesh.vertices.astype(np.float32)
        self._basis = sp.hstack(
            [self.deformer.matrix[:, self._moving], self.deformer.arcs, *map(self._eye_basis, self._eyes)], format="csr"
        ).astype(np.float32)

    def frames(self, values: FloatArray, turn_head: bool = False) -> FloatArray:
        """Positions (F, V, 3) float32 of FAPs (F, 68).

        turn_head : whether FAPs 48 to 50 turn everything about the top of the spine.
        """
        values = self._checked(values)
        moved: FloatArray = self._basis @ self.channel_values(values).T.astype(np.float32)
        shape = len(values), *self._neutral.shape
        frames: FloatArray = np.ascontiguousarray(moved.T).reshape(shape) @ self.axes.astype(np.float32)
        frames += self._neutral
        if turn_head:
            # What the turn adds, so that a head which does not turn stays where it is to the last digit.
            change = self.axes.T @ (rotation_of_angles(values[:, HEAD_TURNS], np.eye(3)) - np.eye(3)) @ self.axes
            frames += (frames - self.head_pivot.astype(np.float32)) @ change.astype(np.float32).transpose(0, 2, 1)
        return frames

    def measure(self, frames: FloatArray) -> FloatArray:
        """FAPs (F, 68) of frames (F, V, 3) of this mesh, off its points; 0 for those that points do not show.

        Raises
        ------
        RetargetError : for frames of another number of vertices.
        """
        frames = np.asarray(frames)
        if frames.ndim != 3 or frames.shape[1:] != self._neutral.shape:
            raise RetargetError(f"frames have shape {frames.shape}, expected (F, {len(self._neutral)}, 3)")
        return self.measure_points(self.known.positions(frames))

    def measure_points(self, places: FloatArray) -> FloatArray:
        """FAPs (F, 68) of places (F, K, 3) of the known points; the rest as `measure`."""
        return self._motion.values(places - self.known.positions(self.mesh.vertices))

    def channel_values(self, values: FloatArray) -> FloatArray:
        """Values (F, C) of the channels for FAPs (F, 68); lengths in the object's units."""
        values = self._checked(values)
        points = self._motion.displacements(values)
        inside = (points @ self.axes.T).reshape(len(values), 3 * len(self.known))[:, self._moving]
        eyes = [self._eye_values(eye, values) for eye in self._eyes]
        return np.concatenate([inside, self.deformer.half_shut(points), *eyes], axis=1)

    def channel_shapes(self) -> FloatArray:
        """Positions (C, V, 3) float32 at value 1 of each channel."""
        moved = self._basis.T.toarray().reshape(len(self.channels), -1, 3) @ self.axes.astype(np.float32)
        shapes: FloatArray = moved + self._neutral
        return shapes

    @cached_property
    def head_pivot(self) -> FloatArray:
        """(3,) what the head turns about: FDP 7.1, or where it lies on the average face."""
        return place_missing(self.known.names, self.known.positions(self.mesh.vertices), ["7.1"])["7.1"]

    @cached_property
    def report(self) -> Mapping[str, Any]:
        """Figures of the fit, as plain data."""
        still = [fap.name for fap in FAPS[2:] if not self.playable[fap.number - 1]]
        return {
            "variant": self._variant,
            "points": len(self.known),
            "fapu": {unit: self.fapu.length(unit) for unit in ("IRISD", "ES", "ENS", "MNS", "MW")},
            "fapu_taken": self.fapu.taken,
            "eyeballs": [eye.side for eye in self._eyes],
            "parts": self._parts,
            "faps_without_points": still,
            "weights_per_vertex": self._basis.nnz / max(len(self.mesh.vertices), 1),
            "warnings": list(self.deformer.warnings),
        }

    def _playable(self) -> BoolArray:
        playable: BoolArray = self._motion.measurable.copy()
        playable[HEAD_TURNS] = True
        playable[46] = {"6.2", "6.3", "6.4"} <= set(self.known.names)
        for eye in self._eyes:
            playable[list(EYE_COLUMNS[eye.side])] = True
        return playable

    def _names(self) -> tuple[str, ...]:
        names = [f"{name} {axis}" for name in self.known.names for axis in "xyz"]
        eyes = [f"eye {eye.side} {what}" for eye in self._eyes for what in _EYE_CHANNELS]
        return (*(names[k] for k in self._moving), *(f"{lid.middle} arc" for lid in self.deformer.lids), *eyes)

    def _eye_basis(self, eye: Eyeball) -> sp.csr_matrix:
        """(3V, 11) what an eyeball's channels do, in the head's axes."""
        away = (self.mesh.vertices[eye.vertices] - eye.centre) @ self.axes.T
        rows = 3 * eye.vertices
        basis = sp.lil_matrix((3 * len(self.mesh.vertices), len(_EYE_CHANNELS)), dtype=np.float32)
        for i in range(3):
            for j in range(3):
                basis[rows + i, 3 * i + j] = away[:, j : j + 1]
        basis[rows + 2, 9] = 1.0
        # The pupil's rim moves by half of what its diameter grows, the iris' rim stays.
        iris = 0.5 * self.fapu.irisd
        beside = np.hypot(away[:, 0], away[:, 1])
        rim = 2 * PUPIL * iris
        profile = np.minimum(beside / rim, np.clip((iris - beside) / (iris - rim), 0, None)) * (away[:, 2] > 0)
        outwards = np.divide(away[:, :2], beside[:, None], out=np.zeros_like(away[:, :2]), where=beside[:, None] > 0)
        for axis in (0, 1):
            basis[rows + axis, 10] = (0.5 * profile * outwards[:, axis])[:, None]
        return basis.tocsr()

    def _eye_values(self, eye: Eyeball, values: FloatArray) -> FloatArray:
        """(F, 11) an eyeball's channels: its rotation less the identity, its thrust, its pupil's growth."""
        pitch, yaw, thrust, dilation = (values[:, column] for column in EYE_COLUMNS[eye.side])
        turns = rotation_of_angles(np.stack([pitch, yaw, np.zeros_like(yaw)], axis=1), np.eye(3)) - np.eye(3)
        grown = np.stack([thrust * self.fapu.unit("ES"), dilation * self.fapu.unit("IRISD")], axis=1)
        return np.concatenate([turns.reshape(len(values), 9), grown], axis=1)

    def _checked(self, values: FloatArray) -> FloatArray:
        values = np.asarray(values, np.float64)
        if values.ndim != 2 or values.shape[1] != len(FAPS):
            raise RetargetError(f"FAPs have shape {values.shape}, expected (F, {len(FAPS)})")
        return values


_EYE_CHANNELS = (*(f"turn {row}{column}" for row in "xyz" for column in "xyz"), "thrust", "pupil")


def _nose_root(mesh: TriMesh, points: FeaturePoints, axes: FloatArray) -> FeaturePoints:
    """The place between the inner corners of the eyes, which holds the nose's root where no point on it does."""
    nothing = points.subset([])
    if {"9.6", "9.7"} & set(points.names) or not {"3.8", "3.11", "9.12"} <= set(points.names):
        return nothing
    right, left, bump = points.subset(["3.8", "3.11", "9.12"]).positions(mesh.vertices)
    middle = 0.5 * (right + left)
    middle = middle + max((bump - middle) @ axes[2], 0.0) * axes[2]
    found = SurfaceFinder(mesh).closest(middle[None], axes[2:], FACING)
    if found.face[0] < 0:
        return nothing
    # A place on an edge belongs to the edge's ends alone, whichever of its faces was found.
    weights = np.where(found.weights > ON_EDGE, found.weights, 0.0)
    return FeaturePoints(("nose root",), mesh.faces[found.face], weights / weights.sum(axis=1, keepdims=True))


def fit_fap_face(
    mesh: TriMesh,
    points: FeaturePoints,
    variant: str = "default",
    progress: Progress = no_progress,
    named: NamedParts = NO_NAMES,
) -> FapFace:
    """Make a face playable by FAPs.

    Parameters
    ----------
    mesh : the neutral: eyes open, mouth closed.
    points : places on it; those with MPEG-4 names count.
    variant : default, or paper for the published weights alone.
    named : parts that the artist named.

    Raises
    ------
    RetargetError : for a mesh or points that cannot be used: no MPEG-4 names, no left and right, a unit of no length,
        places that are not on the mesh; for named parts that are none, and for a variant that does not exist.

    References
    ----------
    Kshirsagar et al. 2003, section 3.
    """
    if variant not in VARIANTS:
        raise RetargetError(f"there is no variant {variant!r}, expected {' or '.join(VARIANTS)}")
    mesh = mesh.checked("the face")
    if ((points.vertices < 0) | (points.vertices >= len(mesh.vertices))).any():
        raise RetargetError(f"feature points lie on vertices that the face's {len(mesh.vertices)} do not include")
    if not any(name in FDPS for name in points.names):
        raise RetargetError(
            f"none of the {len(points)} feature points has an MPEG-4 name, expected names such as 2.1, 8.3 and 8.4"
        )
    if wrong := named_faults(mesh, points, named):
        raise RetargetError("; ".join(wrong))
    progress(0.1, "finding what each point moves")
    face = FapFace(mesh, points, variant, named)
    progress(1.0, "fitted")
    return face
