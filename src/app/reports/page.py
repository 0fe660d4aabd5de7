"""Self-contained HTML pages of charts and tables, from the templates below web."""
import base64
import errno
import html
import json
import os
import pathlib
import re

from reports import document
from reports.files import write_file

# JavaScript is beside the package in a build and once installed; in the sources it is where Debian has it.
PACKAGE = pathlib.Path(__file__).absolute().parent
WEB = [PACKAGE / "web", PACKAGE / "web/charts"]
JAVASCRIPT = [PACKAGE / "javascript", *(pathlib.Path("/usr/share/javascript") / name for name in ("chart.js", "three/build", "three/examples/js/controls"))]
LIBRARIES = {"chart_js": "chart.min.js", "three_js": "three.min.js", "orbit_controls_js": "OrbitControls.js"}


def asset(name):
    """The text of a file of the templates; `name` as a template has it: theme_css."""
    folders = JAVASCRIPT if name in LIBRARIES else WEB
    file = LIBRARIES.get(name) or name[::-1].replace("_", ".", 1)[::-1]
    for folder in folders:
        if (folder / file).is_file():
            return (folder / file).read_text(encoding="utf-8")
    raise FileNotFoundError(errno.ENOENT, f"{file}, a part of pages, is missing beside the reports", file)


def safe_json(value):
    """JSON inside of a <script>."""
    return json.dumps(document.finite(value), ensure_ascii=False).replace("<", "\\u003c")


def shown_table(table):
    return {"title": table.title, "header": table.header, "rows": table.rows, "looks": table.looks}


def shown_section(section):
    charts = [{"title": chart.title, "text": chart.text, "config": chart.config} for chart in section.charts]
    tables = [shown_table(table) for table in section.tables if document.PAGE in table.shown_in]
    pictures = [{"name": name, "png": base64.b64encode(png).decode()} for name, png in section.pictures]
    more = {"pictures": pictures, "last": section.last}
    return {"title": section.title, "text": section.text, "charts": charts, "tables": tables} | {name: one for name, one in more.items() if one}


def fill(template, fields):
    """The template with each {{name}} replaced by a field, or else by the file of that name, which may be a template, too."""
    def content(found):
        name = found[1]
        return fields[name] if name in fields else fill(name, fields) if name.endswith("_html") else asset(name)

    return re.sub(r"\{\{(\w+)\}\}", content, asset(template))


def page_of(report):
    sections = [shown_section(section) for section in report.sections if document.PAGE in section.shown_in]
    return fill("charts_html", fields_of(report) | {"sections": safe_json(sections), "drawn_with": "Chart.js"})


def fields_of(report):
    """What all templates have: title, subtitle, provenance."""
    return {"title": html.escape(report.title, quote=True), "subtitle": html.escape(report.subtitle, quote=True),
            "provenance": safe_json({"line": report.line, "entries": report.entries})}


def write(path, report):
    write_file(path, page_of(report))


def joined(*parts):
    return " · ".join(filter(None, parts))


def version_line():
    """Of the pbreport that called; it hands its version on."""
    return os.environ.get("PBREPORT_VERSION", "pbreport")


def origin(attributes):
    version = attributes.get("pbmpi_version", "")
    return joined(version and f"pbmpi {version}", attributes.get("git_revision", ""), attributes.get("created", ""))


def origin_of_study(study, maker=""):
    """(line, entries) of a Report on the file of a study. `maker` of the page: pbreport, if none is named."""
    return joined(origin(study.attributes), f"page by {maker or version_line()}"), [("file", study.path), *study.texts()]


def origin_of_runs(runs, maker=""):
    """(line, entries) of a Report on runs, which have `path` and `attributes`."""
    entries = []
    for run in runs:
        state = run.attributes.get("state_hash", "")
        entries.append((run.path, joined(run.attributes.get("command_line", ""), origin(run.attributes), state and f"state {state}")))
    return joined(f"{len(runs)} {'run' if len(runs) == 1 else 'runs'}", f"page by {maker or version_line()}"), entries
