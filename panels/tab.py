"""Where the panels stand."""


class RetargetTab:
    """A panel in the Retarget tab of the 3D View's sidebar."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Retarget"
