"""Sentences that arrive with their values filled in, found by the pattern that they fit. No bpy.

The core knows no languages: it raises `RetargetError` and gives warnings in whole English sentences, which the command
line shows as they are. Where Blender shows them, the pattern is found again, and filled in anew in another language.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import lru_cache
from string import Formatter

SENTENCE_JOINT, NAME_JOINT, LIST_JOINT = "; ", ": ", ", "
"""What stands between sentences in one line, between a name and what is said of it, and between phrases."""

VALUE = rf"((?:(?!{SENTENCE_JOINT}).)*?)"
"""A value is never more than one sentence ..."""
FIRST = rf"((?:(?!{SENTENCE_JOINT}|{NAME_JOINT}).)*?)"
"""... and where it begins one, no name of which the sentence is said stands before it."""

Pattern = tuple[re.Pattern[str], str]


class Sentences:
    """The sentences of a language.

    Parameters
    ----------
    sentences : English pattern -> pattern of the language. {} stands for a value; in the language also {0}, {1}, and
        {:said} or {0:said} where the value itself is one of the sentences or phrases.
    phrases : the same for what is only said as a value.
    """

    def __init__(self, sentences: Mapping[str, str], phrases: Mapping[str, str]) -> None:
        self._sentences = dict(sentences)
        self._all = self._sentences | dict(phrases)
        self._patterns: dict[int, list[Pattern]] = {}
        self.told = lru_cache(maxsize=1000)(self._told)

    def _told(self, line: str) -> str:
        """A sentence in the language, or several in one line, named or not; what fits no pattern stays as it is."""
        whole = self._whole(line, self._sentences)
        if whole is not None:
            return whole
        if SENTENCE_JOINT in line:
            return SENTENCE_JOINT.join(map(self.told, line.split(SENTENCE_JOINT)))
        name, joint, rest = line.partition(NAME_JOINT)
        return f"{self.said(name)}{joint}{self.told(rest)}" if joint else line

    def said(self, value: str) -> str:
        """A value of a sentence in the language, or several with commas between."""
        whole = self._whole(value, self._all)
        if whole is not None:
            return whole
        return LIST_JOINT.join(map(self.said, value.split(LIST_JOINT))) if LIST_JOINT in value else value

    def _whole(self, text: str, known: dict[str, str]) -> str | None:
        if text in known:
            return known[text]
        for pattern, answer in self._compiled(known):
            values = pattern.fullmatch(text)
            if values:
                return answer.format(*(_Value(value, self) for value in values.groups()))
        return None

    def _compiled(self, known: dict[str, str]) -> list[Pattern]:
        """Those with values; what has the most words of its own comes first, since it fits the least."""
        if id(known) not in self._patterns:
            tightest = sorted((english for english in known if "{" in english), key=_words, reverse=True)
            self._patterns[id(known)] = [(_regular(english), known[english]) for english in tightest]
        return self._patterns[id(known)]


class _Value(str):
    """A value of a sentence, which can be said in the language too."""

    def __new__(cls, text: str, language: Sentences) -> _Value:
        value = super().__new__(cls, text)
        value._language = language
        return value

    def __format__(self, how: str) -> str:
        return self._language.said(str(self)) if how == "said" else str(self)


def _regular(pattern: str) -> re.Pattern[str]:
    """The expression whose groups are the values; one that another follows at once ends where a word does."""
    pieces = [re.escape(words) + ("" if field is None else VALUE) for words, field, _, _ in Formatter().parse(pattern)]
    if pieces[0] == VALUE:
        pieces[0] = FIRST
    return re.compile("".join(pieces).replace(VALUE + VALUE, rf"(\S*){VALUE}"), re.DOTALL)


def _words(pattern: str) -> int:
    """Characters beside the values."""
    return sum(len(words) for words, _, _, _ in Formatter().parse(pattern))
