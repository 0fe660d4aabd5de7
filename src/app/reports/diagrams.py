"""Work-precision diagrams of a study of accuracy: the time of settings against their error."""
import math

from reports import charts
from reports.document import Chart
from reports.words import plural, stepper_in

SHAPES = ("circle", "triangle", "rect", "rectRot", "star")  # of points, by the number of substeps; what is beyond shares the last
LINES = {"more_iterations": ("reference with more iterations [mm]", []), "second_method": ("second method: ODE [mm]", [4, 2, 1, 2]),
         "halved_dt": ("reference with half the step [mm]", [8, 4])}  # label and dashes, by the kind of case
ASKED = {"colour": charts.RED, "dash": [6, 4]}  # how limits are drawn


class Sweeps:
    """The shape of a point shows its number of substeps, the size its number of iterations."""

    def __init__(self, settings):
        self.substeps = sorted({one.row.substeps for one in settings})
        self.most_iterations = max((one.row.iterations for one in settings), default=1)

    def shape(self, substeps):
        return SHAPES[min(self.substeps.index(substeps), len(SHAPES) - 1)]

    def radius(self, iterations):
        """In pixels: 3 for one iteration, 6.5 for the most, linear in the logarithm in between."""
        return 3 + 3.5 * math.log2(max(1, iterations)) / max(1.0, math.log2(self.most_iterations))

    def key(self):
        entries = [{"label": plural(substeps, "substep"), "shape": shape} for substeps, shape in zip(self.substeps, SHAPES)]
        if len(self.substeps) > len(SHAPES):
            entries[-1]["label"] += " or more"
        for iterations in sorted({1, self.most_iterations}):
            entries.append({"label": plural(iterations, "iteration"), "shape": "circle", "radius": self.radius(iterations)})
        return entries


def point(one, y_mm):
    sweeps = f" ({plural(one.row.substeps, 'substep')} of {plural(one.row.iterations, 'iteration')})" if one.iterates else ""
    return charts.point(1e3 * one.time_s, y_mm, f"{one.setting()}{sweeps}: {1e3 * one.time_s:.3f} ms, {y_mm:.4g} mm")


def bands(scene, limit, measure):
    """How far the reference may be off, the cases that bound it, and the limits asked for."""
    def line(value, axis, label, colour, dash):
        return charts.band(value, value, label, colour, axis=axis, dash=dash)

    found = [charts.band(0, 1e3 * scene.uncertainty_m(measure), "uncertainty of the reference [mm]"),
             line(1e3 * scene.floor_m(measure), "y", "another solver seed: noise floor [mm]", charts.INK, [1, 3])]
    found += [line(1e3 * scene.judges[kind].error_m(measure), "y", label, charts.INK, dash) for kind, (label, dash) in LINES.items()
              if kind in scene.judges]
    if limit.budget_s:
        found.append(line(1e3 * limit.budget_s, "x", "budget [ms]", **ASKED))
    if limit.tolerance_m and measure == limit.measure:
        found.append(line(1e3 * limit.tolerance_m, "y", "tolerance [mm]", **ASKED))
    return found


def setting_sets(settings, error_mm, sweeps):
    """A set of points for each stepper and precision, of the settings that did not blow up."""
    by_stepper = {}
    for one in settings:
        if one.finite():
            by_stepper.setdefault(stepper_in(one.row.setting), []).append(one)
    sets = []
    for label, some in sorted(by_stepper.items()):
        sets.append({"label": label, "data": [point(one, error_mm(one)) for one in some],
                     "backgroundColor": charts.GREEN if label.endswith("single") else charts.ENGINES[some[0].stepper], "keyShape": "bar",
                     "pointStyle": [sweeps.shape(one.row.substeps) for one in some],
                     "pointRadius": [sweeps.radius(one.row.iterations) for one in some]})
    return sets


def diagram(scene, limit, measure, title, axis):
    """All settings and estimates, the front, a ring round the chosen setting, and how far the reference may be off."""
    def error_mm(one):
        return 1e3 * one.error_m(measure)

    sweeps, chosen = Sweeps(scene.settings), limit.chosen(scene)
    front = [point(one, error_mm(one)) for one in scene.front(measure)]
    sets = [{"label": "Pareto front", "data": front, "showLine": True, "borderColor": "#3d4650", "borderWidth": 1.5, "pointRadius": 0,
             "unread": True, "pointHitRadius": 0}, *setting_sets(scene.settings, error_mm, sweeps)]
    estimates = [point(one, error_mm(one)) for one in scene.estimates if one.finite()]
    if estimates:
        sets.append({"label": "estimates (FEEC)", "data": estimates, "borderColor": charts.SKY, "pointStyle": "crossRot", "pointRadius": 5,
                     "borderWidth": 2.2})
    if chosen:
        where = point(chosen, error_mm(chosen))
        sets.append({"label": "chosen", "data": [where | {"label": f"chosen: {where['label']}"}], "borderColor": charts.RED,
                     "backgroundColor": "transparent", "borderWidth": 2.5, "pointRadius": 10, "keyShape": "ring", "unread": True})
    axes = {"x": charts.axis("time of the worst frame [ms]", "logarithmic"), "y": charts.axis(axis, "logarithmic")}
    return Chart(title, "Each point is a setting; down and left is better.",
                 charts.chart("scatter", sets, axes, bands=bands(scene, limit, measure), key=sweeps.key()))
