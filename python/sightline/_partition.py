"""Where the light of a source changes on a face."""

from typing import TYPE_CHECKING, Any, Dict, List, NamedTuple, Optional, Tuple

from ._answers import Point

if TYPE_CHECKING:
    from ._scene import Scene

Bounds = Tuple[float, float]  #: two doubles that a number is between


class LightCell(NamedTuple):
    """A region from all of whose points, but for curves, the same is seen of the source."""

    light: str  #: "lit", "penumbra", "umbra"; "undecided" where the budget ran out
    piece: int  #: of the face
    point: Point  #: a point of it, exactly
    area: Bounds  #: as a share of the piece
    edges: List[List[Tuple[Point, Point]]]  #: with all_borders: edges that bound what is seen of each source


class LightBorder(NamedTuple):
    """A part of a curve between two cells."""

    kind: str  #: "line", "conic"; "upright": a line of one x
    piece: int
    #: integers; of a line a, b, c of a + b x + c y, of a conic of 1, x, y, x^2, x y, y^2, in the piece's chart
    curve: Tuple[int, ...]
    below: Optional[int]  #: a place in `cells`, None outside of the piece; left of it where it is upright
    above: Optional[int]
    x: Tuple[Bounds, Bounds]  #: of its ends
    y: Tuple[Bounds, Bounds]


class Chart(NamedTuple):
    """Coordinates of a convex piece of the face: a point is origin + x u + y v."""

    piece: int
    origin: Point
    u: Point
    v: Point


class LightPartition:
    """What of a face's front sees all of a source, a part of it, or nothing."""

    def __init__(
        self,
        scene: "Scene",
        face: int,
        shares: Dict[str, Bounds],
        cells: List[Tuple[Any, ...]],
        borders: List[Tuple[Any, ...]],
        charts: List[Tuple[Any, ...]],
    ) -> None:
        self.scene, self.face = scene, face
        self.shares = shares  #: of the face's area: of "lit", "penumbra", "umbra", "undecided"
        self.cells = [LightCell(*cell) for cell in cells]
        self.borders = [LightBorder(*border) for border in borders]
        self.charts = [Chart(*chart) for chart in charts]

    def __repr__(self) -> str:
        middle = {light: (low + high) / 2 for light, (low, high) in self.shares.items()}
        named = ", ".join(f"{light} {share:.6f}" for light, share in middle.items() if share > 0)
        return f"<LightPartition of face {self.face}: {named}; {len(self.cells)} cells>"
