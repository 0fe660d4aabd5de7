#!/usr/bin/env python3
"""Writes the tables and diagrams of the documents: what stands between `<!-- figures: NAME -->` and `<!-- end figures -->`, and docs/images/*.svg.

Usage: docs/figures.py [--check | --without-clock | --diagrams] [NAME ...], after jobs/build.sh (PBMPI_BIN: another folder of the programs);
default: all tables, or all without a clock. Below each table stand its commands, the revision and, of a table with a clock, the machine and the day. A
long table has a page of its own in docs/tables/pages, and its cells in docs/tables/data. --check recomputes the tables without a clock, and fails with
the names of those that differ from their page. Diagrams are drawn of tables as they are kept, with them or, by --diagrams, alone: that starts no program.
"""
import argparse
import os
import sys

from tables import kept, programs
from tables.entries import DIAGRAMS, ENTRIES, diagram_file, drawn


def caption(entry, busy):
    """`busy`: the load of the machine before the table was made."""
    commands = ", ".join(f"`{command}`" for command in entry.commands)
    if not entry.has_clock:
        return f"*{commands}; revision {programs.revision()}.*"
    return (f"*{commands}; revision {programs.revision()}, {programs.machine()}, {programs.today()}, "
            f"load of the machine {busy:.1f}.*")


def write(name):
    entry = ENTRIES[name]
    busy = os.getloadavg()[0]
    table = entry.make()
    if entry.has_clock or table != kept.lines(entry.page, name):
        kept.write(entry.page, name, table, caption(entry, busy))
    draw([diagram for diagram in DIAGRAMS if name in DIAGRAMS[diagram].tables])


def draw(diagrams):
    for name in diagrams:
        diagram_file(name).write_text(drawn(name), encoding="utf-8")


def differs(name):
    """Whether the page has another table than the programs give now; shows the lines."""
    page = ENTRIES[name].page
    old, new = kept.lines(page, name), ENTRIES[name].make()
    if old == new:
        return False
    print(f"{page}: table '{name}' differs; run docs/figures.py {name}")
    for line in old:
        if line not in new:
            print(f"- {line}")
    for line in new:
        if line not in old:
            print(f"+ {line}")
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--without-clock", action="store_true")
    parser.add_argument("--diagrams", action="store_true")
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(ENTRIES))
    arguments = parser.parse_args()
    unknown = [name for name in arguments.names if name not in ENTRIES]
    if unknown:
        parser.error(f"no table {', '.join(unknown)}; known: {', '.join(ENTRIES)}")
    if arguments.diagrams:
        draw(DIAGRAMS)
        return 0
    names = arguments.names or list(ENTRIES)
    if arguments.check or arguments.without_clock:
        names = [name for name in names if not ENTRIES[name].has_clock]
    if arguments.check:
        return int(any([differs(name) for name in names]))
    for name in names:
        print(name, flush=True)
        write(name)
    return 0


if __name__ == "__main__":
    sys.exit(main())
