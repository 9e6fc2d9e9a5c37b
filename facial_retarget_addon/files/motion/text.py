"""What every motion file goes through first: it is there, of a bearable size, and text if it should be."""

from __future__ import annotations

import codecs
from collections.abc import Callable
from pathlib import Path

from ...core.errors import RetargetError

LARGEST = 2**30
"""Bytes; hours of a hundred markers. A larger file is refused before it is read."""
HEAD = 4096
"""Bytes at the start that tell a text from a binary file, before the rest is read."""
_UTF16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


def read_motion_bytes(path: Path, kind: str, starts_well: Callable[[bytes], bool]) -> bytes:
    """The content of a file whose first bytes, at most HEAD of them, are what they should be.

    Raises
    ------
    RetargetError : if it is no file, cannot be read, is empty, is larger than LARGEST, or starts otherwise; `kind`
        says what was expected, such as "a FAP stream".
    """
    try:
        size = path.stat().st_size
        if not path.is_file():
            raise RetargetError(f"{path} is no file, expected {kind}")
        if size > LARGEST:
            raise RetargetError(f"{path} has {size / LARGEST:.1f} GiB, expected {kind} of at most {LARGEST >> 30} GiB")
        with open(path, "rb") as file:
            head = file.read(HEAD)
            if not head:
                raise RetargetError(f"{path} is empty, expected {kind}")
            if not starts_well(head):
                raise RetargetError(f"{path} starts with {head[:8]!r}, so it is not {kind}")
            return head + file.read()
    except (OSError, ValueError) as error:
        raise RetargetError(f"{path} cannot be read: {getattr(error, 'strerror', None) or error}") from error


def read_motion_lines(path: Path, kind: str) -> list[str]:
    """The lines of a text file, without their ends: UTF-8, UTF-16 with its mark, or else Latin-1.

    Raises
    ------
    RetargetError : as `read_motion_bytes`, and if it is a binary file.
    """
    content = read_motion_bytes(path, kind, _is_text)
    if content.startswith(_UTF16):
        text = content.decode("utf-16", "replace")
    else:
        try:
            text = content.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = content.decode("latin-1")
    return text.replace("\r\n", "\n").replace("\r", "\n").split("\n")


def _is_text(head: bytes) -> bool:
    return head.startswith(_UTF16) or b"\0" not in head
