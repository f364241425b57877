"""What hands, keys and buttons do to a page, and what all pages have."""

import math
import re

import pytest
from conftest import corpus

cube = corpus / "general" / "cube.off"
rooms = corpus / "general" / "two_rooms.off"
camera = "const c = sightline.camera; return [c.yaw, c.pitch, c.distance, c.field, ...c.target, c.atEye]"


def corners_of(page):
    numbers = page.numbers("polygons", "corners")
    return [numbers[i:i + 3] for i in range(0, len(numbers), 3)]


def pixel_of(page, x, y):
    """Of the scene as it is drawn."""
    return page.js(
        """
        sightline.draw();
        const view = document.getElementById('view'), gl = view.getContext('webgl2'), scale = view.width / view.clientWidth, pixel = new Uint8Array(4);
        gl.readPixels(Math.round(arguments[0] * scale), view.height - 1 - Math.round(arguments[1] * scale), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        return [...pixel.slice(0, 3)];
        """, x, y)


@pytest.mark.parametrize("words", [["graph"], ["order", "--eye=3,4,5"]])
def test_what_is_under_the_hand_follows_it(open_page, words):
    page = open_page(words[0], cube, *words[1:])
    at_eye = page.js("return sightline.camera.atEye")
    assert at_eye == (len(words) > 1)
    place = min(corners_of(page), key=lambda p: math.dist(page.js("return sightline.onCanvas(arguments[0])", p), (350, 350)))
    where = lambda: page.js("return sightline.onCanvas(arguments[0])", place)
    if not at_eye:  # what is nearest goes where the hand goes
        place = max(corners_of(page), key=lambda p: sum(a * b for a, b in zip(p, (-0.6, -1.1, 0.7))))

    def moved(act):
        before = where()
        act()
        return [b - a for a, b in zip(before, where())]

    assert all(0.5 * by < to < (1.6 if at_eye else 3) * by for by, to in zip((40, 30), moved(lambda: page.drag((300, 300), (40, 30)))))
    aside = moved(lambda: page.drag((300, 300), (30, -20), modifiers=8))
    assert aside[0] > 5 and aside[1] < -2
    if not at_eye:
        page.press("Home")
        place = page.js("return sightline.camera.target")
        assert moved(lambda: page.drag((300, 300), (60, 40), modifiers=8)) == pytest.approx([60, 40], abs=0.1)
        assert moved(lambda: page.drag((300, 300), (60, 40), button="right", buttons=2)) == pytest.approx([60, 40], abs=0.1)
    near = (lambda: 1 / page.js("return sightline.camera.field")) if at_eye else (lambda: 1 / page.js("return sightline.camera.distance"))
    for closer, farther in ((lambda: page.press("+"), lambda: page.press("-")),
                            (lambda: page.mouse("mouseWheel", 300, 300, deltaX=0, deltaY=-100), lambda: page.mouse("mouseWheel", 300, 300, deltaX=0, deltaY=100))):
        page.press("Home")
        begun = near()
        closer()
        assert near() > 1.1 * begun
        farther()
        assert near() == pytest.approx(begun)
    for there, back, k in (("ArrowLeft", "ArrowRight", 0), ("ArrowUp", "ArrowDown", 1)):
        begun = page.js(camera)
        page.press(there)
        # Round the scene the one who looks goes to the left and up; from the eye the look turns to the left and, as the scene goes, down.
        assert (page.js(camera)[k] > begun[k]) == (k == 1 or at_eye)
        page.press(back)
        assert page.js(camera) == pytest.approx(begun)


def test_nobody_goes_over_the_top_nor_out_of_sight(open_page):
    page = open_page("graph", cube)
    for key in ("ArrowUp", "ArrowDown", "-", "+"):
        press = "for (let i = 0; i < 150; ++i) document.dispatchEvent(new KeyboardEvent('keydown', {key: arguments[0], bubbles: true}))"
        page.js(press, key)
        at_end = page.js(camera)
        page.js(press, key)
        assert page.js(camera) == at_end and abs(at_end[1]) < math.pi / 2, key
        if key != "+":
            assert page.js("const v = document.getElementById('view'); return sightline.pickAt(v.clientWidth / 2, v.clientHeight / 2)") >= 0, "the scene is in the middle"


def test_a_rod_along_the_look_is_looked_at_from_outside(open_page, tmp_path):
    """Fifty times as long as it is wide, and seen from its end at first."""
    away = [x / math.sqrt(0.36 + 1.21 + 0.49) for x in (-0.6, -1.1, 0.7)]
    right = [away[1] / math.hypot(*away[:2]), -away[0] / math.hypot(*away[:2]), 0.0]
    up = [right[(k + 1) % 3] * away[(k + 2) % 3] - right[(k + 2) % 3] * away[(k + 1) % 3] for k in range(3)]
    rod = tmp_path / "rod.obj"
    rod.write_text("".join("v " + " ".join(f"{s * away[k] + a * right[k] + b * up[k]:.4f}" for k in range(3)) + "\n"
                           for s in (-50, 50) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
                   + "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")
    page = open_page("graph", rod)
    places = page.js("return arguments[0].map(sightline.onCanvas)", corners_of(page))
    width, height = page.js("const v = document.getElementById('view'); return [v.clientWidth, v.clientHeight]")
    assert all(at and 0 < at[0] < width and 0 < at[1] < height for at in places)


@pytest.mark.parametrize("height", ["1/4", "3/4"])
def test_an_eye_straight_below_or_above_the_middle_does_not_look_over_the_top(open_page, height):
    page = open_page("see", cube, "--eye=1/2,1/2," + height)
    before = page.js(camera)
    page.press("ArrowLeft")
    after = page.js(camera)
    assert abs(before[1]) > 1.5 and before[1] == after[1], "to turn aside is not to turn upside down"


def test_a_closed_room_fills_the_view_of_who_looks_along_an_axis(open_page, tmp_path):
    """Its squares have corners in the plane of the eye across that axis, which renderers may take for ones behind it."""
    grid = [[0, 1, 2, 3, 4, 4.2, 5, 6, 7, 8.2], range(3), range(5)]
    points, faces = [], []
    for k in range(3):
        x, y = (k + 1) % 3, (k + 2) % 3
        for side, a, b in ((s, a, b) for s in (0, -1) for a in range(len(grid[x]) - 1) for b in range(len(grid[y]) - 1)):
            loop = [{k: grid[k][side], x: grid[x][a + i], y: grid[y][b + j]} for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
            faces.append(range(len(points), len(points) + 4))
            points += loop if side == 0 else loop[::-1]
    room = tmp_path / "room.off"
    room.write_text(f"OFF\n{len(points)} {len(faces)} 0\n" + "".join(f"{p[0]} {p[1]} {p[2]}\n" for p in points) + "".join(f"4 {' '.join(map(str, f))}\n" for f in faces))
    page = open_page("see", room, "--eye", "1,1,2")
    assert page.picture()[0] == 1, "no paper is seen"


def test_keys_go_on_from_where_a_button_was(open_page, browser):
    from selenium.webdriver.common.keys import Keys

    page = open_page("graph", corpus / "general" / "cyclic_bars.off" if (corpus / "general" / "cyclic_bars.off").exists() else rooms)
    page.js("sightline.select(0)")
    page.one("#arcs ul.list button").send_keys(Keys.ENTER)
    assert page.js("return document.activeElement.id") == "selection" and page.js("return sightline.selected") != 0
    browser.switch_to.active_element.send_keys(Keys.TAB)
    assert page.js("return document.getElementById('selection').contains(document.activeElement) && document.activeElement.tagName") == "BUTTON"
    page.js("sightline.select(-1)")
    assert page.js("return document.activeElement.id") in ("selection", ""), "what is clicked elsewhere takes no focus"


def test_a_trembling_hand_clicks_and_the_right_one_does_not(open_page):
    page = open_page("graph", cube)
    begun = page.js(camera)
    page.drag((380, 380), (1, 1), button="right", buttons=2)
    assert page.js("return sightline.selected") == -1
    page.drag((380, 380), (1, 1))
    assert page.js("return sightline.selected") >= 0 and page.js(camera) == begun
    page.drag((380, 380), (0, 60))
    page.js("sightline.select(-1)")
    page.drag((380, 380), (0, 60))
    assert page.js("return sightline.selected") == -1


def test_two_fingers_pinch_by_what_they_spread_and_move_aside(open_page, browser):
    page = open_page("graph", cube)

    def touch(kind, *points):
        browser.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": 300, "id": i} for i, x in enumerate(points)]})

    begun = page.js(camera)
    touch("touchStart", 300), touch("touchStart", 300, 400), touch("touchMove", 250, 450), touch("touchMove", 200, 500), touch("touchEnd")
    assert page.js("return sightline.camera.distance") == pytest.approx(begun[2] / 3, rel=0.02)
    target = page.js("return sightline.camera.target")
    before = page.js("return sightline.onCanvas(arguments[0])", target)
    touch("touchStart", 300), touch("touchStart", 300, 400), touch("touchMove", 330, 430), touch("touchMove", 360, 460), touch("touchEnd")
    after = page.js("return sightline.onCanvas(arguments[0])", target)
    assert 40 < after[0] - before[0] < 80 and page.js("return sightline.camera.yaw") == begun[0]
    assert page.js("return getComputedStyle(document.getElementById('view')).touchAction") == "none"


def test_a_name_is_under_the_hand_while_it_is_there(open_page, town):
    page = open_page("see", town, "--eye=-3.5,-5,5")
    name = lambda: (page.drawn(), page.text("#hover"))[1]
    assert name() == "" and not page.one("#hover").is_displayed() and page.one("#hover").get_attribute("aria-live") == "off"
    k = page.js("return sightline.pickAt(350, 400)")
    page.js("sightline.select(arguments[0])", k)
    wanted = page.text("#selected-name")
    page.js("sightline.select(-1)")
    page.mouse("mouseMoved", 350, 400)
    assert name() == wanted and ": visible" in wanted and page.one("#hover").is_displayed()
    assert page.js("const box = document.getElementById('hover').getBoundingClientRect(); return document.elementFromPoint(box.left + 5, box.top + 5).id") == "view"
    page.mouse("mouseMoved", 1000, 700)
    assert name() == ""
    box = page.js("document.getElementById('sphere').scrollIntoView(); const box = document.getElementById('sphere').getBoundingClientRect(); return [box.left, box.top, box.width, box.height]")
    x, y, z = page.data["eye"]["place"]  # the middle of the scene is 0, 0, 0
    page.mouse("mouseMoved", box[0] + 0.5 * box[2], box[1] + (0.5 + math.atan2(z, math.hypot(x, y)) / math.pi) * box[3])
    assert name().startswith("face ") and ": visible" in name()
    page.mouse("mouseMoved", 1000, 5)
    assert name() == ""


def test_buttons_say_whether_they_are_pressed(open_page):
    page = open_page("order", cube, "--eye=3,4,5")
    state = lambda: {b.text: b.get_attribute("aria-pressed") for b in page.all("#tools button")}
    of = lambda: page.js("return [sightline.camera.atEye, sightline.drawing.outlines, sightline.drawing.backs]")
    words = {"e": "From the eye", "o": "Edges", "b": "Backs"}
    begun = of()
    assert begun == [True, True, True] and state() == {"From the eye": "true", "Home": None, "Edges": "true", "Backs": "true"}
    for i, (key, name) in enumerate(words.items()):
        for after in (False, True):
            page.press(key) if after else next(b for b in page.all("#tools button") if b.text == name).click()
            assert of() == [after if j == i else on for j, on in enumerate(begun)] and state()[name] == str(after).lower()
    page.press("e"), page.press("Home")
    assert state()["From the eye"] == "true" and of() == begun


def test_a_canvas_that_is_measured_late_does_not_take_back_what_a_key_did(open_page, browser):
    measured = "const Observer = ResizeObserver; ResizeObserver = class { constructor(done) { this.done = done; }" \
               " observe(canvas) { new Observer(() => { window.measure = this.done; }).observe(canvas); } }; requestAnimationFrame = () => {};"
    script = browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": measured})
    try:
        page = open_page("order", cube, "--eye=3,4,5")
        begun = page.js(camera)
        page.press("ArrowUp")
        turned = page.js(camera)
        page.browser.execute_async_script("const done = arguments[0], ask = () => window.measure ? done() : setTimeout(ask, 5); ask()")
        page.js("window.measure()")
        assert page.js(camera) == turned != begun
        page.press("Home")
        assert page.js(camera) == begun
    finally:
        browser.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", {"identifier": script["identifier"]})


def test_keys_are_left_to_fields_buttons_and_the_browser(open_page, browser):
    page = open_page("order", cube, "--eye=3,4,5")

    def press(selector, key, **more):
        page.js("document.querySelector(arguments[0]).focus();"
                "document.activeElement.dispatchEvent(new KeyboardEvent('keydown', {key: arguments[1], bubbles: true, ...arguments[2]}))", selector, key, more)

    page.slide(2)
    page.press("ArrowUp")
    begun = page.js(camera)
    for of, key, more in (("#slider", "ArrowLeft", {}), ("#slider", "Home", {}), ("#view", "ArrowLeft", {"ctrlKey": True}), ("#view", "+", {"metaKey": True}),
                          ("#view", "Home", {"altKey": True})):
        press(of, key, **more)
        assert page.js(camera) == begun, key
    assert page.text("#slider-value") == "2 of 6"
    press("#tools button", " ")
    assert page.text("#play") == "Play"
    press("#slider", "o"), press("#slider", "]")  # a slider uses neither
    assert page.js("return sightline.drawing.outlines") is False and page.text("#slider-value") == "3 of 6"
    press("#slider", " ")
    assert page.text("#play") == "Pause"
    press("#slider", " ")
    assert page.text("#play") == "Play"


def test_a_player_stops_goes_on_and_begins_anew(open_page):
    page = open_page("order", cube, "--eye=3,4,5")
    value = lambda: int(page.text("#slider-value").split()[0])
    until = lambda text: page.browser.execute_async_script("const done = arguments[0], ask = () => " + text + " ? done() : requestAnimationFrame(ask); ask()")
    wait = lambda milliseconds: page.js("return new Promise(done => setTimeout(done, arguments[0]))", milliseconds)
    assert value() == 6 == page.data["polygons"]["count"]
    page.press(" ")
    assert page.text("#play") == "Pause"
    until("parseInt(document.getElementById('slider-value').textContent) < 6")  # from its end it begins anew
    page.press(" ")
    before = value()
    assert page.text("#play") == "Play"
    wait(700)
    assert value() == before
    page.slide(5)
    assert page.js("return sightline.linesOf('last').length") == 8, "the last painted is outlined, twice four sides"
    last, corners = page.js("return sightline.linesOf('last').map(line => line.from)"), corners_of(page)
    assert all(any(math.dist(p, q) < 1e-6 for q in corners[16:20]) for p in last)
    page.js("sightline.select(4)")
    assert page.text("#selected-name").endswith(", polygon 5 of 6 from the back")
    page.press("["), page.press("[")
    assert value() == 3
    back, on = page.all("#panel .row button")[1:3]
    on.click(), on.click(), back.click()
    assert value() == 4 and (back.accessible_name, on.accessible_name) == ("a step back", "a step on")
    page.one("#play").click()
    page.slide(2)
    assert page.text("#play") == "Play", "a hand on the slider stops it"
    page.js("""
        const ask = window.requestAnimationFrame, steps = [];
        window.requestAnimationFrame = step => steps.push(step);
        document.getElementById('play').click();
        window.requestAnimationFrame = ask;
        steps[0](performance.now() - 1000);  // stamped before it began
        """)
    assert value() == 2
    page.slide(5)
    page.press(" ")
    until("document.getElementById('play').textContent === 'Play'")  # at its end
    assert value() == 6


@pytest.mark.parametrize("words", [["order", "--eye=3,4,5"], ["graph"], ["order", "--eye=300,-400,500"], ["order", "--eye=3e40,-4e40,5e40"]])
def test_the_scene_fills_the_canvas(open_page, words):
    page = open_page(words[0], cube, *words[1:])
    assert page.js("return sightline.camera.atEye") == (words[0] == "order")
    places = page.js("return arguments[0].map(sightline.onCanvas)", corners_of(page))
    size = page.js("const v = document.getElementById('view'); return [v.clientWidth, v.clientHeight]")
    spans = [[min(p[k] for p in places), max(p[k] for p in places)] for k in (0, 1)]
    assert all(0 < low and high < of for (low, high), of in zip(spans, size))
    assert 0.75 < max((high - low) / of for (low, high), of in zip(spans, size)) < 0.96
    assert all(abs(low + high - of) < 0.1 * of for (low, high), of in zip(spans, size)), "in the middle"
    # No corner is cut off: what is drawn spans as much.
    assert all(page.js("return sightline.pickAt(arguments[0], arguments[1])", *(0.98 * (c - m / 2) + m / 2 for c, m in zip(p, size))) >= 0
               for p in places if p[0] in spans[0] or p[1] in spans[1])
    if words[0] == "graph":  # from the right, before and above
        top, bottom = (page.js("return sightline.onCanvas(arguments[0])", p)[1] for p in ([0, 0, 0.25], [0, 0, -0.25]))
        left, right = (page.js("return sightline.onCanvas(arguments[0])", p)[0] for p in ([-0.25, 0, 0], [0.25, 0, 0]))
        assert top < bottom and left < right
        assert page.js("sightline.drawing.to = 6; return sightline.pickAt(arguments[0], arguments[1])", *[s / 2 for s in size]) >= 0


def test_light_comes_from_above(open_page):
    def change(data):
        data["command"] = "another"  # that adds nothing

    page = open_page("graph", cube, change=change)
    corners = corners_of(page)
    light = {}
    for k in range(6):
        own = corners[4 * k:4 * k + 4]
        side = next((a, own[0][a] > 0) for a in range(3) if len({p[a] for p in own}) == 1)
        light[side] = sum(page.js("return [...sightline.looks.slice(4 * arguments[0], 4 * arguments[0] + 3)]", k))
    assert max(light, key=light.get) == (2, True) and min(light, key=light.get) == (2, False)
    assert len(set(light.values())) == 6


def test_what_is_selected_is_outlined_and_where_it_was_clicked_is_said(open_page):
    page = open_page("graph", cube)
    k = page.js("return sightline.pickAt(380, 380)")
    page.click_on(k)
    own = corners_of(page)[4 * k:4 * k + 4]
    middle = [sum(c) / 4 * page.data["frame"]["size"] + m for c, m in zip(zip(*own), page.data["frame"]["middle"])]
    said = page.one("#selection").text.split("clicked near ")[1]
    assert [float(x) for x in said.split(", ")] == pytest.approx(middle, abs=0.01)
    assert "Corners, exactly:" in page.one("#selection").text
    lines = page.js("return sightline.linesOf('selection').map(line => [line.from, line.to])")
    sides = [[own[i], own[(i + 1) % 4]] for i in range(4)]
    assert lines == sides + sides, "dark within light"
    assert page.js("sightline.select(-1); return sightline.lines('selection')") == 0


def test_a_legend_says_how_many_and_leaves_each_group_out(open_page):
    page = open_page("weak", rooms, "--from-face", 0)
    groups = page.numbers("polygons", "groups")
    rows = page.all(".legend label")
    counts = [groups.count(i) for i in range(len(page.data["groups"]))]
    assert [row.text.split("\n") for row in rows] == [[group["name"], str(n)] for group, n in zip(page.data["groups"], counts)]
    colours = {"seen": "rgb(230, 159, 0)", "hidden": "rgb(150, 151, 156)", "open": "rgb(204, 121, 167)", "source": "rgb(0, 114, 178)"}
    assert page.js("return [...document.querySelectorAll('.legend .swatch')].map(s => getComputedStyle(s).backgroundColor)") == [
        colours[group["role"]] for group in page.data["groups"]]
    shown = lambda: page.js("return [...sightline.looks].filter((_, i) => i % 4 === 3)")
    for i, row in enumerate(rows):
        row.click()
        assert shown() == [0 if g == i else 255 for g in groups]
        row.click()
    assert set(shown()) == {255}


def test_a_page_says_its_facts_notes_and_title(open_page):
    def change(data):
        data["notes"] = ["Many were left out.", "All is rounded."]
        del data["polygons"]["exact"]
        data["scene"] = "a folder/of/cube.off"
        data["frame"] = {"middle": [4500000.3, -5800000.3, 0.5], "size": 2}

    page = open_page("order", cube, "--eye=3,4,5", change=change)
    assert page.browser.title == page.text("h1") == "order: cube.off"
    assert [[cell.text for cell in row.find_elements("css selector", "th, td")] for row in page.all("#panel > table tr")] == page.data["facts"]
    assert page.texts("#panel > .note") == page.data["notes"]
    assert not page.one("#trouble").is_displayed()
    page.js("sightline.select(0)")
    assert "Corners, rounded:" in page.one("#selection").text
    said = [[float(x) for x in item.text.split(", ")] for item in page.all("#selection .exact li")]
    frame = page.data["frame"]
    assert said == [pytest.approx([m + frame["size"] * x for x, m in zip(p, frame["middle"])], abs=1e-6, rel=0) for p in corners_of(page)[:4]], "seven digits of the scene's size"


def test_corners_beyond_two_hundred_are_counted(open_page, tmp_path):
    scene = tmp_path / "round.off"
    n = 230
    scene.write_text(f"OFF {n} 1 0\n" + "\n".join(f"{1000 * x} {x * x} 0" for x in range(n)) + f"\n{n} " + " ".join(map(str, range(n))) + "\n")
    page = open_page("graph", scene)
    page.js("sightline.select(0)")
    said = page.js("return [...document.querySelectorAll('#selection .exact li')].map(item => item.textContent)")
    assert len(said) == 201 and said[-1] == "and 30 more" and "0, 0, 0" in said


def test_dark_where_the_browser_is(open_page, browser):
    page = open_page("see", cube, "--eye=3,4,5")
    state = lambda: (page.drawn(), page.js("return getComputedStyle(document.body).backgroundColor"),
                     page.js("return getComputedStyle(document.getElementById('panel')).backgroundColor"), pixel_of(page, 2, 300))[1:]
    lines = lambda: page.js("const c = document.createElement('canvas'), pen = c.getContext('2d'); c.width = 1024, c.height = 512;"
                            "pen.drawImage(document.getElementById('sphere'), 0, 0); return [...pen.getImageData(425, 100, 5, 1).data]")
    light, frames = state(), page.js("return sightline.frames")
    drawn = lines()
    try:
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
        dark = state()
        assert light == ("rgb(246, 245, 241)", "rgb(255, 255, 255)", [246, 245, 241]) and dark == ("rgb(23, 24, 27)", "rgb(32, 34, 38)", [23, 24, 27])
        assert page.js("return sightline.frames") > frames + 1 and lines() != drawn
    finally:
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})


def test_a_window_of_another_size_is_drawn_anew(open_page, browser):
    page = open_page("graph", cube)
    page.drawn()
    size = browser.get_window_size()
    try:
        for width, height in ((900, 600), (520, 700)):
            browser.set_window_size(width, height)
            page.drawn()
            view = page.js("const v = document.getElementById('view'); return [v.width, v.height, v.clientWidth * devicePixelRatio, v.clientHeight * devicePixelRatio]")
            assert view[:2] == view[2:] and min(view) > 100
        box = page.js("const a = document.getElementById('panel').getBoundingClientRect(), b = document.getElementById('stage').getBoundingClientRect();"
                      "return [a.top - b.bottom, a.width - b.width]")
        assert box == [0, 0], "on a narrow screen the panel is below"
        assert page.js("const box = document.getElementById('panel'); return box.scrollWidth <= box.clientWidth") and re.search("[a-z]", page.text("h1"))
    finally:
        browser.set_window_size(size["width"], size["height"])
