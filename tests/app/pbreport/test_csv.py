"""pbreport csv against the files themselves: every number comes back with the same bits."""
import csv
import os
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ProgramTest  # noqa: E402

AXES = ("x", "y", "z")


class Table:
    """Lines of a CSV file; numbers by the names of their columns."""

    def __init__(self, text):
        lines = list(csv.reader(text.splitlines()))
        self.header, self.lines = lines[0], lines[1:]

    def texts(self, name):
        at = self.header.index(name)
        return [line[at] for line in self.lines]

    def numbers(self, *names):
        found = np.array([[float(line[self.header.index(name)]) for name in names] for line in self.lines])
        return found[:, 0] if len(names) == 1 else found


class Csv(ProgramTest):
    def table(self, *args):
        result = self.report("csv", *args)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return Table(result.stdout)

    def run_scene(self, *args, ranks=2):
        return self.summary(ranks, "--scene", "CrashSk", "--replicas", 2, "--frames", 4, "--output", "run.h5", *args)

    def assert_bits(self, found, expected):
        self.assertEqual(np.asarray(found, dtype="<f8").tobytes(), np.asarray(expected, dtype="<f8").tobytes())

    def test_bodies_have_the_bits_of_the_file_and_units_in_the_first_line(self):
        self.run_scene()
        table = self.table("run.h5")
        with h5py.File(self.path("run.h5")) as file:
            bodies = file["particles/bodies"]
            frames, count = bodies["position/value"].shape[:2]
            self.assertEqual(len(table.lines), frames * count)
            for name, unit, parts in (("position", " [m]", AXES), ("orientation", "", ("w", *AXES)),
                                      ("velocity", " [m s-1]", AXES), ("angular_velocity", " [rad s-1]", AXES)):
                found = table.numbers(*(f"{name}_{part}{unit}" for part in parts))
                self.assert_bits(found, bodies[name]["value"][:].reshape(-1, len(parts)))
            self.assertEqual(table.texts("name"), [name.decode() for name in bodies["name"][:]] * frames)
            self.assertEqual(table.texts("actor"), [name.decode() for name in bodies["actor"][:]] * frames)
            self.assert_bits(table.numbers("world"), np.tile(bodies["world"][:], frames))
            self.assert_bits(table.numbers("time [s]"), np.repeat(bodies["position/time"][:], count))
            self.assert_bits(table.numbers("step"), np.repeat(bodies["position/step"][:], count))

    def test_worlds_bodies_actors_and_frames_can_be_chosen(self):
        self.run_scene("--record-every", 2)
        table = self.table("run.h5", "--body", "car.chassis", "--world", "1", "--frames", "3:5")
        with h5py.File(self.path("run.h5")) as file:
            bodies = file["particles/bodies"]
            row, = np.flatnonzero((bodies["name"][:] == b"car.chassis") & (bodies["world"][:] == 1))
            # Frames 1, 3, 5 are recorded.
            self.assertEqual(table.numbers("frame").tolist(), [3, 5])
            self.assert_bits(table.numbers(*(f"position_{axis} [m]" for axis in AXES)), bodies["position/value"][1:3, row])
            of_car = int((bodies["actor"][:] == b"car").sum())
        self.assertEqual(len(self.table("run.h5", "--actor", "car", "--frames", "1").lines), of_car)
        self.assertEqual(set(self.table("run.h5", "--measured").texts("measured")), {"1"})
        self.assertEqual(self.table("run.h5", "--table", "timings", "--frames", ":5:2").numbers("frame").tolist(), [0, 2, 4])

    def assert_tables(self, *more):
        listed = [line.split()[0] for line in self.report("csv", "run.h5", "--list").stdout.splitlines()]
        self.assertEqual(sorted(listed), sorted(["bodies", "observables", "timings", "ranks", "events", "world_results", *more]))

    def test_every_table_of_the_file_is_there_with_its_numbers(self):
        self.run_scene("--record", "islands", "--stepper", "quick")
        self.assert_tables("islands", "spaces")
        with h5py.File(self.path("run.h5")) as file:
            self.assert_bits(self.table("run.h5", "--table", "islands").numbers("solve [s]"),
                             file["timings/island/solve"][:].ravel())
        self.run_scene("--feec")
        self.assert_tables("estimates", "estimate_times", "estimate_ranks")
        with h5py.File(self.path("run.h5")) as file:
            self.assert_bits(self.table("run.h5", "--table", "estimates").numbers("position_z [m]"),
                             file["estimate/position/value"][:, :, 2].ravel())
        self.run_scene("--record", "contacts,residuals")
        self.assert_tables("residuals", "joints", "contacts")
        with h5py.File(self.path("run.h5")) as file:
            observables = self.table("run.h5", "--table", "observables")
            for name, unit in (("contacts", ""), ("energy", " [J]"), ("joint_gap", " [m]")):
                self.assert_bits(observables.numbers(name + unit), file["observables/world"][name][:].ravel())
            self.assert_bits(observables.numbers(*(f"linear_momentum_{axis} [kg m s-1]" for axis in AXES)),
                             file["observables/world/linear_momentum"][:].reshape(-1, 3))
            ranks = self.table("run.h5", "--table", "ranks")
            self.assert_bits(ranks.numbers("solve [s]"), file["timings/rank/solve"][:].ravel())
            self.assertEqual(set(ranks.texts("host")), {name.decode() for name in file["ranks/host"][:]})
            self.assert_bits(self.table("run.h5", "--table", "timings").numbers("wall [s]"), file["timings/frame/wall"][:])
            joints = self.table("run.h5", "--table", "joints")
            self.assert_bits(joints.numbers("torque_y [N m]"), file["observables/joint/torque"][:, :, 1].ravel())
            self.assertEqual(joints.texts("name")[:3], [name.decode() for name in file["joints/name"][:3]])
            contacts = self.table("run.h5", "--table", "contacts")
            points = file["contacts/point"]
            names = points.attrs["columns"].decode().split()
            self.assert_bits(contacts.numbers("depth [m]"), points[:, names.index("depth")])
            self.assert_bits(contacts.numbers("geom_b"), points[:, names.index("geom_b")])
            self.assert_bits(contacts.numbers("frame"), np.repeat(np.arange(len(file["contacts/frame/count"])),
                                                                  file["contacts/frame/count"][:]))
            wheel = int(points[0, names.index("body_a")])
            name = file["particles/bodies/name"][wheel].decode()
            chosen = self.table("run.h5", "--table", "contacts", "--body", name, "--world", "0")
            self.assertEqual(len(chosen.lines), int(((points[:, names.index("world")] == 0) &
                             ((points[:, names.index("body_a")] == wheel) | (points[:, names.index("body_b")] == wheel))).sum()))

    def test_events_have_their_texts_and_a_resumed_run_goes_on_counting(self):
        self.summary(1, "--scene", "CrashSk", "--frames", 3, "--output", "run.h5", "--checkpoint", "run.ck.h5")
        events = self.table("run.h5", "--table", "events")
        self.assertEqual(events.texts("kind"), ["checkpoint"])
        self.assertIn("run.ck.h5", events.texts("detail")[0])
        self.assertEqual((events.texts("frame"), events.texts("value")), (["5"], ["1"]))
        self.summary(1, "--resume", "run.ck.h5", "--frames", 6, "--output", "rest.h5")
        self.assertEqual(self.table("rest.h5", "--table", "timings").numbers("frame").tolist(), [6, 7, 8])

    def test_writes_a_file_that_is_whole_and_replaces_no_run(self):
        self.run_scene()
        printed = self.report("csv", "run.h5").stdout
        result = self.report("csv", "run.h5", "--output", "run.csv")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
        with open(self.path("run.csv"), encoding="utf-8") as file:
            self.assertEqual(file.read(), printed)
        self.assertEqual(self.report("csv", "run.h5", "-o", "/dev/stdout").stdout, printed)
        self.assertEqual(self.report("csv", "run.h5", "--output", "run.h5").returncode, 2)
        self.assertEqual(sorted(os.listdir(self.folder)), ["run.csv", "run.h5", "run.xdmf"])

    def test_refuses_what_the_run_does_not_have_with_one_message(self):
        self.run_scene()
        for words, args in (("no such table; did you mean 'observables'", ["--table", "observable"]),
                            ("car.chassis", ["--body", "car.chasis"]), ("worlds 0 to 1", ["--world", "2"]),
                            ("not of bodies", ["--table", "timings", "--body", "car.chassis"]),
                            ("not of worlds", ["--table", "ranks", "--world", "0"]),
                            ("--frames 5:2", ["--frames", "5:2"]), ("--frames x", ["--frames", "x"])):
            result = self.report("csv", "run.h5", *args)
            self.assertEqual((result.returncode, result.stdout), (2, ""), args)
            self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
            self.assertIn(words, result.stderr)
        self.assertEqual(self.report("csv").returncode, 2)
        with h5py.File(self.path("run.h5"), "r+") as file:
            file["particles/bodies/velocity/value"][1, 0, 0] += 1
        self.assertIn("changed since it was written", self.report("csv", "run.h5").stderr)


if __name__ == "__main__":
    unittest.main()
