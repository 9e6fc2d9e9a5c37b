"""Retarget the performance and bake it."""

from time import monotonic

from bpy.types import Context, Event, Operator

from .errors import tells_user
from .polls import OnTask

TICK, TURN = 0.01, 0.1
"""Seconds that Blender has between two turns of the modal operator, and that a turn takes."""


class FACIAL_RETARGET_OT_retarget(OnTask, Operator):
    """Retarget the source's performance and bake it on the target as one shape key per frame; Esc stops"""

    bl_idname = "facial_retarget.retarget"
    bl_label = "Retarget"
    bl_options = {"REGISTER", "UNDO"}

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Run in steps, so that the window stays alive. In background Blender calls `execute` instead."""
        from ..facial_retarget_addon.bridge.retargeting import retarget_steps

        self._steps = retarget_steps(context)
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
                return self._finish(stop.value)
        context.window_manager.progress_update(100 * share)
        context.workspace.status_text_set(f"Retargeting {share:.0%}: {what} (Esc stops)")
        return {"RUNNING_MODAL"}

    def cancel(self, context: Context) -> None:
        """Stop what runs, and give the window back; also called by Blender when it closes the file."""
        self._steps.close()
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """All at once, for scripts."""
        from ..facial_retarget_addon.bridge.background import finished
        from ..facial_retarget_addon.bridge.retargeting import retarget_steps

        return self._finish(finished(retarget_steps(context)))

    def _finish(self, report: dict) -> set[str]:
        for warning in report.get("warnings", ()):
            self.report({"WARNING"}, warning)
        self.report({"INFO"}, "Retargeted")
        return {"FINISHED"}
