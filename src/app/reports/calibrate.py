"""pbreport calibrate: what the harness costs beside the physics, and forecasts of frames on more ranks than there are; the file of
pbstudy calibrate."""
import dataclasses
import math

from reports import harness, tables
from reports.command_line import Command, Listed, add_table_option, deliver, one_file, parse, quantity, require_table
from reports.document import Column, Report, Section, Table
from reports.files import read_study, require

TABLES = ("costs", "forecasts", "walls", "checks")
LOAD = ("ranks", "worlds", "bodies", "steps")  # what a case of frames differs in
MOST_RANKS, MOST_WORLDS, MOST_BODIES = 1 << 20, 10**12, 10**6
LAST_POWER_OF_RANKS = 131072  # for which walls are looked for
USUAL_FRAMES = 1000  # measured frames of a run whose memory is forecast
BUDGET_S = 0.1 / 30  # of a frame: default_frame_budget_s of stepping/frame.h
FLAT, TREE = "flat", "tree"  # messages straight to root and results on every rank, or by a tree of ranks to root alone


def add_options(group):
    group.add_argument("--ranks", nargs="+", action=Listed, type=int, default=[2, 64, 1024, 16384, 131072], metavar="N",
                       help="numbers of ranks; default: 2 64 1024 16384 131072")
    group.add_argument("--worlds", nargs="+", action=Listed, type=int, default=[100, 10000, 1000000, 100000000], metavar="N",
                       help="numbers of worlds; default: 100 10000 1000000 100000000")
    group.add_argument("--bodies", type=int, default=37, metavar="N", help="bodies of a world; default: 37")
    group.add_argument("--world-step", default="0", metavar="TIME",
                       help="what a step of a world takes in its engine, e.g. 40us; 0, the default: the harness alone")
    add_table_option(group, TABLES, "forecasts")


COMMAND = Command("calibrate", "Shows what the harness costs beside the physics, and computes from it what a frame takes, sends and holds "
                  "on numbers of ranks that were never there: the file of pbstudy calibrate. The word calibrate may be left out.",
                  "calibrate.h5 [options]", markdown="print the tables in Markdown", csv="one table as comma-separated values",
                  add_options=add_options)


@dataclasses.dataclass
class Forecast:
    load: harness.Load
    way: str
    traffic: harness.Traffic
    parts: dict  # seconds
    memory: harness.Memory

    @property
    def frame_s(self):
        return sum(self.parts.values())

    @property
    def longest(self):
        """Of the harness."""
        return max(harness.FRAME_PARTS[1:], key=self.parts.get)

    @property
    def in_budget(self):
        return self.frame_s <= BUDGET_S


@dataclasses.dataclass
class Wall:
    """By way: the power of two of ranks at which a part of the frame alone takes longer than the budget; 0: none up to 131,072, or up to
    as many ranks as worlds."""
    worlds: int
    part: str
    ranks: dict = dataclasses.field(default_factory=lambda: {FLAT: 0, TREE: 0})


@dataclasses.dataclass
class Check:
    """A case of frames on several ranks, and its forecast, which is not made from it."""
    case: object
    forecast_s: float


def costs_of(study):
    for row in study.rows():
        require(row.part in harness.TERMS, f"a study of calibrate has a part '{row.part}', which this pbreport does not know; use that of "
                                           "the pbstudy which wrote it")
    for name in ("rank_bytes", "body_bytes"):
        require(name in study.parameters, f"a study of calibrate has no parameter '{name}'; measure it again")
    costs = harness.fit_costs([row for row in study.rows() if row.part != "frame" or row.ranks == 1])
    costs.memory_rank, costs.memory_body = (float(study.parameters[name]) for name in ("rank_bytes", "body_bytes"))
    return costs


def forecast_of(load, costs, way):
    gather = harness.Gather(load, linear=way == FLAT)
    return Forecast(load, way, harness.traffic_of(load, gather), harness.frame_parts(load, costs, gather),
                    harness.memory_of(load, costs, gather, way == FLAT, USUAL_FRAMES))


def forecasts_of(options, costs):
    """Both ways for each number of worlds and of ranks with no fewer worlds than ranks."""
    loads = [harness.Load(ranks, worlds, options.bodies, step_s=options.step_s)
             for worlds in options.worlds for ranks in options.ranks if ranks <= worlds]
    return [forecast_of(load, costs, way) for load in loads for way in (FLAT, TREE)]


def walls_of(options, costs):
    walls = []
    for worlds in options.worlds:
        parts = [Wall(worlds, part) for part in harness.FRAME_PARTS[1:]]
        ranks = 2
        while ranks <= min(LAST_POWER_OF_RANKS, worlds):
            load = harness.Load(ranks, worlds, options.bodies, step_s=options.step_s)
            for way in (FLAT, TREE):
                seconds = harness.frame_parts(load, costs, harness.Gather(load, linear=way == FLAT))
                for wall in parts:
                    if wall.ranks[way] == 0 and seconds[wall.part] > BUDGET_S:
                        wall.ranks[way] = ranks
            ranks *= 2
        walls += parts
    return walls


def checks_of(study, costs):
    checks = []
    for row in study.rows():
        if row.part == "frame" and row.ranks > 1:
            load = harness.Load(row.ranks, row.worlds, row.bodies, row.steps)
            checks.append(Check(row, sum(harness.frame_parts(load, costs, harness.Gather(load)).values())))
    return checks


def costs_table(costs):
    """[(name, value, unit)]"""
    return [(name, value, "B" if name.startswith("memory") else "s") for name, value in dataclasses.asdict(costs).items()]


def numbers_of(costs, forecasts, walls, checks):
    times = [(f"{part}_time", "s", lambda one, part=part: one.parts[part]) for part in harness.FRAME_PARTS]
    memory = [(f"memory_{whose}", "B", lambda one, whose=whose: getattr(one.memory, whose)) for whose in ("any_rank", "root", "row_writer")]
    return {
        "costs": tables.columns_of(costs_table(costs), ("cost", "", lambda one: one[0]), ("value", "", lambda one: one[1]),
                                   ("unit", "", lambda one: one[2])),
        "forecasts": tables.columns_of(
            forecasts, ("worlds", "", lambda one: one.load.worlds), ("ranks", "", lambda one: one.load.ranks),
            ("gather", "", lambda one: one.way), ("messages", "", lambda one: one.traffic.all[0]),
            ("bytes", "B", lambda one: one.traffic.all[1]), ("messages_into_root", "", lambda one: one.traffic.into_root[0]),
            ("bytes_into_root", "B", lambda one: one.traffic.into_root[1]),
            ("bytes_of_busiest_rank", "B", lambda one: one.traffic.busiest_rank_bytes), *times,
            ("frame_time", "s", lambda one: one.frame_s), ("longest_part", "", lambda one: one.longest),
            ("within_budget", "", lambda one: int(one.in_budget)), *memory),
        "walls": tables.columns_of(walls, ("worlds", "", lambda wall: wall.worlds), ("part", "", lambda wall: wall.part),
                                   *((f"{way}_ranks", "", lambda wall, way=way: wall.ranks[way]) for way in (FLAT, TREE))),
        "checks": tables.columns_of(checks, *((name, "", lambda check, name=name: getattr(check.case, name)) for name in LOAD),
                                    ("measured", "s", lambda check: check.case.seconds), ("forecast", "s", lambda check: check.forecast_s))}


def time_text(seconds):
    for least, scale, unit in ((1, 1, "s"), (1e-3, 1e3, "ms"), (1e-6, 1e6, "us")):
        if seconds >= least:
            return f"{scale * seconds:.3g} {unit}"
    return f"{1e9 * seconds:.3g} ns"


def bytes_text(size):
    units = ["B", "kB", "MB", "GB", "TB"]
    while size >= 1000 and len(units) > 1:
        size /= 1000
        del units[0]
    return f"{size:.3g} {units[0]}"


FORECAST_COLUMNS = (Column("worlds", lambda one: str(one.load.worlds)), Column("ranks", lambda one: str(one.load.ranks)),
                    Column("gather", lambda one: one.way), Column("messages into root", lambda one: str(one.traffic.into_root[0])),
                    Column("bytes into root", lambda one: bytes_text(one.traffic.into_root[1])),
                    Column("busiest rank", lambda one: bytes_text(one.traffic.busiest_rank_bytes)),
                    Column("frame", lambda one: time_text(one.frame_s)), Column("gather", lambda one: time_text(one.parts["gather"])),
                    Column("memory of a rank", lambda one: bytes_text(one.memory.any_rank)),
                    Column("of root", lambda one: bytes_text(one.memory.root)),
                    Column("longest part", lambda one: one.longest + ("" if one.in_budget else ", over the budget")))
COST_COLUMNS = (Column("cost", lambda one: one[0]), Column("value", lambda one: (time_text if one[2] == "s" else bytes_text)(one[1])))
WALL_COLUMNS = (Column("worlds", lambda wall: str(wall.worlds)), Column("part", lambda wall: wall.part),
                *(Column(f"{way}: from ranks", lambda wall, way=way: str(wall.ranks[way] or "none")) for way in (FLAT, TREE)))
CHECK_COLUMNS = (*(Column(name, lambda check, name=name: str(getattr(check.case, name))) for name in LOAD),
                 Column("measured", lambda check: time_text(check.case.seconds)),
                 Column("forecast", lambda check: time_text(check.forecast_s)),
                 Column("forecast / measured", lambda check: f"{check.forecast_s / check.case.seconds:.2f}"))


def section(text, columns, rows):
    return Section(text=text, tables=[Table.of("", columns, rows)]) if rows else Section(text=f"{text}\n\nnone")


def report_of(study, options):
    """(the report, its tables of numbers)"""
    costs = costs_of(study)
    forecasts, walls, checks = forecasts_of(options, costs), walls_of(options, costs), checks_of(study, costs)
    numbers = numbers_of(costs, forecasts, walls, checks)
    question = f"worlds of {options.bodies} bodies that take {time_text(options.step_s)} a step, budget {time_text(BUDGET_S)}"
    sections = [section("Costs of the harness, measured:", COST_COLUMNS, costs_table(costs)),
                section(f"Forecast of a frame, {question}:", FORECAST_COLUMNS, forecasts),
                section("From how many ranks on a part alone takes longer than the budget:", WALL_COLUMNS,
                        [wall for wall in walls if any(wall.ranks.values())]),
                section("Frames of the ranks that there were, measured and forecast:", CHECK_COLUMNS, checks)]
    return Report("What the harness costs", study.path, sections, tables.json_of(numbers)), numbers


def seconds(text):
    """A time with its unit, or a number of seconds."""
    try:
        value = float(text)
    except ValueError:
        return quantity(text, "time", "--world-step")
    return value if value >= 0 and math.isfinite(value) else quantity(text, "time", "--world-step")


def run(words):
    options = parse(COMMAND, words)
    if options is None:
        return
    path = one_file(options, "a study of calibrate", "calibrate.h5")
    require_table(options, TABLES)
    for name, least, most in (("ranks", 2, MOST_RANKS), ("worlds", 1, MOST_WORLDS)):
        for number in getattr(options, name):
            require(least <= number <= most, f"--{name} {number}: it must be from {least} to {most}")
    require(0 <= options.bodies <= MOST_BODIES, f"--bodies: it must be from 0 to {MOST_BODIES}")
    options.step_s = seconds(options.world_step)
    report, numbers = report_of(read_study(path, "calibrate"), options)
    deliver(report, options, tables.csv_of(numbers[options.table]))
