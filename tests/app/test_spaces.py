"""One world over the ranks: the programs from the command line to the file."""
import json
import os
import signal
import subprocess
import time
import unittest

import h5py

from harness import PBREPORT, TIMEOUT_S, ProgramTest, rank_pids

SOR = ["--stepper", "sor"]
PHASES = ("collide", "islands", "rows", "solve", "integrate", "cross_space", "ship", "gather", "wait")


class Spaces(ProgramTest):
    def test_a_scene_of_several_spaces_has_the_hash_of_the_whole_for_1_to_4_ranks(self):
        args = ["--scene", "Fight", *SOR, "--frames", 20]
        whole = self.summary(1, *args, "--decompose", "worlds", "--no-output")
        for ranks in (1, 2, 3, 4):
            cut = self.summary(ranks, *args, "--decompose", "spaces", "--output", f"run{ranks}.h5")
            self.assertEqual(cut["state_hash"], whole["state_hash"], ranks)
            self.assertEqual(cut["decomposition"], "spaces")
            for key in ("islands", "contacts", "rows", "invariants"):
                self.assertEqual(cut[key], whole[key], f"{ranks} ranks: {key}")
        with h5py.File(self.path("run1.h5")) as one, h5py.File(self.path("run3.h5")) as three:
            for group in ("particles/bodies/position/value", "particles/bodies/angular_velocity/value",
                          "observables/world/energy", "observables/world/rows", "observables/world/max_island_rows"):
                self.assertEqual(one[group][:].tobytes(), three[group][:].tobytes(), group)

    def test_other_substeps_have_the_hash_of_the_whole_too(self):
        args = ["--scene", "Fight", *SOR, "--frames", 20, "--substeps", 4, "--iterations", 4, "--no-output"]
        whole = self.summary(1, *args, "--decompose", "worlds")
        for ranks in (2, 3, 4):
            cut = self.summary(ranks, *args, "--decompose", "spaces")
            self.assertEqual((cut["state_hash"], cut["decomposition"]), (whole["state_hash"], "spaces"), ranks)

    def test_auto_cuts_one_world_of_several_spaces_and_nothing_else(self):
        args = ["--frames", 2, "--no-output"]
        self.assertEqual(self.summary(2, "--scene", "Fight", *SOR, *args)["decomposition"], "spaces")
        self.assertEqual(self.summary(1, "--scene", "Fight", *SOR, *args)["decomposition"], "worlds")
        self.assertEqual(self.summary(2, "--scene", "Fight", "--stepper", "quick", *args)["decomposition"], "worlds")
        self.assertEqual(self.summary(2, "--scene", "CrashSk", *SOR, *args)["decomposition"], "worlds")

    def test_the_file_and_pbreport_show_the_phases_of_each_rank(self):
        summary = self.summary(2, "--scene", "Battle2", *SOR, "--frames", 12, "--output", "run.h5")
        spaces = summary["spaces"]
        self.assertTrue(0 < spaces["serial_share"] < 1)
        self.assertTrue(1 <= spaces["island_bound"] <= spaces["amdahl_bound"] <= 2, spaces)
        self.assertGreater(spaces["messages_per_step"], 0)
        with h5py.File(self.path("run.h5")) as file:
            rank = file["timings/rank"]
            for phase in PHASES:
                self.assertEqual(rank[phase].shape, (15, 2))
            self.assertTrue((rank["cross_space"][:, 0] > 0).all(), "root looks at what crosses in every frame")
            self.assertTrue((rank["cross_space"][:, 1] == 0).all(), "and nobody else does")
            self.assertTrue((rank["messages"][:] > 0).all())
            self.assertTrue((rank["processor"][:] > 0).all())
            used = rank["processor"][file["timings/frame/measured"][:] != 0].mean(axis=0)
            self.assertAlmostEqual(summary["processor_time"]["busiest_s"], used.max(), 12)
            self.assertEqual(summary["processor_time"]["busiest_rank"], used.argmax())
            self.assertGreater(rank["bytes"][:].sum(), rank["messages"][:].sum())
            self.assertEqual(file["parameters/decompose"][()], b"spaces")
        report = subprocess.run([PBREPORT, self.path("run.h5")], capture_output=True, text=True, check=True,
                                timeout=TIMEOUT_S).stdout
        for words in ("\nrank: 0 ", "\nrank: 1 ", " cross_space ", " ship ", "\nspaces: serial share", "\ntraffic: "):
            self.assertIn(words, report)
        document = subprocess.run([PBREPORT, self.path("run.h5"), "--json"], capture_output=True, text=True, check=True,
                                  timeout=TIMEOUT_S).stdout
        self.assertEqual(json.loads(document)["spaces"], spaces)

    def test_more_ranks_than_spaces_leave_ranks_idle(self):
        args = ["--scene", "Battle", *SOR, "--frames", 3]
        summary = self.summary(4, *args, "--output", "run.h5")
        self.assertEqual(len(summary["idle_ranks"]), 1)
        report = subprocess.run([PBREPORT, self.path("run.h5")], capture_output=True, text=True, check=True,
                                timeout=TIMEOUT_S).stdout
        # Which rank it is follows measured times. Root has its section to do even without a space of its own.
        idle = summary["idle_ranks"][0]
        self.assertEqual(f"idle_ranks: {idle} (more ranks than spaces)" in report, idle != 0)
        self.assertEqual(self.summary(1, *args, "--no-output")["state_hash"], summary["state_hash"])

    def test_spaces_are_refused_where_they_cannot_be_had(self):
        for args, words in ((["--stepper", "quick"], "add --stepper sor"), (["--stepper", "direct"], "add --stepper sor"),
                            ([*SOR, "--record", "residuals"], "use --decompose worlds")):
            result = self.pbmpi(2, "--scene", "Fight", "--decompose", "spaces", *args)
            self.assertEqual(result.returncode, 2, result.stderr)
            lines = [line for line in result.stderr.splitlines() if line.startswith("pbmpi: ")]
            self.assertEqual(len(lines), 1, result.stderr)
            self.assertIn(words, lines[0])
        self.assertEqual(os.listdir(self.folder), [])

    def test_describe_tells_who_owns_which_space(self):
        result = self.pbmpi(4, "--scene", "Battle", *SOR, "--describe")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("decomposition: spaces over 4 ranks\n", result.stdout)
        for words in ("spaces attack (", "spaces clash (", "spaces rounds (", "rank 3: idle (more ranks than spaces)"):
            self.assertIn(words, result.stdout)

    def test_a_rank_killed_in_a_step_ends_the_run_and_leaves_a_readable_file(self):
        for victim in (0, 1, 2):
            name = f"run{victim}.h5"
            process = self.start(3, "--scene", "Battle2", *SOR, "--frames", 1000000, "--record-every", 100, "--quiet",
                                 "--output", name)
            deadline = time.monotonic() + TIMEOUT_S
            while not os.path.exists(self.path(name)):
                self.assertLess(time.monotonic(), deadline, "waited in vain for the file")
                time.sleep(0.01)
            time.sleep(2.5)  # past the first flush
            killed = time.monotonic()
            os.kill(rank_pids(process)[victim], signal.SIGKILL)
            _, errors = process.communicate(timeout=TIMEOUT_S)
            self.assertLess(time.monotonic() - killed, 10)
            self.assertNotEqual(process.returncode, 0)
            self.assertIn(f"rank {victim} ", errors, "the message must name the rank")
            with h5py.File(self.path(name)) as file:
                committed = int(file.attrs["frames_committed"])
                self.assertGreater(committed, 0)
                self.assertTrue((file["timings/frame/wall"][:committed] > 0).all())
            os.remove(self.path(name))

    def test_a_signal_finishes_the_frame_and_closes_the_file(self):
        process = self.start(2, "--scene", "Fight", *SOR, "--frames", 1000000, "--record-every", 100, "--quiet",
                             "--output", "run.h5")
        deadline = time.monotonic() + TIMEOUT_S
        while not os.path.exists(self.path("run.h5")):
            self.assertLess(time.monotonic(), deadline, "waited in vain for the file")
            time.sleep(0.01)
        os.kill(rank_pids(process)[1], signal.SIGTERM)
        process.wait(timeout=TIMEOUT_S)
        self.assertEqual(process.returncode, 75, process.stderr.read())
        with h5py.File(self.path("run.h5")) as file:
            self.assertEqual(int(file.attrs["complete"]), 0)
            self.assertEqual(len(file.attrs["state_hash"]), 16)


if __name__ == "__main__":
    unittest.main()
