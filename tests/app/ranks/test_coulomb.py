"""--law coulomb: the same bits for any ranks, whole and cut, and from a checkpoint; what it leaves; what is refused."""
import os
import sys
import unittest

import h5py

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ODE_LAW, ProgramTest  # noqa: E402

COULOMB = ("--stepper", "sor", "--law", "coulomb")
RUN = ("--frames", 4, "--warmup", 0)


class Coulomb(ProgramTest):
    def test_one_world_has_one_hash_whole_and_cut_for_every_instruction_set(self):
        run = ("--scene", "Fight", *RUN, *COULOMB, "--no-output")
        hashes = {self.summary(1, *run, "--decompose", "worlds", "--simd", simd)["state_hash"] for simd in ("auto", "off")}
        hashes |= {self.summary(ranks, *run, "--decompose", "spaces")["state_hash"] for ranks in (1, 2, 3, 4)}
        self.assertEqual(len(hashes), 1)
        self.assertNotEqual(hashes, {self.summary(1, "--scene", "Fight", *RUN, *ODE_LAW, "--no-output")["state_hash"]})

    def test_worlds_have_one_hash_for_1_to_4_ranks(self):
        run = ("--scene", "CrashSk", *RUN, *COULOMB, "--replicas", 4, "--no-output", "--decompose", "worlds")
        self.assertEqual(len({self.summary(ranks, *run)["state_hash"] for ranks in (1, 2, 3, 4)}), 1)

    def test_it_leaves_far_less_unsolved_than_odes_law_and_the_file_says_which(self):
        run = ("--scene", "CrashSk", *RUN, "--record", "residuals")
        self.summary(1, *run, *ODE_LAW, "--output", "ode.h5")
        self.summary(1, *run, *COULOMB, "--output", "coulomb.h5")
        with h5py.File(self.path("ode.h5")) as ode, h5py.File(self.path("coulomb.h5")) as coulomb:
            self.assertEqual((ode["parameters/law"][()], coulomb["parameters/law"][()]), (b"ode", b"coulomb"))
            left, now = (file["observables/residual/natural_speed"][:].max() for file in (ode, coulomb))
        self.assertGreater(left, 1e-3)
        self.assertLess(now, 1e-6)

    def test_a_run_goes_on_to_the_same_bits(self):
        run = ("--scene", "CrashSk", *COULOMB, "--warmup", 0, "--no-output")
        whole = self.summary(1, *run, "--frames", 4)["state_hash"]
        self.summary(1, *run, "--frames", 2, "--checkpoint", "state.h5")
        self.assertEqual(self.summary(2, "--resume", "state.h5", "--frames", 4, "--no-output")["state_hash"], whole)

    def test_other_steppers_are_refused(self):
        result = self.pbmpi(1, "--scene", "CrashSk", *RUN, "--no-output", "--stepper", "quick", "--law", "coulomb")
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("--law", result.stderr)


if __name__ == "__main__":
    unittest.main()
