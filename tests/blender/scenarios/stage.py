"""What the scenarios share: the installed extension, and small things to work on."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib import import_module
from types import ModuleType

import bpy
import numpy as np

NAME = "bl_ext.user_default.facial_retarget"


# addon_utils exists once bpy is imported, so that it is imported where it is used.
def enable() -> None:
    """Enable the installed extension."""
    import addon_utils

    assert addon_utils.enable(NAME) is not None, "the extension cannot be enabled"


def disable() -> None:
    """Disable it."""
    import addon_utils

    addon_utils.disable(NAME)


def policy_warnings() -> dict[str, list[str]]:
    """Blender's own complaints about extensions: absolute imports, changes of sys.path."""
    import addon_utils

    addon_utils._extensions_warnings_get._is_first = True
    return addon_utils._extensions_warnings_get()


def part(name: str) -> ModuleType:
    """A module of the installed extension, such as "bridge.bakes.frames"."""
    return import_module(f"{NAME}.facial_retarget_addon.{name}")


def empty_scene() -> None:
    """A new file without any object."""
    bpy.ops.wm.read_homefile(use_empty=True)
    enable()


def grid(name: str, side: int = 6) -> bpy.types.Object:
    """A curved surface of side x side vertices."""
    x, y = np.meshgrid(np.linspace(-1, 1, side), np.linspace(-1, 1, side))
    vertices = np.stack([x, y, 1 - 0.4 * (x**2 + y**2)], axis=2).reshape(-1, 3)
    row = np.arange(side - 1)
    first = (row[:, None] * side + row).ravel()
    corners = first[:, None] + [0, 1, side + 1, side]
    return part("bridge.meshes").new_object(name, vertices, np.full(len(corners), 4), corners.ravel())


def actor_face(vertices: int = 1_500) -> bpy.types.Object:
    """The built-in actor with its feature points, as the active object."""
    actor = part("demo").actor(vertices)
    file = part("files.mesh_file").MeshFile(actor.face.mesh, actor.counts, actor.corners)
    made = part("bridge.meshes").new_face("actor", file)
    part("bridge.points.points").write_points(made, actor.face.points)
    bpy.context.view_layer.objects.active = made
    return made


def donor_pair(vertices: int = 4_500) -> tuple[bpy.types.Object, bpy.types.Object]:
    """The built-in actor with a key for each of its expressions, and a warped one of another topology without keys."""
    demo, rng = part("demo"), np.random.default_rng(1)
    actor, warped = demo.actor(vertices), demo.warped_actor(rng, vertices)
    pair = demo_object(actor, "source"), demo_object(warped, "target")
    for name, positions in actor.face.examples.items():
        if name != "neutral":
            part("bridge.examples.examples").write_example(pair[0], name, positions)
    return pair


def demo_object(face: object, name: str, pieces: bool = False) -> bpy.types.Object:
    """A built-in face as an object with its feature points; with `pieces` what is not skin is objects of its head."""
    counts, corners, vertices = face.counts, face.corners, face.face.mesh.vertices
    labels = face.face.mesh.components if pieces else np.zeros(len(vertices), int)
    made = []
    first = np.unique(labels, return_index=True)[1]
    for label in labels[np.sort(first)].tolist():
        own = labels == label
        index = np.cumsum(own) - 1
        polygons = own[corners[np.cumsum(counts) - counts]]
        kept = np.repeat(polygons, counts)
        made.append(part("bridge.meshes").new_object(name, vertices[own], counts[polygons], index[corners[kept]]))
    part("bridge.points.points").write_points(made[0], face.face.points)
    for thing in made[1:]:
        made[0].facial_retarget.parts.add().thing = thing
    return made[0]


def key_shape(thing: bpy.types.Object, name: str) -> np.ndarray:
    """(V, 3) positions that a shape key of an object holds."""
    flat = np.empty(3 * len(thing.data.vertices), np.float32)
    thing.data.shape_keys.key_blocks[name].points.foreach_get("co", flat)
    return flat.reshape(-1, 3)


def fitted(thing: bpy.types.Object) -> object:
    """An object as core's FapFace."""
    return part("bridge.background").finished(part("bridge.motion.fap_faces").fit_steps(thing))


def wave(thing: bpy.types.Object, count: int) -> np.ndarray:
    """(count, V, 3) float32 frames that move every vertex of an object, the first one too."""
    basis = part("bridge.meshes").read_positions(thing.data)
    time = np.arange(1, count + 1, dtype=np.float32)[:, None]
    frames = np.repeat(basis[None], count, axis=0)
    frames[..., 2] += 0.1 * np.sin(time + 3 * basis[:, 0])
    return frames


def bake_as(
    face: bpy.types.Object,
    kind: str,
    frames: np.ndarray,
    times: Sequence[float],
    cache: object = "",
    pattern: str = "frame_####",
    **how: object,
) -> dict[str, object]:
    """Bake frames (F, V, 3) of a head as the button does; returns the figures."""
    module, head = part("bridge.bakes.bake"), part("bridge.heads").read_head(face)
    wish = module.Wish(part("core.methods.settings").BakeSettings(kind=kind, **how), pattern, str(cache))
    prepared = part("bridge.background").finished(module.bake_steps(head, 1.0, frames, times, wish))
    with part("bridge.bakes.scene_cache").let_go(prepared.files), part("files.whole").written_whole() as aside:
        prepared.add_files(aside)
    prepared.write()
    return prepared.figures


def shown(thing: bpy.types.Object) -> np.ndarray:
    """(V, 3) positions of an object as it looks at the scene's frame, in its own coordinates."""
    mesh = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    flat = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", flat)
    return flat.reshape(-1, 3)


def shown_frames(thing: bpy.types.Object, frames: range) -> np.ndarray:
    """(F, V, 3) positions of an object as it looks at some of the scene's frames."""
    found = []
    for frame in frames:
        bpy.context.scene.frame_set(frame)
        found.append(shown(thing))
    return np.array(found)


@contextmanager
def refused(*words: str) -> Iterator[None]:
    """The block must raise an error whose text holds all the words, and leave the scene as it was."""
    before = snapshot()
    message = ""
    try:
        yield
    except Exception as error:
        if type(error).__name__ not in ("RetargetError", "RuntimeError"):
            raise
        message = str(error)
    assert message, f"accepted, expected an error with {words}"
    assert "Traceback" not in message, message
    missing = [word for word in words if word not in message]
    assert not missing, f"{missing} not in: {message}"
    assert snapshot() == before, f"the scene has changed: {before} -> {snapshot()}"


def snapshot() -> dict[str, object]:
    """What an operator that fails or is stopped must not change."""
    scene = bpy.context.scene
    return {
        "frame": (scene.frame_current, scene.frame_subframe),
        "objects": sorted(thing.name for thing in bpy.data.objects),
        "meshes": sorted(mesh.name for mesh in bpy.data.meshes),
        "actions": sorted(action.name for action in bpy.data.actions),
        "keys": {key.name: [(block.name, block.value) for block in key.key_blocks] for key in bpy.data.shape_keys},
        "drivers": {key.name: len(key.animation_data.drivers) for key in bpy.data.shape_keys if key.animation_data},
        "texts": sorted(text.name for text in bpy.data.texts),
        "cloned": {thing.name: [key.name for key in thing.facial_retarget.cloned] for thing in bpy.data.objects},
        "controls": {
            thing.name: sorted(n for n, _ in thing.items() if n.startswith("fap_")) for thing in bpy.data.objects
        },
        "points": {thing.name: len(thing.facial_retarget.points) for thing in bpy.data.objects},
        "examples": [example.name for example in scene.facial_retarget.examples],
    }


def everything() -> dict[str, object]:
    """All that the file holds of what our operators write, to the last vertex: for what must be as it was before."""
    scene = bpy.context.scene
    found: dict[str, object] = {
        "scene": (scene.frame_current, scene.frame_subframe, scene.frame_start, scene.frame_end),
        "rate": (scene.render.fps, scene.render.fps_base),
        "active": getattr(bpy.context.view_layer.objects.active, "name", None),
        "task": _values(scene.facial_retarget),
        "texts": {text.name: text.as_string() for text in bpy.data.texts},
        "worlds": [
            [item.name for item in kind] for kind in (bpy.data.materials, bpy.data.images, bpy.data.collections)
        ],
    }
    for thing in bpy.data.objects:
        found[f"object {thing.name}"] = {
            "data": thing.data.name if thing.data else "",
            "place": [list(row) for row in thing.matrix_world],
            "look": (thing.hide_get(), thing.select_get(), thing.mode, thing.show_only_shape_key),
            "active_key": thing.active_shape_key_index,
            "modifiers": [modifier.name for modifier in thing.modifiers],
            "groups": thing.vertex_groups.keys(),
            "parent": thing.parent.name if thing.parent else "",
            "custom": {name: str(value) for name, value in thing.items() if name != "facial_retarget"},
            "face": _values(thing.facial_retarget),
            "motion": _motion(thing),
            "shown": shown(thing).tobytes() if thing.type == "MESH" else b"",
        }
    for mesh in bpy.data.meshes:
        found[f"mesh {mesh.name}"] = (
            part("bridge.meshes").read_positions(mesh).tobytes(),
            sorted(attribute.name for attribute in mesh.attributes),
            len(mesh.polygons),
        )
    for keys in bpy.data.shape_keys:
        found[f"keys {keys.name}"] = (_motion(keys), [_key(key) for key in keys.key_blocks])
    return found


def differences(before: dict[str, object], after: dict[str, object]) -> list[str]:
    """What of `everything` is not as it was."""
    return [name for name in {**before, **after} if before.get(name) != after.get(name)]


def _key(key: bpy.types.ShapeKey) -> tuple[object, ...]:
    flat = np.empty(3 * len(key.points), np.float32)
    key.points.foreach_get("co", flat)
    traits = (key.value, key.mute, key.slider_min, key.slider_max, key.vertex_group, key.relative_key.name)
    return key.name, *traits, flat.tobytes()


def _motion(animated: bpy.types.ID) -> object:
    """Curves and drivers."""
    animation = animated.animation_data
    if animation is None:
        return None
    bag = part("bridge.curves").find_curves(animated)
    curves = [
        (curve.data_path, curve.array_index, [tuple(key.co) for key in curve.keyframe_points], curve.mute)
        for curve in (bag.fcurves if bag else ())
    ]
    drivers = [(curve.data_path, curve.driver.expression, len(curve.driver.variables)) for curve in animation.drivers]
    return animation.action.name if animation.action else "", curves, drivers, len(animation.nla_tracks)


def _values(group: bpy.types.PropertyGroup) -> dict[str, object]:
    """A property group with all that it holds, without what is worked out when it is read."""
    found: dict[str, object] = {}
    for prop in group.bl_rna.properties:
        if prop.identifier == "rna_type" or (prop.is_readonly and prop.type not in ("POINTER", "COLLECTION")):
            continue
        value = getattr(group, prop.identifier)
        if prop.type == "COLLECTION":
            found[prop.identifier] = [_values(item) for item in value]
        elif isinstance(value, bpy.types.PropertyGroup):
            found[prop.identifier] = _values(value)
        elif isinstance(value, bpy.types.ID):
            found[prop.identifier] = value.name
        elif getattr(prop, "is_array", False):
            found[prop.identifier] = tuple(value)
        else:
            found[prop.identifier] = value
    return found
