"""The list of points: guessed, accepted, mirrored by the panel's buttons, one undo step each; doubtful ones say why."""

import bpy
from drive import (
    area,
    click,
    find_button,
    key,
    look,
    open_section,
    open_tab,
    redo,
    screenshot,
    undo,
    wait,
    wait_until,
)
from stage import add_face, clear, part, remember


def scenario():
    clear()
    thing = add_face(part("demo").actor(3_000), "Actor", points=False)
    part("bridge.points.points").skip_point(thing, "11.1")
    remember()
    yield from look("FRONT", [thing])
    yield from open_tab()
    yield from open_section("2. Feature Points")

    yield from press("facial_retarget.guess_points", 0.5)
    yield from wait_until(lambda: len(face().proposals), "the guess", 30)
    assert (len(face().points), len(face().proposals)) == (0, 47)
    yield from show("PROPOSED")
    screenshot("proposed")
    yield from press("facial_retarget.accept_points", 0.5)
    assert (len(face().points), len(face().proposals)) == (47, 0)
    yield from undo()
    assert (len(face().points), len(face().proposals)) == (0, 47)
    yield from redo()
    assert (len(face().points), len(face().proposals)) == (47, 0)

    yield from show("SKIPPED")
    screenshot("skipped")
    yield from press("facial_retarget.want_point", 0.86)
    assert (face().proposals.keys(), face().skipped.keys()) == (["11.1"], [])

    # A point on the wrong side is doubtful until its half is mirrored from the other one.
    left = face().points["8.3"]
    part("bridge.points.points").place_point(bpy.data.objects["Actor"], "8.4", left.vertices, left.weights)
    part("bridge.points.point_prediction").update_predictions(bpy.data.objects["Actor"])
    remember()
    yield from show("PLACED")
    screenshot("doubtful")
    assert "in the same place" in face().points["8.4"].doubt
    # A menu is no button that the mouse can name: it stands two rows above one.
    x, y = yield from find_button("facial_retarget.load_points", across=(0.3,))
    yield from click(x, y + 41)
    screenshot("menu")
    yield from key("L")
    yield from wait_until(lambda: not face().points["8.4"].doubt, "the mirror image", 10)
    assert not face().points["8.4"].doubt
    yield from show("PLACED")
    screenshot("mirrored")


def press(what: str, across: float):
    """Press a button of which it is known how far across the sidebar it stands."""
    yield from click(*(yield from find_button(what, across=(across,))))


def show(kind: str):
    """Choose what the list shows."""
    face().point_list = kind
    area().tag_redraw()
    yield from wait()


def face() -> bpy.types.PropertyGroup:
    """What the object knows as a face: undo makes it anew."""
    return bpy.data.objects["Actor"].facial_retarget
