"""--on-blowup: what the summary and the file say of worlds that blow up, the same bits everywhere, what is refused."""
import re
import unittest

import h5py

from harness import PBREPORT, ProgramTest

# Balls that fall on a thin plate, and pass it in a step: nothing looks ahead. A heavy one has the ground alone.
SCENE = """title = "balls dropped on a thin plate"
spaces = ["here", "there"]
[effects]
fast_bodies = false
[[actor]]
name = "ground"
type = "ground"
[[actor]]
name = "plate"
type = "box"
static = true
size = [4, 4, 0.02]
position = [0, 0, 1]
[[actor]]
name = "ball"
type = "sphere"
space = "here"
radius = 0.2
mass = 4
position = [0, 0, 60]
variation = { position = [0, 0, 20] }
[[actor]]
name = "other"
type = "sphere"
space = "there"
radius = 0.3
mass = 40
position = [9, 0, 0.3]
"""
RUN = ("--scene", "drop.toml", "--seed", 24, "--frames", 150)
WORLDS = (*RUN, "--replicas", 3)


class Guards(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("drop.toml", SCENE)

    def events(self, name):
        with h5py.File(self.path(name)) as file:
            events = file["events"]
            count = events.attrs["num_events"]
            rows = [dict(zip(("kind", "world", "step", "name", "value"), row)) for row in
                    zip(events["kind"].asstr()[:count], events["world"][:count].tolist(), events["step"][:count].tolist(),
                        events["name"].asstr()[:count], events["value"][:count].tolist())]
            return rows, {kind: int(events.attrs["num_" + kind]) for kind in
                          ("nonfinite", "joint_gap", "energy_gain", "passage", "frozen", "refined")}

    def test_the_file_says_what_was_to_be_done(self):
        self.summary(1, "--scene", "drop.toml", "--frames", 1, "--on-blowup", "freeze", "--record", "residuals", "--output", "run.h5")
        with h5py.File(self.path("run.h5")) as file:
            self.assertEqual(file["parameters/on_blowup"][()], b"freeze")
            self.assertEqual(file["parameters/record_residuals"][()], 1)

    def test_report_is_the_default_and_says_what_where_and_when(self):
        for stepper in ("quick", "sor"):
            summary = self.summary(2, *WORLDS, "--stepper", stepper, "--output", "drop.h5")
            rows, counts = self.events("drop.h5")
            self.assertEqual(counts["passage"], summary["guards"]["passage"])
            passed = [row for row in rows if row["kind"] == "passage"]
            self.assertGreater(len(passed), 0)
            for row in passed:
                self.assertEqual(row["name"], "ball")
                self.assertGreater(row["value"], 0)
                self.assertGreater(row["step"], 250)
            self.assertIn(f"world {passed[0]['world']}: 'ball' went through 'plate'", summary["guards"]["first"])
            self.assertTrue(summary["guards"]["first"].endswith(f"in step {passed[0]['step']}"))
            text = self.run_command([PBREPORT, "drop.h5"]).stdout
            self.assertIn(f"guards: {len(passed)} passage; first: {summary['guards']['first']}", text)

    def test_a_sound_run_says_nothing(self):
        summary = self.summary(1, "--scene", "CrashSk", "--frames", 3, "--output", "crash.h5")
        self.assertEqual(summary["guards"], {"nonfinite": 0, "joint_gap": 0, "energy_gain": 0, "passage": 0, "frozen": 0,
                                             "refined": 0, "first": ""})
        self.assertNotIn("guards", self.pbmpi(1, "--scene", "CrashSk", "--frames", 3, "--no-output").stdout)

    def test_stop_ends_the_run_with_1_and_a_readable_file(self):
        for ranks, args in ((1, WORLDS), (2, WORLDS), (2, (*RUN, "--replicas", 1, "--decompose", "spaces"))):
            result = self.pbmpi(ranks, *args, "--on-blowup", "stop", "--output", "drop.h5")
            self.assertEqual(result.returncode, 1, result.stderr)
            found = re.search(r"world (\d): 'ball' went through 'plate', .* in step (\d+); the run ends here "
                              r"\(--on-blowup stop\), after frame (\d+)", result.stderr)
            self.assertTrue(found, result.stderr)
            self.assertEqual(int(found[2]) // 3, int(found[3]))
            with h5py.File(self.path("drop.h5")) as file:
                self.assertEqual(file.attrs["frames_committed"], int(found[3]) + 1)
                self.assertEqual(file.attrs["complete"], 0)

    def test_freeze_and_refine_have_the_same_bits_on_any_number_of_ranks(self):
        for choice, kind in (("freeze", "frozen"), ("refine", "refined")):
            alone = self.summary(1, *WORLDS, "--on-blowup", choice, "--no-output")
            self.assertGreater(alone["guards"][kind], 0)
            for ranks in (2, 3):
                found = self.summary(ranks, *WORLDS, "--on-blowup", choice, "--no-output")
                self.assertEqual((found["state_hash"], found["guards"]), (alone["state_hash"], alone["guards"]))
            whole, cut = (self.summary(2, *RUN, "--on-blowup", choice, "--decompose", how, "--no-output")
                          for how in ("worlds", "spaces"))
            self.assertGreater(whole["guards"][kind], 0)
            self.assertEqual((cut["state_hash"], cut["guards"]), (whole["state_hash"], whole["guards"]))

    def test_refine_keeps_the_balls_on_the_plate(self):
        summary = self.summary(1, *WORLDS, "--on-blowup", "refine", "--output", "drop.h5")
        self.assertEqual(summary["guards"]["frozen"], 0)
        with h5py.File(self.path("drop.h5")) as file:
            last = file["particles/bodies/position/value"][file.attrs["frames_committed"] - 1]
        self.assertTrue((last[::2, 2] > 1).all(), last)

    def test_a_run_goes_on_from_a_checkpoint_with_what_guards_remember(self):
        for choice in ("report", "freeze", "refine"):
            run = ("--scene", "drop.toml", "--seed", 24, "--replicas", 3, "--on-blowup", choice)
            whole = self.summary(1, *run, "--frames", 150, "--no-output")
            self.summary(2, *run, "--frames", 120, "--no-output", "--checkpoint", "ck.h5")
            found = self.summary(3, "--resume", "ck.h5", "--frames", 150, "--no-output")
            self.assertEqual(found["state_hash"], whole["state_hash"], choice)

    def test_an_estimate_of_a_world_that_stands_is_that_world(self):
        for steps in (1, 3):
            summary = self.summary(1, "--scene", "drop.toml", "--seed", 24, "--on-blowup", "freeze", "--feec", "--steps-per-frame", steps,
                                   "--frames", 450 // steps + 30, "--warmup", 450 // steps, "--no-output")
            self.assertEqual(summary["guards"]["frozen"], 1)
            self.assertEqual(summary["estimate"]["position_defect_m"]["max"], 0)

    def test_what_cannot_be_had_together_is_refused(self):
        result = self.pbmpi(1, *RUN, "--on-blowup", "freeze", "--stepper", "quick", "--record", "islands")
        self.assertEqual(result.returncode, 2)
        self.assertIn("use --on-blowup report or stop", result.stderr)
        result = self.pbmpi(1, *RUN, "--on-blowup", "panic")
        self.assertEqual(result.returncode, 2)
        self.assertIn("it must be one of report, stop, freeze, refine", result.stderr)


if __name__ == "__main__":
    unittest.main()
