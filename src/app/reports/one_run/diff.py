"""pbreport diff: how far two recorded runs of the same bodies are apart."""
import dataclasses
import math

import numpy as np

from reports import charts, errors, page
from reports.command_line import Command, Listed, deliver, parse
from reports.document import PAGE, Chart, Report, Section, Table
from reports.files import require
from reports.one_run.error_sets import CONSTRAINTS, ORIENTATION_BANDS, POSITION_BANDS, constraints_of, pose_errors
from reports.one_run.recorded import RecordedRun, require_comparable

# Harrison, Rensink and van de Panne (SIGGRAPH 2004): with full attention 3 % can be seen; without it more than 20 % can go unnoticed.
STRETCH_BANDS, STRETCH_EDGES = ("< 3 %", "3-20 %", "> 20 %", "inf/NaN"), (0.03, 0.20)
MOST_POINTS, MOST_ACTORS = 2000, 40  # of a chart, of a table on the page


def add_options(group):
    group.add_argument("--floor", nargs="+", action=Listed, default=[], metavar="FILE", help="the noise floor: runs like REFERENCE in all but "
                       "--solver-seed")


COMMAND = Command("diff", "Shows how far two recorded runs of the same bodies are apart: drift, along the trajectory, over the measured frames; "
                  "where RUN has estimates (FEEC), their defect too.", "RUN.h5 REFERENCE.h5 [options]",
                  page="errors and constraints as curves over the frames", add_options=add_options,
                  examples=("pbreport diff iter19.h5 iter20.h5", "pbreport diff iter19.h5 iter20.h5 --floor seed2.h5 seed3.h5 --json"))


@dataclasses.dataclass
class Invariants:
    """Of a run's measured frames."""
    max_penetration_m: float
    max_joint_gap_m: float
    energy_first_j: float
    energy_last_j: float
    stretch: list  # of segments of humans, in STRETCH_BANDS
    max_stretch: float  # the largest of the finite ones

    def json(self):
        return {name: getattr(self, name) for name in ("max_penetration_m", "max_joint_gap_m", "energy_first_j", "energy_last_j")} | {
            "stretch": {"max": self.max_stretch, "bands": self.stretch}}


def invariants_of(run):
    parts = [run.segments.stretch(run.poses(row), run.held(row)) for row in run.measured_rows(run.num_recorded)]
    stretch = np.concatenate([np.zeros(0), *parts])
    largest = {name: float(np.fmax.reduce(run.joined(name)[run.measured], initial=0.0)) for name in ("max_penetration", "joint_gap")}
    energy = run.joined("energy").tolist() or [0.0]
    return Invariants(largest["max_penetration"], largest["joint_gap"], energy[0], energy[-1], stretch_bands(stretch),
                      float(stretch[np.isfinite(stretch)].max(initial=0.0)))


def stretch_bands(stretch):
    finite = stretch[np.isfinite(stretch)]
    return [*np.bincount(np.searchsorted(STRETCH_EDGES, finite, "right"), minlength=3).tolist(), len(stretch) - len(finite)]


class Comparison:
    """A run against a reference, over the frames that both recorded and the reference measured, with other samples of the reference."""

    def __init__(self, run, reference, floor):
        self.run, self.reference = run, reference
        self.rows = self._rows(run)
        frames = pose_errors(run, reference, self.rows)
        self.drift = frames.summary()
        self.by_frame = [frames.summary([place]) for place in range(len(self.rows))]
        self.actors, of_body = reference.actors()
        of_joint = of_body[reference.joints.body_a]
        self.by_actor = [frames.summary(bodies=np.flatnonzero(of_body == actor), joints=np.flatnonzero(of_joint == actor))
                         for actor in range(len(self.actors))]
        self.defect = self.estimate_drift = None
        if run.has("estimate") and run.num_recorded > 0:
            own_rows = run.measured_rows(run.num_recorded)
            self.defect = pose_errors(run, run, own_rows, "estimate").summary()
            self.estimate_drift = pose_errors(run, reference, self.rows, "estimate").summary()
        self.floor = [pose_errors(other, reference, self._rows(other)).summary() for other in floor]
        self.invariants = [invariants_of(one) for one in (run, reference)]
        self.constraints = {"run": constraints_of(run, self.rows), "reference": constraints_of(reference, self.rows)}
        self.broken = compare_breaks(run, reference)
        self.same_hash = run.attributes.get("state_hash", "") == reference.attributes.get("state_hash", "")

    def _rows(self, run):
        return self.reference.measured_rows(min(run.num_recorded, self.reference.num_recorded))


def compare_breaks(run, reference):
    """As in the document's joints_broken."""
    num_frames = min(run.num_frames, reference.num_frames)
    known = [one.broken_joints() for one in (run, reference)]
    in_run, in_reference = ([event for event in events if event["frame"] < one.first_frame + num_frames]
                            for one, events in zip((run, reference), known))
    unknown = [one.num_events("joint_broken") - len(events) for one, events in zip((run, reference), known)]
    in_run_only, in_reference_only = missing(in_reference, in_run), missing(in_run, in_reference)
    return {"in_both": len(in_run) - len(in_run_only), "in_run_only": in_run_only, "in_reference_only": in_reference_only,
            "unknown_in_run": unknown[0], "unknown_in_reference": unknown[1]}


def missing(others, events):
    names = {event["joint_name"] for event in others}
    return [{"joint": event["joint_name"], "step": event["step"]} for event in events if event["joint_name"] not in names]


def error_json(found):
    return {"count": found.count, **found.json(), "broken": found.broken}


def table_json(table):
    return {f"{kind}_{unit}": error_json(table[kind]) for kind, unit in errors.KINDS.items()}


def constraints_json(found):
    def of(table):
        return {f"{kind}_{unit}": error_json(table[kind]) for kind, unit in CONSTRAINTS.items() if kind in table}

    return of(found.all) | {"passages": found.passages, "by_frame": list(map(of, found.by_frame)), "by_actor": list(map(of, found.by_actor))}


def json_of(c):
    estimates = {name: table_json(table) for name, table in (("estimate_defect", c.defect), ("estimate_drift", c.estimate_drift)) if table}
    by_actor = [{"world": world, "actor": name, "kind": kind} | table_json(table) for (world, name, kind), table in zip(c.actors, c.by_actor)]
    return {"run": c.run.path, "reference": c.reference.path, "same_state_hash": c.same_hash, "frames": len(c.rows),
            "steps": c.reference.recorded_step[c.rows].tolist(),
            "position_bands": POSITION_BANDS, "orientation_bands": ORIENTATION_BANDS, "drift": table_json(c.drift),
            "drift_by_frame": [table_json(table) for table in c.by_frame], **estimates, "drift_by_actor": by_actor,
            "noise_floor": [table_json(table) for table in c.floor],
            "invariants": dict(zip(("run", "reference"), (one.json() for one in c.invariants))),
            "constraints": {whose: constraints_json(found) for whose, found in c.constraints.items()}, "joints_broken": c.broken}


def bands_text(counts, names):
    return ", ".join(f"{count} {name}" for count, name in zip(counts, names))


def error_line(what, kind, unit, found):
    bands = bands_text(found.bands, POSITION_BANDS if unit == "m" else ORIENTATION_BANDS)
    broken = f", {found.broken} broken" if found.broken > 0 else ""
    return f"{what} {kind:<17} rms {found.rms:10.4g}  p99 {found.p99:10.4g}  max {found.max:10.4g} {unit:<3}  ({bands}{broken})\n"


def errors_text(what, table):
    return "".join(error_line(what, kind, unit, table[kind]) for kind, unit in errors.KINDS.items()) if table else ""


def floor_text(c):
    text = "" if c.floor else "noise_floor: unknown; name runs that differ from the reference in --solver-seed with --floor\n"
    for kind, unit in errors.KINDS.items() if c.floor else ():
        rms, largest = ([getattr(table[kind], number) for table in c.floor] for number in ("rms", "max"))
        verdict = "above it" if c.drift[kind].rms > max(rms) else "inside it and proves nothing"
        text += (f"noise_floor: {kind:<11} rms {min(rms):.4g} to {max(rms):.4g}, max {min(largest):.4g} to {max(largest):.4g} {unit} over "
                 f"{len(c.floor)} seeds: the drift is {verdict}\n")
    return text


def invariants_text(whose, kept):
    return (f"{whose}: penetration {1e3 * kept.max_penetration_m:.2f} mm, joint gap {1e3 * kept.max_joint_gap_m:.2f} mm, energy "
            f"{kept.energy_first_j:.1f} J to {kept.energy_last_j:.1f} J, stretch of human segments max {100 * kept.max_stretch:.2f} % "
            f"({bands_text(kept.stretch, STRETCH_BANDS)})\n")


def constraints_text(whose, found):
    text = "".join(error_line(f"constraints of the {whose}:", kind, unit, found.all[kind]) for kind, unit in CONSTRAINTS.items() if kind in found.all)
    return text + (f"constraints of the {whose}: {found.passages} bodies went through something\n" if found.passages > 0 else "")


def breaks_text(broken):
    """Empty if no joint broke."""
    only = [(whose, one) for whose in ("run", "reference") for one in broken[f"in_{whose}_only"]]
    unknown = ""
    if broken["unknown_in_run"] + broken["unknown_in_reference"] > 0:
        unknown = (f"joints_broken: {broken['unknown_in_run']} more in the run and {broken['unknown_in_reference']} in the reference, of which the "
                   "files do not say which they are\n")
    if broken["in_both"] == 0 and not only:
        return unknown
    lines = [f"joints_broken: in the {whose} only: {one['joint']} in step {one['step']}\n" for whose, one in only]
    return f"joints_broken: {broken['in_both']} in both, {len(only)} in one of the two\n{unknown}{''.join(lines)}"


def text_of(c):
    head = (f"run: {c.run.path}\nreference: {c.reference.path}\nframes: {len(c.rows)} measured\n"
            f"state_hash: {'equal' if c.same_hash else 'different'}\n")
    head += errors_text("drift:", c.drift) + errors_text("estimate_defect:", c.defect) + errors_text("estimate_drift:", c.estimate_drift)
    head += floor_text(c) + "".join(map(invariants_text, ("run", "reference"), c.invariants))
    return head + "".join(constraints_text(*one) for one in c.constraints.items()) + breaks_text(c.broken)


def frames_a_point(c):
    """More frames than fit are drawn in bins, by the bin's largest value."""
    return max(1, math.ceil(len(c.rows) / MOST_POINTS))


def chart_of(c, title, text, unit, lines):
    """`lines`: [(label, colour, is_dashed, a number for each frame)]."""
    per_point = frames_a_point(c)
    labels = [f"{time:.4g}" for time in c.reference.recorded_time[c.rows][::per_point]]
    datasets = [charts.line(label, [max(values[first:first + per_point]) for first in range(0, len(values), per_point)], colour,
                            borderWidth=1.5, pointRadius=0, **({"borderDash": [5, 4]} if is_dashed else {}))
                for label, colour, is_dashed, values in lines]
    scales = {"x": charts.axis("simulated time [s]"), "y": charts.axis(f"error [{unit}]")}
    return Chart(title, text, charts.chart("line", datasets, scales, labels))


def spoken(name):
    return name.replace("_", " ")


def drift_section(c):
    text = f"Drift along the trajectory, frame by frame, over the {len(c.rows)} measured frames that both have."
    text += f" A point is the largest of {frames_a_point(c)} frames." if frames_a_point(c) > 1 else ""
    found = [chart_of(c, spoken(kind), "Of all finite errors of the frame.", unit,
                      [("largest", charts.RED, False, [table[kind].max for table in c.by_frame]),
                       ("rms", charts.BLUE, False, [table[kind].rms for table in c.by_frame])]) for kind, unit in errors.KINDS.items()]
    return Section("How far the run is from the reference", text, found, shown_in=(PAGE,))


def constraint_section(c):
    found = []
    for kind, unit in CONSTRAINTS.items():
        lines = [line for (whose, of_run), colour in zip(c.constraints.items(), (charts.RED, charts.BLUE)) if kind in of_run.all and of_run.by_frame
                 for line in ((f"{whose}, largest", colour, False, [table[kind].max for table in of_run.by_frame]),
                              (f"{whose}, rms", colour, True, [table[kind].rms for table in of_run.by_frame]))]
        found += [chart_of(c, spoken(kind), "", unit, lines)] if lines else []
    return Section("How far each run is from its own constraints", "Joints that gape or are bent where they must not be; with --record contacts, of "
                   "the last step of each frame, how deep contacts are, and how far those slip that should stick.", found, shown_in=(PAGE,))


def actor_section(c):
    order = sorted(range(len(c.actors)), key=lambda actor: -c.by_actor[actor]["body_position"].rms)
    by_actor = c.constraints["run"].by_actor
    rows = []
    for actor in order[:MOST_ACTORS]:
        drift = c.by_actor[actor]["body_position"]
        own = [by_actor[actor].get(kind) for kind in CONSTRAINTS]
        rows.append([str(c.actors[actor][0]), c.actors[actor][1], f"{drift.rms:.3g}", f"{drift.max:.3g}",
                     *(f"{one.max:.3g}" if one and one.count else "" for one in own)])
    header = ["world", "actor", "drift rms [m]", "largest [m]", *(f"run's largest {spoken(kind)} [{unit}]" for kind, unit in CONSTRAINTS.items())]
    text = "Those that are farthest off first."
    if len(order) > MOST_ACTORS:
        text = f"The {MOST_ACTORS} of {len(order)} actors that are farthest off; --json has all."
    return Section("By actor", text, tables=[Table("Actors", header, rows)], shown_in=(PAGE,))


def report_of(c):
    line, entries = page.origin_of_runs([c.run, c.reference])
    return Report("Two runs compared", f"{c.run.path} against {c.reference.path}", [drift_section(c), constraint_section(c), actor_section(c)],
                  json_of(c), text_of(c), line, entries)


def run(words):
    options = parse(COMMAND, words)
    if options is None:
        return
    require(len(options.files) == 2, f"diff: {len(options.files)} files are given; it compares two, RUN and REFERENCE (those of --floor come last)")
    found, reference = map(RecordedRun, options.files)
    require_comparable(found, reference)
    floor = []
    for path in options.floor:
        floor.append(RecordedRun(path))
        require_comparable(floor[-1], reference)
        require(floor[-1].attributes.get("state_hash") != reference.attributes.get("state_hash"),
                f"{path}: it is the reference bit for bit and shows no noise; record it with another --solver-seed")
    deliver(report_of(Comparison(found, reference, floor)), options)
