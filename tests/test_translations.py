"""Translations: complete for the guide and the panels, without dead entries, with the fields of the English."""

import ast
import re
from importlib import util
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parent.parent
PACKAGE = REPOSITORY / "facial_retarget_addon"
FIELD = re.compile(r"{[^}]*}")


def texts(language: str) -> dict[str, str]:
    """A language's table, loaded without Blender."""
    spec = util.spec_from_file_location(language, PACKAGE / "translations" / f"{language}.py")
    module = util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.TEXTS


def strings(path: Path) -> set[str]:
    """All texts in a file's code."""
    nodes = ast.walk(ast.parse(path.read_text("utf-8")))
    return {node.value for node in nodes if isinstance(node, ast.Constant) and isinstance(node.value, str)}


def advised() -> set[str]:
    """What the guide may say."""
    found = set()
    for node in ast.walk(ast.parse((PACKAGE / "guide.py").read_text("utf-8"))):
        if isinstance(node, ast.FunctionDef):
            said = {text.value for text in ast.walk(node) if isinstance(text, ast.Constant)} - {ast.get_docstring(node)}
            found |= {text for text in said if isinstance(text, str) and " " in text}
    return found


def titles() -> set[str]:
    """The panels' titles, but for names that are the same in every language."""
    found = set()
    for path in (REPOSITORY / "panels").glob("*.py"):
        found |= set(re.findall(r'bl_label = "([^"]+)"', path.read_text("utf-8")))
    return found - {"FAPs", "Facial Retarget", "Next", "Bake"}


LANGUAGES = sorted(path.stem for path in (PACKAGE / "translations").glob("[a-z]*.py"))


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_guide_and_the_titles_are_complete(language: str) -> None:
    assert not (advised() | titles()) - texts(language).keys()


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_entry_is_dead(language: str) -> None:
    files = [*PACKAGE.glob("*.py"), *(REPOSITORY / "operators").glob("*.py"), *(REPOSITORY / "panels").glob("*.py")]
    assert not texts(language).keys() - set().union(*map(strings, files))


@pytest.mark.parametrize("language", LANGUAGES)
def test_fields_are_kept(language: str) -> None:
    for english, text in texts(language).items():
        assert sorted(FIELD.findall(text)) == sorted(FIELD.findall(english)), english
