"""Motion of a face from a file of any format that is read: FAPs, ARKit weights or markers."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ...core.errors import RetargetError
from ...core.markers.take import MarkerTake
from ...core.mpeg4.arkit_take import ArkitTake
from ...core.mpeg4.stream import FapStream
from .arkit_csv import arkit_take, has_arkit_names
from .bvh import read_bvh
from .c3d_markers import read_c3d
from .csv_table import read_csv_table
from .fap import read_fap
from .marker_csv import has_markers, table_markers
from .trc import read_trc

Motion = FapStream | ArkitTake | MarkerTake
READERS: dict[str, Callable[[Path], Motion]] = {".fap": read_fap, ".trc": read_trc, ".c3d": read_c3d, ".bvh": read_bvh}
"""Suffix -> reader, for formats that know their own rate; `.csv` is told by its header."""


def read_motion(path: Path, fps: float | None = None) -> Motion:
    """Read a FAP stream, a take of ARKit weights or a take of markers, by the file's suffix and a table's header.

    Parameters
    ----------
    fps : frames a second of a CSV table that does not tell them; all other files do.

    Raises
    ------
    RetargetError : if the suffix is another one, a table has neither weights nor markers, or as the format's reader.
    """
    suffix = path.suffix.lower()
    if suffix in READERS:
        return READERS[suffix](path)
    if suffix != ".csv":
        expected = ", ".join([*READERS, ".csv"])
        raise RetargetError(f"motion {path} is a {suffix or 'file without a suffix'}, expected one of {expected}")
    table = read_csv_table(path, "a CSV table of ARKit weights or markers")
    if has_arkit_names(table):
        return arkit_take(table, fps)
    if has_markers(table):
        return table_markers(table, fps)
    raise RetargetError(
        f"{path} has neither ARKit weights nor markers, expected columns such as JawOpen, or chin_x, chin_y and chin_z"
    )
