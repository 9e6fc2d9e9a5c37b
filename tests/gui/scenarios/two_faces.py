"""With source and target side by side, the feature-point tool goes from one to the other by a click."""

import bpy
import drive
import stage


def scenario():
    """Play it."""
    stage.clear()
    demo, task = stage.part("demo"), bpy.context.scene.facial_retarget
    task.source = stage.add_face(demo.actor(1_500), "Source", -1.2, points=False)
    task.target = stage.add_face(demo.actor(1_500), "Target", 1.2, points=False)
    yield from drive.look("FRONT")
    with drive.override():
        bpy.ops.wm.tool_set_by_id(name="facial_retarget.feature_points", space_type="VIEW_3D")
    yield from drive.wait()
    left, right = drive.on_screen((-1.2, 0, 0)), drive.on_screen((1.2, 0, 0))

    def counts():
        return [len(bpy.data.objects[name].facial_retarget.points) for name in ("Source", "Target")]

    def active():
        return bpy.context.view_layer.objects.active.name

    assert active() == "Target"
    yield from drive.click(*right)
    assert counts() == [0, 1]
    # The first click beside the active face only makes the other one active, so that none places a point by mistake.
    yield from drive.click(*left)
    assert (active(), counts()) == ("Source", [0, 1])
    yield from drive.click(*left)
    assert (active(), counts()) == ("Source", [1, 1])
    # A click on a point of the other face chooses both.
    yield from drive.click(*right)
    assert (active(), counts()) == ("Target", [1, 1])
    # Between the faces nothing happens.
    yield from drive.click(*drive.on_screen((0, 0, 0)))
    assert (active(), counts()) == ("Target", [1, 1])
    drive.screenshot("two_faces")
