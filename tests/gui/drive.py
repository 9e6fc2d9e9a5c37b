"""Drives a real Blender window by simulated events.

A scenario is a file with a generator `scenario()`. Each `yield` gives Blender a turn, in which it handles the events
so far and draws the window; what needs several turns is a generator itself: `yield from click(x, y)`. Places are in
pixels from the window's lower left corner.
"""

import os
import subprocess
import sys
import traceback
from collections.abc import Callable, Generator, Sequence
from pathlib import Path
from time import monotonic
from typing import Any

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d

OUT = Path()
"""Where screenshots go, and what else a scenario writes."""
ARGUMENTS: list[str] = []
"""What follows the scenario's name on the command line."""

Turns = Generator[None, None, Any]
TURN = 0.01
"""Seconds between two turns, at least: a redraw takes longer."""
ACROSS = (0.3, 0.6, 0.9)
"""Where buttons are looked for, as shares of a region's width."""
_mouse = [0, 0]


# The scenario's life.


def set_preferences() -> None:
    """Before the window is drawn: nothing that steals a click, nothing that moves by itself."""
    preferences = bpy.context.preferences
    preferences.view.show_splash = False
    preferences.view.smooth_view = 0
    preferences.view.show_tooltips = False
    preferences.system.viewport_aa = "OFF"
    preferences.use_preferences_save = False
    preferences.filepaths.use_auto_save_temporary_files = False


def play(scenario: Callable[[], Turns]) -> None:
    """Play a scenario from a timer, turn by turn; Blender then ends with a true status and without a question."""
    turns = scenario()

    def tick() -> float:
        try:
            next(turns)
            return TURN
        except StopIteration:
            status = 0
        except BaseException:
            traceback.print_exc()
            screenshot("failed")
            status = 1
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)

    # Persistent: a timer must outlive the opening of a file.
    bpy.app.timers.register(tick, first_interval=0.5, persistent=True)


def log(*words: object) -> None:
    """Say something that the log shows."""
    print("[gui]", *words, flush=True)


def wait(turns: int = 5) -> Turns:
    """Give Blender some turns."""
    for _ in range(turns):
        yield


def wait_until(condition: Callable[[], object], what: str, seconds: float = 60) -> Turns:
    """Give Blender turns until something is so; fails when it takes too long."""
    end = monotonic() + seconds
    while not condition():
        assert monotonic() < end, f"not after {seconds} s: {what}"
        yield


# Where things are.


def window() -> bpy.types.Window:
    """The window; in a timer bpy.context.window is None."""
    return bpy.data.window_managers[0].windows[0]


def area(kind: str = "VIEW_3D", place: int = 0) -> bpy.types.Area:
    """An editor, counted from the left."""
    found = [area for area in window().screen.areas if area.type == kind]
    return sorted(found, key=lambda area: (area.x, -area.y))[place]


def region(kind: str = "WINDOW", editor: bpy.types.Area | None = None) -> bpy.types.Region:
    """A region of an editor, the 3D view if none is named."""
    return next(region for region in (editor or area()).regions if region.type == kind)


def override(editor: bpy.types.Area | None = None, kind: str = "WINDOW") -> Any:
    """The context of an editor, for operators without a place of their own."""
    editor = editor or area()
    return bpy.context.temp_override(window=window(), area=editor, region=region(kind, editor))


def on_screen(world: Sequence[float], editor: bpy.types.Area | None = None) -> tuple[float, float]:
    """Pixels of a place in the scene, as a 3D view shows it."""
    editor = editor or area()
    shown = region("WINDOW", editor)
    place = location_3d_to_region_2d(shown, editor.spaces.active.region_3d, world)
    assert place is not None, f"{world} lies behind the view"
    return shown.x + place.x, shown.y + place.y


def look(axis: str = "FRONT", things: Sequence[bpy.types.Object] = (), editor: bpy.types.Area | None = None) -> Turns:
    """Turn a 3D view and frame some objects in it, or all that is there; what was selected stays so."""
    editor = editor or area()
    chosen, active = [thing for thing in bpy.data.objects if thing.select_get()], bpy.context.view_layer.objects.active
    with override(editor):
        bpy.ops.view3d.view_axis(type=axis)
        if things:
            for thing in bpy.data.objects:
                thing.select_set(thing in things)
            bpy.ops.view3d.view_selected()
            for thing in bpy.data.objects:
                thing.select_set(thing in chosen)
            bpy.context.view_layer.objects.active = active
        else:
            bpy.ops.view3d.view_all()
    yield from wait()


# Mouse and keys.


def _simulate(kind: str, value: str, **more: Any) -> None:
    window().event_simulate(type=kind, value=value, x=_mouse[0], y=_mouse[1], **more)


def move(x: float, y: float) -> Turns:
    """Move the mouse; twice, for the first move only makes the region under it the active one."""
    _mouse[:] = round(x), round(y)
    for _ in range(2):
        _simulate("MOUSEMOVE", "NOTHING")
        yield


def click(x: float, y: float, button: str = "LEFTMOUSE", **modifiers: bool) -> Turns:
    """Click; modifiers are shift, ctrl, alt, oskey."""
    yield from move(x, y)
    _simulate(button, "PRESS", **modifiers)
    yield
    _simulate(button, "RELEASE", **modifiers)
    yield from wait(3)


def drag(
    start: Sequence[float], end: Sequence[float], steps: int = 8, button: str = "LEFTMOUSE", **modifiers: bool
) -> Turns:
    """Press, move in a straight line, release."""
    yield from move(*start)
    _simulate(button, "PRESS", **modifiers)
    yield
    for step in range(1, steps + 1):
        _mouse[:] = (round(a + (b - a) * step / steps) for a, b in zip(start, end, strict=True))
        _simulate("MOUSEMOVE", "NOTHING", **modifiers)
        yield
    _simulate(button, "RELEASE", **modifiers)
    yield from wait(3)


def hold(start: Sequence[float], end: Sequence[float], button: str = "LEFTMOUSE") -> Turns:
    """Press and move, without a release."""
    yield from move(*start)
    _simulate(button, "PRESS")
    yield
    yield from move(*end)
    yield from wait(3)


def let_go(button: str = "LEFTMOUSE") -> Turns:
    """Release what is held."""
    _simulate(button, "RELEASE")
    yield from wait(3)


def key(kind: str, **modifiers: Any) -> Turns:
    """Press and release a key where the mouse is."""
    _simulate(kind, "PRESS", **modifiers)
    yield
    _simulate(kind, "RELEASE", **{name: value for name, value in modifiers.items() if name != "unicode"})
    yield from wait(3)


def write(text: str) -> Turns:
    """Type into the field that has the keyboard; ends without RET."""
    for letter in text:
        yield from key("A", unicode=letter)


def undo() -> Turns:
    """Ctrl Z over the 3D view."""
    yield from over_view()
    yield from key("Z", ctrl=True)


def redo() -> Turns:
    """Shift Ctrl Z over the 3D view."""
    yield from over_view()
    yield from key("Z", ctrl=True, shift=True)


def over_view() -> Turns:
    """Move the mouse over the 3D view."""
    shown = region()
    yield from move(shown.x + 0.5 * shown.width, shown.y + 20)


# Buttons. Python knows no button's place, but Blender copies the command of the button under the mouse.


def open_tab(name: str = "Retarget", editor: bpy.types.Area | None = None) -> Turns:
    """Show the sidebar of a 3D view with one of its tabs."""
    editor = editor or area()
    editor.spaces.active.show_region_ui = True
    yield from wait()  # the tab can only be chosen once the region was drawn
    sidebar = region("UI", editor)
    sidebar.active_panel_category = name
    sidebar.tag_redraw()
    yield from wait()
    assert sidebar.active_panel_category == name, f"there is no tab {name}"


def button_under_mouse(shown: bpy.types.Region, editor: bpy.types.Area) -> str:
    """What the button under the mouse does: 'wm.call_menu(name="...")' or the path of its property; "" for none."""
    manager = bpy.data.window_managers[0]
    manager.clipboard = ""
    with bpy.context.temp_override(window=window(), area=editor, region=shown):
        for copy in (bpy.ops.ui.copy_python_command_button, bpy.ops.ui.copy_data_path_button):
            if copy.poll():
                copy()
                if manager.clipboard:
                    return manager.clipboard.removeprefix("bpy.ops.").replace("'", '"')
    return ""


def buttons(
    kind: str = "UI", editor: bpy.types.Area | None = None, across: Sequence[float] = ACROSS, wanted: str = ""
) -> Turns:
    """What the buttons of a region do -> (x, y), for all that the mouse finds; it stops at one that does `wanted`."""
    editor = editor or area()
    shown = region(kind, editor)
    step = 14 * bpy.context.preferences.system.ui_scale  # a button is 20 high
    found: dict[str, tuple[float, float]] = {}
    yield from move(shown.x + 0.5 * shown.width, shown.y + shown.height - 2)
    for share in across:
        for row in range(1, int(shown.height / step)):
            _mouse[:] = round(shown.x + share * (shown.width - 20)), round(shown.y + shown.height - row * step)
            _simulate("MOUSEMOVE", "NOTHING")
            yield
            what = button_under_mouse(shown, editor)
            if what:
                found.setdefault(what, (_mouse[0], _mouse[1]))
                if wanted and wanted in what:
                    # A busy window may still tell of the row before.
                    x, y = found[what]
                    yield from move(x, y)
                    late = wanted not in button_under_mouse(shown, editor)
                    return found | {what: (x, y + late * step)}
    return found


def middle_of(what: str, place: tuple[float, float], kind: str = "UI", editor: bpy.types.Area | None = None) -> Turns:
    """The middle, from top to bottom, of a button that was found at a place: a search stops at its first row."""
    editor = editor or area()
    shown = region(kind, editor)
    rows = []
    for row in range(-14, 15):
        yield from move(place[0], place[1] + row)
        if what in button_under_mouse(shown, editor):
            rows.append(row)
    assert rows, f"no button near {place} does {what}"
    return place[0], place[1] + 0.5 * (rows[0] + rows[-1])


def find_button(
    what: str, kind: str = "UI", editor: bpy.types.Area | None = None, across: Sequence[float] = ACROSS
) -> Turns:
    """The place of a button whose command or property path holds `what`; scrolls down if it must.

    Parameters
    ----------
    across : where to look, as shares of the region's width.
    """
    shown = region(kind, editor)
    seen: set[str] = set()
    for _ in range(6):
        found = yield from buttons(kind, editor, across, what)
        for command, place in found.items():
            if what in command:
                return place
        if found.keys() <= seen:
            break
        seen |= found.keys()
        yield from scroll(shown)
    raise AssertionError(f"no button does {what}; there are {sorted(seen)}")


def press_button(what: str, kind: str = "UI", editor: bpy.types.Area | None = None) -> Turns:
    """Press a button with the mouse, found by its operator ("facial_retarget.retarget") or its property."""
    x, y = yield from find_button(what, kind, editor)
    yield from click(x, y)


def open_section(title: str, tab: str = "Retarget", editor: bpy.types.Area | None = None) -> Turns:
    """Open one panel of the sidebar and close the others."""
    editor = editor or area()
    shown = panels(tab, editor)
    place = [panel.bl_label for panel in shown].index(title)
    parents = {getattr(panel, "bl_parent_id", "") for panel in bpy.types.Panel.__subclasses__()}
    # Ctrl and a click on a header close all other panels; on that of a panel with children they open and close those.
    childless = next(i for i, panel in enumerate(shown) if panel.__name__ not in parents)
    with override(editor, "UI"):
        bpy.ops.view2d.reset()
    yield from wait()
    yield from click(*headers(editor)[childless], ctrl=True)
    yield from still()
    for other in (childless, place):
        if _is_open(other, editor) != (other == place):
            yield from click(*headers(editor)[other])
            yield from still()
    assert _is_open(place, editor), f"{title} does not open"


def panels(tab: str, editor: bpy.types.Area) -> list[type[bpy.types.Panel]]:
    """The panels with headers that a tab shows, from top to bottom."""
    with override(editor, "UI"):
        found = [
            panel
            for panel in bpy.types.Panel.__subclasses__()
            if getattr(panel, "bl_category", "") == tab
            and not getattr(panel, "bl_parent_id", "")
            and "HIDE_HEADER" not in getattr(panel, "bl_options", ())
            and (not hasattr(panel, "poll") or panel.poll(bpy.context))
        ]
    return sorted(found, key=lambda panel: getattr(panel, "bl_order", 0))


def _is_open(place: int, editor: bpy.types.Area) -> bool:
    """Whether the panel there is open: then the arrow at the left of its header points down, and is wider than high."""
    shown, scale = region("UI", editor), bpy.context.preferences.system.ui_scale
    pixels = picture()
    row, reach = len(pixels) - int(headers(editor)[place][1]), int(9 * scale)
    left = int(shown.x + 6 * scale)
    arrow = pixels[row - reach : row + reach, left : left + int(16 * scale)].astype(int)
    down, across = np.nonzero(arrow - np.median(arrow) > 80)  # a line of the scene shines through at less
    return np.ptp(across) > np.ptp(down)


def headers(editor: bpy.types.Area) -> list[tuple[float, float]]:
    """Places of the headers of the sidebar's panels from top to bottom, seen by the dots at their right ends."""
    shown = region("UI", editor)
    pixels = picture()[:, shown.x : shown.x + shown.width]
    scale = bpy.context.preferences.system.ui_scale
    # The tabs stand at the right of the panels, the question mark of the manual at the left of the dots.
    dots = pixels[:, int(shown.width - 50 * scale) : int(shown.width - 30 * scale)].astype(int)
    bright = (np.abs(dots - np.median(dots, axis=1, keepdims=True)) > 20).sum(axis=1)
    plain = bright == 0
    rows = [
        row
        for row in range(4, len(bright) - 8)
        if 4 <= bright[row] <= 9 and 4 <= bright[row + 3] <= 9 and plain[row - 4 : row].all() and plain[row + 6]
    ]
    inside = [row for row in rows if shown.y < len(pixels) - row < shown.y + shown.height]
    return [(shown.x + 0.5 * shown.width, len(pixels) - row - 2) for row in inside]


def scroll(shown: bpy.types.Region, turns: int = 10) -> Turns:
    """Turn the mouse's wheel over a region."""
    yield from move(shown.x + 0.5 * shown.width, shown.y + 0.5 * shown.height)
    for _ in range(turns):
        _simulate("WHEELDOWNMOUSE", "PRESS")
        yield
    yield from wait()


def search(label: str) -> Turns:
    """Call an operator as an artist does who does not know where its button is: F3, its name, Return."""
    yield from over_view()
    yield from key("F3")
    yield from write(label)
    yield from wait()
    yield from key("RET")
    yield from wait()


# Pictures.


def screenshot(name: str) -> Path:
    """A picture of the whole window; Blender's own screenshot is black on a screen in memory."""
    path = OUT / f"{name}.png"
    subprocess.run(["import", "-window", "root", path], check=True)
    log("screenshot", path)
    return path


def illustrate(name: str, width: int = 0, height: int = 0, right: int = 0, top: int = 0) -> None:
    """A picture for the pages in docs, of few colours: the whole window, or a part of it.

    Parameters
    ----------
    width, height : of the part, in pixels; 0 for the whole window.
    right, top : how far it is from the window's edges there.
    """
    (OUT / "docs").mkdir(exist_ok=True)
    part = ["-gravity", "NorthEast", "-crop", f"{width}x{height}+{right}+{top}", "+repage"] if width else []
    few = ["-dither", "None", "-colors", "128", "-define", "png:compression-level=9"]
    subprocess.run(["magick", screenshot(name), *part, *few, f"PNG8:{OUT / 'docs' / name}.png"], check=True)


def picture() -> np.ndarray:
    """(height, width) uint8: how bright the window's pixels are, the top row first."""
    raw = subprocess.run(["import", "-window", "root", "-depth", "8", "gray:-"], check=True, stdout=subprocess.PIPE)
    shown = window()
    return np.frombuffer(raw.stdout, np.uint8).reshape(shown.height, shown.width)


def still(seconds: float = 0.4) -> Turns:
    """Give Blender turns until its window has looked the same for a while: panels slide to their places."""
    before, since = picture(), monotonic()
    while monotonic() < since + seconds:
        yield from wait(3)
        now = picture()
        if (now != before).any():
            before, since = now, monotonic()
