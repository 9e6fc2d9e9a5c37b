"""Subdivision wavelets: filter identities, inner products, orthogonality, reconstruction."""

import numpy as np
import pytest
import scipy.sparse as sp

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.levels.butterfly import butterfly
from facial_retarget_addon.core.levels.subdivision import Level, hierarchy, loop
from facial_retarget_addon.core.wavelets.inner_products import REGULAR, inner_products
from facial_retarget_addon.core.wavelets.lifting import Lift, Wavelets, integral_wavelets, wavelets

from .test_curvature import surface
from .test_subdivision import grid, papers_counts

# fmt: off
ICOSAHEDRON = np.array([
    [0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6],
    [7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7],
    [9, 8, 1],
])
# fmt: on


def icosahedron_once() -> tuple[np.ndarray, int]:
    step = butterfly(ICOSAHEDRON, 12)
    return step.faces, step.vertex_count


MESHES = {"closed": icosahedron_once(), "open": (grid(9, 9), 81)}


def made(kind: str, faces: np.ndarray, count: int, steps: list[Level]) -> Wavelets:
    if kind == "integral":
        return integral_wavelets(faces, count, steps)
    return wavelets(faces, count, steps, int(kind))


@pytest.mark.parametrize("kind", ["0", "1", "2", "3", "integral"])
def test_filters_are_inverse_to_each_other(kind: str) -> None:
    faces, count = papers_counts()
    steps = hierarchy(faces, count, 2, butterfly)
    for lift in made(kind, faces, count, steps).lifts:
        a, b, p, q = lift.filters
        coarse, new, fine = p.shape[1], q.shape[1], p.shape[0]
        for product, wanted in (
            (p @ a + q @ b, sp.eye(fine)),
            (a @ p, sp.eye(coarse)),
            (b @ q, sp.eye(new)),
            (b @ p, sp.csr_matrix((new, coarse))),
            (a @ q, sp.csr_matrix((coarse, new))),
        ):
            assert abs(product - wanted).max() < 1e-12


def test_lifting_does_what_the_filters_say(rng: np.random.Generator) -> None:
    faces, count = papers_counts()
    lift = wavelets(faces, count, hierarchy(faces, count, 1, butterfly)).lifts[0]
    a, b, p, q = lift.filters
    fine = rng.normal(size=(a.shape[1], 3))
    coarse, coefficients = lift.analyse(fine)
    np.testing.assert_allclose(coarse, a @ fine, atol=1e-13)
    np.testing.assert_allclose(coefficients, b @ fine, atol=1e-13)
    np.testing.assert_allclose(lift.synthesise(coarse, coefficients), p @ coarse + q @ coefficients, atol=1e-13)


def test_any_number_of_levels_is_reconstructed(rng: np.random.Generator) -> None:
    faces, count = papers_counts()
    for levels in (1, 3):
        steps = hierarchy(faces, count, levels, butterfly)
        bank = wavelets(faces, count, steps)
        fine = rng.normal(size=(steps[-1].vertex_count, 6))
        parts = bank.analyse(fine)
        assert [len(part) for part in parts] == [count, *(len(step.parents) for step in steps)]
        np.testing.assert_allclose(bank.synthesise(parts), fine, atol=1e-12)


def test_what_subdivision_makes_has_no_coefficients(rng: np.random.Generator) -> None:
    faces, count = papers_counts()
    steps = hierarchy(faces, count, 2, butterfly)
    base = rng.normal(size=(count, 3))
    found = wavelets(faces, count, steps).analyse(steps[1].matrix @ (steps[0].matrix @ base))
    np.testing.assert_allclose(found[0], base, atol=1e-13)
    assert max(np.abs(part).max() for part in found[1:]) < 1e-13


def test_the_lattices_inner_products_obey_the_two_scale_relation() -> None:
    """I_j = P^T I_(j+1) P with the table on both sides: a coarse function's integral is 4 fine ones."""
    faces = grid(21, 21)
    pulled = inner_products(faces, 441, hierarchy(faces, 441, 1, butterfly))[0] / 4
    direct = inner_products(faces, 441, [])[0]
    middle = 10 * 21 + 10
    for offset, entry in ((0, (0, 1)), (1, (1, 1)), (2, (2, 1)), (23, (2, 2)), (3, (3, 1)), (24, (3, 3)), (46, (4, 6))):
        assert pulled[middle, middle + offset] == pytest.approx(REGULAR[entry], abs=1e-12)
        assert direct[middle, middle + offset] == REGULAR[entry]
    assert pulled[middle].sum() == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize(("mesh", "condition"), [("closed", 4), ("open", 12)])
def test_inner_products_are_well_conditioned(mesh: str, condition: float) -> None:
    faces, count = MESHES[mesh]
    gram = inner_products(faces, count, [])[0].toarray()
    np.testing.assert_allclose(gram, gram.T, atol=1e-15)
    assert np.linalg.cond(gram) < condition


# fmt: off
TABLE = [
    ("closed", "0", 0.105, 0.033), ("closed", "1", 0.070, 0.016), ("closed", "2", 0.017, 0.005),
    ("closed", "3", 0.009, 0.002), ("closed", "integral", 0.166, 0.039),
    ("open", "0", 0.238, 0.025), ("open", "1", 0.105, 0.012), ("open", "2", 0.036, 0.005), ("open", "3", 0.016, 0.002),
    ("open", "integral", 0.213, 0.029),
]
# fmt: on


@pytest.mark.parametrize(("mesh", "kind", "worst", "mean"), TABLE)
def test_wavelets_are_nearly_orthogonal_to_scaling_functions(mesh: str, kind: str, worst: float, mean: float) -> None:
    """Largest and root mean square cosine between the two, as measured independently to three digits."""
    faces, count = MESHES[mesh]
    steps = hierarchy(faces, count, 1, butterfly)
    cosines = _cosines(made(kind, faces, count, steps).lifts[0], *inner_products(faces, count, steps))
    assert np.abs(cosines).max() == pytest.approx(worst, abs=1.5e-3)
    assert np.sqrt(np.square(cosines).mean()) == pytest.approx(mean, abs=1e-3)


def _cosines(lift: Lift, coarse: sp.csr_matrix, fine: sp.csr_matrix) -> np.ndarray:
    p, q = lift.filters.p, lift.filters.q
    scaling = np.sqrt(coarse.diagonal())
    wavelet = np.sqrt((q.T @ fine @ q).diagonal())
    return (p.T @ fine @ q).toarray() / scaling[:, None] / wavelet


def test_integral_wavelets_have_no_integral() -> None:
    faces, count = MESHES["open"]
    steps = hierarchy(faces, count, 1, butterfly)
    integrals = np.asarray(inner_products(faces, count, steps)[1].sum(axis=0)).ravel()
    q = integral_wavelets(faces, count, steps).lifts[0].filters.q
    assert np.abs(integrals @ q).max() < 1e-13


def test_a_scheme_that_moves_old_vertices_is_refused() -> None:
    faces, count = papers_counts()
    with pytest.raises(RetargetError, match="keeps them for wavelets"):
        wavelets(faces, count, hierarchy(faces, count, 1, loop))


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(4)


def test_a_mesh_that_is_regular_everywhere_needs_no_finer_levels() -> None:
    torus, _ = surface(16, 16)
    gram = inner_products(torus.faces, 256, [])[0]
    np.testing.assert_allclose(gram.sum(axis=1), 1, atol=1e-12)
    assert gram[0, 0] == REGULAR[0, 1]
