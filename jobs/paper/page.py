"""Self-contained HTML pages of charts and tables, without a script. They have the colours of pbreport's pages."""
import base64
import dataclasses
import html
import math

import runs
import svg

STYLES = ("theme.css", "page.css", "charts/key.css", "charts/charts.css")  # of io/html/web
OWN_STYLE = """
.drawing { overflow-x: auto; }
.drawing svg { display: block; }
.drawing text { font-size: 12px; fill: var(--ink-soft); }
.drawing .grid { stroke: var(--line); }
.drawing .level { stroke-width: 1.5; stroke-dasharray: 6 4; }
.drawing rect { stroke: var(--edge); stroke-width: .7; }
.key i { width: 14px; height: 11px; flex: none; border: 1px solid var(--edge); }
.chart summary { padding: 4px 0; font-weight: 400; font-size: 12.5px; }
.stills { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 320px), 1fr)); gap: 12px; }
.stills figure { margin: 0; }
.stills img { width: 100%; border-radius: 6px; display: block; }
"""
WIDE = 24  # letters from which on a column is one of words


@dataclasses.dataclass
class Table:
    title: str
    header: list
    rows: list


@dataclasses.dataclass
class Section:
    """A heading with its text, in paragraphs, its charts and its tables; `pictures`: [(name, PNG)]."""
    title: str
    text: str = ""
    charts: list = dataclasses.field(default_factory=list)
    tables: list = dataclasses.field(default_factory=list)
    pictures: list = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class Page:
    """`line` and `entries`, [(name, text)], say what it was made from."""
    title: str
    subtitle: str
    sections: list
    line: str = ""
    entries: list = dataclasses.field(default_factory=list)


def tag(name, content="", **attributes):
    """An element; the content is HTML already."""
    text = "".join(f' {key.rstrip("_").replace("_", "-")}="{html.escape(str(value), quote=True)}"' for key, value in attributes.items())
    return f"<{name}{text}>{content}</{name}>"


def scrollable(name, content, label):
    """An element that may be wider than its place: the keyboard reaches it."""
    return tag("div", content, class_=name, tabindex=0, role="region", aria_label=label)


def table_html(table):
    """A column is one of numbers if all its cells are short; such cells do not wrap."""
    wide = [any(len(str(row[i])) > WIDE for row in table.rows) for i in range(len(table.header))]

    def line(kind, cells, **attributes):
        return tag("tr", "".join(tag(kind, html.escape(str(cell)), **attributes, **({"class_": "words"} if is_wide else {}))
                                 for cell, is_wide in zip(cells, wide)))

    body = "".join(line("td", row) for row in table.rows)
    return scrollable("table", tag("table", tag("thead", line("th", table.header, scope="col")) + tag("tbody", body)), table.title)


def number(value):
    return "" if value is None or not math.isfinite(value) else f"{value:.4g}"


def chart_html(chart):
    """The picture, its key, and its numbers."""
    key = chart.key or [(bars.label, bars.colour) for bars in chart.bars]
    marks = [*key, *((label, colour) for _, label, colour in chart.levels)]
    items = "".join(tag("li", tag("span", tag("i", style=f"background: {colour}") + html.escape(label))) for label, colour in marks)
    numbers = Table(f"Numbers of {chart.title}", ["scene", *(bars.label for bars in chart.bars)],
                    [[group, *(number(bars.values[i]) for bars in chart.bars)] for i, group in enumerate(chart.groups)])
    return tag("article", tag("h3", html.escape(chart.title)) + tag("p", html.escape(chart.text))
               + scrollable("drawing", svg.draw(chart), chart.title) + tag("ul", items, class_="key")
               + tag("details", tag("summary", "its numbers") + table_html(numbers)), class_="chart")


def section_html(section):
    parts = [tag("h2", html.escape(section.title)), *(tag("p", html.escape(text)) for text in section.text.split("\n\n") if text)]
    if section.charts:
        parts.append(tag("div", "".join(map(chart_html, section.charts)), class_="chart-grid"))
    for table in section.tables:
        parts += [tag("h3", html.escape(table.title), class_="table-title"), table_html(table)]
    if section.pictures:
        parts.append(tag("div", "".join(picture_html(*picture) for picture in section.pictures), class_="stills"))
    return tag("section", "".join(parts), class_="card section")


def picture_html(name, png):
    return tag("figure", f'<img src="data:image/png;base64,{base64.b64encode(png).decode()}" alt="{html.escape(name, quote=True)}">'
               + tag("figcaption", html.escape(name)))


def foot_html(page):
    """What the page was made from; texts of several lines, such as a scene, keep them."""
    def cell(text):
        return tag("pre", html.escape(text), tabindex=0) if "\n" in text else html.escape(text)

    rows = "".join(tag("tr", tag("th", html.escape(name), scope="row") + tag("td", cell(text))) for name, text in page.entries)
    return tag("p", html.escape(page.line)) + tag("details", tag("summary", "Settings and provenance")
                                                  + scrollable("tables", tag("table", rows), "Settings and provenance"))


def write(path, page):
    """Writes the page."""
    web = runs.SOURCE / "io/html/web"
    style = "".join((web / name).read_text(encoding="utf-8") for name in STYLES) + OWN_STYLE
    head = ('<meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">'
            f'<title>{html.escape(page.title)} · pbmpi</title><link rel="icon" href="data:,"><style>{style}</style>')
    header = tag("div", tag("p", "pbmpi", class_="brand") + tag("h1", html.escape(page.title)) + tag("p", html.escape(page.subtitle), class_="sub"),
                 class_="head-text")
    body = (tag("header", header, class_="head") + tag("main", "".join(map(section_html, page.sections)))
            + tag("footer", tag("div", foot_html(page), id="provenance")))
    text = f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head>\n<body data-ready="yes">{body}</body></html>\n'
    try:
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    except OSError as error:
        raise runs.BadInput(f"{path}: the page cannot be written: {error.strerror}") from None


def origin(attributes):
    """Version, revision and time of the file's program."""
    version = attributes.get("pbmpi_version", "")
    return [f"pbmpi {version}" if version else "", attributes.get("git_revision", ""), attributes.get("created", "")]


def joined(parts):
    return " · ".join(part for part in parts if part)


MAKER = "page by jobs/paper/paper.py"


def provenance_of_runs(files):
    """(line, entries) of several files [(path, attributes)]: for each its command, its program and its state hash."""
    entries = [(path, joined([attributes.get("command_line", ""), *origin(attributes),
                              f"state {attributes['state_hash']}" if "state_hash" in attributes else ""])) for path, attributes in files]
    return joined([f"{len(files)} run{'' if len(files) == 1 else 's'}", MAKER]), entries


def provenance_of_study(path, attributes, parameters):
    """(line, entries) of a study's file: its attributes and parameters."""
    return joined([*origin(attributes), MAKER]), [("file", path), *attributes.items(), *parameters.items()]
