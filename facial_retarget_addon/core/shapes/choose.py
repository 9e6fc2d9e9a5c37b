"""Which shapes of a set are wanted, by patterns such as `mouth*`."""

from __future__ import annotations

from collections.abc import Sequence
from fnmatch import fnmatchcase

from ..errors import RetargetError

EVERY = ("*",)


def chosen(names: Sequence[str], keep: Sequence[str] = EVERY, drop: Sequence[str] = ()) -> tuple[str, ...]:
    """The names that a pattern of `keep` and none of `drop` matches, in their order.

    Parameters
    ----------
    keep, drop : shell patterns (`*`, `?`, `[abc]`); capitals count.

    Raises
    ------
    RetargetError : for patterns that match no name, or if nothing is left; names the patterns.
    """
    idle = [pattern for pattern in (*keep, *drop) if not any(fnmatchcase(name, pattern) for name in names)]
    if idle:
        raise RetargetError(
            f"no shape is called {' or '.join(map(repr, idle))}; the {len(names)} shapes are {listed(names)}"
        )
    left = tuple(
        name
        for name in names
        if any(fnmatchcase(name, pattern) for pattern in keep)
        and not any(fnmatchcase(name, pattern) for pattern in drop)
    )
    if not left:
        raise RetargetError(f"no shape is left of {len(names)}: keep {', '.join(keep)}, drop {', '.join(drop)}")
    return left


def listed(names: Sequence[str], most: int = 8) -> str:
    """Names for a message; the first ones of many."""
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more
