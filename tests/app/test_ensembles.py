"""Ensembles: parameters a world, ranges of worlds, results a world."""
import json
import unittest

import h5py
import numpy as np

from harness import ProgramTest

TABLE = """car.speed,ground.material.mu,human1.height,world.gravity
12.5,0.3,,
,,1.6,
8,,,"[0, 0, -3.7]"
20,0.9,1.9,
12.5,,,
"""
# What a scene file says instead, for worlds 0, 2 and 3.
EDITED = {
    0: '[[actor]]\nname = "car"\nspeed = 12.5\n[[actor]]\nname = "ground"\nmaterial = { mu = 0.3 }\n',
    2: 'gravity = [0, 0, -3.7]\n[[actor]]\nname = "car"\nspeed = 8\n',
    3: '[[actor]]\nname = "car"\nspeed = 20\n[[actor]]\nname = "ground"\nmaterial = { mu = 0.9 }\n'
       '[[actor]]\nname = "human1"\nheight = 1.9\n',
}
RUN = ("--scene", "100CrSk", "--frames", 6)


class Ensembles(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("p.csv", TABLE)

    def hashes(self, name):
        with h5py.File(self.path(name)) as file:
            return [text.decode() for text in file["world_results/state_hash"][:]]

    def test_a_table_of_parameters_gives_the_same_hash_on_any_number_of_ranks(self):
        for stepper in ("sor", "quick"):
            found = {self.summary(ranks, *RUN, "--parameters", "p.csv", "--stepper", stepper, "--output", f"{ranks}.h5")
                     ["state_hash"] for ranks in (1, 2, 3, 4)}
            self.assertEqual(len(found), 1)
        self.assertEqual(len(set(self.hashes("1.h5"))), 5, "no two worlds are alike")

    def test_each_world_is_that_of_an_edited_scene_file(self):
        for stepper in ("sor", "quick"):
            self.summary(2, *RUN, "--parameters", "p.csv", "--stepper", stepper, "--output", "table.h5")
            hashes = self.hashes("table.h5")
            for world, text in EDITED.items():
                self.write("edited.toml", 'title = "t"\nbase = "100CrSk"\n' + text)
                self.summary(1, "--scene", "edited.toml", "--frames", 6, "--replicas", 5, "--stepper", stepper,
                             "--output", "edited.h5")
                self.assertEqual(self.hashes("edited.h5")[world], hashes[world], (stepper, world))

    def test_toml_says_the_same_as_csv(self):
        self.write("p.toml", "[[world]]\ncar.speed = 12.5\nground.material.mu = 0.3\n[[world]]\nhuman1.height = 1.6\n"
                   "[[world]]\ncar.speed = 8\nworld.gravity = [0, 0, -3.7]\n"
                   "[[world]]\ncar.speed = 20\nground = { material = { mu = 0.9 } }\nhuman1.height = 1.9\n"
                   "[[world]]\ncar.speed = 12.5\n")
        csv, toml = (self.summary(1, *RUN, "--parameters", name, "--no-output") for name in ("p.csv", "p.toml"))
        self.assertEqual(csv["state_hash"], toml["state_hash"])
        self.assertEqual(csv["worlds"], 5)

    def test_the_file_holds_the_parameters_as_columns(self):
        self.summary(2, *RUN, "--parameters", "p.csv", "--output", "p.h5")
        with h5py.File(self.path("p.h5")) as file:
            columns = file["world_parameters"]
            np.testing.assert_array_equal(columns["car.speed"][:], [12.5, np.nan, 8, 20, 12.5])
            np.testing.assert_array_equal(columns["human1.height"][:], [np.nan, 1.6, np.nan, 1.9, np.nan])
            self.assertEqual(list(columns["world.gravity"].asstr()[:]), ["", "", "[0, 0, -3.7]", "", ""])
            self.assertEqual(file["parameters/parameters_text"].asstr()[()], TABLE)
            np.testing.assert_array_equal(file["worlds/gravity"][:, 2], [-9.81, -9.81, -3.7, -9.81, -9.81])
        lines = self.report("csv", "p.h5", "--table", "world_parameters").stdout.splitlines()
        self.assertEqual(lines[0], "world,id,car.speed,ground.material.mu,human1.height,world.gravity")
        self.assertEqual(lines[3], '2,2,8,nan,nan,"[0, 0, -3.7]"')

    def test_a_resumed_run_needs_no_table(self):
        whole = self.summary(1, *RUN, "--parameters", "p.csv", "--no-output")["state_hash"]
        for first, then in ((1, 3), (4, 2)):
            self.summary(first, "--scene", "100CrSk", "--frames", 2, "--parameters", "p.csv", "--no-output",
                         "--checkpoint", "c.h5")
            self.assertEqual(self.summary(then, "--resume", "c.h5", "--frames", 6)["state_hash"], whole)
        self.write("other.csv", TABLE.replace("12.5", "12"))
        refused = self.pbmpi(2, "--resume", "c.h5", "--parameters", "other.csv")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--parameters other.csv: the run in c.h5 has other ones, of p.csv", refused.stderr)

    def test_parts_of_an_ensemble_are_those_of_the_whole(self):
        for stepper in ("sor", "quick"):
            self.summary(2, *RUN, "--parameters", "p.csv", "--stepper", stepper, "--output", "whole.h5")
            for part in ("0:2", "2:5"):
                self.summary(2, *RUN, "--parameters", "p.csv", "--stepper", stepper, "--world-range", part)
            hashes = self.hashes("100CrSk.worlds0-2.h5") + self.hashes("100CrSk.worlds2-5.h5")
            self.assertEqual(hashes, self.hashes("whole.h5"))
        with h5py.File(self.path("whole.h5")) as whole, h5py.File(self.path("100CrSk.worlds2-5.h5")) as part:
            self.assertEqual(list(part["worlds/id"][:]), [2, 3, 4])
            self.assertEqual(part["parameters/world_range"].asstr()[()], "2:5")
            np.testing.assert_array_equal(part["world_parameters/car.speed"][:], [8, 20, 12.5])
            np.testing.assert_array_equal(part["observables/world/energy"][:], whole["observables/world/energy"][:, 2:])
        tables = [json.loads(self.report("ensemble", *files, "--over", "worlds", "--json").stdout)
                  for files in (["whole.h5"], ["100CrSk.worlds0-2.h5", "100CrSk.worlds2-5.h5"])]
        for name in ("frames", "positions", "bodies"):
            self.assertEqual(tables[0][name], tables[1][name], name)
        worlds = [{name: column for name, column in table["worlds"].items() if name not in ("run", "cost")}
                  for table in tables]
        self.assertIn("car.speed", worlds[0])
        self.assertEqual(worlds[0]["survived"], [1] * 5)
        self.assertEqual(worlds[0], worlds[1])

    def test_a_range_goes_on_from_a_checkpoint_as_the_same_range(self):
        self.summary(1, *RUN, "--parameters", "p.csv", "--world-range", "1:4", "--output", "range.h5")
        self.summary(2, "--scene", "100CrSk", "--frames", 2, "--parameters", "p.csv", "--world-range", "1:4",
                     "--no-output", "--checkpoint", "c.h5")
        self.summary(3, "--resume", "c.h5", "--frames", 6, "--output", "rest.h5")
        self.assertEqual(self.hashes("rest.h5"), self.hashes("range.h5"))
        refused = self.pbmpi(1, "--resume", "c.h5", "--frames", 6, "--world-range", "1:3")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("world-range", refused.stderr)

    def test_results_by_world_follow_from_the_observables(self):
        found = {}
        for ranks in (1, 3):
            self.summary(ranks, *RUN, "--parameters", "p.csv", "--output", f"{ranks}.h5")
            with h5py.File(self.path(f"{ranks}.h5")) as file:
                results, seen = file["world_results"], file["observables/world"]
                self.assertEqual(results.attrs["num_worlds"], 5)
                np.testing.assert_array_equal(results["survived"][:], (seen["nonfinite"][:] == 0).all(axis=0))
                np.testing.assert_array_equal(results["nonfinite_step"][:], [-1] * 5)
                np.testing.assert_array_equal(results["frames"][:], [file.attrs["frames_committed"]] * 5)
                np.testing.assert_array_equal(results["energy_first"][:], seen["energy"][0])
                np.testing.assert_array_equal(results["energy_last"][:], seen["energy"][-1])
                np.testing.assert_array_equal(results["joint_gap_max"][:], seen["joint_gap"][:].max(axis=0))
                np.testing.assert_array_equal(results["penetration_max"][:], seen["max_penetration"][:].max(axis=0))
                np.testing.assert_array_equal(results["row_visits"][:], seen["row_visits"][:].sum(axis=0))
                np.testing.assert_array_equal(results["contacts_mean"][:],
                                              seen["contacts"][:].sum(axis=0) / len(seen["contacts"]))
                self.assertTrue((results["cost"][:] > 0).all())
                found[ranks] = {name: results[name][:].tobytes() for name in results if name not in ("cost", "moves")}
        self.assertEqual(found[1], found[3])
        self.assertIn("worlds_survived: 5 of 5", self.report("3.h5").stdout)
        lines = self.report("csv", "1.h5", "--table", "world_results").stdout.splitlines()
        self.assertEqual(len(lines), 1 + 5)

    def test_results_of_a_world_that_is_cut_are_those_of_the_whole(self):
        for ranks, cut in ((1, "worlds"), (3, "spaces")):
            self.summary(ranks, "--scene", "Battle2", "--frames", 3, "--decompose", cut, "--output", f"{cut}.h5")
        with h5py.File(self.path("worlds.h5")) as whole, h5py.File(self.path("spaces.h5")) as parts:
            for name in whole["world_results"]:
                if name != "cost":
                    self.assertEqual(whole[f"world_results/{name}"][0], parts[f"world_results/{name}"][0], name)
            self.assertGreater(parts["world_results/cost"][0], 0)

    def test_a_frozen_world_has_not_survived(self):
        self.write("bad.csv", "car.speed\n10\n1e6\n")
        summary = self.summary(2, "--scene", "CrashSk", "--frames", 6, "--parameters", "bad.csv", "--on-blowup", "freeze",
                               "--output", "bad.h5")
        self.assertEqual(summary["worlds_survived"], 1)
        with h5py.File(self.path("bad.h5")) as file:
            self.assertEqual(list(file["world_results/survived"][:]), [1, 0])
            frozen = file["events/step"][:][file["events/kind"][:] == b"frozen"]
            self.assertEqual(list(file["world_results/frozen_in"][:]), [-1, frozen[0]])

    def test_describe_counts_the_worlds_as_they_are(self):
        self.write("b.csv", "car.wheel_break_force\n0\n900\n0\n")
        text = self.pbmpi(1, "--scene", "CrashSk", "--parameters", "b.csv", "--describe").stdout
        self.assertIn("parameters: b.csv, a world a row: car.wheel_break_force\n", text)
        self.assertRegex(text, r"breakable_joints .*in 1 of 3 worlds|breakable_joints .*in 1 world")
        self.summary(2, "--scene", "CrashSk", "--frames", 2, "--parameters", "b.csv", "--output", "b.h5")
        with h5py.File(self.path("b.h5")) as file:
            self.assertIn("broken_in", file["observables/joint"], "though nothing can break in world 0")
        text = self.pbmpi(1, *RUN, "--world-range", "5:8", "--describe").stdout
        self.assertIn("ensemble: worlds 5..7 of 100\n", text)

    def test_what_is_wrong_is_told_where_it_stands(self):
        def refuse(message, *args):
            result = self.pbmpi(2, *RUN, "--no-output", *args)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(message, result.stderr)

        self.write("key.csv", "car.sped\n5\n")
        refuse("key.csv:2:1: column 'car.sped': actor 'car': unknown key 'sped'; did you mean 'speed'", "--parameters",
               "key.csv")
        self.write("late.csv", "car.chassis_mass\n1200\n1200\n-5\n")
        refuse("late.csv:4:1: column 'car.chassis_mass': actor 'car': 'chassis_mass' is -5", "--parameters", "late.csv")
        refuse("--replicas 4: the table of --parameters has 5 rows", "--parameters", "p.csv", "--replicas", 4)
        refuse("--world-range 3:6: the ensemble has worlds 0 to 4", "--parameters", "p.csv", "--world-range", "3:6")
        refuse("--world-range 3: give A:B", "--world-range", "3")
        refuse("--world-range 3:3: there is no world", "--world-range", "3:3")
        self.assertEqual(self.pbmpi(1, *RUN, "--no-output", "--parameters", "p.csv", "--replicas", 5).returncode, 0)

    def test_worlds_of_unequal_cost_stop_at_one_step(self):
        # World 0 has ten times the bodies of the others, so that its rank is always the last.
        self.write("uneven.toml", 'title = "t"\n[run]\nreplicas = 4\n[[actor]]\nname = "ground"\ntype = "ground"\n'
                   '[[actor]]\nname = "b"\ntype = "box"\nsize = [1, 1, 1]\nmass = 1\nposition = [0, 0, 0.5]\n'
                   'spacing = [3, 0, 0]\ncopies = [[0, 300], [1, 3]]\n')
        for ranks in (1, 2, 3, 4):
            result = self.pbmpi(ranks, "--scene", "uneven.toml", "--frames", 1000000, "--max-time", 1, "--output", "u.h5")
            self.assertEqual(result.returncode, 75, result.stderr)
            with h5py.File(self.path("u.h5")) as file, h5py.File(self.path("u.checkpoint.h5")) as saved:
                done = file.attrs["frames_committed"]
                self.assertEqual(list(file["world_results/frames"][:]), [done] * 4)
                self.assertEqual(saved["parameters/steps_done"][()], 3 * done)
                last = file["particles/bodies/position/value"][-1]
                self.assertEqual(last.tobytes(), saved["bodies/position"][:].tobytes(), "each world's last frame")


if __name__ == "__main__":
    unittest.main()
