"""Runs of the unmodified pbmpi under pbvalue: counts beside callgrind's, and results that exact prediction leaves."""
import json
import os
import shutil
import subprocess
import sys
import unittest

import h5py
import numpy

from pbvalue import BIN, ToolTest, total

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(SOURCE, "jobs"))

import figure3  # noqa: E402

PBMPI, SINGLE = os.path.join(BIN, "pbmpi"), os.path.join(BIN, "pbmpi_ode_single")
OPTIONS = ("--scene", "2-Cars", "--stepper", "quick", "--no-output", "--report", "json")
MIX = {"floating point": "floating_point", "integer": "integer", "branch": "branch", "store": "store", "load": "load"}


class Runs(ToolTest):
    def run_scene(self, *options, scene=("2-Cars", "--stepper", "quick")):
        """(report, summary) of a run under the tool."""
        report, out = self.run_tool([PBMPI, "--scene", *scene, "--no-output", "--report", "json"], *options)
        return report, json.loads(out)

    def native(self, scene=("2-Cars", "--stepper", "quick")):
        out = subprocess.run([PBMPI, "--scene", *scene, "--no-output", "--report", "json"], capture_output=True, check=True, timeout=60,
                             env=self.environment)
        return json.loads(out.stdout)

    def test_exact_prediction_leaves_every_bit_of_a_result(self):
        native = self.native()["state_hash"]
        for options in (("--predict=none",), ("--predict=all",), ("--scope=frame", "--predict=all", "--table-entries=0"),
                        ("--threshold=0",)):
            report, summary = self.run_scene(*options)
            self.assertEqual(summary["state_hash"], native, options)
            if options != ("--predict=none",):
                self.assertGreater(total(report, "fp_load", "exact"), 1000, options)

    def test_exact_prediction_leaves_the_vectors_of_sor(self):
        scene = ("2-Cars", "--stepper", "sor")
        for scope in ("frame", "all"):
            report, summary = self.run_scene(f"--scope={scope}", "--predict=all", scene=scene)
            self.assertEqual(summary["state_hash"], self.native(scene)["state_hash"])
            self.assertGreater(total(report, "fp_operation", "exact"), 1000)

    def test_sor_marks_its_phases(self):
        executed = {}
        for scope in ("collision", "step", "all", "frame"):
            report, _ = self.run_scene(f"--scope={scope}", scene=("CrashSk", "--stepper", "sor"))
            executed[scope] = total(report, "fp_operation", "executed")
            for section in report["sections"]:
                self.assertGreater(section["collision_instructions"], 0)
                self.assertGreater(section["forward_instructions"], section["collision_instructions"])
                self.assertLess(section["collision_instructions"] + section["forward_instructions"], section["instructions"])
        self.assertAlmostEqual((executed["collision"] + executed["step"]) / executed["all"], 1, delta=1e-3)
        self.assertLess(executed["collision"], executed["step"])
        self.assertLess(executed["all"], executed["frame"])

    def test_a_threshold_changes_the_result_which_repeats_to_the_bit(self):
        # The canary of the stack protector, which is read as padding, was another one in each process.
        runs = [self.run_scene("--threshold=1e-6") for _ in range(3)]
        report, summary = runs[0]
        self.assertNotEqual(summary["state_hash"], self.native()["state_hash"])
        self.assertGreater(total(report, "fp_operation", "fuzzy"), 0)
        for section in report["sections"]:
            for numbers in section["classes"].values():
                self.assertLessEqual(numbers["error_max"], 1e-6)
        for again, again_summary in runs[1:]:
            self.assertEqual(again_summary["state_hash"], summary["state_hash"])
            self.assertEqual(again["sections"], report["sections"])

    def test_with_a_table_for_all_a_fuzzy_run_does_not_follow_the_addresses_of_code(self):
        options = ("--threshold=1e-6", "--table-entries=0")
        report, summary = self.run_scene(*options)
        self.environment["LD_PRELOAD"] = os.environ["PBMPI_SPACER"]
        moved, moved_summary = self.run_scene(*options)
        self.assertNotEqual(summary["state_hash"], self.native()["state_hash"])
        self.assertEqual(moved_summary["state_hash"], summary["state_hash"])
        self.assertEqual(moved["sections"], report["sections"])

    def test_each_frame_is_a_section_and_each_estimate_one(self):
        report, _ = self.run_scene(scene=("2-Cars", "--stepper", "quick", "--feec"))
        self.assertEqual([s["section"] for s in report["sections"]], ["estimate", "precise"] * 8)
        for section in report["sections"]:
            self.assertTrue(section["complete"])
            inside = section["collision_instructions"] + section["forward_instructions"]
            self.assertTrue(0.5 * section["instructions"] < inside < section["instructions"])

    @unittest.skipUnless(os.path.exists(SINGLE), "this build has no ODE in single precision")
    def test_quick_in_single_precision_is_near_quick_and_holds_single_numbers(self):
        positions = {}
        for program in (PBMPI, SINGLE):
            subprocess.run([program, "--scene", "2-Cars", "--stepper", "quick", "--warmup", "0", "--frames", "1", "--quiet",
                            "--output", self.path("run.h5")], check=True, timeout=60, env=self.environment)
            with h5py.File(self.path("run.h5")) as file:
                positions[program] = file["particles/bodies/position/value"][:]
                self.assertEqual(file["parameters/library_ode"][()].endswith(b", single precision"), program == SINGLE)
            os.remove(self.path("run.h5"))
        single, double = positions[SINGLE], positions[PBMPI]
        self.assertTrue((single == single.astype(numpy.float32)).all())
        self.assertFalse((double == double.astype(numpy.float32)).all())
        # A last place at 10 m is 1e-6 m; the frame's 60 sweeps over the rows may add up some of them.
        self.assertLess(abs(single - double).max(), 1e-5)

    @unittest.skipUnless(os.path.exists(SINGLE), "this build has no ODE in single precision")
    def test_exact_prediction_leaves_every_bit_in_single_precision(self):
        native = subprocess.run([SINGLE, *OPTIONS], capture_output=True, check=True, timeout=60, env=self.environment)
        report, out = self.run_tool([SINGLE, *OPTIONS], "--predict=all")
        self.assertEqual(json.loads(out)["state_hash"], json.loads(native.stdout)["state_hash"])
        self.assertGreater(total(report, "fp_load", "exact"), 1000)

    @unittest.skipUnless(shutil.which("objdump"), "no objdump")
    def test_instructions_and_their_mix_are_those_of_callgrind(self):
        frame = "pbmpi::stepping::SlotStepper::advance(int, pbmpi::core::PhaseTimes&)"
        code = {}  # of the object files, which both scenes execute
        for scene in ("2-Cars", "CrashSk"):
            prefix = self.path(scene + ".callgrind")
            subprocess.run(["valgrind", "--quiet", "--tool=callgrind", f"--callgrind-out-file={prefix}", f"--toggle-collect={frame}",
                            f"--dump-after={frame}", "--dump-instr=yes", "--dump-line=no", "--compress-pos=no", "--compress-strings=no",
                            PBMPI, "--scene", scene, "--stepper", "quick", "--no-output", "--quiet"],
                           capture_output=True, check=True, timeout=250, env=self.environment)
            dumps = sorted((p for p in figure3.pathlib.Path(self.folder).glob(scene + ".callgrind.*")), key=lambda p: int(p.suffix[1:]))
            expected = figure3.summarize(dumps[figure3.WARMUP:], code)
            report, _ = self.run_scene("--predict=none", scene=(scene, "--stepper", "quick"))
            sections = report["sections"][figure3.WARMUP:]
            self.assertEqual(len(sections), expected["frames"])
            counted = sum(s["instructions"] for s in sections) / len(sections)
            self.assertAlmostEqual(counted / expected["instructions_per_frame"], 1, delta=0.01)
            operations = sum(sum(s["mix"].values()) for s in sections)
            for name, key in MIX.items():
                share = sum(s["mix"][key] for s in sections) / operations
                self.assertAlmostEqual(share, expected["mix"][name], delta=0.01 * expected["mix"][name] + 1e-4, msg=(scene, name))


if __name__ == "__main__":
    unittest.main()
