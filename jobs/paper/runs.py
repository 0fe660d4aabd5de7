"""Reads files of pbmpi's runs, as far as the paper's statements need them, and asks pbreport for what it knows better."""
import json
import os
import pathlib
import subprocess

import h5py
import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("PBMPI_BIN", SOURCE / "build/release/bin"))
RUN, STUDY = "pbmpi-run", "pbmpi-study"
PHASES = ("collide", "islands", "rows", "solve", "integrate")  # of a serial step
BUDGET_S = 1 / 30 / 10  # a tenth of a frame
COUNT = "num_"  # before the name of an event's kind


class BadInput(Exception):
    """What is wrong, where, and what to do."""


def require(holds, message):
    if not holds:
        raise BadInput(message)


def text_of(value):
    """An attribute or a parameter as text."""
    return value.decode() if isinstance(value, bytes) else str(value)


def total(values):
    """The sum, in order: one that adds up in pairs has other last digits."""
    return sum(np.asarray(values, dtype=float).tolist())


def mean(values):
    return total(values) / len(values)


def harmonic_mean_hz(seconds):
    return len(seconds) / total(seconds)


def satisfied_fraction(seconds):
    """The share of these frames that were within the budget."""
    return sum(one <= BUDGET_S for one in seconds) / len(seconds)


def open_file(path):
    """The HDF5 file; the user has one message if it cannot be read."""
    try:
        return h5py.File(path, "r")
    except OSError as error:
        raise BadInput(f"{path}: it cannot be read as HDF5 ({error}); name a file of pbmpi or pbstudy") from None


def kind_of(path):
    """(file type, study) as the file's root names them; empty where it names none, or is no HDF5."""
    try:
        with h5py.File(path, "r") as file:
            return text_of(file.attrs.get("filetype", b"")), text_of(file.attrs.get("study", b""))
    except OSError:
        return "", ""


def pbreport(*args):
    """What the built pbreport prints as JSON."""
    command = [str(word) for word in (BIN / "pbreport", *args, "--json")]
    try:
        result = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as error:
        raise BadInput(f"{command[0]}: {error.strerror}; build it with jobs/build.sh release, or set PBMPI_BIN") from None
    require(result.returncode == 0, result.stderr.strip().removeprefix("pbreport: "))
    return json.loads(result.stdout)


class Run:
    """A run's committed frames: T of them, of which those at the indices `measured` count."""

    def __init__(self, path):
        self.path = str(path)
        with open_file(path) as file:
            require(text_of(file.attrs.get("filetype", b"")) == RUN, f"{path}: not a pbmpi run; name the HDF5 files of runs")
            self.attributes = {name: text_of(value) for name, value in file.attrs.items()}
            self.parameters = {name: text_of(value[()]) for name, value in file["parameters"].items()}
            self.num_worlds = len(file["worlds/id"])
            self.frames = int(file.attrs["frames_committed"])
            self.measured = np.flatnonzero(file["timings/frame/measured"][:self.frames])
            self.wall_s = file["timings/frame/wall"][:self.frames]
            self.islands = file["observables/world/islands"][:self.frames].sum(axis=1)  # [T] over all worlds
            self.phase_s = {phase: file[f"timings/rank/{phase}"][:self.frames].sum(axis=1) for phase in PHASES}
            self.delivered_s = file["estimate/delivered"][:self.frames] if "estimate" in file else None
            self.events = {name.removeprefix(COUNT): int(value) for name, value in file["events"].attrs.items() if name.startswith(COUNT)}
            self.actor_bodies = count_actor_bodies(file["particles/bodies"])
            self.num_bodies = len(file["particles/bodies/id"])
            self.profile = read_profile(file, self.frames)

    def parameter(self, name):
        return self.parameters.get(name, "")

    @property
    def scene(self):
        return self.parameter("scene")

    @property
    def state_hash(self):
        return self.attributes["state_hash"]


def count_actor_bodies(bodies):
    """Kind of actor -> the numbers of bodies that its actors have."""
    columns = (bodies["kind"].asstr()[:], bodies["world"][:], bodies["actor"].asstr()[:])
    counts = {}
    for actor in zip(*columns):
        counts[actor] = counts.get(actor, 0) + 1
    found = {}
    for (kind, _, _), number in counts.items():
        found.setdefault(kind, set()).add(number)
    return {kind: sorted(numbers) for kind, numbers in found.items()}


def read_profile(file, frames):
    """The islands [T][N], each at its lowest body, and the spaces [T][W] of each frame's last step; None unless they were recorded."""
    if "timings/island" not in file or frames == 0:
        return None
    names = ("island/bodies", "island/rows", "island/solve", "space/collide", "space/collide_spaces", "space/cross_contacts")
    return {name: file[f"timings/{name}"][:frames] for name in names}


def require_profile(run):
    require(run.profile is not None, f"{run.path}: it has no times of islands; record the run with --record-islands")


def keep_least(run, repeat):
    """Keeps the lesser of each two times of the same run: other programs on the machine only add time."""
    frames = min(run.frames, repeat.frames)

    def least(mine, other):
        mine[:frames] = np.minimum(mine[:frames], other[:frames])

    for phase in PHASES:
        least(run.phase_s[phase], repeat.phase_s[phase])
    for name in ("island/solve", "space/collide", "space/collide_spaces"):
        least(run.profile[name], repeat.profile[name])
    least(run.wall_s, repeat.wall_s)


def require_same_state(run, other):
    require(run.state_hash == other.state_hash,
            f"{run.path} and {other.path} are different runs of one scene and setting; name repeats only")
