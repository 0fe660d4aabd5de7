"""Many worlds of one scene, stepped together; files of pbmpi as arrays and tables; settings compared.

    import pbmpi
    batch = pbmpi.Batch("CrashSk", worlds=100)
    batch.step(300)
    batch.position   # [worlds][bodies][3] m

Batch steps worlds, read() opens what the programs wrote, sweep() measures what settings cost and how wrong they are. SI
units; world frame, z up; a quaternion is (w, x, y, z). A tutorial is docs/python.md. read() needs h5py and pandas, sweep()
pandas, a communicator mpi4py.
"""

from ._batch import Batch
from ._pbmpi import Motor, version
from ._read import read
from ._run import Run
from ._sweep import sweep

__version__ = version()
__all__ = ["Batch", "Motor", "Run", "read", "sweep", "version"]
