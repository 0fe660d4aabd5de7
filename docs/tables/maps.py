"""Diagrams of verdicts: hard cases under engines or settings, statements of the paper."""
import itertools

from tables.canvas import Canvas

VERDICTS = ("pass", "degraded", "broken")


def verdict_of(cell):
    """Of a cell of the map of hard cases: ok, **broken**, what is degraded; or the word itself."""
    if cell in ("-", "", "n/a"):
        return "none"
    if cell in VERDICTS:
        return cell
    return {"ok": "pass"}.get(cell, "broken" if cell.startswith("broken: ") else "degraded")


def map_of(title, columns, rows, origin, width, row_height, label=112):
    """A strip a column of the table, a tick a case, by families; the counts at the right."""
    counts, gap = 92, 3
    families = [row["case"].split("/")[0] for row in rows]
    names = list(dict.fromkeys(families))
    unit = (width - label - counts - gap * len(names)) / len(rows)
    starts = [label + unit * place + gap * names.index(family) for place, family in enumerate(families)]
    height = 66 + row_height * len(columns) + 42
    canvas = Canvas(width, height, title)
    canvas.text(12, 20, title, size=13, bold=True)
    for place, name in enumerate(names):
        canvas.text(starts[families.index(name)], 37 + 11 * (place % 3), name, "faint", 9.5)
    for place, column in enumerate(columns):
        y = 64 + row_height * place
        verdicts = [verdict_of(row[column]) for row in rows]
        canvas.text(label - 8, y + row_height / 2 + 2, column, size=10.5, anchor="end")
        for (verdict, _), run in itertools.groupby(zip(verdicts, families, starts), key=lambda one: one[:2]):
            run = list(run)
            canvas.rectangle(run[0][2], y, unit * len(run), row_height - 3, verdict)
        canvas.text(width - counts + 6, y + row_height / 2 + 2, " / ".join(str(verdicts.count(one)) for one in VERDICTS), size=10.5)
    key(canvas, height - 26, width)
    canvas.text(12, height - 9, origin, "faint", 8.5)
    return canvas.svg()


def key(canvas, y, width):
    for place, verdict in enumerate(VERDICTS):
        canvas.rectangle(14 + 84 * place, y - 8, 9, 9, verdict)
        canvas.text(27 + 84 * place, y, verdict, size=10.5)
    if width > 500:
        canvas.text(14 + 84 * 3, y, "a tick is a case; at the right how many of each", "faint", 10)


def engines(origin, rows):
    """The hard cases under every engine."""
    columns = [column for column in rows[0] if column != "case"]
    return map_of(f"{len(rows)} hard cases, engine by engine", columns, rows, origin, 430, 24)


def settings(origin, rows):
    """The hard cases under the settings of the study's own list; below the cases the table counts verdicts."""
    rows = [row for row in rows if row["row"]]
    columns = [column for column in rows[0] if column not in ("row", "case")]
    return map_of(f"{len(rows)} hard cases under {len(columns)} settings", columns, rows, origin, 880, 22, 182)
