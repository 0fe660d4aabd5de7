"""Batches over the ranks of an mpi4py communicator."""
import os
import sys
import unittest

from support import PackageTest

WORLDS, STEPS = 5, 12
RANK = """import sys
from mpi4py import MPI
import numpy as np
import pbmpi

world = MPI.COMM_WORLD
batch = pbmpi.Batch("CrashSk", {worlds}, communicator=world)
batch.step({steps})
positions = world.gather(batch.position.copy(), root=0)
ids = world.gather(batch.world_ids, root=0)
whole = batch.hash()  # all ranks have it
half = world.Split(world.rank % 2)
part = pbmpi.Batch("CrashSk", 2, communicator=half)  # each half has worlds of its own
part.step({steps})
hashes = set(world.allgather(whole)), set(world.allgather(part.hash()))
try:
    batch.__reduce__()
except TypeError as error:
    refused = "rank by rank" in str(error)
if world.rank == 0:
    np.save("positions.npy", np.concatenate(positions))
    print("ids", np.concatenate(ids).tolist(), "local", batch.num_local_worlds, "of", batch.num_worlds)
    print("hashes", *map(sorted, hashes), "refused", refused)
"""
# The batch is a global, which Python gives back only after mpi4py has ended MPI.


class Ranks(PackageTest):
    def test_any_number_of_ranks_has_the_worlds_of_one_process(self):
        import numpy as np
        import pbmpi

        alone, part = pbmpi.Batch("CrashSk", WORLDS), pbmpi.Batch("CrashSk", 2)
        for batch in (alone, part):
            batch.step(STEPS)
        script = self.write("rank.py", RANK.format(worlds=WORLDS, steps=STEPS))
        for ranks, local in ((1, 5), (2, 3)):
            result = self.run_command(["mpirun", "-n", str(ranks), sys.executable, script])
            self.assertEqual((result.returncode, result.stderr), (0, ""), result.stderr)
            ids, hashes = result.stdout.splitlines()
            self.assertEqual(ids, f"ids [0, 1, 2, 3, 4] local {local} of 5")
            self.assertEqual(hashes, f"hashes {[alone.hash()]} {[part.hash()]} refused True")
            self.assertTrue(np.array_equal(np.load(self.path("positions.npy")), alone.position))

    def test_more_ranks_than_worlds(self):
        script = self.write("rank.py", """from mpi4py import MPI
import pbmpi
batch = pbmpi.Batch("CrashSk", 1, communicator=MPI.COMM_WORLD)
batch.step(3)
shapes = MPI.COMM_WORLD.gather((batch.position.shape, batch.steps.shape, batch.observable("energy").shape))
batch.reset()
if MPI.COMM_WORLD.rank == 0:
    print(shapes)
""")
        result = self.run_command(["mpirun", "-n", "2", sys.executable, script])
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout, "[((1, 37, 3), (1,), (1,)), ((0, 37, 3), (0,), (0,))]\n")

    def test_a_null_communicator_is_refused(self):
        script = self.write("rank.py", """from mpi4py import MPI
import pbmpi
try:
    pbmpi.Batch("CrashSk", 1, communicator=MPI.COMM_NULL)
except ValueError as error:
    print(error)
""")
        self.assertIn("COMM_NULL", self.run_command(["mpirun", "-n", "1", sys.executable, script]).stdout)

    def test_without_mpi4py_only_a_communicator_is_refused(self):
        os.mkdir(self.path("mpi4py"))
        self.write("mpi4py/__init__.py", "raise ImportError('none here')\n")
        script = self.write("alone.py", """import pbmpi
batch = pbmpi.Batch("CrashSk", 2)
batch.step(3)
try:
    pbmpi.Batch("CrashSk", 2, communicator=0)
except ImportError as error:
    print(error)
""")
        path = self.folder + os.pathsep + os.environ["PYTHONPATH"]
        result = self.run_command([sys.executable, script], env={**os.environ, "PYTHONPATH": path})
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("python3-mpi4py", result.stdout)


if __name__ == "__main__":
    unittest.main()
