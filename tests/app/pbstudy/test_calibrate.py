"""What the harness costs is measured, and forecasts of more ranks follow from the file: pbstudy calibrate, pbreport calibrate."""
import csv
import json
import os
import sys
import unittest

import h5py

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import BIN, SOURCE, ProgramTest  # noqa: E402

sys.path.insert(0, os.path.join(SOURCE, "src", "app"))
from reports.harness import Gather, Load, traffic_of  # noqa: E402

# Of one rank; of root for others that are not there; of two ranks.
ALONE = {"frame", "bodies"}
ROOTS = {"unpack", "balance", "table", "hash"}
BETWEEN = {"message", "send", "receive"}
BOX = """title = "t"
[[actor]]
name = "b"
type = "box"
size = [1, 1, 1]
mass = 1
position = [0, 0, 5]
"""
BYTES_OF_A_WORLD = 8 * (1 + 7 * 37)  # a number, positions and orientations of 37 bodies


class Calibrate(ProgramTest):
    def study(self, ranks):
        done = self.run_command(["mpirun", "-n", str(ranks), os.path.join(BIN, "pbstudy"), "calibrate", "--repeats", "2", "--largest-ranks", "64",
                                 "--output", f"{ranks}.h5"])
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.path(f"{ranks}.h5")

    def report(self, *args):
        return self.run_command([os.path.join(BIN, "pbreport"), *map(str, args)])

    def table(self, study, name, *args):
        done = self.report("calibrate", study, "--quiet", "--csv", self.path("table.csv"), "--table", name, *args)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("table.csv"), encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_each_part_is_timed_as_often_as_there_are_ranks_for_it(self):
        for ranks, parts in ((1, ALONE | ROOTS), (2, ALONE | ROOTS | BETWEEN)):
            with h5py.File(self.study(ranks)) as file:
                cases = {name: column[()] for name, column in file["cases"].items()}
            self.assertEqual({part.decode() for part in cases["part"]}, parts)
            self.assertTrue((cases["seconds"] > 0).all())
            self.assertTrue((cases["seconds_p10"] <= cases["seconds_p90"]).all())
            self.assertEqual(set(cases["ranks"][cases["part"] == b"frame"]), {1, ranks})

    def test_messages_and_bytes_of_a_forecast_are_those_that_a_gather_sends(self):
        study = self.study(2)
        question = ("--ranks", "2", "64", "1024", "--worlds", "2048", "--bodies", "37")
        rows = {(int(row["ranks"]), row["gather"]): row for row in self.table(study, "forecasts", *question)}
        self.assertEqual(len(rows), 6)
        for (ranks, gather), row in rows.items():
            children = ranks - 1 if gather == "flat" else min(31, ranks - 1) + max(0, ranks // 32 - 1)
            into_root = BYTES_OF_A_WORLD * (2048 - 2048 // ranks)
            pieces = children if gather == "flat" else int(row["messages_into_root"])
            self.assertEqual(int(row["bytes_into_root [B]"]), into_root)
            self.assertEqual(int(row["messages_into_root"]), pieces)
            self.assertGreaterEqual(int(row["messages_into_root"]), children)
        tree, flat = rows[1024, "tree"], rows[1024, "flat"]
        self.assertLess(int(tree["messages_into_root"]), int(flat["messages_into_root"]))
        self.assertGreater(int(tree["bytes [B]"]), int(flat["bytes [B]"]), "inner ranks hand on what is not theirs")
        self.assertEqual(rows[2, "tree"]["bytes [B]"], rows[2, "flat"]["bytes [B]"])

    def test_messages_and_bytes_of_a_forecast_are_those_that_ranks_count(self):
        """In the first frame, before worlds move: the traffic does not depend on the clock, so it is exact."""
        self.write("box.toml", BOX)
        for ranks in (1, 2, 3, 4):
            for worlds in (5, 64, 1000):
                self.summary(ranks, "--scene", "box.toml", "--replicas", worlds, "--decompose", "worlds", "--frames", 1,
                             "--output", "run.h5")
                with h5py.File(self.path("run.h5")) as file:
                    counted = [file[f"timings/rank/{what}"][0].sum() for what in ("messages", "bytes")]
                load = Load(ranks, worlds, 1)
                self.assertEqual(tuple(counted), traffic_of(load, Gather(load)).gather, (ranks, worlds))

    def test_memory_starts_from_what_a_rank_was_measured_to_take(self):
        study = self.study(1)
        costs = {row["cost"]: float(row["value"]) for row in self.table(study, "costs")}
        with h5py.File(study) as file:
            for cost, parameter in (("memory_rank", "rank_bytes"), ("memory_body", "body_bytes")):
                self.assertEqual(costs[cost], file[f"parameters/{parameter}"][()])
                self.assertGreater(costs[cost], 0)

    def test_a_cost_is_what_the_cases_say_and_no_wall_is_before_its_ranks(self):
        study = self.study(2)
        costs = {row["cost"]: float(row["value"]) for row in self.table(study, "costs")}
        self.assertTrue(all(value >= 0 for value in costs.values()), costs)
        for row in self.table(study, "walls"):
            for ranks in (int(row["flat_ranks"]), int(row["tree_ranks"])):
                self.assertLessEqual(ranks, 131072)
        checks = self.table(study, "checks")
        self.assertEqual(len(checks), 12)
        self.assertTrue(all(float(row["forecast [s]"]) > 0 for row in checks))
        slow = self.table(study, "forecasts", "--ranks", "2", "--worlds", "2048", "--world-step", "40us")
        self.assertGreater(float(slow[0]["step_time [s]"]), 0.12, "1,024 worlds of 3 steps of 40 us")
        self.assertEqual(slow[0]["longest_part"] in ("harness", "agreement", "gather", "unpack", "balance", "verdict"), True)

    def test_json_and_markdown_have_the_same_forecasts(self):
        study = self.study(1)
        document = json.loads(self.report(study, "--json").stdout)
        self.assertIn("forecasts", json.dumps(document))
        markdown = self.report(study, "--markdown").stdout
        self.assertIn("| worlds | ranks | gather |", markdown)

    def test_bad_questions_are_refused(self):
        study = self.study(1)
        for args, words in ((("--table", "nonsense"), "there is no such table; known: 'costs', 'forecasts', 'walls', 'checks'"), (("--ranks", "1"), "from 2"),
                            (("--bodies", "-1"), "--bodies"), (("--world-step", "soon"), "--world-step"), (("--json", "--markdown"), "one of the two")):
            done = self.report("calibrate", study, *args)
            self.assertEqual(done.returncode, 2, args)
            self.assertIn(words, done.stderr)


if __name__ == "__main__":
    unittest.main()
