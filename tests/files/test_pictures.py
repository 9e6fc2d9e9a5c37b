"""Pictures: light falls where it should, the camera stands where it says, and the PNG holds the pixels."""

import struct
import zlib

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.files.images import png_bytes
from facial_retarget_addon.files.pages.pictures import BACKGROUND, Camera, contact_sheet, mark, shade


def ball(rings=24, sides=48):
    """A unit sphere as (vertices, faces)."""
    t, p = np.meshgrid(np.linspace(0, np.pi, rings), np.linspace(0, 2 * np.pi, sides, endpoint=False), indexing="ij")
    vertices = np.stack([np.sin(t) * np.sin(p), np.cos(t), np.sin(t) * np.cos(p)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(rings - 1), np.arange(sides), indexing="ij")
    a, b = i * sides + j, i * sides + (j + 1) % sides
    quads = np.stack([a, a + sides, b + sides, b], axis=-1).reshape(-1, 4)
    return vertices, np.concatenate([quads[:, :3], quads[:, [0, 2, 3]]])


BACKGROUND_BYTES = np.rint(255 * BACKGROUND).astype(np.uint8)


def test_a_ball_covers_its_disc_and_nothing_else():
    vertices, faces = ball()
    image = shade(vertices, faces, size=(80, 60))
    covered = (image != BACKGROUND_BYTES).any(axis=2)
    row, column = np.mgrid[0:60, 0:80] + 0.5
    radius = np.hypot(column - 40, row - 30)
    edge = np.sqrt(covered.sum() / np.pi)
    assert 24 < edge < 30
    assert covered[radius < edge - 1.5].all()
    assert not covered[radius > edge + 1.5].any()


def test_the_key_light_comes_from_the_left():
    image = shade(*ball(), size=(60, 60)).astype(float)
    assert image[30, 15].sum() > 1.3 * image[30, 45].sum()


def test_the_eye_walks_around_the_face():
    vertices, faces = ball()
    nose = vertices + 0.8 * np.maximum(vertices[:, 2:] - 0.9, 0) / 0.1 * np.array([0, 0, 1.0])
    frame = 2.0 * vertices
    front, left = (shade(nose, faces, (80, 80), (turn, 0), frame) for turn in (0.0, 90.0))
    covered = [(image != BACKGROUND_BYTES).any(axis=2) for image in (front, left)]
    width = [np.flatnonzero(c.any(axis=0)) for c in covered]
    # From the face's left (+X) its nose points to the left of the picture.
    assert np.ptp(width[1]) > np.ptp(width[0]) + 5
    assert 40 - width[1].min() > width[1].max() - 39 + 5


def test_projection_inverts_the_rays():
    camera = Camera.framing(ball()[0], (90, 70), turn=30.0, tilt=-20.0)
    places = np.random.default_rng(1).uniform((0, 0), (90, 70), (50, 2))
    through = camera.eye + 3.0 * camera.distance * camera.rays(places[:, 0], places[:, 1])
    np.testing.assert_allclose(camera.project(through), places, atol=1e-9)


def test_the_whole_frame_is_seen():
    corners = np.array(np.meshgrid([-1, 1], [-2, 2], [-3, 3])).reshape(3, -1).T
    for turn, tilt in ((0, 0), (40, 20), (-90, 60)):
        places = Camera.framing(corners, (200, 100), turn, tilt).project(corners)
        assert (places > 0).all()
        assert (places < [200, 100]).all()


def test_a_fixed_frame_keeps_the_camera_still():
    vertices, faces = ball()
    moved = vertices + np.array([0.5, 0.0, 0.0])
    frame = 2.0 * vertices
    middle = [
        np.argwhere((shade(v, faces, (80, 80), frame=frame) != BACKGROUND_BYTES).any(axis=2)).mean(axis=0)
        for v in (vertices, moved)
    ]
    assert middle[1][1] - middle[0][1] > 5


def test_colours_reach_the_picture():
    vertices, faces = ball()
    red = np.broadcast_to([0.8, 0.0, 0.0], vertices.shape)
    pixel = shade(vertices, faces, (40, 40), colours=red)[20, 20].astype(int)
    assert pixel[0] > pixel[1] + 60


def test_png_holds_the_pixels():
    image = np.random.default_rng(2).integers(0, 256, (13, 7, 3), dtype=np.uint8)
    data = png_bytes(image)
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, chunks = 8, {}
    while at < len(data):
        length = struct.unpack(">I", data[at : at + 4])[0]
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        assert struct.unpack(">I", data[at + 8 + length : at + 12 + length])[0] == zlib.crc32(kind + body)
        chunks[kind], at = body, at + 12 + length
    assert struct.unpack(">IIBBBBB", chunks[b"IHDR"]) == (7, 13, 8, 2, 0, 0, 0)
    lines = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), np.uint8).reshape(13, 22)
    assert not lines[:, 0].any()
    np.testing.assert_array_equal(lines[:, 1:].reshape(13, 7, 3), image)


def test_contact_sheet_lays_pictures_in_rows():
    pictures = [np.full((4, 6, 3), value, np.uint8) for value in (10, 20, 30)]
    sheet = contact_sheet(pictures, columns=2, gap=1)
    assert sheet.shape == (9, 13, 3)
    assert (sheet[:4, :6] == 10).all()
    assert (sheet[:4, 7:] == 20).all()
    assert (sheet[5:, :6] == 30).all()
    assert (sheet[5:, 6:] == 255).all()


def test_marks_are_drawn_and_cut_at_the_border():
    image = np.zeros((10, 10, 3), np.uint8)
    marked = mark(image, np.array([[5.5, 4.5], [0.0, 9.0], [-50.0, 3.0]]), (1, 2, 3), radius=1)
    assert not image.any()
    assert (marked[4, 5] == [1, 2, 3]).all()
    assert (marked[9, 0] == [1, 2, 3]).all()
    assert (marked != 0).any(axis=2).sum() == 9 + 4


def test_bad_input_is_named():
    vertices, faces = ball()
    with pytest.raises(RetargetError, match="NaN"):
        shade(np.where(np.arange(len(vertices))[:, None] == 3, np.nan, vertices), faces)
    with pytest.raises(RetargetError, match="0 x 10"):
        shade(vertices, faces, size=(0, 10))
    with pytest.raises(RetargetError, match="one size"):
        contact_sheet([], 2)
    with pytest.raises(RetargetError, match="finite"):
        Camera.framing(np.full((2, 3), np.nan), (10, 10))
