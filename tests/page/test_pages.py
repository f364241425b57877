"""Pages in a browser: what they show, and what becomes of clicks, keys and sliders."""

import base64
import json
import math
import re
from fractions import Fraction
from pathlib import Path

import pytest
from conftest import block_of, corpus, packed, program, run, unpacked

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
    fragments = json.loads(run("order", town, eye, "--json", "-"))["result"]["fragments"]
    assert page.text("#painted") == f"painted last: face {fragments[2]['face']}"
    page.press("]")
    assert page.text("#slider-value") == f"4 of {count}"
    page.slide(0)
    assert page.picture()[1] < 8 and page.text("#painted") == "nothing is painted yet"


def test_what_is_skipped_is_not_painted_and_not_missed(open_page, town):
    """Of an order without what is hidden: fewer polygons, those that are seen, and the same faces in the picture."""
    def of(*words):
        page = open_page("order", town, eye, *words, name=f"{len(words)}.html")
        fragments = json.loads(run("order", town, eye, *words, "--json", "-"))["result"]["fragments"]
        return page, [fragment["face"] for fragment in fragments][::-1 if words else 1]  # painted: farthest first

    def met(page, faces):
        places = page.js("""
            const met = [];
            for (let x = 10; x < 700; x += 23) for (let y = 10; y < 700; y += 19) met.push(sightline.pickAt(x, y));
            return met;
            """)
        return [faces[k] if k >= 0 else None for k in places]

    whole, all_of_them = of()
    wanted = met(whole, all_of_them)
    page, faces = of("--front-to-back", "--skip-hidden")
    assert page.data["polygons"]["count"] == len(faces) < len(all_of_them)
    assert f"{len(faces)} that are seen" in page.text("body")
    assert page.is_drawn() and met(page, faces) == wanted and len(set(wanted)) > 20
    seen = json.loads(run("see", town, eye, "--two-sided", "--json", "-"))["result"]
    assert sorted(set(faces)) == seen["visible"]
    for k in (1, len(faces) // 2, len(faces)):
        page.slide(k)
        assert page.text("#painted") == f"painted last: face {faces[k - 1]}"


def test_a_click_says_which_face_and_where_exactly(open_page, town):
    page = open_page("order", town, eye)
    last = page.data["polygons"]["count"] - 1  # nothing is painted over it
    page.click_on(last)
    assert page.js("return sightline.selected") == last
    fragments = json.loads(run("order", town, eye, "--json", "-"))["result"]["fragments"]
    assert page.text("#selected-name").startswith(f"face {fragments[last]['face']}, ")
    corners = page.texts("#selection .exact li")
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


def group_of(page, k):
    groups = page.js("const p = JSON.parse(document.getElementById('data').textContent).polygons.groups; return p ? atob(p.base64).charCodeAt(arguments[0]) : 0", k)
    return page.data["groups"][groups]["name"]


def first_seen(page, wanted):
    """A polygon that the program says is so, and that a click in its middle meets."""
    return page.js(
        """
        const from = JSON.parse(document.getElementById('data').textContent), groups = from.polygons.groups ? atob(from.polygons.groups.base64) : null;
        for (let k = 0; k < from.polygons.count; ++k) {
          if (groups && arguments[0] !== null && from.groups[groups.charCodeAt(k)].name !== arguments[0]) continue;
          const at = sightline.middleOf(k);
          if (at && sightline.pickAt(...at) === k) return k;
        }
        return -1;
        """, wanted)


def test_a_graph_shows_cycles_and_the_arcs_of_a_face(open_page):
    scene = corpus / "general" / "three_bars.off"
    page = open_page("graph", scene)
    assert page.is_drawn()
    assert page.texts("section ul.list button") == ["component 1: 3 faces"]
    k = first_seen(page, None)
    page.click_on(k)
    assert page.js("return sightline.selected") == k
    arcs = json.loads(run("graph", scene, "--arcs", "--json", "-"))["result"]["arc_list"]
    in_front = sorted(f"face {a[0][0]}" for a in arcs if a[1] == [k, 0])
    behind = sorted(f"face {a[1][0]}" for a in arcs if a[0] == [k, 0])
    lists = page.all("#arcs ul.list")
    assert [sorted(item.text for item in one.find_elements("css selector", "button")) for one in lists] == [in_front, behind]


def looks_of(page, k):
    return page.js("return [...sightline.looks.slice(4 * arguments[0], 4 * arguments[0] + 3)]", k)


def test_colours_of_a_graph_are_its_cycles_or_its_priorities(open_page, tmp_path):
    scene = tmp_path / "bars.off"
    # Three bars in a cycle, and two squares, one far before them and one far behind.
    lines = (corpus / "general" / "three_bars.off").read_text().split("\n", 1)
    body = [line for line in lines[1].splitlines() if line.strip() and not line.startswith("#")]
    points, faces = map(int, body[0].split()[:2])
    corners, loops = body[1:1 + points], body[1 + points:1 + points + faces]
    for z in (-50, 50):
        loops.append(f"4 {len(corners)} {len(corners) + 1} {len(corners) + 2} {len(corners) + 3}")
        corners += [f"{x} {y} {z}" for x, y in ((-9, -9), (9, -9), (9, 9), (-9, 9))]
    scene.write_text(f"OFF\n{len(corners)} {len(loops)} 0\n" + "\n".join(corners + loops) + "\n")
    components = [[face for face, _ in one] for one in json.loads(run("graph", scene, "--json", "-"))["result"]["components"]]
    page = open_page("graph", scene)
    cycle = next(one for one in components if len(one) > 1)
    alone = [one[0] for one in components if len(one) == 1]
    assert len(cycle) == 3 and len(alone) == faces - 1
    spread = lambda face: max(looks_of(page, face)) - min(looks_of(page, face))
    assert all(spread(face) > 60 for face in cycle) and all(spread(face) < 40 for face in alone), "what is in no cycle is grey"
    # Chosen and no more: its outlines are drawn, or not.
    before = page.js("return sightline.lines('cycle')")
    page.all("section ul.list button")[0].click()
    assert before == 0 and page.js("return sightline.lines('cycle')") > 0
    page.all("section ul.list button")[0].click()
    assert page.js("return sightline.lines('cycle')") == 0
    # By priority: from dark blue to yellow.
    next(b for b in page.all("#panel button") if b.text == "Priority").click()
    green = [looks_of(page, one[0])[1] for one in components]
    assert green == sorted(green) and green[-1] > 2 * green[0]


def test_arcs_are_the_same_as_a_list_and_as_a_matrix(open_page, tmp_path):
    scene = tmp_path / "soup.off"
    run("generate", "soup", "--size", 500, "--out", scene)
    page = open_page("graph", scene)
    assert "arc_matrix" in page.data
    page.js("sightline.select(7)")
    arcs = json.loads(run("graph", scene, "--arcs", "--json", "-"))["result"]["arc_list"]
    counts = [sum(a[1] == [7, 0] for a in arcs), sum(a[0] == [7, 0] for a in arcs)]
    assert [int(p.text.split(": ")[1]) for p in page.all("#arcs p")] == counts


def test_what_is_seen_has_lines_and_what_hides_them(open_page, town):
    page = open_page("see", town, eye, "--lines")
    assert page.is_drawn()
    result = json.loads(run("see", town, eye, "--lines", "--json", "-"))["result"]
    assert page.data["polygons"]["count"] == page.data["base"] + len(result["pieces"])
    # Edges of which a part is hidden: clicked in the middle of a part that is seen, if that is 40 pixels long.
    frame = page.data["frame"]
    clicked = 0
    for line in result["lines"]:
        if line["class"] == "smooth" or len(line["parts"]) < 2:
            continue
        for part in (part for part in line["parts"] if part["visible"]):
            p, q = ([(float(Fraction(x)) - m) / frame["size"] for x, m in zip(vertex, frame["middle"])] for vertex in part["vertices"])
            a, b = page.js("return arguments[0].map(sightline.onCanvas)", [p, q])
            if abs(a[0] - b[0]) + abs(a[1] - b[1]) < 40 or clicked == 8:
                continue
            clicked += 1
            page.click_at((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
            said = [item.text.split("\n")[0] for item in page.all("#edge-parts li")]
            assert said == ["visible" if one["visible"] else f"hidden by face {one['hidden_by'][0]}" for one in line["parts"]]
    assert clicked == 8
    sphere = page.js("const c = document.getElementById('sphere'), all = new Uint32Array(c.getContext('2d').getImageData(0, 0, c.width, c.height).data.buffer);"
                     "return new Set(all).size")
    assert sphere > 8, "the sphere of directions is empty"
    k = first_seen(page, "visible")
    page.click_on(k)
    assert "visible" in page.text("#selected-name") or page.all("#edge-parts")


def paper_of_the_sphere(page):
    """The share of the unrolled sphere that shows nothing."""
    return page.js("""
        const c = document.getElementById('sphere'), all = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
        const p = getComputedStyle(document.body).backgroundColor.match(/\\d+/g).map(Number);
        let count = 0;
        for (let i = 0; i < all.length; i += 4) count += all[i] === p[0] && all[i + 1] === p[1] && all[i + 2] === p[2];
        return count / (all.length / 4);
    """)


def test_all_directions_are_filled_in_a_closed_room(open_page):
    page = open_page("see", corpus / "general" / "two_rooms.off", "--eye", "1,1,2")
    paper = paper_of_the_sphere(page)
    assert paper < 1e-3, "the eye sees faces wherever it looks"


def test_weak_visibility_shows_a_sightline_or_a_proof(open_page):
    scene = corpus / "general" / "two_rooms.off"
    page = open_page("weak", scene, "--from-face", 0)
    assert page.is_drawn()
    result = json.loads(run("weak", scene, "--from-face", 0, "--json", "-"))["result"]
    facts = dict(page.data["facts"])
    assert [facts["visible"], facts["hidden"]] == [str(len(result["visible"])), str(len(result["hidden"]))]
    k = first_seen(page, "visible")
    page.click_on(k)
    face = int(page.text("#selected-name").split()[1].rstrip(":,"))
    assert face in result["visible"]
    ends = page.texts("#sightline li")
    assert len(ends) == 2 and ends[0].startswith("from ") and ends[1].startswith("to ") and "rounded" not in ends[0]
    # A hidden face: its proof ends in leaves, each of which says why.
    hidden = next(k for k in range(page.data["polygons"]["count"]) if group_of(page, k) == "hidden" and page.js(
        "sightline.select(arguments[0]); return document.querySelectorAll('#proof ul.tree button').length", k) > 2)
    assert page.text("#selected-name").endswith(": hidden")
    for _ in range(200):  # all nodes that have parts are opened
        closed = [b for b in page.all("#proof ul.tree button") if b.text.endswith("…") and not b.find_elements("xpath", "../ul/li")]
        if not closed:
            break
        page.js("arguments[0].click()", closed[0])
    texts = page.texts("#proof ul.tree button")
    inner = [t for t in texts if t.endswith("…")]
    assert len(texts) == 2 * len(inner) + 1, "a tree of two parts each"
    assert any("blocked by face" in t for t in texts), hidden


def test_a_path_is_played(open_page, town):
    page = open_page("cutset", town, "--orbit", 30)
    assert page.is_drawn()
    frames = json.loads(run("cutset", town, "--orbit", 30, "--faces", "--json", "-"))["result"]["frames"]
    for n in (1, 11, 30):
        page.slide(n)
        assert page.text("#frame").startswith(f"{len(frames[n - 1]['on_view'])} polygons on-view, {frames[n - 1]['cut_edges']} edges")
        assert page.text("#viewpoint") == f"viewpoint {n}: " + ", ".join(frames[n - 1]["eye"])
        assert page.js("return sightline.lines('cut')") == frames[n - 1]["cut_edges"], "the cut is drawn"
        on, before = set(frames[n - 1]["on_view"]), set(frames[max(0, n - 2)]["on_view"])
        some = range(0, page.data["polygons"]["count"], 7)
        said = page.js("""
            return arguments[0].map(k => {
              sightline.select(k);
              return [document.getElementById('selected-name').textContent, ...sightline.looks.slice(4 * k, 4 * k + 3)];
            });
            """, [*some])
        for k, (name, r, g, b) in zip(some, said):
            face = int(name.split()[1].rstrip(":,"))
            assert name.endswith("on-view" if face in on else "off-view")
            assert (max(r, g, b) - min(r, g, b) < 20) == (face not in on), (n, k)
            assert face not in on or (g > r) == (face not in before), "green where it has just become so"
    page.slide(1)
    page.one("#play").click()
    page.js("return new Promise(done => setTimeout(done, 700))")
    assert int(page.text("#slider-value").split()[0]) > 1
    page.click_on(first_seen(page, None))
    assert page.js("return sightline.selected") >= 0


def test_cells_say_what_they_see(open_page):
    scene = corpus / "general" / "two_rooms.map"
    page = open_page("pvs", scene)
    assert page.is_drawn()
    buttons = page.all("section ul.list button")
    assert len(buttons) == len(page.data["cells"])
    shown = json.loads(run("pvs", scene, "--show", page.data["cells"][3]["cell"], "--json", "-"))["result"]["shown"][0]
    buttons[3].click()
    assert page.text("#cell").startswith(f"cell {shown['cell']} about {', '.join(shown['point'])}: sees {len(shown['visible'])} faces")


def test_a_result_is_in_its_solids_colours(open_page, tmp_path):
    small = tmp_path / "small.off"
    run("generate", "convex_sphere", "--size", 40, "--out", small)
    page = open_page("boolean", "union", corpus / "general" / "cube.off", small)
    assert page.is_drawn()
    k = first_seen(page, "cube.off")
    page.click_on(k)
    assert page.text("#selected-name").startswith("face ") and "cube.off" in page.text("#selected-name")


def test_what_is_left_of_a_scene_is_shown_with_its_query(open_page, tmp_path):
    scene, query, small = tmp_path / "scene.qoff", tmp_path / "query.json", tmp_path / "small.qoff"
    run("generate", "hinged", "--seed", 3, "--out", scene, "--query", query)
    fails_where_a_face_is_kept = ["sh", "-c", f"{program} info {{}} | grep -q ', 0 kept'  # {{query}}"]
    page = open_page("reduce", scene, "--query", query, "--out", small, "--seconds", 30, after=["--", *fails_where_a_face_is_kept])
    assert page.is_drawn()
    assert ["faces", "1 of 2"] in page.data["facts"] and small.read_text().split()[2] == "1"
    k = first_seen(page, "faces")
    page.click_on(k)
    assert page.text("#selected-name").startswith("face 0")
    eye = json.loads((tmp_path / "small.json").read_text())["eye"]
    assert ["eye", ", ".join(eye)] in page.data["facts"]


def test_clicks_on_nothing_select_nothing_and_groups_can_be_left_out(open_page):
    page = open_page("weak", corpus / "general" / "two_rooms.off", "--from-face", 0)
    page.click_on(first_seen(page, "visible"))
    page.click_at(3, 300)
    assert page.js("return sightline.selected") == -1
    before = page.picture()[0]
    page.all(".legend input")[0].click()
    assert page.picture()[0] < before
    assert first_seen(page, "visible") == -1


def test_cells_are_walked_through_and_leaks_drawn(open_page, tmp_path):
    lines = [line for line in (corpus / "general" / "two_rooms.off").read_text().splitlines() if line.strip() and not line.startswith("#")]
    points, faces = map(int, lines[1].split()[:2])
    leaky = tmp_path / "leaky.off"
    kept = lines[2:2 + points] + [face for k, face in enumerate(lines[2 + points:2 + points + faces]) if k != 79]
    leaky.write_text(f"OFF\n{points} {faces - 1} 0\n" + "\n".join(kept) + "\n")
    page = open_page("cells", leaky, "--seal", "1,1,2", code=1)
    assert page.is_drawn()
    result = json.loads(run("cells", leaky, "--seal", "1,1,2", "--json", "-", code=1))["result"]
    assert len(page.data["cells"]) == result["cells"]
    way = result["leaks"][0]["way"]
    leak = next(b for b in page.all("section ul.list button") if b.text.startswith("from 1,1,2"))
    assert leak.text == f"from 1,1,2, through {len(way)} cells"
    leak.click()
    assert page.js("return sightline.lines('way')") == len(way)
    first = page.text("#cell p")
    page.all("#cell ul.list button")[0].click()
    assert page.text("#cell p") != first


def test_a_painter_paints_what_a_depth_buffer_finds(open_page, tmp_path):
    scene = tmp_path / "cycle.off"
    run("generate", "bars", "--size", 7, "--out", scene)
    for place in ("--eye=5,-7,9", "--eye=-4,3,8"):
        page = open_page("order", scene, place)
        assert page.js("return sightline.drawing.painter && sightline.camera.atEye")
        differ = page.js("""
            const view = document.getElementById('view'), gl = view.getContext('webgl2'), pixels = [];
            sightline.drawing.outlines = false;
            for (const painter of [true, false]) {
              sightline.drawing.painter = painter;
              sightline.measure(0), sightline.draw();
              const all = new Uint8Array(4 * view.width * view.height);
              gl.readPixels(0, 0, view.width, view.height, gl.RGBA, gl.UNSIGNED_BYTE, all);
              pixels.push(new Uint32Array(all.buffer));
            }
            const paper = pixels[0][0];
            let differ = 0, drawn = 0;
            for (let i = 0; i < pixels[0].length; ++i) differ += pixels[0][i] !== pixels[1][i], drawn += pixels[0][i] !== paper;
            return [differ, drawn];
            """)
        assert differ[1] > 5000 and differ[0] < 0.01 * differ[1], differ


def test_hands_turn_pinch_and_do_not_click(open_page, town, browser):
    from selenium.webdriver import ActionChains

    page = open_page("graph", town)
    before = page.js("return [sightline.camera.yaw, sightline.camera.pitch]")
    ActionChains(browser).move_to_element(page.one("#view")).click_and_hold().move_by_offset(60, 30).release().perform()
    after = page.js("return [sightline.camera.yaw, sightline.camera.pitch]")
    assert after[0] < before[0] and after[1] > before[1] and page.js("return sightline.selected") == -1
    distance = page.js("return sightline.camera.distance")

    def touch(kind, *points):
        browser.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": 300, "id": i} for i, x in enumerate(points)]})

    touch("touchStart", 300), touch("touchStart", 300, 400), touch("touchMove", 250, 450), touch("touchMove", 200, 500), touch("touchEnd")
    assert page.js("return sightline.camera.distance") < 0.6 * distance


def test_a_page_without_webgl_says_so_and_keeps_its_lists(open_page, browser):
    script = browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": "HTMLCanvasElement.prototype.getContext = () => null"})
    try:
        page = open_page("pvs", corpus / "general" / "two_rooms.map")
        assert "no WebGL 2" in page.text("#trouble")
        page.all("section ul.list button")[1].click()
        assert page.text("#cell").startswith(f"cell {page.data['cells'][1]['cell']} ")
        page = open_page("see", corpus / "general" / "two_rooms.off", "--lines")
        page.press("ArrowLeft")
        assert "no WebGL 2" in page.text("#trouble")
    finally:
        browser.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", {"identifier": script["identifier"]})


def test_a_lost_context_is_found_again(open_page, town):
    page = open_page("see", town, eye, "--lines")
    drawn = page.picture()[0]
    page.browser.execute_async_script("""
        const done = arguments[0], view = document.getElementById('view'), lose = view.getContext('webgl2').getExtension('WEBGL_lose_context');
        const paint = () => { for (let i = 0; i < 2; ++i) document.querySelector('.legend input').click(); };
        view.addEventListener('webglcontextlost', () => setTimeout(() => { paint(); lose.restoreContext(); }, 50));
        view.addEventListener('webglcontextrestored', () => setTimeout(done, 300));
        lose.loseContext();
        """)
    assert abs(page.picture()[0] - drawn) < 0.01
    # Each time the sphere is drawn it leaves nothing.
    left = page.js("""
        const gl = document.getElementById('view').getContext('webgl2'), create = gl.createShader.bind(gl), made = [];
        gl.createShader = type => (made.push(create(type)), made.at(-1));
        document.querySelector('.legend input').click();
        sightline.draw();  // with other programs
        return [made.length, made.filter(shader => gl.isShader(shader)).length];
        """)
    assert left == [2, 0]


@pytest.mark.parametrize("words", [["order", eye], ["see", eye], ["weak", "--from-face", 0]])
def test_pixels_have_the_colour_of_what_a_ray_meets_there(open_page, town, words):
    page = open_page(words[0], corpus / "general" / "two_rooms.off" if words[0] == "weak" else town, *words[1:])
    for _ in ("from the eye", "from outside"):
        right, wrong = page.js("""
            sightline.draw();  // the canvas has its size from then on
            const view = document.getElementById('view'), gl = view.getContext('webgl2'), scale = view.width / view.clientWidth, pixel = new Uint8Array(4);
            sightline.drawing.outlines = false;
            sightline.draw();
            let right = 0, wrong = 0;
            for (let x = 10; x < view.clientWidth; x += 19)
              for (let y = 10; y < view.clientHeight; y += 17) {
                const k = sightline.pickAt(x, y);
                if (k < 0 || [[3, 0], [-3, 0], [0, 3], [0, -3]].some(([a, b]) => sightline.pickAt(x + a, y + b) !== k)) continue;
                gl.readPixels(Math.round(x * scale), view.height - 1 - Math.round(y * scale), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
                const own = [...sightline.looks.slice(4 * k, 4 * k + 3)], grey = own.reduce((a, b) => a + b) * 0.33;
                const fits = colour => colour.every((c, i) => Math.abs(c - pixel[i]) < 3);
                fits(own) || fits(own.map(c => (c * 0.45 + grey * 0.55) * 0.8)) ? ++right : ++wrong;
              }
            return [right, wrong];
            """)
        assert right > 50 and wrong <= (0.05 * right if words[0] == "weak" else 0), _  # a source's outline is before all
        page.press("e")


def test_where_doubles_err_is_marked(open_page, tmp_path):
    scene = tmp_path / "leaves.qoff"
    run("generate", "leaves", "--seed", 1, "--ulps", 0, "--out", scene, "--query", tmp_path / "leaves.json")
    place = "--eye=" + ",".join(json.loads((tmp_path / "leaves.json").read_text())["eye"])
    exact, doubles = (set(json.loads(run("see", scene, place, "--kernel", kernel, "--json", "-"))["result"]["visible"]) for kernel in ("exact", "double"))
    page = open_page("see", scene, place)
    missing = sorted(exact - doubles)
    assert missing and not doubles - exact, "a scene that doubles get wrong"
    assert page.text("#errors") == f"missing: {', '.join(map(str, missing))}."
    colours = lambda: page.js("return [...sightline.looks]")
    before = colours()
    page.one("#doubles").click()
    assert colours() != before
    page = open_page("see", corpus / "general" / "cube.off", "--eye=3,4,5", name="other.html")
    assert page.one("#panel").text.count("finds the same faces") == 1


def test_where_a_search_in_doubles_errs_is_marked(open_page, tmp_path):
    scene = tmp_path / "exponents.qoff"
    run("generate", "exponents", "--seed", 2, "--out", scene, "--query", tmp_path / "exponents.json")
    source = "--from=" + " ".join(map(",".join, json.loads((tmp_path / "exponents.json").read_text())["source"]))
    visible, hidden = (json.loads(run("weak", scene, source, "--method", method, "--json", "-"))["result"][which]
                       for method, which in (("lines", "visible"), ("doubles", "hidden")))
    missing = sorted({*visible} & {*hidden})
    page = open_page("weak", scene, source)
    assert missing and page.text("#errors") == f"missing: {', '.join(map(str, missing))}."
    before = page.js("return [...sightline.looks]")
    page.one("#doubles").click()
    assert page.js("return [...sightline.looks]") != before
    page = open_page("weak", corpus / "general" / "cube.off", "--from-face", 0, name="other.html")
    assert page.one("#panel").text.count("A search in plain doubles finds the same faces") == 1


def generated(tmp_path, family, seed):
    """A scene of a family, and its eye."""
    scene, query = tmp_path / f"{family}{seed}.qoff", tmp_path / f"{family}{seed}.json"
    run("generate", family, "--seed", seed, "--out", scene, "--query", query)
    return scene, "--eye=" + ",".join(json.loads(query.read_text())["eye"])


def test_the_pairs_that_an_order_in_doubles_has_wrong_are_marked_and_named(open_page, tmp_path):
    scene, place = generated(tmp_path, "exponents", 2)
    page = open_page("order", scene, place)
    numbers = page.numbers("doubles", "pairs")
    pairs = list(zip(numbers[::2], numbers[1::2]))
    compared = json.loads(run("compare", scene, "order", place, "--kernels", "double", "--json", "-"))["result"]["rows"][0]
    assert len(pairs) == compared["errors"]["pairs_wrong"] > 1
    covered, over = {a for a, _ in pairs}, {b for _, b in pairs}
    assert covered - over and over - covered
    assert f"{len(covered)} faces painted over though nearer" in page.text("#panel") and f"{len(over)} faces painted over nearer ones" in page.text("#panel")
    faces = page.numbers("polygons", "faces")
    own = [looks_of(page, k) for k in range(len(faces))]
    page.one("#doubles").click()
    assert has_colours(page, {k: undecided if face in covered & over else front if face in covered else source if face in over else face_colour
                              for k, face in enumerate(faces)})
    # A face that is picked names those it is wrong with; who clicks one of them picks that.
    for face in sorted(covered | over):
        page.js("sightline.select(arguments[0])", faces.index(face))
        for part, wanted in (("#over", sorted(b for a, b in pairs if a == face)), ("#under", sorted(a for a, b in pairs if b == face))):
            assert page.texts(f"{part} button") == [f"face {other}" for other in wanted]
    for face in sorted(covered | over):
        page.js("sightline.select(arguments[0])", faces.index(face))
        other = page.one("#over button, #under button")
        name = other.text
        other.click()
        assert page.text("#selected-name").split(",")[0] == name
    page.js("sightline.select(arguments[0])", faces.index(min({*faces} - covered - over)))
    assert not page.all("#over, #under")
    page.one("#doubles").click()
    assert [looks_of(page, k) for k in range(len(faces))] == own
    graph = open_page("order", scene, place, "--method", "graph", name="graph.html")
    assert 0 < len(graph.numbers("doubles", "pairs")) < len(numbers), "by the graph faces that are seen from behind are in no pair"


@pytest.mark.parametrize("words, said", [
    (["order", corpus / "general" / "cube.off", "--eye=3,4,5"], "An order in plain doubles finds nothing in the wrong place."),
    (["order", corpus / "general" / "cube.off", "--eye=3,4,5", "--method", "graph"], "An order in plain doubles finds nothing in the wrong place."),
    (["order", corpus / "general" / "cube.off", "--eye=3,4,5", "--kernel", "float"], "Not asked: by --kernel float the order is not exact itself."),
    (["graph", corpus / "general" / "cube.off"], "A comparison in plain doubles finds the same arcs."),
    (["graph", corpus / "general" / "cube.off", "--eye", "3,4,5"], "Not asked: the viewpoints are not all."),
    (["cutset", corpus / "general" / "cube.off", "--orbit", 5], "A test of each plane in plain doubles finds the same faces on-view at all of these viewpoints."),
    (["weak", corpus / "general" / "cube.off", "--from-face", 0, "--budget", 1000], "A search in plain doubles finds the same faces."),
    (["weak", corpus / "general" / "cube.off", "--from-face", 0, "--method", "sample"], "Not asked: by sample the answer is not exact itself."),
    (["see", corpus / "general" / "cube.off", "--eye=3,4,5", "--budget", 1000], "The same algorithm on plain doubles finds the same faces."),
    (["see", corpus / "general" / "cube.off", "--eye=3,4,5", "--frustum"], "Not asked: they look in all directions, and --frustum does not."),
], ids=lambda word: None)
def test_where_nothing_is_marked_the_page_says_why(open_page, words, said):
    page = open_page(*words)
    assert page.text("#not-marked") == said and not page.all("#doubles")


@pytest.mark.parametrize("words", [[], ["--method", "graph"]], ids=["by a tree", "by the graph"])
def test_coordinates_beyond_doubles_leave_them_out(open_page, tmp_path, words):
    huge = tmp_path / "huge.qoff"
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1), (0, 0, 2), (1, 1, 2), (0, 1, 3)]
    huge.write_text("OFF\n9 3 0\n" + "".join(" ".join(f"{x}{'0' * 400}" for x in p) + "\n" for p in points) + "3 0 1 2\n3 3 4 5\n3 6 7 8\n")
    page = open_page("order", huge, "--eye=1,1,5", *words)
    assert page.text("#not-marked") == "Not asked: coordinates are beyond them."


def test_doubles_are_left_out_where_they_would_take_long(open_page, tmp_path, town):
    soup = tmp_path / "soup.off"
    run("generate", "soup", "--size", 2001, "--out", soup)
    assert open_page("order", soup, "--eye=0,0,9").text("#not-marked") == "Not asked: of more than 4000 parts all pairs would take too long."
    assert open_page("graph", soup, name="graph.html").text("#not-marked") == "Not asked: the arcs are not known."
    # Where the budget ends before: the exact answer, which has nothing decided.
    page = open_page("weak", town, "--from-face", 3, "--budget", "0.000001", code=4, name="weak.html")
    assert page.text("#not-marked").startswith("Not asked: the budget of ") and page.text("#not-marked").endswith(" s ran out.")


def test_arcs_that_doubles_lack_or_invent_are_marked(open_page, tmp_path, town):
    scene, _ = generated(tmp_path, "exponents", 2)
    for words, key, colour, of in (([scene], "missing", front, "#arcs-missing"), ([town], "extra", source, "#arcs-extra")):
        page = open_page("graph", *words, name=f"{key}.html")
        arcs = {(a[0], b[0]) for a, b in json.loads(run("graph", *words, "--arcs", "--json", "-"))["result"]["arc_list"]}
        numbers = page.numbers("doubles", key)
        wrong = list(zip(numbers[::2], numbers[1::2]))
        other = page.numbers("doubles", "extra" if key == "missing" else "missing")
        assert wrong and not other and {*wrong} <= arcs if key == "missing" else not {*wrong} & arcs
        words_of = ("arc missing", "arcs missing") if key == "missing" else ("arc that is none", "arcs that are none")
        words_of = words_of[len(wrong) > 1]
        assert [p.text for p in page.all("#panel p.row") if re.search(r"\barcs?\b", p.text)] == [f"{len(wrong)} {words_of}"]
        count = page.data["polygons"]["count"]
        page.one("#doubles").click()
        marked = {k for arc in wrong for k in arc}
        assert has_colours(page, {k: colour if k in marked else face_colour for k in range(count)})
        # Of a face that is picked, those at the other ends.
        one = wrong[0][0]
        page.js("sightline.select(arguments[0])", one)
        ends = {b if a == one else a for a, b in wrong if one in (a, b)}
        assert has_colours(page, {k: (250, 250, 245) if k == one else colour if k in ends else face_colour for k in range(count)})
        assert {b.text for b in page.all(f"{of} button")} == {f"face {k}" for k in ends}
        assert not page.all("#arcs-right")
        for other in list({*range(count)} - marked)[:1]:
            page.js("sightline.select(arguments[0])", other)
            assert page.text("#arcs-right") == "plain doubles have all of its arcs right" and not page.all(of)
        page.js("sightline.select(-1)")
        assert has_colours(page, {k: colour if k in marked else face_colour for k in range(count)})


def on_view_in_doubles(points, faces, at):
    """By the sign of each height in Python's floats: Newell's normal, through the first corner."""
    on = set()
    for face, loop in enumerate(faces):
        corners, h = [points[p] for p in loop], [0.0] * 4
        for p, q in zip(corners, corners[1:] + corners[:1]):
            for k in range(3):
                x, y = (k + 1) % 3, (k + 2) % 3
                h[k] += (p[x] - q[x]) * (p[y] + q[y])
        for k in range(3):
            h[3] -= h[k] * corners[0][k]
        if h[0] * at[0] + h[1] * at[1] + h[2] * at[2] + h[3] > 0:
            on.add(face)
    return on


def test_faces_that_doubles_take_for_on_view_are_marked_as_the_path_is_played(open_page, tmp_path, town):
    lines = [line.split() for line in town.read_text().splitlines() if line.strip() and not line.startswith("#")]
    count = int(lines[1][0])
    corners = lines[2:2 + count]
    points = [[float(Fraction(x)) for x in corner] for corner in corners]
    faces = [[int(n) for n in line[1:]] for line in lines[2 + count:]]
    path = tmp_path / "corners.csv"
    path.write_text("".join(",".join(corner) + "\n" for corner in corners))  # in the planes of their faces
    page = open_page("cutset", town, "--path", path)
    frames = json.loads(run("cutset", town, "--path", path, "--faces", "--json", "-"))["result"]["frames"]
    wrong = []
    for frame in frames:
        on, said = set(frame["on_view"]), on_view_in_doubles(points, faces, [float(Fraction(x)) for x in frame["eye"]])
        wrong.append((sorted(on - said), sorted(said - on)))
    assert any(extra for _, extra in wrong)
    for i, key in enumerate(("missing", "extra")):
        begin, pieces = page.numbers("doubles", key, "begin"), page.numbers("doubles", key, "pieces")
        assert [pieces[a:b] for a, b in zip(begin, begin[1:])] == [one[i] for one in wrong]
    page.one("#doubles").click()
    at = [n for n, (missing, extra) in enumerate(wrong) if missing or extra]
    buttons = page.all("section ul.list button")
    assert [b.text for b in buttons] == [f"viewpoint {n + 1}: {len(wrong[n][0]) + len(wrong[n][1])}" for n in at]
    for button, n in list(zip(buttons, at))[:5]:
        button.click()
        assert page.text("#slider-value").startswith(f"{n + 1} of ")
        on = set(frames[n]["on_view"])
        assert has_colours(page, {k: front if k in wrong[n][0] else source if k in wrong[n][1] else face_colour if k in on else hidden for k in range(len(faces))})
        said = " ".join(f"here {state} in doubles: {', '.join(f'face {k}' for k in list_)}." for state, list_ in zip(("off-view", "on-view"), wrong[n]) if list_)
        assert page.text("#errors") == said
    page.slide(next(n for n in range(len(frames)) if n not in at) + 1)
    assert page.text("#errors") == ""


def test_a_corner_in_the_eye_is_in_no_direction(open_page):
    """Of what is selected the sphere shows the sides, and no line from the top to a corner that is the eye itself."""
    page = open_page("see", corpus / "general" / "cube.off", "--eye=0,0,0")
    corners, sizes = page.numbers("polygons", "corners"), page.numbers("polygons", "sizes")
    heights = [{corners[3 * (sum(sizes[:k]) + i) + 2] for i in range(sizes[k])} for k in range(page.data["base"])]
    page.js("sightline.select(arguments[0])", next(k for k, own in enumerate(heights) if own == {min(corners[2::3])}))  # the bottom, in whose plane the eye is
    rows = page.js("""
        const all = document.getElementById('sphere').getContext('2d').getImageData(0, 0, 1024, 512).data, rows = new Set();
        for (let i = 0; i < all.length; i += 4) if (all[i] < 50 && all[i + 1] < 50 && all[i + 2] < 50) rows.add(i / 4 >> 10);
        return [...rows];
        """)
    assert rows and min(rows) > 245 and max(rows) < 267, "all of its other corners are on the horizon"


def test_the_sphere_shows_nothing_of_groups_that_are_left_out(open_page):
    page = open_page("see", corpus / "general" / "two_rooms.off", "--eye", "1,1,2")
    for box in page.all(".legend input")[:2]:
        box.click()
    paper = paper_of_the_sphere(page)
    assert paper > 0.9, "the paper and its grid; what lies beneath is no part of the sphere"


def test_a_scene_without_faces_shows_what_else_there_is(open_page, tmp_path):
    empty = tmp_path / "empty.off"
    empty.write_text("OFF\n0 0 0\n")
    assert open_page("cells", empty).picture()[0] > 0, "the walls of the one cell"


def test_what_is_too_small_to_be_drawn_is_said(open_page, tmp_path):
    scene, place = generated(tmp_path, "exponents", 2)
    page = open_page("see", scene, place)
    assert any(re.fullmatch(r"[0-9]+ of the polygons (is|are) too small beside the scene to be drawn", note) for note in page.data["notes"])
    assert not any("too small" in note for note in open_page("see", corpus / "general" / "cube.off", "--eye=3,4,5", name="cube.html").data["notes"])


def test_lines_from_behind_the_eye_are_drawn_where_they_are(open_page):
    page = open_page("see", corpus / "general" / "cube.off", "--eye=2/5,1/2,1/3", "--lines")
    lines, points, dark = page.js("""
        const view = document.getElementById('view'), gl = view.getContext('webgl2');
        let lines = 0, points = 0, dark = 0;
        sightline.camera.field = 100;
        for (let turn = 0; turn < 24; ++turn) {
          sightline.camera.yaw = 0.3 + turn * Math.PI / 4, sightline.camera.pitch = [-0.5, 0.1, 0.5][turn % 3];
          sightline.draw();
          const scale = view.width / view.clientWidth, all = new Uint8Array(4 * view.width * view.height);
          gl.readPixels(0, 0, view.width, view.height, gl.RGBA, gl.UNSIGNED_BYTE, all);
          for (const line of sightline.linesOf('visible')) {
            if (sightline.onCanvas(line.from) || !sightline.onCanvas(line.to)) continue;
            let seen = 0;
            for (let t = 0; t < 1; t += 0.005) {
              const at = sightline.onCanvas(line.from.map((x, k) => x + t * (line.to[k] - x)));
              if (!at || at[0] < 4 || at[1] < 4 || at[0] > view.clientWidth - 5 || at[1] > view.clientHeight - 5) continue;
              const x = Math.floor(at[0] * scale), y = view.height - 1 - Math.floor(at[1] * scale);
              let least = 255;
              for (let i = -1; i <= 1; ++i) for (let j = -1; j <= 1; ++j) least = Math.min(least, all[4 * ((y + j) * view.width + x + i)]);
              ++seen, ++points, dark += least < 75;
            }
            lines += seen > 0;
          }
        }
        return [lines, points, dark];
        """)
    assert lines > 10 and dark > 0.95 * points, (lines, points, dark)
    # A click on what is before the eye finds the edge.
    found = page.js("""
        const found = [], view = document.getElementById('view'), isInside = ([x, y]) => Math.min(x, y, view.clientWidth - x, view.clientHeight - y) > 60;
        for (let turn = 0; turn < 24; ++turn) {
          const [yaw, pitch] = [sightline.camera.yaw, sightline.camera.pitch] = [0.3 + turn * Math.PI / 4, [-0.5, 0.1, 0.5][turn % 3]];
          for (const line of sightline.linesOf('visible'))
            for (let t = 0.02; t < 1 && !sightline.onCanvas(line.from) && found.length <= turn; t += 0.02) {
              const at = sightline.onCanvas(line.from.map((x, k) => x + t * (line.to[k] - x)));
              if (at && isInside(at)) found.push([yaw, pitch, ...at, line.text]);
            }
        }
        return found;
        """)
    assert len(found) > 2
    for yaw, pitch, x, y, text in found[:3]:
        page.js("[sightline.camera.yaw, sightline.camera.pitch] = arguments[0]", [yaw, pitch])
        page.click_at(x, y)
        assert text in page.text("#edge-parts")


def test_the_unrolled_sphere_has_the_colour_of_what_is_met_there(open_page):
    page = open_page("see", corpus / "general" / "two_rooms.off", "--eye", "1,1,2")
    size = page.js("const s = document.getElementById('sphere'); return [s.clientWidth, s.clientHeight]")
    page.js("const s = document.getElementById('sphere'); window.before = s.getContext('2d').getImageData(0, 0, s.width, s.height)")
    met = set()
    for x in (0.07, 0.2, 0.33, 0.46, 0.61, 0.78, 0.93):
        for y in (0.22, 0.47, 0.71):
            at = [round(x * size[0]), round(y * size[1])]
            pixel = page.js("const s = document.getElementById('sphere'), [x, y] = arguments[0];"
                            "const i = 4 * (Math.floor(y / s.clientHeight * s.height) * s.width + Math.floor(x / s.clientWidth * s.width));"
                            "return [...before.data.slice(i, i + 3)]", at)
            page.js("const s = document.getElementById('sphere'), box = s.getBoundingClientRect(), [x, y] = arguments[0];"
                    "s.dispatchEvent(new MouseEvent('click', {clientX: box.left + s.clientLeft + x, clientY: box.top + s.clientTop + y}))", at)
            k = page.js("return sightline.selected")
            colour = page.js("return [...sightline.looks.slice(4 * arguments[0], 4 * arguments[0] + 3)]", k)
            if all(abs(a - b) < 3 for a, b in zip(colour, pixel)):
                met.add(k)
    assert len(met) > 12, "but for borders, and the lines of the grid"


def test_a_source_out_of_all_proportion_leaves_the_scene_in_view(open_page):
    page = open_page("weak", corpus / "general" / "cube.off", "--from", "-1e9,0,0 -1e9,0,1 -1e9,1,1 -1e9,1,0")
    assert page.is_drawn()


def test_what_is_beyond_a_page_keeps_its_direction(tmp_path):
    def page_of(*source):
        run("weak", corpus / "general" / "cube.off", "--from", " ".join(source), "--html", tmp_path / "page.html")
        data = block_of(tmp_path / "page.html")
        corners, texts, of = unpacked(data["polygons"]["corners"]), data["polygons"]["exact"]["texts"], unpacked(data["polygons"]["exact"]["corners"])
        first = sum(unpacked(data["polygons"]["sizes"])[:data["base"]])
        return data, list(zip(*[iter(corners[3 * first:])] * 3)), [texts[n] for n in of[first:]]

    # All of it: a smaller one, nearer, and so are ends of sightlines.
    data, corners, texts = page_of("1e9,1e7,0", "1e9,1e7,1e5", "1e9,1.1e7,1e5")
    assert [(y / x, z / x) for x, y, z in corners] == [pytest.approx(p, abs=1e-6) for p in ((0.01, 0), (0.01, 1e-4), (0.011, 1e-4))]
    ends = unpacked(data["sightlines"]["ends"])
    assert ends and all(0.0099 < ends[i + 1] / ends[i] < 0.0111 for i in range(0, len(ends), 6))
    assert texts[0] == "1000000000, 10000000, 0" and any("drawn nearer" in note for note in data["notes"])
    # A part of it: that, where it is.
    data, corners, texts = page_of("-1e9,-1e9,5", "-1e9,1e9,5", "1e9,1e9,5", "1e9,-1e9,5")
    height = (5 - data["frame"]["middle"][2]) / data["frame"]["size"]
    assert sorted(corners) == [pytest.approx((x, y, height)) for x in (-1e6, 1e6) for y in (-1e6, 1e6)]
    assert len(texts) == 4 and all(text.endswith(", 5") for text in texts) and any("as far as that" in note for note in data["notes"])


def test_outlines_are_the_sides_of_polygons_and_nothing_else(open_page, tmp_path):
    """Of a triangle, a square and a heptagon every side is drawn, and nothing across them, where they are fans of triangles."""
    heptagon = [(30, 0), (40, 0), (46, 8), (44, 18), (35, 22), (26, 18), (24, 8)]
    polygons = [[(0, 0), (18, 0), (9, 18)], [(0, 24), (18, 24), (18, 42), (0, 42)], heptagon]
    scene = tmp_path / "flat.off"
    corners = [p for polygon in polygons for p in polygon]
    places = iter(range(len(corners)))
    faces = [" ".join(map(str, [len(polygon), *(next(places) for _ in polygon)])) for polygon in polygons]
    scene.write_text(f"OFF {len(corners)} {len(polygons)} 0\n" + "\n".join([f"{x} {y} 0" for x, y in corners] + faces))
    page = open_page("order", scene, "--eye=20,20,90")
    frame = page.data["frame"]

    def darkened(places):
        """Whether edges darken what is there, or beside it."""
        points = [[(x - m) / frame["size"] for x, m in zip((*place, 0), frame["middle"])] for place in places]
        return page.js("""
            sightline.draw();  // the canvas has its size from then on
            const view = document.getElementById('view'), gl = view.getContext('webgl2'), scale = view.width / view.clientWidth, pictures = [];
            for (const outlines of [false, true]) {
              sightline.drawing.outlines = outlines;
              sightline.draw();
              const all = new Uint8Array(4 * view.width * view.height);
              gl.readPixels(0, 0, view.width, view.height, gl.RGBA, gl.UNSIGNED_BYTE, all);
              pictures.push(all);
            }
            return arguments[0].map(place => {
              const [x, y] = sightline.onCanvas(place).map(c => Math.round(c * scale));
              for (let a = -2; a <= 2; ++a)
                for (let b = -2; b <= 2; ++b) {
                  const i = 4 * ((view.height - 1 - y - b) * view.width + x + a);
                  if (pictures[1][i] < pictures[0][i] - 20) return true;
                }
              return false;
            });
            """, points)

    def between(p, q, share):
        return tuple(a + share * (b - a) for a, b in zip(p, q))

    for polygon in polygons:
        n = len(polygon)
        sides = [between(polygon[k], polygon[(k + 1) % n], 0.4) for k in range(n)]
        assert darkened(sides) == [True] * n, f"{n} corners"
        across = [between(polygon[0], polygon[k], share) for k in range(2, n - 1) for share in (0.3, 0.5, 0.7)]
        middle = tuple(sum(c) / n for c in zip(*polygon))
        assert not any(darkened(across + [middle])), f"{n} corners"


def test_a_painter_needs_an_order_and_a_depth_buffer_does_not(open_page):
    """The pieces of a cube in the file's order, which is none: painted, the last is in front; with depths, the nearest."""
    page = open_page("see", corpus / "general" / "cube.off", "--eye=3,4,5")
    base = page.data["base"]
    page.js("sightline.drawing.to = arguments[0], sightline.drawing.outlines = false", base)
    met = {}
    for painter, outside in ((True, False), (False, False), (True, True)):
        if outside:  # where no order is claimed
            page.press("e")
        seen, wrong = page.js("""
            sightline.draw();  // the canvas has its size from then on
            const view = document.getElementById('view'), gl = view.getContext('webgl2'), scale = view.width / view.clientWidth, pixel = new Uint8Array(4), met = [];
            sightline.drawing.painter = arguments[0];
            sightline.draw();
            let wrong = 0;
            for (let x = 10; x < view.clientWidth; x += 19)
              for (let y = 10; y < view.clientHeight; y += 17) {
                const k = sightline.pickAt(x, y);
                if (k < 0 || [[3, 0], [-3, 0], [0, 3], [0, -3]].some(([a, b]) => sightline.pickAt(x + a, y + b) !== k)) { met.push(-1); continue; }
                met.push(k);
                gl.readPixels(Math.round(x * scale), view.height - 1 - Math.round(y * scale), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
                const own = [...sightline.looks.slice(4 * k, 4 * k + 3)], grey = own.reduce((a, b) => a + b) * 0.33;
                const fits = colour => colour.every((c, i) => Math.abs(c - pixel[i]) < 3);
                // From outside of a cube the painter's last is seen from behind where it is no face of the near three.
                wrong += !fits(own) && !fits(own.map(c => (c * 0.45 + grey * 0.55) * 0.8));
              }
            return [met, wrong];
            """, painter)
        assert wrong == 0 and sum(k >= 0 for k in seen) > 50, (painter, outside)
        if not outside:
            met[painter] = seen
    both = [(a, b) for a, b in zip(met[True], met[False]) if a >= 0 and b >= 0]
    assert len(both) > 50 and all(a >= b or a != b for a, b in both)
    differ = [(a, b) for a, b in both if a != b]
    assert len(differ) > 20, "the cube's order is one, from this eye"
    assert all(a > b for a, b in differ), "what is painted last has the higher number"


@pytest.mark.parametrize("size", [20000, 24000])
def test_a_page_of_many_corners_rounds_them(open_page, tmp_path, size):
    scene = tmp_path / "terrain.off"
    run("generate", "terrain", "--size", size, "--out", scene)
    in_steps = size == 24000  # which are those of the scene, however far a source is
    page = open_page("weak", scene, "--from", "0,0,10000 1,0,10000 0,1,10000", "--method", "sample", "--rays", 1) if in_steps else open_page("cutset", scene, "--orbit", 2)
    assert "exact" not in page.data["polygons"] and ("step" in page.data["polygons"]) == in_steps
    words = scene.read_text().split()
    points, faces = int(words[1]), int(words[2])
    place = lambda p: [float(x) for x in words[4 + 3 * p:7 + 3 * p]]
    within = 2**-15 * page.data["frame"]["size"]
    for k in (0, faces // 2, faces - 1):
        page.js("sightline.select(arguments[0])", k)
        assert page.text("#selected-name") in ((f"face {k}: visible", f"face {k}: hidden") if in_steps else (f"face {k}, on-view", f"face {k}, off-view"))
        said = [[float(x) for x in item.text.split(", ")] for item in page.all("#selection .exact li")]
        loop = [int(w) for w in words[4 + 3 * points + 4 * k + 1:4 + 3 * points + 4 * k + 4]]
        assert len(said) == 3
        for p in loop:
            assert any(all(abs(a - b) <= within for a, b in zip(place(p), q)) for q in said), (k, p, said)
    if in_steps:
        page.js("sightline.select(arguments[0])", faces)
        assert [[float(x) for x in item.text.split(", ")] for item in page.all("#selection .exact li")] == [pytest.approx(p, abs=1e-3) for p in ([0, 0, 1e4], [1, 0, 1e4], [0, 1, 1e4])]


def wrong_faces(page, rows):
    """How many faces all of them have wrong: each row's are on the page, as missing or as too many."""
    wrong = 0
    for row, item, method in zip(rows, page.all("#methods button"), page.data["methods"], strict=True):
        item.click()
        assert page.texts("#methods [aria-pressed=true]") == [item.text]
        hidden, visible = row["errors"]["wrongly_hidden"], row["errors"]["wrongly_visible"]
        assert page.text("#method") == f"{method['name']}: {hidden} faces are missing, {visible} too many"
        wrong += hidden + visible
        if hidden + visible > 0:
            names = page.js("""
                const names = [];
                for (let k = 0; k < arguments[0]; ++k) { sightline.select(k); names.push(document.getElementById('selected-name').textContent); }
                sightline.select(-1);
                return names;
                """, page.data["polygons"]["count"])
            assert sum(name.endswith("visible, and missing") for name in names) >= hidden
            assert sum(name.endswith("not visible, and said to be") for name in names) >= visible
    return wrong


def test_a_comparison_shows_the_faces_that_each_has_wrong(open_page, tmp_path):
    scene = tmp_path / "leaves.qoff"
    run("generate", "leaves", "--seed", 1, "--ulps", 0, "--out", scene, "--query", tmp_path / "leaves.json")
    words = ["compare", scene, "see", "--eye=" + ",".join(json.loads((tmp_path / "leaves.json").read_text())["eye"]), "--sizes", 16, "--bits", 16]
    page = open_page(*words, "--json", tmp_path / "said.json")
    assert page.is_drawn(0.005)  # leaves are thin
    rows = json.loads((tmp_path / "said.json").read_text())["result"]["rows"]
    said = page.texts("#methods button")
    assert [text.split(": ")[0] for text in said] == [method["name"] for method in page.data["methods"]]
    assert all(f"{1e-6 * method['peak_bytes']:.1f} MB" in text for text, method in zip(said, page.data["methods"]))
    assert page.text("#method") == "partition, exact: 0 faces are missing, 0 too many"
    assert wrong_faces(page, rows) > 0, "a scene that something gets wrong"
    # Where no list of faces is said, the table alone.
    page = open_page("compare", scene, "trace", "--random", 20, name="trace.html")
    assert page.is_drawn() and len(page.all("#methods button")) == len(page.data["methods"]) > 0


def test_a_comparison_of_weak_visibility_shows_the_faces_that_each_has_wrong(open_page, tmp_path):
    page = open_page("compare", corpus / "general" / "two_rooms.off", "weak", "--from-face", 0, "--rays", 200, "--json", tmp_path / "said.json")
    assert page.is_drawn()
    rows = json.loads((tmp_path / "said.json").read_text())["result"]["rows"]
    assert wrong_faces(page, rows) == sum(abs(row["visible"] - rows[0]["visible"]) for row in rows) > 0


@pytest.mark.parametrize("words", [["order", "--eye", "1,1,2"], ["render", "--eye", "1,1,2"], ["pvs", "--rays", 200]])
def test_a_comparison_says_the_errors_of_each(open_page, tmp_path, words):
    words = ["compare", corpus / "general" / "two_rooms.off", *words]
    page = open_page(*words, "--json", tmp_path / "said.json")
    assert page.is_drawn()
    rows = json.loads((tmp_path / "said.json").read_text())["result"]["rows"]
    clicked = page.js("""
        const textOf = one => one.innerText;
        return [...document.querySelectorAll('#methods button')].map(item => {
          item.click();
          return [textOf(item), textOf(document.getElementById('method')), [...document.querySelectorAll('#methods [aria-pressed=true]')].map(textOf)];
        });
        """)
    told = 0
    for row, (text, shown, pressed), method in zip(rows, clicked, page.data["methods"], strict=True):
        name, said = text.split(": ")
        assert name == method["name"] and name.startswith(f"{row['method']}, {row['kernel']}")
        cost, _, errors = said.partition("; ")
        assert re.fullmatch(r"[\d.e-]+ s, [\d.]+ MB", cost), cost
        wanted = {key.replace("_", " "): value for key, value in row.get("errors", {}).items()
                  if not isinstance(value, bool) and value != 0 and key not in ("pairs", "sides_asked")}
        found = {key: float(value) for key, value in (error.rsplit(" ", 1) for error in filter(None, errors.split(", ")))}
        assert found == pytest.approx(wanted, rel=0.01), name
        told += len(found)
        assert shown == text and pressed == [text]
    assert told > 2, "a scene that something gets wrong"


def test_a_judgement_fits_1400_pixels(browser, tmp_path):
    mine, page = tmp_path / ("a_long_name_" * 15 + ".sh"), tmp_path / "judgement.html"
    mine.write_text("echo '{\"visible\": []}' > $3\n")
    run("judge", "--program", f"sh {mine} {{scene}} {{query}} {{answer}}", "--query", "see", "--contract", "exact",
        "--families", "hinged,triangles_between_squares", "--cases", 1, "--html", page, code=1)
    size = browser.get_window_size()
    browser.set_window_size(1400, 900)
    browser.get(page.as_uri())
    across = browser.execute_script("return [document.documentElement.scrollWidth, innerWidth, document.querySelectorAll('tr').length]")
    browser.set_window_size(size["width"], size["height"])
    assert across[2] > 10
    assert across[0] <= across[1] <= 1400


# ---- What sections hold, and what their buttons draw


def shares(colour):
    """What of a colour's parts are left where a face is lighter or darker."""
    return [c / max(colour) for c in colour]


def has_colours(page, colours):
    """Of polygons, {polygon: colour}."""
    looks = page.js("return [...sightline.looks]")
    return [k for k, colour in colours.items() if shares(looks[4 * k:4 * k + 3]) != pytest.approx(shares(colour), abs=0.02)] == []


def has_colour(page, k, colour):
    return has_colours(page, {k: colour})


seen, hidden, source, new, other, front, face_colour, undecided = (
    (230, 159, 0), (150, 151, 156), (0, 114, 178), (0, 158, 115), (86, 180, 233), (213, 94, 0), (178, 190, 200), (204, 121, 167))


def shown(page):
    """Polygons that are drawn."""
    return page.js("return [...sightline.looks].filter((_, i) => i % 4 === 3).flatMap((a, k) => a > 0 ? [k] : [])")


def ends_of(page, layer):
    return [tuple(map(tuple, line)) for line in page.js("return sightline.linesOf(arguments[0]).map(line => [line.from, line.to])", layer)]


def segments_of(numbers):
    return [(tuple(numbers[i:i + 3]), tuple(numbers[i + 3:i + 6])) for i in range(0, len(numbers), 6)]


def sides_of(page, k):
    """Sides of a polygon, from its first corner on."""
    first = sum(page.numbers("polygons", "sizes")[:k])
    numbers = page.numbers("polygons", "corners")[3 * first:3 * (first + page.numbers("polygons", "sizes")[k])]
    corners = [tuple(numbers[i:i + 3]) for i in range(0, len(numbers), 3)]
    return list(zip(corners, corners[1:] + corners[:1]))


def without(data, left):
    """Leaves polygons out of a block of data, as pages of many triangles do."""
    polygons = data["polygons"]
    sizes, faces = unpacked(polygons["sizes"]), unpacked(polygons["faces"])
    kept = [k for k in range(polygons["count"]) if k not in left]
    place = [sum(sizes[:k]) for k in range(len(sizes))]
    corners = [i for k in kept for i in range(place[k], place[k] + sizes[k])]
    at = base64.b64decode(polygons["corners"]["base64"])
    polygons["corners"]["base64"] = base64.b64encode(b"".join(at[12 * i:12 * i + 12] for i in corners)).decode()
    exact = unpacked(polygons["exact"]["corners"])
    polygons["exact"]["corners"] = packed([exact[i] for i in corners])
    polygons.update(count=len(kept), sizes=packed([sizes[k] for k in kept]), faces=packed([faces[k] for k in kept]), numbers=packed(kept))
    if "groups" in polygons:
        groups = unpacked(polygons["groups"])
        polygons["groups"] = packed([groups[k] for k in kept])


def test_a_proof_is_the_tree_that_the_page_holds(open_page):
    def change(data):
        kinds = unpacked(data["proofs"]["kinds"])
        other = lambda i, kind: 3 + (1 + kinds[:i].count(3)) % 4 if kind == 3 else kind if kind > 0 else 2 if kinds[i - 1] < 3 else 0
        data["proofs"]["kinds"] = packed([other(i, kind) for i, kind in enumerate(kinds)])

    page = open_page("weak", corpus / "general" / "two_rooms.off", "--from-face", 0, change=change)
    proofs = {key: page.numbers("proofs", key) for key in page.data["proofs"]}
    faces = page.numbers("polygons", "faces")
    longest = max(range(len(proofs["pieces"])), key=lambda i: proofs["begin"][i + 1] - proofs["begin"][i])
    k = proofs["pieces"][longest]
    own = [i for i, piece in enumerate(proofs["pieces"]) if faces[piece] == faces[k]]

    def walk(step, way):
        """A node, as [text, step, parts], and where it ends."""
        kind, name = proofs["kinds"][step], f"face {faces[proofs['of'][step]]}"
        text = [f"past an edge of {name} …", "a cut of the source …", "a cut of the face …", f"blocked by {name}", "no line there", "they face away", "open"][kind]
        if kind > 2:
            return [way + text, step, []], step + 1
        ways = ("on one side: ", "on the other: ") if kind == 0 else ("in front: ", "behind: ")
        one, end = walk(step + 1, ways[0])
        two, end = walk(end, ways[1])
        return [way + text, step, [one, two]], end

    trees = [walk(proofs["begin"][i], "") for i in own]
    assert [end for _, end in trees] == [proofs["begin"][i + 1] for i in own]
    trees = [tree for tree, _ in trees]
    flat = lambda node: [node, *(below for part in node[2] for below in flat(part))]
    nodes = [node for tree in trees for node in flat(tree)]
    assert {proofs["kinds"][step] for _, step, _ in nodes} == {0, 2, 3, 4, 5, 6}, "some of each, and planes in first parts"
    page.js("sightline.select(arguments[0])", k)
    to_depth = lambda node, depth: [node[0], *(text for part in node[2] if depth > 0 for text in to_depth(part, depth - 1))]
    shown_nodes = lambda: page.texts("#proof ul.tree button")
    assert shown_nodes() == [text for tree in trees for text in to_depth(tree, 2)], "open to its second level"
    blockers = set()
    for i, tree, said in zip(own, trees, page.all("#proof > p:not(.faint)"), strict=True):
        leaves = [node for node in flat(tree) if not node[2]]
        by = list(dict.fromkeys(proofs["of"][step] for _, step, _ in leaves if proofs["kinds"][step] == 3))
        blockers.update(by)
        wanted = f"source {proofs['sources'][i] + 1}: {len(leaves)} " + ("leaf" if len(leaves) == 1 else "leaves")
        opened = sum(proofs["kinds"][step] == 6 for _, step, _ in leaves)
        assert said.text == wanted + (f", blocked by {', '.join(f'face {faces[b]}' for b in by)}" if by else "") + (f"; {opened} open" if opened else "")
    assert blockers and len(page.data["groups"]) > 3
    assert has_colours(page, {b: other for b in blockers}) and not any(has_colour(page, b, other) for b in range(0, 142, 5) if b not in blockers)
    assert len(ends_of(page, "blockers")) == sum(len(sides_of(page, b)) for b in blockers)
    # All of it, and what each node draws.
    for _ in range(40):
        page.js("""
            for (const made of document.querySelectorAll('#proof ul.tree button'))
              if (made.textContent.endsWith('…') && made.nextSibling.childElementCount === 0) { made.click(); break; }
            """)
    assert shown_nodes() == [text for text, _, _ in nodes]
    for j in range(len(nodes) - 1, -1, -1):  # from below, as a click closes what is below
        text, step, _ = nodes[j]
        page.js("document.querySelectorAll('#proof ul.tree button')[arguments[0]].click()", j)
        drawn, kind, sides = ends_of(page, "step"), proofs["kinds"][step], sides_of(page, proofs["of"][step])
        assert drawn == (sides + [sides[proofs["corners"][step]]] if kind == 0 else sides if kind == 3 else []), text
    page.js("sightline.select(-1)")
    assert all(page.js("return sightline.lines(arguments[0])", name) == 0 for name in ("step", "sightline", "blockers"))
    assert not any(has_colour(page, b, other) for b in list(blockers)[:5])


def test_sightlines_go_from_a_source_to_a_face(open_page):
    def change(data):
        data["sightlines"]["sources"] = packed([7] * len(unpacked(data["sightlines"]["pieces"])))
        data["proofs"]["kinds"] = packed([6 if kind == 4 else kind for kind in unpacked(data["proofs"]["kinds"])])
        data["proofs"].update(pieces=packed(unpacked(data["proofs"]["pieces"])[:-1]), sources=packed(unpacked(data["proofs"]["sources"])[:-1]))

    page = open_page("weak", corpus / "general" / "two_rooms.off", "--from-face", 0, change=change)
    lines = segments_of(page.numbers("sightlines", "ends"))
    texts = page.data["sightlines"]["texts"]
    for i, k in list(enumerate(page.numbers("sightlines", "pieces")))[::20]:
        page.js("sightline.select(arguments[0])", k)
        assert page.texts("#sightline li") == ["from " + texts[2 * i], "to " + texts[2 * i + 1]]
        assert page.text("#sightline p") == "Seen from source 8 along the line"
        assert ends_of(page, "sightline")[0] == lines[i] and page.js("return sightline.lines('sightline')") == 7
    box = next(label for label in page.all("#panel label") if label.text == "all of them")
    box.click()
    assert ends_of(page, "all") == lines
    box.click()
    assert ends_of(page, "all") == [] and page.js("return sightline.drawing.backs") is False
    # What no proof is written of; leaves that are open; a source.
    groups = page.numbers("polygons", "groups")
    pieces = page.numbers("proofs", "pieces")
    unproved = next(k for k, g in enumerate(groups) if page.data["groups"][g]["role"] == "hidden" and k not in pieces)
    page.js("sightline.select(arguments[0])", unproved)
    assert "There is no proof of it on this page." in page.text("#selection")
    kinds, begin = page.numbers("proofs", "kinds"), page.numbers("proofs", "begin")
    of_open = [kinds[begin[i]:begin[i + 1]].count(6) for i in range(len(pieces))]
    i = max(range(len(pieces)), key=lambda i: of_open[i])
    page.js("sightline.select(arguments[0])", pieces[i])
    assert of_open[i] == 0 or f"; {of_open[i]} open" in page.text("#proof")
    page.js("sightline.select(142)")
    assert page.text("#selected-name") == page.data["groups"][groups[142]]["name"] and "proof" not in page.text("#selection")
    assert ends_of(page, "sources") == sides_of(page, 142) and has_colour(page, 142, source)


def test_hidden_lines_are_dashed_and_what_hides_a_line_lights_up(open_page, town):
    def change(data):
        names, kinds = data["lines"]["names"], unpacked(data["lines"]["kinds"])
        names += [] if "smooth" in names else ["smooth"]
        data["lines"]["kinds"] = packed([names.index("smooth") if edge % 7 == 0 else kind for edge, kind in zip(unpacked(data["lines"]["edges"]), kinds)])

    page = open_page("see", town, eye, "--lines", change=change)
    of, kinds = page.numbers("lines", "hidden_by"), [page.data["lines"]["names"][kind] for kind in page.numbers("lines", "kinds")]
    edges, ends = page.numbers("lines", "edges"), segments_of(page.numbers("lines", "ends"))
    of_kind = lambda is_hidden: [ends[i] for i in range(len(ends)) if kinds[i] != "smooth" and (of[i] > 0) == is_hidden]
    assert ends_of(page, "hidden") == of_kind(True) and ends_of(page, "visible") == of_kind(False)
    # A picture with them, and one without.
    box = next(label for label in page.all("#panel label") if label.text == "hidden parts, dashed")
    pixels = lambda places: page.js("""
        sightline.draw();
        const view = document.getElementById('view'), gl = view.getContext('webgl2'), scale = view.width / view.clientWidth, all = new Uint8Array(4 * view.width * view.height);
        gl.readPixels(0, 0, view.width, view.height, gl.RGBA, gl.UNSIGNED_BYTE, all);
        return arguments[0].map(list => list.map(([x, y]) => {
          const i = 4 * ((view.height - 1 - Math.floor(y * scale)) * view.width + Math.floor(x * scale));
          return all[i] + all[i + 1] + all[i + 2];
        }));
        """, places)
    along = lambda line: [[a + s / 60 * (b - a) for a, b in zip(*line)] for s in range(2, 59)]

    def on_canvas(is_hidden):
        lines = page.js("return arguments[0].map(line => line.map(sightline.onCanvas))", of_kind(is_hidden))
        return [along(line) for line in lines if None not in line and max(abs(b - a) for a, b in zip(*line)) > 25][:30]

    dashed, whole = on_canvas(True), on_canvas(False)
    assert len(dashed) > 3 and len(whole) > 3
    with_lines, black = pixels(dashed), pixels(whole)
    box.click()
    assert ends_of(page, "hidden") == [] and ends_of(page, "visible") == of_kind(False)
    without_lines = pixels(dashed)
    changed = [sum(abs(a - b) > 30 for a, b in zip(one, two)) / len(one) for one, two in zip(with_lines, without_lines)]
    assert 0.25 < sorted(changed)[len(changed) // 2] < 0.8, "dashes, and what is between them"
    dark = [sum(p < 150 for p in one) / len(one) for one in black]
    assert sorted(dark)[len(dark) // 2] > 0.8, "whole lines on their faces"
    box.click()
    assert page.js("return sightline.drawing.outlines") is False and page.js("return sightline.lines('hidden')") > 0
    inks = sorted(p for one, two in zip(with_lines, without_lines) for p, q in zip(one, two) if q - p > 30)
    assert inks[len(inks) // 10] > 150, "faces shine through what is hidden"
    # What hides one, and all parts of its edge.
    for n in (i for i in range(len(ends)) if kinds[i] != "smooth" and of[i] == 0 and sum(edge == edges[i] for edge in edges) > 2):
        a, b = page.js("return arguments[0].map(sightline.onCanvas)", ends[n])
        if max(abs(b[0] - a[0]), abs(b[1] - a[1])) < 40:
            continue
        page.click_at((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
        parts = [i for i in range(len(ends)) if edges[i] == edges[n]]
        hiders = list(dict.fromkeys(of[i] - 1 for i in parts if of[i] > 0))
        assert ends_of(page, "selection") == [side for k in hiders for side in sides_of(page, k)] + [ends[i] for i in parts]
        assert [item.text.split("\n")[1] for item in page.all("#edge-parts li")] == [page.data["lines"]["texts"][i] for i in parts]
        break
    else:
        pytest.fail("no edge of three parts that is long enough")
    # A hidden part, and a face, away from all other lines.
    at, k = page.js("""
        const far = (p, [a, b]) => {
          const d = [b[0] - a[0], b[1] - a[1]], l = d[0] * d[0] + d[1] * d[1], t = l > 0 ? Math.max(0, Math.min(1, ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / l)) : 0;
          return Math.hypot(a[0] + t * d[0] - p[0], a[1] + t * d[1] - p[1]);
        };
        const lines = ['hidden', 'visible'].flatMap(name => sightline.linesOf(name)).map(line => [line.from, line.to].map(sightline.onCanvas)).filter(([a, b]) => a && b);
        const hidden = sightline.linesOf('hidden').map(line => [line.from, line.to].map(sightline.onCanvas)).filter(([a, b]) => a && b);
        const middles = hidden.map(([a, b]) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]);
        const part = middles.find(at => at[0] > 150 && at[1] > 60 && at[1] < 550 && at[0] < 700 && lines.filter(line => far(at, line) <= 5).length === 1);
        for (let k = arguments[0]; k < arguments[1]; ++k) {
          const at = sightline.middleOf(k);
          if (at && sightline.pickAt(...at) === k && lines.every(line => far(at, line) > 8)) return [part, k];
        }
        return [part, -1];
        """, page.data["base"], page.data["polygons"]["count"])
    page.click_on(k)
    assert k >= 0 and page.js("return sightline.selected") == k and page.all("#edge-parts") == []
    page.click_at(*at)
    assert "hidden by face" in page.text("#edge-parts")


def test_the_unrolled_sphere_outlines_what_is_selected(open_page):
    page = open_page("see", corpus / "general" / "two_rooms.off", "--eye", "1,1,2")
    # Some, and all that are across the border of the sheet, behind the eye.
    place = page.data["eye"]["place"]
    def turned(p):
        angle = math.atan2(p[1] - place[1], p[0] - place[0]) - math.atan2(-place[1], -place[0])
        return (angle + 3 * math.pi) % (2 * math.pi) - math.pi
    across = [k for k in range(page.data["base"], page.data["polygons"]["count"])
              if any(abs(turned(p) - turned(q)) > math.pi and min(abs(turned(p)), abs(turned(q))) > math.pi / 2 for p, q in sides_of(page, k))]
    assert across
    ks = across[:2] + list(range(page.data["base"], page.data["polygons"]["count"], 40))
    changed = page.js("""
        const copy = document.createElement('canvas'), counts = [];
        copy.width = 1024, copy.height = 512;
        const pen = copy.getContext('2d', {willReadFrequently: true});
        const all = () => { pen.drawImage(document.getElementById('sphere'), 0, 0); return new Uint32Array(pen.getImageData(0, 0, 1024, 512).data.buffer); };
        const before = all(), differs = (p, q) => Math.abs((p & 255) - (q & 255)) > 40;
        for (const k of arguments[0]) {
          sightline.select(k);
          const now = all();
          let differ = 0, longest = 0;
          for (let y = 0; y < 512; ++y)
            for (let x = 0, run = 0; x < 1024; ++x) {
              const is = differs(before[1024 * y + x], now[1024 * y + x]);
              differ += is, run = is ? run + 1 : 0, longest = Math.max(longest, run);
            }
          counts.push([differ, longest]);
        }
        sightline.select(-1);
        return [counts, all().every((p, i) => !differs(p, before[i]))];
        """, ks)
    assert all(differ > 30 for differ, _ in changed[0]) and changed[1]
    assert all(longest < 900 for _, longest in changed[0]), "who is across the border of the sheet has no line along all of it"


def test_faces_that_doubles_err_in_have_colours_of_their_own(open_page, tmp_path):
    def change(data):
        data["doubles"] = {"missing": packed([0, *range(10, 50)]), "extra": packed([3])}

    page = open_page("see", corpus / "general" / "two_rooms.off", "--eye", "1,1,2", change=change)
    assert page.text("#errors") == "missing: " + ", ".join(map(str, [0, *range(10, 39)])) + " …. shown: 3."
    own = looks_of(page, 0)
    above = {face: k for k, face in enumerate(page.numbers("polygons", "faces")) if k >= page.data["base"]}
    one, two = next((above[face], above[face + 6]) for face in above if face + 6 in above)
    assert shares(looks_of(page, one)) != pytest.approx(shares(looks_of(page, two)), abs=0.02), "six colours, of each three"
    page.one("#doubles").click()
    faces = page.numbers("polygons", "faces")
    assert has_colours(page, {k: front if face in (0, *range(10, 50)) else source if face == 3 else hidden if k < page.data["base"] else face_colour
                              for k, face in enumerate(faces)})
    page.one("#doubles").click()
    assert looks_of(page, 0) == own


def test_arcs_have_colours_and_lead_to_other_faces(open_page, tmp_path):
    scene = tmp_path / "soup.off"
    run("generate", "soup", "--size", 500, "--out", scene)
    page = open_page("graph", scene)
    arcs = json.loads(run("graph", scene, "--arcs", "--json", "-"))["result"]["arc_list"]
    in_front, behind = {a[0][0] for a in arcs if a[1] == [7, 0]}, {a[1][0] for a in arcs if a[0] == [7, 0]}
    assert in_front & behind and in_front - behind and behind - in_front
    page.js("sightline.select(7)")
    assert has_colours(page, {k: (250, 250, 245) if k == 7 else undecided if k in in_front & behind else front if k in in_front
                              else source if k in behind else face_colour for k in range(500)})
    for part, faces in zip(page.all("#arcs ul.list"), (in_front, behind)):
        items = page.js("return [...arguments[0].children].map(item => item.textContent)", part)
        assert len(items) == min(101, len(faces)) and set(items[:100]) <= {f"face {k}" for k in faces}
        assert len(faces) <= 100 or items[100] == f"and {len(faces) - 100} more"
    item = page.all("#arcs ul.list button")[2]
    k = int(item.text.split()[1])
    page.js("arguments[0].click()", item)
    assert page.js("return sightline.selected") == k and page.text("#selected-name").startswith(f"face {k}, ")

    def change(data):
        del data["arcs"]
        data["components"] = packed([4, 0, 4])

    page = open_page("graph", corpus / "general" / "three_bars.off", name="bars.html", change=change)
    page.all("section ul.list button")[0].click()
    assert len(ends_of(page, "cycle")) == 2 * (len(sides_of(page, 0)) + len(sides_of(page, 2)))
    assert has_colour(page, 0, front) and has_colour(page, 1, face_colour) and has_colour(page, 2, front)
    page.js("sightline.select(0)")
    assert page.text("#selected-name") == "face 0, component 5, a cycle of 2"
    assert "Arcs are not known" in page.text("#selection") and has_colour(page, 0, front)


def test_one_looks_from_the_path_and_back(open_page):
    def change(data):
        data["frames"]["at_infinity"] = packed([2])
        without(data, {1, 4})

    for changed in (None, change):
        page = open_page("cutset", corpus / "general" / "cube.off", "--orbit", 3, name=f"{changed is None}.html", change=changed)
        places = [tuple(place) for place in page.data["frames"]["places"]]
        assert ends_of(page, "path") == list(zip(places, places[1:]))
        on, numbers = page.numbers("frames", "on_view"), page.numbers("polygons", "numbers") if changed else range(6)
        edges = {key: page.numbers("edges", key) for key in page.data["edges"]}
        before = set()
        for n in (1, 2, 3):
            page.slide(n)
            is_on = {k for k in numbers if on[(6 * (n - 1) + k) // 8] >> (6 * (n - 1) + k) % 8 & 1}
            assert is_on - before, "a face has just become on-view"
            for k, number in enumerate(numbers):
                wanted = hidden if number not in is_on else new if n > 1 and number not in before else seen
                assert has_colour(page, k, wanted), (n, k)
            before = is_on
            cut = [sides_of(page, list(numbers).index(a))[c] for a, c, b in zip(edges["pieces"], edges["corners"], edges["others"])
                   if a in numbers and b in numbers and (a in is_on) != (b in is_on)]
            assert ends_of(page, "cut") == cut
            assert page.text("#frame").startswith(f"{len(is_on)} polygons on-view" + (" of those drawn, " if changed else ", "))
            assert page.text("#viewpoint").startswith(f"{'direction' if changed and n == 2 else 'viewpoint'} {n}: ")
            assert len(ends_of(page, "eye")) == 4 and ends_of(page, "eye")[3][0] == places[n - 1]
        assert page.js("return sightline.camera.atEye") is False
        page.one("#follow").click()
        assert page.js("return sightline.camera.atEye") is True and ends_of(page, "eye") == []
        page.one("#follow").click()
        assert page.js("return sightline.camera.atEye") is False and len(ends_of(page, "eye")) == 4
        if changed:
            page.js("sightline.select(1)")
            assert page.text("#selected-name").startswith("face 2")


def test_a_wall_hides_lines_behind_it_from_an_eye_close_to_it(open_page):
    def change(data):
        data["frames"]["places"] = [[0.6, 0, 0], [-0.5, -0.2, 0], [-0.5, 0.2, 0.02]]

    page = open_page("cutset", corpus / "general" / "cube.off", "--orbit", 3, change=change)
    page.one("#follow").click()
    pixel, k = page.js("""
        const view = document.getElementById('view'), gl = view.getContext('webgl2'), pixels = new Uint8Array(4 * 121);
        sightline.draw();
        const scale = view.width / view.clientWidth, [x, y] = sightline.onCanvas([-0.5, 0, 0.01]);
        gl.readPixels(Math.round(x * scale) - 5, view.height - 6 - Math.round(y * scale), 11, 11, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        return [[...pixels], sightline.pickAt(x, y)];
        """)
    assert page.js("return sightline.camera.atEye") is True and k >= 0
    assert all(abs(pixel[i + c] - own) < 3 for i in range(0, len(pixel), 4) for c, own in enumerate(looks_of(page, k)))


def test_a_path_that_leads_far_behind_the_scene_is_drawn_as_far_as_it_goes(open_page):
    far = [[-40, 14, 3], [-60, 24, 5]]

    def change(data):
        data["frames"]["places"] = [[3, 0, 0], *far]

    page = open_page("cutset", corpus / "general" / "cube.off", "--orbit", 3, change=change)
    page.one("#follow").click()
    pixels = page.js("""
        const view = document.getElementById('view'), gl = view.getContext('webgl2'), pixels = new Uint8Array(4 * 121);
        sightline.camera.field = 60;
        sightline.draw();
        const scale = view.width / view.clientWidth, [x, y] = sightline.onCanvas(arguments[0]);
        gl.readPixels(Math.round(x * scale) - 5, view.height - 6 - Math.round(y * scale), 11, 11, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        return [...pixels];
        """, [(a + b) / 2 for a, b in zip(*far)])
    assert page.js("return sightline.camera.atEye") is True
    assert len(set(zip(*[iter(pixels)] * 4))) > 1, "nothing but paper"


def test_a_source_far_from_the_scene_is_drawn(open_page):
    page = open_page("weak", corpus / "general" / "cube.off", "--from", "9,6,-5 11,6,-5 11,8,-5 9,8,-5")  # behind the cube, to the right
    pixel = page.js("""
        const view = document.getElementById('view'), gl = view.getContext('webgl2'), pixel = new Uint8Array(4);
        sightline.drawing.backs = true;
        sightline.draw();
        const scale = view.width / view.clientWidth, [x, y] = sightline.middleOf(arguments[0]);
        gl.readPixels(Math.round(x * scale), view.height - 1 - Math.round(y * scale), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        return [...pixel];
        """, page.data["base"])
    assert pixel[2] > 1.5 * pixel[0], "blue, as sources are"


def test_faces_that_are_left_out_are_not_taken_for_others(open_page):
    arcs = json.loads(run("graph", corpus / "general" / "three_bars.off", "--arcs", "--json", "-"))["result"]["arc_list"]
    ends = {k: [[a[0][0] for a in arcs if a[1][0] == k], [a[1][0] for a in arcs if a[0][0] == k]] for k in range(18)}
    chosen = max(ends, key=lambda k: len(ends[k][0]))
    left = {*ends[chosen][0][:2]}
    assert len(left) == 2
    page = open_page("graph", corpus / "general" / "three_bars.off", change=lambda data: without(data, left))
    page.js("sightline.select(arguments[0])", chosen - sum(k < chosen for k in left))
    assert page.text("#selected-name").startswith(f"face {chosen}, ")
    lists = [[b.text for b in part.find_elements("css selector", "button")] for part in page.all("#arcs ul.list")]
    assert lists == [[f"face {k}" for k in list_ if k not in left] for list_ in ends[chosen]]
    assert [int(p.text.split(": ")[1]) for p in page.all("#arcs p.row")] == [len(list_) for list_ in ends[chosen]], "those that are not drawn count"


def test_cells_show_what_looks_into_them(open_page):
    page = open_page("cells", corpus / "general" / "two_rooms.off")
    rooms = {face for cell in page.data["cells"] if cell["kind"] == "room" for face in unpacked(cell["faces"])}
    label = next(label for label in page.all("#panel label") if "no room" in label.text)
    buttons = next(section for section in page.all("#panel section") if section.text.lower().startswith("all cells")).find_elements("css selector", "button")
    for cell, made in list(zip(page.data["cells"], buttons, strict=True))[:3] + [(page.data["cells"][-1], buttons[-1])]:
        page.js("arguments[0].click()", made)
        own = set(unpacked(cell["faces"]))
        assert page.text("#cell p") == f"cell {cell['cell']}, {cell['kind']}, about {cell['inside']}: {len(own)} faces look into it"
        assert shown(page) == sorted(rooms | own)
        for k in sorted(own)[:2] + sorted(rooms - own)[:2]:
            assert has_colour(page, k, seen if k in own else face_colour)
        for layer, key in (("cell", "walls"), ("portals", "portals")):
            assert ends_of(page, layer) == segments_of(unpacked(cell[key]))
    label.click()
    assert shown(page) == list(range(142)) and page.js("return sightline.drawing.backs") is False
    label.click()


def test_of_a_face_the_cells_that_see_it(open_page):
    def change(data):
        data["cells"][1]["undecided"] = packed([unpacked(data["cells"][1]["visible"])[0] + 1000, unpacked(data["rooms"])[0], unpacked(data["rooms"])[1]])
        data["cells"][1]["visible"] = packed(unpacked(data["rooms"])[2:4])

    page = open_page("pvs", corpus / "general" / "two_rooms.map", change=change)
    cells, rooms = page.data["cells"], page.numbers("rooms")
    page.all("section ul.list button")[1].click()
    assert page.text("#cell").endswith(": sees 2 faces, 3 undecided")
    for i, (name, colour) in enumerate([("undecided", undecided)] * 2 + [("visible", seen)] * 2 + [("hidden", hidden)]):
        page.js("sightline.select(arguments[0])", rooms[i])
        assert page.text("#selected-name") == f"face {rooms[i]}, {name}" and has_colour(page, rooms[i], colour)
        by = [cell["cell"] for cell in cells if rooms[i] in unpacked(cell["visible"])]
        assert page.text("#seen-from p") == f"Seen from {len(by)} of {len(cells)} cells:"
        assert page.texts("#seen-from button") == [f"cell {cell}" for cell in by]
    assert ends_of(page, "cell") == segments_of(unpacked(cells[1]["walls"]))
    assert shown(page) == sorted(rooms)
    next(label for label in page.all("#panel label") if "no cell" in label.text).click()
    assert shown(page) == list(range(71))


def test_a_result_has_other_colours_where_it_is_turned_round(open_page, tmp_path):
    small = tmp_path / "small.off"
    small.write_text(
        "OFF 8 6 0\n" + "".join(f"{x} {y} {z}\n" for x in (0.25, 0.5) for y in (0.25, 0.5) for z in (0.25, 0.5))
        + "4 0 1 3 2\n4 4 6 7 5\n4 0 4 5 1\n4 2 3 7 6\n4 0 2 6 4\n4 1 5 7 3\n")
    page = open_page("boolean", "difference", corpus / "general" / "cube.off", small)
    groups, faces, of = (page.numbers(*keys) for keys in (("polygons", "groups"), ("polygons", "faces"), ("operand_faces",)))
    assert sorted(groups) == [0] * 6 + [3] * 6 and page.data["groups"][3]["name"] == "small.off, turned round"
    for k in range(12):
        page.js("sightline.select(arguments[0])", k)
        assert page.text("#selected-name") == f"face {faces[k]}: {page.data['groups'][groups[k]]['name']}, face {of[faces[k]]} of its solid"
        assert has_colour(page, k, [c + (245 - c) * 0.55 for c in source] if groups[k] else [c + (245 - c) * 0.2 for c in front])


def test_what_was_not_done_is_said(open_page):
    def change(data):
        data["methods"][1]["status"] = "refused"
        data["methods"][0]["errors"] = {"wrong_pixels": 1}
        del data["methods"][0]["missing"], data["methods"][0]["extra"], data["methods"][1]["missing"], data["methods"][1]["extra"]

    page = open_page("compare", corpus / "general" / "two_rooms.off", "see", "--eye", "1,1,2", "--sizes", 16, "--bits", 16, change=change)
    assert page.js("return sightline.camera.atEye") is True
    items = page.all("#methods button")
    assert items[1].text == f"{page.data['methods'][1]['name']}: refused" and items[0].text.endswith("MB; wrong pixels 1")


# ---- What needs no browser


def test_mutants_stand_on_texts_of_pages_and_are_found_by_tests():
    here = Path(__file__).parent
    texts = {path.name: path.read_text() for path in (here.parents[1] / "apps" / "page").glob("*.*") if path.suffix in (".js", ".css", ".html")}
    tests = "".join(path.read_text() for path in here.glob("test_*.py"))
    for mutant in json.loads((here / "mutants.json").read_text()):
        assert texts[mutant["file"]].count(mutant["text"]) == 1 == sum(text.count(mutant["text"]) for text in texts.values()), mutant
        assert f"def {mutant['found']}(" in tests if "found" in mutant else mutant["why"], mutant


def test_a_page_stays_small(tmp_path):
    scene, path = tmp_path / "terrain.off", tmp_path / "page.html"
    run("generate", "terrain", "--size", 20000, "--out", scene)
    run("cutset", scene, "--orbit", 500, "--html", path)
    data = block_of(path)
    triangles = data["polygons"]["count"]
    assert triangles == 20000 and path.stat().st_size < 1e6 + 40 * triangles
    assert any("evenly" in note for note in data["notes"]) and any("rounded" in note for note in data["notes"])


def test_a_page_holds_no_other_tag_and_asks_for_nothing(tmp_path):
    scene = tmp_path / "<!--<script> & 'x' ünï.off"
    scene.write_text((corpus / "general" / "cube.off").read_text())
    run("order", scene, "--html", tmp_path / "a page, <b>.html")
    text = (tmp_path / "a page, <b>.html").read_text()
    assert text.count("</script") == 2 and "http" not in text and " src=" not in text
    assert block_of(tmp_path / "a page, <b>.html")["scene"].endswith("ünï.off")


def test_a_page_goes_where_outputs_go(tmp_path):
    cube = corpus / "general" / "cube.off"
    assert run("order", cube, "--html", "-").startswith("<!DOCTYPE html>")
    assert "-: that is where --json writes" in run("order", cube, "--json", "-", "--html", "-", code=2)
    said = run("order", cube, "--html", tmp_path / "missing" / "page.html", code=3)
    assert said.count("\n") == 1 and "page.html" in said
    assert ".html" in run("order", cube, "--html", tmp_path / "page.svg", code=2)
    assert "--decision-tree" in run("cutset", cube, "--decision-tree", "--html", tmp_path / "page.html", code=2)
    assert list(tmp_path.iterdir()) == []


def test_scenes_without_faces_far_away_and_out_of_range_have_pages(open_page, tmp_path):
    nothing = tmp_path / "nothing.off"
    nothing.write_text("OFF\n0 0 0\n")
    for words in (["order"], ["see"], ["graph"], ["cutset", "--orbit", 2]):
        page = open_page(words[0], nothing, *words[1:])
        assert page.data["polygons"]["count"] == 0 and "no face" in page.text("#selection")
    for shift, scale in (("1e12,1e12,-1e12", "1"), ("0,0,0", "2^900"), ("0,0,0", "2^-900")):
        scene = tmp_path / "far.qoff"
        run("generate", "rooms", "--size", 2, "--offset", shift, "--scale", scale, "--out", scene)
        assert open_page("order", scene).is_drawn(), (shift, scale)
