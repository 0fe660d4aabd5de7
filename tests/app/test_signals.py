"""What a dead run leaves behind stops no later one, and a run hears signals at each moment of its life."""
import contextlib
import ctypes
import os
import signal
import subprocess
import time
import unittest

from harness import AT_ONCE, PBMPI, TIMEOUT_S, ProgramTest, rank_pids, wait_until

SMALL = ["--scene", "CrashSk", "--frames", "3", "--quiet"]
ENDLESS_FRAME = ["--scene", "CrashSk", "--iterations", "2000000000", "--quiet"]


def hold_semaphore(test, name):
    """A named semaphore as a killed run leaves it: nobody will ever post it."""
    libc = ctypes.CDLL(None, use_errno=True)
    libc.sem_open.restype = ctypes.c_void_p
    if not libc.sem_open(name.encode(), os.O_CREAT, 0o600, 0):
        raise OSError(ctypes.get_errno(), name)
    test.addCleanup(libc.sem_unlink, name.encode())


def shared_pointers():
    return [name for name in os.listdir("/dev/shm") if name.startswith("sem.OMPIO_")]


def records():
    """The process of each record of segments in shared memory, and the names in it."""
    found = {}
    for name in os.listdir("/dev/shm"):
        if name.startswith("pbmpi-segments-"):
            with contextlib.suppress(FileNotFoundError), open(f"/dev/shm/{name}", encoding="utf-8") as file:
                found[int(name.rsplit("-", 1)[1])] = file.read().split()
    return found


def memory_bytes(pid):
    try:
        with open(f"/proc/{pid}/statm", encoding="utf-8") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE")
    except (FileNotFoundError, ProcessLookupError):
        return 0  # it is not there yet


class Signals(ProgramTest):
    def start_alone(self, *args):
        """A run on one rank, without mpirun, which would end its ranks by itself."""
        process = subprocess.Popen([PBMPI, *args], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                   text=True, start_new_session=True)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def test_a_semaphore_that_a_killed_run_left_stops_no_later_run_of_that_name(self):
        for name in ("run.h5", "run.h5.part"):
            hold_semaphore(self, f"/OMPIO_{name}")
        for ranks in (1, 2):
            result = self.pbmpi(ranks, *SMALL, "--output", "run.h5")
            self.assertEqual(result.returncode, 0, result.stderr)

    def test_a_run_makes_no_shared_pointer_of_its_file(self):
        before = shared_pointers()
        process = self.start(2, "--scene", "CrashSk", "--frames", "1000000", "--record-every", "1000", "--quiet",
                             "--output", "lone.h5", env={**os.environ, "OMPI_MCA_sharedfp": "lockedfile"})
        wait_until(lambda: os.path.exists(self.path("lone.h5")), "the file's skeleton")
        self.assertEqual([name for name in shared_pointers() if name not in before and "lone" in name], [])
        for pid in rank_pids(process).values():
            os.kill(pid, signal.SIGTERM)
        self.assertEqual(process.wait(timeout=TIMEOUT_S), 75)

    def test_segments_of_a_killed_run_are_removed_by_the_next_and_those_of_a_living_one_are_not(self):
        living, killed = (self.start(2, "--scene", "CrashSk", "--frames", "1000000", "--record-every", "1000", "--quiet", "--output", name)
                          for name in ("living.h5", "killed.h5"))
        for name in ("living.h5", "killed.h5"):
            wait_until(lambda name=name: os.path.exists(self.path(name)), "the file's skeleton")
        own = {process: {pid: records().get(pid, []) for pid in rank_pids(process).values()} for process in (living, killed)}
        if not all(own[killed].values()):
            self.skipTest("MPI keeps no segments in /dev/shm")
        os.killpg(killed.pid, signal.SIGKILL)
        for pid in own[killed]:
            os.kill(pid, signal.SIGKILL)
        killed.wait(timeout=TIMEOUT_S)
        self.assertTrue(any(os.path.exists(f"/dev/shm/{name}") for names in own[killed].values() for name in names))
        wait_until(lambda: not any(os.path.exists(f"/proc/{pid}") for pid in own[killed]), "the killed ranks' end")
        self.assertEqual(self.pbmpi(2, *SMALL, "--no-output").returncode, 0)
        for pid, names in own[killed].items():
            self.assertNotIn(pid, records())
            self.assertEqual([name for name in names if os.path.exists(f"/dev/shm/{name}")], [])
        for pid, names in own[living].items():
            self.assertEqual(records()[pid], names)
            self.assertTrue(all(os.path.exists(f"/dev/shm/{name}") for name in names))
        for pid in own[living]:
            os.kill(pid, signal.SIGTERM)
        self.assertEqual(living.wait(timeout=TIMEOUT_S), 75)
        self.assertFalse(set(own[living]) & set(records()), "who ends in good order leaves no record")

    def test_a_signal_while_worlds_are_built_ends_the_run_at_once(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            process = self.start_alone("--scene", "CrashSk", "--replicas", "400000", "--frames", "1", "--quiet",
                                       "--output", "large.h5")
            time.sleep(1)
            process.send_signal(number)
            self.assertEqual(process.wait(timeout=TIMEOUT_S), -number)
            self.assertEqual(os.listdir(self.folder), [])

    def test_one_signal_ends_a_frame_that_does_not_end(self):
        process = self.start_alone(*ENDLESS_FRAME, "--output", "run.h5")
        wait_until(lambda: os.path.exists(self.path("run.h5")), "the file's skeleton")
        time.sleep(0.5)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=TIMEOUT_S), -signal.SIGTERM)
        self.assertIn("frame to end", process.stderr.read())

    def test_a_second_signal_ends_the_run_at_once(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            process = self.start_alone(*[word for word in ENDLESS_FRAME if word != "--quiet"], "--output", "run.h5")
            wait_until(lambda: os.path.exists(self.path("run.h5")), "the file's skeleton")
            time.sleep(0.5)
            process.send_signal(number)
            self.assertIn("a second INT or TERM ends it at once", process.stderr.readline())
            time.sleep(0.2)
            process.send_signal(number)
            self.assertEqual(process.wait(timeout=TIMEOUT_S), -number)
            self.assertNotIn("waited", process.stderr.read())
            os.remove(self.path("run.h5"))

    def test_ranks_that_wait_for_a_stopped_one_say_what_for_and_end(self):
        process = self.start(2, "--scene", "CrashSk", "--replicas", "100000", "--frames", "1", "--no-output", "--quiet",
                             env={**os.environ, **AT_ONCE, "PBMPI_WAIT_LIMIT": "4"})
        wait_until(lambda: memory_bytes(rank_pids(process).get(1)) > 2e8, "rank 1 to build worlds")
        os.kill(rank_pids(process)[1], signal.SIGSTOP)
        self.assertEqual(process.wait(timeout=TIMEOUT_S), 1)
        said = process.stderr.read()
        self.assertRegex(said, r"pbmpi: rank 0 has waited \d+ s for all ranks to (read|build|start|create)")
        self.assertRegex(said, r"pbmpi: rank 0 waited \d+ s for .* and ends here")


if __name__ == "__main__":
    unittest.main()
