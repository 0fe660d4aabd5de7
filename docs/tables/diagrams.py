"""Diagrams of the documents, as SVG that is readable on white and on black."""
import matplotlib

from tables import programs

matplotlib.use("svg")
from matplotlib import pyplot  # noqa: E402

COLOURS = {"quick": "#c4632f", "sor": "#2f7fc4"}
MARKERS = {1: "o", 2: "s", 4: "^", 8: "D"}  # by the scene's step over the step
GREY = "#808080"  # lines and letters


def best(points):
    """Those that no other beats in both time and error, by time."""
    kept = []
    for point in sorted(points, key=lambda one: (one["time"], one["error_mm"])):
        if not kept or point["error_mm"] < kept[-1]["error_mm"]:
            kept.append(point)
    return kept


def fronts(path, scenes):
    """Error over time, a line a stepper through its best settings, for {scene: {"points": [{stepper, cut, time, error_mm, is_default}], "uncertainty_mm"}}.
    Written to a path below the project's root."""
    style = {"svg.hashsalt": "pbmpi", "text.color": GREY, "axes.edgecolor": GREY, "axes.labelcolor": GREY, "xtick.color": GREY, "ytick.color": GREY,
             "font.size": 9}
    with pyplot.rc_context(style):
        figure, axes = pyplot.subplots(1, len(scenes), figsize=(4 * len(scenes), 3.6), layout="constrained")
        for axis, (scene, drawn) in zip(axes, scenes.items()):
            draw_scene(axis, scene, drawn)
        axes[0].set_ylabel("error after a frame by nature, rms [mm]")
        axes[0].legend(handles=legend(), frameon=False, fontsize=7, labelcolor=GREY)
        figure.savefig(programs.SOURCE / path, transparent=True, metadata={"Date": None})
        pyplot.close(figure)


def draw_scene(axis, scene, drawn):
    for stepper, colour in COLOURS.items():
        points = [point for point in drawn["points"] if point["stepper"] == stepper]
        line = best(points)
        axis.plot([one["time"] for one in line], [one["error_mm"] for one in line], color=colour, linewidth=1)
        for one in points:
            axis.plot(one["time"], one["error_mm"], MARKERS[one["cut"]], color=colour, markersize=4 if one in line else 2.5,
                      alpha=1 if one in line else 0.35, markeredgewidth=0)
    for one in drawn["points"]:
        if one["is_default"]:
            axis.plot(one["time"], one["error_mm"], "o", color=GREY, markersize=10, fillstyle="none")
    axis.axhspan(1e-9, drawn["uncertainty_mm"], color=GREY, alpha=0.25, linewidth=0)
    axis.set(xscale="log", yscale="log", title=scene, xlabel="time over that of quick, 20 iterations",
             ylim=(drawn["uncertainty_mm"] / 2, 2 * max(one["error_mm"] for one in drawn["points"])))
    axis.title.set_color(GREY)


def legend():
    def entry(label, **look):
        return pyplot.Line2D([], [], label=label, **look)

    return [*(entry(stepper, color=colour) for stepper, colour in COLOURS.items()),
            *(entry("the scene's step" if cut == 1 else f"1/{cut} of it", color=GREY, marker=marker, linestyle="none", markersize=4)
              for cut, marker in MARKERS.items()),
            entry("the default", color=GREY, marker="o", linestyle="none", markersize=9, fillstyle="none"),
            entry("nature is known to", color=GREY, alpha=0.4, linewidth=6)]
