"""A file that cannot grow: the ranks end with the same error, and what was committed is right.
usage: full_disk_test.py MPIEXEC RUN_WRITER"""
import os
import sys
import tempfile

import sample_check

FRAMES = 12


def starve(mpiexec, writer, folder, ranks, limit_bytes):
    """From frame 3 on, no byte beyond limit_bytes can be written; every frame is flushed."""
    path = os.path.join(folder, "run.h5")
    result = sample_check.run_writer(mpiexec, ranks, writer, path, FRAMES, FRAMES, move=2, limit_bytes=limit_bytes)
    assert result.returncode == 1, (result.returncode, result.stderr)
    errors = [line for line in result.stderr.splitlines() if "run error" in line]
    assert errors and all("cannot write" in e and "File too large" in e for e in errors), result.stderr
    committed = sample_check.check(path)
    assert committed >= 3, f"{committed} frames although 3 were flushed before the limit"
    assert committed < FRAMES
    os.remove(path)


def main():
    mpiexec, writer = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as folder:
        # Below all data (the last position row, the tables at the end, the attributes at the start).
        for limit in (1000, 90000, 150000, 300000, 330000, 401000):
            for ranks in (1, 3):
                starve(mpiexec, writer, folder, ranks, limit)


main()
