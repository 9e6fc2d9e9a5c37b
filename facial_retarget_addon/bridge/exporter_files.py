"""What Blender's exporters do not care for: whether there is room for a file, and whether it was written to its end."""

from __future__ import annotations

import os
from pathlib import Path

ALEMBIC_DONE = b"Ogawa\xff"
"""How an Alembic file starts that was written to its end."""
USD = b"PXR-USDC"
"""How a USD file starts that is no text."""
USD_TEXT = b"#usda"
"""How one starts that is text."""
MORE = 1_000_000
"""Bytes of a file that are no vertices, at most of most."""


def check_room(place: Path, size: int) -> None:
    """OSError if there is no room for a file: Blender's Alembic exporter ends Blender where a disk is full."""
    with open(place, "xb") as file:
        if hasattr(os, "posix_fallocate"):
            os.posix_fallocate(file.fileno(), 0, size + size // 50 + MORE)
        else:  # on Windows a file has its room once it has its length
            file.truncate(size + size // 50 + MORE)
    place.unlink()


def is_complete(path: Path) -> bool:
    """Whether an Alembic or USD file was written to its end: neither exporter says when the disk is full."""
    if not path.is_file():
        return False
    with open(path, "rb") as file:
        head = file.read(24)
        size = file.seek(0, 2)
        file.seek(max(size - 24, 0))
        tail = file.read()
    if path.suffix == ".abc":
        return head.startswith(ALEMBIC_DONE)
    if head.startswith(USD_TEXT):
        return tail.rstrip().endswith(b"}")
    # After the signature and eight bytes of version comes where the table of contents starts, at the very end.
    return head.startswith(USD) and 24 <= int.from_bytes(head[16:24], "little") < size
