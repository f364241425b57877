"""What lights reach."""

from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _sightline
from ._answers import Ids, Parts, Point
from ._progress import Progress, followed

if TYPE_CHECKING:
    from ._scene import Scene


class DarkSpace(NamedTuple):
    """The points of a box that a light does not reach, as a solid."""

    scene: "Scene"  #: its surface, closed, fronts outwards; faces may have holes
    volume: Fraction
    box: Tuple[Point, Point]  #: the scene's, larger by a quarter of its longest side all around


class Shadow:
    """What a light reaches: of faces that are turned to it convex parts, each lit all over or shadowed all over."""

    def __init__(
        self, scene: "Scene", at: Any, is_sun: bool, lit: Ids, away: Ids, by: Ids, parts: "_sightline.Parts"
    ) -> None:
        self.scene = scene
        self._at, self._is_sun = at, is_sun
        self.lit = lit  #: ids of faces that are lit, in part at least, sorted
        self.away = away  #: ids of faces that are not turned to the light: it is behind, or in their plane
        self.parts = Parts(parts)  #: of faces turned to the light, which they tile; `from_front`: where it is
        self.by = by  #: of each part the face that the light meets first on its way there, (parts,); -1: it is lit

    @property
    def dark(self) -> Ids:
        """Ids of faces no part of which is lit, sorted: those that are `away` too."""
        return np.setdiff1d(self.scene.parts.faces, self.lit)

    def _by_face(self, chosen: NDArray[np.bool_]) -> NDArray[np.float64]:
        faces, areas = self.parts.faces[chosen], self.parts.areas[chosen]
        return np.bincount(faces, areas, minlength=self.scene.face_count).astype(float)

    @property
    def lit_areas(self) -> NDArray[np.float64]:
        """Of each face the area that is lit, (faces,), in the scene's units squared."""
        return self._by_face(self.by < 0)

    @property
    def dark_areas(self) -> NDArray[np.float64]:
        """Of each face the area that others shadow, (faces,); 0 for faces that are `away`."""
        return self._by_face(self.by >= 0)

    def space(self, *, threads: int = 0, progress: Progress = None, budget: float = 0) -> DarkSpace:
        """What the faces keep the light from, exactly, within a box about the scene; both sides of faces shadow."""
        from ._scene import Scene, _question

        with followed(progress, "the space in shadow") as told:
            model, volume, box = _sightline.dark_space(
                self.scene._model, self._at, self._is_sun, _question(threads, told, budget)
            )
        return DarkSpace(Scene._of(model), volume, box)

    def __repr__(self) -> str:
        lit = np.count_nonzero(self.by < 0)
        return f"<Shadow: {len(self.lit)} faces lit, {lit} lit parts, {len(self.parts) - lit} in shadow>"
