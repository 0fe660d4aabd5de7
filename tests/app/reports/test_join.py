"""Which frames a joined run takes from which file."""
import pathlib
import sys
import unittest
from typing import NamedTuple

SOURCE = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(SOURCE / "src/app"))
from reports.files import BadInput  # noqa: E402
from reports.join.plan import Plan, Stretch  # noqa: E402


class Part(NamedTuple):
    path: str
    first_frame: int
    num_frames: int


class Plans(unittest.TestCase):
    def setUp(self):
        self.plan = Plan([Part("a", 0, 10), Part("b", 6, 2), Part("c", 9, 11)], 1)

    def refused(self, *parts, record_every=1):
        with self.assertRaises(BadInput) as caught:
            Plan([Part(*part) for part in parts], record_every)
        return str(caught.exception)

    def test_each_frame_comes_from_the_last_part_that_has_it(self):
        self.assertEqual(self.plan.stretches, [(0, 0, 6), (1, 6, 2), (0, 8, 1), (2, 9, 11)])
        self.assertEqual(self.plan.num_frames, 20)
        self.assertEqual(self.plan.part_of(8), 0)
        self.assertEqual(self.plan.part_of(25), 2, "what happened behind the last frame is the last part's")

    def test_the_frames_that_come_from_another_part_are_compared(self):
        self.assertEqual(self.plan.overlaps_of(0), [(1, 6, 2), (2, 9, 1)])
        self.assertEqual(self.plan.overlaps_of(2), [])

    def test_frames_that_are_missing_have_names_and_the_files_beside_them(self):
        self.assertEqual(self.refused(("a", 0, 5), ("b", 7, 3)),
                         "frames 5 to 6 are missing: a ends before, b begins behind; name the file of the run between them, too")
        self.assertTrue(self.refused(("a", 0, 5), ("b", 6, 3)).startswith("frame 5 is missing: "))
        self.assertIn("b: it has no frame", self.refused(("a", 0, 5), ("b", 5, 0)))

    def test_recorded_rows_are_counted_from_the_start_of_each_file(self):
        plan = Plan([Part("a", 3, 8), Part("b", 9, 6)], 3)
        of_b = Stretch(1, 9, 6)
        self.assertEqual(plan.rows(of_b, plan.first, True), slice(2, 4))
        self.assertEqual(plan.rows(of_b, 9, True), slice(0, 2))
        self.assertEqual(plan.rows(of_b, 9, False), slice(0, 6))

    def test_an_interval_of_recording_that_begins_anew_in_between_is_refused(self):
        self.assertIn("b: one frame of 3 is recorded", self.refused(("a", 0, 8), ("b", 7, 6), record_every=3))
        Plan([Part("a", 0, 8), Part("b", 6, 6)], 3)
        self.assertTrue(self.refused(("a", 0, 8), ("b", 5, 3), ("c", 6, 6), record_every=3).startswith("b: one frame"), "frame 5 comes from it")


if __name__ == "__main__":
    unittest.main()
