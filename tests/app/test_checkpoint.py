"""When a run is saved: signals, clocks, kills and full disks. What it is saved for: test_resume.py."""
import os
import random
import shutil
import signal
import subprocess
import time
import unittest

import h5py

from harness import TIMEOUT_S, ProgramTest, end_group, rank_pids, wait_until

# Minutes of work, to be stopped; a frame takes some 20 ms.
SCENE = ("--scene", "100CrSk", "--replicas", 6, "--steps-per-frame", 30)
LONG = (*SCENE, "--frames", 100000, "--record-every", 1000)
NUM_KILLS = 6


class Checkpoint(ProgramTest):
    def frames_in(self, name):
        """Frames done of a checkpoint, which must be whole."""
        with h5py.File(self.path(name)) as file:
            self.assertEqual(file.attrs["filetype"].decode(), "pbmpi-checkpoint")
            self.assertEqual(len(file["bodies/position"]), int(file["worlds/bodies"][:].sum()))
            frames = int(file["parameters/frames_done"][()])
            self.assertEqual(int(file["parameters/steps_done"][()]), 30 * frames)
            return frames

    def exists(self, name):
        return os.path.exists(self.path(name))

    def events(self, name, kind):
        with h5py.File(self.path(name)) as file:
            kinds = file["events/kind"].asstr()[:int(file["events"].attrs["num_events"])]
            details = file["events/detail"].asstr()[:]
            return [details[i] for i, found in enumerate(kinds) if found == kind]

    def check_hash(self, checkpoint):
        """The run in this file, and one that was never stopped, a few frames later."""
        frames = self.frames_in(checkpoint)
        shutil.copy(self.path(checkpoint), self.path("last.h5"))
        rest = self.summary(3, "--resume", "last.h5", "--frames", frames + 2, "--no-output")
        whole = self.summary(1, *SCENE, "--frames", frames + 2, "--no-output")
        self.assertEqual(rest["state_hash"], whole["state_hash"])

    def test_usr1_to_mpirun_saves_the_run_once_which_goes_on(self):
        process = self.start(2, *LONG, "--output", "run.h5")
        wait_until(lambda: self.exists("run.h5"), "skeleton of the file")
        seen = []
        for _ in range(2):
            before = os.stat(self.path("run.checkpoint.h5")).st_mtime_ns if seen else 0
            process.send_signal(signal.SIGUSR1)
            wait_until(lambda b=before: self.exists("run.checkpoint.h5")
                       and os.stat(self.path("run.checkpoint.h5")).st_mtime_ns > b, "checkpoint")
            seen.append(self.frames_in("run.checkpoint.h5"))
        self.assertLess(seen[0], seen[1], "the run has gone on in between")
        process.send_signal(signal.SIGUSR2)
        process.wait(timeout=TIMEOUT_S)
        self.assertEqual(process.returncode, 75, process.stderr.read())
        self.assertEqual(len(self.events("run.h5", "checkpoint")), 3, "two that were asked for, one as it stopped")
        self.assertEqual(len(self.events("run.h5", "signal")), 1)
        with h5py.File(self.path("run.h5")) as file:
            self.assertEqual(int(file.attrs["frames_committed"]), self.frames_in("run.checkpoint.h5"))

    def test_usr2_stops_with_a_checkpoint_from_which_the_run_goes_on(self):
        process = self.start(2, *LONG, "--output", "run.h5")
        wait_until(lambda: self.exists("run.h5"), "skeleton of the file")
        process.send_signal(signal.SIGUSR2)
        process.wait(timeout=TIMEOUT_S)
        self.assertEqual(process.returncode, 75, process.stderr.read())
        self.check_hash("run.checkpoint.h5")

    def test_max_time_stops_with_75_and_a_checkpoint(self):
        result = self.pbmpi(2, *LONG, "--output", "run.h5", "--max-time", 1)
        self.assertEqual(result.returncode, 75, result.stderr)
        self.assertEqual(len(self.events("run.h5", "time_limit")), 1)
        self.assertIn("\ncheckpoint: run.checkpoint.h5 (after ", result.stdout)
        self.check_hash("run.checkpoint.h5")

    def test_without_an_output_the_checkpoint_has_the_scene_s_name(self):
        result = self.pbmpi(1, *LONG, "--no-output", "--max-time", 0.2)
        self.assertEqual(result.returncode, 75, result.stderr)
        self.assertEqual(os.listdir(self.folder), ["100CrSk.checkpoint.h5"])

    def test_a_run_that_comes_to_its_end_is_saved_only_if_that_was_asked_for(self):
        self.summary(1, "--scene", "CrashSk", "--frames", 2, "--no-output")
        self.assertEqual(os.listdir(self.folder), [])
        summary = self.summary(1, "--scene", "CrashSk", "--frames", 2, "--no-output", "--checkpoint", "end.h5")
        self.assertEqual(os.listdir(self.folder), ["end.h5"])
        self.assertEqual(summary["checkpoint"], "end.h5 (after 5 frames)")

    def test_kill_9_at_random_moments_leaves_a_whole_checkpoint(self):
        random_source = random.Random(722)
        for _ in range(NUM_KILLS):
            process = self.start(2, *LONG, "--output", "run.h5", "--checkpoint", "run.ck.h5", "--checkpoint-every", 1e-6)
            wait_until(lambda: len(rank_pids(process)) == 2, "ranks")
            wait_until(lambda: self.exists("run.ck.h5") or process.poll() is not None, "checkpoint")
            time.sleep(random_source.uniform(0, 0.3))
            os.kill(rank_pids(process)[0], signal.SIGKILL)  # the one that writes
            process.wait(timeout=TIMEOUT_S)
            self.assertNotEqual(process.returncode, 0)
            with h5py.File(self.path("run.h5")) as file:
                self.assertGreaterEqual(int(file.attrs["frames_committed"]), self.frames_in("run.ck.h5"),
                                        "no frame is missing between the file and the one that follows the checkpoint")
            os.remove(self.path("run.h5"))
            os.rename(self.path("run.ck.h5"), self.path("last.ck.h5"))
        self.check_hash("last.ck.h5")

    def test_a_full_disk_is_warned_of_and_neither_the_run_nor_the_last_checkpoint_is_lost(self):
        disk = self.small_disk("1m")
        with open(self.path("errors"), "w", encoding="utf-8") as errors:
            process = subprocess.Popen(["mpirun", "-n", "2", os.path.join(os.environ["PBMPI_BIN"], "pbmpi"), *map(str, LONG),
                                        "--output", "run.h5", "--checkpoint", "disk/ck.h5", "--checkpoint-every", "0.2",
                                        "--quiet"], cwd=self.folder, stderr=errors, start_new_session=True)
        self.addCleanup(end_group, process)
        wait_until(lambda: self.exists("disk/ck.h5"), "checkpoint")
        # A file that is being replaced gives its place to the next one: the disk is filled until it is full.
        wait_until(lambda: self.fill(disk) or "the run goes on" in self.text("errors"), "warning")
        whole = self.frames_in("disk/ck.h5")
        self.assertIn("warning: no checkpoint in frame ", self.text("errors"))
        self.assertIn("cannot write disk/ck.h5: No space left on device", self.text("errors"))
        process.send_signal(signal.SIGUSR2)
        process.wait(timeout=TIMEOUT_S)
        self.assertEqual(process.returncode, 1, "it was to be saved as it stopped, and is not")
        self.assertIn("the run ended without a checkpoint: cannot write disk/ck.h5", self.text("errors"))
        self.assertEqual(self.frames_in("disk/ck.h5"), whole, "the last one that could be written")
        with h5py.File(self.path("run.h5")) as file:
            self.assertGreater(int(file.attrs["frames_committed"]), whole)
            self.assertEqual(len(file.attrs["state_hash"].strip()), 16, "the file of the run is closed in good order")
        self.assertTrue(any(detail.startswith("failed: ") for detail in self.events("run.h5", "checkpoint")))

    def fill(self, disk):
        with open(os.path.join(disk, "ballast"), "ab", buffering=0) as file:
            try:
                while True:
                    file.write(bytes(4096))
            except OSError:
                pass

    def text(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()


if __name__ == "__main__":
    unittest.main()
