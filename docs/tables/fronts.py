"""Diagrams of error over time, from the tables of docs/engines.md and docs/accuracy.md."""
import re

from tables.canvas import Canvas, LogAxes

BUDGET_MS = 3.33  # a tenth of a frame of 1/30 s
DEFAULTS = {"quick": "quick, 1 x 20", "sor": "sor double, 14 x 1", "bullet": "bullet, 1 x 10", "mujoco": "mujoco, 1 x 100"}
NAMES = {"sor": "sor (pbmpi)", "quick": "quick (ODE)", "direct": "direct (ODE)", "bullet": "Bullet", "mujoco": "MuJoCo"}
SUBJECTS = {"CrashSk": "a car hits two humans", "CrashWa": "a car hits a wall at 89 m/s", "Fight": "ten humans fight", "100CrSk": "8 worlds of CrashSk",
            "Battle2": "a compound under fire"}


def number(text):
    return float(text.replace(",", "").replace("<", ""))


def engines(scene):
    """A drawing of error by nature over a frame's worst time, a line an engine, with the budget: best settings of a scene."""
    def draw(origin, rows):
        canvas = Canvas(290, 310, f"{scene}: error after a frame over its time, for each engine, with the budget of {BUDGET_MS} ms")
        axes = LogAxes(canvas, (0.1, 10000), (0.05, 10), (46, 48, 272, 206))
        canvas.text(12, 20, scene, size=14, bold=True)
        canvas.text(12, 36, SUBJECTS[scene], "faint", 11)
        canvas.rectangle(axes.left, axes.top, axes.x(BUDGET_MS) - axes.left, axes.bottom - axes.top, "band")
        axes.frame("worst frame [ms]", "error after a frame [mm]")
        canvas.line([(axes.x(BUDGET_MS), axes.top - 2), (axes.x(BUDGET_MS), axes.bottom)], "text", 1.3, dashed=True)
        canvas.text(axes.x(BUDGET_MS) + 4, axes.top + 10, f"budget {BUDGET_MS} ms", size=10)
        of_scene = [row for row in rows if row["scene"] == scene]
        drawn = [engine for engine in NAMES if any(row["engine"] == engine for row in of_scene)]
        for engine in drawn:
            points = [(number(row["worst frame [ms]"]), number(row["error: nature [mm]"]), row["setting"]) for row in of_scene if row["engine"] == engine]
            canvas.line([(axes.x(time), axes.y(error)) for time, error, _ in points], engine, 2)
            for time, error, setting in points:
                canvas.dot(axes.x(time), axes.y(error), 3.2, engine, f"{setting}: {time:g} ms, {error:g} mm")
                if setting == DEFAULTS.get(engine):
                    canvas.ring(axes.x(time), axes.y(error), 6, "text")
        legend(canvas, drawn, 250)
        made = origin.split(", ")
        canvas.text(12, 283, "blue: in time; ring: the default of an engine", "faint", 9)
        canvas.text(12, 295, f"{made[0]}, {made[-1]}", "faint", 8)
        canvas.text(12, 305, ", ".join(made[1:-1]), "faint", 8)
        return canvas.svg()

    return draw


def legend(canvas, engines_drawn, top):
    for place, engine in enumerate(engines_drawn):
        x, y = 14 + 92 * (place % 3), top + 14 * (place // 3)
        canvas.line([(x, y - 4), (x + 12, y - 4)], engine, 2.5)
        canvas.text(x + 16, y, NAMES[engine], size=10.5)


def settings(origin, rows):
    """Error by nature over time relative to `quick`, three scenes beside each other, a line a stepper through its best settings."""
    scenes = ("CrashSk", "CrashWa", "Fight")
    canvas = Canvas(880, 320, "Error after a frame by nature over time, for settings of quick and sor in three scenes")
    name = next(iter(rows[0]))
    for place, scene in enumerate(scenes):
        left = 50 + 286 * place
        axes = LogAxes(canvas, (0.2, 20), (0.1, 20), (left, 34, left + 236, 244))
        canvas.text(left, 22, scene, size=14, bold=True)
        axes.frame("time over that of quick, 1 x 20", "error after a frame, rms [mm]")
        for stepper in ("quick", "sor"):
            points = sorted((*map(number, re.match(r"([\d.]+): ([^,]+),", row[scene]).groups()), row[name]) for row in rows if row[name].startswith(stepper))
            canvas.line([(axes.x(time), axes.y(error)) for time, error, _ in best(points)], stepper, 2)
            for time, error, setting in points:
                canvas.dot(axes.x(time), axes.y(error), 3.5, stepper, f"{setting}: {time:g} x, {error:g} mm")
                if setting in ("sor, 10 ms, 14 x 1", "quick, 10 ms, 1 x 20"):
                    canvas.ring(axes.x(time), axes.y(error), 6.5, "text")
    legend(canvas, ("sor", "quick"), 296)
    canvas.text(240, 296, f"ring: the default of each; {origin}", "faint", 9.5)
    return canvas.svg()


def best(points):
    """Those that no other beats in both time and error, by time."""
    kept = []
    for point in points:
        if not kept or point[1] < kept[-1][1]:
            kept.append(point)
    return kept
