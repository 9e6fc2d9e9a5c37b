"""Build the base mesh and show it on both faces."""

from bpy.types import Context, Operator

from .errors import tells_user
from .polls import OnTask


class FACIAL_RETARGET_OT_show_base(OnTask, Operator):
    """Build the base mesh from the feature points and show it on both faces, as wire objects"""

    bl_idname = "facial_retarget.show_base"
    bl_label = "Show Base Mesh"
    bl_options = {"REGISTER", "UNDO"}

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Build, then show."""
        from ..facial_retarget_addon.bridge.points.base_object import show_base
        from ..facial_retarget_addon.bridge.task import read_problem
        from ..facial_retarget_addon.core.base.base_mesh import base_mesh

        problem = read_problem(context)
        source, target = problem.source, problem.target
        base = base_mesh(source.mesh, source.points, target.mesh, target.points, problem.base, problem.make_caster)
        task = context.scene.facial_retarget
        for thing in (task.source, task.target):
            show_base(thing, base.names, base.faces)
        for warning in base.warnings:
            self.report({"WARNING"}, warning)
        self.report({"INFO"}, f"Base mesh of {len(base.names)} points and {len(base.faces)} triangles")
        return {"FINISHED"}
