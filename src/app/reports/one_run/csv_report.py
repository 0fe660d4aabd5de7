"""pbreport csv: a table of a run as comma-separated values."""
import functools
import math
import re

import numpy as np

from reports.command_line import Command, Listed, parse, put, suggestion
from reports.files import BadInput, require, write_file
from reports.one_run.processes import in_order
from reports.one_run.run_tables import BODIES, CONTACTS, EVENTS, JOINTS, RANKS, WHOLE, WORLDS, RunTables
from reports.words import short

ITEMS_AT_ONCE = 1 << 15
LABELS = {RANKS: ("rank", "host"), WORLDS: ("world",), BODIES: ("body", "world", "name", "actor", "kind"), JOINTS: ("joint", "world", "name")}
COMPONENTS = {1: ("",), 3: ("_x", "_y", "_z"), 4: ("_w", "_x", "_y", "_z")}  # of a number, a vector, a quaternion


def add_options(group):
    group.add_argument("--table", default="bodies", metavar="NAME", help="which table of the file; default: bodies")
    group.add_argument("--list", action="store_true", help="print the tables that the file has")
    group.add_argument("--frames", metavar="FIRST:LAST[:EVERY]", help="these frames only, both ends included, counted from 0 at the start of "
                       "the first run; either end may be left out")
    group.add_argument("--measured", action="store_true", help="no warm-up frames")
    group.add_argument("--world", nargs="+", action=Listed, type=int, default=[], metavar="N", help="these worlds only")
    group.add_argument("--body", nargs="+", action=Listed, default=[], metavar="NAME", help="bodies of these names only, e.g. car.chassis")
    group.add_argument("--actor", nargs="+", action=Listed, default=[], metavar="NAME", help="bodies of these actors only, e.g. human1")
    group.add_argument("-o", "--output", metavar="FILE", help="write into FILE instead of standard output")


COMMAND = Command("csv", "Writes a table of a run as comma-separated values, units in the first line: poses and velocities of bodies, "
                  "observables, joints, contacts, timings, events. Numbers have as many digits as it takes to read them back to the same bits.",
                  "RUN.h5 [options]", add_options=add_options, prints_report=False,
                  examples=("pbreport csv 100CrSk.h5 --body car.chassis --world 0 --output chassis.csv",
                            "pbreport csv 100CrSk.h5 --table observables --measured > observables.csv", "pbreport csv 100CrSk.h5 --list"))


def frame_range(text):
    """(first, last, every) of "10:20", ":20", "10:", "10:20:5", "12"."""
    def number(part):
        require(re.fullmatch("[0-9]+", part), f"--frames {text}: '{part}' is no number of a frame; give FIRST:LAST, e.g. 10:20")
        return int(part)

    parts = text.split(":")
    require(text and len(parts) <= 3, f"--frames {text}: give FIRST:LAST or FIRST:LAST:EVERY, e.g. 10:20")
    first = number(parts[0]) if parts[0] else 0
    last = first if len(parts) == 1 else number(parts[1]) if parts[1] else math.inf
    every = number(parts[2]) if len(parts) > 2 else 1
    require(every >= 1, f"--frames {text}: every 0th frame is none; give 1 or more")
    require(first <= last, f"--frames {text}: the last frame is before the first")
    return first, last, every


class Choice:
    """The frames, worlds and bodies that a user has chosen. world [W], body [N]: bool, or None for all. Raises BadInput for what the run
    or the table does not have."""

    def __init__(self, run, table, options):
        self.range, self.measured_only = frame_range(options.frames) if options.frames is not None else (0, math.inf, 1), options.measured
        has_bodies = table.items in (BODIES, CONTACTS)
        require(has_bodies or not (options.body or options.actor), f"--table {table.name}: its rows are not of bodies; leave out --body and --actor")
        has_worlds = has_bodies or table.items in (WORLDS, JOINTS) or table.rows == EVENTS
        require(has_worlds or not options.world, f"--table {table.name}: its rows are not of worlds; leave out --world")
        require(table.rows != WHOLE or (self.range == (0, math.inf, 1) and not self.measured_only),
                f"--table {table.name}: its rows are not of frames; leave out --frames and --measured")
        for world in options.world:
            require(0 <= world < run.num_worlds, f"--world {world}: the run has worlds 0 to {run.num_worlds - 1}")
        self.world = np.isin(np.arange(run.num_worlds), options.world) if options.world else None
        of_name, of_actor = named(options.body, run.body_name, "--body"), named(options.actor, run.actor, "--actor")
        self.body = of_name if of_actor is None else of_actor if of_name is None else of_name & of_actor

    def has_frames(self, numbers, measured):
        """Of each frame, given its number and whether it was measured."""
        first, last, every = self.range
        return (numbers >= first) & (numbers <= last) & ((numbers - first) % every == 0) & (measured | (not self.measured_only))


def named(names, of_bodies, option):
    """bool [N]: the bodies that have one of these names; None for no names."""
    for name in names:
        require(name in of_bodies, f"{option} {name}: the run has none of this name; {suggestion(name, sorted(set(of_bodies)))}")
    return np.isin(np.array(of_bodies, object), names) if names else None


def is_chosen(chosen, places):
    """`chosen`: bool by place, None for all. A place of -1, which is nothing, is never among those chosen."""
    if chosen is None:
        return np.ones(len(places), bool)
    inside = (places >= 0) & (places < len(chosen))
    return inside & chosen[np.where(inside, places, 0)]


def quoted(text):
    return '"' + text.replace('"', '""') + '"' if re.search('[,"\n\r]', text) else text


def number_text(value):
    """short(), with every digit of a large whole number and the sign of what is no number."""
    if math.isnan(value):
        return "-nan" if math.copysign(1, value) < 0 else "nan"
    text = short(value)
    return str(int(value)) if abs(value) >= 2 ** 53 and text.lstrip("-").isdigit() else text


def texts_of(values):
    """The cells of one column of numbers or texts. repr() and number_text() differ for whole numbers, some below 0.001, and what is not
    finite, which are few."""
    if values.dtype.kind == "O":
        return list(map(quoted, values))
    if values.dtype.kind in "iub":
        return list(map(str, values.tolist()))
    texts = list(map(repr, values.tolist()))
    sizes = np.abs(values)
    is_usual = (values != np.rint(values)) & ((sizes >= 1e-3) | (sizes < 9e-5))
    for place in np.flatnonzero(~is_usual).tolist():
        texts[place] = number_text(float(values[place])) if values[place] else texts[place].removesuffix(".0")
    return texts


def header(columns, labels):
    names = [f"{column.name}{component}" + (f" [{column.unit}]" if column.unit else "") for column in columns
             for component in COMPONENTS.get(column.values.shape[1]) or [f"_{k + 1}" for k in range(column.values.shape[1])]]
    return ",".join([*labels, *names]) + "\n"


def lines(columns, chosen, labels=None):
    """`chosen`: the rows to write, bool or their places; `labels()`: a text before each of them."""
    cells = [texts_of(column.values[chosen, k]) for column in columns for k in range(column.values.shape[1])]
    return "".join([",".join(line) + "\n" for line in zip(*([labels()] if labels else []), *cells)])


def item_labels(run, table):
    """A text for each item of a row."""
    names = {RANKS: (run.hosts,), WORLDS: (), BODIES: (run.body_world, run.body_name, run.actor, run.kind),
             JOINTS: (run.joint_world, run.joint_name)}.get(table.items)
    if names is None:
        return None
    cells = [texts_of(np.array(name, object) if isinstance(name, list) else name) for name in names]
    return [",".join(map(str, label)) for label in zip(range(run.num_items(table)), *cells)]


def event_lines(run, table, choice):
    """Here and below: makers of the lines of some rows, for processes.in_order()."""
    columns = run.read(table, 0, run.num_rows(table))
    values = {column.name: column.values[:, 0] for column in columns}
    world = values.get("world", np.full(len(values["frame"]), -1))
    measured = np.isin(values["frame"], run.frame_number[run.measured])
    yield lambda: lines(columns, choice.has_frames(values["frame"], measured) & is_chosen(choice.world, world))


def lines_of_the_run(run, table, choice):
    """Lines of worlds, without frames."""
    worlds = np.flatnonzero(is_chosen(choice.world, np.arange(run.num_worlds)))
    columns = run.read(table, 0, 1)
    yield lambda: lines(columns, worlds, lambda: map(str, worlds))


def blocks(rows, sizes):
    """(first, count) of rows to read together: of `rows`, ascending, those that follow each other, with not many more than
    ITEMS_AT_ONCE items. `sizes`: the items of each of them."""
    first, items = 0, 0
    for place, size in enumerate(sizes):
        items += size
        if place + 1 == len(rows) or rows[place + 1] != rows[place] + 1 or items >= ITEMS_AT_ONCE:
            yield int(rows[first]), place + 1 - first
            first, items = place + 1, 0


def frame_lines(run, table, choice):
    frames = run.frames_of(table)
    rows = np.flatnonzero(choice.has_frames(run.frame_number[frames], run.measured[frames]))
    stamps = [",".join(stamp) for stamp in zip(*map(texts_of, (run.frame_number, run.step, run.time, run.measured.astype(int))))]
    if table.items == CONTACTS:
        for first, count in blocks(rows, np.diff(run.contacts_before)[rows]):
            yield functools.partial(contact_lines, run, run.read(table, first, count), choice, stamps, first)
        return
    places = np.arange(run.num_items(table))
    world = {WORLDS: places, BODIES: run.body_world, JOINTS: run.joint_world}.get(table.items)
    items = places if world is None else np.flatnonzero(is_chosen(choice.world, world) & ((table.items != BODIES) | is_chosen(choice.body, places)))
    labels = item_labels(run, table)
    of_items = [""] if labels is None else ["," + labels[item] for item in items]
    for first, count in blocks(rows, [len(places)] * len(rows)):
        chosen = (np.arange(count)[:, None] * len(places) + items).ravel()
        before = functools.partial(joined_labels, [stamps[frame] for frame in frames[first:first + count]], of_items)
        yield functools.partial(lines, run.read(table, first, count), chosen, before)


def joined_labels(of_rows, of_items):
    return [row + item for row in of_rows for item in of_items]


def contact_lines(run, columns, choice, stamps, first):
    values = {column.name: column.values[:, 0] for column in columns}
    touches = is_chosen(choice.body, values["body_a"]) | is_chosen(choice.body, values["body_b"])
    chosen = np.flatnonzero(touches & is_chosen(choice.world, values["world"]))
    frames = np.searchsorted(run.contacts_before, run.contacts_before[first] + chosen, "right") - 1
    return lines(columns, chosen, lambda: [stamps[frame] for frame in frames])


def text_of(run, table, options):
    """The lines of a table, in parts."""
    choice = Choice(run, table, options)
    labels = {EVENTS: (), WHOLE: ("world",)}.get(table.rows, ("frame", "step", "time [s]", "measured", *LABELS.get(table.items, ())))
    yield header(run.read(table, 0, 0), labels)
    yield from in_order({EVENTS: event_lines, WHOLE: lines_of_the_run}.get(table.rows, frame_lines)(run, table, choice))


def run(words):
    options = parse(COMMAND, words)
    if options is None:
        return
    require(len(options.files) == 1, f"csv: {len(options.files)} files are given; name the HDF5 file of one run (names of --body, --actor and "
                                     "numbers of --world come after it)")
    found = RunTables(options.files[0])
    if options.list:
        put("".join(f"{table.name:<15} {table.meaning}\n" for table in found.tables.values()))
        return
    if options.table not in found.tables:
        raise BadInput(f"--table {options.table}: {found.path} has no such table; {suggestion(options.table, list(found.tables))}; --list prints all")
    text = text_of(found, found.tables[options.table], options)
    if options.output:
        write_file(options.output, text)
    else:
        for part in text:
            put(part)
