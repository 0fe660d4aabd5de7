"""Work-precision diagrams of a study of accuracy: the time of settings against their error."""
import math

from reports import charts
from reports.document import Chart
from reports.words import plural, stepper_in

SHAPES = ("circle", "triangle", "rect", "rectRot", "star")  # of points, by the number of substeps; what is beyond shares the last
DASHES = {"ode": [7, 3], "coulomb": [2, 3]}  # of lines, by sor's law
ASKED = {"colour": charts.RED, "dash": [6, 4]}  # how limits are drawn
SMALL = 1.6  # radius [pixels] of points that are on no line


class Marks:
    """The shape of a point shows its number of substeps, the size its number of iterations, a dark edge a step below the longest."""

    def __init__(self, settings):
        self.substeps = sorted({one.row.substeps for one in settings})
        self.most_iterations = max((one.row.iterations for one in settings), default=1)
        self.longest_s = max((one.row.dt for one in settings), default=0.0)
        self.has_shorter = any(self.is_short(one) for one in settings)

    def is_short(self, one):
        return one.row.dt < 0.999 * self.longest_s

    def shape(self, substeps):
        return SHAPES[min(self.substeps.index(substeps), len(SHAPES) - 1)]

    def radius(self, iterations):
        """In pixels: 3 for one iteration, 6.5 for the most, linear in the logarithm in between."""
        return 3 + 3.5 * math.log2(max(1, iterations)) / max(1.0, math.log2(self.most_iterations))

    def of(self, settings, colour):
        """How Chart.js draws their points."""
        return {"pointStyle": [self.shape(one.row.substeps) for one in settings],
                "pointRadius": [self.radius(one.row.iterations) for one in settings],
                "pointBorderColor": [charts.INK if self.is_short(one) else colour for one in settings],
                "pointBorderWidth": [2.2 if self.is_short(one) else 1 for one in settings]}

    def key(self):
        entries = [{"label": plural(substeps, "substep"), "shape": shape} for substeps, shape in zip(self.substeps, SHAPES)]
        if len(self.substeps) > len(SHAPES):
            entries[-1]["label"] += " or more"
        for iterations in sorted({1, self.most_iterations}):
            entries.append({"label": plural(iterations, "iteration"), "shape": "circle", "radius": self.radius(iterations)})
        if self.has_shorter:
            entries.append({"label": f"dt below {self.longest_s:g} s", "shape": "circle", "stroke": charts.INK, "width": 2.2})
        return entries


def point(one, y_mm):
    sweeps = f" ({plural(one.row.substeps, 'substep')} of {plural(one.row.iterations, 'iteration')})" if one.iterates else ""
    return charts.point(1e3 * one.time_s, y_mm, f"{one.setting()}{sweeps}: {1e3 * one.time_s:.3f} ms, {y_mm:.4g} mm")


def bands(scene, limit, measure):
    """How far nature may be off, and the limits asked for."""
    def line(value, axis, label):
        return charts.band(value, value, label, axis=axis, **ASKED)

    uncertainty_mm = 1e3 * scene.uncertainty_m(measure)
    found = [] if math.isnan(uncertainty_mm) else [charts.band(0, uncertainty_mm, "uncertainty of nature [mm]")]
    if limit.budget_s:
        found.append(line(1e3 * limit.budget_s, "x", "budget [ms]"))
    if limit.tolerance_m and measure == limit.measure:
        found.append(line(1e3 * limit.tolerance_m, "y", "tolerance [mm]"))
    return found


def colour_of(one):
    return charts.GREEN if stepper_in(one.row.setting).endswith("single") else charts.ENGINES[one.stepper]


def lines(scene, measure, marks):
    """For each method the settings that no other of it beats, joined by a line; then all other settings, small."""
    by_method = {}
    for one in scene.settings:
        if not math.isnan(one.error_m(measure)):
            by_method.setdefault(one.method(), []).append(one)
    sets, small = [], []
    for label, settings in sorted(by_method.items()):
        front, colour = scene.front(measure, settings), colour_of(settings[0])
        small += [one for one in settings if one.finite() and one not in front]
        law = settings[0].options().get("law")
        sets.append(charts.line(label, [point(one, 1e3 * one.error_m(measure)) for one in front], colour, showLine=True, borderWidth=1.8,
                                borderDash=DASHES.get(law, []), **marks.of(front, colour)))
    if small:
        sets.append({"label": "other settings", "data": [point(one, 1e3 * one.error_m(measure)) for one in small], "keyShape": "circle",
                     "backgroundColor": list(map(colour_of, small)), "pointRadius": SMALL, "pointBorderWidth": 0})
    return sets


def diagram(scene, limit, measure, title, axis):
    """A line a method, all other settings and the estimates, a ring round the chosen setting, and how far nature may be off."""
    marks, chosen = Marks(scene.settings), limit.chosen(scene)
    sets = lines(scene, measure, marks)
    estimates = [point(one, 1e3 * one.error_m(measure)) for one in scene.estimates if one.finite()]
    if estimates:
        sets.append({"label": "estimates (FEEC)", "data": estimates, "borderColor": charts.SKY, "pointStyle": "crossRot", "pointRadius": 5,
                     "borderWidth": 2.2})
    if chosen:
        where = point(chosen, 1e3 * chosen.error_m(measure))
        sets.append({"label": "chosen", "data": [where | {"label": f"chosen: {where['label']}"}], "borderColor": charts.RED,
                     "backgroundColor": "transparent", "borderWidth": 2.5, "pointRadius": 10, "keyShape": "ring", "unread": True})
    axes = {"x": charts.axis("time of the worst frame [ms]", "logarithmic"), "y": charts.axis(axis, "logarithmic")}
    text = "Each point is a setting, each line one way of stepping; down and left is better."
    return Chart(title, text, charts.chart("scatter", sets, axes, bands=bands(scene, limit, measure), key=marks.key()))
