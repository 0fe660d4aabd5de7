"""jobs/paper/predict.py and the report on its study of a small scene.

With --all every case is stepped with a threshold as large as the scene; without, one."""
import json
import os
import subprocess
import sys
import unittest

import h5py

from pbvalue import BIN, ToolTest  # which adds the folder of harness
from harness import PAPER, SOURCE  # noqa: E402

PREDICT, PBREPORT = [sys.executable, os.path.join(SOURCE, "jobs/paper/predict.py")], os.path.join(BIN, "pbreport")
HAS_SINGLE = os.path.exists(os.path.join(BIN, "pbmpi_ode_single"))
HUGE = 1e9  # a threshold as large as the scene: nothing that is predicted has to do with what is computed
BROKEN = f"FVP({HUGE:g})"
ALL = "--all" in sys.argv
BARS = ["20Iter", "19Iter", "FEEC", "FVP6", "EVP", "FEEC+FVP6"]


class Study(ToolTest):
    def command(self, *words, limit_s=500):
        return subprocess.run([str(word) for word in words], cwd=self.folder, capture_output=True, text=True, timeout=limit_s, check=False)

    def report(self, *options):
        result = self.command(*PAPER, "prediction", "prediction.h5", *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def test_a_study_has_hits_cycles_and_errors_of_each_case(self):
        result = self.command(*PREDICT, "--jobs", 2, "--scene", "2-Cars", "--frames", 1, "--warmup", 1,
                              "--threshold", "1e-6", HUGE, "--detail-scene", "2-Cars", "--time-limit", "60s")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(f"{12 if HAS_SINGLE else 10} cases of 1 scene in prediction.h5", result.stdout)
        self.assertEqual("no pbmpi_ode_single" in result.stdout, not HAS_SINGLE)
        with h5py.File(self.path("prediction.h5")) as file:
            cases = {name.decode(): i for i, name in enumerate(file["cases/name"])}
            self.check_broken(file["cases"])
            self.check_cases(file["cases"], cases)
            self.check_frames(file["frames"], {name: i for name, i in cases.items() if file["cases/ended"][i] and name != BROKEN})
            self.check_sensitivity(file["sensitivity"], cases)
        self.check_report()

    def check_cases(self, table, cases):
        self.assertEqual(list(cases), ["20Iter", "19Iter", "FEEC", "FEEC+FVP6", "FVP6", BROKEN, "FVP6 collision", "FVP6 step", "sor", "sor FVP6",
                                       *(["single", "single FVP6"] if HAS_SINGLE else [])])
        self.assertEqual([name for name, i in cases.items() if table["precision"][i] == b"single"], [n for n in cases if n.startswith("single")])
        for name, i in cases.items():
            if name == BROKEN:
                continue
            if name == "sor FVP6" and not table["ended"][i]:
                self.assertNotEqual(table["exit_code"][i], 0)  # guesses in the whole frame, and a memory of them
                continue
            self.assertEqual(table["ended"][i], 1, name)
            self.assertEqual(table["frames_done"][i], 2, name)
            self.assertEqual(table["errors_known"][i], 1, name)
            is_exact = name in ("20Iter", "FEEC", "sor", "single")  # FEEC leaves the precise state
            self.assertEqual(table["same_hash"][i], int(is_exact), name)
            self.assertEqual(table["nonfinite_step"][i], -1, name)
            self.assertEqual(table["drift_body_position_bands"][i].sum(), (2 if "FEEC" in name else 1) * 10, "10 bodies a frame")
        drift, defect = table["drift_body_position_rms"], table["defect_body_position_rms"]
        self.assertEqual(drift[cases["20Iter"]], 0)
        self.assertGreater(drift[cases["FVP6"]], 0)
        self.assertGreater(defect[cases["FVP6"]], 0)
        self.assertGreater(table["floor_body_position_rms"][cases["20Iter"]], 0)

    def check_frames(self, table, cases):
        rows = {name: [i for i, case in enumerate(table["case"]) if case == index] for name, index in cases.items()}
        for name, own in rows.items():
            self.assertEqual(len(own), 4 if "FEEC" in name else 2, name)
            for i in own:
                is_modelled = table["frame"][i] >= 1 and not name.startswith(("sor", "single")) and bool(table["is_estimate"][i]) == ("FEEC" in name)
                self.assertEqual(table["cycles"][i] > 0, is_modelled, (name, i))
                fuzzy = table["fp_load_fuzzy"][i] + table["fp_operation_fuzzy"][i]
                if name in ("20Iter", "19Iter", "FEEC", "sor", "single"):
                    self.assertEqual(fuzzy, 0, name)
                self.assertLessEqual(table["fp_operation_error_max"][i], 1e-6)
        sums = {name: sum(int(table["fp_operation_fuzzy"][i]) for i in own) for name, own in rows.items()}
        for name in {"FVP6", "FVP6 step", "FEEC+FVP6", "sor FVP6", "single FVP6"} & sums.keys():
            self.assertGreater(sums[name], 0, name)
        executed = {name: sum(int(table["fp_load_executed"][i]) for i in rows[name]) for name in rows}
        self.assertLess(executed["FVP6 collision"], executed["FVP6"])

    def check_sensitivity(self, table, cases):
        self.assertEqual(set(table["case"][:]), {cases["20Iter"], cases["FVP6"]})
        cycles = {table["variant"][i].decode(): int(table["cycles"][i]) for i in range(len(table["case"])) if table["case"][i] == cases["20Iter"]}
        self.assertEqual(len(cycles), 12)
        self.assertGreater(cycles["width 4"], cycles["Table 3"])
        self.assertLess(cycles["all accesses hit"], cycles["Table 3"])
        self.assertGreater(cycles["floating point twice as long"], cycles["Table 3"])

    def check_report(self):
        text = self.report()
        for word in (*BARS, "noise floor", "Hits of floating-point results by engine", "quick double", "The paper's statements",
                     "What other processors would change"):
            self.assertIn(word, text)
        data = json.loads(self.report("--json"))
        self.assertAlmostEqual(data["budget_s"], 1 / 300)
        scene = data["scenes"][0]
        self.assertEqual(list(scene["figure_8"]), BARS)
        self.assertAlmostEqual(sum(scene["mix"].values()), 1)
        self.assertEqual(list(scene["engines"]), [*(["quick single"] if HAS_SINGLE else []), "quick double", "sor"])
        for engine in scene["engines"].values():
            self.assertTrue(0 < engine["exact"]["coverage"] < engine["exact"]["hit_rate"] <= 1)
        for bar in BARS:
            self.assertGreater(scene["figure_8"][bar]["hz"], 300, "2-Cars is small")
            self.assertEqual(scene["figure_8"][bar]["satisfied"], 1)
        with h5py.File(self.path("prediction.h5")) as file:
            cycles = [int(c) for case, frame, c in zip(file["frames/case"], file["frames/frame"], file["frames/cycles"]) if case == 0 and frame >= 1]
        self.assertAlmostEqual(scene["figure_8"]["20Iter"]["hz"], len(cycles) * 3e9 / sum(cycles), places=6)
        findings = {one["statement"]: one for one in data["statements"]}
        self.assertEqual(findings["exact prediction leaves the result as it is"]["finding"], "confirmed")
        self.assertEqual(findings["FVP6 raises Battle2's frame rate by 24 %"]["finding"], "not decidable here", "no Battle2 in it")
        self.assertEqual(findings["results blow up, even with a threshold of 1e-12"]["finding"], "not decidable here", "no such run")
        self.report("--html", "page.html", "--csv", "cases.csv", "--quiet")
        with open(self.path("page.html"), encoding="utf-8") as page:
            self.assertIn("Figure 8 on the modelled processor", page.read())
        with open(self.path("cases.csv"), encoding="utf-8") as csv:
            self.assertEqual(len(csv.readlines()), 13 if HAS_SINGLE else 11)
        self.assertIn("| 2-Cars |", self.report("--markdown"))
        refused = self.command(PBREPORT, "prediction.h5")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("jobs/paper/paper.py prediction", refused.stderr)

    def check_broken(self, table):
        """A run that blows up has its step."""
        names = [name.decode() for name in table["name"]]
        broken = [i for i in range(len(names)) if table["nonfinite_frame"][i] >= 0]
        self.assertGreater(len(broken), 0)
        for i in range(len(names)):
            if table["ended"][i] == 0:
                self.assertGreater(table["threshold"][i], 0, "exact runs end well")
                self.assertTrue(table["exit_code"][i] == -1 or table["exit_code"][i] > 0)
        for i in broken:
            self.assertGreater(table["threshold"][i], 0, "only with fuzzy prediction")
            self.assertIn(table["nonfinite_step"][i], range(-1, 3), "-1: the second run lost none")
        self.assertIn(table["nonfinite_step"][names.index(BROKEN)], range(3))

    @unittest.skipUnless(ALL, "with --all")
    def test_any_run_that_blows_up_has_its_step(self):
        result = self.command(*PREDICT, "--scene", "2-Cars", "--frames", 1, "--warmup", 0, "--threshold", HUGE, "--time-limit", "60s")
        self.assertEqual(result.returncode, 0, result.stderr)
        with h5py.File(self.path("prediction.h5")) as file:
            self.check_broken(file["cases"])

    def test_what_cannot_be_is_refused_before_anything_runs(self):
        for options in (("--threshold", "0"), ("--scene", "3-Cars"), ("--frames", "0"), ("--budget", "-1")):
            result = self.command(*PREDICT, *options)
            self.assertEqual(result.returncode, 2, options)
            self.assertIn(options[0].lstrip("-") if options[0] != "--scene" else "3-Cars", result.stderr)


if __name__ == "__main__":
    unittest.main(argv=[argument for argument in sys.argv if argument != "--all"])
