"""Motion in levels: what the base mesh carries, what each level adds, and what is finer still."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import scipy.sparse as sp

from ..arrays import FloatArray
from .subdivision import Level


class Strengths(NamedTuple):
    """Strengths of the base and of each level, and of what is finer than the last one."""

    gains: tuple[float, ...]
    detail: float

    @property
    def plain(self) -> bool:
        """Whether all of them are 1."""
        return self.detail == 1.0 and all(gain == 1.0 for gain in self.gains)

    @property
    def whole(self) -> Strengths:
        """All of them 1."""
        return Strengths((1.0,) * len(self.gains), 1.0)

    def up_to(self, count: int) -> Strengths:
        """The same for the base and the levels below `count`, 0 for the rest."""
        return Strengths(self.gains[:count] + (0.0,) * (len(self.gains) - count), 0.0)


def scale_levels(
    carry: sp.csr_matrix,
    fine: sp.csr_matrix,
    ride: sp.csr_matrix,
    inside: FloatArray,
    steps: Sequence[Level],
    gains: Sequence[float],
    detail: float,
) -> sp.csr_matrix:
    """A carry matrix whose levels of motion have their own strengths.

    The detail is what the artist's vertices move beyond the finest level. All of it is linear in the
    source's motion, so it stays one matrix.

    Parameters
    ----------
    carry : (V, S) source displacements to displacements of the target's vertices.
    fine : (N, S) to displacements of the finest level's vertices.
    ride : (V, N) finest level to the target's vertices.
    inside : (V,) 1 on the base, 0 away from it, where all motion counts as base motion.
    steps, gains : as for `scale_fine`.
    detail : strength of what is finer than the last level.

    Returns
    -------
    (V, S). With all strengths 1 this is `carry` again.
    """
    on_base = ride @ scale_fine(fine, steps, gains) + detail * (carry - ride @ fine)
    return (sp.diags(inside) @ on_base + sp.diags(gains[0] * (1 - inside)) @ carry).tocsr()


def scale_fine(fine: sp.csr_matrix, steps: Sequence[Level], gains: Sequence[float]) -> sp.csr_matrix:
    """Motion of the finest level, (N, S) as `fine`, whose levels have their own strengths.

    Level j adds what its vertices move beyond the subdivision of level j - 1: offsets as vectors, Na
    and Jung 2004, equation 7, without the restriction to the normal.

    Parameters
    ----------
    fine : (N, S) source displacements to displacements of the finest level's vertices.
    steps : subdivision steps; vertex i of a level is vertex i of all finer ones.
    gains : strengths of the base and of each level, len(steps) + 1 of them.
    """
    size = steps[0].matrix.shape[1]
    scaled = gains[0] * fine[:size]
    for step, gain in zip(steps, gains[1:], strict=True):
        band = fine[: step.vertex_count] - step.matrix @ fine[:size]
        scaled = step.matrix @ scaled + gain * band
        size = step.vertex_count
    return scaled.tocsr()
