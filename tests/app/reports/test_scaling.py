"""pbreport scaling: which runs make a curve, what its points amount to, and what speaks against them."""
import contextlib
import dataclasses
import io
import json
import pathlib
import sys
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "src/app"))
import made_up  # noqa: E402
from reports import document, scaling, scaling_curves  # noqa: E402
from reports.files import BadInput  # noqa: E402
from reports.scaling_curves import STRONG, WEAK, Pop, Rules, ScalingRun, files_without_curve  # noqa: E402

FEW_RULES = Rules(2, 10)


def run_of(ranks, worlds, repeat, frame_s, way="worlds"):
    """The repeat-th run of a point, after the runs of the previous points in the round."""
    return ScalingRun(path=f"w{worlds}-r{ranks}{way}{repeat}.h5", created=f"2026-01-01T00:00:0{repeat}Z", attributes={}, scene="Fight",
                      stepper="sor", precision="double", decomposition=way, problem={"scene": "Fight"}, program="0.1.0",
                      state_hash=f"hash of {worlds}", complete=True, records_islands=False, ranks=ranks, worlds=worlds, steps_per_frame=3,
                      most_ranks_of_a_host=ranks, processors=8, frames=10, frame_s=frame_s, within_budget=1.0, useful_s=frame_s * ranks,
                      pop=Pop(1.0, 1.0, 1.0), root_share=0.0, island_bound=0.0, messages=0.0, bytes=0.0, processor_s=2 * frame_s if ranks == 1 else frame_s,
                      phase_s=dict.fromkeys(made_up.PHASES, 0.001))


def curves_of(*runs, rules=Rules()):
    return scaling_curves.curves_of(list(runs), rules)


def alike():
    return [run_of(1, 4, 1, 1), run_of(2, 4, 1, 0.5), run_of(1, 4, 2, 1), run_of(2, 4, 2, 0.5)]


def doubts_of(*runs, rules=FEW_RULES):
    return curves_of(*runs, rules=rules)[0].points[-1].doubts


class Curves(unittest.TestCase):
    def test_pair_runs_by_their_starts(self):
        """In a slow second round both points take three times as long, which no ratio shows."""
        [curve] = curves_of(run_of(2, 4, 2, 1.5), run_of(1, 4, 1, 0.8), run_of(2, 4, 1, 0.5), run_of(1, 4, 2, 2.4),
                            run_of(1, 4, 3, 0.9), run_of(2, 4, 3, 0.5))
        one, two = curve.points
        self.assertEqual((curve.kind, two.ranks, one.speed_up.median), (STRONG, 2, 1))
        speed_up, efficiency = two.speed_up, two.efficiency
        found = (speed_up.median, speed_up.interval.low, speed_up.interval.high, efficiency.median, efficiency.interval.high)
        np.testing.assert_allclose(found, (1.6, 1.6, 1.8, 0.8, 0.9), rtol=1e-15)
        self.assertAlmostEqual(two.processor_speed_up, 2 * 0.9 / 0.5, 15, "medians of the busiest rank's processor time")

    def test_grow_weakly_where_each_rank_has_as_many_worlds(self):
        runs = [run_of(1, 3, 1, 1.0), run_of(4, 12, 1, 1.25), run_of(2, 4, 1, 9)]
        [curve] = curves_of(*runs)
        four = curve.points[1]
        self.assertEqual((curve.kind, curve.title()), (WEAK, "Fight, 3 worlds a rank, sor double: weak scaling, worlds over ranks"))
        np.testing.assert_allclose((four.speed_up.median, four.efficiency.median), (4 / 1.25, 0.8), rtol=1e-15)
        self.assertAlmostEqual(four.computation, 0.8, 15, "12 worlds cost 5 s of useful time, 3 cost 1")
        self.assertEqual(files_without_curve(runs, [curve]), [runs[2].path])

    def test_start_from_the_fastest_way_on_the_fewest_ranks(self):
        runs = [run_of(1, 1, 1, 1.2, "spaces"), run_of(1, 1, 1, 1.0), run_of(2, 1, 1, 0.8, "spaces")]
        [curve] = curves_of(*runs)  # whole on one rank alone is no curve
        self.assertEqual((curve.decomposition, curve.base.decomposition, len(curve.points)), ("spaces", "worlds", 3))
        self.assertEqual([curve.label(point) for point in curve.points], ["1", "1, worlds", "2"])
        self.assertEqual(curve.points[2].speed_up.median, 1.25)
        self.assertEqual(files_without_curve(runs, [curve]), [])

    def test_keep_other_work_apart(self):
        runs = [run_of(1, 4, 1, 1), dataclasses.replace(run_of(2, 4, 1, 0.5), problem={"scene": "Fight", "seed": "2"})]
        self.assertEqual(curves_of(*runs), [])
        self.assertEqual(len(files_without_curve(runs, [])), 2)

    def test_the_largest_island_bounds_a_cut_world(self):
        runs = [run_of(1, 1, 1, 1.0, "spaces"), dataclasses.replace(run_of(4, 1, 1, 0.5, "spaces"), island_bound=2.5)]
        self.assertEqual([point.bound for point in curves_of(*runs)[0].points], [1, 2.5])


class Doubts(unittest.TestCase):
    def test_there_are_none_of_runs_that_agree(self):
        self.assertEqual(doubts_of(*alike()), "")

    def test_few_repeats_and_wide_intervals(self):
        runs = [*alike()[:3], run_of(2, 4, 2, 0.4)]
        self.assertEqual(doubts_of(*runs, rules=Rules(2, 0.3)), "", "2 and 2.5: 22 % of 2.25")
        self.assertEqual(doubts_of(*runs, rules=Rules(2, 0.2)), "interval of 22 %, 20 % at most")
        self.assertEqual(doubts_of(*runs, rules=Rules(5, 0.3)), "2 of 5 repeats")

    def test_runs_that_are_not_alike(self):
        of_base, of_point = 2, 3
        for which, change, doubt in ((of_point, {"state_hash": "other"}, "2 different hashes"),
                                     (of_point, {"program": "0.2.0"}, "another build or processor than the base's"),
                                     (of_point, {"complete": False}, "a run that did not end"),
                                     (of_point, {"processors": 1}, "more ranks than processors"),
                                     (of_base, {"program": "0.2.0"}, "another build or processor than the base's"),
                                     (of_base, {"complete": False}, "a run that did not end"),
                                     (of_base, {"processors": 0}, "")):  # of an older file: not known
            runs = alike()
            runs[which] = dataclasses.replace(runs[which], **change)
            self.assertEqual(doubts_of(*runs), doubt, change)


class PopEfficiencies(unittest.TestCase):
    def test_multiply_to_the_parallel_efficiency(self):
        """Two ranks compute for 6 and 8 s of 10; the second waits and the first exchanges for 1 s longer."""
        found = scaling_curves.pop_of([6, 8], [2, 1], 10)
        self.assertEqual((found.load_balance, found.transfer, found.serialisation), (7 / 8, 9 / 10, 8 / 9))
        self.assertAlmostEqual(found.load_balance * found.transfer * found.serialisation, 14 / 2 / 10, 15)

    def test_are_zero_where_nothing_was_done(self):
        self.assertEqual(scaling_curves.pop_of([0, 0], [0, 0], 1), Pop(0, 0, 0))


class Files(made_up.FilesTest):
    def test_times_are_of_the_measured_frames(self):
        found = scaling_curves.read_scaling_run(self.write("run.h5", ranks=2))
        self.assertEqual((found.frames, found.ranks, found.most_ranks_of_a_host, found.decomposition), (3, 2, 2, "worlds"))
        self.assertAlmostEqual(found.frame_s, 0.02, 15)
        self.assertAlmostEqual(found.useful_s, 6 * (3 + 4) * 1e-3, 15, "six phases of 3 and of 4 ms a frame")
        self.assertAlmostEqual(found.phase_s["solve"], 3.5e-3, 15)
        self.assertAlmostEqual(found.messages, 7e-3, 15)
        self.assertEqual(found.problem, {"frames": "3", "scene": "Fight", "stepper": "sor", "precision": "double", "steps_per_frame": "3",
                                         "num_spaces": "1"}, "neither replicas nor ranks")

    def test_a_run_within_its_warm_up_is_refused(self):
        with self.assertRaisesRegex(BadInput, "no measured frame"):
            scaling_curves.read_scaling_run(self.write("run.h5", warmup=9))

    def test_a_cut_world_is_bound_by_its_largest_island(self):
        rows, largest = np.full((5, 1), 100), np.full((5, 1), 75)
        found = scaling_curves.read_scaling_run(self.write("run.h5", ranks=2, worlds=1, parameters={"decompose": "spaces"},
                                                           observables__world__rows=rows, observables__world__max_island_rows=largest))
        # Of both ranks together a phase takes x: 2 x to find the islands, 3 x to solve them, x in root's section.
        self.assertAlmostEqual(found.root_share, 1 / 6, 12)
        self.assertAlmostEqual(found.island_bound, 5 / (1 + 2 / 2 + 3 * 0.75), 12)

    def test_the_command_prints_and_writes_one_report(self):
        files = [self.write(f"{ranks}.h5", ranks=ranks) for ranks in (1, 2)] + [self.write("other.h5", worlds=5)]
        page, csv = self.path("page.html"), self.path("points.csv")
        with contextlib.redirect_stdout(io.StringIO()) as out:
            scaling.run([*files, "--json", "--html", page, "--csv", csv])
        found = json.loads(out.getvalue())
        self.assertEqual(list(found), ["phases", "points", "runs"])
        self.assertEqual((found["points"]["ranks"], found["points"]["speed_up"], found["runs"]["frames"]), ([1, 2], [1, 1], [3, 3]))
        self.assertIn("frame_time [s]", pathlib.Path(csv).read_text(encoding="utf-8").splitlines()[0])
        self.assertIn("strong scaling, worlds over ranks", pathlib.Path(page).read_text(encoding="utf-8"))
        with contextlib.redirect_stdout(io.StringIO()) as out:
            scaling.run(files)
        self.assertIn("Not reportable: on 1 rank, 1 of 5 repeats; on 2 ranks, 1 of 5 repeats.", out.getvalue())
        self.assertIn("left out: " + files[2], out.getvalue())

    def test_markdown_has_the_points_alone(self):
        runs = alike()
        curves = curves_of(*runs)
        text = document.markdown(scaling.report_of(runs, curves, scaling.tables_of(curves)))
        self.assertTrue(text.startswith("**Fight, 4 worlds, sor double: strong scaling, worlds over ranks.** Base: 1 rank, whole worlds, "))
        self.assertIn("| 2 | 4 | 2 | 500 | 2.000 (2.000 to 2.000) | 2.00 | 1.000 (1.000 to 1.000) |", text)
        self.assertNotIn("mean rank", text)

    def test_what_cannot_be_compared_is_refused(self):
        one, same = self.write("a.h5"), self.write("b.h5")
        for words, message in (([one], "1 files are given"), ([one, same], "different numbers of ranks"),
                               ([one, same, "--table", "frames"], "there is no such table; known: 'points', 'phases', 'runs'"),
                               ([one, same, "--least-repeats", "0"], "--least-repeats"),
                               ([one, same, "--least-repeats", "x"], "--least-repeats"),
                               ([one, same, "--widest-interval", "-1"], "--widest-interval")):
            with self.assertRaises(BadInput) as caught:
                scaling.run(words)
            self.assertIn(message, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
