"""Feature points: what they are called, and where on a face they lie. Left and right are the subject's."""

import re

_SWAPS = (("Left", "Right", "Link", "Recht"), ("left", "right", "link", "recht"))


def _other_side(english: str, german: str) -> tuple[str, str]:
    """The same texts about the other half of the face: left and right change places."""
    for left, right, links, rechts in _SWAPS:
        english = re.sub(rf"\b({left}|{right})\b", lambda found, a=left, b=right: b if found[0] == a else a, english)
        german = re.sub(rf"\b({links}|{rechts})", lambda found, a=links, b=rechts: b if found[0] == a else a, german)
    return english, german


_ONE_SIDE = {
    # Labels.
    "Left Outer Eye Corner": "Linkes Auge außen",
    "Left Mouth Corner": "Linker Mundwinkel",
    "Left Inner Eye Corner": "Linkes Auge innen",
    "Left Brow Top": "Linke Braue oben",
    "Left Jaw Angle": "Linker Kieferwinkel",
    "Left Upper Lid": "Linkes Oberlid",
    "Left Lower Lid": "Linkes Unterlid",
    "Left Inner Brow": "Linke Braue innen",
    "Left Outer Brow": "Linke Braue außen",
    "Left Nostril Wing": "Linker Nasenflügel",
    "Left Mouth Corner Inside": "Mundwinkel innen links",
    "Left Cupid's Bow": "Linker Amorbogen",
    "Left Upper Lip Side": "Oberlippe links",
    "Left Lower Lip Side": "Unterlippe links",
    "Left Upper Lip Inside": "Oberlippe innen links",
    "Left Lower Lip Inside": "Unterlippe innen links",
    "Left Cheek": "Linke Wange",
    "Left Cheek Bone": "Linkes Jochbein",
    "Left Hairline": "Linker Haaransatz",
    "Left Forehead": "Linke Stirn",
    "Left Outer Cheek": "Linke Wange außen",
    "Left Jaw Muscle": "Linker Kaumuskel",
    "Left Upper Lid Inner": "Linkes Oberlid innen",
    "Left Upper Lid Outer": "Linkes Oberlid außen",
    "Left Lower Lid Inner": "Linkes Unterlid innen",
    "Left Lower Lid Outer": "Linkes Unterlid außen",
    "Left Lid Crease": "Linke Lidfalte",
    "Left Inner Under-Eye": "Linker Augenring innen",
    "Left Outer Under-Eye": "Linker Augenring außen",
    "Left Middle Brow": "Linke Braue Mitte",
    "Left Nose Side": "Linke Nasenseite",
    "Left Nose Wing": "Linker Nasenflügel oben",
    "Left Nostril": "Linkes Nasenloch",
    "Left Above the Lip": "Über der Lippe links",
    "Left Smile Line": "Linke Lachfalte",
    "Left Beside the Mouth": "Links neben dem Mund",
    "Left Inner Cheek": "Linke Wange innen",
    "Left Upper Cheek": "Linke Wange oben",
    "Left Lower Cheek": "Linke Wange unten",
    "Left Before the Ear": "Vor dem linken Ohr",
    "Left Below the Ear": "Unter dem linken Ohr",
    "Left Upper Chin": "Kinn oben links",
    "Left Chin": "Kinn links",
    "Left Above the Jaw": "Über dem Kiefer links",
    "Left Front Jaw": "Kiefer vorn links",
    "Left Jaw": "Kiefer links",
    "Left Lower Temple": "Linke Schläfe unten",
    "Left Temple": "Linke Schläfe",
    "Left Above the Inner Brow": "Über Braue innen links",
    "Left Above the Outer Brow": "Über Braue außen links",
    "Left Inner Forehead": "Linke Stirn innen",
    "Left Outer Forehead": "Linke Stirn außen",
    "Left Hairline Inner": "Linker Haaransatz innen",
    # Meanings of the points between MPEG-4's.
    "left half of the forehead, its middle": "Mitte der linken Stirnhälfte",
    "left cheek, between its middle and the angle of the jaw": "linke Wange, zwischen ihrer Mitte und dem Kieferwinkel",
    "left cheek above the jaw, level with the mouth": "linke Wange über dem Kiefer, auf der Höhe des Mundes",
    "left upper lid's edge, toward the nose": "Rand des linken Oberlids, zur Nase hin",
    "left upper lid's edge, toward the ear": "Rand des linken Oberlids, zum Ohr hin",
    "left lower lid's edge, toward the nose": "Rand des linken Unterlids, zur Nase hin",
    "left lower lid's edge, toward the ear": "Rand des linken Unterlids, zum Ohr hin",
    "left upper lid's fold below the brow, middle": "Falte des linken Oberlids unter der Braue, Mitte",
    "below the left lower lid, toward the nose": "unter dem linken Unterlid, zur Nase hin",
    "below the left lower lid, toward the ear": "unter dem linken Unterlid, zum Ohr hin",
    "left brow, between its inner end and its top": "linke Braue, zwischen innerem Ende und höchstem Punkt",
    "left side of the nose, level with its bone's lower end": (
        "linke Seite der Nase, auf der Höhe des unteren Nasenbeinendes"
    ),
    "upper edge of the left nostril's wing": "oberer Rand des linken Nasenflügels",
    "lower edge of the left nostril": "unterer Rand des linken Nasenlochs",
    "skin between the left nostril and the upper lip": "Haut zwischen dem linken Nasenloch und der Oberlippe",
    "left fold from nose to mouth, halfway": "linke Falte von der Nase zum Mund, auf halbem Weg",
    "fold beside the left corner of the mouth": "Falte neben dem linken Mundwinkel",
    "left cheek beside the nose": "linke Wange neben der Nase",
    "left cheek below the eye's outer half": "linke Wange unter der äußeren Hälfte des Auges",
    "left cheek between its middle and the jaw": "linke Wange zwischen ihrer Mitte und dem Kiefer",
    "left side of the face before the ear, level with the nose": (
        "linke Gesichtsseite vor dem Ohr, auf der Höhe der Nase"
    ),
    "left side of the face, above the angle of the jaw": "linke Gesichtsseite, über dem Kieferwinkel",
    "left of the chin's boss, below the lower lip": "links vom Kinnvorsprung, unter der Unterlippe",
    "left corner of the chin": "linke Ecke des Kinns",
    "left jaw, beside the chin's boss": "linker Kiefer, neben dem Kinnvorsprung",
    "left edge of the jaw, beside the chin": "linke Kante des Kiefers, neben dem Kinn",
    "left edge of the jaw, between its angle and the chin": "linke Kante des Kiefers, zwischen Kieferwinkel und Kinn",
    "beside the left eye's outer corner, toward the ear": "neben dem äußeren Winkel des linken Auges, zum Ohr hin",
    "left temple, beside the brow's outer end": "linke Schläfe, neben dem äußeren Ende der Braue",
    "forehead above the left brow's inner half": "Stirn über der inneren Hälfte der linken Braue",
    "forehead above the left brow's outer half": "Stirn über der äußeren Hälfte der linken Braue",
    "left half of the forehead, near its middle": "linke Stirnhälfte, nahe der Mitte",
    "left half of the forehead, toward the temple": "linke Stirnhälfte, zur Schläfe hin",
    "hairline between its middle and its left end": "Haaransatz zwischen der Mitte und dem linken Ende",
    # Meanings of MPEG-4's points.
    "left corner of the lips' inner edge": "linker Winkel des inneren Lippenrands",
    "upper lip's inner edge, halfway to the left corner": (
        "innerer Rand der Oberlippe, auf halbem Weg zum linken Mundwinkel"
    ),
    "lower lip's inner edge, halfway to the left corner": (
        "innerer Rand der Unterlippe, auf halbem Weg zum linken Mundwinkel"
    ),
    "left angle of the jaw bone": "linker Winkel des Kieferknochens",
    "left upper lid's inner edge, middle": "innerer Rand des linken Oberlids, Mitte",
    "left lower lid's inner edge, middle": "innerer Rand des linken Unterlids, Mitte",
    "left upper lid's outer edge, middle": "äußerer Rand des linken Oberlids, Mitte",
    "left lower lid's outer edge, middle": "äußerer Rand des linken Unterlids, Mitte",
    "left pupil, centre": "Mitte der linken Pupille",
    "left eye's left corner, the outer one": "linker Winkel des linken Auges, der äußere",
    "left eye's right corner, the one at the nose": "rechter Winkel des linken Auges, der an der Nase",
    "left brow's inner end": "inneres Ende der linken Braue",
    "left brow's highest point": "höchster Punkt der linken Braue",
    "left brow's outer end": "äußeres Ende der linken Braue",
    "middle of the left cheek": "Mitte der linken Wange",
    "left cheek bone": "linkes Jochbein",
    "left edge of the tongue": "linker Rand der Zunge",
    "left corner of the lips' outer edge": "linker Winkel des äußeren Lippenrands",
    "upper lip's outer edge, halfway to the left corner": (
        "äußerer Rand der Oberlippe, auf halbem Weg zum linken Mundwinkel"
    ),
    "lower lip's outer edge, halfway to the left corner": (
        "äußerer Rand der Unterlippe, auf halbem Weg zum linken Mundwinkel"
    ),
    "left peak of the Cupid's bow": "linke Spitze des Amorbogens",
    "left nostril's outer border": "äußerer Rand des linken Nasenlochs",
    "nose's base, left edge": "Nasenansatz, linker Rand",
    "nose bone, left upper edge": "Nasenbein, linker oberer Rand",
    "nose bone's lower end, left": "unteres Ende des Nasenbeins, links",
    "left ear, top": "linkes Ohr, oben",
    "left ear, rearmost point": "linkes Ohr, hinterster Punkt",
    "left ear lobe, bottom": "linkes Ohrläppchen, unten",
    "left ear lobe, lower end of its joint with the face": "linkes Ohrläppchen, unteres Ende des Ansatzes am Gesicht",
    "left ear, upper end of its joint with the face": "linkes Ohr, oberes Ende des Ansatzes am Gesicht",
    "hairline above the forehead, left": "Haaransatz über der Stirn, links",
}
"""Texts about the left half; those about the right one are made from them."""

_MIDDLE = {
    # Labels.
    "Nose Tip": "Nasenspitze",
    "Chin Bottom": "Kinn unten",
    "Upper Lip": "Oberlippe",
    "Lower Lip": "Unterlippe",
    "Hairline": "Haaransatz",
    "Nose Base": "Nasenansatz",
    "Upper Lip Inside": "Oberlippe innen",
    "Lower Lip Inside": "Unterlippe innen",
    "Chin Boss": "Kinnvorsprung",
    "Nose Bridge": "Nasenrücken",
    "Nose Root": "Nasenwurzel",
    "Between the Brows": "Zwischen den Brauen",
    "Forehead": "Stirn",
    "Philtrum": "Philtrum",
    "Chin Crease": "Kinnfalte",
    "Nose Ridge": "Nasengrat",
    "Above the Nose Tip": "Über der Nasenspitze",
    "Throat": "Kehle",
    # Meanings.
    "deepest point between the eyes, in the middle": "tiefster Punkt zwischen den Augen, in der Mitte",
    "middle of the bulge between the brows": "Mitte der Wölbung zwischen den Brauen",
    "middle of the forehead": "Mitte der Stirn",
    "middle of the groove between nose and upper lip": "Mitte der Rinne zwischen Nase und Oberlippe",
    "deepest point between lower lip and chin, in the middle": (
        "tiefster Punkt zwischen Unterlippe und Kinn, in der Mitte"
    ),
    "ridge of the nose, between its root and its bone's lower end": (
        "Grat der Nase, zwischen der Wurzel und dem unteren Nasenbeinende"
    ),
    "ridge of the nose, a little above the tip": "Grat der Nase, etwas über der Spitze",
    "where chin and neck meet, in the middle": "wo Kinn und Hals sich treffen, in der Mitte",
    "lowest point of the chin": "tiefster Punkt des Kinns",
    "upper lip's inner edge, middle": "innerer Rand der Oberlippe, Mitte",
    "lower lip's inner edge, middle": "innerer Rand der Unterlippe, Mitte",
    "boss of the chin, its foremost point": "Kinnvorsprung, vorderster Punkt",
    "tip of the tongue": "Zungenspitze",
    "middle of the tongue's body": "Mitte des Zungenkörpers",
    "top of the spine, about which the head turns": "oberes Ende der Wirbelsäule, um das der Kopf sich dreht",
    "upper lip's outer edge, middle": "äußerer Rand der Oberlippe, Mitte",
    "lower lip's outer edge, middle": "äußerer Rand der Unterlippe, Mitte",
    "tip of the nose": "Nasenspitze",
    "upper teeth, top": "obere Zähne, oben",
    "upper teeth, bottom": "obere Zähne, unten",
    "lower teeth, top": "untere Zähne, oben",
    "lower teeth, bottom": "untere Zähne, unten",
    "nose bone's lower end in the middle, or the nose's bump": (
        "unteres Ende des Nasenbeins in der Mitte, oder der Nasenhöcker"
    ),
    "nose's base in the middle, where the upper lip begins": "Nasenansatz in der Mitte, wo die Oberlippe beginnt",
    "hairline above the forehead, middle": "Haaransatz über der Stirn, Mitte",
    "top of the skull": "Scheitel des Schädels",
    "top of the hair, over the top of the skull": "oberstes Haar, über dem Scheitel des Schädels",
    "back of the skull": "Hinterkopf",
}

_EITHER = _MIDDLE | _ONE_SIDE | dict(_other_side(english, german) for english, german in _ONE_SIDE.items())

TEXTS = {text[:1].upper() + text[1:]: german[:1].upper() + german[1:] for text, german in _EITHER.items()} | _EITHER
"""A meaning also stands at the beginning of a line: then with a capital."""
