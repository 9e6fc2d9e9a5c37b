"""Set Up Workspace shows each face alone, from the front and as a whole; it is made once, and all works in it."""

import bpy
import numpy as np
from drive import (
    area,
    click,
    look,
    on_screen,
    open_section,
    open_tab,
    override,
    press_button,
    region,
    screenshot,
    still,
    wait,
    wait_until,
    window,
)
from stage import choose, clear, part, point_places, remember


def scenario():
    clear()
    with override():
        bpy.ops.facial_retarget.add_faces("EXEC_DEFAULT", points=True)
    task = bpy.context.scene.facial_retarget
    # However the heads stand, and even inside each other: each view shows one face from the front.
    task.target.rotation_euler = (0.4, 2.0, 0.7)
    task.target.location = task.source.location
    bpy.context.view_layer.update()
    yield from look("TOP")
    yield from open_tab()
    before = set(bpy.data.workspaces)
    yield from press_button("facial_retarget.set_up_workspace")
    yield from wait_until(is_aimed, "the workspace", 20)
    yield from wait()
    screenshot("workspace")
    (made,) = set(bpy.data.workspaces) - before
    assert (made.name, window().workspace) == ("Retarget", made)
    assert sorted(found.type for found in window().screen.areas) == ["DOPESHEET_EDITOR", "VIEW_3D", "VIEW_3D"]
    for place, face in enumerate((task.source, task.target)):
        check_view(area(place=place), face)

    # Pressed again, after the artist has looked elsewhere and renamed it: the same one, aimed anew.
    made.name = "Mine"
    yield from look("TOP", editor=area(place=1))
    yield from press_button("facial_retarget.set_up_workspace", editor=area(place=1))
    yield from wait_until(is_aimed, "the views are aimed anew", 20)
    yield from wait()
    assert set(bpy.data.workspaces) - before == {made}
    check_view(area(place=1), task.target)

    # The base mesh shows in the views of its faces, though these show faces alone.
    with override(area(place=1)):
        bpy.ops.facial_retarget.show_base()
    for place, face in enumerate((task.source, task.target)):
        space = area(place=place).spaces.active
        shown = {thing.name for thing in bpy.context.scene.objects if thing.local_view_get(space)}
        assert shown == {face.name, f"{face.name} base"}, shown

    # A view that does not show the source is no reason not to read it.
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 30, 33
    yield from open_section("4. Retarget", editor=area(place=1))
    yield from press_button("facial_retarget.retarget", editor=area(place=1))
    yield from wait_until(lambda: part("guide").is_baked(task.target, 30), "the bake", 60)

    # A click in the view of the other face goes on with that one.
    place = on_screen(point_places(task.target)["9.3"], area(place=1))
    task.target.facial_retarget.points.clear()
    choose(task.source)
    remember()
    yield from press_button("facial_retarget.feature_points", kind="TOOLS")
    yield from click(*place)
    assert bpy.context.view_layer.objects.active == task.target
    assert not len(task.target.facial_retarget.points)
    yield from still(0.5)  # else it is a double click
    yield from click(*place)
    assert len(task.target.facial_retarget.points) == 1

    with bpy.context.temp_override(workspace=made):
        bpy.ops.workspace.delete()
    yield from wait()
    assert set(bpy.data.workspaces) == before


def is_aimed() -> bool:
    """Whether the second view shows the target from the front."""
    views = [found for found in window().screen.areas if found.type == "VIEW_3D"]
    if len(views) != 2 or not area(place=1).width:
        return False
    shown = area(place=1).spaces.active.region_3d
    forward = np.array(shown.view_rotation.to_matrix())[:, 2]
    return bool(forward @ face_axes(bpy.context.scene.facial_retarget.target)[2] > 0.999)


def face_axes(face: bpy.types.Object) -> np.ndarray:
    places = point_places(face)
    return part("core.mpeg4.head").head_axes(list(places), np.array(list(places.values())))


def check_view(view: bpy.types.Area, face: bpy.types.Object) -> None:
    """The view shows the face alone, upright, whole and large, and nothing covers it."""
    space = view.spaces.active
    assert [thing for thing in bpy.context.scene.objects if thing.local_view_get(space)] == [face]
    assert (space.shading.type, space.region_3d.view_perspective) == ("SOLID", "ORTHO")
    axes, turn = face_axes(face), np.array(space.region_3d.view_rotation.to_matrix()).T
    np.testing.assert_allclose(turn, axes, atol=1e-3)
    places = np.array([on_screen(place, view) for place in point_places(face).values()])
    low, high = places.min(axis=0), places.max(axis=0)
    main, tools, sidebar = (region(kind, view) for kind in ("WINDOW", "TOOLS", "UI"))
    left = max(main.x, tools.x + tools.width)
    right = sidebar.x if space.show_region_ui else main.x + main.width
    assert left < low[0] < high[0] < right, (left, low, high, right)
    assert main.y < low[1] < high[1] < main.y + main.height
    free = np.array([right - left, main.height])
    assert ((high - low) / free).max() > 0.6, (high - low, free)
