"""Meshes as Python has them, made ready for C++: which array holds what. No number is changed here."""

import operator
import warnings
from fractions import Fraction
from itertools import islice
from typing import Any, List, Optional, Sequence, Set, Tuple

import numpy as np
from numpy.typing import NDArray

Faces = Tuple[NDArray[Any], NDArray[np.int64], NDArray[np.int64]]

_kept: Set[Any] = {np.dtype(t) for t in (np.float64, np.float32, np.int64, np.int32, object)}


def check_unmasked(array: Any, name: str) -> None:
    if np.ma.is_masked(array):
        raise ValueError(f"{name} has numbers that are masked; give arrays without them")


def points(V: Any) -> NDArray[Any]:
    """V as (n, 3) of a type that C++ reads, without a copy where it has one. Lists become Python's own numbers."""
    check_unmasked(V, "V")
    array = V if isinstance(V, np.ndarray) else np.array(V, dtype=object)
    if array.size == 0 and array.ndim <= 2 and array.shape[-1] in (0, 3):
        return np.empty((0, 3))
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"V has the shape {array.shape}; give points as (n, 3)")
    if array.dtype in _kept:
        return array
    if array.dtype.kind == "f" and array.dtype.itemsize <= 8 or array.dtype.kind in "iu" and array.dtype != np.uint64:
        wider = np.float64 if array.dtype.kind == "f" else np.int64  # of other bytes or fewer: each number fits
        return array.astype(wider, casting="safe")
    if array.dtype.kind in "fu":  # long double, uint64
        exact = np.empty(array.size, dtype=object)
        exact[:] = [x if array.dtype.kind == "f" else int(x) for x in array.flat]
        return exact.reshape(array.shape)
    raise TypeError(f"V has the type {array.dtype}; give floats, integers, or objects such as Fraction")


def _int64(numbers: List[Any], name: str) -> NDArray[np.int64]:
    """Integers of any kind. Errors: TypeError where one is none, a boolean too; IndexError where one names nothing."""
    for x in numbers:
        if isinstance(x, (bool, np.bool_)) or not hasattr(x, "__index__"):
            raise TypeError(f"{name} has {x!r}, a {type(x).__name__}, in it; give integers, counted from 0")
    try:
        return np.array([operator.index(x) for x in numbers], dtype=np.int64)
    except OverflowError:
        largest = max((operator.index(x) for x in numbers), key=abs)
        raise IndexError(f"{name} has {largest} in it, and nothing has that many points; count from 0") from None


def _whole(numbers: NDArray[Any], name: str) -> NDArray[Any]:
    """Integers of a type that C++ reads."""
    if numbers.size == 0:
        return numbers.astype(np.int64)
    if numbers.dtype == object:
        return _int64(list(numbers.flat), name).reshape(numbers.shape)
    if numbers.dtype.kind not in "iu":
        raise TypeError(f"{name} has the type {numbers.dtype}; give integers, counted from 0")
    if numbers.dtype in (np.int64, np.int32, np.uint32, np.uint64) and numbers.dtype.isnative:
        return numbers
    return numbers.astype(np.uint64 if numbers.dtype.kind == "u" else np.int64)


def kept_point(point: Any) -> Any:
    """A point that a question takes and its answer keeps, whatever becomes of what it was given in."""
    if isinstance(point, str) or not hasattr(point, "__iter__"):
        return point
    check_unmasked(point, "the point")
    return tuple(islice(point.tolist() if isinstance(point, np.ndarray) and point.dtype != object else point, 4))


def fraction(number: Any) -> Fraction:
    """A number as it is."""
    if not isinstance(number, (str, Fraction)) and hasattr(number, "as_integer_ratio"):
        return Fraction(*number.as_integer_ratio())  # numpy's floats, too
    # Of numpy's integers Fraction keeps numerators that overflow.
    return Fraction(operator.index(number) if hasattr(number, "__index__") else number)


def exact_point(point: Any) -> Tuple[Fraction, ...]:
    """A point that a question takes."""
    return tuple(fraction(x) for x in (point.split(",") if isinstance(point, str) else point))


def rounded_point(point: Any) -> NDArray[np.float64]:
    """The same, rounded."""
    return np.array([float(x) for x in exact_point(point)])


def is_index(x: Any) -> bool:
    """Whether it is one integer."""
    return isinstance(x, (int, np.integer)) and not isinstance(x, bool)


def whole_number(x: Any, name: str, least: int = 0, most: int = 2**63 - 1) -> int:
    """It as an int. Errors: ValueError where it is out of range, TypeError where it is none."""
    number = operator.index(x)
    if not least <= number <= most:
        raise ValueError(f"{name} is {number}; give {least} or more" + (f", up to {most}" if number > most else ""))
    return number


def _starts(numbers: Any) -> NDArray[np.int64]:
    """Where something begins, and the last ends."""
    return np.ascontiguousarray(numbers, dtype=np.int64)


def _given_starts(numbers: Any, name: str) -> NDArray[np.int64]:
    """The same, as it was given."""
    try:
        row = _whole(np.asarray(numbers), name)
    except IndexError as error:
        raise ValueError(str(error)) from None
    if row.ndim != 1:
        raise ValueError(f"{name} has the shape {row.shape}; give one row")
    return _starts(row)


_none = _starts([])


def _of_lists(F: Sequence[Any]) -> Faces:
    """Faces of corners, or of loops of corners."""
    corners: List[Any] = []
    loops, faces = [0], [0]
    for face in F:
        nested = len(face) > 0 and hasattr(face[0], "__len__")
        for loop in face if nested else [face]:
            corners.extend(loop)
            loops.append(len(corners))
        faces.append(len(loops) - 1)
    return _int64(corners, "F"), _starts(loops), _starts(faces)


def faces(F: Any, offsets: Any, face_offsets: Any) -> Faces:
    """F as (m, k), or one row of corners with where loops and faces begin."""
    check_unmasked(F, "F")
    if isinstance(F, str) or not hasattr(F, "__len__"):
        raise TypeError(f"F is {F!r}; give faces as (m, 3), (m, 4), lists of corners, or flat with offsets")
    if not isinstance(F, np.ndarray):
        if offsets is None and len(F) > 0 and not is_index(F[0]):
            return _of_lists(F)
        F = np.array(F, dtype=object) if len(F) > 0 else np.empty((0, 3) if offsets is None else 0, dtype=np.int64)
    corners = _whole(F, "F")
    if corners.ndim == 2:
        if offsets is not None or face_offsets is not None:
            raise ValueError("F is two-dimensional, and offsets are for a flat one; leave one of them out")
        return corners, _none, _none
    if corners.ndim != 1:
        raise ValueError(f"F has the shape {corners.shape}; give faces as (m, 3), (m, 4), or flat with offsets")
    if corners.size == 0 and offsets is None:
        return corners.reshape(0, 3), _none, _none
    if offsets is None:
        raise ValueError("F is flat; say by offsets where its loops begin, and where the last ends")
    loops = _given_starts(offsets, "offsets")
    if face_offsets is None:
        return corners, loops, np.arange(len(loops))
    return corners, loops, _given_starts(face_offsets, "face_offsets")


def _of_padded(padded: NDArray[Any]) -> Faces:
    """Faces as VTK has them, each after the number of its corners: [3, a, b, c, 4, a, b, c, d, ...]."""
    padded = _whole(padded, "faces")
    starts, at = [], 0
    while at < len(padded):
        starts.append(at)
        if padded[at] < 0 or at + 1 + padded[at] > len(padded):
            raise ValueError(f"faces[{at}] says that {padded[at]} corners follow, which are not there")
        at += 1 + int(padded[at])
    loops = _starts(np.concatenate([[0], np.cumsum(padded[starts])]))
    return np.delete(padded, starts), loops, np.arange(len(loops))


def _of_cells(cells: Any) -> Faces:
    """Faces as meshio has them: blocks of one type each."""
    rows: List[Any] = []
    for block in cells:
        kind, data = (block.type, block.data) if hasattr(block, "type") else block
        if kind in ("triangle", "quad") or kind.startswith("polygon"):
            rows.extend(data)
        elif kind in ("vertex", "line"):
            warnings.warn(f"{len(data)} cells of the type {kind} are no faces, and are left out", stacklevel=4)
        else:
            raise ValueError(f"cells of the type {kind} are no polygons; give triangles, quads and polygons")
    return _of_lists(rows)


def mesh(thing: Any) -> Tuple[NDArray[Any], Faces]:
    """Points and faces of what has .vertices or .points, and .faces, .triangles or .cells."""
    where = getattr(thing, "vertices", getattr(thing, "points", None))
    what: Optional[Any] = None
    for name in ("faces", "triangles", "cells"):
        what = getattr(thing, name, None) if what is None else what
    if where is None or what is None:
        raise TypeError(
            f"a {type(thing).__name__} is no mesh: it has no .vertices and .faces, .points and .faces, or .points and "
            ".cells; give V and F, or read a file by sightline.read(path)"
        )
    check_unmasked(where, "the mesh")
    check_unmasked(what, "the mesh")
    V = points(where if isinstance(where, (list, tuple)) else np.asarray(where))
    if getattr(thing, "faces", None) is None and getattr(thing, "triangles", None) is None:
        return V, _of_cells(what)
    if isinstance(what, (list, tuple)) and not (len(what) > 0 and is_index(what[0])):
        return V, faces(what, None, None)
    F = np.asarray(what)
    return V, (_of_padded(F) if F.ndim == 1 and F.size > 0 and F.dtype != object else faces(what, None, None))
