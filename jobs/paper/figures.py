"""Figures 8 and 9 of the paper: frame rates of the ways to compute a frame, and their errors, from the runs of jobs/figure8_9.sh."""
import dataclasses
import itertools
import math

from reports.files import require
from reports.one_run.error_sets import ORIENTATION_BANDS, POSITION_BANDS
from reports.one_run.recorded import RecordedRun

import runs

REFERENCE, FLOOR, FEEC = "Iter20", "seed", "FEEC quick x 1"
SCENES = ("CrashWa", "Environ", "Battle", "Fight", "Battle2")  # those of the paper's Figures 8 and 9
# The errors of `pbreport diff`: name, unit, title of the panel, what the table adds to it, bands.
ERRORS = (("body_position", "m", "Geometric, position", "", POSITION_BANDS),
          ("body_orientation", "rad", "Geometric, orientation", "", ORIENTATION_BANDS),
          ("joint_position", "m", "Constraint, position", " (anchor gap)", POSITION_BANDS),
          ("joint_orientation", "rad", "Constraint, orientation", " (axis angle)", ORIENTATION_BANDS))


@dataclasses.dataclass
class Method:
    """A way to compute a scene's frames: "Iter20", "Iter19", "FEEC quick x 1"."""
    label: str
    is_estimate: bool = False
    num_runs: int = 0
    frame_s: float = 0  # mean time of the precise result, or of an estimate's delivery
    rate_hz: float = 0
    satisfied: float = 0
    errors: dict = dataclasses.field(default_factory=dict)  # name_unit -> errors against Iter20, of an estimate those of its poses
    same_hash: bool = False  # has the precise result the bits of Iter20?
    stretch: list = dataclasses.field(default_factory=list)  # of the human segments in all measured frames; NaN: not finite
    joint_gap_m: float = 0  # the widest of the precise result

    @property
    def positions(self):
        return self.errors["body_position_m"]


@dataclasses.dataclass
class Scene:
    name: str
    methods: list  # Iter20 first
    floor: list  # errors of Iter20 with other solver seeds, as in Method

    def find(self, label):
        """None if it was not recorded."""
        return next((method for method in self.methods if method.label == label), None)

    def ratio(self, estimate):
        """Mean time of a frame of Iter20 over that of an estimate's delivery."""
        return self.methods[0].frame_s / estimate.frame_s


def label_of(run):
    """Which method the run's settings are."""
    if run.parameter("feec") == "1":
        stepper = run.parameter("estimate_stepper")
        precision = " " + run.parameter("estimate_precision") if stepper == "sor" else ""
        return f"FEEC {stepper}{precision} x {run.parameter('estimate_iterations')}"
    if run.parameter("solver_seed") != run.parameter("seed"):
        return FLOOR
    stepper = run.parameter("stepper")
    return ("Iter" if stepper == "quick" else f"{stepper} x ") + run.parameter("iterations")  # the paper has quick alone


def least_times(repeats, is_estimate):
    """Frame by frame the least of the repeats: other programs on the machine only add time, to some runs and not to others."""
    times = [(run.delivered_s if is_estimate else run.wall_s)[run.measured].tolist() for run in repeats]
    return [min(one for one in frame if one is not None) for frame in itertools.zip_longest(*times)]


def method_of(label, repeats, reference):
    first = repeats[0]
    for other in repeats[1:]:
        runs.require_same_state(other, first)
    found = runs.pbreport("diff", first.path, reference.path)
    is_estimate = first.delivered_s is not None
    times = least_times(repeats, is_estimate)
    return Method(label, is_estimate, len(repeats), runs.mean(times), runs.harmonic_mean_hz(times), runs.satisfied_fraction(times),
                  found["estimate_drift" if is_estimate else "drift"], found["same_state_hash"], stretch_of(first, is_estimate),
                  found["invariants"]["run"]["max_joint_gap_m"])


def scene_of(name, of_scene):
    """The runs of one scene, held against its first run of Iter20."""
    by_label = {}
    for run in of_scene:
        by_label.setdefault(label_of(run), []).append(run)
    require(REFERENCE in by_label, f"{name}: no file has a run of quick with 20 iterations, which the others are held against; "
            "record one")
    reference = by_label[REFERENCE][0]
    floor = [runs.pbreport("diff", run.path, reference.path)["drift"] for run in by_label.pop(FLOOR, [])]
    labels = [REFERENCE, *(label for label in by_label if label != REFERENCE)]
    return Scene(name, [method_of(label, by_label[label], reference) for label in labels], floor)


def scenes_of(recorded):
    """[Scene] in the order of their first runs."""
    by_scene = {}
    for run in recorded:
        by_scene.setdefault(run.scene, []).append(run)
    return [scene_of(name, of_scene) for name, of_scene in by_scene.items()]


def labels_of(scenes):
    """Of all methods, in the order of the scenes."""
    return list(dict.fromkeys(method.label for scene in scenes for method in scene.methods))


def mean_ratio(scenes, label):
    """Of Iter20's time over that of this estimate's delivery; 0 without such."""
    pairs = [(scene, scene.find(label)) for scene in scenes]
    ratios = [scene.ratio(method) for scene, method in pairs if method and method.is_estimate]
    return sum(ratios) / len(ratios) if ratios else 0


def stretch_of(run, is_estimate):
    """|distance / length - 1| of the joints of each human segment, as its neighbours have them, in all measured frames that were
    recorded; NaN if it is not finite. Segments of broken joints are left out."""
    recorded = RecordedRun(run.path)
    rows = recorded.measured_rows(recorded.num_recorded) if len(recorded.segments.length) else []
    group = "estimate" if is_estimate else "particles/bodies"
    return [share for row in rows for share in recorded.segments.stretch(recorded.poses(row, group), recorded.held(row)).tolist()]


@dataclasses.dataclass
class StretchCount:
    """By the paper's own bounds for what an observer sees of a changed length (section 2.2): below 2.7 % it cannot be seen, beyond
    20 % it always is. A NaN counts as seen."""
    num: int
    seen: int
    perhaps_seen: int  # includes those that are seen
    most: float  # of the finite ones


def count_stretch(stretch):
    finite = [one for one in stretch if math.isfinite(one)]
    return StretchCount(len(stretch), sum(not one <= 0.20 for one in stretch), sum(not one < 0.027 for one in stretch),
                        max(finite, default=0))


def bands_text(errors):
    return "/".join(map(str, errors["body_position_m"]["bands"]))


def line_of(scene, method, rate="", satisfied="", milliseconds="", ratio="", bands=""):
    return f"{scene:<9} {method:<20} {rate:>11} {satisfied:>10} {milliseconds:>10} {ratio:>8}  {bands}\n"


def figures_text(scenes):
    """One line a scene and method, then the mean ratio of each estimate."""
    text = line_of("scene", "method", "rate Hz", "satisfied", "ms", "ratio", "position errors: < 1 cm/1-10/10-100/> 100/inf")
    for scene in scenes:
        for method in scene.methods:
            text += line_of(scene.name, method.label, f"{method.rate_hz:.1f}", f"{100 * method.satisfied:.0f} %", f"{1e3 * method.frame_s:.3f}",
                            f"{scene.ratio(method):.2f}" if method.is_estimate else "", bands_text(method.errors))
        for errors in scene.floor:
            text += line_of(scene.name, "another seed", bands=bands_text(errors))
    for label in labels_of(scenes):
        ratio = mean_ratio(scenes, label)
        if ratio > 0:
            text += (f"precise_over_delivery: {label}: mean {ratio:.2f} over {len(scenes)} scenes ({100 * (ratio - 1):+.0f} %; "
                     "the paper: +220 %)\n")
    return text
