"""Diagrams of one number a line: speed-ups over ranks, joint gaps over substeps, shares of a step, verdicts on the paper."""
import re

from tables.canvas import Canvas, LogAxes
from tables.fronts import number


def ratio(text):
    """Of `1.99 (1.84 to 2.03)`: median, least, largest; None where the report holds it back."""
    found = re.match(r"([\d.]+) \(([\d.]+) to ([\d.]+)\)", text)
    return tuple(map(float, found.groups())) if found else None


def scaling(origin, rows):
    """The speed-up of two ranks over one: worlds distributed, and a world cut into spaces, each with its bound."""
    on_two = [row for row in rows if row["ranks"].startswith("2")]
    width, left, right, top, height = 430, 170, 404, 56, 24
    canvas = Canvas(width, top + height * len(on_two) + 54, "Speed-up of two ranks over one, with intervals and bounds")
    canvas.text(12, 20, "Two ranks against one", size=13, bold=True)
    canvas.text(12, 37, "bar: speed-up, with its interval; mark: what it cannot exceed", "faint", 10)
    for value in (0, 0.5, 1, 1.5, 2):
        x = left + (right - left) * value / 2.1
        canvas.line([(x, top - 4), (x, top + height * len(on_two))], "grid")
        canvas.text(x, top + height * len(on_two) + 13, f"{value:g}", "faint", 10, "middle")
    for place, row in enumerate(on_two):
        y = top + height * place
        found = ratio(row["speed-up"])
        canvas.text(left - 6, y + 13, row["work"].replace(", cut into spaces", ", one world, cut"), size=10.5, anchor="end")
        if found:
            middle, low, high = (left + (right - left) * value / 2.1 for value in found)
            canvas.rectangle(left, y + 3, middle - left, 14, "quick" if "cut" in row["ranks"] else "sor", hint=f"{row['work']}: {row['speed-up']}")
            canvas.line([(low, y + 10), (high, y + 10)], "text", 1.5)
        bound = left + (right - left) * float(row["bound"]) / 2.1
        canvas.line([(bound, y + 1), (bound, y + 19)], "text", 2)
    canvas.text(12, canvas.height - 26, "blue: worlds distributed over ranks; orange: one world cut over ranks", "faint", 9.5)
    canvas.text(12, canvas.height - 9, origin, "faint", 8.5)
    return canvas.svg()


def substeps(origin, rows):
    """Joint gaps over the number of substeps."""
    canvas = Canvas(520, 40 + 22 * len(rows) + 34, "Gaps of joints by the number of substeps")
    name, column = list(rows[0])[0], list(rows[0])[1]
    canvas.text(12, 20, "100CrSk: gaps of joints in the crash, rms [mm]", size=13, bold=True)
    longest = max(number(row[column]) for row in rows)
    for place, row in enumerate(rows):
        y, value = 36 + 22 * place, number(row[column])
        canvas.text(140, y + 12, row[name], size=10.5, anchor="end")
        canvas.rectangle(148, y + 1, max(1, 310 * value / longest), 14, "quick" if "law ode" in row[name] else "sor")
        canvas.text(154 + 310 * value / longest, y + 12, row[column], size=10.5)
    canvas.text(12, canvas.height - 10, f"substeps x sweeps; orange: ODE's law; {origin}", "faint", 9)
    return canvas.svg()


def effects(origin, rows):
    """What leaving an effect out saves of a step in CrashWa and in Fight."""
    scenes = ("CrashWa", "Fight")
    name = next(iter(rows[0]))
    called_for = {scene: [row for row in rows if not row[scene].startswith("(") and row[name] != "noise floor"] for scene in scenes}
    shares = {scene: {row[name]: float(row[scene].split(",")[0]) for row in found} for scene, found in called_for.items()}
    drawn = [row[name] for row in rows if any(shares[scene].get(row[name], 0) >= 1 for scene in scenes)]
    canvas = Canvas(720, 62 + 20 * len(drawn) + 26, "Share of a step that leaving an effect out saves")
    canvas.text(12, 20, "What leaving an effect out saves of a step [%]", size=13, bold=True)
    for place, scene in enumerate(scenes):
        left = 150 + 290 * place
        canvas.text(left, 44, scene, size=11, bold=True)
        for line, effect in enumerate(drawn):
            y, value = 54 + 20 * line, shares[scene].get(effect)
            if not place:
                canvas.text(left - 8, y + 11, effect, size=10.5, anchor="end")
            if value is None:
                canvas.text(left, y + 11, "not in the scene", "faint", 9.5)
                continue
            canvas.rectangle(left, y + 1, max(1, 2.2 * value), 13, "sor")
            canvas.text(left + max(1, 2.2 * value) + 5, y + 11, f"{value:g}", size=10)
    canvas.text(12, canvas.height - 10, origin, "faint", 9)
    return canvas.svg()


def paper(origin, *tables):
    """How many of the paper's statements are confirmed, refuted, not decidable here, by the kind of evidence."""
    kinds = ("counts", "times of this machine", "counted instructions", "modelled processor")
    verdicts = (("confirmed", "pass"), ("not decidable here", "degraded"), ("refuted", "broken"))
    canvas = Canvas(640, 150, "Verdicts on the paper's statements by the kind of evidence")
    canvas.text(12, 20, "The paper's statements", size=13, bold=True)
    most = max(map(len, tables))
    for line, (kind, rows) in enumerate(zip(kinds, tables)):
        y, x = 34 + 22 * line, 160.0
        canvas.text(152, y + 12, kind, size=10.5, anchor="end")
        for verdict, colour in verdicts:
            count = sum(row["verdict"] == verdict for row in rows)
            canvas.rectangle(x, y, 440 * count / most, 16, colour, hint=f"{count} {verdict}")
            if count:
                canvas.text(x + 220 * count / most, y + 12, str(count), "page", 10, "middle", bold=True)
            x += 440 * count / most
    for place, (verdict, colour) in enumerate(verdicts):
        canvas.rectangle(160 + 130 * place, 124, 9, 9, colour)
        canvas.text(173 + 130 * place, 132, verdict, size=10)
    canvas.text(12, 145, origin.split(",")[0], "faint", 8.5)
    return canvas.svg()


def forecast(origin, rows):
    """Time of a frame without physics over ranks, by the number of worlds, with the budget."""
    canvas = Canvas(560, 300, "Time of a frame without physics over the number of ranks, with the budget")
    axes = LogAxes(canvas, (1, 200000), (0.01, 1000), (56, 40, 440, 240))
    canvas.text(12, 20, "A frame without physics: what gathering poses costs", size=13, bold=True)
    axes.frame("ranks", "frame [ms]")
    canvas.line([(axes.left, axes.y(3.33)), (axes.right, axes.y(3.33))], "text", 1.3, dashed=True)
    canvas.text(axes.right + 4, axes.y(3.33) + 4, "budget 3.33 ms", size=10)
    for worlds, colour in zip(dict.fromkeys(row["worlds"] for row in rows), ("direct", "bullet", "sor", "quick")):
        points = [(number(row["ranks"]), number(row["frame, tree [ms]"])) for row in rows if row["worlds"] == worlds]
        canvas.line([(axes.x(ranks), axes.y(time)) for ranks, time in points], colour, 2)
        for ranks, time in points:
            canvas.dot(axes.x(ranks), axes.y(time), 3, colour, f"{worlds} worlds, {ranks:g} ranks: {time:g} ms")
        canvas.text(axes.x(points[-1][0]) + 6, axes.y(points[-1][1]) + 13, f"{worlds} worlds", size=10)
    canvas.text(12, 290, origin, "faint", 9)
    return canvas.svg()
