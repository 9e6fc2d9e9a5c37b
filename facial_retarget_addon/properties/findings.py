"""Baked frames and cloned shape keys that are in trouble."""

from bpy.props import EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy.types import PropertyGroup


class FACIAL_RETARGET_PG_finding(PropertyGroup):
    """A baked frame or a cloned shape key that is in trouble. `name` is inherited."""

    kind: EnumProperty(
        name="Kind",
        items=[("FRAME", "Frame", "A baked frame"), ("KEY", "Shape Key", "A cloned shape key")],
        description="What is in trouble",
    )
    frame: FloatProperty(name="Frame", description="The scene frame")
    note: StringProperty(name="Figures", description="What is wrong, in words")
    trouble: FloatProperty(name="Trouble", description="All figures together, by which the worst come first")
    torn: IntProperty(name="Torn Edges", description="Edges stretched beyond 3 times where the source is calm")
    turned: IntProperty(name="Turned Triangles", description="Triangles that look inwards where the source's do not")
    lip_gap: FloatProperty(name="Lip Gap", description="More than the source's, in percent of the mouth's width")
    lid_gap: FloatProperty(name="Lid Gap", description="More than the source's, in percent of the eye's opening")
    torn_vertices: StringProperty(name="Torn Vertices", description="Vertices of the torn edges, packed")
    turned_vertices: StringProperty(name="Turned Vertices", description="Vertices of the turned triangles, packed")
    lip_vertices: StringProperty(name="Lip Vertices", description="Vertices of lips that gape, packed")
    lid_vertices: StringProperty(name="Lid Vertices", description="Vertices of lids that gape, packed")


CLASSES = (FACIAL_RETARGET_PG_finding,)
