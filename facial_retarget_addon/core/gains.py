"""How strong the motion is at each place of the target: by its regions, and by masks that the artist has painted."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, NamedTuple

from .arrays import FloatArray
from .methods.settings import RegionGains


class Mask(NamedTuple):
    """A painted mask: weights (V,) from 0 to 1, and the strength of the motion where they are 1."""

    weights: FloatArray
    gain: float


@dataclass(frozen=True, eq=False)
class Gains:
    """Strengths of the motion on the target; 1 everywhere changes nothing."""

    regions: RegionGains = field(default_factory=RegionGains)
    masks: Mapping[str, Mask] = field(default_factory=dict)

    @property
    def plain(self) -> bool:
        """Whether all of them are 1."""
        return self.regions == RegionGains() and all(mask.gain == 1.0 for mask in self.masks.values())

    def report(self) -> dict[str, Any]:
        """Those that change anything, as plain data."""
        if self.plain:
            return {}
        return {"gains": {**asdict(self.regions), "masks": {name: mask.gain for name, mask in self.masks.items()}}}
