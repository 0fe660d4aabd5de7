"""The steppers of engines that a build may lack: the promises of all steppers, and what is said of one that is left out."""
import os
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from harness import BIN, SCENES, SOURCE, ProgramTest  # noqa: E402
from small_scenes import SIGN, STACKS  # noqa: E402

PACKAGES = {"bullet": "libbullet-dev", "mujoco": "libmujoco-dev"}
# Scenes with effects that the engine has, with the frames before a checkpoint and in all.
EFFECTS = {"bullet": ((STACKS, 22, 45), (SIGN, 6, 20)), "mujoco": ((SIGN, 6, 20),)}
# Ten frames of the scenes with hundreds of contacts take MuJoCo minutes.
STEPPED = {"bullet": SCENES, "mujoco": ("2-Cars", "10-Cars", "CrashSk", "100CrSk", "Fight")}
PBSTUDY = os.path.join(BIN, "pbstudy")
ALL = "--all" in sys.argv  # the frames of the long form


class Engines(ProgramTest):
    def in_build(self, engine):
        """Does --help all name the engine before what it says is not in this build?"""
        text = " ".join(self.pbmpi(1, "--help", "all").stdout.split())
        self.assertIn("Steppers of other engines: ", text)
        present = text.split("Steppers of other engines: ")[1].split("not in this build: ")[0]
        return f"{engine} (" in present

    def each(self):
        """The engines of this build; skips the test where there is none."""
        engines = [engine for engine in PACKAGES if self.in_build(engine)]
        if not engines:
            self.skipTest("this build has neither Bullet nor MuJoCo")
        return engines

    def test_what_is_left_out_is_refused_with_what_to_do(self):
        for engine, package in PACKAGES.items():
            if self.in_build(engine):
                continue
            with self.subTest(engine):
                for option, named in ((["--stepper", engine], f"--stepper {engine}"), ([f"--feec={engine}"], f"--feec='{engine}'")):
                    result = self.pbmpi(3, "--scene", "CrashSk", *option)
                    self.assertEqual(result.returncode, 2, result.stderr)
                    lines = [line for line in result.stderr.splitlines() if line.startswith("pbmpi: ")]
                    self.assertEqual(len(lines), 1, result.stderr)
                    for word in (named, package, "configure anew", f"PBMPI_{engine.upper()}"):
                        self.assertIn(word, lines[0])
                self.assertEqual(os.listdir(self.folder), [])

    def test_one_hash_for_1_to_4_ranks_with_and_without_output(self):
        for engine in self.each():
            for scene, replicas in (("CrashSk", 5), ("2-Cars", 3), ("Fight", 2)):
                args = ["--scene", scene, "--replicas", replicas, "--frames", 20 if ALL else 8, "--stepper", engine]
                hashes = {self.summary(ranks, *args, *output)["state_hash"]
                          for ranks, output in ((1, ["--no-output"]), (2, ["--no-output"]), (3, ["--no-output"]),
                                                (4, ["--output", f"{engine}.{scene}.h5"]))}
                self.assertEqual(len(hashes), 1, (scene, hashes))
                with h5py.File(self.path(f"{engine}.{scene}.h5")) as file:
                    self.assertEqual(file["parameters/stepper"].asstr()[()], engine)
                    self.assertIn("double precision", file[f"parameters/library_{engine}"].asstr()[()])

    def test_a_rebalance_does_not_change_the_hash(self):
        for engine in self.each():
            args = ["--scene", f"{SOURCE}/tests/scenes/Unequal.toml", "--frames", 40 if ALL else 20, "--stepper", engine, "--no-output"]
            one, three = self.summary(1, *args), self.summary(3, *args)
            self.assertGreater(three["rebalances"]["worlds_moved"], 0, "the worlds are so unequal that they must move")
            self.assertEqual(one["state_hash"], three["state_hash"])

    def test_a_checkpoint_does_not_change_the_hash(self):
        for engine in self.each():
            args = ["--scene", "100CrSk", "--replicas", 7, "--stepper", engine]
            whole = self.summary(1, *args, "--frames", 12, "--no-output")["state_hash"]
            for ranks, ranks_after in ((1, 2), (3, 1)):
                self.summary(ranks, *args, "--frames", 4, "--no-output", "--checkpoint", "run.ck.h5")
                rest = self.summary(ranks_after, "--resume", "run.ck.h5", "--frames", 12, "--no-output")
                self.assertEqual(rest["state_hash"], whole, (ranks, ranks_after))

    def test_effects_go_on_from_a_checkpoint_too(self):
        for engine in self.each():
            for text, before, frames in EFFECTS[engine]:
                args = ["--scene", self.write("scene.toml", text), "--stepper", engine]
                whole = self.summary(1, *args, "--frames", frames, "--no-output")["state_hash"]
                self.summary(1, *args, "--frames", before, "--no-output", "--checkpoint", "run.ck.h5")
                rest = self.summary(2, "--resume", "run.ck.h5", "--frames", frames, "--no-output")
                self.assertEqual(rest["state_hash"], whole)

    def test_the_scenes_of_the_paper_stay_finite(self):
        for engine in self.each():
            for scene in STEPPED[engine]:
                replicas = ["--replicas", 2] if scene == "100CrSk" else []
                summary = self.summary(1, "--scene", scene, *replicas, "--stepper", engine, "--frames", 10, "--no-output")
                self.assertEqual(summary["invariants"]["nonfinite_bodies"], 0, scene)
                self.assertGreater(summary["contacts"]["mean"], 0, scene)

    def test_contacts_are_recorded_with_forces_that_carry_the_weight(self):
        scene = self.write("box.toml", BOX)
        for engine in self.each():
            self.summary(1, "--scene", scene, "--stepper", engine, "--frames", 20, "--record", "contacts", "--output", "run.h5")
            hashes = {self.summary(ranks, "--scene", "CrashSk", "--replicas", 3, "--stepper", engine, "--frames", 8, *record,
                                   "--output", "other.h5")["state_hash"] for ranks, record in ((1, []), (2, ["--record", "contacts"]))}
            self.assertEqual(len(hashes), 1, "what is recorded moves no bit")
            with h5py.File(self.path("run.h5")) as file:
                first, count = (file["contacts/frame"][name][-1] for name in ("first", "count"))
                columns = file["contacts/point"].attrs["columns"].decode().split()
                last = file["contacts/point"][first:first + count]
                self.assertGreaterEqual(count, 3)
                # A box of 10 kg at rest; solvers leave a hundredth of its weight over.
                self.assertAlmostEqual(last[:, columns.index("normal_force")].sum() / 98.1, 1, delta=0.02)
                self.assertTrue(np.isfinite(last).all())

    def test_estimates_by_and_for_an_engine_leave_its_bits(self):
        for engine in self.each():
            args = ["--scene", "CrashSk", "--stepper", engine, "--frames", 6, "--no-output"]
            alone = self.summary(1, *args)["state_hash"]
            for feec in ("--feec", "--feec=sor"):
                summary = self.summary(2, *args, feec)
                self.assertEqual(summary["state_hash"], alone)
                self.assertGreater(summary["estimate"]["position_defect_m"]["count"], 0)

    def test_options_of_others_and_cut_worlds_are_refused(self):
        for engine in self.each():
            for options, word in ((["--substeps", 4], "--substeps"), (["--law", "soft"], "--law"), (["--threads", 2], "--threads"),
                                  (["--precision", "single"], "--precision"), (["--decompose", "spaces"], "--decompose"),
                                  (["--record", "residuals"], "--record residuals"), (["--record", "islands"], "--record islands")):
                result = self.pbmpi(2, "--scene", "Fight", "--stepper", engine, *options)
                self.assertEqual(result.returncode, 2, (options, result.stderr))
                self.assertIn(word, result.stderr)
                self.assertEqual(result.stdout, "")

    def test_describe_says_what_is_taken_otherwise(self):
        for engine in self.each():
            result = self.pbmpi(1, "--scene", "CrashSk", "--stepper", engine, "--describe")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertTrue([line for line in result.stdout.splitlines() if line.startswith(f"{engine}: ")], result.stdout)

    def test_a_study_says_of_which_cases_mujoco_has_no_run(self):
        if not self.in_build("mujoco"):
            self.skipTest("this build has no MuJoCo")
        result = self.run_command([PBSTUDY, "stability", "--scene", "hard/sleep/at_rest", "hard/free/tumbling_box", "--setting", "mujoco",
                                   "--output", "stability.h5", "--progress", "never"])
        self.assertEqual(result.returncode, 0, result.stderr)
        with h5py.File(self.path("stability.h5")) as file:
            verdicts, reasons = (file[f"cases/{name}"].asstr()[:] for name in ("verdict", "decided_by"))
            self.assertEqual([verdict == "n/a" for verdict in verdicts], [True, False])
            self.assertIn("'sleeping'", reasons[0])

    def test_studies_take_them_when_they_are_named(self):
        for engine in self.each():
            result = self.run_command([PBSTUDY, "stability", "--scene", "hard/rest/column20", "--setting", f"{engine} iterations=20",
                                       "--output", f"{engine}.stability.h5", "--progress", "never"])
            self.assertEqual(result.returncode, 0, result.stderr)
            result = self.run_command([PBSTUDY, "accuracy", "--scene", "2-Cars", "--stepper", engine, "--iterations", "5", "20", "--frames",
                                       "2", "--repeats", "1", "--floor-seeds", "1", "--nature-steps", "24", "--rest-seconds", "0", "--estimates", "0",
                                       "--output",
                                       f"{engine}.accuracy.h5", "--progress", "never"])
            self.assertEqual(result.returncode, 0, result.stderr)


BOX = """\
title = "a box at rest"
[[actor]]
type = "ground"
name = "ground"
[[actor]]
type = "box"
name = "box"
position = [0, 0, 0.5]
size = [1, 1, 1]
mass = 10
"""

if __name__ == "__main__":
    unittest.main(argv=[argument for argument in sys.argv if argument != "--all"])
