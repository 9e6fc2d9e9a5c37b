"""What cloning reports: a text in the .blend, and a few words for each key."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import bpy

from ..files.pages.report import report_json

REPORT = "Cloned Shapes"
"""Name of the text."""
NAMED = ("name", "with", "corrected", "largest_motion", "share_of_source")
"""What a row holds besides figures that are 0 where all is well."""


def worst_first(rows: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """The names of rows, those with the most trouble first: the sum of their figures, each over its greatest."""
    figures = {figure for row in rows.values() for figure in trouble(row)}
    greatest = {figure: max(abs(trouble(row).get(figure, 0.0)) for row in rows.values()) or 1.0 for figure in figures}
    total = {name: sum(abs(v) / greatest[figure] for figure, v in trouble(row).items()) for name, row in rows.items()}
    return sorted(rows, key=lambda name: -total[name])


def trouble(row: Mapping[str, Any]) -> dict[str, float]:
    """The figures of a row that are 0 where all is well."""
    return {name: value for name, value in row.items() if name not in NAMED and value is not None}


def figures_note(row: Mapping[str, Any]) -> str:
    """A row's trouble in a few words, such as `3 torn edges, lip gap 0.2`."""
    found = [f"{name.replace('_', ' ')} {value:.3g}" for name, value in trouble(row).items() if value]
    return ", ".join(found)


def write_report(reports: Mapping[str, Mapping[str, Any]]) -> None:
    """Set the text of the report, made if there is none: head -> its report, with the shapes' rows worst first."""
    text = bpy.data.texts.get(REPORT) or bpy.data.texts.new(REPORT)
    ordered = {}
    for head, report in reports.items():
        rows = {row["name"]: row for row in report["shapes"]}
        ordered[head] = {**report, "shapes": [rows[name] for name in worst_first(rows)]}
    text.from_string(report_json(ordered).decode())
