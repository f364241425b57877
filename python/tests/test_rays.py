"""Rays and solids, against exact arithmetic done here."""

import itertools
import random
import time
from fractions import Fraction

import numpy as np
import pytest

import sightline


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def met(triangle, origin, direction):
    """Where a ray that is not in its plane meets a closed triangle, and whether from its front; or None."""
    a, b, c = triangle
    normal = cross(minus(b, a), minus(c, a))
    slope = dot(normal, direction)
    if slope == 0:
        return None
    t = Fraction(dot(normal, minus(a, origin))) / slope
    if t <= 0:
        return None
    p = [x + t * d for x, d in zip(origin, direction)]
    sides = [dot(normal, cross(minus(v, u), minus(p, u))) for u, v in ((a, b), (b, c), (c, a))]
    return (t, 1 if slope < 0 else -1) if min(sides) >= 0 else None


@pytest.mark.parametrize("kind", ["doubles", "fractions"])
def test_rays_meet_what_arithmetic_by_hand_says(kind):
    dice = random.Random(7)
    V = np.array([[dice.randrange(-3, 4) for _ in range(3)] for _ in range(25)])
    F = np.array([dice.sample(range(25), 3) for _ in range(20)])  # they share corners
    scene = sightline.Scene(V, F)
    out = {face for face, _ in scene.left_out}
    share = Fraction(1, 3) if kind == "fractions" else 1
    origins = [[dice.randrange(-4, 5) * share for _ in range(3)] for _ in range(300)]
    directions = [[dice.randrange(-3, 4), dice.randrange(-3, 4), dice.choice((-5, 5)) * share] for _ in range(300)]
    for i in range(0, 300, 3):  # to a corner
        origins[i], directions[i] = (o := [4 * share, 5, dice.randrange(-4, 5)]), minus(V[i % 25].tolist(), o)
    first, every = scene.trace(origins, directions), scene.trace(origins, directions, all=True)
    compared = tied = 0
    for i, (o, d) in enumerate(zip(origins, directions)):
        hits = {}
        for f in set(range(20)) - out:
            a, b, c = V[F[f]].tolist()
            in_plane = dot(cross(minus(b, a), minus(c, a)), d) == 0
            if not in_plane and (hit := met((a, b, c), o, d)):
                hits[f] = hit
        said = {hit.face: (hit.t, hit.side) for hit in every[i] if hit.side != 0}
        assert said == hits, (o, d)
        if any(hit.side == 0 for hit in every[i]):
            continue
        if not hits:
            assert first.faces[i] == -1 and np.isnan(first.t[i]) and first[i] == []
            continue
        compared += 1
        least = min(t for t, _ in hits.values())
        nearest = sorted(f for f, (t, _) in hits.items() if t == least)
        tied += len(nearest) > 1
        assert first.faces[i] == nearest[0] and first.tied[i] == (len(nearest) > 1)
        assert first.t[i] == pytest.approx(float(least), rel=1e-12) and first.sides[i] == hits[nearest[0]][1]
        assert [hit.face for hit in first[i]] == nearest and first[i][0].t == least
        assert first[i][0].point == tuple(x + least * y for x, y in zip(o, d))
        assert first.points[i] == pytest.approx([float(x) for x in first[i][0].point], abs=1e-12)
    assert compared > 80 and tied > 10


def test_rays_of_all_kinds():
    square = sightline.Scene([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
    down = square.trace(np.array([[0.5, 0.5, 2], [3, 3, 3]], np.float32), (0, 0, -1))
    assert down.faces.tolist() == [0, -1] and down.t[0] == 2 and len(down) == 2
    assert square.trace((0, 0, 1), [[0, 0, -1], [0, 0, 1]]).faces.tolist() == [0, -1]
    along = square.trace(("-1", "1/3", 0), (1, 0, 0))
    assert along[0] == [(0, 0, 1, 2, (0, Fraction(1, 3), 0))]
    assert along.points.tolist() == [[0, pytest.approx(1 / 3), 0]]
    leaving = square.trace((0.5, 0.5, 0), (0, 0, 1)), square.trace((0.5, 0.5, 0), (0, 0, 1), closed=True)
    assert [rays.faces[0] for rays in leaving] == [-1, 0] and leaving[1][0][0].t == 0
    assert square.trace(np.empty((0, 3)), (0, 0, 1)).faces.shape == (0,)
    assert [len(rays) for rays in down[0:2]] == [1, 0] and down[-1] == []
    for origins, directions, error in (
        ((0, 0, 0), (0, 0, 0), ValueError),
        ((0, 0, "1/3"), (0, 0, 0), ValueError),
        ((0, 0, float("nan")), (0, 0, 1), ValueError),
        (np.array([0, 0, np.inf]), (0, 0, 1), ValueError),
        ([[0, 0, 0]] * 2, [[0, 0, 1]] * 3, ValueError),
        ((0, 0), (0, 0, 1), ValueError),
        ((0, 0, 1j), (0, 0, 1), TypeError),
        ("0,0,0", (0, 0, 1), TypeError),
        (np.zeros((1, 3), bool), (0, 0, 1), TypeError),
    ):
        with pytest.raises(error):
            square.trace(origins, directions)
    with pytest.raises(IndexError):
        down[2]


def test_one_direction_for_all_rays_is_read_once():
    scene, origins = sightline.Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]), np.random.rand(200_000, 3)

    def seconds(direction):
        start = time.process_time()
        assert (scene.trace(origins, direction, threads=1).points >= 0).any()
        return time.process_time() - start

    assert seconds((0, 0, -1.0)) < 2 * seconds(np.tile([0, 0, -1.0], (len(origins), 1)))


def test_whole_numbers_that_no_double_holds_are_not_rounded():
    n = 2**53
    scene = sightline.Scene([[n, -10, 0], [n, 10, 0], [0, 0, 0]], [[0, 1, 2]])
    for at, expected in ((n, 0), (n + 1, -1)):
        origins = [[at, 0, 5]]
        for given in (origins, np.array(origins, dtype=np.int64), np.array(origins, dtype=np.uint64),
                      np.array([[np.int64(at), 0, 5]], dtype=object)):
            rays = scene.trace(given, [[0, 0, -1]])
            assert rays.faces.tolist() == [expected]
            assert len(rays[0]) == expected + 1


def test_solids():
    box = sightline.generate("convex_sphere", size=100).scene
    low, high = (np.array(corner) for corner in box.info()["box"])
    moved = sightline.Scene(box.points(exact=True) + (high - low) / 2, box.faces())
    volume = {word: sightline.boolean(word, box, moved).volume for word in
              ("union", "intersection", "difference", "symmetric-difference")}  # fmt: skip
    whole = sightline.boolean("union", box).volume
    assert volume["intersection"] > 0 and isinstance(whole, Fraction)
    assert volume["union"] + volume["intersection"] == 2 * whole
    assert volume["difference"] == whole - volume["intersection"]
    assert volume["symmetric-difference"] == 2 * volume["difference"]
    found = sightline.boolean("difference", box, moved)
    assert found.scene.info()["closed"] and found.sources.shape == (found.scene.face_count, 2)
    assert set(found.sources[:, 0]) == {0, 1} and found.sources[:, 1].max() < box.face_count
    with pytest.raises(ValueError, match="union"):
        sightline.boolean("minus", box, moved)
    with pytest.raises(ValueError, match="solid 1 bounds no solid"):
        sightline.boolean("union", box, sightline.Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))


def test_answers_keep_what_they_were_asked():
    lid = sightline.Scene([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], [[0, 1, 2], [3, 4, 5]])
    origins, down = np.array([[0.25, 0.25, 3], [1, 1, 3]]), np.array([0, 0, -1.0])
    rays = lid.trace(origins, down)
    origins[:], down[:] = 9, 9
    assert [hits[0].face for hits in rays] == [1, 0] and rays.points.tolist() == [[0.25, 0.25, 1], [1, 1, 0]]
    eye = np.array([0, 0, 2.0])
    seen, tracked, shadow = lid.see(eye), lid.order(eye), lid.shadow(eye)
    picture, walk = lid.render(eye, look=(0, 0, -1), up=(0, 1, 0), size=(4, 4)), lid.see_along(eye, eye + 1)
    before = seen.solid_angles.copy(), picture.means(np.eye(2, 3))[0], shadow.space().volume
    eye += 5
    assert np.array_equal(seen.solid_angles, before[0]) and seen.eye == tracked.eye == (0, 0, 2) == walk.start
    assert np.array_equal(picture.means(np.eye(2, 3))[0], before[1]) and shadow.space().volume == before[2]
    assert np.array_equal(lid.see(iter([0, 0, 2])).solid_angles, before[0])
    with pytest.raises(ValueError, match="wants three numbers"):
        lid.see(itertools.count())
    with pytest.raises(ValueError, match="masked"):
        lid.trace(np.ma.array([[0.25, 0.25, 3]], mask=[[1, 0, 0]]), (0, 0, -1))
    with pytest.raises(ValueError, match="masked"):
        lid.see(np.ma.array([0.25, 0.25, 3], mask=[1, 0, 0]))
