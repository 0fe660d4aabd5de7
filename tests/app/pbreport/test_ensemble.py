"""pbreport ensemble against numpy's mean, spread and quantiles of what stands in the files."""
import csv
import json
import os
import re
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ProgramTest  # noqa: E402

QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)


class Ensemble(ProgramTest):
    def run_seeds(self, seeds=(1, 2, 3), *args, ranks=1):
        names = []
        for seed in seeds:
            names.append(f"seed{seed}.h5")
            self.summary(ranks, "--scene", "CrashWa", "--replicas", 2, "--frames", 5, "--solver-seed", seed, "--output", names[-1],
                         *args)
        return names

    def test_a_page_has_results_over_the_parameters_and_the_spread_over_the_frames(self):
        self.write("study.csv", "car.speed\n5\n10\n15\n")
        self.summary(1, "--scene", "CrashSk", "--parameters", "study.csv", "--frames", 3, "--output", "study.h5")
        result = self.report("ensemble", "study.h5", "--over", "worlds", "--html", "study.html", "--quiet")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        with open(self.path("study.html"), encoding="utf-8") as file:
            [sections] = re.findall(r'id="sections-data"[^>]*>(.*?)</script>', file.read(), re.DOTALL)
        charts = {chart["title"]: chart["config"]["data"]["datasets"] for section in json.loads(sections) for chart in section["charts"]}
        with h5py.File(self.path("study.h5")) as file:
            gaps = file["world_results/joint_gap_max"][:]
        self.assertEqual([(one["x"], one["y"]) for one in charts["joint_gap_max over car.speed"][0]["data"]], list(zip((5, 10, 15), gaps)))
        self.assertEqual([one["label"] for one in charts["energy"]], ["mean", "q5", "q95"])

    def ensemble(self, *args):
        result = self.report("ensemble", *args, "--json")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return self.json(result)

    def columns(self, names, path):
        """[runs][...] of a dataset."""
        found = []
        for name in names:
            with h5py.File(self.path(name)) as file:
                found.append(file[path][:])
        return np.array(found)

    def assert_spread(self, table, rows, samples, prefix=""):
        """`samples`: [samples][rows]."""
        def column(name):
            return np.array(table[prefix + name], dtype=float)[rows]
        scale = max(1e-300, np.abs(samples).max())
        np.testing.assert_array_equal(column("count"), len(samples))
        np.testing.assert_allclose(column("mean"), samples.mean(0), rtol=0, atol=1e-13 * scale)
        np.testing.assert_allclose(column("stddev"), samples.std(0, ddof=1), rtol=1e-9, atol=1e-13 * scale)
        np.testing.assert_array_equal(column("min"), samples.min(0))
        np.testing.assert_array_equal(column("max"), samples.max(0))
        for q in QUANTILES:
            np.testing.assert_allclose(column(f"q{100 * q:g}"), np.quantile(samples, q, axis=0), rtol=1e-12, atol=1e-13 * scale)

    def rows_of(self, table, quantity):
        return [i for i, name in enumerate(table["quantity"]) if name == quantity]

    def test_observables_and_frame_times_over_runs(self):
        names = self.run_seeds()
        frames = self.ensemble(*names)["frames"]
        for quantity, join in (("energy", np.sum), ("contacts", np.sum), ("joint_gap", np.max), ("max_penetration", np.max)):
            self.assert_spread(frames, self.rows_of(frames, quantity), join(self.columns(names, f"observables/world/{quantity}"), axis=2))
        momentum = self.columns(names, "observables/world/linear_momentum").sum(axis=2)
        self.assert_spread(frames, self.rows_of(frames, "linear_momentum_y"), momentum[:, :, 1])
        self.assert_spread(frames, self.rows_of(frames, "wall"), self.columns(names, "timings/frame/wall"))
        rows = self.rows_of(frames, "energy")
        self.assertEqual([frames["frame"][i] for i in rows], list(range(8)))
        self.assertEqual([frames["measured"][i] for i in rows], [0] * 3 + [1] * 5)
        self.assertEqual({frames["unit"][i] for i in rows}, {"J"})

    def test_worlds_are_samples_too_of_one_run_or_of_many(self):
        names = self.run_seeds()
        for files in (names, names[:1]):
            found = self.ensemble(*files, "--over", "worlds")
            energy = self.columns(files, "observables/world/energy")
            samples = np.moveaxis(energy, 2, 1).reshape(-1, energy.shape[1])
            self.assert_spread(found["frames"], self.rows_of(found["frames"], "energy"), samples)
            self.assertEqual(self.rows_of(found["frames"], "wall"), [])
            position = self.columns(files, "particles/bodies/position/value")
            runs, num_frames, bodies = position.shape[:3]
            worlds = np.moveaxis(position.reshape(runs, num_frames, 2, bodies // 2, 3), 2, 1).reshape(-1, num_frames, bodies // 2, 3)
            self.assert_positions(found, worlds)

    def assert_positions(self, found, position):
        """`position`: [samples][frames][bodies][3]."""
        mean = position.mean(0)
        distance = np.linalg.norm(position - mean, axis=-1)
        body_rms = np.sqrt((distance**2).mean(0))
        frames, bodies = found["positions"], found["bodies"]
        np.testing.assert_allclose(frames["distance_rms"], np.sqrt((distance**2).mean((0, 2))), rtol=1e-9, atol=1e-14)
        np.testing.assert_allclose(frames["body_rms_max"], body_rms.max(1), rtol=1e-9, atol=1e-14)
        np.testing.assert_allclose(frames["body_rms_q50"], np.quantile(body_rms, 0.5, axis=1), rtol=1e-9, atol=1e-14)
        self.assertEqual(frames["widest_body"][-1], int(body_rms[-1].argmax()))
        measured = distance[:, 3:]
        np.testing.assert_allclose(bodies["distance_rms"], np.sqrt((measured**2).mean((0, 1))), rtol=1e-9, atol=1e-14)
        np.testing.assert_allclose(bodies["distance_max"], measured.max((0, 1)), rtol=1e-9, atol=1e-14)
        np.testing.assert_allclose(np.transpose([bodies[f"last_mean_{axis}"] for axis in "xyz"]), mean[-1], rtol=1e-13, atol=1e-14)

    def test_positions_by_frame(self):
        names = self.run_seeds()
        found = self.ensemble(*names)
        position = self.columns(names, "particles/bodies/position/value")
        self.assert_positions(found, position)
        self.assertGreater(found["positions"]["distance_rms"][-1], 0, "the seeds make a difference")

    def test_contacts_and_times_of_each_world(self):
        self.summary(1, "--scene", "CrashSk", "--replicas", 2, "--frames", 4, "--stepper", "quick", "--record", "islands", "--output", "a.h5")
        worlds = self.ensemble("a.h5", "--over", "worlds")["worlds"]
        with h5py.File(self.path("a.h5")) as file:
            contacts = file["observables/world/contacts"][3:]
            np.testing.assert_allclose(worlds["contacts_mean"], contacts.mean(0), rtol=1e-14)
            np.testing.assert_array_equal(worlds["contacts_max"], contacts.max(0))
            solve, world = file["timings/island/solve"][3:], file["particles/bodies/world"][:]
            np.testing.assert_allclose(worlds["solve_mean"], [solve[:, world == w].sum(1).mean() for w in (0, 1)], rtol=1e-12)
            np.testing.assert_allclose(worlds["collide_mean"], file["timings/space/collide"][3:].mean(0), rtol=1e-12)

    def test_the_csv_and_the_json_have_the_same_numbers(self):
        names = self.run_seeds()
        result = self.report("ensemble", *names, "--csv", "frames.csv", "--json", "--quantiles", 0.1, 0.9)
        self.assertEqual(result.returncode, 0, result.stderr)
        json = self.json(result)
        self.assertIn("q10", json["frames"])
        with open(self.path("frames.csv"), encoding="utf-8") as file:
            lines = list(csv.DictReader(file))
        self.assertEqual(json["runs"]["solver_seed"], ["1", "2", "3"])
        self.assertEqual(json["frames"]["mean"], [float(line["mean"]) for line in lines])
        text = self.report("ensemble", *names).stdout
        self.assertIn("state_hashes: 3 different in 3 runs", text)
        self.assertRegex(text, r"\n +energy +J +[0-9]")
        markdown = self.report("ensemble", *names, "--markdown").stdout.splitlines()
        self.assertEqual(len({line.count("|") for line in markdown if line.startswith("|")}), 1)

    def test_samples_that_are_not_finite_are_counted_apart(self):
        names = self.run_seeds()
        with h5py.File(self.path(names[1]), "r+") as file:
            file["observables/world/energy"][6, 1] = np.nan
            del file["checksums"]
            file.attrs["checksum"] = 0
        frames = self.ensemble(*names)["frames"]
        row = self.rows_of(frames, "energy")[6]
        self.assertEqual((frames["count"][row], frames["nonfinite"][row]), (2, 1))
        with h5py.File(self.path(names[0])) as a, h5py.File(self.path(names[2])) as b:
            self.assertAlmostEqual(frames["mean"][row], (a["observables/world/energy"][6].sum() + b["observables/world/energy"][6].sum()) / 2)

    def refused(self, words, *args):
        result = self.report("ensemble", *args)
        self.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
        self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        self.assertIn(words, result.stderr)

    def test_runs_that_are_no_samples_of_the_same_are_refused_or_named(self):
        names = self.run_seeds((1, 2))
        scene = ["--scene", "CrashWa", "--replicas", 2]
        args = [*scene, "--frames", 5]
        self.refused("name the HDF5 files of two runs", names[0])
        self.summary(1, *args, "--iterations", 7, "--output", "few.h5")
        self.refused("--allow iterations", *names, "few.h5")
        found = self.ensemble(*names, "few.h5", "--allow", "iterations")
        self.assertIn("iterations is ", found["differences"])
        self.assertEqual(found["frames"]["count"][0], 3)
        self.summary(2, *args, "--solver-seed", 2, "--output", "again.h5")
        self.refused("the same sample", *names, "again.h5")
        self.summary(2, *scene, "--solver-seed", 5, "--frames", 3, "--output", "ranks.h5")
        found = self.ensemble(*names, "ranks.h5")
        self.assertIn("ranks is 1 in seed1.h5 and 2 in ranks.h5", found["differences"])
        self.assertEqual(max(found["frames"]["frame"]), 5, "the frames that all have")
        self.summary(1, *args, "--solver-seed", 6, "--record-every", 2, "--output", "rare.h5")
        self.refused("--record-every", *names, "rare.h5")
        self.summary(1, "--scene", "CrashSk", "--frames", 5, "--solver-seed", 7, "--output", "other.h5")
        self.refused("not of one ensemble", *names, "other.h5")
        self.refused("must be runs or worlds", *names, "--over", "bodies")


if __name__ == "__main__":
    unittest.main()
