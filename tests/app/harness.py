"""Starts the built programs under a real mpirun. Shared by the end-to-end tests."""
import json
import os
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

BIN = os.environ["PBMPI_BIN"]
PBMPI = os.path.join(BIN, "pbmpi")
PBREPORT = os.path.join(BIN, "pbreport")
SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# The paper's figures, tables and statements, in Python; a command and files follow.
PAPER = [sys.executable, os.path.join(SOURCE, "jobs", "paper", "paper.py")]
# Job scripts start python3: the one that runs the tests.
PATH = os.pathsep.join((BIN, os.path.dirname(sys.executable), os.environ["PATH"]))
# Once a rank has failed mpirun gives the others a second to end by themselves. What ends in good order does not need it.
AT_ONCE = {"OMPI_MCA_odls_base_sigkill_timeout": "0"}
# The nine scenes of the paper.
SCENES = ("2-Cars", "10-Cars", "CrashSk", "CrashWa", "Environ", "100CrSk", "Battle", "Fight", "Battle2")
# Those that call for the effects that none of the nine calls for: scenes/effects.
EFFECT_SCENES = ("Bowling", "Feathers", "Stadium", "Warehouse")
# sor without a memory, in one substep: iterations alone decide how near a step comes to its solution.
ODE_LAW = ("--stepper", "sor", "--law", "ode")
# What a program says of the machine that it runs on, not of what it was given: hwloc's own lines, ranks that share processors, and a line
# now and then on a slow machine.
OF_THE_MACHINE = re.compile(r"(?:\[?hwloc/.*|pb\w+: warning: \d+ ranks .*take turns on .*|pb\w+: rank 0 waits for .* so far|"
                            r"pbmpi: frame \d.* ETA .*|pbstudy: .* cases done, .*)\n")
TIMEOUT_S = 300  # a hang, not a slow run: the longest takes seconds on a machine that has nothing else to do


def number_argument(name, default):
    """The number after `name` among the arguments of a test, which unittest then does not see; without it `default`."""
    if name not in sys.argv:
        return default
    place = sys.argv.index(name)
    number = int(sys.argv[place + 1])
    del sys.argv[place:place + 2]
    return number


def alone(folder):
    """The environment of a process that needs no way to others: MPI starts without a daemon, in a tenth of the time. `folder` is for
    its session: all such processes of a machine would use the same one, at the same time."""
    return {**os.environ, "OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_btl": "self", "OMPI_MCA_pml": "ob1",
            "OMPI_MCA_orte_tmpdir_base": folder}


def mpirun(ranks, *args):
    """The command line of `mpirun -n ranks pbmpi args...`."""
    return ["mpirun", "-n", str(ranks), PBMPI, *map(str, args)]


class ProgramTest(unittest.TestCase):
    """Each test runs in an empty folder of its own, which is the current one of what it starts."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="pbmpi-test-")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.session = tempfile.mkdtemp(prefix="pbmpi-session-")
        self.addCleanup(shutil.rmtree, self.session, ignore_errors=True)

    def path(self, name):
        return os.path.join(self.folder, name)

    def small_disk(self, size):
        """A folder on a disk of its own of that size, such as "4m". Skips the test where nothing can be mounted."""
        if os.geteuid() != 0:
            self.skipTest("mounting a small disk needs root")
        disk = self.path("disk")
        os.mkdir(disk)
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", disk], check=True)
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        return disk

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def run_command(self, command, **options):
        options.setdefault("env", {**os.environ, **AT_ONCE})
        result = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=TIMEOUT_S, check=False,
                                **options)
        result.stderr = OF_THE_MACHINE.sub("", result.stderr)
        return result

    def drawn(self, page):
        """The page's elements after its script has run in Chromium."""
        drawn = self.run_command(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic",
                                  "--no-first-run", "--disable-background-networking", "--disable-component-update",
                                  "--disable-sync", f"--user-data-dir={self.path('profile')}", "--dump-dom",
                                  f"file://{self.path(page)}"]).stdout
        self.assertIn('data-ready="yes"', drawn, "the last line of the page's script was reached")
        return drawn

    def pbmpi(self, ranks, *args, **options):
        """A run of so many ranks that is over. One rank is started without mpirun, in a third of the time."""
        if ranks == 1 and "env" not in options:
            return self.run_command([PBMPI, *map(str, args)], env=alone(self.session), **options)
        return self.run_command(mpirun(ranks, *args), **options)

    def summary(self, ranks, *args):
        """The JSON summary of a run that must succeed."""
        result = self.pbmpi(ranks, *args, "--report", "json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def report(self, *args):
        return self.run_command([PBREPORT, *map(str, args)])

    def json(self, result):
        return json.loads(result.stdout)

    def start(self, ranks, *args, **options):
        """A run in a session of its own, so that its whole process group can be signalled."""
        process = subprocess.Popen(mpirun(ranks, *args), cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True, start_new_session=True, **options)
        self.addCleanup(end_group, process)
        return process


def seal(path):
    """Appends the checksum of core/seal.h: for a file that a test has changed on purpose."""
    with open(path, "rb") as file:
        image = file.read()
    value = 0x9e3779b97f4a7c15
    padded = image + bytes(8 - len(image) % 8)
    for word in (*struct.unpack(f"<{len(padded) // 8}Q", padded), len(image)):
        value = (value ^ word) * 0x100000001b3 % 2**64
        value ^= value >> 32
    with open(path, "ab") as file:
        file.write(b"PBMPISUM" + struct.pack("<QQ", len(image), value))


def end_group(process):
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    process.wait()
    if process.stderr:
        process.stderr.close()


def wait_until(condition, what):
    deadline = time.monotonic() + TIMEOUT_S
    while not condition():
        if time.monotonic() > deadline:
            raise AssertionError(f"waited {TIMEOUT_S} s in vain for {what}")
        time.sleep(0.005)


def rank_pids(process):
    """Process ids of the pbmpi ranks that this mpirun started, by rank."""
    ranks = {}
    for entry in os.listdir("/proc"):
        if not entry.isdigit():
            continue
        try:
            with open(f"/proc/{entry}/stat", encoding="utf-8") as file:
                parent = int(file.read().rsplit(")", 1)[1].split()[1])
            if parent != process.pid:
                continue
            with open(f"/proc/{entry}/environ", "rb") as file:
                environment = dict(pair.split(b"=", 1) for pair in file.read().split(b"\0") if b"=" in pair)
            if b"OMPI_COMM_WORLD_RANK" in environment:
                ranks[int(environment[b"OMPI_COMM_WORLD_RANK"])] = int(entry)
        except (FileNotFoundError, ProcessLookupError, PermissionError):
            continue  # ended while we looked
    return ranks
