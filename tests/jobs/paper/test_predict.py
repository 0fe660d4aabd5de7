"""The cases of jobs/paper/predict.py, the programs that it starts, what it makes of their errors, and what it keeps of a study that was stopped."""
import os
import pathlib
import tempfile
import unittest
from unittest import mock

import made_up  # noqa: F401  which adds the folder of what is tested

from predict import Kept
from reports.errors import KINDS
from reports.files import BadInput
from study import child, table_file, tables
from study.cases import ODE_SINGLE, VARIANTS, cases_of, threshold_name
from study.runs import joined_errors

SCENE = {"worlds": 1, "warmup": 3, "frames": 5, "iterations": 20, "bodies": 10, "in_detail": False}


def cases(scenes=(SCENE,), thresholds=(1e-6, 1e-8, 1e-10, 1e-12), full=False, has_single=False):
    return cases_of(scenes, {"thresholds": thresholds, "full": full}, has_single)


class Cases(unittest.TestCase):
    def test_are_figure_8_then_the_other_thresholds_then_sor(self):
        found = cases()
        self.assertEqual([case["name"] for case in found], ["20Iter", "19Iter", "FEEC", "FEEC+FVP6", "FVP6", "FVP8", "FVP10", "FVP12", "sor", "sor FVP6"])
        self.assertEqual((found[0]["threshold"], found[1]["iterations"], found[2]["feec"]), (0, 19, True))
        self.assertTrue(found[4]["has_cycles"])
        self.assertFalse(found[5]["has_cycles"], "in the full form only")
        self.assertEqual((found[8]["stepper"], found[8]["scope"]), ("sor", "all"))

    def test_have_quick_in_single_precision_where_the_build_has_it(self):
        single = cases(has_single=True)[10:]
        self.assertEqual([case["name"] for case in single], ["single", "single FVP6"])
        for case in single:
            self.assertEqual((case["program"], case["stepper"], case["iterations"]), (ODE_SINGLE, "quick", 20))

    def test_have_single_phases_and_variants_in_the_scene_of_details(self):
        found = cases([SCENE | {"in_detail": True}, SCENE], [1e-9])
        self.assertEqual([case["name"] for case in found if case["scope"] != "all"], ["FVP9 collision", "FVP9 step"])
        self.assertEqual([case["name"] for case in found if case["has_variants"]], ["20Iter", "FVP9"])
        self.assertFalse(any(case["has_variants"] for case in cases()))

    def test_in_full_have_cycles_everywhere(self):
        self.assertTrue(all(case["has_cycles"] for case in cases(full=True)))

    def test_cost_more_with_more_models(self):
        hits, cycles, variants = (one["cost"] for one in (cases()[5], cases()[4], cases([SCENE | {"in_detail": True}])[4]))
        self.assertEqual((hits, cycles, variants), (120, 170, 170 + 50 * len(VARIANTS)))

    def test_thresholds_are_named_by_their_power_of_ten(self):
        self.assertEqual(list(map(threshold_name, (1e-6, 1e-12, 5e-7, 1e9))), ["FVP6", "FVP12", "FVP(5e-07)", "FVP(1e+09)"])


class Children(unittest.TestCase):
    def run_script(self, script, limit_s=60):
        with tempfile.TemporaryDirectory() as folder:
            return child.run(["sh", "-c", script], pathlib.Path(folder, "run"), limit_s, PBMPI_WORD="given")

    def test_their_end_is_as_a_shell_gives_it(self):
        self.assertEqual([self.run_script(script).exit_code for script in ("true", "exit 7", "kill -TERM $$")], [0, 7, 128 + 15])
        self.assertEqual(self.run_script("exec sleep 100", 0.2).exit_code, -1)
        with self.assertRaisesRegex(child.RunError, "/no/such/program cannot be started"), tempfile.TemporaryDirectory() as folder:
            child.run(["/no/such/program"], pathlib.Path(folder, "run"), 60)

    def test_a_number_that_is_not_finite_is_a_good_end(self):
        run = self.run_script("echo '1 non-finite body in frame 3' >&2; exit 1")
        self.assertEqual((run.nonfinite_frame, run.has_ended_well), (3, True))
        with self.assertRaisesRegex(child.RunError, "(?s)^case ended with exit code 1:.*bad"):
            self.run_script("echo bad >&2; exit 1").require_end("case")

    def test_get_the_environment_but_not_what_mpirun_has_set(self):
        with mock.patch.dict(os.environ, OMPI_COMM_WORLD_RANK="3", PMIX_RANK="3", PBMPI_WORD="own", PBMPI_OTHER="kept"):
            run = self.run_script('echo "[\\"$PBMPI_WORD\\", \\"$PBMPI_OTHER\\", $(env | grep -cE "^(OMPI|PMIX)_")]"')
        self.assertEqual(run.summary, ["given", "kept", 0])


class Errors(unittest.TestCase):
    def test_of_frames_are_joined(self):
        def frame(rms, largest, bands, broken=0):
            one = {"count": sum(bands) + broken, "broken": broken, "rms": rms, "max": largest, "bands": bands}
            return {f"{kind}_{unit}": one for kind, unit in KINDS.items()}

        joined = joined_errors([frame(3.0, 4.0, [1, 0, 0, 0, 0]), frame(1.0, None, [0, 2, 0, 1, 1], 5)])["joint_position"]
        self.assertAlmostEqual(joined["rms"], ((9 + 3) / 4)**0.5, 12, "over the four that are finite")
        self.assertEqual((joined["max"], joined["bands"], joined["broken"]), (float("inf"), [1, 2, 0, 1, 1], 5))
        self.assertEqual(joined_errors([])["joint_position"], {"rms": 0, "max": 0, "bands": [0] * 5, "broken": 0})


class Tables(unittest.TestCase):
    def test_without_rows_have_the_types_of_their_columns(self):
        columns = {column.name: table_file.stored(column.values) for column in tables.columns([])["cases"]}
        self.assertEqual([(columns[name].dtype.kind, columns[name].shape) for name in ("exit_code", "threshold", "drift_body_position_bands")],
                         [("i", (0,)), ("f", (0,)), ("i", (0, 5))])
        self.assertEqual(columns["scene"].dtype.kind, "S")


class KeptCases(unittest.TestCase):
    def test_are_those_that_ended_before_a_kill_and_of_the_same_study_only(self):
        with tempfile.TemporaryDirectory() as folder:
            output = pathlib.Path(folder, "study.h5")
            kept = Kept(output, {"seed": 1}, False)
            kept.add(3, {"cases": [{"rms": float("inf"), "bands": [1, 0]}]})
            kept.add(0, {"cases": []})
            with open(kept.path, "a", encoding="utf-8") as file:
                file.write('[1, {"cases"')
            again = Kept(output, {"seed": 1}, True)
            self.assertEqual(again.outcomes, {3: {"cases": [{"rms": float("inf"), "bands": [1, 0]}]}, 0: {"cases": []}})
            self.assertEqual(len(kept.path.read_text(encoding="utf-8").splitlines()), 3)
            with self.assertRaisesRegex(BadInput, "of another study"):
                Kept(output, {"seed": 2}, True)
            self.assertEqual(Kept(output, {"seed": 2}, False).outcomes, {})


if __name__ == "__main__":
    unittest.main()
