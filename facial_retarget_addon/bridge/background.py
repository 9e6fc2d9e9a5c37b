"""Long work in steps, so that Blender keeps drawing and Esc stops it."""

from __future__ import annotations

from collections.abc import Callable, Generator
from concurrent.futures import Future, TimeoutError
from contextlib import closing
from threading import Event, Lock, Thread
from typing import TypeVar

from ..core.arrays import Progress
from ..core.errors import Cancelled

T = TypeVar("T")
Steps = Generator[tuple[float, str], None, T]
"""Yields the share done and what is being done; returns a result. Closing it stops the work."""

PATIENCE = 0.02
"""Seconds that one step waits for the work."""
MOST_LINGERING = 2
"""Stopped works that may still be on their way to their end when another one begins."""

_lingering: list[Thread] = []
"""The threads of stopped works."""


def _keep(made: object) -> None:
    """What most works make needs no discarding."""


def in_thread(work: Callable[[Progress], T], discard: Callable[[T], None] = _keep) -> Steps[T]:
    """Run `work(progress)` on a thread; it may touch no Blender data.

    Either the steps return what the work has made, or `discard` gets it: where they are closed after its last progress
    call.

    Closing the steps takes no time: the work's next progress call raises Cancelled, and nobody waits for that, at the
    end of Blender neither. Where several stopped works are still on their way there, the next one waits for one of
    them: they hold memory.
    """
    while len(_still_lingering()) >= MOST_LINGERING:
        _lingering[0].join(PATIENCE)
        yield 0.0, "Waiting for what was stopped"
    state: list[tuple[float, str]] = [(0.0, "")]
    stopped, lock, taken = Event(), Lock(), False
    result: Future[T] = Future()

    def progress(share: float, what: str) -> None:
        state[0] = (share, what)
        if stopped.is_set():
            raise Cancelled

    def run() -> None:
        try:
            made = work(progress)
        except BaseException as error:
            result.set_exception(error)
            return
        with lock:
            if stopped.is_set():
                discard(made)
            else:
                result.set_result(made)

    # Python waits at its end for all threads but daemons.
    thread = Thread(target=run, name="facial retarget", daemon=True)
    thread.start()
    try:
        while True:
            try:
                made = result.result(PATIENCE)
                taken = True
                return made
            except TimeoutError:
                if result.done():
                    raise
            yield state[0]
    finally:
        with lock:
            stopped.set()
            if not taken and result.done() and result.exception() is None:
                discard(result.result())
        _lingering.append(thread)


def _still_lingering() -> list[Thread]:
    _lingering[:] = [thread for thread in _lingering if thread.is_alive()]
    return _lingering


def part(steps: Steps[T], start: float, length: float) -> Steps[T]:
    """The same steps as a part of something longer: shares from `start` to `start + length`."""
    with closing(steps):
        while True:
            try:
                share, what = next(steps)
            except StopIteration as end:
                return end.value
            yield start + length * share, what


def finished(steps: Steps[T]) -> T:
    """Run all steps; returns their result."""
    with closing(steps):
        while True:
            try:
                next(steps)
            except StopIteration as end:
                return end.value
