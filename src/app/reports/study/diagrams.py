"""Work-precision diagrams of a study of accuracy: the time of settings against their error."""
import math

from reports import charts
from reports.document import Chart
from reports.words import plural

ASKED = {"colour": charts.RED, "dash": [6, 4]}  # how limits are drawn
SMALL = 2  # radius [pixels] of points that are on no line


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
    if limit.tolerance_m and measure == "rms":
        found.append(line(1e3 * limit.tolerance_m, "y", "tolerance [mm]"))
    return found


def lines(scene, measure):
    """For each stepper a line through the settings that no other of it beats; then all other settings, small, and hidden until they are asked for."""
    by_stepper = {}
    for one in scene.settings:
        if not math.isnan(one.error_m(measure)):
            by_stepper.setdefault(one.stepper, []).append(one)
    sets, others = [], []
    for stepper, settings in sorted(by_stepper.items()):
        front = scene.front(measure, settings)
        others += [one for one in settings if one.finite() and one not in front]
        sets.append(charts.line(stepper, [point(one, 1e3 * one.error_m(measure)) for one in front], charts.ENGINES[stepper], showLine=True, borderWidth=2,
                                pointRadius=4))
    if others:
        sets.append({"label": "other settings", "data": [point(one, 1e3 * one.error_m(measure)) for one in others], "keyShape": "circle",
                     "backgroundColor": [charts.ENGINES[one.stepper] for one in others], "pointRadius": SMALL, "pointBorderWidth": 0, "hidden": True})
    return sets


def diagram(scene, limit, measure, title, axis):
    """A line a stepper, a ring round the chosen setting, and how far nature may be off; other settings and estimates on request."""
    chosen = limit.chosen(scene)
    sets = lines(scene, measure)
    estimates = [point(one, 1e3 * one.error_m(measure)) for one in scene.estimates if one.finite()]
    if estimates:
        sets.append({"label": "estimates (FEEC)", "data": estimates, "borderColor": charts.SKY, "pointStyle": "crossRot", "pointRadius": 5,
                     "borderWidth": 2.2, "hidden": True})
    if chosen:
        where = point(chosen, 1e3 * chosen.error_m(measure))
        sets.append({"label": "chosen", "data": [where | {"label": f"chosen: {where['label']}"}], "borderColor": charts.RED,
                     "backgroundColor": "transparent", "borderWidth": 2.5, "pointRadius": 10, "keyShape": "ring", "unread": True})
    axes = {"x": charts.axis("time of the worst frame [ms]", "logarithmic"), "y": charts.axis(axis, "logarithmic")}
    text = "Each line joins a stepper's best settings; down and left is better. The key shows what is hidden: all other settings, and estimates."
    return Chart(title, text, charts.chart("scatter", sets, axes, bands=bands(scene, limit, measure)))
