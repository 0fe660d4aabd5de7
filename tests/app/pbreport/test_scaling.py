"""pbreport scaling against numpy's view of the runs' files, and what jobs/scaling.sh makes."""
import csv
import os
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ProgramTest, SOURCE  # noqa: E402

PHASES = ("collide", "islands", "rows", "solve", "integrate", "cross_space", "ship", "gather", "wait", "output")


class Scaling(ProgramTest):
    def run_point(self, name, ranks, *args):
        return self.summary(ranks, *args, "--frames", 4, "--output", name)

    def scaling(self, *args):
        result = self.report("scaling", *args, "--json")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return self.json(result)

    def rows(self, table):
        names = list(table)
        return [dict(zip(names, row)) for row in zip(*table.values())]

    def measured(self, name):
        """Frames [T], ranks' phases {name: [T][R]} and counts of the measured frames."""
        with h5py.File(self.path(name)) as file:
            keep = file["timings/frame/measured"][:] == 1
            return (file["timings/frame/wall"][:][keep], {phase: file[f"timings/rank/{phase}"][:][keep] for phase in PHASES},
                    {key: file[f"timings/rank/{key}"][:][keep].sum(1).mean() for key in ("messages", "bytes")})

    def test_strong_scaling_of_one_world_cut_into_spaces(self):
        files = {(ranks, k): f"r{ranks}k{k}.h5" for k in (1, 2, 3) for ranks in (1, 2)}
        for (ranks, _), name in files.items():
            self.run_point(name, ranks, "--scene", "Battle2", "--decompose", "spaces")
        found = self.scaling(*files.values(), "--least-repeats", 3, "--widest-interval", 1000)
        base, two = self.rows(found["points"])
        self.assertEqual((base["ranks"], base["is_base"], base["speed_up"]), (1, 1, 1))
        self.assertEqual((two["kind"], two["decomposition"], two["ranks"], two["repeats"], two["ideal_speed_up"]),
                         ("strong", "spaces", 2, 3, 2))
        ratios = [self.measured(files[1, k])[0].sum() / self.measured(files[2, k])[0].sum() for k in (1, 2, 3)]
        np.testing.assert_allclose([two["speed_up"], two["speed_up_low"], two["speed_up_high"]],
                                   [np.median(ratios), min(ratios), max(ratios)], rtol=1e-12)
        np.testing.assert_allclose(two["efficiency"], np.median(ratios) / 2, rtol=1e-12)
        self.assertEqual(two["confidence"], 0.75)
        self.assertEqual((two["reportable"], two["doubts"]), (1, ""))
        balance, serial, transfer, counts = [], [], [], []
        for k in (1, 2, 3):
            wall, phases, count = self.measured(files[2, k])
            useful = sum(phases[phase] for phase in PHASES[:6]).sum(0)
            ideal = wall.sum() - (phases["ship"] + phases["gather"]).sum(0).min()
            balance.append(useful.mean() / useful.max())
            serial.append(useful.max() / ideal)
            transfer.append(ideal / wall.sum())
            counts.append((count["messages"], count["bytes"]))
        for key, values in (("load_balance", balance), ("serialisation", serial), ("transfer", transfer)):
            self.assertAlmostEqual(two[key], np.median(values), places=9)
        self.assertEqual((two["messages"], two["bytes"]), tuple(np.median(counts, axis=0)))
        self.assertGreater(two["messages"], 0)
        for row in self.rows(found["phases"]):
            times = [self.measured(files[row["ranks"], k])[1][row["phase"]].mean() for k in (1, 2, 3)]
            self.assertAlmostEqual(row["time"], np.median(times), places=12)
        self.assertEqual(sorted(row["file"] for row in self.rows(found["runs"])), sorted(files.values()))
        self.assertEqual(len({row["state_hash"] for row in self.rows(found["runs"])}), 1)

    def test_weak_scaling_of_worlds_and_what_is_in_no_curve(self):
        for ranks in (1, 2, 3):
            self.run_point(f"r{ranks}.h5", ranks, "--scene", "CrashSk", "--replicas", 2 * ranks)
        self.run_point("other.h5", 1, "--scene", "CrashSk", "--replicas", 5)
        found = self.rows(self.scaling("r1.h5", "r2.h5", "r3.h5", "other.h5")["points"])
        self.assertEqual([(row["kind"], row["ranks"], row["worlds"]) for row in found],
                         [("weak", 1, 2), ("weak", 2, 4), ("weak", 3, 6)])
        walls = [self.measured(f"r{ranks}.h5")[0].sum() for ranks in (1, 2, 3)]
        np.testing.assert_allclose([row["efficiency"] for row in found], [walls[0] / wall for wall in walls], rtol=1e-12)
        np.testing.assert_allclose([row["speed_up"] for row in found], [r * walls[0] / walls[r - 1] for r in (1, 2, 3)], rtol=1e-12)
        self.assertEqual({row["reportable"] for row in found}, {0})
        self.assertTrue(found[1]["doubts"].startswith("1 of 5 repeats"), found[1])
        text = self.report("scaling", "r1.h5", "r2.h5", "r3.h5", "other.h5").stdout
        self.assertIn("CrashSk, 2 worlds a rank, sor double: weak scaling, worlds over ranks", text)
        self.assertIn("left out: other.h5", text)

    def test_the_largest_island_bounds_a_cut_world(self):
        for ranks in (1, 2):
            run = self.run_point(f"r{ranks}.h5", ranks, "--scene", "Fight", "--decompose", "spaces")
        point = self.rows(self.scaling("r1.h5", "r2.h5")["points"])[1]
        self.assertAlmostEqual(point["island_bound"], run["spaces"]["island_bound"], places=9)
        self.assertAlmostEqual(point["root_share"], run["spaces"]["serial_share"], places=9)

    def test_forms_hold_the_same_numbers(self):
        for ranks in (1, 2):
            self.run_point(f"r{ranks}.h5", ranks, "--scene", "CrashSk", "--replicas", 4)
        found = self.scaling("r1.h5", "r2.h5", "--csv", "points.csv", "--html", "page.html")
        with open(self.path("points.csv"), encoding="utf-8", newline="") as file:
            lines = list(csv.DictReader(file))
        self.assertEqual([float(line["speed_up"]) for line in lines], found["points"]["speed_up"])
        self.assertEqual([float(line["frame_time [s]"]) for line in lines], found["points"]["frame_time"])
        markdown = self.report("scaling", "r1.h5", "r2.h5", "--markdown").stdout
        self.assertIn(f"| {found['points']['speed_up'][1]:.3f} (", markdown)
        with open(self.path("page.html"), encoding="utf-8") as file:
            self.assertIn("strong scaling, worlds over ranks", file.read())

    def test_what_cannot_be_compared_is_refused(self):
        self.run_point("a.h5", 1, "--scene", "CrashSk")
        self.run_point("b.h5", 1, "--scene", "CrashSk", "--seed", 2)
        self.write("text.h5", "no file of a run")
        for args, words in ((["a.h5"], "1 files are given"), (["a.h5", "b.h5"], "different numbers of ranks"),
                            (["a.h5", "text.h5"], "text.h5"), (["a.h5", "b.h5", "--json", "--markdown"], "one of the two"),
                            (["a.h5", "b.h5", "--table", "frames"], "there is no such table; known: 'points', 'phases', 'runs'"),
                            (["a.h5", "b.h5", "--least-repeats", "0"], "--least-repeats"),
                            (["a.h5", "b.h5", "--widest-interval", "-1"], "--widest-interval")):
            result = self.report("scaling", *args)
            self.assertEqual(result.returncode, 2, result.stdout)
            self.assertIn(words, result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)


class Sweep(ProgramTest):
    def sweep(self, *args):
        return self.run_command([os.path.join(SOURCE, "jobs", "scaling.sh"), *args])

    def test_runs_each_point_in_each_round_and_goes_on_where_it_was_stopped(self):
        args = ("--frames", "2", "--repeats", "2", "--ranks", "1 2", "out", "CrashSk:worlds:4", "CrashSk:each:2", "Fight:spaces")
        result = self.sweep(*args)
        self.assertEqual(result.returncode, 0, result.stderr)
        runs = sorted(name for name in os.listdir(self.path("out")) if name.endswith(".h5"))
        self.assertEqual(runs, sorted([f"{point}-k{k}.h5" for k in (1, 2) for point in (
            "CrashSk-worlds-w4-r1", "CrashSk-worlds-w4-r2", "CrashSk-worlds-w2-r1", "Fight-worlds-w1-r1", "Fight-spaces-w1-r1",
            "Fight-spaces-w1-r2")]), "two ranks with two worlds each are two ranks with four")
        for form in ("html", "txt", "md", "csv"):
            self.assertTrue(os.path.getsize(self.path(f"out/scaling.{form}")) > 0, form)
        titles = [line for line in result.stdout.splitlines() if "scaling," in line]
        self.assertEqual(titles, ["CrashSk, 4 worlds, sor double: strong scaling, worlds over ranks",
                                  "Fight, 1 world, sor double: strong scaling, spaces over ranks",
                                  "CrashSk, 2 worlds a rank, sor double: weak scaling, worlds over ranks"])
        with h5py.File(self.path("out/Fight-spaces-w1-r2-k2.h5")) as file:
            self.assertGreater(file["parameters/processors"][()], 0)
        os.remove(self.path("out/CrashSk-worlds-w4-r2-k2.h5"))
        again = self.sweep(*args)
        self.assertEqual([line for line in again.stdout.splitlines() if line.startswith("round")],
                         ["round 2: CrashSk, 4 worlds, decomposed into worlds, on 2 ranks"])

    def test_bad_use_is_refused_before_the_first_run(self):
        for args, words in ((["out", "CrashSk"], "SCENE:worlds:N"), (["--ranks", "two"], "--ranks two"), (["--repeats"], "--repeats"),
                            (["--sixty"], "--sixty"), (["out", "--", "--output", "x.h5"], "--output")):
            result = self.sweep(*args)
            self.assertEqual(result.returncode, 2, result.stdout)
            self.assertIn(words, result.stderr)
        self.assertEqual(os.listdir(self.folder), [])

    def test_options_of_pbmpi_reach_each_run_and_its_failure_ends_the_sweep(self):
        result = self.sweep("--quick-look", "out", "CrashSk:worlds:2", "--", "--stepper", "quick")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("CrashSk, 2 worlds, quick double", result.stdout)
        result = self.sweep("--quick-look", "bad", "NoSuchScene:worlds:2")
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stdout.count("round"), 1)


if __name__ == "__main__":
    unittest.main()
