"""What a bake or cloning found wrong is listed on the face, the worst first; a click goes there, Select selects it."""

import sys
from pathlib import Path
from types import SimpleNamespace

import bpy
import numpy as np
from stage import donor_pair, empty_scene, enable, grid, part, refused

folder = Path(sys.argv[1])
findings, heat, quality = part("bridge.reports.findings"), part("bridge.reports.heat"), part("core.quality")
empty_scene()
task = bpy.context.scene.facial_retarget
task.target = face = grid("face", 8)
source = grid("source", 8)
whole = np.arange(64)


def at(torn: object = (), turned: object = (), lips: object = (), lids: object = ()) -> object:
    """Spots at vertices."""
    return quality.Spots(*(np.array(rows, np.int64) for rows in (torn, turned, lips, lids)))


# Frames 5 to 8: the third is the worst, the first has nothing to say but what its source shows as well.
spots = [
    at(),
    at([3, 4]),
    at([10, 11, 12], [20, 21, 28], lids=[70, 71]),
    at(lips=[40, 41], lids=[50]),
]
figures = {
    "torn_edges": [0, 1, 3, 0],
    "flipped_triangles": [0, 0, 2, 0],
    "lip_gap_percent": [40.0, 0.0, 0.0, 12.0],
    "source_lip_gap_percent": [40.0, 5.0, 0.0, 0.0],
}
result = SimpleNamespace(spots=spots, per_frame=figures, counterpart=whole)
findings.write_frame_findings(face, source, result, range(5, 5 + len(result.spots)))
known = face.facial_retarget
assert [(one.name, one.kind, one.frame) for one in known.findings] == [
    ("Frame 8", "FRAME", 8),
    ("Frame 7", "FRAME", 7),
    ("Frame 6", "FRAME", 6),
], list(known.findings)
assert [one.note for one in known.findings] == ["lip gap +12 %", "torn edges 3, flipped triangles 2", "torn edges 1"]
assert known.findings_text == "3 of 4 frames have trouble"
assert bpy.context.scene.frame_current == 1, "writing goes nowhere"

# Cloned keys come beside them, in the place of what was known of the same keys.
face.shape_key_add(name="Basis", from_mix=False)
for name in ("joy", "anger"):
    face.shape_key_add(name=name, from_mix=False).value = 0.0
row = {"name": "joy", "largest_motion": 1.0, "share_of_source": 1.0, "torn_edges": 9, "flipped_triangles": 0}
for torn in (99, 9):
    found = {name: findings.Finding({**row, "torn_edges": torn}, at(whole[:5])) for name in ("joy",)}
    findings.write_key_findings(face, found)
findings.write_key_findings(face, {"anger": findings.Finding({**row, "torn_edges": 2}, at(whole))})
assert [one.name for one in known.findings] == ["Frame 8", "joy", "Frame 7", "anger", "Frame 6"]
assert [one.torn for one in known.findings] == [0, 9, 3, 2, 1]

# A click goes to the frame, or shows the key; another click puts the key back.
keys = face.data.shape_keys.key_blocks
for place, frame, values in ((2, 7, (0, 0)), (1, 7, (1, 0)), (3, 7, (0, 1)), (0, 8, (0, 0))):
    known.active_finding = place
    assert bpy.context.scene.frame_current == frame
    assert (keys["joy"].value, keys["anger"].value) == values, place


def selected() -> list[int]:
    """The selected vertices."""
    bpy.ops.object.mode_set(mode="OBJECT")
    chosen = np.empty(64, bool)
    face.data.vertices.foreach_get("select", chosen)
    return np.flatnonzero(chosen).tolist()


bpy.context.view_layer.objects.active = source
for row, kind, wanted in (
    (2, "TORN", [10, 11, 12]),
    (2, "TURNED", [20, 21, 28]),
    (0, "LIPS", [40, 41]),
    (0, "LIDS", [50]),
):
    known.active_finding = row
    bpy.ops.facial_retarget.select_trouble(kind=kind)
    assert (bpy.context.mode, bpy.context.active_object) == ("EDIT_MESH", face)
    assert selected() == wanted
with refused("Frame 8", "no torn edges"):
    bpy.ops.facial_retarget.select_trouble(kind="TORN")
known.active_finding = 2
with refused("gap between the lids", "Frame 7", "on the parts of 'face'"):
    bpy.ops.facial_retarget.select_trouble(kind="LIDS")

# All of it is in the file.
bpy.ops.wm.save_as_mainfile(filepath=str(folder / "findings.blend"))
bpy.ops.wm.open_mainfile(filepath=str(folder / "findings.blend"))
enable()
face = bpy.data.objects["face"]
known = face.facial_retarget
assert findings.unpacked(known.findings[2].turned_vertices).tolist() == [20, 21, 28]
assert findings.unpacked(known.counterpart).tolist() == whole.tolist()
assert known.findings_source == bpy.data.objects["source"]

# Another bake replaces the frames and leaves the keys; a lost key goes with the next cloning.
findings.write_frame_findings(
    face, bpy.data.objects["source"], SimpleNamespace(**vars(result) | {"spots": spots[:1]}), [1]
)
assert [one.name for one in known.findings] == ["joy", "anger"]
assert known.findings_text == "0 of 1 frames have trouble"
face.shape_key_remove(face.data.shape_keys.key_blocks["joy"])
findings.write_key_findings(face, {})
assert [one.name for one in known.findings] == ["anger"]
known.active_finding = 0
bpy.context.view_layer.objects.active = face
face.data.clear_geometry()
with refused("0 vertices", "64"):
    bpy.ops.facial_retarget.select_trouble(kind="TORN")

# The heat map of a real bake: at rest nothing is warm; what stretches is.
empty_scene()
task = bpy.context.scene.facial_retarget
task.source, task.target = donor_pair()
task.method = "motion_cloning"
bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 2
key = task.source.data.shape_keys.key_blocks["surprise"]
for frame, value in ((1, 0.0), (2, 1.0)):
    key.value = value
    key.keyframe_insert("value", frame=frame)
bpy.ops.facial_retarget.retarget()
known, count = task.target.facial_retarget, len(task.target.data.vertices)
assert known.findings_text.endswith("of 2 frames have trouble"), known.findings_text
assert len(findings.unpacked(known.counterpart)) == count
warm = heat.HeatFigures()
for frame in (1, 2):
    bpy.context.scene.frame_set(frame)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    shown = {kind: warm.values(task, task.target, kind, depsgraph) for kind in ("STRETCH", "BEYOND", "MOTION")}
    assert all(values.shape == (count,) for values in shown.values())
    assert np.isfinite(shown["MOTION"]).mean() > 0.5, np.isfinite(shown["MOTION"]).mean()
    if frame == 1:
        assert shown["STRETCH"].max() < 1.001
        assert np.nanmax(shown["BEYOND"]) < 1.001
        assert np.nanmax(shown["MOTION"]) < 0.01
    else:
        assert shown["STRETCH"].max() > 1.05
        assert np.nanmax(shown["MOTION"]) > 0.1
        before = shown
task.target.location, task.target.scale = (3, 4, 5), (2, 2, 2)
bpy.context.view_layer.update()
again = warm.values(task, task.target, "STRETCH", bpy.context.evaluated_depsgraph_get())
assert np.allclose(again, before["STRETCH"], atol=1e-4), "where a face stands, and how large, changes nothing"
task.source_neutral = "FRAME"
with refused("Basis"):
    warm.values(task, task.target, "MOTION", depsgraph)
