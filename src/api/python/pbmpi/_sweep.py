"""What settings cost, and how wrong they are."""

import itertools
import statistics
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Optional, Union

import numpy as np

from ._batch import Batch
from ._files import needed
from ._text import plain

UNITS = {"step_time": "s", "frame_time": "s", "frame_time_min": "s", "frame_time_max": "s", "energy": "J", "joint_gap": "m",
         "position_error_rms": "m", "position_error_max": "m", "dt": "s"}
# A timing is the median of as many passes over the frames as take so long together, but of so many at most: what interrupts a
# process does so for milliseconds.
LEAST_SECONDS, MOST_PASSES = 0.05, 10
Measure = Union[Callable[[Batch], Any], Sequence[str], None]


def sweep(scene: str, settings: Mapping[str, Sequence[Any]], *, worlds: Optional[int] = None, frames: int = 30, seed: int = 1,
          parameters: Any = None, scene_text: Optional[str] = None, measure: Measure = None,
          reference: Optional[Mapping[str, Any]] = None, warmup: int = 3, repeats: int = 5) -> Any:
    """Runs a scene with all combinations of settings: a pandas.DataFrame with a row a combination, in the order of itertools.product.

    settings: values by option, e.g. {"substeps": [2, 4, 8], "precision": ["double", "single"]}. A text is a list of one.
    worlds, seed, parameters, scene_text: as of Batch.
    frames: how many are simulated; a frame is as long as with the scene's own dt, and so the same time with each setting.
    measure: names of observables, of which columns "mean_NAME" have the mean over the worlds; or a function of the batch, called
    after the last frame, that gives a number (column "measure") or a dict of columns.
    reference: settings of the run that positions are compared with, e.g. {"substeps": 64}; options that it does not name are as
    pbmpi has them by default. None: of the combinations that with the shortest substep, then most iterations, then double precision.
    warmup: so many of the frames are stepped before the clock starts; at least one is timed.
    repeats: so many times each combination is timed, each time over some passes if these are short.

    Columns, beside those of settings and measure:
      step_time [s]      wall time of a step of all worlds: the median over the repeats
      frame_time [s]     the same of a frame, with frame_time_min and frame_time_max over the repeats
      energy [J]         after the last frame, the sum over the worlds
      joint_gap [m]      largest of a world at the end of a frame
      position_error_rms, position_error_max [m]
                         distances of bodies from where they are in the reference, over all frames, worlds and bodies (drift)
      is_reference       whether the row is the reference itself
      hash               of all bits after the last frame
    attrs["units"] has units by column, attrs["reference"] the settings of the reference.

    Times are taken in rounds over all combinations, so that none of them has a quieter machine than the others; all batches are in
    memory together. A timed run must end with the hash of the untimed one. A trajectory that bounces and rubs departs from any other
    one in time: errors over many frames say that settings differ, those over few how wrong one is (docs/accuracy.md).

    ValueError for settings that pbmpi refuses, and for a dt of which a frame is no whole number; RuntimeError for a run that fails.
    """
    for name, number, least in (("frames", frames, 1), ("warmup", warmup, 0), ("repeats", repeats, 1)):
        if number < least:
            raise ValueError(f"{name}={number}: it must be at least {least}")
    pandas = needed("pandas", "python3-pandas")
    chosen = {name: [values] if isinstance(values, (str, Mapping)) or np.ndim(values) == 0 else [plain(one) for one in values]
              for name, values in settings.items()}
    combinations = [dict(zip(chosen, values)) for values in itertools.product(*chosen.values())]
    made = {"worlds": worlds, "seed": seed, "parameters": parameters, "scene_text": scene_text}
    frame_s = _frame_of(scene, made)
    cases = [_Case(scene, made, combination, frame_s) for combination in combinations]
    if not cases:
        raise ValueError("settings: an option has no value; give each at least one")
    for case in cases:
        case.simulate(frames, measure)
    judge = _reference(cases, scene, made, frame_s, frames, reference)
    for _ in range(repeats):
        for case in cases:
            case.measure_time(frames, warmup)
    table = pandas.DataFrame([case.row(judge) for case in cases])
    table.attrs["units"] = {name: UNITS.get(name, "") for name in table}
    table.attrs["reference"] = judge.settings
    return table


class _Case:
    """A combination of settings."""

    def __init__(self, scene: str, made: Mapping[str, Any], settings: Mapping[str, Any], frame_s: float) -> None:
        self.settings = dict(settings)
        self.batch = Batch(scene, **made, **settings)
        steps = frame_s / self.batch.dt
        self.steps_per_frame = round(steps)
        if self.steps_per_frame < 1 or abs(steps - self.steps_per_frame) > 1e-6 * steps:
            raise ValueError(f"dt={self.batch.dt:g}: a frame of {frame_s:g} s is no whole number of such steps")
        self.positions: list[np.ndarray] = []
        self.joint_gap = 0.0
        self.times: list[float] = []

    def simulate(self, frames: int, measure: Measure) -> None:
        """The frames without a clock, and what they show."""
        for _ in range(frames):
            self.batch.step(self.steps_per_frame)
            self.positions.append(self.batch.position.copy())
            self.joint_gap = max(self.joint_gap, float(np.max(self.batch.observable("joint_gap"))))
        self.energy = float(np.sum(self.batch.observable("energy")))
        self.hash = self.batch.hash()
        self.measured = _measured(self.batch, measure)

    def measure_time(self, frames: int, warmup: int) -> None:
        """The same frames again, those after the warm-up with a clock, and again until that has run for long enough."""
        warmup = min(warmup, frames - 1)
        passes: list[float] = []
        while sum(passes) < LEAST_SECONDS and len(passes) < MOST_PASSES:
            self.batch.reset()
            self.batch.step(warmup * self.steps_per_frame)
            start = time.perf_counter()
            self.batch.step((frames - warmup) * self.steps_per_frame)
            passes.append(time.perf_counter() - start)
            if self.batch.hash() != self.hash:
                raise RuntimeError(f"{self.settings}: a second run of the same frames has other bits")
        self.times.append(statistics.median(passes) / (frames - warmup))

    def rank(self) -> tuple:
        """Larger: nearer to the exact solution, as far as settings tell."""
        settings = self.settings
        return (-self.batch.dt / int(settings.get("substeps", 1)), int(settings.get("iterations", 0)),
                settings.get("precision", "double") == "double")

    def row(self, reference: "_Case") -> dict[str, Any]:
        distances = np.linalg.norm(np.subtract(self.positions, reference.positions), axis=-1)
        frame_time = statistics.median(self.times)
        return {**self.settings, "step_time": frame_time / self.steps_per_frame, "frame_time": frame_time,
                "frame_time_min": min(self.times), "frame_time_max": max(self.times), "energy": self.energy,
                "joint_gap": self.joint_gap, "position_error_rms": float(np.sqrt(np.mean(distances**2))),
                "position_error_max": float(np.max(distances)), "is_reference": self is reference, "hash": self.hash,
                **self.measured}


def _frame_of(scene: str, made: Mapping[str, Any]) -> float:
    """Length of a frame of the scene [s]."""
    batch = Batch(scene, 1, seed=made["seed"], scene_text=made["scene_text"])
    return batch.steps_per_frame * batch.dt


def _reference(cases: list[_Case], scene: str, made: Mapping[str, Any], frame_s: float, frames: int,
               settings: Optional[Mapping[str, Any]]) -> _Case:
    if settings is None:
        return max(cases, key=_Case.rank)
    for case in cases:
        if case.settings == dict(settings):
            return case
    case = _Case(scene, made, settings, frame_s)
    case.simulate(frames, None)
    return case


def _measured(batch: Batch, measure: Measure) -> dict[str, Any]:
    if measure is None:
        return {}
    if callable(measure):
        seen = measure(batch)
        return dict(seen) if isinstance(seen, Mapping) else {"measure": seen}
    names = [measure] if isinstance(measure, str) else measure
    return {f"mean_{name}": np.mean(batch.observable(name), axis=0).tolist() for name in names}
