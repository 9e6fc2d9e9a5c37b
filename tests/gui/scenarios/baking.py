"""Esc half-way through a bake leaves everything as it was; the next bake plays, is one undo step, and is exported.

What an export loses stands in the panel and beside the file browser; a copy prepared for others is one undo step too.
"""

import json
import struct

import bpy
import numpy as np
from drive import (
    OUT,
    key,
    look,
    open_section,
    open_tab,
    override,
    press_button,
    redo,
    screenshot,
    still,
    undo,
    wait,
    wait_until,
    window,
)
from stage import check_unchanged, clear, remember, shown, snapshot

FRAMES = 12


def scenario():
    clear()
    with override():
        bpy.ops.facial_retarget.add_faces("EXEC_DEFAULT", target="child", points=True)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 30, 29 + FRAMES
    remember()
    yield from look("FRONT")
    yield from open_tab()
    yield from open_section("4. Retarget")
    before = snapshot()

    yield from press_button("facial_retarget.retarget")
    yield from wait_until(working, "the operator runs")
    yield from wait(3)
    screenshot("working")
    yield from key("ESC")
    yield from wait_until(lambda: not working(), "the operator stops", 5)
    check_unchanged(before)

    yield from press_button("facial_retarget.retarget")
    yield from wait_until(lambda: baked(target()), "the bake", 60)
    yield from wait()
    screenshot("baked")
    assert len(baked(target())) == FRAMES, baked(target())
    assert motion() > 0.01, motion()

    yield from undo()
    check_unchanged(before)
    yield from redo()
    assert len(baked(target())) == FRAMES, baked(target())

    file = OUT / "child.glb"
    yield from open_section("5. Bake and Export")
    yield from export("facial_retarget.export_gltf", file)
    names = morph_names(file)
    assert names == baked(target()), names[:20]

    table = OUT / "child.csv"
    yield from export("facial_retarget.export_curves", table)
    head, *lines = table.read_text().splitlines()
    assert head == ",".join(["frame", "time", *names]), head
    assert [line.partition(",")[0] for line in lines] == [str(30 + frame) for frame in range(FRAMES)], lines
    assert all(line.split(",")[2 + row] == "1.0" for row, line in enumerate(lines)), lines

    before = snapshot()
    yield from press_button("facial_retarget.prepare_export")
    yield from wait_until(lambda: "Export" in bpy.data.collections and not working(), "the prepared copy", 30)
    yield from wait()
    screenshot("prepared")
    (copy,) = bpy.data.collections["Export"].objects
    assert copy.name == "Child_export", copy.name
    assert baked(copy) == names, baked(copy)
    yield from undo()
    check_unchanged(before)


def export(button, file):
    """As an artist does: read what is lost, press the button, name the file in the browser that opens."""
    before = snapshot()
    bpy.context.preferences.view.filebrowser_display_type = "SCREEN"
    yield from still()
    screenshot(f"{file.suffix[1:]}_panel")
    yield from press_button(button)
    yield from wait_until(lambda: window().screen.areas[0].type == "FILE_BROWSER", "the file browser")
    browser = window().screen.areas[0]
    browser.spaces.active.params.directory = bytes(file.parent)
    browser.spaces.active.params.filename = file.name
    yield from still()
    screenshot(f"{file.suffix[1:]}_browser")
    with override(browser):
        bpy.ops.file.execute("INVOKE_DEFAULT")
    yield from wait_until(file.exists, "the file", 30)
    yield from wait_until(lambda: not working(), "the operator ends", 10)
    yield from wait()
    screenshot(f"{file.suffix[1:]}_exported")
    check_unchanged(before)


def target() -> bpy.types.Object:
    return bpy.context.scene.facial_retarget.target


def working() -> bool:
    return any(found.bl_idname.startswith("FACIAL_RETARGET") for found in window().modal_operators)


def baked(thing: bpy.types.Object) -> list[str]:
    keys = thing.data.shape_keys
    return [] if keys is None else [key.name for key in keys.key_blocks if key.name.startswith("frame_")]


def motion() -> float:
    """How far the target's vertices move at most between the bake's frames, as a share of its height."""
    frames = []
    for frame in range(30, 30 + FRAMES):
        bpy.context.scene.frame_set(frame)
        frames.append(shown(target()))
    frames = np.array(frames)
    return float(np.ptp(frames, axis=0).max() / np.ptp(frames[0][:, 1]))


def morph_names(file) -> list[str]:
    """The shape keys in a .glb."""
    data = file.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    document = json.loads(data[20 : 20 + length])
    return document["meshes"][0]["extras"]["targetNames"]
