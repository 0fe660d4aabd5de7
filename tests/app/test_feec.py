"""FEEC from the command line to the file: what it adds, and what it must not change."""
import unittest

import h5py
import numpy as np

from harness import ODE_LAW, ProgramTest


class Feec(ProgramTest):
    def test_the_precise_hash_is_the_same_with_and_without_for_1_to_4_ranks(self):
        for stepper in ("quick", "sor"):
            args = ["--scene", "CrashSk", "--replicas", 7, "--stepper", stepper, "--no-output"]
            alone = self.summary(1, *args)["state_hash"]
            hashes = {self.summary(ranks, *args, "--feec")["state_hash"] for ranks in (1, 2, 3, 4)}
            self.assertEqual(hashes, {alone}, stepper)

    def test_an_estimate_by_another_stepper_does_not_change_the_hash(self):
        args = ["--scene", "CrashSk", "--no-output"]
        mixed = self.summary(2, *args, "--feec=sor precision=single")
        self.assertEqual(mixed["state_hash"], self.summary(1, *args)["state_hash"])
        self.assertEqual((mixed["estimate"]["stepper"], mixed["estimate"]["precision"]), ("sor", "single"))

    def test_a_file_of_options_a_checkpoint_and_the_description_have_what_estimates(self):
        self.write("feec.cfg", "feec = quick iterations=2\n")
        args = ["--scene", "CrashSk", "--config", "feec.cfg", "--frames", 3]
        self.summary(1, *args, "--output", "run.h5", "--checkpoint", "run.checkpoint.h5")
        again = self.summary(2, "--resume", "run.checkpoint.h5", "--frames", 5, "--output", "on.h5")
        self.assertEqual((again["estimate"]["stepper"], again["estimate"]["iterations"]), ("quick", 2))
        for name in ("run.h5", "on.h5"):
            with h5py.File(self.path(name)) as file:
                self.assertEqual((file["parameters/feec"][()], file["parameters/estimate_stepper"][()],
                                  file["parameters/estimate_iterations"][()]), (1, b"quick", 2))
        self.assertIn("estimate: quick, 2 iterations, double precision\n", self.pbmpi(1, *args, "--describe").stdout)

    def test_the_file_holds_what_the_summary_says(self):
        summary = self.summary(2, "--scene", "CrashSk", "--replicas", 4, "--feec", "--output", "run.h5")
        with h5py.File(self.path("run.h5")) as file:
            measured = file["timings/frame/measured"][:] == 1
            estimate, precise = (file[group]["position/value"][measured] for group in ("estimate", "particles/bodies"))
            delivered, completed = (file["estimate"][name][measured] for name in ("delivered", "precise"))
            compute = file["estimate/compute"][measured]
            self.assertEqual(file["parameters/feec"][()], 1)
        distance = np.linalg.norm(estimate - precise, axis=2).ravel()
        defect = summary["estimate"]["position_defect_m"]
        self.assertEqual(defect["count"], distance.size)
        self.assertEqual(sum(defect["bands"]), distance.size)
        # Sums of some hundred squares in another order: 1e-12 is a thousand roundings.
        self.assertAlmostEqual(defect["rms"] / np.sqrt(np.mean(distance**2)), 1, delta=1e-12)
        self.assertAlmostEqual(defect["max"] / distance.max(), 1, delta=1e-12)
        self.assertGreater(defect["max"], 1e-3, "one iteration is visibly off in a crash")
        self.assertTrue((delivered > 0).all() and (delivered < completed).all())
        self.assertTrue((compute > 0).all() and (compute.max(axis=1) < completed).all())
        ratio = summary["estimate"]["precise_over_delivered"]
        self.assertAlmostEqual(ratio / (completed.sum() / delivered.sum()), 1, delta=1e-12)

    def test_a_world_of_many_spaces_is_estimated_in_parts_to_the_same_bits(self):
        for scene, options in (("Fight", []), ("CrashWa", []), ("Battle2", ["--precision", "single"]), ("Environ", ["--effects", "+sleeping"])):
            args = ["--scene", scene, "--frames", 3, *options]
            alone = self.summary(1, *args, "--no-output")["state_hash"]
            for ranks in (1, 2, 3, 4):
                cut = self.summary(ranks, *args, "--feec", "--output", f"run{ranks}.h5")
                self.assertEqual((cut["decomposition"], cut["state_hash"]), ("worlds" if ranks == 1 else "spaces", alone))
                with h5py.File(self.path("run1.h5")) as one, h5py.File(self.path(f"run{ranks}.h5")) as file:
                    for column in ("position/value", "orientation/value"):
                        self.assertEqual(one["estimate"][column][:].tobytes(), file["estimate"][column][:].tobytes(), (scene, ranks))
                    self.assertGreater(np.abs(file["estimate/position/value"][:] - file["particles/bodies/position/value"][:]).max(), 0)

    def test_what_cannot_estimate_a_cut_world_is_refused_and_by_itself_leaves_it_whole(self):
        args = ["--scene", "Fight", "--frames", 2, "--no-output", "--feec=quick"]
        refused = self.pbmpi(2, *args, "--decompose", "spaces")
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertIn("--feec=quick: ", refused.stderr)
        self.assertEqual(self.summary(2, *args)["decomposition"], "worlds")

    def test_as_many_iterations_as_the_precise_run_leave_no_defect(self):
        for setting in (["--stepper", "quick"], [*ODE_LAW, "--iterations", 20], ["--substeps", 1, "--iterations", 20]):
            summary = self.summary(3, "--scene", "CrashSk", *setting, "--feec=iterations=20", "--no-output")
            self.assertEqual(summary["estimate"]["position_defect_m"]["max"], 0)

    def test_an_estimate_is_the_run_of_so_many_iterations_from_where_the_frame_starts(self):
        args = ["--scene", "CrashSk", "--replicas", 7, *ODE_LAW, "--steps-per-frame", 1, "--frames", 16]
        self.summary(3, *args, "--iterations", 20, "--feec=iterations=3", "--output", "run.h5")
        self.summary(1, *args, "--iterations", 3, "--output", "short.h5")
        with h5py.File(self.path("run.h5")) as run, h5py.File(self.path("short.h5")) as short:
            self.assertEqual(run["estimate/position/value"][0].tobytes(), short["particles/bodies/position/value"][0].tobytes())

    def test_pbreport_shows_the_same_estimate_as_pbmpi(self):
        for solve in ([], ["--stepper", "sor", "--steps-per-frame", 1]):
            live = self.summary(2, "--scene", "CrashSk", *solve, "--feec", "--output", "run.h5")
            result = self.report("run.h5", "--json")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(self.json(result)["estimate"], live["estimate"])

    def test_estimates_stay_out_of_a_run_without_feec(self):
        summary = self.summary(1, "--scene", "CrashSk", "--output", "run.h5")
        self.assertNotIn("estimate", summary)
        with h5py.File(self.path("run.h5")) as file:
            self.assertNotIn("estimate", file)


class SolverSeed(ProgramTest):
    def test_it_changes_the_run_but_not_the_scene(self):
        first, other = (self.summary(1, "--scene", "100CrSk", "--replicas", 3, "--solver-seed", seed, "--output",
                                     f"seed{seed}.h5") for seed in (1, 2))
        self.assertNotEqual(first["state_hash"], other["state_hash"])
        with h5py.File(self.path("seed1.h5")) as a, h5py.File(self.path("seed2.h5")) as b:
            start = "particles/bodies/initial_position"
            self.assertEqual(a[start][:].tobytes(), b[start][:].tobytes())
            self.assertEqual((a["parameters/seed"][()], b["parameters/solver_seed"][()]), (1, 2))


if __name__ == "__main__":
    unittest.main()
