"""Where the bake's files may not go: over one another, over what is played, beside a .blend that has no place yet."""

import sys
from pathlib import Path

import bpy
from stage import bake_as, donor_pair, empty_scene, everything, refused, wave

FOLDER = Path(sys.argv[-1])


def pair() -> bpy.types.PropertyGroup:
    """The built-in actor and a warped one as the task's faces, for two frames."""
    empty_scene()
    task = bpy.context.scene.facial_retarget
    task.source, task.target = donor_pair(2_500)
    task.method = "motion_cloning"
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 2
    return task


def outputs_are_told_apart_before_anything_is_computed() -> None:
    """Report, page and cache in one place, in a folder's place, in no place."""
    task = pair()
    task.report = task.page = str(FOLDER / "both.html")
    with refused("its page and the report are one file"):
        bpy.ops.facial_retarget.retarget()
    task.page, task.report = "", "//report.json"
    with refused("'//report.json'", "not saved yet"):
        bpy.ops.facial_retarget.retarget()
    with refused("'//report.json'", "not saved yet"):
        bpy.ops.facial_retarget.save_job(filepath=str(FOLDER / "job.toml"))
    (FOLDER / "folder.json").mkdir()
    task.report = str(FOLDER / "folder.json")
    with refused("folder.json cannot be written: it is a folder"):
        bpy.ops.facial_retarget.retarget()
    task.report, task.page = str(FOLDER / "gone" / "a.json"), str(FOLDER / "gone" / "a.html")
    with refused("a.json cannot be written: there is no folder", "a.html cannot be written"):
        bpy.ops.facial_retarget.retarget()
    assert sorted(path.name for path in FOLDER.iterdir()) == ["folder.json"]


def a_bake_does_not_replace_what_the_source_plays() -> None:
    """The performance itself would be gone."""
    for kind, suffix in (("pc2", "pc2"), ("usd", "usdc")):
        task = pair()
        path = FOLDER / f"performance.{suffix}"
        bake_as(task.source, kind, wave(task.source, 2), [1, 2], path)
        content = path.read_bytes()
        task.bake.how.kind, task.bake.cache = kind, str(path)
        before = everything()
        with refused("the cache and what modifier 'Facial Retarget' of 'source' plays are one file"):
            bpy.ops.facial_retarget.retarget()
        assert path.read_bytes() == content
        assert everything() == before


outputs_are_told_apart_before_anything_is_computed()
a_bake_does_not_replace_what_the_source_plays()
