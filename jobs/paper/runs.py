"""Reads files of pbmpi's runs, as far as the paper's statements need them, and asks pbreport for what it knows better."""
import json
import os
import pathlib
import subprocess
from typing import NamedTuple

import h5py
import numpy as np

from reports import runs
from reports.files import STUDY, BadInput, open_file, require, text_of
from reports.samples import total

BIN = pathlib.Path(os.environ.get("PBMPI_BIN", pathlib.Path(__file__).resolve().parents[2] / "build/release/bin"))
PHASES = runs.PHASES[:5]  # of a serial step
BUDGET_S = 1 / 30 / 10  # a tenth of a frame
COUNT = "num_"  # before the name of an event's kind


class Source(NamedTuple):
    """A file that was read, for the foot of a page."""
    path: str
    attributes: dict


def source_of(path):
    """Of a study."""
    with open_file(path, STUDY) as file:
        return Source(path, {name: text_of(value) for name, value in file.attrs.items()})


def mean(values):
    return float(total(values)) / len(values)


def harmonic_mean_hz(seconds):
    return len(seconds) / float(total(seconds))


def satisfied_fraction(seconds):
    """The share of these frames that were within the budget."""
    return sum(one <= BUDGET_S for one in seconds) / len(seconds)


def kind_of(path):
    """(file type, study) as the file's root names them; empty where it names none, or is no HDF5."""
    try:
        with h5py.File(path, "r", locking=False) as file:
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


class Run(runs.Run):
    """A run's committed frames, T of them, with what the statements need in memory; the file is closed. `measured_frames`: indices."""

    def __init__(self, path):
        super().__init__(str(path))
        with self.file:
            self.measured_frames = np.flatnonzero(self.measured).tolist()
            self.wall_s = self.frames("timings/frame/wall")
            self.islands = self.frames("observables/world/islands").sum(axis=1)  # [T] over all worlds
            self.phase_s = {phase: self.frames(f"timings/rank/{phase}").sum(axis=1) for phase in PHASES}
            self.delivered_s = self.frames("estimate/delivered") if self.has("estimate") else None
            events = self.file["events"].attrs
            self.events = {name.removeprefix(COUNT): int(value) for name, value in events.items() if name.startswith(COUNT)}
            self.actor_bodies = self.count_actor_bodies()
            self.num_bodies = len(self.column("particles/bodies/id"))
            self.profile = self.read_profile()

    def count_actor_bodies(self):
        """Kind of actor -> the numbers of bodies that its actors have."""
        counts = {}
        for actor in zip(*(self.column(f"particles/bodies/{name}") for name in ("kind", "world", "actor"))):
            counts[actor] = counts.get(actor, 0) + 1
        found = {}
        for (kind, _, _), number in counts.items():
            found.setdefault(kind, set()).add(number)
        return {kind: sorted(numbers) for kind, numbers in found.items()}

    def read_profile(self):
        """The islands [T][N], each at its lowest body, and the spaces [T][W] of each frame's last step; None unless they were recorded."""
        if not self.has("timings/island") or self.num_frames == 0:
            return None
        names = ("island/bodies", "island/rows", "island/solve", "space/collide", "space/collide_spaces", "space/cross_contacts")
        return {name: self.frames(f"timings/{name}") for name in names}


def require_profile(run):
    require(run.profile is not None, f"{run.path}: it has no times of islands; record the run with --record islands")


def keep_least(run, repeat):
    """Keeps the lesser of each two times of the same run: other programs on the machine only add time."""
    frames = min(run.num_frames, repeat.num_frames)

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
