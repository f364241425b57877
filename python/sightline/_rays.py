"""Rays, and what they meet."""

import operator
from fractions import Fraction
from numbers import Integral
from typing import TYPE_CHECKING, Any, List, NamedTuple, Optional, Sequence, Tuple, Union, overload

import numpy as np
from numpy.typing import NDArray

from . import _sightline
from ._answers import Ids, Point
from ._arrays import check_unmasked

if TYPE_CHECKING:
    from ._scene import Scene

Doubles = NDArray[np.float64]


class Hit(NamedTuple):
    """A part of a ray that a face holds, exactly."""

    face: int
    side: int  #: 1: the ray comes from the front, -1: from behind, 0: it runs along the face
    t: Fraction  #: where it begins: at origin + t direction
    until: Fraction  #: where it ends, t but for a ray along the face
    point: Point  #: where it begins


def _rows(numbers: Any, name: str) -> NDArray[Any]:
    if isinstance(numbers, str):
        raise TypeError(f"{name} is text; give points of three numbers")
    check_unmasked(numbers, name)
    # A copy, as answers keep it.
    array = np.array(numbers, dtype=None if isinstance(numbers, np.ndarray) else object)
    if array.size == 0:
        array = np.empty((0, 3))
    if array.ndim == 1:
        array = array[np.newaxis]
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name} has the shape {array.shape}; give (n, 3), or (3,) for all rays")
    if array.dtype.kind not in "fiuO":
        raise TypeError(f"{name} has the type {array.dtype}; give floats, integers, or objects such as Fraction")
    return array


def pairs(origins: Any, directions: Any) -> Tuple[NDArray[Any], NDArray[Any]]:
    """Both as (n, 3)."""
    o, d = _rows(origins, "origins"), _rows(directions, "directions")
    if len(o) != len(d) and 1 not in (len(o), len(d)):
        raise ValueError(f"there are {len(o)} origins and {len(d)} directions; give as many, or one")
    n = min(len(o), len(d)) if 0 in (len(o), len(d)) else max(len(o), len(d))
    return np.broadcast_to(o[:n] if len(o) > n else o, (n, 3)), np.broadcast_to(d[:n] if len(d) > n else d, (n, 3))


def _doubles(numbers: NDArray[Any]) -> Optional[Doubles]:
    """The same numbers as doubles, where they are doubles."""
    if len(numbers) > 1 and numbers.strides[0] == 0:  # one point for all rays
        one = _doubles(numbers[:1])
        return None if one is None else np.ascontiguousarray(np.broadcast_to(one, numbers.shape))
    if numbers.dtype.kind == "f" and numbers.dtype.itemsize <= 8:
        return np.ascontiguousarray(numbers, dtype=np.float64)
    if numbers.dtype.kind in "iu" and numbers.dtype.itemsize <= 4:
        return np.ascontiguousarray(numbers, dtype=np.float64)
    try:
        rounded = np.array([float(x) for x in numbers.flat], dtype=np.float64).reshape(numbers.shape)
    except (TypeError, ValueError, OverflowError):
        return None

    def is_same(x: Any) -> bool:
        if isinstance(x, (str, bool)):
            return False
        if isinstance(x, Integral):  # numpy's own are compared in doubles with a double
            return int(float(x)) == int(x)
        return bool(float(x) == x)

    return rounded if all(is_same(x) for x in numbers.flat) else None


def _rounded(numbers: NDArray[Any]) -> Doubles:
    if len(numbers) > 1 and numbers.strides[0] == 0:
        return np.broadcast_to(_rounded(numbers[:1]), numbers.shape)
    if numbers.dtype != object:
        return numbers.astype(np.float64)
    return np.array([float(Fraction(x) if isinstance(x, str) else x) for x in numbers.flat]).reshape(numbers.shape)


def as_doubles(o: NDArray[Any], d: NDArray[Any]) -> Optional[Tuple[Doubles, Doubles]]:
    """Both as doubles, where they are."""
    first, second = _doubles(o), _doubles(d)
    return None if first is None or second is None else (first, second)


class Rays(Sequence[List[Hit]]):
    """What rays meet first, as arrays; and the hits of each, exactly, as a sequence."""

    def __init__(
        self,
        scene: "Scene",
        origins: NDArray[Any],
        directions: NDArray[Any],
        columns: "_sightline.Columns",
        hits: Optional["_sightline.Hits"],
        closed: bool,
    ) -> None:
        self.scene = scene
        self.faces: Ids = columns[0]  #: the first face that each meets, (n,), exactly; -1: none
        self.sides: NDArray[np.int8] = columns[1]  #: 1: from the front, -1: from behind, 0: along, or none
        self.tied: NDArray[np.bool_] = columns[2]  #: whether other faces are met there too, (n,)
        self.t: Doubles = columns[3]  #: where, (n,), rounded; nan: nowhere
        self._origins, self._directions, self._hits, self._closed = origins, directions, hits, closed

    @property
    def points(self) -> Doubles:
        """Where each meets its first face, (n, 3), rounded; nan: nowhere."""
        found: Doubles = _rounded(self._origins) + self.t[:, np.newaxis] * _rounded(self._directions)
        return found

    def __len__(self) -> int:
        return len(self.faces)

    @overload
    def __getitem__(self, place: int) -> List[Hit]: ...
    @overload
    def __getitem__(self, place: slice) -> List[List[Hit]]: ...
    def __getitem__(self, place: Union[int, slice]) -> Union[List[Hit], List[List[Hit]]]:
        """The exact hits of a ray: all, if all were asked for, else those where it first meets something."""
        if isinstance(place, slice):
            return [self[i] for i in range(*place.indices(len(self)))]
        place = operator.index(place)
        if not -len(self) <= place < len(self):
            raise IndexError(f"ray {place} is not there: there are {len(self)}")
        i = place % len(self)
        if self._hits is not None:
            return [Hit(*hit) for hit in self._hits.of(i)]
        question = _sightline.Question(1, None, 0, False)
        row = slice(i, i + 1)
        one = _sightline.traced(
            self.scene._model, self._origins[row], self._directions[row], False, self._closed, question
        )
        return [Hit(*hit) for hit in one.of(0)]

    def __repr__(self) -> str:
        return f"<{len(self)} rays, {np.count_nonzero(self.faces >= 0)} meet something>"
