"""Normal maps of the finest level on level 2: ours against Cycles' bake, frame after frame."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple, cast

import bpy
import numpy as np

from facial_retarget_addon import demo
from facial_retarget_addon.bridge.meshes import new_object
from facial_retarget_addon.core.arrays import FloatArray, IntArray
from facial_retarget_addon.core.level_retargeter import LevelRetargeter
from facial_retarget_addon.core.methods.base import fit
from facial_retarget_addon.core.methods.settings import HierarchicalSettings, MapSettings
from facial_retarget_addon.core.normal_maps.frame_maps import FrameMaps
from facial_retarget_addon.core.problem import Problem

from .timing import Row, medians

SIZES = {512: 10.0, 1024: 8.0, 2048: 5.0}
"""Pixels along a side -> how many times faster than Cycles we must be."""
LEVEL, ROUNDS = 2, 3


class Subject(NamedTuple):
    """A fitted pair, the finest mesh of some frames (F, N, 3), and the problem."""

    retargeter: LevelRetargeter
    problem: Problem
    fine: FloatArray


def rows() -> Iterator[Row]:
    """Ratios at three sizes, and the angle between the two at each frame."""
    subject = actor_onto_ape()
    for size, bound in SIZES.items():
        maps = FrameMaps(subject.retargeter, subject.problem, None, MapSettings(level=LEVEL, pixels=size, margin=0))
        cycles = Cycles(maps, subject, size)
        held = maps.maps[0, 0]
        turn = iter(range(10**6))

        def ours(held=held, cycles=cycles, turn=turn) -> FloatArray:
            frame = subject.fine[next(turn) % len(subject.fine)]
            return held.vectors(frame[: cycles.count], frame)

        def theirs(cycles=cycles, turn=turn) -> None:
            cycles.bake(next(turn) % len(subject.fine))

        seconds = medians({"ours": ours, "cycles": theirs}, ROUNDS)
        yield Row(f"{size} x {size}, one frame", 1e3 * seconds["ours"], "ms")
        yield Row(f"{size} x {size}, Cycles' bake of it", 1e3 * seconds["cycles"], "ms")
        yield Row(f"{size} x {size}, faster by", seconds["cycles"] / seconds["ours"], "x", bound, at_least=True)
        if size == 1024:
            for number, frame in enumerate(subject.fine):
                off = cycles.angles(number, held.vectors(frame[: cycles.count], frame).reshape(-1, 3), held.pixel)
                yield Row(f"degrees from Cycles, frame {number}: median", float(np.median(off)), "", 1.0)
                yield Row(f"degrees from Cycles, frame {number}: 95 %", float(np.quantile(off, 0.95)), "", 4.0)


def actor_onto_ape() -> Subject:
    """The built-in actor onto the ape, five levels; the neutral and the two liveliest frames of the performance."""
    actor, ape = demo.actor(), demo.targets()[0]
    problem = Problem(actor.face, ape.face)
    fitted = cast(LevelRetargeter, fit("hierarchical", problem, HierarchicalSettings(levels=5)))
    performance = demo.performance(actor)
    order = np.argsort(-np.abs(performance - performance[0]).sum(axis=(1, 2)))
    fine, _ = fitted.detail(performance[[0, order[0], order[20]]])
    return Subject(fitted, problem, fine)


class Cycles:
    """A scene with the light and the fine mesh, where Cycles bakes from one onto the other."""

    def __init__(self, maps: FrameMaps, subject: Subject, size: int) -> None:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        scene = bpy.context.scene
        scene.render.engine, scene.cycles.samples, scene.cycles.device = "CYCLES", 1, "CPU"
        surface, faces = maps.surface, subject.retargeter.level_faces(5)
        self.count = len(surface.mesh.vertices)
        self._fine, self._reach = subject.fine, 0.05 * surface.mesh.size
        self._low = new_object("low", surface.mesh.vertices, surface.counts, surface.corners)
        self._high = new_object("high", subject.fine[0], np.full(len(faces), 3), faces.ravel())
        layer = self._low.data.uv_layers.new(name="UVMap")
        layer.uv.foreach_set("vector", np.ravel(surface.uvs).astype(np.float32))
        for thing in (self._low, self._high):
            thing.data.shade_smooth()
            thing.select_set(True)
        bpy.context.view_layer.objects.active = self._low
        material = bpy.data.materials.new("baked")
        material.use_nodes = True
        self._low.data.materials.append(material)
        node = material.node_tree.nodes.new("ShaderNodeTexImage")
        self._image = bpy.data.images.new("baked", size, size, alpha=True, float_buffer=True, is_data=True)
        self._image.generated_color = (0, 0, 0, 0)
        node.image = self._image
        material.node_tree.nodes.active = node

    def bake(self, number: int) -> None:
        """Bake a frame."""
        frame = self._fine[number]
        for thing, positions in ((self._low, frame[: self.count]), (self._high, frame)):
            # Written through the attribute, the mesh would keep its normals of before.
            thing.data.vertices.foreach_set("co", np.ascontiguousarray(positions).ravel())
            thing.data.update()
        bpy.ops.object.bake(
            type="NORMAL",
            use_selected_to_active=True,
            cage_extrusion=self._reach,
            max_ray_distance=2 * self._reach,
            margin=0,
        )

    def angles(self, number: int, vectors: FloatArray, covered: IntArray) -> FloatArray:
        """(P,) degrees between pixels (H * W, 3) and those that Cycles bakes, at covered ones where it does."""
        self.bake(number)
        flat = np.empty(4 * len(vectors), np.float32)
        self._image.pixels.foreach_get(flat)
        theirs = 2 * flat.reshape(-1, 4)[covered, :3] - 1
        lengths = np.linalg.norm(theirs, axis=1)
        baked = np.abs(lengths - 1) < 0.05
        agree = np.einsum("pi,pi->p", theirs[baked], vectors[covered][baked]) / lengths[baked]
        off: FloatArray = np.degrees(np.arccos(np.clip(agree, -1, 1)))
        return off
