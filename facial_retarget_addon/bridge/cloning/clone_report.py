"""What cloning reports: a text in the .blend, and a few words for each key."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import bpy

from ...files.pages.report import report_json

REPORT = "Cloned Shapes"
"""Name of the text."""
NAMED = ("name", "with", "corrected", "largest_motion", "share_of_source")
"""What a row holds besides figures that are 0 where all is well."""
OF_SOURCE, PERCENT = "source_", "_percent"
"""How figures are named that say what the source itself shows, and those that are percents."""
SLIGHT = 0.5
"""Trouble below this is not worth a word."""
SEEN = {"lip_gap_percent": 3.0, "lid_gap_percent": 5.0}
"""Gaps from which an eye that does not look for them sees them: of less no frame or shape key is in trouble."""


def worst_first(rows: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """The names of rows, those with the most trouble first: torn edges, turned triangles, percents of a gap."""
    return sorted(rows, key=lambda name: -sum(trouble(rows[name]).values()))


def trouble(row: Mapping[str, Any]) -> dict[str, float]:
    """The figures of a row as far as they are worse than the source's own: 0 where all is well."""
    figures = {name: value for name, value in row.items() if name not in NAMED and value is not None}
    return {
        name: max(float(value) - float(figures.get(OF_SOURCE + name, 0.0)), 0.0)
        for name, value in figures.items()
        if not name.startswith(OF_SOURCE)
    }


def in_trouble(row: Mapping[str, Any]) -> bool:
    """Whether an artist should look at a row."""
    return any(value >= SEEN.get(name, SLIGHT) for name, value in trouble(row).items())


def figures_note(row: Mapping[str, Any]) -> str:
    """A row's trouble in a few words, such as `torn edges 3, lip gap +2 %`."""
    found = []
    for name, value in trouble(row).items():
        label = name.removesuffix(PERCENT).replace("_", " ")
        if value >= SLIGHT:
            found.append(f"{label} +{value:.0f} %" if name.endswith(PERCENT) else f"{label} {value:.0f}")
    return ", ".join(found)


def write_report(reports: Mapping[str, Mapping[str, Any]]) -> None:
    """Set the text of the report, made if there is none: head -> its report, with the shapes' rows worst first."""
    text = bpy.data.texts.get(REPORT) or bpy.data.texts.new(REPORT)
    ordered = {}
    for head, report in reports.items():
        rows = {row["name"]: row for row in report["shapes"]}
        ordered[head] = {**report, "shapes": [rows[name] for name in worst_first(rows)]}
    text.from_string(report_json(ordered).decode())
