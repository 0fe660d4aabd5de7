"""pbreport ensemble: mean, spread and quantiles over runs of one scene that differ in their seeds, or over their worlds."""
import dataclasses

import numpy as np

from reports import runs as run_files
from reports import page, tables
from reports.command_line import Command, Listed, add_table_option, deliver, parse, require_table
from reports.document import MARKDOWN, PAGE, TEXT, Report, Section, Table
from reports.files import require
from reports.runs import OBSERVABLES, difference_text, differences
from reports.one_run.run_tables import RunTables
from reports.samples import quantile, total
from reports.study import ensemble_charts
from reports.tables import Values

TABLES = ("runs", "frames", "positions", "bodies", "worlds")
RUNS, WORLDS = "runs", "worlds"  # what a sample is: a run with its worlds joined, or each world of each run
# Worlds are joined by their sum, or by the largest.
VECTORS = ("linear_momentum", "angular_momentum")
LARGEST = ("max_island_rows", "max_penetration", "joint_gap")
AXES = "xyz"
RESULTS = ("cost", "nonfinite_step", "row_visits", "survived")  # columns of /world_results that the table worlds takes over


def add_options(group):
    group.add_argument("--over", default=RUNS, metavar="runs|worlds",
                       help="what a sample is: a run, its worlds taken together, or each world of each run; default: runs")
    group.add_argument("--quantiles", nargs="+", action=Listed, type=float, default=[0.05, 0.25, 0.5, 0.75, 0.95], metavar="Q",
                       help="from 0 to 1; default: 0.05 0.25 0.5 0.75 0.95")
    group.add_argument("--allow", nargs="+", action=Listed, default=[], metavar="NAME",
                       help="parameters that may differ beside seed and solver_seed, e.g. iterations")
    add_table_option(group, TABLES, "frames")


COMMAND = Command("ensemble", "Compares runs of one scene that differ in --seed or --solver-seed: mean, spread and quantiles of "
                  "observables and positions frame by frame, contacts and times of each world. Runs that differ in what decides over their "
                  "results are refused.",
                  "RUN.h5... [options]", page="results of worlds over their parameters, and the spread over the frames",
                  markdown="print the summary as a table in Markdown", csv="one table as comma-separated values",
                  add_options=add_options)


class Member(RunTables):
    """A run of an ensemble. world_id: [W], numbers in the ensemble."""

    def __init__(self, path):
        super().__init__(path)
        self.world_id = self.column("worlds/id") if self.has("worlds/id") else np.arange(self.num_worlds)
        fit = len(self.body_name) == len(self.actor) == len(self.kind) == len(self.body_world) and len(self.world_id) == self.num_worlds
        self._require(fit and all(0 <= world < self.num_worlds for world in self.body_world), "its bodies and worlds do not fit together")

    def rows(self, values, *items):
        """[rows][items]... as floats, if it has this shape."""
        self._require(values.shape[1:] == items and values.dtype.kind in "iuf", "a column does not have as many items a row as the run")
        return values.astype(float)

    def of_worlds(self, name):
        """[W] of a column that the run has once, a row a world: texts as a list."""
        values = self.column(name)[:self.num_worlds]
        self._require(len(values) == self.num_worlds, f"/{name} does not have a row a world")
        return values

    def observable(self, name, frames):
        """[frames][W], or [frames][W][3]; None in a file of an older layout."""
        if not self.has(f"observables/world/{name}"):
            return None
        items = (self.num_worlds, 3) if name in VECTORS else (self.num_worlds,)
        return self.rows(self.frames(f"observables/world/{name}", slice(frames)), *items)

    def wall_s(self):
        """[T]"""
        return self.rows(self.frames("timings/frame/wall"))

    def seeds(self):
        of_worlds = f", worlds {self.parameter('world_range')}" if self.parameter("world_range") else ""
        return f"seed {self.parameter('seed')}, solver_seed {self.parameter('solver_seed')}{of_worlds}"

    def hash(self):
        """Empty for a run that was cut off."""
        return self.attributes.get("state_hash", "").strip()


@dataclasses.dataclass
class Ensemble:
    """Runs that are samples of the same. num_frames: that all runs have; differences: sentences on what differs beside the seeds."""
    runs: list
    over: str
    quantiles: list
    num_frames: int
    differences: list

    @property
    def first(self):
        return self.runs[0]

    @property
    def num_bodies(self):
        """Of a sample: of all worlds, or of one."""
        return len(self.first.body_name) // (self.first.num_worlds if self.over == WORLDS else 1)

    @property
    def num_samples(self):
        return sum(run.num_worlds if self.over == WORLDS else 1 for run in self.runs)

    def recorded(self):
        """Indices of the frames in which bodies were recorded."""
        every = self.first.record_every
        return np.arange(self.num_frames // every) * every + every - 1


def bodies_of_a_world(run):
    return run.body_name[:len(run.body_name) // run.num_worlds]


def require_comparable(first, run, options):
    both = f"{first.path} and {run.path}"
    apart = [one for one in differences(first, run, run_files.RESULTS) if one[0] not in options.allow]
    require(not apart, f"{both} are not of one ensemble: {difference_text(apart[0], first, run) if apart else ''}; leave one out, or allow "
                       f"what differs (--allow {' '.join(name for name, *_ in apart)})")
    # Worlds are compared one by one, so runs may have different numbers of them: parts of an ensemble.
    same_bodies = (bodies_of_a_world(first) == bodies_of_a_world(run) if options.over == WORLDS
                   else first.body_name == run.body_name and np.array_equal(first.body_world, run.body_world))
    require(same_bodies, f"{both} do not have the same bodies; compare runs of one scene with as many worlds")
    require(first.record_every == run.record_every, f"{both}: one has recorded every {first.record_every} frames, the other every "
                                                    f"{run.record_every}; give all the same --record-every")
    frames = min(first.num_frames, run.num_frames)
    require(frames > 0, f"{both}: one of them has no frame")
    same = ((first.frame_number[:frames] == run.frame_number[:frames]) & (first.measured[:frames] == run.measured[:frames])
            & (abs(first.time[:frames] - run.time[:frames]) <= 1e-9))  # times are step x dt, so another dt rounds differently
    require(same.all(), f"{both}: frame {first.frame_number[same.argmin()]} is not at the same time in both, or is warm-up in one; give all the "
                        "same frame length, warm-up and start")


def require_new_sample(run, others):
    for other in others:
        require(differences(other, run, run_files.RESULTS) or other.seeds() != run.seeds(),
                f"{other.path} and {run.path} are the same sample ({run.seeds()}), which would count twice; leave one out")


def require_equal_worlds(run):
    require(run.body_name == bodies_of_a_world(run) * run.num_worlds,
            f"{run.path}: its worlds do not have the same bodies; leave out --over worlds")


def ensemble_of(options):
    runs = [Member(path) for path in options.files]
    first = runs[0]
    require(first.num_frames > 0, f"{first.path}: it has no frame")
    told = []
    for place, run in enumerate(runs[1:], 1):
        require_comparable(first, run, options)
        require_new_sample(run, runs[:place])
        for matters in (run_files.RESULTS, run_files.ESTIMATE, run_files.NOTHING):
            told += [difference_text(one, first, run) for one in differences(first, run, matters) if not one[0].startswith("env_")]
    if options.over == WORLDS:
        for run in runs:
            require_equal_worlds(run)
    return Ensemble(runs, options.over, sorted(set(options.quantiles)), min(run.num_frames for run in runs), told)


def quantile_name(q):
    return f"q{100 * q:.12g}"


def spread_of(samples, quantiles):
    """{name: array [...]} of samples [S][...]: count, nonfinite, and of the finite ones mean, stddev (the sample's, divided by count - 1),
    min, quantiles (linear between order statistics), max. NaN with too few of them."""
    finite = np.isfinite(samples)
    count = finite.sum(axis=0)
    ordered = np.sort(np.where(finite, samples, np.nan), axis=0, kind="stable")  # NaN at the end, and one more for none
    ordered = np.concatenate([ordered, np.full((1, *samples.shape[1:]), np.nan)])
    last = np.maximum(count - 1, 0)

    def at(place):
        return np.take_along_axis(ordered, place[None], axis=0)[0]

    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        mean = (total(np.where(finite, samples, 0.0)) + 0.0) / count  # + 0.0: no minus before a zero
        squares = total(np.where(finite, (samples - mean) ** 2, 0.0))
        stddev = np.where(count > 1, np.sqrt(squares / count) * np.sqrt(count / (count - 1)), np.nan)
    found = {"count": count, "nonfinite": len(samples) - count, "mean": mean, "stddev": stddev, "min": ordered[0]}
    for q in quantiles:
        low = (q * last).astype(int)
        found[quantile_name(q)] = at(low) + (q * last - low) * (at(np.minimum(low + 1, last)) - at(low))
    return found | {"max": at(last)}


def by_row(spreads):
    """Spreads of arrays [rows] as one, in which the first of each row are followed by the second of each."""
    return {name: np.stack([spread[name] for spread in spreads], axis=-1).ravel() for name in spreads[0]}


def spread_columns(spread, unit="", prefix=""):
    return [Values(prefix + name, "" if name in ("count", "nonfinite") else unit, values) for name, values in spread.items()]


def frame_columns(run, frames):
    """`frames`: the index of each row's."""
    return [Values("frame", "", run.frame_number[frames]), Values("step", "", run.step[frames]), Values("time", "s", run.time[frames]),
            Values("measured", "", run.measured[frames].astype(int))]


def join_worlds(name, values):
    """[frames][W]... of a run as [frames]..."""
    if name in LARGEST:
        return np.fmax.reduce(values, axis=1, initial=0.0)
    return total(np.moveaxis(values, 1, 0)) + 0.0


def samples_of(ensemble, name):
    """[S][frames]... of an observable."""
    found = []
    for run in ensemble.runs:
        values = run.observable(name, ensemble.num_frames)
        if values is not None:
            found.append(np.moveaxis(values, 1, 0) if ensemble.over == WORLDS else join_worlds(name, values)[None])
    return np.concatenate(found) if found else np.zeros((0, ensemble.num_frames, 3)[:3 if name in VECTORS else 2])


def spread_by_frame(ensemble):
    """{quantity: (unit, spread [frames])}: the observables of worlds, vectors by their components, and over runs the times of frames."""
    found = {}
    for name, unit in OBSERVABLES.items():
        samples = samples_of(ensemble, name)
        parts = [(f"{name}_{axis}", samples[..., place]) for place, axis in enumerate(AXES)] if name in VECTORS else [(name, samples)]
        found.update((part, (unit, spread_of(values, ensemble.quantiles))) for part, values in parts)
    if ensemble.over == RUNS:
        found["wall"] = ("s", spread_of(np.array([run.wall_s()[:ensemble.num_frames] for run in ensemble.runs]), ensemble.quantiles))
    return found


def frames_table(ensemble, quantities):
    frames = np.repeat(np.arange(ensemble.num_frames), len(quantities))
    return [*frame_columns(ensemble.first, frames), Values("quantity", "", list(quantities) * ensemble.num_frames),
            Values("unit", "", [unit for unit, _ in quantities.values()] * ensemble.num_frames),
            *spread_columns(by_row([spread for _, spread in quantities.values()]))]


class Bodies:
    """Positions of bodies in a frame [m], from samples [S][N][3]. mean: [N][3], of the finite samples; rms: [N], of their distances from
    it; distance: spread [N]. NaN where no sample is finite."""

    def __init__(self, samples, quantiles):
        finite = np.isfinite(samples).all(axis=-1)
        self.count = finite.sum(axis=0)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            self.mean = (total(np.where(finite[..., None], samples, 0.0)) + 0.0) / self.count[:, None]
            x, y, z = np.moveaxis(samples - self.mean, -1, 0)
            distance = np.where(finite, np.sqrt(x * x + (y * y + z * z)), np.nan)
            self.squares = total(np.where(finite, distance * distance, 0.0))
            self.rms = np.sqrt(self.squares / self.count)
        self.distance = spread_of(distance, quantiles)


def bodies_in(ensemble, row):
    """Bodies of a recorded frame."""
    found = []
    for run in ensemble.runs:
        values = run.rows(run.recorded("particles/bodies/position/value", slice(row, row + 1)), len(run.body_name), 3)
        found.append(values.reshape(run.num_worlds if ensemble.over == WORLDS else 1, ensemble.num_bodies, 3))
    return Bodies(np.concatenate(found), ensemble.quantiles)


def bodies_of_none(ensemble):
    return Bodies(np.zeros((0, ensemble.num_bodies, 3)), ensemble.quantiles)


def positions_table(ensemble, frames):
    """`frames`: Bodies of each recorded frame."""
    rms = np.array([one.rms for one in frames]).reshape(len(frames), ensemble.num_bodies)
    known = np.where(np.isfinite(rms), rms, -1.0)
    widest = np.where(known.max(axis=1, initial=-1.0) >= 0, known.argmax(axis=1) if ensemble.num_bodies else 0, -1)
    with np.errstate(invalid="ignore"):
        whole = [np.sqrt(total(one.squares) / one.count.sum()) for one in frames]
    return [*frame_columns(ensemble.first, ensemble.recorded()), Values("distance_rms", "m", np.array(whole)),
            *spread_columns(spread_of(rms.T, ensemble.quantiles), "m", "body_rms_"), Values("widest_body", "", widest),
            Values("widest_name", "", [ensemble.first.body_name[body] if body >= 0 else "" for body in widest])]


def bodies_table(ensemble, frames):
    """Over the measured frames, and in the last recorded one."""
    first = ensemble.first
    bodies, over_runs = np.arange(ensemble.num_bodies), ensemble.over == RUNS
    last = frames[-1] if frames else bodies_of_none(ensemble)
    measured = [one for one, frame in zip(frames, ensemble.recorded()) if first.measured[frame]]
    none = np.zeros((1, len(bodies)))
    squares, count, nonfinite, largest = (np.array([value(one) for one in measured]) if measured else none for value in (
        lambda one: one.squares, lambda one: one.count, lambda one: one.distance["nonfinite"], lambda one: one.distance["max"]))
    with np.errstate(invalid="ignore"):
        rms = np.sqrt(total(squares) / count.sum(axis=0))
    texts = {"name": first.body_name, "actor": first.actor, "kind": first.kind}
    return [Values("body", "", bodies), Values("world", "", first.body_world.astype(int) if over_runs else np.full(len(bodies), -1)),
            *(Values(name, "", values[:len(bodies)]) for name, values in texts.items()), Values("distance_rms", "m", rms),
            Values("distance_max", "m", np.fmax.reduce(largest, axis=0, initial=0.0)),
            Values("nonfinite", "", nonfinite.sum(axis=0).astype(int)),
            *(Values(f"last_mean_{axis}", "m", last.mean[:, place]) for place, axis in enumerate(AXES)),
            Values("last_distance_rms", "m", last.rms)]


def step_times(run, frames):
    """{column: [W] s of a step, mean}: collision detection, and a world's islands one after the other; NaN without --record islands."""
    found = dict.fromkeys(("collide_mean", "solve_mean"), np.full(run.num_worlds, np.nan))
    names = ("timings/space/collide", "timings/island/solve")
    if len(frames) > 0 and all(map(run.has, names)):
        collide, solve = (run.frames(name)[frames] for name in names)
        by_world = [np.bincount(run.body_world, weights=row, minlength=run.num_worlds) for row in run.rows(solve, len(run.body_name))]
        found = {"collide_mean": total(run.rows(collide, run.num_worlds)) / len(frames), "solve_mean": total(by_world) / len(frames)}
    return found


def facts_of_worlds(run, num_frames):
    """{column: [W]} over the measured frames."""
    frames = np.flatnonzero(run.measured[:num_frames])
    seen = {}
    for name in ("contacts", "rows", "islands", "energy", "max_penetration", "joint_gap"):
        values = run.observable(name, num_frames)
        seen[name] = np.zeros((0, run.num_worlds)) if values is None else values[frames]
    found = {}
    for name in ("contacts", "rows", "islands"):
        found[f"{name}_mean"] = total(seen[name]) / max(len(frames), 1)
        found[f"{name}_max"] = np.fmax.reduce(seen[name], axis=0, initial=0.0)
    del found["islands_max"]
    for name, place in (("energy_first", 0), ("energy_last", -1)):
        found[name] = seen["energy"][place] if len(seen["energy"]) else np.zeros(run.num_worlds)
    for name, of in (("penetration_max", "max_penetration"), ("joint_gap_max", "joint_gap")):
        found[name] = np.fmax.reduce(seen[of], axis=0, initial=0.0)
    return found | step_times(run, frames)


def columns_of_all(runs, group, names=None):
    """Columns that each run has once, a row a world: all of the group, or those in `names`, if all runs have them of one type."""
    found = []
    for name in sorted(runs[0].file.get(group, {})) if names is None else names:
        path = f"{group}/{name}"
        if all(run.has(path) for run in runs):
            parts = [run.of_worlds(path) for run in runs]
            if all(isinstance(part, list) for part in parts):
                found.append(Values(name, runs[0].unit(path), sum(parts, [])))
            elif not any(isinstance(part, list) for part in parts) and len({part.dtype.kind for part in parts}) == 1:
                found.append(Values(name, runs[0].unit(path), np.concatenate(parts)))
    return found


def worlds_table(ensemble):
    runs = ensemble.runs
    facts = [facts_of_worlds(run, ensemble.num_frames) for run in runs]
    units = {"energy": "J", "penetration": "m", "joint_gap": "m", "collide": "s", "solve": "s"}
    ended = all(run.has("world_results") and run.file["world_results"].attrs.get("num_worlds", 0) > 0 for run in runs)
    return [Values("run", "", np.repeat(np.arange(len(runs)), [run.num_worlds for run in runs])),
            Values("world", "", np.concatenate([run.world_id for run in runs])),
            *(Values(name, units.get(name.rpartition("_")[0], ""), np.concatenate([one[name] for one in facts])) for name in facts[0]),
            *(columns_of_all(runs, "world_results", RESULTS) if ended else []), *columns_of_all(runs, "world_parameters")]


def runs_table(ensemble):
    walls = [run.wall_s()[run.measured] for run in ensemble.runs]
    return tables.columns_of(
        list(zip(ensemble.runs, walls)), ("file", "", lambda row: row[0].path), ("seed", "", lambda row: row[0].parameter("seed")),
        ("solver_seed", "", lambda row: row[0].parameter("solver_seed")), ("state_hash", "", lambda row: row[0].hash()),
        ("complete", "", lambda row: int(row[0].complete)), ("frames", "", lambda row: row[0].num_frames),
        ("ranks", "", lambda row: row[0].num_ranks), ("worlds", "", lambda row: row[0].num_worlds),
        ("frame_time_median", "s", lambda row: quantile(row[1], 0.5)), ("frame_time_max", "s", lambda row: float(max(row[1], default=0.0))),
        ("frame_rate", "Hz", lambda row: len(row[1]) / total(row[1]) if len(row[1]) and min(row[1]) > 0 else 0.0))


def tables_of(ensemble, quantities):
    frames = [bodies_in(ensemble, row) for row in range(len(ensemble.recorded()))]
    return {"runs": runs_table(ensemble), "frames": frames_table(ensemble, quantities), "positions": positions_table(ensemble, frames),
            "bodies": bodies_table(ensemble, frames), "worlds": worlds_table(ensemble)}


def head(ensemble):
    first, last = ensemble.first, ensemble.num_frames - 1
    samples = "each world of each run" if ensemble.over == WORLDS else "runs"
    lines = [f"scene: {first.scene}", f"samples: {ensemble.num_samples} ({samples})",
             f"frames: {first.frame_number[0]} to {first.frame_number[last]} ({first.time[last]:.6g} s)",
             f"state_hashes: {len({run.hash() for run in ensemble.runs})} different in {len(ensemble.runs)} runs",
             *(f"differs: {one}" for one in ensemble.differences)]
    return "\n".join(lines) + "\n"


def runs_shown(ensemble):
    rows = [[run.path, run.parameter("seed"), run.parameter("solver_seed"), str(run.num_frames), run.state_hash] for run in ensemble.runs]
    return Table("", ["run", "seed", "solver_seed", "frames", "hash"], rows)


def last_frame_shown(quantities):
    """The spread of each quantity in the last frame that all runs have."""
    shown = [(name, unit, {what: values[-1] for what, values in spread.items()}) for name, (unit, spread) in quantities.items()]
    numbers = [what for what in shown[0][2] if what not in ("count", "nonfinite")]
    columns = [[f"{spread[what]:{'.4g' if what == 'stddev' else '.6g'}}" for what in numbers] for _, _, spread in shown]
    rows = [[name, unit, *cells] for (name, unit, _), cells in zip(shown, columns)]
    header = ["quantity", "unit", *numbers]
    if any(spread["nonfinite"] for _, _, spread in shown):
        header.append("not finite")
        rows = [[*row, str(spread["nonfinite"])] for row, (_, _, spread) in zip(rows, shown)]
    return Table("", header, rows, rule="|---|---|" + "--:|" * (len(header) - 2))


def positions_text(positions):
    """`positions`: the table of that name."""
    last = {column.name: column.values[-1] for column in positions if len(column.values)}
    if not last or last["widest_body"] < 0:
        return "positions: none is finite" if last else ""
    return (f"positions: in frame {last['frame']} samples are {last['distance_rms']:.4g} m rms from their mean; a body "
            f"{last['body_rms_max']:.4g} m at most: {last['widest_name']}")


def report_of(ensemble):
    """(the report, its tables of numbers)"""
    quantities = spread_by_frame(ensemble)
    numbers = tables_of(ensemble, quantities)
    table = last_frame_shown(quantities)
    sections = [Section(tables=[runs_shown(ensemble)], shown_in=(TEXT,)),
                Section(text="The last frame that all runs have:", tables=[table], shown_in=(TEXT,)),
                Section(tables=[table], shown_in=(MARKDOWN,))]
    positions = positions_text(numbers["positions"])
    sections += [Section(text=positions)] if positions else []
    sections += page_sections(ensemble, quantities, numbers["worlds"])
    line, entries = page.origin_of_runs(ensemble.runs)
    report = Report("An ensemble of runs", f"{ensemble.first.scene}, {ensemble.num_samples} samples", sections,
                    parameters_of(ensemble) | tables.json_of(numbers), head(ensemble), line, entries)
    return report, numbers


def page_sections(ensemble, quantities, worlds):
    """What the page shows besides: diagrams over parameters, if the worlds have any, and over the frames."""
    parameters = [column.name for column in columns_of_all(ensemble.runs, "world_parameters")]
    by_parameter = ensemble_charts.over_parameters(worlds, parameters)
    time_s = ensemble.first.time[:ensemble.num_frames]
    sections = [Section("Results over parameters", "", by_parameter, shown_in=(PAGE,))] if by_parameter else []
    return [*sections, Section("Over the frames", "", ensemble_charts.over_frames(time_s, quantities), shown_in=(PAGE,))]


def parameters_of(ensemble):
    return {"scene": ensemble.first.scene, "over": ensemble.over, "differences": "".join(f"{one}\n" for one in ensemble.differences)}


def require_sense(options):
    require(options.over in (RUNS, WORLDS), f"--over {options.over}: it must be runs or worlds")
    require(len(options.files) >= (2 if options.over == RUNS else 1),
            f"ensemble: {len(options.files)} files are given; name the HDF5 files of two runs or more, or one with --over worlds")
    for q in options.quantiles:
        require(0 <= q <= 1, f"--quantiles: {q:f} is not from 0 to 1")
    require_table(options, TABLES)


def run(words):
    options = parse(COMMAND, words)
    if options is None:
        return
    require_sense(options)
    report, numbers = report_of(ensemble_of(options))
    deliver(report, options, tables.csv_of(numbers[options.table]))
