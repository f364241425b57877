"""What an eye sees on its way, and exactly when that changes."""

from fractions import Fraction
from typing import TYPE_CHECKING, Any, List, NamedTuple, Optional, Tuple

from . import _sightline
from ._answers import Answer, Ids

if TYPE_CHECKING:
    from ._scene import Scene


class Moment(NamedTuple):
    """A moment t of a path from 0 to 1, exactly; float(t) is near it."""

    root: Optional[Fraction]  #: t, where it is a fraction; else None, and t is the root of `quadratic` in `bounds`
    quadratic: Tuple[int, int, int]  #: (a, b, c) of a t^2 + b t + c, which has no other root in `bounds`
    bounds: Tuple[Fraction, Fraction]  #: fractions that t is between; twice t where it is one
    near: float

    def __float__(self) -> float:
        return self.near


class Change(NamedTuple):
    """A face of which another thing is so before a moment than at it or after it."""

    face: int
    before: bool  #: whether it is seen just before
    at: bool  #: at this moment
    after: bool  #: just after
    kind: str  #: why: "horizon" (the eye is in its plane), "contact" (on some face), "edge and vertex", "triple"
    edges: List[Tuple[int, int]]  #: edges that one ray of the eye meets: a place in `scene.parts`, its first corner


class Event(NamedTuple):
    """A moment at which what is seen is not what is seen just before and just after."""

    t: Moment
    changes: List[Change]  #: by face

    @property
    def appear(self) -> List[int]:
        """Faces that are hidden just before and seen just after."""
        return [change.face for change in self.changes if not change.before and change.after]

    @property
    def disappear(self) -> List[int]:
        """Faces that are seen just before and hidden just after."""
        return [change.face for change in self.changes if change.before and not change.after]

    @property
    def momentary(self) -> List[int]:
        """Faces that are seen, or hidden, at this moment alone."""
        return [change.face for change in self.changes if change.before == change.after]


class SeenAlong(Answer):
    """What an eye sees that moves straight from `start` to `end`: at t it is at start + t (end - start)."""

    def __init__(
        self,
        scene: "Scene",
        start: Any,
        end: Any,
        events: List[Tuple[Any, ...]],
        at_start: Ids,
        at_end: Ids,
        visible: Ids,
        certifier: "_sightline.Certifier",
    ) -> None:
        super().__init__(scene, certifier)
        self.start, self.end = start, end
        #: all moments at which what is seen changes, in order
        self.events: List[Event] = [
            Event(Moment(*t), [Change(*change) for change in changes]) for t, changes in events
        ]
        self.at_start = at_start  #: ids of faces that are seen at 0, sorted
        self.at_end = at_end  #: at 1
        self.visible = visible  #: at some moment between them

    def __repr__(self) -> str:
        return f"<SeenAlong: {len(self.visible)} of {self.scene.face_count} faces visible, {len(self.events)} events>"
