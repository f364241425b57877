"""A browser for all tests, and pages that the program writes."""

import base64
import json
import os
import re
import subprocess
from pathlib import Path

import pytest
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

program = os.environ["SIGHTLINE_PROGRAM"]
corpus = Path(__file__).parents[1] / "corpus"
block = re.compile(r'(<script type="application/json" id="data">)(.*?)(</script>)', re.S)


def run(*words, code=0):
    """What the program prints."""
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True, timeout=100)
    assert done.returncode == code, f"{words}: exit {done.returncode}\n{done.stdout}\n{done.stderr}"
    return done.stdout + done.stderr


def block_of(path):
    """The block of data of a page."""
    return json.loads(block.search(Path(path).read_text())[2])


def unpacked(numbers):
    return list(memoryview(base64.b64decode(numbers["base64"])).cast({"u8": "B", "u16": "H", "u32": "I", "f32": "f"}[numbers["type"]]))


def packed(numbers):
    """Of a list of whole numbers, as pages hold them."""
    return {"type": "u32", "base64": base64.b64encode(b"".join(n.to_bytes(4, "little") for n in numbers)).decode()}


class Page:
    """A page that is open in the browser."""

    def __init__(self, browser, path):
        self.browser, self.path, self.data = browser, path, block_of(path)
        browser.get_log("browser")
        browser.get(path.as_uri())
        assert self.js("return document.documentElement.dataset.ready") == "yes", browser.get_log("browser")

    @classmethod
    def within(cls, browser, data):
        """That of a frame which the browser is in."""
        page = cls.__new__(cls)
        page.browser, page.data = browser, data
        return page

    def js(self, text, *arguments):
        return self.browser.execute_script(text, *arguments)

    def one(self, selector):
        return self.browser.find_element("css selector", selector)

    def all(self, selector):
        return self.browser.find_elements("css selector", selector)

    def text(self, selector):
        """What one reads there."""
        return self.js("const e = document.querySelector(arguments[0]); return e.checkVisibility() ? e.innerText.trim() : ''", selector)

    def texts(self, selector):
        return self.js("return [...document.querySelectorAll(arguments[0])].map(e => e.checkVisibility() ? e.innerText.trim() : '')", selector)

    def press(self, key):
        self.js("document.dispatchEvent(new KeyboardEvent('keydown', {key: arguments[0], bubbles: true}))", key)

    def slide(self, value):
        self.js("const s = document.getElementById('slider'); s.value = arguments[0]; s.dispatchEvent(new Event('input'))", value)

    def click_on(self, polygon):
        """Clicks on the middle of a polygon, as a hand does."""
        self.click_at(*self.js("return sightline.middleOf(arguments[0])", polygon))

    def click_at(self, x, y):
        actions = webdriver.ActionChains(self.browser, duration=0)
        view = self.one("#view")
        actions.move_to_element_with_offset(view, x - view.size["width"] / 2, y - view.size["height"] / 2).click().perform()

    def mouse(self, kind, x, y, **more):
        """What a mouse does in the window, whose corner is the scene's."""
        self.browser.execute_cdp_cmd("Input.dispatchMouseEvent", {"type": kind, "x": x, "y": y, **more})

    def drag(self, start, by, **more):
        button = {"button": "left", "buttons": 1, "clickCount": 1, **more}
        self.mouse("mousePressed", *start, **button)
        self.mouse("mouseMoved", start[0] + by[0], start[1] + by[1], **button)
        self.mouse("mouseReleased", start[0] + by[0], start[1] + by[1], **button)

    def drawn(self):
        """Waits for what was asked to be drawn."""
        self.js("return new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def numbers(self, *keys):
        """Numbers of the block of data."""
        found = self.data
        for key in keys:
            found = found[key]
        return unpacked(found)

    def picture(self):
        """Of a screenshot of the scene: the share of pixels that are not the paper, and how many colours there are."""
        self.js("for (const id of ['tools', 'hover']) document.getElementById(id).style.visibility = 'hidden'")
        self.drawn()
        return self.browser.execute_async_script(
            """
            const done = arguments[1], image = new Image();
            image.onload = () => {
              const sheet = document.createElement('canvas');
              sheet.width = image.width, sheet.height = image.height;
              const pen = sheet.getContext('2d');
              pen.drawImage(image, 0, 0);
              const all = new Uint32Array(pen.getImageData(0, 0, image.width, image.height).data.buffer), counts = new Map();
              for (const p of all) counts.set(p, (counts.get(p) || 0) + 1);
              const paper = getComputedStyle(document.body).backgroundColor.match(/\\d+/g).map(Number);
              done([1 - (counts.get((255 << 24 | paper[2] << 16 | paper[1] << 8 | paper[0]) >>> 0) || 0) / all.length, counts.size]);
            };
            image.src = 'data:image/png;base64,' + arguments[0];
            """,
            self.one("#view").screenshot_as_base64,
        )

    def is_drawn(self, least=0.05):
        share, colours = self.picture()
        return share > least and colours > 8

    def close(self):
        errors = [entry for entry in self.browser.get_log("browser")
                  if entry["level"] in ("SEVERE", "WARNING") and "Performance" not in entry["message"]]
        assert errors == []


@pytest.fixture(scope="session")
def browser():
    options = Options()
    options.binary_location = os.environ["SIGHTLINE_CHROMIUM"]
    for word in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                 "--window-size=1100,760", "--disable-extensions",
                 # A window put together without the software renderer, and borders of pixels: drawing is half of what the tests take.
                 "--disable-gpu-compositing", "--webgl-antialiasing-mode=none"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(os.environ["SIGHTLINE_CHROMEDRIVER"]))
    driver.set_script_timeout(30)
    yield driver
    driver.quit()


@pytest.fixture
def open_page(browser, tmp_path):
    """open_page(command, scene, ...) runs the program and opens what it wrote; no page may have said anything on the console."""
    opened = []

    def opener(*words, code=0, name="page.html", after=(), change=None):
        path = tmp_path / name
        run(*words, "--html", path, *after, code=code)
        if change:  # of the data, as another program may write them
            data = block_of(path)
            change(data)
            path.write_text(block.sub(lambda _: _[1] + json.dumps(data).replace("<", "\\u003c") + _[3], path.read_text()))
        opened.append(Page(browser, path))
        return opened[-1]

    yield opener
    for page in opened:
        page.close()


@pytest.fixture(scope="session")
def town(tmp_path_factory):
    path = tmp_path_factory.mktemp("scenes") / "town.qoff"
    run("generate", "city_rotated", "--size", 25, "--seed", 4, "--out", path)
    return path
