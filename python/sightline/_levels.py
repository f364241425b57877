"""The cells of levels, and what these see."""

import operator
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple, Union, overload

import numpy as np
from numpy.typing import NDArray

from . import _sightline
from ._answers import Certificate, Ids, Point
from ._progress import Progress, followed

if TYPE_CHECKING:
    from ._scene import Scene


class Wall(NamedTuple):
    """What two cells have in common: a convex polygon, counterclockwise as seen from the cell in front."""

    front: int  #: the cell in front
    behind: Optional[int]  #: the cell behind; None at the end of the world
    corners: Tuple[Point, ...]
    open: Tuple[Tuple[Point, ...], ...]  #: convex parts that no face covers; none at the end of the world
    faces_front: Ids  #: that cover some of it, and look into the cell in front
    faces_behind: Ids


class Cell:
    """A convex polyhedron that no face passes through."""

    def __init__(self, cells: "Cells", place: int) -> None:
        self.cells = cells
        self.id = place  #: its place in `cells`

    @property
    def is_solid(self) -> bool:
        """Whether faces close up, and it is behind some of them."""
        return bool(self.cells.solid[self.id])

    @property
    def is_outside(self) -> bool:
        """Whether it has no end, but for the box that is put about the scene."""
        return bool(self.cells.outside[self.id])

    @property
    def winding(self) -> int:
        """How often the faces wind round it, where they close up."""
        return int(self.cells.windings[self.id])

    @property
    def region(self) -> int:
        """The number of what it is of: cells with a way through open walls from each to each."""
        return int(self.cells.regions[self.id])

    @property
    def box(self) -> Optional[Tuple[int, int, int]]:
        """The box (x, y, z) of `grid` that it is in; None without."""
        grid = self.cells.grid
        if grid is None:
            return None
        number = int(self.cells._leaves[self.id])
        return number % grid[0], number // grid[0] % grid[1], number // grid[0] // grid[1]

    @property
    def room(self) -> Optional[int]:
        """The volume of `volumes` that it is in, by first faces; None: it is in none, or there are none."""
        number = int(self.cells._leaves[self.id])
        return number if number < self.cells._level.volumes else None

    @property
    def leaf(self) -> Optional[int]:
        """The leaf of the compiled level that it is in, by the file's number; None without `leaves`."""
        return int(self.cells._leaves[self.id]) if self.cells.within_leaves else None

    @property
    def faces(self) -> Ids:
        """Ids of the faces that look into it, sorted."""
        return self.cells._level.faces(self.id)

    @property
    def walls(self) -> List[Wall]:
        """The polygons that bound it."""
        return [Wall(*self.cells._level.wall(i)) for i in self.cells._level.walls(self.id)]

    @property
    def portals(self) -> List[Tuple[Point, ...]]:
        """What of its walls is open, as convex polygons that look out of it: sources of Scene.weakly_visible()."""
        return self.cells._level.portals_of(self.id)

    @property
    def inside(self) -> Point:
        """A point of its inside: the mean of its corners."""
        return self.cells._level.inside(self.id)

    @property
    def volume(self) -> Fraction:
        """How much it holds, exactly."""
        return self.cells._level.volume(self.id)

    def __repr__(self) -> str:
        kind = "solid" if self.is_solid else "without end" if self.is_outside else "a room's"
        return f"<Cell {self.id}: {kind}, {len(self.cells._level.walls(self.id))} walls, {len(self.faces)} faces>"


class Cells(Sequence[Cell]):
    """The cells that a BSP tree of all faces divides space into, within a box twice as large as the scene.

    As a sequence; and what they are as arrays, by cell.
    """

    def __init__(
        self,
        scene: "Scene",
        level: "_sightline.Level",
        grid: Optional[Tuple[int, int, int]],
        leaves: bool,
        seed: int,
    ) -> None:
        self.scene = scene
        self.within_leaves = leaves  #: whether cells lie within the leaves of a compiled level
        self.grid = grid  #: the even boxes along each axis that cells lie within; None: there are none
        self.solid: NDArray[np.bool_] = level.solid().astype(bool)
        self.outside: NDArray[np.bool_] = level.outside().astype(bool)
        self.windings: Ids = level.windings()
        self.regions: Ids = level.regions()
        self._level, self._seed, self._leaves = level, seed, level.leaves()

    def __len__(self) -> int:
        return len(self._level)

    @overload
    def __getitem__(self, place: int) -> Cell: ...
    @overload
    def __getitem__(self, place: slice) -> List[Cell]: ...
    def __getitem__(self, place: Union[int, slice]) -> Union[Cell, List[Cell]]:
        if isinstance(place, slice):
            return [Cell(self, i) for i in range(*place.indices(len(self)))]
        place = operator.index(place)
        if not -len(self) <= place < len(self):
            raise IndexError(f"cell {place} is not there: there are {len(self)}")
        return Cell(self, place % len(self))

    def __iter__(self) -> Iterator[Cell]:
        return (Cell(self, i) for i in range(len(self)))

    @property
    def walls(self) -> List[Wall]:
        """All polygons between cells, each once."""
        return [Wall(*self._level.wall(i)) for i in range(self._level.wall_count)]

    @property
    def portals(self) -> int:
        """How many walls between cells that are not solid are open, in part at least."""
        return self._level.portals

    @property
    def is_closed(self) -> bool:
        """Whether the faces close up; else no cell is solid."""
        return self._level.is_closed

    def at(self, point: Any) -> Optional[Cell]:
        """The cell that a point is in; on a wall one beside it, which is not solid if one is not; None beyond the box."""
        cell = self._level.at(point)
        return None if cell is None else Cell(self, cell)

    def coarse(self, most: int = 1) -> Ids:
        """Cells that are not solid, put together to convex regions without a face inside: each cell's region, or -1.

        No more are put together once there are `most` regions.
        """
        if operator.index(most) < 1:
            raise ValueError(f"most is {most}; give 1 or more")
        return self._level.coarse(most)

    def way_out(self, point: Any) -> List[Cell]:
        """Cells from that of a point to one that has no end, through open walls: a leak; empty: there is no way."""
        return [Cell(self, int(i)) for i in self._level.way_out(point)]

    def pvs(
        self, *, outside: bool = False, threads: int = 0, progress: Progress = None, budget: float = 0
    ) -> "PotentiallyVisible":
        """Which faces each cell sees; outside: cells too from which there is a way out of a level that has rooms."""
        from ._scene import _question

        with followed(progress, "pvs") as told:
            question = _question(threads, told, budget)
            return PotentiallyVisible(self, _sightline.faces_seen(self._level, self._seed, outside, question))

    def pairs(
        self, *, outside: bool = False, threads: int = 0, progress: Progress = None, budget: float = 0
    ) -> "CellPairs":
        """Which cells see each other: `sightline pvs --cells-too`. Arguments are those of pvs()."""
        from ._scene import _question

        with followed(progress, "pairs of cells") as told:
            question = _question(threads, told, budget)
            return CellPairs(self, _sightline.cells_seen(self._level, self._seed, outside, question))

    def __repr__(self) -> str:
        solid, outside = np.count_nonzero(self.solid), np.count_nonzero(self.outside)
        return f"<Cells: {len(self)}, {solid} solid, {outside} without end, {self.portals} portals>"


class PotentiallyVisible:
    """Of each cell that is asked about the faces some point of which is seen from some point of its inside."""

    def __init__(self, cells: Cells, rows: List[Tuple[int, Ids, Ids]]) -> None:
        self.cells = cells
        self.visible: Dict[int, Ids] = {cell: seen for cell, seen, _ in rows}  #: by cell: ids, sorted
        self.undecided: Dict[int, Ids] = {cell: left for cell, _, left in rows}  #: empty, unless the budget ran out

    def at(self, point: Any) -> Optional[Ids]:
        """What the cell of a point sees; None where there is none, or it was not asked about."""
        cell = self.cells.at(point)
        return None if cell is None else self.visible.get(cell.id)

    def certificate(self, cell: int, *, threads: int = 0, progress: Progress = None, budget: float = 0) -> Certificate:
        """What is shown of a cell: what its portals see. It sees the faces that look into it besides.

        Made when it is asked for, by looking from its portals again, and what `budget` leaves open stays open.
        """
        if operator.index(cell) not in self.visible:
            raise KeyError(f"cell {cell} is not there, or was not asked about")
        portals = self.cells[cell].portals
        if not portals:
            raise ValueError(f"cell {cell} has no portals: it sees the faces that look into it, and no others")
        ask = self.cells.scene.weakly_visible
        return ask(portals, threads=threads, progress=progress, budget=budget).certificate()

    def table(self) -> NDArray[np.bool_]:
        """Whether each cell sees each face, (cells, faces)."""
        seen = np.zeros((len(self.cells), self.cells.scene.face_count), bool)
        for cell, faces in self.visible.items():
            seen[cell, faces] = True
        return seen

    def __repr__(self) -> str:
        visible, undecided = (sum(map(len, of.values())) for of in (self.visible, self.undecided))
        return f"<PotentiallyVisible: {len(self.visible)} cells, {visible} pairs visible, {undecided} undecided>"


class CellPairs:
    """Of each cell that is asked about the other cells some point of which is seen from some point of its inside."""

    def __init__(self, cells: Cells, rows: List[Tuple[int, Ids, Ids]]) -> None:
        self.cells = cells
        self.visible: Dict[int, Ids] = {cell: seen for cell, seen, _ in rows}  #: by cell: cells, sorted; symmetric
        self.undecided: Dict[int, Ids] = {cell: left for cell, _, left in rows}  #: empty, unless the budget ran out

    def __repr__(self) -> str:
        visible, undecided = (sum(map(len, of.values())) // 2 for of in (self.visible, self.undecided))
        return f"<CellPairs: {len(self.visible)} cells, {visible} pairs visible, {undecided} undecided>"


def counts_of(grid: Any) -> Optional[Tuple[int, int, int]]:
    """Three positive counts. Errors: ValueError, TypeError."""
    if grid is None:
        return None
    if isinstance(grid, str) or len(grid) != 3:
        raise ValueError(f"grid is {grid!r}; give three positive numbers, like (8, 8, 2)")
    x, y, z = (operator.index(count) for count in grid)
    if min(x, y, z) < 1 or x * y * z > 1000000:
        raise ValueError(f"grid is {grid!r}; give three positive numbers, at most 1000000 boxes")
    return x, y, z
