"""From two bare faces to a performance: points, a corrected example, preview and bake; saved and opened between."""

import bpy
import numpy as np
from drive import (
    OUT,
    area,
    click,
    drag,
    key,
    log,
    look,
    on_screen,
    open_section,
    open_tab,
    override,
    press_button,
    redo,
    region,
    screenshot,
    still,
    undo,
    wait,
    wait_until,
)
from stage import choose, clear, part, point_places, remember, shown

FRAMES = 12


def scenario():
    true = set_the_stage()
    yield from look("FRONT")
    yield from open_tab()
    yield from press_button("facial_retarget.feature_points", kind="TOOLS")
    for name in ("Actor", "Child"):
        yield from place_points(name, true[name])
    yield from save_and_open()
    yield from sculpt_example()
    yield from preview()
    yield from bake()


def set_the_stage() -> dict[str, dict[str, np.ndarray]]:
    """The built-in faces without their points; returns where those were."""
    clear()
    with override():
        bpy.ops.facial_retarget.add_faces("EXEC_DEFAULT", target="child", points=True)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 30, 29 + FRAMES
    true = {}
    for name in ("Actor", "Child"):
        true[name] = point_places(bpy.data.objects[name])
        bpy.data.objects[name].facial_retarget.points.clear()
    remember()
    return true


def points(name: str) -> dict[str, np.ndarray]:
    """Undo makes objects anew: they are looked up by name."""
    return point_places(bpy.data.objects[name])


def place_points(name: str, true: dict[str, np.ndarray]):
    """Five clicks, one of them undone and done again; all others accepted; one dragged, undone and redone."""
    log("points on", name)
    choose(bpy.data.objects[name])
    yield from look("FRONT", [bpy.data.objects[name]])
    yield from open_section("2. Feature Points")
    first = part("core.point_sets").FIRST_FIVE
    for point in first:
        yield from click(*on_screen(true[point]))
    assert tuple(points(name)) == first, list(points(name))
    yield from undo()
    assert tuple(points(name)) == first[:-1], list(points(name))
    yield from redo()
    assert tuple(points(name)) == first, list(points(name))
    screenshot(f"five_points_{name.lower()}")

    face = bpy.data.objects[name].facial_retarget
    yield from wait_until(lambda: len(face.points) + len(face.proposals) == face.set_size, "the proposals", 20)
    yield from press_button("facial_retarget.accept_points")
    wanted = part("core.point_sets").POINT_SETS[face.point_set]
    assert set(points(name)) == {point.name for point in wanted}, len(points(name))
    assert not len(face.proposals)
    yield from still()
    screenshot(f"accepted_{name.lower()}")

    before = points(name)
    start = np.array(on_screen(before["9.3"]))
    yield from drag(start, start + [9, 6])
    moved = points(name)
    assert np.abs(on_screen(moved["9.3"]) - start - [9, 6]).max() <= 1, (on_screen(moved["9.3"]), start)
    assert all((moved[point] == before[point]).all() for point in before if point != "9.3")
    yield from undo()
    assert (points(name)["9.3"] == before["9.3"]).all()
    yield from redo()
    assert (points(name)["9.3"] == moved["9.3"]).all()


def save_and_open():
    """What the artist has done is in the file."""
    yield from look("FRONT")
    before = {name: points(name) for name in ("Actor", "Child")}
    with override():
        bpy.ops.wm.save_as_mainfile(filepath=str(OUT / "points.blend"))
        bpy.ops.wm.read_homefile()
    yield from wait()
    assert "Child" not in bpy.data.objects
    with override():
        bpy.ops.wm.open_mainfile(filepath=str(OUT / "points.blend"))
    yield from wait()
    for name, places in before.items():
        assert list(points(name)) == list(places)
        assert all(np.allclose(points(name)[point], place, atol=1e-6) for point, place in places.items())
    assert bpy.context.scene.facial_retarget.target.name == "Child"


def sculpt_example():
    """A smile on both faces, by brush strokes that lift the corners of the mouth."""
    yield from open_tab()
    yield from open_section("3. Examples")
    yield from press_button("facial_retarget.create_examples")
    task = bpy.context.scene.facial_retarget
    assert "joy" in task.examples
    for side, thing in (("SOURCE", task.source), ("TARGET", task.target)):
        yield from press_button(f'sculpt_example(example="joy", side="{side}")')
        yield from wait()
        assert bpy.context.mode == "SCULPT"
        assert bpy.context.object == thing
        for corner in ("8.3", "8.4"):
            spot = np.array(on_screen(point_places(thing)[corner]))
            yield from drag(spot, spot + [0, 12], steps=6)
        yield from press_button("facial_retarget.stop_sculpting")
        assert bpy.context.mode == "OBJECT"
        keys = thing.data.shape_keys
        joy, basis = (key_shape(key) for key in (keys.key_blocks["joy"], keys.reference_key))
        size, height = np.linalg.norm(joy - basis, axis=1), np.ptp(basis[:, 1])
        assert size.max() > 0.003 * height, size.max() / height
        assert np.median(size) == 0, "the brush has reached half the face"
    screenshot("examples")


def key_shape(block: bpy.types.ShapeKey) -> np.ndarray:
    """(V, 3) positions in a shape key."""
    flat = np.empty(3 * len(block.points), np.float32)
    block.points.foreach_get("co", flat)
    return flat.reshape(-1, 3)


def preview():
    """While the mouse scrubs, the target follows; off, nothing of it is left."""
    task = bpy.context.scene.facial_retarget
    names = [block.name for block in task.target.data.shape_keys.key_blocks]
    rest = shown(task.target)
    yield from open_section("4. Retarget")
    yield from press_button("facial_retarget.start_preview")
    yield from wait_until(lambda: part("preview_state").STATE.on, "the preview")
    yield from wait()
    bar = region("WINDOW", area("DOPESHEET_EDITOR"))
    height = bar.y + bar.height - 10
    seen = []
    for share in (0.35, 0.5):
        yield from drag((bar.x + 0.3 * bar.width, height), (bar.x + share * bar.width, height), steps=4)
        yield from still()
        seen.append(shown(task.target))
    screenshot("preview")
    assert np.abs(seen[0] - seen[1]).max() > 0.005 * np.ptp(rest[:, 1]), "the target does not follow"
    yield from press_button("facial_retarget.stop_preview")
    assert [block.name for block in task.target.data.shape_keys.key_blocks] == names
    assert (shown(task.target) == rest).all()


def bake():
    """Esc half-way, then to the end; one undo step; glTF."""
    task = bpy.context.scene.facial_retarget
    names = [block.name for block in task.target.data.shape_keys.key_blocks]
    yield from press_button("facial_retarget.retarget")
    yield from wait(3)
    yield from key("ESC")
    yield from wait()
    assert [block.name for block in task.target.data.shape_keys.key_blocks] == names
    yield from press_button("facial_retarget.retarget")
    yield from wait_until(lambda: "frame_0030" in task.target.data.shape_keys.key_blocks, "the bake", 90)
    yield from wait()
    baked = [block.name for block in task.target.data.shape_keys.key_blocks if block.name.startswith("frame_")]
    assert len(baked) == FRAMES, baked
    moments = []
    for frame in range(30, 30 + FRAMES):
        bpy.context.scene.frame_set(frame)
        moments.append(shown(task.target))
    assert np.ptp(moments, axis=0).max() > 0.01 * np.ptp(moments[0][:, 1])
    screenshot("baked")
