"""Five clicks on each built-in face land within a pixel; the others are proposed, accepted, dragged with mirroring."""

import bpy
import numpy as np
from drive import (
    click,
    drag,
    find_button,
    key,
    look,
    on_screen,
    open_section,
    open_tab,
    picture,
    press_button,
    redo,
    region,
    screenshot,
    still,
    undo,
    wait_until,
)
from stage import FACES, add_face, add_suzanne, clear, part, point_places, remember, small_face

FIRST = part("core.point_sets").FIRST_FIVE


def scenario():
    yield from open_tab()
    yield from open_section("2. Feature Points")
    yield from press_button("facial_retarget.feature_points", kind="TOOLS")
    bpy.context.scene.facial_retarget.mirror_points = True
    for name in FACES:
        clear()
        face = add_suzanne() if name == "Suzanne" else add_face(small_face(name), name)
        true = point_places(face)
        face.facial_retarget.points.clear()
        bpy.context.scene.facial_retarget.mirror_points = False
        remember()
        yield from look("FRONT", [face])
        for point in FIRST:
            yield from click(*on_screen(true[point]))
        assert tuple(places(name)) == FIRST, list(places(name))
        for point in FIRST:
            off = np.abs(np.subtract(on_screen(places(name)[point]), on_screen(true[point]))).max()
            assert off <= 1, (name, point, off)
        proposed = face.facial_retarget.set_size - 5
        yield from wait_until(lambda name=name: all_proposed(name), "the proposals", 20)

        if name == FACES[0]:
            accept = yield from find_button("facial_retarget.accept_points")
        before = picture()
        yield from click(*accept)
        assert len(places(name)) == proposed + 5, (name, len(places(name)))
        yield from still()
        assert (picture() != before)[:, : region("UI").x].sum() > 20 * proposed, "the view is not drawn anew"
        screenshot(name)
        yield from drag_mirrored(name)


def all_proposed(name: str) -> bool:
    """Whether all points of the set are placed or proposed."""
    face = bpy.data.objects[name].facial_retarget
    return len(face.points) + len(face.proposals) == face.set_size


def places(name: str) -> dict[str, np.ndarray]:
    """Undo makes objects anew: they are looked up by name."""
    return point_places(bpy.data.objects[name])


def drag_mirrored(name: str):
    """With X on, the other corner of the mouth goes up as far; undo and redo take both."""
    before = places(name)
    start = np.array(on_screen(before["8.3"]))
    yield from drag(start, start)
    yield from key("X")
    yield from drag(start, start + [0, 8])
    moved = places(name)
    up = {point: (moved[point] - before[point])[2] for point in ("8.3", "8.4")}
    assert np.abs(on_screen(moved["8.3"]) - start - [0, 8]).max() <= 1
    assert up["8.3"] > 0, up
    changed = {point for point in before if not np.array_equal(before[point], moved[point])}
    assert changed == {"8.3", "8.4"}, changed
    assert moved["8.4"][0] < moved["8.3"][0]
    yield from undo()
    assert all(np.array_equal(place, before[point]) for point, place in places(name).items())
    yield from redo()
    assert all(np.array_equal(place, moved[point]) for point, place in places(name).items())
