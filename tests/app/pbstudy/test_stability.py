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
from harness import BIN, ProgramTest  # noqa: E402

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
            return {f"{table}/{key}": column[:] for table in ("cases", "curves", "poses")
                    for key, column in file[table].items()}

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
        self.assertEqual(len(study["curves/case"]), 0)

    def test_curves_and_poses_end_with_the_case(self):
        study = self.made(2, "study.h5", "--scene", "hard/rest/column10", "--setting", "sor", "quick", "--poses", 100)
        for case in range(2):
            curve, poses = study["curves/case"] == case, study["poses/case"] == case
            self.assertEqual(curve.sum(), 100)
            self.assertAlmostEqual(study["curves/time"][curve][-1], 10)
            self.assertTrue((np.diff(study["curves/drift"][curve]) >= 0).all(), "the longest way so far")
            self.assertAlmostEqual(study["curves/drift"][curve][-1], study["cases/drift"][case])
            self.assertEqual(poses.sum(), 10 * 10, "ten moments of ten boxes")
            self.assertAlmostEqual(study["poses/time"][poses][-1], 10)

    def test_scenes_with_poses_have_their_bodies_and_geoms(self):
        self.made(1, "study.h5", "--scene", "hard/rest/column10", "hard/free/tumbling_box", "--setting", "sor", "sor cut", "--poses", 100)
        self.made(1, "none.h5", "--scene", "hard/rest/column10", "--setting", "sor", "--poses", 0)
        with h5py.File(self.path("study.h5")) as file, h5py.File(self.path("none.h5")) as none:
            bodies, geoms = ({name: column[:] for name, column in file[table].items()} for table in ("bodies", "geoms"))
            self.assertEqual(len(none["bodies/scene"]) + len(none["geoms/scene"]), 0)
            self.assertEqual(set(file["cases/options"].asstr()[0].split()) & {"--stepper", "sor", "--substeps", "14"},
                             {"--stepper", "sor", "--substeps", "14"})
            self.assertEqual(len(file["differences/text"]), 0, "sor expresses all")
        column = bodies["scene"] == b"hard/rest/column10"
        self.assertEqual((column.sum(), (~column).sum()), (10, 1))
        self.assertEqual(bodies["pose"].shape, (11, 7))
        self.assertTrue(np.allclose(sorted(bodies["pose"][column][:, 2]), np.arange(0.25, 5, 0.5)), "boxes on boxes")
        of_column = geoms["scene"] == b"hard/rest/column10"
        self.assertEqual(sorted(geoms["body"][of_column]), list(range(-1, 10)), "the ground is static")
        self.assertEqual(set(geoms["shape"][of_column]), {b"plane", b"box"})

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
    def test_a_field_of_the_page_opens_its_curves_and_its_replay(self):
        self.made(1, "study.h5", "--scene", *SCENES, "--setting", "quick", "sor")
        self.assertEqual(self.report("study.h5", "--quiet", "--html", "page.html").returncode, 0)
        closed = self.drawn("page.html")
        self.assertEqual(len(re.findall(r'<button type="button" id="field-', closed)), 3 * 2)
        self.assertRegex(closed, r'<section[^>]*id="replay"[^>]*hidden')
        opened = self.drawn("page.html#case=hard/rest/column10&setting=sor double, 14 x 1")
        self.assertIn("hard/rest/column10, sor double, 14 x 1: pass", opened)
        self.assertEqual(len(re.findall(r'aria-label="[^"$]+ over time"', opened)), 4, "energy, gap, contact, drift")
        self.assertNotRegex(opened, r'<section[^>]*id="replay"[^>]*hidden')

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
        for option in ("--scene", "--setting", "--dt", "--most-work", "--poses", "--seed", "--output"):
            self.assertIn(option, result.stdout)


if __name__ == "__main__":
    unittest.main()
