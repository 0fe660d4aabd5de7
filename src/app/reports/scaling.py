"""pbreport scaling: what more ranks bring, from files of runs that do the same work on different numbers of ranks."""
from reports import charts, page
from reports.command_line import Command, add_table_option, deliver, parse, require_table
from reports.document import MARKDOWN, PAGE, TEXT, Chart, Column, Report, Section, Table
from reports.files import require
from reports.runs import PHASES
from reports.scaling_curves import Rules, curves_of, files_without_curve, read_scaling_run
from reports.tables import Values, csv_of, json_of
from reports.words import percent, plural

TABLES = ("points", "phases", "runs")
UNITS = {"frame_time": "s", "processor_time": "s", "time": "s", "bytes": "B"}  # of columns; others are counts or ratios


def point_columns(curve):
    def beside_base(name):
        return lambda point: "1" if point is curve.base else str(getattr(point, name))

    def share(value):
        return lambda point: percent(point.median(value))

    return (Column("ranks", curve.label), Column("worlds", lambda point: str(point.worlds)),
            Column("runs", lambda point: str(len(point.runs))), Column("frame [ms]", lambda point: f"{1e3 * point.median('frame_s'):.4g}"),
            Column("speed-up", beside_base("speed_up")),
            Column("bound", lambda point: f"{point.bound:.2f}"), Column("efficiency", beside_base("efficiency")),
            Column("by processor time", lambda point: f"{point.processor_speed_up:.2f}" if point.processor_speed_up > 0 else "-"),
            Column("balance", share("pop.load_balance")), Column("serialisation", share("pop.serialisation")),
            Column("transfer", share("pop.transfer")), Column("computation", lambda point: percent(point.computation)),
            Column("root", share("root_share")), Column("messages", lambda point: f"{point.median('messages'):.1f}"),
            Column("kB", lambda point: f"{1e-3 * point.median('bytes'):.1f}"), Column("within budget", share("within_budget")),
            Column("reportable", lambda point: f"no: {point.doubts}" if point.doubts else "yes"))


def phases_table(curve):
    """Leaves out phases in which no rank spent time; pages have a chart of it."""
    shown = [phase for phase in PHASES if any(point.phase_s(phase) > 0 for point in curve.points)]
    columns = [Column("ms a frame, mean rank", str)]
    for point in curve.points:
        way = "" if point.decomposition == curve.decomposition else f", {point.decomposition}"
        columns.append(Column(plural(point.ranks, "rank") + way, lambda phase, point=point: f"{1e3 * point.phase_s(phase):.4f}"))
    return Table.of("", columns, shown, shown_in=(TEXT,))


def lines_chart(curve, title, text, lines, scales, kind="line"):
    """`lines`: {name: (colour, value(point), whether it is dashed)}, or bars."""
    labels, sets = list(map(curve.label, curve.points)), []
    for name, (colour, value, is_dashed) in lines.items():
        points = [charts.point(label, y, f"{name}, {label} ranks: {y:.3g}") for label, y in zip(labels, map(value, curve.points))]
        one = charts.line(name, points, colour)
        sets.append(charts.dashed(one) if is_dashed else one)
    return Chart(title, text, charts.chart(kind, sets, scales, labels))


def speed_up_chart(curve):
    lines = {"median of ratios": (charts.BLUE, lambda point: point.speed_up.median, False),
             "interval, low": (charts.BLUE, lambda point: point.speed_up.interval.low, True),
             "interval, high": (charts.BLUE, lambda point: point.speed_up.interval.high, True),
             "ideal": (charts.INK, lambda point: point.ideal, True)}
    if curve.decomposition == "spaces":
        lines["largest island on one rank"] = (charts.RED, lambda point: point.median("island_bound"), True)
    return lines_chart(curve, "Speed-up", "Ratios of the k-th runs of a point and of the base.", lines,
                       {"x": charts.axis("ranks"), "y": charts.axis("worlds a second, over the base's")})


def factors_chart(curve):
    def factor(value):
        return lambda point: 100 * point.median(value)

    lines = {"efficiency": (charts.BLACK, lambda point: 100 * point.efficiency.median, False),
             "load balance": (charts.BLUE, factor("pop.load_balance"), False),
             "serialisation": (charts.RED, factor("pop.serialisation"), False),
             "transfer": (charts.GREEN, factor("pop.transfer"), False),
             "computation": (charts.PINK, lambda point: 100 * point.computation, False)}
    text = "Factors of the POP centre of excellence, medians of the runs; their product, over the base's, is the efficiency."
    return lines_chart(curve, "What the efficiency is made of", text, lines, {"x": charts.axis("ranks"), "y": charts.axis("%")})


def phases_chart(curve):
    colours = (charts.SKY, charts.YELLOW, charts.GREEN, charts.BLUE, charts.PINK, charts.RED, charts.ORANGE, charts.BLACK, charts.GREY,
               charts.PALE)
    lines = {phase: (colour, lambda point, phase=phase: 1e3 * point.phase_s(phase), False) for phase, colour in zip(PHASES, colours)}
    return lines_chart(curve, "Time of a frame", "Mean of the ranks, median of the runs.", lines,
                       {"x": charts.axis("ranks", stacked=True), "y": charts.axis("ms", stacked=True)}, "bar")


def sections_of(curve):
    doubts = [f"on {curve.label(point)} rank{'' if point.ranks == 1 else 's'}, {point.doubts}" for point in curve.points if point.doubts]
    text = curve.base_text() + (f" Not reportable: {'; '.join(doubts)}." if doubts else "")
    points = Table.of("", point_columns(curve), curve.points)
    return [Section(curve.title(), text, [speed_up_chart(curve), factors_chart(curve), phases_chart(curve)], [points, phases_table(curve)],
                    shown_in=(TEXT, PAGE)),
            Section("", f"**{curve.title()}.** {curve.base_text()}", tables=[points], shown_in=(MARKDOWN,))]


def names_of(place, curve, point):
    """Columns that identify a point."""
    first = curve.first
    return {"curve": place, "kind": curve.kind, "scene": first.scene, "stepper": first.stepper, "precision": first.precision,
            "decomposition": point.decomposition, "ranks": point.ranks, "worlds": point.worlds}


def estimated_json(name, value):
    return {name: value.median, f"{name}_low": value.interval.low, f"{name}_high": value.interval.high}


def point_row(curve, point):
    factors = {name: point.median(f"pop.{name}") for name in ("load_balance", "serialisation", "transfer")}
    counted = {name: point.median(name) for name in ("root_share", "messages", "bytes", "within_budget")}
    return {"is_base": int(point is curve.base), "repeats": len(point.runs), "frame_time": point.median("frame_s"),
            **estimated_json("speed_up", point.speed_up), **estimated_json("efficiency", point.efficiency),
            "processor_speed_up": point.processor_speed_up, "processor_time": point.median("processor_s"),
            "confidence": point.speed_up.interval.confidence, "ideal_speed_up": point.ideal, "island_bound": point.median("island_bound"),
            **factors, "computation": point.computation, **counted, "reportable": int(not point.doubts), "doubts": point.doubts}


def tables_of(curves):
    """{table: columns}, as tables.py takes them."""
    points, phases, runs = [], [], []
    for place, curve, point in ((place, curve, point) for place, curve in enumerate(curves) for point in curve.points):
        names = names_of(place, curve, point)
        points.append(names | point_row(curve, point))
        phases += [names | {"phase": phase, "time": point.phase_s(phase)} for phase in PHASES]
        runs += [names | {"file": run.path, "created": run.created, "frames": run.frames, "frame_time": run.frame_s,
                          "state_hash": run.state_hash, "complete": int(run.complete)} for run in point.runs]
    rows_of = {"points": points, "phases": phases, "runs": runs}
    return {table: [Values(name, UNITS.get(name, ""), [row[name] for row in rows]) for name in rows[0]] for table, rows in rows_of.items()}


def report_of(runs, curves, columns):
    sections = [section for curve in curves for section in sections_of(curve)]
    left_out = [f"left out: {path}: there is no run of the same work on other ranks" for path in files_without_curve(runs, curves)]
    if left_out:
        sections.append(Section(text="\n".join(left_out), shown_in=(TEXT,)))
    line, entries = page.origin_of_runs(runs)
    subtitle = (f"{plural(len(curves), 'curve')} of {len(runs)} runs. Intervals hold the median with the confidence that the number of "
                "runs allows, 95 % from six on, 93.8 % with five.")
    return Report("Scaling", subtitle, sections, json_of(columns), line=line, entries=entries)


def add_options(group):
    group.add_argument("--least-repeats", type=int, default=Rules.least_repeats, metavar="N",
                       help="runs of a point, and of the one it is compared with, below which it is not reportable (usual: %(default)s)")
    group.add_argument("--widest-interval", type=float, default=Rules.widest_interval, metavar="SHARE",
                       help="of the median, above which a speed-up is not reportable (usual: %(default)s)")
    add_table_option(group, TABLES, "points")


COMMAND = Command("scaling", "Compares runs of the same work on different numbers of ranks: speed-up and efficiency with their intervals, "
                  "what takes the rest of the time, and which figures should not be reported, and why. jobs/scaling.sh makes such runs.",
                  "RUN.h5... [options]", page="the curves", markdown="print the points as tables in Markdown",
                  csv="one table as comma-separated values", add_options=add_options)


def run(words):
    options = parse(COMMAND, words)
    if options is None:
        return
    count = len(options.files)
    require(count >= 2, f"scaling: {count} files are given; name the HDF5 files of two runs or more")
    require(options.least_repeats >= 1, "--least-repeats: it must be at least 1")
    require(options.widest_interval > 0, "--widest-interval: it must be above 0")
    require_table(options, TABLES)
    runs = list(map(read_scaling_run, options.files))
    curves = curves_of(runs, Rules(options.least_repeats, options.widest_interval))
    require(curves, f"scaling: no two of the {count} runs do the same work on different numbers of ranks; give runs that differ in ranks "
                    "alone, or in ranks and worlds")
    columns = tables_of(curves)
    report = report_of(runs, curves, columns)
    deliver(report, options, csv_of(columns[options.table]))
