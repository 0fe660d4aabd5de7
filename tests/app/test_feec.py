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
        mixed = self.summary(2, *args, "--feec", "--estimate-stepper", "sor", "--estimate-precision", "single")
        self.assertEqual(mixed["state_hash"], self.summary(1, *args)["state_hash"])
        self.assertEqual((mixed["estimate"]["stepper"], mixed["estimate"]["precision"]), ("sor", "single"))

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
                    self.assertTrue((file["estimate/coarse_steps"][:] == 3).all())

    def test_what_cannot_estimate_a_cut_world_is_refused_and_by_itself_leaves_it_whole(self):
        args = ["--scene", "Fight", "--frames", 2, "--no-output", "--feec"]
        for options, name in ((["--estimate-after", 1], "--estimate-after"), (["--estimate-stepper", "quick"], "--estimate-stepper quick")):
            refused = self.pbmpi(2, *args, *options, "--decompose", "spaces")
            self.assertEqual(refused.returncode, 2, refused.stderr)
            self.assertIn(name + ": ", refused.stderr)
            self.assertEqual(self.summary(2, *args, *options)["decomposition"], "worlds")

    def test_an_estimate_after_precise_steps_is_nearer_and_leaves_the_run_alone(self):
        for stepper in (["--stepper", "quick"], [], ODE_LAW):
            args = ["--scene", "CrashSk", "--replicas", 3, *stepper, "--iterations", 20]
            alone = self.summary(1, *args, "--no-output")["state_hash"]
            defects = []
            for after in (0, 1, 2):
                estimates = []
                for ranks in (1, 3):
                    summary = self.summary(ranks, *args, "--feec", "--estimate-after", after, "--output", "run.h5")
                    self.assertEqual(summary["state_hash"], alone)
                    self.assertEqual(summary["estimate"]["after_steps"], after)
                    with h5py.File(self.path("run.h5")) as file:
                        self.assertTrue((file["estimate/precise_steps"][:] == after).all())
                        estimates.append(file["estimate/position/value"][:].tobytes())
                self.assertEqual(estimates[0], estimates[1])
                defects.append(summary["estimate"]["position_defect_m"]["rms"])
            self.assertEqual(defects, sorted(defects, reverse=True))
            self.assertLess(defects[2], defects[0])
            source = summary["estimate"]["source"]
            self.assertEqual(source, "same_solve" if stepper == ODE_LAW else "short_run")

    def test_an_estimate_is_there_when_it_is_due_and_leaves_the_run_alone(self):
        for ranks, scene in ((1, "CrashSk"), (3, "CrashSk"), (2, "Fight")):
            args = ["--scene", scene, "--frames", 6]
            alone = self.summary(1, *args, "--no-output")["state_hash"]
            ample = self.summary(ranks, *args, "--feec", "--estimate-by", "100s", "--output", "ample.h5")
            self.assertEqual((ample["state_hash"], ample["estimate"]["source"]), (alone, "until_due"))
            self.assertEqual((ample["estimate"]["due_s"], ample["estimate"]["in_time_fraction"]), (100, 1))
            self.assertEqual(ample["estimate"]["position_defect_m"]["max"], 0, "there is time for the precise frame")
            none = self.summary(ranks, *args, "--feec", "--estimate-by", "0.001us", "--output", "none.h5")
            self.assertEqual((none["state_hash"], none["estimate"]["in_time_fraction"]), (alone, 0))
            self.assertGreater(none["estimate"]["position_defect_m"]["max"], 0)
            with h5py.File(self.path("ample.h5")) as early, h5py.File(self.path("none.h5")) as late:
                has_worlds = early["estimate/precise_steps"][:].max(axis=0) > 0
                self.assertTrue((early["estimate/precise_steps"][:, has_worlds] == 3).all())
                start = late["particles/bodies/position/value"][3:-1]
                # Bodies that no step moved: the first frames count on no time at all for a step that is not known yet.
                self.assertTrue((late["estimate/coarse_steps"][4:] == 0).all() and (late["estimate/precise_steps"][4:] == 0).all())
                gone = late["estimate/position/value"][4:] - start - 0.03 * late["particles/bodies/velocity/value"][3:-1]
                # A sum of two roundings of numbers below 100.
                self.assertLess(np.abs(gone).max(), 1e-13)
            self.assertEqual(self.json(self.report("ample.h5", "--json"))["estimate"], ample["estimate"])
        both = self.pbmpi(1, "--scene", "CrashSk", "--feec", "--estimate-by", "1ms", "--estimate-after", 1)
        self.assertEqual(both.returncode, 2)
        self.assertIn("exclude each other", both.stderr)

    def test_as_many_iterations_as_the_precise_run_leave_no_defect(self):
        for setting in (["--stepper", "quick"], [*ODE_LAW, "--iterations", 20], ["--substeps", 1, "--iterations", 20]):
            summary = self.summary(3, "--scene", "CrashSk", *setting, "--feec", "--estimate-iterations", 20, "--no-output")
            self.assertEqual(summary["estimate"]["position_defect_m"]["max"], 0)

    def test_with_one_step_a_frame_sor_estimates_from_the_same_solve(self):
        ode_law = ["--scene", "CrashSk", "--replicas", 7, *ODE_LAW, "--steps-per-frame", 1, "--frames", 16]
        args = [*ode_law, "--iterations", 20]
        alone = self.summary(1, *args, "--no-output")["state_hash"]
        for ranks in (1, 2, 3, 4):
            summary = self.summary(ranks, *args, "--feec", "--estimate-iterations", 3, "--output", f"run{ranks}.h5")
            self.assertEqual(summary["state_hash"], alone)
            self.assertEqual(summary["estimate"]["source"], "same_solve")
        own = self.summary(2, *args, "--feec", "--estimate-iterations", 3, "--estimate-precision", "single", "--no-output")
        self.assertEqual((own["state_hash"], own["estimate"]["source"]), (alone, "short_run"))
        exact = self.summary(2, *args, "--feec", "--estimate-iterations", 20, "--no-output")["estimate"]
        self.assertEqual((exact["source"], exact["position_defect_m"]["max"]), ("same_solve", 0))
        with h5py.File(self.path("run1.h5")) as one, h5py.File(self.path("run4.h5")) as four:
            for column in ("position/value", "orientation/value"):
                self.assertEqual(one["estimate"][column][:].tobytes(), four["estimate"][column][:].tobytes())
            # The first frame starts where a run of three iterations does, and so is its first frame.
            self.summary(1, *ode_law, "--iterations", 3, "--output", "short.h5")
            with h5py.File(self.path("short.h5")) as short:
                self.assertEqual(one["estimate/position/value"][0].tobytes(),
                                 short["particles/bodies/position/value"][0].tobytes())
            self.assertEqual(one["parameters/estimate_source"][()], b"same_solve")

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
