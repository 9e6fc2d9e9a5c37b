"""The sliders move the wrinkles in a view that renders; making the kit is one undo step, and so is removing it."""

import bpy
import numpy as np
from drive import OUT, area, look, override, picture, region, screenshot, undo, wait, wait_until
from stage import choose, clear, part, remember

NODE = "Wrinkle Kit"


def scenario():
    clear()
    light, fine = skin("skin", 21), skin("sculpt", 161)
    fine.hide_set(True)
    task = bpy.context.scene.facial_retarget
    task.target, task.wrinkle_kit.detail, task.wrinkle_kit.fine = light, "OBJECT", fine
    task.wrinkle_kit.folder, task.wrinkle_kit.pixels = str(OUT / "kit"), 256
    choose(light)
    remember()
    yield from look("TOP", [light])
    with override():
        bpy.ops.facial_retarget.make_wrinkle_kit("INVOKE_DEFAULT")
    yield from wait_until(lambda: has_kit(), "the wrinkle kit", 30)
    view, solid = region(), picture()
    area().spaces.active.shading.type = "MATERIAL"
    middle = (view.height // 2, view.x + view.width // 2 + 60)
    yield from wait_until(lambda: is_rendered(solid, picture(), middle), "the shaders of the view", 90)
    flat = yield from shown(0.0)
    half = yield from shown(0.5)
    whole = yield from shown(1.0)
    screenshot("folded")
    seen = [int(np.abs(one.astype(int) - flat).sum()) for one in (half, whole)]
    assert seen[0] > 50_000, seen
    assert seen[1] > 1.3 * seen[0], seen

    area().spaces.active.shading.type = "SOLID"
    light.data.shape_keys.key_blocks["fold"].value = 0.0
    remember()
    with override():
        bpy.ops.facial_retarget.remove_wrinkle_kit("INVOKE_DEFAULT", True)
    yield from wait_until(lambda: not has_kit(), "the kit's end", 10)
    assert not bpy.data.node_groups
    yield from undo()
    assert has_kit()
    yield from undo()
    yield from undo()
    assert not has_kit()
    assert (OUT / "kit" / "wrinkles.json").exists()


def skin(name: str, side: int) -> bpy.types.Object:
    """A flat skin with UVs and a key that pushes it together; one of many vertices folds there."""
    x, y = np.meshgrid(np.linspace(-1, 1, side), np.linspace(-1, 1, side))
    places = np.stack([x, y, 0 * x], axis=-1).reshape(-1, 3)
    cells = np.arange(side * side).reshape(side, side)
    corners = np.stack([cells[:-1, :-1], cells[:-1, 1:], cells[1:, 1:], cells[1:, :-1]], axis=-1).ravel()
    made = part("bridge.meshes").new_object(name, places, np.full(len(corners) // 4, 4), corners)
    made.data.shade_smooth()
    uvs = (places[corners, :2] * 0.49 + 0.5).astype(np.float32)
    made.data.uv_layers.new(name="UVMap").uv.foreach_set("vector", uvs.ravel())
    near = np.clip(1 - 2 * (places[:, 0] ** 2 + places[:, 1] ** 2), 0, None) ** 2
    moved = np.stack([0 * near, -0.15 * places[:, 1] * near, 0 * near], axis=1)
    if side > 100:
        moved[:, 2] = 0.03 * np.sin(25 * places[:, 1]) * near
    part("bridge.key_sets").write_keys(made, {"fold": moved}, {})
    return made


def has_kit() -> bool:
    """Whether a material of the skin has the node of a kit."""
    slots = bpy.data.objects["skin"].material_slots
    return any(slot.material and NODE in slot.material.node_tree.nodes for slot in slots)


def is_rendered(solid: np.ndarray, now: np.ndarray, place: tuple[int, int]) -> bool:
    """Whether the skin at a place is there, and looks other than in solid shading: until then the view is empty."""
    area().tag_redraw()
    around = np.s_[place[0] - 20 : place[0] + 20, place[1] - 20 : place[1] + 20]
    return bool(now[around].mean() > 100 and (solid[around] != now[around]).mean() > 0.5)


def shown(value: float):
    """The window's brightness with the key at a value, once the view has settled."""
    bpy.data.objects["skin"].data.shape_keys.key_blocks["fold"].value = value
    before = picture()
    for _ in range(60):
        area().tag_redraw()
        yield from wait(10)
        now = picture()
        if (now == before).mean() > 0.999:
            break
        before = now
    return now
