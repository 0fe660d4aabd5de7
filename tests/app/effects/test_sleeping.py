"""The effect "sleeping": the same bits everywhere, what is printed of it, and what is refused."""
import os
import sys
import unittest

import h5py

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ProgramTest  # noqa: E402
from small_scenes import STACKS  # noqa: E402

RUN = ("--scene", "stacks.toml", "--frames", 45)


class Sleeping(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("stacks.toml", STACKS)

    def hash_of(self, ranks, *args):
        return self.summary(ranks, *RUN, "--no-output", *args)["state_hash"]

    def test_worlds_have_one_hash_for_1_to_4_ranks(self):
        for stepper in ("quick", "sor"):
            hashes = {self.hash_of(ranks, "--stepper", stepper, "--replicas", 5) for ranks in (1, 2, 3, 4)}
            self.assertEqual(len(hashes), 1, stepper)

    def test_one_world_has_one_hash_whole_and_cut_for_every_instruction_set(self):
        for precision in ("double", "single"):
            sor = ("--stepper", "sor", "--precision", precision)
            hashes = {self.hash_of(1, *sor, "--decompose", "worlds")}
            hashes |= {self.hash_of(ranks, *sor, "--decompose", "spaces") for ranks in (1, 2, 3, 4)}
            for simd in ("off", "sse2", "avx2", "avx512"):
                result = self.pbmpi(1, *RUN, "--no-output", *sor, "--simd", simd, "--report", "json")
                if result.returncode == 2 and "lacks the instruction set" in result.stderr:
                    continue  # not this machine's
                hashes.add(self.json(result)["state_hash"])
            self.assertEqual(len(hashes), 1, precision)

    def test_islands_sleep_until_the_ball_comes(self):
        for stepper in ("quick", "sor"):
            self.summary(1, *RUN, "--stepper", stepper, "--output", "run.h5")
            with h5py.File(self.path("run.h5")) as file:
                rows = file["observables/world/rows"][:, 0]
                islands = file["observables/world/islands"][:, 0]
            self.assertGreater(rows[5], 0)
            self.assertEqual(list(rows[15:20]), [0] * 5, "asleep after 0.3 s, and the shot falls after 0.7 s")
            self.assertEqual(islands[5], islands[18], "islands that sleep are islands")
            self.assertGreater(max(rows[25:]), 0)

    def test_describe_and_summary_say_what_was_demanded(self):
        text = self.pbmpi(1, *RUN, "--describe").stdout
        self.assertIn("after 0.3 s below 0.05 m/s and 0.1 rad/s", text)
        plain = self.summary(1, *RUN[:2], "--frames", 1, "--no-output", "--effects", "-sleeping")
        self.assertNotIn("sleeping", [effect["name"] for effect in plain["effects"]])

    def test_what_cannot_be_is_refused(self):
        for old, new, words in (("after = 0.3", "after = 0", "after"), ("after = 0.3", "speed = -1", "speed"),
                                ("after = 0.3", "afer = 1", "afer")):
            self.write("bad.toml", STACKS.replace(old, new))
            result = self.pbmpi(1, "--scene", "bad.toml", "--describe")
            self.assertEqual(result.returncode, 2, result.stdout)
            self.assertIn("bad.toml:6:", result.stderr)
            self.assertIn(words, result.stderr)
        result = self.pbmpi(1, *RUN, "--stepper", "quick", "--record", "islands")
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertIn("'sleeping'", result.stderr)


if __name__ == "__main__":
    unittest.main()
