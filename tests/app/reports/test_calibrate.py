"""pbreport calibrate: costs fitted to timed cases, and forecasts of traffic, time and memory."""
import itertools
import math
import pathlib
import sys
import types
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "src/app"))
from reports import calibrate, harness  # noqa: E402
from reports.files import BadInput, Study  # noqa: E402
from reports.harness import Costs, Gather, Load  # noqa: E402


def case(part, seconds, **others):
    usual = {"part": part, "ranks": 1, "worlds": 0, "bodies": 0, "steps": 0, "bytes": 0, "seconds": seconds}
    return types.SimpleNamespace(**usual | others)


def shaped(load, radix, piece_bytes):
    gather = Gather(load)
    place = 1
    while place < load.ranks:
        place *= radix
    gather.radix, gather.piece_bytes, gather.root = radix, piece_bytes, gather.root._replace(place=place)
    return gather


def link(latency, overhead, gap, byte):
    return Costs(message_latency=latency, message_overhead=overhead, message_gap=gap, message_byte=byte)


class FitCosts(unittest.TestCase):
    def test_finds_the_costs_of_which_times_are_made(self):
        """Up to the rounding of the fit: 1e-6 of each."""
        cases = []
        for worlds, bodies in itertools.product((1, 10, 100), (1, 40)):
            cases += [case("frame", 2e-6 + worlds * (1e-7 + 3e-9 * steps + 5e-9 * bodies), worlds=worlds, bodies=bodies, steps=steps)
                      for steps in (1, 8)]
            cases.append(case("unpack", worlds * (2e-8 + 4e-9 * bodies), ranks=64, worlds=worlds, bodies=bodies))
        cases += [case("message", 3e-6 + 2e-10 * size, ranks=2, bytes=size) for size in (8, 1024, 1048576)]
        cases += [case("send", 4e-7, ranks=2, bytes=8), case("receive", 6e-7, ranks=2, bytes=8)]
        costs = harness.fit_costs(cases)
        for name, expected in (("frame", 2e-6), ("world_frame", 1e-7), ("world_step", 3e-9), ("body_frame", 5e-9),
                               ("root_unpack_world", 2e-8), ("root_unpack_body", 4e-9), ("message_byte", 2e-10), ("message_overhead", 4e-7),
                               ("message_latency", 3e-6 - 8e-7), ("message_gap", 6e-7)):
            self.assertAlmostEqual(getattr(costs, name) / expected, 1, delta=1e-6, msg=name)
        self.assertEqual(costs.root_hash_world, 0, "was not timed")

    def test_has_no_negative_cost(self):
        """The time falls as ranks are added, as if a rank gave time back."""
        costs = harness.fit_costs([case("balance", 1e-3, ranks=10, worlds=100), case("balance", 0.9e-3, ranks=1000, worlds=100)])
        self.assertEqual(costs.root_balance_rank, 0)
        self.assertAlmostEqual(costs.root_balance_world, 0.95e-5, delta=0.05e-5)


class Traffic(unittest.TestCase):
    def test_of_two_ranks_is_a_message_of_poses_two_of_the_agreement_and_one_of_the_verdict(self):
        load = Load(2, 100, 37)  # rank 1 has 50 worlds of 1 + 7 x 37 numbers of 8 bytes
        traffic = harness.traffic_of(load, Gather(load))
        self.assertEqual(traffic.gather, (1, 50 * 260 * 8))
        self.assertEqual(traffic.into_root, traffic.gather)
        self.assertEqual(traffic.all, (1 + 2 + 1, 50 * 260 * 8 + 2 * 48 + 32))

    def test_of_one_rank_is_none(self):
        load = Load(1, 100, 37)
        self.assertEqual(harness.traffic_of(load, Gather(load)).all, (0, 0))

    def test_of_four_ranks_in_a_binomial_tree_passes_one_share_on(self):
        load = Load(4, 8, 1)  # 2 worlds a rank: shares of 128 bytes. 1 -> 0, 3 -> 2, 2 -> 0 with the share of 3
        traffic = harness.traffic_of(load, shaped(load, 2, 200))
        self.assertEqual(traffic.gather, (1 + 1 + 2, 4 * 128), "256 bytes are two pieces of 200 at most")
        self.assertEqual(traffic.into_root, (3, 3 * 128))
        self.assertEqual(traffic.busiest_rank_bytes, 256)

    def test_of_ranks_without_worlds_is_no_message(self):
        load = Load(8, 3, 2)
        self.assertEqual(harness.traffic_of(load, Gather(load)).gather[0], 2, "ranks 1 and 2 have a world each")

    def test_brings_the_same_bytes_into_root_by_every_tree_and_fewer_messages_by_a_deeper_one(self):
        load = Load(1024, 5000, 3)
        linear, tree = (harness.traffic_of(load, Gather(load, flat)) for flat in (True, False))
        self.assertEqual(linear.into_root[1], tree.into_root[1])
        self.assertEqual((linear.into_root[0], tree.into_root[0]), (1023, 62))
        self.assertEqual((linear.busiest_rank_bytes, tree.busiest_rank_bytes), (5 * 176, 32 * 5 * 176))

    def test_is_that_of_the_ranks_one_by_one(self):
        """By brute force over the parents of all ranks, as mpi/comm/tree_gather.h defines them."""
        for ranks, worlds in ((2, 7), (33, 40), (100, 250), (1025, 1500), (2111, 9000)):
            load = Load(ranks, worlds, 2)
            sent = [load.world_bytes() * (worlds // ranks + (rank < worlds % ranks)) for rank in range(ranks)]
            into_root, messages, size = 0, 0, 0
            for rank in reversed(range(1, ranks)):  # children have higher numbers
                place = 1
                while rank // place % 32 == 0:
                    place *= 32
                parent = rank - rank // place % 32 * place
                messages, size = messages + -(-sent[rank] // (1 << 20)), size + sent[rank]
                into_root += sent[rank] if parent == 0 else 0
                sent[parent] += sent[rank] if parent else 0
            traffic = harness.traffic_of(load, Gather(load))
            self.assertEqual(traffic.gather, (messages, size))
            self.assertEqual((traffic.into_root[1], traffic.busiest_rank_bytes), (into_root, max(sent[1:])))

    def test_counts_an_allreduce_as_open_mpi_does(self):
        """Open MPI 4.1.4's own count (pml monitoring) of an allreduce of 6 numbers is 2, 4 and 384 messages."""
        self.assertEqual([harness.messages_of_allreduce(ranks) for ranks in (1, 2, 3, 64)], [0, 2, 4, 384])
        self.assertEqual([harness.rounds_of_allreduce(ranks) for ranks in (64, 65)], [6, 8])


class FrameTimes(unittest.TestCase):
    """Times are sums and products of a few numbers; 1e-15 s is far above their rounding, and far below any term."""

    def assert_near(self, found, expected):
        self.assertAlmostEqual(found, expected, delta=1e-15)

    def test_of_a_flat_gather_are_the_messages_that_root_takes_one_after_the_other(self):
        load = Load(4, 4, 1)  # three messages of 64 bytes, all sent at 0 and received after overhead + latency
        self.assert_near(Gather(load, linear=True).seconds(link(2e-6, 1e-6, 0.5e-6, 1e-9)), 1e-6 + 2e-6 + 3 * (1e-6 + 64e-9))

    def test_of_a_binomial_gather_follow_the_longest_way(self):
        # 3 sends to 2, which has the whole message after o + L + o + 64 G and hands on two shares for another o.
        # By then root has the message of 1.
        at_2 = 1e-6 + 2e-6 + 1e-6 + 64e-9
        found = shaped(Load(4, 4, 1), 2, 1 << 20).seconds(link(2e-6, 1e-6, 0, 1e-9))
        self.assert_near(found, at_2 + 1e-6 + 2e-6 + 1e-6 + 128e-9)

    def test_pieces_are_handed_on_while_others_arrive(self):
        """Long streams over 3 levels: root's own bytes decide, not their number of levels."""
        found = shaped(Load(8, 8000, 37), 2, 1 << 16).seconds(link(1e-6, 1e-6, 1e-6, 1e-9))
        bytes_s = 7000 * 260 * 8 * 1e-9
        self.assertGreater(found, bytes_s)
        self.assertLess(found, 1.3 * bytes_s, "a quarter of the stream would wait at each level otherwise")

    def test_count_every_part_once(self):
        costs = Costs(message_latency=1e-6, message_overhead=1e-6, frame=10e-6, world_frame=2e-6, world_step=1e-7, body_frame=1e-8,
                      root_unpack_world=1e-7, root_unpack_body=1e-8, root_balance_world=3e-7, root_balance_rank=1e-6)
        load = Load(2, 10, 4, 3, 1e-4)
        forecast = calibrate.forecast_of(load, costs, calibrate.TREE)
        expected = {"step": 5 * 3 * 1e-4, "harness": 10e-6 + 5 * (2e-6 + 3e-7 + 4e-8), "agreement": 3e-6, "gather": 3e-6,
                    "unpack": 5 * (1e-7 + 4e-8), "balance": 10 * 3e-7 + 2e-6, "verdict": 3e-6}
        self.assertEqual(list(forecast.parts), list(expected))
        for part, seconds in expected.items():
            self.assert_near(forecast.parts[part], seconds)
        self.assertEqual(forecast.longest, "harness")
        alone = Load(1, 10, 4, 3, 1e-4)
        self.assert_near(sum(harness.frame_parts(alone, costs, Gather(alone)).values()), 10 * 3e-4 + 10e-6 + 10 * (2e-6 + 3e-7 + 4e-8))


class Memory(unittest.TestCase):
    def test_of_a_rank_does_not_grow_with_ranks_or_results_that_root_alone_holds(self):
        costs, load = Costs(memory_rank=30e6, memory_body=1000), Load(1024, 102400, 37)
        before = harness.memory_of(load, costs, Gather(load, linear=True), True, 1000)
        after = harness.memory_of(load, costs, Gather(load), False, 1000)
        self.assertGreater(before.any_rank - after.any_rank, 1024 * 1000 * 8, "times of 1,024 ranks in 1,000 frames")
        # 36 bytes of the table for each world of the run; the bodies, message and result of each of the 100 own worlds; and two pieces of
        # what other ranks hand on.
        self.assertEqual(after.any_rank, 30e6 + 36 * 102400 + 100 * (37 * 1000 + 2080 + 368) + 2 * (1 << 20))
        self.assertEqual(after.row_writer - after.any_rank, 104 * 37 * 102400)
        self.assertGreater(after.root, after.any_rank)


class Report(unittest.TestCase):
    def study(self, **parameters):
        cases = [case("frame", 1e-5, worlds=4, bodies=1, steps=1), case("frame", 9e-6, ranks=2, worlds=4, bodies=1, steps=1)]
        columns = {name: [getattr(one, name) for one in cases] for name in vars(cases[0])}
        return Study("calibrate.h5", {}, {"rank_bytes": "3e7", "body_bytes": "1000"} | parameters, {"cases": columns})

    def options(self, **others):
        return types.SimpleNamespace(**{"ranks": [2, 64], "worlds": [10, 100], "bodies": 37, "step_s": 0.0} | others)

    def test_has_costs_forecasts_walls_and_checks(self):
        report, numbers = calibrate.report_of(self.study(), self.options())
        self.assertEqual(list(report.numbers), sorted(calibrate.TABLES))
        forecasts = report.numbers["forecasts"]
        self.assertEqual(list(zip(forecasts["worlds"], forecasts["ranks"], forecasts["gather"])),
                         [(10, 2, "flat"), (10, 2, "tree"), (100, 2, "flat"), (100, 2, "tree"), (100, 64, "flat"), (100, 64, "tree")],
                         "no more ranks than worlds")
        costs = dict(zip(report.numbers["costs"]["cost"], report.numbers["costs"]["value"]))
        self.assertEqual((costs["memory_rank"], costs["memory_body"]), (3e7, 1000))
        self.assertEqual(report.numbers["checks"]["ranks"], [2], "frames of several ranks are compared with a forecast")
        self.assertEqual({column.name: column.unit for column in numbers["forecasts"]}["gather_time"], "s")
        self.assertTrue(report.sections[2].text.endswith("\n\nnone"), "no part takes longer than the budget")

    def test_a_wall_is_at_the_first_power_of_two_of_ranks_beyond_the_budget(self):
        costs = Costs(root_balance_rank=1e-4)  # 3.33 ms hold 33 ranks
        walls = calibrate.walls_of(self.options(worlds=[1000, 16]), costs)
        found = {(wall.worlds, wall.part): wall.ranks for wall in walls if any(wall.ranks.values())}
        self.assertEqual(found, {(1000, "balance"): {"flat": 64, "tree": 64}})

    def test_refuses_parts_and_files_that_it_does_not_know(self):
        with self.assertRaisesRegex(BadInput, "a part 'frames', which this pbreport does not know"):
            study = self.study()
            study.tables["cases"]["part"][0] = "frames"
            calibrate.costs_of(study)
        with self.assertRaisesRegex(BadInput, "no parameter 'body_bytes'; measure it again"):
            study = self.study()
            del study.parameters["body_bytes"]
            calibrate.costs_of(study)

    def test_times_and_bytes_are_read_and_shown_with_their_units(self):
        self.assertEqual(list(map(calibrate.time_text, (2.0, 3e-3, 4.5e-6, 1e-9, 0.0))), ["2 s", "3 ms", "4.5 us", "1 ns", "0 ns"])
        self.assertEqual(list(map(calibrate.bytes_text, (999, 1000, 2.5e9, 1e15))), ["999 B", "1 kB", "2.5 GB", "1e+03 TB"])
        self.assertEqual(list(map(calibrate.seconds, ("0", "0.5", "40us"))), [0, 0.5, 40 * 1e-6])
        for text in ("soon", "-1", "inf", "nan"):
            with self.assertRaisesRegex(BadInput, f"--world-step {text}"):
                calibrate.seconds(text)
        self.assertTrue(math.isclose(calibrate.BUDGET_S, 1 / 300))


if __name__ == "__main__":
    unittest.main()
