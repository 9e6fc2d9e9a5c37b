"""The chosen finding of the report in the view: torn edges, turned triangles, lips and lids that gape."""

from __future__ import annotations

from typing import Any

from bpy.types import Context, Object
from gpu.types import GPUBatch
from mathutils import Matrix

from .changes import look
from .lines import draw_lines, line_batch
from .shaders import linear

LOOKS = {
    "lip_vertices": (linear(0.25, 0.85, 1.0), 2.5),
    "lid_vertices": (linear(0.25, 0.85, 1.0), 2.5),
    "torn_vertices": (linear(1.0, 0.15, 0.55), 3.0),
    "turned_vertices": (linear(1.0, 0.84, 0.0), 2.0),
}
"""Where a finding keeps its vertices -> the colour and width of their lines, in the order of drawing."""

_made: list[tuple[Any, list[GPUBatch | None]]] = []


def forget() -> None:
    """Drop everything: another file is open."""
    _made.clear()


def draw_trouble_spots(context: Context, thing: Object, view: Matrix, projection: Matrix) -> None:
    """Draw the chosen finding of a face if its frame or shape key is the one that we see."""
    face = thing.facial_retarget
    if not 0 <= face.active_finding < len(face.findings) or not _is_shown(context, thing):
        return
    finding = face.findings[face.active_finding]
    state = (thing.session_uid, look(thing), *(getattr(finding, kept) for kept in LOOKS))
    if not _made or _made[0][0] != state:
        _made[:] = [(state, _batches(context, thing, state))]
    scale = context.preferences.system.ui_scale
    for batch, (colour, width) in zip(_made[0][1], LOOKS.values(), strict=True):
        if batch is not None:
            draw_lines(batch, view, projection, width * scale, colour, through=True)


def _is_shown(context: Context, thing: Object) -> bool:
    """Whether the scene is at the chosen finding's frame, or its shape key is on."""
    face = thing.facial_retarget
    finding = face.findings[face.active_finding]
    if finding.kind == "FRAME":
        return abs(context.scene.frame_current_final - finding.frame) < 1e-3
    keys = thing.data.shape_keys
    return keys is not None and finding.name in keys.key_blocks and keys.key_blocks[finding.name].value > 0.5


def _batches(context: Context, thing: Object, state: Any) -> list[GPUBatch | None]:
    from ..bridge.points.point_places import shown_vertices
    from ..bridge.reports.findings import edges_among, unpacked  # loads SciPy, which enabling does not

    places = shown_vertices(thing, context.view_layer.depsgraph)
    if places is None or thing.facial_retarget.findings_vertices != len(places):
        return [None] * len(LOOKS)
    lines = [places[edges_among(thing, unpacked(text))] for text in state[2:]]
    return [line_batch(pieces) if len(pieces) else None for pieces in lines]
