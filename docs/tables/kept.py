"""Tables as the documents keep them: between markers on a page; a long one on a page of its own below docs/tables/pages, with its cells in docs/tables/data."""
import csv
import io
import re

from tables import programs

LONG = "docs/tables/pages/"


def block(name):
    """The pattern of a table's place: its opening marker, what stands between, its closing marker."""
    return re.compile(rf"(<!-- figures: {name} -->\n)(.*?)(<!-- end figures -->)", re.DOTALL)


def content(page, name):
    """What stands in a table's place."""
    found = block(name).search((programs.SOURCE / page).read_text(encoding="utf-8"))
    if not found:
        raise SystemExit(f"figures.py: {page} has no place for '{name}'; write <!-- figures: {name} --> and <!-- end figures --> there, on a line each")
    return found[2]


def lines(page, name):
    """The lines of the table."""
    return [line for line in content(page, name).splitlines() if line.startswith("|")]


def caption(page, name):
    """What stands below the table: commands, revision, machine."""
    return content(page, name).strip().splitlines()[-1].strip("*")


def origin(page, name):
    """Of the caption: revision, machine and day, without the commands and the machine's load."""
    found = re.search(r"revision .*$", caption(page, name))
    return re.sub(r", load of the machine .*|\.$", "", found[0])


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def plain(cell):
    """Without Markdown's marks; what is bold is what broke."""
    return re.sub(r"[`*]", "", re.sub(r"\*\*(.*?)\*\*", r"broken: \1", cell))


def rows(page, name):
    """The table as [{column: text}], without Markdown's marks."""
    head, _, *body = lines(page, name)
    return [dict(zip(map(plain, cells(head)), map(plain, cells(line)))) for line in body]


def as_csv(page, name):
    """The file of a long table: its caption as a comment, then its cells."""
    head, _, *body = lines(page, name)
    text = io.StringIO()
    text.write(f"# {plain(caption(page, name))}\n")
    csv.writer(text, lineterminator="\n").writerows([plain(cell) for cell in cells(line)] for line in (head, *body))
    return text.getvalue()


def data_file(name):
    return programs.SOURCE / "docs/tables/data" / f"{name}.csv"


def write(page, name, table, its_caption):
    """Puts a table into its place, and the cells of a long one into its file."""
    path = programs.SOURCE / page
    text = "\n".join([*table, "", its_caption]) + "\n"
    path.write_text(block(name).sub(lambda found: found[1] + text + found[3], path.read_text(encoding="utf-8")), encoding="utf-8")
    if page.startswith(LONG):
        data_file(name).write_text(as_csv(page, name), encoding="utf-8")
