"""Parts of real heads: what teeth, gums and lashes do against what their artists made them do, percent of its motion.

The skin is met exactly: what is measured is the parts alone. *Skin*: the source's parts are called still, so that the
target's follow its skin. *Source*: they move as the source's do, which here is the same head.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from facial_retarget_addon.core.arrays import BoolArray, FloatArray
from facial_retarget_addon.core.mesh import TriMesh
from facial_retarget_addon.core.parts.carried_parts import CarriedParts, carried_parts
from facial_retarget_addon.core.parts.follow import fit_following
from facial_retarget_addon.core.parts.kinds import LOWER
from facial_retarget_addon.core.parts.known_head import know_head
from facial_retarget_addon.core.problem import Face
from facial_retarget_addon.files.points import read_points

from .real_pair import DATA
from .timing import Row

ICT = {
    "jawOpen": {"teeth": (15, 1), "gums_tongue": (20, 14)},
    "jawLeft": {"teeth": (20, 1)},
    "jawForward": {"teeth": (25, 1)},
    "eyeBlink_L": {"lashes_L": (40, 22), "lacrimal_L": (13, 13), "eyeocc_L": (20, 20)},
    "eyeWide_L": {"lashes_L": (25, 15)},
    "eyeSquint_L": {"lashes_L": (25, 15)},
    "eyeLookDown_L": {"lashes_L": (22, 12)},
}
"""Shape -> part -> bounds from the skin and from the source."""
STILL = {"mouthShrugLower": 18, "mouthClose": 10, "mouthFunnel": 10, "mouthPucker": 5}
"""Shape in which the jaw rests -> bound on the lower teeth's motion from the skin, percent of that in jawOpen."""
MAKEHUMAN = {"mouth-open": {"teeth_lower": (35, 3)}}


class _Head:
    """A head with its artist's names and shapes; every shape has been made by the parts in both ways."""

    def __init__(self, name: str, points: str) -> None:
        with np.load(DATA / name) as archive:
            mesh = TriMesh(archive["vertices"], archive["tris"])
            self.names = archive["part_names"][archive["vert_part"]]
            self.shapes = dict(zip(archive["expr_names"].tolist(), archive["expr_delta"], strict=True))
        self.face = Face(mesh, read_points(DATA / points, mesh))
        self.known = know_head(self.face)
        nothing = np.zeros(len(mesh.vertices), bool)
        held = np.concatenate([part.vertices for part in self.known.parts])
        still = Face(mesh, self.face.points, named_parts={"still": held})
        self.ways = [carried_parts(source, self.face, nothing) for source in (still, self.face)]
        self.skin = nothing.copy()
        self.skin[self.known.skin] = True

    def moved(self, way: CarriedParts, shape: str) -> FloatArray:
        """(V, 3) of a shape whose skin is the artist's."""
        rest = self.face.mesh.vertices.astype(np.float32)
        frames = (self.face.mesh.vertices + self.shapes[shape]).astype(np.float32)[None]
        return way.add_to((frames - rest) * self.skin[:, None], frames)[0]

    def error(self, found: FloatArray, shape: str, part: BoolArray) -> float:
        wanted = self.shapes[shape][part]
        return 100 * float(np.linalg.norm(found[part] - wanted) / np.linalg.norm(wanted))


def rows() -> Iterator[Row]:
    """Errors by shape and part, both ways, and how far resting teeth go with a chin that muscles move."""
    if not (DATA / "ict_dev.npz").exists():
        return
    ict = _Head("ict_dev.npz", "ict_points.json")
    makehuman = _Head("makehuman_dev.npz", "makehuman_points.json")
    for head, wanted in ((ict, ICT), (makehuman, MAKEHUMAN)):
        for shape, parts in wanted.items():
            for way, name, column in zip(head.ways, ("skin", "source"), (0, 1), strict=True):
                found = head.moved(way, shape)
                for part, bounds in parts.items():
                    error = head.error(found, shape, head.names == part)
                    yield Row(f"{shape}: {part}, {name}", error, "%", bounds[column])
    lower = ict.known.vertices((LOWER,))
    opened = np.linalg.norm(ict.shapes["jawOpen"][lower])
    for shape, bound in STILL.items():
        share = 100 * float(np.linalg.norm(ict.moved(ict.ways[0], shape)[lower]) / opened)
        yield Row(f"{shape}: resting lower teeth, skin", share, "% of jawOpen", bound)
    # A face that FAPs move takes the teeth where the bottom of its chin goes.
    for head, wanted in ((ict, ICT), (makehuman, MAKEHUMAN)):
        chin = fit_following(head.known, head.known.parts)
        for shape, parts in wanted.items():
            found = chin.add_to(np.float32(head.shapes[shape] * head.skin[:, None])[None])[0]
            for part in parts:
                yield Row(f"{shape}: {part}, with FAPs", head.error(found, shape, head.names == part), "%")
