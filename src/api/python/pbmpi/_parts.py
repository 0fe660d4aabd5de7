"""The files of one run: which frames come from which file, as `pbreport join` takes them."""

from typing import Any, NamedTuple

import numpy as np

from ._files import attributes_of, parameters_of
from ._rows import Piece

# Parameters that change no result (src/app/reports/runs.py has the same list), and beginnings of such.
FREE = {"ranks", "processors", "build", "simd", "threads", "decompose", "budget", "frames", "record_every", "record_islands",
        "record_contacts", "record_residuals", "resumed_from", "joined_from", "parameters_file", "ranks_per_world", "rank_groups",
        "on_blowup"}
FREE_BEGINNINGS = ("library_", "env_")
# What must have the same bits where two files have the same frame.
COMPARED = ("particles/bodies/position/value", "particles/bodies/orientation/value", "particles/bodies/velocity/value",
            "particles/bodies/angular_velocity/value", "timings/frame/step", "timings/frame/time")
COMPARED_GROUPS = ("observables/world", "observables/interest", "observables/joint")


class Stretch(NamedTuple):
    """Frames [first, first + length) of a run, which come from one of its files."""

    part: int
    first: int
    length: int


class Part:
    """A file of a run. Frames are counted from the start of the run; `every`: one of so many frames is recorded."""

    def __init__(self, path: str, file: Any) -> None:
        self.path, self.file = path, file
        self.attributes = attributes_of(file)
        self.parameters = parameters_of(file)
        self.first: int = self.attributes.get("first_frame", 0)
        self.count: int = self.attributes["frames_committed"]
        self.every: int = self.attributes["record_every"]

    @property
    def end(self) -> int:
        return self.first + self.count

    def piece(self, path: str, frames: Stretch) -> Piece:
        """Rows of these frames in a dataset of the file; of one with a row a recorded frame those of recorded ones."""
        begin = frames.first - self.first
        if is_of_recorded_frames(path):
            row = begin // self.every
            return Piece(self.file[path], row, (begin + frames.length) // self.every - row)
        return Piece(self.file[path], begin, frames.length)


def is_of_recorded_frames(path: str) -> bool:
    return path.startswith("particles/bodies/") or path in ("estimate/position/value", "estimate/orientation/value")


def plan(parts: list[Part]) -> list[Stretch]:
    """From which file each frame comes: of several that have it the last. ValueError for files that are not of one run, frames that
    none has, and frames that differ."""
    parts.sort(key=lambda part: (part.first, part.end))
    for part in parts[1:]:
        _require_one_run(parts[0], part)
    owners: list[int] = []
    begin = parts[0].first
    for number, part in enumerate(parts):
        if len(parts) > 1 and part.count == 0:
            raise ValueError(f"{part.path}: it has no frame; leave it out")
        if part.first - begin > len(owners):
            raise ValueError(f"frames {begin + len(owners)} to {part.first - 1} are missing before {part.path}; name the file of "
                             "the run between, too")
        owners[part.first - begin:part.end - begin] = [number] * part.count
    stretches: list[Stretch] = []
    for place, owner in enumerate(owners):
        if stretches and stretches[-1].part == owner:
            stretches[-1] = stretches[-1]._replace(length=stretches[-1].length + 1)
        else:
            stretches.append(Stretch(owner, begin + place, 1))
    _require_equal_overlaps(parts, stretches)
    return stretches or [Stretch(0, begin, 0)]


def _require_one_run(a: Part, b: Part) -> None:
    for name in ("version", "pbmpi_version", "scene", "record_every"):
        _require_same(a, b, name, a.attributes.get(name), b.attributes.get(name))
    for name in sorted({*a.parameters, *b.parameters}):
        if name not in FREE and not name.startswith(FREE_BEGINNINGS):
            _require_same(a, b, name, a.parameters.get(name), b.parameters.get(name))
    if (b.first - a.first) % a.every != 0:
        raise ValueError(f"{b.path}: one frame of {a.every} is recorded, counted from its first, {b.first}, which is no such frame of "
                         f"{a.path}; such files cannot be joined")


def _require_same(a: Part, b: Part, name: str, of_a: Any, of_b: Any) -> None:
    if of_a != of_b:
        short = len(str(of_a)) + len(str(of_b)) < 120
        what = f"{name} is {of_a} in {a.path} and {of_b} in {b.path}" if short else f"{name} differs in {a.path} and {b.path}"
        raise ValueError(f"the files are not of one run: {what}; name the file of a run and those that were resumed from it")


def _require_equal_overlaps(parts: list[Part], stretches: list[Stretch]) -> None:
    for stretch in stretches:
        new = parts[stretch.part]
        for number, old in enumerate(parts):
            first, end = max(stretch.first, old.first), min(stretch.first + stretch.length, old.end)
            if number == stretch.part or first >= end:
                continue
            for path in _compared(old, new):
                mine, theirs = (part.piece(path, Stretch(0, first, end - first)) for part in (new, old))
                same = (rows(mine).tobytes() == rows(theirs).tobytes())
                if not same:
                    raise ValueError(f"{old.path} and {new.path} are not of one run: {path} of frames {first} to {end - 1} is not the "
                                     "same in both; name files of one build that were resumed from one another")


def _compared(a: Part, b: Part) -> list[str]:
    """Datasets that both files have."""
    paths = list(COMPARED)
    for group in COMPARED_GROUPS:
        paths += [f"{group}/{name}" for name in a.file.get(group, ())]
    return [path for path in paths if path in a.file and path in b.file]


def rows(piece: Piece) -> np.ndarray:
    return piece.dataset[piece.begin:piece.begin + piece.length]
