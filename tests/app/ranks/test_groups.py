"""Many worlds, each cut into spaces over a group of ranks: the bits and the files of whole worlds."""
import os
import signal
import sys
import unittest

import h5py
import numpy as np

APP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [APP, os.path.join(APP, "files")]
from harness import ProgramTest, rank_pids, wait_until  # noqa: E402
from same_files import content, differences  # noqa: E402
from small_scenes import SIGN, STACKS  # noqa: E402
from test_guards import SCENE as DROP  # noqa: E402

# Ranks, ranks a world, and the groups of three worlds that come of it: "ranks:worlds" of each.
FORMS = ((1, 1, "1:3"), (2, 1, "1:2,1:1"), (2, 2, "2:3"), (3, 1, "1:1,1:1,1:1"), (3, 2, "2:2,1:1"), (4, 2, "2:2,2:1"), (4, 3, "2:2,2:1"),
         (4, 4, "4:3"))
THREE = ("--replicas", 3, "--stepper", "sor")


def cut(ranks_per_world):
    return ("--decompose", "spaces", "--ranks-per-world", ranks_per_world)


class Groups(ProgramTest):
    def test_the_file_is_that_of_whole_worlds_for_any_groups_and_says_which_ranks_cut_which_worlds(self):
        for scene, options in (("Fight", ("--frames", 6)), ("Battle2", ("--frames", 3, "--precision", "single"))):
            run = ("--scene", scene, *THREE, *options, "--record", "contacts")
            self.summary(1, *run, "--decompose", "worlds", "--output", "whole.h5")
            whole = content(self.path("whole.h5"))
            self.assertGreater(len(whole), 60, "the columns of the file, with their states and observables")
            for ranks, ranks_per_world, form in FORMS:
                with self.subTest(scene=scene, ranks=ranks, ranks_per_world=ranks_per_world):
                    summary = self.summary(ranks, *run, *cut(ranks_per_world), "--output", "cut.h5")
                    self.assertEqual(summary["decomposition"], "spaces")
                    self.assertEqual(differences(whole, content(self.path("cut.h5"))), [])
                    self.check_groups(summary, form)

    def check_groups(self, summary, form):
        """Summary, file and pbreport name the groups."""
        groups = [tuple(map(int, one.split(":"))) for one in form.split(",")]
        self.assertEqual([(group["ranks"], group["worlds"]) for group in summary["spaces"]["groups"]], groups)
        with h5py.File(self.path("cut.h5")) as file:
            self.assertEqual(file["parameters/rank_groups"].asstr()[()], form)
            self.assertEqual(file["parameters/decompose"].asstr()[()], "spaces")
            owned = [worlds if rank == 0 else 0 for size, worlds in groups for rank in range(size)]
            self.assertEqual(file["ranks/worlds_at_start"][:].tolist(), owned)
            cost = file["world_results/cost"][:]
            self.assertTrue((cost > 0).all())
            self.assertAlmostEqual(cost.sum() / file["timings/rank/useful"][:].sum(), 1, delta=1e-9)
        self.assertEqual(self.json(self.report("cut.h5", "--json"))["spaces"], summary["spaces"])
        self.assertIn("\ngroups: ", self.report("cut.h5").stdout)

    def test_one_world_that_is_cut_has_no_groups(self):
        one = self.summary(2, "--scene", "Fight", "--stepper", "sor", "--frames", 2, "--output", "one.h5")
        self.assertNotIn("groups", one["spaces"])
        with h5py.File(self.path("one.h5")) as file:
            self.assertNotIn("rank_groups", file["parameters"])

    def test_bodies_that_sleep_and_joints_that_break_do_so_in_groups_too(self):
        for name, text in (("stacks.toml", STACKS), ("sign.toml", SIGN)):
            run = ("--scene", self.write(name, text), *THREE, "--frames", 40, "--no-output")
            whole = self.summary(2, *run, "--decompose", "worlds")
            for ranks, ranks_per_world, _ in FORMS[2:]:
                found = self.summary(ranks, *run, *cut(ranks_per_world))
                for key in ("state_hash", "joints_broken", "islands", "invariants"):
                    self.assertEqual(found[key], whole[key], (name, ranks, ranks_per_world, key))

    def test_the_energy_of_all_worlds_is_that_of_the_file_whichever_rank_has_which(self):
        run = ("--scene", self.write("stacks.toml", STACKS), "--replicas", 7, "--stepper", "sor", "--frames", 3, "--output", "run.h5")
        found = set()
        for ranks in (1, 2, 3, 4):
            for form in (("--decompose", "worlds"), cut(ranks)):
                found.add(self.summary(ranks, *run, *form)["invariants"]["energy_j"])
                found.add(self.json(self.report("run.h5", "--json"))["invariants"]["energy_j"])
        with h5py.File(self.path("run.h5")) as file:
            found.add(sum(file["observables/world/energy"][-1].tolist(), 0.0))
        self.assertEqual(len(found), 1, found)

    def test_a_run_goes_on_from_a_checkpoint_in_another_form(self):
        run = ("--scene", "Fight", *THREE)
        whole = self.summary(1, *run, "--frames", 12, "--decompose", "worlds", "--no-output")["state_hash"]
        forms = ((4, cut(2)), (2, ("--decompose", "worlds")), (3, cut(2)), (4, cut(4)), (1, ("--decompose", "worlds")))
        for (ranks, form), (ranks_after, then) in zip(forms, forms[1:] + forms[:1]):
            self.summary(ranks, *run, *form, "--frames", 5, "--no-output", "--checkpoint", "run.ck.h5")
            rest = self.summary(ranks_after, "--resume", "run.ck.h5", "--frames", 12, "--no-output", *then)
            self.assertEqual(rest["state_hash"], whole, (ranks, form, ranks_after, then))

    def test_a_world_that_blows_up_is_dealt_with_in_its_group_as_in_one_piece(self):
        run = ("--scene", self.write("drop.toml", DROP), "--seed", 24, "--frames", 150, *THREE, "--no-output")
        for choice, kind in (("report", "passage"), ("freeze", "frozen"), ("refine", "refined")):
            whole = self.summary(1, *run, "--on-blowup", choice, "--decompose", "worlds")
            self.assertGreater(whole["guards"][kind], 0)
            for ranks, ranks_per_world in ((2, 2), (3, 2), (4, 2)):
                found = self.summary(ranks, *run, "--on-blowup", choice, *cut(ranks_per_world))
                for key in ("state_hash", "guards", "worlds_survived"):
                    self.assertEqual(found[key], whole[key], (choice, ranks, key))
        stopped = [self.pbmpi(ranks, *run, "--on-blowup", "stop", *form) for ranks, form in ((1, ()), (4, cut(2)))]
        for result in stopped:
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn("the run ends here (--on-blowup stop)", result.stderr)
        said = [[line for line in result.stderr.splitlines() if "ends here" in line] for result in stopped]
        self.assertEqual(said[0], said[1])

    def test_a_range_of_an_ensemble_has_its_own_numbers_in_groups_too(self):
        run = ("--scene", "Fight", "--replicas", 7, "--world-range", "3:6", "--frames", 3, "--no-output")
        self.assertEqual(self.summary(1, *run, "--decompose", "worlds")["state_hash"], self.summary(4, *run, *cut(2))["state_hash"])

    def test_auto_makes_groups_of_ranks_that_would_have_no_world(self):
        run = ("--scene", "Fight", "--frames", 3, "--no-output")
        found = self.summary(4, *run, "--replicas", 2)
        self.assertEqual(found["spaces"]["groups"], [{"ranks": 2, "worlds": 1}] * 2)
        self.assertEqual(found["state_hash"], self.summary(1, *run, "--replicas", 2)["state_hash"])
        for ranks, args in ((2, ("--replicas", 2)), (3, ("--replicas", 2, "--stepper", "quick")), (4, ("--replicas", 2, "--threads", 2))):
            self.assertEqual(self.summary(ranks, *run, *args)["decomposition"], "worlds", args)

    def test_estimates_are_the_same_in_groups_and_leave_the_run_alone(self):
        run = ("--scene", "Fight", *THREE, "--frames", 3)
        alone = self.summary(1, *run, "--decompose", "worlds", "--no-output")["state_hash"]
        estimates = set()
        for ranks, form in ((1, ("--decompose", "worlds")), (2, cut(2)), (3, cut(2)), (4, cut(2))):
            summary = self.summary(ranks, *run, *form, "--feec", "--output", "run.h5")
            self.assertEqual(summary["state_hash"], alone)
            with h5py.File(self.path("run.h5")) as file:
                estimate = file["estimate/position/value"][:]
                self.assertGreater(np.abs(estimate - file["particles/bodies/position/value"][:]).max(), 0)
                estimates.add(estimate.tobytes())
        self.assertEqual(len(estimates), 1)

    def test_describe_tells_which_ranks_own_which_worlds_and_spaces(self):
        result = self.pbmpi(4, "--scene", "Battle", "--replicas", 5, "--world-range", "1:5", *cut(3), "--describe")
        self.assertEqual(result.returncode, 0, result.stderr)
        for line in ("decomposition: spaces over 4 ranks, 2 groups of 2 ranks\n",
                     "  group 0: worlds 1..2 (2 worlds), one after the other, each over ranks 0..1\n",
                     "  group 1: worlds 3..4 (2 worlds), one after the other, each over ranks 2..3\n", "  rank 2: spaces ", "  rank 3: spaces "):
            self.assertIn(line, result.stdout)
        idle = self.pbmpi(4, "--scene", "Battle", "--replicas", 2, *cut(1), "--describe").stdout
        self.assertIn("2 groups of 1 rank\n", idle)
        self.assertIn("  rank 3: idle (more ranks than groups have use for)\n", idle)

    def test_ranks_that_are_left_over_are_idle(self):
        summary = self.summary(4, "--scene", "Fight", "--replicas", 2, "--frames", 2, "--no-output", *cut(1))
        self.assertEqual(summary["idle_ranks"], [2, 3])

    def test_what_cannot_be_had_is_refused_with_one_message(self):
        for args, words in ((("--stepper", "quick", "--decompose", "spaces"), "add --stepper sor"),
                            (("--ranks-per-world", 2, "--decompose", "worlds"), "or give --decompose spaces"),
                            (("--ranks-per-world", 0), "--ranks-per-world 0: it must be at least 1"),
                            ((*cut(2), "--record", "residuals"), "--record residuals: no rank of a world that is cut"),
                            ((*cut(2), "--threads", 2), "--threads 2: a rank steps its part")):
            result = self.pbmpi(2, "--scene", "Fight", "--replicas", 3, *args)
            self.assertEqual(result.returncode, 2, result.stderr)
            lines = [line for line in result.stderr.splitlines() if line.startswith("pbmpi: ")]
            self.assertEqual(len(lines), 1, result.stderr)
            self.assertIn(words, lines[0])
        self.assertEqual(os.listdir(self.folder), [])

    def test_a_signal_saves_the_run_which_goes_on_to_the_same_bits(self):
        run = ("--scene", "Fight", *THREE)
        process = self.start(4, *run, *cut(2), "--frames", 1000000, "--record-every", 100, "--quiet", "--output", "run.h5")
        wait_until(lambda: os.path.exists(self.path("run.h5")), "the file")
        os.kill(rank_pids(process)[3], signal.SIGTERM)
        _, errors = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 75, errors)
        with h5py.File(self.path("run.h5")) as file:
            done = int(file.attrs["frames_committed"])
            self.assertEqual(int(file.attrs["complete"]), 0)
        rest = self.summary(2, "--resume", "run.checkpoint.h5", "--frames", done + 2, "--decompose", "worlds", "--no-output")
        whole = self.summary(1, *run, "--frames", done + 2, "--decompose", "worlds", "--no-output")
        self.assertEqual(rest["state_hash"], whole["state_hash"])


if __name__ == "__main__":
    unittest.main()
