"""Scenes from what people have: each number is taken as it is, and what is no scene is refused with a sentence."""

import copy
import decimal
import os
import pickle
import sys
import types
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import sightline

corpus = Path(__file__).parents[2] / "tests" / "corpus"
square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])


def first_coordinate(V):
    return sightline.Scene(V, [[0, 1, 2]]).points(exact=True)[0, 0]


def test_numbers_are_taken_as_they_are():
    rest = [[1, 0, 0], [0, 1, 0]]
    for number in (0.1, np.float32(0.1), 2**53 + 1, -(2**200), Fraction(1, 3), decimal.Decimal("0.1"), np.int64(-7)):
        exactly = Fraction(number.item() if isinstance(number, np.generic) else number)
        assert first_coordinate([[number, 0, 0], *rest]) == exactly, type(number)
    assert first_coordinate([["1/3", 0, 0], *rest]) == Fraction(1, 3)
    assert first_coordinate([["0.1", 0, 0], *rest]) == Fraction(1, 10)
    for kind in (np.float64, np.float32, np.float16, np.longdouble, ">f8", ">f4"):
        V = np.array([[0.1, 0, 0], *rest], dtype=kind)
        assert first_coordinate(V) == Fraction(*V[0, 0].as_integer_ratio()), kind
    for kind in (np.int64, np.int32, np.int16, np.int8, np.uint8, np.uint32, ">i4"):
        assert first_coordinate(np.array([[7, 0, 0], *rest], dtype=kind)) == 7, kind
    for number in (2**53 + 1, -(2**63), 2**63 - 1):
        assert first_coordinate(np.array([[number, 0, 0], *rest], dtype=np.int64)) == number
    assert first_coordinate(np.array([[2**64 - 1, 0, 0], *rest], dtype=np.uint64)) == 2**64 - 1


def test_a_cast_to_doubles_would_change_who_sees_it():
    z = 2**53 + 1  # a double rounds it to 2^53
    V = np.array([[0, 0, z], [1, 0, z], [0, 1, z]], dtype=np.int64)
    scene = sightline.Scene(V, [[0, 1, 2]])
    assert list(scene.see((0, 0, z)).visible) == []
    assert list(scene.see((0, 0, z + 1)).visible) == [0]
    assert list(scene.see((0, 0, z - 1)).visible) == []
    assert list(scene.see((0, 0, z + Fraction(1, 10**30))).visible) == [0]


def test_arrays_of_any_layout_are_read():
    V, F = square.astype(float), np.array([[0, 1, 2], [0, 2, 3]])
    plain = sightline.Scene(V, F)
    wide = np.zeros((8, 6))
    wide[::2, ::2] = V
    read_only = V.copy()
    read_only.flags.writeable = False
    for other, faces in (
        (wide[::2, ::2], F),
        (np.asfortranarray(V), np.asfortranarray(F)),
        (read_only, F.astype(np.uint32)),
        (V[::-1][::-1], np.repeat(F, 2, axis=1)[:, ::2]),
        (V.tolist(), F.tolist()),
        (V.tolist(), [tuple(f) for f in F]),
        (V.astype(object), F.astype(object)),
        (V, F.astype(np.uint64)),
        (V, F.astype(np.int16)),
        (V, [np.array(f) for f in F]),
    ):
        scene = sightline.Scene(other, faces)
        assert (scene.points() == plain.points()).all()
        assert [list(f) for f in scene.faces()] == [[0, 1, 2], [0, 2, 3]]
    assert (V == square).all()


def test_polygons_and_holes():
    V = [*square * 4, *(square + [1, 1, 0])]
    ring = sightline.Scene(V, [[[0, 1, 2, 3], [4, 7, 6, 5]], [4, 5, 6]])
    assert ring.areas.tolist() == [15, 0.5]
    flat = sightline.Scene(V, [0, 1, 2, 3, 4, 7, 6, 5, 4, 5, 6], offsets=[0, 4, 8, 11], face_offsets=[0, 2, 3])
    assert flat.areas.tolist() == [15, 0.5]
    assert flat.info()["with_holes"] == 1
    two = sightline.Scene(V, np.array([0, 1, 2, 3, 4, 7, 6, 5]), offsets=np.array([0, 4, 8]))
    assert two.areas.tolist() == [16, 1]
    assert [[list(loop) for loop in face] for face in ring.faces()[:1]] == [[[0, 1, 2, 3], [4, 7, 6, 5]]]


@pytest.mark.parametrize(
    "V, F, error, words",
    [
        ([[0, 0]], [[0, 0, 0]], ValueError, "shape"),
        (np.zeros(3), [[0, 0, 0]], ValueError, "shape"),
        (np.zeros((3, 3), complex), [[0, 1, 2]], TypeError, "complex"),
        (np.zeros((3, 3), bool), [[0, 1, 2]], TypeError, "bool"),
        ([[True, 0, 0]], [[0, 0, 0]], TypeError, r"V\[0, 0\] is a bool"),
        ([[None, 0, 0]], [[0, 0, 0]], TypeError, r"V\[0, 0\] is a NoneType"),
        ([["a", 0, 0]], [[0, 0, 0]], ValueError, "a"),
        ([[types.SimpleNamespace(numerator=1, denominator=0), 0, 0]], [[0, 0, 0]], ValueError, "the denominator 0"),
        (
            [[Fraction(1, 3**2000), 0, Fraction(1, 5**3000)]],
            [[0, 0, 0]],
            ValueError,
            r"V\[0, 2\]: common denominator of the coordinates needs more than 8192 bits",
        ),
        ([[0, Fraction(1, 10**100000), 0]], [[0, 0, 0]], ValueError, r"V\[0, 1\]: common denominator"),
        ([[10**100000, 0, 0]], [[0, 0, 0]], ValueError, r"V\[0, 0\]: a coordinate beyond 2\^8192"),
        ([[0, float("nan"), 0]], [[0, 0, 0]], ValueError, r"V\[0, 1\] is nan"),
        (np.array([[0, np.inf, 0]]), [[0, 0, 0]], ValueError, r"V\[0, 1\] is inf"),
        (np.array([[0, 0, np.nan]], np.float32), [[0, 0, 0]], ValueError, r"V\[0, 2\] is nan"),
        (np.array([[0, np.inf, 0]], np.longdouble), [[0, 0, 0]], ValueError, r"V\[0, 1\] is inf"),
        (square, [[0, 1, 4]], IndexError, "face 0 has the corner 4, and there are 4 points"),
        (square, [[0, 1, 2], [0, -1, 2]], IndexError, "face 1 has the corner -1"),
        (square, np.array([[0, 1, 2**63]], np.uint64), IndexError, "corner 9223372036854775808,"),
        (square, [[0, 1, 2**63]], IndexError, "F has 9223372036854775808 in it"),
        (square, np.array([[0, 1, -(2**70)]], object), IndexError, "F has -1180591620717411303424 in it"),
        (square, [[0.0, 1.0, 2.0]], TypeError, "F has 0.0, a float, in it"),
        (square, [[0, 1, 2], [0, 1, True]], TypeError, "F has True, a bool, in it"),
        (square, np.array([[0, 1, True]], object), TypeError, "F has True, a bool, in it"),
        (square, [[True, 0, 2]], TypeError, "F has True, a bool, in it"),
        (square, ["012"], TypeError, "F has '0', a str, in it"),
        (square, np.array([[0.0, 1.0, 2.0]]), TypeError, "float64"),
        (square, np.zeros((1, 1, 3), int), ValueError, "shape"),
        (square, np.array([0, 1, 2]), ValueError, "offsets"),
        (square, 7, TypeError, "F is 7; give faces as"),
        (square, "012", TypeError, "F is '012'; give faces as"),
        (np.ma.masked_array(square, square == 1), [[0, 1, 2]], ValueError, "V has numbers that are masked"),
        (square, np.ma.masked_array([[0, 1, 2, 0]], [[0, 0, 0, 1]]), ValueError, "F has numbers that are masked"),
        ("town.obj", None, TypeError, "sightline.read"),
    ],
)
def test_what_is_no_scene_is_refused(V, F, error, words):
    with pytest.raises(error, match=words):
        sightline.Scene(V, F)


@pytest.mark.parametrize(
    "offsets, face_offsets, words",
    [
        ([0, 2], None, "end with 3"),
        ([1, 3], None, "begin with 0"),
        ([], None, "begin with 0"),
        ([0, 3, 1, 3], None, "ascending"),
        ([0, 3], [0, 0, 1], "at least one loop"),
        ([0, 3], [0, 2], "end with 1"),
        ([0, 3], [0, 2**63 - 1, 1], "after 9223372036854775807"),
        ([0, 2**63 - 1, 3], None, "after 9223372036854775807"),
        ([0, 2**70], None, "offsets has 1180591620717411303424 in it"),
        ([[0, 3]], None, r"offsets has the shape \(1, 2\)"),
        ([0, 3], [[0, 1]], r"face_offsets has the shape \(1, 2\)"),
    ],
)
def test_offsets_that_do_not_add_up_are_refused(offsets, face_offsets, words):
    with pytest.raises(ValueError, match=words):
        sightline.Scene(square, [0, 1, 2], offsets=offsets, face_offsets=face_offsets)
    with pytest.raises(ValueError, match="two-dimensional"):
        sightline.Scene(square, [[0, 1, 2]], offsets=[0, 3])


def test_empty_scenes_are_scenes():
    for V, F in (
        ([], []),
        (np.empty((0, 3)), np.empty((0, 3), int)),
        (square, []),
        (np.empty((0, 3), np.float32), np.empty((0, 4), np.int32)),
    ):
        scene = sightline.Scene(V, F)
        assert scene.face_count == 0 and scene.info()["box"] is None
        assert len(scene.see((0, 0, 0)).visible) == 0 and len(scene.order((0, 0, 0)).parts) == 0
        assert scene.graph().components == [] and len(scene.weakly_visible(square[:3]).visible) == 0
        assert scene.areas.shape == (0,) and scene.parts.triangles()[1].shape == (0, 3)
    assert sightline.Scene(square, [[]]).left_out == [(0, "zero area")]


def test_meshes_of_others():
    V, F = square.astype(float), np.array([[0, 1, 2], [0, 2, 3]])
    padded = np.array([3, 0, 1, 2, 4, 0, 1, 2, 3])
    block = types.SimpleNamespace(type="quad", data=np.array([[0, 1, 2, 3]]))
    lines = types.SimpleNamespace(type="line", data=np.array([[0, 1]]))
    for mesh, sizes in (
        (types.SimpleNamespace(vertices=V, faces=F), [3, 3]),
        (types.SimpleNamespace(vertices=V, triangles=F), [3, 3]),
        (types.SimpleNamespace(points=V, faces=padded), [3, 4]),
        (types.SimpleNamespace(points=V, cells=[block]), [4]),
        (types.SimpleNamespace(points=V, cells=[("triangle", F)]), [3, 3]),
    ):
        assert [len(f) for f in sightline.Scene(mesh).faces()] == sizes
        assert [len(f) for f in sightline.Scene.from_trimesh(mesh).faces()] == sizes
    with pytest.warns(UserWarning, match="line"):
        assert sightline.Scene(types.SimpleNamespace(points=V, cells=[block, lines])).face_count == 1
    with pytest.raises(ValueError, match="tetra"):
        sightline.Scene(types.SimpleNamespace(points=V, cells=[("tetra", [[0, 1, 2, 3]])]))
    with pytest.raises(ValueError, match="5 corners follow"):
        sightline.Scene(types.SimpleNamespace(points=V, faces=np.array([5, 0, 1, 2])))
    lists = types.SimpleNamespace(points=[[2**53 + 1, 0, 0], [0.5, 0, 0], ["0.1", 1, 0]], faces=[[0, 1, 2], [0, 1, 2, 0]])
    scene = sightline.Scene(lists)
    assert scene.points(exact=True)[[0, 2], 0].tolist() == [2**53 + 1, Fraction(1, 10)]
    assert [len(f) for f in scene.faces()] == [3, 4]
    assert sightline.Scene(types.SimpleNamespace(points=V.tolist(), faces=padded.tolist())).face_count == 2
    with pytest.raises(TypeError, match="no mesh"):
        sightline.Scene(object())


def test_to_trimesh(monkeypatch):
    made = types.SimpleNamespace(Trimesh=lambda **arguments: types.SimpleNamespace(**arguments))
    monkeypatch.setitem(sys.modules, "trimesh", made)
    mesh = sightline.Scene([*square, [2, 2, 5]], [[0, 1, 1], [0, 1, 2, 3]]).to_trimesh()
    assert mesh.faces.shape == (2, 3) and mesh.face_attributes["face"].tolist() == [1, 1]
    corners = mesh.vertices[mesh.faces]
    assert np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).tolist() == [[0, 0, 1]] * 2
    back = sightline.Scene(mesh)
    assert back.areas.tolist() == [0.5, 0.5]
    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(ImportError, match="trimesh"):
        back.to_trimesh()


def test_files(tmp_path):
    scene = sightline.read(corpus / "general" / "cube.off")
    assert scene.face_count == 6 and scene.info()["closed"]
    third = sightline.Scene([["1/3", 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    third.write(tmp_path / "third.qoff")
    assert sightline.read(str(tmp_path / "third.qoff")).points(exact=True)[0, 0] == Fraction(1, 3)
    with pytest.raises(ValueError):
        third.write(tmp_path / "third.off")
    with pytest.raises(OSError):
        third.write(tmp_path / "no such folder" / "third.qoff")
    (tmp_path / "tenth.obj").write_text("v 0.1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert sightline.read(tmp_path / "tenth.obj").points(exact=True)[0, 0] == Fraction(1, 10)
    rounded = sightline.read(tmp_path / "tenth.obj", coordinates="double", flip=True)
    assert rounded.points(exact=True)[0, 0] == Fraction(0.1) and rounded.see((0, 0, -1)).visible.tolist() == [0]
    with pytest.raises(ValueError, match="coordinates"):
        sightline.read(tmp_path / "tenth.obj", coordinates="float")
    (tmp_path / "bad.obj").write_text("v 0 0 0\nv 1 0 oh\nf 1 2 3\n")
    with pytest.raises(sightline.InputError, match="bad.obj:2:7: ") as caught:
        sightline.read(tmp_path / "bad.obj")
    assert (caught.value.line, caught.value.column, caught.value.byte) == (2, 7, None)
    assert caught.value.file.endswith("bad.obj") and isinstance(caught.value, ValueError)
    with pytest.raises(sightline.InputError) as caught:
        sightline.read(tmp_path / "none.obj")
    assert caught.value.line is None
    strange = os.fsdecode(os.fsencode(tmp_path) + b"/\xff.off")  # no UTF-8
    scene.write(strange)
    for path in (strange, os.fsencode(strange)):
        assert sightline.read(path)._model.file == strange
    with open(strange, "w", encoding="utf-8") as file:
        file.write("OFF\n1 0 0\n0 0 oh\n")
    with pytest.raises(sightline.InputError, match="oh") as caught:
        sightline.read(strange)
    assert caught.value.file == strange


def test_the_box_is_that_of_faces():
    scene = sightline.Scene([*square, [1000, 1000, 1000], [-5, 0, 0], [-6, 0, 0]], [[0, 1, 2, 3], [4, 5, 4]])
    assert scene.info()["box"] == ((0, 0, 0), (1, 1, 0))


def test_scenes_are_pickled_and_copied_exactly():
    V = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, 0], [2, 1, 0], [1, 2, 0]], float)
    rounded = sightline.Scene(V / 3, [[[0, 1, 2], [5, 4, 3]], [3, 4, 5]])
    exact = sightline.Scene([["1/3", 0, 10**40], [1, 0, 0], [0, 1, Fraction(1, 7)]], [[0, 1, 2]])
    for scene in (rounded, exact, sightline.Scene(np.empty((0, 3)), [])):
        for again in (pickle.loads(pickle.dumps(scene)), copy.deepcopy(scene)):
            assert again.points(exact=True).tolist() == scene.points(exact=True).tolist()
            assert [np.concatenate(f).tolist() if isinstance(f, list) else f.tolist() for f in again.faces()] == [
                np.concatenate(f).tolist() if isinstance(f, list) else f.tolist() for f in scene.faces()
            ]
            assert again.areas.tolist() == scene.areas.tolist()
    assert pickle.loads(pickle.dumps(rounded)).points().dtype == float


def test_results_of_set_operations_are_pickled_whatever_their_denominators_are():
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], object)
    F = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
    scale = np.array([1 - Fraction(1, 5**1100), 1 + Fraction(1, 7**900), 1 - Fraction(1, 11**700)])
    other = sightline.Scene(corners * scale - Fraction(1, 9), F)
    union = sightline.boolean("union", sightline.Scene(corners, F), other).scene
    again = pickle.loads(pickle.dumps(union))
    assert again.points(exact=True).tolist() == union.points(exact=True).tolist()
    with pytest.raises(ValueError, match="common denominator"):
        sightline.Scene(union.points(exact=True), union.faces())


def test_what_is_left_out_is_said():
    scene = sightline.Scene(square, [[0, 1, 2], [1, 2, 0], [0, 1, 1]])
    assert scene.left_out == [(1, "duplicate of 0"), (2, "zero area")]
    assert scene.info()["faces"] == 1 and scene.info()["faces_read"] == 3 and scene.info()["left_out"] == scene.left_out
    assert scene.areas.tolist() == [0.5, 0, 0]
    assert [part.face for part in scene.parts] == [0] and scene.parts[0].from_front is None
    assert scene.parts[-1].corners == ((0, 0, 0), (1, 0, 0), (1, 1, 0))
    with pytest.raises(IndexError):
        scene.parts[1]
    assert scene.parts[np.int8(0)].face == 0
    with pytest.raises(TypeError, match="cannot be interpreted as an integer"):
        scene.parts[0.0]
