"""What the list of examples says: sculpted, empty or missing, and one sentence where something is wrong."""

import numpy as np

from facial_retarget_addon.core.example_states import (
    EMPTY,
    MISSING,
    SCULPTED,
    ExampleState,
    ShownExamples,
    example_states,
    same_shapes,
)

STILL, UP, DOWN = np.zeros((4, 3)), np.full((4, 3), 0.1), np.full((4, 3), -0.1)


def states(source: dict, target: dict) -> dict[str, ExampleState]:
    return example_states(list(source), ShownExamples("Ann", 1.0, source), ShownExamples("Bob", 1.0, target))


def test_a_finished_and_an_unbegun_example():
    found = states({"joy": UP, "fear": STILL}, {"joy": DOWN, "fear": STILL + 1e-8})
    assert found == {"joy": (SCULPTED, SCULPTED, ""), "fear": (EMPTY, EMPTY, "")}


def test_one_side_alone():
    found = states({"joy": UP, "fear": STILL}, {"joy": STILL, "fear": DOWN})
    assert found["joy"][:2] == (SCULPTED, EMPTY)
    assert "on Ann alone" in found["joy"].warning
    assert "on Bob too" in found["joy"].warning
    assert "on Bob alone" in found["fear"].warning


def test_missing_keys():
    found = states({"joy": UP, "fear": None}, {"joy": None, "fear": None})
    assert found["joy"][:2] == (SCULPTED, MISSING)
    assert found["joy"].warning.startswith("No shape key joy on Bob:")
    assert found["fear"].warning.startswith("No shape key fear on Ann and Bob:")


def test_identical_examples_name_each_other_and_their_face():
    found = states({"joy": UP, "fear": DOWN, "anger": UP + 1e-9}, {"joy": UP, "fear": DOWN, "anger": DOWN / 2})
    assert "same as anger on Ann" in found["joy"].warning
    assert "same as joy on Ann" in found["anger"].warning
    assert found["fear"].warning == ""


def test_a_tolerance_parts_shapes_and_the_size_gives_it():
    assert same_shapes({"a": UP, "b": UP + 0.01}, 0.02) == [("a", "b")]
    assert same_shapes({"a": UP, "b": UP + 0.01}, 0.005) == []
    assert same_shapes({"a": UP, "b": -UP}, 0.005) == []
    bent = UP.copy()
    bent[0, 0] = -0.1
    assert same_shapes({"a": UP, "b": bent}, 0.005) == []


def test_nan_counts_as_sculpted():
    torn = STILL.copy()
    torn[1] = np.nan
    assert states({"joy": torn}, {"joy": UP})["joy"][:2] == (SCULPTED, SCULPTED)
