"""The page of a run: what its blocks of data hold, and that it stands alone."""
import base64
import copy
import json
import pathlib
import re
import sys
import unittest

import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(SOURCE / "src/app"))
import made_up  # noqa: E402
import page_sample  # noqa: E402
from reports import page  # noqa: E402
from reports.files import BadInput, write_file  # noqa: E402
from reports.one_run import run_page  # noqa: E402
from reports.runs import Run  # noqa: E402

BUDGET_S = 0.1 / 30


def room_for(bodies, frames):
    """Bytes of so many poses, one frame of which is the initial one."""
    return -(-run_page.THREE_POSES_BYTES * bodies * frames // 3)


class Sample(made_up.FilesTest):
    def sample(self, **others):
        return Run(page_sample.write(self.path("run.h5"), **others))

    def selected(self, run, bodies, frames):
        return run_page.Selection(run, room_for(bodies, frames))


class Page(Sample):
    def made(self, most_bytes=run_page.MOST_POSE_BYTES, **others):
        return run_page.text_of(self.sample(**others), page_sample.SUMMARY, most_bytes)

    def block(self, text, name):
        return json.loads(re.search(rf'id="{name}-data">(.*?)</script>', text, re.DOTALL)[1])

    def test_no_text_of_the_user_ends_a_script_or_opens_a_tag(self):
        text = self.made()  # scene and command line hold "<" and "</script>"
        self.assertEqual(text.count("<script"), text.count("</script>"))
        self.assertNotIn("Sample <crash>", text)
        self.assertEqual(self.block(text, "about")["attributes"]["command_line"], 'pbmpi --scene "Sample </script>"')
        self.assertEqual(self.block(text, "about")["events"], ["frame 2: rebalance: 1 world moved"])

    def test_loads_nothing_from_the_network(self):
        text = self.made()
        for loader in ('src="http', 'href="http', "url(http", "@import", "src='http", "href='http"):
            self.assertNotIn(loader, text)

    def test_stays_within_its_room_for_poses(self):
        replay = self.block(self.made(100_000, worlds=40, frames=10), "replay")
        self.assertLessEqual(len(replay["position"]) + len(replay["orientation"]), 100_008, "base64 pads each of the two arrays")
        self.assertNotEqual(replay["note"], "")

    def test_has_the_libraries_and_refuses_unknown_names(self):
        self.assertIn("WebGLRenderer", page.asset("three_js"))
        self.assertIn("Chart.js v", page.asset("chart_js"))
        with self.assertRaises(FileNotFoundError):
            page.asset("nothing_js")

    def test_a_link_that_leads_back_to_itself_is_refused(self):
        pathlib.Path(self.path("round")).symlink_to("round")
        with self.assertRaisesRegex(BadInput, "round"):
            write_file(self.path("round"), "text")


class Facts(unittest.TestCase):
    def found(self, **changes):
        return {label: (value, note) for label, value, note in run_page.facts(copy.deepcopy(page_sample.SUMMARY) | changes)}

    def test_thousands_are_grouped_and_counts_in_plain_words(self):
        self.assertEqual(self.found(bodies=1234567, worlds=1)["Size"], ("1,234,567 bodies", "in 1 world"))
        self.assertEqual(self.found(substeps=2)["Stepper"], ("quick", "2 substeps of 20 iterations, dt 10 ms"))

    def test_a_run_without_a_measured_frame_claims_no_speed(self):
        found = self.found(frames={"measured": 0})
        self.assertEqual(found["Frame rate"][0], "not measured")
        self.assertNotIn("Efficiency", found)

    def test_times_are_in_milliseconds(self):
        self.assertEqual(self.found()["Frame time"], ("2.10 ms", "median; p99 4.10, max 4.20"))
        self.assertEqual(self.found()["Within budget"], ("80 %", "of frames in 3.33 ms"))

    def test_estimates_are_shown_where_there_are_any(self):
        self.assertNotIn("Estimate", self.found())
        estimate = {"delivered_s": {"p50": 0.00125}, "precise_over_delivered": 3.25, "position_defect_m": {"rms": 0.04}}
        self.assertEqual(self.found(estimate=estimate)["Estimate"], ("1.25 ms", "delivered; precise 3.2 × later, rms off 40.0 mm"))


class Plots(Sample):
    def test_sums_and_bounds_the_worlds_of_each_frame(self):
        band = run_page.band(np.array([[3.0, 1, 2], [1, 1, 4]]), 1)
        self.assertEqual(band, {"sum": [6, 6], "min": [1, 1], "mean": [2, 2], "max": [3, 4]})

    def test_bins_frames_by_mean_sum_and_by_extreme_worlds(self):
        band = run_page.band(np.array([[1.0, 3], [5, 7], [2, 2]]), 2)
        self.assertEqual(band, {"sum": [8, 4], "min": [1, 2], "mean": [4, 2], "max": [7, 2]})

    def test_phases_are_averaged_over_the_measured_frames_and_left_out_where_they_took_no_time(self):
        seconds = np.array([[90.0, 90], [90, 90], [90, 90], [0.001, 0.004], [0.003, 0.004]])
        plots = run_page.plots(self.sample(worlds=1, frames=5, timings__rank__collide=seconds), BUDGET_S)
        self.assertEqual(plots["phases"][0]["name"], "collide")
        # Means of small binary fractions: off by rounding at most.
        np.testing.assert_allclose(plots["phases"][0]["mean_ms"], [2, 4], atol=1e-12)
        self.assertEqual(plots["num_warmup"], 3)
        self.assertEqual(len(plots["phases"]), 8, "of the ten phases of the sample, cross_space and ship are zero")

    def test_shows_what_a_simulation_should_keep_with_lengths_in_mm(self):
        plots = run_page.plots(self.sample(worlds=2, frames=4), BUDGET_S)
        self.assertEqual(plots["energy"]["mean"], [1000, 990, 980, 970])
        self.assertEqual(plots["linear_momentum"]["max"], [50] * 4)  # (30, 40, 0)
        self.assertIsNone(plots["angular_momentum"])  # the sample has none
        self.assertAlmostEqual(plots["joint_gap_mm"]["max"][3], 0.4, places=12)
        self.assertEqual(plots["max_penetration_mm"]["min"][0], 2)

    def test_a_long_run_is_drawn_in_bins_in_which_a_spike_survives(self):
        frames = 3 * run_page.MOST_POINTS + 1
        wall = np.full(frames, 0.001)
        wall[5] = 0.009
        path = self.write("long.h5", committed=frames, timings__frame__wall=wall)
        plots = run_page.plots(Run(path), BUDGET_S)
        self.assertEqual((plots["per_bin"], plots["wall_ms"][:3]), (4, [1, 9, 1]))
        self.assertLessEqual(len(plots["wall_ms"]), run_page.MOST_POINTS)


class Replay(Sample):
    BODIES = len(page_sample.bodies())

    def test_takes_everything_that_fits(self):
        found = self.selected(self.sample(worlds=3), 3 * self.BODIES, 9)
        self.assertEqual((found.num_worlds, found.num_bodies, len(found.records), found.note), (3, 3 * self.BODIES, 8, ""))

    def test_leaves_out_the_last_worlds_first_and_says_so(self):
        found = self.selected(self.sample(worlds=3), 2 * self.BODIES, 9)
        self.assertEqual((found.num_worlds, found.num_bodies, len(found.records)), (2, 2 * self.BODIES, 8))
        self.assertIn("the first 2 of 3 worlds", found.note)

    def test_thins_the_frames_of_one_world_and_keeps_the_last(self):
        found = self.selected(self.sample(worlds=1, frames=11), self.BODIES, 5)
        self.assertEqual(list(found.records), [1, 4, 7, 10])
        self.assertIn("4 of 11 recorded frames", found.note)

    def test_thins_a_long_run_before_it_leaves_out_worlds(self):
        run = self.sample(worlds=2, frames=4)
        run.num_recorded = 3 * run_page.PREFERRED_RECORDS
        found = self.selected(run, 2 * self.BODIES, run_page.PREFERRED_RECORDS + 1)
        self.assertEqual((found.num_worlds, len(found.records), found.records[-1]), (2, run_page.PREFERRED_RECORDS, run.num_recorded - 1))

    def test_shows_the_end_of_one_world_in_the_least_room(self):
        found = run_page.Selection(self.sample(worlds=2), 1)
        self.assertEqual((found.num_worlds, list(found.records)), (1, [7]))

    def test_a_run_without_a_frame_shows_its_initial_pose(self):
        run = self.sample(worlds=1, frames=0)
        found = run_page.replay(run, run_page.Selection(run))
        self.assertEqual(found["time_s"], [0])
        self.assertEqual(len(base64.b64decode(found["position"])), 12 * self.BODIES)

    def test_the_first_frame_is_the_initial_pose_and_poses_take_the_room_that_is_counted_for_them(self):
        run = self.sample(worlds=2)
        chosen = run_page.Selection(run)
        found = run_page.replay(run, chosen)
        positions = np.frombuffer(base64.b64decode(found["position"]), "<f4").reshape(9, -1, 3)
        np.testing.assert_array_equal(positions[0], run.column("particles/bodies/initial_position").astype("f4"))
        # Base64 pads each of the two arrays by at most 4 characters.
        self.assertAlmostEqual(len(found["position"]) + len(found["orientation"]), room_for(chosen.num_bodies, 9), delta=8)

    def test_frames_are_numbered_as_in_the_plots(self):
        for attributes, first, numbers in (({}, 0, [0, 1, 2, 3]), ({"record_every": 2, "first_frame": 30}, 30, [0, 32])):
            run = Run(page_sample.write(self.path(f"from{first}.h5"), frames=3, attributes=attributes))
            self.assertEqual(run_page.replay(run, run_page.Selection(run))["number"], numbers)
            self.assertEqual(run_page.plots(run, BUDGET_S)["first_frame"], first)

    def test_kinds_of_actors_are_those_of_the_model(self):
        text = (SOURCE / "src/model/names.h").read_text(encoding="utf-8")
        names = re.search(r"actor_kind_names = \{(.*?)\}", text, re.DOTALL)[1]
        self.assertEqual(tuple(re.findall(r'"(\w+)"', names)), run_page.KINDS)

    def test_has_the_geoms_of_the_shown_worlds_only(self):
        run = self.sample(worlds=2)
        found = run_page.replay(run, self.selected(run, self.BODIES, 9))
        self.assertEqual(len(base64.b64decode(found["geoms"]["kind"])), self.BODIES + 2)
        self.assertEqual(found["shape_names"][0], "plane")


if __name__ == "__main__":
    unittest.main()
