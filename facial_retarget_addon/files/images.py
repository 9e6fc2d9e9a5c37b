"""Pictures on disk: PNG with 8 or 16 bits a channel, EXR with 32-bit floats."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..core.arrays import FloatArray
from ..core.errors import RetargetError

DEPTHS = {"png8": (".png", 8), "png16": (".png", 16), "exr": (".exr", 32)}
"""What a picture file may hold: its suffix, and bits a channel."""

_EXR_LINES = 16
"""Lines that are compressed together; the format's."""


def suffix_of(depth: str) -> str:
    """Suffix of picture files of a depth.

    Raises
    ------
    RetargetError : for a depth that is none of `DEPTHS`.
    """
    if depth not in DEPTHS:
        raise RetargetError(f"pictures of depth {depth!r} are not known, expected one of {', '.join(DEPTHS)}")
    return DEPTHS[depth][0]


def image_bytes(picture: FloatArray, depth: str) -> bytes:
    """A picture (H, W, 3), or (H, W, 4) with alpha, of values from 0 to 1, first row on top, as a file of `DEPTHS`.

    Raises
    ------
    RetargetError : for another depth.
    """
    suffix_of(depth)
    if depth == "exr":
        return exr_bytes(picture)
    whole = np.clip(picture, 0.0, 1.0)
    return png_bytes(
        np.rint(255 * whole).astype(np.uint8) if depth == "png8" else np.rint(65535 * whole).astype(np.uint16)
    )


def write_image(picture: FloatArray, path: Path, depth: str) -> None:
    """Write a picture; see `image_bytes`.

    Raises
    ------
    RetargetError : for another depth, or a suffix that is not that depth's.
    """
    data = image_bytes(picture, depth)
    if path.suffix.lower() != suffix_of(depth):
        raise RetargetError(f"{path} ends in {path.suffix!r}, expected {suffix_of(depth)!r} for {depth}")
    path.write_bytes(data)


def png_bytes(image: npt.NDArray[np.uint8] | npt.NDArray[np.uint16]) -> bytes:
    """An image (H, W, 3 or 4) of uint8 or uint16, first row on top, as a PNG file (RGB or RGBA)."""
    height, width, channels = image.shape
    depth = 8 * image.dtype.itemsize
    line = width * channels * image.dtype.itemsize
    lines = np.zeros((height, 1 + line), np.uint8)
    lines[:, 1:] = np.ascontiguousarray(image, image.dtype.newbyteorder(">")).view(np.uint8).reshape(height, line)
    if depth == 16:
        # Each line as its difference from the one above, the format's second filter: half the size for smooth maps.
        lines[1:, 1:] -= lines[:-1, 1:].copy()
        lines[1:, 0] = 2
    header = struct.pack(">IIBBBBB", width, height, depth, 2 if channels == 3 else 6, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(lines.tobytes(), 6)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in chunks
    )


def exr_bytes(picture: FloatArray) -> bytes:
    """A picture (H, W, 3 or 4), first row on top, as an OpenEXR file: scan lines of 32-bit floats, ZIP-compressed."""
    height, width, count = picture.shape
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    names = (b"A", b"B", b"G", b"R")[-count:]
    channels = b"".join(name + b"\0" + struct.pack("<iBxxxii", 2, 0, 1, 1) for name in names) + b"\0"
    header = b"".join(
        name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value
        for name, kind, value in (
            (b"channels", b"chlist", channels),
            (b"compression", b"compression", b"\x03"),
            (b"dataWindow", b"box2i", window),
            (b"displayWindow", b"box2i", window),
            (b"lineOrder", b"lineOrder", b"\0"),
            (b"pixelAspectRatio", b"float", struct.pack("<f", 1.0)),
            (b"screenWindowCenter", b"v2f", struct.pack("<2f", 0.0, 0.0)),
            (b"screenWindowWidth", b"float", struct.pack("<f", 1.0)),
        )
    )
    start = struct.pack("<2i", 20000630, 2) + header + b"\0"
    values = np.ascontiguousarray(picture[..., ::-1].transpose(0, 2, 1), "<f4")
    blocks = [
        struct.pack("<2i", first, len(packed)) + packed
        for first in range(0, height, _EXR_LINES)
        for packed in [_exr_packed(values[first : first + _EXR_LINES].tobytes())]
    ]
    offsets, place = [], len(start) + 8 * len(blocks)
    for block in blocks:
        offsets.append(place)
        place += len(block)
    return start + struct.pack(f"<{len(offsets)}Q", *offsets) + b"".join(blocks)


def _exr_packed(data: bytes) -> bytes:
    """Bytes as the format packs them: even ones first, as differences from the one before; or as they are."""
    whole = np.frombuffer(data, np.uint8)
    split = np.concatenate([whole[::2], whole[1::2]])
    split[1:] = split[1:] - split[:-1] + np.uint8(128)
    packed = zlib.compress(split.tobytes(), 6)
    return packed if len(packed) < len(data) else data
