"""A wrinkle kit on the built-in faces: sliders move the wrinkles of a light mesh.

    python docs/samples/13_wrinkle_kit.py FOLDER

Makes the kit of seven ARKit shapes for level 2 of the ape, gives it to an object with these shapes as keys, and renders
it at several values of the sliders: without the wrinkles, with the kit, and with a normal map made for that very
moment. Leaves FOLDER/wrinkle_kit.png, and FOLDER/wrinkle_kit/, which an engine can read. Ends with status 1 if the kit
brings a picture less than 70 % of the way from the first to the last.
"""

import sys
from importlib import import_module
from pathlib import Path
from typing import cast

import bpy
import numpy as np
from scipy.ndimage import binary_erosion

from facial_retarget_addon import demo
from facial_retarget_addon.bridge.key_sets import write_keys
from facial_retarget_addon.bridge.maps.map_nodes import MapSequence, wire
from facial_retarget_addon.bridge.maps.wrinkle_nodes import LABEL, STRENGTH, wire_kit
from facial_retarget_addon.core.level_retargeter import LevelRetargeter
from facial_retarget_addon.core.methods.base import fit
from facial_retarget_addon.core.methods.settings import HierarchicalSettings, WrinkleSettings
from facial_retarget_addon.core.normal_maps.encoding import as_picture
from facial_retarget_addon.core.normal_maps.frame_maps import FrameMaps
from facial_retarget_addon.core.normal_maps.key_poses import Pose, retargeted_poses
from facial_retarget_addon.core.normal_maps.wrinkle_kit import fit_wrinkle_kit
from facial_retarget_addon.core.problem import Problem
from facial_retarget_addon.core.shapes.shape_set import ShapeSet
from facial_retarget_addon.files.images import png_bytes, write_image
from facial_retarget_addon.files.normal_map_files import map_name
from facial_retarget_addon.files.whole import written_whole
from facial_retarget_addon.files.wrinkle_kit_files import kit_folder, write_wrinkle_kit

figure_11 = import_module("10_figure_11")

BROWS = ("browInnerUp", "browOuterUpLeft", "browOuterUpRight")
NOSE = ("noseSneerLeft", "noseSneerRight", "cheekSquintLeft", "cheekSquintRight")
MOMENTS = (
    dict.fromkeys(BROWS, 0.5),
    dict.fromkeys(BROWS, 1.0),
    {"browInnerUp": 1.0} | dict.fromkeys(NOSE, 1.0),
)
SETTINGS = WrinkleSettings(level=2, pixels=1024)
TILE, WAY = (0, 0), 0.7


def main(folder: Path) -> bool:
    """Make kit and picture; whether the kit brings it far enough."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    donor, ape = demo.donor(42_000), demo.ape()
    rest = donor.face.mesh.vertices
    made = demo.face_shapes(donor, ["arkit"])
    shapes = ShapeSet.of_positions(rest, {name: made[name] for name in (*BROWS, *NOSE)})
    problem = Problem(donor.face, ape.face)
    maps = FrameMaps(
        cast(LevelRetargeter, fit("hierarchical", problem, HierarchicalSettings(levels=5))), problem, None, SETTINGS
    )
    posed = retargeted_poses(maps, rest, shapes, shapes.names)
    kit = fit_wrinkle_kit(maps, posed, SETTINGS.least)
    moves = {name: poses().pose.light - posed.neutral.light for name, poses in posed.keys.items()}
    truth = [mixed(posed, values) for values in MOMENTS]
    with written_whole() as aside:
        files = write_wrinkle_kit(kit_folder(aside, folder / "wrinkle_kit"), SETTINGS, kit, "ape level 2")
        pictures = aside.place(folder / "wrinkle_kit_truth", replaces=".png")
        pictures.mkdir()
        for number, pose in enumerate(truth, start=1):
            write_image(as_picture(maps.maps[TILE].vectors(*pose)), pictures / map_name("png16", number), "png16")

    surface, count = maps.surface, len(MOMENTS)
    still = np.repeat(posed.neutral.light[None], count, axis=0)
    light = figure_11.shown("light", surface.mesh.vertices, surface.counts, surface.corners, still)
    light.shape_key_clear()
    light.animation_data_clear()
    write_keys(light, moves, {})
    frames = np.stack([pose.light for pose in truth])
    mapped = figure_11.shown("mapped", surface.mesh.vertices, surface.counts, surface.corners, frames)
    for thing in (light, mapped):
        uvs = np.ravel(surface.uvs).astype(np.float32)
        thing.data.uv_layers.new(name="UVMap").uv.foreach_set("vector", uvs)
    wire_kit(light, folder.absolute() / "wrinkle_kit", files)
    wire(mapped, MapSequence(folder.absolute() / "wrinkle_kit_truth", SETTINGS, (TILE,), range(1, 1 + count)))

    figure_11.stage(frames)
    rows, ways = [], []
    strength = light.material_slots[0].material.node_tree.nodes[LABEL].inputs[STRENGTH]
    for number, values in enumerate(MOMENTS, start=1):
        bpy.context.scene.frame_set(number)
        for key in light.data.shape_keys.key_blocks[1:]:
            key.value = values.get(key.name, 0.0)
        row = []
        for thing, strong in ((light, 0.0), (light, 1.0), (mapped, 1.0)):
            strength.default_value = strong
            row.append(figure_11.picture(thing, (light, mapped), folder / "wrinkle_kit.tile.png"))
        inside = binary_erosion(np.minimum(row[0], row[2])[..., 3] > 0.99, iterations=3)
        before, after = (np.abs(one[..., :3] - row[2][..., :3])[inside].mean() for one in row[:2])
        ways.append(1 - after / before)
        print(f"{', '.join(values)}: the kit brings the picture {ways[-1]:.0%} of the way to that moment's own map")
        rows.append(np.concatenate(row, axis=1))
    whole = np.concatenate(rows)[..., :3]
    (folder / "wrinkle_kit.png").write_bytes(png_bytes(np.round(255 * whole).astype(np.uint8)))
    return min(ways) >= WAY


def mixed(posed, values: dict[str, float]) -> Pose:
    """Both meshes with shape keys at some values."""
    light, fine = (np.array(rest) for rest in posed.neutral)
    for name, value in values.items():
        there = posed.keys[name]().pose
        light += np.float32(value) * (there.light - posed.neutral.light)
        fine += np.float32(value) * (there.fine - posed.neutral.fine)
    return Pose(light, fine)


if __name__ == "__main__":
    sys.exit(0 if main(Path(sys.argv[1])) else 1)
