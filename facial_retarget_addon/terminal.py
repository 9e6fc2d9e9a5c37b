"""What the command line shows while it works: a bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

import re
import shutil
from typing import TextIO

from .core.arrays import Progress

WIDTH = 30
LINE_STEP = 0.05
"""Outside a terminal, a line for each new task and each such share of the whole. A task may count: frame 3 of 9."""
_CLEAR = "\r\x1b[K"


def progress_on(stream: TextIO) -> Progress:
    """A Progress that writes to a stream."""
    return _bar(stream) if stream.isatty() else _lines(stream)


def clear(stream: TextIO) -> None:
    """Wipe a bar away, so that something else can be said."""
    if stream.isatty():
        stream.write(_CLEAR)


def _bar(stream: TextIO) -> Progress:
    def show(share: float, what: str) -> None:
        done = round(min(max(share, 0.0), 1.0) * WIDTH)
        text = f"[{'#' * done}{'.' * (WIDTH - done)}] {share:4.0%} {what}"
        stream.write(_CLEAR + (text[: shutil.get_terminal_size().columns - 1] if share < 1 else ""))
        stream.flush()

    return show


def _lines(stream: TextIO) -> Progress:
    told = ("", -1.0)

    def show(share: float, what: str) -> None:
        nonlocal told
        task = re.sub(r"\d+", "", what)
        if task != told[0] or share >= told[1] + LINE_STEP:
            told = task, share
            stream.write(f"{share:4.0%} {what}\n")
            stream.flush()

    return show
