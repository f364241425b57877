"""Images of what an eye sees: faces at pixels' centres, and means over pixels' squares, both exact."""

import math
import operator
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _sightline
from ._arrays import check_unmasked, exact_point, fraction
from ._progress import Progress, followed

if TYPE_CHECKING:
    from ._scene import Scene

Doubles = NDArray[np.float64]
Axes = Tuple[Doubles, Doubles, Doubles]


def _doubles(direction: Any, what: str) -> Doubles:
    check_unmasked(direction, what)
    try:
        exact = exact_point(direction)
    except (ArithmeticError, ValueError):  # of infinity, nan, a denominator 0, words
        exact = ()
    if len(exact) != 3:
        raise ValueError(f"{what} is {direction!r}; give a direction of three finite numbers")
    largest = max(map(abs, exact))
    # Neither huge nor tiny, so that its length can be told; by a power of two, so that it is the same direction.
    power = largest.denominator.bit_length() - largest.numerator.bit_length()
    return np.array([float(x * Fraction(2) ** power) for x in exact])


def middle_from(eye: Any, box: Any) -> Tuple[float, ...]:
    """The direction to the middle of a box, its longest coordinate 1 long."""
    way = [(fraction(a) + fraction(b)) / 2 - x for a, b, x in zip(box[0], box[1], exact_point(eye))]
    size = max(map(abs, way))
    if size == 0:
        raise ValueError("the eye is in the middle of the scene; give look, the direction to look in")
    return tuple(float(x / size) for x in way)


def axes_of(look: Any, up: Any, field: float, size: Tuple[int, int]) -> Axes:
    """Where an image looks, and to its right and upper side: pixels look between look - right and look + right."""
    to, upwards = _doubles(look, "look"), _doubles(up, "up")
    if not np.any(to):
        raise ValueError("look is zero; give the direction to look in")
    if not 0 < field < 180:
        raise ValueError(f"field is {field}; give degrees between 0 and 180, of the image's width")
    to = to / np.linalg.norm(to)
    right = np.cross(to, upwards)
    length = np.linalg.norm(right)
    if not length > 1e-9 * np.linalg.norm(upwards):
        raise ValueError(f"up is {up!r}, along the direction to look in, or so nearly that doubles do not tell; give another one")
    right = right / length
    half = math.tan(math.radians(field) / 2)
    return to, half * right, half * size[1] / size[0] * np.cross(right, to)


def size_of(size: Any) -> Tuple[int, int]:
    """Width and height. Errors: ValueError."""
    numbers = tuple(operator.index(n) for n in size)
    width, height = numbers if len(numbers) == 2 else (0, 0)
    if not (1 <= width <= 2**20 and 1 <= height <= 2**20 and width * height <= 2**28):
        raise ValueError(f"size is {size!r}; give width and height from 1, with at most 2**28 pixels")
    return width, height


class Picture:
    """What an eye sees in the pixels of an image, rows from the top.

    A pixel in column x of row y looks along look + (2 (x + 1/2) / width - 1) right + (1 - 2 (y + 1/2) / height) up.
    """

    def __init__(self, scene: "Scene", eye: Any, axes: Axes, size: Tuple[int, int], *columns: Any) -> None:
        self.scene, self.eye = scene, eye
        self.look, self.right, self.up = axes
        self.size = size  #: width, height
        #: (height, width): the face that an exact ray through each pixel's centre meets first, -1 where there is none
        self.faces: NDArray[np.int64] = columns[0]
        self.sides: NDArray[np.int8] = columns[1]  #: 1 where it is seen from its front, -1 from behind, 0: nothing
        #: where others are met there too, or the ray runs through the border of one of the face's convex parts
        self.tied: NDArray[np.bool_] = columns[2]

    @property
    def rays(self) -> Doubles:
        """The directions of pixels' centres, (height, width, 3), rounded."""
        width, height = self.size
        across = (2 * np.arange(width) + 1 - width) / width
        upwards = (height - 2 * np.arange(height) - 1) / height
        rays: Doubles = self.look + across[None, :, None] * self.right + upwards[:, None, None] * self.up
        return rays

    def means(
        self, values: Any, *, threads: int = 0, progress: Progress = None, budget: float = 0
    ) -> Tuple[Doubles, Doubles]:
        """The mean over each pixel's square of what is seen: anti-aliased without samples.

        values: colours, or any three numbers, of each face, (faces, 3). Returns the sums, each value times its share of
        the square, (height, width, 3), and the share in which something is seen, (height, width): on a background b,
        the colour is sums + (1 - shares) b. Regions are exact; their corners are rounded to 2^-30 of a pixel.
        """
        from ._scene import _question

        check_unmasked(values, "values")
        if np.iscomplexobj(values):
            raise TypeError("values are complex; give real numbers")
        colours = np.ascontiguousarray(values, dtype=float)
        if colours.shape != (self.scene.face_count, 3) or not np.all(np.isfinite(colours)):
            raise ValueError(f"values: give finite numbers, ({self.scene.face_count}, 3), three for each face")
        with followed(progress, "render") as told:
            question = _question(threads, told, budget)
            axes = (self.look, self.right, self.up)
            return _sightline.means(self.scene._model, self.eye, axes, *self.size, colours, question)

    def __repr__(self) -> str:
        seen = np.unique(self.faces[self.faces >= 0])
        return f"<Picture: {self.size[0]} x {self.size[1]}, {len(seen)} of {self.scene.face_count} faces>"
