"""Earlier bakes stay if the artist says so, turned off: each plays again as it was, and goes when it is told to."""

import sys
from pathlib import Path

import bpy
import numpy as np
from stage import differences, empty_scene, enable, everything, grid, part, refused, shown

FOLDER = Path(sys.argv[-1])
FIRST, COUNT = 3, 4
TIMES = [FIRST + i for i in range(COUNT)]
KINDS = ("frames", "rig", "pc2", "compact", "alembic", "usd", "mdd")
NEAR = {"compact": 1e-2, "rig": 2e-3}
"""How near a kind comes to the frames; others to float32."""


def head(own: bool = True) -> bpy.types.Object:
    """A face and a part as the task's target; the face with own keys, one of them animated, and an own modifier."""
    empty_scene()
    face, other = grid("face", 6), grid("part", 5)
    other.location.x = 3
    face.facial_retarget.parts.add().thing = other
    bpy.context.scene.facial_retarget.target = face
    face.modifiers.new("own", "SIMPLE_DEFORM").angle = 0.0
    if own:
        face.shape_key_add(name="Basis", from_mix=False)
        for number, name in enumerate(('a "b"', "still")):
            key = face.shape_key_add(name=name, from_mix=False)
            key.value = 0.0
            for row, point in enumerate(key.points):
                point.co.z += 0.2 * (number == 0) * np.sin(row)
        key.keyframe_insert("value", frame=1)
    bpy.context.view_layer.update()
    return face


def things(face: bpy.types.Object) -> list[bpy.types.Object]:
    return [face, *part("bridge.heads").head_parts(face)]


def frames_of(face: bpy.types.Object, seed: int) -> np.ndarray:
    """(COUNT, V, 3) frames: the face moves as its own first key does, the part otherwise."""
    found = part("bridge.heads").read_head(face)
    rest = found.face.mesh.vertices
    rng, split = np.random.default_rng(seed), found.starts[1]
    move = np.zeros_like(rest)
    move[:split, 2] = 0.2 * np.sin(np.arange(split))
    move[split:] = rng.normal(0, 0.1, (len(rest) - split, 3))
    return (rest + rng.uniform(0.2, 1, COUNT)[:, None, None] * move).astype(np.float32)


def bake(face: bpy.types.Object, kind: str, frames: np.ndarray, keep: bool = True) -> None:
    """As the button does."""
    module, settings = part("bridge.bakes.bake"), part("core.methods.settings").BakeSettings
    how = settings(kind=kind, tolerance=0.001, smoothness=0.0, sparsity=0.0)
    wish = module.Wish(how, "frame_####", str(FOLDER / "cache.pc2"), keep)
    found = part("bridge.heads").read_head(face)
    prepared = part("bridge.background").finished(module.bake_steps(found, 1.0, frames, TIMES, wish))
    assert prepared.figures.get("files", []) == [str(path) for path in prepared.files]
    with part("bridge.bakes.scene_cache").let_go(prepared.files), part("files.whole").written_whole() as aside:
        prepared.add_files(aside)
    prepared.write()


def check_plays(face: bpy.types.Object, kind: str, frames: np.ndarray) -> None:
    """The head shows frames of a kind, and nothing else moves it; a rig has no keys for the part."""
    assert face.facial_retarget.bake == kind, (face.facial_retarget.bake, kind)
    for time, frame in zip(TIMES, frames, strict=True):
        bpy.context.scene.frame_set(time)
        seen = part("bridge.heads").head_now(things(face), bpy.context.evaluated_depsgraph_get())
        count = len(face.data.vertices) if kind == "rig" else len(seen)
        np.testing.assert_allclose(seen[:count], frame[:count], atol=NEAR.get(kind, 5e-6), err_msg=f"{kind} {time}")


def reopened() -> bpy.types.Object:
    """The target after saving and loading."""
    bpy.ops.wm.save_as_mainfile(filepath=str(FOLDER / "kept.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(FOLDER / "kept.blend"))
    enable()
    return bpy.context.scene.facial_retarget.target


def every_kind_is_kept_and_plays_again() -> None:
    """All one after the other, each kept; then each played again, in another order, after saving too; then all gone."""
    face = head()
    clean = everything()
    made = {}
    for number, kind in enumerate((*KINDS, "frames", "pc2")):
        frames = frames_of(face, number)
        bake(face, kind, frames)
        check_plays(face, kind, frames)
        made[number + 1] = (kind, frames)
    assert [item.number for item in face.facial_retarget.kept_bakes] == list(range(1, len(made)))
    files = sorted(path.name for path in FOLDER.glob("cache*"))
    pieces = [f"cache{number}{piece}" for number in ("", ".001") for piece in (".pc2", ".part.pc2")]
    assert files == sorted([*pieces, "cache.abc", "cache.usdc", "cache.mdd", "cache.part.mdd"]), files
    playing = len(made)
    for step, number in enumerate((2, 1, 6, 4, 5, 7, 3, 8)):
        now = max(item.number for item in face.facial_retarget.kept_bakes) + 1
        assert bpy.ops.facial_retarget.play_bake(number=number) == {"FINISHED"}
        made[now], playing = made[playing], number
        check_plays(face, *made[number])
        if step % 3 == 1:
            face = reopened()
            check_plays(face, *made[number])
        assert number not in [item.number for item in face.facial_retarget.kept_bakes]
    made = {item.number: made[item.number] for item in face.facial_retarget.kept_bakes} | {playing: made[playing]}
    assert sorted(kind for kind, _ in made.values()) == sorted((*KINDS, "frames", "pc2"))
    while len(face.facial_retarget.kept_bakes):
        kind, frames = made[playing]
        assert bpy.ops.facial_retarget.remove_bake(number=face.facial_retarget.kept_bakes[0].number) == {"FINISHED"}
        check_plays(face, kind, frames)
    assert bpy.ops.facial_retarget.remove_bake() == {"FINISHED"}
    assert not bpy.ops.facial_retarget.remove_bake.poll()
    bpy.context.scene.frame_set(clean["scene"][0])
    left = [name for name in differences(clean, everything()) if name not in ("scene", "object part", "keys Key.001")]
    assert not left, left
    assert len(bpy.data.actions) == 1, bpy.data.actions.keys()
    assert not bpy.data.cache_files


def what_the_artist_has_edited_comes_back() -> None:
    """Curves with handles and modifiers, absolute keys beside kept ones, names that were taken meanwhile."""
    face = head(own=False)
    first, second = frames_of(face, 1), frames_of(face, 2)
    bake(face, "absolute", first)
    bake(face, "frames", second)
    bag = part("bridge.curves").find_curves(face.data.shape_keys)
    curve = next(curve for curve in bag.fcurves if "frame_0004" in curve.data_path)
    curve.keyframe_points[1].interpolation = "BEZIER"
    curve.keyframe_points[1].handle_left = (3.5, 0.7)
    curve.modifiers.new("NOISE").strength = 0.5
    bake(face, "absolute", first[::-1])
    check_plays(face, "absolute", first[::-1])
    # A copy of the face keeps the same bakes: one of the two playing them takes nothing from the other.
    twin = face.copy()
    twin.data = face.data.copy()
    bpy.context.scene.collection.objects.link(twin)
    bpy.ops.facial_retarget.play_bake(number=1)
    check_plays(face, "absolute", first)
    task = bpy.context.scene.facial_retarget
    task.target = twin
    twin.facial_retarget.parts.clear()
    bpy.ops.facial_retarget.play_bake(number=1)
    bpy.context.scene.frame_set(TIMES[2])
    np.testing.assert_allclose(shown(twin), first[2, : len(twin.data.vertices)], atol=5e-6)
    task.target = face
    bpy.data.objects.remove(twin)
    bpy.ops.facial_retarget.play_bake(number=2)
    bag = part("bridge.curves").find_curves(face.data.shape_keys)
    (curve,) = [curve for curve in bag.fcurves if "frame_0004" in curve.data_path]
    assert curve.keyframe_points[1].handle_left[1] > 0.5
    assert curve.modifiers[0].strength == 0.5
    curve.modifiers.remove(curve.modifiers[0])
    check_plays(face, "frames", second)
    assert [key.name for key in face.data.shape_keys.key_blocks if not key.mute][1:] == [
        f"frame_{time:04d}" for time in TIMES
    ]
    # Own keys that came meanwhile are not turned off by absolute ones.
    face.shape_key_add(name="mine", from_mix=False).value = 0.0
    with refused("'mine'", "turn off"):
        bpy.ops.facial_retarget.play_bake(number=4)
    # Replacing touches the newest alone.
    kept = [(item.number, item.kept) for item in face.facial_retarget.kept_bakes]
    bake(face, "compact", second, keep=False)
    check_plays(face, "compact", second)
    assert kept == [(item.number, item.kept) for item in face.facial_retarget.kept_bakes]
    face.shape_key_remove(face.data.shape_keys.key_blocks[kept[0][1].split("\n")[0]])
    with refused("is gone"):
        bpy.ops.facial_retarget.play_bake(number=kept[0][0])
    with refused("no earlier bake of number 99"):
        bpy.ops.facial_retarget.remove_bake(number=99)


def one_undo_step_takes_each_back() -> None:
    """Playing a kept bake and removing one."""
    face = head()
    bake(face, "frames", frames_of(face, 1))
    bake(face, "alembic", frames_of(face, 2))
    for press in (
        lambda: bpy.ops.facial_retarget.play_bake(number=1),
        lambda: bpy.ops.facial_retarget.remove_bake(),
        lambda: bpy.ops.facial_retarget.remove_bake(number=1),
    ):
        bpy.ops.ed.undo_push(message="before")
        before = everything()
        press()
        assert differences(before, everything())
        bpy.ops.ed.undo_push(message="after")
        bpy.ops.ed.undo()
        assert not differences(before, everything()), differences(before, everything())


every_kind_is_kept_and_plays_again()
one_undo_step_takes_each_back()
what_the_artist_has_edited_comes_back()
