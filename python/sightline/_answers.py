"""What questions answer: arrays of face ids, parts with exact corners, certificates."""

import json
import operator
import os
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple, Union, overload

import numpy as np
from numpy.typing import NDArray

from . import _sightline

if TYPE_CHECKING:
    from ._scene import Scene

Point = Tuple[Fraction, Fraction, Fraction]
Ids = NDArray[np.int64]


class Verdict:
    """What a checker says of a certificate: true where it accepts it, and one line that says why."""

    def __init__(self, accepted: bool, why: str) -> None:
        self.accepted, self.why = accepted, why

    def __bool__(self) -> bool:
        return self.accepted

    def __repr__(self) -> str:
        return f"{'accepted' if self.accepted else 'rejected'}: {self.why}"


class Certificate:
    """What an answer can show for itself: text that `sightline.verify` and the program's `verify` read."""

    def __init__(self, scene: "Scene", text: str) -> None:
        self._scene, self.text = scene, text

    @property
    def data(self) -> Dict[str, Any]:
        """The same as dictionaries and lists; exact numbers are strings "p" or "p/q"."""
        found: Dict[str, Any] = json.loads(self.text)
        return found

    def verify(self) -> Verdict:
        """Checks it, by code that shares nothing with what made it."""
        return self._scene.verify(self)

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes it to a file, for `sightline verify SCENE CERTIFICATE`."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.text)

    def __repr__(self) -> str:
        return f"<Certificate: {len(self.text)} characters>"


class Part:
    """A convex part of a face, counterclockwise as seen from the face's front."""

    def __init__(self, parts: "_sightline.Parts", place: int) -> None:
        self._parts, self._place = parts, place

    @property
    def face(self) -> int:
        """The id of its face."""
        return self._parts.face(self._place)

    @property
    def piece(self) -> int:
        """Which convex piece of the face it is of; 0 for a convex face."""
        return self._parts.piece(self._place)

    @property
    def from_front(self) -> Optional[bool]:
        """Whether it is seen from its front; None where nobody looks."""
        return self._parts.from_front(self._place)

    @property
    def corners(self) -> Tuple[Point, ...]:
        """Its corners, exactly."""
        return self._parts.corners(self._place)

    @property
    def points(self) -> NDArray[np.float64]:
        """Its corners as (k, 3), each the nearest double."""
        return self._parts.points(self._place)

    def __repr__(self) -> str:
        return f"<Part of face {self.face}: {len(self.points)} corners>"


class Parts(Sequence[Part]):
    """Parts of faces, as a sequence; and all of them as arrays."""

    def __init__(self, parts: "_sightline.Parts") -> None:
        self._parts = parts

    def __len__(self) -> int:
        return len(self._parts)

    @overload
    def __getitem__(self, place: int) -> Part: ...
    @overload
    def __getitem__(self, place: slice) -> List[Part]: ...
    def __getitem__(self, place: Union[int, slice]) -> Union[Part, List[Part]]:
        if isinstance(place, slice):
            return [Part(self._parts, i) for i in range(*place.indices(len(self)))]
        place = operator.index(place)
        if not -len(self) <= place < len(self):
            raise IndexError(f"part {place} is not there: there are {len(self)}")
        return Part(self._parts, place % len(self))

    def __iter__(self) -> Iterator[Part]:
        return (Part(self._parts, i) for i in range(len(self)))

    @property
    def faces(self) -> Ids:
        """The face of each part, (parts,)."""
        return self._parts.faces()

    @property
    def fronts(self) -> NDArray[np.bool_]:
        """Whether each is seen from its front, (parts,); all are where nobody looks."""
        return self._parts.fronts()

    @property
    def areas(self) -> NDArray[np.float64]:
        """The area of each, (parts,), to about 2^-50."""
        return self._parts.areas()

    def points(self) -> Tuple[NDArray[np.float64], Ids]:
        """All corners as (n, 3) doubles, and where each part begins, (parts + 1,)."""
        return self._parts.all_points()

    def triangles(self) -> Tuple[NDArray[np.float64], Ids, Ids]:
        """V (n, 3), F (m, 3) that fan the parts out, and the face of each triangle, (m,)."""
        V, starts = self.points()
        sizes = np.diff(starts)
        of = np.repeat(np.arange(len(sizes)), np.maximum(sizes - 2, 0))
        first = starts[:-1][of]
        ends = np.cumsum(np.maximum(sizes - 2, 0))
        step = np.arange(len(of)) - np.concatenate([[0], ends[:-1]]).astype(np.int64)[of] if len(of) else of
        F = np.stack([first, first + step + 1, first + step + 2], axis=1) if len(of) else np.empty((0, 3), np.int64)
        return V, F, self.faces[of]

    def __repr__(self) -> str:
        return f"<{len(self)} parts of {len(np.unique(self.faces))} faces>"


class Answer:
    """What all answers have: the scene they are about, and a certificate."""

    def __init__(self, scene: "Scene", certifier: "_sightline.Certifier") -> None:
        self.scene = scene
        self._certifier = certifier

    def certificate(self) -> Certificate:
        """What the answer can show for itself, made when it is asked for."""
        return Certificate(self.scene, self._certifier.text())


class Order(Answer):
    """An exact back-to-front order: no part hides, even in part, one that comes after it."""

    def __init__(self, scene: "Scene", eye: Any, parts: "_sightline.Parts", certifier: "_sightline.Certifier") -> None:
        super().__init__(scene, certifier)
        self.eye = eye
        self.parts = Parts(parts)

    @property
    def faces(self) -> Ids:
        """The face of each part, farthest first; a face that had to be cut is there several times."""
        return self.parts.faces

    def __repr__(self) -> str:
        return f"<Order: {self.parts!r}, farthest first>"


class Graph(Answer):
    """Which faces may obscure which, from anywhere: components, those that may obscure others first."""

    def __init__(
        self, scene: "Scene", components: List[Ids], cyclic: int, certifier: "_sightline.Certifier"
    ) -> None:
        super().__init__(scene, certifier)
        self.components = components  #: places in `scene.parts`
        self.cyclic = cyclic  #: components of more than one part

    @property
    def faces(self) -> List[Ids]:
        """The faces of each component, sorted."""
        of = self.scene.parts.faces
        return [np.unique(of[component]) for component in self.components]

    def __repr__(self) -> str:
        return f"<Graph: {len(self.components)} components, {self.cyclic} of them cycles>"


class Stretch(NamedTuple):
    """A part of a line, from ends[0] + start (ends[1] - ends[0])."""

    start: Fraction
    end: Fraction
    hidden_by: Optional[int]  #: a face that hides it; None: it is seen


class Line(NamedTuple):
    """An edge of the scene, or a line where faces cross, in the drawing of what is seen."""

    kind: str  #: "boundary", "silhouette", "smooth", "crease"; "intersection": faces cross there
    ends: Tuple[Point, Point]
    faces: List[int]  #: that it bounds; that cross there
    stretches: List[Stretch]  #: from end to end


class View(Answer):
    """What is seen from a point, all around or in a frustum."""

    def __init__(
        self,
        scene: "Scene",
        eye: Any,
        two_sided: bool,
        fronts: Ids,
        from_behind: Ids,
        parts: "_sightline.Parts",
        drawing: "_sightline.Drawing",
        certifier: "_sightline.Certifier",
    ) -> None:
        super().__init__(scene, certifier)
        self.eye = eye
        self.visible = np.union1d(fronts, from_behind) if two_sided else fronts  #: ids, sorted
        self.from_behind = from_behind  #: ids of faces of which a back is seen, sorted
        self.parts = Parts(parts)  #: what is seen of them, backs too; they do not overlap
        self._two_sided = two_sided
        self._drawing = drawing

    def lines(self) -> List[Line]:
        """The scene's edges, and lines where faces cross: what is seen of each, and what hides the rest."""
        return [
            Line(kind, ends, faces, [Stretch(*stretch) for stretch in stretches])
            for kind, ends, faces, stretches in self._drawing.lines()
        ]

    def _by_face(self, measures: NDArray[np.float64]) -> NDArray[np.float64]:
        counted = np.ones(len(self.parts), bool) if self._two_sided else self.parts.fronts
        return np.bincount(self.parts.faces[counted], measures[counted], minlength=self.scene.face_count).astype(float)

    @property
    def areas(self) -> NDArray[np.float64]:
        """Of each face the area that is seen, (faces,), in the scene's units squared."""
        return self._by_face(self.parts.areas)

    @property
    def solid_angles(self) -> NDArray[np.float64]:
        """Of each face what it fills of the view, (faces,), in steradians: 4 pi is everything."""
        return self._by_face(self.parts._parts.solid_angles(self.eye))

    def plot(self, ax: Any = None, **style: Any) -> Any:
        """Draws the parts that are seen, coloured by face, in perspective, and returns the axes (matplotlib)."""
        from ._drawing import draw_view

        return draw_view(self, ax, style)

    def __repr__(self) -> str:
        return f"<View: {len(self.visible)} of {self.scene.face_count} faces visible, in {len(self.parts)} parts>"


class WeakView(Answer):
    """The faces some point of which is seen from some point of the source; every kept face is in one list."""

    def __init__(
        self, scene: "Scene", visible: Ids, hidden: Ids, undecided: Ids, certifier: "_sightline.Certifier"
    ) -> None:
        super().__init__(scene, certifier)
        self.visible = visible  #: ids, sorted
        self.hidden = hidden
        self.undecided = undecided  #: empty, unless the budget ran out

    def sightlines(self) -> Dict[int, Tuple[Point, Point]]:
        """Of each visible face a segment from the source to it that no face meets, exactly."""

        def point(texts: List[str]) -> Point:
            return Fraction(texts[0]), Fraction(texts[1]), Fraction(texts[2])

        data = self.certificate().data
        lines: Dict[int, Tuple[Point, Point]] = {}
        for entry in data["visible"]:
            face = data["fragments"][entry["fragment"]]["face"]
            lines.setdefault(face, (point(entry["from"]), point(entry["to"])))
        return lines

    def plot(self, ax: Any = None, *, eye: Any = None, **style: Any) -> Any:
        """Draws fronts of faces, visible orange, hidden grey, undecided violet, and returns the axes (matplotlib).

        eye: from where; by default from outside. What is in front is painted over what is behind, in an exact order.
        """
        from ._drawing import draw_faces

        groups = {"orange": self.visible, "lightsteelblue": self.hidden, "violet": self.undecided}
        return draw_faces(self.scene, groups, eye, ax, style)

    def __repr__(self) -> str:
        return f"<WeakView: {len(self.visible)} visible, {len(self.hidden)} hidden, {len(self.undecided)} undecided>"


class Tracker:
    """The faces that a moving viewpoint is in front of, by Tanimoto's cut-set: a step costs what changes."""

    def __init__(self, scene: "Scene") -> None:
        self.scene = scene
        self._tracker = _sightline.Tracker(scene._model)

    def move_to(self, eye: Any) -> Ids:
        """Moves the viewpoint. Returns the faces that came to be on-view or ceased to be, sorted."""
        return self._tracker.move_to(eye)

    @property
    def on_view(self) -> Ids:
        """The faces that the viewpoint is strictly in front of, sorted; none before the first move."""
        return self._tracker.on_view()

    def __repr__(self) -> str:
        return f"<Tracker: {len(self.on_view)} of {self.scene.face_count} faces on-view>"
