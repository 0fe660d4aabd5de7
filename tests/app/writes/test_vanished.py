"""Somebody removes, moves or cuts what a program is writing: it notices by itself, soon, and never ends as if all were well."""
import os
import shutil
import signal
import subprocess
import sys
import unittest

import h5py

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import BIN, TIMEOUT_S, ProgramTest, end_group, rank_pids, wait_until  # noqa: E402

ENDLESS = ["--scene", "CrashSk", "--replicas", "4", "--frames", "1000000", "--record-every", "1000", "--quiet"]
STUDY = [os.path.join(BIN, "pbstudy"), "stability", "--scene", "hard/free/cradle", "hard/free/exchange", "hard/rest/column10", "--setting", "sor", "quick",
         "--dt", "0.004", "0.002", "0.001", "0.0005", "--quiet"]


class Vanished(ProgramTest):
    def setUp(self):
        super().setUp()
        os.mkdir(self.path("out"))

    def committed(self, name):
        with h5py.File(self.path(name)) as file:
            return int(file.attrs["frames_committed"])

    def endless_run(self, *args):
        process = self.start(2, *ENDLESS, *args)
        wait_until(lambda: os.path.exists(self.path("out/run.h5")) and self.committed("out/run.h5") > 0, "the first frames")
        return process

    def end_run(self, process):
        for pid in rank_pids(process).values():
            os.kill(pid, signal.SIGTERM)
        return process.communicate(timeout=TIMEOUT_S)[1]

    def start_study(self):
        process = subprocess.Popen(["mpirun", "-n", "2", *STUDY, "--output", "out/study.h5"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True, start_new_session=True)
        self.addCleanup(end_group, process)
        wait_until(lambda: self.journals(), "a case that is done")
        return process

    def journals(self):
        """Those with a case; the head of a journal has 16 bytes."""
        names = [name for name in os.listdir(self.path("out")) if ".cases-" in name]
        return [name for name in names if os.path.getsize(self.path(f"out/{name}")) > 16]

    def test_a_run_whose_file_is_gone_ends_by_itself(self):
        for what in ("removed", "moved", "replaced", "its folder removed"):
            with self.subTest(what=what):
                process = self.endless_run("--output", "out/run.h5")
                if what == "moved":
                    os.rename(self.path("out/run.h5"), self.path("moved.h5"))
                elif what == "its folder removed":
                    shutil.rmtree(self.path("out"))
                else:
                    os.remove(self.path("out/run.h5"))
                    if what == "replaced":
                        self.write("out/run.h5", "mine")
                errors = process.communicate(timeout=TIMEOUT_S)[1]
                self.assertEqual(process.returncode, 1, errors)
                self.assertIn("out/run.h5 was removed or replaced by somebody", errors)
                if what == "moved":
                    with h5py.File(self.path("moved.h5")) as file:
                        self.assertEqual(len(file["timings/frame/wall"]), file.attrs["frames_committed"], "it is closed in good order")
                if what == "replaced":
                    with open(self.path("out/run.h5"), encoding="utf-8") as file:
                        self.assertEqual(file.read(), "mine")
                    os.remove(self.path("out/run.h5"))

    def test_a_run_whose_file_is_cut_short_ends_by_itself(self):
        for length in (0, 5000):
            with self.subTest(length=length):
                process = self.endless_run("--output", "out/run.h5")
                os.truncate(self.path("out/run.h5"), length)
                errors = process.communicate(timeout=TIMEOUT_S)[1]
                self.assertEqual(process.returncode, 1, errors)
                self.assertIn("cannot write out/run.h5: somebody has cut the file short", errors)
                os.remove(self.path("out/run.h5"))

    def test_a_checkpoint_that_is_gone_is_written_anew_with_a_warning(self):
        process = self.endless_run("--output", "out/run.h5", "--checkpoint", "out/ck.h5", "--checkpoint-every", "0.2")
        for _ in range(2):
            wait_until(lambda: os.path.exists(self.path("out/ck.h5")), "a checkpoint")
            os.remove(self.path("out/ck.h5"))
        errors = self.end_run(process)
        self.assertEqual(process.returncode, 75, errors)
        self.assertIn("warning: the checkpoint out/ck.h5 was removed or replaced by somebody", errors)
        self.assertTrue(h5py.is_hdf5(self.path("out/ck.h5")))

    def test_a_run_that_cannot_save_its_end_fails(self):
        os.mkdir(self.path("saved"))
        process = self.endless_run("--output", "out/run.h5", "--checkpoint", "saved/ck.h5")
        shutil.rmtree(self.path("saved"))
        errors = self.end_run(process)
        self.assertEqual(process.returncode, 1, errors)
        self.assertIn("ended without a checkpoint: cannot write saved/ck.h5: No such file or directory", errors)

    def test_a_study_goes_on_without_a_journal_and_begins_it_anew(self):
        process = self.start_study()
        for name in self.journals():
            os.remove(self.path(f"out/{name}"))
        errors = process.communicate(timeout=TIMEOUT_S)[1]
        self.assertEqual(process.returncode, 0, errors)
        self.assertIn("was removed by somebody", errors)
        self.assertEqual(os.listdir(self.path("out")), ["study.h5"])

    def test_a_study_whose_folder_is_gone_ends_at_its_next_case(self):
        process = self.start_study()
        shutil.rmtree(self.path("out"))
        errors = process.communicate(timeout=TIMEOUT_S)[1]
        self.assertEqual(process.returncode, 1, errors)
        self.assertIn("cannot be written: No such file or directory", errors)


if __name__ == "__main__":
    unittest.main()
