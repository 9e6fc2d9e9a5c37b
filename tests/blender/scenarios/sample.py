"""Run a sample script of the documentation, as an artist would."""

import runpy
import sys

from stage import enable

enable()
runpy.run_path(sys.argv[1], run_name="__main__")
