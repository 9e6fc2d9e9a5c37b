"""When an operator can run; what is missing stands in its tooltip."""

from bpy.types import Context

from ..facial_retarget_addon.translations import filled


def in_mode(cls: type, context: Context, modes: tuple[str, ...] = ("OBJECT",)) -> bool:
    """Whether nothing is being computed and Blender is in one of the modes; the tooltip says it if not."""
    if context.window_manager.facial_retarget.running:
        cls.poll_message_set(filled("Wait for what is being computed, or stop it with Esc"))
        return False
    if context.mode not in modes:
        cls.poll_message_set(filled("Switch to Object Mode"))
        return False
    return True


def has_target(cls: type, context: Context) -> bool:
    """Whether a target is chosen; the tooltip says it if not."""
    if context.scene.facial_retarget.target is None:
        cls.poll_message_set(filled("Choose a target under Faces"))
        return False
    return True


class OnFace:
    """For operators on the active mesh object."""

    modes = ("OBJECT",)

    @classmethod
    def poll(cls, context: Context) -> bool:
        """A mesh object must be active, in a mode that the operator can work in."""
        if context.active_object is None or context.active_object.type != "MESH":
            cls.poll_message_set(filled("Select a mesh object: the source or the target face"))
            return False
        return in_mode(cls, context, cls.modes)


class OnChosen(OnFace):
    """For operators on what is chosen in a list of the active face."""

    listed, chosen, missing = "points", "active_point", "Choose a feature point in the list"

    @classmethod
    def poll(cls, context: Context) -> bool:
        """As `OnFace`; the list must have a chosen row."""
        if not super().poll(context):
            return False
        face = context.active_object.facial_retarget
        if getattr(face, cls.chosen) not in range(len(getattr(face, cls.listed))):
            cls.poll_message_set(filled(cls.missing))
            return False
        return True


class OnPoints(OnFace):
    """For operators on the active mesh object and its feature points."""

    missing = "Give the face feature points with MPEG-4 names first"

    @classmethod
    def poll(cls, context: Context) -> bool:
        """As `OnFace`; the object must have points."""
        if not super().poll(context):
            return False
        if not len(context.active_object.facial_retarget.points):
            cls.poll_message_set(filled(cls.missing))
            return False
        return True


class OnProposals(OnFace):
    """For operators on the active mesh object and its proposed feature points."""

    @classmethod
    def poll(cls, context: Context) -> bool:
        """As `OnFace`; points must be proposed."""
        if not super().poll(context):
            return False
        if not len(context.active_object.facial_retarget.proposals):
            cls.poll_message_set(filled("No points are proposed: place a few, or press Guess Points"))
            return False
        return True


class OnTask:
    """For operators on source and target."""

    modes = ("OBJECT",)

    @classmethod
    def poll(cls, context: Context) -> bool:
        """Source and target must be chosen, in a mode that the operator can work in."""
        task = context.scene.facial_retarget
        if task.source is None or task.target is None:
            cls.poll_message_set(filled("Choose a source and a target under Faces"))
            return False
        return in_mode(cls, context, cls.modes)


class OnTarget:
    """For operators on the target alone."""

    @classmethod
    def poll(cls, context: Context) -> bool:
        """A target must be chosen, in Object Mode."""
        return has_target(cls, context) and in_mode(cls, context)


class OnCloning:
    """For operators that clone shape keys."""

    @classmethod
    def poll(cls, context: Context) -> bool:
        """What the shapes come from and where they go must be chosen, in Object Mode."""
        task = context.scene.facial_retarget
        if task.cloning.donor == "SOURCE" and task.source is None:
            cls.poll_message_set(filled("Choose a source under Faces, or clone from the built-in actor"))
            return False
        if task.cloning.targets == "TARGET" and task.target is None:
            cls.poll_message_set(filled("Choose a target under Faces, or clone onto the selected heads"))
            return False
        if task.cloning.targets == "SELECTED" and not context.selected_objects:
            cls.poll_message_set(filled("Select the heads that shall get the shapes"))
            return False
        return in_mode(cls, context)
