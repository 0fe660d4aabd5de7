"""A file system that goes on refusing writes, from any of them on, on all ranks or on one alone: no signal, no hang, exit code 1 with one message,
and what was committed stays readable."""
import os
import sys
import unittest

import h5py
import numpy

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import AT_ONCE, BIN, PBMPI, PBREPORT, ProgramTest, alone  # noqa: E402

REFUSE = os.environ["PBMPI_REFUSE_WRITES"]
ALL = "PBMPI_ALL_WRITES" in os.environ
PBSTUDY = os.path.join(BIN, "pbstudy")
FRAMES = 6
RUN = [PBMPI, "--scene", "CrashSk", "--replicas", "2", "--warmup", "0", "--quiet"]
ALL_FRAMES = ["--frames", str(FRAMES)]
HALF = ["--frames", str(FRAMES // 2)]
STUDY = [PBSTUDY, "stability", "--scene", "hard/free/cradle", "hard/free/exchange", "--setting", "sor", "quick", "--quiet"]


class RefusedWrites(ProgramTest):
    def setUp(self):
        super().setUp()
        os.mkdir(self.path("out"))

    def refuse(self, command, ranks, first, rank=None, under="out"):
        """Runs the command where the first-th and all later writes below `under` fail; 0: none does."""
        settings = {"LD_PRELOAD": REFUSE, "REFUSE_UNDER": self.path(under), "REFUSE_FROM": str(first),
                    "REFUSE_COUNTS": self.path("counts")}
        if rank is not None:
            settings["REFUSE_RANK"] = str(rank)
        if ranks == 0:  # without MPI
            return self.run_command(command, env={**alone(self.folder), **settings})
        exports = [word for name, value in settings.items() for word in ("-x", f"{name}={value}")]
        return self.run_command(["mpirun", "-n", str(ranks), *exports, *command], env={**os.environ, **AT_ONCE})

    def num_writes(self, command, ranks, under="out"):
        """The writes of the rank or process that has the most of them."""
        self.empty()
        with open(self.path("counts"), "w", encoding="utf-8"):
            pass
        result = self.refuse(command, ranks, 0, under=under)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.path("counts"), encoding="utf-8") as counts:
            return max(map(int, counts))

    def some_of(self, num_writes):
        """First writes that fail: all of them, or some that lie closer at the beginning and at the end."""
        if ALL:
            return range(1, num_writes + 1)
        steps = [2**power for power in range(num_writes.bit_length()) if 2**power <= num_writes]
        return sorted({*steps, *(num_writes + 1 - step for step in steps[:4])})

    def empty(self):
        for name in os.listdir(self.path("out")):
            os.remove(self.path(f"out/{name}"))

    def check_failure(self, result, program):
        """It ended by itself, with one message; 2 where nothing had been begun, for want of room."""
        said = [line for line in result.stderr.splitlines() if line.startswith(f"{program}: ") and "warning" not in line]
        self.assertIn(result.returncode, (1, 2), result.stderr)
        self.assertEqual(len(said), 1, result.stderr)
        if result.returncode == 2:
            self.assertIn("do not fit", said[0])
        self.assertNotIn("Signal", result.stderr)
        return said[0]

    def committed(self, name):
        """The number of committed frames, which are those of the whole run."""
        with h5py.File(self.path(f"out/{name}")) as file, h5py.File(self.path("whole.h5")) as whole:
            committed = int(file.attrs["frames_committed"])
            for column in ("particles/bodies/position/value", "observables/world/energy"):
                numpy.testing.assert_array_equal(file[column][:committed], whole[column][:committed])
            return committed

    def test_a_run_ends_with_a_message_and_keeps_what_it_has_committed(self):
        self.assertEqual(self.run_command(["mpirun", "-n", "2", *RUN, *ALL_FRAMES, "--output", "whole.h5"]).returncode, 0)
        command = [*RUN, *ALL_FRAMES, "--output", "out/run.h5"]
        num_writes = self.num_writes(command, 2)
        for rank in (None, 0, 1):
            for first in self.some_of(num_writes):
                with self.subTest(rank=rank, first=first):
                    self.empty()
                    result = self.refuse(command, 2, first, rank)
                    if result.returncode == 0:  # the rank has fewer writes, or only the sidecar, or the space behind the file, was lost
                        self.assertEqual(self.committed("run.h5"), FRAMES)
                        continue
                    self.check_failure(result, "pbmpi")
                    left = os.listdir(self.path("out"))
                    self.assertLessEqual(set(left), {"run.h5"}, "no unfinished file, no lock")
                    if left:
                        self.committed("run.h5")

    def test_one_process_alone_does_the_same(self):
        self.assertEqual(self.run_command([*RUN, *ALL_FRAMES, "--output", "whole.h5"]).returncode, 0)
        command = [*RUN, *ALL_FRAMES, "--output", "out/run.h5"]
        for first in self.some_of(self.num_writes(command, 0)):
            with self.subTest(first=first):
                self.empty()
                result = self.refuse(command, 0, first)
                if result.returncode != 0:
                    self.check_failure(result, "pbmpi")
                if os.listdir(self.path("out")):
                    self.committed("run.h5")

    def test_a_checkpoint_that_cannot_be_written_is_a_failure_where_it_ends_the_run(self):
        command = [*RUN, *ALL_FRAMES, "--output", "run.h5", "--checkpoint", "out/ck.h5"]
        self.assertEqual(self.run_command([*RUN, *HALF, "--no-output", "--checkpoint", "old.h5"]).returncode, 0)
        for first in range(1, self.num_writes(command, 2) + 1):
            with self.subTest(first=first):
                self.empty()
                os.link(self.path("old.h5"), self.path("out/ck.h5"))
                result = self.refuse(command, 2, first)
                self.assertEqual(os.listdir(self.path("out")), ["ck.h5"])
                if result.returncode == 0:  # it has its name; that the folder cannot be flushed costs nothing
                    self.assertFalse(os.path.samefile(self.path("old.h5"), self.path("out/ck.h5")))
                    continue
                self.assertIn("ck.h5", self.check_failure(result, "pbmpi"))
                again = self.pbmpi(1, "--resume", "out/ck.h5", *ALL_FRAMES, "--no-output", "--quiet")
                self.assertEqual(again.returncode, 0, "the older checkpoint is still there: " + again.stderr)

    def test_a_study_ends_with_a_message_and_goes_on_with_resume(self):
        command = [*STUDY, "--output", "out/study.h5"]
        num_writes = self.num_writes(command, 2)
        for rank in (None, 0, 1):
            for first in self.some_of(num_writes):
                with self.subTest(rank=rank, first=first):
                    self.empty()
                    result = self.refuse(command, 2, first, rank)
                    if result.returncode == 0:
                        self.assertEqual(os.listdir(self.path("out")), ["study.h5"])
                        continue
                    self.check_failure(result, "pbstudy")
                    self.assertNotIn("study.h5", os.listdir(self.path("out")))
        again = self.run_command(["mpirun", "-n", "2", *command, "--resume"])
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(os.listdir(self.path("out")), ["study.h5"])

    def test_reports_end_with_a_message_and_leave_the_older_file(self):
        for seed in (1, 2):
            self.assertEqual(self.run_command([*RUN, *ALL_FRAMES, "--seed", str(seed), "--output", f"seed{seed}.h5"]).returncode, 0)
        one, other = "seed1.h5", "seed2.h5"
        self.assertEqual(self.run_command([*RUN, *HALF, "--output", "begin.h5", "--checkpoint", "ck.h5"]).returncode, 0)
        self.assertEqual(self.pbmpi(1, "--resume", "ck.h5", *ALL_FRAMES, "--output", "end.h5", "--quiet").returncode, 0)
        for words in (["--quiet", one, "--html", "out/page"], ["--quiet", one, "--xdmf", "out/page"], ["csv", one, "--output", "out/page"],
                      ["diff", one, other, "--html", "out/page"], ["join", "begin.h5", "end.h5", "--output", "out/page"]):
            command = [PBREPORT, *words]
            for first in self.some_of(self.num_writes(command, 0)):
                with self.subTest(words=words, first=first):
                    self.empty()
                    result = self.refuse(command, 0, first)
                    if result.returncode == 0:  # as above
                        self.assertEqual(os.listdir(self.path("out")), ["page"])
                        continue
                    self.check_failure(result, "pbreport")
                    self.assertEqual(os.listdir(self.path("out")), [])


if __name__ == "__main__":
    unittest.main()
