"""Every kind of page in Chromium, as wide as a desk and as a phone, light and dark: no text on other text, beyond its box or
the window; every contrast is enough; all that a mouse reaches the keyboard reaches. Broken pages show that this is noticed.

With PBMPI_PAGE_SHOTS=FOLDER the pictures stay there."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import browser  # noqa: E402
from harness import BIN, PAPER, PBMPI, SOURCE  # noqa: E402

SKIPPED = 77
TIMEOUT_S = 280  # a hang, not a slow run
BALL = """title = "a ball that falls on a plane"
[[actor]]
name = "ground"
type = "ground"
[[actor]]
name = "ball"
type = "sphere"
radius = 0.1
mass = 1
position = [0, 0, 0.2]
"""
STABILITY = ["hard/free/tumbling_box", "hard/rest/column10", "hard/joints/chain20_100"]


def values_are_predicted():
    """Valgrind and its tool are there, and the program has no sanitizer in it."""
    with open(PBMPI, "rb") as program:
        return shutil.which("valgrind") is not None and b"__asan_init" not in program.read()


class Files:
    """Small files of each kind, and the pages of them."""

    def __init__(self, folder):
        self.folder = folder
        self.pages = {}

    def path(self, name):
        return os.path.join(self.folder, name)

    def run(self, program, *args):
        done = subprocess.run([os.path.join(BIN, program), *map(str, args)], cwd=self.folder, capture_output=True, text=True,
                              timeout=TIMEOUT_S, check=False)
        if done.returncode != 0:
            raise AssertionError(f"{program} {args}: {done.stderr}")

    def page(self, name, *args):
        """`args`: of pbreport, without the page."""
        self.run("pbreport", *args, "--html", name + ".html")
        self.pages[name] = self.path(name + ".html")

    def paper_page(self, name, *args):
        """`args`: of jobs/paper/paper.py, without the page."""
        self.run(PAPER[0], PAPER[1], *args, "--quiet", "--html", name + ".html")
        self.pages[name] = self.path(name + ".html")

    def make(self):
        self.run("pbmpi", "--scene", "100CrSk", "--replicas", 4, "--frames", 6, "--output", "many.h5", "--quiet")
        self.page("run of many worlds", "many.h5", "--quiet")
        self.run("pbmpi", "--scene", "CrashSk", "--frames", 6, "--record-every", 3, "--feec", "--output", "one.h5", "--quiet")
        self.page("run of one world", "one.h5", "--quiet")
        for seed in (1, 2):
            self.run("pbmpi", "--scene", "CrashSk", "--frames", 6, "--seed", seed, "--record", "contacts", "--output", f"seed{seed}.h5", "--quiet")
        self.page("difference", "diff", "seed1.h5", "seed2.h5")
        for ranks in (1, 2):
            self.run(shutil.which("mpirun"), "-n", ranks, PBMPI, "--scene", "Fight", "--decompose", "spaces", "--frames", 4, "--quiet",
                     "--output", f"ranks{ranks}.h5")
        self.page("scaling", "scaling", "ranks1.h5", "ranks2.h5", "--quiet")
        with open(self.path("speeds.csv"), "w", encoding="utf-8") as file:
            file.write("car.speed\n5\n10\n15\n")
        self.run("pbmpi", "--scene", "CrashSk", "--parameters", "speeds.csv", "--frames", 4, "--output", "study.h5", "--quiet")
        self.page("ensemble", "ensemble", "study.h5", "--over", "worlds", "--quiet")
        self.studies()
        self.figures()

    def studies(self):
        self.run("pbstudy", "accuracy", "--scene", "CrashSk", "--iterations", 1, 20, "--substeps", 1, 2, "--frames", 2, "--repeats", 1,
                 "--nature-steps", 96, "--floor-seeds", 1, "--rest-seconds", 0, "--output", "accuracy.h5", "--quiet")
        self.page("accuracy", "accuracy.h5", "--quiet", "--budget", "1000s")
        self.run("pbstudy", "effects", "--scene", "CrashSk", "Battle", "--stepper", "sor", "--frames", 1, "--repeats", 1, "--floor-seeds", 1,
                 "--output", "effects.h5", "--quiet")
        self.page("effects", "effects.h5", "--quiet")
        self.run("pbstudy", "stability", "--scene", *STABILITY, "--setting", "quick", "sor", "--output", "stability.h5", "--quiet")
        self.page("stability", "stability.h5", "--quiet")
        self.page("engines", "engines", "accuracy.h5", "stability.h5", "--quiet")
        if not values_are_predicted():
            print("no Valgrind: the page of prediction is left out")
            return
        with open(self.path("ball.toml"), "w", encoding="utf-8") as file:
            file.write(BALL)
        self.run(PAPER[0], os.path.join(SOURCE, "jobs/paper/predict.py"), "--scene", "ball.toml", "--frames", 1, "--warmup", 0,
                 "--threshold", 1e-6, "--detail-scene", "none", "--output", "prediction.h5", "--quiet")
        self.paper_page("prediction", "prediction", "prediction.h5")

    def figures(self):
        for name, *options in (["iter20"], ["iter1", "--iterations", 1], ["feec", "--feec"], ["seed", "--solver-seed", 5]):
            self.run("pbmpi", "--scene", "CrashSk", "--stepper", "quick", *options, "--output", name + ".h5", "--quiet")
        self.paper_page("figures 8 and 9", "figures", "iter20.h5", "iter1.h5", "feec.h5", "seed.h5")
        scenes = ("2-Cars", "10-Cars", "CrashSk", "CrashWa", "Environ", "Fight")
        for scene in scenes:
            self.run("pbmpi", "--scene", scene, "--stepper", "quick", "--record", "islands", "--output", scene + ".h5", "--quiet")
        counts = {"instructions_per_frame": 2e6, "collision_share": 0.1, "frames": 5,
                  "mix": {"floating point": 0.3, "integer": 0.2, "branch": 0.1, "store": 0.1, "load": 0.3}}
        with open(self.path("figure3.json"), "w", encoding="utf-8") as file:
            json.dump({"filetype": "pbmpi-instructions",
                       "scenes": {"CrashSk": {"quick": counts, "direct": {**counts, "instructions_per_frame": 3e7}},
                                  "Environ": {"quick": {**counts, "instructions_per_frame": 2e7}}}}, file)
        self.paper_page("figure 3", "figure3", "figure3.json", "CrashSk.h5", "Environ.h5")
        self.paper_page("figures of the paper", "paper", "figure3.json", "iter20.h5", "iter1.h5", "feec.h5", "seed.h5",
                        *(scene + ".h5" for scene in scenes))
        self.paper_page("figure 6", "figure6", *(scene + ".h5" for scene in scenes), "--stills", os.path.join(SOURCE, "scenes", "gallery"))


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="pbmpi-test-")
        cls.files = Files(cls.folder)
        cls.files.make()
        cls.browser = browser.Browser(cls.folder)
        cls.shots = os.environ.get("PBMPI_PAGE_SHOTS")
        if cls.shots:
            os.makedirs(cls.shots, exist_ok=True)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        shutil.rmtree(cls.folder, ignore_errors=True)

    def open(self, name, width="desk", mode="light", address=""):
        self.browser.open(self.files.pages[name], width, mode, address)

    def js(self, script, *args):
        return self.browser.js(script, *args)

    def test_no_text_overlaps_or_leaves_its_box_and_every_contrast_is_enough(self):
        for name in self.files.pages:
            for width in browser.WIDTHS:
                backs = set()
                for mode in browser.MODES:
                    with self.subTest(page=name, width=width, mode=mode):
                        self.open(name, width, mode)
                        self.js("document.querySelectorAll('details').forEach((one) => { one.open = true; })")
                        self.assertEqual(self.browser.problems(), [])
                        self.assertEqual(self.browser.complaints(), [])
                        backs.add(self.js("return getComputedStyle(document.body).backgroundColor"))
                        if self.shots:
                            self.browser.save_screenshot(os.path.join(self.shots, f"{name}, {width}, {mode}.png"))
                self.assertEqual(len(backs), 2, f"{name}: dark is another colour than light")

    def test_the_check_sees_text_in_charts_and_out_of_them(self):
        self.open("accuracy")
        texts = self.js("return [...canvasTexts.entries()].filter(([canvas]) => canvas.isConnected).map(([, texts]) => texts.length)")
        self.assertEqual(len(texts), 4)
        self.assertGreater(min(texts), 4, "labels and titles of two axes")

    def broken(self, script, kind, name="accuracy", width="desk", mode="light"):
        """The page is right, and after the script it is not, in this way."""
        self.open(name, width, mode)
        self.assertEqual(self.browser.problems(), [])
        self.js(script)
        problems = self.browser.problems()
        self.assertTrue(any(problem.startswith(kind + ":") for problem in problems), f"{kind}: {problems}")

    STYLE = "document.head.append(Object.assign(document.createElement('style'), {textContent: arguments_text}));"

    def styled(self, rule, kind, **where):
        self.broken(self.STYLE.replace("arguments_text", repr(rule)), kind, **where)

    def test_text_on_other_text_is_noticed(self):
        self.styled(".key { margin-top: -110px; }", "overlap")
        self.styled("h1 { margin-bottom: -24px; }", "overlap", name="stability", width="phone")

    def test_labels_of_a_chart_on_each_other_are_noticed(self):
        self.broken("const chart = Object.values(Chart.instances)[0]; chart.ctx.fillStyle = '#000000';"
                    "for (const x of [90, 110]) chart.ctx.fillText('a label on another', x, 50);", "overlap")

    def test_text_beyond_its_box_is_noticed(self):
        self.styled(".chart p { width: 60px; white-space: nowrap; }", "box")

    def test_text_beyond_the_window_is_noticed(self):
        self.styled(".chart h3 { width: 2000px; text-align: right; } .card { overflow: visible; }", "view")
        self.styled(".sub { position: relative; left: 300px; }", "view", width="phone")

    def test_text_beyond_its_chart_is_noticed(self):
        self.broken("const chart = Object.values(Chart.instances)[0];"
                    "chart.ctx.fillStyle = '#000000'; chart.ctx.fillText('a label that has no room', chart.width - 30, 50);", "box")

    def test_a_weak_contrast_is_noticed_in_light_and_dark(self):
        self.styled(".chart p { color: #9aa4ae; }", "contrast")
        self.styled(".chart p { color: #5b6775; }", "contrast", mode="dark")
        self.broken("Object.values(Chart.instances)[0].options.scales.x.ticks.color = '#b0b8c0'; Object.values(Chart.instances)[0].update();",
                    "contrast")
        self.broken("const chart = Object.values(Chart.instances)[0]; const set = chart.data.datasets[1];"
                    "set.borderColor = set.backgroundColor = '#f0e442'; chart.update();", "contrast")

    def test_what_only_a_mouse_reaches_is_noticed(self):
        self.broken("document.querySelectorAll('.table').forEach((one) => one.removeAttribute('tabindex'))", "keyboard", width="phone")
        self.broken("document.querySelector('.area canvas').tabIndex = -1", "keyboard")

    def test_a_bar_beyond_its_frame_is_noticed(self):
        self.broken("const chart = Object.values(Chart.instances)[0], axis = chart.options.indexAxis === 'y' ? 'x' : 'y';"
                    "chart.options.scales[axis].max = 0.01; chart.update();", "bar", name="effects")

    def test_a_decade_without_a_label_is_noticed(self):
        self.broken("const chart = Object.values(Chart.instances)[0];"
                    "chart.options.scales.y.ticks.callback = () => ''; chart.update();", "decade")

    def test_a_line_off_the_scale_that_the_key_keeps_quiet_about_is_noticed(self):
        self.open("accuracy")
        keys = self.js("return [...document.querySelectorAll('.key')].map((key) => key.innerText)")
        self.assertTrue(all("budget [ms]: 1000000, above the scale" in key for key in keys), keys)
        self.broken("for (const one of document.querySelectorAll('.key li')) if (one.innerText.startsWith('budget')) one.remove();", "scale")

    def test_every_page_says_what_it_was_made_from(self):
        for name in self.files.pages:
            self.open(name)
            foot = self.js("const place = document.getElementById('provenance');"
                           "place.querySelectorAll('details').forEach((one) => { one.open = true; }); return place.innerText")
            self.assertRegex(foot, r"page by (pbreport|jobs/paper/paper\.py)", name)
            whole = foot + self.js("document.querySelectorAll('details').forEach((one) => { one.open = true; });"
                                   "return document.body.innerText")
            self.assertRegex(whole, r"pbmpi \d+\.\d+", name)
            of_several_runs = "figure" in name or name in ("difference", "ensemble", "scaling")
            self.assertIn("pbmpi --scene " if of_several_runs else "command_line", whole, name)

    def test_the_chosen_setting_and_the_estimates_are_in_each_diagram(self):
        self.open("accuracy")
        for chart in self.js("return Object.values(Chart.instances).map((chart) => chart.data.datasets.map((one) => "
                             "({label: one.label, texts: one.data.map((point) => point.label)})))"):
            sets = {one["label"]: one["texts"] for one in chart}
            self.assertEqual(len(sets["chosen"]), 1)
            self.assertTrue(any(sets["chosen"][0].removeprefix("chosen: ") == text for label in sets if label.startswith(("sor", "quick", "other"))
                                for text in sets[label]), "the ring lies round one of the settings")
            self.assertEqual(len(sets["estimates (FEEC)"]), 2 * (1 + 2 * 2),
                             "two numbers of iterations, of quick and of two kinds of sor in two precisions")
            self.assertTrue(any(", 5 a step," in text for text in sets["estimates (FEEC)"]))
            said = " ".join(text for texts in sets.values() for text in texts)
            self.assertIn("(2 substeps of 20 iterations)", said)
            self.assertIn("(1 substep of 1 iteration)", said)
        hidden = self.js("const chart = Object.values(Chart.instances)[0];"
                         "return chart.data.datasets.filter((one, index) => !chart.isDatasetVisible(index)).map((one) => one.label)")
        self.assertEqual(hidden, ["other settings", "estimates (FEEC)"], "on request")
        pressed = self.js("return [...document.querySelector('.key').querySelectorAll('button')].map((one) => one.getAttribute('aria-pressed'))")
        self.assertEqual(pressed.count("false"), 2)

    def test_bars_lie_where_their_names_have_no_room_on_the_same_axis(self):
        for width in browser.WIDTHS:
            self.open("effects", width)
            lies, low, high, errors = self.js(
                "const chart = Object.values(Chart.instances).find((one) => Object.values(one.scales).some((axis) => axis.type === 'logarithmic'));"
                "const lies = chart.options.indexAxis === 'y', axis = chart.scales[lies ? 'x' : 'y'];"
                "const values = chart.data.datasets.flatMap((one) => one.data.map((point) => point[lies ? 'x' : 'y'] ?? point));"
                "return [axis.type === 'logarithmic' && lies, axis.min, axis.max, values.filter((value) => value > 0)]")
            self.assertTrue(lies or width == "desk", width)
            self.assertGreater(len(errors), 0)
            self.assertTrue(all(low < error < high for error in errors), errors)

    def test_the_keyboard_reads_a_chart_off_and_hides_its_sets(self):
        from selenium.webdriver.common.keys import Keys
        self.open("accuracy", "phone")
        canvas = self.browser.driver.find_element("css selector", ".area canvas")
        self.js("arguments[0].focus()", canvas)
        canvas.send_keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
        box = self.js("const box = arguments[0].parentElement.querySelector('.readout'), place = box.getBoundingClientRect();"
                      "return [box.innerText, place.left, place.right]", canvas)
        self.assertIn(" ms, ", box[0])
        self.assertGreaterEqual(box[1], 0)
        self.assertLessEqual(box[2], browser.WIDTHS["phone"], "what is read off stays in the window")
        canvas.send_keys(Keys.ESCAPE)
        self.assertTrue(self.js("return arguments[0].parentElement.querySelector('.readout').hidden", canvas))
        button = self.browser.driver.find_element("css selector", ".key button")
        button.send_keys(Keys.SPACE)
        self.assertEqual(button.get_attribute("aria-pressed"), "false")
        self.assertFalse(self.js("return Object.values(Chart.instances)[0].isDatasetVisible(0)"))

    def test_the_focus_is_seen_wherever_the_tab_key_goes(self):
        from selenium.webdriver.common.keys import Keys
        for name in ("run of one world", "stability", "accuracy"):
            self.open(name)
            reached = set()
            for _ in range(24):
                self.browser.driver.switch_to.active_element.send_keys(Keys.TAB)
                tag, style, width = self.js("const one = document.activeElement, style = getComputedStyle(one);"
                                            "return [one.tagName, style.outlineStyle, parseFloat(style.outlineWidth)]")
                if tag == "BODY":
                    break
                reached.add(tag)
                self.assertNotEqual(style, "none", f"{name}: {tag}")
                self.assertGreaterEqual(width, 1, f"{name}: {tag}")
            self.assertIn("CANVAS" if name != "stability" else "DIV", reached)

    def test_the_page_of_figure_6_shows_pictures_of_its_scenes(self):
        self.open("figure 6")
        pictures = self.js("return [...document.querySelectorAll('.pictures img')].map((one) => [one.alt, one.naturalWidth > 100])")
        self.assertEqual(pictures, [[scene, True] for scene in ("2-Cars", "10-Cars", "CrashSk", "CrashWa", "Environ", "Fight")])

    def test_frames_of_replay_and_plots_have_the_same_numbers(self):
        self.open("run of one world", address="#frame=2")
        self.assertIn("frame 6 of 9", self.js("return document.getElementById('frame-label').innerText"),
                      "the second of the recorded, which are every third of 3 + 6")
        self.assertEqual(self.js("return [...pb.framePlots.charts].map((chart) => chart.cursor).filter((at) => at !== 6)"), [])
        self.assertEqual(self.js("return [...pb.framePlots.charts][0].data.datasets[0].data.map((point) => point.x)"), list(range(1, 10)))


if __name__ == "__main__":
    if not browser.is_there():
        print("chromium, chromium-driver or python3-selenium is not installed: skipped")
        sys.exit(SKIPPED)
    unittest.main(verbosity=2)
