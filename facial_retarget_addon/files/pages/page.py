"""Pages to look at: one HTML file that needs nothing else, with pictures, warnings and plain data as tables."""

from __future__ import annotations

import base64
import html
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

_STYLE = """
:root { color-scheme: light dark;
  --ink: #1d1d1f; --soft: #6b6b70; --line: #d9d9de; --paper: #fbfbfa; --note: #fff4d6; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #ececee; --soft: #a0a0a8; --line: #3a3a40; --paper: #1b1b1e; --note: #3d3417; }
}
body { margin: 2rem auto; max-width: 62rem; padding: 0 1rem; background: var(--paper); color: var(--ink);
  font: 15px/1.5 system-ui, sans-serif; }
h1 { font-size: 1.6rem; margin: 0; }
h2 { font-size: 1.1rem; margin: 2.2rem 0 .3rem; }
p { margin: .2rem 0 .6rem; max-width: 46rem; color: var(--soft); }
ul.warnings { background: var(--note); margin: 1rem 0; padding: .7rem 1rem .7rem 2rem; border-radius: 6px; }
.pictures { display: grid; gap: 1rem; margin-top: 1.5rem; }
figure { margin: 0; }
figure div { display: flex; gap: 2px; }
figure img { flex: 1; min-width: 0; height: auto; }
figcaption { color: var(--soft); font-size: .85rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .2rem 1.2rem .2rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
th { font-weight: 500; color: var(--soft); }
td.number { text-align: right; }
"""


class Figure(NamedTuple):
    """Pictures side by side over a caption; each one is its description and a PNG file."""

    caption: str
    images: tuple[tuple[str, bytes], ...]


class Section(NamedTuple):
    """A part of a page: its title, the keys of the report that it shows, what they mean."""

    title: str
    keys: tuple[str, ...]
    note: str = ""


def html_page(
    title: str,
    lead: str,
    figures: Sequence[Figure],
    report: Mapping[str, Any],
    sections: Iterable[Section],
    shown_elsewhere: Iterable[str] = (),
    rows: Sequence[Figure] = (),
) -> bytes:
    """A page: title, one sentence, warnings, pictures, then the sections; what no section shows follows under More.

    Parameters
    ----------
    report : plain data; its "warnings" stand above the pictures.
    shown_elsewhere : keys of the report that title or lead have said already.
    rows : figures that take the page's whole width, beneath the others.
    """
    sections = tuple(sections)
    known = {key for section in sections for key in section.keys} | {"warnings", *shown_elsewhere}
    rest = Section("More", tuple(key for key in report if key not in known))
    width = 9 * max((len(figure.images) for figure in figures), default=1)
    parts = [
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{_escape(title)}</title>',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<style>{_STYLE}</style></head><body><h1>{_escape(title)}</h1>",
        f"<p>{_escape(lead)}</p>",
        _warnings(report.get("warnings", [])),
        f'<div class="pictures" style="grid-template-columns: repeat(auto-fill, minmax({width}rem, 1fr))">',
        *map(_figure, figures),
        "</div>",
        *(f'<div class="pictures">{_figure(row)}</div>' for row in rows),
        *(_section(section, report) for section in (*sections, rest)),
        "</body></html>\n",
    ]
    return "\n".join(part for part in parts if part).encode("utf-8", "backslashreplace")


def _warnings(texts: Sequence[str]) -> str:
    if not texts:
        return ""
    return f'<ul class="warnings">{"".join(f"<li>{_escape(text)}</li>" for text in texts)}</ul>'


def _figure(figure: Figure) -> str:
    images = "".join(
        f'<img alt="{_escape(what)}" src="data:image/png;base64,{base64.b64encode(png).decode()}">'
        for what, png in figure.images
    )
    return f"<figure><div>{images}</div><figcaption>{_escape(figure.caption)}</figcaption></figure>"


def _section(section: Section, report: Mapping[str, Any]) -> str:
    found = {key: report[key] for key in section.keys if key in report}
    if not any(value not in ({}, [], ()) for value in found.values()):
        return ""
    whole = len(section.keys) == 1 and isinstance(next(iter(found.values())), dict | list)
    shown = _value(next(iter(found.values())) if whole else found)
    note = f"<p>{section.note}</p>" if section.note else ""
    return f"<h2>{section.title}</h2>{note}<div class='scroll'>{shown}</div>"


def _value(value: Any) -> str:
    """Plain data as HTML: tables of tables, lists as tables where they hold tables."""
    if isinstance(value, Mapping):
        rows = "".join(f"<tr><th>{_label(key)}</th>{_cell(part)}</tr>" for key, part in value.items())
        return f"<table>{rows}</table>"
    if isinstance(value, Sequence) and not isinstance(value, str):
        if value and all(isinstance(part, Mapping) for part in value):
            columns = list(dict.fromkeys(key for part in value for key in part))
            head = "".join(f"<th>{_label(key)}</th>" for key in columns)
            rows = "".join(f"<tr>{''.join(_cell(part.get(key)) for key in columns)}</tr>" for part in value)
            return f"<table><tr>{head}</tr>{rows}</table>"
        return ", ".join(map(_value, value)) or "none"
    return _escape(_text(value))


def _cell(value: Any) -> str:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    return f"<td{' class=number' if number else ''}>{_value(value)}</td>"


def _text(value: Any) -> str:
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        return f"{value:,}"
    if isinstance(value, float):
        return f"{value:.3g}" if abs(value) < 1000 else f"{value:,.0f}"
    return str(value)


def _label(key: object) -> str:
    return _escape(str(key).replace("_", " "))


def _escape(text: str) -> str:
    return html.escape(text)
