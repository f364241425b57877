"""Scenes, and the questions that one asks them."""

import importlib
import json
import operator
import os
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _sightline
from ._along import SeenAlong
from ._answers import Certificate, Graph, Order, Parts, Tracker, Verdict, View, WeakView
from ._levels import Cells, PotentiallyVisible, counts_of
from ._partition import LightPartition
from ._pictures import Picture, axes_of, middle_from, size_of
from ._progress import Progress, followed
from ._rays import Rays, as_doubles, pairs
from ._shadows import Shadow

Path = Union[str, "os.PathLike[str]"]


def _question(threads: int, progress: Any, budget: float, two_sided: bool = False) -> "_sightline.Question":
    if not 0 <= operator.index(threads) <= 1024:
        raise ValueError(f"threads is {threads}; give 0, one for each processor, up to 1024")
    if not budget >= 0 or budget == float("inf"):
        raise ValueError(f"budget is {budget}; give seconds, or 0 for no limit")
    return _sightline.Question(threads, progress, budget, two_sided)


class Scene:
    """A scene of polygons, made ready once for all questions, with exact coordinates. It never changes.

    V: points, (n, 3): float64, float32, integers, or objects (Fraction, int, Decimal, text "0.1" or "p/q"). Each number
       is taken as it is: nothing is rounded. Objects have a common denominator of 8192 bits at most, and are at most
       2^8192, as in a .qoff.
    F: faces, corners counted from 0: (m, 3), (m, 4), lists of corners (or of loops: further loops are holes), or flat,
       with offsets, (loops + 1,), where its loops begin and the last ends, and, where faces have holes, face_offsets,
       (faces + 1,), where faces begin among loops. Fronts are where corners run counterclockwise.

    In place of V and F: anything that has .vertices and .faces, .points and .faces, or .points and .cells (trimesh,
    pyvista, open3d, meshio).

    >>> scene = Scene([[0, 0, 0], [1, 0, 0], ["1/3", 1, 0]], [[0, 1, 2]])
    >>> scene.see((0, 0, 2)).visible
    array([0])
    >>> scene.points(exact=True)[2, 0]
    Fraction(1, 3)
    """

    _model: "_sightline.Model"

    def __init__(self, V: Any, F: Any = None, *, offsets: Any = None, face_offsets: Any = None) -> None:
        if F is None:
            points, faces = _arrays.mesh(V)
        else:
            points, faces = _arrays.points(V), _arrays.faces(F, offsets, face_offsets)
        self._model = _sightline.Model.of_arrays(points, *faces, _question(0, None, 0))

    @staticmethod
    def _of(model: "_sightline.Model") -> "Scene":
        scene = Scene.__new__(Scene)
        scene._model = model
        return scene

    @staticmethod
    def read(path: Path, *, coordinates: str = "exact", flip: bool = False) -> "Scene":
        """A scene of a file of any format that the program reads. Errors: InputError.

        coordinates: what decimals mean, "exact" (0.1 is 1/10) or "double" (rounded first, as in other programs). flip:
        turns the scene round, all corners backwards, so that backs become fronts.
        """
        if coordinates not in ("exact", "double"):
            raise ValueError(f"coordinates is {coordinates!r}; give 'exact' or 'double'")
        return Scene._of(_sightline.Model.read(os.fsencode(path), coordinates == "double", flip, _question(0, None, 0)))

    def __reduce__(self) -> Tuple[Any, ...]:
        """For pickle and copy: points and faces, as they are; not the file that they were read from."""
        points, exact = self.points(), self.points(exact=True)
        is_rounded = any(x != y for x, y in zip(points.flat, exact.flat))
        return _of_loops, (exact if is_rounded else points, *self._model.faces())

    @staticmethod
    def from_trimesh(mesh: Any) -> "Scene":
        """A scene of a trimesh, or of anything that Scene() takes."""
        return Scene(mesh)

    # ---- What it is

    @property
    def face_count(self) -> int:
        """Faces of the input: their ids are places in it."""
        return self._model.face_count

    @property
    def point_count(self) -> int:
        """Points of the input."""
        return self._model.point_count

    @property
    def parts(self) -> Parts:
        """What is modelled: each kept face in convex parts, in order."""
        return Parts(self._model.parts())

    @property
    def left_out(self) -> List[Tuple[int, str]]:
        """Faces that are not modelled, and why."""
        return self._model.left_out()

    @property
    def areas(self) -> NDArray[np.float64]:
        """The area of each face, (faces,), 0 for one that is left out."""
        parts = self.parts
        return np.bincount(parts.faces, parts.areas, minlength=self.face_count).astype(float)

    def info(self) -> Dict[str, Any]:
        """What the scene is made of, and the arithmetic that it takes: the program's `info`.

        Counts of points_read and of different points; of faces_read, faces that are kept, convex parts, concave,
        non_planar and with_holes faces, and supporting planes; bits of the largest coordinate on the scene's integer
        grid; arithmetic; closed: whether the faces close up, as those of solids do; box: two points, or None; left_out.
        """
        return {**self._model.facts(), "left_out": self.left_out}

    def points(self, exact: bool = False) -> NDArray[Any]:
        """The points as (n, 3): the nearest doubles, or, if exact, Fractions."""
        return self._model.points(exact)

    def faces(self) -> List[Any]:
        """The corners of each face; where it has holes, a list of its loops."""
        corners, loops, faces = self._model.faces()
        each = np.split(corners, loops[1:-1]) if len(loops) > 1 else []
        groups = [each[a:b] for a, b in zip(faces[:-1], faces[1:])]
        return [group[0] if len(group) == 1 else group for group in groups]

    def write(self, path: Path) -> None:
        """Writes the scene exactly, in the format that the ending says. Errors: ValueError where it cannot hold it.

        What of a .qoff has a common denominator beyond 8192 bits is read only with coordinates="double".
        """
        self._model.write(os.fsencode(path))

    def to_trimesh(self) -> Any:
        """The convex parts as a trimesh.Trimesh: coordinates rounded; face_attributes["face"] are the ids of faces."""
        try:
            trimesh = importlib.import_module("trimesh")
        except ImportError as error:
            raise ImportError("to_trimesh() needs trimesh; scene.parts.triangles() has the arrays") from error
        V, F, ids = self.parts.triangles()
        return trimesh.Trimesh(vertices=V, faces=F, process=False, face_attributes={"face": ids})

    def __repr__(self) -> str:
        return f"<Scene: {self.face_count} faces, {self.point_count} points>"

    # ---- Questions. Of all: threads, 0 for one each processor, the answer does not depend on them; progress, a
    # callable of (done, all), or True for a bar by tqdm; budget, seconds, 0 for no limit. Ctrl-C ends them.

    def order(self, eye: Any, *, threads: int = 0, progress: Progress = None, budget: float = 0) -> Order:
        """All faces back to front as seen from a point, cut where they cross or hide each other in turn.

        >>> from sightline import generate
        >>> cube = generate("boxes", size=1).scene
        >>> cube.order((5, 5, 5)).certificate().verify().accepted
        True
        """
        eye = _arrays.kept_point(eye)
        with followed(progress, "order") as told:
            found = _sightline.order(self._model, eye, _question(threads, told, budget))
        return Order(self, eye, *found)

    def graph(self, *, threads: int = 0, progress: Progress = None, budget: float = 0) -> Graph:
        """Which faces may obscure which, from anywhere: the components of the priority graph."""
        with followed(progress, "graph") as told:
            return Graph(self, *_sightline.graph(self._model, _question(threads, told, budget)))

    def tracker(self) -> Tracker:
        """The faces that a moving viewpoint is in front of."""
        return Tracker(self)

    def see(
        self,
        eye: Any,
        *,
        frustum: Any = (),
        two_sided: bool = False,
        threads: int = 0,
        progress: Progress = None,
        budget: float = 0,
    ) -> View:
        """What is seen from a point, all around, or in a frustum; two_sided: faces seen from behind count as visible.

        frustum: the directions of its edges, (k, 3), counterclockwise as seen from the eye, all within less than a half space.

        >>> lid = Scene([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], [[0, 1, 2], [3, 4, 5]])
        >>> seen = lid.see((0, 0, 2))
        >>> seen.visible, seen.areas
        (array([0, 1]), array([6. , 0.5]))
        """
        eye = _arrays.kept_point(eye)
        with followed(progress, "see") as told:
            found = _sightline.see(self._model, eye, frustum, _question(threads, told, budget))
        return View(self, eye, two_sided, *found)

    def render(
        self,
        eye: Any,
        *,
        look: Any = None,
        up: Any = (0, 0, 1),
        field: float = 60,
        size: Tuple[int, int] = (640, 480),
        threads: int = 0,
        progress: Progress = None,
        budget: float = 0,
    ) -> Picture:
        """Which face each pixel of an image shows, by an exact ray through its centre: the truth for renderers.

        look: the direction to look in; by default to the middle of the scene. field: degrees, of the image's width.
        size: width, height. Picture.means() has exact means over pixels' squares.

        >>> lid = Scene([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], [[0, 1, 2], [3, 4, 5]])
        >>> lid.render((1, 1, 4), look=(0, 0, -1), up=(0, 1, 0), field=70, size=(6, 4)).faces
        array([[-1, -1,  0,  0, -1, -1],
               [-1, -1,  0,  0,  0, -1],
               [-1, -1,  0,  0,  0,  0],
               [-1, -1, -1, -1, -1, -1]])
        """
        pixels, eye = size_of(size), _arrays.kept_point(eye)
        if look is None:
            box = self.info()["box"]
            look = (0, 1, 0) if box is None else middle_from(eye, box)
        axes = axes_of(look, up, field, pixels)
        with followed(progress, "render") as told:
            found = _sightline.centres(self._model, eye, axes, *pixels, _question(threads, told, budget))
        return Picture(self, eye, axes, pixels, *found)

    @staticmethod
    def _source(source: Any) -> Any:
        if _arrays.is_index(source):
            return int(source)
        if isinstance(source, (bool, np.bool_, str)) or not hasattr(source, "__len__"):
            raise TypeError(f"source is {source!r}; give the id of a face, a convex polygon (k, 3), or a list of them")
        if len(source) == 0 or any(np.ndim(part) > 0 and len(part) == 0 for part in source):
            raise ValueError("source is empty; give the id of a face, a convex polygon (k, 3), or a list of them")
        if any(np.ndim(part) == 0 and not isinstance(part, str) for part in source):
            raise TypeError("source is a list of numbers; give one id, or from_faces of what faces bound")
        return source if not isinstance(source[0], str) and np.ndim(source[0][0]) > 0 else [source]

    def weakly_visible(
        self,
        source: Any = None,
        *,
        from_volume: Union["Scene", Sequence["Scene"]] = (),
        from_faces: Any = (),
        two_sided: bool = False,
        conservative: bool = False,
        threads: int = 0,
        progress: Progress = None,
        budget: float = 0,
    ) -> WeakView:
        """The faces some point of which is seen from some point of the source.

        source: the id of a face that looks to its front; a convex polygon, (k, 3), counterclockwise as seen from the
        side that it looks to; or a list of polygons. from_volume: a closed polyhedron, a scene, or several: from some
        point of its inside, what its surface sees outwards and what is seen within. from_faces: the same of what these
        faces of the scene bound, ids. What `budget` leaves open is undecided. conservative: a quick answer that leaves
        out nothing; what it calls visible may be hidden by several faces together. A budget that runs out then raises
        OutOfBudget.
        """
        volumes = [from_volume] if isinstance(from_volume, Scene) else list(from_volume)
        if not all(isinstance(volume, Scene) for volume in volumes):
            raise TypeError("from_volume wants closed polyhedra, each a Scene")
        solids = [volume._model for volume in volumes]
        faces = [operator.index(face) for face in from_faces]
        if source is None and not solids and not faces:
            raise ValueError("say what looks: give a source, from_volume or from_faces")
        with followed(progress, "weak") as told:
            question = _question(threads, told, budget, two_sided)
            looking = None if source is None else self._source(source)
            return WeakView(
                self, *_sightline.weakly_visible(self._model, looking, solids, faces, conservative, question)
            )

    def partition(
        self,
        source: Any,
        face: int,
        *,
        all_borders: bool = False,
        threads: int = 0,
        progress: Progress = None,
        budget: float = 0,
    ) -> LightPartition:
        """What of a face is lit by a source, in penumbra and in umbra, and where the borders run, exactly.

        source: as of weakly_visible(). all_borders: also those between parts that see the source bounded by different
        edges. What `budget` leaves open is undecided. The program's `weak --partition`.

        >>> scene = Scene([[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0], [1, 0, 1], [1, 4, 1], [1, 4, 0], [1, 0, 0]],
        ...               [[0, 1, 2, 3], [4, 5, 6, 7]])
        >>> lamp = [(2, 1, 3), (2, 3, 3), (3, 3, 3), (3, 1, 3)]  # counterclockwise from where it looks to
        >>> scene.partition(lamp, 0)
        <LightPartition of face 0: lit 0.750000, penumbra 0.125000, umbra 0.125000; 3 cells>
        """
        if not _arrays.is_index(face) or not 0 <= face < self.face_count:
            raise IndexError(f"face {face!r} is not there: there are {self.face_count}, counted from 0")
        with followed(progress, "partition") as told:
            question = _question(threads, told, budget)
            found = _sightline.partition(self._model, self._source(source), int(face), all_borders, question)
        return LightPartition(self, int(face), *found)

    def see_along(
        self,
        start: Any,
        end: Any,
        *,
        two_sided: bool = False,
        threads: int = 0,
        progress: Progress = None,
        budget: float = 0,
    ) -> SeenAlong:
        """What an eye sees that moves straight from one point to another, and exactly when that changes.

        two_sided: faces seen from behind count too. The program's `weak --along`.

        >>> lid = Scene([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], [[0, 1, 2], [3, 4, 5]])
        >>> walk = lid.see_along((0, 0, -1), (0, 0, 2))
        >>> [(event.t.root, event.appear) for event in walk.events]
        [(Fraction(1, 3), [0]), (Fraction(2, 3), [1]), (Fraction(7, 9), [0])]
        """
        start, end = _arrays.kept_point(start), _arrays.kept_point(end)
        with followed(progress, "along the path") as told:
            question = _question(threads, told, budget, two_sided)
            return SeenAlong(self, start, end, *_sightline.see_along(self._model, start, end, question))

    def shadow(
        self,
        light: Any = None,
        *,
        sun: Any = None,
        two_sided: bool = False,
        threads: int = 0,
        progress: Progress = None,
        budget: float = 0,
    ) -> Shadow:
        """Which parts of faces a light reaches, and which faces shadow the others.

        light: the point where it is; or sun: the direction to it, from anywhere. two_sided: backs that it is behind are
        parted too.

        >>> lid = Scene([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], [[0, 1, 2], [3, 4, 5]])
        >>> shadow = lid.shadow((0, 0, 2))
        >>> shadow.lit_areas, shadow.dark_areas
        (array([6. , 0.5]), array([2., 0.]))
        >>> lid.shadow(sun=(0, 0, 1)).dark_areas
        array([0.5, 0. ])
        """
        if (light is None) == (sun is None):
            raise ValueError("give a light, a point, or a sun, the direction to it; for several, ask several times")
        with followed(progress, "shadow") as told:
            at = _arrays.kept_point(light if sun is None else sun)
            question = _question(threads, told, budget, two_sided)
            found = _sightline.shadow(self._model, at, sun is not None, question)
        return Shadow(self, at, sun is not None, *found)

    def cells(
        self,
        *,
        grid: Any = None,
        volumes: Optional["Scene"] = None,
        leaves: bool = False,
        candidates: int = 5,
        seed: int = 1,
        threads: int = 0,
        progress: Progress = None,
        budget: float = 0,
    ) -> Cells:
        """The convex cells that the faces' planes divide space into, the walls between them, what is solid, and leaks.

        grid: (nx, ny, nz), even boxes that cells lie within, along each axis of the box about the scene. volumes: the
        same for given rooms, the closed polyhedra of a scene, each with points of its own. leaves: of a compiled
        level that was read (.bsp), cells lie within its own. candidates: planes tried for each node of the tree, by the
        seed's choice.

        >>> cells = Scene([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]]).cells()
        >>> cells.at((1, 1, "1/9")).faces, cells.at((1, 1, "-1/9")).faces
        (array([0]), array([], dtype=int64))
        """
        if not 1 <= operator.index(candidates) <= 1000:
            raise ValueError(f"candidates is {candidates}; give 1 to 1000")
        if not 0 <= operator.index(seed) < 2**64:
            raise ValueError(f"seed is {seed}; give 0 to 2**64 - 1")
        counts = counts_of(grid)
        if sum((counts is not None, volumes is not None, bool(leaves))) > 1:
            raise ValueError("grid, volumes and leaves each say what cells lie within; give one of them")
        if volumes is not None and not isinstance(volumes, Scene):
            raise TypeError(f"volumes is a {type(volumes).__name__}; give rooms as one Scene")
        rooms = None if volumes is None else volumes._model
        with followed(progress, "cells") as told:
            question = _question(threads, told, budget)
            level = _sightline.cells(self._model, candidates, seed, list(counts or ()), rooms, leaves, question)
        return Cells(self, level, counts, leaves, seed)

    def pvs(
        self,
        *,
        grid: Any = None,
        volumes: Optional["Scene"] = None,
        leaves: bool = False,
        candidates: int = 5,
        seed: int = 1,
        outside: bool = False,
        threads: int = 0,
        progress: Progress = None,
        budget: float = 0,
    ) -> PotentiallyVisible:
        """Which faces each cell sees: those of which some point is seen from some point of its inside, exactly.

        What `budget`, which is of looking, leaves open is undecided. Other arguments: as of cells(), and Cells.pvs().
        """
        cells = self.cells(
            grid=grid,
            volumes=volumes,
            leaves=leaves,
            candidates=candidates,
            seed=seed,
            threads=threads,
            progress=progress,
        )
        return cells.pvs(outside=outside, threads=threads, progress=progress, budget=budget)

    def trace(
        self,
        origins: Any,
        directions: Any,
        *,
        all: bool = False,
        closed: bool = False,
        threads: int = 0,
        progress: Progress = None,
        budget: float = 0,
    ) -> Rays:
        """What rays meet first, or, if all, at all: the points origin + t direction, t >= 0.

        origins, directions: (n, 3), or one point (3,) for all rays, of the numbers that Scene() takes. Faces are met
        from both sides. closed: a face that holds the origin is met there; else it is passed over, as what leaves a
        surface wants it.

        >>> lid = Scene([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], [[0, 1, 2], [3, 4, 5]])
        >>> rays = lid.trace([(0.25, 0.25, 3), (1, 1, 3), (9, 9, 3)], (0, 0, -1))
        >>> rays.faces, rays.t
        (array([ 1,  0, -1]), array([ 2.,  3., nan]))
        >>> rays[0][0].point
        (Fraction(1, 4), Fraction(1, 4), Fraction(1, 1))
        """
        o, d = pairs(origins, directions)
        with followed(progress, "trace") as told:
            question = _question(threads, told, budget)
            doubles = None if all else as_doubles(o, d)
            if doubles is not None:
                columns = _sightline.nearest(self._model, *doubles, closed, question)
                return Rays(self, o, d, columns, None, closed)
            hits = _sightline.traced(self._model, o, d, all, closed, question)
            return Rays(self, o, d, hits.firsts(), hits, closed)

    def verify(
        self,
        certificate: Union[Certificate, str, Dict[str, Any], "os.PathLike[str]"],
        *,
        threads: int = 0,
        progress: Progress = None,
        budget: float = 0,
    ) -> Verdict:
        """Checks a certificate, its text, data or file, by code that shares nothing with what made it."""
        if isinstance(certificate, os.PathLike) or isinstance(certificate, str) and "{" not in certificate:
            with open(certificate, encoding="utf-8") as file:
                text = file.read()
        else:
            text = certificate.text if isinstance(certificate, Certificate) else certificate
            if isinstance(text, dict):
                text = json.dumps(text)
            if not isinstance(text, str):
                raise TypeError(f"a {type(text).__name__} is no certificate; give one, its text, or a file's path")
        with followed(progress, "verify") as told:
            return Verdict(*_sightline.verify(self._model, text, _question(threads, told, budget)))


def _of_loops(points: NDArray[Any], corners: Any, loops: Any, faces: Any) -> Scene:
    """Of pickle: what set operations make may have any denominators."""
    V, F = _arrays.points(points), _arrays.faces(corners, loops, faces)
    return Scene._of(_sightline.Model.of_arrays(V, *F, _question(0, None, 0), True))


def read(path: Path, *, coordinates: str = "exact", flip: bool = False) -> Scene:
    """A scene of a file of any format that the program reads, as Scene.read(). Errors: InputError."""
    return Scene.read(path, coordinates=coordinates, flip=flip)


def verify(scene: Scene, certificate: Union[Certificate, str, "os.PathLike[str]"]) -> Verdict:
    """Checks a certificate about a scene, its text, or the file of a path."""
    return scene.verify(certificate)
