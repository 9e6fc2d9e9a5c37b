"""Stopping work on a thread waits for nothing: neither for its next progress call, nor at the end of Blender."""

from threading import Event

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

# `second` still hangs: Python must end nevertheless.
assert not second.go.is_set()
