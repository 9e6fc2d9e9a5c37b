"""Curves on disk: what other programs read is what the keys do."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.mpeg4.arkit import ARKIT_NAMES
from facial_retarget_addon.files.curves import Curves, write_curves
from facial_retarget_addon.files.motion.arkit_csv import read_arkit_csv

NAMES = ("jaw", 'the "smile", left', "frown;ä", "line\nbreak")


def some_curves(count: int = 5, frames: range | list[float] = range(3, 13, 2)) -> Curves:
    values = np.random.default_rng(1).normal(size=(count, len(NAMES))).astype(np.float32)
    return Curves(NAMES, frames, values, 25.0)


def test_a_table_has_a_column_for_each_key_and_reads_back_exactly(tmp_path):
    curves = some_curves()
    write_curves(curves, tmp_path / "curves.csv")
    with open(tmp_path / "curves.csv", encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    assert head == ["frame", "time", *NAMES]
    assert [row[0] for row in rows] == ["3", "5", "7", "9", "11"]
    np.testing.assert_allclose([float(row[1]) for row in rows], np.arange(5) * 2 / 25)
    np.testing.assert_array_equal(np.array([row[2:] for row in rows]).astype(np.float32), curves.values)


def test_a_document_says_what_it_is_and_reads_back_exactly(tmp_path):
    curves = some_curves(frames=[1.0, 1.5, 2.0, 2.5, 3.0])
    write_curves(curves, tmp_path / "curves.json")
    document = json.loads((tmp_path / "curves.json").read_text(encoding="utf-8"))
    assert (document["format"], document["version"], document["fps"]) == ("facial-retarget/curves", 1, 25.0)
    assert document["frames"] == [1, 1.5, 2, 2.5, 3]
    assert tuple(document["curves"]) == NAMES
    values = np.array(list(document["curves"].values())).astype(np.float32)
    np.testing.assert_array_equal(values, curves.values.T)


def test_no_keys_and_one_frame_are_files_too(tmp_path):
    for suffix in (".csv", ".json"):
        write_curves(Curves((), range(1, 2), np.empty((1, 0), np.float32), 24.0), tmp_path / f"none{suffix}")
    assert (tmp_path / "none.csv").read_text() == "frame,time\n1,0\n"
    assert json.loads((tmp_path / "none.json").read_text())["curves"] == {}


def test_a_table_of_arkits_names_is_motion_that_can_be_imported(tmp_path):
    values = np.random.default_rng(2).uniform(size=(9, 52)).astype(np.float32)
    write_curves(Curves(tuple(ARKIT_NAMES), range(11, 20), values, 30.0), tmp_path / "take.csv")
    take = read_arkit_csv(tmp_path / "take.csv")
    assert take.fps == 30.0
    np.testing.assert_array_equal(take.weights.astype(np.float32), values)


@pytest.mark.parametrize("name", ["curves.txt", "curves"])
def test_another_kind_of_file_is_refused(tmp_path, name):
    with pytest.raises(RetargetError, match=r"expected \.csv or \.json"):
        write_curves(some_curves(), tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_a_value_that_is_not_finite_is_refused_and_an_earlier_file_stays(tmp_path: Path):
    (tmp_path / "curves.csv").write_text("earlier")
    curves = some_curves()
    curves.values[2, 1] = np.nan
    with pytest.raises(RetargetError, match=r"shape key 'the \"smile\", left' has the value nan at frame 7"):
        write_curves(curves, tmp_path / "curves.csv")
    assert [path.read_text() for path in tmp_path.iterdir()] == ["earlier"]
