"""A wrinkle kit of the target: a folder of pictures, and materials that wrinkle as the shape keys' sliders say."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple, cast

import numpy as np
from bpy.types import Context, Object, PropertyGroup

from ...core.arrays import FloatArray, Progress, progress_part
from ...core.errors import RetargetError
from ...core.level_retargeter import LevelRetargeter
from ...core.methods.settings import LEVELED, WrinkleSettings
from ...core.normal_maps.frame_maps import FrameMaps, Tile, light_maps
from ...core.normal_maps.key_poses import KeysPosed, Pose, retargeted_poses, sculpted_poses
from ...core.normal_maps.normal_map import NormalMap
from ...core.normal_maps.surface import TexturedSurface
from ...core.normal_maps.wrinkle_kit import WrinkleKit
from ...core.problem import Problem
from ...core.retarget import checked_fit
from ...core.shapes.clone import still_shapes
from ...core.shapes.shape_set import ShapeSet
from ...files.normal_map_files import textured
from ...files.whole import Aside, appear_whole, written_aside
from ...files.wrinkle_kit_files import KitFiles, check_kit_place, kit_folder, write_wrinkle_kit
from ..background import Steps, in_thread, part
from ..cloning.clone_wishes import wanted_names
from ..cloning.cloning import preparer
from ..cloning.donors import donor_steps
from ..heads import Head, own_to_head, read_head
from ..key_sets import check_relative, check_targets, key_names, write_keys
from ..meshes import from_face_space, name_beside, read_positions, read_surface
from ..paths import chosen_path
from ..raycast import available_caster
from ..settings import read_task_settings
from ..shape_keys import find_key, key_displacement
from .map_nodes import check_uv_name
from .map_output import wrinkle_settings
from .normal_maps import level_object
from .wrinkle_nodes import wire_kit

READING = 0.05
PROMISED = 16
"""Pictures that OpenGL promises a material on every graphics card; most take more."""


class MadeKit(NamedTuple):
    """Where a kit went: the folder, the object that it is for, how many keys have wrinkles, and what is to be said."""

    folder: Path
    thing: Object
    keys: int
    pictures: int
    warnings: list[str]


class _Ready(NamedTuple):
    """A light mesh with its maps, and the poses of its keys.

    surface : its neutral, in face space of the target; triangles only where the maps are.
    """

    surface: TexturedSurface
    maps: Mapping[Tile, NormalMap]
    posed: KeysPosed


class _Computed(NamedTuple):
    """A kit whose pictures have not appeared yet.

    moves : name -> (V, 3) how a key moves the light mesh, in face space; none where that has its keys already.
    """

    kit: WrinkleKit
    files: KitFiles
    surface: TexturedSurface
    moves: dict[str, FloatArray]
    aside: Aside

    def discard(self) -> None:
        """Leave no picture behind."""
        self.aside.vanish()


def wrinkle_kit_steps(context: Context) -> Steps[MadeKit]:
    """Make the wrinkle kit of the target's shape keys, and let materials show it.

    The wrinkles are those of the finest level of a retargeting of the shapes that the panel clones, or of a high-poly
    object that has the target's keys. Closing the steps at any time leaves scene and disk as they were.

    Raises
    ------
    RetargetError : for bad input, no common keys, keys without wrinkles; says what, and on which object.
    """
    task = context.scene.facial_retarget
    wish, settings = task.wrinkle_kit, wrinkle_settings(task.wrinkle_kit)
    folder = chosen_path(wish.folder, "folder", "wrinkle kit", "Wrinkle Kit")
    check_kit_place(folder)
    if task.target is None:
        raise RetargetError("no target is chosen, expected a mesh object under Faces")
    if wish.wire and not settings.level:
        check_uv_name(task.target)
    head = read_head(task.target)
    lacking: list[str] = []
    if wish.detail == "OBJECT":
        make = _sculpted(head, wish.fine, settings)
    else:
        make = yield from part(_retargeted(task, head, settings, lacking), 0.0, READING)

    def compute(progress: Progress) -> _Computed:
        ready = make(progress_part(progress, 0.0, 0.4))
        looking = progress_part(progress, 0.4, 0.7)
        kit = WrinkleKit(ready.surface.mesh, ready.maps, ready.posed.neutral, ready.posed.keys, settings.least, looking)
        with written_aside() as aside:
            place = kit_folder(aside, folder)
            files = write_wrinkle_kit(place, settings, kit, head.name, progress_part(progress, 0.7, 1.0))
        moves = {}
        if settings.level:
            for name, poses in ready.posed.keys.items():
                there = poses()
                moves[name] = there.pose.light - there.start.light
        return _Computed(kit, files, ready.surface, moves, aside)

    computed = yield from part(in_thread(compute, _Computed.discard), READING, 1 - READING)
    appear_whole(computed.aside)
    thing = task.target
    if settings.level:
        name = name_beside(task.target, f" level {settings.level} wrinkles")
        thing = level_object(name, task.target, computed.surface)
        write_keys(thing, {name: from_face_space(task.target, move) for name, move in computed.moves.items()}, {})
    warnings = wire_kit(thing, folder, computed.files, computed.surface.shown_polygons) if wish.wire else []
    kit = computed.kit
    return MadeKit(folder, thing, len(kit.keys), kit.pictures, [*_said(kit, lacking), *warnings])


def _said(kit: WrinkleKit, lacking: Sequence[str]) -> list[str]:
    """What the artist should know of keys without a map."""
    said = []
    if lacking:
        said.append(f"shapes without a key of their name on the target: {_some(lacking)}")
    if kit.dropped:
        said.append(f"keys that wrinkle too little for a map: {_some(list(kit.dropped))}")
    if kit.pictures > PROMISED:
        said.append(
            f"the kit has {kit.pictures} pictures, and some graphics cards take {PROMISED} in an EEVEE material; raise "
            "Least if it stays grey there"
        )
    return said


def _some(names: Sequence[str]) -> str:
    """The first few of many names."""
    first = ", ".join(names[:5])
    return first if len(names) <= 5 else f"{first} and {len(names) - 5} more"


def _retargeted(
    task: PropertyGroup, head: Head, settings: WrinkleSettings, lacking: list[str]
) -> Steps[Callable[[Progress], _Ready]]:
    """What retargets the shapes that the panel clones, on a thread; names that the target lacks join `lacking`."""
    method, how = task.method, read_task_settings(task)
    if method not in LEVELED:
        raise RetargetError(f"method {method!r} has no levels, expected one of {', '.join(LEVELED)}")
    surface = None if settings.level else _textured(head)
    donor = yield from donor_steps(task)
    check_targets(donor.things, head.things)
    prepare = preparer(donor, head, wanted_names(donor.names, task.cloning), task.cloning)
    there = None if settings.level else key_names(head.things[0])
    problem = Problem(donor.face, head.face, make_caster=available_caster())

    def make(progress: Progress) -> _Ready:
        prepared = prepare()
        still = still_shapes(problem, prepared.shapes, prepared.correctives)
        names = [name for name in prepared.wanted if name not in still]
        if there is not None:
            lacking.extend(name for name in names if name not in there)
            names = [name for name in names if name in there]
        if not names:
            raise RetargetError(
                f"object {head.name!r} has none of the {len(prepared.wanted)} shape keys that Cloning would give it, "
                "expected keys of the same names: clone them first"
            )
        fitted = cast(LevelRetargeter, checked_fit(method, problem, how, progress_part(progress, 0.0, 0.7)))
        maps = FrameMaps(fitted, problem, surface, settings, progress_part(progress, 0.7, 1.0))
        rest = donor.face.mesh.vertices
        posed = retargeted_poses(maps, rest, prepared.shapes, names, prepared.correctives)
        return _Ready(maps.mapped, maps.maps, posed)

    return make


def _sculpted(head: Head, fine: Object | None, settings: WrinkleSettings) -> Callable[[Progress], _Ready]:
    """What takes the wrinkles of a high-poly object with keys of the target's names, on a thread."""
    face = head.things[0]
    if fine is None or fine == face:
        raise RetargetError("no high-poly object is chosen for the wrinkles, expected another mesh than the target")
    for thing in (face, fine):
        check_relative(thing)
    names = [name for name in key_names(face) if name in key_names(fine)]
    if not names:
        raise RetargetError(
            f"objects {face.name!r} and {fine.name!r} have no shape key of the same name, expected the keys that "
            "wrinkle on both"
        )
    surface, matrix = _textured(head), own_to_head(face, fine)
    places = read_positions(fine.data).astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3]
    high = read_surface(fine, places, bool(np.linalg.det(matrix[:3, :3]) < 0)).mesh
    theirs = np.stack([key_displacement(find_key(fine, name)) for name in names]) @ matrix[:3, :3].T
    count = len(surface.mesh.vertices)
    ours, fines = ShapeSet(tuple(names), head.displacements(names)[:, :count]), ShapeSet(tuple(names), theirs)
    neutral = Pose(surface.mesh.vertices.astype(np.float32), high.vertices.astype(np.float32))
    caster = available_caster()

    def make(progress: Progress) -> _Ready:
        maps = light_maps(surface, high, settings, None, caster, progress)
        return _Ready(surface, maps, sculpted_poses(neutral, ours, fines))

    return make


def _textured(head: Head) -> TexturedSurface:
    """The target's own face with its texture coordinates."""
    face = head.things[0]
    count = len(face.data.vertices)
    places = head.face.mesh.vertices[:count]
    mirrored = bool(np.linalg.det(head.linear[0]) < 0)
    return textured(read_surface(face, places, mirrored), f"object {face.name!r}")
