"""The report of a job: figures as JSON, and a page to look at."""

from __future__ import annotations

import base64
import html
import math
from collections.abc import Mapping, Sequence
from typing import Any

from ..core.arrays import FloatArray
from ..core.problem import Problem
from .documents import json_bytes
from .report_pictures import PICTURE_SIZE, Moment, liveliest, moments

_SECTIONS: tuple[tuple[str, tuple[str, ...], str], ...] = (
    (
        "Quality",
        ("quality",),
        "Over all frames. Torn edges grew to several times their length, flipped triangles turned over, neutral drift "
        "is what is left where the source does not move.",
    ),
    (
        "Piercing",
        ("levels",),
        "Rays of the normal mesh that found no surface, level by level; their neighbours filled their places.",
    ),
    (
        "Examples",
        ("examples",),
        "Error of each example relative to its motion: with it among the examples, and left out of them. One that is "
        "far worse when it is left out shows what no other example does.",
    ),
    (
        "Fit",
        ("scale", "coverage", "matched", "base", "source", "target", "still_components"),
        "Scale is target units for one source unit; coverage the share of the target's surface that lies on the base "
        "mesh; matched the share that found its place on the source. Still components hold no feature point.",
    ),
    ("Times", ("seconds",), "In seconds."),
    ("Settings", ("method", "settings"), ""),
)
"""Title, keys of the report, what the figures mean."""
_SHOWN_ELSEWHERE = ("job", "warnings")

_STYLE = f"""
:root {{ color-scheme: light dark;
  --ink: #1d1d1f; --soft: #6b6b70; --line: #d9d9de; --paper: #fbfbfa; --note: #fff4d6; }}
@media (prefers-color-scheme: dark) {{
  :root {{ --ink: #ececee; --soft: #a0a0a8; --line: #3a3a40; --paper: #1b1b1e; --note: #3d3417; }}
}}
body {{ margin: 2rem auto; max-width: 62rem; padding: 0 1rem; background: var(--paper); color: var(--ink);
  font: 15px/1.5 system-ui, sans-serif; }}
h1 {{ font-size: 1.6rem; margin: 0; }}
h2 {{ font-size: 1.1rem; margin: 2.2rem 0 .3rem; }}
p {{ margin: .2rem 0 .6rem; max-width: 46rem; color: var(--soft); }}
ul.warnings {{ background: var(--note); margin: 1rem 0; padding: .7rem 1rem .7rem 2rem; border-radius: 6px; }}
.moments {{ display: grid; grid-template-columns: repeat(auto-fit, minmax(18rem, 1fr)); gap: 1rem;
  margin-top: 1.5rem; }}
figure {{ margin: 0; }}
figure div {{ display: flex; gap: 2px; }}
figure img {{ width: 50%; height: auto; aspect-ratio: {PICTURE_SIZE[0]} / {PICTURE_SIZE[1]}; }}
figcaption {{ color: var(--soft); font-size: .85rem; }}
.scroll {{ overflow-x: auto; }}
table {{ border-collapse: collapse; font-variant-numeric: tabular-nums; }}
th, td {{ text-align: left; padding: .2rem 1.2rem .2rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }}
th {{ font-weight: 500; color: var(--soft); }}
td.number {{ text-align: right; }}
"""


def report_json(report: Mapping[str, Any]) -> bytes:
    """The report as a JSON document; a number that does not exist (NaN) is null."""
    return json_bytes(_finite(report))


def report_page(
    report: Mapping[str, Any], problem: Problem, source_frames: FloatArray, target_frames: FloatArray
) -> bytes:
    """The report as one HTML file that needs nothing else: pictures of source and target, the figures beneath.

    Parameters
    ----------
    report : plain data; what it holds beyond the known keys is shown too.
    source_frames, target_frames : (F, Vs, 3) and (F, Vt, 3).
    """
    chosen = {*liveliest(problem.source.mesh.vertices, source_frames), *worst_frame(report)}
    return render(report, moments(problem, source_frames, target_frames, sorted(chosen)), len(target_frames))


def worst_frame(report: Mapping[str, Any]) -> list[int]:
    """The frame (from 0) with the most torn edges and flipped triangles; none where nothing is torn or flipped."""
    quality = report.get("quality", {})
    trouble = quality.get("torn_edges", 0) + quality.get("flipped_triangles", 0)
    return [quality["worst_frame"] - 1] if trouble and quality.get("worst_frame") else []


def render(report: Mapping[str, Any], pictures: Sequence[Moment], frame_count: int) -> bytes:
    """The page of a report and its pictures."""
    title = f"Retargeting report: {report['job']}" if "job" in report else "Retargeting report"
    known = {key for _, keys, _ in _SECTIONS for key in keys} | set(_SHOWN_ELSEWHERE)
    rest = tuple(key for key in report if key not in known)
    parts = [
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{_escape(title)}</title>',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<style>{_STYLE}</style></head><body><h1>{_escape(title)}</h1>",
        f"<p>{frame_count} frames. Pictures of the liveliest ones and the worst, source left, target right.</p>",
        _warnings(report.get("warnings", [])),
        f'<div class="moments">{"".join(_figure(moment, worst_frame(report)) for moment in pictures)}</div>',
        *(_section(name, keys, note, report) for name, keys, note in (*_SECTIONS, ("More", rest, ""))),
        "</body></html>\n",
    ]
    return "\n".join(part for part in parts if part).encode("utf-8", "backslashreplace")


def _warnings(texts: Sequence[str]) -> str:
    if not texts:
        return ""
    return f'<ul class="warnings">{"".join(f"<li>{_escape(text)}</li>" for text in texts)}</ul>'


def _figure(moment: Moment, worst: Sequence[int]) -> str:
    images = "".join(
        f'<img alt="{side}, frame {moment.frame + 1}" src="data:image/png;base64,{base64.b64encode(png).decode()}">'
        for side, png in (("source", moment.source), ("target", moment.target))
    )
    remark = ", the worst: most torn edges and flipped triangles" if moment.frame in worst else ""
    return f"<figure><div>{images}</div><figcaption>Frame {moment.frame + 1}{remark}</figcaption></figure>"


def _section(name: str, keys: Sequence[str], note: str, report: Mapping[str, Any]) -> str:
    found = {key: report[key] for key in keys if key in report}
    if not any(value not in ({}, [], ()) for value in found.values()):
        return ""
    whole = len(keys) == 1 and isinstance(next(iter(found.values())), dict | list)
    shown = _value(next(iter(found.values())) if whole else found)
    return f"<h2>{name}</h2>{f'<p>{note}</p>' if note else ''}<div class='scroll'>{shown}</div>"


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


def _finite(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _finite(part) for key, part in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(part) for part in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
