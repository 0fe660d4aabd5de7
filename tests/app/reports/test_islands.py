"""jobs/paper/paper.py islands: counts over the measured frames, beside the paper's."""
import json
import pathlib
import sys
import tempfile
import unittest

import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[3]
sys.path[:0] = [str(SOURCE / "jobs/paper"), str(SOURCE / "src/app")]
import islands  # noqa: E402
from islands import Summary, summarize  # noqa: E402
from reports import document  # noqa: E402
from reports.runs import Run  # noqa: E402
from made_up import write_run  # noqa: E402


class Islands(unittest.TestCase):
    def test_moments_are_of_the_population(self):
        self.assertEqual(summarize([2, 4, 4, 4, 5, 5, 7, 9]), Summary(2, 9, 5, 2), "divided by n - 1 the last would be 2.138")
        self.assertEqual(summarize([]), Summary(0, 0, 0, 0))

    def read(self, **others):
        with tempfile.TemporaryDirectory() as folder:
            return islands.islands_of(Run(write_run(pathlib.Path(folder) / "run.h5", **others)))

    def test_are_counted_over_all_worlds_in_measured_frames(self):
        one = self.read(parameters={"num_spaces": 5})
        self.assertEqual(one.islands, Summary(5, 13, 9, np.sqrt(32 / 3)), "2 + 3, 4 + 5, 6 + 7, not 0 + 1 and 8 + 9")
        self.assertEqual((one.spaces, one.crossing), (10, None))

    def test_contacts_across_spaces_are_those_of_runs_that_recorded_islands(self):
        one = self.read(timings__island__solve=np.ones((5, 3)), timings__space__cross_contacts=np.arange(10).reshape(5, 2))
        self.assertEqual(one.crossing, 9)
        [row] = json.loads(document.json(islands.report_of([one])))
        self.assertEqual(row["cross_space_contacts_per_step"], 9)

    def test_differ_from_the_papers_by_a_share_of_them(self):
        one = islands.Islands("2-Cars", Summary(1.0, 3.0, 2.0, 0.5), 1, None)
        self.assertEqual(islands.differences(one), {"max": 0.5, "min": -0.5, "mean": 0, "stddev": None})
        ours, papers, apart = islands.rows_of(one)
        self.assertEqual(ours, ["2-Cars", "ours", "3", "1", "2.0", "0.50", "1", "not recorded"])
        self.assertEqual(papers, ["", "paper", "2", "2", "2.0", "0.00", "1", "none"])
        self.assertEqual(apart, ["", "difference", "+50 %", "-50 %", "+0 %", "-", "", ""])

    def test_a_scene_that_the_paper_has_not_stands_alone(self):
        one = islands.Islands("Mine", Summary(1.0, 3.0, 2.0, 0.5), 1, None)
        [row] = islands.report_of([one]).numbers
        self.assertEqual((row["paper"], row["relative_difference"]), (None, None))
        self.assertEqual(len(islands.rows_of(one)), 1)


if __name__ == "__main__":
    unittest.main()
