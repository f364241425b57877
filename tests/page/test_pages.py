"""Pages in a browser: what they show, and what becomes of clicks, keys and sliders."""

import json

import pytest
from conftest import block_of, run

eye = "--eye=-3.5,-5,5"


def test_an_order_is_painted_by_a_slider(open_page, town):
    page = open_page("order", town, eye)
    count = page.data["polygons"]["count"]
    assert page.is_drawn()
    whole = page.picture()[0]
    page.slide(3)
    assert page.text("#slider-value") == f"3 of {count}"
    assert page.js("return sightline.drawing.to") == 3
    assert 0 < page.picture()[0] < whole
    page.press("]")
    assert page.text("#slider-value") == f"4 of {count}"
    page.slide(0)
    assert page.picture()[1] < 8, "nothing is painted"


def test_a_click_says_which_face_and_where_exactly(open_page, town):
    page = open_page("order", town, eye)
    last = page.data["polygons"]["count"] - 1  # nothing is painted over it
    page.click_on(last)
    assert page.js("return sightline.selected") == last
    fragments = json.loads(run("order", town, eye, "--json", "-"))["result"]["fragments"]
    assert page.text("#selected-name").startswith(f"face {fragments[last]['face']}, ")
    corners = [item.text for item in page.all("#selection .exact li")]
    assert corners == [", ".join(vertex) for vertex in fragments[last]["vertices"]]


def test_keys_and_buttons_move_the_one_who_looks(open_page, town):
    page = open_page("order", town, eye)
    before = page.js("return [sightline.camera.yaw, sightline.camera.field]")
    page.press("ArrowLeft"), page.press("+")
    assert page.js("return [sightline.camera.yaw, sightline.camera.field]") != before
    page.press("Home")
    assert page.js("return [sightline.camera.yaw, sightline.camera.field]") == before
    page.press("e")
    assert page.js("return sightline.camera.atEye") is False
    assert page.is_drawn()
