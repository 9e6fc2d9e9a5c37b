"""Which feature points a face wants, in which order, and what an artist reads about each. Plain data: panels show it.

Left is the subject's left. Diagram places are in eye separations on the front view of a face, from the middle between
the eyes: x to the subject's left (the viewer's right), y up; all lie within `DIAGRAM_LOW` and `DIAGRAM_HIGH`.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from .mpeg4.fdps import FDPS

DIAGRAM_LOW, DIAGRAM_HIGH = (-1.45, -2.2), (1.45, 1.1)
"""Corners of the rectangle that holds all diagram places."""


@dataclass(frozen=True)
class PointInfo:
    """What an artist reads about a feature point.

    Attributes
    ----------
    name : MPEG-4 number or free name.
    label : what a person calls it, such as "Left Mouth Corner".
    meaning : where it lies, in words.
    partner : the point of the other half of the face, "" on the middle line.
    diagram : (x, y) on the front view of a face.
    """

    name: str
    label: str
    meaning: str
    partner: str
    diagram: tuple[float, float]


_MIDDLE: tuple[tuple[str, str, str, float, float], ...] = (
    ("9.3", "Nose Tip", "", 0.0, -0.53),
    ("2.1", "Chin Bottom", "", 0.0, -1.74),
    ("8.1", "Upper Lip", "", 0.0, -0.97),
    ("8.2", "Lower Lip", "", 0.0, -1.24),
    ("11.1", "Hairline", "", 0.0, 0.84),
    ("9.15", "Nose Base", "", 0.0, -0.735),
    ("2.2", "Upper Lip Inside", "", 0.0, -1.07),
    ("2.3", "Lower Lip Inside", "", 0.0, -1.13),
    ("2.10", "Chin Boss", "", 0.0, -1.56),
    ("9.12", "Nose Bridge", "", 0.0, -0.26),
    ("nose_bridge", "Nose Root", "deepest point between the eyes, in the middle", 0.0, 0.06),
    ("glabella", "Between the Brows", "middle of the bulge between the brows", 0.0, 0.28),
    ("forehead_mid", "Forehead", "middle of the forehead", 0.0, 0.56),
    ("philtrum", "Philtrum", "middle of the groove between nose and upper lip", 0.0, -0.845),
    ("chin_crease", "Chin Crease", "deepest point between lower lip and chin, in the middle", 0.0, -1.345),
    ("nose_ridge", "Nose Ridge", "ridge of the nose, between its root and its bone's lower end", 0.0, -0.11),
    ("nose_upper", "Above the Nose Tip", "ridge of the nose, a little above the tip", 0.0, -0.40),
    ("throat", "Throat", "where chin and neck meet, in the middle", 0.0, -2.05),
)
"""Name, label, meaning (an FDP has its own), diagram place of the points on the middle line."""

_PAIRED: tuple[tuple[str, str, str, str, float, float], ...] = (
    ("3.7", "3.12", "Outer Eye Corner", "", 0.76, -0.005),
    ("8.3", "8.4", "Mouth Corner", "", 0.43, -1.10),
    ("3.11", "3.8", "Inner Eye Corner", "", 0.29, -0.005),
    ("4.3", "4.4", "Brow Top", "", 0.63, 0.315),
    ("2.13", "2.14", "Jaw Angle", "", 1.20, -1.20),
    ("3.1", "3.2", "Upper Lid", "", 0.525, 0.095),
    ("3.3", "3.4", "Lower Lid", "", 0.525, -0.07),
    ("4.1", "4.2", "Inner Brow", "", 0.20, 0.22),
    ("4.5", "4.6", "Outer Brow", "", 0.90, 0.20),
    ("9.1", "9.2", "Nostril Wing", "", 0.285, -0.60),
    ("2.4", "2.5", "Mouth Corner Inside", "", 0.37, -1.10),
    ("8.10", "8.9", "Cupid's Bow", "", 0.085, -0.945),
    ("8.5", "8.6", "Upper Lip Side", "", 0.25, -1.0),
    ("8.7", "8.8", "Lower Lip Side", "", 0.25, -1.20),
    ("2.6", "2.7", "Upper Lip Inside", "", 0.19, -1.08),
    ("2.8", "2.9", "Lower Lip Inside", "", 0.19, -1.12),
    ("5.1", "5.2", "Cheek", "", 0.62, -0.62),
    ("5.3", "5.4", "Cheek Bone", "", 1.02, -0.50),
    ("11.3", "11.2", "Hairline", "", 0.90, 0.70),
    ("forehead_l", "forehead_r", "Forehead", "{side} half of the forehead, its middle", 0.50, 0.58),
    ("cheek_l_2", "cheek_r_2", "Outer Cheek", "{side} cheek, between its middle and the angle of the jaw", 0.86, -0.78),
    ("jaw_l_1", "jaw_r_1", "Jaw Muscle", "{side} cheek above the jaw, level with the mouth", 0.76, -1.14),
    ("upper_lid_l_1", "upper_lid_r_1", "Upper Lid Inner", "{side} upper lid's edge, toward the nose", 0.385, 0.06),
    ("upper_lid_l_2", "upper_lid_r_2", "Upper Lid Outer", "{side} upper lid's edge, toward the ear", 0.665, 0.06),
    ("lower_lid_l_1", "lower_lid_r_1", "Lower Lid Inner", "{side} lower lid's edge, toward the nose", 0.385, -0.047),
    ("lower_lid_l_2", "lower_lid_r_2", "Lower Lid Outer", "{side} lower lid's edge, toward the ear", 0.665, -0.047),
    ("lid_crease_l", "lid_crease_r", "Lid Crease", "{side} upper lid's fold below the brow, middle", 0.53, 0.165),
    ("under_eye_l_1", "under_eye_r_1", "Inner Under-Eye", "below the {side} lower lid, toward the nose", 0.38, -0.19),
    ("under_eye_l_2", "under_eye_r_2", "Outer Under-Eye", "below the {side} lower lid, toward the ear", 0.62, -0.22),
    ("brow_l_1", "brow_r_1", "Middle Brow", "{side} brow, between its inner end and its top", 0.41, 0.29),
    (
        "nose_side_l",
        "nose_side_r",
        "Nose Side",
        "{side} side of the nose, level with its bone's lower end",
        0.17,
        -0.22,
    ),
    ("nose_wing_l", "nose_wing_r", "Nose Wing", "upper edge of the {side} nostril's wing", 0.19, -0.49),
    ("nostril_l", "nostril_r", "Nostril", "lower edge of the {side} nostril", 0.20, -0.72),
    ("upper_lip_l", "upper_lip_r", "Above the Lip", "skin between the {side} nostril and the upper lip", 0.17, -0.86),
    ("fold_l", "fold_r", "Smile Line", "{side} fold from nose to mouth, halfway", 0.40, -0.81),
    ("fold_l_2", "fold_r_2", "Beside the Mouth", "fold beside the {side} corner of the mouth", 0.55, -1.12),
    ("cheek_l_1", "cheek_r_1", "Inner Cheek", "{side} cheek beside the nose", 0.40, -0.40),
    ("cheek_l_3", "cheek_r_3", "Upper Cheek", "{side} cheek below the eye's outer half", 0.70, -0.38),
    ("cheek_l_4", "cheek_r_4", "Lower Cheek", "{side} cheek between its middle and the jaw", 0.60, -0.92),
    (
        "cheek_l_5",
        "cheek_r_5",
        "Before the Ear",
        "{side} side of the face before the ear, level with the nose",
        1.24,
        -0.30,
    ),
    ("cheek_l_6", "cheek_r_6", "Below the Ear", "{side} side of the face, above the angle of the jaw", 1.26, -0.75),
    ("chin_l_2", "chin_r_2", "Upper Chin", "{side} of the chin's boss, below the lower lip", 0.25, -1.42),
    ("chin_l", "chin_r", "Chin", "{side} corner of the chin", 0.27, -1.64),
    ("jaw_l_4", "jaw_r_4", "Above the Jaw", "{side} jaw, beside the chin's boss", 0.52, -1.36),
    ("jaw_l_3", "jaw_r_3", "Front Jaw", "{side} edge of the jaw, beside the chin", 0.60, -1.62),
    ("jaw_l_2", "jaw_r_2", "Jaw", "{side} edge of the jaw, between its angle and the chin", 0.95, -1.45),
    ("temple_l_2", "temple_r_2", "Lower Temple", "beside the {side} eye's outer corner, toward the ear", 1.02, -0.02),
    ("temple_l", "temple_r", "Temple", "{side} temple, beside the brow's outer end", 1.08, 0.30),
    ("forehead_l_2", "forehead_r_2", "Above the Inner Brow", "forehead above the {side} brow's inner half", 0.27, 0.44),
    ("forehead_l_3", "forehead_r_3", "Above the Outer Brow", "forehead above the {side} brow's outer half", 0.74, 0.46),
    ("forehead_l_5", "forehead_r_5", "Inner Forehead", "{side} half of the forehead, near its middle", 0.25, 0.68),
    ("forehead_l_6", "forehead_r_6", "Outer Forehead", "{side} half of the forehead, toward the temple", 0.68, 0.74),
    ("forehead_l_4", "forehead_r_4", "Hairline Inner", "hairline between its middle and its {side} end", 0.42, 0.86),
)
"""Left name, right name, label, meaning (an FDP has its own), diagram place of the left one."""

FIRST_FIVE = ("3.7", "3.12", "9.3", "2.1", "8.3")
"""The points that predict the others best, the first of every set: see docs/placing.md."""

_MINIMAL = ("8.4", "3.11", "3.8", "8.1", "8.2", "4.3", "4.4", "2.13", "2.14", "11.1")
_FMC = (
    *("9.15", "3.1", "3.2", "3.3", "3.4", "2.2", "2.3", "2.4", "2.5", "9.1", "9.2"),
    *("4.1", "4.2", "4.5", "4.6", "2.10", "9.12", "8.10", "8.9", "8.5", "8.6", "8.7", "8.8"),
    *("2.6", "2.7", "2.8", "2.9", "5.1", "5.2", "5.3", "5.4", "11.3", "11.2"),
)


def _infos() -> dict[str, PointInfo]:
    infos = {
        name: PointInfo(name, label, meaning or FDPS[name].meaning, "", (x, y))
        for name, label, meaning, x, y in _MIDDLE
    }
    for left, right, label, meaning, x, y in _PAIRED:
        for name, partner, side, sign in ((left, right, "left", 1.0), (right, left, "right", -1.0)):
            words = meaning.format(side=side) if meaning else FDPS[name].meaning
            infos[name] = PointInfo(name, f"{side.title()} {label}", words, partner, (sign * x, y))
    return infos


POINT_INFOS: dict[str, PointInfo] = _infos()
"""Name -> what is known of each point of the sets."""


def _set(*names: str) -> tuple[PointInfo, ...]:
    return tuple(POINT_INFOS[name] for name in dict.fromkeys((*FIRST_FIVE, *names)))


POINT_SETS: dict[str, tuple[PointInfo, ...]] = {
    "MINIMAL": _set(*_MINIMAL),
    "FMC": _set(*_MINIMAL, *_FMC),
    "DENSE": _set(*_MINIMAL, *_FMC, *POINT_INFOS),
}
"""Set -> its points, in the order in which an artist places them: the least that makes sense; the MPEG-4 points of the
skin that motion cloning aligns by; as many as the hierarchical method's base mesh wants. Each holds the one before.
"""


def next_point(set_name: str, placed: Collection[str], skipped: Collection[str]) -> str | None:
    """The name of the point whose turn it is: the first of the set that is neither placed nor skipped."""
    done = {*placed, *skipped}
    return next((info.name for info in POINT_SETS[set_name] if info.name not in done), None)


def point_label(name: str) -> str:
    """What an artist reads for a name: its label, an MPEG-4 point's meaning, or the name itself."""
    if name in POINT_INFOS:
        return POINT_INFOS[name].label
    return FDPS[name].meaning.capitalize() if name in FDPS else name


def point_meaning(name: str) -> str:
    """Where the point of a name lies, "" for names of one's own."""
    if name in POINT_INFOS:
        return POINT_INFOS[name].meaning
    return FDPS[name].meaning if name in FDPS else ""


def partner_of(name: str) -> str:
    """The point of the other half of the face, "" for points of the middle line and names of one's own."""
    if name in POINT_INFOS:
        return POINT_INFOS[name].partner
    return FDPS[name].partner if name in FDPS and FDPS[name].partner != name else ""


def side_of(name: str) -> str:
    """The half of the face, "left" or "right", that a point with a partner lies on; "" for all others."""
    if not partner_of(name):
        return ""
    if name in POINT_INFOS:
        return "left" if POINT_INFOS[name].diagram[0] > 0 else "right"
    return "left" if "left" in FDPS[name].meaning else "right"
