"""What is selected in the scene."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from contextlib import contextmanager

from bpy.types import Context, Object, ViewLayer


@contextmanager
def selected_alone(context: Context, things: Collection[Object]) -> Iterator[None]:
    """Some objects alone are selected inside, whatever view shows others alone; afterwards what was."""
    layer = context.view_layer
    before, active = [thing for thing in layer.objects if thing.select_get()], layer.objects.active
    select_only(layer, things)
    try:
        # In a view that shows some objects alone the context has no others.
        with context.temp_override(area=None, selected_objects=list(things)):
            yield
    finally:
        select_only(layer, before)
        layer.objects.active = active


def select_only(layer: ViewLayer, things: Collection[Object]) -> None:
    """Select some objects and no other."""
    layer.update()  # up to Blender 5.0 objects that are gone are among its own until then, as None
    for thing in layer.objects:
        thing.select_set(thing in things)
