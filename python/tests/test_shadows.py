"""What lights reach: by hand, what the program says, and parts that add up to their faces as fractions."""

from fractions import Fraction

import numpy as np
import pytest

import sightline
from test_answers import by_program, corners_of, corpus, lamp_and_lid


def vector_area(corners):
    """Twice the area of a polygon as a vector, exactly."""
    total = [Fraction(0)] * 3
    for p, q in zip(corners, corners[1:] + corners[:1]):
        for k in range(3):
            i, j = (k + 1) % 3, (k + 2) % 3
            total[k] += p[i] * q[j] - p[j] * q[i]
    return total


def by_face(parts):
    sums = {}
    for part in parts:
        of = sums.setdefault((part.face, part.piece), [Fraction(0)] * 3)
        sums[part.face, part.piece] = [a + b for a, b in zip(of, vector_area(part.corners))]
    return sums


def test_a_shadow_by_hand():
    shadow = lamp_and_lid().shadow((0, 0, 2))
    assert (shadow.lit.tolist(), shadow.away.tolist(), shadow.dark.tolist()) == ([0, 1, 2], [], [])
    assert shadow.lit_areas == pytest.approx([64 - 16, 4, 4])  # the lid shadows [-2, 2]^2 of the floor
    assert shadow.dark_areas == pytest.approx([16, 0, 0])
    dark = [part for part, by in zip(shadow.parts, shadow.by) if by >= 0]
    assert {int(by) for by in shadow.by} == {-1, 1}
    corners = [p for part in dark for p in part.corners]
    assert (min(corners), max(corners)) == ((-2, -2, 0), (2, 2, 0)) and {p[2] for p in corners} == {0}
    above = lamp_and_lid().shadow((0, 0, 10))
    assert above.away.tolist() == [2] and above.dark.tolist() == [1, 2]  # the lamp's back shadows the lid
    both = lamp_and_lid().shadow((0, 0, 10), two_sided=True)
    assert both.lit.tolist() == [0, 2] and both.away.tolist() == []
    assert {part.from_front for part in both.parts if part.face == 2} == {False}
    sun = lamp_and_lid().shadow(sun=("0", 0, Fraction(1, 3)))
    assert sun.dark_areas == pytest.approx([4, 4, 0]) and sun.lit.tolist() == [0]
    assert set(sun.by[sun.parts.faces == 1]) == {2}  # the lamp's back
    below = lamp_and_lid().shadow(sun=(0, 0, -1))
    assert below.lit.tolist() == [] and below.away.tolist() == [0, 1]
    assert below.dark_areas == pytest.approx([0, 0, 4])
    in_the_plane = lamp_and_lid().shadow((9, 9, 0))
    assert 0 in in_the_plane.away and 0 in in_the_plane.dark


@pytest.mark.parametrize("family", ["city_rotated", "crossing_faces", "leaves", "coplanar_overlap"])
@pytest.mark.parametrize("asked", [{"light": (3, "1/3", 7)}, {"sun": (-1, 2, 3)}, {"light": (0, 0, 0)}])
def test_parts_add_up_to_faces(family, asked):
    scene = sightline.generate(family, size=8, seed=3).scene
    for two_sided in (False, True):
        shadow = scene.shadow(**asked, two_sided=two_sided)
        whole, found = by_face(scene.parts), by_face(shadow.parts)
        assert found and all(found[piece] == whole[piece] for piece in found)
        assert {face for face, _ in found}.isdisjoint(shadow.away.tolist())
        if "light" in asked:  # what the light reaches is what an eye there sees
            seen = scene.see(asked["light"], two_sided=two_sided)
            assert shadow.lit.tolist() == seen.visible.tolist()
            assert (shadow.lit_areas >= seen.areas - 1e-9).all()  # of faces at one place each is lit
            if family in ("city_rotated", "crossing_faces"):
                assert shadow.lit_areas == pytest.approx(seen.areas)


def test_the_program_says_the_same_of_shadows(tmp_path):
    file = corpus / "two_rooms.off"
    scene = sightline.read(file)
    for asked, options in (({"light": (1, 1, 2)}, ("--light", "1,1,2")), ({"sun": (1, 2, 5)}, ("--sun", "1,2,5"))):
        shadow, said = scene.shadow(**asked), by_program(tmp_path, "shadow", file, *options)
        assert shadow.lit.tolist() == said["lit_faces"] and shadow.dark.tolist() == said["dark_faces"]
        assert shadow.away.tolist() == said["lights"][0]["away"]
        lit = [part for part, by in zip(shadow.parts, shadow.by) if by < 0]
        dark = [part for part, by in zip(shadow.parts, shadow.by) if by >= 0]
        assert corners_of(lit) == [part["vertices"] for part in said["lit"]]
        assert corners_of(dark) == [part["vertices"] for part in said["dark"]]
        assert shadow.by[shadow.by >= 0].tolist() == [part["by"] for part in said["dark"]]
        assert {part.from_front for part in shadow.parts} == {True}


def test_the_space_in_shadow_by_hand():
    # The box is [-6, 6]^2 x [-2, 5]. At h from the light, the lid's shadow is 2 h wide, and so is that of the lamp,
    # above it; the floor's, from h = 2 on, is 4 h wide, up to the box, and holds what the lid's has below it.
    space = lamp_and_lid().shadow((0, 0, 2)).space()
    assert space.box == ((-6, -6, -2), (6, 6, 5)) and space.scene.info()["closed"]
    assert space.volume == Fraction(4, 3) * (8 - 1) + Fraction(4, 3) * (27 - 1) + Fraction(16, 3) * (27 - 8) + 144
    # From above, to the box's end: the floor's 8 x 8 x 2, and the lamp's 2 x 2 x 3 above it, which holds the lid's.
    assert lamp_and_lid().shadow(sun=(0, 0, 1)).space(threads=1).volume == 128 + 12


def test_points_of_the_space_in_shadow_see_no_light():
    scene = sightline.generate("city_rotated", size=6, seed=4).scene
    light = (3, "1/3", 7)
    cells = scene.shadow(light).space().scene.cells()
    dark = [cell.inside for cell in cells if cell.is_solid]
    bright = [cell.inside for cell in cells if not cell.is_solid and not cell.is_outside]
    assert cells.is_closed and len(dark) > 5 < len(bright)
    low, high = scene.shadow(light).space().box
    for points, are_dark in ((dark, True), (bright, False)):
        for point in points:
            if not all(low[k] < point[k] < high[k] for k in range(3)):
                continue
            to_light = [Fraction(x) - p for x, p in zip(light, point)]
            (hits,) = scene.trace([point], [to_light])
            assert (len(hits) > 0 and hits[0].t < 1) == are_dark


def test_what_is_no_light_is_refused():
    scene = lamp_and_lid()
    for asked in ({}, {"light": (0, 0, 1), "sun": (0, 0, 1)}):
        with pytest.raises(ValueError, match="give a light"):
            scene.shadow(**asked)
    with pytest.raises(ValueError, match="no direction"):
        scene.shadow(sun=(0, 0, 0))
    with pytest.raises(ValueError, match="sun wants three numbers"):
        scene.shadow(sun=(0, 1))
    with pytest.raises(TypeError, match="light"):
        scene.shadow((0, 0, None))
    with pytest.raises(sightline.OutOfBudget):
        sightline.generate("city_rotated", size=60).scene.shadow((3, 3, 9), budget=1e-9)
    assert sightline.Scene(np.zeros((0, 3)), np.zeros((0, 3), int)).shadow((0, 0, 0)).by.tolist() == []
