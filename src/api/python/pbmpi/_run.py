"""The file of a run, or several of one that was saved and resumed, as arrays and tables."""

from functools import cached_property
from typing import Any, Optional

from ._files import unit_of
from ._parts import Part, Stretch, is_of_recorded_frames, plan
from ._rows import Rows
from ._tables import columns_of, joined, table_of, whole_table

# Groups with a row a frame, and what their columns have in it; other groups have a row an item.
OF_FRAMES: dict[str, list[str]] = {
    "timings/frame": ["frame"], "timings/rank": ["frame", "rank"], "timings/island": ["frame", "body"],
    "timings/space": ["frame", "world"], "observables/world": ["frame", "world"], "observables/interest": ["frame", "world"],
    "observables/residual": ["frame", "world"], "observables/joint": ["frame", "joint"]}
ITEMS = {"particles/bodies": "body", "geoms": "geom", "joints": "joint", "worlds": "world", "ranks": "rank",
         "pair_materials": "pair"}


class Run:
    """A run of pbmpi, as its file tells it: read("run.h5"), or read(["run.h5", "run.from120.h5"]).

    Of a run that was killed the committed frames are there; of one that was resumed those of all its files, as `pbreport join`
    takes them. Frames are counted from 0 at the start of the first run; `frames.measured` is 0 in warm-up frames. Bodies are in
    (world, body) order: rows of `bodies`.

    position, orientation, velocity, angular_velocity: [recorded frames][bodies][k] Rows, read as they are indexed.
    frames: a row a frame; worlds: a row a frame and world, what was measured; ranks: a row a frame and rank, seconds of its
    phases; bodies, geoms, joints: a row an item; events: a row an event. All are pandas tables, made when first asked for, whose
    attrs["units"] has the unit of each column. Meanings stand in io/SCHEMA.md.
    """

    def __init__(self, parts: list[Part]) -> None:
        self._parts = parts
        self._stretches = plan(parts)
        last = parts[self._stretches[-1].part]
        self.paths = [part.path for part in parts]
        #: Root attributes: of the first file; complete and state_hash of that with the last frame.
        self.attributes: dict[str, Any] = {**parts[0].attributes, **{name: last.attributes[name] for name in
                                                                     ("complete", "state_hash")}}
        #: Resolved options, the scene's text, build, hosts: of the first file.
        self.parameters = parts[0].parameters
        self.first_frame = parts[0].first
        self.num_frames = sum(stretch.length for stretch in self._stretches)
        self.attributes["frames_committed"] = self.num_frames

    def __enter__(self) -> "Run":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def close(self) -> None:
        """Closes the files: Rows can then not be read any more."""
        for part in self._parts:
            part.file.close()

    def __repr__(self) -> str:
        complete = "complete" if self.attributes["complete"] else "not complete"
        return f"<pbmpi.Run {self.attributes['scene']!r} {self.num_frames} frames, {complete}, of {', '.join(self.paths)}>"

    def array(self, path: str) -> Rows:
        """[frames][...] of a dataset with a row a frame (or a recorded frame), e.g. "observables/world/energy".

        KeyError for one that a file has not. ValueError for one whose rows differ in length from file to file.
        """
        if not is_of_recorded_frames(path) and path.rpartition("/")[0] not in (*OF_FRAMES, "estimate", "contacts/frame"):
            raise KeyError(f"{path}: it has no row a frame; table() reads what has a row an item")
        pieces = [self._parts[stretch.part].piece(path, stretch) for stretch in self._stretches]
        return Rows(path, pieces, unit_of(pieces[0].dataset))

    def table(self, group: str) -> Any:
        """A group of the file as a pandas table, e.g. "observables/world", "geoms", "worlds" (gravity and laws of each).

        What has a row an item is that of the first file. KeyError for a group that is not there.
        """
        if group not in OF_FRAMES:
            return whole_table(self._parts[0].file[group], ITEMS.get(group, "row"))
        return joined([self._frame_table(group, stretch) for stretch in self._stretches])

    def _frame_table(self, group: str, stretch: Stretch) -> Any:
        part = self._parts[stretch.part]
        read = ((name, Rows(name, [part.piece(f"{group}/{name}", stretch)], "")[:], unit_of(item))
                for name, item in columns_of(part.file[group]).items())
        return table_of(read, OF_FRAMES[group], stretch.first)

    @property
    def position(self) -> Rows:
        """[recorded frames][bodies][3] m: centres of mass at the end of the frame."""
        return self.array("particles/bodies/position/value")

    @property
    def orientation(self) -> Rows:
        """[recorded frames][bodies][4] (w, x, y, z)."""
        return self.array("particles/bodies/orientation/value")

    @property
    def velocity(self) -> Rows:
        """[recorded frames][bodies][3] m/s, of centres of mass."""
        return self.array("particles/bodies/velocity/value")

    @property
    def angular_velocity(self) -> Rows:
        """[recorded frames][bodies][3] rad/s, world frame."""
        return self.array("particles/bodies/angular_velocity/value")

    @property
    def time(self) -> Rows:
        """[recorded frames] s of simulated time, at which position and its like are."""
        return self.array("particles/bodies/position/time")

    @cached_property
    def frames(self) -> Any:
        """A row a frame: step, time [s], measured, wall [s], deadline_met."""
        return self.table("timings/frame")

    @cached_property
    def worlds(self) -> Any:
        """A row a frame and world: energy [J], contacts, joint_gap [m], ... of the frame's last step."""
        return self.table("observables/world")

    @cached_property
    def ranks(self) -> Any:
        """A row a frame and rank: seconds of each phase, messages, bytes."""
        return self.table("timings/rank")

    @cached_property
    def bodies(self) -> Any:
        """A row a body: world, name, actor, mass [kg], shape, ..."""
        return self.table("particles/bodies").drop(columns="id")

    @cached_property
    def geoms(self) -> Any:
        """A row a geom: world, body, shape, size, mu, ..."""
        return self.table("geoms")

    @cached_property
    def joints(self) -> Any:
        """A row a joint: world, name, kind, body_a, body_b, anchors, limits, motors, ..."""
        return self.table("joints")

    @cached_property
    def events(self) -> Any:
        """A row an event: frame, kind, detail, step, world, joint, name, value; of several files in the order of the frames."""
        return joined([self._events_of(stretch) for stretch in self._stretches]).reset_index(drop=True)

    def _events_of(self, stretch: Stretch) -> Any:
        """Events in these frames; before the first and behind the last frame of all those of the file at that end, too."""
        group = self._parts[stretch.part].file["events"]
        number = int(group.attrs["num_events"])
        table = table_of(((name, item[:number], unit_of(item)) for name, item in columns_of(group).items()), ["event"])
        wanted = (table.frame >= stretch.first) & (table.frame < stretch.first + stretch.length)
        if stretch is self._stretches[0]:
            wanted |= table.frame < stretch.first
        if stretch is self._stretches[-1]:
            wanted |= table.frame >= stretch.first + stretch.length
        kept = table[wanted]
        kept.attrs["units"] = table.attrs["units"]
        return kept

    def body(self, name: str, world: Optional[int] = None) -> int:
        """Row of a body, e.g. run.position[:, run.body("car.chassis")]. `world`: its world, needed where several have it.

        KeyError for a name that no body, or more than one, has.
        """
        bodies = self.bodies
        found = bodies.index[(bodies.name == name) & ((bodies.world == world) if world is not None else True)]
        if len(found) != 1:
            where = f"in world {world}" if world is not None else "of all worlds; name the world, too"
            raise KeyError(f"{name!r}: {len(found)} bodies {where} have this name; names stand in run.bodies.name")
        return int(found[0])
