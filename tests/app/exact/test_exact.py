"""Motions known in closed form: the formulas by laws of motion that they do not use, and `sor` by the formulas at two step lengths."""
import collections
import os
import pathlib
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import harness  # noqa: E402

sys.path.insert(0, os.path.join(harness.SOURCE, "docs"))
from tables import exact, motions  # noqa: E402

FINER = 4  # the second step is a quarter of the scene's
# Of sor: largest error [m] at the scene's step, least order between the two steps, and why.
Bound = collections.namedtuple("Bound", "error_m order why")
# A force acts before the motion of each substep s = 10 ms / 14, as in Euler's symplectic method: half a substep's kick too early.
# After a change of speed by v this is v s / 2.
KICK = "the force acts half a substep too early"
BOUNDS = {
    "flight": Bound(7.1e-3, 0.99, f"{KICK}: g t s / 2 = 7.007 mm after 2 s"),
    "damped": Bound(5.4e-3, 0.99, f"{KICK} and the damping half a substep too late: 5.25 mm"),
    "drag": Bound(7.5e-3, 0.99, f"{KICK}, and the drag of the speed at the step's start: 0.3 mm more"),
    "slide": Bound(1.1e-3, 0.99, f"{KICK}: v s / 2 = 1.07 mm at 3 m/s"),
    "roll": Bound(0.56e-3, 0.99, f"{KICK}: v s / 2 = 0.51 mm for the 1.43 m/s that friction takes"),
    "incline_stay": Bound(6e-6, 1.9, "the contact's spring gives by (s / 1.13)^2 g = 4 um across, and along as friction's does"),
    "incline_slide": Bound(1.9e-3, 0.95, f"{KICK}: 0.81 mm; the contact is not fully pressed in the first 0.1 s, and 0.65 mm/s too much stay: 0.97 mm"),
    "incline_roll": Bound(1.4e-3, 0.99, f"{KICK}: v s / 2 = 1.28 mm at 3.6 m/s"),
    "ladder": Bound(1.2e-3, 0.95, f"{KICK}, at up to 1.6 m/s, and it grows as the ladder falls ever faster"),
    "pendulum": Bound(1.3e-3, 0.97, f"{KICK}: v s / 2 = 1.18 mm at 3.3 m/s"),
    "pendulum_over": Bound(0.15e-3, 1.5, "at the lowest point, where it starts, a kick has no effect; the reversible joint is of second order"),
    "two_links": Bound(1.2e-6, 0.97, f"{KICK}: v s / 2 of 3 mm/s"),
    "free_spin": Bound(0.4e-6, 1.97, "the symmetric splitting of the free turn is of second order"),
    "disc_spin": Bound(1e-9, None, "the splitting is exact for a symmetric body: rounding"),
    "top": Bound(0.13e-3, 0.97, f"{KICK}: v s / 2 = 0.05 mm at 0.15 m/s, which also makes it nod by as much"),
    "suspension": Bound(1.1e-3, 0.95, f"{KICK}: v s / 2 = 0.3 mm, and the spring is implicit, which damps it by w s / 2 = 0.45 % of critical more"),
    "motor": Bound(1.1e-3, 0.97, f"{KICK}: v s / 2 of 3 m/s = 1.07 mm"),
    # A touch inside a step is found at its end, and the bodies part in the first substep of the next one.
    "bounce": Bound(66e-3, 0.85, "each impact up to a step late: at 4.4 m/s until then and 3.5 m/s from then on"),
    "cradle": Bound(33e-3, 0.85, "each of three impacts up to a step late, at 2 m/s"),
    "impact": Bound(44e-3, 0.85, "up to a step late, at 4.5 m/s of change"),
}


def derivatives(motion, t, d=1e-3):
    """{point: (positions, velocities, accelerations)} at t [s] by differences of fourth order; their truncation and rounding stay below 1e-7."""
    stencil = (t[:, None] + d * np.arange(-2, 3)).ravel()
    weights = np.array([[0, 0, 1, 0, 0], np.array([1, -8, 0, 8, -1]) / (12 * d), np.array([-1, 16, -30, 16, -1]) / (12 * d * d)])
    return {point: tuple(np.einsum("oj,tjc->otc", weights, path.reshape(len(t), 5, 3))) for point, path in motion(stencil).items()}


def size(vectors):
    return np.linalg.norm(vectors, axis=-1)


def swinging_energy(start, path, about):
    """[J] of the only body, which turns at its speed over its distance from `about`, less that of its start in the file."""
    name, body = start.only()
    x, v, _ = path[name]

    def energy(x, v):
        return body.mass * (start.g * x[..., 2] + size(v)**2 / 2) + body.inertia[1, 1] * (size(v) / size(x - about))**2 / 2
    return energy(x, v) - energy(body.position, body.velocity)


def two_links(start, path, t):
    """Moments [N m] about the pivot, of both links, and about the elbow, of the lower one: change of angular momentum less gravity's."""
    (x1, _, a1), (x2, _, a2) = path["upper"], path["lower"]
    upper = start.bodies["upper"]
    elbow, pull = 2 * x1, start.gravity
    turning = [upper.inertia[1, 1] * np.cross(-arm, -along)[:, 1] / size(arm)**2 for arm, along in ((x1, a1), (x2 - elbow, a2 - 2 * a1))]
    both = upper.mass * (np.cross(x1, a1 - pull) + np.cross(x2, a2 - pull))[:, 1] + sum(turning)
    return np.maximum(abs(both), abs(upper.mass * np.cross(x2 - elbow, a2 - pull)[:, 1] + turning[1]))


def free_momentum(start, path, t):
    """[kg m2/s]: angular momentum R I R^T w of each body less that of its start; w of the turning axes."""
    changes = []
    for name, body in start.bodies.items():
        x, z = (np.array(path[f"{name}:{arm}"][:2]) - [[body.position], [0 * body.position]] for arm in "xz")
        axes = np.stack([x[0], np.cross(z[0], x[0]), z[0]], axis=-1)
        turning = np.stack([x[1], np.cross(z[1], x[0]) + np.cross(z[0], x[1]), z[1]], axis=-1)
        w = np.cross(axes, turning, axis=1).sum(axis=-1) / 2
        frame = motions.rotation(body.orientation)
        first = frame @ body.inertia @ frame.T @ body.spin
        changes.append(size(np.einsum("tij,jk,tlk,tl->ti", axes, body.inertia, axes, w) - first))
    return np.max(changes, axis=0)


def top(start, path, t):
    """[N m]: the change of the angular momentum about the pivot, which goes round with the axis, less the moment of the weight."""
    name, body = start.only()
    x, v, _ = path[name]
    frame = motions.rotation(body.orientation)
    momentum = frame @ body.inertia @ frame.T @ body.spin + body.mass * np.cross(body.position, body.velocity)
    rate = np.cross(x, v)[:, 2] / (x[:, :2]**2).sum(axis=-1)
    round_ = motions.about(motions.Z, np.unwrap(np.arctan2(x[:, 1], x[:, 0]))) @ momentum
    return size(rate[:, None] * np.cross(motions.Z, round_) - np.cross(x, body.mass * start.gravity))


def driven(start, path, t):
    """[N m]: I q'' less the motor's moment, until the speed is reached."""
    name, body = start.only()
    x, v, a = path[name]
    wanted, lever = start.table("joint", "hinge")["motor"], size(x)
    moment = np.where(size(v) / lever < wanted["velocity"] - 1e-6, wanted["max_force"], 0)
    return (body.inertia[2, 2] / lever**2 + body.mass) * np.cross(x, a)[:, 2] - moment


def forces(law):
    """The law of a scene of one body: its acceleration less law(start, body, positions, velocities, t) [m/s2]."""
    def rest(start, path, t):
        name, body = start.only()
        x, v, a = path[name]
        return size(a - law(start, body, x, v, t))
    return rest


def on_board(start, body, x, v, t):
    """Gravity's part along the board, less friction's if the box slides, less what turns the ball if it rolls."""
    turn = motions.about(np.array([0, 1.0, 0]), np.radians(start.table("actor", "board")["rotation"]["angle"]))
    along, across = turn @ motions.X, turn @ motions.Z
    pull = start.gravity @ along
    if "ball" in start.bodies:
        pull /= 1 + body.inertia[0, 0] / (body.mass * start.radius("ball")**2)
    else:
        pull = max(0, pull + start.mu() * (start.gravity @ across))
    return pull * along


def drag(start, body, x, v, t):
    """A ball of 10 cm and 50 g in air of 1.2 kg/m3 falls at 7.44077 m/s in the end: m g = 1.2 / 2 x 0.47 pi 0.1^2 v^2."""
    return start.gravity - start.g * v * size(v)[:, None] / 7.44077**2


def suspended(start, path, t):
    joint, body = start.table("joint", "spring"), start.bodies["weight"]
    x, v, a = path["weight"]
    return size(a - start.gravity + (joint["stiffness"] * (x - body.position) + joint["damping"] * v) / body.mass)


# Scene: what is zero at all times t [s], in its own unit: law(Start, {point: (positions, velocities, accelerations)}, t), the largest
# remainder, and the number of instants at which the law changes, next to which differences mean nothing.
Law = collections.namedtuple("Law", "rest largest kinks", defaults=(1e-6, 0))
IMPACTS = ("bounce", "cradle", "impact")
FREE = Law(lambda start, path, t: np.max([size(a) for _, _, a in path.values()], axis=0))
LAWS = {
    "flight": Law(forces(lambda start, body, x, v, t: start.gravity)),
    "damped": Law(forces(lambda start, body, x, v, t: start.gravity - start.scene["linear_damping"] * v)),
    "drag": Law(forces(drag), 1e-4),  # the end speed has six digits
    "bounce": Law(forces(lambda start, body, x, v, t: start.gravity), kinks=3),
    "slide": Law(forces(lambda start, body, x, v, t: -start.mu() * start.g * (v > 1e-6) * motions.X), kinks=1),
    "roll": Law(forces(lambda start, body, x, v, t: -start.mu() * start.g * (v > 5 / 7 * 5 + 1e-6) * motions.X), kinks=1),
    "incline_stay": Law(forces(on_board)),
    "incline_slide": Law(forces(on_board)),
    "incline_roll": Law(forces(on_board)),
    "ladder": Law(lambda start, path, t: swinging_energy(start, path, start.radius("ladder") * np.array([1, 0, 1]))),
    "pendulum": Law(lambda start, path, t: swinging_energy(start, path, np.zeros(3))),
    "pendulum_over": Law(lambda start, path, t: swinging_energy(start, path, np.zeros(3))),
    "two_links": Law(two_links, 1e-7),  # of 1e-2 N m: what small angles leave out is of their third power
    "free_spin": Law(free_momentum),
    "disc_spin": Law(free_momentum),
    "top": Law(top),
    "cradle": FREE._replace(kinks=3),
    "impact": FREE._replace(kinks=1),
    "suspension": Law(suspended),
    "motor": Law(driven, kinks=1),
}


class Exact(harness.ProgramTest):
    def record(self, scene, parts):
        """The file of a run with the scene's step divided into `parts`."""
        path = pathlib.Path(self.path("run.h5"))
        path.unlink(missing_ok=True)
        exact.record(scene, parts, path)
        return path

    def start(self, scene):
        """What the scene's file says, and the end of its run [s]."""
        with h5py.File(self.record(scene, 1)) as file:
            return motions.Start(file), file["particles/bodies/position/time"][-1]

    def test_each_scene_has_a_motion_a_law_and_bounds(self):
        names = {path.stem for path in pathlib.Path(harness.SOURCE, "scenes/exact").glob("*.toml")}
        self.assertEqual([set(motions.MOTIONS), set(LAWS), set(BOUNDS)], [names] * 3)

    def test_each_motion_starts_where_the_scene_does_and_obeys_its_law(self):
        for scene, law in LAWS.items():
            with self.subTest(scene=scene):
                start, end = self.start(scene)
                t = np.linspace(0.005, end - 0.005, 179)  # apart by more than the differences reach
                path = derivatives(lambda times: motions.MOTIONS[scene](times, start), t)
                rest = abs(law.rest(start, path, t))
                self.assertLessEqual(np.count_nonzero(~(rest < law.largest)), law.kinks, f"largest {np.sort(rest)[-5:]}")
                self.starts_as(start, motions.MOTIONS[scene](np.array([0.0, 1e-6]), start))

    def starts_as(self, start, paths):
        """Position and velocity of centres; 1e-6 s on, accelerations add up to 1e-5 m/s."""
        for point, path in paths.items():
            body = start.bodies[point.split(":")[0]]
            if ":" in point:
                arm = motions.rotation(body.orientation)[:, "xyz".index(point[-1])]
                position, velocity = body.position + arm, np.cross(body.spin, arm)
            else:
                position, velocity = body.position, body.velocity
            np.testing.assert_allclose(path[0], position, atol=1e-10)
            np.testing.assert_allclose((path[1] - path[0]) / 1e-6, velocity, atol=1e-4)

    def test_no_motion_jumps_and_only_an_impact_changes_a_speed_at_once(self):
        d = 1e-4
        for scene, law in LAWS.items():
            if law.kinks:
                start, end = self.start(scene)
                for point, path in motions.MOTIONS[scene](np.arange(0, end, d), start).items():
                    with self.subTest(scene=scene, point=point):
                        self.assertLess(size(np.diff(path, axis=0)).max(), 6 * d, "nothing is faster than 6 m/s")
                        if scene not in IMPACTS:
                            self.assertLess(size(np.diff(path, 2, axis=0)).max(), 20 * d * d, "nor gains more than 20 m/s2")

    def test_impacts_leave_the_momentum_and_speeds_of_the_textbook(self):
        t = np.linspace(0, 1.0, 100_001)
        for scene, last in (("cradle", [0, 0, 0, 2]), ("impact", [-1.5, 0.5])):  # (m1 v1 + m2 v2 -+ e m (v1 - v2)) / (m1 + m2), m the other's
            start, _ = self.start(scene)
            paths = motions.MOTIONS[scene](t, start)
            x = np.array([path[:, 0] for path in paths.values()])
            speeds = (x[:, -1] - x[:, -2]) / t[1]
            np.testing.assert_allclose(speeds, last, atol=1e-8)
            reach = np.array([start.radius(name.split(".")[0]) for name in paths])
            gaps = np.diff(x, axis=0) - (reach[1:] + reach[:-1])[:, None]
            # They touch, within the way of a sample, and never overlap.
            self.assertGreater(gaps.min(), -1e-9)
            self.assertLess(gaps.min(axis=1).max(), 4 * t[1])

    def test_tops_after_a_bounce_are_lower_by_the_square_of_restitution(self):
        start, _ = self.start("bounce")
        z = motions.bounce(np.linspace(0, 2, 200_001), start)["ball"][:, 2] - 0.1
        self.assertGreater(z.min(), -1e-12)
        tops = z[1:-1][(z[1:-1] > z[:-2]) & (z[1:-1] > z[2:])]
        np.testing.assert_allclose(tops, 0.64**np.arange(1, len(tops) + 1), atol=1e-8)
        self.assertGreaterEqual(len(tops), 2)

    def test_a_ball_that_has_begun_to_roll_has_its_angular_momentum_about_the_ground(self):
        start, _ = self.start("roll")
        body, radius = start.bodies["ball"], start.radius("ball")
        x = motions.roll(np.array([1.4, 1.5]), start)["ball"]
        self.assertAlmostEqual((x[1, 0] - x[0, 0]) / 0.1, body.velocity[0] / (1 + body.inertia[1, 1] / (body.mass * radius**2)), 9)

    def test_sor_keeps_to_each_motion_and_comes_nearer_with_a_shorter_step(self):
        for scene, bound in BOUNDS.items():
            with self.subTest(scene=scene, why=bound.why):
                coarse, fine = (motions.error(self.record(scene, parts), scene) for parts in (1, FINER))
                self.assertLess(coarse[0], bound.error_m)
                if bound.order is None:
                    self.assertLess(fine[0], bound.error_m)
                else:
                    # Where an impact falls in its step moves the largest error, and the rms less.
                    self.assertGreater(exact.order(coarse[1], fine[1], FINER), bound.order)


if __name__ == "__main__":
    unittest.main()
