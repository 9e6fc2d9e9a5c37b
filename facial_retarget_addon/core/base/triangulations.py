"""Fixed triangulations of the standard sets of feature points, by point name.

Counter-clockwise seen from outside. MPEG-4 numbers where one exists (left is the subject's left). Mouth and eye
openings stay open, and so does the back of the head.
"""

from __future__ import annotations

Triangles = tuple[tuple[str, str, str], ...]


def mirrored_name(name: str) -> str:
    """Name of the point on the other side of the face; the name itself on the midline."""
    return _MIRROR.get(name, name)


def _both_sides(left: str) -> Triangles:
    """The left side's triangles, one per line, and their mirror images."""
    one = [tuple(line.split()) for line in left.strip().splitlines()]
    triangles = [(a, b, c) for a, b, c in one]
    triangles += [(mirrored_name(c), mirrored_name(b), mirrored_name(a)) for a, b, c in one]
    return tuple(dict.fromkeys(triangles))


_PAIRS = """
2.4 2.5, 2.6 2.7, 2.8 2.9, 2.11 2.12, 2.13 2.14, 3.1 3.2, 3.3 3.4, 3.7 3.12, 3.9 3.10, 3.11 3.8, 3.13 3.14, 4.1 4.2,
4.3 4.4, 4.5 4.6, 5.1 5.2, 5.3 5.4, 8.3 8.4, 8.5 8.6, 8.7 8.8, 8.10 8.9, 9.1 9.2, 9.5 9.4, 9.7 9.6, 9.13 9.14,
10.7 10.8, 10.9 10.10, 11.3 11.2, forehead_l forehead_r, cheek_l_2 cheek_r_2, jaw_l_1 jaw_r_1
"""
_MIRROR = {
    name: other
    for pair in _PAIRS.replace("\n", " ").split(",")
    for name, other in (tuple(pair.split()), tuple(reversed(pair.split())))
}

FACE_57: Triangles = _both_sides("""
11.1 forehead_mid forehead_l
11.1 forehead_l 11.3
forehead_mid glabella 4.1
forehead_mid 4.1 forehead_l
glabella nose_bridge 4.1
forehead_l 4.1 4.3
4.1 3.1 4.3
forehead_l 4.3 11.3
11.3 4.3 4.5
4.3 3.1 3.7
4.3 3.7 4.5
nose_bridge 3.11 4.1
4.1 3.11 3.1
nose_bridge 9.12 3.11
9.12 9.1 3.11
9.12 9.3 9.1
9.3 9.15 9.1
3.11 9.1 3.3
3.3 9.1 5.1
3.3 5.1 3.7
3.7 5.1 cheek_l_2
3.7 cheek_l_2 5.3
3.7 5.3 4.5
cheek_l_2 2.13 5.3
cheek_l_2 jaw_l_1 2.13
5.1 jaw_l_1 cheek_l_2
jaw_l_1 2.1 2.13
9.15 8.1 8.10
9.15 8.10 9.1
9.1 8.10 8.5
9.1 8.5 8.3
9.1 8.3 5.1
5.1 8.3 jaw_l_1
8.3 8.7 jaw_l_1
8.2 2.10 8.7
8.7 2.10 jaw_l_1
2.10 2.1 jaw_l_1
8.1 2.2 2.6
8.1 2.6 8.10
8.10 2.6 8.5
8.5 2.6 2.4
8.5 2.4 8.3
8.3 2.4 8.7
2.4 2.8 8.7
2.8 2.3 8.2
2.8 8.2 8.7
""")
"""57 points: the MPEG-4 points of the face without teeth, tongue and ears' details, and ten more on forehead, nose,
cheeks and jaw. 92 triangles; loops: 10 outer, 8 mouth, 4 each eye."""

MPEG4_64: Triangles = _both_sides("""
4.3 11.3 11.1
4.1 4.3 11.1
2.11 2.13 5.1
2.13 10.7 5.1
11.3 4.5 10.9
4.5 11.3 4.3
9.12 9.7 11.1
9.7 4.1 11.1
2.11 2.10 2.1
3.13 4.5 4.3
4.1 3.13 4.3
3.11 9.7 9.12
9.7 3.11 4.1
3.11 3.13 4.1
10.7 5.3 5.1
8.7 2.10 2.11
2.8 8.7 2.4
3.13 3.7 4.5
5.3 3.7 3.9
4.5 3.7 10.9
3.7 10.7 10.9
3.7 5.3 10.7
9.3 9.13 9.12
9.13 3.11 9.12
3.11 9.13 3.9
8.3 2.11 5.1
8.3 8.7 2.11
8.7 8.3 2.4
8.10 9.15 8.1
2.2 8.10 8.1
8.7 8.2 2.10
2.3 8.2 2.8
8.2 8.7 2.8
3.1 3.7 3.13
3.11 3.1 3.13
9.1 5.3 3.9
9.13 9.1 3.9
2.4 9.1 8.5
8.3 9.1 2.4
5.3 9.1 5.1
9.1 8.3 5.1
2.2 2.6 8.10
8.10 2.6 8.5
2.6 2.4 8.5
3.7 3.3 3.9
3.3 3.11 3.9
9.15 9.5 9.3
9.5 9.13 9.3
9.5 9.1 9.13
9.1 9.5 8.5
9.5 8.10 8.5
9.5 9.15 8.10
""")
"""64 MPEG-4 points: those of motion cloning. Loops: outer, 8 mouth, 4 each eye."""

STANDARD: tuple[Triangles, ...] = (MPEG4_64, FACE_57)
"""The sets that are looked for, largest first."""
