"""The house's rules, held by machine: who may import whom, and what every room keeps out."""

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parent.parent
PACKAGE = REPOSITORY / "facial_retarget_addon"
ROOMS = {
    "core": ({"numpy", "scipy", "embreex"}, {"core"}),
    "files": ({"numpy", "c3d"}, {"core", "files"}),
    "demo": ({"numpy", "scipy"}, {"core", "demo"}),
    "bridge": (
        {"numpy", "bpy", "mathutils", "bpy_extras"},
        {"core", "files", "bridge", "export_losses", "fap_controls", "guide", "preview_state", "properties", "demo"},
    ),
    "viewport": (
        {"numpy", "bpy", "mathutils", "bpy_extras", "gpu", "gpu_extras", "blf"},
        {"core", "bridge", "properties", "translations", "viewport"},
    ),
}
"""Room -> the packages from outside it may import, and the rooms it may import."""


def imports(path: Path) -> Iterator[tuple[str, int]]:
    """(module, level) of each import in a file; level 0 is absolute."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from ((alias.name, 0) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            names = [node.module] if node.module else [alias.name for alias in node.names]
            yield from ((name, node.level) for name in names)


def modules(folder: Path) -> list[Path]:
    return sorted(folder.rglob("*.py"))


def extension_modules() -> list[Path]:
    return [
        REPOSITORY / "__init__.py",
        *modules(PACKAGE),
        *modules(REPOSITORY / "operators"),
        *modules(REPOSITORY / "panels"),
    ]


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_imports_only_what_it_may(room: str) -> None:
    packages, rooms = ROOMS[room]
    wrong = []
    for path in modules(PACKAGE / room):
        parts = path.relative_to(PACKAGE).with_suffix("").parts
        for name, level in imports(path):
            if level == 0:
                top = name.split(".")[0]
                if top not in packages and top not in sys.stdlib_module_names:
                    wrong.append(f"{path.name}: {name}")
            else:
                reached = (*parts[:-level], *name.split("."))
                if len(parts) > level - 1 and reached[0] not in rooms:
                    wrong.append(f"{path.name}: {'.' * level}{name}")
    assert not wrong


def test_the_extension_imports_itself_relatively() -> None:
    wrong = [
        f"{path.relative_to(REPOSITORY)}: {name}"
        for path in extension_modules()
        for name, level in imports(path)
        if level == 0 and name.split(".")[0] in {"facial_retarget_addon", "operators", "panels"}
    ]
    assert not wrong


def test_panels_hold_no_logic() -> None:
    wrong = [
        f"{path.name}: {name}"
        for path in modules(REPOSITORY / "panels")
        for name, _ in imports(path)
        if name.split(".")[0] in {"numpy", "scipy", "bridge", "core"}
    ]
    assert not wrong


def test_core_and_files_load_without_blender_and_c3d() -> None:
    program = """
import importlib, pkgutil, sys
import facial_retarget_addon
for name in ("core", "files", "demo"):
    room = importlib.import_module(f"facial_retarget_addon.{name}")
    for module in pkgutil.walk_packages(room.__path__, room.__name__ + "."):
        importlib.import_module(module.name)
sys.exit(", ".join(sorted({"bpy", "mathutils", "c3d"} & set(sys.modules))) or None)
"""
    run = subprocess.run([sys.executable, "-c", program], cwd=REPOSITORY, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr


def test_what_panels_need_loads_without_scipy() -> None:
    program = """
import sys
import facial_retarget_addon.core.methods, facial_retarget_addon.core.methods.settings
import facial_retarget_addon.fap_controls
sys.exit(", ".join(sorted({"numpy", "scipy", "embreex"} & set(sys.modules))) or None)
"""
    run = subprocess.run([sys.executable, "-c", program], cwd=REPOSITORY, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr


def test_every_public_function_of_the_core_says_what_it_does() -> None:
    silent = []
    for path in modules(PACKAGE / "core"):
        for node in ast.walk(ast.parse(path.read_text())):
            if (
                isinstance(node, ast.FunctionDef | ast.ClassDef)
                and not node.name.startswith("_")
                and not ast.get_docstring(node)
                and node.col_offset == 0
            ):
                silent.append(f"{path.name}: {node.name}")
    assert not silent
