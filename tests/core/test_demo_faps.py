"""The built-in take of FAPs: every expression and the word's visemes are reached in full, neutral at both ends."""

import numpy as np

from facial_retarget_addon.core.mpeg4.conversions import low_level, recipe_matrix
from facial_retarget_addon.core.mpeg4.expressions import EXPRESSIONS
from facial_retarget_addon.core.mpeg4.visemes import VISEMES
from facial_retarget_addon.demo.fap_take import SPOKEN, fap_take

LIDS = [18, 19]


def test_every_expression_and_viseme_is_reached_in_full():
    values = low_level(fap_take())
    values[:, LIDS] = 0
    wanted = [expression.recipe for expression in EXPRESSIONS.values()] + [VISEMES[name].recipe for name in SPOKEN]
    for recipe in recipe_matrix(wanted):
        recipe[LIDS] = 0
        assert np.abs(values - recipe).max(axis=1).min() < 1e-9


def test_it_is_neutral_at_both_ends_and_blinks():
    values = low_level(fap_take())
    assert not values[0].any()
    assert np.abs(values[-1]).max() < 0.02 * np.abs(values).max()
    assert np.abs(np.diff(values[:, LIDS], axis=0)).max() > 500
    assert len(values) / fap_take().fps < 8
