"""pbreport diff against a slow recomputation from the files, by other formulas."""
import unittest

import h5py
import numpy as np

from harness import ODE_LAW, ProgramTest

# Two boxes on a ball joint that starts at ANCHOR, and a third on a hinge with AXIS at HINGE: the loads are unequal
# enough that few iterations leave gaps.
ANCHOR, HINGE, AXIS = np.array([0.5, 0, 3]), np.array([1.5, 0, 3]), np.array([0, 1, 0])
SCENE = """\
title = "three boxes"
[run]
warmup = 1
frames = 6
""" + "".join(f"""
[[actor]]
type = "box"
name = "{name}"
position = [{x}, 0, 3]
size = [0.9, 0.5, 0.5]
mass = {mass}
angular_velocity = [0, 0, {spin}]
""" for name, x, mass, spin in (("a", 0, 1, 0), ("b", 1, 10, 3), ("c", 2, 300, 0))) + """
[[joint]]
kind = "ball"
name = "ball"
bodies = ["a", "b"]
anchor = [0.5, 0, 3]
[[joint]]
kind = "hinge"
name = "hinge"
bodies = ["b", "c"]
anchor = [1.5, 0, 3]
axis = [0, 1, 0]
"""


def matrices(q):
    """Rotation matrices [..., 3, 3] of quaternions (w, x, y, z), normalised first."""
    w, x, y, z = np.moveaxis(q / np.linalg.norm(q, axis=-1, keepdims=True), -1, 0)
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def angle_of(rotation):
    """Angle of a rotation matrix, from its skew part (small angles) and its trace."""
    skew = np.stack([rotation[..., 2, 1] - rotation[..., 1, 2], rotation[..., 0, 2] - rotation[..., 2, 0],
                     rotation[..., 1, 0] - rotation[..., 0, 1]], axis=-1)
    return np.arctan2(np.linalg.norm(skew, axis=-1), np.trace(rotation, axis1=-2, axis2=-1) - 1)


def bands(values, edges):
    finite = np.isfinite(values)
    return [int(n) for n in np.bincount(np.searchsorted(edges, values[finite], side="right"), minlength=4)] + [
        int((~finite).sum())]


class Run:
    """The measured frames of a file."""

    def __init__(self, path, group="particles/bodies"):
        with h5py.File(path) as file:
            measured = file["timings/frame/measured"][:file.attrs["frames_committed"]] == 1
            self.position = file[group]["position/value"][:len(measured)][measured]
            self.rotation = matrices(file[group]["orientation/value"][:len(measured)][measured])
            self.start = file["particles/bodies/initial_position"][:]
            self.start_rotation = matrices(file["particles/bodies/initial_orientation"][:])

    def point(self, body, at_start):
        """Where a point that was at `at_start` [m, world frame] is now, carried by `body`: [T][3]."""
        local = self.start_rotation[body].T @ (at_start - self.start[body])
        return self.position[:, body] + self.rotation[:, body] @ local

    def gap(self, body_a, body_b, anchor):
        """In the frame of a."""
        gap = self.point(body_a, anchor) - self.point(body_b, anchor)
        return np.einsum("tji,tj->ti", self.rotation[:, body_a], gap)

    def bend(self, body_a, body_b, axis):
        a, b = (self.rotation[:, body] @ self.start_rotation[body].T @ axis for body in (body_a, body_b))
        return np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.einsum("ti,ti->t", a, b))


class Diff(ProgramTest):
    def record(self, name, *args, ranks=1):
        result = self.pbmpi(ranks, *args, "--output", name, "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.path(name)

    def diff(self, *args):
        result = self.report("diff", *args, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.json(result)

    def assert_summary(self, found, errors, edges, scale=1.0):
        errors = np.asarray(errors).ravel()
        self.assertEqual(found["count"], errors.size)
        self.assertEqual(found["bands"], bands(errors * scale, edges))
        # Metres and radians of size 1 through rotation matrices instead of quaternions, some 1e-15 off each.
        self.assertAlmostEqual(found["rms"], np.sqrt(np.mean(errors**2)), delta=1e-12)
        self.assertAlmostEqual(found["p99"], np.quantile(errors, 0.99), delta=1e-12)
        self.assertAlmostEqual(found["max"], errors.max(), delta=1e-12)

    def assert_bodies(self, table, run, reference):
        self.assert_summary(table["body_position_m"], np.linalg.norm(run.position - reference.position, axis=2),
                            [0.01, 0.1, 1.0])
        turn = np.einsum("tnji,tnjk->tnik", run.rotation, reference.rotation)
        self.assert_summary(table["body_orientation_rad"], angle_of(turn), [0.05, 0.25, 0.5], 0.5 / np.pi)

    def test_bodies_of_a_crash_against_the_recomputation(self):
        few = self.record("few.h5", "--scene", "CrashSk", "--iterations", 3, "--feec", ranks=2)
        many = self.record("many.h5", "--scene", "CrashSk")
        found = self.diff(few, many)
        self.assertEqual(found["frames"], 5)
        self.assert_bodies(found["drift"], Run(few), Run(many))
        self.assert_bodies(found["estimate_defect"], Run(few, "estimate"), Run(few))
        self.assert_bodies(found["estimate_drift"], Run(few, "estimate"), Run(many))
        self.assertGreater(found["drift"]["body_position_m"]["max"], 0.01, "3 iterations are seen in a crash")
        self.assertFalse(found["same_state_hash"])

    def test_joints_against_the_recomputation(self):
        scene = self.write("three.toml", SCENE)
        few, many = (self.record(f"{n}.h5", "--scene", scene, *ODE_LAW, "--iterations", n) for n in (1, 50))
        drift = self.diff(few, many)["drift"]
        a, b = Run(few), Run(many)
        self.assert_bodies(drift, a, b)
        gaps = [np.linalg.norm(a.gap(*joint) - b.gap(*joint), axis=1) for joint in ((0, 1, ANCHOR), (1, 2, HINGE))]
        self.assertGreater(np.max(gaps), 1e-3, "the two runs must differ for this to test anything")
        self.assert_summary(drift["joint_position_m"], np.array(gaps).T, [0.01, 0.1, 1.0])
        bent = np.abs(a.bend(1, 2, AXIS) - b.bend(1, 2, AXIS))
        self.assertGreater(bent.max(), 1e-4)
        self.assert_summary(drift["joint_orientation_rad"], np.stack([np.zeros_like(bent), bent]).T,
                            [0.05, 0.25, 0.5], 0.5 / np.pi)

    def test_the_same_run_on_other_ranks_has_no_drift(self):
        files = [self.record(f"on{ranks}.h5", "--scene", "CrashSk", "--replicas", 3, ranks=ranks) for ranks in (1, 3)]
        found = self.diff(*files)
        self.assertTrue(found["same_state_hash"])
        self.assertEqual({found["drift"][name]["max"] for name in found["drift"]}, {0})

    def test_the_noise_floor_comes_from_other_seeds(self):
        run = self.record("run.h5", "--scene", "CrashWa", "--iterations", 19)
        reference = self.record("reference.h5", "--scene", "CrashWa")
        seeds = [self.record(f"seed{n}.h5", "--scene", "CrashWa", "--solver-seed", n) for n in (2, 3)]
        found = self.diff(run, reference, "--floor", *seeds)
        self.assertEqual(len(found["noise_floor"]), 2)
        for table, path in zip(found["noise_floor"], seeds):
            self.assert_bodies(table, Run(path), Run(reference))
        text = self.report("diff", run, reference, "--floor", *seeds).stdout
        self.assertEqual(text.count("noise_floor: "), 4)

    def refused(self, *args, words):
        result = self.report("diff", *args)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual((result.stdout, len(result.stderr.splitlines())), ("", 1), result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def contact_errors(self, path):
        """Of each measured frame: depths and slips [m] of contacts, and which bodies each is between."""
        found = []
        with h5py.File(path) as file:
            names = file["contacts/point"].attrs["columns"].decode().split()
            bodies = file["particles/bodies"]
            dt = file["parameters/dt"][()]
            for frame in np.flatnonzero(file["timings/frame/measured"][:]):
                first, count = (file["contacts/frame"][name][frame] for name in ("first", "count"))
                point = dict(zip(names, file["contacts/point"][first:first + count].T))
                a, b = point["body_a"].astype(int), point["body_b"].astype(int)
                place, normal, friction = (np.stack([point[f"{name}_{axis}"] for axis in "xyz"], 1)
                                           for name in ("position", "normal", "friction"))

                def speed(body):
                    arm = place - bodies["position/value"][frame][body]
                    moving = bodies["velocity/value"][frame][body] + np.cross(bodies["angular_velocity/value"][frame][body], arm)
                    return np.where(body[:, None] < 0, 0, moving)
                along = speed(a) - speed(b)
                along -= (along * normal).sum(1, keepdims=True) * normal
                force = point["normal_force"]
                sticks = (force > 0) & (np.linalg.norm(friction, axis=1) < 0.99 * point["mu"] * force)
                found.append((np.maximum(point["depth"], 0), dt * np.linalg.norm(along, axis=1), sticks, a, b))
        return found

    def test_constraints_by_frame_and_by_actor_against_the_recomputation(self):
        args = ["--scene", "CrashWa", "--frames", 12, "--record", "contacts"]
        few = self.record("few.h5", *args, "--iterations", 3)
        many = self.record("many.h5", *args, ranks=2)
        result = self.report("diff", few, many, "--html", "diff.html", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        found = self.json(result)
        constraints, frames = found["constraints"], self.contact_errors(few)
        with h5py.File(few) as run:
            actor_of = run["particles/bodies/actor"].asstr()[:]
        by_frame = constraints["run"]["by_frame"]
        self.assertEqual([len(found["steps"]), len(by_frame)], [len(frames)] * 2)
        for row, (depth, slip, sticks, _, _) in zip(by_frame, frames):
            for name, errors in (("penetration_m", depth), ("slip_m", slip[sticks])):
                self.assertEqual((row[name]["count"], row[name]["bands"]), (errors.size, bands(errors, [0.01, 0.1, 1.0])))
                self.assertAlmostEqual(row[name]["max"], errors.max(), delta=1e-12)
                self.assertAlmostEqual(row[name]["rms"], np.sqrt(np.mean(errors**2)), delta=1e-12)
        self.assertGreater(max(row["penetration_m"]["max"] for row in by_frame), 0)
        for whose in ("run", "reference"):  # the parts add up to the whole
            for name in ("joint_gap_m", "joint_bend_rad", "penetration_m", "slip_m"):
                whole, parts = constraints[whose][name], [row[name] for row in constraints[whose]["by_frame"]]
                self.assertEqual(sum(part["count"] for part in parts), whole["count"])
                self.assertEqual(np.sum([part["bands"] for part in parts], axis=0).tolist(), whole["bands"])
                self.assertEqual(max(part["max"] for part in parts), whole["max"])
        by_actor = constraints["run"]["by_actor"]
        for name in ("joint_gap_m", "joint_bend_rad"):  # a joint has one actor
            self.assertEqual(sum(row[name]["count"] for row in by_actor), constraints["run"][name]["count"])
        for row, actor in zip(by_actor, (one["actor"] for one in found["drift_by_actor"])):
            of_actor = [(np.r_[actor_of, [""]][a] == actor) | (np.r_[actor_of, [""]][b] == actor) for _, _, _, a, b in frames]
            depth = np.concatenate([frame[0][mine] for frame, mine in zip(frames, of_actor)])
            slip = np.concatenate([frame[1][mine & frame[2]] for frame, mine in zip(frames, of_actor)])
            for name, errors in (("penetration_m", depth), ("slip_m", slip)):
                self.assertEqual(row[name]["count"], errors.size, actor)
                self.assertAlmostEqual(row[name]["max"], errors.max(initial=0), delta=1e-12)
        page = self.drawn("diff.html")
        for words in ("joint gap", "joint bend", "penetration", "slip", "body position", "By actor"):
            self.assertIn(words, page)

    def test_a_page_has_no_curves_of_contacts_that_were_not_recorded(self):
        run, reference = self.record("run.h5", "--scene", "CrashSk", "--iterations", 5), self.record("all.h5", "--scene", "CrashSk")
        result = self.report("diff", run, reference, "--html", "diff.html", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(set(self.json(result)["constraints"]["run"]["by_frame"][0]), {"joint_gap_m", "joint_bend_rad"})
        with open(self.path("diff.html"), encoding="utf-8") as file:
            self.assertNotIn('"title":"slip"', file.read())
        self.refused(run, reference, "--html", run, words=["run.h5"])

    def test_files_that_cannot_be_compared_are_refused(self):
        one = self.record("one.h5", "--scene", "CrashSk")
        self.refused(one, words=["two"])
        self.refused(one, "absent.h5", words=["absent.h5", "no such file"])
        self.refused(one, self.record("2.h5", "--scene", "2-Cars"), words=["same bodies", "one.h5", "2.h5"])
        self.refused(one, self.record("two.h5", "--scene", "CrashSk", "--replicas", 2),
                     words=["same bodies", "37 bodies against 74"])
        varied = [self.record(f"{n}.h5", "--scene", "100CrSk", "--replicas", 2, "--seed", n) for n in (1, 2)]
        self.refused(*varied, words=["same bodies", "starts elsewhere", "--seed"])
        self.refused(one, self.record("long.h5", "--scene", "CrashSk", "--steps-per-frame", 6), words=["another time"])
        self.refused(one, one, "--floor", one, words=["one.h5", "--solver-seed"])


if __name__ == "__main__":
    unittest.main()
