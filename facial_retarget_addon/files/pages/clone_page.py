"""Pages and contact sheets about cloned shapes: every key with the neutral face and the donor's key beside it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ...core.arrays import FloatArray, Progress, no_progress, unit_vectors
from ...core.mpeg4.head import gives_axes
from ...core.parts.known_head import know_head
from ...core.problem import Face
from ...core.shapes.counterparts import feature_of
from ..images import png_bytes
from .lettering import lettered
from .page import Figure, Section, html_page
from .pictures import SKIN, Image, contact_sheet
from .report_pictures import Portrait, upright

SIZE = (240, 240)
WORST = 3
"""Keys that are marked: those with the most torn edges and flipped triangles."""
COLUMNS = 4
"""Keys beside each other on a contact sheet, three pictures each."""
_BEYOND = ("forehead", "ear", "neck")
"""Features that pictures need not show."""
_PUPIL = np.cos(np.radians(24))
"""Of the angle between the way an eye looks and the edge of its pupil in pictures."""
_WHITE, _DARK = np.array([0.85, 0.85, 0.85]), np.array([0.02, 0.02, 0.03])
_FRAME = (205, 40, 40)
_SECTIONS = (
    Section(
        "Shapes",
        ("shapes",),
        "Largest motion in the target's units, and as a share of the source's in the proportions of the heads. Torn "
        "edges grew to several times their length, flipped triangles turned over. Lid gaps are in percent of the eye's "
        "neutral opening, lip gaps, beyond the neutral one, of the mouth's width.",
    ),
    Section("Without counterpart", ("without_counterpart",), "They move the source; the target stays still, and why."),
    Section(
        "Examples",
        ("examples",),
        "Error of each corrected shape relative to its motion: with it among the examples, and left out of them.",
    ),
    Section("Quality", ("quality",), "Over all shapes."),
    Section("Parts", ("parts",), "Components of the target without feature points."),
    Section("Times", ("seconds",), "In seconds."),
    Section("Settings", ("method", "settings")),
)


class KeyPictures(NamedTuple):
    """One key: its name, and pictures of the donor's key, the target's neutral and the target's key."""

    name: str
    source: Image
    neutral: Image
    target: Image


def portrait_of(face: Face) -> Portrait:
    """Takes pictures of a face from in front: of what lies between brows and chin, of all of a head without a mouth.

    Eyeballs are white with a dark pupil that looks ahead in the neutral face, so that a gaze shows.
    """
    head = know_head(face)
    axes = head.axes if gives_axes(head.points.names) else upright(face)
    framed = [name for name in head.points.names if feature_of(name) not in _BEYOND] if head.shown else []
    colours = np.tile(SKIN, (len(face.mesh.vertices), 1))
    for eye in head.eyeballs.values():
        looks = unit_vectors(face.mesh.vertices[eye.vertices] - eye.centre) @ axes[2]
        colours[eye.vertices] = np.where((looks > _PUPIL)[:, None], _DARK, _WHITE)
    return Portrait(face.mesh, face.points.subset(framed), axes, SIZE, colours=colours)


def key_pictures(face: Face, seen: FloatArray, progress: Progress = no_progress) -> list[Image]:
    """Pictures of a face in each of its shapes, displacements (E, V, 3)."""
    portrait = portrait_of(face)
    pictures = []
    for row, displacement in enumerate(seen):
        progress(row / len(seen), f"picture {row + 1} of {len(seen)}")
        pictures.append(portrait.picture(face.mesh.vertices + displacement))
    return pictures


def sheet_rows(
    names: Sequence[str], source: Sequence[Image], face: Face, seen: FloatArray, progress: Progress = no_progress
) -> list[KeyPictures]:
    """The pictures of all keys.

    Parameters
    ----------
    source : of the donor's keys, in the order of the names.
    face : the target. seen : (E, Vt, 3) its keys' displacements, correctives with what they need.
    """
    neutral = portrait_of(face).picture(face.mesh.vertices)
    target = key_pictures(face, seen, progress)
    return [KeyPictures(*row) for row in zip(names, source, [neutral] * len(names), target, strict=True)]


def worst_keys(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Names of the keys with the most torn edges and flipped triangles, the worst first; none that has neither."""
    trouble = {row["name"]: row.get("torn_edges", 0) + row.get("flipped_triangles", 0) for row in rows}
    return sorted((name for name in trouble if trouble[name]), key=lambda name: -trouble[name])[:WORST]


def clone_page(report: Mapping[str, Any], pictures: Sequence[KeyPictures]) -> bytes:
    """The page of one target: for each key the donor's, the neutral face and the target's; the worst are marked."""
    worst = worst_keys(report["shapes"])
    rows = {row["name"]: row for row in report["shapes"]}
    figures = []
    for key in pictures:
        images = tuple(
            (f"{what}, {key.name}", png_bytes(image))
            for what, image in (("source", key.source), ("neutral", key.neutral), ("target", _marked(key, worst)))
        )
        figures.append(Figure(_caption(rows[key.name], worst, report["without_counterpart"]), images))
    title = f"Shapes cloned onto {report['target_file']}"
    lead = f"{len(pictures)} shapes of {report['source_file']}: the source's, the neutral face, the target's."
    return html_page(title, lead, figures, report, _SECTIONS, shown_elsewhere=("source_file", "target_file"))


def clone_sheet(pictures: Sequence[KeyPictures], rows: Sequence[Mapping[str, Any]]) -> bytes:
    """The same pictures as one PNG, the names written on them."""
    worst = worst_keys(rows)
    cells = []
    for key in pictures:
        strip = np.concatenate([key.source, key.neutral, _marked(key, worst)], axis=1)
        cells.append(lettered(strip, key.name, scale=3))
    return png_bytes(contact_sheet(cells, min(COLUMNS, len(cells)), gap=8))


def _marked(key: KeyPictures, worst: Sequence[str]) -> Image:
    """The target's picture, in a red frame if it is among the worst."""
    if key.name not in worst:
        return key.target
    framed = key.target.copy()
    for edge in (framed[:4], framed[-4:], framed[:, :4], framed[:, -4:]):
        edge[:] = _FRAME
    return framed


def _caption(row: Mapping[str, Any], worst: Sequence[str], lost: Mapping[str, str]) -> str:
    remarks = [row["name"]]
    if row.get("with"):
        remarks[0] += f" with {row['with']}"
    if row["name"] in lost:
        remarks.append(f"no counterpart: {lost[row['name']]}")
    if row.get("corrected"):
        remarks.append("corrected")
    remarks += [f"{row[key]} {what}" for key, what in _TROUBLE.items() if row.get(key)]
    if row["name"] in worst:
        remarks.append("among the worst")
    return ", ".join(remarks)


_TROUBLE = {"torn_edges": "torn edges", "flipped_triangles": "flipped triangles"}
