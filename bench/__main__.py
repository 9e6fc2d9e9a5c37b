"""Run the bench, print its tables, and end with status 1 where a bound is missed."""

import sys
from importlib import import_module

from .timing import LeftOut

SECTIONS = (
    "fit",
    "piercing",
    "frames",
    "feature_points",
    "wrinkles",
    "real_faces",
    "levels",
    "cloning",
    "cloning_grid",
    "cloning_speed",
    "parts",
    "placing",
    "normal_maps",
    "wrinkle_kit",
    "bakes",
    "blender_write",
    "bake_kinds",
    "preview",
    "points",
    "window",
)


def main(names: list[str]) -> int:
    """Run sections by name, or all of them."""
    unknown = [name for name in names if name not in SECTIONS]
    if unknown:
        print(f"no section {', '.join(unknown)}; there are {', '.join(SECTIONS)}", file=sys.stderr)
        return 2
    missed = 0
    for name in names or SECTIONS:
        module = import_module(f".{name}", __package__)
        print(
            f"\n## {name}: {(module.__doc__ or '').splitlines()[0]}\n\n| what | measured | bound | |\n|---|---|---|---|"
        )
        try:
            for row in module.rows():
                print(row, flush=True)
                missed += not row.met
        except LeftOut as why:
            print(f"\nLEFT OUT: {why}", flush=True)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
