"""Earlier bakes of the target: played again, removed."""

from bpy.props import IntProperty
from bpy.types import Context, Operator

from ..facial_retarget_addon.translations import filled
from .errors import tells_user
from .polls import has_target, in_mode


class OnBakes:
    """For operators on the bakes of the target."""

    number: IntProperty(
        name="Number", description="Which kept bake; 0 for the one that plays", min=0, options={"SKIP_SAVE"}
    )

    @classmethod
    def poll(cls, context: Context) -> bool:
        """A target must be chosen and have a bake."""
        if not has_target(cls, context):
            return False
        target = context.scene.facial_retarget.target
        if not target.facial_retarget.bake and not len(target.facial_retarget.kept_bakes):
            cls.poll_message_set(filled("The target has no bake"))
            return False
        return in_mode(cls, context)


class FACIAL_RETARGET_OT_play_bake(OnBakes, Operator):
    """Play this earlier bake again; the one that plays now is kept, and a live preview ends"""

    bl_idname = "facial_retarget.play_bake"
    bl_label = "Play Bake"
    bl_options = {"REGISTER", "UNDO"}

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Turn one on and the other off."""
        from ..facial_retarget_addon.bridge.bakes.kept import play_bake
        from ..facial_retarget_addon.bridge.heads import head_parts
        from ..facial_retarget_addon.bridge.preview.preview import stop_preview

        target = context.scene.facial_retarget.target
        stop_preview()
        play_bake([target, *head_parts(target)], self.number)
        return {"FINISHED"}


class FACIAL_RETARGET_OT_remove_bake(OnBakes, Operator):
    """Remove this bake: its shape keys, curves and modifiers; files of a cache stay, and other bakes"""

    bl_idname = "facial_retarget.remove_bake"
    bl_label = "Remove Bake"
    bl_options = {"REGISTER", "UNDO"}

    @tells_user
    def execute(self, context: Context) -> set[str]:
        """Remove the one that plays, or a kept one."""
        from ..facial_retarget_addon.bridge.bakes.kept import remove_kept_bake, remove_playing_bake
        from ..facial_retarget_addon.bridge.heads import head_parts

        target = context.scene.facial_retarget.target
        things = [target, *head_parts(target)]
        if self.number:
            remove_kept_bake(things, self.number)
        else:
            remove_playing_bake(things)
        return {"FINISHED"}
