"""Operators whose work comes in steps: modal in a window, all at once in a script."""

from time import monotonic
from typing import Any

from bpy.types import Context, Event

from .errors import tells_user

TICK, TURN = 0.01, 0.1
"""Seconds that Blender has between two turns of the modal operator, and that a turn takes."""


class InSteps:
    """An operator that has two methods: `steps(context)` gives the work as `bridge.background.Steps`, and
    `finish(result)` reports what was made. In a window the steps go on while it stays alive.
    """

    doing = "Working"
    """What the status bar says."""
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
        self._timer = context.window_manager.event_timer_add(TICK, window=context.window)
        context.window_manager.progress_begin(0, 100)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: Context, event: Event) -> set[str]:
        """A turn for each tick of the timer; nothing else gets through until the end."""
        if event.type == "ESC":
            self.cancel(context)
            self.report({"INFO"}, "Stopped: nothing was changed")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
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
        context.window_manager.progress_update(100 * share)
        context.workspace.status_text_set(f"{self.doing} {share:.0%}: {what} (Esc stops)")
        return {"RUNNING_MODAL"}

    def cancel(self, context: Context) -> None:
        """Stop what runs, and give the window back; also called by Blender when it closes the file or its browser."""
        if self._steps is None:
            return
        self._steps.close()
        self._steps = None
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)

    def _finished(self, result: Any) -> set[str]:
        self.finish(result)
        return {"FINISHED"}


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
