"""The events of a joined run: the rows of /events, and the number of events of each kind, including those without a row."""
import numpy as np

from reports.files import require, text_of
from reports.join.tables import bytes_of

# Kinds of events of a run rather than of its worlds. As in the file of one run, they have rows of their own, and the worlds have the rest.
OF_THE_RUN = ("rebalance", "signal", "time_limit", "checkpoint")
MOST_OF_THE_RUN, MOST_OF_WORLDS = 64, 512 - 64
NO_KINDS = ("num_events", "num_dropped", "worlds_moved")  # counts of other things


class Events:
    """Of a part: `columns` by name, `kinds` and `frames` of the rows, `counts` by attribute."""

    def __init__(self, run):
        group = run.file["events"]
        self.counts = {name: int(value) for name, value in group.attrs.items()}
        self.columns = {name: column[:self.counts["num_events"]] for name, column in group.items()}
        self.kinds, self.frames = [text_of(kind) for kind in self.columns["kind"]], self.columns["frame"].tolist()

    def of_worlds(self, frames):
        """The rows of events of worlds in a stretch of frames."""
        return [row for row, (frame, kind) in enumerate(zip(self.frames, self.kinds))
                if frames.first <= frame < frames.end and kind not in OF_THE_RUN]

    def knows_all(self, frames):
        """Is there a row for each event of a world that happened before the end of these frames?"""
        last = [frame for frame, kind in zip(self.frames, self.kinds) if kind not in OF_THE_RUN][-1:]
        return self.counts["num_dropped"] == 0 or (last != [] and last[0] >= frames.end)

    def same_as(self, other, rows, other_rows):
        return len(rows) == len(other_rows) and all(
            np.array_equal(bytes_of(column[rows]), bytes_of(other.columns[name][other_rows])) for name, column in self.columns.items())

    def take_off(self, row, counts):
        """Counts one event less of its kind."""
        counts[f"num_{self.kinds[row]}"] -= 1
        if self.kinds[row] == "rebalance":
            counts["worlds_moved"] -= int(self.columns["value"][row])


def common_events(a, b, runs, overlap):
    """(Events, rows): the events of worlds in frames that two parts share, from the part that has them all."""
    a_knows, b_knows = a.knows_all(overlap), b.knows_all(overlap)
    names = f"{runs[0].path} and {runs[1].path}"
    require(a_knows or b_knows, f"{names} have more events in the frames that both have than they have room for: which these are is not known, "
                                "and they cannot be joined")
    of_a, of_b = a.of_worlds(overlap), b.of_worlds(overlap)
    require(not a_knows or not b_knows or a.same_as(b, of_a, of_b),
            f"{names} do not have the same events in frames {overlap.first} to {overlap.end - 1}, which both have; they are not of one run, or of "
            "other builds")
    return (a, of_a) if a_knows else (b, of_b)


class JoinedEvents:
    """The events of a frame come from the part from which the frame comes. `rows`: [(Events, row)]; `counts`: the attributes of /events.
    Raises BadInput where several parts share frames but disagree on the events of worlds, or the events are not known."""

    def __init__(self, parts, plan):
        self.rows, self.counts = [], {}
        events = [Events(part) for part in parts]
        room = {True: MOST_OF_THE_RUN, False: MOST_OF_WORLDS}
        for index, one in enumerate(events):
            self.counts = {name: self.counts.get(name, 0) + count for name, count in one.counts.items()}
            for overlap in plan.overlaps_of(index):
                known, rows = common_events(one, events[overlap.part], (parts[index], parts[overlap.part]), overlap)
                for row in rows:
                    known.take_off(row, self.counts)
            for row, (frame, kind) in enumerate(zip(one.frames, one.kinds)):
                of_the_run, has_frame = kind in OF_THE_RUN, frame < parts[index].first_frame + parts[index].num_frames
                if plan.part_of(frame) != index:
                    if of_the_run or not has_frame:  # those of worlds in frames that both parts have are taken off above
                        one.take_off(row, self.counts)
                elif room[of_the_run] > 0:
                    room[of_the_run] -= 1
                    self.rows.append((one, row))
        happened = sum(count for name, count in self.counts.items() if name not in NO_KINDS)
        self.counts |= {"num_events": len(self.rows), "num_dropped": happened - len(self.rows)}

    def write(self, file):
        for name, column in file["events"].items():
            values = np.array([one.columns[name][row] for one, row in self.rows], column.dtype)
            if len(values) > 0:
                column.id.write(column.id.get_space(), column.id.get_space(), values, mtype=column.id.get_type())
