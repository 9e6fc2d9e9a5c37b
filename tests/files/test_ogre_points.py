"""Our own points on the one-eyed ogre of the shared data: they lie where their names say."""

from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.files.points import read_points

FILE = Path(__file__).parent.parent / "data" / "ogre_points.json"


@pytest.fixture(scope="module")
def ogre(shared_data):
    with np.load(shared_data / "ogre.npz") as data:
        return TriMesh(data["vertices"], data["tris"])


@pytest.fixture(scope="module")
def places(ogre):
    points = read_points(FILE, ogre)
    return dict(zip(points.names, points.positions(ogre.vertices), strict=True))


def test_the_middle_runs_down_the_face(ogre, places):
    middle = ["11.1", "forehead_mid", "glabella", "eye_upper", "eye_lower", "nose_bridge", "9.12", "9.3", "9.15"]
    middle += ["philtrum", "8.1", "2.2", "2.3", "8.2", "chin_crease", "2.10", "2.1"]
    heights = [places[name][1] for name in middle]
    assert heights == sorted(heights, reverse=True)
    assert np.abs([places[name][0] for name in middle]).max() < 0.01 * ogre.size
    assert places["9.3"][2] > ogre.vertices[:, 2].max() - 0.03 * ogre.size


def test_sides_mirror_each_other(ogre, places):
    pairs = [("2.4", "2.5"), ("2.6", "2.7"), ("2.8", "2.9"), ("2.13", "2.14"), ("4.1", "4.2"), ("4.3", "4.4")]
    pairs += [("4.5", "4.6"), ("5.1", "5.2"), ("5.3", "5.4"), ("8.3", "8.4"), ("8.5", "8.6"), ("8.7", "8.8")]
    pairs += [("8.10", "8.9"), ("9.1", "9.2"), ("11.3", "11.2")]
    pairs += [(name, name.replace("_l", "_r")) for name in places if name.endswith("_l") or "_l_" in name]
    for left, right in pairs:
        assert places[left][0] > 0.02 * ogre.size
        np.testing.assert_allclose(places[left] * [-1, 1, 1], places[right], atol=0.015 * ogre.size)
    named_in_pairs = {name for pair in pairs for name in pair}
    assert len(named_in_pairs) + 17 == len(places)


def test_the_lips_open_between_the_corners(places):
    assert places["8.3"][0] > places["2.4"][0] > places["2.6"][0] > places["8.10"][0] > 0
    assert places["2.6"][1] > places["2.4"][1] > places["2.8"][1]
