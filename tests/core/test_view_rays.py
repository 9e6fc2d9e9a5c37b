"""Pixels and rays agree, whatever the view."""

import numpy as np
import pytest

from facial_retarget_addon.core.arrays import FloatArray
from facial_retarget_addon.core.view_rays import View

SIZE = np.array([800.0, 600.0])


def perspective(lens: float, near: float, far: float, shift: float = 0.0) -> FloatArray:
    depth = near - far
    return np.array(
        [
            [lens, 0, shift, 0],
            [0, lens * SIZE[0] / SIZE[1], 0, 0],
            [0, 0, (far + near) / depth, 2 * far * near / depth],
            [0, 0, -1, 0],
        ]
    )


def orthographic(scale: float, depth: float, shift: float = 0.0) -> FloatArray:
    return np.array([[scale, 0, 0, shift], [0, scale * SIZE[0] / SIZE[1], 0, 0], [0, 0, -1 / depth, 0], [0, 0, 0, 1.0]])


def turned(rng: np.random.Generator, distance: float) -> FloatArray:
    """A view from anywhere onto the middle of the world."""
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    view = np.eye(4)
    view[:3, :3] = turn * np.sign(np.linalg.det(turn))
    view[2, 3] = -distance
    return view


WINDOWS = {
    "perspective": perspective(1.4, 0.01, 1000),
    "shifted": perspective(3.0, 0.1, 100, 0.4),
    "orthographic": orthographic(0.3, 50),
    "shifted orthographic": orthographic(0.3, 50, -0.2),
}


@pytest.mark.parametrize("window", WINDOWS)
def test_what_a_ray_meets_is_seen_at_its_pixel(window: str) -> None:
    rng = np.random.default_rng(2)
    for _ in range(20):
        view = View(SIZE, turned(rng, 6.0), WINDOWS[window])
        pixel = rng.uniform(0, SIZE)
        origin, direction = view.ray(pixel)
        along = origin + np.array([0.1, 3.0, 20.0])[:, None] * direction
        np.testing.assert_allclose(view.pixels(along), np.repeat(pixel[None], 3, axis=0), atol=1e-6)
        assert np.linalg.norm(direction) == pytest.approx(1)


@pytest.mark.parametrize("window", WINDOWS)
def test_a_ray_begins_on_the_near_plane_and_leads_away(window: str) -> None:
    view = View(SIZE, turned(np.random.default_rng(3), 6.0), WINDOWS[window])
    origin, direction = view.ray(np.array([123.0, 456.0]))
    clip = (view.window @ view.view) @ np.array([[*origin, 1], [*(origin + 5 * direction), 1]]).T
    assert clip[2, 0] / clip[3, 0] == pytest.approx(-1)
    assert clip[2, 1] / clip[3, 1] > -1


@pytest.mark.parametrize("window", WINDOWS)
def test_a_pixel_is_as_long_as_two_places_a_pixel_apart(window: str) -> None:
    view = View(SIZE, turned(np.random.default_rng(4), 6.0), WINDOWS[window])
    across = np.linalg.inv(view.view)[:3, 0]
    length = view.pixel_length(np.zeros(3))
    pixels = view.pixels(np.array([np.zeros(3), length * across]))
    np.testing.assert_allclose(pixels[1] - pixels[0], [1, 0], atol=1e-9)


def test_what_is_behind_the_eye_has_no_pixel() -> None:
    view = View(SIZE, turned(np.random.default_rng(5), 6.0), WINDOWS["perspective"])
    eye = np.linalg.inv(view.view)[:3, 3]
    assert np.isnan(view.pixels(2 * eye[None])).all()
