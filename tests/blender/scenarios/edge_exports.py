"""Exports of one frame, of a face that does not move, and of ten thousand frames, read back: meshes, curves, motion."""

import json
import sys
from pathlib import Path

import bpy
import numpy as np
from stage import actor_face, empty_scene, grid, part, shown

FOLDER = Path(sys.argv[-1])
FORMATS = {"gltf": "glb", "fbx": "fbx", "usd": "usdc", "alembic": "abc"}
RATE, FIRST, MANY = 24, 5, 10_000


def fresh_scene() -> None:
    """An empty scene in which all formats can be read and written, at the rate that importers take for granted."""
    import addon_utils  # exists once bpy is imported

    empty_scene()
    bpy.context.scene.render.fps = RATE
    for name in ("io_scene_gltf2", "io_scene_fbx"):
        addon_utils.enable(name)


def lifted(values: np.ndarray) -> bpy.types.Object:
    """A face as the target with a key that lifts it, on one curve of a keyframe per frame."""
    fresh_scene()
    face = grid('a "face"', 4)
    scene, task = bpy.context.scene, bpy.context.scene.facial_retarget
    scene.frame_start, scene.frame_end = FIRST, FIRST + len(values) - 1
    task.target, task.source = face, grid("source", 3)
    keys = part("bridge.shape_keys")
    rest = part("bridge.meshes").read_positions(face.data)
    keys.write_key(keys.ensure_key(face, "lift"), rest + np.float32([0, 0, 1]))
    bag = part("bridge.curves").ensure_curves(face.data.shape_keys, "curves")
    times = np.arange(FIRST, FIRST + len(values), dtype=float)
    part("bridge.curves").write_curve(bag, keys.value_path("lift"), times, values)
    return face


def heights(thing: bpy.types.Object, times: list[float]) -> list[float]:
    """How high an object's lowest vertex stands at some frames."""
    found = []
    for time in times:
        bpy.context.scene.frame_set(int(time // 1), subframe=time % 1)
        matrix = np.array(thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world)
        found.append(float((shown(thing) @ matrix[:3, :3].T + matrix[:3, 3])[:, 2].min()))
    return found


def read_back(form: str, path: Path) -> bpy.types.Object:
    """The object in a file, in an empty scene."""
    fresh_scene()
    if form == "gltf":
        bpy.ops.import_scene.gltf(filepath=str(path))
    elif form == "fbx":
        bpy.ops.import_scene.fbx(filepath=str(path), anim_offset=0)
    elif form == "usd":
        bpy.ops.wm.usd_import(filepath=str(path))
    else:
        bpy.ops.wm.alembic_import(filepath=str(path))
    (made,) = (thing for thing in bpy.data.objects if thing.type == "MESH")
    return made


def plays(values: np.ndarray, rows: list[int]) -> None:
    """Every format plays a lift by these values, looked at in some rows."""
    lowest = min(heights(lifted(np.zeros(1)), [FIRST]))
    for form, suffix in FORMATS.items():
        lifted(values)
        path = FOLDER / f"lift.{suffix}"
        assert getattr(bpy.ops.facial_retarget, f"export_{form}")(filepath=str(path)) == {"FINISHED"}
        thing = read_back(form, path)
        wanted = lowest + values[rows]
        found = heights(thing, [FIRST + row for row in rows])
        np.testing.assert_allclose(found, wanted, atol=1e-4, err_msg=f"{form} {len(values)}")
        path.unlink()


def tabled(values: np.ndarray) -> None:
    """The same as a table and as a document."""
    lifted(values)
    ends = {"frame_start": FIRST, "frame_end": FIRST + len(values) - 1}
    for suffix in ("csv", "json"):
        assert bpy.ops.facial_retarget.export_curves(filepath=str(FOLDER / f"lift.{suffix}"), **ends) == {"FINISHED"}
    table = np.loadtxt(FOLDER / "lift.csv", delimiter=",", skiprows=1, ndmin=2)
    np.testing.assert_allclose(table[:, -1], values, atol=1e-6)
    np.testing.assert_allclose(table[:, 0], FIRST + np.arange(len(values)))
    document = json.loads((FOLDER / "lift.json").read_text(), parse_constant=lambda name: 1 / 0)
    assert [len(held) for held in document["curves"].values()] == [len(values)], document.keys()


def measured(count: int) -> None:
    """FAPs and weights of a face that does not move, or of one frame, are all 0."""
    fresh_scene()
    face = actor_face(2_500)
    keys = part("bridge.shape_keys")
    keys.ensure_key(face, "jawOpen")
    for suffix in ("fap", "csv"):
        path = FOLDER / f"still.{suffix}"
        ends = {"frame_start": 1, "frame_end": count}
        assert bpy.ops.facial_retarget.export_motion(filepath=str(path), **ends) == {"FINISHED"}
    values = part("files.motion.fap").read_fap(FOLDER / "still.fap").values
    assert values.shape == (count, 68)
    assert not values.any()
    take = part("files.motion.arkit_csv").read_arkit_csv(FOLDER / "still.csv", 24.0)
    assert take.weights.shape[0] == count
    assert not np.nan_to_num(take.weights).any()


plays(np.array([0.4]), [0])
plays(np.zeros(3), [0, 1, 2])
plays(0.5 + 0.5 * np.sin(np.arange(MANY) * 0.37), [0, 1, 4_000, 9_994, 9_995, MANY - 1])
for lift in (np.array([0.4]), np.zeros(3), np.linspace(0, 1, MANY)):
    tabled(lift)
measured(1)
measured(3)
