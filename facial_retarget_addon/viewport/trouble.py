"""The chosen finding of the report in the view: its torn edges and turned triangles, while they are shown."""

from __future__ import annotations

from typing import Any

from bpy.types import Context, Object
from gpu.types import GPUBatch
from mathutils import Matrix

from .changes import look
from .lines import draw_lines, line_batch
from .shaders import linear

TORN, TURNED = linear(1.0, 0.15, 0.55), linear(1.0, 0.84, 0.0)

_made: list[tuple[Any, tuple[GPUBatch | None, GPUBatch | None]]] = []


def forget() -> None:
    """Drop everything: another file is open."""
    _made.clear()


def draw_trouble_spots(context: Context, thing: Object, view: Matrix, projection: Matrix) -> None:
    """Draw the chosen finding of a face if its frame or shape key is the one that we see."""
    face = thing.facial_retarget
    if not 0 <= face.active_finding < len(face.findings) or not _is_shown(context, thing):
        return
    finding = face.findings[face.active_finding]
    state = (thing.session_uid, look(thing), finding.torn_vertices, finding.turned_vertices)
    if not _made or _made[0][0] != state:
        _made[:] = [(state, _batches(context, thing, state))]
    scale = context.preferences.system.ui_scale
    for batch, colour, width in zip(_made[0][1], (TORN, TURNED), (3.0, 2.0), strict=True):
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


def _batches(context: Context, thing: Object, state: Any) -> tuple[GPUBatch | None, GPUBatch | None]:
    from ..bridge.points.point_places import shown_vertices
    from ..bridge.reports.findings import edges_among, unpacked  # loads SciPy, which enabling does not

    places = shown_vertices(thing, context.view_layer.depsgraph)
    if places is None or thing.facial_retarget.findings_vertices != len(places):
        return None, None
    torn, turned = (places[edges_among(thing, unpacked(text))] for text in state[2:])
    return (line_batch(torn) if len(torn) else None), (line_batch(turned) if len(turned) else None)
