"""Stopping work on a thread waits for nothing: neither for its next progress call, nor at the end of Blender."""

from threading import Event
from time import sleep

import bpy
from stage import enable, part

enable()
background, cancelled = part("bridge.background"), part("core.errors").Cancelled
ended: list[str] = []


class Work:
    """Says nothing until it is let go; then it calls progress."""

    def __init__(self) -> None:
        self.started, self.go = Event(), Event()

    def __call__(self, progress: object) -> str:
        """The work."""
        self.started.set()
        self.go.wait()
        try:
            progress(0.5, "half")
        except cancelled:
            ended.append("cancelled")
            raise
        ended.append("finished")
        return "made"


def begun(work: Work) -> object:
    """Steps of a work that is under way."""
    steps = background.in_thread(work)
    assert next(steps)[0] == 0.0
    assert work.started.wait(60)
    return steps


# Left alone it comes to its end.
work = Work()
steps = begun(work)
work.go.set()
assert background.finished(steps) == "made"
assert ended == ["finished"]

# Closed while it is deep in the core: this would hang here if closing waited.
first, second, third = Work(), Work(), Work()
for one in (first, second):
    begun(one).close()
assert ended == ["finished"]

# Two may linger; the next one waits until one of them has ended by itself, and can be closed meanwhile.
steps = background.in_thread(third)
assert [next(steps)[1] for _ in range(3)] == ["Waiting for what was stopped"] * 3
steps.close()
steps = background.in_thread(third)
next(steps)
assert not third.started.is_set()
first.go.set()
while not third.started.is_set():
    next(steps)
assert ended == ["finished", "cancelled"]
third.go.set()
assert background.finished(steps) == "made"

# An error of the work is its caller's.
try:
    background.finished(background.in_thread(lambda progress: [][0]))
except IndexError:
    pass
else:
    raise AssertionError("the error was lost")

assert not second.go.is_set()

# What was made and is not taken is discarded, whether the work has ended before the steps are closed or after.
for ends_first in (True, False):
    made: list[str] = []
    said, go, over = Event(), Event(), Event()

    def late(progress: object, said: Event = said, go: Event = go, over: Event = over) -> str:
        """Calls progress for the last time, and goes on for a while."""
        progress(1.0, "last")
        said.set()
        go.wait()
        over.set()
        return "late"

    steps = background.in_thread(late, made.append)
    while not said.is_set():  # at first it may wait for a thread that is about to end
        next(steps)
    if ends_first:
        go.set()
        assert over.wait(60)
        sleep(0.2)
    steps.close()
    go.set()
    background._lingering[-1].join(60)
    assert made == ["late"], made
made.clear()
work = Work()
work.go.set()
assert background.finished(background.in_thread(work, made.append)) == "made"
assert made == []

# `second` still hangs: Python must end nevertheless. As a module, Blender 4.5 tidies up only once no thread of Python's
# is left, and waits for itself at the end if it could not; Blender itself, and newer modules, end.
if bpy.app.version < (5, 0):
    second.go.set()
    for thread in list(background._lingering):
        thread.join(60)
