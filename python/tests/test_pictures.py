"""Images, drawings and partitions, each held to another question."""

import math
from fractions import Fraction

import numpy as np
import pytest

import sightline
from sightline import Scene

lid = Scene([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], [[0, 1, 2], [3, 4, 5]])
town = sightline.generate("city_rotated", size=4, seed=3).scene


def exact_rays(picture):
    """The directions of pixels' centres, as the page says, in Fractions."""
    width, height = picture.size
    axes = [[Fraction(float(x)) for x in axis] for axis in (picture.look, picture.right, picture.up)]
    for y in range(height):
        for x in range(width):
            across, upwards = Fraction(2 * x + 1 - width, width), Fraction(height - 2 * y - 1, height)
            yield [look + across * right + upwards * up for look, right, up in zip(*axes)]


def test_pixels_show_what_their_rays_meet_first():
    for scene, eye in ((town, (7, -6, 7)), (lid, (1, 1, 3)), (lid, (0, 0, 2))):
        picture = scene.render(eye, size=(24, 18))
        assert picture.faces.shape == picture.sides.shape == picture.tied.shape == (18, 24)
        rays = scene.trace(eye, list(exact_rays(picture)))
        clear = ~picture.tied.ravel()
        assert clear.sum() > 400 and (picture.faces >= 0).sum() > 20
        assert np.array_equal(picture.faces.ravel()[clear], rays.faces[clear])
        assert np.array_equal(picture.sides.ravel()[clear], rays.sides[clear])
        assert np.allclose(picture.rays.reshape(-1, 3), np.array(list(exact_rays(picture)), dtype=float))


def test_a_ray_through_a_border_is_a_tie():
    picture = lid.render((2, 1, 3), look=(0, 0, -1), up=(0, 1, 0), size=(3, 3))
    assert picture.faces[1, 1] == 0 and not picture.tied[1, 1]
    picture = lid.render((2, 0, 3), look=(0, 0, -1), up=(0, 1, 0), size=(3, 3))
    assert picture.faces[1, 1] == 0 and picture.tied[1, 1]
    dart = Scene([[0, 0, 0], [3, 0, 0], [1, 1, 0], [0, 3, 0]], [[0, 1, 2, 3]])  # cut from (0, 0, 0) to (1, 1, 0)
    picture = dart.render(("1/2", "1/2", 3), look=(0, 0, -1), up=(0, 1, 0), size=(3, 3))
    assert picture.faces[1, 1] == 0 and picture.tied[1, 1]


def test_directions_are_any_numbers():
    def axes(look, up=(0, 0, 1)):
        picture = lid.render((1, 1, 5), look=look, up=up, size=(4, 4))
        return [axis.tolist() for axis in (picture.look, picture.right, picture.up)]

    for look in ("1/2,1,-3", ["1/2", "1", "-3"], np.array([0.5, 1, -3], np.float32), [Fraction(1, 2), 1, -3],
                 [2**1400, 2 * 2**1400, -6 * 2**1400], [Fraction(1, 2**1400) * k for k in (1, 2, -6)],
                 np.array([1, 2, -6], np.int8)):  # fmt: skip
        assert axes(look) == axes((0.5, 1, -3))
    for eye in ((2**62, 5, -(2**62)), (np.int64(2**62), np.int8(5), np.int64(-(2**62)))):
        look = lid.render(eye, size=(4, 4)).look
        assert look == pytest.approx([-math.sqrt(0.5), 0, math.sqrt(0.5)], abs=1e-9)
    assert axes((1, 0, 0), "0,0,1") == axes((1, 0, 0), (0, 0, 5e-324)) == axes((1, 0, 0))


def test_means_are_what_many_centres_come_to():
    eye, fine = (7, -6, 7), 16
    colours = np.random.default_rng(1).random((town.face_count, 3))
    coarse = town.render(eye, size=(12, 9))
    sums, covered = coarse.means(colours)
    many = town.render(eye, size=(12 * fine, 9 * fine)).faces
    seen = np.concatenate([colours, np.zeros((1, 3))])[many].reshape(9, fine, 12, fine, 3).mean(axis=(1, 3))
    assert np.abs(sums - seen).max() < 0.05 and np.abs(sums - seen).mean() < 0.005
    assert 0 <= covered.min() and covered.max() <= 1 + 1e-9
    assert np.abs(covered - (many >= 0).reshape(9, fine, 12, fine).mean(axis=(1, 3))).max() < 0.05


def test_pictures_say_what_is_wrong_with_their_view():
    for wrong in ({"field": 180}, {"field": 0}, {"size": (0, 5)}, {"size": (2**20, 2**20)}, {"look": (0, 0, 0)},
                  {"look": (0, 0, -1)}, {"look": (0, 1)}, {"look": (0, float("nan"), 0)}, {"look": "a,b,c"},
                  {"look": (0, float("inf"), 0)}, {"look": ("1/0", 1, 0)}, {"size": (4, 4, 4)},
                  {"look": np.ma.masked_array([1, 0, 0], [1, 0, 0])}):  # fmt: skip
        with pytest.raises(ValueError, match="; give|along"):
            lid.render((1, 1, 5), **{"size": (4, 4), **wrong})
    with pytest.raises(TypeError):
        lid.render((1, 1, 5), look=np.array([1j, 0, 1]), size=(4, 4))
    picture = lid.render((1, 1, 5), size=(4, 4))
    with pytest.raises(ValueError, match="three for each face"):
        picture.means([[1, 0, 0]])
    with pytest.raises(ValueError, match="values has numbers that are masked"):
        picture.means(np.ma.masked_array(np.ones((2, 3)), np.eye(2, 3)))
    with pytest.raises(TypeError, match="values are complex"):
        picture.means(np.ones((2, 3)) * 1j)
    with pytest.raises(sightline.OutOfBudget):
        town.render((7, -6, 7), size=(900, 900), budget=1e-9)


def test_a_frustum_shows_what_is_in_it():
    all_around = town.see((7, -6, 7))
    rays = [(-7, 5, -7), (-7, 6, -6), (-6, 7, -7)]
    turned = np.linalg.det(np.array(rays, dtype=float)) < 0
    frustum = rays[::-1] if turned else rays
    seen = town.see((7, -6, 7), frustum=frustum)
    assert 0 < len(seen.visible) < len(all_around.visible)
    assert set(seen.visible) <= set(all_around.visible)
    whole, some = all_around.solid_angles, seen.solid_angles
    assert np.all(some <= whole + 1e-9) and 0 < some.sum() < whole.sum() / 2
    verdict = seen.certificate().verify()
    assert verdict.accepted and "the field" in verdict.why
    with pytest.raises(ValueError, match="convex cone"):
        town.see((7, -6, 7), frustum=frustum[::-1])
    with pytest.raises(ValueError, match="three rays"):
        town.see((7, -6, 7), frustum=frustum[:2])


def test_lines_are_seen_where_no_face_is_before_them():
    eye = [Fraction(7), Fraction(-6), Fraction(7)]
    kinds, hidden = set(), 0
    for line in town.see(eye).lines():
        kinds.add(line.kind)
        assert line.stretches[0].start == 0 and line.stretches[-1].end == 1
        for k, part in enumerate(line.stretches):
            assert part.start < part.end and (k == 0 or line.stretches[k - 1].end == part.start)
            middle = [p + (part.start + part.end) / 2 * (q - p) for p, q in zip(*line.ends)]
            met = town.trace([eye], [[m - e for m, e in zip(middle, eye)]], all=True)[0]
            before = {hit.face for hit in met if hit.t < 1}
            assert (part.hidden_by in before) if part.hidden_by is not None else not before
            hidden += part.hidden_by is not None
    assert {"silhouette", "crease"} <= kinds and hidden > 5


def test_partitions_are_what_points_see():
    V = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0], [1, 0, 1], [1, 4, 1], [1, 4, 0], [1, 0, 0]]
    lamp = [[2, 1, 3], [2, 3, 3], [3, 3, 3], [3, 1, 3]]
    scene = Scene(V, [[0, 1, 2, 3], [4, 5, 6, 7]])
    with_lamp = Scene(V + lamp, [[0, 1, 2, 3], [4, 5, 6, 7], [8, 9, 10, 11]])
    for all_borders in (False, True):
        divided = scene.partition(lamp, 0, all_borders=all_borders)
        assert {cell.light for cell in divided.cells} == {"lit", "penumbra", "umbra"}
        assert sum(low for low, _ in divided.shares.values()) <= 1 <= sum(high for _, high in divided.shares.values())
        for cell in divided.cells:
            seen = with_lamp.see(cell.point).areas[2]
            assert seen == {"lit": 2, "umbra": 0}.get(cell.light, seen) and (cell.light != "penumbra" or 0 < seen < 2)
            assert bool(cell.edges and cell.edges[0]) == (all_borders and cell.light != "umbra")
        assert divided.charts[0].piece == 0
        for border in divided.borders:
            assert border.kind in ("line", "conic", "upright")
            assert all(side is None or 0 <= side < len(divided.cells) for side in (border.below, border.above))
    assert with_lamp.partition(2, 0).shares["lit"] == scene.partition(lamp, 0).shares["lit"]
    for face in (9, -1, 1.5):
        with pytest.raises(IndexError, match="is not there"):
            scene.partition(lamp, face)


def test_a_conservative_answer_leaves_out_nothing():
    window = [[-1, 2, 0.2], [-1, 3, 0.2], [-1, 3, 0.6], [-1, 2, 0.6]]
    quick, exact = town.weakly_visible(window, conservative=True), town.weakly_visible(window)
    assert set(exact.visible) <= set(quick.visible) and set(quick.hidden) <= set(exact.hidden)
    assert len(quick.hidden) > 0 and len(quick.undecided) == 0
    assert quick.certificate().verify().accepted


def test_set_operations_are_proved():
    cube = Scene([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
                 [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [2, 3, 7, 6], [1, 2, 6, 5], [3, 0, 4, 7]])  # fmt: skip
    other = Scene(cube.points() + [0.5, 0.25, 0.125], cube.faces())
    union = sightline.boolean("union", cube, other)
    assert union.volume == 2 - Fraction(1, 2) * Fraction(3, 4) * Fraction(7, 8)
    certificate = union.certificate()
    assert certificate.verify().accepted and certificate.data["operation"] == "union"
    less = sightline.boolean("difference", cube, other)
    assert less.certificate().verify().accepted
    taken = sightline.SolidCertificate(less.scene, (cube, other), certificate.text)
    assert not taken.verify().accepted
    with pytest.raises(ValueError):
        sightline.SolidCertificate(less.scene, (cube, other), "{}").verify()
    with pytest.raises(TypeError, match="solid 1 is a int; give each as a Scene"):
        sightline.boolean("union", cube, 5)


@pytest.mark.parametrize("scale", [Fraction(10) ** 200, Fraction(1, 10**200), Fraction(10) ** 400, Fraction(1, 10**400)])
def test_scenes_of_any_size_are_looked_at(scale):
    corners = [[0, 0, 0], [4, 0, 0], [0, 4, 0], [900, 900, 900]]  # the last is of no face
    eye = (scale, scale, 5 * scale)
    scene = Scene([[scale * x for x in p] for p in corners], [[0, 1, 2]])
    picture = scene.render(eye, up=(0, 1e-200, 0), size=(8, 6))
    assert np.array_equal(picture.faces, Scene(corners, [[0, 1, 2]]).render((1, 1, 5), up=(0, 1, 0), size=(8, 6)).faces)
    assert (picture.faces == 0).any() and (picture.faces < 0).any()
