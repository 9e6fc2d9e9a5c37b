"""What registered classes say has an entry in every language, and no entry is left over; Blender knows ours."""

import ast
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import bpy
from stage import NAME, disable, enable, part

enable()
LANGUAGES = part("translations").LANGUAGES
BLENDERS = {field.description for field in bpy.types.PropertyGroup.bl_rna.properties}
"""What Blender says of the properties that every group has."""


def classes(base: type) -> Iterator[type]:
    """Our registered classes of a kind."""
    for kind in base.__subclasses__():
        yield from classes(kind)
        if kind.__module__.startswith(NAME) and kind.__name__.startswith("FACIAL_RETARGET_"):
            yield kind


def is_group(found: bpy.types.Property) -> bool:
    """Whether a property holds others, and is never drawn itself."""
    return found.type == "COLLECTION" or (
        found.type == "POINTER" and found.fixed_type.identifier.startswith("FACIAL_RETARGET_PG")
    )


def property_texts(kind: type, rna: bpy.types.Struct) -> Iterator[str]:
    """Names, tooltips and choices of the properties that our classes declare."""
    for base in kind.__mro__:
        for name in getattr(base, "__annotations__", ()) if base.__module__.startswith(NAME) else ():
            found = rna.properties.get(name)
            if found is not None and not found.is_hidden and not is_group(found):
                yield from (found.name, found.description)
                for item in found.enum_items if found.type == "ENUM" else ():
                    yield from (item.name, item.description)


def registered() -> Iterator[str]:
    """All texts of classes that Blender shows by itself."""
    for kind in classes(bpy.types.Operator):
        rna = getattr(bpy.ops.facial_retarget, kind.bl_idname.partition(".")[2]).get_rna_type()
        yield from (rna.name, rna.description)
        yield from property_texts(kind, rna)
    for kind in classes(bpy.types.PropertyGroup):
        yield from property_texts(kind, kind.bl_rna)
    for base in (bpy.types.Panel, bpy.types.Menu):
        yield from (kind.bl_label for kind in classes(base))


def written() -> Iterator[str]:
    """Every text in the code, with {} for each value."""
    root = Path(import_module(NAME).__file__).parent
    for path in (
        found for room in ("facial_retarget_addon", "operators", "panels") for found in root.glob(f"{room}/**/*.py")
    ):
        if "translations" in path.parts:
            continue
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                yield node.value
                yield f"{node.value.removesuffix('_percent').replace('_', ' ')} {{}}"  # a figure in a note
            elif isinstance(node, ast.JoinedStr):
                said = "".join(piece.value if isinstance(piece, ast.Constant) else "{}" for piece in node.values)
                yield said.removeprefix("; ")


def called() -> Iterator[str]:
    """What feature points are called, and where they lie; a meaning may begin a line."""
    sets, fdps = part("core.point_sets"), part("core.mpeg4.fdps").FDPS
    for name in {*sets.POINT_INFOS, *fdps}:
        meaning = sets.point_meaning(name)
        yield from (sets.point_label(name), meaning, meaning[:1].upper() + meaning[1:])


shown = {text for text in registered() if any(letter.isalpha() for letter in text)} - BLENDERS
assert len(shown) > 600, len(shown)
points, code = set(called()), set(written())
for name, texts in LANGUAGES.items():
    missing = sorted((shown | points) - texts.TEXTS.keys())
    assert not missing, f"{name} has no text for\n" + "\n".join(missing)
    stale = sorted(texts.TEXTS.keys() - shown - points - code)
    assert not stale, f"{name} has texts that nothing shows:\n" + "\n".join(stale)
    stale = sorted((texts.SENTENCES.keys() | texts.PHRASES.keys()) - points - code)
    assert not stale, f"{name} has sentences that nothing says:\n" + "\n".join(stale)

# Blender as a module has no languages; tests/gui/scenarios/languages.py looks at a window that has them.
assert part("translations").told("it is so") == "it is so"
disable()
enable()
