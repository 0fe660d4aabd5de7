"""What a report consists of, whoever prints it: sections of prose, tables and charts, and a document of numbers.

A command builds one Report from what it has read. text(), markdown() and page.html() print its sections, json() its numbers, csv() one
of its tables.
"""
import csv as csv_module
import dataclasses
import io
import json as json_module
import math

from reports.words import short

TEXT, MARKDOWN, PAGE = "text", "markdown", "page"
EVERYWHERE = (TEXT, MARKDOWN, PAGE)


@dataclasses.dataclass
class Column:
    """A column of a table: its header, and the cell that a row has in it, as text."""
    header: str
    cell: object  # callable(row) -> str


@dataclasses.dataclass
class Table:
    """Rows of cells under a header. `shown_in`: the printers that show it. `of_words`: Markdown aligns its cells to the left; `rule`: its
    line below the header, if neither suits; `looks`: pages give the cells of the first rows these classes."""
    title: str
    header: list
    rows: list
    text: str = ""
    shown_in: tuple = EVERYWHERE
    of_words: bool = False
    rule: str = ""
    looks: list = dataclasses.field(default_factory=list)

    @classmethod
    def of(cls, title, columns, rows, **others):
        """From rows of any kind and a Column for each column."""
        return cls(title, [column.header for column in columns], [[column.cell(row) for column in columns] for row in rows], **others)

    def lines(self):
        return [self.header, *self.rows]


@dataclasses.dataclass
class Chart:
    """A chart of Chart.js (charts.py makes the usual ones); pages alone show it."""
    title: str
    text: str
    config: dict


@dataclasses.dataclass
class Section:
    """A heading with its text, in paragraphs, its charts, its tables and its pictures: [(name, PNG)], which pages alone show. `last`: a
    paragraph below them all."""
    title: str = ""
    text: str = ""
    charts: list = dataclasses.field(default_factory=list)
    tables: list = dataclasses.field(default_factory=list)
    shown_in: tuple = EVERYWHERE
    pictures: list = dataclasses.field(default_factory=list)
    last: str = ""


@dataclasses.dataclass
class Report:
    """`head`: the lines above all sections of the text. `numbers`: what JSON has, nested dicts and lists. `line`, `entries`: what the page
    says about its origin (page.origin_of)."""
    title: str
    subtitle: str
    sections: list
    numbers: dict
    head: str = ""
    line: str = ""
    entries: list = dataclasses.field(default_factory=list)


def aligned(rows):
    """Columns as wide as their longest cell, right-aligned except the last."""
    widths = [max(map(len, column)) for column in zip(*rows)]
    lines = []
    for row in rows:
        cells = [cell if place == len(row) - 1 else cell.rjust(width) for place, (cell, width) in enumerate(zip(row, widths))]
        lines.append(("  " + "  ".join(cells)).rstrip())
    return "\n".join(lines) + "\n"


def markdown_table(rows, of_words=False, rule=""):
    """The first row is the header; `rule`: the line below it, if not the usual one."""
    rule = rule or "|" + ("---|" if of_words else "--:|") * (len(rows[0]) - 1) + "---|"
    lines = ["|" + "".join(f" {cell} |" if cell else " |" for cell in row) for row in rows]
    return "\n".join([lines[0], rule, *lines[1:]]) + "\n"


def text(report):
    parts = [report.head] if report.head else []
    for section in report.sections:
        if TEXT in section.shown_in:
            heading = "".join(line + "\n" for line in (section.title, section.text) if line)
            tables = [table_text(table) for table in section.tables if TEXT in table.shown_in]
            parts.append(heading + "\n".join(tables + ([section.last + "\n"] if section.last else [])))
    return "\n".join(parts)


def table_text(table):
    return "".join(line + "\n" for line in (table.title, table.text) if line) + aligned(table.lines())


def markdown(report):
    parts = []
    for section in report.sections:
        if MARKDOWN in section.shown_in:
            parts += [f"### {section.title}\n"] if section.title else []
            parts += [section.text + "\n"] if section.text else []
            for table in section.tables:
                if MARKDOWN in table.shown_in:
                    parts += [f"### {table.title}\n"] if table.title else []
                    parts += [table.text + "\n"] if table.text else []
                    parts.append(markdown_table(table.lines(), table.of_words, table.rule))
            parts += [section.last + "\n"] if section.last else []
    return "\n".join(parts)


def json(report):
    """Numbers that are not finite are null: JSON has no word for them."""
    return json_module.dumps(finite(report.numbers), indent=2, ensure_ascii=False) + "\n"


def finite(value):
    if isinstance(value, dict):
        return {name: finite(one) for name, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(one) for one in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def csv(columns):
    """Columns {name: list} as comma-separated values, a column a name; rows of several numbers have one column for each."""
    flat = {}
    for name, values in columns.items():
        if values and isinstance(values[0], list):
            flat.update({f"{name}_{place}": [value[place] for value in values] for place in range(len(values[0]))})
        else:
            flat[name] = values
    stream = io.StringIO()
    writer = csv_module.writer(stream, lineterminator="\n")
    writer.writerow(flat)
    writer.writerows(map(short, row) for row in zip(*flat.values()))
    return stream.getvalue()
