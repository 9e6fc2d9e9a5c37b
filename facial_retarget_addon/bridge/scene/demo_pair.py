"""A built-in performance and a built-in face to give it to: everything can be tried without a file."""

from __future__ import annotations

import numpy as np
from bpy.types import Context, Object

from ...core.arrays import FloatArray, Progress
from ...demo import DemoFace, actor, child, performance, targets
from ...files.mesh_file import MeshFile
from ..background import Steps, in_thread
from ..bakes.frames import write_frames
from ..cloning.donors import STANDING
from ..meshes import new_face, read_positions
from ..points.points import write_points

ACTOR_VERTICES = 8_000
RATE = 24
"""Frames a second of the built-in performance."""
TALL, APART = 2.0, 2.0
"""Height of both faces, and from middle to middle, in metres."""


def add_pair_steps(context: Context, target: str, with_points: bool) -> Steps[tuple[Object, Object]]:
    """Put the acting actor and a face at rest side by side into the scene, as source and target.

    The scene's range and rate become the performance's.

    Parameters
    ----------
    target : name of the face that gets the performance, child, ape or skull.
    with_points : whether both have their feature points already.
    """

    def make(progress: Progress) -> tuple[DemoFace, FloatArray, DemoFace]:
        progress(0.0, "making the actor")
        acting = actor(ACTOR_VERTICES)
        progress(0.3, "making the target")
        still = child() if target == "child" else next(face for face in targets() if face.name == target)
        progress(0.6, "acting")
        return acting, performance(acting), still

    acting, frames, still = yield from in_thread(make)
    yield 0.9, "Writing"
    source, given = (_stand(face, place, with_points) for place, face in enumerate((acting, still)))
    write_frames(source, frames, 1)
    scene = context.scene
    scene.render.fps, scene.render.fps_base = RATE, 1.0
    scene.frame_start, scene.frame_end = 1, len(frames)
    scene.frame_set(1)
    scene.facial_retarget.source, scene.facial_retarget.target = source, given
    for thing in context.view_layer.objects:
        thing.select_set(thing == source)
    context.view_layer.objects.active = source
    return source, given


def _stand(face: DemoFace, place: int, with_points: bool) -> Object:
    """A built-in face with its colours, on its feet and as tall as the other one."""
    made = new_face(face.name.title(), MeshFile(face.face.mesh, face.counts, face.corners, face.uvs[face.corners]))
    colours = made.data.color_attributes.new("Skin", "FLOAT_COLOR", "POINT")
    rgba = np.ones((len(face.colours), 4), np.float32)
    rgba[:, :3] = face.colours
    colours.data.foreach_set("color", rgba.ravel())
    low, high = (edge(read_positions(made.data), axis=0) for edge in (np.min, np.max))
    size = TALL / (high[1] - low[1])
    middle = 0.5 * size * (low + high)
    made.rotation_euler.x = STANDING
    made.scale = (size,) * 3
    made.location = (place * APART - middle[0], middle[2], 0.5 * TALL - middle[1])
    if with_points:
        write_points(made, face.face.points)
    return made
