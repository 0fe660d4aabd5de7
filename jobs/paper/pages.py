"""The reports on the paper's figures, on its statements, and on a study of value prediction: what their pages show, and what is printed."""
import math

from reports import charts, page
from reports.charts import BLACK, BLUE, GREEN, ORANGE, PINK, RED, SKY, YELLOW
from reports.document import MARKDOWN, PAGE, Chart, Report, Section, Table
from reports.words import NO_NUMBER, number, percent

import figures
import instructions
import islands
import prediction
import report
from statements.prediction import judge_study
from statements.statement import FINDINGS

PAPER = "Yeh, Faloutsos, Reinman 2006"
MAKER = "jobs/paper/paper.py"
METHOD_COLOURS = ("#3d4650", BLUE, SKY, GREEN, ORANGE, PINK, RED)
BAND_COLOURS = (GREEN, YELLOW, ORANGE, RED, BLACK)
FINDING_COLOURS = (GREEN, RED, "#8a949e")
PREDICTION_COLOURS = (BLUE, SKY, ORANGE, RED, GREEN, PINK)


def report_of(title, subtitle, sections, origin, text, numbers=None, markdown=""):
    """The sections are those of the page; the text and the Markdown are as they are printed."""
    for section in sections:
        section.shown_in = (PAGE,)
    return Report(title, subtitle, [*sections, Section(text=markdown, shown_in=(MARKDOWN,))], numbers, text, *origin)


def bars_of(label, names, values, colour, **others):
    """A bar, or part of a stack, over each name; none where there is no value."""
    pairs = [(name, value) for name, value in zip(names, values) if value is not None and math.isfinite(value)]
    return charts.bars(label, [charts.point(name, value, f"{label}: {value:.4g}") for name, value in pairs], colour, **others)


def bar_chart(title, text, names, sets, axis, **marks):
    """`marks`: bands, and a key instead of the sets' own."""
    config = charts.chart("bar", sets, {"y": axis}, names, **marks)
    if "key" in marks:
        config["options"]["plugins"]["legend"] = {"display": False}
    return Chart(title, text, config)


def share_axis(text="%"):
    return charts.axis(text, max=100)


def figure3_section(counts, works):
    """Instructions of a frame; `works` for the scenes in which direct was not counted."""
    cost = instructions.counted_cost(counts, works)
    direct = [instructions.direct_cost(scene, cost, works) for scene in counts]

    def millions(is_counted):
        return [one.middle / 1e6 if one and one.is_counted == is_counted else None for one in direct]

    names = [scene.name for scene in counts]
    sets = [bars_of("quick", names, [scene.quick.per_frame / 1e6 if scene.quick else None for scene in counts], BLUE),
            bars_of("direct", names, millions(True), RED)]
    if any(value is not None for value in millions(False)):
        sets.append(bars_of("direct, extrapolated", names, millions(False), ORANGE))
    chart = bar_chart("Instructions of a frame", "Millions, logarithmic; mean of the measured frames.", names, sets,
                      charts.axis("million instructions", "logarithmic"))
    text = ("Inside the stepper, counted by callgrind. An instruction counts as what it computes, its access to memory besides as a load or "
            "a store. The paper prints the figure without numbers; its text says that quick takes far fewer instructions than direct. It "
            f"counts single-precision code of 2006, this is double precision.\n\n{instructions.law_text(cost)}")
    return Section("Figure 3: instructions of a frame", text, [chart], [mix_table(counts, direct)])


def mix_table(counts, direct):
    def row(scene, stepper, millions, mix, collision):
        return [scene, stepper, millions, *(percent(share, 0) for share in mix), collision]

    def counted(scene, stepper, one):
        return row(scene, stepper, instructions.millions(one.per_frame), one.mix, percent(one.collision_share, 0))

    rows, quick = [], [scene.quick for scene in counts if scene.quick]
    for scene, cost in zip(counts, direct):
        if scene.quick:
            rows.append(counted(scene.name, "quick", scene.quick))
        if scene.direct:
            rows.append(counted(scene.name, "direct", scene.direct))
        else:
            rows.append([scene.name, "direct", instructions.direct_text(cost), *[""] * (len(instructions.MIX) + 1)])
    share = sum(one.collision_share for one in quick) / len(quick) if quick else 0
    rows.append(row("all", "quick", "", instructions.mean_mix([one.mix for one in quick]), percent(share, 0)))
    rows.append(row("paper", "", "", instructions.PAPER_MIX, "7 % (2 to 20 %)"))
    return Table("Numbers", ["scene", "stepper", "millions", *instructions.MIX, "collision"], rows)


def figure3_page(counts, works, files):
    return report_of("Instructions of a frame", f"Figure 3 of {PAPER}", [figure3_section(counts, works)], page.origin_of_runs(files, MAKER),
                     instructions.figure3_text(counts, works))


FORMS = (("serial", "serial", charts.INK), ("islands parallel", "islands_parallel", BLUE),
         ("islands and spaces parallel", "spaces_parallel", ORANGE))


def forms_chart(scenes, title, text, value, axis, **marks):
    """Figure 6: value(rate) of the serial rate, and of the rate with a core for each island, then also for each space."""
    names = [one.scene for one in scenes]
    sets = [bars_of(label, names, [value(getattr(one, form)) for one in scenes], colour) for label, form, colour in FORMS]
    return bar_chart(title, text, names, sets, axis, **marks)


def rates_chart(scenes, text):
    levels = [charts.band(hz, hz, label, colour, dash=[6, 4], showValue=False)
              for hz, label, colour in ((30, "line at 30 Hz", RED), (300, "line at 300 Hz, the budget", GREEN))]
    return forms_chart(scenes, "Frame rate", text, lambda rate: rate.hz, charts.axis("Hz", "logarithmic"), bands=levels)


def satisfied_chart(scenes):
    return forms_chart(scenes, "Satisfied frames", "Share of the measured frames within 3.33 ms [%].", lambda rate: 100 * rate.satisfied,
                       share_axis())


def islands_table(scenes):
    """Table 1."""
    table = islands.report_of(scenes).sections[0].tables[0]
    table.title = "Islands"
    return table


def cores_table(scenes):
    """Table 2."""
    rows = []
    for one in scenes:
        paper = islands.PAPER.get(one.scene)
        rows.append([one.scene, str(one.cores), f"{one.cores_mean:.1f}", str(paper.cores) if paper else NO_NUMBER,
                     percent(one.longest_share, 0), *(f"{rate.hz:.1f}" for rate in (one.serial, one.islands_parallel, one.spaces_parallel)),
                     percent(one.collide_share_serial, 0), percent(one.collide_share_parallel, 0)])
    return Table("Cores", ["scene", "cores", "mean", "paper", "longest island of all islands' time", "serial [Hz]", "islands parallel [Hz]",
                           "and spaces [Hz]", "collision, serial", "collision, islands parallel"], rows)


def figure6_page(scenes, pictures, files):
    """`pictures`: [(scene, PNG)]."""
    rates = ("Harmonic mean over the measured frames [Hz], logarithmic. Serial is measured. Islands parallel: the solver takes as long as its "
             "longest island. Islands and spaces parallel: collision detection, too, takes as long as its longest space and what lies between "
             "spaces. Both assume a core each and no cost of communication, as the paper does. Of each frame the last step is taken apart, and "
             "stands for the frame. The paper prints its bars without numbers; its text says that on its processor only 2-Cars, 10-Cars and "
             "CrashSk met the budget serially, that 100CrSk gains most from parallel islands, Battle and Fight less, and that CrashWa, Environ "
             "and Battle2 gain little.")
    sections = [
        Section("Figure 6: frame rate", rates, [rates_chart(scenes, "Lines: 30 Hz, and 300 Hz, the budget of a tenth of a frame.")]),
        Section("Figure 6: satisfied frames", "", [satisfied_chart(scenes)]),
        Section("Table 1: islands", "At the end of each measured frame, over all worlds. Contacts across spaces: contact points between bodies "
                                    "of different spaces, mean of the measured frames' last steps.", tables=[islands_table(scenes)]),
        Section("Table 2: cores for full parallelism",
                "Fewest cores on which the islands of a step, longest first, end at most 5 % after the longest island alone; in the worst "
                "measured frame. The share of collision detection is of the frame's serial time, then of the time with islands in parallel "
                "(paper, of all scenes: solver 92 % of the serial time; collision detection 20 % on average, 55 % at most with islands in "
                "parallel).", tables=[cores_table(scenes)])]
    if pictures:
        sections.append(Section("The scenes", "Each from the replay of its run.", pictures=pictures))
    return report_of("PhysicsBench", "The paper's Figure 6 and Tables 1 and 2 beside this machine's, stepper quick.", sections,
                     page.origin_of_runs(files, MAKER), "")


def methods_chart(scenes, title, text, axis, value):
    """One bar a scene and method."""
    names = [scene.name for scene in scenes]
    sets = []
    for place, label in enumerate(figures.labels_of(scenes)):
        methods = [scene.find(label) for scene in scenes]
        sets.append(bars_of(label, names, [value(one) if one else None for one in methods], METHOD_COLOURS[place % len(METHOD_COLOURS)]))
    return bar_chart(title, text, names, sets, axis)


def share(errors, band):
    """Of the entries in a category [%]."""
    return 100 * errors["bands"][band] / errors["count"] if errors["count"] else 0


def errors_chart(scenes, title, key, bands):
    """One stack of five categories a method and scene. Iter20 is left out: it is the reference."""
    labels = [label for label in figures.labels_of(scenes) if label != figures.REFERENCE]
    names = [scene.name for scene in scenes]

    def of_method(scene, label, band):
        method = scene.find(label)
        return share(method.errors[key], band) if method else None

    def of_floor(scene, band):
        return sum(share(errors[key], band) for errors in scene.floor) / len(scene.floor) if scene.floor else 0

    sets = []
    for band, name in enumerate(bands):
        stacks = {label: [of_method(scene, label, band) for scene in scenes] for label in labels}
        stacks["noise floor"] = [of_floor(scene, band) for scene in scenes]
        sets += [bars_of(f"{label}: {name}", names, values, BAND_COLOURS[band], stack=label) for label, values in stacks.items()]
    key = [{"label": name, "shape": "bar", "colour": colour} for name, colour in zip(bands, BAND_COLOURS)]
    return bar_chart(title, f"Bars of a scene, in this order: {', '.join([*labels, 'noise floor'])}.", names, sets,
                     share_axis("% of entries"), key=key)


def method_rows(scenes):
    return [[scene.name, method.label, f"{method.rate_hz:.1f}", f"{100 * method.satisfied:.0f}", f"{1e3 * method.frame_s:.3f}",
             f"{scene.ratio(method):.2f}" if method.is_estimate else "", "equal to Iter20's" if method.same_hash else "another",
             str(method.num_runs)] for scene in scenes for method in scene.methods]


def errors_table(scenes, title, key, unit, bands):
    def row(scene, label, errors):
        return [scene.name, label, *(f"{errors[name]:.3g}" for name in ("rms", "p99", "max")), *map(str, errors["bands"])]

    rows = []
    for scene in scenes:
        rows += [row(scene, method.label, method.errors[key]) for method in scene.methods if method.label != figures.REFERENCE]
        rows += [row(scene, "another seed", errors[key]) for errors in scene.floor]
    return Table(title, ["scene", "method", f"rms {unit}", f"p99 {unit}", f"max {unit}", *bands], rows)


def figure8_9_sections(scenes):
    ratios = [(label, figures.mean_ratio(scenes, label)) for label in figures.labels_of(scenes)]
    ratio_text = " ".join(f"{label}: {ratio:.2f} ({100 * (ratio - 1):+.0f} %)." for label, ratio in ratios if ratio > 0)
    rates = Section(
        "Figure 8: frame rate, and frames within the budget of 3.33 ms",
        "Mean over the scenes of the time of an Iter20 frame over the time until its estimate is delivered: "
        f"{ratio_text} The paper: +220 %, i.e. 3.2.\n\nThe rate of an estimate is that of its deliveries: what consumers see. The precise "
        "result follows later in the same frame.",
        [methods_chart(scenes, "Frame rate", "Harmonic mean of the measured frames [Hz], logarithmic.", charts.axis("Hz", "logarithmic"),
                       lambda one: one.rate_hz),
         methods_chart(scenes, "Satisfied", "Frames, or deliveries, within the budget [%].", share_axis(),
                       lambda one: 100 * one.satisfied)],
        [Table("Numbers", ["scene", "method", "frame rate Hz", "satisfied %", "ms", "Iter20 / delivery", "precise state", "runs"],
               method_rows(scenes))])
    errors = Section(
        "Figure 9: errors against 20 iterations",
        "Iter19 and Iter1: drift. FEEC: of the delivered estimates; since their precise run is Iter20's bit for bit, this is the defect of the "
        "estimator, and the drift of what FEEC goes on from is zero. The last bar is the noise floor: 20 iterations with other solver seeds. A "
        "method whose bar looks like that one is as good as can be told.\n\nThe shortest rotation is at most half a turn, so that the "
        "orientation category beyond 50 % stays empty.",
        [errors_chart(scenes, title, f"{name}_{unit}", bands) for name, unit, title, _, bands in figures.ERRORS],
        [errors_table(scenes, title + more, f"{name}_{unit}", unit, bands) for name, unit, title, more, bands in figures.ERRORS])
    return [rates, errors]


def figure8_9_page(scenes, files):
    return report_of("Fast estimation with error control", f"Figures 8 and 9 of {PAPER}", figure8_9_sections(scenes),
                     page.origin_of_runs(files, MAKER), figures.figures_text(scenes))


def overview(chapters):
    counts = [report.count_findings(chapter.entries) for chapter in chapters]
    names = [chapter.name for chapter in chapters]
    sets = [bars_of(finding, names, values, colour, stack="statements")
            for finding, values, colour in zip(FINDINGS, zip(*counts), FINDING_COLOURS)]
    chart = bar_chart("Verdicts", "Statements of each part of the paper.", names, sets, charts.axis("statements"))
    text = ("Each statement of the paper with the rule by which it counts as confirmed, which was set before the number was known, and what "
            "was measured. What rests on a clock is of the machine and the day in the foot of this page; what rests on counts is the same in "
            "each run.\n\nThe scenes are built to the paper's description, which has no parameters, and their islands to its Table 1: that "
            "this table is met says that such scenes exist. ODE here is version 0.16 in double precision, with a simple or a sweep-and-prune "
            "space; the paper ran it in single precision with a hash space on a Pentium 4 Xeon of 2.4 GHz, and on a modelled processor of "
            "3 GHz. A car's wheels hang on hinge2 joints with a suspension instead of four sliders.")
    return Section("Verdicts", text, [chart])


def paper_page(chapters, data):
    sections = [overview(chapters)]
    sections += [Section(chapter.title, tables=[Table("Statements", report.HEADER, list(map(report.cells_of, chapter.entries)))])
                 for chapter in chapters]
    if data.counts:
        sections.append(figure3_section(data.counts, data.works()))
    if data.suite:
        sections.append(Section("Figure 6: frame rates", "One core; an unlimited number of cores for islands, then also for spaces, without "
                                                         "overheads.",
                                [rates_chart(data.suite, "Harmonic mean of the measured frames [Hz], logarithmic.")]))
    if data.figures:
        sections += figure8_9_sections(data.figures)
    return report_of("The paper, statement by statement",
                     "Yeh, Faloutsos, Reinman: Enabling Real-Time Physics Simulation in Future Interactive Entertainment, 2006", sections,
                     page.origin_of_runs(data.files, MAKER), report.paper_text(chapters), report.paper_json(chapters),
                     report.paper_markdown(chapters))


def prediction_chart(study, title, axis, value):
    names = [scene.name for scene in study.scenes]
    by_bar = zip(*(prediction.figure_8(scene, study.fvp) for scene in study.scenes))
    sets = [bars_of(of_scenes[0].name, names, [value(bar.rate) for bar in of_scenes], colour)
            for of_scenes, colour in zip(by_bar, PREDICTION_COLOURS)]
    return bar_chart(title, "", names, sets, axis)


def cases_section(scene):
    rms, bands = scene.base.errors["floor"]
    rows = []
    for case in scene.cases:
        hits = case.hits()
        rows.append([case.name, percent(hits.coverage()), percent(hits.hit_rate()), number(hits.mean_error(), ".2g"),
                     f"{hits.error_max:.2g}" if hits.fuzzy > 0 else "-",
                     *report.errors_cells(case), number(case.islands, ".1f"), case.fate()])
    head = ["case", "coverage", "hit rate", "mean accepted error", "largest", "drift [mm]", "defect [mm]",
            "< 1 cm/1-10/10-100/> 100 cm/inf or NaN", "islands", ""]
    return Section(scene.name, f"{report.plural_worlds(scene)}. Errors of positions against the unpredicted run; noise floor (another solver "
                               f"seed): {1e3 * rms:.3g} mm, {report.bands_text(bands)}.", tables=[Table("Cases", head, rows)])


def prediction_page(study):
    tables = [Table("The paper's statements", ["statement", "finding", "number", "confirmed if"],
                    [[one.statement.text, one.finding, one.ours, one.statement.rule] for one in judge_study(study)]),
              Table(f"Hits of floating-point results by engine, exact and {study.fvp}", report.ENGINE_HEAD, report.engine_rows(study))]
    if study.sensitivity:
        rows = [[row.scene, row.case, row.variant, f"{row.cycles:.0f}", f"{row.predicted_cycles:.0f}", f"{100 * row.gain():+.2f} %"]
                for row in study.sensitivity]
        tables.append(Table("What other processors would change", ["scene", "case", "processor", "cycles", "with prediction", "gain"], rows))
    first = Section("Figure 8 on the modelled processor",
                    f"Table 3 at 3 GHz; a frame is satisfied within {1e3 * study.budget_s:.3g} ms. A bar is missing where no measured frame was "
                    "left.", [prediction_chart(study, "Frame rate", charts.axis("Hz", "logarithmic"), lambda rate: rate.hz),
                              prediction_chart(study, "Frames satisfied", share_axis(), lambda rate: 100 * rate.satisfied)], tables)
    return report_of("Value prediction", study.file.attributes["command_line"], [first, *map(cases_section, study.scenes)],
                     page.origin_of_study(study.file, MAKER), report.prediction_text(study), report.prediction_json(study),
                     report.prediction_markdown(study).removesuffix("\n"))
