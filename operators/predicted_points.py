"""Feature points that are predicted: guessed, accepted, mirrored, cleared away, or wanted again."""

from typing import Any

from bpy.props import EnumProperty, StringProperty
from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import told
from .errors import tells_user
from .in_steps import InSteps
from .polls import OnFace, OnPoints, OnProposals

SURE = 0.4
"""A face that is found with less confidence than this may be none."""


class FACIAL_RETARGET_OT_guess_points(OnFace, InSteps, Operator):
    """Propose all missing feature points: by those that are placed, or by the shape of the head alone; Esc stops"""

    bl_idname = "facial_retarget.guess_points"
    bl_label = "Guess Points"
    bl_options = {"REGISTER", "UNDO"}
    doing = "Guessing"

    def steps(self, context: Context) -> Any:
        """Look for the face, then propose."""
        from ..facial_retarget_addon.bridge.points.point_prediction import guess_steps

        self._thing = context.active_object
        return guess_steps(self._thing)

    def finish(self, result: float) -> None:
        """Say how sure it is."""
        count = len(self._thing.facial_retarget.proposals)
        if result < SURE:
            self.report({"WARNING"}, told(f"{count} points proposed, but {self._thing.name} hardly looks like a face"))
        else:
            self.report({"INFO"}, told(f"{count} points proposed: move what is wrong, then accept them"))


class FACIAL_RETARGET_OT_mirror_points(OnPoints, Operator):
    """Place the partners of feature points on the other half of the face, through its surface"""

    bl_idname = "facial_retarget.mirror_points"
    bl_label = "Mirror Points"
    bl_options = {"REGISTER", "UNDO"}

    which: EnumProperty(
        name="Mirror",
        items=[
            ("LEFT", "Left to Right", "From the half that is the subject's left to the other one"),
            ("RIGHT", "Right to Left", "From the half that is the subject's right to the other one"),
            ("CHOSEN", "Chosen Point", "From the point that is chosen in the list to its partner"),
        ],
        description="Which points are mirrored; their partners are moved if they are placed",
    )

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Mirror them."""
        from ..facial_retarget_addon.bridge.points.point_prediction import mirror_points, names_to_mirror

        thing = context.active_object
        placed = mirror_points(thing, names_to_mirror(thing, self.which))
        self.report({"INFO"}, told(f"{len(placed)} points mirrored"))
        return {"FINISHED"}


class FACIAL_RETARGET_OT_accept_point(OnProposals, Operator):
    """Place one proposed feature point where it is proposed"""

    bl_idname = "facial_retarget.accept_point"
    bl_label = "Accept Point"
    bl_options = {"REGISTER", "UNDO"}

    name: StringProperty(name="Name", description="The proposed point; empty for the one that is chosen in the list")

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Place it, and predict the others anew."""
        from ..facial_retarget_addon.bridge.points.point_prediction import accept_proposals, chosen_proposal

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
        from ..facial_retarget_addon.bridge.points.point_prediction import accept_proposals

        count = accept_proposals(context.active_object)
        self.report({"INFO"}, told(f"{count} feature points accepted"))
        return {"FINISHED"}


class FACIAL_RETARGET_OT_clear_proposals(OnProposals, Operator):
    """Forget all proposed feature points; those that are placed stay"""

    bl_idname = "facial_retarget.clear_proposals"
    bl_label = "Clear Proposals"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: Context) -> set[str]:
        """Forget them."""
        from ..facial_retarget_addon.bridge.points.points import read_proposals, write_proposals

        thing = context.active_object
        write_proposals(thing, read_proposals(thing).subset([]))
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
        from ..facial_retarget_addon.bridge.points.point_prediction import update_predictions
        from ..facial_retarget_addon.bridge.points.points import want_point

        want_point(context.active_object, self.name)
        update_predictions(context.active_object)
        return {"FINISHED"}
