"""Put the feature points of the active face back onto a mesh that has changed."""

from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import told
from .errors import tells_user
from .polls import OnFace

SHOWN = 6
"""Points that a message names."""


class FACIAL_RETARGET_OT_refresh_points(OnFace, Operator):
    """Put the feature points back onto a mesh that was cut or merged, and say which ones lost their surface"""

    bl_idname = "facial_retarget.refresh_points"
    bl_label = "Refresh Points"
    bl_options = {"REGISTER", "UNDO"}

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Refresh, and report."""
        from ..facial_retarget_addon.bridge.points.point_prediction import update_predictions
        from ..facial_retarget_addon.bridge.points.points import refresh_points

        thing = context.active_object
        settled = refresh_points(thing)
        update_predictions(thing)
        said = [f"{thing.name}: {len(thing.facial_retarget.points)} points"]
        if settled.moved:
            worst = sorted(settled.moved, key=settled.moved.get, reverse=True)
            shown = ", ".join(f"{name}: {settled.moved[name]:.3g}" for name in worst[:SHOWN])
            said.append(f"{len(worst)} moved with the surface ({shown}{', ...' if len(worst) > SHOWN else ''})")
        if settled.lost:
            said.append(f"only proposed now, as the surface is gone: {', '.join(settled.lost)}")
        if len(said) == 1:
            said.append("all are where they were")
        self.report({"WARNING" if settled.lost else "INFO"}, told("; ".join(said)))
        return {"FINISHED"}
