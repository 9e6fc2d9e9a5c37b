"""A wrinkle kit in materials: a node group that blends its pictures, with an input for each shape key, which a driver
fills with the key's value. Drivers of that kind run no script: Blender asks nobody before it opens the file.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import bpy
from bpy.types import Image, Key, Node, NodeSocket, NodeTree, Object, ShaderNode, ShaderNodeTree

from ...core.arrays import BoolArray
from ...core.normal_maps.wrinkle_kit import LOWEST
from ...files.normal_map_files import udim_number
from ...files.wrinkle_kit_files import UDIM, KitFiles
from ..shape_keys import value_path
from . import map_nodes

LABEL = "Wrinkle Kit"
"""The node with this label is ours, and goes with its group."""
ADDING = "Facial Retarget Wrinkle"
"""The group that adds one wrinkle to those before it."""
STRENGTH = "Strength"


def wire_kit(thing: Object, folder: Path, files: KitFiles, polygons: BoolArray | None = None) -> list[str]:
    """Let an object's materials, or those of some polygons (P,), wrinkle by the values of its shape keys.

    Where there is no material it gets one.

    An earlier kit and normal maps of ours go. A Principled shader whose normal comes from nodes of the artist's own
    keeps them, and bump nodes get the wrinkles beneath their bumps; a warning names the material of any other.
    """
    remove_kit(thing)
    group = _kit_group(thing, folder, files)
    warnings = []
    for material in map_nodes.materials(thing, polygons):
        tree = map_nodes.node_tree(material)
        map_nodes.remove_maps(tree)
        shaders = [node for node in tree.nodes if node.type == "BSDF_PRINCIPLED"]
        free = [socket for node in shaders if (socket := map_nodes.free_normal(node)) is not None]
        if len(free) < len(shaders) or not shaders:
            what = "has a normal of its own" if shaders else "has no Principled shader"
            warnings.append(f"material {material.name!r} {what}: the wrinkle kit is not wired there")
        if free:
            node = tree.nodes.new("ShaderNodeGroup")
            node.node_tree, node.label, node.name = group, LABEL, LABEL
            left, top = free[0].node.location
            node.location, node.width = (left - 260, top - 260), 220
            for socket in free:
                tree.links.new(node.outputs[0], socket)
            _drive(node, files, thing.data.shape_keys)
    if not group.users:
        _remove_group(group)
    return warnings


def remove_kit(thing: Object) -> int:
    """Take a kit out of an object's materials, with its drivers, group and pictures; returns how many materials had it.

    Shape keys and files stay.
    """
    groups, found = set(), 0
    for slot in thing.material_slots:
        tree = None if slot.material is None else slot.material.node_tree
        ours = [] if tree is None else [node for node in tree.nodes if node.label == LABEL and node.type == "GROUP"]
        found += bool(ours)
        for node in ours:
            groups.add(node.node_tree)
            for socket in node.inputs:
                socket.driver_remove("default_value")
            tree.nodes.remove(node)
    for group in groups - {None}:
        if not group.users:
            _remove_group(group)
    return found


def _remove_group(group: NodeTree) -> None:
    """Remove a group, and the pictures and the group in it that nothing else uses."""
    inner = {node.node_tree for node in group.nodes if node.type == "GROUP"}
    images = {node.image for node in group.nodes if node.type == "TEX_IMAGE"}
    bpy.data.node_groups.remove(group)
    for image in images - {None}:
        if not image.users:
            bpy.data.images.remove(image)
    for one in inner - {None}:
        if not one.users:
            bpy.data.node_groups.remove(one)


def _drive(node: Node, files: KitFiles, keys: Key) -> None:
    """Let each input of a group node be the value of its shape key."""
    for number, key in enumerate(files.keys, start=1):
        curve = node.inputs[number].driver_add("default_value")
        # The straight line that a new driver passes through costs digits: keyframes from 5.0 on, a modifier before.
        curve.keyframe_points.clear()
        for modifier in list(curve.modifiers):
            curve.modifiers.remove(modifier)
        curve.driver.type = "SUM"
        target = curve.driver.variables.new().targets[0]
        target.id_type, target.id, target.data_path = "KEY", keys, value_path(key.name)


def _kit_group(thing: Object, folder: Path, files: KitFiles) -> ShaderNodeTree:
    """The group of a kit: a strength and a value for each key in, a normal out."""
    group = bpy.data.node_groups.new(f"{thing.name} wrinkles", "ShaderNodeTree")
    strength = group.interface.new_socket(STRENGTH, in_out="INPUT", socket_type="NodeSocketFloat")
    strength.default_value, strength.min_value, strength.max_value = 1.0, 0.0, 4.0
    strength.description = "How strong the wrinkles are; the neutral's own detail stays"
    for key in files.keys:
        group.interface.new_socket(key.name, in_out="INPUT", socket_type="NodeSocketFloat")
    group.interface.new_socket("Normal", in_out="OUTPUT", socket_type="NodeSocketVector")
    _Kit(group, thing.data.uv_layers.active.name, folder, files).build()
    return group


class _Kit:
    """Fills the group of a kit with nodes.

    Parameters
    ----------
    uv_name : the UV map of the pictures.
    """

    def __init__(self, group: ShaderNodeTree, uv_name: str, folder: Path, files: KitFiles) -> None:
        self._group, self._uv_name, self._folder, self._files = group, uv_name, folder, files
        self._row = 0
        uv = self._node("ShaderNodeUVMap", -6)
        uv.uv_map = uv_name
        self._uv = uv.outputs["UV"]
        self._adding = _adding_group()

    def build(self) -> None:
        """The neutral's slopes, those of all keys times the strength, and the normal that has them."""
        given = self._node("NodeGroupInput", -3).outputs
        neutral = self._wrinkle(self._channels(self._files.neutral), "RG", 1.0, None)
        added = None
        weights = self._weights(given)
        channels = {name: self._channels(name) for name in dict.fromkeys(name for name, _ in weights)}
        for (name, pair), weight in weights.items():
            added = self._wrinkle(channels[name], pair, weight, added)
        # The neutral comes first: exporters take the first picture that they find for the normal map.
        whole = self._vector("ADD", 3, neutral, self._vector("MULTIPLY", 2, added, given[STRENGTH]))
        whole = self._vector("ADD", 4, whole, (0.0, 0.0, 1.0))
        if self._files.settings.convention == "directx":
            whole = self._vector("MULTIPLY", 5, whole, (1.0, -1.0, 1.0))
        whole = self._vector("NORMALIZE", 6, whole)
        whole = self._vector("MULTIPLY_ADD", 7, whole, (0.5, 0.5, 0.5), (0.5, 0.5, 0.5))
        normal = self._node("ShaderNodeNormalMap", 8)
        normal.uv_map = self._uv_name
        self._group.links.new(whole, normal.inputs["Color"])
        self._group.links.new(normal.outputs["Normal"], self._node("NodeGroupOutput", 9).inputs[0])

    def _weights(self, given: Mapping[str, NodeSocket]) -> dict[tuple[str, str], NodeSocket]:
        """Picture and channels of each layer -> the sum of value times mask over its keys."""
        masks = {name: self._channels(name) for name in dict.fromkeys(key.mask for key in self._files.keys)}
        weights: dict[tuple[str, str], NodeSocket] = {}
        # A key may be called as the strength is: its input is found by its place.
        for value, key in zip(list(given)[1:], self._files.keys, strict=False):
            node = self._node("ShaderNodeMath", -1)
            node.operation = "MULTIPLY_ADD"
            self._group.links.new(value, node.inputs[0])
            self._group.links.new(masks[key.mask][key.channel], node.inputs[1])
            node.inputs[2].default_value = 0.0
            before = weights.get((key.wrinkle, key.pair))
            if before is not None:
                self._group.links.new(before, node.inputs[2])
            weights[key.wrinkle, key.pair] = node.outputs[0]
        return weights

    def _channels(self, name: str) -> dict[str, NodeSocket]:
        """The channels R, G, B, A of a picture."""
        picture = self._node("ShaderNodeTexImage", -5)
        picture.image = _image(self._folder, name, self._files)
        self._group.links.new(self._uv, picture.inputs["Vector"])
        split = self._node("ShaderNodeSeparateColor", -4)
        self._group.links.new(picture.outputs["Color"], split.inputs[0])
        self._row += 1
        return dict(zip("RGBA", (*split.outputs[:3], picture.outputs["Alpha"]), strict=True))

    def _wrinkle(
        self, channels: Mapping[str, NodeSocket], pair: str, weight: NodeSocket | float, before: NodeSocket | None
    ) -> NodeSocket:
        """Slopes with those of two channels added."""
        node = self._node("ShaderNodeGroup", 0)
        node.node_tree = self._adding
        for socket, value in zip(node.inputs, (before, channels[pair[0]], channels[pair[1]], weight), strict=True):
            if isinstance(value, NodeSocket):
                self._group.links.new(value, socket)
            elif value is not None:
                socket.default_value = value
        self._row += 1
        return node.outputs[0]

    def _vector(self, operation: str, column: int, *values: NodeSocket | tuple[float, float, float]) -> NodeSocket:
        return _vector_math(self._group, self._node("ShaderNodeVectorMath", column), operation, values)

    def _node(self, kind: str, column: int) -> ShaderNode:
        node = self._group.nodes.new(kind)
        node.location = (220 * column, -280 * self._row)
        return node


def _adding_group() -> ShaderNodeTree:
    """The group that adds one wrinkle: its x and y as colours, unpacked to slopes, times its weight."""
    there = bpy.data.node_groups.get(ADDING)
    if there is not None:
        return there
    group = bpy.data.node_groups.new(ADDING, "ShaderNodeTree")
    for name, kind in (("Before", "Vector"), ("X", "Float"), ("Y", "Float"), ("Weight", "Float")):
        group.interface.new_socket(name, in_out="INPUT", socket_type=f"NodeSocket{kind}")
    group.interface.new_socket("Slopes", in_out="OUTPUT", socket_type="NodeSocketVector")
    columns = iter(range(20))

    def new(kind: str) -> ShaderNode:
        node = group.nodes.new(kind)
        node.location = (200 * next(columns), 0)
        return node

    def math(operation: str, *values: NodeSocket | float) -> NodeSocket:
        node = new("ShaderNodeMath")
        map_nodes.operate(group, node, operation, *values)
        return node.outputs[0]

    before, x, y, weight = new("NodeGroupInput").outputs[:4]
    joined = new("ShaderNodeCombineXYZ")
    group.links.new(math("MULTIPLY_ADD", x, 2.0, -1.0), joined.inputs[0])
    group.links.new(math("MULTIPLY_ADD", y, 2.0, -1.0), joined.inputs[1])
    squared = _vector_math(group, new("ShaderNodeVectorMath"), "DOT_PRODUCT", (joined.outputs[0], joined.outputs[0]))
    rest = math("MAXIMUM", math("SUBTRACT", 1.0, squared), LOWEST**2)
    scale = math("MULTIPLY", math("INVERSE_SQRT", rest), weight)
    slopes = _vector_math(group, new("ShaderNodeVectorMath"), "MULTIPLY_ADD", (joined.outputs[0], scale, before))
    group.links.new(slopes, new("NodeGroupOutput").inputs[0])
    return group


def _vector_math(
    tree: NodeTree, node: Node, operation: str, values: tuple[NodeSocket | tuple[float, float, float], ...]
) -> NodeSocket:
    """The output of a vector-math node; a number that is linked counts for all three coordinates."""
    map_nodes.operate(tree, node, operation, *values)
    return node.outputs["Value" if operation == "DOT_PRODUCT" else "Vector"]


def _image(folder: Path, name: str, files: KitFiles) -> Image:
    """A picture of the kit, read from disk again if it is there already."""
    numbers = [udim_number(tile) for tile in files.tiles]
    first = str(folder / name.replace(UDIM, str(numbers[0])))
    wanted = str(folder / name)
    image = next((one for one in bpy.data.images if bpy.path.abspath(one.filepath) == wanted), None)
    if image is None:
        image = bpy.data.images.load(first)
    if len(numbers) > 1:
        image.source, image.filepath = "TILED", wanted
        image.tiles[0].number = numbers[0]
        for number in numbers[1:]:
            if image.tiles.get(number) is None:
                image.tiles.new(tile_number=number)
    image.colorspace_settings.name = "Non-Color"
    image.alpha_mode = "CHANNEL_PACKED"  # the alpha is data
    image.name = f"{folder.name} {name}"
    image.reload()
    return image
