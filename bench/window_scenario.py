"""What `bench.window` measures, played in a real Blender's window by tests/gui/window.py: writes figures.json."""

import json
from functools import wraps
from statistics import median
from time import perf_counter, thread_time

import bpy
import drive
import numpy as np
from stage import add_face, choose, clear, part, remember

MOMENTS = (0.02, 0.15, 0.25, 0.35, 0.45, 0.6, 0.75, 0.85)
"""Shares of the work done at which Esc is pressed."""
SHOWN = {
    "points": ("show_points",),
    "points and all names": ("show_points", "show_names"),
    "base mesh": ("show_base",),
    "heat map": ("show_heat",),
    "everything": ("show_points", "show_names", "show_base", "show_heat"),
}
"""What is drawn over the view -> the overlay's switches that are on then."""
ROUNDS, STEPS = 3, 4
"""Rounds in which these take their turns, and frames that are stepped through; the quickest round counts."""
PLACED = ("3.7", "3.12", "9.3", "2.1", "8.4")
"""Points that are clicked onto a bare face, one after the other."""
MOVES = 20
"""Of the mouse while a point is dragged."""


def scenario():
    """Play it; the arguments are how many vertices the faces have about, and frames."""
    vertices, frames = map(int, drive.ARGUMENTS)
    clear()
    demo = part("demo")
    actor, other = demo.actor(vertices), demo.warped_actor(np.random.default_rng(3), vertices)
    source, target = add_face(actor, "Source", -1.3), add_face(other, "Target", 1.3)
    part("bridge.bakes.frames").write_frames(source, demo.performance(actor)[:frames].astype(np.float32), 1)
    task, scene = bpy.context.scene.facial_retarget, bpy.context.scene
    task.source, task.target, task.method = source, target, "hierarchical"
    scene.frame_start, scene.frame_end = 1, frames
    remember()
    yield from drive.look("FRONT", [source, target])
    yield from drive.open_tab()
    figures = {"vertices": [len(source.data.vertices), len(target.data.vertices)], "frames": frames}
    figures["esc"] = yield from seconds_to_freedom()
    figures |= yield from drawing()
    figures |= yield from clicking(actor)
    (drive.OUT / "figures.json").write_text(json.dumps(figures))


def seconds_to_freedom():
    """Seconds from Esc until Blender has time again and nothing is computed, at each of the moments."""
    work = bpy.data.window_managers[0].facial_retarget
    taken = []
    for share in MOMENTS:
        with drive.override():
            bpy.ops.facial_retarget.retarget("INVOKE_DEFAULT")
        yield from drive.wait_until(lambda share=share: work.share >= share or not work.running, "it computes", 120)
        assert work.running, f"it has come to its end before {share:.0%}"
        start = perf_counter()
        drive.window().event_simulate(type="ESC", value="PRESS", x=400, y=300)
        while work.running or drive.window().modal_operators:
            yield
        taken.append(perf_counter() - start)
        drive.window().event_simulate(type="ESC", value="RELEASE", x=400, y=300)
        yield from drive.wait(3)
    assert bpy.data.objects["Target"].data.shape_keys is None
    return taken


def times_of(owner, name):
    """Wrap a function of a module or class: the seconds of each call to come go into the list that is returned.

    They are those that Blender's thread is at work, so that other programs do not count.
    """
    taken, work = [], getattr(owner, name)

    @wraps(work)
    def timed(*arguments):
        start = thread_time()
        try:
            return work(*arguments)
        finally:
            taken.append(thread_time() - start)

    setattr(owner, name, timed)
    return taken


def drawing():
    """Milliseconds that the overlay adds to a redraw, by what it shows: if nothing has changed, and at a new frame."""
    scene, module = bpy.context.scene, part("viewport.overlay")
    module.unregister()
    passes = [times_of(module, name) for name in ("_draw_places", "_draw_pixels")]
    module.register()
    show("everything")
    lines, faces = part("viewport.base").lines_of, [bpy.data.objects[name] for name in ("Source", "Target")]
    yield from redraw(passes)
    yield from drive.wait_until(lambda: all(lines(face) for face in faces), "the base mesh is worked out", 60)
    still = {what: [] for what in SHOWN}
    moved = {what: [[] for _ in range(STEPS)] for what in SHOWN}
    for _ in range(ROUNDS):
        for what in SHOWN:
            show(what)
            scene.frame_set(1)
            yield from redraw(passes)  # builds what was not drawn for a while
            still[what].append((yield from redraw(passes)))
            for step in range(STEPS):
                scene.frame_set(10 + 5 * step)
                moved[what][step].append((yield from redraw(passes)))
    show("points")
    scene.frame_set(1)
    return {
        "still": {what: 1e3 * min(taken) for what, taken in still.items()},
        "moved": {what: 1e3 * median(map(min, taken)) for what, taken in moved.items()},
    }


def show(what):
    """Switch on what the overlay is to show, and all else off."""
    overlay = bpy.context.scene.facial_retarget.overlay
    for switch in SHOWN["everything"]:
        setattr(overlay, switch, switch in SHOWN[what])


def redraw(passes):
    """Draw the view once; gives the seconds of the overlay's two passes together."""
    for taken in passes:
        taken.clear()
    drive.area().tag_redraw()
    while not all(passes):
        yield
    return sum(taken[-1] for taken in passes)


def clicking(actor):
    """Milliseconds of a press that places a point, of moves that drag it, and of a release."""
    source = bpy.data.objects["Source"]
    source.facial_retarget.points.clear()
    choose(source)
    remember()
    yield from drive.look("FRONT", [source])
    with drive.override():
        bpy.ops.wm.tool_set_by_id(name="facial_retarget.feature_points", space_type="VIEW_3D")
    preparing = part("bridge.points.point_preparation").is_preparing
    yield from drive.wait(20)
    yield from drive.wait_until(lambda: not preparing(source), "the predictor is made")
    hand = part("viewport.point_drag").PointDrag
    presses, moves, releases = (times_of(hand, name) for name in ("__init__", "move", "put_down"))
    world, mesh = np.array(source.matrix_world), actor.face.mesh
    places = actor.face.points.subset(PLACED).positions(mesh.vertices) @ world[:3, :3].T + world[:3, 3]
    for place in places:
        x, y = drive.on_screen(place)
        yield from drive.click(x, y)
        yield from drive.wait_until(lambda: len(releases) == len(presses), "the point is put down")
    moves.clear()
    assert len(bpy.data.objects["Source"].facial_retarget.points) == len(PLACED)
    yield from drive.drag((x, y), (x + 3 * MOVES, y), steps=MOVES)
    taken = {"press": max(presses[1:]), "first move": max(moves[:3]), "move": median(moves), "release": max(releases)}
    return {"clicking": {what: 1e3 * seconds for what, seconds in taken.items()}}
