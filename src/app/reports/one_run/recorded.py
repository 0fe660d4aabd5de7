"""What a run has recorded of its bodies and joints, frame by frame."""
import numpy as np

from reports.files import require
from reports.one_run.rigid import Joints, Poses, Segments
from reports.one_run.run_tables import POINTS, RunTables
from reports.samples import total

SAME_TIME_S = 1e-9  # times are step x dt, so another dt rounds differently


class RecordedRun(RunTables):
    """A run and its poses. mass [N] kg; start: the initial Poses; recorded_step, recorded_time [s]: [P]; joints [J], segments of humans.

    Its `rows` are those of recorded frames."""

    def __init__(self, path):
        super().__init__(path)
        self.mass = self.column("particles/bodies/mass")
        self.start = Poses(self.column("particles/bodies/initial_position"), self.column("particles/bodies/initial_orientation"))
        self.recorded_step, self.recorded_time = (self.recorded(f"particles/bodies/position/{name}") for name in ("step", "time"))
        require(self.has("joints/kind"), f"{path}: it has no /joints, as files before layout 1.5; run it again with this pbmpi")
        self.joints = Joints(self, self.start)
        self.segments = Segments(self.joints, np.array(self.kind, object) == "human")
        self.events = self._events()
        self._broken_in = self._broken_steps()

    def _events(self):
        columns = {column.name: column.values[:, 0].tolist() for column in self.read(self.tables["events"], 0, self.num_rows(self.tables["events"]))}
        return [dict(zip(columns, event)) for event in zip(*columns.values())]

    def num_events(self, kind):
        """In the whole run, those for which the file had no row included."""
        return int(self.file["events"].attrs.get(f"num_{kind}", 0))

    def broken_joints(self):
        """Events, which have a name of the joint beside: "world 0: 'car.wheel'"."""
        return [event | {"joint_name": f"world {event['world']}: '{event['name']}'"} for event in self.events
                if event["kind"] == "joint_broken" and event.get("world", -1) >= 0]

    def _broken_steps(self):
        """[J], the step in which each joint broke; -1: it did not. Joints that are broken stay broken: the last frame has them all."""
        if self.has("observables/joint/broken_in") and self.num_frames > 0:
            return self.frames("observables/joint/broken_in", slice(self.num_frames - 1, None))[0]
        return np.full(len(self.joints), -1)

    def held(self, row):
        """bool [J]: the joints that are not broken at the end of a recorded frame."""
        return (self._broken_in < 0) | (self._broken_in >= self.recorded_step[row])

    def places_of(self, other):
        """int [J] of another run: the place of each of its joints among this run's; -1: this run lacks it."""
        ours, theirs = (list(zip(np.asarray(run.joint_world).tolist(), run.joint_name)) for run in (self, other))
        place = {joint: index for index, joint in enumerate(ours)}
        return np.array([place.get(joint, -1) for joint in theirs], int)

    def poses(self, row, group="particles/bodies"):
        """At the end of a recorded frame; `group` "estimate": as FEEC estimated them."""
        return Poses(*(self.recorded(f"{group}/{name}/value", slice(row, row + 1))[0].astype(float) for name in ("position", "orientation")))

    def measured_rows(self, num_rows):
        """The rows among the first so many whose frames were measured."""
        return np.flatnonzero(self.measured[(np.arange(num_rows) + 1) * self.record_every - 1])

    @property
    def has_contacts(self):
        return self.has(POINTS) and self.num_frames > 0

    def contacts(self, row):
        """[contacts][columns of /contacts/point] that acted in the last step of a recorded frame."""
        frame = (row + 1) * self.record_every - 1
        points = self._read(POINTS, slice(*self.contacts_before[frame:frame + 2]))
        points = points[points[:, 5] == 1]
        bodies, count = points[:, 3:5], len(self.body_name)
        self._require(np.all((bodies >= [0, -1]) & (bodies < count)), f"/{POINTS} names a body that is not there")
        return points

    def joined(self, name):
        """[T] of a column of /observables/world: the largest of the worlds of lengths, else their sum."""
        if not self.has(f"observables/world/{name}"):
            return np.zeros(self.num_frames)
        worlds = self.frames(f"observables/world/{name}").astype(float)
        return worlds.max(1) if self.unit(f"observables/world/{name}") == "m" else total(worlds.T)

    def actors(self):
        """([(world, name, kind)] in the order of their first bodies, [N] the actor of each body)."""
        known = {}
        places = [known.setdefault(key, len(known)) for key in zip(self.body_world.tolist(), self.actor)]
        first = np.unique(places, return_index=True)[1].tolist()
        return [(int(self.body_world[body]), self.actor[body], self.kind[body]) for body in first], np.array(places, int)


def difference(a, b):
    """Why two runs do not have the same bodies; empty if they do."""
    if len(a.body_name) != len(b.body_name):
        return f"{len(a.body_name)} bodies against {len(b.body_name)}"
    same = ((a.start.position == b.start.position).all(1) & (a.start.orientation == b.start.orientation).all(1))[:-1]
    for body, name in enumerate(a.body_name):
        which = f"body {body} ('{name}' of world {a.body_world[body]})"
        if (name, a.body_world[body]) != (b.body_name[body], b.body_world[body]):
            return f"{which} is '{b.body_name[body]}' there"
        if a.mass[body] != b.mass[body]:
            return f"{which} has another mass there"
        if not same[body]:
            return f"{which} starts elsewhere there"
    return ""


def require_comparable(a, b):
    """Raises BadInput unless two runs have the same bodies, recorded at the same times as far as both have them."""
    reason = difference(a, b)
    require(not reason, f"{a.path} and {b.path} do not describe the same bodies ({reason}); compare runs of one scene and one --seed")
    rows = min(a.num_recorded, b.num_recorded)
    require(rows > 0, f"{a.path} and {b.path}: one of them has no recorded frame to compare")
    apart = np.flatnonzero(~(np.abs(a.recorded_time[:rows] - b.recorded_time[:rows]) <= SAME_TIME_S)).tolist()
    require(not apart, f"{a.path} and {b.path}: row {next(iter(apart), None)} was recorded at another time; give both the same frame length and "
                       "--record-every")
