"""What is drawn over the views compiles, and paints the right pixels, in Blenders whose window no test opens.

A render engine gets a true GPU context, in background too; without one Blender 4.5 and 5.0 draw nothing there.
"""

import os
import sys
import traceback
from collections.abc import Callable
from ctypes import CDLL
from types import SimpleNamespace

import bpy
import numpy as np
from mathutils import Matrix
from stage import empty_scene, grid, part

SIZE = 200
"""Pixels of the picture that is drawn on, both ways."""
FLAT = Matrix(((2 / SIZE, 0, 0, -1), (0, 2 / SIZE, 0, -1), (0, 0, -0.01, 0), (0, 0, 0, 1)))
"""From pixels to clip space; a place is nearer the higher its z is, -100 to 100."""
NOWHERE = Matrix.Identity(4)
BLACK = (0.0, 0.0, 0.0)

try:
    CDLL("libEGL.so.1")
except OSError:
    assert not os.environ.get("CI"), "CI always draws, and that needs libEGL.so.1"
    print("libEGL.so.1 is not here: nothing is drawn")
    sys.exit()

empty_scene()
context = bpy.context
face = grid("face", 21)
face.matrix_world = Matrix.Translation((100, 100, 0)) @ Matrix.Scale(80, 4)
face.shape_key_add(name="Basis", from_mix=False)
key = face.shape_key_add(name="pulled", from_mix=False)
for row in range(10, 21):  # the right half is stretched, to the right
    for vertex in range(row, 441, 21):
        key.data[vertex].co.x += 0.05 * (row - 10)
key.value = 1.0
context.view_layer.objects.active = face
context.view_layer.update()
task = context.scene.facial_retarget
task.target = face
# Without a window Blender has no scale of its interface.
preferences = SimpleNamespace(system=SimpleNamespace(ui_scale=1.0))
seen_by = SimpleNamespace(scene=context.scene, view_layer=context.view_layer, preferences=preferences)


def painted(draw: Callable[[], object]) -> np.ndarray:
    """(SIZE, SIZE, 3) what `draw` leaves on black paper, by row from the lower left corner."""
    import gpu

    screen = gpu.types.GPUOffScreen(SIZE, SIZE)
    with screen.bind():
        buffer = gpu.state.active_framebuffer_get()
        buffer.clear(color=(*BLACK, 1.0), depth=1.0)
        with gpu.matrix.push_pop(), gpu.matrix.push_pop_projection():
            gpu.matrix.load_matrix(NOWHERE)
            gpu.matrix.load_projection_matrix(FLAT)
            draw()
        pixels = np.array(buffer.read_color(0, 0, SIZE, SIZE, 4, 0, "FLOAT").to_list())
    screen.free()
    return pixels.reshape(SIZE, SIZE, 4)[..., :3]


def has(pixel: np.ndarray, colour: object) -> bool:
    """Whether a pixel has a colour, as exactly as eight bits tell."""
    return bool(np.abs(pixel - np.array(colour)).max() < 0.02)


def check_marks() -> None:
    """Each mark has its shape and colour; what lies behind a surface is faint."""
    marks = part("viewport.marks")
    batch = marks.mark_batch(np.array([(30.0 + 35 * shape, 100, 0) for shape in range(5)]), range(5))
    shown = painted(lambda: marks.draw_marks(batch, NOWHERE, FLAT, 8.0, -1, flat=True))
    disc, ring, chosen, doubtful, wanted = (shown[100, 30 + 35 * shape] for shape in range(5))
    assert has(disc, marks.COLOURS[marks.PLACED])
    assert has(ring, BLACK)
    assert has(wanted, BLACK)
    assert has(shown[100, 73], marks.COLOURS[marks.PROPOSED])
    assert has(chosen, (0.95, 0.95, 0.95))
    assert not has(doubtful, marks.COLOURS[marks.DOUBTFUL]), "the exclamation mark is dark"
    assert has(shown[96, 139], marks.COLOURS[marks.DOUBTFUL])
    larger = painted(lambda: marks.draw_marks(batch, NOWHERE, FLAT, 8.0, 0, flat=True))
    assert has(shown[100, 38], BLACK)
    assert has(larger[100, 38], marks.COLOURS[marks.PLACED]), "the one under the mouse is larger"

    def behind() -> None:
        heat = part("viewport.shaders").heat_shader()  # the only one of ours that hides what lies behind
        wall = batch_of(heat, [(0, 0, 50), (SIZE, 0, 50), (SIZE, SIZE, 50), (0, SIZE, 50)], [9.0] * 4)
        draw_heated(heat, wall)
        marks.draw_marks(batch, NOWHERE, FLAT, 8.0, -1, flat=False)

    wall, faint = painted(behind)[[20, 100], 30]
    share = marks.HIDDEN_STRENGTH
    assert has(faint, (1 - share) * wall + share * np.array(marks.COLOURS[marks.PLACED])), (wall, faint)


def batch_of(shader: object, places: list[tuple[float, ...]], values: list[float]) -> object:
    """A square for the heat map's shader."""
    from gpu_extras.batch import batch_for_shader

    return batch_for_shader(shader, "TRIS", {"pos": places, "value": values}, indices=[(0, 1, 2), (0, 2, 3)])


def draw_heated(shader: object, batch: object) -> None:
    """Draw it from 1 to 3."""
    shaders = part("viewport.shaders")
    shader.bind()
    shader.uniform_float("matrix", FLAT)
    shader.uniform_float("lens", shaders.lens(FLAT))
    shader.uniform_float("viewport", (SIZE, SIZE))
    shader.uniform_float("low", 1.0)
    shader.uniform_float("high", 3.0)
    with shaders.drawing("LESS_EQUAL", writes_depth=True):
        batch.draw(shader)


def check_lines() -> None:
    """A line is as wide as it shall be, with dark sides."""
    lines = part("viewport.lines")
    batch = lines.line_batch(np.array([[(20, 50, 0), (180, 50, 0)]]))
    shown = painted(lambda: lines.draw_lines(batch, NOWHERE, FLAT, 5.0, (0.2, 0.9, 0.4)))
    assert has(shown[50, 100], (0.2, 0.9, 0.4))
    assert 4 <= (shown[:, 100, 1] > 0.5).sum() <= 6, shown[:, 100, 1]
    assert has(shown[50, 5], BLACK)
    assert has(shown[60, 100], BLACK)


def check_heat() -> None:
    """The half that is stretched is warm, the other half is not; its legend stands on the region."""
    heat = part("viewport.heat")
    task.overlay.heat = "STRETCH"
    shown = painted(lambda: heat.draw_heat(context, face, NOWHERE, FLAT))
    assert shown[100, 130].max() > 0.2, shown[100, 130]
    assert has(shown[100, 50], BLACK)
    legend = painted(lambda: heat.draw_legend(seen_by, face))
    assert legend[40:90, 70:].max() > 0.5, "the bar of colours and its figures"


def check_trouble() -> None:
    """Edges among the vertices of the chosen finding are drawn while its shape key is on."""
    findings, trouble = part("bridge.reports.findings"), part("viewport.trouble")
    spots = part("core.quality").Spots(*(np.arange(first, first + 21) for first in (0, 42, 210, 399)))
    row = {"name": "pulled", "torn_edges": 9, "flipped_triangles": 9, "lip_gap_percent": 9.0, "lid_gap_percent": 9.0}
    findings.write_key_findings(face, {"pulled": findings.Finding(row, spots)})
    face.facial_retarget.active_finding = 0
    context.view_layer.update()
    shown = painted(lambda: trouble.draw_trouble_spots(seen_by, face, NOWHERE, FLAT))
    for vertices, kept in ((210, "lip_vertices"), (399, "lid_vertices"), (0, "torn_vertices"), (42, "turned_vertices")):
        _, y, _ = face.matrix_world @ face.data.vertices[vertices].co
        colour = trouble.LOOKS[kept][0]
        assert has(shown[round(y) - 2 : round(y) + 3, 60].max(axis=0), colour), (kept, shown[round(y), 60], colour)
    key.value = 0.0
    context.view_layer.update()
    assert not painted(lambda: trouble.draw_trouble_spots(seen_by, face, NOWHERE, FLAT)).any()
    key.value = 1.0


def check_region() -> None:
    """Names on their boxes, and the face of the diagram."""
    labels, diagram = part("viewport.labels"), part("viewport.diagram")
    placed = list(labels.spread_labels([labels.Label("2.1", 100, 100, 6)], (), 1.0, SIZE, SIZE))
    ((left, bottom, right, top), _) = placed[0]
    shown = painted(lambda: labels.draw_labels(placed, 1.0))
    inside = shown[round(bottom) : round(top), round(left) : round(right)]
    assert inside.max() > 0.8, "light letters"
    outside = shown.copy()
    outside[round(bottom) - 1 : round(top) + 1, round(left) - 1 : round(right) + 1] = 0
    assert not outside.any()
    drawn = painted(lambda: diagram._draw_face((100.0, 80.0), 55.0, 1.0))
    assert 0.01 < (drawn.max(axis=2) > 0.3).mean() < 0.3, (drawn.max(axis=2) > 0.3).mean()
    points = painted(lambda: diagram._draw_points((100.0, 80.0), 55.0, 1.0, "9.3", ("2.1",)))
    x, y = (round(v) for v in 55 * np.array(part("core.point_sets").POINT_INFOS["9.3"].diagram) + (100, 80))
    assert has(points[y, x], (0.95, 0.95, 0.95))


CHECKS = (check_marks, check_lines, check_heat, check_trouble, check_region)
seen = SimpleNamespace(done=0, wrong=[])


class Probe(bpy.types.RenderEngine):
    """Draws."""

    bl_idname, bl_label, bl_use_gpu_context = "FACIAL_RETARGET_PROBE", "Probe", True

    def render(self, depsgraph: object) -> None:
        """Run all checks: Blender prints what a render raises, and goes on."""
        for check in CHECKS:
            try:
                check()
                seen.done += 1
            except BaseException:
                seen.wrong.append(traceback.format_exc())


bpy.utils.register_class(Probe)
render, camera = context.scene.render, bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
render.engine, render.resolution_x, render.resolution_y = Probe.bl_idname, 8, 8
context.scene.collection.objects.link(camera)
context.scene.camera = camera
bpy.ops.render.render()
print(f"{seen.done} of {len(CHECKS)} checks", *seen.wrong, sep="\n", flush=True)
os._exit(seen.done != len(CHECKS))  # Blender 4.5 as a module never comes to its end once it has drawn
