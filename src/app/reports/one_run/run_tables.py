"""The tables of a run's file as the file stores them, some rows at a time."""
import dataclasses

import numpy as np

from reports.files import text_of
from reports.runs import OBSERVABLES, PHASES, Run
from reports.tables import Values

# What a row of a table describes: a frame, a frame in which the motion of bodies was stored, an event, or the whole run.
FRAMES, RECORDED, EVENTS, WHOLE = "frames", "recorded", "events", "run"
# What the items of a row are. ONE: it has one. CONTACTS: as many as the frame had.
ONE, RANKS, WORLDS, BODIES, JOINTS, CONTACTS = "one", "ranks", "worlds", "bodies", "joints", "contacts"
POSE = ("position/value", "orientation/value")
POINTS = "contacts/point"
NUM_INDICES = 6  # the first columns of a contact are whole numbers
CONTACT_UNITS = ("", "", "", "", "", "", "m", "m", "m", "", "", "", "m", "", "m", "m", "m", "N", "N", "N", "N", "N s", "N s", "N s")
EVENT_COLUMNS = ("frame", "kind", "detail", "step", "world", "joint", "name", "value")


@dataclasses.dataclass
class RunTable:
    """`columns`: datasets below `group`, in their order; of `owns_group` also those that this list lacks, after it."""
    name: str
    meaning: str
    group: str
    items: str
    rows: str
    columns: tuple
    owns_group: bool = False


KNOWN = (
    RunTable("bodies", "poses and velocities of bodies", "particles/bodies", BODIES, RECORDED,
             (*POSE, "velocity/value", "angular_velocity/value")),
    RunTable("observables", "what is measured of each world", "observables/world", WORLDS, FRAMES, tuple(OBSERVABLES), True),
    RunTable("residuals", "residuals of each world's last step", "observables/residual", WORLDS, FRAMES,
             ("joint_speed", "joint_turn", "complementarity", "natural_speed", "natural_turn"), True),
    RunTable("interest", "bodies in the field of interest", "observables/interest", WORLDS, FRAMES, ("bodies_inside",), True),
    RunTable("joints", "forces of joints, and when they broke", "observables/joint", JOINTS, FRAMES,
             ("broken_in", "force", "torque", "control", "rotor", "angle"), True),
    RunTable("timings", "how long frames took", "timings/frame", ONE, FRAMES, ("wall", "deadline_met")),  # the rest are labels
    RunTable("ranks", "seconds of ranks in their phases", "timings/rank", RANKS, FRAMES, (*PHASES, "useful", "processor", "messages", "bytes"), True),
    RunTable("islands", "islands, each at its lowest body", "timings/island", BODIES, FRAMES, ("bodies", "contacts", "rows", "solve"), True),
    RunTable("spaces", "collision detection by spaces", "timings/space", WORLDS, FRAMES, ("cross_contacts", "collide", "collide_spaces"), True),
    RunTable("estimates", "poses as FEEC estimated them", "estimate", BODIES, RECORDED, POSE),
    RunTable("estimate_times", "when estimates were delivered", "estimate", ONE, FRAMES, ("delivered", "precise")),
    RunTable("estimate_ranks", "seconds and steps of ranks for estimates", "estimate", RANKS, FRAMES,
             ("compute", "precise_steps", "coarse_steps")),
    RunTable("contacts", "contacts of each frame's last step", "contacts", CONTACTS, FRAMES, ("point",)),
    RunTable("world_parameters", "what worlds have otherwise than the scene", "world_parameters", WORLDS, WHOLE, (), True),
    RunTable("world_results", "what has become of each world", "world_results", WORLDS, WHOLE, (), True),
    RunTable("events", "what happened beside the frames", "events", ONE, EVENTS, EVENT_COLUMNS),
)


def column_name(path):
    """"position" for particles/bodies/position/value, "value" for events/value."""
    parts = path.split("/")
    return parts[-2] if parts[-1] == "value" and len(parts) > 2 else parts[-1]


class RunTables(Run):
    """A run, the tables that its file has, and the names of what their rows are about.

    step, time [s], frame_number: [T], of each frame; body_name, actor, kind, body_world: [N]; joint_name, joint_world: [J];
    contacts_before: [T + 1], the number of contacts before each frame."""

    def __init__(self, path):
        super().__init__(path)
        self.step, self.time = self.frames("timings/frame/step"), self.frames("timings/frame/time")
        self.frame_number = self.first_frame + np.arange(self.num_frames)
        bodies = ("name", "actor", "kind", "world")
        self.body_name, self.actor, self.kind, self.body_world = (self.column(f"particles/bodies/{what}") for what in bodies)
        has_joints = self.has("joints/name")
        self.joint_name = self.column("joints/name") if has_joints else []
        self.joint_world = self.column("joints/world") if has_joints else np.zeros(0, int)
        counts = self.frames("contacts/frame/count") if self.has(POINTS) else np.zeros(self.num_frames, int)
        self.contacts_before = np.concatenate([[0], np.cumsum(counts)])
        self.tables = {table.name: table for table in KNOWN if self._paths(table)}

    def _paths(self, table):
        """The datasets of a table; none where the file lacks the table."""
        if not self.has(table.group):
            return []
        group = self.file[table.group]
        if table.name == "world_results" and group.attrs.get("num_worlds", 0) <= 0:  # a run that was cut off
            return []
        names = [name for name in table.columns if name in group]
        names += sorted(name for name in group if name not in names) if table.owns_group else []
        before = ["worlds/id"] if table.rows == WHOLE and self.has("worlds/id") else []
        return before + [f"{table.group}/{name}" for name in names]

    def num_rows(self, table):
        if table.rows == EVENTS:
            return int(self.file["events"].attrs["num_events"])
        return {FRAMES: self.num_frames, RECORDED: self.num_recorded, WHOLE: 1}[table.rows]

    def frames_of(self, table):
        """The place among the frames of each row of a table of frames."""
        if table.rows == RECORDED:
            return (np.arange(self.num_recorded) + 1) * self.record_every - 1
        return np.arange(self.num_frames)

    def num_items(self, table):
        """In each row; not for contacts, whose number differs from row to row."""
        return {ONE: 1, RANKS: self.num_ranks, WORLDS: self.num_worlds, BODIES: len(self.body_name), JOINTS: len(self.joint_name)}[table.items]

    def read(self, table, first, count):
        """Columns [count * items][numbers of an item] of the rows from `first` on: the items of a row after those of the row before."""
        if table.items == CONTACTS:
            return self._read_contacts(*self.contacts_before[[first, first + count]])
        if table.rows == WHOLE:
            return [self._values(path, self._dataset(path)[:self.num_worlds * count], self.num_worlds * count) for path in self._paths(table)]
        rows, items = slice(first, first + count), self.num_items(table)
        if table.rows == EVENTS:
            return [self._values(path, self._read(path, rows), count) for path in self._paths(table)]
        of_rows = self.recorded if table.rows == RECORDED else self.frames
        return [self._values(path, of_rows(path, rows), count * items, items) for path in self._paths(table)]

    def _values(self, path, values, count, items=1):
        """`values`: [rows, ...], with `count` items in all and so many in a row."""
        width, rest = divmod(int(np.prod(values.shape[1:])), items)
        self._require(rest == 0, f"/{path} does not have {items} items a row")
        if values.dtype.kind in "SO":
            values = np.array([text_of(value) for value in values.ravel()], object)
        return Values(column_name(path), self.unit(path), values.reshape(count, width))

    def _read_contacts(self, first, last):
        points = self._read(POINTS, slice(first, last))
        names = text_of(self._dataset(POINTS).attrs["columns"]).split()
        self._require(points.ndim == 2 and points.shape[1] == len(names) == len(CONTACT_UNITS), f"/{POINTS} has other columns")
        return [Values(name, CONTACT_UNITS[place], points[:, [place]].astype(int if place < NUM_INDICES else float))
                for place, name in enumerate(names)]
