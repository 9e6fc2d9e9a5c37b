"""Pages about a face that FAPs move: a contact sheet of its motion or of its shapes, and the figures beneath."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...core.acting.fap_face import FapFace
from ...core.arrays import FloatArray, Progress, no_progress
from ..frames import FrameBlocks
from ..images import png_bytes
from .page import Figure, Section, html_page
from .pictures import Image
from .report_pictures import Portrait, liveliest

PICTURES = 12
"""Frames that are shown."""
LOOKED_AT = 240
"""Frames among which they are chosen, evenly spaced over a longer take."""

_SECTIONS = (
    Section("Motion", ("motion",)),
    Section(
        "Markers",
        ("gaps", "markers"),
        "Gaps are filled along smooth curves. The residual of the rigid markers, in the markers' units, is how far "
        "they are from moving as one piece; clamped FAPs went below zero, where they mean nothing.",
    ),
    Section("FAPs", ("faps",), "Those that are not zero all along. 1024 is one whole length of the face."),
    Section("Shapes", ("shapes",), "The farthest that any vertex moves, as a share of the face's size."),
    Section("Face", ("face",), "The face's units (FAPU) in its own lengths, and the points that gave them."),
    Section("Times", ("seconds",), "In seconds."),
)


def fap_page(report: Mapping[str, Any], face: FapFace, frames: FrameBlocks, rows: slice) -> bytes:
    """The page of a moving face: neutral with its points, then the liveliest frame of each of 12 spans of time.

    Parameters
    ----------
    frames : (F, V, 3).
    rows : which of the take's frames they are, from 0.
    """
    stride = -(-len(frames) // LOOKED_AT)
    chosen = [stride * row for row in liveliest(face.mesh.vertices, frames[::stride], PICTURES)]
    portrait = Portrait(face.mesh, face.points, face.axes)
    numbers = range(rows.stop)[rows]
    pictures = [_figure(f"Frame {numbers[row] + 1}", portrait.picture(frames[row : row + 1][0])) for row in chosen]
    title = f"FAP report: {report['motion']['file']}"
    lead = f"{len(frames)} frames. The neutral face with its points, then the liveliest frame of each span of time."
    return html_page(title, lead, [_neutral(portrait, face), *pictures], report, _SECTIONS)


def shapes_page(
    report: Mapping[str, Any], face: FapFace, shapes: Mapping[str, FloatArray], progress: Progress = no_progress
) -> bytes:
    """The page of a face's shapes (V, 3) by name: neutral with its points, then every shape."""
    portrait = Portrait(face.mesh, face.points, face.axes)
    figures = [_neutral(portrait, face)]
    for name, positions in shapes.items():
        progress(len(figures) / (len(shapes) + 1), f"picture {len(figures)} of {len(shapes)}")
        figures.append(_figure(name, portrait.picture(positions)))
    title = f"Shapes of {report['face']['file']}"
    lead = f"The neutral face with its points, then {len(shapes)} shapes at full strength."
    return html_page(title, lead, figures, report, _SECTIONS)


def _neutral(portrait: Portrait, face: FapFace) -> Figure:
    return Figure("Neutral", (("neutral", png_bytes(portrait.marked(face.mesh.vertices))),))


def _figure(caption: str, image: Image) -> Figure:
    return Figure(caption, ((caption, png_bytes(image)),))
