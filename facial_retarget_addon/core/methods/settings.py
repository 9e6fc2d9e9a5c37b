"""The methods' settings as plain data: no SciPy here, so that panels and job files can read them.

One frozen dataclass per method. Every field has `help`; numbers have `low` and `high`, texts have
`choices`. Job files, the panel and `check` are all made from these.
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any, TypeVar

from ..errors import RetargetError

T = TypeVar("T", bound="Settings | RegionGains | MapSettings | BakeSettings")


def _setting(default: Any, help: str, **limits: Any) -> Any:
    return field(default=default, metadata={"help": help, **limits})


@dataclass(frozen=True)
class LevelSettings:
    """What the methods that work level by level have in common."""

    levels: int = _setting(4, "Levels over the base mesh: each one holds four times the triangles", low=1, high=6)
    base_points: int = _setting(
        105,
        "Base points wanted: what the given ones lack is added between them, matched by the correspondence",
        low=4,
        high=500,
    )
    base_gain: float = _setting(1.0, "Strength of the coarse motion, carried by the base mesh", low=0.0, high=4.0)
    level_gains: tuple[float, ...] = _setting(
        (), "Strength of the motion that each level adds, level 1 first; missing ones are 1", low=0.0, high=4.0
    )
    detail_scale: float = _setting(
        1.0, "Strength of what is finer than the last level, wrinkles above all", low=0.0, high=4.0
    )
    example_strength: float = _setting(1.0, "How far the examples steer the result", low=0.0, high=1.0)

    def gain(self, level: int) -> float:
        """Gain of a level: 0 is the base."""
        if level == 0:
            return self.base_gain
        return self.level_gains[level - 1] if level <= len(self.level_gains) else 1.0


@dataclass(frozen=True)
class HierarchicalSettings(LevelSettings):
    """Settings of the hierarchical method (Na and Jung 2004)."""

    variant: str = _setting(
        "default",
        "default: dense motion with example residuals; paper: the published formulas",
        choices=("default", "paper"),
    )
    read: str = _setting(
        "track",
        "track: the source keeps its topology and its points are followed; pierce: every frame is pierced anew",
        choices=("track", "pierce"),
    )
    frames: str = _setting(
        "local",
        "How motion turns: with the surface around each place, or with the heads as a whole",
        choices=("local", "global"),
    )


@dataclass(frozen=True)
class WaveletSettings(LevelSettings):
    """Settings of the wavelet method (Min and Jung 2005)."""

    mode: str = _setting(
        "framed",
        "framed: details scale and turn with the target's surface; scaled: they scale only; paper: as published, "
        "pasted as they are",
        choices=("framed", "scaled", "paper"),
    )
    source_mesh: str = _setting(
        "matched",
        "Where the source is read: matched: at the counterparts of the target's fine vertices; pierced: on a fine mesh "
        "made for the source by itself",
        choices=("matched", "pierced"),
    )
    lifting: str = _setting(
        "disc",
        "disc: wavelets nearly orthogonal to the coarser levels; integral: wavelets without a mean, for comparison",
        choices=("disc", "integral"),
    )
    disc: int = _setting(2, "Edges around a new vertex over which its wavelet is made orthogonal", low=0, high=3)


@dataclass(frozen=True)
class FeaturePointSettings:
    """Settings of the feature-point method (Kshirsagar, Garchery and Magnenat-Thalmann 2003)."""

    motion: str = _setting(
        "free",
        "free: every common point moves along all three axes; faps: only what MPEG-4's parameters can say",
        choices=("free", "faps"),
    )
    variant: str = _setting(
        "default",
        "default: continuous weights, lids that shut; paper: the published weights",
        choices=("default", "paper"),
    )


@dataclass(frozen=True)
class MotionCloningSettings:
    """Settings of motion cloning (Pandzic 2001)."""

    motion: str = _setting(
        "local",
        "local: one scale for the heads, motion turns with the surface; regional: every region by its own size; "
        "compliant: that along the axes of the heads, as MPEG-4's parameters want it",
        choices=("local", "regional", "compliant"),
    )
    variant: str = _setting(
        "default",
        "default: places found on the surfaces, continuous units; paper: the published cylinder and regions",
        choices=("default", "paper"),
    )
    example_strength: float = _setting(1.0, "How far the examples steer the result", low=0.0, high=1.0)


Settings = HierarchicalSettings | WaveletSettings | FeaturePointSettings | MotionCloningSettings
"""Any method's settings."""

SETTINGS: dict[str, type[Settings]] = {
    "hierarchical": HierarchicalSettings,
    "feature_points": FeaturePointSettings,
    "motion_cloning": MotionCloningSettings,
    "wavelet": WaveletSettings,
}
"""Method name -> its settings class."""

LEVELED = tuple(name for name, settings in SETTINGS.items() if issubclass(settings, LevelSettings))
"""Methods whose motion is made of levels."""

STRENGTHS = ("base_gain", "level_gains", "detail_scale", "example_strength")
"""Settings that a fitted method can change without another fit; see `Retargeter.adjusted`."""

LEAST_POINTS = 30
"""Common feature points from which a base mesh can be made."""
FEWEST_POINTS = 8
"""Common feature points from which a method without a base mesh can work."""


def least_points(settings: type[Settings]) -> int:
    """Feature points that both faces must have in common for the method of these settings."""
    return LEAST_POINTS if issubclass(settings, LevelSettings) else FEWEST_POINTS


@dataclass(frozen=True)
class RegionGains:
    """How strong the motion is in each region of the target."""

    brows: float = _setting(1.0, "Strength of the motion of brows and forehead", low=0.0, high=4.0)
    eyes: float = _setting(1.0, "Strength of the motion of the lids; eyeballs look where they look", low=0.0, high=4.0)
    nose: float = _setting(1.0, "Strength of the motion of the nose", low=0.0, high=4.0)
    cheeks: float = _setting(1.0, "Strength of the motion of the cheeks", low=0.0, high=4.0)
    mouth: float = _setting(1.0, "Strength of the motion of the lips and around them", low=0.0, high=4.0)
    jaw: float = _setting(1.0, "Strength of the motion of chin, jaw, lower teeth and tongue", low=0.0, high=4.0)


@dataclass(frozen=True)
class MapSettings:
    """How normal maps are made and written."""

    level: int = _setting(0, "Level of the target's normal mesh that the maps are for; 0: its own mesh", low=0, high=6)
    pixels: int = _setting(1024, "Pixels along each side of a map", low=16, high=16384)
    margin: int = _setting(8, "Pixels that a map goes on past the borders of the UVs", low=0, high=256)
    depth: str = _setting(
        "png16", "What a picture file holds: 8 or 16 bits a channel, or floats", choices=("png8", "png16", "exr")
    )
    convention: str = _setting(
        "opengl", "Green points up, as OpenGL and Blender have it, or down as DirectX", choices=("opengl", "directx")
    )


CACHES = {"pc2": (".pc2",), "mdd": (".mdd",), "alembic": (".abc",), "usd": (".usdc", ".usd")}
"""Kind of a bake that becomes files -> their suffixes, the usual one first."""


@dataclass(frozen=True)
class WrinkleSettings(MapSettings):
    """How a wrinkle kit is made and written."""

    least: float = _setting(
        3.0, "Degrees: shape keys that turn no normal by so much get no map in a wrinkle kit", low=0.0, high=90.0
    )


@dataclass(frozen=True)
class BakeSettings:
    """What frames become."""

    kind: str = _setting(
        "frames",
        "frames: a shape key per frame; absolute: the same on one evaluation-time curve; compact: as few shape keys as "
        "the tolerance allows; rig: curves of the shape keys that are there; pc2, mdd, alembic, usd: a cache on disk",
        choices=("frames", "absolute", "compact", "rig", "pc2", "mdd", "alembic", "usd"),
    )
    tolerance: float = _setting(
        0.005, "How far a frame of a compact bake may be off, in distances between the eyes", low=0.0001, high=0.5
    )
    smoothness: float = _setting(
        0.05, "How much the curves of a rig are kept from bending from frame to frame", low=0.0, high=100.0
    )
    sparsity: float = _setting(
        0.005, "How much the curves of a rig are kept at zero where others do nearly as well", low=0.0, high=1.0
    )
    residual: int = _setting(
        0, "Frames that share one more shape key for what a rig's own cannot do; 0: no such keys", low=0, high=100000
    )


MASK_GAIN = fields(RegionGains)[0].metadata
"""Limits of the gain of a painted mask: those of the regions."""


def without_strengths(settings: Settings) -> Settings:
    """What a fit depends on: the settings with all strengths at their defaults."""
    kept = {f.name: getattr(settings, f.name) for f in fields(settings) if f.name not in STRENGTHS}
    return type(settings)(**kept)


def read_settings(method: str, values: dict[str, Any], where: str = "[settings]") -> Settings:
    """Settings of a method from plain values, every one checked.

    Raises
    ------
    RetargetError : for an unknown name, a wrong type, or a value out of range; it names them all.
    """
    return read_values(SETTINGS[method], values, where)


def read_values(cls: type[T], values: dict[str, Any], where: str) -> T:
    """One of the dataclasses of this module from plain values; as `read_settings`."""
    known = {f.name: f for f in fields(cls)}
    wrong: list[str] = []
    clean: dict[str, Any] = {}
    for name, value in values.items():
        if name not in known:
            wrong.append(f"{where} has no setting {name!r}; there are {', '.join(known)}")
            continue
        problem, clean[name] = _fit_value(known[name].default, known[name].metadata, value)
        if problem:
            wrong.append(f"{where} {name} = {value!r}: expected {problem}")
    if wrong:
        raise RetargetError("; ".join(wrong))
    return cls(**clean)


def _fit_value(default: Any, limits: Any, value: Any) -> tuple[str, Any]:
    """('', the value in its type), or (what was expected, None)."""
    if isinstance(default, tuple):
        if not isinstance(value, list | tuple):
            return f"a list of numbers from {limits['low']} to {limits['high']}", None
        parts = [_fit_value(1.0, limits, part) for part in value]
        return next((problem for problem, _ in parts if problem), ""), tuple(part for _, part in parts)
    if isinstance(default, str):
        return ("" if value in limits["choices"] else f"one of {', '.join(limits['choices'])}"), value
    kind = int if isinstance(default, int) else float
    expected = f"{'a whole number' if kind is int else 'a number'} from {limits['low']} to {limits['high']}"
    if isinstance(value, bool) or not isinstance(value, int if kind is int else (int, float)):
        return expected, None
    if not limits["low"] <= value <= limits["high"]:
        return expected, None
    return "", kind(value)
