"""The target follows while the artist scrubs, plays and drags, by one method or another, and nothing is left of it."""

import bpy
import numpy as np
from drive import (
    OUT,
    area,
    click,
    drag,
    find_button,
    key,
    log,
    look,
    move,
    open_section,
    open_tab,
    override,
    press_button,
    redo,
    region,
    screenshot,
    undo,
    wait,
    wait_until,
    window,
)
from stage import clear, part, remember, shown

KEY = "facial_retarget_preview"
seen: dict[int, np.ndarray] = {}


def scenario():
    clear()
    with override():
        bpy.ops.facial_retarget.add_faces("EXEC_DEFAULT", target="child", points=True)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 30, 41
    scene.frame_set(30)
    actor = part("demo").actor(part("bridge.scene.demo_pair").ACTOR_VERTICES)
    part("bridge.examples.examples").write_example(source(), "surprise", actor.face.examples["surprise"])
    source().active_shape_key_index = len(source().data.shape_keys.key_blocks) - 1
    remember()
    rest = shown(target())
    yield from look("FRONT")
    yield from open_tab()
    yield from open_section("4. Retarget")
    screenshot("off")

    # On: the fit runs in steps, and the target is where a bake would put it.
    yield from press_button("facial_retarget.start_preview")
    yield from wait_until(lambda: state().on, "the preview is on")
    yield from wait()
    see()
    assert motion(rest) > 0.01, motion(rest)
    screenshot("on")

    # Scrubbing, by keys and in the timeline.
    view = region()
    yield from move(view.x + 0.5 * view.width, view.y + 20)
    for _ in range(3):
        yield from key("RIGHT_ARROW")
        see()
    line = region("WINDOW", area("DOPESHEET_EDITOR"))
    at = [
        (line.x + line.view2d.view_to_region(frame, 0, clip=False)[0], line.y + line.height - 8) for frame in (34, 40)
    ]
    yield from drag(*at, steps=6)
    see()
    assert len(seen) >= 5, sorted(seen)
    screenshot("scrubbed")

    # Playback.
    yield from move(view.x + 0.5 * view.width, view.y + 20)
    yield from key("SPACE")
    assert window().screen.is_animation_playing
    for _ in range(20):
        yield from wait(2)
        see()
    yield from key("SPACE")
    assert not window().screen.is_animation_playing
    yield from wait()
    log(f"{len(seen)} frames seen, {state().milliseconds:.1f} ms the last")
    assert len(seen) >= 8, sorted(seen)

    # A slider of the source's.
    before = shown(target())
    area("PROPERTIES").spaces.active.context = "DATA"
    yield from wait()
    slider = yield from find_button('key_blocks["surprise"].value', "WINDOW", area("PROPERTIES"), (0.62,))
    yield from drag(slider, (slider[0] + 60, slider[1]))
    assert source().data.shape_keys.key_blocks["surprise"].value > 0.1
    assert motion(before) > 0.01, motion(before)
    screenshot("dragged")
    yield from undo()
    assert source().data.shape_keys.key_blocks["surprise"].value == 0.0
    assert state().on
    yield from wait()
    np.testing.assert_allclose(shown(target()), before, atol=1e-5 * np.ptp(rest))

    # A gain acts at once; the saved file has nothing of it.
    scene = bpy.context.scene
    scene.facial_retarget.regions.mouth = 0.0
    yield from wait()
    assert motion(before) > 0.002, motion(before)
    screenshot("mouth_still")
    scene.facial_retarget.regions.mouth = 1.0
    yield from wait()
    np.testing.assert_allclose(shown(target()), before, atol=1e-5 * np.ptp(rest))
    saved = OUT / "saved.blend"
    with override():
        bpy.ops.wm.save_as_mainfile(filepath=str(saved), copy=True)
    with bpy.data.libraries.load(str(saved)) as (inside, wanted):
        wanted.objects = [name for name in inside.objects if name == target().name]
    assert wanted.objects[0].data.shape_keys is None
    bpy.data.batch_remove([wanted.objects[0], wanted.objects[0].data])

    # Compared: a click on a method shows it at once.
    x, y = yield from find_button("facial_retarget.stop_preview")
    scale = bpy.context.preferences.system.ui_scale
    yield from click(x, y - 58 * scale)
    yield from press_button("facial_retarget.compare()")
    yield from wait_until(lambda: len(state().rows) == 4, "the comparison", 120)
    yield from wait()
    np.testing.assert_allclose(shown(target()), before, atol=1e-5 * np.ptp(rest))
    screenshot("compared")
    yield from press_button('facial_retarget.show_method(method="feature_points")')
    yield from wait_until(lambda: state().method == "feature_points", "the method")
    yield from wait()
    assert motion(before) > 0.002, motion(before)
    screenshot("other_method")
    yield from press_button('facial_retarget.show_method(method="hierarchical")')
    yield from wait_until(lambda: state().method == "hierarchical", "the method")
    yield from wait()
    np.testing.assert_allclose(shown(target()), before, atol=1e-5 * np.ptp(rest))

    # Off: as before. Undo turns it on again, redo off.
    with override(None, "UI"):
        bpy.ops.view2d.reset()
    yield from wait()
    yield from press_button("facial_retarget.stop_preview")
    assert not state().on
    assert target().data.shape_keys is None
    assert np.array_equal(shown(target()), rest)
    yield from undo()
    assert state().on
    bpy.context.scene.frame_set(33)
    yield from wait()
    np.testing.assert_allclose(shown(target()), seen[33], atol=1e-5 * np.ptp(rest))
    yield from redo()
    assert not state().on
    assert target().data.shape_keys is None

    # What was seen is what a bake makes.
    with override():
        bpy.ops.facial_retarget.retarget("EXEC_DEFAULT")
    for frame, positions in seen.items():
        bpy.context.scene.frame_set(frame)
        np.testing.assert_allclose(shown(target()), positions, atol=1e-5 * np.ptp(rest))


def source() -> bpy.types.Object:
    return bpy.context.scene.facial_retarget.source


def target() -> bpy.types.Object:
    return bpy.context.scene.facial_retarget.target


def state():
    return part("preview_state").STATE


def see() -> None:
    """Keep how the target looks at this frame."""
    assert KEY in target().data.shape_keys.key_blocks
    assert not state().trouble, state().trouble
    seen[bpy.context.scene.frame_current] = shown(target())


def motion(before: np.ndarray) -> float:
    """How far a vertex of the target is at most from where it was, as a share of its size."""
    return float(np.abs(shown(target()) - before).max() / np.ptp(before))
