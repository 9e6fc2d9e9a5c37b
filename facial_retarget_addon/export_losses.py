"""What a format loses of a head, in words, before anything is written: for the panel, without NumPy and bpy."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from bpy.types import Key, Object, Scene, ShapeKey

FORMATS = {"GLTF": "glTF", "FBX": "FBX", "USD": "USD", "ALEMBIC": "Alembic"}
"""Formats of an export, and how they are called."""
CACHES = {"MESH_CACHE", "MESH_SEQUENCE_CACHE"}
"""Modifiers that play a motion from disk."""
NAMED = 3
"""So many names stand in a sentence; dots and the number of all stand for the others."""
LONGEST = 63
"""Bytes that Blender keeps of a name."""
_ALEMBIC_MARKS = str.maketrans(" .:/", "____")


class Loss(NamedTuple):
    """A sentence, to be translated before its {fields} are filled in."""

    text: str
    fields: dict[str, object] = {}

    def __str__(self) -> str:
        return self.text.format(**self.fields)


UNSAMPLED = Loss("Keyframes that lie between the samples are left out")
"""Where the samples of a frame do not meet all keyframes."""


def export_losses(form: str, face: Object, scene: Scene, points: bool = False) -> list[Loss]:
    """What an export of a head loses; found by exporting and reading back in Blender 4.5, 5.0 and 5.2.

    Parameters
    ----------
    form : of `FORMATS`.
    points : USD shall carry moving vertices instead of shape keys, as Alembic always does.
    """
    things = head_things(face)
    found = list(_left_out_frames(things, scene))
    if form == "ALEMBIC" or points:
        found += _lost_keys(things)
    else:
        found += [*_still(things), *_left_out_modifiers(form, things), *_made_plain(form, things)]
    return [*found, *_of_format(form, things, scene, points)]


def head_things(face: Object) -> list[Object]:
    """A face and the parts of its head."""
    return [face, *(part.thing for part in face.facial_retarget.parts if part.thing and part.thing.users_scene)]


def own_key_names(things: Iterable[Object]) -> list[str]:
    """Names of the shape keys of some objects, each once, without the first one and that of the live preview."""
    return list(dict.fromkeys(key.name for keys in _keyed(things) for key in _own(keys)))


def _keyed(things: Iterable[Object]) -> list[Key]:
    return [thing.data.shape_keys for thing in things if thing.data.shape_keys is not None]


def _own(keys: Key) -> list[ShapeKey]:
    basis = keys.reference_key
    return [key for key in keys.key_blocks if key != basis and key.name != "facial_retarget_preview"]


def usd_names(names: Iterable[str]) -> dict[str, str]:
    """Each name -> one that USD takes: letters, digits and underscores, no digit first, each once.

    Blender's exporter writes an underscore for each other character too, but two keys that become one are both lost.
    """
    made: dict[str, str] = {}
    taken: set[str] = set()
    for name in names:
        safe = "".join(letter if f"_{letter}".isidentifier() else "_" for letter in name)
        safe = safe if safe.isidentifier() else f"_{safe}"
        unique, number = _shortened(safe, LONGEST), 1
        while unique in taken:
            unique, number = f"{_shortened(safe, LONGEST - 4)}_{number:03d}", number + 1
        made[name] = unique
        taken.add(unique)
    return made


def _shortened(name: str, length: int) -> str:
    return name.encode()[:length].decode(errors="ignore")


def _left_out_frames(things: list[Object], scene: Scene) -> Iterator[Loss]:
    """Keyframes outside the scene's range; a frame's key is off at the frames beside it."""
    first, last = scene.frame_start, scene.frame_end
    animated = [keys.animation_data for keys in _keyed(things) if keys.animation_data is not None]
    actions = [animation.action for animation in animated if animation.action is not None]
    # An action that has lost its curves says (0, 0).
    ranges = [ends for ends in (tuple(action.curve_frame_range) for action in actions) if ends[1] > ends[0]]
    if any(start < first - 1 or end > last + 1 for start, end in ranges):
        yield Loss(
            "Only the scene's frames {first} to {last} are exported: the keyframes reach from {start:g} to {end:g}",
            {"first": first, "last": last, "start": min(r[0] for r in ranges), "end": max(r[1] for r in ranges)},
        )


def _lost_keys(things: list[Object]) -> Iterator[Loss]:
    names = own_key_names(things)
    if names:
        yield Loss("Shape keys become moving vertices, without sliders: {names}", {"names": _listed(names)})


def _left_out_modifiers(form: str, things: list[Object]) -> Iterator[Loss]:
    for thing in things:
        shown = [modifier for modifier in thing.modifiers if modifier.show_viewport and modifier.type != "ARMATURE"]
        for cache in (modifier for modifier in shown if modifier.type in CACHES):
            yield Loss(
                "The motion that {modifier} plays on {thing} is lost: {form} takes shape keys only. Bake some, or "
                "export moving vertices",
                {"modifier": cache.name, "thing": thing.name, "form": FORMATS[form]},
            )
        others = [modifier.name for modifier in shown if modifier.type not in CACHES]
        if others:
            yield Loss(
                "{thing} goes without what its modifiers do ({names}): they would cost it its shape keys",
                {"thing": thing.name, "names": _listed(others)},
            )


def _still(things: list[Object]) -> Iterator[Loss]:
    moving = any(modifier.type in {*CACHES, "ARMATURE"} for thing in things for modifier in thing.modifiers)
    if not moving and not own_key_names(things):
        yield Loss("Nothing of {thing} will move: it has no shape keys. Retarget first", {"thing": things[0].name})


def _made_plain(form: str, things: list[Object]) -> Iterator[Loss]:
    """What keys are that a file's keys cannot be, or that few programs take."""
    driven: list[str] = []
    muted: list[str] = []
    beyond: list[str] = []
    for keys in _keyed(things):
        animation = keys.animation_data
        paths = set() if animation is None else {curve.data_path for curve in animation.drivers}
        for key in _own(keys):
            driven += [key.name] if paths and key.path_from_id("value") in paths else []
            muted += [key.name] if key.mute else []
            beyond += [key.name] if key.slider_min < 0 or key.slider_max > 1 else []
    for text, names in (
        ("Driven shape keys become curves: {names}", driven),
        ("Muted shape keys stay at 0: {names}", muted),
        ("{form} carries values below 0 and above 1, and many programs cut them off: {names}", beyond),
    ):
        if names:
            yield Loss(text, {"form": FORMATS[form], "names": _listed(dict.fromkeys(names))})
    for thing in things:
        if thing.data.shape_keys is not None and not thing.data.shape_keys.use_relative:
            yield Loss(
                "The absolute shape keys of {thing} become relative ones with a curve each", {"thing": thing.name}
            )


def _of_format(form: str, things: list[Object], scene: Scene, points: bool) -> Iterator[Loss]:
    if form == "GLTF":
        yield Loss(
            "glTF makes polygons triangles and doubles vertices at the borders of UVs: their number and order change"
        )
        rate, base = scene.render.fps, scene.render.fps_base
        if base != 1:
            yield Loss(
                "glTF counts seconds, and Blender's importer takes this scene's {rate:.3f} frames a second for "
                "{wrong:.3f}",
                {"rate": rate / base, "wrong": rate * base},
            )
    quoted = [name for name in own_key_names(things) if '"' in name] if form == "FBX" else []
    if quoted:
        yield Loss(
            "Blender's newer FBX importer leaves out curves of shape keys that have a \" in their names: {names}",
            {"names": _listed(quoted)},
        )
    layers = [layer.name for thing in things for layer in thing.data.uv_layers]
    if form == "GLTF" and any(name != "UVMap" for name in layers):
        yield Loss("The names of UV maps are lost")
    if form == "USD":
        yield from _renamed("USD calls objects otherwise: {names}", usd_names(thing.name for thing in things))
        yield from _renamed(
            "USD calls shape keys otherwise: {names}", usd_names(() if points else own_key_names(things))
        )
        if any(layer.name != "st" for thing in things for layer in thing.data.uv_layers if layer.active_render):
            yield Loss("The UV map that renders is called st, as USD's programs expect")
    if form == "ALEMBIC":
        names = {thing.name: thing.name.translate(_ALEMBIC_MARKS) for thing in things}
        yield from _renamed("Alembic calls objects otherwise: {names}", names)


def _renamed(text: str, names: dict[str, str]) -> Iterator[Loss]:
    changed = [f"{old} → {new}" for old, new in names.items() if old != new]
    if changed:
        yield Loss(text, {"names": _listed(changed)})


def _listed(names: Iterable[str]) -> str:
    found = list(names)
    return ", ".join(found[:NAMED]) + (f", ... ({len(found)})" if len(found) > NAMED else "")
