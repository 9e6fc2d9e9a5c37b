"""FAP controls: sliders that move the face exactly as the core does, without Python, and leave nothing behind."""

import sys
from pathlib import Path

import bpy
import numpy as np
from stage import actor_face, disable, empty_scene, enable, fitted, part, shown

TOLERANCE = 1e-5
"""Share of the face that float32 may cost."""

empty_scene()
controls = part("fap_controls")
actor = actor_face()
own = actor.shape_key_add(name="Basis", from_mix=False)
own = actor.shape_key_add(name="wart", from_mix=False)
own.value = 0.0
face = fitted(actor)
size = face.mesh.size
assert bpy.ops.facial_retarget.make_controls() == {"FINISHED"}
assert bpy.ops.facial_retarget.make_controls() == {"FINISHED"}  # a second time changes nothing
keys = actor.data.shape_keys
assert len(keys.key_blocks) == len({key.name for key in keys.key_blocks})

# All drivers are Blender's own expressions: no Python runs, whatever the artist allows.
drivers = keys.animation_data.drivers
assert len(drivers) == len(keys.key_blocks) - 2, (len(drivers), len(keys.key_blocks))
assert all(curve.driver.is_simple_expression and curve.driver.is_valid for curve in drivers)

# Sliders are there for all FAPs; keys for those that the face can show.
for control in controls.CONTROLS:
    assert actor[control.name] == 0.0
    limits = actor.id_properties_ui(control.name).as_dict()
    assert limits["soft_max"] == control.full, limits
    assert (limits["soft_min"] == 0) == control.fap.one_way, limits
    assert (control.key in keys.key_blocks) == bool(face.playable[control.fap.number - 1]), control


def at(values: dict[int, float]) -> np.ndarray:
    """(V, 3) the object with its controls set to some FAPs."""
    for control in controls.CONTROLS:
        actor[control.name] = float(values.get(control.fap.number, 0.0))
    actor.update_tag()
    bpy.context.view_layer.update()
    return shown(actor)


def expected(values: dict[int, float]) -> np.ndarray:
    """(V, 3) what the core says."""
    row = np.zeros((1, 68))
    for number, value in values.items():
        row[0, number - 1] = value
    return face.frames(row)[0]


def check(values: dict[int, float]) -> None:
    """The object shows what the core says."""
    np.testing.assert_allclose(at(values), expected(values), rtol=0, atol=TOLERANCE * size, err_msg=str(values))


np.testing.assert_allclose(at({}), face.mesh.vertices, atol=1e-7)
for control in controls.CONTROLS:
    for share in (1, 0.37, -0.6):
        check({control.fap.number: share * control.full})
rng = np.random.default_rng(4)
moved = 0.0
for _ in range(20):
    values = {control.fap.number: rng.normal() * control.full for control in controls.CONTROLS}
    check(values)
    moved = max(moved, float(np.abs(expected(values) - face.mesh.vertices).max()))
assert moved > 0.3 * size, "nothing has moved"

# Scrubbing: keyframes on a slider.
for frame, value in ((1, 0.0), (11, 1024.0)):
    actor["fap_open_jaw"] = value
    actor.keyframe_insert('["fap_open_jaw"]', frame=frame)
curve = actor.animation_data.action.layers[0].strips[0].channelbags[0].fcurves[0]
for point in curve.keyframe_points:
    point.interpolation = "LINEAR"
at({})
for frame in (1, 4, 11):
    bpy.context.scene.frame_set(frame)
    np.testing.assert_allclose(shown(actor), expected({3: 102.4 * (frame - 1)}), rtol=0, atol=TOLERANCE * size)

# It works in a file that is opened without the extension.
path = Path(sys.argv[1]) / "controls.blend"
disable()
bpy.ops.wm.save_as_mainfile(filepath=str(path))
bpy.ops.wm.open_mainfile(filepath=str(path))
actor = bpy.data.objects["actor"]
bpy.context.scene.frame_set(4)
np.testing.assert_allclose(shown(actor), expected({3: 307.2}), rtol=0, atol=TOLERANCE * size)
check({19: 500, 20: 800, 23: 40000, 26: -20000})

# Made anew, it shows what its points say now.
enable()
bpy.context.view_layer.objects.active = actor
points = actor.facial_retarget.points
points.remove(points.find("9.3"))
bpy.ops.facial_retarget.make_controls()
assert actor.data.shape_keys.key_blocks.find("FAP 63 raise_nose") == -1
assert len(actor.data.shape_keys.animation_data.drivers) == len(actor.data.shape_keys.key_blocks) - 2
face = fitted(actor)
check({41: 700, 63: 500, 12: 300})

# Removed again, nothing is left but the artist's own.
bpy.ops.facial_retarget.remove_controls()
keys = actor.data.shape_keys
assert [key.name for key in keys.key_blocks] == ["Basis", "wart"]
assert not keys.animation_data.drivers
assert not [name for name, _ in actor.items() if name.startswith("fap_")]
assert not list(actor.animation_data.action.layers[0].strips[0].channelbags[0].fcurves)
np.testing.assert_allclose(shown(actor), face.mesh.vertices, atol=1e-7)
