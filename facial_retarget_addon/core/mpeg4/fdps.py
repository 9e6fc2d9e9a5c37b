"""The 84 Facial Definition Points of MPEG-4 (ISO/IEC 14496-2), as plain data. Left is the subject's left."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Fdp:
    """A Facial Definition Point.

    Attributes
    ----------
    name : group and number, as "2.1".
    meaning : where it lies, in our words.
    partner : the point of the other half of the face, itself on the middle line.
    place : what the standard asks of its coordinates, "" for nothing.
    anchored : no FAP moves it and it sits on bone or on a rim: it holds the skin around it.
    rides_on : the point whose motion it shares before its own is added, "" for none. FAP 3 moves the chin's bottom;
        without this the chin's boss would stay behind.
    """

    name: str
    meaning: str
    partner: str
    place: str = ""
    anchored: bool = False
    rides_on: str = ""


FDPS: dict[str, Fdp] = {
    "2.1": Fdp("2.1", "", "2.1"),
    "2.2": Fdp("2.2", "", "2.2"),
    "2.3": Fdp("2.3", "", "2.3"),
    "2.4": Fdp("2.4", "", "2.5"),
    "2.5": Fdp("2.5", "", "2.4"),
    "2.6": Fdp("2.6", "", "2.7"),
    "2.7": Fdp("2.7", "", "2.6"),
    "2.8": Fdp("2.8", "", "2.9"),
    "2.9": Fdp("2.9", "", "2.8"),
    "2.10": Fdp("2.10", "", "2.10", rides_on="2.1"),
    "2.11": Fdp("2.11", "", "2.12", rides_on="2.1"),
    "2.12": Fdp("2.12", "", "2.11", rides_on="2.1"),
    "2.13": Fdp("2.13", "", "2.14", anchored=True),
    "2.14": Fdp("2.14", "", "2.13", anchored=True),
    "3.1": Fdp("3.1", "", "3.2"),
    "3.2": Fdp("3.2", "", "3.1"),
    "3.3": Fdp("3.3", "", "3.4"),
    "3.4": Fdp("3.4", "", "3.3"),
    "3.5": Fdp("3.5", "", "3.6"),
    "3.6": Fdp("3.6", "", "3.5"),
    "3.7": Fdp("3.7", "", "3.12", anchored=True),
    "3.8": Fdp("3.8", "", "3.11", anchored=True),
    "3.9": Fdp("3.9", "", "3.10"),
    "3.10": Fdp("3.10", "", "3.9"),
    "3.11": Fdp("3.11", "", "3.8", anchored=True),
    "3.12": Fdp("3.12", "", "3.7", anchored=True),
    "3.13": Fdp("3.13", "", "3.14"),
    "3.14": Fdp("3.14", "", "3.13"),
    "4.1": Fdp("4.1", "", "4.2"),
    "4.2": Fdp("4.2", "", "4.1"),
    "4.3": Fdp("4.3", "", "4.4"),
    "4.4": Fdp("4.4", "", "4.3"),
    "4.5": Fdp("4.5", "", "4.6"),
    "4.6": Fdp("4.6", "", "4.5"),
    "5.1": Fdp("5.1", "", "5.2"),
    "5.2": Fdp("5.2", "", "5.1"),
    "5.3": Fdp("5.3", "", "5.4"),
    "5.4": Fdp("5.4", "", "5.3"),
    "6.1": Fdp("6.1", "", "6.1"),
    "6.2": Fdp("6.2", "", "6.2"),
    "6.3": Fdp("6.3", "", "6.4"),
    "6.4": Fdp("6.4", "", "6.3"),
    "7.1": Fdp("7.1", "", "7.1"),
    "8.1": Fdp("8.1", "", "8.1"),
    "8.2": Fdp("8.2", "", "8.2"),
    "8.3": Fdp("8.3", "", "8.4"),
    "8.4": Fdp("8.4", "", "8.3"),
    "8.5": Fdp("8.5", "", "8.6"),
    "8.6": Fdp("8.6", "", "8.5"),
    "8.7": Fdp("8.7", "", "8.8"),
    "8.8": Fdp("8.8", "", "8.7"),
    "8.9": Fdp("8.9", "", "8.10"),
    "8.10": Fdp("8.10", "", "8.9"),
    "9.1": Fdp("9.1", "", "9.2"),
    "9.2": Fdp("9.2", "", "9.1"),
    "9.3": Fdp("9.3", "", "9.3"),
    "9.4": Fdp("9.4", "", "9.5"),
    "9.5": Fdp("9.5", "", "9.4"),
    "9.6": Fdp("9.6", "", "9.7", anchored=True),
    "9.7": Fdp("9.7", "", "9.6", anchored=True),
    "9.8": Fdp("9.8", "", "9.8"),
    "9.9": Fdp("9.9", "", "9.9"),
    "9.10": Fdp("9.10", "", "9.10"),
    "9.11": Fdp("9.11", "", "9.11"),
    "9.12": Fdp("9.12", "", "9.12", anchored=True),
    "9.13": Fdp("9.13", "", "9.14", anchored=True),
    "9.14": Fdp("9.14", "", "9.13", anchored=True),
    "9.15": Fdp("9.15", "", "9.15"),
    "10.1": Fdp("10.1", "", "10.2"),
    "10.2": Fdp("10.2", "", "10.1"),
    "10.3": Fdp("10.3", "", "10.4"),
    "10.4": Fdp("10.4", "", "10.3"),
    "10.5": Fdp("10.5", "", "10.6"),
    "10.6": Fdp("10.6", "", "10.5"),
    "10.7": Fdp("10.7", "", "10.8", anchored=True),
    "10.8": Fdp("10.8", "", "10.7", anchored=True),
    "10.9": Fdp("10.9", "", "10.10", anchored=True),
    "10.10": Fdp("10.10", "", "10.9", anchored=True),
    "11.1": Fdp("11.1", "", "11.1", anchored=True),
    "11.2": Fdp("11.2", "", "11.3", anchored=True),
    "11.3": Fdp("11.3", "", "11.2", anchored=True),
    "11.4": Fdp("11.4", "", "11.4", anchored=True),
    "11.5": Fdp("11.5", "", "11.5", anchored=True),
    "11.6": Fdp("11.6", "", "11.6", anchored=True),
}
"""Name -> point."""
