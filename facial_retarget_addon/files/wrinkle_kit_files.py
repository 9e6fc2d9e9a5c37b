"""A wrinkle kit as a folder: the neutral's normal map, pictures of wrinkles, pictures of masks, and what is where."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from ..core.arrays import Progress, no_progress
from ..core.errors import RetargetError
from ..core.methods.settings import WrinkleSettings
from ..core.normal_maps.encoding import as_pairs, as_picture
from ..core.normal_maps.frame_maps import Tile
from ..core.normal_maps.wrinkle_kit import LAYERS, LOWEST, MASKS, WrinkleKit
from .documents import json_bytes
from .images import suffix_of, write_image
from .normal_map_files import udim_number
from .whole import Aside, check_place

DOCUMENT = "wrinkles.json"
FORMAT, VERSION = "facial-retarget/wrinkle-kit", 1
NEUTRAL = "neutral"
UDIM = "<UDIM>"
"""Stands for a tile's number in the name of a picture."""

_OURS = re.compile(r"(neutral|wrinkle_\d+|mask_\d+)(\.\d{4})?\.(png|exr)")
_SUFFIXES = (".png", ".exr", ".json")
_CHANNELS = "RGBA"


class KeyPlace(NamedTuple):
    """Where a key's wrinkle and mask lie: names of pictures, and their channels, such as RG, BA and R."""

    name: str
    wrinkle: str
    pair: str
    mask: str
    channel: str


@dataclass(frozen=True)
class KitFiles:
    """What the pictures of a kit are called, and what they hold.

    Attributes
    ----------
    settings : how they were made.
    tiles : UDIM tiles with pictures; where there are several, the names of pictures hold `UDIM`.
    keys : those that wrinkle.
    """

    settings: WrinkleSettings
    tiles: tuple[Tile, ...]
    keys: tuple[KeyPlace, ...]

    @classmethod
    def of(cls, kit: WrinkleKit, settings: WrinkleSettings) -> KitFiles:
        """What a kit becomes."""
        files = cls(settings, kit.tiles, ())
        places = []
        for number, key in enumerate(kit.keys):
            first = LAYERS * (key.layer % LAYERS)
            places.append(
                KeyPlace(
                    key.name,
                    files.wrinkle(key.layer // LAYERS),
                    _CHANNELS[first : first + 2],
                    files.mask(number // MASKS),
                    _CHANNELS[number % MASKS],
                )
            )
        return cls(settings, kit.tiles, tuple(places))

    @property
    def neutral(self) -> str:
        """The neutral's normal map."""
        return self._name(NEUTRAL)

    def wrinkle(self, number: int) -> str:
        """A picture of wrinkles, from 0."""
        return self._name(f"wrinkle_{number + 1}")

    def mask(self, number: int) -> str:
        """A picture of masks, from 0."""
        return self._name(f"mask_{number + 1}")

    def _name(self, stem: str) -> str:
        return f"{stem}{f'.{UDIM}' if len(self.tiles) > 1 else ''}{suffix_of(self.settings.depth)}"


def check_kit_place(folder: Path) -> None:
    """RetargetError if a kit cannot be written there, or would replace anything but an earlier kit."""
    if folder.is_dir():
        for entry in sorted(folder.iterdir()):
            if entry.name != DOCUMENT and not _OURS.fullmatch(entry.name):
                raise RetargetError(
                    f"folder {folder} holds {entry.name!r}; expected a new folder, or one that holds a wrinkle kit and "
                    "nothing else, since it is replaced"
                )
    check_place(folder, _SUFFIXES)


def kit_folder(aside: Aside, folder: Path) -> Path:
    """A new folder for a kit that takes the place of another one; RetargetError as `check_kit_place`."""
    check_kit_place(folder)
    place = aside.place(folder, replaces=_SUFFIXES)
    place.mkdir()
    return place


def write_wrinkle_kit(
    folder: Path, settings: WrinkleSettings, kit: WrinkleKit, mesh: str, progress: Progress = no_progress
) -> KitFiles:
    """Write a kit into a folder that is there.

    Parameters
    ----------
    mesh : what the document calls the light mesh.
    """
    files, directx = KitFiles.of(kit, settings), settings.convention == "directx"
    work = [("neutral", 0)]
    work += [("wrinkle", number) for number in range(kit.difference_pictures)]
    work += [("mask", number) for number in range(kit.mask_pictures)]
    for done, (kind, number) in enumerate(work):
        progress(done / len(work), f"picture {done + 1} of {len(work)}")
        for tile in kit.tiles:
            if kind == "neutral":
                name, picture = files.neutral, as_picture(kit.neutral(tile), directx)
            elif kind == "wrinkle":
                name, picture = files.wrinkle(number), as_pairs(kit.differences(number, tile), directx)
            else:
                name, picture = files.mask(number), kit.masks(number, tile)[::-1]
            write_image(picture, folder / name.replace(UDIM, str(udim_number(tile))), settings.depth)
    (folder / DOCUMENT).write_bytes(json_bytes(_document(files, kit, mesh)))
    return files


def _document(files: KitFiles, kit: WrinkleKit, mesh: str) -> dict[str, Any]:
    """What an engine must know."""
    settings = files.settings
    return {
        "format": FORMAT,
        "version": VERSION,
        "mesh": mesh,
        "pixels": settings.pixels,
        "green": "down" if settings.convention == "directx" else "up",
        "convention": settings.convention,
        "colour_space": "linear",
        "tangents": "MikkTSpace",
        "udim": [udim_number(tile) for tile in files.tiles],
        "neutral": files.neutral,
        "keys": [
            {
                "name": key.name,
                "wrinkle": {"file": place.wrinkle, "channels": place.pair},
                "mask": {"file": place.mask, "channel": place.channel},
                "turn": round(key.turn, 3),
                "kept": round(key.kept, 4),
            }
            for key, place in zip(kit.keys, files.keys, strict=True)
        ],
        "dropped": {name: round(turn, 3) for name, turn in kit.dropped.items()},
        "blend": [
            f"n = 2 * neutral.rgb - 1; slope = n.xy / max(n.z, {LOWEST})",
            "for each key: d = 2 * wrinkle.channels - 1; "
            f"slope += value * mask.channel * d / sqrt(max(1 - dot(d, d), {LOWEST**2:.2g}))",
            "normal = normalize(vec3(slope, 1)), in tangent space",
        ],
    }
