"""Examples: created, sculpted with the mouse, undone, roughed out, replaced after a question, mirrored, checked."""

import bpy
import numpy as np
from drive import (
    click,
    drag,
    find_button,
    key,
    look,
    middle_of,
    move,
    on_screen,
    open_section,
    open_tab,
    press_button,
    redo,
    screenshot,
    undo,
    wait,
    wait_until,
    write,
)
from stage import add_face, clear, part, point_places, remember

ROW = 20.6
"""Pixels from button to button in a column."""
ROUGH_OUT, MIRROR = 2, 1
"""Rows above Strength."""


def shapes() -> dict[str, np.ndarray]:
    """What every shape key of every object holds."""
    found = {}
    for thing in bpy.data.objects:
        for block in thing.data.shape_keys.key_blocks if thing.data.shape_keys else ():
            flat = np.empty(3 * len(block.points), np.float32)
            block.points.foreach_get("co", flat)
            found[f"{thing.name} {block.name}"] = flat
    return found


def changed(before: dict[str, np.ndarray]) -> list[str]:
    """The keys that do not hold what they held."""
    now = shapes()
    assert now.keys() == before.keys(), now.keys() ^ before.keys()
    return [name for name, flat in now.items() if not np.array_equal(flat, before[name])]


def example_button(operator: str, example: str, side: str):
    """Press the button of an operator for an example on one face."""
    command = f'facial_retarget.{operator}(example="{example}", side="{side}"'
    x, y = yield from find_button(command, across=(0.3, 0.75))
    yield from click(x, y)


def choose(rows: int, example: str, side: str, letter: str):
    """Open the menu some rows above Strength, and choose what has a letter of its own."""
    command = f'facial_retarget.scale_example(example="{example}", side="{side}"'
    found = yield from find_button(command, across=(0.3, 0.75))
    x, y = yield from middle_of(command, found)
    yield from click(x, y + rows * ROW)
    yield from key(letter)


def state(example: str) -> tuple[str, str]:
    """What the list shows of an example on source and target."""
    shown = bpy.context.scene.facial_retarget.examples[example]
    return shown.source_state, shown.target_state


def idle() -> bool:
    """Whether no work runs in steps."""
    return not bpy.context.window_manager.facial_retarget.running


def scenario():
    clear()
    demo = part("demo")
    source, target = add_face(demo.actor(4_500), "Actor"), add_face(demo.child(), "Child", 2.5)
    task = bpy.context.scene.facial_retarget
    task.source, task.target = source, target
    remember()
    cheek = point_places(source)["5.1"]
    yield from look("FRONT", [source, target])
    yield from open_tab()
    yield from open_section("3. Examples")
    yield from press_button("facial_retarget.create_examples")
    assert [state(example.name) for example in bpy.context.scene.facial_retarget.examples] == [("EMPTY", "EMPTY")] * 6

    # A stroke on the source's cheek changes this key alone, and is a step of its own.
    before = shapes()
    yield from example_button("sculpt_example", "joy", "SOURCE")
    assert bpy.context.mode == "SCULPT"
    active = bpy.context.view_layer.objects.active
    assert (active.name, active.active_shape_key.name) == ("Actor", "joy")
    place = np.array(on_screen(cheek))
    yield from drag(place - 12, place + 12)
    assert changed(before) == ["Actor joy"], changed(before)
    sculpted = shapes()
    screenshot("sculpting")
    yield from undo()
    assert changed(before) == []
    yield from redo()
    assert changed(sculpted) == []
    yield from press_button("facial_retarget.stop_sculpting")
    assert bpy.context.mode == "OBJECT"
    assert bpy.context.view_layer.objects.active.name == "Child"
    assert not bpy.data.objects["Actor"].show_only_shape_key
    assert changed(sculpted) == []
    assert state("joy") == ("SCULPTED", "EMPTY")
    assert "Actor alone" in bpy.context.scene.facial_retarget.examples["joy"].warning
    screenshot("one_side")
    # Undone, Done leads back to Object Mode with the pin, and from there to the stroke.
    yield from undo()
    assert bpy.data.objects["Actor"].show_only_shape_key
    yield from undo()
    assert bpy.context.mode == "SCULPT"
    assert bpy.context.view_layer.objects.active.name == "Actor"
    assert changed(sculpted) == []
    yield from redo()
    yield from redo()
    assert bpy.context.mode == "OBJECT"
    assert not bpy.data.objects["Actor"].show_only_shape_key

    # Rough Out from the other face, in steps; then the artist is asked before it is replaced.
    yield from choose(ROUGH_OUT, "joy", "TARGET", "O")
    yield from wait_until(lambda: idle() and state("joy")[1] == "SCULPTED", "cloned")
    assert changed(sculpted) == ["Child joy"], changed(sculpted)
    cloned = shapes()
    yield from choose(ROUGH_OUT, "joy", "TARGET", "F")
    screenshot("question")
    yield from key("ESC")
    assert changed(cloned) == []
    yield from choose(ROUGH_OUT, "joy", "TARGET", "F")
    yield from key("RET")
    yield from wait_until(lambda: idle() and changed(cloned), "replaced")
    assert changed(cloned) == ["Child joy"]
    yield from undo()
    assert changed(cloned) == []

    yield from choose(MIRROR, "joy", "SOURCE", "F")
    yield from wait_until(lambda: idle() and changed(cloned), "flipped")
    assert changed(cloned) == ["Actor joy"]
    yield from undo()
    assert changed(cloned) == []

    # The slider of Strength acts at once: half of it.
    strength = 'facial_retarget.scale_example(example="joy", side="TARGET"'
    x, y = yield from middle_of(strength, (yield from find_button(strength, across=(0.3, 0.75))))
    yield from click(x, y)
    screenshot("strength")
    yield from move(x + 215, y - 102)
    yield from key("RET")
    yield from write("0.5")
    yield from key("RET")
    yield from click(x - 400, y)
    assert changed(cloned) == ["Child joy"]
    half = shapes()["Child joy"] - cloned["Child Basis"]
    np.testing.assert_allclose(half, 0.5 * (cloned["Child joy"] - cloned["Child Basis"]), atol=1e-4)
    weaker = shapes()

    # Check Examples: Esc leaves all as it is; then the figures stand in the list, until an example changes.
    task = bpy.context.scene.facial_retarget
    yield from press_button("facial_retarget.check_examples")
    assert not idle()
    yield from key("ESC")
    yield from wait_until(idle, "stopped")
    assert task.examples["joy"].fit == -1
    for side in ("SOURCE", "TARGET"):
        bpy.ops.facial_retarget.rough_out(side=side)
    remember()
    yield from press_button("facial_retarget.check_examples")
    yield from wait_until(lambda: idle() and task.examples["joy"].checked, "checked")
    assert changed(weaker) != []
    assert all(0 <= example.fit < example.leave_one_out for example in task.examples)
    yield from wait(20)
    screenshot("checked")
