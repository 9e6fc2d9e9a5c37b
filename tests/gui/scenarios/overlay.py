"""What is drawn of the points: marks where they are, told apart, names under the mouse, nothing when it is off."""

from types import SimpleNamespace

import addon_utils
import bpy
import numpy as np
from drive import area, look, move, on_screen, override, region, screenshot, wait, wait_until, window
from stage import NAME, add_face, choose, clear, part, point_places

BLUE, ORANGE, YELLOW = np.array([64, 184, 255]), np.array([255, 140, 26]), np.array([255, 214, 0])
"""Of placed points, of the selected one's ring, of what is doubtful."""


def picture(name: str) -> np.ndarray:
    """(height, width, 3) what the window shows, from its lower left corner."""
    image = bpy.data.images.load(str(screenshot(name)))
    pixels = np.empty(4 * image.size[0] * image.size[1], np.float32)
    image.pixels.foreach_get(pixels)
    shape = (image.size[1], image.size[0], 4)
    bpy.data.images.remove(image)
    return np.round(255 * pixels.reshape(shape)[..., :3]).astype(int)


def spots(shown: np.ndarray, colour: np.ndarray, editor: bpy.types.Area | None = None) -> np.ndarray:
    """(n, 2) pixels (x, y) of about this colour within a 3D view."""
    view = region("WINDOW", editor or area())
    inside = shown[view.y : view.y + view.height, view.x : view.x + view.width]
    rows, columns = np.nonzero(np.abs(inside - colour).max(axis=2) < 12)
    return np.stack([columns + view.x, rows + view.y], axis=1)


def are_marked(shown: np.ndarray, places: list[np.ndarray], colour: np.ndarray) -> list[bool]:
    """Whether each place of the scene has the colour within two pixels."""
    found = []
    for place in places:
        x, y = (round(v) for v in on_screen(place))
        found.append(bool((np.abs(shown[y - 2 : y + 3, x - 2 : x + 3] - colour).max(axis=2) < 12).any()))
    return found


def scenario():
    clear()
    demo, points = part("demo"), part("bridge.points.points")
    actor = add_face(demo.actor(4_000), "Actor", -1.3)
    ape = add_face(demo.targets()[0], "Ape", 1.3)
    task = bpy.context.scene.facial_retarget
    task.source, task.target = actor, ape
    yield from look("FRONT", [actor, ape])

    # Both faces at once; the active one's selected point has its own shape.
    shown = picture("both_faces")
    for face in (actor, ape):
        places = point_places(face)
        front = [places[name] for name in ("5.1", "5.2", "11.1", "4.3", "4.4")]
        assert all(are_marked(shown, front, BLUE)), face.name
    selected = point_places(ape)[ape.facial_retarget.points[ape.facial_retarget.active_point].name]
    ring = spots(shown, ORANGE) - np.array(on_screen(selected))
    near = np.linalg.norm(ring, axis=1) < 12
    assert near.sum() > 8, near.sum()

    # The name comes under the mouse, and goes.
    x, y = on_screen(point_places(actor)["5.1"])
    yield from move(x, y)
    yield from wait()
    beside = np.s_[round(y) - 6 : round(y) + 7, round(x) + 9 : round(x) + 60]
    assert (picture("name")[beside].min(axis=2) > 240).sum() > 20, "no name beside the point under the mouse"
    yield from move(x, y + 200)
    yield from wait()
    assert not (picture("no_name")[beside].min(axis=2) > 240).any(), "the name has stayed"

    # Proposals are hollow.
    every = points.read_points(actor)
    points.write_points(actor, every.subset([name for name in every.names if name not in ("5.1", "5.2")]))
    points.write_proposals(actor, every.subset(["5.1", "5.2"]))
    area().tag_redraw()
    yield from wait()
    hollow = picture("proposals")
    places = [
        every.positions(part("bridge.meshes").neutral_mesh(actor).vertices)[every.index([n])[0]] for n in ("5.1",)
    ]
    world = np.array(actor.matrix_world)
    assert not any(are_marked(hollow, [world[:3, :3] @ place + world[:3, 3] for place in places], BLUE))

    # A sculpted shape moves the marks with the surface; a renumbering modifier does not lose them.
    task.overlay.show_diagram = False
    actor.shape_key_add(name="Basis", from_mix=False)
    key = actor.shape_key_add(name="down", from_mix=False)
    moved = part("bridge.meshes").read_positions(actor.data) - np.array([0, 0.3, 0], np.float32)
    key.points.foreach_set("co", moved.ravel())
    key.value = 0.0
    yield from wait()
    key.value = 1.0
    yield from wait()
    low = picture("moved")
    place = point_places(actor)["11.1"] - world[:3, 1] * 0.3
    assert are_marked(low, [place], BLUE) == [True]
    key.value = 0.0

    # Hidden, in local view, switched off, without overlays: nothing is drawn.
    def gone(what: str, thing: bpy.types.Object) -> None:
        assert not any(are_marked(picture(what), [point_places(thing)["11.1"]], BLUE)), what

    ape.hide_set(True)
    yield from wait()
    gone("hidden", ape)
    ape.hide_set(False)
    choose(actor)
    with override():
        bpy.ops.view3d.localview(frame_selected=False)
    yield from wait()
    gone("local_view", ape)
    with override():
        bpy.ops.view3d.localview(frame_selected=False)
    for data, name in ((task.overlay, "show_points"), (area().spaces.active.overlay, "show_overlays")):
        setattr(data, name, False)
        area().tag_redraw()
        yield from wait()
        assert not len(spots(picture(name), BLUE)), name
        setattr(data, name, True)

    # A quad view, with no, few and all points.
    with override():
        bpy.ops.screen.region_quadview()
    for count in (0, 5, len(every)):
        points.write_points(actor, every.subset(every.names[:count]))
        points.write_points(ape, every.subset([]))
        area().tag_redraw()
        yield from wait()
        found = spots_in_all(picture(f"quad_view_{count}"))
        assert (found > 4 * count) if count else found == 0, (count, found)
    with override():
        bpy.ops.screen.region_quadview()

    # All names, none over another one: as many boxes as can be read.
    points.write_points(actor, every)
    task.overlay.show_names = True
    yield from look("FRONT", [actor])
    screenshot("all_names")

    task.overlay.show_names = False

    # The base mesh comes over both faces; where it folds over, its triangles and their points warn.
    points.write_points(ape, part("demo").targets()[0].face.points)
    base = part("viewport.base")
    task.overlay.show_base = True
    area().tag_redraw()
    yield from wait_until(lambda: base.folded_names(actor) == frozenset() and base.lines_of(actor), "a base mesh")
    yield from wait()
    shown = picture("base_mesh")
    assert len(spots(shown, YELLOW)) == 0
    placed = actor.facial_retarget.points
    one, other = (placed[name].vertices[:] for name in ("5.1", "9.1"))
    placed["5.1"].vertices, placed["9.1"].vertices = other, one
    area().tag_redraw()
    yield from wait_until(lambda: base.folded_names(actor), "folded triangles")
    yield from wait()
    assert {"5.1", "9.1"} <= base.folded_names(actor)
    assert len(spots(picture("folded"), YELLOW)) > 100
    assert "5.1" in part("viewport.faces").face_marks(view_context(), actor).doubts

    # With too few points the view says why there is no base mesh.
    points.write_points(actor, every.subset(every.names[:9]))
    area().tag_redraw()
    yield from wait_until(base.trouble, "why there is none")
    assert "9 feature points in common" in base.trouble()
    yield from wait()
    screenshot("too_few_points")

    # In Edit Mode the face's mesh is left alone; disabling takes all drawing away, and enabling brings it back.
    choose(actor)
    with override():
        bpy.ops.object.mode_set(mode="EDIT")
    yield from wait()
    with override():
        bpy.ops.object.mode_set(mode="OBJECT")
    task.overlay.show_base = False
    points.write_points(actor, every)
    for enabled in (False, True):
        (addon_utils.enable if enabled else addon_utils.disable)(NAME)
        area().tag_redraw()
        yield from wait()
        found = len(spots(picture(f"enabled_{enabled}"), BLUE))
        assert (found > 100) if enabled else found == 0, (enabled, found)


def view_context() -> SimpleNamespace:
    """What drawing asks of the context."""
    editor = area()
    return SimpleNamespace(
        active_object=bpy.context.view_layer.objects.active,
        view_layer=bpy.context.view_layer,
        scene=bpy.context.scene,
        space_data=editor.spaces.active,
        workspace=window().workspace,
        mode=bpy.context.mode,
    )


def spots_in_all(shown: np.ndarray) -> int:
    """How many pixels of a 3D view have the colour of placed points."""
    editor = area()
    inside = shown[editor.y : editor.y + editor.height, editor.x : editor.x + editor.width]
    return int((np.abs(inside - BLUE).max(axis=2) < 12).sum())
