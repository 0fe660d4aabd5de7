"""pbreport engines: engines side by side; the files of pbstudy accuracy and pbstudy stability, either of which may be left out."""
import dataclasses
import math

import h5py

from reports import accuracy, charts, files, page, stability
from reports.command_line import Command, add_scene_option, deliver, parse
from reports.document import MARKDOWN, PAGE, TEXT, Chart, Column, Report, Section, Table
from reports.files import require
from reports.words import joined, number, plural

COMMAND = Command("engines", "Shows engines side by side: of pbstudy accuracy each engine's front of error against time, by nature and by "
                  "its own solution, and its noise; of pbstudy stability what each setting holds; and what each engine cannot express. "
                  "Either file may be left out.", "[accuracy.h5] [stability.h5] [options]",
                  page="fronts of all engines in one diagram a scene, and the tables", markdown="print the tables in Markdown",
                  add_options=add_scene_option)

MOST_NAMES = 4  # scenes listed in a cell
NOT_COMPARABLE = (  # differences that no setting removes
    "Contacts: each engine finds them by its own collision detection, so that points, numbers and depths differ before a solver begins. "
    "Nature is the limit that two laws of sor, soft and ode, reach with ever shorter steps and the contacts of sor. The error against it is what "
    "an engine loses by its step, its law, its solver and its contacts together; that other contacts count as an error favours sor. The own "
    "solution has the engine's contacts.",
    "Laws: MuJoCo's contacts are soft by a law of its own, and its joints are coordinates of a tree that cannot open; the others have "
    "rows for joints, which open by what the solver leaves. A joint gap of nothing is no merit of MuJoCo's solver, as contacts that "
    "give are no fault of it. quick, direct and bullet bound friction by a pyramid of two directions, sor by default and mujoco by a "
    "cone.",
    "Memory: quick, direct and bullet begin each step from nothing, here also mujoco, so that a state restores a world; sor keeps its "
    "memory in the state. Bullet and MuJoCo in a program of their own would begin with their last forces.",
    "Steps: all engines are given the step of the scene. MuJoCo divides it into parts of 2.5 ms at most, sor into substeps with one "
    "collision detection.",
    "Times: processor time on one core, of all worlds of the scene and of the worst measured frame. sor steps worlds side by side in "
    "vector lanes, the others one after the other; of one world much of the lanes is idle.")


@dataclasses.dataclass
class Yardstick:
    """What an engine's settings are ranked by: errors against nature, or against the engine's own solution. They answer different questions
    and are never mixed. `error_of(case)`: rms of body positions after one frame [m]."""
    key: str
    name: str
    error_of: object

    def error_m(self, case):
        """Infinite for a setting that blew up or lets bodies fall at rest, and where the study has no such error."""
        error = self.error_of(case) if case.finite() and not case.fells() else math.inf
        return math.inf if math.isnan(error) else error


NATURE = Yardstick("nature", "nature", lambda case: case.error_m())
OWN = Yardstick("own", "its own solution", lambda case: case.own_error_m())


class Engine:
    """An engine in a scene. Of its solution with its usual settings [m], rms: `law_m`, its distance from nature, by what its model and its
    step differ; `fewer_m`, from itself with fewer iterations; `floor_m`, from itself begun in disturbed states with another seed, its
    noise. NaN where the study has none."""

    def __init__(self, scene, name):
        self.name = name
        self.settings = [one for one in scene.settings if one.stepper == name]
        self.not_finite = sum(not one.finite() for one in self.settings)
        self.felled = sum(one.fells() for one in self.settings)
        self.floor_m, self.law_m, self.fewer_m = scene.own_floor_m(name), math.nan, math.nan
        # The own solution whose noise was measured is that of the usual settings.
        measured = [one.own for one in scene.own_floor if one.stepper == name][:1]
        for usual in [one for one in scene.own if one.own in measured][:1]:
            self.law_m = usual.error_m()
            self.fewer_m = usual.own_error_m() if usual.iterates else math.nan

    def front(self, yardstick):
        """Its settings that no other of them beats, by ascending time; empty if none stands."""
        return accuracy.SceneCases(self.name, self.settings).pareto_front(yardstick.error_m)


class Scene:
    """A scene of a study of accuracy."""

    def __init__(self, cases):
        self.name, self.uncertainty_m = cases.name, cases.uncertainty_m()  # of nature
        self.engines = [Engine(cases, name) for name in dict.fromkeys(one.stepper for one in cases.settings)]
        self.has_own = any(one.has_own() for one in cases.settings)
        self.yardsticks = [NATURE, OWN] if self.has_own else [NATURE]
        self.worlds, self.frames = (cases.settings[-1].row.worlds, cases.settings[-1].row.frames) if cases.settings else (1, 0)


class Held:
    """How many of the hard cases a setting holds: `groups` {group: {verdict: number}}, and `all` of them."""

    def __init__(self, found, place):
        self.setting, self.engine = found.settings[place], found.rows_of(place)[0].stepper
        groups = dict.fromkeys(scene.facts.group for scene in found.scenes)
        self.groups = {group: stability.count(found.rows_of(place, group)) for group in groups}
        self.all = stability.count(found.rows_of(place))


class Engines:
    """What the studies say. `differences`: {(engine, text): scenes}, what an engine takes otherwise than ODE."""

    def __init__(self, studies, names):
        self.studies, self.scenes, self.held, self.map = list(studies.values()), [], [], None
        self.differences = {}
        if "accuracy" in studies:
            self.scenes = [Scene(cases) for cases in accuracy.scenes_of(studies["accuracy"], names)]
            self.add_differences(studies["accuracy"], [scene.name for scene in self.scenes])
        if "stability" in studies:
            self.map = stability.map_of(studies["stability"])
            self.held = [Held(self.map, place) for place in range(len(self.map.settings))]
            self.add_differences(studies["stability"], [scene.name for scene in self.map.scenes])
        self.differences = dict(sorted(self.differences.items(), key=lambda one: one[0][0]))

    def add_differences(self, study, scenes):
        require("differences" in study.tables, f"{study.path}: it does not say what engines take otherwise, as studies before version 1.7; run it again")
        for scene in scenes:
            for row in (row for row in study.rows("differences") if row.scene == scene):
                known = self.differences.setdefault((row.engine, row.text), [])
                known += [scene] if scene not in known else []


def millimetres(metres):
    return number(metres, ".3g", 1e3)


def counts_text(counts):
    """"6 pass, 1 degraded"; "-" without any."""
    return ", ".join(f"{count} {verdict}" for verdict, count in counts.items() if count) or "-"


NOTHING_STANDS = "none that stays finite and holds the scene at rest"


def front_columns(yardstick):
    """Of (engine, one): a setting of the engine's front, or None where nothing stands."""
    def of_setting(header, cell, otherwise="-"):
        return Column(header, lambda row: cell(row[1]) if row[1] else otherwise)

    return (Column("engine", lambda row: row[0].name),
            of_setting("worst frame [ms]", lambda one: f"{1e3 * one.time_s:.3g}"),
            of_setting("error rms [mm]", lambda one: millimetres(yardstick.error_m(one))),
            of_setting("joint gap [mm]", lambda one: millimetres(one.joint_gap_m)),
            of_setting("depth [mm]", lambda one: millimetres(one.penetration_m)),
            of_setting("setting (substeps x iterations)", lambda one: one.setting(), NOTHING_STANDS))


def front_table(scene, yardstick):
    text = (f"Each engine's front; nature is known to {millimetres(scene.uncertainty_m)} mm." if yardstick is NATURE
            else "Each engine's front; errors of two engines are not to be compared here.")
    rows = [(engine, one) for engine in scene.engines for one in engine.front(yardstick) or [None]]
    return Table.of(f"{scene.name}: error against {yardstick.name}, and time", front_columns(yardstick), rows, text=text)


OWN_COLUMNS = (Column("engine", lambda one: one.name), Column("settings", lambda one: str(len(one.settings))),
               Column("not finite", lambda one: str(one.not_finite)), Column("fell at rest", lambda one: str(one.felled)),
               Column("from nature [mm]", lambda one: millimetres(one.law_m)),
               Column("from itself with fewer iterations [mm]", lambda one: millimetres(one.fewer_m)),
               Column("noise [mm]", lambda one: millimetres(one.floor_m)))


def own_text(scene):
    return (f"{plural(scene.worlds, 'world')}, {scene.frames} measured frames. Of each engine with its usual settings and many iterations, "
            "errors after a frame, rms.")


def scene_tables(scene):
    own = [Table.of(f"{scene.name}: own solutions", OWN_COLUMNS, scene.engines, text=own_text(scene))] if scene.has_own else []
    return own + [front_table(scene, yardstick) for yardstick in scene.yardsticks]


def held_table(found):
    groups = list(found.held[0].groups)
    rows = [[one.engine, one.setting, *(counts_text(counts) for counts in one.groups.values()), counts_text(one.all)] for one in found.held]
    return Table("Hard cases", ["engine", "setting", *groups, "all"], rows, "How many of each group a setting holds.")


def case_cell(row):
    return ": ".join(filter(None, (row.verdict, stability.decided_text(row))))


def case_table(found):
    rows = [[scene.name, *map(case_cell, scene.results)] for scene in found.map.scenes]
    return Table("Case by case", ["case", *found.map.settings], rows)


def difference_table(found):
    rows = [[engine, joined(scenes, MOST_NAMES), text] for (engine, text), scenes in found.differences.items()]
    return Table("What an engine cannot express, or takes otherwise", ["engine", "in", "what"], rows or [["all", "-", "nothing"]])


def versions_of(study):
    """{what: which}: of pbmpi, its build, the engines."""
    built = {name.removeprefix("library_"): text for name, text in study.parameters.items()
             if name == "build" or name.startswith("library_")}
    return {"pbmpi": f"{study.attributes['pbmpi_version']} ({study.attributes['git_revision']})"} | built


def version_table(found):
    rows = [[study.path, what, which] for study in found.studies
            for what, which in {"command": study.attributes["command_line"], **versions_of(study)}.items()]
    return Table("Versions and settings", ["study", "what", "which"], rows)


def front_line(engine, yardstick):
    points = []
    for one in engine.front(yardstick):
        time_ms, error_mm = 1e3 * one.time_s, 1e3 * yardstick.error_m(one)
        label = f"{one.setting()}: {time_ms:.3f} ms, {error_mm:.4g} mm, joint gap {1e3 * one.joint_gap_m:.3g} mm"
        points.append(charts.point(time_ms, error_mm, label))
    return charts.line(engine.name, points, charts.ENGINES[engine.name], showLine=True, borderWidth=1.5, pointRadius=4)


def front_chart(scene, yardstick):
    """Errors below its dashed lines say nothing: nature's uncertainty, or each engine's own noise."""
    floors = [(scene.uncertainty_m, "uncertainty of nature [mm]", charts.INK)]
    if yardstick is OWN:
        floors = [(engine.floor_m, f"noise of {engine.name} [mm]", charts.ENGINES[engine.name]) for engine in scene.engines]
    lines = [charts.band(1e3 * at_m, 1e3 * at_m, label, colour, axis="y", dash=[3, 3]) for at_m, label, colour in floors if at_m > 0]
    sets = [one for one in (front_line(engine, yardstick) for engine in scene.engines) if one["data"]]
    scales = {"x": charts.axis("time of the worst frame [ms]", "logarithmic"),
              "y": charts.axis("error after a frame, rms [mm]", "logarithmic")}
    return Chart(f"Against {yardstick.name}", "Each engine's front; down and left is better.",
                 charts.chart("scatter", sets, scales, bands=lines))


def scene_section(scene, tables):
    shown = [front_chart(scene, yardstick) for yardstick in scene.yardsticks if any(engine.front(yardstick) for engine in scene.engines)]
    return Section(scene.name, own_text(scene), shown, tables, shown_in=(PAGE,))


def setting_json(case):
    return {"setting": case.setting(), "frame_time_s": {"worst": case.time_s, "median": case.median_time_s},
            "nature_error_m": NATURE.error_m(case), "own_error_m": OWN.error_m(case), "joint_gap_m": case.joint_gap_m,
            "penetration_m": case.penetration_m}


def engine_json(engine):
    solution = {"from_nature_m": engine.law_m, "from_fewer_iterations_m": engine.fewer_m, "noise_m": engine.floor_m}
    fronts = {f"{yardstick.key}_front": list(map(setting_json, engine.front(yardstick))) for yardstick in (NATURE, OWN)}
    return {"engine": engine.name, "settings": len(engine.settings), "not_finite": engine.not_finite, "felled": engine.felled,
            "own_solution": solution} | fronts


def json_of(found):
    scenes = [{"scene": scene.name, "worlds": scene.worlds, "frames": scene.frames, "nature_uncertainty_m": scene.uncertainty_m,
               "engines": list(map(engine_json, scene.engines))} for scene in found.scenes]
    studies = [{"file": study.path, "command_line": study.attributes["command_line"], "versions": versions_of(study)}
               for study in found.studies]
    return {"studies": studies, "scenes": scenes,
            "hard_cases": [{"setting": one.setting, "engine": one.engine, "all": one.all, "groups": one.groups} for one in found.held],
            "differences": [{"engine": engine, "text": text, "scenes": scenes} for (engine, text), scenes in found.differences.items()],
            "not_comparable": NOT_COMPARABLE}


def report_of(found):
    of_scenes = [scene_tables(scene) for scene in found.scenes]
    held = [held_table(found)] if found.held else []
    last = [difference_table(found), version_table(found)]
    sections = [Section(tables=[*sum(of_scenes, []), *held, *last], shown_in=(TEXT, MARKDOWN)),
                Section("What is not comparable", "\n".join(f"- {paragraph}" for paragraph in NOT_COMPARABLE), shown_in=(TEXT, MARKDOWN)),
                *map(scene_section, found.scenes, of_scenes)]
    if held:
        sections.append(Section("Hard cases", held[0].text, tables=[*held, case_table(found)], shown_in=(PAGE,)))
    sections.append(Section("What is not comparable", "\n\n".join(NOT_COMPARABLE), tables=last, shown_in=(PAGE,)))
    line, entries = page.origin_of_study(found.studies[0])
    return Report("Engines side by side", ", ".join(study.path for study in found.studies), sections, json_of(found), "", line, entries)


def kind_of(path):
    """Of a study: accuracy, stability, ...; empty for another file, or none."""
    try:
        with h5py.File(path, "r", locking=False) as file:
            is_study = files.text_of(file.attrs.get("filetype", b"")) == files.STUDY
            return files.text_of(file.attrs.get("study", b"accuracy")) if is_study else ""
    except OSError:
        return ""


def studies_named(options):
    """{kind: Study}, that of accuracy first."""
    paths = {}
    for path in options.files:
        kind = kind_of(path)
        require(kind in ("accuracy", "stability"), f"{path}: engines are compared by studies of accuracy and stability; this is "
                                                   + (f"a study of {kind}" if kind else "no study"))
        require(kind not in paths, f"'{path}' follows '{paths.get(kind)}': give one study of {kind}")
        paths[kind] = path
    require(paths, "no file given; name one of pbstudy accuracy, one of pbstudy stability, or both, e.g. pbreport engines accuracy.h5 "
                   "stability.h5")
    require(not options.scene or "accuracy" in paths, "--scene chooses scenes of a study of accuracy; name one")
    return {kind: files.read_study(path, kind) for kind, path in sorted(paths.items())}


def run(words):
    options = parse(COMMAND, words)
    if options is not None:
        deliver(report_of(Engines(studies_named(options), options.scene)), options)
