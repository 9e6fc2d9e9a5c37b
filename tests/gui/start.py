"""What Blender runs at its start: plays `scenario()` of the file that the command line names after "--"."""

import importlib.util
import sys
from pathlib import Path

scenario, out, *arguments = sys.argv[sys.argv.index("--") + 1 :]
sys.path[:0] = [str(Path(__file__).parent), str(Path(scenario).parent)]
import drive  # noqa: E402

drive.OUT, drive.ARGUMENTS = Path(out), arguments
drive.set_preferences()
spec = importlib.util.spec_from_file_location("scenario", scenario)
module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)
drive.play(module.scenario)
