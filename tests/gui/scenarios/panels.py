"""Every panel of the tab with something in it; its pictures are those of docs/blender.md."""

import bpy
from drive import area, click, headers, illustrate, look, open_section, open_tab, override, panels, still, window
from stage import choose, clear, part, remember

FRAMES = 8


def scenario():
    clear()
    task = bpy.context.scene.facial_retarget
    with override():
        bpy.ops.facial_retarget.add_faces("EXEC_DEFAULT", target="child", points=True)
        bpy.context.scene.frame_start, bpy.context.scene.frame_end = 40, 39 + FRAMES
        choose(task.target)
        bpy.ops.facial_retarget.create_examples("EXEC_DEFAULT")
        for side in ("SOURCE", "TARGET"):
            bpy.ops.facial_retarget.rough_out("EXEC_DEFAULT", example="joy", side=side, way="POINTS")
        bpy.ops.facial_retarget.retarget("EXEC_DEFAULT")
    assert part("guide").is_baked(task.target, 40)
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
