"""pbstudy accuracy: errors against the steppers' own solutions, end to end."""
import os
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import BIN, ProgramTest  # noqa: E402

FAST = ["--frames", 2, "--repeats", 1, "--nature-steps", 24, "--rest-seconds", 0, "--estimates", 0, "--dt", 0.01]
OWN = ["--own-iterations", 160, "--own-most-iterations", 2560, "--floor-seeds", 2]


class OwnSolution(ProgramTest):
    def made(self, ranks, name, *args):
        command = ["mpirun", "-n", str(ranks), os.path.join(BIN, "pbstudy"), "accuracy", *map(str, args), "--output", name, "--quiet"]
        result = self.run_command(command)
        self.assertEqual(result.returncode, 0, result.stderr)
        with h5py.File(self.path(name)) as file:
            self.assertEqual(list(file.attrs["version"]), [1, 8])
            self.assertIn("library_ode", file["parameters"])
            return {key: column[:] for key, column in file["cases"].items()}

    def test_own_columns_are_the_same_for_any_number_of_ranks(self):
        args = ["--scene", "CrashSk", "2-Cars", "--stepper", "quick", "direct", "sor", "--iterations", 2, "--substeps", 2, *FAST, *OWN]
        one, two = self.made(1, "one.h5", *args), self.made(2, "two.h5", *args)
        compared = [name for name in one if name.startswith("own")]
        self.assertEqual(len(compared), 1 + 4 * 6 + 2, "the case, four errors in six columns, joints that are broken")
        for name in [*compared, "solve_iterations", "defect_body_position_rms"]:
            self.assertEqual(one[name].tobytes(), two[name].tobytes(), name)
        kinds = one["kind"]
        setting, own, floor = (kinds == kind for kind in (b"setting", b"own", b"own_floor"))
        # quick, direct, and sor with both laws in two substeps: their precisions share a solution.
        self.assertEqual((setting.sum(), own.sum(), floor.sum()), (2 * (1 + 1 + 2 + 2), 2 * 4, 2 * 3 * 2))
        self.assertTrue((one["own"][~(setting | own | floor)] == -1).all())
        for index in np.flatnonzero(setting | floor):
            of = one["own"][index]
            self.assertEqual(kinds[of], b"own")
            for name in ("scene", "stepper", "dt", "substeps", "law"):
                self.assertEqual(one[name][of], one[name][index], name)
        self.assertTrue((one["own"][own] == np.flatnonzero(own)).all())
        entries = one["own_defect_body_position_bands"].sum(axis=1)
        self.assertTrue((entries[setting | own | floor] > 0).all())
        self.assertTrue((entries[~(setting | own | floor)] == 0).all())

    def test_what_is_solved_has_no_error_and_what_is_crude_has(self):
        # 2-Cars settle on their wheels in each of the frames: all converge.
        study = self.made(1, "study.h5", "--scene", "2-Cars", "--stepper", "quick", "direct", "sor", "--iterations", 1, 4000,
                          "--substeps", 1, "--precision", "double", "--max-sweeps", 10000, *FAST, *OWN)
        error = {(kind, stepper, iterations): rms for kind, stepper, iterations, law, rms in
                 zip(study["kind"], study["stepper"], study["iterations"], study["law"], study["own_defect_body_position_rms"])
                 if law == b"ode"}
        for stepper in (b"quick", b"sor"):
            solved, crude = (error[b"setting", stepper, iterations] for iterations in (4000, 1))
            self.assertLess(solved, 1e-5, "the residual asked for")
            self.assertGreater(crude, 1e-3, "a car of one iteration sinks into its wheels")
            self.assertLess(error[b"own", stepper, 160], 1e-5, "a quarter of the iterations gives it as well")
        self.assertEqual(error[b"setting", b"direct", 1], 0, "elimination leaves nothing")
        self.assertEqual(error[b"own", b"direct", 1], 0)
        floor = study["own_defect_body_position_max"][study["kind"] == b"own_floor"]
        self.assertTrue((floor > 0).all(), "a disturbed start ends elsewhere")
        self.assertTrue((floor < 1e-4).all())

    def test_0_iterations_leave_it_out(self):
        study = self.made(1, "study.h5", "--scene", "2-Cars", "--stepper", "quick", "--iterations", 1, *FAST, "--own-iterations", 0)
        self.assertFalse(np.isin(study["kind"], [b"own", b"own_floor"]).any())
        self.assertTrue((study["own"] == -1).all())
        self.assertNotIn("Own solutions", self.report("study.h5").stdout)

    def test_reports_show_both_errors_apart(self):
        self.made(2, "study.h5", "--scene", "CrashSk", "--stepper", "quick", "sor", "--iterations", 1, 20, "--substeps", 1, "--precision",
                  "double", *FAST, *OWN)
        text = self.report("study.h5").stdout
        for words in ("Own solutions\neach stepper's equations", "own rms mm"):
            self.assertIn(words, text)
        [study] = self.json(self.report("study.h5", "--json"))["scenes"]
        self.assertEqual([own["stepper"] for own in study["own"]], ["quick", "sor", "sor"])
        self.assertGreater(study["front"][0]["own_error_m"], 0)


if __name__ == "__main__":
    unittest.main()
