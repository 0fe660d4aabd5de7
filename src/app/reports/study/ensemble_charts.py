"""Diagrams of an ensemble: results of worlds over the parameters in which they differ, and the spread of what is observed, frame by frame."""
import numpy as np

from reports import charts
from reports.document import Chart

RESULTS = ("energy_last", "joint_gap_max", "penetration_max", "contacts_mean")  # columns of the table worlds, each a diagram a parameter
SPREADS = ("energy", "joint_gap", "max_penetration", "contacts")  # observables, each a diagram over the frames
MOST_WORLDS = 2000  # of which points are drawn


def titled(name, unit):
    return f"{name} [{unit}]" if unit else name


def is_varied(column):
    """Is it a number that is not the same in all worlds?"""
    values = np.asarray(column.values)
    return values.dtype.kind in "iuf" and len(np.unique(values)) > 1


def over_parameters(worlds, parameters):
    """`worlds`: the table of that name; `parameters`: the names of its columns that are parameters. Of many worlds some, evenly."""
    columns = {column.name: column for column in worlds}
    found = []
    for name in parameters:
        if not is_varied(columns[name]):
            continue
        along = np.asarray(columns[name].values, float)
        shown = np.arange(len(along))[::max(1, -(-len(along) // MOST_WORLDS))]
        text = "A point is a world." + (f" {len(shown)} of {len(along)} worlds are drawn." if len(shown) < len(along) else "")
        for result in RESULTS:
            values = np.asarray(columns[result].values, float)
            points = [charts.point(float(along[at]), float(values[at]), f"{name} {along[at]:.6g}: {result} {values[at]:.4g}") for at in shown]
            axes = {"x": charts.axis(titled(name, columns[name].unit)), "y": charts.axis(titled(result, columns[result].unit))}
            found.append(Chart(f"{result} over {name}", text, charts.chart("scatter", [charts.line(result, points, charts.BLUE, pointRadius=3)], axes)))
    return found


def over_frames(time_s, quantities):
    """`quantities`: {name: (unit, spread [frames])}: the mean, and the least and largest of the quantiles."""
    found = []
    for name in (one for one in SPREADS if one in quantities):
        unit, spread = quantities[name]
        quantiles = [what for what in spread if what.startswith("q")]
        sets = []
        for what, colour in (("mean", charts.BLUE), *((one, charts.GREY) for one in (quantiles[:1] + quantiles[-1:]))):
            points = [charts.point(float(time), float(value), f"{what} at {time:.4g} s: {value:.4g}") for time, value in zip(time_s, spread[what])]
            sets.append(charts.line(what, points, colour, showLine=True, pointRadius=0, borderWidth=2))
        axes = {"x": charts.axis("time [s]"), "y": charts.axis(titled(name, unit))}
        found.append(Chart(name, "Over the samples, frame by frame.", charts.chart("scatter", sets, axes)))
    return found
