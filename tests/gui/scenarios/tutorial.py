"""The newcomer's walk of docs/tutorial.md, click by click; its pictures are that page's."""

import bpy
import numpy as np
from drive import (
    area,
    click,
    drag,
    illustrate,
    key,
    on_screen,
    open_tab,
    over_view,
    press_button,
    region,
    still,
    wait,
    wait_until,
    window,
)
from stage import part, point_places, shown

FIRST = part("core.point_sets").FIRST_FIVE


def scenario():
    yield from add_faces()
    yield from set_up_workspace()
    task = bpy.context.scene.facial_retarget
    for place, face in enumerate((task.source, task.target)):
        yield from place_points(place, face)
    yield from retarget()
    yield from play()


def add_faces():
    yield from over_view()
    yield from key("A")
    yield from key("DEL")
    assert not len(bpy.context.scene.objects)
    yield from key("N")
    yield from open_tab()
    yield from still()
    illustrate("tutorial_tab", 290, 270, right=230, top=60)
    yield from press_button("facial_retarget.add_faces")
    yield from wait_until(lambda: bpy.context.scene.facial_retarget.target is not None, "the faces")


def set_up_workspace():
    yield from press_button("facial_retarget.set_up_workspace")
    yield from wait_until(lambda: window().workspace.name == "Retarget" and aimed(), "the workspace")
    yield from still()
    illustrate("tutorial_workspace")


def aimed() -> bool:
    """Whether each of the two views shows a face alone."""
    views = [found for found in window().screen.areas if found.type == "VIEW_3D"]
    return len(views) == 2 and all(view.spaces.active.local_view for view in views)


def place_points(place: int, face: bpy.types.Object):
    """Five clicks where the diagram says, and the others as they are proposed."""
    name, true = face.name, true_places(face)
    yield from press_button("facial_retarget.start_placing", editor=area(place=1))
    assert bpy.context.view_layer.objects.active == face
    for number, point in enumerate(FIRST):
        if number == 3 and place == 0:
            yield from still()
            illustrate("tutorial_placing", 640, 605, right=640)
        yield from click(*on_screen(true[point], area(place=place)))
    stored = face.facial_retarget
    assert tuple(stored.points.keys()) == FIRST, stored.points.keys()
    yield from wait_until(lambda: len(stored.points) + len(stored.proposals) == stored.set_size, "the proposals", 20)
    yield from still()
    illustrate(f"tutorial_proposed_{name.lower()}")
    yield from press_button("facial_retarget.accept_points", editor=area(place=1))
    assert len(point_places(face)) == stored.set_size
    error = [np.linalg.norm(spot - true[point]) for point, spot in point_places(face).items()]
    eyes = np.linalg.norm(true["3.7"] - true["3.12"])
    assert np.median(error) < 0.1 * eyes, np.median(error) / eyes


def true_places(face: bpy.types.Object) -> dict[str, np.ndarray]:
    """Where the built-in face's own points lie in the scene: what an artist sees at a glance."""
    demo = part("demo")
    built = demo.actor(part("bridge.scene.demo_pair").ACTOR_VERTICES) if face.name == "Actor" else demo.child()
    world = np.array(face.matrix_world)
    own = built.face.points.positions(built.face.mesh.vertices)
    return dict(zip(built.face.points.names, own @ world[:3, :3].T + world[:3, 3], strict=True))


def retarget():
    task = bpy.context.scene.facial_retarget
    yield from press_button("facial_retarget.retarget", editor=area(place=1))
    yield from wait_until(lambda: bpy.data.window_managers[0].facial_retarget.share > 0.2, "progress")
    yield from wait()
    illustrate("tutorial_working", 420, 160, top=80)
    yield from wait_until(lambda: part("guide").is_baked(task.target, 1), "the bake", 120)
    yield from still()


def play():
    """Play, and look at the liveliest moment."""
    scene = bpy.context.scene
    yield from press_button("screen.animation_play", editor=area(place=1))
    yield from wait(20)
    assert scene.frame_current > 3
    yield from over_view()
    yield from key("ESC")
    rest = shown(scene.facial_retarget.target)
    bar = region("WINDOW", area("DOPESHEET_EDITOR"))
    height = bar.y + bar.height - 10
    yield from drag((bar.x + 0.1 * bar.width, height), (bar.x + 0.3 * bar.width, height))
    yield from still()
    moved = np.abs(shown(scene.facial_retarget.target) - rest).max() / np.ptp(rest[:, 1])
    assert moved > 0.02, moved
    illustrate("tutorial_played")
