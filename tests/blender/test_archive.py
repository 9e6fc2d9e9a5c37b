"""The zip holds what ships, and nothing else."""

import tomllib
import zipfile
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def shipped(archive: Path) -> list[str]:
    with zipfile.ZipFile(archive) as content:
        return content.namelist()


def test_one_wheel_of_scipy_and_embree_for_each_python_and_one_of_c3d(shipped: list[str]) -> None:
    wheels = [name.rpartition("/")[2].split("-") for name in shipped if name.startswith("wheels/")]
    assert sorted((parts[0], parts[2]) for parts in wheels) == [
        ("c3d", "py3"),
        *((package, python) for package in ("embreex", "scipy") for python in ("cp311", "cp313", "cp314")),
    ]


def test_nothing_but_the_extension(shipped: list[str]) -> None:
    assert {name.partition("/")[0] for name in shipped} == {
        "LICENSE",
        "__init__.py",
        "blender_manifest.toml",
        "facial_retarget_addon",
        "manual",
        "operators",
        "panels",
        "wheels",
    }
    assert not [name for name in shipped if name.endswith((".pyc", "/cli.py", "/terminal.py"))]


def test_manifest_lists_the_wheels_and_keeps_the_version(archive: Path, shipped: list[str]) -> None:
    with zipfile.ZipFile(archive) as content:
        manifest = tomllib.loads(content.read("blender_manifest.toml").decode())
    own = tomllib.loads((REPOSITORY / "blender_manifest.toml").read_text("utf-8"))
    assert sorted(manifest["wheels"]) == sorted(f"./{name}" for name in shipped if name.startswith("wheels/"))
    assert len(manifest["platforms"]) == 1
    assert {key: manifest[key] for key in own if key != "platforms"} == {
        key: value for key, value in own.items() if key != "platforms"
    }
