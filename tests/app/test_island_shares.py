"""--tolerance: the same bits everywhere, less or more work, what is recorded, and what is refused."""
import unittest

import h5py
import numpy as np

from harness import ProgramTest

RUN = ("--scene", "Environ", "--frames", 6, "--warmup", 0)
TOLERANCE = ("--tolerance", "0.1mm")


class IslandShares(ProgramTest):
    def hash_of(self, ranks, *args):
        return self.summary(ranks, *RUN, "--no-output", *args)["state_hash"]

    def test_one_world_has_one_hash_whole_and_cut_for_every_instruction_set(self):
        for precision in ("double", "single"):
            run = (*TOLERANCE, "--precision", precision)
            hashes = {self.hash_of(1, *run, "--decompose", "worlds", "--simd", simd) for simd in ("auto", "off")}
            hashes |= {self.hash_of(ranks, *run, "--decompose", "spaces") for ranks in (1, 2, 3, 4)}
            self.assertEqual(len(hashes), 1, run)
            self.assertNotEqual(hashes, {self.hash_of(1, "--precision", precision)})

    def test_worlds_have_one_hash_for_1_to_4_ranks(self):
        hashes = {self.hash_of(ranks, *TOLERANCE, "--replicas", 4, "--decompose", "worlds") for ranks in (1, 2, 3, 4)}
        self.assertEqual(len(hashes), 1)

    def test_a_length_has_a_unit_or_is_in_metres(self):
        hashes = {self.hash_of(1, "--tolerance", text) for text in ("0.1mm", "0.0001", "0.01cm", "1e-4m")}
        self.assertEqual(len(hashes), 1)
        self.assertEqual(self.hash_of(1, "--tolerance", "0"), self.hash_of(1))

    def test_what_is_no_length_is_refused(self):
        for text in ("-1mm", "1km", "nan", "inf", "much"):
            result = self.pbmpi(1, *RUN, "--no-output", "--tolerance", text)
            self.assertEqual(result.returncode, 2, text)
            self.assertIn(f"--tolerance {text}: ", result.stderr)

    def test_quick_has_no_use_for_it(self):
        result = self.pbmpi(1, *RUN, "--no-output", "--stepper", "quick", *TOLERANCE)
        self.assertEqual(result.returncode, 2)
        self.assertIn("--tolerance", result.stderr)

    def test_the_file_says_how_much_work_was_done(self):
        sweeps = 14 * (1 + 1)
        for cut in ("worlds", "spaces"):
            self.summary(2, *RUN, *TOLERANCE, "--decompose", cut, "--output", f"{cut}.h5")
        self.summary(1, *RUN, "--output", "all.h5")
        with h5py.File(self.path("worlds.h5")) as worlds, h5py.File(self.path("spaces.h5")) as spaces, \
                h5py.File(self.path("all.h5")) as everything:
            visits, rows = (worlds[f"observables/world/{name}"][:, 0] for name in ("row_visits", "rows"))
            self.assertTrue((visits < sweeps * rows).any())
            self.assertTrue((visits >= 2 * rows).all(), "one sweep and a relaxing one at least")
            self.assertTrue(np.array_equal(visits, spaces["observables/world/row_visits"][:, 0]))
            self.assertAlmostEqual(worlds["parameters/tolerance"][()], 1e-4, 15)
            rows = everything["observables/world/rows"][:]
            self.assertTrue(np.array_equal(everything["observables/world/row_visits"][:], sweeps * rows))
            self.assertEqual(everything["parameters/tolerance"][()], 0)

    def test_a_resumed_run_goes_on_with_the_same_bits(self):
        run = ("--scene", "Environ", "--warmup", 0, "--decompose", "worlds", *TOLERANCE)
        whole = self.summary(1, *run, "--frames", 6, "--no-output")["state_hash"]
        self.summary(2, *run, "--frames", 3, "--output", "first.h5", "--checkpoint", "checkpoint.h5")
        resumed = self.summary(2, "--resume", "checkpoint.h5", "--frames", 6, "--output", "second.h5")
        self.assertEqual(resumed["state_hash"], whole)

    def test_an_estimate_leaks_into_nothing(self):
        self.assertEqual(self.hash_of(1, *TOLERANCE, "--feec"), self.hash_of(1, *TOLERANCE))


if __name__ == "__main__":
    unittest.main()
