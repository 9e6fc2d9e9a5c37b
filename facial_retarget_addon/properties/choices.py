"""What several groups share: which objects may be chosen, what the live preview is told, names as artists read them."""

from collections.abc import Callable

from bpy.types import Context, Object, PropertyGroup

from ..preview_state import STATE


def is_mesh(_: PropertyGroup, candidate: Object) -> bool:
    """Polls a pointer: only meshes."""
    return candidate.type == "MESH"


def tell(what: str) -> Callable[[PropertyGroup, Context], None]:
    """Tells the live preview that a property was changed: its faces, or settings."""
    return lambda _, __: STATE.tell(what)


def label(name: str) -> str:
    """A name of the core as an artist reads it."""
    return name.replace("_", " ").title()
