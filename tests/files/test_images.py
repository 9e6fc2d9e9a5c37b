"""Pictures on disk, read back by Blender or by hand."""

import struct
import zlib
from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.normal_maps.encoding import as_picture
from facial_retarget_addon.files.images import exr_bytes, image_bytes, png_bytes, write_image

PICTURE = np.random.default_rng(4).random((37, 23, 3)).astype(np.float32)


def png_values(data: bytes) -> np.ndarray:
    """Values (H, W, 3 or 4) of a PNG file with lines unfiltered or filtered by the one above."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    place, chunks = 8, {}
    while place < len(data):
        size, kind = struct.unpack(">I4s", data[place : place + 8])
        body = data[place + 8 : place + 8 + size]
        assert struct.unpack(">I", data[place + 8 + size : place + 12 + size])[0] == zlib.crc32(kind + body)
        chunks[kind] = body
        place += 12 + size
    width, height, depth, colour, *rest = struct.unpack(">IIBBBBB", chunks[b"IHDR"])
    assert rest == [0, 0, 0]
    channels = {2: 3, 6: 4}[colour]
    lines = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), np.uint8).reshape(height, -1).copy()
    for row in range(height):
        assert lines[row, 0] == 0 or (lines[row, 0] == 2 and row)
        if lines[row, 0] == 2:
            lines[row, 1:] += lines[row - 1, 1:]
    kind = np.dtype(">u2" if depth == 16 else np.uint8)
    return np.ascontiguousarray(lines[:, 1:]).view(kind).reshape(height, width, channels)


@pytest.mark.parametrize(("depth", "most"), [("png8", 255), ("png16", 65535)])
def test_png_holds_the_picture_as_finely_as_it_says(depth: str, most: int) -> None:
    found = png_values(image_bytes(PICTURE, depth))
    np.testing.assert_allclose(found / most, PICTURE, atol=0.5001 / most)


def test_png_holds_whole_numbers_exactly() -> None:
    for kind in (np.uint8, np.uint16):
        image = np.random.default_rng(1).integers(0, np.iinfo(kind).max, (5, 7, 3)).astype(kind)
        np.testing.assert_array_equal(png_values(png_bytes(image)), image)


def exr_values(data: bytes) -> np.ndarray:
    """Values (H, W, 3 or 4) of an EXR file as `exr_bytes` writes them, by the published layout."""
    assert struct.unpack("<2i", data[:8]) == (20000630, 2)
    place, attributes = 8, {}
    while data[place]:
        name, _, rest = data[place:].partition(b"\0")
        _, _, rest = rest.partition(b"\0")
        (size,) = struct.unpack("<i", rest[:4])
        attributes[name.decode()] = rest[4 : 4 + size]
        place = len(data) - len(rest) + 4 + size
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    height, width = bottom - top + 1, right - left + 1
    channels = (len(attributes["channels"]) - 1) // 18
    assert left == top == 0
    count = -(-height // 16)
    offsets = struct.unpack(f"<{count}Q", data[place + 1 : place + 1 + 8 * count])
    lines = []
    for number, offset in enumerate(offsets):
        first, size = struct.unpack("<2i", data[offset : offset + 8])
        assert first == 16 * number
        block = data[offset + 8 : offset + 8 + size]
        whole = 4 * channels * width * min(16, height - first)
        if size < whole:
            delta = np.frombuffer(zlib.decompress(block), np.uint8).astype(np.int64)
            delta[1:] -= 128
            split = np.cumsum(delta).astype(np.uint8)
            plain = np.empty(whole, np.uint8)
            plain[::2], plain[1::2] = split[: (whole + 1) // 2], split[(whole + 1) // 2 :]
            block = plain.tobytes()
        lines.append(np.frombuffer(block, "<f4").reshape(-1, channels, width))
    return np.concatenate(lines).transpose(0, 2, 1)[..., ::-1]


def test_exr_holds_floats_as_they_are() -> None:
    np.testing.assert_array_equal(exr_values(exr_bytes(PICTURE)), PICTURE)
    smooth = np.repeat(np.linspace(-2, 3, 64, dtype=np.float32)[:, None, None], 48, axis=1) * np.ones(3, np.float32)
    np.testing.assert_array_equal(exr_values(exr_bytes(smooth)), smooth)


def test_a_depth_and_a_suffix_must_agree(tmp_path: Path) -> None:
    write_image(PICTURE, tmp_path / "normals.exr", "exr")
    assert (tmp_path / "normals.exr").read_bytes() == exr_bytes(PICTURE)
    with pytest.raises(RetargetError, match=r"normals.png ends in '.png', expected '.exr' for exr"):
        write_image(PICTURE, tmp_path / "normals.png", "exr")
    with pytest.raises(RetargetError, match="'jpeg' are not known, expected one of png8, png16, exr"):
        image_bytes(PICTURE, "jpeg")
    assert not (tmp_path / "normals.png").exists()


def test_normals_become_colours_with_green_up_or_down() -> None:
    vectors = np.zeros((2, 1, 3), np.float32)
    vectors[0, 0], vectors[1, 0] = (0, 0, 1), (0, 1, 0)
    np.testing.assert_allclose(as_picture(vectors), [[[0.5, 1, 0.5]], [[0.5, 0.5, 1]]])
    np.testing.assert_allclose(as_picture(vectors, directx=True), [[[0.5, 0, 0.5]], [[0.5, 0.5, 1]]])
