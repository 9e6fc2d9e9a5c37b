"""Translations are complete, and their texts have the fields of the English ones.

What registered classes say (names, tooltips, choices) is compared in tests/blender/scenarios/translations.py; here
stands what panels draw and what operators report, read off the code.
"""

import ast
import importlib
import sys
from collections.abc import Iterator
from itertools import count
from pathlib import Path
from string import Formatter
from types import ModuleType

import pytest

REPOSITORY = Path(__file__).resolve().parent.parent
PACKAGE = REPOSITORY / "facial_retarget_addon"
TRANSLATIONS = PACKAGE / "translations"
LANGUAGES = sorted(path.parent.name for path in TRANSLATIONS.glob("*/__init__.py"))

DRAWN = {"filled", "pgettext_iface", "poll_message_set"}
"""Functions whose first argument is a text of the interface."""
SHOWN = {"text", "heading", "message", "confirm_text"}
"""Keywords whose value is one."""
NAMED = {"doing", "missing", "bl_label", "bl_description"}
"""Attributes of classes that are one."""
CHECKS = ("checks", "doubts", "example_states")
"""Modules of the core that only list what is wrong."""


# Loading them imports no bpy: only the package around them does.
sys.modules["translated"] = package = ModuleType("translated")
package.__path__ = [str(TRANSLATIONS)]
Sentences = importlib.import_module("translated.sentences").Sentences


def language(name: str) -> ModuleType:
    """A language's texts."""
    return importlib.import_module(f"translated.{name}")


def trees(*places: Path) -> Iterator[ast.AST]:
    """The nodes of the code at these places."""
    for place in places:
        for path in sorted(place.rglob("*.py")) if place.is_dir() else [place]:
            yield from ast.walk(ast.parse(path.read_text("utf-8")))


INTERFACE = (
    REPOSITORY / "panels",
    REPOSITORY / "operators",
    PACKAGE / "viewport",
    PACKAGE / "properties",
    *sorted(PACKAGE.glob("*.py")),
)
"""Code that draws. Blender's rooms; what the bridge and the core say arrives as sentences."""


def patterns(said: ast.AST | None) -> Iterator[str]:
    """The texts that an expression can be, with {} for each value."""
    if isinstance(said, ast.Constant) and isinstance(said.value, str):
        yield said.value
    elif isinstance(said, ast.JoinedStr):
        yield "".join(piece.value if isinstance(piece, ast.Constant) else "{}" for piece in said.values)
    elif isinstance(said, ast.IfExp):
        yield from patterns(said.body)
        yield from patterns(said.orelse)
    elif isinstance(said, ast.BoolOp | ast.BinOp):
        for part in getattr(said, "values", ()) or (said.left, said.right):
            yield from patterns(part)


def called(node: ast.Call) -> str:
    """The name of what is called, without what it belongs to."""
    return node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")


def drawn() -> set[str]:
    """Texts of the interface that the code names where it draws them."""
    found: set[str] = set()
    for node in trees(*INTERFACE):
        if isinstance(node, ast.Call):
            for keyword in node.keywords:
                found.update(patterns(keyword.value) if keyword.arg in SHOWN else ())
            found.update(patterns(node.args[0]) if called(node) in DRAWN and node.args else ())
            if called(node) == "report" and len(node.args) == 2 and isinstance(node.args[1], ast.Constant):
                found.add(node.args[1].value)
        if isinstance(node, ast.Assign):
            for target in node.targets:
                names, values = (
                    (target.elts, getattr(node.value, "elts", ()))
                    if isinstance(target, ast.Tuple)
                    else ([target], [node.value])
                )
                for name, value in zip(names, values, strict=False):
                    found.update(patterns(value) if getattr(name, "id", "") in NAMED else ())
    return {text for text in found if any(letter.isalpha() for letter in plain(text))}


def plain(text: str) -> str:
    """What is left of a text without its fields."""
    return "".join(words for words, _, _, _ in Formatter().parse(text))


def advised() -> set[str]:
    """What the guide may say."""
    found = set()
    for node in trees(PACKAGE / "guide.py", PACKAGE / "time_left.py", PACKAGE / "bake_cost.py"):
        if isinstance(node, ast.FunctionDef):
            said = {text for part in node.body[1:] for one in ast.walk(part) for text in patterns(one)}
            found |= {text for text in said if " " in text}
    return found


def reported() -> set[str]:
    """Sentences with {} for each value: errors, warnings, what operators tell, and what is being done.

    Those that tell the shapes of arrays are for programs; those of job files and file formats may stay English.
    """
    found: set[str] = set()
    rooms = (REPOSITORY / "operators", PACKAGE / "viewport", PACKAGE / "bridge")
    for node in trees(*rooms, *(PACKAGE / "core" / f"{name}.py" for name in CHECKS)):
        if isinstance(node, ast.Yield) and isinstance(node.value, ast.Tuple):
            found.update(patterns(node.value.elts[-1]))
        if isinstance(node, ast.Call) and node.args:
            whole = ast.unparse(node.func)
            says = called(node) in ("RetargetError", "told") or whole.endswith(("warnings.append", "said.append"))
            found.update(patterns(node.args[0]) if says else ())
            found.update(patterns(node.args[-1]) if whole == "progress" else ())
    for node in trees(PACKAGE / "core"):
        if isinstance(node, ast.Call) and node.args:
            if ast.unparse(node.func) == "progress":
                found.update(patterns(node.args[-1]))
            if called(node) == "RetargetError" and ".shape" not in ast.unparse(node.args[0]):
                found.update(patterns(node.args[0]))
    return {text for text in found if any(letter.isalpha() for letter in plain(text))}


@pytest.mark.parametrize("name", LANGUAGES)
def test_what_is_drawn_is_translated(name: str) -> None:
    missing = sorted((drawn() | advised()) - language(name).TEXTS.keys())
    assert not missing, "\n".join(missing)


@pytest.mark.parametrize("name", LANGUAGES)
def test_what_is_reported_is_translated(name: str) -> None:
    texts = language(name)
    missing = sorted(reported() - texts.SENTENCES.keys() - texts.PHRASES.keys() - texts.TEXTS.keys())
    assert not missing, "\n".join(missing)


def test_reports_are_told() -> None:
    """Blender itself looks up reports without values alone, and what poll functions say not at all."""
    for node in trees(REPOSITORY / "operators"):
        if isinstance(node, ast.Call) and called(node) in ("report", "poll_message_set") and node.args:
            said = node.args[-1]
            fixed = isinstance(said, ast.Constant) and called(node) == "report"
            assert fixed or (isinstance(said, ast.Call) and called(said) in ("told", "filled")), ast.unparse(node)


@pytest.mark.parametrize("name", LANGUAGES)
def test_fields_are_kept(name: str) -> None:
    texts = language(name)
    for english, text in texts.TEXTS.items():
        assert fields(text) == fields(english), english
    for english, text in (texts.SENTENCES | texts.PHRASES).items():
        assert {field for field, _ in fields(text)} == {field for field, _ in fields(english)}, english


def fields(text: str) -> list[tuple[str, str]]:
    """The fields of a text with how they are written; those without a name are counted."""
    numbers = count()
    parsed = [(field, how) for _, field, how, _ in Formatter().parse(text) if field is not None]
    return sorted((field or str(next(numbers)), how or "") for field, how in parsed)


@pytest.mark.parametrize("name", LANGUAGES)
def test_parts_of_a_language_agree(name: str) -> None:
    """One English text has one translation, whichever module it stands in."""
    texts = language(name)
    for parts, table in ((texts.PARTS, "TEXTS"), (texts.SAYING, "SENTENCES"), (texts.SAYING, "PHRASES")):
        known: dict[str, str] = {}
        for part in parts:
            for english, text in getattr(part, table, {}).items():
                assert known.setdefault(english, text) == text, f"{part.__name__}: {english}"


SENTENCES = Sentences(
    {"{} has {} points": "{1} Punkte hat {0:said}", "it is full": "es ist voll", "made{}{}": "gemacht{:said}{:said}"},
    {"head": "Kopf", "object {}": "Objekt {}", " onto {}": " auf {}", "{} kept": "{} behalten"},
)


@pytest.mark.parametrize(
    ("english", "german"),
    [
        ("it is full", "es ist voll"),
        ("object 'a' has 3 points", "3 Punkte hat Objekt 'a'"),
        ("'head' has 3 points", "3 Punkte hat 'head'"),
        ("head has 3 points; it is full", "3 Punkte hat Kopf; es ist voll"),
        ("left: it is full", "left: es ist voll"),
        ("left: head has 3 points", "left: 3 Punkte hat Kopf"),
        ("head: it is full: head", "Kopf: es ist voll: head"),
        ("made, 3 kept", "gemacht, 3 behalten"),
        ("made onto x", "gemacht auf x"),
        ("object 'a' is unknown", "object 'a' is unknown"),
        ("100 % of {} has 3 points", "3 Punkte hat 100 % of {}"),
        ("", ""),
    ],
)
def test_sentences_are_found_with_their_values(english: str, german: str) -> None:
    assert SENTENCES.told(english) == german


def test_the_tightest_pattern_is_taken() -> None:
    told = Sentences({"{} is {}": "lose", "{} is not {}": "fest"}, {}).told
    assert told("a is not b") == "fest"
    assert told("a is b") == "lose"
