"""Set operations on solids."""

from fractions import Fraction
from typing import Tuple

from . import _sightline
from ._answers import Certificate, Ids, Verdict
from ._progress import Progress, followed
from ._scene import Scene, _question


class SolidCertificate(Certificate):
    """What a set operation can show for itself: text that the program's `verify --solid ... --result` reads."""

    def __init__(self, scene: Scene, solids: Tuple[Scene, ...], text: str) -> None:
        super().__init__(scene, text)
        self._solids = solids

    def verify(self) -> Verdict:
        """Checks that it proves the operation, and that the scene is its result, by code of its own."""
        models = [solid._model for solid in self._solids]
        return Verdict(*_sightline.verify_solids(models, self._scene._model, self.text, _question(0, None, 0)))


class Solid:
    """A solid made of others."""

    def __init__(
        self,
        solids: Tuple[Scene, ...],
        model: "_sightline.Model",
        sources: Ids,
        volume: Fraction,
        certifier: "_sightline.Certifier",
    ) -> None:
        #: its surface, closed, fronts outwards; faces may have holes. It is made ready when it is first asked for more
        #: than points and faces, which no budget bounds: where new points have many denominators that takes long
        self.scene = Scene._of(model)
        self.sources = sources  #: of each face, (faces, 2): which solid it was of, and which face there
        self.volume = volume
        self._solids, self._certifier = solids, certifier

    @property
    def area(self) -> Tuple[float, float]:
        """The least and the most that its surface may have, close to each other."""
        return _sightline.area_of(self.scene._model)

    def certificate(self) -> SolidCertificate:
        """What the answer can show for itself. It takes the time of the answer again."""
        return SolidCertificate(self.scene, self._solids, self._certifier.text())

    def __repr__(self) -> str:
        return f"<Solid: {self.scene.face_count} faces around {float(self.volume):.6g}>"


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
    >>> "%.6f %.6f" % boolean("union", cube, other).area
    '10.500000 10.500000'
    >>> boolean("union", cube, other).certificate().verify().accepted
    True
    """
    for place, solid in enumerate(solids):
        if not isinstance(solid, Scene):
            raise TypeError(f"solid {place} is a {type(solid).__name__}; give each as a Scene")
    with followed(progress, operation) as told:
        question = _question(threads, told, budget)
        found = _sightline.combine(operation, [solid._model for solid in solids], inside, question)
    return Solid(solids, *found)
