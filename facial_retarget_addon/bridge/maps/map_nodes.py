"""Normal maps in materials: image sequences, through a normal-map node, into every Principled shader."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import bpy
import numpy as np
from bpy.types import Image, Material, Node, NodeSocket, NodeTree, Object

from ...core.arrays import BoolArray
from ...core.errors import RetargetError
from ...core.methods.settings import MapSettings
from ...core.normal_maps.frame_maps import Tile
from ...files.normal_map_files import first_number, map_name, udim_number
from ..key_sets import LONGEST

LABEL = "Facial Retarget Normal Map"
"""Nodes with this label are ours: made anew each time."""


class MapSequence(NamedTuple):
    """Maps on disk, by frame and UDIM tile.

    polygons : (P,) bool, the polygons that they are for; None for all.
    """

    folder: Path
    settings: MapSettings
    tiles: tuple[Tile, ...]
    frames: range
    polygons: BoolArray | None = None


def check_uv_name(thing: Object) -> None:
    """RetargetError if no node can name the active UV map of an object: maps may have longer names than nodes."""
    layer = thing.data.uv_layers.active
    name = "" if layer is None else layer.name
    if len(name.encode()) > LONGEST:
        raise RetargetError(
            f"UV map {name!r} of object {thing.name!r} has a name of {len(name.encode())} bytes, expected at most "
            f"{LONGEST}: materials cannot name it"
        )


def wire(thing: Object, sequence: MapSequence) -> list[str]:
    """Let the materials of an object's mapped polygons show maps; where these have no material they get one.

    A Principled shader whose normal comes from nodes of the artist's own keeps them, with the map beneath a bump; what
    used our normal before uses it again. Warnings name the materials that cannot show the maps, and other objects that
    now show them too.
    """
    warnings = []
    uv_name = thing.data.uv_layers.active.name
    for material in materials(thing, sequence.polygons):
        if material.library is not None:
            warnings.append(f"material {material.name!r} is linked from a library: the normal map is not wired there")
            continue
        tree = node_tree(material)
        taken = remove_maps(tree)
        shaders = [node for node in tree.nodes if node.type == "BSDF_PRINCIPLED"]
        free = [socket for node in shaders if (socket := free_normal(node)) is not None]
        free += [socket for socket in taken if not socket.is_linked and socket not in free]
        if not taken and (len(free) < len(shaders) or not shaders):
            what = "has a normal of its own" if shaders else "has no Principled shader"
            warnings.append(f"material {material.name!r} {what}: the normal map is not wired there")
        if free:
            normal = _normal(tree, sequence, uv_name, free[0].node)
            for socket in free:
                tree.links.new(normal, socket)
            others = _other_users(material, thing)
            if others:
                warnings.append(f"material {material.name!r} shows the normal map on {', '.join(others)} too")
    return warnings


def materials(thing: Object, polygons: BoolArray | None = None) -> list[Material]:
    """An object's materials, each once, or those of some of its polygons (P,); where there is none it gets one."""
    mesh, slots = thing.data, thing.material_slots
    if not slots:
        mesh.materials.append(None)
    if polygons is None:
        used = [number for number, slot in enumerate(slots) if slot.material is not None] or [0]
    else:
        index = np.empty(len(mesh.polygons), np.int32)
        mesh.polygons.foreach_get("material_index", index)
        used = np.unique(np.clip(index[polygons], 0, len(slots) - 1)).tolist()
    for number in used:
        if slots[number].material is None:
            slots[number].material = bpy.data.materials.new(thing.name)
    return list(dict.fromkeys(slots[number].material for number in used))


def remove_maps(tree: NodeTree) -> list[NodeSocket]:
    """Remove the nodes of earlier maps; returns the sockets of other nodes that took their normal."""
    ours = [node for node in tree.nodes if node.label == LABEL]
    links = [link for node in ours if node.type == "NORMAL_MAP" for link in node.outputs["Normal"].links]
    taken = [link.to_socket for link in links if link.to_node not in ours]
    for node in ours:
        tree.nodes.remove(node)
    return taken


def free_normal(shader: Node) -> NodeSocket | None:
    """The socket that takes a normal of a shader: its own, or that of the bump node before it; None if it is taken."""
    socket = shader.inputs["Normal"]
    while socket.is_linked and socket.links[0].from_node.type == "BUMP":
        socket = socket.links[0].from_node.inputs["Normal"]
    return None if socket.is_linked else socket


def _other_users(material: Material, thing: Object) -> list[str]:
    """Names of other objects with a material, other than those that share the object's mesh."""
    return [
        repr(other.name)
        for other in bpy.data.objects
        if other.data != thing.data and any(slot.material == material for slot in other.material_slots)
    ]


def node_tree(material: Material) -> NodeTree:
    """A material's nodes."""
    # From 5.0 on every material has its nodes; asking for them there warns.
    if bpy.app.version < (5, 0) and not material.use_nodes:
        material.use_nodes = True
    return material.node_tree


def _normal(tree: NodeTree, sequence: MapSequence, uv_name: str, before: Node) -> NodeSocket:
    """The output that has the normal: new nodes, to the left of a shader."""
    left, top = before.location
    uv = _new(tree, "ShaderNodeUVMap", (left - 1240, top))
    uv.uv_map = uv_name
    where, several = uv.outputs["UV"], len(sequence.tiles) > 1
    whole = _vector(tree, "FLOOR", (left - 1040, top), where).outputs[0] if several else None
    colour = None
    for row, tile in enumerate(sequence.tiles):
        here = top - 500 * row
        picture = _picture(tree, sequence, tile, (left - 680, here))
        if whole is None:
            tree.links.new(where, picture.inputs["Vector"])
        else:
            # Past its own tile a picture goes on with its border, so that none bleeds into another.
            picture.extension = "EXTEND"
            inside = _vector(tree, "SUBTRACT", (left - 860, here), where, (*tile, 0.0))
            tree.links.new(inside.outputs[0], picture.inputs["Vector"])
        made = picture.outputs["Color"]
        colour = made if colour is None else _of_tile(tree, colour, made, whole, tile, (left - 400, here))
    node = _new(tree, "ShaderNodeNormalMap", (left - 220, top))
    node.uv_map = uv_name
    if sequence.settings.convention == "directx":
        if hasattr(node, "convention"):  # from 5.2 on
            node.convention = "DIRECTX"
        else:
            colour = _green_turned(tree, colour, (left - 400, top - 160))
    tree.links.new(colour, node.inputs["Color"])
    return node.outputs["Normal"]


def _picture(tree: NodeTree, sequence: MapSequence, tile: Tile, place: tuple[float, float]) -> Node:
    """A node with one tile's maps."""
    node = _new(tree, "ShaderNodeTexImage", place)
    node.image = _image(sequence, tile)
    # Before its start Blender plays the picture before a sequence's first, and that is the one here.
    node.image_user.frame_start = sequence.frames.start + 1
    node.image_user.frame_duration = max(len(sequence.frames) - 1, 1)
    node.image_user.frame_offset = first_number(sequence.frames.start)
    node.image_user.use_auto_refresh = True
    return node


def _of_tile(
    tree: NodeTree, others: NodeSocket, own: NodeSocket, whole: NodeSocket, tile: Tile, place: tuple[float, float]
) -> NodeSocket:
    """The own colour in a tile, and that of the others elsewhere; `whole` has u and v rounded down."""
    away = _vector(tree, "DISTANCE", (place[0] - 460, place[1] - 220), whole, (*tile, 0.0))
    mix = _new(tree, "ShaderNodeMix", place)
    mix.data_type = "RGBA"
    factor, first, second = (
        next(socket for socket in mix.inputs if socket.identifier == name)
        for name in ("Factor_Float", "A_Color", "B_Color")
    )
    # The factor stops at 1: that of the others, from one tile away.
    tree.links.new(away.outputs["Value"], factor)
    tree.links.new(own, first)
    tree.links.new(others, second)
    return next(socket for socket in mix.outputs if socket.identifier == "Result_Color")


def _vector(tree: NodeTree, operation: str, place: tuple[float, float], *values: object) -> Node:
    """A node that works on vectors; its inputs are sockets or values."""
    node = _new(tree, "ShaderNodeVectorMath", place)
    operate(tree, node, operation, *values)
    return node


def operate(tree: NodeTree, node: Node, operation: str, *values: object) -> None:
    """Let a math node do something with values, which are sockets or what an input may hold."""
    node.operation = operation
    for socket, value in zip(node.inputs, values, strict=False):
        if isinstance(value, NodeSocket):
            tree.links.new(value, socket)
        else:
            socket.default_value = value


def _green_turned(tree: NodeTree, colour: NodeSocket, place: tuple[float, float]) -> NodeSocket:
    """A colour whose green points the other way."""
    return _vector(tree, "MULTIPLY_ADD", place, colour, (1, -1, 1), (0, 1, 0)).outputs[0]


def _image(sequence: MapSequence, tile: Tile) -> Image:
    """The first frame's picture, as a sequence where there are several."""
    several = len(sequence.tiles) > 1
    number = first_number(sequence.frames.start)
    path = sequence.folder / map_name(sequence.settings.depth, number, tile if several else None)
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
