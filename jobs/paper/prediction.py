"""A study of value prediction, the file of predict.py: hits, frame rates of the modelled processor, and errors."""
import dataclasses
import math

import numpy as np

from reports import files

import runs
from instructions import MIX

PROCESSOR_HZ = 3e9  # the paper's Table 3
MIX_COLUMNS = [f"mix_{name.replace(' ', '_')}" for name in MIX]
NAN = math.nan


def ratio(a, b):
    """NaN where nothing was counted."""
    return a / b if b else NAN


@dataclasses.dataclass
class Hits:
    """Of predictions, over the measured frames."""
    executed: float = 0
    exact: float = 0
    fuzzy: float = 0
    wrong: float = 0
    error_sum: float = 0
    error_max: float = 0

    def coverage(self):
        """Correct predictions over executions."""
        return ratio(self.exact + self.fuzzy, self.executed)

    def hit_rate(self):
        """Correct predictions over those that were used."""
        return ratio(self.exact + self.fuzzy, self.exact + self.fuzzy + self.wrong)

    def mean_error(self):
        """Of the values that enter the simulation."""
        return ratio(self.error_sum, self.fuzzy)


@dataclasses.dataclass
class FrameRate:
    """Of frames on the modelled processor; NaN where none was modelled."""
    hz: float = NAN  # harmonic mean
    satisfied: float = NAN


@dataclasses.dataclass
class Case:
    """One run of the study."""
    name: str
    stepper: str = "quick"
    precision: str = "double"
    scope: str = ""
    threshold: float = 0
    ended: bool = False
    same_hash: bool = False
    errors_known: bool = False
    exit_code: int = 0  # -1: the time limit
    frames_done: int = 0
    measured: int = 0  # number of frames that count
    nonfinite_step: int = -1
    nonfinite_frame: int = -1
    islands: float = NAN
    base_islands: float = NAN
    instructions: float = NAN  # a frame, mean
    collision_share: float = NAN
    mix: tuple = (0,) * len(MIX)
    loads: Hits = dataclasses.field(default_factory=Hits)
    operations: Hits = dataclasses.field(default_factory=Hits)
    unpredicted: FrameRate = dataclasses.field(default_factory=FrameRate)
    predicted: FrameRate = dataclasses.field(default_factory=FrameRate)
    errors: dict = dataclasses.field(default_factory=dict)  # "defect", "drift", "floor" -> (rms of positions [m], their bands)

    def has_crashed(self):
        return not self.ended and self.exit_code > 0

    def is_broken(self):
        return self.nonfinite_frame >= 0 or self.has_crashed()

    def rms(self, kind):
        return self.errors[kind][0]

    def hits(self):
        """Of loads and operations together."""
        pairs = [(getattr(self.loads, one.name), getattr(self.operations, one.name)) for one in dataclasses.fields(Hits)]
        return Hits(*(a + b for a, b in pairs[:-1]), max(pairs[-1]))

    def fate(self):
        """ "not finite from step 11 on", "not ended in time", or empty."""
        if self.has_crashed():
            return f"crashed with exit code {self.exit_code}"
        if not self.ended:
            return "not ended in time"
        if not self.is_broken():
            return ""
        return f"not finite from {f'step {self.nonfinite_step}' if self.nonfinite_step >= 0 else f'frame {self.nonfinite_frame}'} on"


@dataclasses.dataclass
class PredictionScene:
    name: str
    worlds: int = 1
    warmup: int = 0
    frames: int = 0
    cases: list = dataclasses.field(default_factory=list)

    @property
    def base(self):
        return self.cases[0]

    def find(self, name):
        """None if the study has no such case."""
        return next((case for case in self.cases if case.name == name), None)


@dataclasses.dataclass
class Bar:
    """One bar of Figure 8; no case if the study has none."""
    name: str
    rate: FrameRate
    case: Case = None


@dataclasses.dataclass
class Sensitivity:
    """Cycles of a case on another processor."""
    scene: str
    case: str
    variant: str
    cycles: float
    predicted_cycles: float

    def gain(self):
        return self.cycles / self.predicted_cycles - 1


@dataclasses.dataclass
class Study:
    budget_s: float = 0
    fvp: str = ""  # "FVP6": the threshold of Figure 8
    scenes: list = dataclasses.field(default_factory=list)
    sensitivity: list = dataclasses.field(default_factory=list)
    file: files.Study = None

    def find(self, name):
        return next((scene for scene in self.scenes if scene.name == name), None)


def hits_of(frames, rows, value_class):
    column = {name: frames[f"{value_class}_{name}"][rows].tolist()
              for name in ("executed", "exact", "fuzzy", "wrong", "error_sum", "error_max")}
    sums = (float(sum(column[name])) for name in ("executed", "exact", "fuzzy", "wrong", "error_sum"))
    return Hits(*sums, max(column["error_max"], default=0.0))


def rate_of(cycles, budget_s):
    """A negative number of cycles: the frame was not modelled."""
    if len(cycles) == 0 or min(cycles) < 0:
        return FrameRate()
    seconds = [float(one) / PROCESSOR_HZ for one in cycles]
    return FrameRate(runs.harmonic_mean_hz(seconds), sum(one <= budget_s for one in seconds) / len(seconds))


def count_instructions(case, frames, rows):
    """Sets the instructions of a frame, collision detection's share, and the mix."""
    if len(rows) == 0:
        return
    mix = [int(frames[name][rows].sum()) for name in MIX_COLUMNS]
    instructions = int(frames["instructions"][rows].sum())
    case.mix = tuple(ratio(one, sum(mix)) for one in mix)
    case.instructions = instructions / len(rows)
    case.collision_share = ratio(int(frames["collision_instructions"][rows].sum()), instructions)


def errors_of(row):
    names = {kind: f"{kind}_body_position" for kind in ("defect", "drift", "floor")}
    return {kind: (getattr(row, f"{name}_rms"), getattr(row, f"{name}_bands")) for kind, name in names.items()}


def read_case(row, place, frames, budget_s):
    """`row`: the one at this place of the table of cases; `frames`: {name: array} of all cases."""
    rows = np.flatnonzero((frames["case"] == place) & (frames["frame"] >= row.warmup) & ((frames["is_estimate"] != 0) == bool(row.feec)))
    case = Case(row.name, row.stepper, row.get("precision", "double"), row.scope, row.threshold, bool(row.ended), bool(row.same_hash),
                bool(row.errors_known), row.exit_code, row.frames_done, len(rows), row.nonfinite_step, row.nonfinite_frame,
                row.islands_mean, row.base_islands_mean, errors=errors_of(row))
    count_instructions(case, frames, rows)
    case.loads, case.operations = hits_of(frames, rows, "fp_load"), hits_of(frames, rows, "fp_operation")
    case.unpredicted, case.predicted = (rate_of(frames[name][rows], budget_s) for name in ("cycles", "predicted_cycles"))
    return case


def read_study(path, names=()):
    """The study, of these scenes only if there are any names."""
    file = files.read_study(path, "prediction")
    files.require("budget_s" in file.parameters, "the study has no parameter budget_s; make it anew with this version")
    frames = {name: np.array(column) for name, column in file.tables["frames"].items()}
    cases, scenes = file.rows(), {}
    study = Study(float(file.parameters["budget_s"]), file=file)
    for place, row in enumerate(cases):
        scene = scenes.setdefault(row.scene, PredictionScene(row.scene, row.worlds, row.warmup, row.frames))
        scene.cases.append(read_case(row, place, frames, study.budget_s))
        if not study.fvp and row.name.startswith("FEEC+"):
            study.fvp = row.name.removeprefix("FEEC+")
    study.scenes = files.in_order_of(names, list(scenes.values()), lambda scene: scene.name)
    study.sensitivity = [Sensitivity(case.scene, case.name, row.variant, float(row.cycles), float(row.predicted_cycles))
                         for row, case in ((row, cases[row.case]) for row in file.rows("sensitivity")) if not names or case.scene in names]
    return study


def engines_of(scene, fvp):
    """{engine: (exact hits, fuzzy hits)}, as far as the study has the engine; quick in single precision is the paper's."""
    pairs = {"quick single": ("single", f"single {fvp}"), "quick double": (scene.base.name, fvp), "sor": ("sor", f"sor {fvp}")}
    found = {engine: [scene.find(name) for name in names] for engine, names in pairs.items()}
    return {engine: [case.hits() for case in cases] for engine, cases in found.items() if None not in cases}


def figure_8(scene, fvp):
    """[Bar]: 20Iter, 19Iter, FEEC, FVP6, EVP, FEEC+FVP6."""
    base, less = scene.cases[:2]

    def bar(name, is_predicted):
        case = scene.find(name)
        return Bar(name, (case.predicted if is_predicted else case.unpredicted) if case else FrameRate(), case)

    return [Bar(base.name, base.unpredicted, base), Bar(less.name, less.unpredicted, less), bar("FEEC", False), bar(fvp, True),
            Bar("EVP", base.predicted, base), bar(f"FEEC+{fvp}", True)]
