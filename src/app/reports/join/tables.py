"""The rows of the tables of frames of a joined run."""
import math
from typing import NamedTuple

import numpy as np

from reports.files import BadInput, require, text_of

POINTS, CONTACTS, EVENTS = "contacts/point", "contacts.frame.first", "events.frame"
RECORDED = ("particles.", "estimate.position.")  # beginnings of tables with a row a recorded frame
OF_RANKS = ("timings.rank.", "estimate.compute")  # beginnings of tables with an item a rank
PIECE_BYTES = 4 << 20
# Columns that clocks have measured or decided, or that say where in a file something stands: no two executions of a frame agree on them.
OF_ONE_EXECUTION = ("/timings/frame/wall", "/timings/frame/deadline_met", "/timings/island/solve", "/timings/space/collide",
                    "/timings/space/collide_spaces", "/estimate/delivered", "/estimate/precise", "/estimate/compute", "/contacts/frame/first")


class Table(NamedTuple):
    """`columns`: their paths; `recorded`: there is a row a recorded frame, not one a frame; `of_ranks`: a row has an item a rank."""
    columns: list
    recorded: bool
    of_ranks: bool


def tables_of(run):
    """The tables of a run's file by the names of their rows' checksums, but for /events."""
    require("checksums" in run.file, f"{run.path}: its layout, {run.attributes.get('version')}, is too old to be joined")
    columns = {name: text_of(dataset.attrs["columns"]).split() for name, dataset in run.file["checksums"].items()}
    return {name: Table(paths, name.startswith(RECORDED), name.startswith(OF_RANKS)) for name, paths in columns.items() if name != EVENTS}


def name_of(table):
    """The dataset that a table is known by."""
    return f"/{POINTS}" if table == CONTACTS else "/" + table.replace(".", "/")


def datasets_of(name, table):
    """The paths of a table's datasets."""
    return [*table.columns, f"/checksums/{name}"] + ([f"/{POINTS}"] if name == CONTACTS else [])


def bytes_of(values):
    """An array's bytes, [rows][bytes of a row]."""
    return np.frombuffer(values.tobytes(), np.uint8).reshape(len(values), values.nbytes // max(len(values), 1))


def row_bytes(dataset):
    return dataset.dtype.itemsize * math.prod(dataset.shape[1:])


def pieces(rows, dataset):
    """Slices of a slice of a dataset's rows, each of a few MiB."""
    step = max(PIECE_BYTES // max(row_bytes(dataset), 1), 1)
    return [slice(first, min(first + step, rows.stop)) for first in range(rows.start, rows.stop, step)]


def require_equal(plan, a, b, column, frames, recorded):
    """Raises BadInput unless a column has the same bytes in both parts in a stretch of frames."""
    in_a, in_b = a.file[column], b.file[column]
    rows_a, rows_b = plan.rows(frames, a.first_frame, recorded), plan.rows(frames, b.first_frame, recorded)
    for rows in pieces(rows_a, in_a):
        other = slice(rows.start - rows_a.start + rows_b.start, rows.stop - rows_a.start + rows_b.start)
        differ = [0] if row_bytes(in_a) != row_bytes(in_b) else np.flatnonzero(
            (bytes_of(in_a[rows]) != bytes_of(in_b[other])).any(axis=1)).tolist()
        if differ:
            frame = a.first_frame + (rows.start + differ[0] + 1) * (plan.record_every if recorded else 1) - 1
            raise BadInput(f"frame {frame} is in {a.path} and in {b.path}, and {column} is not the same in both; they are not of one run, or of "
                           "other builds")


def require_equal_overlaps(parts, tables, plan):
    """Raises BadInput unless frames that several parts have are equal bit for bit, except what OF_ONE_EXECUTION names, and the ranks' times."""
    for index, a in enumerate(parts):
        for overlap in plan.overlaps_of(index):
            b = parts[overlap.part]
            alike = (a.first_frame - b.first_frame) % plan.record_every == 0  # the motion of the same frames is recorded
            for table in tables.values():
                for column in table.columns:
                    if not table.of_ranks and column not in OF_ONE_EXECUTION and (alike or not table.recorded):
                        require_equal(plan, a, b, column, overlap, table.recorded)


def copy_rows(source, rows, target, first):
    """Writes rows of a dataset behind the first rows of another, with zeros for ranks that the source's run did not have."""
    for piece in pieces(rows, source):
        values, begin = source[piece], first + piece.start - rows.start
        if target.shape[1:] != values.shape[1:]:
            values = np.pad(values, ((0, 0), (0, target.shape[1] - values.shape[1])))
        target[begin:begin + len(values)] = values


def num_contacts(parts, plan):
    """[stretches] The contacts of their frames."""
    runs = [(parts[stretch.part], stretch) for stretch in plan.stretches]
    return [int(run.file["contacts/frame/count"][plan.rows(stretch, run.first_frame, False)].sum()) for run, stretch in runs]


def shapes_of(parts, tables, plan, num_events):
    """{path: rows, and items of a row where other than in the first part} of the datasets of the joined file that have a row a frame or an event."""
    shapes, num_ranks = {}, max(part.num_ranks for part in parts)
    for name, table in tables.items():
        rows = plan.num_frames // (plan.record_every if table.recorded else 1)
        shapes |= {path: (rows, num_ranks) if table.of_ranks else (rows,) for path in table.columns} | {f"/checksums/{name}": (rows,)}
    if CONTACTS in tables:
        shapes[f"/{POINTS}"] = (sum(num_contacts(parts, plan)),)
    return shapes | {f"/events/{name}": (num_events,) for name in parts[0].file["events"]} | {f"/checksums/{EVENTS}": (num_events,)}


def write_tables(parts, tables, plan, file):
    """Writes all rows but those of events, and without their checksums."""
    for table in tables.values():
        for column in table.columns:
            for stretch in plan.stretches:
                source = parts[stretch.part]
                copy_rows(source.file[column], plan.rows(stretch, source.first_frame, table.recorded), file[column],
                          plan.rows(stretch, plan.first, table.recorded).start)
    if CONTACTS in tables:
        write_contacts(parts, plan, file)


def write_contacts(parts, plan, file):
    """Writes the contacts of each stretch of frames after those of the frames before."""
    begin = 0
    for stretch, total in zip(plan.stretches, num_contacts(parts, plan)):
        source = parts[stretch.part]
        rows = plan.rows(stretch, source.first_frame, False)
        first, count = (source.file[f"contacts/frame/{name}"][rows] for name in ("first", "count"))
        file["contacts/frame/first"][plan.rows(stretch, plan.first, False)] = begin + np.cumsum(count) - count
        copy_rows(source.file[POINTS], slice(int(first[0]), int(first[0]) + total), file[POINTS], begin)
        begin += total
