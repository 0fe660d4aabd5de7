"""The parts of the reports on one run, and on two that are compared: numbers as text, choices of frames, categories, seals."""
import math
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(SOURCE / "src/app"))

from reports.files import BadInput  # noqa: E402
from reports.one_run import csv_report, diff, error_sets, processes, recorded  # noqa: E402
from reports.one_run.rigid import Poses  # noqa: E402


class Text(unittest.TestCase):
    def test_numbers_have_the_shorter_of_the_fewest_digits_that_read_back(self):
        expected = {1e5: "1e+05", 120000.0: "120000", 1e-4: "1e-04", 0.00012: "0.00012", 0.001: "0.001", 1e-5: "1e-05", -0.0: "-0", 0.1: "0.1", 3.0: "3",
                    1e16: "1e+16", 1.2345678901234567e+20: "123456789012345667584", math.inf: "inf", 1234567.0: "1234567", -2.5e-7: "-2.5e-07"}
        self.assertEqual(csv_report.texts_of(np.array(list(expected))), list(expected.values()))
        self.assertEqual(csv_report.texts_of(np.array([math.nan, -math.nan])), ["nan", "-nan"])

    def test_random_bits_read_back(self):
        values = np.random.default_rng(1).integers(0, 2 ** 64, 5000, np.uint64).view(float)
        values = values[np.isfinite(values)]
        self.assertEqual(np.array(list(map(float, csv_report.texts_of(values)))).tobytes(), values.tobytes())

    def test_texts_with_commas_and_quotes_are_quoted(self):
        self.assertEqual(csv_report.texts_of(np.array(["a", 'b,"c"'], object)), ["a", '"b,""c"""'])


class Frames(unittest.TestCase):
    def test_ranges(self):
        for text, found in (("10:20", (10, 20, 1)), (":20", (0, 20, 1)), ("10:", (10, math.inf, 1)), ("10:20:5", (10, 20, 5)), ("12", (12, 12, 1))):
            self.assertEqual(csv_report.frame_range(text), found)
        for text in ("", "x", "5:2", "1:2:0", "1:2:3:4", "-1"):
            with self.assertRaises(BadInput):
                csv_report.frame_range(text)

    def test_rows_are_read_in_blocks_that_follow_each_other(self):
        rows = np.array([0, 1, 2, 5, 6])
        self.assertEqual(list(csv_report.blocks(rows, [1] * 5)), [(0, 3), (5, 2)])
        self.assertEqual(list(csv_report.blocks(rows, [csv_report.ITEMS_AT_ONCE] * 5)), [(row, 1) for row in rows])


class Processes(unittest.TestCase):
    def test_texts_come_in_order_and_errors_where_they_are_asked_for(self):
        texts = [str(place) * 100000 for place in range(7)]
        self.assertEqual(list(processes.in_order(lambda text=text: text for text in texts)), texts)
        self.assertEqual(list(processes.in_order([lambda: str(os.getpid())])), [str(os.getpid())], "a single one needs no other process")
        with self.assertRaises(ZeroDivisionError):
            list(processes.in_order([lambda: "1", lambda: str(1 // 0)]))


class Interrupted(unittest.TestCase):
    PROGRAM = """
import os, signal, sys
from reports import files
signal.signal(signal.SIGTERM, files.end_without_leftovers)
def parts():
    yield b"begun"
    os.kill(os.getpid(), signal.SIGTERM)
    yield b"never"
files.replace(sys.argv[1], parts(), None)
"""

    def test_a_signal_leaves_no_unfinished_file(self):
        with tempfile.TemporaryDirectory() as folder:
            ended = subprocess.run([sys.executable, "-c", self.PROGRAM, os.path.join(folder, "out.csv")],
                                   env={**os.environ, "PYTHONPATH": str(SOURCE / "src/app")},
                                   timeout=60)
            self.assertEqual((ended.returncode, os.listdir(folder)), (-signal.SIGTERM, []))


class OtherJoints(unittest.TestCase):
    @staticmethod
    def run_with(names, held):
        run = recorded.RecordedRun.__new__(recorded.RecordedRun)
        run.joint_name, run.joint_world, run.held = names, np.zeros(len(names), int), lambda row: np.array(held, bool)
        run.body_name, poses = [], Poses(np.zeros((1, 3)), np.array([[1.0, 0, 0, 0]]))
        run.poses = lambda row, group="": poses
        run.joints = unittest.mock.Mock(gaps=lambda poses: np.zeros((len(names), 3)), bends=lambda poses: np.zeros(len(names)),
                                        __len__=lambda joints: len(names))
        return run

    def held(self, run, other):
        return error_sets.pose_errors(run, other, [0]).held.tolist()

    def test_joints_are_found_by_name_and_what_a_run_lacks_does_not_hold(self):
        run, other = self.run_with(["a", "b"], [True, False]), self.run_with(["b", "c", "a"], [True] * 3)
        self.assertEqual(self.held(run, other), [[False, False, True]])
        self.assertEqual(self.held(run, run), [[True, False]])
        self.assertEqual(self.held(run, self.run_with([], [])), [[]])
        self.assertEqual(self.held(self.run_with([], []), run), [[False, False]])


class Categories(unittest.TestCase):
    def test_an_error_on_an_edge_is_in_the_worse_one(self):
        found = error_sets.summarize(np.array([0, 0.0099, 0.01, 0.1, 1, math.nan, math.inf]), "m")
        self.assertEqual((found.bands, found.count, found.max), ([2, 1, 1, 1, 2], 7, 1.0))
        angles = 2 * math.pi * np.array([0, 0.05, 0.25, 0.5, math.nan])
        self.assertEqual(error_sets.summarize(angles, "rad").bands, [1, 1, 2, 0, 1])

    def test_joints_that_are_broken_are_a_class_of_their_own(self):
        found = error_sets.summarize_held(np.array([[1.0, 2.0], [3.0, 4.0]]), np.array([[True, False], [True, True]]), "m")
        self.assertEqual((found.broken, found.count, found.max), (1, 4, 4.0))

    def test_stretch_falls_into_bands(self):
        self.assertEqual(diff.stretch_bands(np.array([0, 0.029, 0.03, 0.19, 0.2, 3, math.nan])), [2, 2, 2, 1])


if __name__ == "__main__":
    unittest.main()
