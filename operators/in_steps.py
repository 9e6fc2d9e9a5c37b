"""Operators whose work comes in steps: modal in a window, all at once in a script."""

from time import monotonic
from typing import Any

from bpy.types import Context, Event

from ..facial_retarget_addon.time_left import TimeLeft, spoken
from ..facial_retarget_addon.translations import filled, told
from .errors import tells_user

TICK, TURN = 0.01, 0.05
"""Seconds that Blender has between two turns of the modal operator, and that a turn takes."""

WHEEL = {"WHEELUPMOUSE", "WHEELDOWNMOUSE", "WHEELLEFTMOUSE", "WHEELRIGHTMOUSE"}
ORBIT = {"MIDDLEMOUSE", "TRACKPADPAN", "TRACKPADZOOM", "MOUSEROTATE", "MOUSESMARTZOOM", "NDOF_MOTION"}
"""Events that move the view and change no data."""
HARMLESS = {"MOUSEMOVE", "INBETWEEN_MOUSEMOVE", "TIMER1", "TIMERREGION", "TIMER_REPORT", "WINDOW_DEACTIVATE"}
"""Events that change nothing anywhere; the first timer is that of views on their way."""


class InSteps:
    """An operator that has two methods: `steps(context)` gives the work as `bridge.background.Steps`, and
    `finish(result)` reports what was made. In a window the steps go on while it stays alive: the artist may look
    around, and change nothing.
    """

    doing = "Working"
    """What the status bar and the panel say."""
    _steps = None

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Run in steps. In background Blender calls `execute` instead."""
        return self.start(context)

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """All at once, for scripts."""
        from ..facial_retarget_addon.bridge.background import finished

        return self._finished(finished(self.steps(context)))

    def start(self, context: Context) -> set[str]:
        """Begin to run in steps, so that the window stays alive."""
        self._steps = self.steps(context)
        self._left = TimeLeft(monotonic())
        work = context.window_manager.facial_retarget
        work.running, work.stop, work.doing, work.share, work.left = True, False, self.doing, 0.0, 0.0
        self._timer = context.window_manager.event_timer_add(TICK, window=context.window)
        context.window_manager.progress_begin(0, 100)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: Context, event: Event) -> set[str]:
        """A turn for each tick of the timer; what might change data waits until the end."""
        if event.type == "ESC" or context.window_manager.facial_retarget.stop:
            self.cancel(context)
            self.report({"INFO"}, "Stopped: nothing was changed")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"} if may_pass(context, event) else {"RUNNING_MODAL"}
        result = {"CANCELLED"}
        try:
            result = self._turn(context)
        finally:
            if result != {"RUNNING_MODAL"}:
                self.cancel(context)
        return result

    @tells_user
    def _turn(self, context: Context) -> set[str]:
        end = monotonic() + TURN
        while monotonic() < end:
            try:
                share, what = next(self._steps)
            except StopIteration as stop:
                return self._finished(stop.value)
        self._left.see(share, monotonic())
        self._show(context, share, what)
        return {"RUNNING_MODAL"}

    def _show(self, context: Context, share: float, what: str) -> None:
        work = context.window_manager.facial_retarget
        work.share, work.left = share, self._left.seconds
        text, fields = spoken(work.left)
        left = f", {filled(text, **fields)}" if text else ""
        stops = filled("Esc stops")
        context.workspace.status_text_set(f"{filled(self.doing)} {share:.0%}: {told(what)}{left} ({stops})")
        context.window_manager.progress_update(100 * share)
        _redraw_sidebars(context)

    def cancel(self, context: Context) -> None:
        """Stop what runs, and give the window back; also called by Blender when it closes the file or its browser."""
        if self._steps is None:
            return
        self._steps.close()
        self._steps = None
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.window_manager.facial_retarget.running = False
        context.workspace.status_text_set(None)
        _redraw_sidebars(context)

    def _finished(self, result: Any) -> set[str]:
        self.finish(result)
        return {"FINISHED"}


def may_pass(context: Context, event: Event) -> bool:
    """Whether an event moves a 3D view, or reaches the sidebar of the panels, where only the button to stop is left."""
    if event.type in HARMLESS:
        return True
    kind, category = region_under(context, event)
    if kind == "UI":
        return event.type == "LEFTMOUSE" and category == "Retarget"
    # With Alt the wheel changes the scene's frame.
    return kind == "WINDOW" and (event.type in ORBIT or (event.type in WHEEL and not event.alt))


def region_under(context: Context, event: Event) -> tuple[str, str]:
    """Kind of the 3D view's region that is under the mouse, and its panels' category; "" where there is none."""
    found = ("", "")
    for area in context.screen.areas:
        for region in area.regions if area.type == "VIEW_3D" else ():
            inside = 0 <= event.mouse_x - region.x < region.width and 0 <= event.mouse_y - region.y < region.height
            # The window's region lies below all others.
            if inside and (not found[0] or region.type != "WINDOW"):
                found = (region.type, region.active_panel_category if region.type == "UI" else "")
    return found


def _redraw_sidebars(context: Context) -> None:
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            for region in area.regions if area.type == "VIEW_3D" else ():
                if region.type == "UI":
                    region.tag_redraw()


class FromBrowser:
    """For operators in steps that ask for a file first. Stands before the helper that asks, `InSteps` after it."""

    browsing = False

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Ask for the file; Blender then calls `execute`."""
        self.browsing = True
        return super().invoke(context, event)

    def execute(self, context: Context) -> set[str]:
        """In steps once the file was chosen, at once in a script or when the artist changes the settings afterwards."""
        if self.browsing:
            self.browsing = False
            return self.start(context)
        return super().execute(context)
