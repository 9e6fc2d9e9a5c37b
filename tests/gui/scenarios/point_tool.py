"""The feature-point tool: clicks land where the mouse is, drags slide, Ctrl-clicks remove, undo goes point by point."""

import bpy
import drive
import numpy as np
import stage

TOOL = "facial_retarget.feature_points"


def choose_tool(editor=None):
    """As a click in the toolbar does."""
    with drive.override(editor):
        bpy.ops.wm.tool_set_by_id(name=TOOL, space_type="VIEW_3D")
    yield from drive.wait()


def actor():
    """The face anew: undo makes new objects of all."""
    return bpy.data.objects["Actor"]


def pixels(name, editor=None):
    """(2,) pixels where a stored point is seen."""
    names, places = stage.part("bridge.points.point_places").world_places(
        actor(), bpy.context.evaluated_depsgraph_get()
    )
    return np.array(drive.on_screen(places[names.index(name)], editor))


def middle():
    """(2,) pixels of the middle of the view."""
    shown = drive.region()
    return np.round([shown.x + shown.width / 2, shown.y + shown.height / 2])


def scenario():
    """Play it."""
    stage.clear()
    stage.add_face(stage.part("demo").actor(1_500), "Actor", points=False)
    yield from drive.look("FRONT")
    yield from choose_tool()

    preparing = stage.part("bridge.points.point_preparation").is_preparing
    yield from drive.wait(20)
    yield from drive.wait_until(lambda: not preparing(actor()), "the predictor is made")

    # Each click places the point whose turn it is, within a pixel, and is a step of the undo history.
    placed, proposed = [], [()]
    for offset in ([70, 90], [-70, 90], [0, -10]):
        name = actor().facial_retarget.turn
        yield from drive.click(*(middle() + offset))
        placed.append(name)
        proposed.append(tuple(actor().facial_retarget.proposals.keys()))
        assert name not in proposed[-1]
        assert actor().facial_retarget.points.keys() == placed
        assert np.abs(pixels(name) - middle() - offset).max() < 1, (pixels(name), offset)
    for count in (2, 1, 0, 1, 2, 3):
        yield from drive.undo() if count < 3 and count != len(actor().facial_retarget.points) + 1 else drive.redo()
        assert actor().facial_retarget.points.keys() == placed[:count]
        assert tuple(actor().facial_retarget.proposals.keys()) == proposed[count]
        assert actor().facial_retarget.turn == (placed + [actor().facial_retarget.turn])[count]

    # A click on a point chooses it and changes nothing; a drag slides it; Esc on the way puts it back.
    left, right, nose = placed
    start = pixels(nose)
    yield from drive.click(*pixels(left))
    face = actor().facial_retarget
    assert face.points.keys() == placed
    assert face.points[face.active_point].name == left
    yield from drive.drag(start, start + [30, -25])
    assert np.abs(pixels(nose) - start - [30, -25]).max() < 1, pixels(nose) - start
    drive.screenshot("point_tool")
    yield from drive.undo()
    assert np.abs(pixels(nose) - start).max() < 0.01
    yield from drive.redo()
    assert np.abs(pixels(nose) - start - [30, -25]).max() < 1
    before = pixels(left)
    yield from drive.hold(before, before + [20, 20])
    assert np.abs(pixels(left) - before - [20, 20]).max() < 1
    yield from drive.key("ESC")
    assert np.abs(pixels(left) - before).max() < 0.01
    yield from drive.let_go()
    assert np.abs(pixels(left) - before).max() < 0.01

    # Dragged off the face it stays on the outline, on the side that is seen.
    outside = middle() + [260, 45]
    yield from drive.drag(pixels(left), outside, steps=20)
    assert 100 < (pixels(left) - middle())[0] < 200, pixels(left) - middle()
    yield from drive.undo()

    # Beside the face a click says why nothing happens. Ctrl-click removes, Tab passes the turn on.
    yield from drive.click(*(middle() + [260, 45]))
    assert actor().facial_retarget.points.keys() == placed
    yield from drive.click(*pixels(nose), ctrl=True)
    assert actor().facial_retarget.points.keys() == placed[:2]
    assert actor().facial_retarget.turn == nose
    yield from drive.key("TAB")
    assert bpy.context.mode == "OBJECT"
    assert actor().facial_retarget.turn not in placed
    yield from drive.key("TAB", shift=True)
    assert actor().facial_retarget.turn == nose

    # X mirrors: the partner comes, follows and goes in the same step.
    yield from drive.key("X")
    assert bpy.context.scene.facial_retarget.mirror_points
    yield from drive.drag(pixels(left), pixels(left) + [10, 5])
    gap = pixels(left) - middle() + (pixels(right) - middle()) * [1, -1]
    assert np.abs(gap).max() < 3, gap
    yield from drive.undo()
    yield from drive.click(*pixels(right), ctrl=True)
    assert not len(actor().facial_retarget.points)
    yield from drive.undo()
    assert actor().facial_retarget.points.keys() == placed[:2]

    # Return accepts the proposal of the point whose turn it is, Shift Return all: one step each.
    yield from drive.click(*(middle() + [0, -10]))
    assert actor().facial_retarget.points.keys() == placed
    name = actor().facial_retarget.turn
    assert name in actor().facial_retarget.proposals
    yield from drive.key("RET")
    assert name in actor().facial_retarget.points
    drive.screenshot("point_tool_proposals")
    yield from drive.key("RET", shift=True)
    assert actor().facial_retarget.turn == ""
    assert not len(actor().facial_retarget.proposals)
    drive.screenshot("point_tool_accepted")
    yield from drive.undo()
    yield from drive.undo()
    assert actor().facial_retarget.points.keys() == placed
