"""A click on a face lands within a pixel, and the point that it gives is where the artist has clicked."""

import bpy
import numpy as np
from drive import click, find_button, key, look, on_screen, open_tab, redo, screenshot, undo, write
from stage import add_face, clear, part, point_places, remember


def scenario():
    clear()
    face = add_face(part("demo").actor(3_000), "Actor")
    corner = point_places(face)["8.3"]
    face.facial_retarget.points.clear()
    remember()
    yield from look("FRONT", [face])
    yield from open_tab()
    place = np.array(on_screen(corner))

    yield from click(*place, button="RIGHTMOUSE", shift=True)
    cursor = np.array(bpy.context.scene.cursor.location)
    assert np.abs(on_screen(cursor) - place).max() <= 1, (on_screen(cursor), place)
    assert np.linalg.norm(cursor - corner) < 0.02, (cursor, corner)

    # The dialog opens with the name's field under the mouse; its OK is two rows below.
    x, y = yield from find_button("facial_retarget.add_point")
    yield from click(x, y)
    yield from click(x - 40, y - 8)
    yield from write("8.3")
    yield from key("RET")
    screenshot("dialog")
    yield from click(x - 40, y - 66)
    assert list(point_places(face)) == ["8.3"], list(point_places(face))
    assert np.abs(on_screen(point_places(face)["8.3"]) - place).max() <= 1

    yield from undo()
    assert not len(bpy.data.objects["Actor"].facial_retarget.points)
    yield from redo()
    assert list(point_places(bpy.data.objects["Actor"])) == ["8.3"]
