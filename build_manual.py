"""The pages of docs/ as HTML, for the manual that ships in the extension: it opens in a browser, without a network.

    python build_manual.py OUT

Knows the Markdown that the pages are written in: headings, paragraphs, lists, tables, fenced code, pictures, links,
bold, italics and code.
"""

from __future__ import annotations

import re
import shutil
import sys
from collections.abc import Iterator
from html import escape
from pathlib import Path

ROOT = Path(__file__).resolve().parent
STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; max-width: 50em; margin: 2em auto; padding: 0 1em; color: #222; }
h1, h2, h3 { line-height: 1.2; margin-top: 1.6em; } img { max-width: 100%; }
code, pre { font-family: ui-monospace, monospace; font-size: 0.9em; background: #f2f2f2; }
code { padding: 0 0.2em; } pre { padding: 0.8em; overflow-x: auto; } pre code { padding: 0; }
table { border-collapse: collapse; } td, th { border: 1px solid #ccc; padding: 0.3em 0.6em; vertical-align: top; }
@media (prefers-color-scheme: dark) {
  body { background: #1d1d1d; color: #ddd; } code, pre { background: #2b2b2b; } a { color: #8ab4f8; }
  td, th { border-color: #555; }
}
"""
ITEM = re.compile(r"(?:[-*]|\d+\.) +")
RULE = re.compile(r"\|?[ :|-]+\|?")
"""The line below a table's head."""
BAR = "\\|"
"""A bar that parts no cells."""


def write_manual(docs: Path, out: Path) -> list[Path]:
    """Write a page for each page of `docs`, and copy their pictures; returns the pages."""
    out.mkdir(parents=True, exist_ok=True)
    pages = []
    for path in sorted(docs.glob("*.md")):
        pages.append(out / f"{path.stem}.html")
        pages[-1].write_text(page(path.read_text("utf-8")), "utf-8")
    for picture in sorted(docs.rglob("*.png")):
        place = out / picture.relative_to(docs)
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(picture, place)
    return pages


def page(text: str) -> str:
    """A whole HTML page of a Markdown text; its title is the first heading."""
    title = next((line.lstrip("# ") for line in text.splitlines() if line.startswith("#")), "")
    head = f'<meta charset="utf-8"><title>{escape(title)}</title><style>{STYLE}</style>'
    return f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head><body>\n{body(text)}\n</body></html>\n'


def body(text: str) -> str:
    """Markdown blocks as HTML."""
    return "\n".join(_block(lines) for lines in _blocks(text.splitlines()))


def anchor(heading: str) -> str:
    """What a link to a heading is called: lower case, words joined by hyphens."""
    return re.sub(r"[^\w -]", "", heading.lower()).strip().replace(" ", "-")


def _blocks(lines: list[str]) -> Iterator[list[str]]:
    """Lines that belong together: between empty ones, but a fence or a list is one block."""
    block: list[str] = []
    fenced = False
    for number, line in enumerate(lines):
        if line.startswith("```"):
            fenced = not fenced
        following = next((later for later in lines[number + 1 :] if later), "")
        within = fenced or (block and ITEM.match(block[0]) and (ITEM.match(following) or following.startswith("  ")))
        if line or (within and block):
            heading = line.startswith("#") and not fenced
            begins = ITEM.match(line) and block and not ITEM.match(block[0]) and not fenced
            if (heading or begins) and block:
                yield block
                block = []
            block.append(line)
            if heading:
                yield block
                block = []
        elif block:
            yield block
            block = []
    if block:
        yield block


def _block(lines: list[str]) -> str:
    first = lines[0]
    if first.startswith("#"):
        level = len(first) - len(first.lstrip("#"))
        text = first[level:].strip()
        return f'<h{level} id="{anchor(text)}">{inline(text)}</h{level}>'
    if first.startswith("```"):
        return f"<pre><code>{escape(chr(10).join(lines[1:-1]))}</code></pre>"
    if len(lines) > 1 and first.startswith("|") and RULE.fullmatch(lines[1]):
        return _table(lines)
    if ITEM.match(first):
        return _list(lines)
    return f"<p>{inline(' '.join(line.strip() for line in lines))}</p>"


def _table(lines: list[str]) -> str:
    rows = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))] for line in lines]
    html = []
    for tag, cells in [("th", rows[0]), *(("td", row) for row in rows[2:])]:
        html.append("<tr>" + "".join(f"<{tag}>{inline(cell)}</{tag}>" for cell in cells) + "</tr>")
    return "<table>\n" + "\n".join(html[0 if any(rows[0]) else 1 :]) + "\n</table>"


def _list(lines: list[str]) -> str:
    items: list[list[str]] = []
    for line in lines:
        if ITEM.match(line):
            items.append([ITEM.sub("", line, count=1)])
        else:
            items[-1].append(line.strip())
    tag = "ol" if lines[0][0].isdigit() else "ul"
    rows = "\n".join("<li>" + "<br>\n".join(_paragraphs(item)) + "</li>" for item in items)
    return f"<{tag}>\n{rows}\n</{tag}>"


def _paragraphs(lines: list[str]) -> list[str]:
    """The paragraphs of one item, which empty lines part."""
    return [inline(part.replace("\n", " ")) for part in "\n".join(lines).strip().split("\n\n")]


def inline(text: str) -> str:
    """Code, pictures, links, bold and italics within a line; a link to a page is one to its HTML."""
    kept: list[str] = []

    def keep(code: re.Match[str]) -> str:
        kept.append(f"<code>{escape(code[1].replace(BAR, '|'))}</code>")
        return f"\0{len(kept) - 1}\0"

    text = re.sub("`([^`]+)`", keep, text)
    text = escape(text.replace(BAR, "|"), quote=False)
    text = re.sub(r"!\[([^\]]*)\]\(([^)]+)\)", r'<img alt="\1" src="\2">', text)
    text = re.sub(r"\[([^\]]+)\]\(([^)]+)\)", lambda link: f'<a href="{_target(link[2])}">{link[1]}</a>', text)
    text = re.sub(r"\*\*(.+?)\*\*", r"<b>\1</b>", text)
    text = re.sub(r"(?<![\w*])\*(?! )(.+?)(?<! )\*(?![\w*])", r"<i>\1</i>", text)
    return re.sub("\0(\\d+)\0", lambda place: kept[int(place[1])], text)


def _target(link: str) -> str:
    return re.sub(r"\.md(?=$|#)", ".html", link)


if __name__ == "__main__":
    for made in write_manual(ROOT / "docs", Path(sys.argv[1])):
        print(made)
