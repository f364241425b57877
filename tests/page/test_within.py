"""Scenes to turn around within the pages of judge and report."""

import json
import re
from fractions import Fraction

import pytest
from conftest import Page, run, unpacked
from selenium import webdriver
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait


@pytest.fixture(scope="module")
def blind(tmp_path_factory):
    """A program that sees face 0, always."""
    mine = tmp_path_factory.mktemp("programs") / "blind.sh"
    mine.write_text("echo 0 > $3\n")
    return f"sh {mine} {{scene}} {{query}} {{answer}}"


@pytest.fixture(scope="module")
def judgement(blind, tmp_path_factory):
    path = tmp_path_factory.mktemp("pages") / "judgement.html"
    run("judge", "--program", blind, "--query", "see", "--contract", "exact", "--families", "hinged,leaves", "--cases", 1, "--html", path, code=1)
    return path


@pytest.fixture(scope="module")
def whole_report(blind, tmp_path_factory):
    path = tmp_path_factory.mktemp("pages") / "report.html"
    run("report", "--questions", "see", "--families", "leaves", "--distances", 0, "--sizes", 0, "--cases", 1, "--quick", "--reduce", 10, "--program", f"see={blind}", "--html", path)
    return path


def opened_scene(browser, knob, data):
    """What is in the frame that a button opens by the key Enter; the browser is in it then."""
    knob.send_keys(Keys.ENTER)
    browser.switch_to.frame(browser.find_element("css selector", "iframe.scene"))
    WebDriverWait(browser, 10, 0.05).until(lambda b: b.execute_script("return document.documentElement.dataset.ready === 'yes' && sightline.frames > 0 && document.hasFocus()"))
    return Page.within(browser, data)


def take_no_time(browser):
    """Scenes are empty from now on."""
    browser.execute_script("document.getElementById('viewer').textContent = JSON.stringify('<canvas id=view></canvas>')")


def silent(browser):
    return [entry for entry in browser.get_log("browser") if entry["level"] in ("SEVERE", "WARNING") and "Performance" not in entry["message"]] == []


@pytest.mark.parametrize("of", ["judgement", "whole_report"])
def test_a_wrong_case_is_turned_around_within_its_page(browser, request, of):
    path = request.getfixturevalue(of)
    text = path.read_text()
    assert text.count('id="viewer"') == 1 and text.count("commands.see =") == 1, "the viewer's text is there once"
    assert not re.search("https?:", text.replace("http://www.w3.org/2000/svg", "")) and " src=" not in text  # that is a name, not a place
    assert len(text) < 500_000
    views = json.loads(re.search(r'id="views"[^>]*>(.*?)</script>', text, re.S)[1])
    silent(browser)
    browser.get(path.as_uri())
    frames = lambda: browser.find_elements("css selector", "iframe")
    knobs = browser.find_elements("css selector", ".card > button[data-view]")
    assert len(knobs) >= 2 and frames() == [], "made when it is asked for"
    pictures = browser.find_elements("css selector", ".card svg, .card img")
    assert pictures and all(browser.execute_async_script(
        "const [image, done] = arguments; if (image.tagName !== 'IMG') done(true); else image.decode().then(() => done(image.naturalWidth > 0), () => done(false))", one) for one in pictures), "pictures stay"

    # 1. By a key: the scene is drawn, what is wrong has a group and a colour of its own, and the eye and the line are there.
    wrong = next(i for i, knob in enumerate(knobs) if "missing but visible" in [g["name"] for g in views[int(knob.get_attribute("data-view"))]["groups"]])
    data = views[int(knobs[wrong].get_attribute("data-view"))]
    page = opened_scene(browser, knobs[wrong], data)
    share, colours = page.js("""
        sightline.draw();
        const view = document.getElementById('view'), gl = view.getContext('webgl2'), all = new Uint32Array(view.width * view.height), counts = new Map();
        gl.readPixels(0, 0, view.width, view.height, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(all.buffer));
        for (const pixel of all) counts.set(pixel, (counts.get(pixel) || 0) + 1);
        return [1 - counts.get(all[0]) / all.length, counts.size];
        """)
    assert share > 0.05 and colours > 8, "it is drawn"
    names = [group["name"] for group in data["groups"]]
    assert names[-1] == "right" and set(names) <= {"missing but visible", "shown but hidden", "in the way", "right"}
    groups, faces = page.numbers("polygons", "groups"), page.numbers("polygons", "faces")
    missing = [k for k, g in enumerate(groups) if names[g] == "missing but visible"]
    assert missing and page.js("return [...sightline.looks.slice(4 * arguments[0], 4 * arguments[0] + 3)].map((c, _, all) => c / Math.max(...all))", missing[0]) == pytest.approx([1, 94 / 213, 0], abs=0.02)
    assert f"face {faces[missing[0]]}: missing but visible" == page.js("sightline.select(arguments[0]); return document.getElementById('selected-name').textContent", missing[0])
    assert page.js("return [sightline.lines('eye'), sightline.lines('refutation')]") == [6, 16], "each within a halo"
    assert page.text("#why") == data["refutation"]["words"] and ["asked", "see"] in data["facts"]
    view = page.js("const v = document.getElementById('view'); return [v.clientWidth, v.clientHeight, document.activeElement === v]")
    assert view[2] and all(0 <= x <= most for p in [data["eye"]["place"]] for x, most in zip(page.js("return sightline.onCanvas(arguments[0])", p), view)), "the eye is in view"

    # 2. Escape within it closes it, and one goes on from the button.
    webdriver.ActionChains(browser).send_keys(Keys.ESCAPE).perform()
    browser.switch_to.default_content()
    assert frames() == [] and browser.switch_to.active_element == knobs[wrong]
    assert silent(browser)


def test_one_scene_is_open_at_a_time_and_its_button_closes_it(browser, judgement):
    browser.get(judgement.as_uri())
    take_no_time(browser)
    frames = lambda: browser.find_elements("css selector", "iframe")
    first, second = browser.find_elements("css selector", "button[data-view]")[:2]
    for knobs, open_ones in (([first], [first]), ([second], [second]), ([second], []), ([first, second], [second])):
        for knob in knobs:
            browser.execute_script("arguments[0].click()", knob)
        assert len(frames()) == len(open_ones)
        for knob in (first, second):
            assert (knob.text, knob.get_attribute("aria-expanded")) == (("close", "true") if knob in open_ones else ("turn it around", "false"))
    webdriver.ActionChains(browser).send_keys(Keys.ESCAPE).perform()
    assert frames() == []


def test_the_pair_that_an_order_has_wrong_is_shown(browser, tmp_path):
    scene, query, path = tmp_path / "three.off", tmp_path / "query.json", tmp_path / "page.html"
    scene.write_text("OFF\n9 3 0\n0 0 0\n4 0 0\n0 4 0\n0 0 1\n4 0 1\n0 4 1\n0 0 2\n1 0 2\n0 1 2\n3 0 1 2\n3 3 4 5\n3 6 7 8\n")
    query.write_text('{"query": "order", "eye": [0.5, 0.25, 5], "two_sided": false}')
    mine = tmp_path / "mine.sh"
    mine.write_text('printf "1\\n0\\n2\\n" > $3\n')
    run("judge", "--program", f"sh {mine} {{scene}} {{query}} {{answer}}", "--query", "order", "--contract", "exact", "--scenes", scene, "--ask", query, "--html", path, code=1)
    data = json.loads(re.search(r'id="views"[^>]*>(.*?)</script>', path.read_text(), re.S)[1])[0]
    names = [group["name"] for group in data["groups"]]
    assert {face: names[g] for face, g in zip(unpacked(data["polygons"]["faces"]), unpacked(data["polygons"]["groups"]))} == {
        1: "nearer, or missing", 0: "drawn over it", 2: "right"}


def test_a_line_is_dashed_beyond_what_it_meets(browser, tmp_path):
    scene, query, path = tmp_path / "two.off", tmp_path / "query.json", tmp_path / "page.html"
    scene.write_text("OFF\n8 2 0\n" + "".join(f"{x} {y} {z}\n" for z in (1, 0) for x, y in ((-1, -1), (-1, 1), (1, 1), (1, -1))) + "4 0 1 2 3\n4 4 5 6 7\n")
    query.write_text('{"query": "see", "eye": [0, 0, -0.5], "two_sided": false}')
    mine = tmp_path / "mine.sh"
    mine.write_text('printf "0\\n1\\n" > $3\n')
    run("judge", "--program", f"sh {mine} {{scene}} {{query}} {{answer}}", "--query", "see", "--contract", "exact", "--scenes", scene, "--ask", query, "--html", path, code=1)
    views, viewer = (json.loads(re.search(rf'id="{name}"[^>]*>(.*?)</script>', path.read_text(), re.S)[1]) for name in ("views", "viewer"))
    alone = tmp_path / "alone.html"
    alone.write_text(viewer.replace("<!--data-->", json.dumps(views[0])))
    page = Page(browser, alone)
    lines = page.js("return sightline.linesOf('refutation').slice(0, 2).map(line => [line.from, line.to, line.dash > 0])")
    place = lambda z: pytest.approx([0, 0, (z - page.data["frame"]["middle"][2]) / page.data["frame"]["size"]])
    assert lines == [[place(-0.5), place(0), False], [place(0), place(1), True]]
    assert page.js("return sightline.camera.pitch") < -0.1, "faces look down: one sees them from below"
    page.close()


def test_of_too_many_faces_those_that_are_wrong_and_the_source_stay(tmp_path):
    """Twelve polygons of 302 corners, whose backs are to a small source, and a small triangle, the only face that it sees."""
    scene, query, path = tmp_path / "squares.off", tmp_path / "query.json", tmp_path / "page.html"
    points = [f"{x} {x * x} {-z}" for z in range(12) for x in range(302)] + ["20 20 1", "20.1 20 1", "20 20.1 1"]
    faces = ["302 " + " ".join(str(302 * z + x) for x in reversed(range(302))) for z in range(12)] + ["3 3624 3625 3626"]
    scene.write_text("\n".join([f"OFF {len(points)} {len(faces)} 0", *points, *faces]) + "\n")
    query.write_text('{"query": "weak", "source": [["20", "20", "3"], ["20", "201/10", "3"], ["201/10", "20", "3"]], "two_sided": false}')
    mine = tmp_path / "mine.sh"
    mine.write_text("echo '{\"visible\": []}' > $3\n")
    run("judge", "--program", f"sh {mine} {{scene}} {{query}} {{answer}}", "--query", "weak", "--contract", "exact", "--scenes", scene, "--ask", query, "--html", path, code=1)
    data = json.loads(re.search(r'id="views"[^>]*>(.*?)</script>', path.read_text(), re.S)[1])[0]
    polygons, names = data["polygons"], [group["name"] for group in data["groups"]]
    groups, sizes, numbers, corners = (unpacked(polygons[key]) for key in ("groups", "sizes", "numbers", "corners"))
    assert polygons["of"] == 14 and sizes == [302] * 9 + [3, 3], "of at most 3,000 triangles"
    assert [names[g] for g in groups[-2:]] == ["missing but visible", "source"] and numbers[-2:] == [12, 13]
    # What is said of corners is theirs.
    texts, of = polygons["exact"]["texts"], unpacked(polygons["exact"]["corners"])
    middle, size = data["frame"]["middle"], data["frame"]["size"]
    assert len(of) == sum(sizes) and all(float(Fraction(text)) == pytest.approx(m + size * x, abs=1e-4) for i, n in enumerate(of) if i % 7 == 3
                                         for text, m, x in zip(texts[n].split(", "), middle, corners[3 * i:3 * i + 3]))


@pytest.mark.parametrize("of", ["judgement", "whole_report"])
def test_no_page_runs_out_of_its_window(browser, request, of):
    path = request.getfixturevalue(of)
    try:
        for width in (390, 1100):
            browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": 800, "deviceScaleFactor": 1, "mobile": width < 500})
            browser.get(path.as_uri())
            take_no_time(browser)
            knob = browser.find_element("css selector", "button[data-view]")
            for act in ("", "arguments[0].click()") if width < 500 else ("",):
                browser.execute_script(act, knob)
                across = browser.execute_script("return [document.documentElement.scrollWidth, innerWidth]")
                assert across[0] <= across[1] == width, (width, act)
            left = browser.execute_script("return Math.min(...[...document.querySelectorAll('h1, h2, p, .card, table')].map(e => e.getBoundingClientRect().left))")
            assert left >= 12
    finally:
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_a_judgement_is_dark_where_the_browser_is(browser, judgement):
    light = lambda colour: sum(map(int, re.findall(r"\d+", colour)[:3]))
    try:
        for scheme, is_dark in (("light", False), ("dark", True)):
            browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})
            browser.get(judgement.as_uri())
            for selector in ("body", "th", "code", ".card", ".verdict", "button"):
                paper, ink = browser.execute_script("const s = getComputedStyle(document.querySelector(arguments[0])); return [s.backgroundColor, s.color]", selector)
                assert (light(paper) < light(ink)) == is_dark, (scheme, selector, paper, ink)
    finally:
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
