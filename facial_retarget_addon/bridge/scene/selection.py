"""What is selected in the scene."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from bpy.types import Context, Object

from ..heads import head_parts


@contextmanager
def head_selected(context: Context, face: Object) -> Iterator[None]:
    """A face and its parts alone are selected inside; afterwards what was."""
    before = context.selected_objects
    _select(context, [face, *head_parts(face)])
    try:
        yield
    finally:
        _select(context, before)


def _select(context: Context, things: list[Object]) -> None:
    for thing in context.selected_objects:
        thing.select_set(False)
    for thing in things:
        thing.select_set(True)
