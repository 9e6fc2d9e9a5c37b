"""Where the feature points lie on the chart: MPEG-4 names where one exists, free names otherwise."""

from __future__ import annotations

import numpy as np

from .chart import LEFT_EYE, MOUTH

_EYE_INNER, _EYE_OUTER = (
    (float(LEFT_EYE.x - LEFT_EYE.half_width), LEFT_EYE.y),
    (float(LEFT_EYE.x + LEFT_EYE.half_width), LEFT_EYE.y),
)


def _rim(u: float, upper: bool, eye: bool) -> tuple[float, float]:
    x, y = (LEFT_EYE if eye else MOUTH).arc(np.array([u]), upper)[0]
    return float(x), float(y)


_MIDDLE: dict[str, tuple[float, float]] = {
    "2.1": (0.0, -1.74),
    "2.10": (0.0, -1.56),
    "2.2": _rim(0.0, True, False),
    "2.3": _rim(0.0, False, False),
    "8.1": (0.0, -0.955),
    "8.2": (0.0, -1.235),
    "9.3": (0.0, -0.53),
    "9.15": (0.0, -0.735),
    "9.12": (0.0, -0.26),
    "nose_bridge": (0.0, 0.06),
    "glabella": (0.0, 0.28),
    "forehead_mid": (0.0, 0.56),
    "11.1": (0.0, 0.84),
    "philtrum": (0.0, -0.845),
    "chin_crease": (0.0, -1.345),
    "throat": (0.0, -2.05),
    "nose_ridge": (0.0, -0.11),
    "nose_upper": (0.0, -0.40),
}

_PAIRED: dict[tuple[str, str], tuple[float, float]] = {
    ("2.4", "2.5"): (MOUTH.half_width, MOUTH.y),
    ("2.6", "2.7"): _rim(0.45, True, False),
    ("2.8", "2.9"): _rim(0.45, False, False),
    ("2.13", "2.14"): (1.20, -1.20),
    ("3.1", "3.2"): _rim(0.0, True, True),
    ("3.3", "3.4"): _rim(0.0, False, True),
    ("3.7", "3.12"): _EYE_OUTER,
    ("3.11", "3.8"): _EYE_INNER,
    ("4.1", "4.2"): (0.20, 0.22),
    ("4.3", "4.4"): (0.63, 0.315),
    ("4.5", "4.6"): (0.90, 0.20),
    ("5.1", "5.2"): (0.62, -0.62),
    ("5.3", "5.4"): (1.02, -0.50),
    ("8.3", "8.4"): (MOUTH.half_width + 0.045, MOUTH.y),
    ("8.5", "8.6"): (0.25, -0.995),
    ("8.7", "8.8"): (0.25, -1.190),
    ("8.10", "8.9"): (0.085, -0.935),
    ("9.1", "9.2"): (0.285, -0.60),
    ("11.3", "11.2"): (0.90, 0.70),
    ("forehead_l", "forehead_r"): (0.50, 0.58),
    ("cheek_l_2", "cheek_r_2"): (0.86, -0.78),
    ("jaw_l_1", "jaw_r_1"): (0.76, -1.14),
    ("upper_lid_l_1", "upper_lid_r_1"): _rim(-0.6, True, True),
    ("upper_lid_l_2", "upper_lid_r_2"): _rim(0.6, True, True),
    ("lower_lid_l_1", "lower_lid_r_1"): _rim(-0.6, False, True),
    ("lower_lid_l_2", "lower_lid_r_2"): _rim(0.6, False, True),
    ("lid_crease_l", "lid_crease_r"): (0.53, 0.16),
    ("under_eye_l_1", "under_eye_r_1"): (0.38, -0.19),
    ("under_eye_l_2", "under_eye_r_2"): (0.62, -0.22),
    ("nose_side_l", "nose_side_r"): (0.17, -0.22),
    ("nose_wing_l", "nose_wing_r"): (0.19, -0.49),
    ("nostril_l", "nostril_r"): (0.20, -0.72),
    ("brow_l_1", "brow_r_1"): (0.41, 0.29),
    ("temple_l", "temple_r"): (1.08, 0.30),
    ("temple_l_2", "temple_r_2"): (1.02, -0.02),
    ("forehead_l_2", "forehead_r_2"): (0.27, 0.44),
    ("forehead_l_3", "forehead_r_3"): (0.74, 0.46),
    ("forehead_l_4", "forehead_r_4"): (0.42, 0.86),
    ("forehead_l_5", "forehead_r_5"): (0.25, 0.68),
    ("forehead_l_6", "forehead_r_6"): (0.68, 0.74),
    ("cheek_l_1", "cheek_r_1"): (0.40, -0.40),
    ("cheek_l_3", "cheek_r_3"): (0.70, -0.38),
    ("cheek_l_4", "cheek_r_4"): (0.60, -0.92),
    ("cheek_l_5", "cheek_r_5"): (1.24, -0.30),
    ("cheek_l_6", "cheek_r_6"): (1.26, -0.75),
    ("fold_l", "fold_r"): (0.40, -0.81),
    ("fold_l_2", "fold_r_2"): (0.55, -1.12),
    ("jaw_l_2", "jaw_r_2"): (0.95, -1.45),
    ("jaw_l_3", "jaw_r_3"): (0.60, -1.62),
    ("jaw_l_4", "jaw_r_4"): (0.52, -1.36),
    ("chin_l", "chin_r"): (0.27, -1.64),
    ("chin_l_2", "chin_r_2"): (0.25, -1.42),
    ("upper_lip_l", "upper_lip_r"): (0.17, -0.86),
}

POINTS: dict[str, tuple[float, float]] = {
    **_MIDDLE,
    **{name: place for (name, _), place in _PAIRED.items()},
    **{name: (-place[0], place[1]) for (_, name), place in _PAIRED.items()},
}
"""Name -> chart place. In a pair the first name lies on the face's left (+x)."""
