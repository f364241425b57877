"""Exact 3D visibility: who can see what, with answers that can be checked.

>>> import sightline
>>> scene = sightline.Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
>>> scene.see((0, 0, 1)).visible
array([0])
"""

from ._along import Change, Event, Moment, SeenAlong
from ._answers import Answer, Certificate, Graph, Order, Part, Parts, Tracker, Verdict, View, WeakView
from ._errors import InputError, OutOfBudget
from ._judging import Failure, FuzzReport, Generated, Report, families, fuzz, generate, judge
from ._levels import Cell, CellPairs, Cells, PotentiallyVisible, Wall
from ._rays import Hit, Rays
from ._scene import Scene, read, verify
from ._shadows import DarkSpace, Shadow
from ._sightline import version as __version__
from ._solids import Solid, boolean

__all__ = [
    "Answer",
    "Cell",
    "CellPairs",
    "Cells",
    "Certificate",
    "Change",
    "DarkSpace",
    "Event",
    "Failure",
    "FuzzReport",
    "Generated",
    "Hit",
    "Graph",
    "InputError",
    "Moment",
    "Order",
    "OutOfBudget",
    "Part",
    "Parts",
    "PotentiallyVisible",
    "Rays",
    "Report",
    "Scene",
    "SeenAlong",
    "Shadow",
    "Solid",
    "Tracker",
    "Verdict",
    "View",
    "Wall",
    "WeakView",
    "boolean",
    "families",
    "fuzz",
    "generate",
    "judge",
    "read",
    "verify",
]
