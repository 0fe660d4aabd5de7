"""Killed ranks, signals and full disks: what was written stays readable, and nothing hangs.

usage: test_faults.py [--kills N]: N runs of which one rank is killed; 12 without it."""
import os
import random
import signal
import time
import unittest

import h5py
import numpy

from harness import AT_ONCE, TIMEOUT_S, ProgramTest, number_argument, rank_pids, wait_until

NUM_KILLS = number_argument("--kills", 12)
LONG_RUN = ["--scene", "CrashSk", "--replicas", "8", "--frames", "1000000", "--record-every", "100", "--quiet"]


class Faults(ProgramTest):
    def check_file(self, name):
        """The file opens, and what is committed is finite; returns the number of committed frames."""
        with h5py.File(self.path(name)) as file:
            self.assertIn(file.attrs["filetype"], ("pbmpi-run", b"pbmpi-run"))
            committed = int(file.attrs["frames_committed"])
            stored = committed // int(file["parameters/record_every"][()])
            for column in ("position", "orientation", "velocity", "angular_velocity"):
                values = file[f"particles/bodies/{column}/value"][:stored]
                self.assertEqual(len(values), stored)
                self.assertTrue(numpy.isfinite(values).all(), column)
            self.assertTrue((numpy.linalg.norm(file["particles/bodies/orientation/value"][:stored], axis=2) > 0.5).all(),
                            "a committed row must hold a rotation, not fill values")
            self.assertTrue((file["timings/frame/wall"][:committed] > 0).all())
            return committed

    def test_kill_9_of_one_rank_at_random_moments_leaves_a_readable_file(self):
        random_source = random.Random(20061)
        most = 0
        for attempt in range(NUM_KILLS):
            name = f"run{attempt}.h5"
            # Every fourth time the other rank has a second more.
            environment = os.environ if attempt % 4 == 0 else {**os.environ, **AT_ONCE}
            process = self.start(2, *LONG_RUN, "--output", name, env=environment)
            wait_until(lambda: os.path.exists(self.path(name)), "the file's skeleton")
            time.sleep(random_source.uniform(0, 2.5) if attempt % 2 else random_source.uniform(0, 0.3))
            os.kill(rank_pids(process)[random_source.randrange(2)], signal.SIGKILL)
            process.wait(timeout=TIMEOUT_S)
            self.assertNotEqual(process.returncode, 0)
            most = max(most, self.check_file(name))
            os.remove(self.path(name))
        self.assertGreater(most, 0, "at least one run must have lived past its first flush")

    def test_signals_finish_the_frame_and_close_the_file(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            name = f"run{int(number)}.h5"
            process = self.start(2, *LONG_RUN, "--output", name)
            wait_until(lambda: os.path.exists(self.path(name)), "the file's skeleton")
            for pid in rank_pids(process).values():
                os.kill(pid, number)
            process.wait(timeout=TIMEOUT_S)
            self.assertEqual(process.returncode, 75, process.stderr.read())
            committed = self.check_file(name)
            with h5py.File(self.path(name)) as file:
                self.assertEqual(int(file.attrs["complete"]), 0)
                self.assertEqual(len(file["timings/frame/wall"]), committed, "the file is cut to what was simulated")
                self.assertEqual(len(file.attrs["state_hash"]), 16)

    def disk_bytes(self, name):
        return 512 * os.stat(self.path(name)).st_blocks

    def test_a_killed_run_keeps_a_step_of_the_disk_that_it_planned_and_repair_gives_it_back(self):
        process = self.start(2, "--scene", "100CrSk", "--frames", "4000", "--quiet", "--output", "run.h5")
        wait_until(lambda: os.path.exists(self.path("run.h5")) and self.check_file("run.h5") > 2, "some frames")
        refused = self.report("repair", "run.h5")
        self.assertEqual(refused.returncode, 2, "a run that lives is not repaired")
        self.assertIn("writes it", refused.stderr)
        for pid in rank_pids(process).values():
            os.kill(pid, signal.SIGKILL)
        process.wait(timeout=TIMEOUT_S)
        committed = self.check_file("run.h5")
        planned, kept = os.stat(self.path("run.h5")).st_size, self.disk_bytes("run.h5")
        with h5py.File(self.path("run.h5")) as file:
            before = file["particles/bodies/position/value"][:committed]
        self.assertGreater(planned, 1e9)
        self.assertLess(kept, planned * committed / 4000 + (150 << 20), "one step too much at most")
        result = self.report("repair", "run.h5")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(f"{committed} frames are committed", result.stdout)
        self.assertLess(self.disk_bytes("run.h5"), planned * committed / 4000 + (8 << 20))
        self.assertEqual(self.check_file("run.h5"), committed)
        with h5py.File(self.path("run.h5")) as file:
            self.assertEqual(len(file["timings/frame/wall"]), committed)
            self.assertTrue(numpy.array_equal(file["particles/bodies/position/value"][:], before))
        self.assertEqual(os.listdir(self.folder), ["run.h5"], "lock and unfinished files are gone")
        again = self.report("repair", "run.h5")
        self.assertIn("0.0 MiB given back", again.stdout)
        self.assertEqual(self.report("run.h5").returncode, 0)

    def test_a_disk_that_fills_up_ends_the_run_between_two_writes(self):
        disk = self.small_disk("400m")
        process = self.start(2, "--scene", "100CrSk", "--frames", "600", "--quiet", "--output", "disk/run.h5")
        wait_until(lambda: os.path.exists(self.path("disk/run.h5")) and self.check_file("disk/run.h5") > 2, "some frames")
        with open(self.path("disk/other"), "wb") as other:
            free = os.statvfs(disk)
            os.posix_fallocate(other.fileno(), 0, (free.f_bavail - 8) * free.f_bsize)
        self.assertEqual(process.wait(timeout=TIMEOUT_S), 1)
        self.assertIn("No space left on device", process.stderr.read())
        self.assertGreater(self.check_file("disk/run.h5"), 2)

    def test_a_disk_too_small_for_the_file_is_refused_before_the_first_frame(self):
        disk = self.small_disk("4m")
        result = self.pbmpi(2, "--scene", "100CrSk", "--frames", 200, "--quiet", "--output", "disk/full.h5")
        self.assertEqual(result.returncode, 2, result.stderr)
        lines = [line for line in result.stderr.splitlines() if line.startswith("pbmpi: ")]
        self.assertEqual(len(lines), 1, result.stderr)
        for words in ("disk/full.h5", "No space left on device", "--record-every"):
            self.assertIn(words, lines[0])
        self.assertEqual(os.listdir(disk), [], "nothing may be left behind")


if __name__ == "__main__":
    unittest.main()
