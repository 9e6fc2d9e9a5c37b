"""A generic head morphed by its feature points alone."""

import numpy as np
import pytest

from facial_retarget_addon import demo
from facial_retarget_addon.core.acting.morph import morph_to_points
from facial_retarget_addon.core.errors import RetargetError


@pytest.fixture(scope="module")
def head() -> demo.DemoFace:
    return demo.actor(vertices=6000)


@pytest.fixture(scope="module")
def other() -> demo.DemoFace:
    return demo.targets()[0]


def places(face: demo.DemoFace) -> dict[str, np.ndarray]:
    points = face.face.points
    return dict(zip(points.names, points.positions(face.face.mesh.vertices), strict=True))


def test_every_point_arrives(head: demo.DemoFace, other: demo.DemoFace) -> None:
    wanted = places(other)
    morph = morph_to_points(head.face.mesh, head.face.points, wanted)
    found = head.face.points.positions(morph.positions)
    goal = np.array([wanted[name] for name in head.face.points.names])
    assert np.abs(found - goal).max() < 1e-4 * other.face.mesh.size


def test_a_head_comes_nearer_to_the_other_than_by_its_placement_alone(
    head: demo.DemoFace, other: demo.DemoFace
) -> None:
    held_back = [name for name in head.face.points.names if name.startswith(("cheek", "forehead", "jaw"))]
    wanted = {name: place for name, place in places(other).items() if name not in held_back}
    morph = morph_to_points(head.face.mesh, head.face.points, wanted)
    goal = np.array([places(other)[name] for name in held_back])
    rows = head.face.points.subset(held_back)
    before = np.linalg.norm(rows.positions(morph.placed.apply(head.face.mesh.vertices)) - goal, axis=1).mean()
    after = np.linalg.norm(rows.positions(morph.positions) - goal, axis=1).mean()
    assert after < 0.8 * before


def test_its_own_points_leave_a_head_as_it_is(head: demo.DemoFace) -> None:
    morph = morph_to_points(head.face.mesh, head.face.points, places(head))
    assert np.abs(morph.positions - head.face.mesh.vertices).max() < 1e-5 * head.face.mesh.size


def test_too_few_places_are_one_sentence(head: demo.DemoFace) -> None:
    with pytest.raises(RetargetError, match=r"1 of the 2 wanted places have a point .* expected at least 4"):
        morph_to_points(head.face.mesh, head.face.points, {"2.1": np.zeros(3), "unheard_of": np.ones(3)})


def test_a_place_that_is_no_number_is_one_sentence(head: demo.DemoFace) -> None:
    wanted = places(head) | {"2.1": np.full(3, np.nan)}
    with pytest.raises(RetargetError, match="NaN or infinite"):
        morph_to_points(head.face.mesh, head.face.points, wanted)
