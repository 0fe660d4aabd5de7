"""pbstudy accuracy and the report of its file, end to end."""
import csv
import json
import os
import re
import shutil
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import BIN, PAPER, PATH, SOURCE, ProgramTest  # noqa: E402

ROUGHLY = ["--nature-steps", 48, "--own-iterations", 0]
FAST = ["--frames", 3, "--repeats", 2, *ROUGHLY, "--rest-seconds", 0]
ONE_DT = ["--dt", 0.01]


class Accuracy(ProgramTest):
    def study(self, ranks, *args):
        command = ["mpirun", "-n", str(ranks), os.path.join(BIN, "pbstudy"), "accuracy", *map(str, args)]
        return self.run_command(command)

    def made(self, ranks, name, *args):
        result = self.study(ranks, *args, "--output", name, "--quiet")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
        with h5py.File(self.path(name)) as file:
            self.assertEqual(file.attrs["filetype"], b"pbmpi-study")
            return {key: column[:] for key, column in file["cases"].items()}

    def front(self, *args):
        result = self.report(*args, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.json(result)["scenes"]

    def test_errors_are_the_same_for_any_number_of_ranks(self):
        args = ["--scene", "CrashSk", "--iterations", 1, 5, 20, "--substeps", 1, 2, *FAST, *ONE_DT]
        one, three = self.made(1, "one.h5", *args), self.made(3, "three.h5", *args)
        self.assertEqual(len(one["scene"]), 3 + 3 * 2 * 2 + 2 * 2 + 2 * (1 + 2 * 2) + 1,
                         "quick; sor with ODE's law in one substep and in two; with the soft one; estimates by two numbers of iterations "
                         "of quick, and of sor with both laws in two precisions; nature")
        for name, column in one.items():
            if not name.startswith("frame_time"):
                self.assertEqual(column.tobytes(), three[name].tobytes(), name)
        self.assertTrue((one["frame_time_worst"] >= one["frame_time_median"]).all())
        self.assertTrue((one["frame_time_median"] > 0).all())
        setting = one["kind"] == b"setting"
        relax = one["law"] == b"soft"  # a sweep that pushes nothing out
        visits = one["rows"] * (one["iterations"] + relax) * one["substeps"] * one["steps_per_frame"]
        self.assertTrue(np.allclose(one["row_visits"][setting], visits[setting], rtol=1e-14))
        estimate = one["kind"] == b"estimate"
        coarse = one["steps_per_frame"] * np.maximum(1, one["substeps"] // 6) * (one["estimate_iterations"] + relax)
        self.assertTrue(np.array_equal(one["row_visits"][estimate], (one["rows"] * coarse)[estimate]))
        self.assertTrue((one["drift_body_position_bands"].sum(axis=1)[setting] == 3 * 37).all(), "all bodies in all frames")
        judged = one["defect_body_position_bands"].sum(axis=1)
        self.assertTrue((judged == round(3 * 37 * one["determined"][0, 1])).all(), "the same bodies for every method")
        self.assertGreater(one["defect_body_position_rms"][setting].min(), 0)

    def test_the_error_falls_along_the_front_and_the_choice_reproduces_its_error(self):
        self.made(2, "study.h5", "--scene", "CrashWa", "--iterations", 1, 5, 20, "--substeps", 1, "--precision", "double",
                  *FAST, *ONE_DT)
        [scene] = self.front("study.h5", "--budget", "1s")
        errors = [row["error_m"] for row in scene["front"]]
        times = [row["frame_time_s"]["worst"] for row in scene["front"]]
        self.assertGreater(len(errors), 1)
        self.assertEqual(errors, sorted(errors, reverse=True))
        self.assertEqual(times, sorted(times))
        chosen = scene["chosen"]
        self.assertEqual(chosen["error_m"], errors[-1], "all fits into a second")
        options = chosen["options"]
        again = self.made(1, "again.h5", "--scene", "CrashWa", "--stepper", options["stepper"], "--iterations",
                          options["iterations"], "--substeps", options.get("substeps", 1), "--law", options.get("law", "ode"),
                          "--precision", "double", *FAST, *ONE_DT)
        found = again["defect_body_position_rms"][again["kind"] == b"setting"]
        self.assertEqual(list(found), [chosen["error_m"]], "the same bits, whatever else is studied")

    def test_an_estimate_of_a_frame_of_one_step_is_the_run_of_so_many_iterations(self):
        args = ["--scene", "CrashSk", "--stepper", "sor", "--dt", 0.03, "--iterations", 3, 20, "--substeps", 1,
                "--estimates", 3, 20, *FAST]
        study = self.made(2, "study.h5", *args)
        rows = {(kind, precision, coarse or iterations): index for index, (kind, precision, coarse, iterations, law) in
                enumerate(zip(study["kind"], study["precision"], study["estimate_iterations"], study["iterations"], study["law"]))
                if law == b"ode"}
        for precision in (b"double", b"single"):
            for iterations in (3, 20):
                estimate, run = (rows[kind, precision, iterations] for kind in (b"estimate", b"setting"))
                for name, column in study.items():
                    if name.startswith("defect") or name in ("joint_gap", "energy_change", "row_visits"):
                        self.assertEqual(column[estimate].tobytes(), column[run].tobytes(), name)
            early, late = (rows[b"estimate", precision, iterations] for iterations in (3, 20))
            self.assertEqual(study["drift_body_position_rms"][early], study["drift_body_position_rms"][late],
                             "an estimate ends with its frame")
            self.assertLess(study["defect_body_position_rms"][late], study["defect_body_position_rms"][early])
        [scene] = self.front("study.h5")
        self.assertEqual([row["estimate"]["iterations"] for row in scene["estimates"]], 4 * [3, 20], "two laws, two precisions")
        self.assertIn("Estimates (FEEC)", self.report("study.h5").stdout)

    def test_nature_is_where_two_ways_meet_and_the_file_shows_it(self):
        study = self.made(2, "study.h5", "--scene", "CrashSk", "--stepper", "quick", "--iterations", 20, "--frames", 3, "--repeats", 1,
                          "--nature-steps", 384, "--own-iterations", 0, "--estimates", 0, "--rest-seconds", 0, *ONE_DT)
        with h5py.File(self.path("study.h5")) as file:
            frames, bodies = ({name: column[:] for name, column in file[table].items()} for table in ("nature", "nature_bodies"))
            self.assertEqual((file["parameters/nature_steps"][()], file["parameters/nature_error"][()]), (384, 1e-4))
        self.assertEqual(list(frames["frame"]), [3, 4, 5])
        self.assertEqual(list(frames["scene"]), 3 * [b"CrashSk"])
        self.assertGreater(len(set(frames["soft_steps"])), 1, "some frames take shorter steps than others")

        def far(one, other):
            return np.linalg.norm(bodies[one] - bodies[other], axis=1)

        moved = {way: far(way, f"{way}_halved") for way in ("soft", "ode")}
        apart = far("soft", "ode")
        self.assertTrue(np.allclose(bodies["uncertainty"], np.maximum.reduce([*moved.values(), apart]), rtol=1e-12, atol=0))
        for row, frame in enumerate(frames["frame"]):
            here = bodies["frame"] == frame
            self.assertEqual(here.sum(), 37)
            self.assertAlmostEqual(frames["apart_median"][row], np.median(apart[here]), delta=1e-15)
            for way in ("soft", "ode"):
                p90 = np.quantile(moved[way][here], 0.9)
                self.assertAlmostEqual(frames[f"{way}_halved_p90"][row], p90, delta=1e-12)
                self.assertTrue(p90 < 1e-4 or frames[f"{way}_steps"][row] == 384)
            shares = [(bodies["uncertainty"][here] < known).mean() for known in (1e-4, 1e-3, 1e-2)]
            self.assertTrue(np.allclose(frames["determined"][row], shares, rtol=1e-14))
        self.assertTrue(np.allclose(study["determined"], frames["determined"].mean(axis=0), rtol=1e-14))
        nature = study["kind"] == b"nature"
        judged = bodies["uncertainty"][bodies["uncertainty"] < 1e-3]
        for what, number in (("rms", np.sqrt((judged ** 2).mean())), ("median", np.median(judged)), ("p90", np.quantile(judged, 0.9))):
            self.assertAlmostEqual(study[f"defect_body_position_{what}"][nature][0], number, delta=1e-15)
        self.assertTrue(np.isnan(study["within"][nature]).all())
        self.assertTrue((study["within"][~nature] <= 1).all())

    def test_shorter_steps_end_nearer_to_nature(self):
        study = self.made(2, "study.h5", "--scene", "Fight", "--stepper", "sor", "--law", "soft", "--substeps", 1, "--precision", "double",
                          "--estimates", 0, "--frames", 3, "--repeats", 1, "--nature-steps", 768, "--own-iterations", 0,
                          "--rest-seconds", 0, "--dt", 0.01, 0.005, 0.0025, 0.00125)
        median = study["defect_body_position_median"][study["kind"] == b"setting"]
        for longer, shorter in zip(median, median[1:]):
            self.assertLess(shorter, 0.7 * longer, "of first order: half of it")

    def test_a_written_config_carries_the_law(self):
        self.made(2, "study.h5", "--scene", "CrashSk", "--stepper", "sor", "--law", "ode", "--iterations", 3, "--substeps", 2,
                  "--precision", "double", "--estimates", 0, *FAST, *ONE_DT)
        result = self.report("study.h5", "--tolerance", "1m", "--write-config", "ode.cfg")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("sor double, 2 x 3, law ode, dt 0.01 s", result.stdout)
        configured = self.pbmpi(1, "--config", "ode.cfg", "--output", "run.h5")
        self.assertEqual(configured.returncode, 0, configured.stderr)
        with h5py.File(self.path("run.h5")) as file:
            self.assertEqual((file["parameters/law"][()], file["parameters/substeps"][()]), (b"ode", 2))

    def test_the_config_of_a_tolerance_runs(self):
        self.made(2, "study.h5", "--scene", "CrashSk", "--iterations", 1, 20, "--substeps", 1, "--stepper", "sor", *FAST, *ONE_DT)
        result = self.report("study.h5", "--tolerance", "1m", "--write-config", "crash.cfg", "--html", "page.html",
                             "--csv", "table.csv")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("run: mpirun -n 1 pbmpi --scene CrashSk --stepper sor", result.stdout)
        self.assertIn("nature", result.stdout)
        run = self.pbmpi(1, "--config", "crash.cfg", "--no-output", "--report", "json")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual((json.loads(run.stdout)["stepper"], json.loads(run.stdout)["iterations"]), ("sor", 1))
        wins = self.pbmpi(1, "--config", "crash.cfg", "--iterations", "7", "--no-output", "--report", "json")
        self.assertEqual(json.loads(wins.stdout)["iterations"], 7, "the command line wins")
        with open(self.path("table.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 4 + 2 + 2 * 2 * 2 + 1, "settings; with the soft law; estimates; nature")
        with open(self.path("page.html"), encoding="utf-8") as file:
            page = file.read()
        self.assertIn("Pareto front", page)
        self.assertNotIn("src=\"http", page)

    @unittest.skipUnless(shutil.which("chromium"), "the page is looked at in Chromium, which is not installed")
    def test_the_page_draws_its_charts_in_a_browser(self):
        self.made(1, "study.h5", "--scene", "CrashSk", "--iterations", 1, 20, "--substeps", 1, "--stepper", "sor", *FAST, *ONE_DT)
        result = self.report("study.h5", "--quiet", "--html", "page.html")
        self.assertEqual(result.returncode, 0, result.stderr)
        page = self.drawn("page.html")
        self.assertEqual(page.count("<canvas"), 4, "rms, median, p90, joint gap")
        self.assertTrue(re.search(r'<td class="words">sor (double|single), 1 x 20, law ode, dt 0.01 s</td>', page),
                        "which precision is on the front follows the times")

    def test_shorter_steps_are_part_of_the_matrix(self):
        study = self.made(1, "study.h5", "--scene", "CrashSk", "--iterations", 20, "--substeps", 1, "--stepper", "quick", *FAST)
        setting = study["kind"] == b"setting"
        self.assertEqual(list(study["dt"][setting]), [0.01, 0.005, 0.0025, 0.00125])
        self.assertEqual(list(study["steps_per_frame"][setting]), [3, 6, 12, 24])

    def test_a_setting_that_fells_what_stands_is_marked_and_not_chosen(self):
        args = ["--scene", "CrashSk", "--stepper", "sor", "--precision", "double", "--substeps", 1, "--estimates", 0,
                "--frames", 3, "--repeats", 1, *ROUGHLY, "--rest-seconds", 2, *ONE_DT]
        study = self.made(2, "study.h5", *args, "--iterations", 1, 80)
        setting = (study["kind"] == b"setting") & (study["law"] == b"ode")  # in one substep a memory holds no human either
        few, many = study["rest_fallen"][setting]
        self.assertGreater(few, 20, "one iteration carries no human")
        self.assertEqual(many, 0)
        self.assertLess(study["rest_fell_at"][setting][0], 1)
        self.assertEqual(study["rest_fell_at"][setting][1], np.inf)
        self.assertLess(study["rest_creep"][setting][1], study["rest_creep"][setting][0])
        self.assertTrue(np.isnan(study["rest_fallen"][study["kind"] != b"setting"]).all())
        [scene] = self.front("study.h5", "--budget", "1s")
        self.assertEqual(scene["chosen"]["options"]["iterations"], "80")
        [loose] = self.front("study.h5", "--tolerance", "10m")
        self.assertEqual(loose["chosen"]["options"]["iterations"], "80", "the cheaper one keeps 10 m, and fells")
        self.assertGreater(scene["front"][0]["at_rest"]["fallen"], 20, "the cheapest, with a memory or without, fells")
        self.assertIn("bodies at rest", self.report("study.h5").stdout)
        self.made(1, "few.h5", *args, "--iterations", 1)
        self.assertIn("without felling", self.report("few.h5", "--budget", "1s").stdout)

    def refused(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stderr)
        lines = [line for line in result.stderr.splitlines() if line.startswith(("pbstudy: ", "pbreport: ", "pbmpi: "))]
        self.assertEqual((result.stdout, len(lines)), ("", 1), result.stderr)
        for word in words:
            self.assertIn(word, lines[0])

    def test_bad_input_is_refused_by_one_rank_before_any_work(self):
        before = set(os.listdir(self.folder))
        self.refused(self.study(2, "--scene", "CrashSq"), "CrashSq", "CrashSk")
        self.refused(self.study(2, "--scene", "CrashSk", "--iterations", "0"), "--iterations")
        self.refused(self.study(2, "--scene", "CrashSk", "--dt", "0.007"), "whole number")
        self.refused(self.study(3, "--scene", "CrashSk", "--output", "no/folder/x.h5"), "no/folder/x.h5")
        program = os.path.join(BIN, "pbstudy")
        self.refused(self.run_command([program]), "pbstudy accuracy")
        self.refused(self.run_command([program, "acuracy"]), "acuracy", "accuracy")
        self.refused(self.pbmpi(2, "--config", "absent.cfg"), "absent.cfg", "--config")
        self.assertEqual(set(os.listdir(self.folder)), before)

    def test_reports_refuse_what_they_cannot_show(self):
        self.made(1, "study.h5", "--scene", "CrashSk", "--iterations", 1, "--stepper", "quick", *FAST, *ONE_DT)
        self.refused(self.report("study.h5", "--budget", "3.33"), "--budget", "unit")
        self.refused(self.report("study.h5", "--scene", "Fight", "--budget", "1ms"), "Fight", "CrashSk")
        self.refused(self.report("study.h5", "--budget", "1us", "--write-config", "p"), "no setting")
        self.refused(self.report("study", "absent.h5"), "absent.h5")
        self.refused(self.report("diff", "study.h5", "study.h5"), "study.h5", "not a pbmpi run")

    def test_help_names_every_option(self):
        result = self.study(1, "--help", "all")
        self.assertEqual(result.returncode, 0)
        for option in ("--scene", "--iterations", "--substeps", "--floor-seeds", "--nature-steps", "--repeats"):
            self.assertIn(option, result.stdout)


class Figures(ProgramTest):
    def test_one_command_draws_both_figures(self):
        result = self.run_command([f"{SOURCE}/jobs/figure8_9.sh", self.path("out"), "CrashSk"],
                                  env={**os.environ, "PATH": PATH, "REPEATS": "1", "SEEDS": "2"})
        self.assertEqual(result.returncode, 0, result.stderr)
        methods = [line.split()[1] for line in result.stdout.splitlines() if line.startswith("CrashSk")]
        self.assertEqual(methods, ["Iter20", "Iter19", "Iter1", "FEEC", "FEEC", "another", "another"])
        self.assertEqual(result.stdout.count("precise_over_delivery: FEEC"), 2)
        with open(self.path("out/figure8_9.html"), encoding="utf-8") as file:
            page = file.read()
        for words in ("Figure 8", "Figure 9", "noise floor", "Constraint, orientation", "equal to Iter20"):
            self.assertIn(words, page)

    def test_a_scene_without_its_reference_is_refused(self):
        self.summary(1, "--scene", "CrashSk", "--iterations", 19, "--output", "run.h5")
        result = self.run_command([*PAPER, "figures", "run.h5"])
        self.assertEqual(result.returncode, 2)
        self.assertIn("20 iterations", result.stderr)
        self.assertEqual(self.run_command([*PAPER, "figures"]).returncode, 2)


if __name__ == "__main__":
    unittest.main()
