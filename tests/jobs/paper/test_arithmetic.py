"""What the statements are computed with: schedules of islands, power laws, counts of instructions and their extrapolation, stretch."""
import json
import math
import os
import random
import tempfile
import unittest

import made_up  # noqa: F401  which adds the folder of what is tested

from reports.files import BadInput

import figures
import instructions
from instructions import CountedScene, Counts
from statements.engine import growth_of
from suite import Work, fewest_cores, makespan


def islands(step):
    return Work("Fight", islands=[step])


class Schedules(unittest.TestCase):
    def test_one_core_takes_the_sum_and_enough_cores_the_longest(self):
        self.assertEqual([makespan([3, 1, 4, 1, 5], cores) for cores in (1, 5)], [14, 5])
        self.assertEqual(makespan([], 3), 0)

    def test_the_longest_go_first(self):
        # Graham's example for which the rule is not optimal (6 would be): 3,3 | 2,2,2 against 3,2,2 | 3,2.
        self.assertEqual(makespan([2, 3, 2, 3, 2], 2), 7)

    def test_equal_jobs_need_a_core_each(self):
        self.assertEqual([fewest_cores(jobs) for jobs in ([2.5] * 10, [2.5], [0, 0], [])], [10, 1, 0, 0])

    def test_one_great_job_and_many_small_ones_need_two_cores(self):
        self.assertEqual(fewest_cores([0.01] * 100 + [1]), 2)

    def test_a_tolerance_forgives_the_noise_of_measuring(self):
        self.assertEqual(fewest_cores([1, 0.51, 0.51]), 2, "2 % above the longest")
        self.assertEqual(fewest_cores([1, 0.53, 0.53]), 3, "6 % above it")

    def test_the_fewest_cores_are_enough_and_one_less_is_not(self):
        jobs_of = random.Random(7)
        for trial in range(200):
            jobs = [jobs_of.random() + 1e-3 for _ in range(3 + trial % 40)]
            cores, most = fewest_cores(jobs), 1.05 * max(jobs)
            self.assertLessEqual(makespan(jobs, cores), most)
            self.assertTrue(all(makespan(jobs, less) > most for less in range(1, cores)))


class Growth(unittest.TestCase):
    def test_the_exponent_of_a_power_law_is_found(self):
        def time(rows):
            return 3e-9 * rows ** 2.5

        growth = growth_of([islands([(rows, time(rows)) for rows in (100, 150, 400, 3000)]), islands([(200, time(200))])])
        self.assertAlmostEqual(growth.exponent, 2.5, places=12)  # rounding
        self.assertEqual((growth.num_islands, growth.least_rows, growth.most_rows), (5, 100, 3000))

    def test_small_islands_and_those_too_short_for_the_clock_are_left_out(self):
        growth = growth_of([islands([(99, 1), (100, 1e-3), (200, 0), (800, 8e-3)])])
        self.assertAlmostEqual(growth.exponent, 1, places=12)  # rounding
        self.assertEqual(growth.num_islands, 2)

    def test_islands_of_one_size_tell_nothing(self):
        self.assertIsNone(growth_of([islands([(100, 1e-3), (399, 4e-3)])]))
        self.assertIsNotNone(growth_of([islands([(100, 1e-3), (400, 4e-3)])]))
        self.assertIsNone(growth_of([]))

    def test_the_time_of_a_row_is_over_all_islands(self):
        self.assertAlmostEqual(islands([(100, 1e-3), (300, 3e-3), (100, 1e-3)]).time_of_a_row(), 1e-5, places=15)
        self.assertEqual(Work("Fight").time_of_a_row(), 0)


class DirectCost(unittest.TestCase):
    def test_cubes_are_those_of_all_islands_and_steps(self):
        work = Work("Fight", steps_per_frame=3, islands=[[(10, 0), (20, 0)], [(30, 0)]])
        self.assertEqual(work.cubed_rows(), 3 * (1000 + 8000 + 27000) / 2)
        self.assertEqual(Work("Fight").cubed_rows(), 0)

    def test_the_cost_spans_the_ratios_of_the_scenes(self):
        cost = instructions.cubic_cost([1, 4, 2])
        self.assertEqual((cost.least, cost.most, cost.num_scenes), (1, 4, 3))
        self.assertAlmostEqual(cost.middle, 2, places=15)  # rounding
        self.assertIsNone(instructions.cubic_cost([]))

    def test_it_is_extrapolated_from_scenes_with_a_large_island(self):
        works = [Work(scene, steps_per_frame=3, islands=[[(rows, 0)]]) for scene, rows in (("2-Cars", 40), ("Fight", 200), ("Environ", 1000))]
        cubes = 3 * 8e6
        scenes = [CountedScene("2-Cars", Counts(1e6, 0.1, ()), Counts(9e9, 0, ())),
                  CountedScene("Fight", Counts(1e6, 0.1, ()), Counts(2 * cubes / 0.5, 0.5, ())), CountedScene("Environ", Counts(1e7, 0.2, ()))]
        cost = instructions.counted_cost(scenes, works)
        self.assertEqual(cost.num_scenes, 1, "the island of 2-Cars is too small to tell")
        self.assertAlmostEqual(cost.middle, 2, places=12)  # rounding
        environ = instructions.direct_cost(scenes[2], cost, works)
        self.assertFalse(environ.is_counted)
        self.assertAlmostEqual(environ.middle, 2 * 3e9 + 2e6, places=3, msg="the solver, and quick's collision detection")
        fight = instructions.direct_cost(scenes[1], cost, works)
        self.assertEqual((fight.is_counted, fight.least), (True, scenes[1].direct.per_frame))
        self.assertIsNone(instructions.direct_cost(scenes[2], None, works))
        self.assertIsNone(instructions.direct_cost(scenes[2], cost, []))


QUICK = {"instructions_per_frame": 2e6, "collision_share": 0.25, "frames": 5,
         "mix": {"floating point": 0.3, "integer": 0.2, "branch": 0.1, "store": 0.1, "load": 0.3}}


class CountsFiles(unittest.TestCase):
    def written(self, text):
        with tempfile.NamedTemporaryFile("w", suffix=".json", delete=False, encoding="utf-8") as file:
            file.write(text)
        self.addCleanup(os.remove, file.name)
        return file.name

    def test_one_is_read_scene_by_scene(self):
        scenes = instructions.read_counts(self.written(json.dumps({"filetype": "pbmpi-instructions", "scenes": {"Fight": {"quick": QUICK}}})))
        self.assertEqual([(scene.name, scene.direct) for scene in scenes], [("Fight", None)])
        self.assertEqual(scenes[0].quick.solver(), 1.5e6)
        self.assertEqual(scenes[0].quick.mix, (0.3, 0.2, 0.1, 0.1, 0.3))

    def test_another_one_or_one_that_lacks_a_number_is_refused(self):
        lacking = {name: value for name, value in QUICK.items() if name != "collision_share"}
        for document in (None, [1], {}, {"filetype": "x", "scenes": {}}, {"filetype": "pbmpi-instructions", "scenes": {}},
                         {"filetype": "pbmpi-instructions", "scenes": {"Fight": {"quick": lacking}}}):
            path = self.written("" if document is None else json.dumps(document))
            with self.assertRaises(BadInput, msg=document):
                instructions.read_counts(path)


class Stretch(unittest.TestCase):
    def test_bounds_are_the_papers_and_what_is_not_finite_counts_as_seen(self):
        count = figures.count_stretch([0, 0.0269, 0.027, 0.2, 0.21, math.nan])
        self.assertEqual((count.num, count.perhaps_seen, count.seen, count.most), (6, 4, 2, 0.21))
        self.assertEqual(figures.count_stretch([]).most, 0)


if __name__ == "__main__":
    unittest.main()
