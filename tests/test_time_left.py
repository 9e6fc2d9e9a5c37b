"""The time left is told only where it is known."""

import pytest

from facial_retarget_addon.time_left import TimeLeft, spoken


def watched(moments: list[tuple[float, float]]) -> TimeLeft:
    left = TimeLeft(100.0)
    for now, share in moments:
        left.see(share, 100.0 + now)
    return left


def test_an_even_pace_tells_the_time_left() -> None:
    left = watched([(0.1 * i, 0.01 * i) for i in range(1, 41)])
    assert left.seconds == pytest.approx(6.0, rel=0.05)


@pytest.mark.parametrize(
    "moments",
    [
        [(1.0, 0.5)],  # too early
        [(10.0, 0.01)],  # too little
        [(1.0, 0.3), (3.0, 0.3), (6.0, 0.3), (9.0, 0.3)],  # stuck
        [(0.1 * i, 0.02 * i) for i in range(1, 21)] + [(2 + i, 0.4 + 0.005 * i) for i in range(1, 21)],  # got slow
    ],
)
def test_nothing_is_said_where_it_is_not_known(moments: list[tuple[float, float]]) -> None:
    assert watched(moments).seconds == 0.0


def test_a_new_pace_is_believed_after_a_while() -> None:
    slow = [(2 + i, 0.1 + 0.01 * i) for i in range(1, 81)]
    left = watched([(0.1 * i, 0.005 * i) for i in range(1, 21)] + slow)
    assert left.seconds == pytest.approx(10, rel=0.2)


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(0, ""), (0.3, "1 s left"), (7.6, "8 s left"), (43.9, "45 s left"), (59.9, "60 s left"), (200, "3 min left")],
)
def test_it_is_spoken_coarsely(seconds: float, text: str) -> None:
    template, fields = spoken(seconds)
    assert template.format(**fields) == text
