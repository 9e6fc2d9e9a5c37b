"""What an artist waits for in Blender's window: Esc, what is drawn over the view, clicks that place points."""

from __future__ import annotations

import json
from collections.abc import Iterator
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from tempfile import TemporaryDirectory
from types import ModuleType

from .timing import LeftOut, Row

HERE = Path(__file__).resolve().parent
VERTICES, FRAMES = 28_000, 100
LIMIT = 900
"""Seconds that all of it may take."""
FREE = 0.2
"""Seconds from Esc to a Blender that does what one wants."""
STILL = 15.0
"""Milliseconds that the overlay may add to a redraw where nothing has changed."""
MOVED = {"points": 20.0, "points and all names": 50.0, "base mesh": 15.0, "heat map": 25.0, "everything": 70.0}
"""What is shown -> milliseconds that it may add where both faces have moved."""
CLICKS = {"press": 100.0, "first move": 100.0, "move": 10.0, "release": 100.0}
"""Milliseconds that a part of a click or drag may take."""


def rows() -> Iterator[Row]:
    """Seconds by the clock for Esc; for what is drawn and for clicks those of Blender's thread, the GPU's left out."""
    window = _window()
    if missing := window.lacks():
        raise LeftOut(f"playing in a window needs {missing}")
    with TemporaryDirectory() as name:
        folder = Path(name)
        user, out = folder / "user", folder / "out"
        window.install_as_shipped(window.ROOT, user, folder / "dist")
        arguments = (str(VERTICES), str(FRAMES))
        status, said = window.play(window.ROOT, user, out, HERE / "window_scenario.py", *arguments, limit=LIMIT)
        if status:
            raise RuntimeError(f"the scenario ended with status {status}:\n{said[-4000:]}")
        figures = json.loads((out / "figures.json").read_text())
    source, target = figures["vertices"]
    yield Row("source vertices", source, "")
    yield Row("target vertices", target, "")
    yield Row("frames", figures["frames"], "")
    yield Row(f"Esc, worst of {len(figures['esc'])} moments of the job", max(figures["esc"]), "s", FREE)
    for what, taken in figures["still"].items():
        yield Row(f"{what}, nothing has changed", taken, "ms", STILL)
    for what, taken in figures["moved"].items():
        yield Row(f"{what}, at a new frame", taken, "ms", MOVED[what])
    for what, bound in CLICKS.items():
        yield Row(f"a point placed and dragged: {what}", figures["clicking"][what], "ms", bound)


def _window() -> ModuleType:
    """The player of the window's tests, which is no part of a package."""
    spec = spec_from_file_location("window", HERE.parent / "tests" / "gui" / "window.py")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
