"""A study of value prediction, the file of `pbstudy prediction`: hits, frame rates of the modelled processor, and errors."""
import csv
import dataclasses
import math

import numpy as np

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
    attributes: dict = dataclasses.field(default_factory=dict)
    parameters: dict = dataclasses.field(default_factory=dict)

    def find(self, name):
        return next((scene for scene in self.scenes if scene.name == name), None)


def columns_of(group):
    """Name -> array of the rows; text as str."""
    return {name: column.asstr()[:] if column.dtype.kind in "SO" else column[:] for name, column in group.items()}


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


def errors_of(cases, i):
    names = {kind: f"{kind}_body_position_" for kind in ("defect", "drift", "floor")}
    return {kind: (float(cases[name + "rms"][i]), cases[name + "bands"][i].tolist()) for kind, name in names.items()}


def read_case(cases, frames, i, budget_s):
    def whole(name):
        return int(cases[name][i])

    rows = np.flatnonzero((frames["case"] == i) & (frames["frame"] >= whole("warmup")) & ((frames["is_estimate"] != 0) == bool(whole("feec"))))
    case = Case(cases["name"][i], cases["stepper"][i], cases["precision"][i] if "precision" in cases else "double", cases["scope"][i],
                float(cases["threshold"][i]), *(bool(whole(name)) for name in ("ended", "same_hash", "errors_known")),
                whole("exit_code"), whole("frames_done"), len(rows), whole("nonfinite_step"), whole("nonfinite_frame"),
                float(cases["islands_mean"][i]), float(cases["base_islands_mean"][i]), errors=errors_of(cases, i))
    count_instructions(case, frames, rows)
    case.loads, case.operations = hits_of(frames, rows, "fp_load"), hits_of(frames, rows, "fp_operation")
    case.unpredicted, case.predicted = (rate_of(frames[name][rows], budget_s) for name in ("cycles", "predicted_cycles"))
    return case


def chosen(scenes, names):
    """The scenes in the order of the names; without names all."""
    for name in names:
        known = ", ".join(dict.fromkeys(scene.name for scene in scenes))
        runs.require(any(scene.name == name for scene in scenes), f"--scene {name}: the study has {known}")
    return [scene for name in names for scene in scenes if scene.name == name] or scenes


def read_study(path, names=()):
    """The study, of these scenes only if there are any names."""
    filetype, kind = runs.kind_of(path)
    runs.require(filetype == runs.STUDY, f"{path}: no study; name the file of pbstudy prediction")
    runs.require(kind == "prediction", f"{path}: a study of {kind}, not of prediction; try pbreport {path}")
    with runs.open_file(path) as file:
        cases, frames, sensitivity = (columns_of(file[name]) for name in ("cases", "frames", "sensitivity"))
        study = Study(attributes={name: runs.text_of(value) for name, value in file.attrs.items()},
                      parameters={name: runs.text_of(value[()]) for name, value in file["parameters"].items()})
    runs.require("budget_s" in study.parameters, "the study has no parameter budget_s; make it anew with this version")
    study.budget_s = float(study.parameters["budget_s"])
    for i, name in enumerate(cases["scene"]):
        scene = study.find(name)
        if scene is None:
            scene = PredictionScene(name, *(int(cases[column][i]) for column in ("worlds", "warmup", "frames")))
            study.scenes.append(scene)
        scene.cases.append(read_case(cases, frames, i, study.budget_s))
        if not study.fvp and scene.cases[-1].name.startswith("FEEC+"):
            study.fvp = scene.cases[-1].name.removeprefix("FEEC+")
    study.scenes = chosen(study.scenes, names)
    study.sensitivity = [Sensitivity(cases["scene"][case], cases["name"][case], variant, float(cycles), float(predicted))
                         for case, variant, cycles, predicted in zip(*(sensitivity[name] for name in
                                                                       ("case", "variant", "cycles", "predicted_cycles")))
                         if not names or cases["scene"][case] in names]
    return study


def write_cases(path, out):
    """All cases as comma-separated values; a column with several values becomes several."""
    with runs.open_file(path) as file:
        cases = columns_of(file["cases"])
    flat = {}
    for name, column in cases.items():
        flat.update({name: column} if column.ndim == 1 else {f"{name}_{k}": column[:, k] for k in range(column.shape[1])})
    with open(out, "w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(flat)
        rows.writerows(zip(*([str(value).removesuffix(".0") for value in column.tolist()] for column in flat.values())))


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
