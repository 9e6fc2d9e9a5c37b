"""The list of points: what is placed, proposed and skipped; accepted by the panel's buttons, one undo step each."""

import bpy
from drive import area, click, find_button, look, open_section, open_tab, press_button, redo, screenshot, undo, wait
from stage import add_face, clear, part, remember


def scenario():
    clear()
    thing = add_face(part("demo").actor(3_000), "Actor")
    points, sets = part("bridge.points"), part("core.point_sets")
    placed = points.read_points(thing).subset(sets.FIRST_FIVE)
    points.write_points(thing, placed)
    part("bridge.point_prediction").update_predictions(thing)
    points.skip_point(thing, "11.1")
    remember()
    yield from look("FRONT", [thing])
    yield from open_tab()
    yield from open_section("2. Feature Points")
    yield from wait()
    screenshot("placed")
    assert (len(face().points), len(face().proposals)) == (5, 42)

    yield from show("PROPOSED")
    screenshot("proposed")
    yield from press_button("facial_retarget.accept_points")
    assert (len(face().points), len(face().proposals)) == (47, 0)
    yield from undo()
    assert (len(face().points), len(face().proposals)) == (5, 42)
    yield from redo()
    assert (len(face().points), len(face().proposals)) == (47, 0)

    yield from show("SKIPPED")
    screenshot("skipped")
    yield from click(*(yield from find_button("facial_retarget.want_point", across=(0.86, 0.9, 0.94, 0.98))))
    assert (face().proposals.keys(), face().skipped.keys()) == (["11.1"], [])
    yield from show("PLACED")
    screenshot("accepted")


def face() -> bpy.types.PropertyGroup:
    """What the object knows as a face: undo makes it anew."""
    return bpy.data.objects["Actor"].facial_retarget


def show(kind: str):
    """Choose what the list shows."""
    face().point_list = kind
    area().tag_redraw()
    yield from wait()
