"""Mesh files: what one format writes every reader gives back."""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np
import pytest

from facial_retarget_addon.core.errors import RetargetError
from facial_retarget_addon.files.mesh_file import MeshFile
from facial_retarget_addon.files.meshes import read_mesh, read_positions, write_mesh

from .conftest import dome

SUFFIXES = [".obj", ".ply", ".npz"]


def mixed(uvs: bool) -> MeshFile:
    """Triangles, quads and a pentagon with numbers that have no short decimal form."""
    rng = np.random.default_rng(3)
    vertices = rng.normal(size=(9, 3)) / 3
    counts = np.array([3, 4, 5, 3])
    corners = np.array([0, 1, 2, 2, 1, 3, 4, 4, 3, 5, 6, 7, 7, 6, 8])
    return MeshFile.from_polygons(Path("mixed"), vertices, counts, corners, rng.random((15, 2)) if uvs else None)


def same(one: MeshFile, other: MeshFile) -> None:
    np.testing.assert_array_equal(one.mesh.vertices, other.mesh.vertices)
    np.testing.assert_array_equal(one.mesh.faces, other.mesh.faces)
    np.testing.assert_array_equal(one.mesh.polygons, other.mesh.polygons)
    np.testing.assert_array_equal(one.counts, other.counts)
    np.testing.assert_array_equal(one.corners, other.corners)
    assert (one.uvs is None) == (other.uvs is None)
    if one.uvs is not None:
        np.testing.assert_array_equal(one.uvs, other.uvs)


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize("mesh", [mixed(True), mixed(False), dome(5), MeshFile.from_mesh(dome(5).mesh)])
def test_writing_and_reading_gives_the_same_mesh(tmp_path, suffix, mesh):
    path = tmp_path / f"mesh{suffix}"
    write_mesh(mesh, path)
    same(read_mesh(path), mesh)
    np.testing.assert_array_equal(read_positions(path), mesh.mesh.vertices)


def obj(tmp_path: Path, text: str) -> MeshFile:
    path = tmp_path / "mesh.obj"
    path.write_bytes(text.encode())
    return read_mesh(path)


SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


@pytest.mark.parametrize(
    "text",
    [
        SQUARE + "f 1 2 3 4",
        SQUARE + "f -4 -3 -2 -1\n",
        SQUARE + "vn 0 0 1\nf 1//1 2//1 3//1 4//1",
        SQUARE + "vn 0 0 1\nvt 0 0\nf 1/1/1 2/1/1 3/1/1 4/1/1",
        SQUARE + "vt 0 0\nf 1/1 2/1 3/1 4/1",
        SQUARE + "vt 0 0\nf 1/1 2 3 4",
        SQUARE.replace("\n", "\r\n") + "f 1 2 3 4\r\n",
        SQUARE + "f 1 2 \\\n3 4",
        SQUARE.replace("\n", " # a corner\n") + "# f 9 9 9\nf 1 2 3 4 # done",
        "mtllib a.mtl\no face\n" + SQUARE + "g skin\ns 1\nusemtl skin\nl 1 2 3\np 1\nvp 0.1\nf 1 2 3 4\nl 9 9",
        SQUARE.replace("v ", "  v\t") + "\tf 1\t2 3 4",
        "v 0 0 0 1\nv 1 0 0 1\nv 1 1 0 1 0.2 0.3 0.4\nv 0 1 0\nf 1 2 3 4",
        "v 0 0 0\nf -1 2 3 4\nv 1 0 0\nv 1 1 0\nv 0 1 0",
        "v 0e0 .0 -0\nv +1 0 0\nv 1. 1E0 0\nv 0 1 0\nf 1 2 3 4",
    ],
)
def test_ways_to_write_one_square(tmp_path, text):
    square = obj(tmp_path, text)
    np.testing.assert_array_equal(square.mesh.vertices, [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    np.testing.assert_array_equal(square.corners, [0, 1, 2, 3])


def test_uvs_of_corners(tmp_path):
    text = SQUARE + "vt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\nvt 0.5 0.5\nf 1/-1/7 3/3 4/2"
    np.testing.assert_array_equal(obj(tmp_path, text).uvs, [[0, 0], [1, 0], [1, 1], [0.5, 0.5], [1, 1], [1, 0]])


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (SQUARE + "f 1 2 5", "index 5"),
        (SQUARE + "f 0 1 2", "index 0"),
        (SQUARE + "f -5 1 2", "index -5"),
        (SQUARE + "vt 0 0\nf 1/1 2/2 3/1", "index 2"),
        (SQUARE + "f 1 2", "expected at least 3"),
        (SQUARE + "f", "expected at least 3"),
        (SQUARE + "f 1 2 x", "malformed"),
        (SQUARE + "f 1 2 3.5", "malformed"),
        (SQUARE + f"f 1 2 {'9' * 30}", "malformed"),
        (SQUARE + f"f 1 2 {'9' * 300}", "malformed"),
        (SQUARE + "f / / /", "malformed"),
        (SQUARE, "0 faces"),
        ("v 0 0\nf 1 1 1", "has 2 numbers, expected 3"),
        ("v\nf 1 1 1", "has 0 numbers, expected 3"),
        ("v 0 0 zero\nf 1 1 1", "malformed"),
        ("v v 0 0\nf 1 1 1", "malformed"),
        ("", "0 vertices"),
        ("v 0 0 nan\nf 1 1 1", "NaN"),
        ("v 0 0 1e300\nf 1 1 1", "expected finite"),
    ],
)
def test_an_obj_that_is_wrong(tmp_path, text, expected):
    with pytest.raises(RetargetError, match=r"mesh.obj") as error:
        obj(tmp_path, text)
    assert expected in str(error.value)


PLY = """ply
format {order} 1.0
comment a square and a triangle
element vertex 5
property float x
property uchar red
property float y
property float z
property float s
property float t
element material 2
property list ushort float numbers
element face 2
property list uchar int vertex_indices
property short flags
end_header
"""


def test_a_hole_that_one_large_polygon_caps(tmp_path):
    """A star of 300 corners keeps its area, however it is cut."""
    angle = np.linspace(0, 2 * np.pi, 300, endpoint=False)
    x, y = (1 + 0.3 * np.sin(9 * angle)) * [np.cos(angle), np.sin(angle)]
    lines = [f"v {a} {b} 0" for a, b in zip(x, y, strict=True)]
    star = obj(tmp_path, "\n".join([*lines, "f " + " ".join(str(i + 1) for i in range(300))])).mesh
    assert len(star.faces) == 298
    assert (star.face_normals[:, 2] > 0).all()
    assert star.area == pytest.approx(0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)), rel=1e-9)


def test_a_polygon_beyond_all_measure(tmp_path):
    with pytest.raises(RetargetError, match="a polygon with 5000 corners, expected at most 2048"):
        obj(tmp_path, SQUARE + "f " + " 1 2 3 4" * 1250)


@pytest.mark.parametrize("order", ["ascii", "binary_little_endian", "binary_big_endian"])
def test_ply_of_any_byte_order_with_things_that_nobody_asked_for(tmp_path, order):
    vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1]], float)
    vertex = [(x, 7, y, z, x / 2, y / 2) for x, y, z in vertices.tolist()]
    lists = [([1.5, 2.5],), ([],), ([0, 1, 2, 3], 1), ([0, 1, 4], 2)]
    if order == "ascii":
        lines = [" ".join(map(str, row)) for row in vertex]
        lines += [" ".join(map(str, [len(row[0]), *row[0], *row[1:]])) for row in lists]
        body = "\n".join(lines).encode()
    else:
        end = "<" if order == "binary_little_endian" else ">"
        rows = np.array(vertex, [(k, f"{end}{t}") for k, t in zip("abcdef", ["f4", "u1", *["f4"] * 4], strict=True)])
        body = rows.tobytes()
        for row, (length, kind) in zip(lists, [("u2", "f4"), ("u2", "f4"), ("u1", "i4"), ("u1", "i4")], strict=True):
            body += np.array(len(row[0]), end + length).tobytes() + np.array(row[0], end + kind).tobytes()
            body += b"".join(np.array(value, f"{end}i2").tobytes() for value in row[1:])
    path = tmp_path / "mesh.ply"
    path.write_bytes(PLY.format(order=order).encode() + body)
    read = read_mesh(path)
    np.testing.assert_array_equal(read.mesh.vertices, vertices)
    np.testing.assert_array_equal(read.counts, [4, 3])
    np.testing.assert_array_equal(read.corners, [0, 1, 2, 3, 0, 1, 4])
    np.testing.assert_array_equal(read.uvs, vertices[read.corners, :2] / 2)
    path.write_bytes(path.read_bytes()[:-9])
    with pytest.raises(RetargetError, match="no PLY mesh"):
        read_mesh(path)


@pytest.mark.parametrize(
    ("arrays", "expected"),
    [
        ({}, "no array 'vertices'"),
        ({"vertices": np.zeros((4, 2))}, "(4, 2), expected (N, 3)"),
        ({"vertices": np.zeros((4, 3))}, "no array 'faces'"),
        ({"vertices": np.zeros((4, 3)), "faces": np.zeros((1, 3))}, "float64, expected whole numbers"),
        ({"vertices": np.zeros((4, 3)), "faces": np.array([[0, 1, 4]])}, "vertex 4, expected 0 to 3"),
        ({"vertices": np.zeros((4, 3)), "face_counts": np.array([3])}, "face_indices is missing"),
        (
            {"vertices": np.zeros((4, 3)), "face_counts": np.array([9]), "face_indices": np.arange(4)},
            "9 corners, but 4",
        ),
        ({"vertices": np.zeros((4, 3)), "faces": np.array([[0, 1, 2]]), "uvs": np.zeros((2, 2))}, "uvs have shape"),
        ({"vertices": np.array([["a", "b", "c"]])}, "holds <U1"),
    ],
)
def test_an_npz_that_is_wrong(tmp_path, arrays, expected):
    np.savez(tmp_path / "mesh.npz", **arrays)
    with pytest.raises(RetargetError, match=r"mesh.npz") as error:
        read_mesh(tmp_path / "mesh.npz")
    assert expected in str(error.value)


def test_nothing_is_unpickled(tmp_path):
    np.savez(tmp_path / "mesh.npz", vertices=np.array([{}], object), faces=np.zeros((1, 3), int))
    with pytest.raises(RetargetError, match="no NPZ file of plain numbers"):
        read_mesh(tmp_path / "mesh.npz")


def test_compressed_and_other_number_types(tmp_path):
    mesh = dome(4).mesh
    np.savez_compressed(tmp_path / "mesh.npz", vertices=mesh.vertices.astype(">f4"), faces=mesh.faces.astype(np.uint16))
    np.testing.assert_allclose(read_mesh(tmp_path / "mesh.npz").mesh.vertices, mesh.vertices, rtol=1e-7)


def test_another_suffix(tmp_path):
    for path in (tmp_path / "mesh.fbx", tmp_path / "mesh"):
        with pytest.raises(RetargetError, match=r"expected one of .obj, .ply, .npz"):
            read_mesh(path)
        with pytest.raises(RetargetError, match=r"expected one of .obj, .ply, .npz"):
            write_mesh(dome(3), path)


def test_a_large_obj_reads_in_a_time_that_grows_with_its_size(tmp_path):
    """100 000 vertices read in under a second of an idle core; here only against writing out the same numbers."""
    mesh = dome(180)
    start = time.process_time()
    write_mesh(mesh, tmp_path / "mesh.obj")
    middle = time.process_time()
    same(read_mesh(tmp_path / "mesh.obj"), mesh)
    assert time.process_time() - middle < 8 * (middle - start)


def test_the_shared_face(shared_data):
    face = read_mesh(shared_data / "ict_generic_neutral_mesh.obj")
    arrays = read_mesh(shared_data / "ict_dev.npz")
    assert len(face.mesh.vertices) == 26719
    np.testing.assert_allclose(face.mesh.vertices, arrays.mesh.vertices, atol=1e-4)
    np.testing.assert_array_equal(face.corners, arrays.corners)
