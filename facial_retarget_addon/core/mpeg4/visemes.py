"""The 14 visemes that FAP 1 mixes: mouths of groups of phonemes that look alike.

The standard names the phonemes only. The mouths are ours; names follow the labels in wide use for shape keys.
"""

from __future__ import annotations

from dataclasses import dataclass

from .recipes import Recipe, symmetric


@dataclass(frozen=True)
class Viseme:
    """A viseme of FAP 1.

    Attributes
    ----------
    number : by which FAP 1 selects it, 1 to 14; 0 selects none.
    name : of its shape key.
    phonemes : in SAMPA.
    meaning : what the mouth does.
    recipe : its FAPs.
    """

    number: int
    name: str
    phonemes: tuple[str, ...]
    meaning: str
    recipe: Recipe


_PP: Recipe = {4: 20, 5: 20, 8: 20, 10: 20, 16: -60, 17: -60, 51: 100, 52: 100, 55: 60, 57: 70}
_FF: Recipe = {4: -220, 5: 50, 8: -180, 10: 40, 16: -220, 18: 80, 51: -200, 52: 160, 55: -120, 57: 110}
_TH: Recipe = {
    **{3: 120, 4: -50, 5: -300, 8: -40, 10: -250, 12: -20, 44: 60, 45: 200},
    **{51: -50, 52: -300, 55: -40, 57: -190, 59: -20},
}
_DD: Recipe = {
    **{3: 120, 4: -60, 5: -320, 8: -50, 10: -260, 12: -20, 44: 250, 46: 100},
    **{51: -50, 52: -320, 55: -40, 57: -200, 59: -20},
}
_KK: Recipe = {
    **{3: 170, 4: -50, 5: -330, 8: -40, 10: -270, 12: -20, 44: -50, 46: 300},
    **{51: -50, 52: -330, 55: -40, 57: -210, 59: -20},
}
_CH: Recipe = {
    **{3: 60, 4: -170, 5: -300, 6: -60, 8: -120, 10: -250, 16: 250, 17: 280, 46: 150},
    **{51: -160, 52: -300, 53: -70, 55: -70, 57: -180},
}
_SS: Recipe = {
    **{4: -70, 5: -220, 6: 70, 8: -60, 10: -180, 12: 40, 44: 80},
    **{51: -60, 52: -220, 53: 80, 55: -70, 57: -110, 59: 50},
}
_NN: Recipe = {
    **{3: 80, 4: -60, 5: -240, 8: -50, 10: -200, 44: 300, 46: 80},
    **{51: -50, 52: -240, 55: -40, 57: -140},
}
_RR: Recipe = {
    **{3: 60, 4: -80, 5: -220, 6: -60, 8: -60, 10: -180, 16: 120, 17: 110, 44: 200, 46: 150},
    **{51: -80, 52: -220, 53: -70, 55: -40, 57: -130},
}
_AA: Recipe = {
    **{3: 800, 4: -40, 5: -1050, 6: -40, 8: -30, 10: -930, 12: -190, 46: -100},
    **{51: -40, 52: -1050, 53: -40, 57: -750, 59: -220},
}
_E: Recipe = {
    **{3: 350, 4: -60, 5: -480, 6: 50, 8: -60, 10: -430, 12: -30},
    **{51: -50, 52: -480, 53: 55, 55: -50, 57: -340, 59: -40},
}
_IH: Recipe = {
    **{3: 200, 4: -50, 5: -320, 6: 70, 8: -50, 10: -270, 12: 20, 46: 150},
    **{51: -50, 52: -320, 53: 75, 55: -50, 57: -190, 59: 20},
}
_OH: Recipe = {
    **{3: 540, 4: -60, 5: -720, 6: -120, 8: -30, 10: -640, 12: -120, 16: 120, 17: 120},
    **{51: -60, 52: -720, 53: -130, 57: -520, 59: -150},
}
_OU: Recipe = {
    **{3: 170, 4: -90, 5: -260, 6: -140, 8: -50, 10: -180, 16: 280, 17: 260, 46: 100},
    **{51: -110, 52: -260, 53: -150, 55: -20, 57: -120},
}

VISEMES: dict[str, Viseme] = {
    viseme.name: viseme
    for viseme in (
        Viseme(1, "viseme_PP", ("p", "b", "m"), "lips shut and pressed", symmetric(_PP)),
        Viseme(2, "viseme_FF", ("f", "v"), "lower lip tucked under the upper teeth", symmetric(_FF)),
        Viseme(3, "viseme_TH", ("T", "D"), "tongue's tip between the teeth", symmetric(_TH)),
        Viseme(4, "viseme_DD", ("t", "d"), "tongue's tip behind the upper teeth, lips apart", symmetric(_DD)),
        Viseme(5, "viseme_kk", ("k", "g"), "tongue's back at the palate, lips apart", symmetric(_KK)),
        Viseme(6, "viseme_CH", ("tS", "dZ", "S"), "lips pushed forward, teeth nearly shut", symmetric(_CH)),
        Viseme(7, "viseme_SS", ("s", "z"), "teeth shut and shown, lips a little wide", symmetric(_SS)),
        Viseme(8, "viseme_nn", ("n", "l"), "tongue's tip up, mouth hardly open", symmetric(_NN)),
        Viseme(9, "viseme_RR", ("r",), "lips a little round, tongue drawn up", symmetric(_RR)),
        Viseme(10, "viseme_aa", ("A:",), "mouth wide open", symmetric(_AA)),
        Viseme(11, "viseme_E", ("e",), "mouth half open, a little wide", symmetric(_E)),
        Viseme(12, "viseme_ih", ("I",), "mouth a little open and wide", symmetric(_IH)),
        Viseme(13, "viseme_oh", ("Q",), "mouth open and round", symmetric(_OH)),
        Viseme(14, "viseme_ou", ("U",), "lips round and pushed forward, a small opening", symmetric(_OU)),
    )
}
"""Name -> viseme, in the order of their numbers."""
