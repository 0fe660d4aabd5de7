"""Kills runs at random moments, each followed at once by a run of the same name, and starts pairs of runs that want the same
output. None may hang, every file opens, every committed row is that of the undisturbed run, and what a killed run has saved leads
to its state.
usage: kills.py BIN [KILLS PAIRS]   (12 and 4; the full form is 200 and 50)"""
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import h5py
import numpy

LIMIT_S = 90  # against a hang; a run takes a few seconds
AT_ONCE = {**os.environ, "OMPI_MCA_odls_base_sigkill_timeout": "0"}
WORLDS = ["--scene", "CrashSk", "--replicas", "6", "--frames", "2500"]
SPACES = ["--scene", "Fight", "--decompose", "spaces", "--frames", "1600"]
KINDS = {
    "worlds": ("pbmpi", WORLDS),
    "spaces": ("pbmpi", SPACES),
    "checkpoints": ("pbmpi", [*WORLDS, "--checkpoint", "ck.h5", "--checkpoint-every", "0.1"]),
    "study": ("pbstudy", ["accuracy", "--scene", "CrashSk", "--frames", "5", "--iterations", "5", "--repeats", "1",
                          "--floor-seeds", "1", "--nature-steps", "6",
                          "--own-iterations", "0", "--rest-seconds", "0"]),
}
SAME = ("particles/bodies/position/value", "particles/bodies/orientation/value", "particles/bodies/velocity/value",
        "particles/bodies/angular_velocity/value", "observables/world/energy", "observables/world/contacts")


class Kind:
    def __init__(self, name, binaries, root):
        self.name, self.folder = name, os.path.join(root, name)
        program, self.options = KINDS[name]
        self.program = os.path.join(binaries, program)
        os.mkdir(self.folder)
        started = time.monotonic()
        self.must_end(self.start(), "the undisturbed run")
        self.took_s = time.monotonic() - started
        self.rows = self.read() if program == "pbmpi" else None
        self.state_hash = self.hash_of("run.h5") if program == "pbmpi" else None
        self.resumed = 0

    def path(self, name):
        return os.path.join(self.folder, name)

    def start(self, *more, output="run.h5"):
        return self.launch("2", [*self.options, "--output", output, *more])

    def launch(self, ranks, options):
        return subprocess.Popen(["mpirun", "-n", ranks, self.program, *options, "--quiet"], cwd=self.folder,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env=AT_ONCE,
                                start_new_session=True)

    def end(self, process, what):
        """Exit code and errors; a hang fails here."""
        try:
            _, errors = process.communicate(timeout=LIMIT_S)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            raise AssertionError(f"{self.name}: {what} hangs")
        return process.returncode, errors

    def must_end(self, process, what):
        code, errors = self.end(process, what)
        assert code == 0, f"{self.name}: {what} ended with {code}: {errors}"

    def hash_of(self, name):
        with h5py.File(self.path(name)) as file:
            return file.attrs["state_hash"]

    def resume(self):
        """What a killed run has saved goes on to the undisturbed run's end."""
        options = ["--resume", "saved.h5", "--output", "resumed.h5"]
        code, errors = self.end(self.launch("3", options), "the resumed run")
        if code != 2 or "are done; give --frames" not in errors:  # killed after its last checkpoint, that of its end
            assert code == 0, f"{self.name}: the resumed run ended with {code}: {errors}"
            assert self.hash_of("resumed.h5") == self.state_hash, f"{self.name}: a resumed run has another hash"
            self.resumed += 1
        for name in ("saved.h5", "resumed.h5", "resumed.xdmf"):
            if os.path.exists(self.path(name)):
                os.remove(self.path(name))

    def read(self, name="run.h5"):
        """Committed frames and their rows."""
        with h5py.File(self.path(name)) as file:
            committed = int(file.attrs["frames_committed"])
            return committed, {path: file[path][:committed] for path in SAME}

    def check(self, name="run.h5"):
        """Every file opens, and holds the undisturbed run's rows; returns the committed frames."""
        if self.rows is None:
            if os.path.exists(self.path(name)):
                with h5py.File(self.path(name)) as file:
                    assert len(file["cases/scene"]) > 0
            return 0
        committed, rows = self.read(name)
        for path, values in rows.items():
            assert numpy.array_equal(values, self.rows[1][path][:committed]), f"{self.name}: {path} differs"
        if os.path.exists(self.path("ck.h5")):
            with h5py.File(self.path("ck.h5")) as file:
                assert numpy.isfinite(file["bodies/position"][:]).all()
        return committed


def ranks_of(launcher):
    with open(f"/proc/{launcher.pid}/task/{launcher.pid}/children", encoding="ascii") as children:
        return [int(pid) for pid in children.read().split()]


def kill(pid):
    try:
        os.kill(pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


def keep(path, name):
    """What is left at `path` under another name, whatever is put in its place. False if there is nothing."""
    while os.path.exists(path):
        try:
            os.link(path, name)
            return True
        except FileNotFoundError:  # ranks that live on have just replaced it
            continue
    return False


def kill_one(kind, rng):
    """One run that is killed, and at once another of the same name. Returns the committed frames of the first."""
    for old in ("run.h5", "ck.h5"):
        if os.path.exists(kind.path(old)):
            os.remove(kind.path(old))
    pids, longest_s = [], kind.took_s
    while not pids:  # a run that has ended cannot be killed
        process = kind.start()
        time.sleep(rng.uniform(0.1, 1.0) * longest_s)
        pids = ranks_of(process) if process.poll() is None else []
        if not pids:
            kind.must_end(process, "a run that nobody killed in time")
            longest_s *= 0.8
    victims = rng.choice([[process.pid], pids, pids[:1], pids[1:]])
    for pid in victims:
        kill(pid)
    if process.pid in victims and rng.random() < 0.5:
        process.wait()
    elif process.pid not in victims:
        process.wait(timeout=LIMIT_S)
    left, saved = kind.path("left.h5"), kind.path("saved.h5")
    is_left, is_saved = keep(kind.path("run.h5"), left), keep(kind.path("ck.h5"), saved)
    kind.must_end(kind.start(), "the run after a kill")
    kind.end(process, "the killed run")
    committed = 0
    if is_left:
        committed = kind.check("left.h5")
        os.remove(left)
    if is_saved:
        kind.resume()
    done = kind.check()
    assert kind.rows is None or done == kind.rows[0], f"{kind.name}: the run after a kill is not complete"
    beside = sorted(name for name in os.listdir(kind.folder) if name not in ("run.h5", "run.xdmf", "ck.h5"))
    assert beside == [], f"{kind.name}: {beside} are left behind"
    return committed


def pair(kind, rng):
    """Two runs that want one output: one is refused, with the other's host and process, and no row is lost."""
    codes = [0, 0]
    for _ in range(10):  # on a busy machine the first may have ended before the second is there: then all is well, too
        first = kind.start()
        time.sleep(rng.uniform(0, 0.3))
        second = kind.start()
        ended = [kind.end(process, "one of a pair") for process in (first, second)]
        codes = sorted(code for code, _ in ended)
        if codes != [0, 0]:
            break
        assert kind.rows is None or kind.check() == kind.rows[0], f"{kind.name}: rows are lost"
    assert codes == [0, 2], f"{kind.name}: a pair ended with {ended}"
    refusal = next(errors for code, errors in ended if code == 2)
    assert f"on host {os.uname().nodename} writes it" in refusal, refusal
    done = kind.check()
    assert kind.rows is None or done == kind.rows[0], f"{kind.name}: rows are lost"


def main():
    binaries = os.path.abspath(sys.argv[1])
    num_kills, num_pairs = map(int, sys.argv[2:4]) if len(sys.argv) > 3 else (12, 4)
    seed = int.from_bytes(os.urandom(4), "little")
    print("seed", seed, flush=True)
    rng = random.Random(seed)
    root = tempfile.mkdtemp(prefix="pbmpi-kills-")
    try:
        kinds = [Kind(name, binaries, root) for name in KINDS]
        print("undisturbed:", ", ".join(f"{kind.name} {kind.took_s:.1f} s" for kind in kinds), flush=True)
        committed = {kind.name: [] for kind in kinds}
        for attempt in range(num_kills):
            kind = kinds[attempt % len(kinds)]
            committed[kind.name].append(kill_one(kind, rng))
            if attempt % 20 == 19:
                print(attempt + 1, "kills", flush=True)
        for attempt in range(num_pairs):
            pair(kinds[attempt % len(kinds)], rng)
    finally:
        shutil.rmtree(root, ignore_errors=True)
    print(sum(kind.resumed for kind in kinds), "checkpoints of killed runs led to the undisturbed run's state")
    for name, frames in committed.items():
        print(f"{name}: {len(frames)} kills, committed frames of the killed runs {frames}")
    print(f"{num_kills} kills and {num_pairs} pairs: none hangs, all files open, no row differs or is lost")


main()
