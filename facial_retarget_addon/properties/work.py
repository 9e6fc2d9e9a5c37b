"""Long work that is under way."""

from bpy.props import BoolProperty, FloatProperty, StringProperty
from bpy.types import PropertyGroup


class FACIAL_RETARGET_PG_work(PropertyGroup):
    """Long work that is under way: what the panel shows of it, and how its button stops it."""

    running: BoolProperty(name="Running", description="Whether something is being computed")
    stop: BoolProperty(name="Stop", description="Whether the artist has asked to stop")
    doing: StringProperty(name="Doing", description="What is being computed")
    share: FloatProperty(name="Share", min=0.0, max=1.0, description="How much of it is done")
    left: FloatProperty(name="Left", min=0.0, description="Seconds that it still takes, 0 where that is not known")


CLASSES = (FACIAL_RETARGET_PG_work,)
