"""Drivers of shape keys, copied to the same keys of another head."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from bpy.types import ID, DriverTarget, FCurve, Object

from ..shape_keys import key_curves, key_path

Renamed = Mapping[str, str]
"""Name of a copied key -> name of the key that it was copied from."""


def copy_drivers(source: Object, target: Object, renamed: Renamed, family: Collection[Object], face: Object) -> None:
    """Copy the drivers of some keys; drivers that those keys have on the target already go.

    What a driver reads stays what it is, but for shape keys of the source's own head: it then reads the same key of
    the target's head, where that has it.

    Parameters
    ----------
    renamed : target key -> source key, of those to copy.
    family : the source's objects.
    face : the object of the target's head that holds all of its keys.
    """
    keys = source.data.shape_keys
    if keys is None or keys.animation_data is None:
        return
    there = {old: new for new, old in reversed(renamed.items())}
    for new, old in renamed.items():
        for curve in key_curves(keys.animation_data.drivers, old):
            copied = _copied(curve, target.data.shape_keys, key_path(new) + curve.data_path[len(key_path(old)) :])
            for variable in copied.driver.variables:
                for read in variable.targets:
                    _redirect(read, family, face, there)


def _copied(curve: FCurve, keys: ID, path: str) -> FCurve:
    keys.driver_remove(path)
    copied = (keys.animation_data or keys.animation_data_create()).drivers.from_existing(src_driver=curve)
    copied.data_path = path
    return copied


def _redirect(read: DriverTarget, family: Collection[Object], face: Object, there: Mapping[str, str]) -> None:
    """Let a variable that reads a key of the source's head read the target's."""
    for thing in family:
        for id_, own, before in (
            (thing.data.shape_keys, face.data.shape_keys, ""),
            (thing.data, face.data, "shape_keys."),
            (thing, face, "data.shape_keys."),
        ):
            if read.id is not None and read.id == id_ and read.data_path.startswith(f"{before}key_blocks["):
                path = read.data_path[len(before) :]
                for old in _names_in(path, thing):
                    new = there.get(old, old)
                    if new in face.data.shape_keys.key_blocks:
                        read.id = own
                        read.data_path = before + key_path(new) + path[len(key_path(old)) :]
                return


def _names_in(path: str, thing: Object) -> list[str]:
    """The shape key that a path reads, if the object has it."""
    return [key.name for key in thing.data.shape_keys.key_blocks if path.startswith(f"{key_path(key.name)}.")][:1]
