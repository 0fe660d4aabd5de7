"""pbreport ensemble: spreads of samples, and which runs are samples of the same."""
import pathlib
import sys
import types
import unittest

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "src/app"))
import made_up  # noqa: E402
from reports import document, ensemble  # noqa: E402
from reports.files import BadInput  # noqa: E402

FRAMES, WORLDS, BODIES = 5, 2, 4  # of a made-up run, with one row that was not committed
QUANTITIES = 10 + 2 * 3 + 1  # observables, those with components, and the time of a frame


class Spreads(unittest.TestCase):
    def test_are_those_of_numpy(self):
        samples = np.random.default_rng(1).normal(size=(7, 3))
        found = ensemble.spread_of(samples, [0.1, 0.5])
        self.assertEqual(list(found), ["count", "nonfinite", "mean", "stddev", "min", "q10", "q50", "max"])
        for name, expected in (("mean", samples.mean(0)), ("stddev", samples.std(0, ddof=1)), ("q10", np.quantile(samples, 0.1, axis=0)),
                               ("q50", np.median(samples, axis=0)), ("min", samples.min(0)), ("max", samples.max(0))):
            np.testing.assert_allclose(found[name], expected, rtol=1e-12, err_msg=name)

    def test_leave_out_what_is_not_finite_and_need_enough_samples(self):
        nan, inf = np.nan, np.inf
        found = ensemble.spread_of(np.array([[1.0, nan, nan], [nan, 5.0, inf], [3.0, nan, -inf]]), [0.5])
        self.assertEqual(found["count"].tolist(), [2, 1, 0])
        self.assertEqual(found["nonfinite"].tolist(), [1, 2, 3])
        np.testing.assert_array_equal(found["mean"], [2, 5, nan])
        np.testing.assert_array_equal(found["stddev"], [np.sqrt(2), nan, nan])
        np.testing.assert_array_equal(found["q50"], [2, 5, nan])
        np.testing.assert_array_equal(found["max"], [3, 5, nan])

    def test_stand_by_row_in_the_order_of_their_arrays(self):
        self.assertEqual(ensemble.by_row([{"mean": np.array([1, 2])}, {"mean": np.array([3, 4])}])["mean"].tolist(), [1, 3, 2, 4])

    def test_worlds_are_joined_by_their_sum_or_the_largest(self):
        values = np.array([[1.0, 4.0], [2.0, np.nan]])
        np.testing.assert_array_equal(ensemble.join_worlds("energy", values), [5, np.nan])
        np.testing.assert_array_equal(ensemble.join_worlds("joint_gap", values), [4, 2])


class Files(made_up.FilesTest):
    def write(self, name, seed, parameters=None, **columns):
        """Bodies move along x: body b of a run with this seed is at b + 0.1 t seed."""
        rows = FRAMES + 1
        position = np.zeros((rows, BODIES, 3))
        position[..., 0] = np.arange(BODIES) + 0.1 * seed * np.arange(rows)[:, None]
        energy = np.full((rows, WORLDS), float(seed))
        usual = {"name": ["a", "b"] * WORLDS, "actor": ["c"] * BODIES, "kind": ["box"] * BODIES, "world": [0, 0, 1, 1],
                 "position__value": position}
        usual = {f"particles__bodies__{what}": values for what, values in usual.items()}
        usual |= {"timings__frame__step": 3 * np.arange(rows), "observables__world__energy": energy}
        settings = {"seed": 1, "solver_seed": seed} | (parameters or {})
        return made_up.write_run(self.path(name), worlds=WORLDS, committed=FRAMES, parameters=settings, **usual | columns)

    def options(self, *files, **others):
        return types.SimpleNamespace(**{"files": files, "over": "runs", "allow": [], "quantiles": [0.5]} | others)

    def ensemble(self, *files, **others):
        return ensemble.ensemble_of(self.options(*files, **others))

    def refused(self, words, call, *args, **others):
        with self.assertRaises(BadInput) as caught:
            call(*args, **others)
        self.assertIn(words, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))


class Runs(Files):
    def test_of_other_seeds_are_samples_and_worlds_are_if_asked_for(self):
        files = [self.write(f"{seed}.h5", seed) for seed in (1, 2, 3)]
        found = self.ensemble(*files)
        self.assertEqual((found.num_samples, found.num_bodies, found.num_frames, found.differences), (3, BODIES, FRAMES, []))
        found = self.ensemble(*files, over="worlds")
        self.assertEqual((found.num_samples, found.num_bodies), (6, BODIES // 2))

    def test_that_differ_in_what_decides_over_results_are_refused_unless_allowed(self):
        files = self.write("1.h5", 1), self.write("2.h5", 2, {"iterations": 7}), self.write("3.h5", 3, {"simd": "avx512"})
        self.refused("not of one ensemble: iterations is (none) in", self.ensemble, *files)
        found = self.ensemble(*files, allow=["iterations"])
        self.assertEqual(found.differences, [f"iterations is (none) in {files[0]} and 7 in {files[1]}",
                                             f"simd is none in {files[0]} and avx512 in {files[2]}"])

    def test_of_the_same_seeds_or_other_bodies_or_times_are_refused(self):
        first = self.write("1.h5", 1)
        self.refused("the same sample (seed 1, solver_seed 1)", self.ensemble, first, self.write("again.h5", 1))
        other = self.write("bodies.h5", 2, particles__bodies__name=["a", "b", "a", "x"])
        self.refused("do not have the same bodies", self.ensemble, first, other)
        self.refused("frame 2 is not at the same time", self.ensemble, first,
                     self.write("times.h5", 2, timings__frame__time=np.array([0, 0.03, 0.07, 0.1, 0.2, 0.3])))
        self.refused("its worlds do not have the same bodies", self.ensemble, other, over="worlds")
        self.refused("damaged", self.ensemble, self.write("damaged.h5", 1, particles__bodies__world=[0, 0, 1, 9]), over="worlds")


class Tables(Files):
    def test_have_rows_by_frame_quantity_body_and_world(self):
        found = self.ensemble(*(self.write(f"{seed}.h5", seed) for seed in (1, 2, 3)))
        report, numbers = ensemble.report_of(found)
        rows = {name: len(columns[0].values) for name, columns in numbers.items()}
        self.assertEqual(rows, {"runs": 3, "frames": FRAMES * QUANTITIES, "positions": FRAMES, "bodies": BODIES, "worlds": 6})
        frames = report.numbers["frames"]
        energy = frames["quantity"].index("energy")
        self.assertEqual((frames["mean"][energy], frames["unit"][energy]), (4.0, "J"), "two worlds of 1, 2 or 3 J")
        self.assertEqual((frames["step"][QUANTITIES], frames["quantity"][QUANTITIES - 1]), (3, "wall"))
        self.assertEqual(frames["count"][frames["quantity"].index("angular_momentum_z")], 0, "no file has it")
        # Bodies are at b + 0.1 t seed: 0.1 t from their mean at seed 2, or on it.
        np.testing.assert_allclose(report.numbers["positions"]["distance_rms"], 0.1 * np.arange(FRAMES) * np.sqrt(2 / 3), atol=1e-15)
        np.testing.assert_allclose(report.numbers["bodies"]["distance_max"], [0.4] * BODIES, rtol=1e-12)
        np.testing.assert_allclose(report.numbers["bodies"]["last_mean_x"], np.arange(BODIES) + 0.8, rtol=1e-12)
        self.assertEqual(report.numbers["worlds"]["energy_last"], [1, 1, 2, 2, 3, 3])

    def test_count_what_is_not_finite_and_say_so_where_it_is(self):
        energy = np.full((FRAMES + 1, WORLDS), 2.0)
        energy[FRAMES - 1, 1] = np.inf
        found = self.ensemble(self.write("1.h5", 1), self.write("2.h5", 2, observables__world__energy=energy))
        report, _ = ensemble.report_of(found)
        frames = report.numbers["frames"]
        self.assertEqual([count for count, name in zip(frames["nonfinite"], frames["quantity"]) if name == "energy"], [0, 0, 0, 0, 1])
        self.assertIn("| energy | J | 2 | nan | 2 | 2 | 2 | 1 |", document.markdown(report))
        self.assertIn("not finite", document.text(report))

    def test_are_empty_where_no_frame_was_recorded(self):
        files = [self.write(f"{seed}.h5", seed) for seed in (1, 2)]
        for path in files:
            with h5py.File(path, "r+") as file:
                file.attrs["record_every"] = 10
        report, _ = ensemble.report_of(self.ensemble(*files))
        self.assertEqual(report.numbers["positions"]["frame"], [])
        self.assertTrue(np.isnan(report.numbers["bodies"]["last_mean_x"]).all())
        self.assertNotIn("positions:", document.text(report))

    def test_take_over_the_results_and_parameters_of_worlds_that_all_runs_have(self):
        cost, speed = {"world_results__cost": [0.5, 1.5]}, {"world_parameters__car.speed": [8.0, np.nan]}
        files = self.write("1.h5", 1, **cost, **speed), self.write("2.h5", 2, **speed, world_parameters__kind=["x", "y"])
        columns = {column.name: column.values for column in ensemble.worlds_table(self.ensemble(*files))}
        self.assertEqual([name for name in columns if "." in name or name in ("cost", "kind")], ["car.speed"])
        np.testing.assert_array_equal(columns["car.speed"], [8, np.nan, 8, np.nan])


if __name__ == "__main__":
    unittest.main()
