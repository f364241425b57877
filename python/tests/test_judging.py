"""Functions of somebody's are judged: right ones hold, and what is wrong with others is found and made small."""

from fractions import Fraction

import numpy as np
import pytest

import sightline


def right(V, F, eye):
    return sightline.Scene(V, F).see(eye).visible


def in_front(V, F, eye):
    """All faces that the eye is in front of, as if none hid another: in doubles, without care."""
    seen = []
    for k, f in enumerate(F):
        a, b, c = V[f[0]], V[f[1]], V[f[2]]
        if np.dot(np.cross(b - a, c - a), eye - a) > 0:
            seen.append(k)
    return seen


def test_generate_is_what_the_program_generates():
    made = sightline.generate("hinged", seed=3, ulps=1, offset=("1/3", 0, 0), scale=2)
    again = sightline.generate("hinged", seed=3, ulps=1)
    assert made.scene.points(exact=True)[0, 0] == 2 * again.scene.points(exact=True)[0, 0] + Fraction(1, 3)
    assert made.eye[1] == 2 * again.eye[1]
    assert made.first == 0
    pair = sightline.generate("solids_twice", seed=5)
    assert 2 * pair.first == pair.scene.face_count
    assert "hinged" in sightline.families()
    with pytest.raises(ValueError, match="hinged"):
        sightline.generate("no such family")
    with pytest.raises(ValueError, match="ulps"):
        sightline.generate("hinged", ulps="near")
    for name, number in (("size", -1), ("seed", -1), ("seed", 2**64), ("ulps", 10**30)):
        with pytest.raises(ValueError, match=name):
            sightline.generate("hinged", **{name: number})
    with pytest.raises(TypeError):
        sightline.generate("hinged", size=1.5)


def test_what_a_family_knows_is_right():
    known = 0
    for family in ("five_edges", "regulus"):
        for seed in range(1, 5):
            made = sightline.generate(family, seed=seed)
            found = made.scene.weakly_visible(made.source)
            assert set(made.visible) <= set(found.visible) and set(made.hidden) <= set(found.hidden)
            known += len(made.visible) + len(made.hidden)
    assert known > 0


@pytest.mark.parametrize("triangles, exact", [(False, False), (True, False), (False, True)])
def test_a_right_function_holds(triangles, exact):
    def ask(V, F, eye):
        assert V.dtype == (object if exact else float)
        assert isinstance(F, np.ndarray) == triangles
        return right(V, F, eye)

    report = sightline.judge(ask, families=["leaves", "boxes"], cases=2, triangles=triangles, exact=exact)
    assert report and report.total["right"] == 16 - report.total["not asked"] and report.smallest is None
    assert report.total["right"] > 8 and "exact: holds" in str(report)


def test_a_wrong_function_is_refuted_by_a_small_scene(tmp_path):
    report = sightline.judge(in_front, families=["boxes", "leaves"], cases=3, seed=2)
    assert not report.holds and report.total["wrong"] == len(report.failures) > 0
    smallest = report.smallest
    assert smallest.mark == "wrong" and len(smallest.wrong_visible) + len(smallest.wrong_hidden) > 0
    assert smallest.face_count <= min(failure.face_count for failure in report.failures)
    truth = set(smallest.scene.see(smallest.eye).visible)
    said = set(in_front(*smallest.arguments))
    assert set(smallest.wrong_visible) <= said - truth and set(smallest.wrong_hidden) <= truth - said
    assert smallest.explanation["line"] and "refuted" in str(report)
    smallest.save(tmp_path)
    assert sightline.read(tmp_path / "scene.qoff").face_count == smallest.face_count
    assert (tmp_path / "query.json").read_text().startswith('{"query":"see"')


def test_contracts():
    everything = lambda V, F, eye: range(len(F))  # noqa: E731
    options = {"families": ["boxes"], "cases": 2, "reduce": 0}
    assert sightline.judge(everything, contract="conservative", **options)
    assert not sightline.judge(everything, contract="aggressive", **options)
    assert sightline.judge(lambda V, F, eye: [], contract="aggressive", **options)
    assert not sightline.judge(lambda V, F, eye: [], contract="conservative", **options)
    with pytest.raises(ValueError, match="contract"):
        sightline.judge(everything, contract="perfect")
    with pytest.raises(ValueError, match="query"):
        sightline.judge(everything, "look")


def test_ways_to_answer():
    def mask(V, F, eye):
        answer = np.zeros(len(F), bool)
        answer[right(V, F, eye)] = True
        return answer

    options = {"families": ["boxes"], "cases": 2, "ulps": (0,), "reduce": 0}
    for function in (mask, lambda *a: set(right(*a)), lambda *a: {"visible": right(*a), "abstained": []}):
        assert sightline.judge(function, **options).total["right"] == 2
    assert sightline.judge(lambda V, F, eye: {"abstained": range(len(F))}, **options).total["abstained"] == 2
    for ask in (sightline.judge, sightline.fuzz):
        with pytest.raises(TypeError, match="no function"):
            ask(None)
    for answer in ([10**6], [-1], [0.5], None, "all", {"seen": [0]}):
        report = sightline.judge(lambda V, F, eye: answer, **options)
        assert report.total["invalid"] == 2 and report.smallest.why
    crashed = sightline.judge(lambda V, F, eye: 1 // 0, **options)
    assert crashed.total["crashed"] == 2 and "ZeroDivisionError" in crashed.smallest.why


def test_truth_values_may_be_a_list_and_have_to_be_one_for_each_face():
    def said(make):
        return sightline.judge(
            lambda V, F, eye: make(np.isin(np.arange(len(F)), right(V, F, eye))), families="boxes", ulps=0, cases=3
        )

    for make in (list, np.ndarray.tolist, tuple, lambda m: {"visible": m}, lambda m: {"visible": m.tolist()}):
        report = said(make)
        assert report and report.total["right"] == 3
    for make in (lambda m: m[:-1], lambda m: [*m, False], lambda m: [True, *np.flatnonzero(m)]):
        report = said(make)
        assert report.total["invalid"] == 3 and "truth value" in report.failures[0].why


def test_orders_and_weak_visibility():
    def nearest_last(V, F, eye):
        scene = sightline.Scene(V, F)
        return list(dict.fromkeys(reversed([f for f in scene.order(eye).faces])))[::-1]

    report = sightline.judge(nearest_last, "order", families=["hinged"], cases=2, reduce=0)
    assert report.total["right"] + report.total["not asked"] == 8 and report.total["right"] > 0
    weak = lambda V, F, source: sightline.Scene(V, F).weakly_visible(source).visible  # noqa: E731
    assert sightline.judge(weak, "weak", families=["five_edges"], cases=2, reduce=0).total["right"] == 8
    turned = lambda V, F, source: sightline.Scene(V, F).weakly_visible(source[::-1]).visible  # noqa: E731
    assert not sightline.judge(turned, "weak", families=["five_edges"], cases=2, ulps=(0,), reduce=0)


@pytest.mark.parametrize("exact", [False, True])
def test_rays(exact):
    def first(V, F, rays):
        rays = np.asarray(rays)
        return sightline.Scene(V, F).trace(rays[:, 0], rays[:, 1]).faces

    asked = dict(query="trace", families=["hinged", "boxes"], ulps=[0, "far"], cases=2, exact=exact)
    report = sightline.judge(first, **asked)
    assert report and report.total["right"] == 8, report
    nothing = sightline.judge(lambda V, F, rays: [None] * len(rays), reduce=0, **asked)
    assert nothing.total["wrong"] == 8
    assert nothing.smallest.wrong_hidden.size > 0 and nothing.smallest.wrong_visible.size == 0
    assert "met first, and not named" in nothing.smallest.why and "first meets" in str(nothing.smallest)
    assert sightline.judge(lambda V, F, rays: ["abstained"] * len(rays), **asked).total["abstained"] == 8
    assert sightline.judge(lambda V, F, rays: [], reduce=0, **asked).total["invalid"] == 8


@pytest.mark.parametrize("exact", [False, True])
def test_set_operations(exact):
    def solids(V, F, first):
        return [sightline.Scene(V, faces) for faces in (F[:first], F[first:])]

    def result(V, F, asked):
        scene = sightline.boolean(asked[0], *solids(V, F, asked[1])).scene
        return scene.points(exact=True), scene.faces()

    def both(V, F, asked):
        return V, F

    asked = dict(query="boolean", families=["leaves", "boxes"], ulps=[0, "far"], cases=3, exact=exact, triangles=True)
    report = sightline.judge(result, **asked)
    assert report and report.total["right"] > 6, report
    small = dict(asked, families=["boxes"], ulps=np.int64(0))
    narrow = sightline.judge(lambda V, F, asked: (np.array(result(V, F, asked)[0], np.float32), result(V, F, asked)[1]), **small)
    assert narrow.total["invalid"] == 0 < narrow.total["right"]
    union = sightline.judge(lambda V, F, asked: result(V, F, ("union", asked[1])), contract="conservative", **asked)
    assert union and union.total["wrong"] > 0, union
    wrong = sightline.judge(both, reduce=1, **asked)
    assert not wrong and wrong.smallest.mark == "wrong" and wrong.smallest.eye[0] in wrong.smallest._case.query()
    assert "beside face" in wrong.smallest.why or "the volume" in wrong.smallest.why
    assert sightline.judge(lambda V, F, asked: None, **asked).total["abstained"] == report.total["right"]
    open_ones = sightline.judge(lambda V, F, asked: (V, F[1:]), reduce=0, **asked)
    assert open_ones.total["invalid"] == report.total["right"]
    with pytest.raises(ValueError, match="fuzz asks see or weak"):
        sightline.fuzz(both, query="boolean")


def test_interrupts_are_not_graded():
    def interrupted(V, F, eye):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sightline.judge(interrupted, families=["boxes"], cases=1)
    with pytest.raises(KeyboardInterrupt):
        sightline.fuzz(interrupted, scenes=3)


def test_fuzz_holds_a_right_function():
    report = sightline.fuzz(right, scenes=30, seed=5)
    assert report and report.scenes == 30 and report.checks["exact"][0] > 15 and report.checks["permute"][0] > 15
    exact = sightline.fuzz(right, scenes=10, exact=True)
    assert exact and exact.checks["rotate"][0] > 5


def test_fuzz_finds_what_a_law_forbids():
    def by_place(V, F, eye):  # right, but where face 0 is not seen, of the last face it says that it is not either
        visible = right(V, F, eye)
        return visible if 0 in visible else [f for f in visible if f != len(F) - 1]

    report = sightline.fuzz(by_place, scenes=200, reduce=2, seed=2)
    assert not report.holds and report.finding.face_count <= 4 and report.finding.again.startswith("case ")
    assert "check" in report.finding.again and str(report)
    crashed = sightline.fuzz(lambda V, F, eye: 1 // 0, scenes=3, reduce=1)
    assert crashed.finding.mark == "crashed" and "ZeroDivisionError" in crashed.finding.why
    with pytest.raises(ValueError, match="order"):
        sightline.fuzz(right, "order")
