"""pbreport stability: which settings hold the hard cases; the file of pbstudy stability."""
import collections
import dataclasses
import math
import statistics

from reports import page
from reports.command_line import Command, add_scene_option, deliver, one_file, parse
from reports.document import MARKDOWN, PAGE, TEXT, Column, Report, Section, Table
from reports.files import in_order_of, read_study
from reports.words import NO_NUMBER, plural

COMMAND = Command("stability", "Shows which settings hold the hard cases: the file of pbstudy stability. The word stability may be left "
                  "out.", "stability.h5 [options]", page="a map of cases and settings, and how to see each run",
                  markdown="print the map as a table instead", csv="all cases as comma-separated values", add_options=add_scene_option)

PASS, DEGRADED, BROKEN, NOT_APPLICABLE = VERDICTS = ("pass", "degraded", "broken", "n/a")  # the last: the setting cannot run the case
# What is measured in every run, in the order of JSON (io/SCHEMA.md).
METRICS = ("nonfinite", "energy_gain", "energy_change", "linear_momentum", "angular_momentum", "joint_gap", "joint_gap_rms", "penetration",
           "escaped", "drift", "sink", "creep", "speed")
MOST_BROKEN = 0.05  # share of the hard cases that a setting may break and still holds: the default breaks 2 of 99
FRAME_S = 1 / 30  # of a run that shows a case, as near as its steps allow
MAP_TEXT = ("Each case says what should happen, and how far from it a run may be: what a verdict rests on is in its field, and case by case below. "
            "Green: as it should be; yellow: degraded; red: broken; grey: cannot be run. The commands below write a file whose page, "
            "pbreport case.h5 --html case.html, has the curves and the replay.")
DRIFT_BANDS = ("< 1 cm", "1-10 cm", "10-100 cm", "> 100 cm", "inf/NaN")


@dataclasses.dataclass
class Scene:
    """A hard case. `results`: its rows of /cases, one for each of the map's settings."""
    name: str
    results: list = dataclasses.field(default_factory=list)

    @property
    def facts(self):
        """What all of its rows have in common."""
        return self.results[0]


@dataclasses.dataclass
class Map:
    """The hard cases under all settings, in the order of the file."""
    settings: list
    scenes: list

    def rows_of(self, place, group=None):
        """The rows of a setting, of all cases or of a group's."""
        return [scene.results[place] for scene in self.scenes if group in (None, scene.facts.group)]

    def counts(self):
        """How many cases have each verdict, setting by setting."""
        return [count(self.rows_of(place)) for place in range(len(self.settings))]


def count(rows):
    """{verdict: how many of the rows have it}"""
    return {verdict: sum(row.verdict == verdict for row in rows) for verdict in VERDICTS}


def map_of(study, names=()):
    scenes, settings = {}, {}
    for row in study.rows():
        scenes.setdefault(row.scene, Scene(row.scene)).results.append(row)
        settings[row.setting] = None
    return Map(list(settings), in_order_of(names, list(scenes.values()), lambda scene: scene.name))


@dataclasses.dataclass
class Tally:
    """How many hard cases a setting was tried on, and how many of them it broke."""
    tried: int = 0
    broken: int = 0

    def holds(self):
        return 0 < self.tried and self.broken <= MOST_BROKEN * self.tried

    def remark(self):
        """Why the setting is not to be chosen; empty if it holds."""
        if self.holds():
            return ""
        return f"breaks {self.broken} of {self.tried} hard cases" if self.tried else "not tried on the hard cases"


def step_key(options, dt_s):
    """What two settings have in common that step alike: their options, as pbmpi takes them, and the step [s]."""
    words = options.split()
    return frozenset(one for one in zip(words[::2], words[1::2]) if one[0] != "--dt"), f"{dt_s:g}"


def tallies(study):
    """{step_key: Tally} of the settings of whole worlds. A setting without a step of its own takes each case's: that of most counts."""
    rows = collections.defaultdict(list)
    for row in study.rows():
        if not row.cut:
            rows[row.setting].append(row)
    found = collections.defaultdict(Tally)
    for some in rows.values():
        tally = found[step_key(some[0].options, statistics.mode(row.dt for row in some))]
        verdicts = count(some)
        tally.tried += len(some) - verdicts[NOT_APPLICABLE]
        tally.broken += verdicts[BROKEN]
    return found


def with_unit(value, unit):
    """"1.2 mm" rather than 0.0012 m."""
    if unit in ("m", "m/s") and abs(value) < 1:
        return f"{1e3 * value:.3g} m{unit}"
    return f"{value:.3g} {unit}".rstrip()


def decided_text(row):
    """"drift 12.3 mm", "sink 1.2 m at 3.1 s" of a broken case; empty where the setting could not run it."""
    if row.verdict == NOT_APPLICABLE:
        return ""
    at = f" at {row.broken_at:.3g} s" if row.verdict == BROKEN and math.isfinite(row.broken_at) else ""
    return f"{row.decided_by} {with_unit(row.value, row.value_unit)}{at}"


def bound_text(bound, row):
    """A bound of what decides, with its unit; "-" where there is none."""
    return with_unit(bound, row.value_unit) if math.isfinite(bound) else NO_NUMBER


RESULT = (Column("setting", lambda row: row.setting), Column("verdict", lambda row: row.verdict),
          Column("right up to", lambda row: bound_text(row.limit_right, row)),
          Column("broken beyond", lambda row: bound_text(row.limit_broken, row)),
          Column("decided by", lambda row: decided_text(row) or row.decided_by))


def command(row):
    """That makes the run of a case anew; none for a world that only this study cuts."""
    if row.verdict == NOT_APPLICABLE or row.cut:
        return ""
    steps = max(1, round(FRAME_S / row.dt))
    return (f"pbmpi --scene {row.scene} {row.options} --warmup 0 --steps-per-frame {steps} --frames {math.ceil(row.seconds / (steps * row.dt))} "
            "--output case.h5")


def scene_section(scene):
    one = scene.facts
    return Section(f"{scene.name} (row {one.row}, {plural(one.bodies, 'body', 'bodies')}, {one.seconds:g} s): {one.oracle}",
                   tables=[Table.of("", RESULT, scene.results, shown_in=(TEXT,)),
                           Table.of("", (*RESULT, Column("run", command)), scene.results, shown_in=(PAGE,))], shown_in=(TEXT, PAGE))


def counts_table(found):
    return Table("", ["setting", *VERDICTS], [[setting, *map(str, one.values())] for setting, one in zip(found.settings, found.counts())])


def markdown_cell(row):
    return {PASS: "ok", DEGRADED: decided_text(row), BROKEN: f"**{decided_text(row)}**", NOT_APPLICABLE: "-"}[row.verdict]


def map_table(found):
    """A case a row and a setting a column; below, how many cases have each verdict."""
    rows = [[str(scene.facts.row), f"`{scene.name.partition('/')[2] or scene.name}`", *map(markdown_cell, scene.results)]
            for scene in found.scenes]
    return Table("", ["row", "case", *found.settings], rows + counts_rows(found), of_words=True)


def coloured_map(found):
    """The same for pages, each verdict in its colour."""
    rows = [[str(scene.facts.row), scene.name, *(decided_text(row) or row.verdict for row in scene.results)] for scene in found.scenes]
    looks = [["", "", *(row.verdict.replace("/", "") for row in scene.results)] for scene in found.scenes]
    return Table("Map of cases and settings", ["row", "case", *found.settings], rows + counts_rows(found), looks=looks)


def counts_rows(found):
    return [["", verdict, *(str(one[verdict]) for one in found.counts())] for verdict in VERDICTS]


def cell_json(row):
    return {"setting": row.setting, "dt_s": row.dt, "verdict": row.verdict, "decided_by": row.decided_by, "value": row.value,
            "unit": row.value_unit, "right_up_to": row.limit_right, "broken_beyond": row.limit_broken, "broken_at_s": row.broken_at,
            "simulated_s": row.simulated, "row_visits": row.row_visits, "step_time_s": row.step_time,
            "drift_category": DRIFT_BANDS[row.drift_band], "metrics": {name: getattr(row, name) for name in METRICS}}


def scene_json(scene):
    one = scene.facts
    return {"scene": scene.name, "group": one.group, "row": one.row, "oracle": one.oracle, "source": one.source, "bodies": one.bodies,
            "seconds": one.seconds, "results": list(map(cell_json, scene.results))}


def report_of(study, found):
    line, entries = page.origin_of_study(study)
    subtitle = f"{plural(len(found.scenes), 'hard case')}, {plural(len(found.settings), 'setting')}; {study.attributes['command_line']}"
    sections = [Section(tables=[counts_table(found)], shown_in=(TEXT,)), Section("", MAP_TEXT, tables=[coloured_map(found)], shown_in=(PAGE,)),
                *map(scene_section, found.scenes),
                Section(tables=[map_table(found)], shown_in=(MARKDOWN,))]
    head = f"study: stability; {plural(len(found.scenes), 'case')}, each judged by the bounds in its scene file\n"
    numbers = {"settings": found.settings, "cases": list(map(scene_json, found.scenes))}
    return Report("Stability", subtitle, sections, numbers, head, line, entries)


def run(words):
    options = parse(COMMAND, words)
    if options is None:
        return
    study = read_study(one_file(options, "a study of stability", "stability.h5"), "stability")
    found = map_of(study, options.scene)
    deliver(report_of(study, found), options, study.tables["cases"])
