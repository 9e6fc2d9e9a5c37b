"""Job files: round trips, and every fault named at once."""

from __future__ import annotations

import json
import math
from dataclasses import fields, replace
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.core.methods.settings import (
    SETTINGS,
    BakeSettings,
    HierarchicalSettings,
    MapSettings,
    RegionGains,
)
from facial_retarget_addon.files.bake_output import NUMBERS, BakeOutput
from facial_retarget_addon.files.frame_range import FrameRange
from facial_retarget_addon.files.job import (
    ExampleFiles,
    FaceFiles,
    Job,
    MapOutput,
    MaskFile,
    OutputFiles,
    read_job,
    write_job,
)

MINIMAL = """
version = 1
method = "hierarchical"
[source]
neutral = "source.obj"
frames = "../takes/frames.npz"
points = "source_points.json"
[target]
neutral = "target.obj"
[output]
frames = "out.npz"
"""


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "job.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_paths_are_relative_to_the_job_file_and_what_is_not_said_has_its_default(tmp_path):
    job = read_job(written(tmp_path, MINIMAL))
    assert job.source == FaceFiles(
        tmp_path / "source.obj", tmp_path / "source_points.json", tmp_path / "../takes/frames.npz"
    )
    assert job.target == FaceFiles(tmp_path / "target.obj")
    assert job.output == OutputFiles(tmp_path / "out.npz")
    assert job.settings == HierarchicalSettings()
    assert (job.examples, job.base) == ((), None)


def test_a_written_job_keeps_paths_relative_so_that_its_folder_can_move(job, tmp_path):
    text = job.path.read_text()
    assert str(tmp_path) not in text
    assert 'neutral = "source.obj"' in text


def test_a_path_outside_the_folder_is_kept(tmp_path):
    job = read_job(written(tmp_path, MINIMAL.replace("source.obj", "/elsewhere/source.obj")))
    write_job(job, job.path)
    assert read_job(job.path) == job


names = st.text(st.characters(exclude_categories=["Cs"]), max_size=8)
files = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0/\\:"), min_size=1, max_size=8).filter(
    lambda name: name.strip(" .") == name and name.strip() != ""
)


@st.composite
def jobs(draw: st.DrawFn, folder: Path) -> Job:
    def path() -> Path:
        return folder / draw(files)

    level_gains = draw(st.lists(st.floats(0, 4), max_size=4))
    return Job(
        method="hierarchical",
        source=FaceFiles(path(), draw(st.none() | st.just(path())), path(), draw(st.none() | st.just(path()))),
        target=FaceFiles(path(), draw(st.none() | st.just(path())), parts=draw(st.none() | st.just(path()))),
        examples=tuple(ExampleFiles(name, path(), path()) for name in draw(st.lists(names, unique=True, max_size=3))),
        settings=HierarchicalSettings(
            levels=draw(st.integers(1, 6)), base_gain=draw(st.floats(0, 4)), level_gains=tuple(level_gains)
        ),
        output=OutputFiles(
            folder / "o" / draw(files),
            draw(st.none() | st.just(folder / "r" / draw(files))),
            folder / "p" / draw(files),
        ),
        base=draw(st.none() | st.just(path())),
        path=folder / "job.toml",
        regions=RegionGains(mouth=draw(st.floats(0, 4)), jaw=draw(st.just(1.0) | st.floats(0, 4))),
        masks=tuple(
            MaskFile(name, path(), draw(st.floats(0, 4))) for name in draw(st.lists(names, unique=True, max_size=2))
        ),
        normal_maps=draw(
            st.none()
            | st.builds(
                MapOutput,
                st.just(folder / "n" / draw(files)),
                st.builds(MapSettings, level=st.just(0), pixels=st.integers(16, 16384), depth=st.just("exr")),
            )
        ),
        bake=draw(st.none() | bakes(folder)),
        chosen=draw(st.builds(FrameRange, st.integers(1, 9), st.none() | st.integers(9, 99), st.integers(1, 9))),
        fps=draw(st.floats(1, 1000)),
    )


def bakes(folder: Path) -> st.SearchStrategy[BakeOutput]:
    paths = st.lists(files, unique=True, min_size=1, max_size=2).map(lambda n: tuple(folder / "c" / name for name in n))
    ranges = st.dictionaries(names, st.tuples(st.floats(-9, 0), st.floats(1, 9)), max_size=2)
    compact = st.builds(BakeSettings, kind=st.just("compact"), tolerance=st.floats(0.0001, 0.5))
    rig = st.builds(BakeSettings, kind=st.just("rig"), residual=st.integers(1, 100))
    place = st.just(folder / "k" / "keys.npz")
    return st.builds(BakeOutput, compact, paths, place) | st.builds(
        BakeOutput, rig, paths, place, st.just(folder / "rig.json"), ranges
    )


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_writing_and_reading_gives_the_same_job(tmp_path, data):
    job = data.draw(jobs(tmp_path))
    write_job(job, job.path)
    assert read_job(job.path) == job


def test_every_fault_is_named_at_once(tmp_path):
    text = """
    version = 2
    method = "magic"
    colour = "red"
    [source]
    neutral = 3
    [target]
    neutral = ""
    frames = "f.npz"
    [[examples]]
    name = "joy"
    source = "a.obj"
    target = "b.obj"
    [[examples]]
    name = "joy"
    target = "b.obj"
    [output]
    report = true
    """
    with pytest.raises(RetargetError) as error:
        read_job(written(tmp_path, text))
    for fault in (
        "version = 2, expected 1",
        "method = 'magic', expected one of hierarchical",
        "colour is unknown",
        "[source] neutral = 3, expected a text",
        "[source] frames is missing",
        "[target] neutral = '', expected a path",
        "[target] frames is unknown",
        "name 'joy' appears twice",
        "[[examples]] 2 source is missing",
        "[output] frames is missing",
        "[output] report = True",
    ):
        assert fault in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("levels = 9", "a whole number from 1 to 6"),
        ("levels = true", "a whole number from 1 to 6"),
        ("levels = 2.5", "a whole number from 1 to 6"),
        ("level = 2", "has no setting 'level'"),
        ("base_gain = nan", "a number from 0.0 to 4.0"),
        ('read = "guess"', "one of track, pierce"),
        ("level_gains = [1, 9]", "a number from 0.0 to 4.0"),
        ("level_gains = 1", "a list of numbers"),
    ],
)
def test_a_setting_that_is_wrong(tmp_path, line, expected):
    text = MINIMAL.replace("[output]", f"[settings]\n{line}\n[output]")
    with pytest.raises(RetargetError, match=r"\[settings\]") as error:
        read_job(written(tmp_path, text))
    assert expected in str(error.value)


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        ("[regions]\nbeak = 1.0", "[regions] has no setting 'beak'; there are brows, eyes, nose, cheeks, mouth, jaw"),
        ("[regions]\nmouth = 5", "[regions] mouth = 5: expected a number from 0.0 to 4.0"),
        ('[[masks]]\nname = "scar"\nweights = "a.npz"\ngain = -1', "[[masks]] 1 gain = -1.0, expected a number from"),
        ('[[masks]]\nname = "scar"\ngain = 1', "[[masks]] 1 weights is missing"),
        ('[[masks]]\nname = "scar"\nweights = "out.npz"\ngain = 1', "[output] frames and mask 'scar' are one file"),
    ],
)
def test_a_gain_that_is_wrong(tmp_path, lines, expected):
    with pytest.raises(RetargetError) as error:
        read_job(written(tmp_path, MINIMAL.replace("[output]", f"{lines}\n[output]")))
    assert expected in str(error.value)


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        ("pixels = 512", "[normal_maps] folder is missing"),
        ('folder = "maps"\npixels = 5', "[normal_maps] pixels = 5: expected a whole number from 16 to 16384"),
        ('folder = "maps"\ndepth = "jpeg"', "[normal_maps] depth = 'jpeg': expected one of png8, png16, exr"),
        ('folder = "maps"\nsize = 5', "[normal_maps] has no setting 'size'"),
        ('folder = "maps"\nlevel = 5', "[normal_maps] level = 5, expected one of the 4 in [settings], or 0"),
        ('folder = "source.obj"', "[normal_maps] folder and [source] neutral are one file"),
    ],
)
def test_normal_maps_that_are_wrong(tmp_path, lines, expected):
    with pytest.raises(RetargetError) as error:
        read_job(written(tmp_path, MINIMAL.replace("[output]", f"[normal_maps]\n{lines}\n[output]")))
    assert expected in str(error.value)


def test_normal_maps_need_a_method_with_levels(tmp_path):
    text = MINIMAL.replace('"hierarchical"', '"motion_cloning"')
    with pytest.raises(RetargetError, match=r"a method with levels, expected one of hierarchical, wavelet, not motion"):
        read_job(written(tmp_path, text.replace("[output]", '[normal_maps]\nfolder = "maps"\n[output]')))


def test_outputs_may_not_replace_inputs_or_each_other(tmp_path):
    text = MINIMAL.replace('frames = "out.npz"', 'frames = "x/../source.obj"\nreport = "r"\npage = "r"')
    with pytest.raises(RetargetError) as error:
        read_job(written(tmp_path, text))
    assert "[output] frames and [source] neutral are one file" in str(error.value)
    assert "[output] page and [output] report are one file" in str(error.value)


def test_numbers_survive_exactly(job):
    changed = replace(job, settings=HierarchicalSettings(base_gain=math.pi, level_gains=(1e-300, 0.1, 4.0)))
    write_job(changed, job.path)
    assert read_job(job.path) == changed


DOCUMENT = Path(__file__).resolve().parents[2] / "docs" / "job_file.md"


def test_the_example_in_the_documentation_is_a_job(tmp_path):
    text = DOCUMENT.read_text(encoding="utf-8")
    job = read_job(written(tmp_path, text.split("```toml\n")[1].split("```")[0]))
    assert job.examples[0].name == "joy"
    assert job.base == tmp_path / "base.json"
    assert job.regions == RegionGains(mouth=0.8, jaw=1.2)
    assert job.masks == (MaskFile("scar", tmp_path / "scar.npz", 0.3),)
    assert job.normal_maps == MapOutput(tmp_path / "normal_maps", MapSettings())
    assert (job.chosen, job.fps) == (FrameRange(1, 400, 2), 30.0)
    curves = (tmp_path / "curves.csv", tmp_path / "curves.json")
    assert job.bake == BakeOutput(BakeSettings("compact"), curves, tmp_path / "keys.npz")


def test_the_bake_of_a_rig_in_the_documentation_is_one(tmp_path):
    text = DOCUMENT.read_text(encoding="utf-8").split("## Bakes")[1].split("```toml\n")[1].split("```")[0]
    bake = read_job(written(tmp_path, MINIMAL + text)).bake
    assert bake.rig == tmp_path / "target_shapes"
    assert bake.ranges == {"jawOpen": (0.0, 1.5), "mouthLeft": (-1.0, 1.0)}


def test_the_documentation_has_every_region_and_its_help():
    text = DOCUMENT.read_text(encoding="utf-8").split("## Regions and masks")[1]
    for field in fields(RegionGains):
        assert f"| `{field.name}` | {field.metadata['help']} |" in text, "docs/job_file.md is behind the regions"


@pytest.mark.parametrize(
    ("heading", "settings_of"),
    [
        ("Settings of `hierarchical`", SETTINGS["hierarchical"]),
        ("Settings of `wavelet`", SETTINGS["wavelet"]),
        ("Normal maps", MapSettings),
        ("Bakes", BakeSettings),
    ],
)
def test_the_documentation_has_every_setting_with_its_default_and_help(heading, settings_of):
    text = DOCUMENT.read_text(encoding="utf-8").split(f"## {heading}")[1]
    for field in NUMBERS if settings_of is BakeSettings else fields(settings_of):
        default = json.dumps(list(field.default) if isinstance(field.default, tuple) else field.default)
        row = next(line for line in text.splitlines() if line.startswith(f"| `{field.name}` |"))
        assert f"| `{default}` |" in row
        assert row.endswith(f"| {field.metadata['help']} |"), "docs/job_file.md is behind the settings"
