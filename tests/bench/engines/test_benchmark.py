"""The benchmark of engines side by side in its small form: rows and errors, not times; and what its tables make of rows."""
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import engines  # noqa: E402

PBMPI = pathlib.Path(os.environ["PBMPI_BIN"]) / "pbmpi"


def has(engine):
    text = " ".join(subprocess.run([PBMPI, "--help", "all"], capture_output=True, text=True, check=True).stdout.split())
    return f"{engine} (" in text.split("Steppers of other engines: ")[1].split("not in this build: ")[0]


def row(engine, setting, ratio, gap_m, penetration_m=0.01, is_default=False):
    return {"scene": "one", "engine": engine, "setting": setting, "is_default": is_default, "people": 0, "why_not": None, "ratio": ratio,
            "ratio_min": ratio, "ratio_max": ratio, "s_per_world_step": 1e-3, "joint_gap_m": gap_m, "penetration_m": penetration_m,
            "energy_drift": None}


class Benchmark(unittest.TestCase):
    def run_quick(self, *options):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "rows.json")
            result = subprocess.run([sys.executable, HERE / "engines.py", "--quick", "--markdown", "--json", path, *options],
                                    capture_output=True, text=True, check=False)
            self.assertEqual(result.returncode, 0, result.stderr)
            with open(path, encoding="utf-8") as file:
                return json.load(file), result.stdout

    def test_each_engine_has_a_row_in_each_scene_with_finite_errors(self):
        result, text = self.run_quick()
        for scene in engines.SCENES:
            for engine in engines.ENGINES:
                rows = [one for one in result["rows"] if (one["scene"], one["engine"]) == (scene, engine)]
                self.assertEqual([one["setting"] for one in rows], [one.name for one in engines.QUICK_SETTINGS[engine]])
                self.assertTrue(rows[0]["is_default"])
                self.assertIn(f"| {scene} | `{engine}` ", text)
                for one in rows:
                    with self.subTest(scene=scene, engine=engine, setting=one["setting"]):
                        self.check_row(one, scene, engine)
        for scene in ("100CrSk", "CrashWa", "humanoids"):
            for engine in engines.ENGINES[1:]:
                if engine in ("bullet", "mujoco") and not has(engine):
                    continue
                self.assertEqual(sum((one["scene"], one["engine"]) == (scene, engine) for one in result["equal_gap"]), 1)

    def check_row(self, one, scene, engine):
        if engine in ("bullet", "mujoco") and not has(engine):
            self.assertIn("not in this build", one["why_not"])
        elif (scene, engine) == ("pyramid100", "mujoco"):
            self.assertIn("addresses no more than", one["why_not"])
        else:
            self.assertIsNone(one["why_not"])
            self.assertEqual(one["joint_gap_m"] is None, scene.startswith("pyramid"))
            self.assertEqual(one["energy_drift"] is None, not scene.startswith("pyramid"))
            for error in engines.errors_of(one):
                self.assertTrue(math.isfinite(error) and error < 0.5, one)
            if scene != "humanoids":  # they still fall in the small form
                self.assertGreater(one["contacts"], 0)

    def test_scenes_and_engines_can_be_chosen(self):
        result, _ = self.run_quick("--scenes", "pyramid15", "--engines", "quick")
        self.assertEqual([(one["scene"], one["engine"]) for one in result["rows"]], [("pyramid15", "quick")])

    def test_a_step_that_takes_too_long_is_told(self):
        result, text = self.run_quick("--scenes", "pyramid15", "--engines", "sor", "--step-limit", "1e-9")
        self.assertEqual(result["rows"][0]["why_not"], "beyond 1e-09 s a step")
        self.assertIn("not run: beyond 1e-09 s a step", text)

    def test_the_page_shows_defaults_what_is_compared_and_the_least_error(self):
        rows = [row("sor", "14 x 1", 1, 0.02, is_default=True), row("sor", "bad", 1.2, 0.021), row("sor", "16 x 1", 2, 0.01),
                row("bullet", "10", 4, 0.010, is_default=True), row("bullet", "5", 2, 0.015), row("bullet", "2", 1.5, 0.1),
                row("bullet", "50", 9, 0.001)]
        result = {"rows": rows, "equal_gap": engines.equal_gap(rows)}
        self.assertEqual([one["setting"] for one in engines.shown(result)], ["14 x 1", "16 x 1", "10", "5", "50"])

    def test_the_aim_is_reached_or_short_by_a_share(self):
        one = {"scene": "CrashWa", "engine": "bullet", "sor_ahead": 1.5}
        self.assertEqual(engines.aim_text(one), "2: short by 25 %")
        self.assertEqual(engines.aim_text({**one, "sor_ahead": 2.5}), "2: reached")
        self.assertEqual(engines.aim_text({**one, "engine": "quick"}), "-")

    def test_at_equal_gap_the_cheapest_setting_counts_and_what_none_reaches_is_told(self):
        rows = [row("sor", "14 x 1", 1, 0.02, is_default=True), row("sor", "16 x 1", 2, 0.005), row("sor", "4 x 1", 0.5, 0.02),
                row("sor", "single 14 x 1", 0.1, 0.001),
                row("bullet", "10", 4, 0.010, penetration_m=0.02, is_default=True), row("bullet", "5", 2, 0.025), row("bullet", "20", 6, 0.01),
                row("quick", "20", 3, 0.03, is_default=True)]
        quick, bullet = engines.equal_gap(rows)
        self.assertEqual((bullet["setting"], bullet["sor_ahead"], bullet["reaches"]), ("10", 4, True))
        self.assertEqual((bullet["setting_both"], bullet["sor_ahead_both"]), ("20", 6))
        self.assertEqual((bullet["sor_setting"], bullet["sor_ahead_at_their_gap"]), ("16 x 1", 2))
        self.assertEqual((bullet["sor_best"], bullet["sor_best_ahead"]), ("4 x 1", 8))
        self.assertEqual((quick["setting"], quick["reaches"], quick["setting_both"]), ("20", False, None))
        self.assertIn("none; nearest: 20", engines.gap_cells(quick)[3])


if __name__ == "__main__":
    unittest.main()
