"""The limit of modified butterfly at valences 4, 5 and 7 as a picture, Loop's beneath.

``.venv/bin/python -m bench.butterfly_limit picture.png``
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from facial_retarget_addon.core.arrays import IntArray
from facial_retarget_addon.core.levels.butterfly import butterfly
from facial_retarget_addon.core.levels.subdivision import Scheme, hierarchy, loop
from facial_retarget_addon.files.images import png_bytes
from facial_retarget_addon.files.pages.pictures import Image, contact_sheet, shade

VALENCES = (4, 5, 7)
RINGS, LEVELS = 2, 5
"""Flat splits that put regular vertices around the one in the middle; steps towards the limit."""


def main(path: str) -> None:
    """Write the picture."""
    pictures = [limit(scheme, valence) for scheme in (butterfly, loop) for valence in VALENCES]
    Path(path).write_bytes(png_bytes(contact_sheet(pictures, len(VALENCES))))


def limit(scheme: Scheme, valence: int) -> Image:
    """A smooth bump over a fan whose middle has some valence."""
    rim: IntArray = 1 + np.arange(valence)
    faces = np.stack([np.zeros(valence, np.int64), rim, np.roll(rim, -1)], axis=1)
    angle = 2 * np.pi * np.arange(valence) / valence
    places = np.concatenate([np.zeros((1, 2)), np.stack([np.cos(angle), np.sin(angle)], axis=1)])
    for step in hierarchy(faces, len(places), RINGS):
        places, faces = np.concatenate([places, places[step.parents].mean(axis=1)]), step.faces
    height = 0.45 * np.exp(-np.square(places).sum(axis=1) / 0.35**2)
    positions = np.column_stack([places, height])
    for step in hierarchy(faces, len(positions), LEVELS, scheme):
        positions, faces = step.matrix @ positions, step.faces
    return shade(positions, faces, (420, 420), (0.0, -35.0))


if __name__ == "__main__":
    main(*sys.argv[1:])
