"""Feature points that are predicted: accepted, cleared away, or wanted again."""

from bpy.props import StringProperty
from bpy.types import Context, Operator

from .errors import tells_user
from .polls import OnFace, OnProposals


class FACIAL_RETARGET_OT_accept_point(OnProposals, Operator):
    """Place one proposed feature point where it is proposed"""

    bl_idname = "facial_retarget.accept_point"
    bl_label = "Accept Point"
    bl_options = {"REGISTER", "UNDO"}

    name: StringProperty(name="Name", description="The proposed point; empty for the one that is chosen in the list")

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Place it, and predict the others anew."""
        from ..facial_retarget_addon.bridge.point_prediction import accept_proposals, chosen_proposal

        thing = context.active_object
        accept_proposals(thing, [self.name or chosen_proposal(thing)])
        return {"FINISHED"}


class FACIAL_RETARGET_OT_accept_points(OnProposals, Operator):
    """Place all proposed feature points where they are proposed"""

    bl_idname = "facial_retarget.accept_points"
    bl_label = "Accept All"
    bl_options = {"REGISTER", "UNDO"}

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Place them all."""
        from ..facial_retarget_addon.bridge.point_prediction import accept_proposals

        count = accept_proposals(context.active_object)
        self.report({"INFO"}, f"{count} feature points accepted")
        return {"FINISHED"}


class FACIAL_RETARGET_OT_clear_proposals(OnProposals, Operator):
    """Forget all proposed feature points; those that are placed stay"""

    bl_idname = "facial_retarget.clear_proposals"
    bl_label = "Clear Proposals"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: Context) -> set[str]:
        """Forget them."""
        context.active_object.facial_retarget.proposals.clear()
        return {"FINISHED"}


class FACIAL_RETARGET_OT_want_point(OnFace, Operator):
    """Take back that the face does without this feature point"""

    bl_idname = "facial_retarget.want_point"
    bl_label = "Want Point"
    bl_options = {"REGISTER", "UNDO"}

    name: StringProperty(name="Name", description="The skipped point")

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Take it back, and propose the point."""
        from ..facial_retarget_addon.bridge.point_prediction import update_predictions
        from ..facial_retarget_addon.bridge.points import want_point

        want_point(context.active_object, self.name)
        update_predictions(context.active_object)
        return {"FINISHED"}
