"""Kills a writer with SIGKILL at random moments: its file opens each time, with every committed frame right.
usage: kill_test.py MPIEXEC RUN_WRITER"""
import os
import random
import signal
import subprocess
import sys
import tempfile
import time

import sample_check

NUM_KILLS = 24
PLANNED = 4000


def ranks_of(launcher):
    """Process ids of the launcher's children."""
    with open(f"/proc/{launcher.pid}/task/{launcher.pid}/children") as children:
        return [int(pid) for pid in children.read().split()]


def kill_one(mpiexec, writer, folder, attempt, rng, within_s):
    path = os.path.join(folder, f"run{attempt}.h5")
    # Every third run ends early by itself, so that some kills hit the closing of the file.
    frames = 12 if attempt % 3 == 2 else PLANNED
    command = sample_check.writer_command(mpiexec, 2, writer, path, PLANNED, frames, record_every=1 + attempt % 2,
                                          flush_s=0.004, move=5, pause_us=300)
    with open(os.path.join(folder, "log"), "w+") as log:
        # Every fourth time the other rank has a second more.
        environment = os.environ if attempt % 4 == 0 else {**os.environ, **sample_check.AT_ONCE}
        launcher = subprocess.Popen(command, stdout=log, stderr=subprocess.DEVNULL, env=environment)
        while not os.path.exists(path) and launcher.poll() is None:
            time.sleep(0.001)
        pids = ranks_of(launcher)
        time.sleep(rng.uniform(0, within_s) if attempt > 0 else 0)  # the first: before any frame
        for pid in rng.sample(pids, rng.choice([1, len(pids)]) if pids else 0):
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        launcher.wait(timeout=60)
    assert os.path.exists(path), f"no file in run {attempt}"
    committed = sample_check.check(path)
    os.remove(path)
    if os.path.exists(path + ".xdmf"):
        os.remove(path + ".xdmf")
    for name in (f".run{attempt}.h5.lock", f".run{attempt}.h5.xdmf.lock"):
        if os.path.exists(os.path.join(folder, name)):  # a killed run's, held by nobody
            os.remove(os.path.join(folder, name))
    for name in os.listdir(folder):  # a sidecar that the kill cut short; the next run of this name removes it
        if name.startswith(f"run{attempt}.h5.xdmf.") and name.endswith(".part"):
            os.remove(os.path.join(folder, name))
    sample_check.only_file_in(folder, ["log"])
    return committed


def main():
    mpiexec, writer = sys.argv[1:3]
    seed = int.from_bytes(os.urandom(4), "little")
    print("seed", seed)
    rng = random.Random(seed)
    committed = []
    within_s = 0.35  # grows where kills come before any frame, and shrinks where they come late, whatever the machine's pace
    with tempfile.TemporaryDirectory() as folder:
        for attempt in range(NUM_KILLS):
            committed.append(kill_one(mpiexec, writer, folder, attempt, rng, within_s))
            if attempt > 0:
                within_s = min(within_s * 1.5, 20) if committed[-1] == 0 else max(within_s / 1.5, 0.1)
    print("frames committed:", committed)
    assert max(committed) > 0, "no kill came after the first flush: the test shows nothing"
    assert min(committed) < PLANNED, "no kill came before the end: the test shows nothing"


main()
