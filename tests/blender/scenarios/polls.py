"""Whatever the scene, an operator that cannot run says why in its tooltip."""

import bpy
from stage import NAME, empty_scene, grid

empty_scene()
names = sorted(
    kind.bl_idname.partition(".")[2]
    for kind in bpy.types.Operator.__subclasses__()
    if kind.__module__.startswith(NAME) and hasattr(kind, "bl_idname")
)
assert len(names) > 30, names
context = bpy.context
task = context.scene.facial_retarget
refused: dict[str, set[str]] = {name: set() for name in names}


def check(where: str) -> None:
    """Every operator either runs now or tells what it lacks."""
    for name in names:
        operator = getattr(bpy.ops.facial_retarget, name)
        if operator.poll():
            continue
        said = ""
        try:
            operator()
        except RuntimeError as error:
            said = str(error).partition(".poll() ")[2].strip()
        assert said, f"{where}: {name} ran though it cannot"
        # What Blender says by itself.
        assert "context is incorrect" not in said, f"{where}: {name} does not say why it cannot run"
        assert not said.endswith("."), f"{where}: {name}: {said}"
        refused[name].add(said)


check("nothing there")
bpy.ops.object.light_add()
check("a light is active")
source, target = grid("source", 9), grid("target", 9)
context.view_layer.objects.active = source
check("a mesh is active")
task.source = source
check("a source alone")
task.target = target
check("both faces")
for method in ("hierarchical", "motion_cloning"):
    task.method = method
    check(method)
bpy.ops.object.mode_set(mode="EDIT")
check("Edit Mode")
bpy.ops.object.mode_set(mode="SCULPT")
check("Sculpt Mode")
bpy.ops.object.mode_set(mode="OBJECT")
task.cloning.targets = "SELECTED"
for thing in context.selected_objects:
    thing.select_set(False)
check("nothing is selected")
context.window_manager.facial_retarget.running = True
check("something is computed")
context.window_manager.facial_retarget.running = False

for name, reason in {
    "retarget": "Choose a source and a target under Faces",
    "remove_point": "Choose a feature point in the list",
    "remove_part": "Choose a part in the list",
    "remove_example": "Choose an example in the list",
    "save_points": "The face has no feature points",
    "set_up_workspace": "Workspaces need a window",
    "stop": "Nothing is being computed",
}.items():
    assert reason in refused[name], (name, refused[name])
assert "Wait for what is being computed, or stop it with Esc" in refused["retarget"]
