"""The report in the view: heat map with its legend, torn edges drawn and selected, a click in the list goes there."""

import bpy
import numpy as np
from drive import (
    area,
    click,
    find_button,
    look,
    on_screen,
    open_section,
    open_tab,
    region,
    screenshot,
    still,
    wait,
)
from stage import add_face, choose, clear, part

PINK, BLUE = np.array([255, 38, 140]), np.array([64, 217, 255])
"""Of torn edges, and of lips and lids that gape."""


def picture(name: str) -> np.ndarray:
    """(height, width, 3) what the window shows, from its lower left corner."""
    yield from still()
    image = bpy.data.images.load(str(screenshot(name)))
    pixels = np.empty(4 * image.size[0] * image.size[1], np.float32)
    image.pixels.foreach_get(pixels)
    shape = (image.size[1], image.size[0], 4)
    bpy.data.images.remove(image)
    return np.round(255 * pixels.reshape(shape)[..., :3]).astype(int)


def warmth(shown: np.ndarray, place: np.ndarray) -> int:
    """How much colour is at a place of the scene; grey has none."""
    x, y = (round(v) for v in on_screen(place))
    return int(np.ptp(shown[y - 2 : y + 3, x - 2 : x + 3], axis=2).max())


def coloured(shown: np.ndarray, colour: np.ndarray) -> int:
    """How many pixels of the view have a colour."""
    view = region()
    inside = shown[view.y : view.y + view.height, view.x : view.x + view.width]
    return int((np.abs(inside - colour).max(axis=2) < 12).sum())


def scenario():
    clear()
    demo, quality, findings = part("demo"), part("core.quality"), part("bridge.reports.findings")
    built = demo.actor(4_000)
    source, target = add_face(built, "Source", -1.3), add_face(built, "Target", 1.3)
    task, scene = bpy.context.scene.facial_retarget, bpy.context.scene
    task.source, task.target = source, target
    task.overlay.show_points = task.overlay.show_diagram = False
    scene.frame_start, scene.frame_end = 1, 4

    # What a bake leaves behind: the chin is pulled down in frame 2, the brow up in frame 3, the jaw opens in frame 4.
    mesh, points = built.face.mesh, built.face.points
    chin, brow = points.subset(["2.1"]).holders[0], points.subset(["4.3"]).holders[0]
    frames = np.repeat(mesh.vertices[None].astype(np.float32), 4, axis=0)
    frames[3] = built.frames(demo.contractions({"jaw": 1.0}))[0]
    for frame, vertex, way in ((1, chin, -0.5), (2, brow, 0.5)):
        near = np.exp(-np.square(mesh.vertices - mesh.vertices[vertex]).sum(axis=1) / 0.02)
        frames[frame, :, 1] += way * near
    gaps = part("core.seams.gaps").SeamGaps(part("core.problem").Problem(built.face, built.face))
    judged = quality.Quality(mesh, mesh, np.arange(len(mesh.vertices)), gaps)
    judged.add(frames[[0, 0, 0, 0]], frames)
    part("bridge.bakes.frames").write_frames(target, frames, 1)
    result = type("Result", (), {})()
    result.spots, result.per_frame, result.counterpart = judged.spots, judged.per_frame(), np.arange(len(mesh.vertices))
    findings.write_frame_findings(target, source, result, range(1, 1 + len(result.spots)))
    known = target.facial_retarget
    assert len(known.findings) == 3, known.findings_text
    choose(target)
    yield from look("FRONT", [source, target])

    # The list: a click on its second row goes to that row's frame.
    yield from open_tab()
    yield from open_section("6. Report")
    x, y = yield from find_button("select_trouble")
    height = 20 * bpy.context.preferences.system.ui_scale
    yield from click(x, y + 4.8 * height)
    assert known.active_finding == 1, known.active_finding
    assert scene.frame_current == known.findings[1].frame
    screenshot("list")

    # Its torn edges are drawn; at another frame they are not.
    task.overlay.show_heat = True
    area().tag_redraw()
    marked = yield from picture("torn_edges")
    assert coloured(marked, PINK) > 50, coloured(marked, PINK)
    scene.frame_set(1)
    rest = yield from picture("rest")
    assert coloured(rest, PINK) == 0

    # So are the edges of lips that gape.
    known.active_finding = known.findings.find("Frame 4")
    gaping = yield from picture("gaping_lips")
    assert coloured(gaping, BLUE) > 50, coloured(gaping, BLUE)

    # The heat map is warm where the face is stretched, cold elsewhere, and follows the frames.
    world = np.array(target.matrix_world)

    def place(frame: int, name: str) -> np.ndarray:
        return world[:3, :3] @ points.subset([name]).positions(frames[frame].astype(float))[0] + world[:3, 3]

    known.active_finding = -1
    for kind in ("STRETCH", "BEYOND", "MOTION"):
        task.overlay.heat = kind
        for frame, name, other in ((1, "2.10", "4.3"), (2, "4.3", "2.10")):
            scene.frame_set(frame + 1)
            shown = yield from picture(f"{kind.lower()}_{frame + 1}")
            assert warmth(shown, place(frame, name)) > 40, (kind, frame, warmth(shown, place(frame, name)))
            assert warmth(shown, place(frame, other)) < 15, (kind, frame, warmth(shown, place(frame, other)))
    task.overlay.show_heat = False
    area().tag_redraw()
    shown = yield from picture("off")
    assert warmth(shown, place(2, "4.3")) < 15

    # Select does.
    for frame, kind, kept in (("Frame 2", "TORN", "torn_vertices"), ("Frame 4", "LIPS", "lip_vertices")):
        known.active_finding = known.findings.find(frame)
        yield from wait()
        wanted = f'facial_retarget.select_trouble(kind="{kind}")'
        yield from click(*(yield from find_button(wanted, across=(0.43, 0.71))))
        assert bpy.context.mode == "EDIT_MESH"
        screenshot(f"selected_{kind.lower()}")
        bpy.ops.object.mode_set(mode="OBJECT")
        chosen = np.empty(len(mesh.vertices), bool)
        target.data.vertices.foreach_get("select", chosen)
        rows = findings.unpacked(getattr(known.findings[frame], kept))
        assert np.array_equal(np.flatnonzero(chosen), rows), (frame, kind)
