"""What the live preview is doing, as plain data: the bridge writes it, panels show it, properties tell of changes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, fields

from .core.methods.settings import SETTINGS, STRENGTHS

COLUMNS = ("Torn", "Folds", "Lips", "Lids", "Fit s", "ms")
"""What is compared: torn edges and turned triangles of the mean frame, by how much lips and lids are open otherwise
than the source's in percent, seconds of the fit, milliseconds of a frame.
"""


@dataclass(frozen=True)
class ComparedMethod:
    """A method's figures as the panel shows them, one for each of `COLUMNS`."""

    method: str
    cells: tuple[str, ...]


@dataclass
class PreviewState:
    """What a panel shows of the preview.

    Attributes
    ----------
    on : whether the target follows the source.
    method : the method that is shown.
    stale : what has changed since the fit, "" for nothing.
    trouble : why the last frame could not be shown, "" where it was.
    milliseconds : that the last update took, from reading the source to writing the target.
    rows : the methods that were compared.
    listener : called with what was changed, "faces", "settings", "gains" or "masks", while the preview is on.
    forget : ends the preview and drops what was fitted; None where nothing was.
    """

    on: bool = False
    method: str = ""
    stale: str = ""
    trouble: str = ""
    milliseconds: float = 0.0
    rows: list[ComparedMethod] = field(default_factory=list)
    listener: Callable[[str], None] | None = None
    forget: Callable[[], None] | None = None

    def tell(self, what: str) -> None:
        """A property has changed."""
        if self.listener is not None:
            self.listener(what)


STATE = PreviewState()
"""That of this Blender."""


def strengths(method: str) -> list[str]:
    """Names of the settings of a method that act at once."""
    return [setting.name for setting in fields(SETTINGS[method]) if setting.name in STRENGTHS]
