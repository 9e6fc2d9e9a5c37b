"""What a retargeting or cloning found wrong, kept on the face: frames and shape keys in trouble, and where."""

from __future__ import annotations

from base64 import b85decode, b85encode
from bisect import bisect, insort
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple
from zlib import compress, decompress

import bpy
import numpy as np
from bpy.types import Object, PropertyGroup, Scene

from ...core.arrays import IntArray
from ...core.errors import RetargetError
from ...core.quality import Spots
from ...core.retarget import Result
from ..cloning.clone_report import figures_note, in_trouble, trouble
from ..shape_keys import find_key

PLACES = {
    "TORN": ("torn_vertices", "torn edges"),
    "TURNED": ("turned_vertices", "turned triangles"),
    "LIPS": ("lip_vertices", "gap between the lips"),
    "LIDS": ("lid_vertices", "gap between the lids"),
}
"""Kind of trouble -> where a finding keeps its vertices, and what it is called."""


class Finding(NamedTuple):
    """Figures as in a row of the report, and where the trouble is."""

    row: Mapping[str, Any]
    spots: Spots


def write_frame_findings(thing: Object, source: Object, result: Result, times: Sequence[float]) -> None:
    """Keep what was found in baked frames, in the place of an earlier bake's; and which source vertex is whose.

    Parameters
    ----------
    times : the scene frames of the result's.
    """
    face = thing.facial_retarget
    _drop(face, lambda finding: finding.kind == "FRAME")
    for i, (time, spots) in enumerate(zip(times, result.spots, strict=True)):
        row = {what: figures[i] for what, figures in result.per_frame.items()}
        _add(face, f"Frame {time}", Finding(row, spots), time)
    bad = sum(finding.kind == "FRAME" for finding in face.findings)
    face.findings_text = f"{bad} of {len(result.spots)} frames have trouble"
    face.findings_source, face.counterpart = source, packed(result.counterpart)
    _sort(face)


def write_key_findings(thing: Object, found: Mapping[str, Finding]) -> None:
    """Keep what was found in cloned shape keys, by name, in the place of what was known of them."""
    face = thing.facial_retarget
    _drop(face, lambda finding: finding.kind == "KEY" and (finding.name in found or not find_key(thing, finding.name)))
    for name, finding in found.items():
        _add(face, name, finding, None)
    bad = sum(finding.kind == "KEY" and finding.name in found for finding in face.findings)
    face.findings_text = f"{bad} of {len(found)} shape keys have trouble"
    _sort(face)


def show_finding(scene: Scene, thing: Object) -> None:
    """Show the chosen finding: go to its frame, or set its shape key to 1 and the one that was shown before to 0."""
    face = thing.facial_retarget
    if not 0 <= face.active_finding < len(face.findings):
        return
    finding = face.findings[face.active_finding]
    shown = find_key(thing, face.shown_key) if face.shown_key else None
    if shown is not None:
        shown.value = 0.0
    face.shown_key = ""
    if finding.kind == "FRAME":
        scene.frame_set(int(finding.frame // 1), subframe=finding.frame % 1)
        return
    key = find_key(thing, finding.name)
    if key is not None:
        key.value, face.shown_key = 1.0, finding.name


def select_spots(thing: Object, kind: str) -> int:
    """Enter Edit Mode with the vertices of the chosen finding's trouble selected, and nothing else.

    Parameters
    ----------
    kind : a key of `PLACES`.

    Returns
    -------
    How many vertices are selected.

    Raises
    ------
    RetargetError : if the mesh has other vertices than then, or the finding has no such trouble, or all of it lies on
        other objects of the head.
    """
    face = thing.facial_retarget
    finding = face.findings[face.active_finding]
    kept, called = PLACES[kind]
    rows = unpacked(getattr(finding, kept))
    if face.findings_vertices != len(thing.data.vertices):
        raise RetargetError(
            f"object {thing.name!r} has {len(thing.data.vertices)} vertices, expected the {face.findings_vertices} "
            "that it had when this was found"
        )
    if not len(rows):
        raise RetargetError(f"{finding.name} has no {called}, expected a row of the report with a figure there")
    own = rows[rows < len(thing.data.vertices)]
    if not len(own):
        raise RetargetError(f"all {called} of {finding.name} are on the parts of {thing.name!r}, not on it")
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    for other in bpy.context.selected_objects:
        other.select_set(False)
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    chosen = np.zeros(len(thing.data.vertices), bool)
    chosen[own] = True
    # Blender 5.0 crashes where foreach_set writes the selection of elements of which none was ever selected.
    attributes = thing.data.attributes
    selection = attributes.get(".select_vert") or attributes.new(".select_vert", "BOOLEAN", "POINT")
    selection.data.foreach_set("value", chosen)
    bpy.context.scene.tool_settings.mesh_select_mode = (True, False, False)
    bpy.ops.object.mode_set(mode="EDIT")
    return len(own)


def edges_among(thing: Object, vertices: IntArray) -> IntArray:
    """(n, 2) edges of an object both of whose ends are among some vertices (k,); others of the head are left aside."""
    mesh = thing.data
    chosen = np.zeros(len(mesh.vertices), bool)
    chosen[vertices[vertices < len(chosen)]] = True
    edges = np.empty(2 * len(mesh.edges), np.int32)
    mesh.attributes[".edge_verts"].data.foreach_get("value", edges)
    edges = edges.reshape(-1, 2).astype(np.int64)
    return edges[chosen[edges].all(axis=1)]


def packed(numbers: IntArray) -> str:
    """Whole numbers (n,) as a short text, for the .blend."""
    return b85encode(compress(np.asarray(numbers, np.int32).tobytes())).decode()


def unpacked(text: str) -> IntArray:
    """The numbers (n,) of `packed`; none of an empty text."""
    return np.frombuffer(decompress(b85decode(text)), np.int32).astype(np.int64) if text else np.empty(0, np.int64)


def _add(face: PropertyGroup, name: str, found: Finding, frame: float | None) -> None:
    """Add a finding that is worth a word."""
    if not in_trouble(found.row):
        return
    figures, finding = trouble(found.row), face.findings.add()
    finding.name, finding.kind, finding.frame = name, "KEY" if frame is None else "FRAME", frame or 0
    finding.note, finding.trouble = figures_note(found.row), sum(figures.values())
    finding.torn = int(figures.get("torn_edges", 0))
    finding.turned = int(figures.get("flipped_triangles", 0))
    finding.lip_gap, finding.lid_gap = figures.get("lip_gap_percent", 0.0), figures.get("lid_gap_percent", 0.0)
    for (kept, _), vertices in zip(PLACES.values(), found.spots, strict=True):
        setattr(finding, kept, packed(vertices))


def _drop(face: PropertyGroup, wanted: Any) -> None:
    """Remove the findings of which `wanted` is true."""
    for row in reversed(range(len(face.findings))):
        if wanted(face.findings[row]):
            face.findings.remove(row)


def _sort(face: PropertyGroup) -> None:
    """The worst ones first; those of the same trouble stay in their order."""
    face.findings_vertices = len(face.id_data.data.vertices)
    trouble_of = [finding.trouble for finding in face.findings]
    order = sorted(range(len(trouble_of)), key=lambda row: -trouble_of[row])
    placed: list[int] = []
    for place, row in enumerate(order):
        # Each one that was moved to the front from behind it has pushed it back by one.
        face.findings.move(row + place - bisect(placed, row), place)
        insort(placed, row)
