"""pbreport study: what accuracy costs in time, and the setting to choose; the file of pbstudy accuracy."""
import dataclasses
import math

from reports import errors, page, stability
from reports.command_line import Command, add_scene_option, deliver, one_file, parse, quantity
from reports.document import PAGE, TEXT, Column, Report, Section, Table
from reports.files import in_order_of, read_study, require, write_file
from reports.study import diagrams
from reports.study.answers import ANSWERS, LENGTHS_M, Limit, answer_command, answer_json, answer_text, result_text
from reports.words import number, percent, plural


def add_options(group):
    group.add_argument("--budget", metavar="TIME", help="name, per scene, the setting with the least error that fits this frame time (us, "
                       "ms, s); what fells bodies that should stand, or breaks hard cases, is not chosen")
    group.add_argument("--tolerance", metavar="LENGTH", help="name, per scene, the cheapest setting that keeps this length (mm, cm, m), "
                       "with the same exceptions: 1mm, 1cm and 10cm for nine bodies in ten of those that nature determines so well, other "
                       "lengths by the rms of all bodies")
    group.add_argument("--hard-cases", metavar="FILE", help="choose only what holds the hard cases of this file of pbstudy stability")
    add_scene_option(group)
    group.add_argument("--write-config", metavar="OUT", help="the setting chosen for one scene, for pbmpi --config")


COMMAND = Command("study", "Shows what accuracy costs in time: the file of pbstudy accuracy. The word study may be left out.",
                  "accuracy.h5 [options]", page="work-precision diagrams, Pareto fronts, categories",
                  csv="all cases as comma-separated values", add_options=add_options)


# The diagrams of a scene: title and axis by the error that they show, as error_by() takes it.
CHARTS = {"rms": ("Position, rms", "error, rms [mm]"), "median": ("Position, median", "error, median [mm]"),
          "p90": ("Position, 90th percentile", "error, p90 [mm]"), "joint": ("Joint gap", "difference of the gaps, rms [mm]")}
# Kinds of which a scene has many cases, and where SceneCases keeps them.
LISTS = {"setting": "settings", "estimate": "estimates", "own": "own", "own_floor": "own_floor"}


def error_by(measure, table):
    """[m] A statistic of all body positions, or "joint": the rms of all joint gaps."""
    return table["joint_position"].rms if measure == "joint" else getattr(table["body_position"], measure)


class Case:
    """A row of /cases: a setting, an estimate, an own solution, or nature, whose errors are its own uncertainty. NaN: not measured.
    `hard`: how it does on the hard cases; None: nobody knows."""

    def __init__(self, row, hard=None):
        self.row, self.hard = row, hard
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

    def may_be_chosen(self):
        return self.finite() and not self.fells() and (self.hard is None or self.hard.holds())

    def has_own(self):
        """Was it compared with its own solution?"""
        return self.own_defect["body_position"].count > 0

    def error_m(self, measure="rms"):
        """Against nature; NaN where nature determines no body."""
        return error_by(measure, self.defect) if self.defect["body_position"].count > 0 else math.nan

    def own_error_m(self):
        """Against its own solution; NaN without one."""
        return error_by("rms", self.own_defect) if self.has_own() else math.nan

    def within(self):
        """{length: share}: of the bodies that nature determines for a length, how many end within it; NaN without any."""
        return dict(zip(LENGTHS_M, self.row.within))

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
    """The cases of a scene by their kinds. `own_floor`: own solutions from disturbed starts. `frames`: rows of /nature. Estimates are never
    chosen, since more work follows them."""
    name: str
    settings: list = dataclasses.field(default_factory=list)
    estimates: list = dataclasses.field(default_factory=list)
    own: list = dataclasses.field(default_factory=list)
    own_floor: list = dataclasses.field(default_factory=list)
    nature: Case | None = None
    frames: list = dataclasses.field(default_factory=list)

    def add(self, case):
        if case.kind == "nature":
            self.nature = case
        elif case.kind in LISTS:
            getattr(self, LISTS[case.kind]).append(case)

    def determined(self):
        """{length: share}: how many of the bodies and frames nature determines so well that their errors say something."""
        return dict(zip(LENGTHS_M, self.nature.row.determined)) if self.nature else dict.fromkeys(LENGTHS_M, math.nan)

    def own_floor_m(self, stepper):
        """The noise floor of a stepper's own solution: the largest error that another start and seed gave it. NaN: none was measured."""
        found = [one.own_error_m() for one in self.own_floor if one.stepper == stepper]
        return max((error for error in found if not math.isnan(error)), default=math.nan)

    def uncertainty_m(self, measure="rms"):
        """How far nature may be off: what half of its step changes, or how far its two ways are apart. NaN: it was not measured."""
        return self.nature.error_m(measure) if self.nature else math.nan

    def pareto_front(self, error, settings=None):
        """The settings that no other beats in both time and error(case), by ascending time: the error falls from each to the next. Not
        those that blew up, or whose error is infinite or NaN."""
        front, least = [], math.inf
        for one in sorted(filter(Case.finite, self.settings if settings is None else settings), key=lambda one: (one.time_s, error(one))):
            if error(one) < least:
                least = error(one)
                front.append(one)
        return front

    def front(self, measure="rms", settings=None):
        return self.pareto_front(lambda one: one.error_m(measure), settings)

    def is_inside(self, case):
        """Is its error within the uncertainty of nature?"""
        return case.error_m() <= self.uncertainty_m()


def scenes_of(study, names=(), hard_cases=None):
    """[SceneCases] in the order of the file, or of `names`. `hard_cases`: a study of stability."""
    require("nature" in study.tables, f"{study.path}: it has no table of nature, as studies of older versions, whose errors are distances from "
                                      "a reference; use the pbreport of the version that wrote it, or run it again")
    known = stability.tallies(hard_cases) if hard_cases else None
    scenes = {}
    for row in study.rows():
        hard = None if known is None else known.get(stability.step_key(row.options, row.dt), stability.Tally())
        scenes.setdefault(row.scene, SceneCases(row.scene)).add(Case(row, hard))
    for row in study.rows("nature"):
        if row.scene in scenes:
            scenes[row.scene].frames.append(row)
    return in_order_of(names, list(scenes.values()), lambda scene: scene.name)


def remarks(scene, limit, one):
    found = ["chosen"] if one is limit.chosen(scene) else []
    if one.fells():
        bodies = "bodies" if one.row.rest_fallen > 1 else "body"
        found.append(f"fells {one.row.rest_fallen:.0f} {bodies} at rest, the first after {one.row.rest_fell_at:.3g} s")
    if one.kind == "setting" and one.hard and not one.hard.holds():
        found.append(one.hard.remark())
    return "; ".join(found)


def cases_tables(title, text, cases, scene, limit, setting="setting (substeps x iterations)", time="worst frame ms"):
    """For the page, and with the long settings at the end of the lines for the text."""
    bands = [Column(name, lambda one, place=place: str(one.defect["body_position"].bands[place]))
             for place, name in enumerate(errors.BANDS)]
    numbers = [Column(time, lambda one: f"{1e3 * one.time_s:.3f}"), Column("median ms", lambda one: f"{1e3 * one.median_time_s:.3f}"),
               Column("row visits", lambda one: f"{one.row.row_visits:.0f}"),
               *(Column(f"{what} mm", lambda one, what=what: number(one.error_m(what), ".4g", 1e3)) for what in errors.NUMBERS),
               *(Column(f"within {length} %", lambda one, length=length: number(one.within()[length], ".1f", 100)) for length in LENGTHS_M),
               Column("own rms mm", lambda one: number(one.own_error_m(), ".4g", 1e3)),
               Column("joint gap mm", lambda one: f"{1e3 * one.joint_gap_m:.4g}"),
               Column("drift rms mm", lambda one: f"{1e3 * one.drift['body_position'].rms:.4g}"),
               Column("creep mm/s", lambda one: number(one.row.rest_creep, ".3g", 1e3)), *bands]

    def remarked(one):
        note = remarks(scene, limit, one)
        return one.setting() + (f" ({note})" if note else "")

    last = Column("remarks", lambda one: remarks(scene, limit, one))
    return [Table.of(title, [Column(setting, Case.setting), *numbers, last], cases, shown_in=(PAGE,)),
            Table.of(title, [*numbers, Column(setting, remarked)], cases, text=text, shown_in=(TEXT,))]


def nature_table(scene):
    """Frame by frame, how well nature is known."""
    def lengths(name, what):
        return [Column(f"{name} {part} mm", lambda row, column=f"{what}_{part}": number(getattr(row, column), ".3g", 1e3))
                for part in ("median", "p90")]

    text = "steps of the frame by either way, what half as many change of the bodies' positions, and how far the two ways are apart"
    columns = [Column("frame", lambda row: str(row.frame)),
               Column("soft steps", lambda row: str(row.soft_steps)), *lengths("half as many:", "soft_halved"),
               Column("ode steps", lambda row: str(row.ode_steps)), *lengths("half as many:", "ode_halved"), *lengths("apart", "apart"),
               *(Column(f"determined for {length} %", lambda row, place=place: number(row.determined[place], ".1f", 100))
                 for place, length in enumerate(LENGTHS_M))]
    return Table.of("Nature", columns, scene.frames, text=text)


def own_table(scene):
    text = ("each stepper's equations, solved by it from the iterations below on; rms from nature, from the same with a quarter of the "
            "iterations, noise floor of the stepper; mean iterations")
    columns = [Column("nature mm", lambda one: number(one.error_m(), ".4g", 1e3)),
               Column("quarter mm", lambda one: number(one.own_error_m(), ".4g", 1e3)),
               Column("floor mm", lambda one: number(scene.own_floor_m(one.stepper), ".4g", 1e3)),
               Column("iterations", lambda one: number(one.row.solve_iterations, ".4g")), Column("", Case.setting)]
    return Table.of("Own solutions", columns, scene.own, text=text, shown_in=(TEXT,))


def choice_text(scene, limit):
    """Paragraphs on the setting that was asked for; none without a limit."""
    if not limit.is_asked():
        return ""
    one = limit.chosen(scene)
    if one is None:
        return f"\n\n{limit.asked()}: {limit.why_none(scene)}"
    return f"\n\n{limit.asked()}: {one.setting()} ({result_text(limit, scene, one)})\n\nrun: {one.run_command()}"


def determined_text(scene):
    """"93 % of bodies and frames at 1 mm, 98 % at 1 cm"."""
    (first, share), *others = scene.determined().items()
    return ", ".join([f"{percent(share, 0)} of bodies and frames at {first}", *(f"{percent(share, 0)} at {length}" for length, share in others)])


def scene_text(scene, limit):
    blown_up = sum(not one.finite() for one in scene.settings)
    text = f"{plural(len(scene.settings), 'setting')}."
    if blown_up:
        text += f" {blown_up} of them blew up (inf or NaN) and {'is' if blown_up == 1 else 'are'} left out."
    text += (" Error: of the bodies of which nature is known to 1 mm, after one frame from nature's own state. Nature is the limit of ever "
             "shorter steps, reached in two ways: by springs (soft), and by ODE's rows with cones of friction (ode). It is determined for "
             f"{determined_text(scene)}, that is, known to a tenth of it. Its uncertainty for the bodies that count, what half the step "
             "changes or the two ways are apart: "
             f"{number(scene.uncertainty_m(), '.4g', 1e3)} mm (rms of body positions).")
    if scene.own:
        text += " Own rms: the error against the same equations solved by the same stepper with many iterations."
    return text + choice_text(scene, limit)


def scene_section(scene, limit):
    charts = [diagrams.diagram(scene, limit, name, title, axis) for name, (title, axis) in CHARTS.items()]
    tables = [nature_table(scene)]
    if scene.own:
        tables.append(own_table(scene))
    tables += cases_tables("Pareto front", "", scene.front(), scene, limit)
    if scene.estimates:
        text = "a frame of the setting, estimated with so many iterations a step; times are those until the estimate is there"
        tables += cases_tables("Estimates (FEEC)", text, scene.estimates, scene, limit, "setting, and what estimates its frame",
                               "until it is there ms")
    answer = answer_text(scene) + ("" if limit.is_asked() else answer_command(scene))
    return Section(scene.name, scene_text(scene, limit), charts, tables, last=answer)


def case_json(one):
    row = one.row
    found = {"options": one.options(), "frame_time_s": {"worst": one.time_s, "median": one.median_time_s}, "row_visits": row.row_visits,
             "defect": errors.json_of(one.defect)}
    if one.has_own():
        found |= {"own_defect": errors.json_of(one.own_defect), "own_error_m": one.own_error_m()}
    found |= {"joint_gap_m": one.joint_gap_m, "error_m": one.error_m(), "within": one.within()}
    if one.hard:
        found["hard_cases"] = dataclasses.asdict(one.hard)
    if not math.isnan(row.rest_fallen):
        found["at_rest"] = {"fallen": row.rest_fallen, "fell_at_s": row.rest_fell_at, "creep_m_s": row.rest_creep,
                            "energy_gain_j": row.rest_energy_gain}
    return found


def estimate_json(one):
    return case_json(one) | {"estimate": {"iterations": one.row.estimate_iterations}}


def own_json(one, scene):
    return {"stepper": one.stepper, "setting": one.setting(), "iterations": one.row.solve_iterations,
            "from_nature_m": one.error_m(), "from_a_quarter_m": one.own_error_m(),
            "noise_floor_m": scene.own_floor_m(one.stepper)}


NATURE = ("frame", "soft_steps", "ode_steps", "soft_halved_median", "soft_halved_p90", "ode_halved_median", "ode_halved_p90", "apart_median",
          "apart_p90")  # columns of /nature; lengths in m


def scene_json(scene, limit):
    found = {"scene": scene.name, "uncertainty_m": scene.uncertainty_m(), "determined": scene.determined(),
             "nature": [{name: getattr(row, name) for name in NATURE} | {"determined": dict(zip(LENGTHS_M, row.determined))}
                        for row in scene.frames]}
    if scene.own:
        found["own"] = [own_json(one, scene) for one in scene.own]
    found["front"] = list(map(case_json, scene.front()))
    if scene.estimates:
        found["estimates"] = list(map(estimate_json, scene.estimates))
    chosen = limit.chosen(scene)
    if chosen:
        found["chosen"] = case_json(chosen) | {"inside_uncertainty": scene.is_inside(chosen)}
        found["run"] = chosen.run_command()
    found["answers"] = [answer_json(one, scene) for one in ANSWERS]
    return found


def config_text(one):
    """Lines "name = value" for pbmpi --config."""
    bodies = one.defect["body_position"]
    head = f"# {one.setting()}: frame time {1e3 * one.time_s:.3f} ms, error rms {1e3 * bodies.rms:.4g} mm, max {1e3 * bodies.max:.4g} mm\n"
    return head + "".join(f"{name} = {value}\n" for name, value in one.options().items())


def write_config(path, scenes, limit):
    require(len(scenes) == 1, f"--write-config holds one scene, the study has {len(scenes)}; name one with --scene")
    chosen = limit.chosen(scenes[0])
    require(chosen, f"no setting of the study keeps what is asked for in {scenes[0].name}; ask for less or study more settings")
    write_file(path, config_text(chosen))


def limit_of(options):
    budget_s = quantity(options.budget, "time", "--budget") if options.budget is not None else None
    tolerance_m = quantity(options.tolerance, "length", "--tolerance") if options.tolerance is not None else None
    limit = Limit(budget_s, tolerance_m)
    require(not options.write_config or limit.is_asked(),
            "--write-config writes the setting that --budget or --tolerance chooses; give one of them")
    require(not (budget_s and tolerance_m), "--budget and --tolerance exclude each other; drop one")
    return limit


def report_of(study, scenes, limit):
    head = "study: accuracy; error after one frame from nature's state, ranked by the rms of body positions\n"
    steps, error_m = (study.parameters.get(name) for name in ("nature_steps", "nature_error"))
    if steps and error_m:
        head += (f"nature: the limit of ever shorter steps, at most {steps} a frame, until half the step moves nine bodies in ten by less than "
                 f"{1e3 * float(error_m):g} mm; solver seed {study.parameters.get('seed', '?')}\n")
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
    scenes = scenes_of(study, options.scene, read_study(options.hard_cases, "stability") if options.hard_cases else None)
    if options.write_config:
        write_config(options.write_config, scenes, limit)
    deliver(report_of(study, scenes, limit), options, study.tables["cases"])
