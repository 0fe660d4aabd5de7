"""Runs of the same work on different numbers of ranks, as curves of speed-up and efficiency."""
import collections
import dataclasses
import math
import operator

import numpy as np

from reports.files import require
from reports.runs import NOTHING, PHASES, USEFUL, Run, matters_for
from reports.samples import Interval, median_interval, quantile, total
from reports.words import plural

CONFIDENCE = 0.95
STRONG, WEAK = "strong", "weak"  # the same number of worlds on more ranks; worlds that grow with the ranks
BUDGET_S = 0.1 / 30  # of a frame, where an old file does not say it


@dataclasses.dataclass
class Rules:
    """What is required of a point to be reported. `widest_interval`: of the speed-up, relative to its median."""
    least_repeats: int = 5
    widest_interval: float = 0.1


@dataclasses.dataclass
class Pop:
    """Efficiencies of the POP centre of excellence (pop-coe.eu, "POP standard metrics"): the parallel efficiency is the product of the
    three."""
    load_balance: float = 0.0  # mean / largest useful time of a rank
    serialisation: float = 0.0  # largest useful time / the elapsed time on an ideal network
    transfer: float = 0.0  # the fraction of the elapsed time that would remain on an ideal network, where messages take no time


@dataclasses.dataclass
class ScalingRun:
    """What a report takes from the file of a run; times are of the measured frames."""
    path: str
    created: str
    attributes: dict
    scene: str
    stepper: str
    precision: str
    decomposition: str
    problem: dict  # all that decides the work of a world, including seeds and number of frames
    program: str  # version, revision, compiler and instruction set
    state_hash: str
    complete: bool
    records_islands: bool  # the islands of its last steps were measured one by one
    ranks: int
    worlds: int
    steps_per_frame: int
    most_ranks_of_a_host: int
    processors: int  # of root's host; 0 = unknown
    frames: int
    frame_s: float  # mean, from the start of a frame to the end of its gather
    within_budget: float  # fraction of the frames
    useful_s: float  # a frame, all ranks together
    pop: Pop
    root_share: float  # root's section / work, 0 where ranks own whole worlds
    island_bound: float  # speed-up with each frame's largest island on one rank; 0 for whole worlds
    messages: float  # a frame, all ranks, inside the steps; so are bytes
    bytes: float
    processor_s: float  # processor time of the busiest rank in a frame, without waiting; 0 in files of a layout before 1.8
    phase_s: dict  # a frame, mean of the ranks, by phase


def pop_of(useful_s, exchange_s, elapsed_s):
    """From the seconds of each rank [R], and the elapsed ones. An ideal network saves the time of exchanges (ship, gather) on the rank that
    spends the least in them."""
    most = max(useful_s)
    if most <= 0 or elapsed_s <= 0:
        return Pop()
    ideal_s = max(most, elapsed_s - min(exchange_s))
    return Pop(total(useful_s) / len(useful_s) / most, most / ideal_s, min(1.0, ideal_s / elapsed_s))


def problem_of(run):
    decides = [name for name in run.parameters if matters_for(name) != NOTHING and name != "replicas"]
    return {name: run.parameter(name) for name in ("frames", *decides)}


def program_of(run):
    threads = run.parameter("threads", "1")
    return (f"{run.attributes.get('pbmpi_version', '')}, revision {run.attributes.get('git_revision', '')}, {run.parameter('build')}, "
            f"{run.parameter('simd')}" + ("" if threads == "1" else f", {threads} threads a rank"))


def of_cut_world(run, seconds):
    """(root's share, bound by the largest islands) of a run cut into spaces. `seconds`: [measured frames][R] by phase."""
    frames = len(seconds["solve"])
    groups = max(1, len([one for one in run.parameter("rank_groups").split(",") if one]))
    collide_s = total((seconds["collide"] + seconds["islands"]).T)  # [measured frames]
    solve_s = total((seconds["rows"] + seconds["solve"] + seconds["integrate"]).T)
    section_s = total(seconds["cross_space"].T)
    rows = run.frames("observables/world/rows")[run.measured].sum(axis=1)
    largest = run.frames("observables/world/max_island_rows")[run.measured].max(axis=1)
    share = np.divide(largest, rows, out=np.zeros(frames), where=rows > 0)
    bound_s = section_s / groups + collide_s / run.num_ranks + solve_s * np.maximum(share, 1 / run.num_ranks)
    work_s, root_s = total(collide_s + solve_s), total(section_s)
    return (root_s / (root_s + work_s), work_s / total(bound_s)) if work_s > 0 else (0.0, 0.0)


def processor_of(run):
    """Seconds of the busiest rank; 0 if the file does not have them."""
    return max(total(run.of_ranks("processor"))) if run.has("timings/rank/processor") else 0.0


def read_scaling_run(path):
    """Raises BadInput for what is no run, or has no measured frame."""
    run = Run(path)
    wall_s = run.frames("timings/frame/wall")[run.measured]
    frames = len(wall_s)
    require(frames > 0 and total(wall_s) > 0, f"{path}: it has no measured frame; leave it out, or run longer than the warm-up")
    frame_s = 1 / (frames / total(wall_s))
    seconds = {phase: run.of_ranks(phase) for phase in PHASES}
    useful_s = total(total([seconds[phase] for phase in USEFUL]))  # [R]
    exchange_s = total(seconds["ship"] + seconds["gather"])
    is_cut = run.parameter("decompose") == "spaces"
    root_share, island_bound = of_cut_world(run, seconds) if is_cut else (0.0, 0.0)
    messages, num_bytes = (total(total(run.of_ranks(counted).T)) / frames for counted in ("messages", "bytes"))
    return ScalingRun(path=path, created=run.attributes.get("created", ""), attributes=run.attributes, scene=run.scene,
                      stepper=run.parameter("stepper"), precision=run.parameter("precision"),
                      decomposition="spaces" if is_cut else "worlds", problem=problem_of(run), program=program_of(run),
                      state_hash=run.state_hash, complete=run.complete,
                      records_islands=run.parameter("record_islands") == "1", ranks=run.num_ranks, worlds=run.num_worlds,
                      steps_per_frame=int(run.number("steps_per_frame")), most_ranks_of_a_host=max(collections.Counter(run.hosts).values()),
                      processors=int(run.number("processors", 0)), frames=frames, frame_s=frame_s,
                      within_budget=np.count_nonzero(wall_s <= run.number("budget", BUDGET_S)) / frames, useful_s=total(useful_s) / frames,
                      pop=pop_of(useful_s, exchange_s, frames * frame_s), root_share=root_share, island_bound=island_bound,
                      messages=messages, bytes=num_bytes, processor_s=processor_of(run) / frames,
                      phase_s={phase: total(total(values)) / run.num_ranks / frames for phase, values in seconds.items()})


@dataclasses.dataclass
class Estimated:
    """The median of a sample, and an interval for the distribution's median."""
    median: float
    interval: Interval

    def times(self, factor):
        interval = self.interval
        return Estimated(self.median * factor, Interval(interval.low * factor, interval.high * factor, interval.confidence))

    def __str__(self):
        return f"{self.median:.3f} ({self.interval.low:.3f} to {self.interval.high:.3f})"


class Sample:
    """Runs of one work on the same number of ranks, with the same decomposition, in the order of their starts."""

    def __init__(self, runs):
        self.runs = runs
        self.ranks, self.worlds, self.decomposition = self.key = key_of(runs[0])

    def median(self, value):
        """Of a value of the runs, e.g. "frame_s", "pop.transfer"."""
        return quantile(list(map(operator.attrgetter(value), self.runs)), 0.5)

    def phase_s(self, phase):
        return quantile([run.phase_s[phase] for run in self.runs], 0.5)


class Point(Sample):
    """A sample beside the base of its curve.

    speed_up: ratio of worlds simulated a second between the k-th run and the k-th run of the base, so that noise of the machine common to
    both cancels. ideal: the growth in ranks; bound: that or, for a cut world, the bound from its largest island if that is less.
    efficiency: speed-up / the growth in ranks. processor_speed_up: the speed-up of worlds a second of the busiest rank's processor time, which
    ranks that share cores have, too; 0 if unknown. computation: useful time of the base, for as many worlds, / that of this point. doubts: why
    it should not be reported, in words; empty if nothing speaks against it. `hashes`: of all runs of as many worlds."""

    def __init__(self, runs, base, hashes, rules):
        super().__init__(runs)
        ratios = [one.worlds / one.frame_s / (other.worlds / other.frame_s) for one, other in zip(runs, base.runs)]
        self.speed_up = Estimated(quantile(ratios, 0.5), median_interval(ratios, CONFIDENCE))
        self.efficiency = self.speed_up.times(base.ranks / self.ranks)
        processor_s = self.median("processor_s") / self.worlds
        self.processor_speed_up = base.median("processor_s") / base.worlds / processor_s if processor_s > 0 else 0.0
        useful_s = self.median("useful_s") / self.worlds
        self.computation = base.median("useful_s") / base.worlds / useful_s if useful_s > 0 else 0.0
        self.ideal = self.ranks / base.ranks
        self.bound = min(self.ideal, self.median("island_bound") or self.ideal)
        self.doubts = "; ".join(doubts_of(self, base, hashes, rules))


def key_of(run):
    return run.ranks, run.worlds, run.decomposition


def doubts_of(point, base, hashes, rules):
    """Why a point should not be reported. A ratio is no better than the base runs in its denominator."""
    runs = point.runs + base.runs
    repeats, interval = min(len(point.runs), len(base.runs)), point.speed_up.interval
    width = (interval.high - interval.low) / point.speed_up.median
    too_wide = f"interval of {100 * width:.0f} %, {100 * rules.widest_interval:.0f} % at most"
    found = ((repeats < rules.least_repeats, f"{repeats} of {rules.least_repeats} repeats"),
             (not width <= rules.widest_interval, too_wide),
             (len(hashes) > 1, f"{len(hashes)} different hashes"),
             (any(run.program != base.runs[0].program for run in runs), "another build or processor than the base's"),
             (not all(run.complete for run in runs), "a run that did not end"),
             (any(0 < run.processors < run.most_ranks_of_a_host for run in runs), "more ranks than processors"))
    return [doubt for holds, doubt in found if holds]


class Curve:
    """Points by ascending ranks, compared with the base. `decomposition`: of all points except, in a strong curve, some on the fewest
    ranks."""

    def __init__(self, kind, decomposition, series, samples, base, rules):
        self.kind, self.decomposition = kind, decomposition
        self.points = [Point(sample.runs, base, hashes_of(series, sample.worlds), rules) for sample in samples]
        self.base = next(point for point in self.points if point.key == base.key)
        self.first = base.runs[0]  # gives scene, stepper ...

    def label(self, point):
        """"2", or "1, worlds" where the point has another decomposition than the curve."""
        return str(point.ranks) + ("" if point.decomposition == self.decomposition else f", {point.decomposition}")

    def title(self):
        worlds = plural(self.base.worlds, "world") if self.kind == STRONG else f"{self.base.worlds / self.base.ranks:g} worlds a rank"
        first = self.first
        return f"{first.scene}, {worlds}, {first.stepper} {first.precision}: {self.kind} scaling, {self.decomposition} over ranks"

    def base_text(self):
        """The base of the curve, and the bound on its speed-up."""
        way = "whole worlds" if self.base.decomposition == "worlds" else "cut into spaces"
        return (f"Base: {plural(self.base.ranks, 'rank')}, {way}, {1e3 * self.base.median('frame_s'):.4g} ms a frame of "
                f"{plural(self.first.steps_per_frame, 'step')}.")


def hashes_of(series, worlds):
    return {run.state_hash for run in series if run.worlds == worlds and run.complete}


def series_of(runs):
    """Lists of runs of one problem, which differ only in the numbers of worlds and ranks; each in the order of their starts."""
    series = []
    for run in runs:
        same = next((one for one in series if one[0].problem == run.problem), None)
        if same is None:
            series.append([run])
        else:
            same.append(run)
    return [sorted(one, key=lambda run: (run.created, run.path)) for one in series]


def samples_of(series):
    """By ascending ranks. Excludes runs that recorded islands, which do more in a frame."""
    by_key = {}
    for run in series:
        if not run.records_islands:
            by_key.setdefault(key_of(run), []).append(run)
    return [Sample(by_key[key]) for key in sorted(by_key)]


def has_several_ranks(samples):
    return samples[0].ranks != samples[-1].ranks


def strong_curves(series, rules):
    """One curve per number of worlds and decomposition; the base is the fastest sample on the fewest ranks, whatever its decomposition."""
    samples = samples_of(series)
    for worlds, way in sorted({(sample.worlds, sample.decomposition) for sample in samples}):
        same_work = [sample for sample in samples if sample.worlds == worlds]
        base = min((sample for sample in same_work if sample.ranks == same_work[0].ranks), key=lambda sample: sample.median("frame_s"))
        on_curve = [sample for sample in same_work if sample.decomposition == way or sample.ranks == base.ranks]
        if has_several_ranks(on_curve):
            yield Curve(STRONG, way, series, on_curve, base, rules)


def weak_curves(series, rules):
    """One curve per number of worlds a rank; a world that is cut does not grow with the ranks."""
    by_load = {}
    for sample in samples_of(series):
        common = math.gcd(sample.worlds, sample.ranks)
        if sample.decomposition == "worlds":
            by_load.setdefault((sample.worlds // common, sample.ranks // common), []).append(sample)
    for _, on_curve in sorted(by_load.items()):
        if has_several_ranks(on_curve):
            yield Curve(WEAK, "worlds", series, on_curve, on_curve[0], rules)


def curves_of(runs, rules):
    """Strong curves, then weak ones, in the order in which the first runs of their scenes were given."""
    series = series_of(runs)
    return [curve for curves_in in (strong_curves, weak_curves) for one in series for curve in curves_in(one, rules)]


def files_without_curve(runs, curves):
    used = {run.path for curve in curves for point in curve.points for run in point.runs}
    return [run.path for run in runs if run.path not in used and not run.records_islands]
