"""Wrinkles: the high-frequency error of the built-in actor on a warped, remeshed target with known truth."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from facial_retarget_addon import demo
from facial_retarget_addon.core.arrays import FloatArray
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.methods import hierarchical
from facial_retarget_addon.core.methods.settings import HierarchicalSettings
from facial_retarget_addon.core.problem import Face, Problem

from .timing import Row

WAVELENGTH = 0.25
"""Eye separations: what is shorter than this counts as wrinkles."""
LEVELS = (1, 2, 3, 4)


def rows() -> Iterator[Row]:
    """Error of the wrinkles over their energy, with all detail and by level without the detail beyond it."""
    actor, target = demo.actor(), demo.warped_actor(np.random.default_rng(3))
    table = demo.performance_table()[::6]
    moving, truth = actor.frames(table), target.frames(table)
    skin = len(target.places)
    mesh = target.face.mesh
    faces = mesh.faces[(mesh.faces < skin).all(axis=1)]
    low_pass = heat_filter(TriMesh(mesh.vertices[:skin], faces), WAVELENGTH)
    areas = mesh.vertex_areas[:skin]
    wanted = high_pass(truth[:, :skin] - mesh.vertices[:skin], low_pass)
    task = Problem(Face(actor.face.mesh, actor.face.points), Face(mesh, target.face.points))

    def error(settings: HierarchicalSettings) -> float:
        frames = hierarchical.fit(task, settings).frames(moving)
        got = high_pass(frames[:, :skin] - mesh.vertices[:skin], low_pass)
        return float(np.sqrt(_energy(got - wanted, areas) / _energy(wanted, areas)))

    yield Row("high-frequency error, no examples", error(HierarchicalSettings()), "", 0.4)
    for level in LEVELS:
        settings = HierarchicalSettings(levels=level, detail_scale=0.0)
        yield Row(f"the same, cut off after level {level}", error(settings), "")


def _energy(motion: FloatArray, areas: FloatArray) -> float:
    return float(np.einsum("fvc,fvc,v->", motion, motion, areas))


def heat_filter(mesh: TriMesh, wavelength: float) -> Callable[[FloatArray], FloatArray]:
    """Low-pass of vertex values (V, K): two implicit heat steps, half power about the wavelength."""
    count = len(mesh.vertices)
    rows, columns, values = [], [], []
    for k in range(3):
        i, j, o = (mesh.faces[:, (k + s) % 3] for s in (1, 2, 0))
        u, v = mesh.vertices[i] - mesh.vertices[o], mesh.vertices[j] - mesh.vertices[o]
        cotangent = 0.5 * np.einsum("ij,ij->i", u, v) / np.maximum(np.linalg.norm(np.cross(u, v), axis=1), 1e-20)
        rows += [i, j]
        columns += [j, i]
        values += [np.clip(cotangent, 1e-3, 50)] * 2
    weights = sp.csr_matrix(
        (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(count, count)
    )
    laplacian = sp.diags(np.asarray(weights.sum(axis=1)).ravel()) - weights
    mass = mesh.vertex_areas
    solver = splu((sp.diags(mass) + (wavelength / (2 * np.pi)) ** 2 * laplacian).tocsc())

    def smooth(values: FloatArray) -> FloatArray:
        for _ in range(2):
            values = solver.solve(mass[:, None] * values)
        return values

    return smooth


def high_pass(motion: FloatArray, low_pass: Callable[[FloatArray], FloatArray]) -> FloatArray:
    """Motion (F, V, 3) without its low frequencies."""
    count, size, _ = motion.shape
    flat = np.asarray(motion, np.float64).transpose(1, 0, 2).reshape(size, -1)
    return (flat - low_pass(flat)).reshape(size, count, 3).transpose(1, 0, 2)
