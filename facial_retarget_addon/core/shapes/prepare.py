"""What is made of a donor's shapes before they go over: chosen, joined, halved, and named as ARKit does."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ..arrays import FloatArray
from .choose import EVERY, chosen
from .combinations import Corrective, find_correctives
from .names import arkit_name
from .shape_set import ShapeSet
from .sides import FEATHER, SideNames, arkit_merges, merged, split


@dataclass(frozen=True)
class Preparation:
    """What is made of a set of shapes, in this order.

    Attributes
    ----------
    keep, drop : patterns of the donor's shapes, see `chosen`.
    arkit_wholes : join the halves that ARKit has as one shape, such as browInnerUp_L and browInnerUp_R.
    merge : new name -> shapes to add up.
    split : patterns of the shapes that are cut in left and right halves; those with a side stay.
    feather : half the width of the border between the halves, in eye separations.
    sides : endings of the halves' names; as the set's own names have them if None.
    arkit_names : give every shape that stands for one of ARKit's its name.
    correctives : the artist's own, beside ARKit's: name -> the shapes that it needs; none if it stands by itself.
    """

    keep: tuple[str, ...] = EVERY
    drop: tuple[str, ...] = ()
    arkit_wholes: bool = False
    merge: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    split: tuple[str, ...] = ()
    feather: float = FEATHER
    sides: SideNames | None = None
    arkit_names: bool = False
    correctives: Mapping[str, tuple[str, ...]] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class PreparedShapes:
    """Shapes that are ready to go over.

    Attributes
    ----------
    shapes : all that are needed. wanted : names of those that were asked for; the others serve correctives.
    correctives : among them.
    """

    shapes: ShapeSet
    wanted: tuple[str, ...]
    correctives: tuple[Corrective, ...]


def prepare_shapes(shapes: ShapeSet, how: Preparation, left_share: FloatArray | None = None) -> PreparedShapes:
    """The shapes of a donor as they shall go over, and those that their correctives need.

    Parameters
    ----------
    left_share : (V,) of `sides.left_share`; None where nothing is split.

    Raises
    ------
    RetargetError : for patterns that match nothing, parts that are missing, or names that appear twice.
    """
    kept = shapes.subset(chosen(shapes.names, how.keep, how.drop))
    whole = merged(kept, arkit_merges(kept.names)) if how.arkit_wholes else kept
    whole = merged(whole, how.merge) if how.merge else whole
    cut = whole
    if how.split and left_share is not None:
        cut = split(whole, left_share, how.sides, chosen(whole.names, how.split))
    correctives = find_correctives((*cut.names, *shapes.names), how.correctives)
    serving = [
        need
        for one in correctives
        if one.name in cut.names
        for need in one.needs
        if need not in cut.names and need in shapes.names
    ]
    ready = cut.joined(shapes.subset(list(dict.fromkeys(serving)))) if serving else cut
    of_these = tuple(one for one in correctives if one.name in ready.names)
    if not how.arkit_names:
        return PreparedShapes(ready, cut.names, of_these)
    called = {name: arkit_name(name) or name for name in ready.names}
    renamed = ShapeSet(tuple(called.values()), ready.displacements)
    known = (Corrective(called[one.name], tuple(called.get(need, need) for need in one.needs)) for one in of_these)
    return PreparedShapes(renamed, tuple(called[name] for name in cut.names), tuple(known))
