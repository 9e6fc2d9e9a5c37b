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
    place : what the standard asks of its coordinates on a neutral face, "" for nothing: x, y and z are the head's
        axes, and "x of 7.1" is the same x as that point's.
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
    "2.1": Fdp("2.1", "lowest point of the chin", "2.1", "x of 7.1"),
    "2.2": Fdp("2.2", "upper lip's inner edge, middle", "2.2", "x of 7.1"),
    "2.3": Fdp("2.3", "lower lip's inner edge, middle", "2.3", "x of 7.1"),
    "2.4": Fdp("2.4", "left corner of the lips' inner edge", "2.5"),
    "2.5": Fdp("2.5", "right corner of the lips' inner edge", "2.4"),
    "2.6": Fdp("2.6", "upper lip's inner edge, halfway to the left corner", "2.7", "x midway 2.2 and 2.4"),
    "2.7": Fdp("2.7", "upper lip's inner edge, halfway to the right corner", "2.6", "x midway 2.2 and 2.5"),
    "2.8": Fdp("2.8", "lower lip's inner edge, halfway to the left corner", "2.9", "x midway 2.3 and 2.4"),
    "2.9": Fdp("2.9", "lower lip's inner edge, halfway to the right corner", "2.8", "x midway 2.3 and 2.5"),
    "2.10": Fdp("2.10", "boss of the chin, its foremost point", "2.10", "x of 7.1", rides_on="2.1"),
    "2.11": Fdp("2.11", "left corner of the chin", "2.12", "x between 8.7 and 8.3", rides_on="2.1"),
    "2.12": Fdp("2.12", "right corner of the chin", "2.11", "x between 8.4 and 8.8", rides_on="2.1"),
    "2.13": Fdp("2.13", "left angle of the jaw bone", "2.14", anchored=True),
    "2.14": Fdp("2.14", "right angle of the jaw bone", "2.13", anchored=True),
    "3.1": Fdp("3.1", "left upper lid's inner edge, middle", "3.2", "x midway 3.7 and 3.11"),
    "3.2": Fdp("3.2", "right upper lid's inner edge, middle", "3.1", "x midway 3.8 and 3.12"),
    "3.3": Fdp("3.3", "left lower lid's inner edge, middle", "3.4", "x midway 3.7 and 3.11"),
    "3.4": Fdp("3.4", "right lower lid's inner edge, middle", "3.3", "x midway 3.8 and 3.12"),
    "3.5": Fdp("3.5", "left pupil, centre", "3.6"),
    "3.6": Fdp("3.6", "right pupil, centre", "3.5"),
    "3.7": Fdp("3.7", "left eye's left corner, the outer one", "3.12", anchored=True),
    "3.8": Fdp("3.8", "right eye's left corner, the one at the nose", "3.11", anchored=True),
    "3.9": Fdp("3.9", "left lower lid's outer edge, middle", "3.10", "x midway 3.7 and 3.11"),
    "3.10": Fdp("3.10", "right lower lid's outer edge, middle", "3.9", "x midway 3.8 and 3.12"),
    "3.11": Fdp("3.11", "left eye's right corner, the one at the nose", "3.8", anchored=True),
    "3.12": Fdp("3.12", "right eye's right corner, the outer one", "3.7", anchored=True),
    "3.13": Fdp("3.13", "left upper lid's outer edge, middle", "3.14", "x midway 3.7 and 3.11"),
    "3.14": Fdp("3.14", "right upper lid's outer edge, middle", "3.13", "x midway 3.8 and 3.12"),
    "4.1": Fdp("4.1", "left brow's inner end", "4.2"),
    "4.2": Fdp("4.2", "right brow's inner end", "4.1"),
    "4.3": Fdp("4.3", "left brow's highest point", "4.4", "x midway 4.1 and 4.5, or of the contour's top"),
    "4.4": Fdp("4.4", "right brow's highest point", "4.3", "x midway 4.2 and 4.6, or of the contour's top"),
    "4.5": Fdp("4.5", "left brow's outer end", "4.6"),
    "4.6": Fdp("4.6", "right brow's outer end", "4.5"),
    "5.1": Fdp("5.1", "middle of the left cheek", "5.2", "y of 8.3"),
    "5.2": Fdp("5.2", "middle of the right cheek", "5.1", "y of 8.4"),
    "5.3": Fdp("5.3", "left cheek bone", "5.4", "x between 3.5 and 3.7; y between 9.15 and 9.12"),
    "5.4": Fdp("5.4", "right cheek bone", "5.3", "x between 3.12 and 3.6; y between 9.15 and 9.12"),
    "6.1": Fdp("6.1", "tip of the tongue", "6.1", "x of 7.1"),
    "6.2": Fdp("6.2", "middle of the tongue's body", "6.2", "x of 7.1"),
    "6.3": Fdp("6.3", "left edge of the tongue", "6.4", "z of 6.2"),
    "6.4": Fdp("6.4", "right edge of the tongue", "6.3", "z of 6.2"),
    "7.1": Fdp("7.1", "top of the spine, about which the head turns", "7.1"),
    "8.1": Fdp("8.1", "upper lip's outer edge, middle", "8.1", "x of 7.1"),
    "8.2": Fdp("8.2", "lower lip's outer edge, middle", "8.2", "x of 7.1"),
    "8.3": Fdp("8.3", "left corner of the lips' outer edge", "8.4"),
    "8.4": Fdp("8.4", "right corner of the lips' outer edge", "8.3"),
    "8.5": Fdp("8.5", "upper lip's outer edge, halfway to the left corner", "8.6", "x midway 8.3 and 8.1"),
    "8.6": Fdp("8.6", "upper lip's outer edge, halfway to the right corner", "8.5", "x midway 8.4 and 8.1"),
    "8.7": Fdp("8.7", "lower lip's outer edge, halfway to the left corner", "8.8", "x midway 8.3 and 8.2"),
    "8.8": Fdp("8.8", "lower lip's outer edge, halfway to the right corner", "8.7", "x midway 8.4 and 8.2"),
    "8.9": Fdp("8.9", "right peak of the Cupid's bow", "8.10"),
    "8.10": Fdp("8.10", "left peak of the Cupid's bow", "8.9"),
    "9.1": Fdp("9.1", "left nostril's outer border", "9.2"),
    "9.2": Fdp("9.2", "right nostril's outer border", "9.1"),
    "9.3": Fdp("9.3", "tip of the nose", "9.3", "x of 7.1"),
    "9.4": Fdp("9.4", "nose's base, right edge", "9.5", anchored=True),
    "9.5": Fdp("9.5", "nose's base, left edge", "9.4", anchored=True),
    "9.6": Fdp("9.6", "nose bone, right upper edge", "9.7", anchored=True),
    "9.7": Fdp("9.7", "nose bone, left upper edge", "9.6", anchored=True),
    "9.8": Fdp("9.8", "upper teeth, top", "9.8", "x of 7.1"),
    "9.9": Fdp("9.9", "lower teeth, bottom", "9.9", "x of 7.1"),
    "9.10": Fdp("9.10", "upper teeth, bottom", "9.10", "x of 7.1"),
    "9.11": Fdp("9.11", "lower teeth, top", "9.11", "x of 7.1"),
    "9.12": Fdp(
        "9.12",
        "nose bone's lower end in the middle, or the nose's bump",
        "9.12",
        "x of 7.1; y midway 9.6 and 9.3, or of the bump",
        anchored=True,
    ),
    "9.13": Fdp("9.13", "nose bone's lower end, left", "9.14", "y midway 9.6 and 9.3", anchored=True),
    "9.14": Fdp("9.14", "nose bone's lower end, right", "9.13", "y midway 9.6 and 9.3", anchored=True),
    "9.15": Fdp("9.15", "nose's base in the middle, where the upper lip begins", "9.15", "x of 7.1", anchored=True),
    "10.1": Fdp("10.1", "left ear, top", "10.2"),
    "10.2": Fdp("10.2", "right ear, top", "10.1"),
    "10.3": Fdp("10.3", "left ear, rearmost point", "10.4", "y midway 10.1 and 10.5"),
    "10.4": Fdp("10.4", "right ear, rearmost point", "10.3", "y midway 10.2 and 10.6"),
    "10.5": Fdp("10.5", "left ear lobe, bottom", "10.6"),
    "10.6": Fdp("10.6", "right ear lobe, bottom", "10.5"),
    "10.7": Fdp("10.7", "left ear lobe, lower end of its joint with the face", "10.8", anchored=True),
    "10.8": Fdp("10.8", "right ear lobe, lower end of its joint with the face", "10.7", anchored=True),
    "10.9": Fdp("10.9", "left ear, upper end of its joint with the face", "10.10", anchored=True),
    "10.10": Fdp("10.10", "right ear, upper end of its joint with the face", "10.9", anchored=True),
    "11.1": Fdp("11.1", "hairline above the forehead, middle", "11.1", "x of 7.1", anchored=True),
    "11.2": Fdp("11.2", "hairline above the forehead, right", "11.3", "x right of 4.4", anchored=True),
    "11.3": Fdp("11.3", "hairline above the forehead, left", "11.2", "x left of 4.3", anchored=True),
    "11.4": Fdp("11.4", "top of the skull", "11.4", "x of 7.1; z between 10.4 and 10.2", anchored=True),
    "11.5": Fdp("11.5", "top of the hair, over the top of the skull", "11.5", "x of 11.4; z of 11.4", anchored=True),
    "11.6": Fdp("11.6", "back of the skull", "11.6", "x of 7.1; y of 3.5", anchored=True),
}
"""Name -> point."""
