"""Long work in steps, so that Blender keeps drawing and Esc stops it."""

from __future__ import annotations

from collections.abc import Callable, Generator
from concurrent.futures import ThreadPoolExecutor, TimeoutError
from contextlib import closing
from typing import TypeVar

from ..core.arrays import Progress
from ..core.errors import Cancelled

T = TypeVar("T")
Steps = Generator[tuple[float, str], None, T]
"""Yields the share done and what is being done; returns a result. Closing it stops the work."""

PATIENCE = 0.02
"""Seconds that one step waits for the work."""


def in_thread(work: Callable[[Progress], T]) -> Steps[T]:
    """Run `work(progress)` on a thread; it may touch no Blender data.

    Closing the steps makes the work's next progress call raise Cancelled, and waits for that.
    """
    state: list[tuple[float, str]] = [(0.0, "")]
    stopped = False

    def progress(share: float, what: str) -> None:
        state[0] = (share, what)
        if stopped:
            raise Cancelled

    with ThreadPoolExecutor(1, "facial retarget") as pool:
        running = pool.submit(work, progress)
        try:
            while True:
                try:
                    return running.result(PATIENCE)
                except TimeoutError:
                    if running.done():
                        raise
                yield state[0]
        finally:
            stopped = True


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
