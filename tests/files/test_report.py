"""The report's page: everything is on it, nothing is fetched, and names cannot break it."""

from __future__ import annotations

import base64
import re
from html.parser import HTMLParser

import numpy as np
import pytest

from facial_retarget_addon.core.level_retargeter import LevelMotion
from facial_retarget_addon.core.points import FeaturePoints
from facial_retarget_addon.core.problem import Face, Problem
from facial_retarget_addon.files.pages.report import render, report_json, report_page
from facial_retarget_addon.files.pages.report_pictures import Moment, level_pictures, liveliest, moments

from .conftest import bump, dome, dome_points

REPORT = {
    "job": "<b>job & co</b>.toml",
    "method": "hierarchical",
    "scale": 2.5,
    "levels": [{"level": 1, "vertices": 1234, "source_piercing_errors": 7}],
    "examples": [{"name": "joy</td>", "fit": float("nan"), "leave_one_out": 0.25}],
    "quality": {"torn_edges": 3, "flipped_triangles": 0, "worst_frame": 2},
    "warnings": ["mind the <gap>"],
    "seconds": {"fit": 1.25},
    "invented": {"by_a_later_method": True},
}
MOMENTS = [Moment(0, b"one", b"two"), Moment(1, b"three", b"four")]


class Page(HTMLParser):
    """Collects the tags and texts of a page, and checks that tags close in order."""

    def __init__(self, page: bytes) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.open: list[str] = []
        self.texts: list[str] = []
        self.feed(page.decode())
        assert self.open == []

    def handle_starttag(self, tag: str, attributes: object) -> None:
        self.tags.append(tag)
        if tag not in ("meta", "img"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.texts.append(data)


def test_everything_is_on_the_page():
    page = Page(render(REPORT, MOMENTS, 9))
    for text in (
        "Retargeting report: <b>job & co</b>.toml",
        "mind the <gap>",
        "joy</td>",
        "1,234",
        "2.5",
        "0.25",
        "–",
        "by a later method",
        "yes",
        "Frame 2, the worst: most torn edges and flipped triangles",
    ):
        assert text in page.texts
    assert page.tags.count("img") == 4
    assert "b" not in page.tags


def test_nothing_is_fetched_and_nothing_runs():
    page = render(REPORT, MOMENTS, 9).decode()
    assert re.findall(r'src="(?!data:image/png;base64,)', page) == []
    for word in ("http", "<script", "<link", "@import", "url("):
        assert word not in page


def test_a_report_with_nothing_in_it_is_a_page():
    assert "Retargeting report" in Page(render({}, [], 1)).texts


def test_a_number_that_does_not_exist_is_null():
    assert b'"fit": null' in report_json(REPORT)


def test_the_liveliest_frame_of_each_span():
    mesh = dome(5).mesh
    frames = np.repeat(mesh.vertices[None], 12, axis=0)
    frames[[1, 8], :, 2] += [[0.5], [0.2]]
    assert liveliest(mesh.vertices, frames, 2) == [1, 8]
    assert liveliest(mesh.vertices, frames[:3], 6) == [0, 1, 2]


@pytest.fixture
def problem() -> Problem:
    faces = [Face(dome(side).mesh, dome_points(side)) for side in (21, 16)]
    return Problem(*faces)


def test_pictures_show_source_and_target_of_the_chosen_frames(problem):
    frames = [np.stack([face.mesh.vertices, bump(face.mesh, 0.0, 0.3)]) for face in (problem.source, problem.target)]
    still, acting = moments(problem, *frames, chosen=[0, 1])
    assert (still.frame, acting.frame) == (0, 1)
    assert len({still.source, still.target, acting.source, acting.target}) == 4


def test_a_face_is_seen_from_in_front_however_it_stands(problem):
    """A face that stands along Z, as Blender's do, gives the picture of the same face along Y."""
    turn = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    lying = Face(problem.source.mesh.with_vertices(problem.source.mesh.vertices @ turn.T), problem.source.points)
    vertices = bump(problem.source.mesh, 0.2, 0.2)
    pair = Problem(problem.source, lying)
    (seen,) = moments(pair, vertices[None], vertices[None] @ turn.T, chosen=[0])
    assert seen.source == seen.target


def test_a_face_without_points_has_pictures_too(problem):
    bare = Face(problem.target.mesh, FeaturePoints((), np.empty((0, 3), np.int64), np.empty((0, 3))))
    frames = problem.source.mesh.vertices[None], problem.target.mesh.vertices[None]
    page = report_page(REPORT, Problem(problem.source, bare), *(np.repeat(f, 2, axis=0) for f in frames)).decode()
    pictures = [base64.b64decode(text) for text in re.findall(r'base64,([^"]+)"', page)]
    assert len(pictures) == 4
    assert all(picture.startswith(b"\x89PNG") for picture in pictures)


def test_a_row_shows_the_motion_level_upon_level(problem):
    target = problem.target.mesh.vertices
    moving = np.stack([problem.source.mesh.vertices, bump(problem.source.mesh, 0.0, 0.3)])
    whole = bump(problem.target.mesh, 0.0, 0.3) - target

    def levels(frames):
        assert frames.shape[0] == 1
        return [LevelMotion("base", 0.75 * whole[None]), LevelMotion("level 1", 0.25 * whole[None])]

    row = level_pictures(problem, moving, levels)
    assert row.frame == 1
    assert [name for name, _, _ in row.levels] == ["base", "level 1"]
    assert row.levels[0][2] == pytest.approx(3 * row.levels[1][2])
    assert row.levels[0][1] != row.levels[1][1]
    text = render(REPORT, MOMENTS, 9, row).decode()
    assert "Frame 2, level upon level" in text
    assert text.count("<img") == 2 * len(MOMENTS) + 2
    frames = moving, np.stack([target, target + whole])
    assert "level upon level" in report_page(REPORT, problem, *frames, levels).decode()
    assert "level upon level" not in report_page(REPORT, problem, *frames).decode()
