"""Same bits for any number of ranks, with output on or off, and for every placement."""
import json
import unittest

import h5py

from harness import PBMPI, SOURCE, ProgramTest


class Determinism(ProgramTest):
    def test_100CrSk_has_one_hash_for_1_to_4_ranks_with_and_without_output(self):
        hashes = {self.summary(ranks, "--scene", "100CrSk", *output)["state_hash"]
                  for ranks in (1, 2, 3, 4) for output in (["--no-output"], ["--output", f"run{ranks}.h5"])}
        self.assertEqual(len(hashes), 1, hashes)
        for ranks in (1, 2, 3, 4):
            with h5py.File(self.path(f"run{ranks}.h5")) as file:
                self.assertIn(file.attrs["state_hash"], (*hashes, *(h.encode() for h in hashes)))

    def test_recorded_bodies_are_equal_for_1_and_3_ranks(self):
        runs = []
        for ranks in (1, 3):
            self.summary(ranks, "--scene", "CrashSk", "--replicas", 5, "--output", f"run{ranks}.h5")
            with h5py.File(self.path(f"run{ranks}.h5")) as file:
                bodies = file["particles/bodies"]
                runs.append([bodies[f"{name}/value"][:].tobytes()
                             for name in ("position", "orientation", "velocity", "angular_velocity")])
        self.assertEqual(runs[0], runs[1])

    def test_a_rebalance_does_not_change_the_hash(self):
        scene = f"{SOURCE}/tests/scenes/Unequal.toml"
        args = ["--scene", scene, "--frames", 40, "--no-output"]
        one, three = self.summary(1, *args), self.summary(3, *args)
        self.assertEqual(one["rebalances"]["count"], 0)
        self.assertGreater(three["rebalances"]["count"], 0, "the worlds of this scene are so unequal that they must move")
        self.assertGreater(three["rebalances"]["worlds_moved"], 0)
        self.assertEqual(one["state_hash"], three["state_hash"])

    def test_sor_has_one_hash_for_1_to_4_ranks_and_every_instruction_set(self):
        for precision in ("double", "single"):
            args = ["--scene", "100CrSk", "--stepper", "sor", "--precision", precision, "--no-output"]
            hashes = {self.summary(ranks, *args)["state_hash"] for ranks in (1, 2, 3, 4)}
            for simd in ("off", "sse2", "avx2", "avx512"):
                result = self.pbmpi(1, *args, "--simd", simd, "--report", "json")
                if result.returncode == 2 and "lacks the instruction set" in result.stderr:
                    continue  # not this machine's
                self.assertEqual(result.returncode, 0, result.stderr)
                hashes.add(json.loads(result.stdout)["state_hash"])
            self.assertEqual(len(hashes), 1, precision)

    def test_substeps_and_residuals_have_one_hash_and_one_file_for_1_to_4_ranks(self):
        args = ["--scene", "CrashSk", "--replicas", 7, "--stepper", "sor", "--substeps", 5, "--iterations", 3]
        alone = self.summary(1, *args, "--no-output")["state_hash"]
        residuals = set()
        for ranks in (1, 2, 3, 4):
            summary = self.summary(ranks, *args, "--record", "residuals", "--output", f"run{ranks}.h5")
            self.assertEqual(summary["state_hash"], alone, ranks)
            with h5py.File(self.path(f"run{ranks}.h5")) as file:
                group = file["observables/residual"]
                self.assertEqual(group["natural_speed"].shape, (8, 7))
                residuals.add(tuple(group[name][:].tobytes() for name in sorted(group)))
                for name in ("joint_speed", "joint_turn", "complementarity", "natural_speed", "natural_turn"):
                    self.assertTrue((group[name][:] > 0).all(), name)
        self.assertEqual(len(residuals), 1)

    def test_threads_have_the_hash_of_one_in_each_rank_and_after_a_checkpoint(self):
        args = ["--scene", "100CrSk", "--replicas", 40, "--frames", 8]
        one = self.summary(1, *args, "--no-output")
        self.assertEqual(one["threads"], 1)
        for ranks, threads in ((1, 3), (2, 2)):
            summary = self.summary(ranks, *args, "--threads", threads, "--output", "run.h5")
            self.assertEqual((summary["threads"], summary["state_hash"]), (threads, one["state_hash"]))
            with h5py.File(self.path("run.h5")) as file:
                self.assertEqual(file["parameters/threads"][()], threads)
        self.assertEqual(self.summary(1, *args, "--threads", 2, "--feec", "--no-output")["state_hash"], one["state_hash"])
        self.summary(1, *args[:-1], 3, "--threads", 3, "--no-output", "--checkpoint", "run.ck.h5")
        rest = self.summary(2, "--resume", "run.ck.h5", "--frames", 8, "--threads", 2, "--no-output")
        self.assertEqual(rest["state_hash"], one["state_hash"])

    def test_threads_without_processors_of_their_own_are_warned_of_and_those_without_work_refused(self):
        bound = self.run_command(["taskset", "-c", "0", PBMPI, "--scene", "CrashSk", "--replicas", "2", "--frames", "1",
                                  "--no-output", "--quiet", "--threads", "2"])
        self.assertEqual(bound.returncode, 0, bound.stderr)
        self.assertIn("rank 0 may use 1 processor, on which its 2 threads take turns; start with `mpirun --bind-to none`",
                      bound.stderr)
        for args, message in ((("--scene", "Battle2", "--threads", 2), "cut into spaces with one thread"),
                              (("--scene", "CrashSk", "--threads", 0), "from 1 to 1024"),
                              (("--scene", "CrashSk", "--stepper", "quick", "--threads", 2), "--threads")):
            refused = self.pbmpi(2, *args, "--no-output")
            self.assertEqual(refused.returncode, 2, refused.stderr)
            self.assertIn(message, refused.stderr)

    def test_another_seed_gives_another_hash(self):
        first, second = (self.summary(2, "--scene", "CrashSk", "--seed", seed, "--no-output") for seed in (1, 2))
        self.assertNotEqual(first["state_hash"], second["state_hash"])

    def test_direct_and_quick_give_different_bits_but_the_same_bodies(self):
        quick, direct = (self.summary(2, "--scene", "CrashSk", "--stepper", stepper, "--no-output")
                         for stepper in ("quick", "direct"))
        self.assertNotEqual(quick["state_hash"], direct["state_hash"])
        self.assertEqual((quick["bodies"], direct["stepper"]), (direct["bodies"], "direct"))


if __name__ == "__main__":
    unittest.main()
