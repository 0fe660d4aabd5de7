"""The islands of scenes beside the paper's Table 1, from files of runs; and what the paper says of its scenes."""
import dataclasses
import math

import numpy as np

from reports.document import Report, Section, Table
from reports.samples import total


@dataclasses.dataclass
class Summary:
    """`stddev`: the population's (divided by n). All zero for an empty sample."""
    min: float = 0.0
    max: float = 0.0
    mean: float = 0.0
    stddev: float = 0.0


def summarize(values):
    if len(values) == 0:
        return Summary()
    values = np.asarray(values, dtype=float)
    mean = total(values) / len(values)
    return Summary(float(min(values)), float(max(values)), float(mean), math.sqrt(total((values - mean) ** 2) / len(values)))


@dataclasses.dataclass
class PaperRow:
    """The paper's numbers for a scene: Table 1 (islands, spaces, traffic between spaces) and Table 2 (cores)."""
    islands: Summary
    spaces: str
    traffic: str
    cores: int


PAPER = {"2-Cars": PaperRow(Summary(2.0, 2.0, 2.0, 0.0), "1", "none", 2),  # min, max, mean, stddev
         "10-Cars": PaperRow(Summary(10.0, 10.0, 10.0, 0.0), "1", "none", 9),
         "CrashSk": PaperRow(Summary(1.0, 3.0, 2.0, 0.65), "1", "none", 3),
         "CrashWa": PaperRow(Summary(99.0, 105.0, 101.0, 1.4), "1, 3", "none to high", 3),
         "Environ": PaperRow(Summary(196.0, 337.0, 245.0, 46.0), "1, 10", "high", 4),
         "100CrSk": PaperRow(Summary(100.0, 300.0, 220.0, 64.0), "100", "none", 100),
         "Battle": PaperRow(Summary(2.0, 120.0, 93.0, 18.0), "1, 3", "none", 19),
         "Fight": PaperRow(Summary(7.0, 10.0, 8.0, 1.1), "1, 10", "moderate", 4),
         "Battle2": PaperRow(Summary(113.0, 156.0, 134.0, 18.0), "1, 15", "high", 3)}


@dataclasses.dataclass
class Islands:
    """Of a scene, over the measured frames of a run."""
    scene: str
    islands: Summary  # at the end of a frame, over all worlds
    spaces: int  # over all worlds
    crossing: float | None  # contact points between spaces a step, mean; None unless the run recorded islands


def of_all_worlds(run, name):
    """Sums of a column of worlds in the measured frames."""
    return run.frames(name)[run.measured].sum(axis=1)


def islands_of(run):
    has_profile = run.has("timings/island") and run.num_frames > 0
    crossing = summarize(of_all_worlds(run, "timings/space/cross_contacts")).mean if has_profile else None
    spaces = run.num_worlds * max(1, int(run.number("num_spaces", 0)))
    return Islands(run.scene, summarize(of_all_worlds(run, "observables/world/islands")), spaces, crossing)


STATISTICS = ("max", "min", "mean", "stddev")


def numbers_of(summary):
    return {name: getattr(summary, name) for name in STATISTICS}


def relative(ours, papers):
    """None where the paper's number is 0 and ours is not."""
    if papers == 0:
        return 0 if ours == 0 else None
    return (ours - papers) / papers


def differences(one):
    paper = PAPER[one.scene].islands
    return {name: relative(getattr(one.islands, name), getattr(paper, name)) for name in STATISTICS}


def counts(summary):
    return [f"{summary.max:.0f}", f"{summary.min:.0f}", f"{summary.mean:.1f}", f"{summary.stddev:.2f}"]


def rows_of(one):
    """Rows of the table: ours, the paper's, and how far apart they are."""
    crossing = "not recorded" if one.crossing is None else f"{one.crossing:.1f} contacts"
    rows = [[one.scene, "ours", *counts(one.islands), str(one.spaces), crossing]]
    if one.scene in PAPER:
        paper = PAPER[one.scene]
        apart = ["-" if share is None else f"{100 * share:+.0f} %" for share in differences(one).values()]
        rows += [["", "paper", *counts(paper.islands), paper.spaces, paper.traffic], ["", "difference", *apart, "", ""]]
    return rows


def json_of(one):
    """Paper and relative difference are null where the paper lacks the scene."""
    found = {"scene": one.scene, "islands": numbers_of(one.islands), "spaces": one.spaces, "cross_space_contacts_per_step": one.crossing,
             "paper": None, "relative_difference": None}
    if one.scene in PAPER:
        paper = PAPER[one.scene]
        found["paper"] = numbers_of(paper.islands) | {"spaces": paper.spaces, "traffic": paper.traffic}
        found["relative_difference"] = differences(one)
    return found


def report_of(found):
    header = ["scene", "islands", "max", "min", "mean", "dev", "spaces", "across spaces"]
    table = Table("", header, [row for one in found for row in rows_of(one)])
    return Report("Islands", "", [Section(tables=[table])], [json_of(one) for one in found])
