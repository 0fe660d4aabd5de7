"""The effect "field_of_interest": the same bits everywhere, what is printed and recorded of it, and what is refused."""
import os
import sys
import unittest

import h5py

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ProgramTest  # noqa: E402

TABLE = '[interest]\nfollows = "car"\nradius = 10\n'
SCENE = 'title = "Environ, of which the surroundings of the car matter"\nbase = "Environ"\n' + TABLE
RUN = ("--scene", "interest.toml", "--frames", 3, "--warmup", 0)
SOR = ("--stepper", "sor")


class Interest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("interest.toml", SCENE)

    def hash_of(self, ranks, *args):
        return self.summary(ranks, *RUN, "--no-output", *args)["state_hash"]

    def test_worlds_have_one_hash_for_1_to_4_ranks(self):
        for stepper in ("quick", "sor"):
            hashes = {self.hash_of(ranks, "--stepper", stepper, "--replicas", 4) for ranks in (1, 2, 3, 4)}
            self.assertEqual(len(hashes), 1, stepper)

    def test_one_world_has_one_hash_whole_and_cut(self):
        for precision in ("double", "single"):
            run = (*SOR, "--precision", precision)
            hashes = {self.hash_of(1, *run, "--decompose", "worlds"), self.hash_of(1, *run, "--simd", "off")}
            hashes |= {self.hash_of(ranks, *run, "--decompose", "spaces") for ranks in (1, 2, 3, 4)}
            self.assertEqual(len(hashes), 1, precision)

    def test_it_changes_the_result_unless_it_is_left_out_or_holds_everything(self):
        self.write("all.toml", SCENE.replace("radius = 10", "radius = 1e6"))
        for stepper in ("quick", "sor"):
            run = (*RUN[2:], "--no-output", "--stepper", stepper, "--iterations", 20)  # sor's own 1 is below the field's 4
            plain = self.summary(1, "--scene", "Environ", *run)["state_hash"]
            self.assertNotEqual(self.summary(1, "--scene", "interest.toml", *run)["state_hash"], plain)
            for same in (("interest.toml", "--effects", "-field_of_interest"), ("all.toml",),
                         ("Environ", "--effects", "+field_of_interest")):
                self.assertEqual(self.summary(1, "--scene", *same, *run)["state_hash"], plain, same)

    def test_an_estimate_leaks_into_nothing(self):
        short = (*SOR, "--steps-per-frame", 1, "--decompose", "worlds")
        plain = self.hash_of(1, *short)
        self.assertEqual(self.hash_of(1, *short, "--feec=iterations=2"), plain)
        self.assertEqual(self.hash_of(1, *short, "--feec=quick"), plain)

    def test_the_file_says_what_mattered_and_how_many_bodies_did(self):
        for cut in ("worlds", "spaces"):
            self.summary(2, *RUN, *SOR, "--decompose", cut, "--output", f"{cut}.h5")
        self.summary(1, "--scene", "Environ", "--frames", 1, "--output", "plain.h5")
        with h5py.File(self.path("worlds.h5")) as worlds, h5py.File(self.path("spaces.h5")) as spaces:
            inside = worlds["observables/interest/bodies_inside"][:, 0]
            self.assertTrue((inside >= 5).all(), "the car's own bodies")
            self.assertTrue((inside < 0.7 * len(worlds["particles/bodies/id"])).all(), "and far from all of them")
            self.assertEqual(list(inside), list(spaces["observables/interest/bodies_inside"][:, 0]))
            self.assertEqual(list(worlds["observables/world/rows"][:, 0]), list(spaces["observables/world/rows"][:, 0]))
            self.assertEqual(worlds["parameters/field_of_interest"][()].decode(),
                             "within 10 m of 'car.chassis'; elsewhere at most 4 iterations")
        with h5py.File(self.path("plain.h5")) as plain:
            self.assertNotIn("interest", plain["observables"])
            self.assertNotIn("field_of_interest", plain["parameters"])

    def test_describe_says_where_and_that_direct_has_no_use_for_it(self):
        line = "within 10 m of 'car.chassis'; elsewhere at most 4 iterations"
        self.assertIn(line + "\n", self.pbmpi(1, *RUN, "--describe").stdout)
        direct = self.pbmpi(1, *RUN, "--describe", "--stepper", "direct").stdout
        self.assertIn(line + "; idle, since direct solves without iterations\n", direct)
        self.write("place.toml", SCENE.replace('follows = "car"', "center = [1, 2, 3]\noutside_iterations = 1"))
        self.assertIn("within 10 m of [1, 2, 3]; elsewhere at most 1 iteration\n",
                      self.pbmpi(1, "--scene", "place.toml", "--describe").stdout)

    def test_the_islands_of_a_frame_are_timed_with_their_iterations(self):
        timed = self.summary(1, *RUN, "--stepper", "quick", "--record", "islands", "--output", "timed.h5")
        with h5py.File(self.path("timed.h5")) as file:
            self.assertTrue((file["timings/island/solve"][:].sum(axis=1) > 0).all())
        self.assertEqual(self.hash_of(1, "--stepper", "quick"), timed["state_hash"])

    def test_what_cannot_be_is_refused_at_its_line(self):
        for table, line, words in (
                ("follows = \"car\"\nradius = 0\n", 5, ("radius",)),
                ("follows = \"cat\"\nradius = 1\n", 4, ("'cat'", "did you mean 'car'")),
                ("follows = \"car\"\ncenter = [0, 0, 0]\nradius = 1\n", 4, ("either 'center'", "'follows'")),
                ("follows = \"car\"\nradius = 1\noutside_iterations = 0\n", 6, ("outside_iterations", "at least 1")),
                ("follows = \"car\"\nradius = 1\niterations = 3\n", 6, ("iterations", "outside_iterations"))):
            self.write("bad.toml", SCENE.replace(TABLE, "[interest]\n" + table))
            result = self.pbmpi(2, "--scene", "bad.toml", "--no-output")
            self.assertEqual(result.returncode, 2, table)
            lines = [text for text in result.stderr.splitlines() if text.startswith("pbmpi: ")]
            self.assertEqual(len(lines), 1, result.stderr)
            self.assertIn(f"bad.toml:{line}:", lines[0])
            for word in words:
                self.assertIn(word, lines[0])


if __name__ == "__main__":
    unittest.main()
