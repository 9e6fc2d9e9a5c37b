"""Normal maps in materials: image sequences, through a normal-map node, into every Principled shader."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import bpy
from bpy.types import Image, Material, Node, NodeSocket, NodeTree, Object

from ...core.methods.settings import MapSettings
from ...core.normal_maps.frame_maps import Tile
from ...files.normal_map_files import map_name, udim_number

LABEL = "Facial Retarget Normal Map"
"""Nodes with this label are ours: made anew each time."""


class MapSequence(NamedTuple):
    """Maps on disk, by frame and UDIM tile."""

    folder: Path
    settings: MapSettings
    tiles: tuple[Tile, ...]
    frames: range


def wire(thing: Object, sequence: MapSequence) -> list[str]:
    """Let an object's materials show maps; it gets a material if it has none.

    A Principled shader whose normal comes from nodes of the artist's own keeps them: a warning names its material.
    """
    warnings = []
    uv_name = thing.data.uv_layers.active.name
    for material in materials(thing):
        tree = node_tree(material)
        remove_maps(tree)
        shaders = [node for node in tree.nodes if node.type == "BSDF_PRINCIPLED"]
        free = [node for node in shaders if not node.inputs["Normal"].is_linked]
        if len(free) < len(shaders) or not shaders:
            what = "has a normal of its own" if shaders else "has no Principled shader"
            warnings.append(f"material {material.name!r} {what}: the normal map is not wired there")
        if free:
            normal = _normal(tree, sequence, uv_name, free[0])
            for node in free:
                tree.links.new(normal, node.inputs["Normal"])
    return warnings


def materials(thing: Object) -> list[Material]:
    """An object's materials, each once; it gets one if it has none."""
    if not any(slot.material for slot in thing.material_slots):
        thing.data.materials.append(bpy.data.materials.new(thing.name))
    return list(dict.fromkeys(slot.material for slot in thing.material_slots if slot.material))


def remove_maps(tree: NodeTree) -> None:
    """Remove the nodes of earlier maps."""
    for node in [node for node in tree.nodes if node.label == LABEL]:
        tree.nodes.remove(node)


def node_tree(material: Material) -> NodeTree:
    """A material's nodes."""
    # From 5.0 on every material has its nodes; asking for them there warns.
    if bpy.app.version < (5, 0) and not material.use_nodes:
        material.use_nodes = True
    return material.node_tree


def _normal(tree: NodeTree, sequence: MapSequence, uv_name: str, before: Node) -> NodeSocket:
    """The output that has the normal: new nodes, to the left of a shader."""
    left, top = before.location
    colours = []
    for row, tile in enumerate(sequence.tiles):
        colours.append(_picture(tree, sequence, tile, uv_name, (left - 640, top - 320 * row)))
    colour = colours[0]
    for other in colours[1:]:
        # Each picture is black outside its tile.
        both = _new(tree, "ShaderNodeVectorMath", (left - 400, top))
        both.operation = "ADD"
        tree.links.new(colour, both.inputs[0])
        tree.links.new(other, both.inputs[1])
        colour = both.outputs[0]
    node = _new(tree, "ShaderNodeNormalMap", (left - 220, top))
    node.uv_map = uv_name
    if sequence.settings.convention == "directx":
        if hasattr(node, "convention"):  # from 5.2 on
            node.convention = "DIRECTX"
        else:
            colour = _green_turned(tree, colour, (left - 400, top - 160))
    tree.links.new(colour, node.inputs["Color"])
    return node.outputs["Normal"]


def _picture(tree: NodeTree, sequence: MapSequence, tile: Tile, uv_name: str, place: tuple[float, float]) -> NodeSocket:
    """The colour of one tile's maps."""
    node = _new(tree, "ShaderNodeTexImage", place)
    node.image = _image(sequence, tile)
    node.image_user.frame_start = sequence.frames.start
    node.image_user.frame_duration = len(sequence.frames)
    node.image_user.frame_offset = sequence.frames.start - 1
    node.image_user.use_auto_refresh = True
    uv = _new(tree, "ShaderNodeUVMap", (place[0] - 420, place[1]))
    uv.uv_map = uv_name
    where = uv.outputs["UV"]
    if len(sequence.tiles) > 1:
        node.extension = "CLIP"
        mapping = _new(tree, "ShaderNodeMapping", (place[0] - 220, place[1]))
        mapping.inputs["Location"].default_value = (-tile[0], -tile[1], 0.0)
        tree.links.new(where, mapping.inputs["Vector"])
        where = mapping.outputs["Vector"]
    tree.links.new(where, node.inputs["Vector"])
    return node.outputs["Color"]


def _green_turned(tree: NodeTree, colour: NodeSocket, place: tuple[float, float]) -> NodeSocket:
    """A colour whose green points the other way."""
    node = _new(tree, "ShaderNodeVectorMath", place)
    node.operation = "MULTIPLY_ADD"
    node.inputs[1].default_value, node.inputs[2].default_value = (1, -1, 1), (0, 1, 0)
    tree.links.new(colour, node.inputs[0])
    return node.outputs[0]


def _image(sequence: MapSequence, tile: Tile) -> Image:
    """The first frame's picture, as a sequence where there are several."""
    several = len(sequence.tiles) > 1
    path = sequence.folder / map_name(sequence.settings.depth, sequence.frames.start, tile if several else None)
    image = bpy.data.images.load(str(path), check_existing=True)
    image.reload()
    image.colorspace_settings.name = "Non-Color"
    image.source = "SEQUENCE" if len(sequence.frames) > 1 else "FILE"
    image.name = f"{sequence.folder.name} {udim_number(tile)}"
    return image


def _new(tree: NodeTree, kind: str, place: tuple[float, float]) -> Node:
    node = tree.nodes.new(kind)
    node.label, node.location = LABEL, place
    return node
