"""A study that is stopped, or killed, goes on where it was, with any number of ranks."""
import os
import signal
import subprocess
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import BIN, ProgramTest, end_group, wait_until  # noqa: E402

PBSTUDY = os.path.join(BIN, "pbstudy")
STABILITY = ("stability", "--scene", "hard/free/cradle", "hard/free/exchange", "hard/rest/column10", "--setting", "sor", "quick")
ACCURACY = ("accuracy", "--scene", "CrashSk", "--replicas", "1", "--frames", "1", "--warmup", "1", "--repeats", "1",
            "--stepper", "quick", "--iterations", "1", "2", "5", "10", "--precision", "double", "--rest-seconds", "0")


class StudyResume(ProgramTest):
    def study(self, ranks, *args):
        return self.run_command(["mpirun", "-n", str(ranks), PBSTUDY, *map(str, args)])

    def journals(self, name):
        return [entry for entry in os.listdir(self.folder) if entry.startswith(name + ".cases-")]

    def tables(self, name):
        """All columns but those with a clock in them."""
        with h5py.File(self.path(name)) as file:
            return {f"{table}/{key}": column[()] for table, group in file.items() if table != "parameters"
                    for key, column in group.items() if "time" not in key}

    def check_equal(self, one, other):
        first, second = self.tables(one), self.tables(other)
        self.assertEqual(first.keys(), second.keys())
        self.assertGreater(len(first), 5)
        for key, column in first.items():
            np.testing.assert_array_equal(column, second[key], err_msg=key)

    def test_a_study_whose_time_is_up_exits_75_and_goes_on_with_other_ranks(self):
        whole = self.study(2, *STABILITY, "--output", "whole.h5")
        self.assertEqual(whole.returncode, 0, whole.stderr)
        stopped = self.study(2, *STABILITY, "--output", "parts.h5", "--max-time", "1e-3")
        self.assertEqual(stopped.returncode, 75, stopped.stderr)
        self.assertIn("--resume", stopped.stderr)
        self.assertFalse(os.path.exists(self.path("parts.h5")), "what is not complete has no file")
        self.assertTrue(self.journals("parts.h5"))
        done = self.study(3, *STABILITY, "--output", "parts.h5", "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.journals("parts.h5"), [])
        self.check_equal("whole.h5", "parts.h5")

    def test_what_a_killed_study_has_done_is_not_done_again(self):
        process = subprocess.Popen([PBSTUDY, *STABILITY, "--output", "killed.h5"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True, start_new_session=True)
        self.addCleanup(end_group, process)
        # The head of a journal has 16 bytes, a record more.
        wait_until(lambda: process.poll() is not None or any(
            os.path.getsize(self.path(name)) > 16 for name in self.journals("killed.h5")), "the first case")
        os.kill(process.pid, signal.SIGKILL)
        process.wait()
        self.assertTrue(self.journals("killed.h5"), "it was killed before its end")
        done = self.study(1, *STABILITY, "--output", "killed.h5", "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"[1-6] of 6 cases are done already")
        whole = self.study(1, *STABILITY, "--output", "whole.h5")
        self.assertEqual(whole.returncode, 0, whole.stderr)
        self.check_equal("whole.h5", "killed.h5")

    def test_a_signal_stops_it_after_the_cases_at_hand(self):
        process = subprocess.Popen(["mpirun", "-n", "2", PBSTUDY, *STABILITY, "--dt", "0.002", "0.001", "0.0005", "--output",
                                    "signal.h5"], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True)
        self.addCleanup(end_group, process)
        wait_until(lambda: process.poll() is not None or len(self.journals("signal.h5")) == 2, "both journals")
        process.send_signal(signal.SIGUSR2)
        _, errors = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 75, errors)

    def test_cases_of_other_options_are_refused_and_a_fresh_start_drops_them(self):
        stopped = self.study(1, *STABILITY, "--output", "s.h5", "--max-time", "1e-6")
        self.assertEqual(stopped.returncode, 75, stopped.stderr)
        other = self.study(1, *STABILITY, "--seed", "2", "--output", "s.h5", "--resume")
        self.assertEqual(other.returncode, 2)
        self.assertIn("another study", other.stderr)
        self.write("seed.cfg", "seed = 1\n")
        configured = (*STABILITY, "--config", "seed.cfg", "--output", "c.h5")
        self.assertEqual(self.study(1, *configured, "--max-time", "1e-6").returncode, 75)
        self.write("seed.cfg", "seed = 2\n")
        other = self.study(1, *configured, "--resume")
        self.assertEqual(other.returncode, 2)
        self.assertIn("another study", other.stderr)
        fresh = self.study(1, "stability", "--scene", "hard/free/cradle", "--setting", "quick", "--output", "s.h5")
        self.assertEqual(fresh.returncode, 0, fresh.stderr)
        self.assertEqual(self.journals("s.h5"), [])

    def test_a_study_without_further_tables(self):
        stopped = self.study(1, *ACCURACY, "--output", "accuracy.h5", "--max-time", "1e-3")
        self.assertEqual(stopped.returncode, 75, stopped.stderr)
        done = self.study(2, *ACCURACY, "--output", "accuracy.h5", "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        whole = self.study(1, *ACCURACY, "--output", "whole.h5")
        self.assertEqual(whole.returncode, 0, whole.stderr)
        self.check_equal("whole.h5", "accuracy.h5")


if __name__ == "__main__":
    unittest.main(verbosity=2)
