"""pbreport study: what accuracy costs in time, and the setting to choose; the file of pbstudy accuracy."""
import dataclasses
import math

from reports import diagrams, errors, page
from reports.command_line import Command, add_scene_option, deliver, one_file, parse, quantity
from reports.document import PAGE, TEXT, Column, Report, Section, Table
from reports.files import in_order_of, read_study, require, write_file
from reports.words import number, plural


def add_options(group):
    group.add_argument("--budget", metavar="TIME", help="name, per scene, the setting with the least defect that fits this frame time "
                       "(us, ms, s); what fells bodies that should stand is not chosen")
    group.add_argument("--tolerance", metavar="LENGTH", help="name, per scene, the cheapest setting that keeps its defect within this "
                       "length (mm, cm, m), with the same exception")
    group.add_argument("--measure", default="rms", metavar="rms|p99|max|joint", help="the defect that counts: rms, p99 or max of all body "
                       "positions, or the rms of all joint gaps")
    add_scene_option(group)
    group.add_argument("--write-config", metavar="OUT", help="the setting chosen for one scene, for pbmpi --config")


COMMAND = Command("study", "Shows what accuracy costs in time: the file of pbstudy accuracy. The word study may be left out.",
                  "accuracy.h5 [options]", page="work-precision diagrams, Pareto fronts, categories",
                  csv="all cases as comma-separated values", add_options=add_options)


@dataclasses.dataclass
class Measure:
    """A statistic of a case's errors [m] by which settings can be ranked, and how its diagram is labelled."""
    kind: str
    what: str
    words: str
    title: str
    axis: str


MEASURES = {"rms": Measure("body_position", "rms", "rms of body positions", "Position, rms", "defect, rms [mm]"),
            "p99": Measure("body_position", "p99", "p99 of body positions", "Position, 99th percentile", "defect, p99 [mm]"),
            "max": Measure("body_position", "max", "max of body positions", "Position, worst body", "defect, max [mm]"),
            "joint": Measure("joint_position", "rms", "rms of joint gaps", "Joint gap", "difference of the gaps, rms [mm]")}
# What the reference is compared with, in the order of the reports.
JUDGES = {"more_iterations": "reference with more iterations", "second_method": "ODE, {setting}",
          "halved_dt": "reference with half the step"}
# Kinds of which a scene has many cases, and where SceneCases keeps them.
LISTS = {"setting": "settings", "estimate": "estimates", "floor": "floor", "own": "own", "own_floor": "own_floor"}


def error_by(measure, table):
    return getattr(table[MEASURES[measure].kind], MEASURES[measure].what)


class Case:
    """A row of /cases: a setting, an estimate, or what says how far the reference is to be trusted. NaN: not measured."""

    def __init__(self, row):
        self.row = row
        self.scene, self.kind, self.stepper = row.scene, row.kind, row.stepper
        self.time_s, self.median_time_s = row.frame_time_worst, row.frame_time_median  # of a measured frame; a budget must hold the worst
        self.joint_gap_m, self.penetration_m = row.joint_gap, row.penetration
        self.own = row.own  # the row of its own solution: its equations, solved by its own stepper; -1: none
        self.defect, self.drift, self.own_defect = (errors.read(row, table) for table in ("defect", "drift", "own_defect"))

    @property
    def iterates(self):
        return self.stepper != "direct"

    def finite(self):
        """Did every body and joint stay finite?"""
        return errors.all_finite(self.defect)

    def fells(self):
        """Does it make something fall that should stand, as far as the study knows?"""
        return self.row.rest_fallen > 0

    def has_own(self):
        """Was it compared with its own solution?"""
        return self.own_defect["body_position"].count > 0

    def error_m(self, measure):
        return error_by(measure, self.defect)

    def own_error_m(self, measure):
        """Against its own solution; NaN without one."""
        return error_by(measure, self.own_defect) if self.has_own() else math.nan

    def setting(self):
        """"sor single, 14 x 1, 2 a step, dt 0.01 s"."""
        text, row = self.row.setting, self.row
        if row.estimate_iterations > 0:
            text += f", {row.estimate_iterations} a step"
        return f"{text}, dt {row.dt:g} s"

    def options(self):
        """{name: value}: the options of pbmpi that give this setting."""
        words = self.row.options.split()
        step = {name.removeprefix("--"): value for name, value in zip(words[::2], words[1::2])}
        return {"scene": self.scene} | step | {"steps-per-frame": str(self.row.steps_per_frame), "replicas": str(self.row.worlds),
                                               "warmup": str(self.row.warmup), "frames": str(self.row.frames)}

    def run_command(self):
        return " ".join(["mpirun -n 1 pbmpi", *(f"--{name} {value}" for name, value in self.options().items())])


@dataclasses.dataclass
class SceneCases:
    """The cases of a scene by their kinds. `own_floor`: own solutions from disturbed starts. `judges`: the cases of which there is one, by
    kind: reference, more_iterations, second_method, halved_dt. Estimates are never chosen, since more work follows them."""
    name: str
    settings: list = dataclasses.field(default_factory=list)
    estimates: list = dataclasses.field(default_factory=list)
    floor: list = dataclasses.field(default_factory=list)
    own: list = dataclasses.field(default_factory=list)
    own_floor: list = dataclasses.field(default_factory=list)
    judges: dict = dataclasses.field(default_factory=dict)

    def add(self, case):
        if case.kind in LISTS:
            getattr(self, LISTS[case.kind]).append(case)
        else:
            self.judges[case.kind] = case

    def floor_m(self, measure):
        """The noise floor: the largest error that another seed alone gave the reference."""
        return max((0.0, *(one.error_m(measure) for one in self.floor)))

    def own_floor_m(self, stepper, measure):
        """The noise floor of a stepper's own solution: the largest error that another start and seed gave it. NaN: none was measured."""
        found = [one.own_error_m(measure) for one in self.own_floor if one.stepper == stepper]
        return max((error for error in found if not math.isnan(error)), default=math.nan)

    def uncertainty_m(self, measure):
        """How far the reference may be off: its largest distance from itself with other seeds and more iterations, and from a second
        method. Not the effect of the step's length, which all settings share."""
        judges = [self.judges[kind].error_m(measure) for kind in ("more_iterations", "second_method") if kind in self.judges]
        return max((self.floor_m(measure), *judges))

    def pareto_front(self, error):
        """The settings that no other beats in both time and error(case), by ascending time: the error falls from each to the next. Not
        those that blew up, or whose error is infinite."""
        front, least = [], math.inf
        for one in sorted(filter(Case.finite, self.settings), key=lambda one: (one.time_s, error(one))):
            if error(one) < least:
                least = error(one)
                front.append(one)
        return front

    def front(self, measure):
        return self.pareto_front(lambda one: one.error_m(measure))

    def standing_front(self, measure):
        """The front of the settings that let nothing fall at rest."""
        return self.pareto_front(lambda one: math.inf if one.fells() else one.error_m(measure))

    def is_inside(self, case, measure):
        """Is its error within the uncertainty of the reference?"""
        return case.error_m(measure) <= self.uncertainty_m(measure)


@dataclasses.dataclass
class Limit:
    """What is asked of a setting: a time of its worst frame, or an error by the measure; or neither, then nothing is chosen."""
    measure: str = "rms"
    budget_s: float | None = None
    tolerance_m: float | None = None

    def is_asked(self):
        return self.budget_s is not None or self.tolerance_m is not None

    def asked(self):
        return f"budget {1e3 * self.budget_s:g} ms" if self.budget_s else f"tolerance {1e3 * self.tolerance_m:g} mm"

    def keeps(self, case):
        if self.budget_s:
            return case.time_s <= self.budget_s
        return self.tolerance_m is not None and case.error_m(self.measure) <= self.tolerance_m

    def chosen(self, scene):
        """The setting with the least error within the time, or the least time within the error, of those that let nothing fall at rest;
        None: there is none."""
        kept = list(filter(self.keeps, scene.standing_front(self.measure)))
        return (kept[-1] if self.budget_s else kept[0]) if kept else None


def scenes_of(study, names=()):
    """[SceneCases] in the order of the file, or of `names`."""
    scenes = {}
    for case in map(Case, study.rows()):
        scenes.setdefault(case.scene, SceneCases(case.scene)).add(case)
    return in_order_of(names, list(scenes.values()), lambda scene: scene.name)


def remarks(scene, limit, one):
    found = ["chosen"] if one is limit.chosen(scene) else []
    if one.fells():
        bodies = "bodies" if one.row.rest_fallen > 1 else "body"
        found.append(f"fells {one.row.rest_fallen:.0f} {bodies} at rest, the first after {one.row.rest_fell_at:.3g} s")
    if one.error_m(limit.measure) <= scene.floor_m(limit.measure):
        found.append("at the noise floor")
    return "; ".join(found)


def cases_tables(title, text, cases, scene, limit, setting="setting (substeps x iterations)", time="worst frame ms"):
    """For the page, and with the long settings at the end of the lines for the text."""
    bands = [Column(name, lambda one, place=place: str(one.defect["body_position"].bands[place]))
             for place, name in enumerate(errors.BANDS)]
    numbers = [Column(time, lambda one: f"{1e3 * one.time_s:.3f}"), Column("median ms", lambda one: f"{1e3 * one.median_time_s:.3f}"),
               Column("row visits", lambda one: f"{one.row.row_visits:.0f}"),
               *(Column(f"{what} mm", lambda one, what=what: f"{1e3 * one.error_m(what):.4g}") for what in ("rms", "p99", "max")),
               Column("own rms mm", lambda one: number(one.own_error_m("rms"), ".4g", 1e3)),
               Column("joint gap mm", lambda one: f"{1e3 * one.joint_gap_m:.4g}"),
               Column("drift rms mm", lambda one: f"{1e3 * one.drift['body_position'].rms:.4g}"),
               Column("creep mm/s", lambda one: number(one.row.rest_creep, ".3g", 1e3)), *bands]

    def remarked(one):
        note = remarks(scene, limit, one)
        return one.setting() + (f" ({note})" if note else "")

    last = Column("remarks", lambda one: remarks(scene, limit, one))
    return [Table.of(title, [Column(setting, Case.setting), *numbers, last], cases, shown_in=(PAGE,)),
            Table.of(title, [*numbers, Column(setting, remarked)], cases, text=text, shown_in=(TEXT,))]


def judges_table(scene):
    """What says how far the reference may be off, and what half the step changes."""
    bodies = ("rms", "p99", "max")
    drift_m = max((0.0, *(one.drift["body_position"].rms for one in scene.floor)))
    seeds = f"another solver seed: noise floor (largest of {plural(len(scene.floor), 'seed')})"
    rows = [(seeds, *map(scene.floor_m, bodies), drift_m, math.nan)]
    for kind, name in JUDGES.items():
        if kind in scene.judges:
            one = scene.judges[kind]
            drift = one.drift["body_position"]
            rows.append((name.format(setting=one.row.setting), *map(one.error_m, bodies), drift.rms if drift.count else math.nan,
                         one.row.solve_residual))
    headers = ("rms mm", "p99 mm", "max mm", "drift rms mm", "residual mm")
    columns = [Column(header, lambda row, place=place: number(row[place], ".4g", 1e3)) for place, header in enumerate(headers, 1)]
    return Table.of("Defect from the reference", [*columns, Column("", lambda row: row[0])], rows, shown_in=(TEXT,))


def own_table(scene):
    text = ("each stepper's equations, solved by it from the iterations below on; rms from the reference, from the same with a quarter of "
            "the iterations, noise floor of the stepper; mean iterations")
    columns = [Column("reference mm", lambda one: f"{1e3 * one.error_m('rms'):.4g}"),
               Column("quarter mm", lambda one: number(one.own_error_m("rms"), ".4g", 1e3)),
               Column("floor mm", lambda one: number(scene.own_floor_m(one.stepper, "rms"), ".4g", 1e3)),
               Column("iterations", lambda one: number(one.row.solve_iterations, ".4g")), Column("", Case.setting)]
    return Table.of("Own solutions", columns, scene.own, text=text, shown_in=(TEXT,))


def inside_text(scene, limit, one):
    if not scene.is_inside(one, limit.measure):
        return ""
    return f": within the {1e3 * scene.uncertainty_m(limit.measure):.4g} mm to which the reference is known"


def choice_text(scene, limit):
    """Paragraphs on the setting that was asked for; none without a limit."""
    if not limit.is_asked():
        return ""
    one = limit.chosen(scene)
    if one is None:
        falls = any(case.fells() and limit.keeps(case) for case in scene.settings)
        return f"\n\n{limit.asked()}: no setting of the study keeps it{' without felling what stands at rest' if falls else ''}"
    return (f"\n\n{limit.asked()}: {one.setting()} ({1e3 * one.time_s:.3f} ms, defect {1e3 * one.error_m(limit.measure):.4g} mm"
            f"{inside_text(scene, limit, one)})\n\nrun: {one.run_command()}")


def scene_text(scene, limit):
    blown_up = sum(not one.finite() for one in scene.settings)
    text = f"{plural(len(scene.settings), 'setting')}."
    if blown_up:
        text += f" {blown_up} of them blew up (inf or NaN) and {'is' if blown_up == 1 else 'are'} left out."
    text += (" Defect: error of all bodies after one frame from the reference's own state. Uncertainty of the reference: its largest "
             f"distance from itself with {plural(len(scene.floor), 'other solver seed')} and more iterations, and from a second method; "
             f"{1e3 * scene.uncertainty_m(limit.measure):.4g} mm ({MEASURES[limit.measure].words}).")
    if "reference" in scene.judges:
        row = scene.judges["reference"].row
        text += f" It was solved to {1e3 * row.solve_residual:.3g} mm a step, with {row.solve_iterations:.0f} iterations on average."
    if scene.own:
        text += " Own rms: the error against the same equations solved by the same stepper with many iterations."
    return text + choice_text(scene, limit)


def scene_section(scene, limit):
    charts = [diagrams.diagram(scene, limit, name, measure.title, measure.axis) for name, measure in MEASURES.items()]
    tables = [judges_table(scene)]
    if scene.own:
        tables.append(own_table(scene))
    tables += cases_tables("Pareto front", "", scene.front(limit.measure), scene, limit)
    if scene.estimates:
        text = "a frame of the setting, estimated with so many iterations a step; times are those until the estimate is there"
        tables += cases_tables("Estimates (FEEC)", text, scene.estimates, scene, limit, "setting, and what estimates its frame",
                               "until it is there ms")
    return Section(scene.name, scene_text(scene, limit), charts, tables)


def case_json(one, scene, limit):
    row, error_m = one.row, one.error_m(limit.measure)
    found = {"options": one.options(), "frame_time_s": {"worst": one.time_s, "median": one.median_time_s}, "row_visits": row.row_visits,
             "defect": errors.json_of(one.defect)}
    if one.has_own():
        found |= {"own_defect": errors.json_of(one.own_defect), "own_error_m": one.own_error_m(limit.measure)}
    found |= {"joint_gap_m": one.joint_gap_m, "error_m": error_m, "at_noise_floor": error_m <= scene.floor_m(limit.measure)}
    if not math.isnan(row.rest_fallen):
        found["at_rest"] = {"fallen": row.rest_fallen, "fell_at_s": row.rest_fell_at, "creep_m_s": row.rest_creep,
                            "energy_gain_j": row.rest_energy_gain}
    return found


def estimate_json(one, scene, limit):
    return case_json(one, scene, limit) | {"estimate": {"iterations": one.row.estimate_iterations}}


def own_json(one, scene, measure):
    return {"stepper": one.stepper, "setting": one.setting(), "iterations": one.row.solve_iterations,
            "from_reference_m": one.error_m(measure), "from_a_quarter_m": one.own_error_m(measure),
            "noise_floor_m": scene.own_floor_m(one.stepper, measure)}


def scene_json(scene, limit):
    measure = limit.measure
    found = {"scene": scene.name, "noise_floor_m": scene.floor_m(measure)}
    for kind in JUDGES:
        if kind in scene.judges:
            found[f"{kind}_m"] = scene.judges[kind].error_m(measure)
    found["uncertainty_m"] = scene.uncertainty_m(measure)
    if "reference" in scene.judges:
        row = scene.judges["reference"].row
        found["reference"] = {"residual_m": row.solve_residual, "iterations": row.solve_iterations}
    if scene.own:
        found["own"] = [own_json(one, scene, measure) for one in scene.own]
    found["front"] = [case_json(one, scene, limit) for one in scene.front(measure)]
    if scene.estimates:
        found["estimates"] = [estimate_json(one, scene, limit) for one in scene.estimates]
    chosen = limit.chosen(scene)
    if chosen:
        found["chosen"] = case_json(chosen, scene, limit) | {"inside_uncertainty": scene.is_inside(chosen, measure)}
        found["run"] = chosen.run_command()
    return found


def config_text(one):
    """Lines "name = value" for pbmpi --config."""
    bodies = one.defect["body_position"]
    head = f"# {one.setting()}: frame time {1e3 * one.time_s:.3f} ms, defect rms {1e3 * bodies.rms:.4g} mm, max {1e3 * bodies.max:.4g} mm\n"
    return head + "".join(f"{name} = {value}\n" for name, value in one.options().items())


def write_config(path, scenes, limit):
    require(len(scenes) == 1, f"--write-config holds one scene, the study has {len(scenes)}; name one with --scene")
    chosen = limit.chosen(scenes[0])
    require(chosen, f"no setting of the study keeps what is asked for in {scenes[0].name}; ask for less or study more settings")
    write_file(path, config_text(chosen))


def limit_of(options):
    require(options.measure in MEASURES, f"--measure {options.measure}: it must be rms, p99, max or joint")
    budget_s = quantity(options.budget, "time", "--budget") if options.budget is not None else None
    tolerance_m = quantity(options.tolerance, "length", "--tolerance") if options.tolerance is not None else None
    limit = Limit(options.measure, budget_s, tolerance_m)
    require(not options.write_config or limit.is_asked(),
            "--write-config writes the setting that --budget or --tolerance chooses; give one of them")
    require(not (budget_s and tolerance_m), "--budget and --tolerance exclude each other; drop one")
    return limit


def report_of(study, scenes, limit):
    head = (f"study: accuracy; defect after one frame from the reference's state, ranked by the {MEASURES[limit.measure].words}\n"
            f"reference: sor double, law ode, from {study.parameters.get('reference_iterations', '?')} iterations a step on, solver seed "
            f"{study.parameters.get('seed', '?')}\n")
    line, entries = page.origin_of_study(study)
    return Report("What accuracy costs in time", study.path, [scene_section(scene, limit) for scene in scenes],
                  {"scenes": [scene_json(scene, limit) for scene in scenes]}, head, line, entries)


def run(words):
    options = parse(COMMAND, words)
    if options is None:
        return
    path = one_file(options, "a study", "accuracy.h5")
    limit = limit_of(options)
    study = read_study(path, "accuracy")
    scenes = scenes_of(study, options.scene)
    if options.write_config:
        write_config(options.write_config, scenes, limit)
    deliver(report_of(study, scenes, limit), options, study.tables["cases"])
