"""pbstudy stability and the report of its file, end to end."""
import csv
import os
import re
import shutil
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import BIN, PBMPI, ProgramTest  # noqa: E402

SCENES = ["hard/free/tumbling_box", "hard/rest/column10", "hard/joints/chain20_100"]
FALLING = """title = "a ball that falls"
[case]
row = 4
group = "mine"
source = "free fall"
oracle = "z = 20 - g t^2 / 2"
seconds = 1
[case.bounds]
energy_gain = [1, 10]
[[case.expect]]
body = "ball"
quantity = "z"
value = {value}
within = [0.1, 1]
[[actor]]
name = "ball"
type = "sphere"
radius = 0.1
mass = 1
position = [0, 0, 20]
"""


class Stability(ProgramTest):
    def study(self, ranks, *args):
        return self.run_command(["mpirun", "-n", str(ranks), os.path.join(BIN, "pbstudy"), "stability", *map(str, args)])

    def made(self, ranks, name, *args):
        result = self.study(ranks, *args, "--output", name)
        self.assertEqual(result.returncode, 0, result.stderr)
        with h5py.File(self.path(name)) as file:
            self.assertEqual(file.attrs["study"], b"stability")
            return {f"cases/{key}": column[:] for key, column in file["cases"].items()}

    def cells(self, name):
        """Verdict and number of each case and setting."""
        report = self.json(self.report(name, "--json"))
        return {(case["scene"], cell["setting"]): cell for case in report["cases"] for cell in case["results"]}

    def test_all_but_times_is_the_same_for_any_number_of_ranks(self):
        args = ["--scene", *SCENES, "--setting", "quick", "sor", "sor cut"]
        one = self.made(1, "one.h5", *args)
        for ranks in (2, 3):
            several = self.made(ranks, "several.h5", *args)
            for name, column in one.items():
                if name != "cases/step_time":
                    self.assertEqual(column.tobytes(), several[name].tobytes(), f"{name}, {ranks} ranks")
        self.assertEqual(len(one["cases/scene"]), 3 * 3)
        self.assertTrue((one["cases/step_time"] >= 0).all())

    def test_a_world_in_two_spaces_has_the_numbers_of_the_whole(self):
        self.made(1, "study.h5", "--scene", "hard/rest/column10", "--setting", "sor", "sor cut")
        cells = self.cells("study.h5")
        whole, cut = (cells["hard/rest/column10", f"sor double, 14 x 1{text}"] for text in ("", ", in two spaces"))
        self.assertEqual(whole["metrics"], cut["metrics"])
        self.assertEqual(whole["broken_at_s"], cut["broken_at_s"])

    def test_what_an_oracle_says_is_judged_by_the_distance_from_it(self):
        # Substeps h = 0.01 s / 14: semi-implicit ones fall g h t / 2 = 0.0035 m further than 4.905 m.
        self.write("right.toml", FALLING.format(value=15.095))
        self.write("wrong.toml", FALLING.format(value=14.5))
        self.write("absurd.toml", FALLING.format(value=0))
        self.made(1, "study.h5", "--scene", "right.toml", "wrong.toml", "absurd.toml", "--setting", "sor")
        cells = {name: cell for (name, _), cell in self.cells("study.h5").items()}
        self.assertEqual([cells[name]["verdict"] for name in ("right", "wrong", "absurd")], ["pass", "degraded", "broken"])
        self.assertEqual(cells["wrong"]["decided_by"], "ball.z")
        self.assertAlmostEqual(cells["right"]["value"], 0.0035, delta=0.0001)
        self.assertAlmostEqual(cells["wrong"]["value"], 0.5915, delta=0.0001)

    def test_a_step_of_another_length_is_a_setting(self):
        self.made(1, "study.h5", "--scene", "hard/free/tumbling_box", "--setting", "quick", "--dt", "0.01", "0.001")
        cells = self.cells("study.h5")
        coarse, fine = (cells["hard/free/tumbling_box", f"quick, 1 x 20, dt {dt} s"] for dt in ("0.01", "0.001"))
        for metric in ("energy_change", "angular_momentum"):  # the integrator is of the first order
            self.assertGreater(coarse["metrics"][metric], 2 * fine["metrics"][metric])

    def test_settings_that_cannot_run_a_case_say_why(self):
        study = self.made(1, "study.h5", "--scene", "hard/free/tumbling_box", "hard/rest/column10", "--setting", "sor cut",
                          "--most-work", 5000)
        self.assertEqual(list(study["cases/verdict"]), [b"n/a", b"n/a"])
        self.assertIn(b"nothing to cut", study["cases/decided_by"][0])
        self.assertEqual(study["cases/decided_by"][1], b"left out by --most-work")

    def test_the_file_has_the_options_of_a_setting_and_what_its_engine_takes_otherwise(self):
        self.made(1, "study.h5", "--scene", "hard/rest/column10", "--setting", "sor", "sor cut")
        with h5py.File(self.path("study.h5")) as file:
            self.assertEqual(set(file["cases/options"].asstr()[0].split()) & {"--stepper", "sor", "--substeps", "14"},
                             {"--stepper", "sor", "--substeps", "14"})
            self.assertEqual(len(file["differences/text"]), 0, "sor expresses all")

    def test_the_command_of_a_field_makes_its_run(self):
        study = self.made(1, "study.h5", "--scene", "hard/rest/column10", "--setting", "quick")
        page = self.report("study.h5", "--quiet", "--html", "page.html")
        self.assertEqual(page.returncode, 0, page.stderr)
        with open(self.path("page.html"), encoding="utf-8") as file:
            [command] = set(re.findall(r"pbmpi --scene [^\"]*--output case.h5", file.read()))
        result = self.run_command([PBMPI, *command.split()[1:], "--quiet"])
        self.assertEqual(result.returncode, 0, result.stderr)
        with h5py.File(self.path("case.h5")) as file:
            self.assertAlmostEqual(file["particles/bodies/position/time"][-1], study["cases/seconds"][0], delta=0.04)
            largest = np.nanmax(file["observables/world/max_penetration"][:])
        self.assertLessEqual(largest, study["cases/penetration"][0] * (1 + 1e-9), "the study looks at each step, the run at each frame")

    def test_reports_agree(self):
        self.made(2, "study.h5", "--scene", *SCENES, "--setting", "quick", "direct")
        text = self.report("study.h5")
        self.assertEqual(text.returncode, 0, text.stderr)
        cells = self.cells("study.h5")
        for (scene, setting), cell in cells.items():
            self.assertIn(scene, text.stdout)
            self.assertRegex(text.stdout, re.escape(setting) + " +" + cell["verdict"])
        markdown = self.report("study.h5", "--markdown").stdout
        self.assertEqual(markdown.count("\n"), 2 + 3 + 4, "head, cases, counts")
        self.assertEqual(markdown.count("| ok "), sum(cell["verdict"] == "pass" for cell in cells.values()))
        self.assertEqual(self.report("study.h5", "--quiet", "--csv", "study.csv").returncode, 0)
        with open(self.path("study.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["verdict"] for row in rows], [cell["verdict"] for cell in cells.values()])
        one = self.json(self.report("study.h5", "--json", "--scene", SCENES[1]))
        self.assertEqual([case["scene"] for case in one["cases"]], [SCENES[1]])

    @unittest.skipUnless(shutil.which("chromium"), "the page is looked at in Chromium, which is not installed")
    def test_the_page_has_a_map_and_a_table_a_case(self):
        self.made(1, "study.h5", "--scene", *SCENES, "--setting", "quick", "sor")
        self.assertEqual(self.report("study.h5", "--quiet", "--html", "page.html").returncode, 0)
        page = self.drawn("page.html")
        self.assertEqual(len(re.findall(r'<td class="(words )?(pass|degraded|broken|na)">', page)), 3 * 2)
        self.assertEqual(page.count("<table"), 1 + 3 + 1, "the map, the cases, and provenance")

    def refused(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stderr)
        lines = [line for line in result.stderr.splitlines() if line.startswith(("pbstudy: ", "pbreport: "))]
        self.assertEqual((result.stdout, len(lines)), ("", 1), result.stderr)
        for word in words:
            self.assertIn(word, lines[0])

    def test_bad_input_is_refused_by_one_rank_before_any_work(self):
        before = set(os.listdir(self.folder))
        self.refused(self.study(2, "--scene", "CrashSk"), "CrashSk", "[case]")
        self.refused(self.study(2, "--scene", "hard/rest/column"), "hard/rest/column")
        self.refused(self.study(2, "--setting", "fast"), "fast", "quick")
        self.refused(self.study(2, "--setting", "quick cut"), "quick cut", "cut")
        self.refused(self.study(2, "--setting", "quick substeps=2"), "substeps")
        self.refused(self.study(2, "--setting", "sor speed=2"), "speed")
        self.refused(self.study(2, "--dt", "0"), "--dt")
        self.refused(self.study(2, "--most-work", "0"), "--most-work")
        self.assertEqual(set(os.listdir(self.folder)), before)

    def test_help_names_every_option(self):
        result = self.study(1, "--help", "all")
        self.assertEqual(result.returncode, 0)
        for option in ("--scene", "--setting", "--dt", "--most-work", "--seed", "--output"):
            self.assertIn(option, result.stdout)


if __name__ == "__main__":
    unittest.main()
