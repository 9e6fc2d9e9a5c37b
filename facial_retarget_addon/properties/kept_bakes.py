"""Earlier bakes that a face keeps, turned off."""

from bpy.props import IntProperty, PointerProperty, StringProperty
from bpy.types import Action, PropertyGroup


class FACIAL_RETARGET_PG_kept_bake(PropertyGroup):
    """What of an object belongs to an earlier bake of its head. Names stand one a line."""

    name: StringProperty(name="Name", description="Name of the earlier bake")
    number: IntProperty(name="Number", description="What the earlier bake is called on every object of the head")
    kind: StringProperty(name="Kind", description="What the frames became")
    keys: StringProperty(name="Shape Keys", description="Names of its shape keys while it plays")
    kept: StringProperty(name="Kept Shape Keys", description="Names of the same shape keys now, muted")
    moved: StringProperty(name="Own Shape Keys", description="Names of the object's own shape keys that it moves")
    action: PointerProperty(name="Kept Action", type=Action, description="Its curves while it does not play")
    slot: StringProperty(name="Kept Slot", description="The slot of the action that has the object's curves")
    modifier: StringProperty(name="Kept Modifier", description="Name of the modifier that plays its cache, turned off")


CLASSES = (FACIAL_RETARGET_PG_kept_bake,)
