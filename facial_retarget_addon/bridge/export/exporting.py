"""A head handed to Blender's exporters, or prepared for the artist's own."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import bpy
from bpy.types import Collection, Context, Object, Scene

from ...core.errors import RetargetError
from ...export_losses import FORMATS, UNSAMPLED, Loss, export_losses, own_key_names, usd_names
from ...files.whole import check_place, written_whole
from ..background import Steps, part
from ..bakes.times import FrameTimes
from ..exporter_files import check_room
from ..heads import head_parts
from ..key_sets import LONGEST, shortened
from ..performance import check_visible, frame_kept
from ..scene.local_views import show_with
from ..scene.selection import select_only, selected_alone
from .copies import copy_head, make_plain, names_lent, remove_copies
from .formats import check_suffix, write_selected
from .key_values import KeyValues, read_key_values, samples_per_frame

COLLECTION = "Export"
"""Where prepared copies lie."""
ENDING = "_export"
"""What their names end in."""
MOST_STRETCHED = 900
"""Blender's limit of a scene's time remapping."""


@dataclass(frozen=True)
class ExportWish:
    """What shall be exported, and how.

    Attributes
    ----------
    form : of `FORMATS`. path : the file.
    samples : of a frame; 0 for as many as meet all keyframes.
    points : USD with moving vertices instead of shape keys, as Alembic always has them.
    lossless : refuse to write what would lose something.
    """

    form: str
    path: Path
    samples: int = 0
    points: bool = False
    lossless: bool = False


@dataclass(frozen=True)
class Exported:
    """What was exported: the file, its scene frames, samples of each."""

    path: Path
    first: int
    last: int
    samples: int


def export_steps(context: Context, face: Object, wish: ExportWish, tell: Callable[[Loss], None]) -> Steps[Exported]:
    """Write a head, over the scene's range, with one of Blender's exporters.

    The exporter gets copies, which are removed whatever happens; the head stays as it is. Closing the steps before the
    exporter runs leaves everything as it was. The file appears whole or not at all.

    Parameters
    ----------
    tell : gets each thing that will be lost, before anything is written.

    Raises
    ------
    RetargetError : for bad input; where the wish is lossless and something would be lost; if the exporter fails.
    """
    check_suffix(wish.form, wish.path)
    check_place(wish.path)
    things, scene = (face, *head_parts(face)), context.scene
    keyed, values = wish.form != "ALEMBIC" and not wish.points, {}
    check_visible((*things, *(_armatures(things) if keyed else ())), context.view_layer)
    first, last = scene.frame_start, scene.frame_end
    needed = samples_per_frame(things)
    samples = wish.samples or needed or 1
    _check_cache_rate(things, wish, samples)
    lost = export_losses(wish.form, face, scene, wish.points)
    lost += [UNSAMPLED] if not needed or samples % needed else []
    for loss in lost:
        tell(loss)
    if wish.lossless and lost:
        raise RetargetError(f"{FORMATS[wish.form]} would lose something of {face.name!r}, and nothing was written")
    times = FrameTimes(first, last, 1 / samples)
    if keyed:
        values = yield from part(read_key_values(context, things, times), 0.0, 0.7)
    yield 0.7, f"Writing {wish.path.name}"
    with _copied(scene, things, times, values if keyed else None, _names(wish.form, things)) as copies:
        _write(context, copies, _armatures(copies) if keyed else [], wish, samples)
    return Exported(wish.path, first, last, samples)


def prepare_steps(context: Context, face: Object, samples: int = 0) -> Steps[list[Object]]:
    """Copies of a head in a collection of their own, for any exporter: plain keys, each with a curve, in one action.

    Those that an earlier call made of the same head are replaced. They are selected afterwards, and shown as boxes: two
    surfaces in one place flicker.

    Parameters
    ----------
    samples : of a frame, in the curves; 0 for as many as meet all keyframes.

    Raises
    ------
    RetargetError : as `read_key_values`.
    """
    things, scene = (face, *head_parts(face)), context.scene
    times = FrameTimes(scene.frame_start, scene.frame_end, 1 / (samples or samples_per_frame(things) or 1))
    values = yield from part(read_key_values(context, things, times), 0.0, 0.9)
    yield 0.9, "Preparing"
    remove_copies([made for made in bpy.data.objects if made.facial_retarget.prepared_from in things])
    copies = copy_head(things, _collection(scene))
    make_plain(things, copies, times, values, {})
    for thing, copy in zip(things, copies, strict=True):
        copy.name = copy.data.name = f"{shortened(thing.name, LONGEST - len(ENDING))}{ENDING}"
        copy.facial_retarget.prepared_from, copy.display_type = thing, "BOUNDS"
        show_with(copy, thing)
    select_only(context.view_layer, copies)
    return copies


def _check_cache_rate(things: Sequence[Object], wish: ExportWish, samples: int) -> None:
    """RetargetError if a cache would play at another pace: USD's samples change the rate by which it finds its time."""
    for thing in things:
        caches = [modifier.name for modifier in thing.modifiers if modifier.type == "MESH_SEQUENCE_CACHE"]
        if caches and wish.points and wish.form == "USD" and samples > 1:
            raise RetargetError(
                f"modifier {caches[0]!r} of object {thing.name!r} plays a cache by the scene's rate, expected 1 sample "
                f"per frame for USD, not {samples}"
            )


def _collection(scene: Scene) -> Collection:
    found = scene.collection.children.get(COLLECTION)
    if found is None:
        found = bpy.data.collections.new(COLLECTION)
        scene.collection.children.link(found)
    return found


def _names(form: str, things: Sequence[Object]) -> dict[str, str]:
    """New names of keys: USD would make one of two that differ in what it does not take."""
    return usd_names(own_key_names(things)) if form == "USD" else {}


@contextmanager
def _copied(
    scene: Scene, things: Sequence[Object], times: FrameTimes, values: KeyValues | None, names: dict[str, str]
) -> Iterator[list[Object]]:
    """Copies that bear the names of some objects, with plain keys where there are values; they are removed again."""
    copies: list[Object] = []
    try:
        copies += copy_head(things, scene.collection)
        if values is not None:
            make_plain(things, copies, times, values, names)
        with names_lent(things, copies):
            yield copies
    finally:
        remove_copies(copies)


def _write(
    context: Context, copies: Sequence[Object], armatures: Sequence[Object], wish: ExportWish, samples: int
) -> None:
    chosen = [*copies, *armatures]
    stretched = samples if wish.form in ("GLTF", "USD") else 1
    with (
        written_whole() as aside,
        _frames_of(context.scene, stretched, wish.form),
        selected_alone(context, chosen),
    ):
        for thing in chosen:
            if not thing.select_get():
                raise RetargetError(
                    f"object {thing.name!r} cannot be selected, expected that it can: exporters ask for it"
                )
        first, last = context.scene.frame_start, context.scene.frame_end
        place = aside.place(wish.path)
        points = (last - first) * samples + 1 if wish.form == "ALEMBIC" or wish.points else 0
        check_room(place, sum(_frame_size(context, copy) * (points or _shapes(copy)) for copy in copies))
        write_selected(wish.form, place, wish.path, first, last, samples, wish.points)


def _shapes(thing: Object) -> int:
    """How many shapes an object has, its neutral among them."""
    keys = getattr(thing.data, "shape_keys", None)
    return 1 if keys is None else len(keys.key_blocks)


def _armatures(things: Sequence[Object]) -> list[Object]:
    """The armatures that move some objects in the viewport, each once."""
    modifiers = [modifier for thing in things for modifier in thing.modifiers if modifier.type == "ARMATURE"]
    return list(dict.fromkeys(one.object for one in modifiers if one.show_viewport and one.object is not None))


def _frame_size(context: Context, thing: Object) -> int:
    """Bytes of an object at one frame, or as one shape, in a file: its vertices, and normals of the artist's own."""
    mesh = thing.evaluated_get(context.evaluated_depsgraph_get()).data
    return 12 * (len(mesh.vertices) + (len(mesh.loops) if mesh.has_custom_normals else 0))


@contextmanager
def _frames_of(scene: Scene, samples: int, form: str) -> Iterator[None]:
    """Inside, the scene has a frame for each sample of its frames, at as many times their rate: the same seconds.

    Raises
    ------
    RetargetError : if the scene stretches its time too far already.
    """
    render = scene.render
    first, last = scene.frame_start, scene.frame_end
    rate, base, stretch = render.fps, render.fps_base, render.frame_map_new
    if stretch * samples > MOST_STRETCHED:
        raise RetargetError(
            f"scene {scene.name!r} maps its time to {stretch}, expected at most {MOST_STRETCHED // samples} for "
            f"{samples} samples per frame"
        )
    with frame_kept(scene):
        try:
            scene.frame_end, scene.frame_start = last * samples, first * samples
            render.fps, render.frame_map_new = rate * samples, stretch * samples
            # The rate is fps / fps_base; Blender's glTF exporter takes their product, in 4.5 to 5.2.
            render.fps_base = 1 / base if form == "GLTF" else base
            yield
        finally:
            scene.frame_start, scene.frame_end = first, last
            render.fps, render.fps_base, render.frame_map_new = rate, base, stretch
