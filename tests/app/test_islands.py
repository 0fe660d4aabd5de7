"""--record islands, a scene in one space, and the tables that are made of them."""
import json
import unittest

import h5py

from harness import PAPER, ProgramTest

RECORDED = ("--stepper", "quick", "--record", "islands")


class Islands(ProgramTest):
    def one_space(self, scene):
        """A file of the scene with one space in place of all of its own."""
        return self.write("one.toml", f'title = "{scene} in one space"\nbase = "{scene}"\n[run]\nspaces = "one"\n')

    def report(self, *args):
        result = self.run_command([*PAPER, *args, "--json"])
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_recording_changes_neither_the_hash_nor_depends_on_ranks(self):
        plain = self.summary(1, "--scene", "CrashSk", "--stepper", "quick", "--replicas", 3, "--no-output")["state_hash"]
        columns = []
        for ranks in (1, 2, 3):
            recorded = self.summary(ranks, "--scene", "CrashSk", "--replicas", 3, *RECORDED)
            self.assertEqual(recorded["state_hash"], plain)
            with h5py.File(self.path("CrashSk.h5")) as run:
                self.assertEqual(run["parameters/record_islands"][()], 1)
                group = run["timings/island"]
                columns.append([group[name][:].tobytes() for name in ("bodies", "contacts", "rows")])
                islands = (group["bodies"][:] > 0).sum(axis=1)
                self.assertEqual(list(islands), list(run["observables/world/islands"][:].sum(axis=1)))
                self.assertEqual(list(group["rows"][:].sum(axis=1)),
                                 list(run["observables/world/rows"][:].sum(axis=1)))
        self.assertEqual(columns[0], columns[1])
        self.assertEqual(columns[0], columns[2])

    def test_the_form_of_the_spaces_changes_what_crosses_them_but_no_bit(self):
        hashes, crossing, spaces = [], [], []
        for scene in (self.one_space("Fight"), "Fight"):
            hashes.append(self.summary(1, "--scene", scene, *RECORDED, "--output", "run.h5")["state_hash"])
            row = self.report("islands", self.path("run.h5"))[0]
            crossing.append(row["cross_space_contacts_per_step"])
            spaces.append(row["spaces"])
        self.assertEqual(hashes[0], hashes[1])
        self.assertEqual(spaces, [1, 10], "Table 1's two forms of Fight")
        self.assertEqual(crossing[0], 0)
        self.assertGreater(crossing[1], 0, "pairs of humans of two spaces meet")

    def test_tables_stand_beside_the_papers(self):
        self.summary(1, "--scene", "2-Cars", *RECORDED)
        row = self.report("islands", self.path("2-Cars.h5"))[0]
        self.assertEqual([row["islands"][name] for name in ("max", "min", "mean", "stddev")], [2, 2, 2, 0])
        self.assertEqual(row["relative_difference"], {"max": 0, "min": 0, "mean": 0, "stddev": 0})
        cores = self.report("cores", self.path("2-Cars.h5"))[0]
        self.assertEqual(cores["paper_cores"], 2)
        self.assertIn(cores["cores"], (1, 2), "two islands")
        self.assertGreaterEqual(cores["islands_parallel"]["harmonic_mean_hz"], cores["serial"]["harmonic_mean_hz"])
        self.assertGreaterEqual(cores["spaces_parallel"]["harmonic_mean_hz"],
                                cores["islands_parallel"]["harmonic_mean_hz"])

    def test_describe_counts_the_spaces(self):
        for scene, count in ((self.one_space("CrashWa"), 1), ("CrashWa", 3)):
            self.assertIn(f"spaces: {count}\n", self.pbmpi(1, "--scene", scene, "--describe").stdout)

    def test_refusals(self):
        for args, words in (
                (("--record", "islands", "--stepper", "sor"), ("--record islands", "sor")),
                ((*RECORDED, "--no-output"), ("--record islands", "--no-output"))):
            result = self.pbmpi(1, "--scene", "CrashSk", *args)
            self.assertEqual(result.returncode, 2, result.stderr)
            for word in words:
                self.assertIn(word, result.stderr)
        self.summary(1, "--scene", "CrashSk")
        result = self.run_command([*PAPER, "cores", self.path("CrashSk.h5")])
        self.assertEqual(result.returncode, 2)
        self.assertIn("--record islands", result.stderr)
        self.summary(2, "--scene", "CrashSk", "--replicas", 2, *RECORDED)
        result = self.run_command([*PAPER, "cores", self.path("CrashSk.h5")])
        self.assertEqual(result.returncode, 2)
        self.assertIn("2 ranks", result.stderr)


if __name__ == "__main__":
    unittest.main()
