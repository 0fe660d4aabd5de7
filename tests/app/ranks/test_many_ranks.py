"""More ranks than cores, which take turns on them: the bits, the file and the memory of one rank's run.

Usage: test_many_ranks.py [TEST...], e.g. ManyRanks.test_40_ranks...
"""
import glob
import json
import os
import re
import sys
import unittest

import h5py

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import harness  # noqa: E402
from harness import ProgramTest, mpirun  # noqa: E402

harness.TIMEOUT_S = 1200  # 64 ranks on two cores
MIB = 2**20
# Of a rank, nearly all of it Open MPI's and shared with the other ranks of its host: 40 to 110 MiB were seen, most where all are on one host.
MOST_MEMORY = 400 * MIB
# Open MPI's own count of what ranks send.
PHASES = 10  # core::num_phases
COUNTED = {"OMPI_MCA_pml_monitoring_enable": "2", "OMPI_MCA_pml_monitoring_enable_output": "3"}


class ManyRanks(ProgramTest):
    def check_run(self, ranks, worlds, frames):
        """Worlds over ranks to the hash of one rank, in bounded memory, with a file that another library reads."""
        args = ("--scene", "CrashSk", "--replicas", worlds, "--frames", frames - 1, "--warmup", 1)
        alone = self.summary(1, *args, "--no-output")["state_hash"]
        many = self.summary(ranks, *args, "--output", "many.h5")
        self.assertEqual(many["state_hash"], alone)
        memory = many["memory"]
        print(f"{ranks} ranks: memory of a rank {memory['min_bytes'] / MIB:.1f} to {memory['max_bytes'] / MIB:.1f} MiB")
        self.assertLess(memory["max_bytes"], MOST_MEMORY)
        self.assertLessEqual(memory["min_bytes"], memory["max_bytes"])
        with h5py.File(self.path("many.h5")) as file:
            self.assertEqual(file.attrs["frames_committed"], frames)
            self.assertIn(file.attrs["state_hash"], (alone, alone.encode()))
            self.assertEqual(file["particles/bodies/position/value"].shape, (frames, many["bodies"], 3))
            self.assertEqual(file["ranks/worlds_at_start"][:].sum(), worlds)
            self.assertEqual(file["timings/rank/bytes"][:].sum() / frames, many["traffic"]["bytes_per_frame"])

    def messages_of(self, ranks, frames):
        """Messages and bytes of a run with a world a rank, by Open MPI's count: (between two ranks, of collectives)."""
        folder = self.path(f"counted-{ranks}-{frames}")
        os.mkdir(folder)
        environment = {**os.environ, **harness.AT_ONCE, **COUNTED, "OMPI_MCA_pml_monitoring_filename": f"{folder}/rank"}
        done = self.run_command(mpirun(ranks, "--scene", "CrashSk", "--replicas", ranks, "--frames", frames, "--warmup", 1, "--no-output",
                                       "--report", "json"), env=environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        sums = {"E": [0, 0], "I": [0, 0]}
        for name in glob.glob(f"{folder}/rank*"):
            with open(name, encoding="utf-8") as file:
                for line in file:
                    sent = re.match(r"([EI])\t\d+\t\d+\t(\d+) bytes\t(\d+) msgs", line)
                    if sent:
                        sums[sent[1]][0] += int(sent[3])
                        sums[sent[1]][1] += int(sent[2])
        return sums, json.loads(done.stdout)

    def check_messages(self, ranks):
        """What ten more frames send, as Open MPI counts it, is what the summary says of a frame and what the forecast says of collectives."""
        few, _ = self.messages_of(ranks, 1)
        many, summary = self.messages_of(ranks, 11)
        sent, collective = ([(many[kind][i] - few[kind][i]) / 10 for i in (0, 1)] for kind in "EI")
        # A rank with 31 below it hands on theirs, too. At the end of a run come a rank's times in each frame, 8 bytes a phase.
        handed_on = sum(min(32, ranks - rank) if rank % 32 == 0 else 1 for rank in range(1, ranks))
        at_end = 8 * PHASES * handed_on
        self.assertEqual(sent, [summary["traffic"]["messages_per_frame"], summary["traffic"]["bytes_per_frame"] + at_end])
        power = 2**(ranks.bit_length() - 1)  # recursive doubling of 6 numbers, and a tree of 32 bytes
        reductions = power * (power.bit_length() - 1) + 2 * (ranks - power)
        # Their bytes grow with the frames at the end of a run, too, where observables are joined.
        self.assertEqual(collective[0], reductions + ranks - 1)
        share = 8 * (1 + 7 * summary["bodies"] // ranks)  # a world of each rank
        self.assertEqual(sent, [ranks - 1, (share + 8 * PHASES) * handed_on])

    def test_40_ranks_have_the_hash_of_one_and_a_file_that_opens(self):
        self.check_run(40, 50, 2)

    def test_2_ranks_send_what_open_mpi_counts(self):
        self.check_messages(2)

    def test_64_ranks_have_the_hash_of_one_and_a_file_that_opens(self):
        self.check_run(64, 64, 3)

    def test_64_ranks_send_what_open_mpi_counts(self):
        self.check_messages(64)


if __name__ == "__main__":
    unittest.main()
