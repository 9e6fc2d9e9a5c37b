"""Every panel of the tab with something in it, those inside others too; the pictures are those of the pages in docs."""

import bpy
from drive import (
    area,
    button_under_mouse,
    click,
    find_button,
    headers,
    illustrate,
    look,
    move,
    open_section,
    open_tab,
    override,
    panels,
    region,
    still,
    wait,
    window,
)
from stage import choose, clear, part, remember

START, FRAMES = 74, 8
"""Around a blink, in which the child's large eyes do not shut: the report has something to tell."""
INSIDE = {
    "4. Retarget": (
        ("bake", "bake.how.kind", "bake.earlier", 2),
        ("compare", "facial_retarget.compared", 'show_method(method="wavelet")', 1),
        ("gains", "regions.brows", "hierarchical.example_strength", 0),
    ),
    "5. Bake and Export": (
        ("normal_maps", "normal_maps.light", "make_normal_maps", 0),
        ("wrinkle_kit", "wrinkle_kit.detail", "remove_wrinkle_kit", 0),
    ),
    "More": (("cloning", "cloning.donor", "save_clone_job", 0),),
}
"""Title of a panel -> those inside it: name of the picture, first and last button, lines of text below that."""
HEADER, LINE, MARGIN = 36, 24, 8
"""Pixels of a header with the gap below it, of a line of text, and of the lower margin, at a scale of 1."""


def scenario():
    clear()
    task = bpy.context.scene.facial_retarget
    with override():
        bpy.ops.facial_retarget.add_faces("EXEC_DEFAULT", target="child", points=True)
        bpy.context.scene.frame_start, bpy.context.scene.frame_end = START, START + FRAMES - 1
        choose(task.target)
        bpy.ops.facial_retarget.create_examples("EXEC_DEFAULT")
        for side in ("SOURCE", "TARGET"):
            bpy.ops.facial_retarget.rough_out("EXEC_DEFAULT", example="joy", side=side, way="POINTS")
        bpy.ops.facial_retarget.retarget("EXEC_DEFAULT")
        task.compared_frames = 4
        bpy.ops.facial_retarget.compare("EXEC_DEFAULT")
        bpy.ops.facial_retarget.stop_preview("EXEC_DEFAULT")
    assert part("guide").is_baked(task.target, START)
    remember()
    yield from look("FRONT")
    yield from open_tab()
    for panel in panels("Retarget", area()):
        yield from open_section(panel.bl_label)
        if panel.bl_label == "More":
            yield from click(*headers(area())[-1], ctrl=True)  # opens the panels inside
        yield from still()
        shown = [y for _, y in headers(area())]
        whole = len(shown) == len(panels("Retarget", area())) and panel.bl_label != "More"
        bottom = int(shown[-1]) - 14 if whole else 80
        name = panel.__name__.removeprefix("FACIAL_RETARGET_PT_")
        illustrate(f"panel_{name}", 260, window().height - 80 - bottom, right=256, top=80)
        if panel.bl_label in INSIDE:
            yield from inside(panel.bl_label)


def inside(title):
    """The panels inside an open one."""
    place = [panel.bl_label for panel in panels("Retarget", area())].index(title)
    if title != "More":
        yield from click(*headers(area())[place], ctrl=True)  # opens them all
        yield from still()
    for name, first, last, lines in INSIDE[title]:
        yield from to_the_top(first)
        (_, top), (_, bottom) = (yield from edge(first, 1)), (yield from edge(last, -1))
        scale = bpy.context.preferences.system.ui_scale
        high, low = top + round(HEADER * scale), bottom - round((MARGIN + LINE * lines) * scale)
        yield from move(20, 20)  # away from the tooltips and lit buttons
        yield from still()
        illustrate(f"panel_{name}", 260, high - low, right=256, top=window().height - high)


def to_the_top(button):
    """Scroll until a button's panel begins at the upper edge of the sidebar."""
    _, y = yield from edge(button, 1)
    shown = region("UI")
    with override(area(), "UI"):
        bpy.ops.view2d.pan(
            deltax=0, deltay=round(y + 50 * bpy.context.preferences.system.ui_scale) - shown.y - shown.height
        )
    yield from wait()


def edge(button, way):
    """The place of a button's upper (1) or lower (-1) edge."""
    x, y = yield from find_button(button, across=(0.6, 0.3))
    for _ in range(40):
        yield from move(x, y + way)
        if button not in button_under_mouse(region("UI"), area()):
            break
        y += way
    return x, y
