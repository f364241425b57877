"""Exact 3D visibility: who can see what, with answers that can be checked.

>>> import sightline
>>> scene = sightline.Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
>>> scene.see((0, 0, 1)).visible
array([0])
"""

from ._along import Change, Event, Moment, SeenAlong
from ._answers import Answer, Certificate, Graph, Line, Order, Part, Parts, Stretch, Tracker, Verdict, View, WeakView
from ._errors import InputError, OutOfBudget
from ._judging import Failure, FuzzReport, Generated, Report, families, fuzz, generate, judge
from ._levels import Cell, CellPairs, Cells, PotentiallyVisible, Wall
from ._partition import Chart, LightBorder, LightCell, LightPartition
from ._pictures import Picture
from ._rays import Hit, Rays
from ._scene import Scene, read, verify
from ._shadows import DarkSpace, Shadow
from ._sightline import version as __version__
from ._solids import Solid, SolidCertificate, boolean

__all__ = [
    "Answer",
    "Cell",
    "CellPairs",
    "Cells",
    "Certificate",
    "Change",
    "Chart",
    "DarkSpace",
    "Event",
    "Failure",
    "FuzzReport",
    "Generated",
    "Hit",
    "Graph",
    "InputError",
    "LightBorder",
    "LightCell",
    "LightPartition",
    "Line",
    "Moment",
    "Order",
    "OutOfBudget",
    "Part",
    "Parts",
    "Picture",
    "PotentiallyVisible",
    "Rays",
    "Report",
    "Scene",
    "SeenAlong",
    "Shadow",
    "Solid",
    "SolidCertificate",
    "Stretch",
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
