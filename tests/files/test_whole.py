"""Outputs appear whole or not at all."""

from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.files.whole import appear_whole, write_whole, written_aside, written_whole


@pytest.fixture
def old(tmp_path: Path) -> Path:
    """A folder with an older output and an older folder of frames."""
    (tmp_path / "report.json").write_text("old")
    (tmp_path / "take").mkdir()
    (tmp_path / "take" / "frame_1.obj").write_text("old")
    (tmp_path / "take" / "frame_2.obj").write_text("old")
    return tmp_path


def write_all(folder: Path) -> None:
    with written_whole() as aside:
        write_both(folder, aside)


def write_folder(folder: Path) -> None:
    with written_whole() as aside:
        take = aside.place(folder / "take", replaces=".obj")
        take.mkdir()
        (take / "frame_1.obj").write_text("new")


def write_both(folder: Path, aside) -> None:
    aside.place(folder / "report.json").write_text("new")
    take = aside.place(folder / "take", replaces=".obj")
    take.mkdir()
    (take / "frame_1.obj").write_text("new")


def test_files_and_folders_appear_together(old, listing):
    with written_whole() as aside:
        write_both(old, aside)
        assert (old / "report.json").read_text() == "old"
        assert (old / "take" / "frame_2.obj").exists()
    assert listing() == {"report.json": b"new", "take/frame_1.obj": b"new"}


@pytest.mark.parametrize("stop", [ValueError, KeyboardInterrupt, SystemExit])
def test_whatever_stops_the_work_leaves_everything_as_it_was(old, listing, stop):
    before = listing()

    def work() -> None:
        with written_whole() as aside:
            write_both(old, aside)
            raise stop

    with pytest.raises(stop):
        work()
    assert listing() == before


@pytest.mark.parametrize("call", ["fsync", "replace"])
def test_a_system_that_refuses_leaves_everything_as_it_was(old, listing, monkeypatch, call):
    def refuse(*args: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    before = listing()
    monkeypatch.setattr(os, call, refuse)
    with pytest.raises(RetargetError, match=r"(take|report\.json) cannot be written: the disk is full"):
        write_all(old)
    assert listing() == before


def test_a_folder_comes_back_when_the_new_one_cannot_take_its_place(old, listing, monkeypatch):
    before = listing()
    rename = os.rename

    def refuse_the_new_one(source, target) -> None:
        if "partial" in str(source):
            raise OSError(errno.EACCES, "Permission denied")
        rename(source, target)

    monkeypatch.setattr(os, "rename", refuse_the_new_one)
    with pytest.raises(RetargetError, match="Permission denied"):
        write_folder(old)
    assert listing() == before


@pytest.mark.parametrize("refused", [1, 2, 3, 4])
def test_a_rename_that_is_refused_takes_the_earlier_ones_back(old, listing, monkeypatch, refused):
    """Whichever it is of: the report aside, the new report, the folder aside, the new folder."""
    before, renames = listing(), []

    def counted(rename):
        def counting(source, target) -> None:
            renames.append(source)
            if len(renames) == refused:
                raise OSError(errno.EBUSY, "Device or resource busy")
            rename(source, target)

        return counting

    monkeypatch.setattr(os, "rename", counted(os.rename))
    monkeypatch.setattr(os, "replace", counted(os.replace))
    with pytest.raises(RetargetError, match=r"(take|report\.json) cannot be written: Device or resource busy"):
        write_all(old)
    assert len(renames) >= refused
    assert listing() == before


def test_a_writer_that_got_a_place_beside_names_the_real_one(old, listing):
    before = listing()
    with pytest.raises(RetargetError) as told, written_whole() as aside:
        write_whole(aside.place(old / "new.json") / "within", b"new")
    assert str(told.value) == f"{old / 'new.json' / 'within'} cannot be written: there is no folder {old / 'new.json'}"
    assert listing() == before


def test_a_folder_with_other_things_is_never_replaced(old, listing):
    (old / "take" / "diary.txt").write_text("dear diary")
    before = listing()
    with pytest.raises(RetargetError, match=r"diary\.txt"), written_whole() as aside:
        aside.place(old / "take", replaces=".obj")
    assert listing() == before


def test_a_folder_is_not_replaced_by_a_file(old):
    with pytest.raises(RetargetError, match="it is a folder, expected a file"):
        write_whole(old / "take", b"new")


def test_a_folder_that_is_not_there(tmp_path):
    with pytest.raises(RetargetError, match="there is no folder"):
        write_whole(tmp_path / "none" / "report.json", b"new")


def test_a_name_that_is_too_long(tmp_path):
    with pytest.raises(RetargetError, match="cannot be written"):
        write_whole(tmp_path / ("x" * 300), b"new")


@pytest.mark.parametrize("name", [251 * "x" + ".txt", 125 * "ä" + ".txt", 'it\'s "two" words ä.txt'])
def test_every_name_that_the_system_allows(tmp_path, listing, name):
    for content in (b"old", b"new"):
        write_whole(tmp_path / name, content)
    with written_whole() as aside:
        aside.place(tmp_path / name).write_bytes(b"newest")
        aside.place(tmp_path / "b").write_bytes(b"b")
    assert listing() == {name: b"newest", "b": b"b"}


def test_new_files_have_ordinary_permissions(tmp_path):
    write_whole(tmp_path / "a", b"new")
    (tmp_path / "b").write_bytes(b"new")
    assert (tmp_path / "a").stat().st_mode == (tmp_path / "b").stat().st_mode


def fail_aside(folder: Path) -> None:
    with written_aside() as aside:
        write_both(folder, aside)
        raise ZeroDivisionError


def test_what_is_written_aside_waits_for_its_appearance(old, listing):
    before = listing()
    with written_aside() as aside:
        write_both(old, aside)
    assert {name: listing()[name] for name in before} == before
    aside.vanish()
    assert listing() == before
    with written_aside() as aside:
        write_both(old, aside)
    appear_whole(aside)
    assert listing() == {"report.json": b"new", "take/frame_1.obj": b"new"}
    with pytest.raises(ZeroDivisionError):
        fail_aside(old)
    assert listing() == {"report.json": b"new", "take/frame_1.obj": b"new"}
