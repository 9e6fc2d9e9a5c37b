"""Build the Blender extension: one zip per platform, with the wheels that Blender does not bring.

    python build_extension.py --out dist [--platforms current|all]

Runs Blender's own build tool, which lies inside the bpy wheel. Wheels are fetched by pip, at the
versions that requirements/develop.in pins, and kept in build/wheels.
"""

from __future__ import annotations

import argparse
import importlib.util
import platform
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from tempfile import TemporaryDirectory

from build_manual import write_manual

ROOT = Path(__file__).resolve().parent
SHIPPED = ("blender_manifest.toml", "LICENSE", "__init__.py", "facial_retarget_addon", "operators", "panels")
LEFT_OUT = ("__pycache__", "cli.py", "demonstration.py", "terminal.py")

PYTHONS = ("3.11", "3.13", "3.14")
"""Blender 4.5 to 5.0; 5.1 and 5.2; 5.2 as some distributions build it."""

TAGS = {
    "windows-x64": "win_amd64",
    "windows-arm64": "win_arm64",
    "macos-x64": "macosx_13_0_x86_64",
    "macos-arm64": "macosx_13_0_arm64",
    "linux-x64": "manylinux_2_28_x86_64",
    "linux-arm64": "manylinux_2_28_aarch64",
}
"""Blender's name of a platform -> the newest wheel tag that may be used on it."""

PURE = ("c3d",)
"""Packages of Python alone: one wheel serves every platform and Python."""

WITHOUT_EMBREE = ("windows-arm64", "linux-arm64")
"""Embree has no wheels there: the extension casts rays through Blender's BVHTree."""


def main() -> None:
    """Build and validate the zips that the command line asks for."""
    parser = argparse.ArgumentParser(description="Build the Blender extension.")
    parser.add_argument("--out", type=Path, default=ROOT / "dist", help="folder for the zips")
    parser.add_argument("--platforms", choices=("current", "all"), default="current")
    options = parser.parse_args()
    chosen = list(TAGS) if options.platforms == "all" else [current_platform()]
    for archive in build(options.out, chosen):
        print(archive)


def build(out: Path, platforms: list[str]) -> list[Path]:
    """Build one zip per platform into `out`; returns their paths."""
    out.mkdir(parents=True, exist_ok=True)
    wheels = [wheel for name in platforms for wheel in fetch_wheels(name)]
    wheels += [wheel for package in PURE for wheel in fetch(package, current_platform(), PYTHONS[0])]
    with TemporaryDirectory() as folder:
        stage = Path(folder)
        lay_out(stage, wheels)
        complete_manifest(stage / "blender_manifest.toml", platforms, wheels)
        blender_tool("build", "--split-platforms", "--source-dir", folder, "--output-dir", str(out.resolve()))
    manifest = tomllib.loads((ROOT / "blender_manifest.toml").read_text("utf-8"))
    stem = f"{manifest['id']}-{manifest['version']}"
    archives = [out / f"{stem}-{name.replace('-', '_')}.zip" for name in platforms]
    for archive in archives:
        blender_tool("validate", str(archive.resolve()))
    return archives


def current_platform() -> str:
    """Blender's name of this platform."""
    system = {"darwin": "macos"}.get(platform.system().lower(), platform.system().lower())
    machine = {"x86_64": "x64", "amd64": "x64", "aarch64": "arm64"}
    return f"{system}-{machine.get(platform.machine().lower(), platform.machine().lower())}"


def fetch_wheels(platform_name: str) -> list[Path]:
    """The compiled wheels of one platform, for every Python."""
    packages = ["scipy"] if platform_name in WITHOUT_EMBREE else ["scipy", "embreex"]
    return [wheel for python in PYTHONS for package in packages for wheel in fetch(package, platform_name, python)]


def fetch(package: str, platform_name: str, python: str) -> list[Path]:
    """A package's pinned wheel for a platform and a Python; one that build/wheels has is not fetched again."""
    pins = dict(
        line.split("==") for line in (ROOT / "requirements" / "develop.in").read_text("utf-8").split() if "==" in line
    )
    folder = ROOT / "build" / "wheels" / platform_name / python / f"{package}-{pins[package]}"
    if not list(folder.glob("*.whl")):
        run_pip_download(folder, f"{package}=={pins[package]}", TAGS[platform_name], python)
    return list(folder.glob("*.whl"))


def run_pip_download(folder: Path, requirement: str, tag: str, python: str) -> None:
    """Fetch one wheel of another platform or Python."""
    arguments = ["--quiet", "--disable-pip-version-check", "--only-binary=:all:", "--no-deps"]
    arguments += ["--platform", tag, "--python-version", python, "--dest", str(folder), requirement]
    subprocess.run([sys.executable, "-m", "pip", "download", *arguments], check=True)


def lay_out(stage: Path, wheels: list[Path]) -> None:
    """Copy what ships into an empty folder."""
    for name in SHIPPED:
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, stage / name, ignore=shutil.ignore_patterns(*LEFT_OUT))
        else:
            shutil.copy2(ROOT / name, stage / name)
    write_manual(ROOT / "docs", stage / "manual")
    (stage / "wheels").mkdir()
    for wheel in wheels:
        shutil.copy2(wheel, stage / "wheels" / wheel.name)


def complete_manifest(path: Path, platforms: list[str], wheels: list[Path]) -> None:
    """Write the platforms that are built and their wheels into the staged manifest."""
    lines = path.read_text("utf-8").splitlines()
    at = next(i for i, line in enumerate(lines) if line.startswith("platforms = "))
    listed = "".join(f'    "./wheels/{wheel.name}",\n' for wheel in wheels)
    names = ", ".join(f'"{name}"' for name in platforms)
    lines[at] = f"platforms = [{names}]\nwheels = [\n{listed}]"
    path.write_text("\n".join(lines) + "\n", "utf-8")


def blender_tool(*arguments: str) -> None:
    """Run Blender's extension tool; it is plain Python inside the bpy wheel."""
    found = importlib.util.find_spec("bpy")
    if found is None or found.origin is None:
        raise SystemExit("build_extension.py needs bpy: pip install facial-retarget[blender]")
    tool = next(Path(found.origin).parent.glob("*/scripts/addons_core/bl_pkg/cli/blender_ext.py"))
    subprocess.run([sys.executable, str(tool), *arguments], check=True)


if __name__ == "__main__":
    main()
