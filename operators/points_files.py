"""Load and save the feature points of the active face."""

from pathlib import Path

from bpy.props import StringProperty
from bpy.types import Context, Operator
from bpy_extras.io_utils import ExportHelper, ImportHelper

from ..facial_retarget_addon.translations import told
from .errors import tells_user
from .polls import OnFace, OnPoints


class FACIAL_RETARGET_OT_load_points(OnFace, Operator, ImportHelper):
    """Replace the feature points of the active face by those of a file"""

    bl_idname = "facial_retarget.load_points"
    bl_label = "Load Feature Points"
    bl_options = {"REGISTER", "UNDO"}

    filename_ext = ".json"
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Read, check against the mesh, then replace."""
        from ..facial_retarget_addon.bridge.meshes import neutral_mesh
        from ..facial_retarget_addon.bridge.points.point_prediction import update_predictions
        from ..facial_retarget_addon.bridge.points.points import write_points
        from ..facial_retarget_addon.files.points import read_points

        thing = context.active_object
        points = read_points(Path(self.filepath), neutral_mesh(thing))
        write_points(thing, points)
        update_predictions(thing)
        self.report({"INFO"}, told(f"{len(points)} feature points on {thing.name}"))
        return {"FINISHED"}


class FACIAL_RETARGET_OT_save_points(OnPoints, Operator, ExportHelper):
    """Save the feature points of the active face to a file; what is only proposed is left out"""

    bl_idname = "facial_retarget.save_points"
    bl_label = "Save Feature Points"
    missing = "The face has no feature points"

    filename_ext = ".json"
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Write the file, whole or not at all."""
        from ..facial_retarget_addon.bridge.points.points import read_points
        from ..facial_retarget_addon.files.points import write_points

        thing = context.active_object
        points = read_points(thing)
        write_points(points, Path(self.filepath), len(thing.data.vertices))
        self.report({"INFO"}, told(f"{len(points)} feature points saved"))
        return {"FINISHED"}
