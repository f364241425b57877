"""Answers: what is worked out by hand, what the program says, and what the checker accepts."""

import json
import math
import os
import signal
import subprocess
import sys
import threading
import time
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import sightline

corpus = Path(__file__).parents[2] / "tests" / "corpus" / "general"
program = Path(os.environ.get("SIGHTLINE_BUILD_DIR", "")) / "sightline"


def lamp_and_lid():
    """A floor, a lid above it that hides it in part, a lamp above both that looks down."""
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    V = np.concatenate([4 * square, square + [0, 0, 1], square + [0, 0, 3]])
    return sightline.Scene(V, [[0, 1, 2, 3], [4, 5, 6, 7], [11, 10, 9, 8]])


def by_program(tmp_path, *arguments):
    if not program.is_file():
        pytest.skip("the program is not built here")
    out = tmp_path / "out.json"
    subprocess.run([program, *map(str, arguments), "--json", str(out)], check=True, capture_output=True)
    return json.loads(out.read_text())["result"]


def corners_of(parts):
    return [[[str(x) for x in p] for p in part.corners] for part in parts]


def test_see_by_hand():
    seen = lamp_and_lid().see((0, 0, 2))
    assert seen.visible.tolist() == [0, 1, 2] and seen.from_behind.tolist() == []
    assert seen.areas == pytest.approx([64 - 16, 4, 4])  # the lid hides [-2, 2]^2 of the floor
    # A square of side 2 at distance 1: 4 atan(1 / sqrt 3) = 2 pi / 3.
    assert seen.solid_angles[1:] == pytest.approx([2 * math.pi / 3] * 2)
    assert seen.certificate().verify()
    above = lamp_and_lid().see((0, 0, 10))
    assert above.visible.tolist() == [0] and above.from_behind.tolist() == [2]
    both = lamp_and_lid().see((0, 0, 10), two_sided=True)
    assert both.visible.tolist() == [0, 2] and above.areas[2] == 0 and both.areas[2] == pytest.approx(4)
    assert {part.face for part in above.parts if part.from_front is False} == {2}


def test_order_graph_and_tracker_by_hand():
    scene = lamp_and_lid()
    order = scene.order(["0", Fraction(0), 10])
    assert order.faces.tolist() == [0, 1, 2] and order.certificate().verify()
    assert scene.order((0, 0, -10)).faces.tolist() == [2, 1, 0]
    graph = scene.graph()
    assert sorted(f for faces in graph.faces for f in faces) == [0, 1, 2] and graph.cyclic == 0
    assert graph.certificate().verify()
    tracker = scene.tracker()
    assert tracker.on_view.tolist() == []
    assert tracker.move_to((0, 0, 2)).tolist() == [0, 1, 2]
    assert tracker.move_to((0, 0, 10)).tolist() == [2] and tracker.on_view.tolist() == [0, 1]
    assert tracker.move_to("0,0,0").tolist() == [0, 1, 2] and tracker.on_view.tolist() == [2]  # in the floor's plane


def test_weak_by_hand():
    scene = lamp_and_lid()
    lit = scene.weakly_visible(2)
    assert (lit.visible.tolist(), lit.hidden.tolist(), lit.undecided.tolist()) == ([0, 1], [2], [])
    assert lit.certificate().verify()
    for face, (p, q) in lit.sightlines().items():
        assert p[2] == 3 and q[2] == (0, 1)[face] and all(isinstance(x, Fraction) for x in p + q)
    assert scene.weakly_visible(np.int64(2)).visible.tolist() == [0, 1]
    below = [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1]]
    assert scene.weakly_visible(below).visible.tolist() == []
    assert scene.weakly_visible(below, two_sided=True).visible.tolist() == [0]
    assert scene.weakly_visible([np.array(below), below], two_sided=True).visible.tolist() == [0]


def test_the_program_says_the_same(tmp_path):
    file = corpus / "two_rooms.off"
    scene = sightline.read(file)
    seen, said = scene.see((1, 1, 2)), by_program(tmp_path, "see", file, "--eye", "1,1,2", "--two-sided")
    assert seen.visible.tolist() == said["visible"] and seen.from_behind.tolist() == said["from_behind"]
    assert corners_of(seen.parts) == [piece["vertices"] for piece in said["pieces"]]
    assert [part.piece for part in seen.parts] == [piece["piece"] for piece in said["pieces"]]
    assert ["front" if part.from_front else "back" for part in seen.parts] == [p["side"] for p in said["pieces"]]
    order, said = scene.order("1/3,1,2"), by_program(tmp_path, "order", file, "--eye", "1/3,1,2")
    assert order.faces.tolist() == [fragment["face"] for fragment in said["fragments"]]
    assert corners_of(order.parts) == [fragment["vertices"] for fragment in said["fragments"]]
    weak, said = scene.weakly_visible(0), by_program(tmp_path, "weak", file, "--from-face", 0)
    assert [weak.visible.tolist(), weak.hidden.tolist()] == [said["visible"], said["hidden"]]
    info, said = scene.info(), by_program(tmp_path, "info", file)
    assert info["closed"] == said["closed"] and info["parts"] == said["pieces"]
    assert info["planes"] == said["supporting_planes"] and info["points"] == said["points"]
    assert [[str(x) for x in p] for p in info["box"]] == said["box"]


def box(low, high):
    """A box that looks outwards."""
    V = [[(low, high)[(k >> d) & 1][d] for d in range(3)] for k in range(8)]
    return V, [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]


@pytest.mark.parametrize("conservative", [False, True])
def test_what_a_solid_sees_is_what_the_program_says(tmp_path, conservative):
    V, F = box((0, 0, 0), (9, 9, 9))
    W, G = box((1, 1, 1), (2, 2, 2))
    card = [[1, 1, 8], [2, 1, 8], [2, 2, 8]]  # looks up, away from the cube below it
    room = sightline.Scene(
        V + W + card, [f[::-1] for f in F] + [[i + 8 for i in g] for g in G] + [[16, 17, 18]]
    )
    cloud = sightline.Scene(*box((1, 1, "15/2"), (3, 3, "17/2")))
    room.write(tmp_path / "room.qoff"), cloud.write(tmp_path / "cloud.qoff")
    options = ["--conservative"] if conservative else []

    of_cube = room.weakly_visible(from_faces=np.arange(6, 12), conservative=conservative)
    if not conservative:
        assert of_cube.visible.tolist() == list(range(6)), "its own faces look outwards, and the card away from it"
    said = by_program(tmp_path, "weak", tmp_path / "room.qoff", "--from-faces", "6,7,8,9,10,11", *options)
    assert said["visible"] == of_cube.visible.tolist() and said["hidden"] == of_cube.hidden.tolist()

    of_cloud = room.weakly_visible(from_volume=cloud, conservative=conservative)
    assert 12 in of_cloud.visible, "within the cloud"
    said = by_program(tmp_path, "weak", tmp_path / "room.qoff", "--from-volume", tmp_path / "cloud.qoff", *options)
    assert said["visible"] == of_cloud.visible.tolist() and said["hidden"] == of_cloud.hidden.tolist()
    assert conservative or of_cloud.certificate().verify() and of_cube.certificate().verify()

    both = room.weakly_visible(0, from_volume=[cloud], from_faces=range(6, 12), conservative=conservative)
    assert set(of_cloud.visible) | set(of_cube.visible) <= set(both.visible)


def test_what_is_no_solid_is_refused():
    room = sightline.Scene(*box((0, 0, 0), (9, 9, 9)))
    for options, error in (
        ({}, ValueError),
        ({"from_faces": [0, 1]}, ValueError),  # open
        ({"from_faces": [6]}, IndexError),
        ({"from_faces": [-1]}, IndexError),
        ({"from_faces": [0.5]}, TypeError),
        ({"from_volume": lamp_and_lid()}, ValueError),
        ({"from_volume": [box((0, 0, 0), (1, 1, 1))]}, TypeError),
    ):
        with pytest.raises(error):
            room.weakly_visible(**options)


@pytest.mark.parametrize("two_sided", [False, True])
def test_the_program_says_the_same_of_a_path(tmp_path, two_sided):
    file = tmp_path / "triangles.off"
    sightline.generate("triangles_between_squares", size=20, seed=3).scene.write(file)
    scene, start, end = sightline.read(file), (-5, -4, 3), (6, "5", 4)
    walk = scene.see_along(start, end, two_sided=two_sided)
    options = ["--two-sided"] if two_sided else []
    said = by_program(tmp_path, "weak", file, "--along", "-5,-4,3 6,5,4", *options)["along"]
    assert walk.at_start.tolist() == said["visible_at_start"] and walk.at_end.tolist() == said["visible_at_end"]
    assert walk.visible.tolist() == said["visible"] and len(walk.events) == len(said["events"]) > 20
    parts, irrational = scene.parts, 0
    for event, of in zip(walk.events, said["events"]):
        assert event.appear == of["appear"] and event.disappear == of["disappear"]
        assert event.momentary == sorted(of["momentary"]["visible"] + of["momentary"]["hidden"])
        assert float(event.t) == of["t"]["near"]
        if event.t.root is None:
            a, b, c = event.t.quadratic
            low, high = event.t.bounds
            assert [[str(a), str(b), str(c)], str(low), str(high)] == [of["t"][k] for k in ("quadratic", "low", "high")]
            assert (a * low**2 + b * low + c) * (a * high**2 + b * high + c) < 0
            irrational += 1
        else:
            assert str(event.t.root) == of["t"]["root"] and event.t.bounds == (event.t.root,) * 2
        for change, other in zip(event.changes, of["changes"], strict=True):
            assert [change.face, change.kind] == [other["face"], other["kind"]]
            assert [change.before, change.at, change.after] == other["visible"]
            edges = [(parts[part].face, parts[part].piece, corner) for part, corner in change.edges]
            assert edges == [(edge["face"], edge["piece"], edge["corner"]) for edge in other["edges"]]
    assert irrational > 0 and walk.certificate().verify()
    with pytest.raises(ValueError):
        scene.see_along(start, start)
    with pytest.raises(sightline.OutOfBudget):
        scene.see_along(start, end, budget=1e-9)


def test_the_program_takes_the_certificates(tmp_path):
    if not program.is_file():
        pytest.skip("the program is not built here")
    file = corpus / "two_rooms.off"
    scene = sightline.read(file)
    walk = scene.see_along((1, 1, 1), (7, 2, 1))
    for answer in (scene.see((1, 1, 2)), scene.order((1, 1, 2)), scene.weakly_visible(0), scene.graph(), walk):
        answer.certificate().save(tmp_path / "certificate.json")
        subprocess.run([program, "verify", file, tmp_path / "certificate.json"], check=True, capture_output=True)
        assert sightline.verify(scene, tmp_path / "certificate.json")
        assert sightline.verify(scene, str(tmp_path / "certificate.json"))
        assert sightline.verify(scene, (tmp_path / "certificate.json").read_text())
    with pytest.raises(FileNotFoundError):
        scene.verify("no such file.json")


def test_a_false_certificate_is_rejected():
    scene = lamp_and_lid()
    certificate = scene.order((0, 0, 10)).certificate()
    assert certificate.data["eye"] == ["0", "0", "10"]
    verdict = scene.verify(certificate.text.replace('"10"', '"-10"'))
    assert not verdict and not verdict.accepted and verdict.why
    with pytest.raises(ValueError):
        scene.verify("{}")
    with pytest.raises(TypeError, match="no certificate"):
        scene.verify(None)
    assert scene.verify(certificate.data)


def test_what_is_no_question_is_refused():
    scene = lamp_and_lid()
    for eye, error in (
        ((0, 0), ValueError),
        ((0, 0, 0, 0), ValueError),
        ((0, 0, float("nan")), ValueError),
        ((0, 0, np.float32("inf")), ValueError),
        ("1,2", ValueError),
        ("a,b,c", ValueError),
        ((0, 0, None), TypeError),
        ((0, 0, True), TypeError),
        ((0, 0, 1j), TypeError),
        (7, TypeError),
    ):
        for ask in (scene.see, scene.order, scene.tracker().move_to):
            with pytest.raises(error):
                ask(eye)
    for source, error in (
        (3, IndexError),
        (-1, IndexError),
        (10**30, IndexError),
        (True, TypeError),
        (0.5, TypeError),
        ([0, 1], TypeError),
        (np.array([0, 1]), TypeError),
        ("0,0,1 1,0,1 0,1,1", TypeError),
        ([], ValueError),
        ([[]], ValueError),
        ([[[0, 0, 0], [1, 0, 0], [0, 1, 0]], []], ValueError),
        ([[0, 0, 0], [1, 0, 0], [2, 0, 0]], ValueError),
    ):
        with pytest.raises(error):
            scene.weakly_visible(source)
    with pytest.raises(ValueError, match="budget"):
        scene.see((0, 0, 0), budget=-1)
    with pytest.raises(ValueError, match="threads"):
        scene.see((0, 0, 0), threads=-1)
    with pytest.raises(TypeError, match="progress"):
        scene.see((0, 0, 0), progress=7)


def test_threads_change_nothing():
    scene = sightline.generate("city_rotated", size=30).scene
    one, four = scene.see((-3, -5, 5), threads=1), scene.see((-3, -5, 5), threads=4)
    assert one.certificate().text == four.certificate().text
    found = [None] * 4

    def ask(i):
        found[i] = scene.see((-3, -5, 5)).visible.tolist()

    threads = [threading.Thread(target=ask, args=(i,)) for i in range(4)]
    [t.start() for t in threads], [t.join() for t in threads]
    assert found == [one.visible.tolist()] * 4


def slow_scene():
    """Asking it takes long."""
    return sightline.generate("triangles_between_squares", size=3000).scene


def test_budget_progress_and_other_threads():
    scene = slow_scene()
    told, ticks, stop = [], [], threading.Event()

    def tick():
        while not stop.wait(0.005):
            ticks.append(0)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.perf_counter()
    open_ = scene.weakly_visible(0, budget=0.5, progress=lambda done, of: told.append((done, of)))
    seconds = time.perf_counter() - start
    stop.set()
    thread.join()
    assert len(open_.visible) + len(open_.hidden) + len(open_.undecided) == scene.info()["faces"]
    assert told and all(0 <= done <= of for done, of in told) and told[-1][0] == told[-1][1]
    assert len(ticks) > 20 * min(seconds, 1)  # the interpreter went on meanwhile
    with pytest.raises(sightline.OutOfBudget):
        scene.order((-3, -5, 5), budget=1e-6)


def test_arrays_of_many_parts_are_made_while_other_threads_go_on():
    n = 400
    x, y = np.meshgrid(np.arange(n), np.arange(n))
    V = np.stack([x, y, np.random.default_rng(1).integers(0, 50, x.shape)], -1).reshape(-1, 3).astype(float)
    i = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    F = np.concatenate([np.stack([i, i + 1, i + n], 1), np.stack([i + 1, i + n + 1, i + n], 1)])
    scene = sightline.Scene(V, F)
    parts = scene.parts
    stop, times = threading.Event(), []

    def tick():
        while not stop.wait(0.002):
            times.append(time.perf_counter())

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.perf_counter()
    points, starts = parts.points()
    faces = parts.faces
    seconds = time.perf_counter() - start
    stop.set()
    thread.join()
    assert sorted(map(tuple, points[:3])) == sorted(map(tuple, V[F[0]])) and len(points) == 3 * len(F)
    assert (faces == np.arange(len(F))).all() and len(starts) == len(F) + 1
    pauses = np.diff([start] + [t for t in times if start <= t <= start + seconds] + [start + seconds])
    assert pauses.max() < 0.5 * seconds, f"nobody else had a turn for {pauses.max()} of {seconds} s"
    assert (scene.points() == V).all() and (np.array(scene.faces()) == F).all()


def test_ctrl_c_ends_what_has_no_progress_and_work_that_is_left_ends_before_the_process():
    script = """
import atexit, os, signal, threading, time
import numpy as np
atexit.register(lambda: print("ended", flush=True))
import sightline

n = 700
x, y = np.meshgrid(np.arange(n), np.arange(n))
V = np.stack([x, y, np.random.default_rng(1).integers(0, 50, x.shape)], -1).reshape(-1, 3).astype(float)
i = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
F = np.concatenate([np.stack([i, i + 1, i + n], 1), np.stack([i + 1, i + n + 1, i + n], 1)])
start = time.perf_counter()
sightline.Scene(V, F)
whole = time.perf_counter() - start
start = time.perf_counter()
threading.Timer(0.1 * whole, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    sightline.Scene(V, F)
    print("made")
except KeyboardInterrupt:
    print("interrupted", (time.perf_counter() - start) / whole)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=100)
    said = done.stdout.split()
    assert done.returncode == 0 and done.stderr == "" and said[0] == "interrupted" and said[-1] == "ended"
    assert float(said[1]) < 0.6


def test_what_progress_raises_ends_the_question():
    scene = slow_scene()

    class Enough(Exception):
        pass

    def enough(done, of):
        raise Enough

    start = time.perf_counter()
    with pytest.raises(Enough):
        scene.weakly_visible(0, progress=enough)
    assert time.perf_counter() - start < 10
    assert scene.see((-3, -5, 50)).certificate().text  # and the scene is as it was


def tangle(count):
    """Tetrahedra that nearly all go through each other: what is made of them takes long."""
    V = np.random.default_rng(1).integers(-1000, 1000, (count, 4, 3))
    turned = np.linalg.det((V[:, 1:] - V[:, :1]).astype(float)) < 0
    V[turned] = V[turned][:, [0, 2, 1, 3]]
    F = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    return sightline.Scene(V.reshape(-1, 3), (F + 4 * np.arange(count)[:, None, None]).reshape(-1, 3))


def slow_question(name):
    """As a function of keyword arguments, made ready but for what takes long."""
    if name == "boolean":
        solid = tangle(300)
        return lambda **asked: sightline.boolean("union", solid, **asked)
    if name == "space":
        return sightline.generate("triangles_between_squares", size=800).scene.shadow((-3, -5, 50)).space
    scene = slow_scene()
    scene.weakly_visible(0, budget=1e-9)  # what is made when first asked for
    if name == "see_along":
        return lambda **asked: scene.see_along((-3, -5, 50), (3, 5, -50), **asked)
    return lambda **asked: scene.weakly_visible(0, **asked)


@pytest.mark.parametrize("name", ["space", "boolean"])
def test_budget_and_progress_of_what_is_made_of_solids(name):
    ask, told = slow_question(name), []
    with pytest.raises(sightline.OutOfBudget):
        ask(threads=1, budget=1, progress=lambda done, of: told.append(done / of))
    assert told == sorted(told) and 0 <= told[0] and told[-1] < 1
    small = tangle(6)
    one, four = (sightline.boolean("union", small, threads=n) for n in (1, 4))
    assert one.volume == four.volume and one.sources.tolist() == four.sources.tolist()


def test_results_of_boolean_are_not_made_ready_before_they_are_asked():
    start = time.process_time()
    union = sightline.boolean("union", tangle(40), threads=1, budget=30)  # one grid for its points takes half a minute
    low, high = union.area
    assert union.volume > 0 and 0 < low <= high < low * 1.000001
    assert len(union.scene.points(exact=True)) == union.scene.point_count
    assert len(union.scene.faces()) == union.scene.face_count == len(union.sources)
    assert time.process_time() - start < 10
    small = sightline.boolean("union", tangle(3), threads=1)
    assert small.scene.areas.sum() == pytest.approx(small.area[0], rel=1e-12) == pytest.approx(small.area[1], rel=1e-12)


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
@pytest.mark.parametrize("name", ["weakly_visible", "see_along", "space", "boolean"])
def test_interrupts_end_a_question_at_once(name):
    ask, sent = slow_question(name), []

    def interrupt():
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(0.3, interrupt)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        ask(budget=60)
    assert time.perf_counter() - sent[0] < 5


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
@pytest.mark.parametrize("name", ["Scene", "trace"])
def test_interrupts_end_the_reading_of_objects(name):
    class Enough(Exception):
        pass

    def enough(*_):
        raise Enough

    def ask():
        V, F = np.full((200_000, 3), 7, dtype=object), np.empty((0, 3), np.int64)
        return sightline.Scene(V, F) if name == "Scene" else sightline.Scene([], []).trace(V[:50_000], V[0], all=True)

    start = time.process_time()
    ask()
    whole = time.process_time() - start
    before = signal.signal(signal.SIGPROF, enough)
    try:
        start = time.process_time()
        signal.setitimer(signal.ITIMER_PROF, whole / 8)  # of processor time
        with pytest.raises(Enough):
            ask()
        assert time.process_time() - start < whole / 2
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_interrupts_end_writing_and_leave_the_old_file(tmp_path):
    n = 250
    x, y = np.meshgrid(np.arange(n) / 7, np.arange(n) / 7)  # exact decimals of some fifty digits
    i = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    F = np.concatenate([np.stack([i, i + 1, i + n], 1), np.stack([i + 1, i + n + 1, i + n], 1)])
    V = np.stack([x, y, x * y], -1).reshape(-1, 3)
    scene, other = sightline.Scene(V, F), sightline.Scene(V, F[::-1])
    file = tmp_path / "a.off"
    took = []
    for _ in range(2):  # the lesser time: an interrupt that comes when all is written would leave the new file
        start = time.perf_counter()
        scene.write(file)
        took.append(time.perf_counter() - start)
    whole, old = min(took), file.read_bytes()
    assert old.startswith(f"OFF\n{len(V)} {len(F)} 0\n".encode()) and old.count(b"\n") == 2 + len(V) + len(F)
    sent = []

    def interrupt():
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    threading.Timer(0.1 * whole, interrupt).start()
    with pytest.raises(KeyboardInterrupt):
        other.write(file)
    assert time.perf_counter() - sent[0] < max(0.3, 0.3 * whole)
    time.sleep(whole)  # nothing goes on to write it either
    is_old = file.read_bytes() == old  # megabytes, of which pytest would seek the difference for minutes
    assert is_old and [f.name for f in tmp_path.iterdir()] == ["a.off"]
    with pytest.raises(OSError, match="none"):
        scene.write(tmp_path / "none" / "a.off")
    with pytest.raises(ValueError, match="STL"):
        sightline.Scene([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]]).write(tmp_path / "a.stl")


def test_pictures():
    pytest.importorskip("matplotlib")
    scene = lamp_and_lid()
    ax = scene.see((0, 0, 10)).plot()
    (drawn,) = ax.collections
    assert len(drawn.get_paths()) == len(scene.see((0, 0, 10)).parts) > 1
    (drawn,) = scene.weakly_visible(2).plot(eye="0,-9,9").collections
    paths = [path.vertices for path in drawn.get_paths()]
    assert len(paths) == 2  # of the lamp its back is seen, which is not drawn
    assert np.ptp(paths[0], axis=0)[0] > np.ptp(paths[1], axis=0)[0]  # the floor is painted first
    red, green, blue = drawn.get_facecolors()[0][:3]
    assert red > green > blue == 0  # orange
    scene.see((0, 0, 1)).plot()  # from within: what is behind the eye is not drawn


def test_progress_bar():
    pytest.importorskip("tqdm")
    assert lamp_and_lid().see((0, 0, 2), progress=True).visible.tolist() == [0, 1, 2]


def test_triangles_fan_the_parts_out():
    scene = sightline.read(corpus / "two_rooms.off")
    V, F, faces = scene.see((1, 1, 2)).parts.triangles()
    corners = V[F]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.bincount(faces, np.linalg.norm(normals, axis=1) / 2, minlength=scene.face_count)
    assert areas == pytest.approx(scene.see((1, 1, 2), two_sided=True).areas, abs=1e-9)
