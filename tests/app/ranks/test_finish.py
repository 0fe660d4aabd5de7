"""--finish newton: the same bits for any ranks, whole and cut, and from a checkpoint; what it leaves; what is refused."""
import os
import sys
import unittest

import h5py

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ODE_LAW, ProgramTest  # noqa: E402

NEWTON = (*ODE_LAW, "--finish", "newton")
RUN = ("--frames", 4, "--warmup", 0)


class Finish(ProgramTest):
    def test_one_world_has_one_hash_whole_and_cut_for_every_instruction_set(self):
        run = ("--scene", "Fight", *RUN, *NEWTON, "--no-output")
        hashes = {self.summary(1, *run, "--decompose", "worlds", "--simd", simd)["state_hash"] for simd in ("auto", "off")}
        hashes |= {self.summary(ranks, *run, "--decompose", "spaces")["state_hash"] for ranks in (1, 2, 3, 4)}
        self.assertEqual(len(hashes), 1)
        self.assertNotEqual(hashes, {self.summary(1, "--scene", "Fight", *RUN, *ODE_LAW, "--no-output")["state_hash"]})

    def test_worlds_have_one_hash_for_1_to_4_ranks(self):
        run = ("--scene", "CrashSk", *RUN, *NEWTON, "--replicas", 4, "--no-output", "--decompose", "worlds")
        self.assertEqual(len({self.summary(ranks, *run)["state_hash"] for ranks in (1, 2, 3, 4)}), 1)

    def test_none_is_the_default_and_the_file_says_which(self):
        run = ("--scene", "CrashSk", *RUN, *ODE_LAW, "--record-residuals")
        plain = self.summary(1, *run, "--output", "plain.h5")["state_hash"]
        self.assertEqual(self.summary(1, *run, "--finish", "none", "--output", "none.h5")["state_hash"], plain)
        self.summary(1, *run, "--finish", "newton", "--output", "newton.h5")
        with h5py.File(self.path("plain.h5")) as none, h5py.File(self.path("newton.h5")) as newton:
            self.assertEqual((none["parameters/finish"][()], newton["parameters/finish"][()]), (b"none", b"newton"))
            self.assertEqual((none["parameters/law"][()], newton["parameters/law"][()]), (b"ode", b"ode"))
            left, now = (file["observables/residual/natural_speed"][:].max() for file in (none, newton))
        self.assertGreater(left, 1e-3)
        self.assertLess(now, 1e-6)

    def test_a_run_goes_on_to_the_same_bits(self):
        run = ("--scene", "CrashSk", *NEWTON, "--warmup", 0, "--no-output")
        whole = self.summary(1, *run, "--frames", 4)["state_hash"]
        self.summary(1, *run, "--frames", 2, "--checkpoint", "state.h5")
        self.assertEqual(self.summary(2, "--resume", "state.h5", "--frames", 4, "--no-output")["state_hash"], whole)

    def test_the_soft_law_and_other_steppers_are_refused(self):
        for options in (("--finish", "newton"), ("--law", "soft", "--finish", "newton"), ("--stepper", "quick", "--finish", "newton")):
            result = self.pbmpi(1, "--scene", "CrashSk", *RUN, "--no-output", *options)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn("--finish", result.stderr)


if __name__ == "__main__":
    unittest.main()
