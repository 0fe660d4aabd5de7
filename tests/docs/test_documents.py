"""The documents: figures only where a script writes them, links and paths that lead somewhere, a README that stays short."""
import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "docs"))

from tables import kept  # noqa: E402
from tables.entries import DIAGRAMS, ENTRIES, diagram_file, drawn  # noqa: E402

DOCUMENTS = [SOURCE / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "jobs/README.md", "io/SCHEMA.md",
                                        "scenes/FORMAT.md")] + sorted((SOURCE / "docs").rglob("*.md"))
PAGES = [SOURCE / "README.md"] + sorted((SOURCE / "docs").rglob("*.md"))
PLACE = re.compile(r"^<!-- figures: (\w+) -->\n(.*?)^<!-- end figures -->$", re.MULTILINE | re.DOTALL)
# Tables whose numbers no program computes, such as exit codes, or figures of variants that are not in the program: (page, first
# line of the table).
ALLOWED = {("contacts.md", "order of contacts in a sweep law ode, 1 x 20 soft law, 8 x 1"), ("start.md", "word meaning")}


def tables(text):
    """Tables of a page: each a list of rows, a row a list of cells; code, links and the line of dashes left out."""
    rows = []
    for line in [*text.splitlines(), ""]:
        if line.startswith("|"):
            plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", re.sub(r"`[^`]*`", "", line))
            rows.append([cell.strip() for cell in plain.strip("|").split("|")])
        elif rows:
            yield rows
            rows = []


def is_of_numbers(rows):
    """Whether a cell is a figure; scenes such as 2-Cars open the lines."""
    return any(re.match(r"[-x×<(]?\s*\d", cell) for row in rows[2:] for cell in row[1:])


class Documents(unittest.TestCase):
    def test_pages_are_few_and_short(self):
        pages = [SOURCE / "README.md", *(SOURCE / "docs").glob("*.md")]
        lines = {page.name: len(page.read_text(encoding="utf-8").splitlines()) for page in pages}
        self.assertLessEqual(lines["README.md"], 150)
        self.assertLessEqual(len(pages) - 1, 14)
        self.assertLessEqual(sum(lines.values()), 2500)

    def test_every_table_of_numbers_stands_where_a_script_writes_it(self):
        for page in PAGES:
            by_hand = PLACE.sub("", page.read_text(encoding="utf-8"))
            found = [rows[0] for rows in tables(by_hand)
                     if is_of_numbers(rows) and (page.name, " ".join(rows[0])) not in ALLOWED]
            self.assertEqual(found, [], f"{page.name}: figures written by hand; add an entry to docs/figures.py")

    def test_no_sentence_quotes_a_speed(self):
        for page in PAGES:
            by_hand = PLACE.sub("", page.read_text(encoding="utf-8"))
            self.assertEqual(re.findall(r"\d[\d.,]* times as fast|\bx \d+\.\d+", by_hand), [], page.name)

    def test_every_entry_has_one_place_on_its_page_and_every_place_an_entry(self):
        places = {}
        for page in PAGES:
            for name, _ in PLACE.findall(page.read_text(encoding="utf-8")):
                places.setdefault(name, []).append(page.relative_to(SOURCE).as_posix())
        self.assertEqual(places, {name: [entry.page] for name, entry in ENTRIES.items()})

    def test_markers_come_in_pairs(self):
        for page in PAGES:
            text = page.read_text(encoding="utf-8")
            self.assertEqual(len(PLACE.findall(text)), text.count("<!-- figures:"), page.name)
            self.assertEqual(len(PLACE.findall(text)), text.count("<!-- end figures"), page.name)

    def test_every_table_of_figures_says_how_and_from_which_revision_it_was_made(self):
        for page in PAGES:
            for name, content in PLACE.findall(page.read_text(encoding="utf-8")):
                self.assertRegex(content, r"^\|", f"{name}: run docs/figures.py {name}")
                caption = content.strip().splitlines()[-1]
                self.assertRegex(caption, r"^\*`.*; revision [0-9a-f]{7}", name)
                if ENTRIES[name].has_clock:
                    self.assertRegex(caption, r"\d+ cores, .*, \d{4}-\d\d-\d\d, load", name)

    def test_a_long_table_has_its_cells_in_a_file(self):
        long = {name: entry.page for name, entry in ENTRIES.items() if entry.page.startswith(kept.LONG)}
        for name, page in long.items():
            self.assertEqual(kept.data_file(name).read_text(encoding="utf-8"), kept.as_csv(page, name), f"run docs/figures.py {name}")
        files = {path.stem for folder in ("pages", "data") for path in (SOURCE / "docs/tables" / folder).iterdir()}
        self.assertEqual(files, set(long), "docs/tables/pages and docs/tables/data")

    def test_every_diagram_is_drawn_from_the_tables_as_they_are(self):
        for name in DIAGRAMS:
            self.assertEqual(diagram_file(name).read_text(encoding="utf-8"), drawn(name), f"docs/images/{name}.svg: run docs/figures.py --diagrams")
        self.assertEqual({path.stem for path in (SOURCE / "docs/images").glob("*.svg")}, set(DIAGRAMS))

    def test_every_image_is_shown_on_a_page(self):
        shown = {name for page in PAGES for name in re.findall(r"images/([\w.-]+)", page.read_text(encoding="utf-8"))}
        files = {path.name: path.stat().st_size for path in (SOURCE / "docs/images").iterdir()}
        self.assertEqual(shown, set(files))
        self.assertLess(max(files.values()), 2_000_000)

    def test_links_lead_somewhere(self):
        for page in DOCUMENTS:
            text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
            for target in re.findall(r"\]\(([^)\s]+)\)|<img src=\"([^\"]+)\"", text):
                target = "".join(target)
                if re.match(r"https?:", target):
                    continue
                path = (page.parent / target.split("#")[0]).resolve() if not target.startswith("#") else page
                self.assertTrue(path.exists(), f"{page.relative_to(SOURCE)}: {target}")
                if "#" in target:
                    headings = re.findall(r"^#+ (.*)$", path.read_text(encoding="utf-8"), re.MULTILINE)
                    anchors = {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}
                    self.assertIn(target.split("#")[1], anchors, page.name)

    def test_paths_that_pages_name_are_there(self):
        tops = "src|mpi|io|scenes|tests|jobs|docs"
        for page in [*PAGES, SOURCE / "CONTRIBUTING.md"]:
            for path in re.findall(rf"`((?:{tops})/[\w./-]+)`", page.read_text(encoding="utf-8")):
                self.assertTrue((SOURCE / path).exists(), f"{page.relative_to(SOURCE)}: {path}")


if __name__ == "__main__":
    unittest.main()
