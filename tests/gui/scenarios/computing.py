"""While something is computed: its progress stands in the sidebar, the view turns, keys do nothing, a button stops."""

import bpy
from drive import (
    area,
    click,
    drag,
    key,
    look,
    open_section,
    open_tab,
    override,
    press_button,
    region,
    screenshot,
    wait,
    wait_until,
    window,
)
from stage import clear, remember

BUTTON = 46
"""Pixels from the sidebar's top to the middle of the button that stops."""


def scenario():
    clear()
    with override():
        bpy.ops.facial_retarget.add_faces("EXEC_DEFAULT", target="ape", points=True)
    remember()
    yield from look("FRONT")
    yield from open_tab()

    # While something is computed only its progress stands there; the button stops it, and the view can be moved.
    bpy.context.scene.facial_retarget.hierarchical.levels = 6
    yield from open_section("4. Retarget")
    yield from press_button("facial_retarget.retarget")
    yield from wait_until(lambda: work().share > 0.21, "it computes")
    yield from wait()
    screenshot("computing")
    main = region()
    before = area().spaces.active.region_3d.view_rotation.copy()
    start = main.x + 0.4 * main.width, main.y + 0.4 * main.height
    yield from drag(start, (start[0] + 60, start[1] + 30), button="MIDDLEMOUSE")
    assert work().running, "the drag has stopped it, or it was too short"
    assert area().spaces.active.region_3d.view_rotation != before, "the view does not turn"
    chosen = bpy.context.view_layer.objects.active
    yield from key("X")
    yield from key("DEL")
    assert work().running, "keys have stopped it, or it was too short"
    assert chosen.name in bpy.data.objects
    # Busy as Blender is, a search would be late: the button stands below the bar.
    side, scale = region("UI"), bpy.context.preferences.system.ui_scale
    place = side.x + 0.8 * side.width, side.y + side.height - BUTTON * scale
    yield from click(*place)
    yield from wait_until(lambda: not window().modal_operators, "it stops", 5)
    assert not work().running
    assert bpy.context.scene.facial_retarget.target.data.shape_keys is None


def work():
    return bpy.data.window_managers[0].facial_retarget
