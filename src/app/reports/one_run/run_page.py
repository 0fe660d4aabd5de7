"""The page of one run: its facts, plots over its frames, and a replay of its bodies (web/page.html).

pbreport has checked the run's file, and computes the summary: the document of pbreport --json. Arrays are in base64, numbers
little-endian and in single precision, but for indices."""
import base64
import html
import json

import numpy as np

from reports import page
from reports.files import write_file
from reports.one_run.rigid import norm
from reports.runs import PHASES, Run
from reports.samples import total
from reports.words import number

MOST_POINTS = 2000  # of a plot; more frames than this are drawn in bins of several frames
MOST_POSE_BYTES = 28_000_000  # of the poses in a page, the rest of which takes about 1.5 MB
PREFERRED_RECORDS = 600  # more frames than this, 20 s at 30 Hz, are left out before worlds are
THREE_POSES_BYTES = 7 * 4 * 4  # seven single-precision numbers each; three bytes are four characters in base64
KINDS = ("ground", "ramp", "wall", "car", "tank", "human", "centipede", "projectile", "prop")  # of actors, as the legend has them
MM = 1e3


def packed(values, kind="f4"):
    """`kind`: numpy's, e.g. i4."""
    return base64.b64encode(np.asarray(values, f"<{kind}").tobytes()).decode("ascii")


def counted(count, one, many):
    return f"{count:,} {one if count == 1 else many}"


def facts(summary):
    """[(label, value, note)] of the page's head."""
    sweeps = counted(summary["iterations"], "iteration", "iterations")
    if summary["substeps"] > 1:
        sweeps = counted(summary["substeps"], "substep", "substeps") + " of " + sweeps
    found = [("Size", counted(summary["bodies"], "body", "bodies"), "in " + counted(summary["worlds"], "world", "worlds")),
             ("Ranks", f"{summary['ranks']:,}", "on " + counted(len(summary["hosts"]), "host", "hosts")),
             ("Stepper", summary["stepper"], f"{sweeps}, dt {1e3 * summary['dt']:g} ms")]
    if summary["frames"]["measured"] == 0:
        return [*found, ("Frame rate", "not measured", "the run ended in its warm-up")]
    found += facts_of_speed(summary)
    estimate = summary.get("estimate")
    if estimate:
        found.append(("Estimate", number(estimate["delivered_s"]["p50"], ".2f", 1e3) + " ms",
                      f"delivered; precise {number(estimate['precise_over_delivered'], '.1f')} × later, rms off "
                      f"{number(estimate['position_defect_m']['rms'], '.1f', MM)} mm"))
    invariants = summary["invariants"]
    found.append(("Invariants", number(invariants["max_joint_gap_m"], ".2f", MM) + " mm",
                  f"joint gap; penetration {number(invariants['max_penetration_m'], '.2f', MM)} mm"))
    return found


def facts_of_speed(summary):
    rate, time_s, efficiency = summary["frame_rate"], summary["frame_time_s"], summary["efficiency"]
    return [("Frame rate", number(rate["harmonic_mean_hz"], ".0f") + " Hz",
             "harmonic mean of " + counted(summary["frames"]["measured"], "frame", "frames")),
            ("Within budget", number(rate["satisfied_fraction"], ".0f", 100) + " %", f"of frames in {number(rate['budget_s'], '.2f', 1e3)} ms"),
            ("Frame time", number(time_s["p50"], ".2f", 1e3) + " ms",
             f"median; p99 {number(time_s['p99'], '.2f', 1e3)}, max {number(time_s['max'], '.2f', 1e3)}"),
            ("Efficiency", number(efficiency["parallel"], ".0f", 100) + " %",
             f"balance {number(efficiency['load_balance'], '.0f', 100)} % × comm. {number(efficiency['communication'], '.0f', 100)} %")]


def event_lines(run):
    """"frame 12: rebalance: 3 worlds moved", and how many more there were."""
    attributes = run.file["events"].attrs
    count = int(attributes["num_events"])
    columns = [run.column(f"events/{name}")[:count] for name in ("frame", "kind", "detail")]
    lines = [f"frame {frame}: {kind}: {detail}" for frame, kind, detail in zip(*columns)]
    more = int(attributes.get("num_dropped", 0))  # older files do not count them
    return lines + ([f"and {more} more, for which the file has no room"] if more else [])


def about(run, summary):
    shown = [dict(zip(("label", "value", "note"), fact)) for fact in facts(summary)]
    return {"scene": run.scene or "run", "complete": run.complete, "frames_committed": run.num_frames, "attributes": run.attributes,
            "events": event_lines(run), "facts": shown}


def bins(values, per_bin):
    """Yields the rows of each bin of `per_bin` frames; the last bin may have fewer."""
    for first in range(0, len(values), per_bin):
        yield values[first:first + per_bin]


def band(worlds, per_bin, scale=1):
    """A column [T][W] over the frames, as lists [bins]: the sum over the worlds, and the smallest, mean and largest value of a world. A
    bin of several frames has the smallest `min`, the largest `max`, and the means of the others."""
    sums = total(worlds.T)
    columns = {"sum": (sums, mean_of), "min": (np.fmin.reduce(worlds, 1), np.fmin.reduce),
               "mean": (sums / worlds.shape[1], mean_of), "max": (np.fmax.reduce(worlds, 1), np.fmax.reduce)}
    return {name: [float(join(rows)) * scale for rows in bins(values, per_bin)] for name, (values, join) in columns.items()}


def mean_of(values):
    return total(values) / len(values)


def observable(run, name, per_bin, scale=1):
    """The band of a column of /observables/world, for one of vectors that of their lengths; None: an older run, which has it not."""
    path = f"observables/world/{name}"
    if not run.has(path):
        return None
    values = run.frames(path).astype(float)
    if values.size == run.num_frames * run.num_worlds * 3:
        values = norm(values.reshape(run.num_frames, run.num_worlds, 3))
    return band(values, per_bin, scale)


def phases(run):
    """[{name, mean_ms [R]}] over the measured frames, or over all if none is measured, in the order of the step; those in which no rank
    spent any time are left out."""
    shown = run.measured if run.measured.any() else np.ones(run.num_frames, bool)
    found = []
    for name in PHASES:
        mean_ms = total(1e3 * run.frames(f"timings/rank/{name}")[shown]) / max(1, np.count_nonzero(shown))
        if mean_ms.any():
            found.append({"name": name, "mean_ms": mean_ms.tolist()})
    return found


def plots(run, budget_s):
    """For web/plots.js."""
    per_bin = max(1, -(-run.num_frames // MOST_POINTS))
    wall_s = run.frames("timings/frame/wall")
    found = {"num_frames": run.num_frames, "first_frame": run.first_frame, "per_bin": per_bin, "budget_ms": 1e3 * budget_s,
             "wall_ms": [1e3 * float(rows.max()) for rows in bins(wall_s, per_bin)],  # a spike must not vanish in a mean
             "num_warmup": int(np.argmax(run.measured)) if run.measured.any() else run.num_frames,
             "phases": phases(run), "hosts": run.hosts, "num_worlds": run.num_worlds, "num_ranks": run.num_ranks}
    found |= {name: observable(run, name, per_bin)
              for name in ("islands", "contacts", "energy", "linear_momentum", "angular_momentum")}
    return found | {f"{name}_mm": observable(run, name, per_bin, MM) for name in ("joint_gap", "max_penetration")}


def every_kth(count, k):
    """Every k-th of `count` records, the last one among them."""
    return range((count + k - 1) % k, count, k)


def at_most(count, most):
    """At most `most` of `count` records, as many as a fixed stride allows."""
    return every_kth(count, max(1, -(-count // max(1, most))))


class Selection:
    """The part of a run that fits into a page: worlds 0 .. num_worlds - 1, which have bodies 0 .. num_bodies - 1, in a range of its P
    `records`, the last one among them. All, if they fit; else at most PREFERRED_RECORDS frames of as many worlds as fit; else fewer
    frames of world 0. `note`: what was left out and why."""

    def __init__(self, run, most_bytes=MOST_POSE_BYTES):
        self._world, self._most_poses = run.column("particles/bodies/world"), 3 * most_bytes // THREE_POSES_BYTES
        self.records = every_kth(run.num_recorded, 1)
        self._take_worlds(run.num_worlds)
        if not self._fits():
            self.records = at_most(run.num_recorded, PREFERRED_RECORDS)
            while self.num_worlds > 1 and not self._fits():
                self._take_worlds(self.num_worlds - 1)
            if not self._fits():
                self.records = at_most(run.num_recorded, self._most_poses // self.num_bodies - 1)
        self.note = self._left_out(run)

    def _take_worlds(self, count):
        self.num_worlds, self.num_bodies = count, int(np.searchsorted(self._world, count))  # bodies are in the order of worlds

    def _fits(self):
        return self.num_bodies * (len(self.records) + 1) <= self._most_poses  # the initial pose is one more frame

    def _left_out(self, run):
        parts = []
        if self.num_worlds < run.num_worlds:
            parts.append(f"the first {self.num_worlds} of {run.num_worlds} worlds")
        if len(self.records) < run.num_recorded:
            parts.append(f"{len(self.records)} of {run.num_recorded} recorded frames")
        return f"To keep this page small, the replay shows {' and '.join(parts)}. The run's file holds all." if parts else ""

    def rows(self):
        return slice(self.records.start, self.records.stop, self.records.step)


def poses(run, chosen, name):
    """[1 + records][num_bodies][...]: position [m] or orientation (w, x, y, z), first the initial one."""
    initial = run.column(f"particles/bodies/initial_{name}")[:chosen.num_bodies]
    recorded = run.recorded(f"particles/bodies/{name}/value", chosen.rows())[:, :chosen.num_bodies]
    return np.concatenate([initial[None], recorded])


def hulls(run, shown):
    """The hull of each of these geoms, as an index into a list of triangles; -1 = none. Nothing for a run without hulls."""
    if not run.has("hulls/corners"):
        return {}
    owner, corners, of_geom = (run.column(name)[:] for name in ("hulls/geom", "hulls/corners", "geoms/hull"))
    of_geom = of_geom[shown]
    used = [int(geom) for geom in np.unique(of_geom) if geom >= 0]
    return {"hull": packed([used.index(geom) if geom >= 0 else -1 for geom in of_geom], "i4"),
            "hulls": [packed(corners[owner == geom]) for geom in used]}


def geoms(run, num_worlds):
    """Names of shapes and columns of the geoms of the first worlds. An unknown kind, of a file of a newer minor version, counts as prop; the
    page does not draw a geom of an unknown shape."""
    shown = np.flatnonzero(run.column("geoms/world") < num_worlds)
    kind, shape = ([texts[geom] for geom in shown] for texts in (run.column("geoms/kind"), run.column("geoms/shape")))
    world, body, size, position, orientation = (run.column(f"geoms/{name}")[shown] for name in ("world", "body", "size", "position", "orientation"))
    shapes = list(dict.fromkeys(shape))
    return shapes, {**hulls(run, shown), "kind": packed([KINDS.index(name if name in KINDS else "prop") for name in kind], "u1"),
                    "shape": packed([shapes.index(name) for name in shape], "u1"), "world": packed(world, "i4"), "body": packed(body, "i4"),
                    "size": packed(size), "local": packed(np.concatenate([position, orientation], 1))}


def replay(run, chosen):
    """For web/data.js. Frames are numbered from the start of the simulation, whose pose is that of frame 0."""
    times, steps = (run.recorded(f"particles/bodies/position/{name}", chosen.rows()).tolist() for name in ("time", "step"))
    shapes, columns = geoms(run, chosen.num_worlds)
    return {"note": chosen.note, "num_worlds": chosen.num_worlds, "num_bodies": chosen.num_bodies,
            "body_names": run.column("particles/bodies/name")[:chosen.num_bodies],
            "body_world": packed(run.column("particles/bodies/world")[:chosen.num_bodies], "i4"), "time_s": [0, *times], "step": [0, *steps],
            "number": [0, *(run.first_frame + run.record_every * (record + 1) for record in chosen.records)],
            "position": packed(poses(run, chosen, "position")), "orientation": packed(poses(run, chosen, "orientation")),
            "geoms": columns, "kind_names": KINDS, "shape_names": shapes}


def text_of(run, summary, most_bytes=MOST_POSE_BYTES):
    blocks = {"about": about(run, summary), "plots": plots(run, summary["frame_rate"]["budget_s"]),
              "replay": replay(run, Selection(run, most_bytes)),
              "provenance": {"line": page.joined(page.origin(run.attributes), f"page by {page.version_line()}"),
                             "entries": [*run.attributes.items(), *run.parameters.items()]}}
    fields = {name: page.safe_json(block) for name, block in blocks.items()}
    return page.fill("page_html", fields | {"drawn_with": "three.js and Chart.js", "title": html.escape(run.scene or "run", quote=True)})


def run(words):
    """`words`: the run's file, the page, and a file with the summary."""
    path, output, summary = words
    with open(summary, encoding="utf-8") as stream:
        write_file(output, text_of(Run(path), json.load(stream)))
