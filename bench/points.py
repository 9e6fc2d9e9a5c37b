"""What an artist waits for while placing feature points on 30 000 vertices in Blender."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from statistics import median
from time import perf_counter

import bpy

from facial_retarget_addon import demo, properties
from facial_retarget_addon.bridge.meshes import new_object
from facial_retarget_addon.bridge.points import point_places, point_prediction, points
from facial_retarget_addon.core.point_sets import POINT_SETS
from facial_retarget_addon.core.points import FeaturePoints

from .timing import Row

VERTICES, ACCEPTED, ROUNDS = 30_000, 100, 7


def rows() -> Iterator[Row]:
    """Seconds, the median of some rounds."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    properties.register()
    built = demo.actor(VERTICES)
    thing = new_object("face", built.face.mesh.vertices, built.counts, built.corners)
    thing.facial_retarget.point_set = "DENSE"
    all_points = built.face.points
    names = [info.name for info in POINT_SETS["DENSE"]]
    placed = all_points.subset(names[: len(names) - ACCEPTED])

    def stage() -> None:
        points.write_points(thing, placed)
        point_prediction.update_predictions(thing)

    def click() -> None:
        place(thing, all_points.subset([names[0]]))

    what = f"{len(thing.data.vertices)} vertices"
    start = perf_counter()
    stage()
    yield Row(f"the first prediction on {what}", perf_counter() - start, "s")
    yield Row(f"one point placed and {ACCEPTED} predicted anew", timed(click, stage), "s")
    assert len(thing.facial_retarget.proposals) == ACCEPTED
    yield Row(
        f"{ACCEPTED} predictions accepted on {what}",
        timed(lambda: point_prediction.accept_proposals(thing), stage),
        "s",
        0.1,
    )
    depsgraph = bpy.context.evaluated_depsgraph_get()
    shown = timed(lambda: point_places.world_places(thing, depsgraph))
    yield Row(f"places of {len(names)} points in the world, for a redraw", shown, "s", 0.01)
    cut(thing)
    yield Row(
        "the points put back after a vertex was deleted", timed(lambda: points.refresh_points(thing), rounds=1), "s"
    )
    properties.unregister()


def place(thing: bpy.types.Object, one: FeaturePoints) -> None:
    """What a click does."""
    points.place_points(thing, one)
    point_prediction.update_predictions(thing)


def cut(thing: bpy.types.Object) -> None:
    """Delete a vertex, so that the others are numbered anew."""
    import bmesh  # Exists once bpy is imported.

    work = bmesh.new()
    work.from_mesh(thing.data)
    work.verts.ensure_lookup_table()
    bmesh.ops.delete(work, geom=[work.verts[0]])
    work.to_mesh(thing.data)
    work.free()


def timed(work: Callable[[], object], stage: Callable[[], None] = lambda: None, rounds: int = ROUNDS) -> float:
    """Seconds that some work takes after the stage was set: the median."""
    seconds = []
    for _ in range(rounds):
        stage()
        start = perf_counter()
        work()
        seconds.append(perf_counter() - start)
    return median(seconds)
