"""Set operations on solids."""

from fractions import Fraction
from typing import NamedTuple

from . import _sightline
from ._answers import Ids
from ._progress import Progress, followed
from ._scene import Scene, _question


class Solid(NamedTuple):
    """A solid made of others."""

    scene: Scene  #: its surface, closed, fronts outwards; faces may have holes
    sources: Ids  #: of each face, (faces, 2): which solid it was of, and which face there
    volume: Fraction


def boolean(
    operation: str,
    *solids: Scene,
    inside: str = "positive",
    threads: int = 0,
    progress: Progress = None,
    budget: float = 0,
) -> Solid:
    """A set operation on closed surfaces, exactly.

    operation: "union", "intersection", "difference" (the first less all others) or "symmetric-difference" (in an odd
    number of them). inside: where a surface winds round its inside: a "positive", "nonzero" or "odd" number of times.

    >>> cube = Scene([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
    ...              [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [2, 3, 7, 6], [1, 2, 6, 5], [3, 0, 4, 7]])
    >>> other = Scene(cube.points() + [0.5, 0.5, 0.5], cube.faces())
    >>> boolean("intersection", cube, other).volume
    Fraction(1, 8)
    """
    with followed(progress, operation) as told:
        question = _question(threads, told, budget)
        model, sources, volume = _sightline.combine(operation, [solid._model for solid in solids], inside, question)
    return Solid(Scene._of(model), sources, volume)
