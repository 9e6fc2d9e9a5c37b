"""Outputs appear whole or not at all: written beside their place, then renamed."""

from __future__ import annotations

import errno
import os
import secrets
import shutil
from collections.abc import Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

from ..core.errors import RetargetError

FLUSHED = 8
"""Files that are flushed at once."""

Suffixes = str | tuple[str, ...]
"""One suffix of files or several, in small letters with their dots; "" for none."""


class Aside:
    """Places beside the real ones. What was written there appears together, or goes away together."""

    def __init__(self) -> None:
        self._pairs: list[tuple[Path, Path]] = []
        self._adopted: set[Path] = set()
        self.busy_with: Path | None = None
        """The output that is being written, for messages."""

    def place(self, path: Path, replaces: Suffixes = "") -> Path:
        """A place in the same folder (same file system, same suffix) to write `path` at.

        Parameters
        ----------
        path : where the file or folder shall appear.
        replaces : for a folder, the suffixes of the files that it may hold now and that go with it.

        Raises
        ------
        RetargetError : if the folder around `path` is missing, or `path` is a folder that holds anything
            but such files: replacing it would lose them.
        """
        check_place(path, replaces)
        aside = _beside(path, "partial")
        self._pairs.append((aside, path))
        self.busy_with = path
        return aside

    def adopt(self, made: Path, path: Path, replaces: Suffixes = "") -> None:
        """Let what stands beside `path`, a file or folder, appear there with the rest; it stays if that fails.

        Parameters and errors as `place`.
        """
        check_place(path, replaces)
        self._pairs.append((made, path))
        self._adopted.add(made)
        self.busy_with = path

    def appear(self) -> None:
        """Put everything in its place: first all of it onto the disk, then the renames, all of them or none."""
        for aside, path in self._pairs:
            self.busy_with = path
            flush(aside)
        done: list[tuple[Path, Path]] = []
        old: list[Path] = []
        try:
            for aside, path in self._pairs:
                self.busy_with = path
                # What is replaced steps aside until everything stands; a file that comes last is replaced in one go.
                if path.is_dir() or (path.exists() and aside != self._pairs[-1][0]):
                    old.append(_beside(path, "old"))
                    done += _renamed(path, old[-1])
                done += _renamed(aside, path)
        except BaseException:
            for start, end in reversed(done):
                os.rename(end, start)
            raise
        self._pairs.clear()
        for place in old:
            remove(place)

    def named(self, text: str) -> str:
        """A message with the real places in it: a writer that was given one beside them knows no other."""
        for aside, path in self._pairs:
            text = text.replace(str(aside), str(path))
        return text

    def vanish(self) -> None:
        """Remove what has not appeared."""
        for aside, _ in self._pairs:
            if aside not in self._adopted:
                remove(aside)


@contextmanager
def written_whole() -> Iterator[Aside]:
    """Write several outputs that appear together at the end of the block.

    An exception, Ctrl-C included, leaves every file and folder as it was.

    Raises
    ------
    RetargetError : if the system refuses to write, such as on a full disk.
    """
    with written_aside() as aside:
        yield aside
    appear_whole(aside)


@contextmanager
def written_aside() -> Iterator[Aside]:
    """Write several outputs that `appear_whole` lets appear together, or whose `vanish` removes them.

    An exception removes them too. RetargetError if the system refuses to write.
    """
    aside = Aside()
    try:
        with _told(aside):
            yield aside
    except BaseException:
        aside.vanish()
        raise


def appear_whole(aside: Aside) -> None:
    """Put what was written aside in its place; RetargetError if the system refuses, and what has not appeared goes."""
    try:
        with _told(aside):
            aside.appear()
    finally:
        aside.vanish()


@contextmanager
def _told(aside: Aside) -> Iterator[None]:
    """What the system refuses, in words."""
    try:
        yield
    except RetargetError as error:
        raise RetargetError(aside.named(str(error))) from error
    except OSError as error:
        raise RetargetError(f"{aside.busy_with or 'the output'} cannot be written: {_reason(error)}") from error


def write_whole(path: Path, content: bytes) -> None:
    """Write one file, whole or not at all; RetargetError if the system refuses."""
    with written_whole() as aside, open(aside.place(path), "xb") as file:
        file.write(content)


def check_place(path: Path, replaces: Suffixes = "") -> None:
    """RetargetError if `Aside.place` would refuse."""
    try:
        if not path.parent.is_dir():
            raise RetargetError(f"{path} cannot be written: there is no folder {path.parent}")
        if not os.access(path.parent, os.W_OK):
            raise RetargetError(f"{path} cannot be written: the folder {path.parent} may not be changed")
        if path.is_dir():
            _check_replaceable(path, replaces)
    except OSError as error:
        raise RetargetError(f"{path} cannot be written: {_reason(error)}") from error


def place_faults(places: Iterable[Path | None], replaces: str = "") -> list[str]:
    """What is wrong with some outputs' places, see `check_place`; None is passed over."""
    wrong = []
    for place in places:
        try:
            if place is not None:
                check_place(place, replaces)
        except RetargetError as error:
            wrong.append(str(error))
    return wrong


def overwritten(inputs: Mapping[str, Path], outputs: Mapping[str, Path]) -> list[str]:
    """What is wrong with outputs that would replace an input or each other, with them or with the folder around them.

    Parameters
    ----------
    inputs, outputs : how messages name each one -> its path.
    """
    taken = {name: Path(os.path.abspath(path)) for name, path in inputs.items()}
    wrong: list[str] = []
    for name, place in outputs.items():
        path = Path(os.path.abspath(place))
        for other, used in taken.items():
            if used == path:
                wrong.append(f"{name} and {other} are one file, expected different ones")
            elif used.is_relative_to(path):
                wrong.append(f"{other} lies in {name}, a folder that is replaced; expected it elsewhere")
            elif other in outputs and path.is_relative_to(used):
                wrong.append(f"{name} lies in {other}, a folder that is replaced; expected it elsewhere")
        taken[name] = path
    return wrong


def _check_replaceable(folder: Path, replaces: Suffixes) -> None:
    if not replaces:
        raise RetargetError(f"{folder} cannot be written: it is a folder, expected a file")
    suffixes = (replaces,) if isinstance(replaces, str) else replaces
    foreign = sorted(entry.name for entry in folder.iterdir() if entry.suffix.lower() not in suffixes)
    if foreign:
        raise RetargetError(
            f"folder {folder} holds {foreign[0]!r}; expected a new folder, or one that holds {' and '.join(suffixes)} "
            "files only, since it is replaced"
        )


def flush(place: Path) -> None:
    """See to it that a file, or the files of a folder, are on the disk."""
    # Files that are flushed at once go there in one go: frames in a folder 20 times as fast.
    with ThreadPoolExecutor(FLUSHED) as flushing:
        list(flushing.map(_flush, place.iterdir() if place.is_dir() else [place]))


def _flush(path: Path) -> None:
    with open(path, "rb+") as file:
        os.fsync(file.fileno())


def _beside(path: Path, what: str) -> Path:
    """A hidden place beside another; its name is no longer than the system allows wherever that of `path` is not."""
    return path.parent / f".{path.stem[:40]}-{secrets.token_hex(4)}-{what}{path.suffix}"


def _renamed(start: Path, end: Path) -> list[tuple[Path, Path]]:
    """Rename, over a file that is there; returns what was done."""
    (os.rename if start.is_dir() else os.replace)(start, end)
    return [(start, end)]


def remove(place: Path) -> None:
    """Remove a file or folder, if it is there."""
    if place.is_dir():
        shutil.rmtree(place, ignore_errors=True)
    else:
        place.unlink(missing_ok=True)


def _reason(error: OSError) -> str:
    return "the disk is full" if error.errno in (errno.ENOSPC, errno.EDQUOT) else error.strerror or str(error)
