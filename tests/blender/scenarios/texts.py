"""Every operator, panel, property and choice has a name in Blender's spelling and a tooltip."""

from collections.abc import Iterator

import bpy
from stage import NAME, enable

SMALL = {"a", "an", "and", "as", "at", "by", "for", "from", "in", "of", "on", "or", "per", "the", "to", "with", "px"}
enable()
wrong: list[str] = []


def classes(base: type) -> Iterator[type]:
    """Our registered classes of a kind."""
    for kind in base.__subclasses__():
        yield from classes(kind)
        if kind.__module__.startswith(NAME) and kind.__name__.startswith("FACIAL_RETARGET_"):
            yield kind


def check_name(where: str, name: str) -> None:
    """A name is there, in Title Case."""
    small = [word for word in name.split() if word[0].islower() and word not in SMALL and word.islower()]
    if not name or small or (name[0].islower() and not name.startswith("glTF")):
        wrong.append(f"{where}: the name {name!r} is not in Title Case")


def check_tip(where: str, text: str) -> None:
    """A tooltip is there; Blender adds the full stop."""
    if not text or text.endswith("."):
        wrong.append(f"{where}: the tooltip {text!r} is missing or ends with a full stop")


def check_property(where: str, found: bpy.types.Property) -> None:
    """A property and its choices."""
    check_name(where, found.name)
    check_tip(where, found.description)
    for item in found.enum_items if found.type == "ENUM" else ():
        check_name(f"{where} {item.identifier}", item.name)
        check_tip(f"{where} {item.identifier}", item.description)


def is_group(found: bpy.types.Property) -> bool:
    """Whether a property holds others, and is never drawn itself."""
    return found.type == "COLLECTION" or (
        found.type == "POINTER" and found.fixed_type.identifier.startswith("FACIAL_RETARGET_PG")
    )


def own_properties(kind: type, rna: bpy.types.Struct) -> Iterator[bpy.types.Property]:
    """The properties that our classes declare; those of Blender's helpers have Blender's texts."""
    for base in kind.__mro__:
        for name in getattr(base, "__annotations__", ()) if base.__module__.startswith(NAME) else ():
            found = rna.properties.get(name)
            if found is not None and not found.is_hidden and not is_group(found):
                yield found


for kind in classes(bpy.types.Operator):
    rna = getattr(bpy.ops.facial_retarget, kind.bl_idname.partition(".")[2]).get_rna_type()
    check_name(kind.__name__, rna.name)
    check_tip(kind.__name__, rna.description)
    for found in own_properties(kind, rna):
        check_property(f"{kind.__name__}.{found.identifier}", found)
for kind in classes(bpy.types.PropertyGroup):
    for found in own_properties(kind, kind.bl_rna):
        check_property(f"{kind.__name__}.{found.identifier}", found)
for kind in classes(bpy.types.Panel):
    check_name(kind.__name__, kind.bl_label.lstrip("123456. "))
assert not wrong, "\n".join(wrong)
