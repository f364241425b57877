"""The harness on Python's functions: scenes, the judge, laws."""

import json
import operator
import os
import time
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _sightline
from ._answers import Ids, Point
from ._arrays import fraction, is_index, whole_number
from ._progress import Progress, followed
from ._scene import Path, Scene, _question

Function = Callable[[Any, Any, Any], Any]
_far = 1 << 44  # ulps: 2^-8 of the scene's size


def _ulps(ulps: Union[int, str]) -> int:
    if isinstance(ulps, str):
        if ulps not in ("far", "-far"):
            raise ValueError(f"ulps is {ulps!r}; give an integer, 'far' or '-far'")
        return _far if ulps == "far" else -_far
    return whole_number(ulps, "ulps", -(2**63))


class Generated(NamedTuple):
    """A scene of a family, what may be asked of it, and what is known of the answers."""

    scene: Scene
    eye: Point  #: a point to look from
    source: List[Point]  #: a convex polygon to look from; empty: none
    visible: Ids  #: from the source, by construction; of other faces nothing is known
    hidden: Ids
    first: int = 0  #: of a pair of solids, so many faces are the first one's, all others the second's


def families() -> Dict[str, str]:
    """The names of families of scenes, and what each is."""
    return {name: what for name, what, _, _, _ in _sightline.families()}


def generate(
    family: str,
    *,
    seed: int = 1,
    size: int = 0,
    ulps: Union[int, str] = 0,
    offset: Any = (0, 0, 0),
    scale: Any = 1,
) -> Generated:
    """A scene from a seed, the same on every machine.

    size: how large; 0: the family's own. ulps: 0 is exactly degenerate, K leaves a gap of K units of 2^-52 of the
    scene's size, -K an overlap; "far" is 2^44. All points are scaled, then moved by offset.

    >>> generate("boxes", size=3, seed=7).scene
    <Scene: 18 faces, 72 points>
    """
    seed, size = whole_number(seed, "seed", 0, 2**64 - 1), whole_number(size, "size")
    model, eye, source, visible, hidden, first = _sightline.generate(family, seed, size, _ulps(ulps), offset, scale)
    return Generated(Scene._of(model), eye, source, visible, hidden, first)


# ---- What a function is asked, and what it says


def _faces(case: "_sightline.Case", triangles: bool) -> Any:
    corners, loops, _ = case.faces()
    if triangles:
        return corners.reshape(-1, 3)
    return np.split(corners, loops[1:-1]) if len(loops) > 1 else []


def _arguments(case: "_sightline.Case", exact: bool, triangles: bool) -> Tuple[Any, Any, Any]:
    return case.points(exact), _faces(case, triangles), case.looker(exact)


def _said(answer: Any, query: str, face_count: int) -> str:
    """An answer as the protocol has it: of faces, of a truth value for each face, or {"visible": ..., ...}."""
    if query == "boolean":
        return _off(answer)
    if query == "trace":
        faces = answer.tolist() if isinstance(answer, np.ndarray) else list(answer)
        return json.dumps({"first": [_first(face) for face in faces]})
    key = "order" if query == "order" else "visible"
    if isinstance(answer, dict):
        if unknown := set(answer) - {key, "abstained"}:
            raise ValueError(f"{sorted(map(str, unknown))[0]!r} is neither {key!r} nor 'abstained'")
        return json.dumps({key: [], **{name: _named(value, face_count) for name, value in answer.items()}})
    return json.dumps({key: _named(answer, face_count)})


def _check_function(function: Any) -> None:
    if not callable(function):
        raise TypeError(f"a {type(function).__name__} is no function of (V, F, ...)")


def _named(faces: Any, face_count: int) -> List[int]:
    """Ids of faces, or of those with a true value where there are truth values, an array or a list of them."""
    named = list(faces)
    if not any(isinstance(face, (bool, np.bool_)) for face in named):
        return [operator.index(face) for face in named]
    if len(named) != face_count or not all(isinstance(face, (bool, np.bool_)) for face in named):
        raise ValueError(f"it mixes truth values and ids, or has not one truth value for each of {face_count} faces")
    return [face for face, is_named in enumerate(named) if is_named]


def _first(face: Any) -> Any:
    """What a ray meets first: a face; nothing where it is None or -1; or "abstained"."""
    if face is None or face == "abstained":
        return face
    number = operator.index(face)
    return None if number == -1 else number


def _off(answer: Any) -> str:
    """A surface, (points, faces), as OFF whose numbers are exactly its own; None leaves it open."""
    if answer is None:
        return "abstained"
    points, faces = answer
    lines = [" ".join(str(fraction(x)) for x in point) for point in points]
    lines += [" ".join(str(operator.index(i)) for i in (len(face), *face)) for face in faces]
    return "\n".join([f"OFF\n{len(points)} {len(faces)} 0", *lines, ""])


class Failure:
    """A scene that a function answers wrongly: what it was given, what it said, and why that is wrong."""

    def __init__(self, case: "_sightline.Case", exact: bool, triangles: bool, query: str) -> None:
        self._case, self._exact, self._triangles, self.query = case, exact, triangles, query
        self.again = ""  #: the arguments of judge() or the case of fuzz() that it was found with
        self.mark = ""  #: wrong, invalid, or crashed
        self.why = ""  #: in one line
        self.answer: Any = None
        self.wrong_visible: Ids = np.empty(0, np.int64)  #: shown although hidden
        self.wrong_hidden: Ids = np.empty(0, np.int64)  #: hidden although visible
        self._graded: Optional["_sightline.Graded"] = None
        self.explanation: Dict[str, Any] = {}  #: the line that refutes it, the share that is wrong, guesses

    @property
    def arguments(self) -> Tuple[Any, Any, Any]:
        """What the function was called with: `function(*failure.arguments)` shows it again."""
        return _arguments(self._case, self._exact, self._triangles)

    @property
    def scene(self) -> Scene:
        """The scene, to ask what is right."""
        return Scene._of(self._case.model())

    @property
    def face_count(self) -> int:
        """Faces of the scene."""
        return self._case.face_count

    @property
    def eye(self) -> Any:
        """What was asked about, exactly: the eye, the corners of the source, the rays, or operation and solids."""
        return self._case.looker(True)

    def save(self, folder: Path) -> None:
        """Writes scene.qoff and query.json there, which `sightline judge --scenes ... --ask ...` takes."""
        os.makedirs(folder, exist_ok=True)
        self.scene.write(os.path.join(folder, "scene.qoff"))
        with open(os.path.join(folder, "query.json"), "w", encoding="utf-8") as file:
            file.write(self._case.query() + "\n")

    def __str__(self) -> str:
        lines = [f"{self.again}: {self.face_count} faces: {self.mark}: {self.why}"]
        if self.explanation.get("line"):
            lines.append(f"  refuted: {self.explanation['line']}")
        if self.explanation.get("share_words"):
            lines.append(f"  {self.explanation['share_words']}")
        lines += [f"  guess: {guess}" for guess in self.explanation.get("guesses", [])]
        return "\n".join(lines)

    def __repr__(self) -> str:
        return f"<Failure: {self.mark}, {self.face_count} faces: {self.why}>"


class _Court:
    """A function, asked one case after another."""

    def __init__(
        self, function: Function, query: str, contract: str, options: "_sightline.CaseOptions", exact: bool,
        triangles: bool, cycles: bool, budget: float, threads: int,
    ) -> None:  # fmt: skip
        self.function, self.query, self.contract, self.options = function, query, contract, options
        self.exact, self.triangles, self.cycles = exact, triangles, cycles
        self.question = _question(threads, None, budget)
        self.seconds = 0.0  # of the function

    def judge(self, case: "_sightline.Case") -> Tuple[str, Optional[Failure]]:
        """The mark, and a failure where the contract is broken; "not asked" where nothing could be right."""
        if case.not_asked:
            return "not asked", None
        truth = _sightline.truth_of(case, self.cycles, self.question)
        if truth.not_asked:
            return "not asked", None
        failure = Failure(case, self.exact, self.triangles, self.query)
        arguments = failure.arguments
        start = time.perf_counter()
        try:
            failure.answer = self.function(*arguments)
        except Exception as error:
            failure.mark, failure.why = "crashed", f"{type(error).__name__}: {error}"
            return failure.mark, failure
        finally:
            self.seconds += time.perf_counter() - start
        try:
            graded = _sightline.graded(case, truth, _said(failure.answer, self.query, case.face_count))
        except (ValueError, TypeError) as error:
            failure.mark, failure.why = "invalid", f"the answer: {error}"
            return failure.mark, failure
        failure.mark = graded.mark
        failure.wrong_visible, failure.wrong_hidden = graded.wrong_visible, graded.wrong_hidden
        wrong = [f"face {face} is shown but hidden" for face in graded.wrong_visible]
        wrong += [f"face {face} is missing but visible" for face in graded.wrong_hidden]
        if self.query == "order":
            wrong = [f"face {face} is painted over what is nearer there" for face in graded.wrong_visible]
            wrong += [f"face {face} is painted over, or missing" for face in graded.wrong_hidden]
        if self.query == "trace":
            wrong = [f"face {face} is named, and not met first" for face in graded.wrong_visible]
            wrong += [f"face {face} is met first, and not named" for face in graded.wrong_hidden]
        if self.query == "boolean":
            wrong = [f"what is outside beside face {face} is held" for face in graded.wrong_visible]
            wrong += [f"what is inside beside face {face} is not held" for face in graded.wrong_hidden]
            if not wrong and graded.mark == "wrong":
                wrong = ["the volume is off by {:.2g} of it, the area by {:.2g}".format(*graded.errors)]
        failure.why = ", ".join(wrong[:4]) + (f", and {len(wrong) - 4} more" if len(wrong) > 4 else "")
        failure._graded = graded
        return graded.mark, failure if graded.breaks(self.contract) else None

    def explain(self, failure: Failure) -> None:
        if failure.mark == "wrong" and failure._graded is not None:
            failure.explanation = _sightline.explained(failure._case, failure._graded, self.contract, self.cycles)

    def reduce(self, found: Failure, seconds: float) -> Failure:
        """A smaller scene that is answered wrongly in the same way."""

        def fails(case: "_sightline.Case") -> bool:
            _, failure = self.judge(case)
            return (
                failure is not None
                and failure.mark == found.mark
                and (failure.mark == "wrong" or failure.why.split(":")[0] == found.why.split(":")[0])
                and (len(failure.wrong_visible) == 0 or len(found.wrong_visible) > 0)
                and (len(failure.wrong_hidden) == 0 or len(found.wrong_hidden) > 0)
            )

        _, failure = self.judge(_sightline.reduced(found._case, self.options, fails, seconds))
        if failure is None:
            return found
        failure.again = found.again + ", made smaller"
        return failure


_marks = ("right", "wrong", "abstained", "crashed", "invalid", "not asked")


class Report:
    """What became of the cases that a function was asked."""

    def __init__(self, query: str, contract: str) -> None:
        self.query, self.contract = query, contract
        self.rows: List[Dict[str, Any]] = []  #: by family and distance: how many cases have which mark
        self.failures: List[Failure] = []  #: that break the contract
        self.smallest: Optional[Failure] = None  #: of them, made smaller, explained
        self.seconds = 0.0  #: that the function took

    @property
    def holds(self) -> bool:
        """Whether no case breaks the contract."""
        return not self.failures

    @property
    def total(self) -> Dict[str, int]:
        """How many cases have which mark."""
        return {mark: sum(row[mark] for row in self.rows) for mark in _marks}

    def __bool__(self) -> bool:
        return self.holds

    def __str__(self) -> str:
        lines = [f"{'family':<26} {'distance':<10}" + "".join(f"{mark:>10}" for mark in _marks)]
        for row in [*self.rows, {"family": "all", "distance": "", **self.total}]:
            lines.append(f"{row['family']:<26} {row['distance']:<10}" + "".join(f"{row[m]:>10}" for m in _marks))
        lines.append(f"{self.contract}: {'holds' if self.holds else 'broken in ' + str(len(self.failures)) + ' cases'}")
        if self.smallest is not None:
            lines.append(f"the smallest: {self.smallest}")
        return "\n".join(lines)

    def __repr__(self) -> str:
        return f"<Report: {sum(self.total.values())} cases, {len(self.failures)} break the contract>"


def judge(
    function: Function,
    query: str = "see",
    *,
    contract: str = "exact",
    families: Union[None, str, Sequence[str]] = None,
    ulps: Union[int, str, Sequence[Union[int, str]]] = (0, 1, -1, "far"),
    size: int = 0,
    cases: int = 5,
    seed: int = 1,
    two_sided: bool = False,
    cycles: bool = False,
    exact: bool = False,
    triangles: bool = False,
    budget: float = 20,
    threads: int = 0,
    reduce: float = 10,
    progress: Progress = None,
) -> Report:
    """Asks a function many cases, most of them degenerate on purpose, and grades its answers against the exact truth.

    function(V, F, eye) returns the faces that are seen (`see`, query="see"), or all faces, farthest first ("order");
    function(V, F, source) those that are weakly visible from a convex polygon ("weak"); function(V, F, rays) the face
    that each ray meets first, None or -1 where there is none ("trace"), rays being (r, 2, 3), origins and directions;
    function(V, F, (operation, first)) the surface of a set operation, (points, faces), or None to leave it open
    ("boolean"), the first so many faces bounding one solid and all others the other. V is (n, 3) doubles that are
    exactly what is asked about, or, if exact, Fractions; F is a list of arrays of corners, or, if triangles, (m, 3);
    eye is (3,), source (k, 3). Instead of faces it may return one truth value for each face, or a dictionary
    {"visible": faces, "abstained": faces}. Only fronts are seen, unless two_sided.

    contract: what it promises: "exact" (no wrong face), "conservative" (never hides a visible one), "aggressive" (never
    shows a hidden one). families, ulps, size, cases, seed: which cases. reduce: seconds to make the smallest failure
    smaller. budget: seconds for the truth of a weak query.

    >>> report = judge(lambda V, F, eye: range(len(F)), families=["hinged"], cases=2, reduce=1)
    >>> report.holds, report.smallest.mark
    (False, 'wrong')
    """
    _sightline.check_contract(contract)
    _check_function(function)
    seed, size = whole_number(seed, "seed", 0, 2**64 - 1), whole_number(size, "size")
    cases = whole_number(cases, "cases", 1)
    options = _sightline.CaseOptions(query, two_sided, exact, triangles)
    known = _sightline.families()
    if isinstance(families, str):
        families = [families]
    if isinstance(ulps, str) or is_index(ulps):
        ulps = [ulps]
    names = [name for name, _, _, _, holes in known if not holes] if families is None else list(families)
    court = _Court(function, query, contract, options, exact, triangles, cycles, budget, threads)
    report = Report(query, contract)
    all_cases = len(names) * len(ulps) * cases
    done = 0
    with followed(progress, "judge") as told:
        for family in names:
            for distance in ulps:
                row: Dict[str, Any] = {"family": family, "distance": "exact" if distance == 0 else str(distance)}
                row.update({mark: 0 for mark in _marks})
                report.rows.append(row)
                for number in range(seed, seed + cases):
                    case = _sightline.case_of(family, number, size, _ulps(distance), options)
                    mark, failure = court.judge(case)
                    row[mark] += 1
                    if failure is not None:
                        failure.again = f"families=[{family!r}], ulps=[{distance!r}], seed={number}"
                        report.failures.append(failure)
                    done += 1
                    if told is not None:
                        told(done, all_cases)
    report.seconds = court.seconds
    if report.failures:
        smallest = min(report.failures, key=lambda failure: failure.face_count)
        report.smallest = court.reduce(smallest, reduce) if reduce > 0 else smallest
        court.explain(report.smallest)
    return report


class FuzzReport:
    """What laws and the exact answer said of a function."""

    def __init__(self, scenes: int, checks: Dict[str, Tuple[int, int, int]], finding: Optional[Failure]) -> None:
        self.scenes = scenes
        self.checks = checks  #: by name: how often it passed, was undecided, was not applicable
        self.finding = finding  #: the smallest scene that was found to fail; `again` is its case and the check

    @property
    def holds(self) -> bool:
        """Whether nothing was found."""
        return self.finding is None

    def __bool__(self) -> bool:
        return self.holds

    def __str__(self) -> str:
        lines = [f"{'check':<12}{'passed':>10}{'undecided':>12}{'not applicable':>16}"]
        lines += [f"{name:<12}{a:>10}{b:>12}{c:>16}" for name, (a, b, c) in self.checks.items()]
        lines.append(f"{self.scenes} scenes: {'nothing found' if self.holds else self.finding}")
        return "\n".join(lines)

    def __repr__(self) -> str:
        return f"<FuzzReport: {self.scenes} scenes, {'nothing found' if self.holds else self.finding!r}>"


def fuzz(
    function: Function,
    query: str = "see",
    *,
    seconds: float = 10,
    scenes: int = 0,
    seed: int = 1,
    family: str = "",
    max_faces: int = 40,
    two_sided: bool = False,
    exact: bool = False,
    triangles: bool = False,
    reduce: float = 10,
) -> FuzzReport:
    """Draws scenes until a function contradicts the exact answer or itself, and makes the scene that shows it small.

    function: as of judge(), for query="see" or "weak". Checks: "exact", and laws: the answer does not change where a
    loop begins elsewhere, faces are permuted, the scene is moved, scaled, turned or mirrored, a face is cut in two, or
    a face is added that nobody can see. Where doubles cannot hold the changed scene, a law is not applicable; if exact,
    all are.
    seconds: how long to draw; scenes: draw so many instead.

    >>> fuzz(lambda V, F, eye: [], scenes=20).finding.wrong_hidden
    array([0])
    """
    _check_function(function)
    seed, scenes = whole_number(seed, "seed", 0, 2**64 - 1), whole_number(scenes, "scenes")
    max_faces = whole_number(max_faces, "max_faces", 1)
    options = _sightline.CaseOptions(query, two_sided, exact, triangles)

    def ask(case: "_sightline.Case") -> str:
        return _said(function(*_arguments(case, exact, triangles)), query, case.face_count)

    found = _sightline.fuzzed(ask, options, seed, scenes, seconds, family, max_faces, reduce)
    finding: Optional[Failure] = None
    if found["finding"] is not None:
        which, check, what, case = found["finding"]
        finding = Failure(case, exact, triangles, query)
        if check == "exact":
            court = _Court(function, query, "exact", options, exact, triangles, False, 20, 0)
            _, again = court.judge(case)
            if again is not None:
                finding = again
                court.explain(finding)
        finding.again = f"case {which}, check {check!r}"
        finding.mark = finding.mark or ("crashed" if what.startswith("throws: ") else "wrong")
        finding.why = finding.why or what
    return FuzzReport(found["scenes"], found["checks"], finding)
