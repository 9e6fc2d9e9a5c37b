"""The manual that ships: every page of docs/ as HTML, with links that lead somewhere."""

import sys
from html.parser import HTMLParser
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(REPOSITORY))
import build_manual  # noqa: E402 it lies beside the package

VOID = {"meta", "img", "br"}


class Page(HTMLParser):
    """Reads a page: its text outside code, links, pictures and anchors; tags must match."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.open: list[str] = []
        self.links: list[str] = []
        self.pictures: list[str] = []
        self.anchors: set[str] = set()
        self.text = ""
        self.feed(path.read_text("utf-8"))
        assert not self.open, self.open

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        values = dict(attributes)
        self.links += [values["href"]] if tag == "a" else []
        self.pictures += [values["src"]] if tag == "img" else []
        self.anchors |= {values["id"]} if "id" in values else set()
        self.open += [] if tag in VOID else [tag]

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag, (tag, self.getpos())

    def handle_data(self, data: str) -> None:
        if not {"code", "style"} & set(self.open):
            self.text += data


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Page]:
    made = build_manual.write_manual(REPOSITORY / "docs", tmp_path_factory.mktemp("manual"))
    return {path.name: Page(path) for path in made}


def test_every_page_is_there(pages: dict[str, Page]) -> None:
    assert {Path(name).stem for name in pages} == {path.stem for path in (REPOSITORY / "docs").glob("*.md")}


def test_links_lead_somewhere(pages: dict[str, Page]) -> None:
    for name, page in pages.items():
        for link in page.links:
            if "://" in link:
                continue
            target, _, place = link.partition("#")
            if target.endswith(".html") or not target:
                assert (target or name) in pages, f"{name}: {link}"
                assert not place or place in pages[target or name].anchors, f"{name}: {link}"


def test_pictures_are_there(pages: dict[str, Page]) -> None:
    for name, page in pages.items():
        for picture in page.pictures:
            assert (REPOSITORY / "docs" / picture).is_file(), f"{name}: {picture}"


def test_no_markdown_is_left(pages: dict[str, Page]) -> None:
    for name, page in pages.items():
        for mark in ("**", "](", "```", "| ---", "\n#"):
            assert mark not in page.text, f"{name}: {mark!r} in {page.text[page.text.index(mark) - 60 :][:140]!r}"


@pytest.mark.parametrize(
    ("text", "html"),
    [
        ("## A *b* (c)", '<h2 id="a-b-c">A <i>b</i> (c)</h2>'),
        ("one\ntwo\n\nthree", "<p>one two</p>\n<p>three</p>"),
        ("- a\n  b\n- **c**", "<ul>\n<li>a b</li>\n<li><b>c</b></li>\n</ul>"),
        ("so:\n1. a\n2. b", "<p>so:</p>\n<ol>\n<li>a</li>\n<li>b</li>\n</ol>"),
        ("1. a\n\n   b\n2. c", "<ol>\n<li>a<br>\nb</li>\n<li>c</li>\n</ol>"),
        ("| a |\n| - |\n| `x\\|y` |", "<table>\n<tr><th>a</th></tr>\n<tr><td><code>x|y</code></td></tr>\n</table>"),
        ("**`a`** b", "<p><b><code>a</code></b> b</p>"),
        ("| | |\n| - | - |\n| a | b < c |", "<table>\n<tr><td>a</td><td>b &lt; c</td></tr>\n</table>"),
        ("```sh\na *b*\n\n# c\n```", "<pre><code>a *b*\n\n# c</code></pre>"),
        ("2 * 3 * 4, `*`, [x](y.md#z)", '<p>2 * 3 * 4, <code>*</code>, <a href="y.html#z">x</a></p>'),
        ("![A face](pictures/a.png)", '<p><img alt="A face" src="pictures/a.png"></p>'),
    ],
)
def test_markdown_becomes_html(text: str, html: str) -> None:
    assert build_manual.body(text) == html
