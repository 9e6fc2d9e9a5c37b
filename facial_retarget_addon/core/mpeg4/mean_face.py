"""Where feature points lie on an average face: to place what a face or a set of markers lacks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray
from ..errors import RetargetError
from ..rigid import fit_similarity

LEAST = 4
"""Known points from which others can be placed."""

MEAN_FACE: dict[str, tuple[float, float, float]] = {
    "2.1": (0.00, -1.80, 0.18),
    "2.2": (0.00, -1.11, 0.34),
    "2.3": (0.00, -1.12, 0.34),
    "2.4": (0.36, -1.12, 0.18),
    "2.5": (-0.36, -1.12, 0.18),
    "2.6": (0.17, -1.10, 0.29),
    "2.7": (-0.17, -1.10, 0.29),
    "2.8": (0.18, -1.10, 0.30),
    "2.9": (-0.18, -1.10, 0.30),
    "2.10": (0.00, -1.62, 0.29),
    "2.13": (0.90, -1.25, -0.53),
    "2.14": (-0.90, -1.25, -0.53),
    "3.1": (0.54, 0.08, 0.05),
    "3.2": (-0.54, 0.08, 0.05),
    "3.3": (0.53, -0.08, 0.04),
    "3.4": (-0.53, -0.08, 0.04),
    "3.5": (0.50, 0.00, 0.03),
    "3.6": (-0.50, 0.00, 0.03),
    "3.7": (0.73, 0.02, -0.04),
    "3.8": (-0.27, -0.02, 0.04),
    "3.11": (0.27, -0.02, 0.04),
    "3.12": (-0.73, 0.02, -0.04),
    "4.1": (0.21, 0.16, 0.22),
    "4.2": (-0.21, 0.16, 0.22),
    "4.3": (0.69, 0.34, 0.10),
    "4.4": (-0.69, 0.34, 0.10),
    "4.5": (0.88, 0.18, -0.09),
    "4.6": (-0.88, 0.18, -0.09),
    "5.1": (0.63, -0.68, 0.08),
    "5.2": (-0.63, -0.68, 0.08),
    "5.3": (1.00, -0.49, -0.32),
    "5.4": (-1.00, -0.49, -0.32),
    "7.1": (0.00, -0.90, -1.35),
    "8.1": (0.00, -1.01, 0.42),
    "8.2": (0.00, -1.26, 0.37),
    "8.3": (0.39, -1.12, 0.16),
    "8.4": (-0.39, -1.12, 0.16),
    "8.5": (0.30, -1.06, 0.28),
    "8.6": (-0.30, -1.06, 0.28),
    "8.7": (0.30, -1.18, 0.24),
    "8.8": (-0.30, -1.18, 0.24),
    "8.9": (-0.12, -0.99, 0.41),
    "8.10": (0.12, -0.99, 0.41),
    "9.1": (0.33, -0.61, 0.18),
    "9.2": (-0.33, -0.61, 0.18),
    "9.3": (0.00, -0.56, 0.62),
    "9.12": (0.00, -0.30, 0.47),
    "9.15": (0.00, -0.76, 0.43),
    "11.1": (0.00, 0.86, 0.19),
    "11.2": (-0.82, 0.72, -0.16),
    "11.3": (0.82, 0.72, -0.16),
}
"""FDP -> place in eye separations from the middle between the eyes; axes left, up, forward.

The mean of four heads by different artists, measured by us and made symmetric; 7.1 and the pupils by judgement.
"""


def place_missing(names: Sequence[str], positions: FloatArray, wanted: Sequence[str]) -> dict[str, FloatArray]:
    """Positions (3,) of the wanted points: the given ones, and for the others the average face's, fitted on them.

    Parameters
    ----------
    names : (P,) of the points that are there.
    positions : (P, 3) in any axes and units.
    wanted : FDPs of the average face.

    Raises
    ------
    RetargetError : if points are missing and fewer than four known ones are there to place them; says which.
    """
    here = {name: np.asarray(position, np.float64) for name, position in zip(names, positions, strict=True)}
    missing = [name for name in wanted if name not in here]
    if missing:
        known = [name for name in here if name in MEAN_FACE]
        if len(known) < LEAST:
            raise RetargetError(
                f"MPEG-4 points {', '.join(missing)} are missing, and {len(known)} others are too few to place them; "
                f"expected these points, or at least {LEAST} of {', '.join(MEAN_FACE)}"
            )
        fit = fit_similarity(np.array([MEAN_FACE[name] for name in known]), np.array([here[name] for name in known]))
        here |= {name: fit.apply(np.array(MEAN_FACE[name])) for name in missing}
    return {name: here[name] for name in wanted}
