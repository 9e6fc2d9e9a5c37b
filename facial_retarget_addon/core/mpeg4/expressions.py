"""The six expressions that FAP 2 mixes.

The standard describes them in words and leaves the amount to the face. The recipes are ours, of the strength that
people show without overacting; `arkit` says how amounts were measured.
"""

from __future__ import annotations

from dataclasses import dataclass

from .recipes import Recipe, symmetric


@dataclass(frozen=True)
class Expression:
    """An expression of FAP 2.

    Attributes
    ----------
    number : by which FAP 2 selects it, 1 to 6; 0 selects the neutral face.
    name : the standard's.
    meaning : what shows on the face, in our words.
    recipe : its FAPs at full intensity.
    """

    number: int
    name: str
    meaning: str
    recipe: Recipe


_JOY: Recipe = {
    **{3: 280, 4: -120, 5: -280, 6: 120, 8: -180, 10: -150, 12: 380, 19: 100, 21: 180},
    **{41: 120, 51: -110, 52: -280, 53: 130, 55: -270, 57: -20, 59: 420},
}
_SADNESS: Recipe = {
    **{8: 30, 10: -30, 12: -100, 18: 100, 19: 200, 21: 40},
    **{31: 180, 33: 40, 35: -60, 37: 60, 55: 55, 57: -60, 59: -120},
}
_ANGER: Recipe = {
    **{4: 20, 5: 20, 6: -40, 8: 20, 10: 20, 16: -70, 17: -70, 19: -250, 21: 60},
    **{31: -150, 33: -110, 35: -30, 37: 130, 51: 110, 52: 110, 53: -45, 55: 80, 57: 80, 61: 40},
}
_FEAR: Recipe = {
    **{3: 180, 5: -260, 6: 70, 8: 30, 10: -240, 12: -110, 19: -290, 21: 100},
    **{31: 230, 33: 130, 35: 50, 37: 100, 52: -260, 53: 80, 55: 40, 57: -200, 59: -135},
}
_DISGUST: Recipe = {
    **{4: -190, 5: 70, 8: -230, 10: 60, 16: 50, 17: 60, 18: 80, 21: 110},
    **{41: 100, 51: -230, 52: 90, 55: -310, 57: 60, 61: 80, 63: 60},
}
_SURPRISE: Recipe = {
    **{3: 690, 5: -900, 6: -30, 10: -800, 12: -170, 19: -330},
    **{31: 220, 33: 260, 35: 200, 52: -900, 53: -30, 57: -640, 59: -190},
}

EXPRESSIONS: dict[str, Expression] = {
    expression.name: expression
    for expression in (
        Expression(1, "joy", "corners back and up, mouth a little open, cheeks lifted, brows at rest", symmetric(_JOY)),
        Expression(2, "sadness", "brows rise at the nose, lids half lowered, mouth slack", symmetric(_SADNESS)),
        Expression(3, "anger", "brows down and together, eyes wide open, lips pressed", symmetric(_ANGER)),
        Expression(4, "fear", "brows up and together, most at the nose, eyes alert, mouth tense", symmetric(_FEAR)),
        Expression(5, "disgust", "upper lip raised and curled, nose wrinkled, brows at rest", symmetric(_DISGUST)),
        Expression(6, "surprise", "brows high, upper lids wide open, jaw dropped", symmetric(_SURPRISE)),
    )
}
"""Name -> expression, in the order of their numbers."""
