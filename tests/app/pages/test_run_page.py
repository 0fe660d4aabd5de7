"""The page of a run in headless Chromium: it draws, plays, scrubs, switches worlds, and asks the network for nothing.

One file, since starting the browser costs more than all its checks."""

import base64
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

SOURCE = pathlib.Path(__file__).resolve().parents[3]
sys.path[:0] = [str(SOURCE / "src/app"), str(SOURCE / "tests/app/reports"), str(SOURCE / "tests/app/pages")]
import browser  # noqa: E402
import page_sample  # noqa: E402
from reports.one_run import run_page  # noqa: E402
from reports.runs import Run  # noqa: E402

SKIPPED = 77
if not browser.is_there():
    print("chromium, chromium-driver or python3-selenium is not installed: skipped")
    sys.exit(SKIPPED)

from selenium import webdriver  # noqa: E402
from selenium.webdriver.chrome.service import Service  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402
from selenium.webdriver.support.ui import Select, WebDriverWait  # noqa: E402

FLAGS = [flag for flag in browser.FLAGS if "window-size" not in flag] + ["--window-size=1000,900"]
STILLS = str(SOURCE / "jobs/stills.sh")
WORLDS, FRAMES = 4, 8


def write_page(path, worlds=WORLDS, frames=FRAMES, most_bytes=run_page.MOST_POSE_BYTES):
    """The page of an artificial run, whose file lies beside it."""
    run = Run(page_sample.write(path + ".h5", worlds, frames))
    with open(path, "w", encoding="utf-8") as file:
        file.write(run_page.text_of(run, page_sample.SUMMARY, most_bytes))


def pixels(png):
    """Width, height and the rows (bytes, RGB or RGBA) of an 8-bit PNG without interlace."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at, data = 8, b""
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        body = png[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
        elif kind == b"IDAT":
            data += body
        at += 12 + length
    assert depth == 8 and colour in (2, 6)
    step = 3 if colour == 2 else 4
    raw, rows, above = zlib.decompress(data), [], bytes(width * step)
    for y in range(height):
        start = y * (width * step + 1)
        row = unfilter(raw[start], bytearray(raw[start + 1:start + 1 + width * step]), above, step)
        rows.append(row)
        above = row
    return width, height, step, rows


def unfilter(kind, row, above, step):
    """One row of PNG with its filter undone (PNG specification, section 9)."""
    for i in range(len(row)):
        a = row[i - step] if i >= step else 0
        b, c = above[i], above[i - step] if i >= step else 0
        if kind == 1:
            row[i] = (row[i] + a) & 255
        elif kind == 2:
            row[i] = (row[i] + b) & 255
        elif kind == 3:
            row[i] = (row[i] + (a + b) // 2) & 255
        elif kind == 4:
            p = a + b - c
            nearest = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            row[i] = (row[i] + nearest) & 255
    return bytes(row)


def colours(png):
    """The number of pixels of each RGB colour."""
    width, _, step, rows = pixels(png)
    counts = {}
    for row in rows:
        for x in range(0, width * step, step):
            key = row[x:x + 3]
            counts[key] = counts.get(key, 0) + 1
    return counts


def read(path):
    with open(path, "rb") as file:
        return file.read()


def share(counts, wanted):
    return sum(count for (r, g, b), count in counts.items() if wanted(r, g, b)) / sum(counts.values())


def is_car(r, g, b):
    return b > 80 and b > 1.3 * g and r < 0.3 * b


def is_human(r, g, b):
    return r > 110 and r > 1.25 * g and g > 2 * b


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.page = os.path.join(cls.folder.name, "page.html")
        write_page(cls.page)
        options = webdriver.ChromeOptions()
        options.binary_location = browser.CHROMIUM
        for flag in FLAGS + ["--user-data-dir=" + os.path.join(cls.folder.name, "profile")]:
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        cls.driver = webdriver.Chrome(service=Service(browser.DRIVER), options=options)

    @classmethod
    def tearDownClass(cls):
        cls.driver.quit()
        cls.folder.cleanup()

    def open(self, address="", page=None):
        self.driver.get("about:blank")
        self.driver.get_log("browser")
        self.driver.get_log("performance")
        self.driver.get("file://" + (page or self.page) + address)
        self.wait(lambda: self.js("return typeof pb !== 'undefined' && Boolean(pb.replay)"))

    def wait(self, condition):
        WebDriverWait(self.driver, browser.WAIT_S, poll_frequency=0.1).until(lambda _: condition())

    def js(self, script, *args):
        return self.driver.execute_script(script, *args)

    def element(self, name):
        return self.driver.find_element(By.ID, name)

    def frame(self):
        return self.js("return pb.replay.currentFrame()")

    def snapshot(self):
        return base64.b64decode(self.js("pb.replay.draw(); return pb.replay.stage.canvas.toDataURL('image/png')").split(",", 1)[1])

    def test_loads_without_a_message_on_the_console(self):
        self.open()
        severe = [entry for entry in self.driver.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")]
        # The software renderer warns about reading pixels back slowly; that is no concern of the page.
        self.assertEqual([e for e in severe if "GPU stall" not in e["message"]], [])

    def test_asks_for_nothing_but_itself(self):
        self.open()
        asked = [entry["message"] for entry in self.driver.get_log("performance")
                 if '"Network.requestWillBeSent"' in entry["message"]]
        self.assertTrue(any("file://" in message for message in asked))  # the log does see requests
        self.assertEqual([m for m in asked if '"url":"http' in m], [])
        self.assertEqual(self.js("return performance.getEntriesByType('resource')"
                                 ".filter((r) => !r.name.startsWith('data:')).map((r) => r.name)"), [])

    def test_canvas_shows_the_actors(self):
        self.open("#world=0&frame=0")
        counts = colours(self.snapshot())
        self.assertGreater(len(counts), 200)
        self.assertGreater(share(counts, is_car), 0.01)
        self.assertGreater(share(counts, is_human), 0.001)

    def test_every_body_kind_has_its_colour_in_the_legend(self):
        self.open()
        legend = self.element("legend").text.split("\n")
        self.assertEqual(" ".join(legend).split(), ["ramp", "wall", "car", "human", "projectile"])

    def test_play_advances_and_pause_holds(self):
        self.open("#world=0&frame=0")
        self.js("pb.replay.speed = 0.25")
        self.element("play").click()
        self.wait(lambda: self.frame() > 0)
        self.element("play").click()
        self.assertFalse(self.js("return pb.replay.playing"))
        held = self.js("return pb.replay.poses.timeAt(pb.replay.frame)")
        time.sleep(0.3)
        self.assertEqual(self.js("return pb.replay.poses.timeAt(pb.replay.frame)"), held)

    def test_play_starts_again_after_the_end(self):
        self.open("#world=0&frame=%d" % (FRAMES - 1))
        self.js("pb.replay.speed = 0.1; pb.replay.play()")
        self.wait(lambda: self.frame() == FRAMES)
        self.wait(lambda: self.frame() < FRAMES)

    def test_scrub_goes_to_the_asked_frame(self):
        self.open("#world=0")
        self.js("const s = document.getElementById('scrub'); s.value = 5; s.dispatchEvent(new Event('input'))")
        self.assertEqual(self.frame(), 5)
        self.assertIn("frame 5 of %d" % FRAMES, self.element("frame-label").text)
        self.assertIn("0.150 s", self.element("frame-label").text)

    def test_keyboard_steps_jumps_and_plays(self):
        self.open("#world=0&frame=2")
        body = self.driver.find_element(By.TAG_NAME, "body")
        body.send_keys(Keys.ARROW_RIGHT)
        self.assertEqual(self.frame(), 3)
        body.send_keys(Keys.ARROW_LEFT, Keys.ARROW_LEFT)
        self.assertEqual(self.frame(), 1)
        body.send_keys(Keys.END)
        self.assertEqual(self.frame(), FRAMES)
        body.send_keys(Keys.HOME)
        self.assertEqual(self.frame(), 0)
        body.send_keys(Keys.SPACE)
        self.assertTrue(self.js("return pb.replay.playing"))

    def test_shows_the_recorded_pose(self):
        self.open("#world=0&frame=4")
        # The car starts at x = -4 m and drives at 20 m/s; frame 4 is step 12 at dt = 0.01 s.
        x, y, z = self.js("return [...pb.replay.poses.position.subarray(0, 3)]")
        self.assertEqual(self.js("return pb.replay.data.bodyNames[0]"), "car.chassis")
        self.assertAlmostEqual(x, -4 + 20 * 0.12, places=5)  # single precision
        self.assertAlmostEqual(z, 0.75, places=5)

    def test_interpolates_between_frames_with_unit_quaternions(self):
        self.open("#world=0")
        self.js("pb.replay.setFrame(4.5)")
        self.assertAlmostEqual(self.js("return pb.replay.poses.position[0]"), -4 + 20 * 0.135, places=5)
        wheel = self.js("return [...pb.replay.poses.orientation.subarray(4, 8)]")
        self.assertAlmostEqual(sum(c * c for c in wheel), 1, places=5)  # single precision

    def test_world_select_changes_what_is_shown(self):
        self.open("#world=0&frame=3")
        first = self.snapshot()
        Select(self.element("world")).select_by_value("3")
        self.assertEqual(self.js("return pb.replay.world"), 3)
        self.assertIn("world 3", self.element("view-label").text)
        self.assertNotEqual(first, self.snapshot())
        Select(self.element("world")).select_by_value("all")
        self.assertEqual(self.js("return pb.replay.world"), "all")
        # Four cars from farther away: more bodies, each smaller.
        self.assertGreater(share(colours(self.snapshot()), is_car), 0.005)

    def test_dragging_orbits_and_reset_returns(self):
        self.open("#world=0")
        before = self.js("return pb.replay.stage.camera.position.toArray()")
        canvas = self.element("canvas")
        webdriver.ActionChains(self.driver).drag_and_drop_by_offset(canvas, 120, 30).perform()
        after = self.js("return pb.replay.stage.camera.position.toArray()")
        self.assertGreater(max(abs(a - b) for a, b in zip(before, after)), 0.5)
        self.element("reset-view").click()
        for a, b in zip(before, self.js("return pb.replay.stage.camera.position.toArray()")):
            self.assertAlmostEqual(a, b, places=6)

    def test_follow_keeps_the_bodies_in_the_picture(self):
        self.open("#world=0&frame=0&follow=1")
        before = self.js("return {position: pb.replay.stage.camera.position.toArray(), target: pb.replay.stage.controls.target.toArray()}")
        self.js("pb.replay.setFrame(%d)" % FRAMES)
        after = self.js("return {position: pb.replay.stage.camera.position.toArray(), target: pb.replay.stage.controls.target.toArray()}")
        moved = [a - b for a, b in zip(after["target"], before["target"])]
        self.assertGreater(moved[0], 0.3)  # the car drives along +x
        for k in range(3):  # place and target move together
            self.assertAlmostEqual(after["position"][k] - before["position"][k], moved[k], places=6)

    def test_address_makes_a_still(self):
        self.open("#frame=6&world=1&still=1&camera=8,-9,6,0,0,1")
        self.assertEqual(self.frame(), 6)
        self.assertEqual(self.js("return pb.replay.world"), 1)
        self.assertEqual([round(c, 6) for c in self.js("return pb.replay.stage.camera.position.toArray()")], [8, -9, 6])
        self.assertFalse(self.element("play").is_displayed())

    def test_plots_are_drawn(self):
        self.open()
        titles = [h.text for h in self.driver.find_elements(By.CSS_SELECTOR, ".plot h2")]
        self.assertEqual(titles, ["Frame time", "Phases", "Islands", "Islands per world", "Contacts",
                                  "Contacts per world", "Energy", "Momentum", "Joint gap", "Penetration"])
        for canvas in self.driver.find_elements(By.CSS_SELECTOR, ".plot canvas"):
            drawn = base64.b64decode(self.js("return arguments[0].toDataURL()", canvas).split(",", 1)[1])
            self.assertGreater(len(colours(drawn)), 20)

    def test_the_plots_show_the_frame_of_the_replay_and_choose_it(self):
        self.open("#world=0&frame=5")
        cursors = "return [...pb.framePlots.charts].map((chart) => chart.cursor)"
        self.assertEqual(set(self.js(cursors)), {5})
        self.assertEqual(len(self.js(cursors)), 9, "all plots but that of the phases")
        # A click at frame 3 of a plot.
        at = self.js("const chart = [...pb.framePlots.charts][0];"
                     "chart.canvas.scrollIntoView({block: 'center'});"
                     "const box = chart.canvas.getBoundingClientRect();"
                     "return [chart.scales.x.getPixelForValue(3) - box.width / 2, 0]")
        canvas = self.driver.find_element(By.CSS_SELECTOR, ".plot canvas")
        webdriver.ActionChains(self.driver).move_to_element_with_offset(canvas, round(at[0]), 0).click().perform()
        self.wait(lambda: self.frame() == 3)  # Chart.js hears of a click with the next picture
        self.assertEqual(self.js("return pb.replay.numberOf(pb.replay.currentFrame())"), 3)
        self.assertEqual(set(self.js(cursors)), {3})

    def test_a_focused_plot_says_its_value_at_the_frame_that_the_arrows_choose(self):
        self.open("#world=0&frame=1")
        canvas = self.driver.find_elements(By.CSS_SELECTOR, ".plot canvas")[8]  # joint gap: 0.1 mm a frame
        self.js("arguments[0].focus()", canvas)
        canvas.send_keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
        self.assertEqual(self.frame(), 3)
        said = self.js("return arguments[0].parentElement.querySelector('.readout').innerText", canvas)
        self.assertIn("frame 3", said)
        self.assertIn("mean: 0.3", said)

    def test_header_tells_the_run(self):
        self.open()
        self.assertEqual(self.element("scene").text, "Sample <crash>")
        self.assertEqual(self.element("state-hash").text, "0123456789abcdef")
        self.assertEqual(self.element("complete").text, "complete")
        self.js("document.querySelector('#provenance details').open = true")
        self.assertIn("iterations", self.element("provenance").text)

    def test_fits_a_phone(self):
        self.open()
        self.driver.set_window_size(500, 900)  # Chromium's narrowest window
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": 390, "height": 844, "deviceScaleFactor": 1, "mobile": True})
        try:
            self.open()
            self.assertLessEqual(self.js("return document.documentElement.scrollWidth"), 390)
        finally:
            self.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
            self.driver.set_window_size(1000, 900)

    def test_says_what_a_small_page_leaves_out(self):
        small = os.path.join(self.folder.name, "small.html")
        write_page(small, most_bytes=40000)
        self.open(page=small)
        self.assertIn("of 4 worlds", self.element("replay-note").text)
        self.assertLess(self.js("return pb.replay.data.numWorlds"), 4)

    def test_a_run_without_frames_shows_its_start(self):
        empty = os.path.join(self.folder.name, "empty.html")
        write_page(empty, worlds=1, frames=0)
        self.open(page=empty)
        self.assertEqual(self.js("return pb.replay.data.numFrames"), 1)
        self.assertGreater(share(colours(self.snapshot()), is_car), 0.01)
        self.assertEqual([e for e in self.driver.get_log("browser") if e["level"] == "SEVERE"], [])


class StillsTest(unittest.TestCase):
    def test_renders_one_picture_a_frame(self):
        with tempfile.TemporaryDirectory() as folder:
            page = os.path.join(folder, "run.html")
            write_page(page, worlds=2)
            subprocess.run([STILLS, "--world", "0", "--size", "400x225", page, folder, "0", "8"], check=True)
            first, last = (read(os.path.join(folder, "run-%s.png" % f)) for f in ("000", "008"))
            self.assertEqual(pixels(first)[:2], (400, 225))
            self.assertGreater(share(colours(first), is_car), 0.01)
            self.assertNotEqual(first, last)

    def test_refuses_a_missing_page(self):
        done = subprocess.run([STILLS, "no-such-page.html", tempfile.gettempdir(), "0"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("no-such-page.html", done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
