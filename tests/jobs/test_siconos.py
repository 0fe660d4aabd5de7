"""jobs/siconos: recorded steps as problems of FCLIB. Against numbers by hand, the states before, libfclib, and Siconos."""
import glob
import json
import os
import sys
import unittest

import numpy as np

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(SOURCE, "tests", "app"), os.path.join(SOURCE, "jobs", "siconos")]
import fclib_check  # noqa: E402
import fclib_export  # noqa: E402
import recorded_steps  # noqa: E402
import solve  # noqa: E402
from harness import PBMPI, ProgramTest  # noqa: E402

REFERENCE = {"law": "coulomb", "iterations": 200, "steps-per-frame": 1, "warmup": 0}

MASS, RADIUS, DEPTH, SPEED, SOFT, CFM, ERP, MU, STEP = 4.0, 0.5, 0.001, 0.3, 2e-6, 1e-10, 0.2, 0.5, 0.01
BALL = f"""title = "a ball that slides on the ground"
[contact]
soft_erp = {ERP}
soft_cfm = {SOFT}
[[actor]]
name = "ground"
type = "ground"
[[actor]]
name = "ball"
type = "sphere"
radius = {RADIUS}
mass = {MASS}
position = [0, 0, {RADIUS - DEPTH}]
velocity = [{SPEED}, 0, 0]
[[pair]]
actors = ["ground", "ball"]
mu = {MU}
"""

BOX = """[[actor]]
name = "{0}"
type = "box"
size = [0.3, 0.2, 0.1]
mass = {1}
position = {2}
rotation = {{ axis = [1, 2, 3], angle = {3} }}
angular_velocity = [3, {4}, -2]
velocity = [0.5, 0, {4}]
"""
JOINT = """[[joint]]
name = "{0}"
kind = "{0}"
bodies = ["{1}", "{2}"]
{3}
"""
# Boxes with a joint of each kind between neighbours, over the ground, which the last one touches.
CHAIN = 'title = "joints of all kinds"\n[[actor]]\nname = "ground"\ntype = "ground"\n' + "".join(
    BOX.format(name, mass, [0.4 * i, 0, 0.3 if i < 6 else 0.049], 20 * i if i < 6 else 0, 3 - i)
    for i, (name, mass) in enumerate(zip("abcdefg", (1, 2, 5, 1, 3, 2, 4)))) + "".join(
        JOINT.format(kind, a, b, more.format(0.4 * i + 0.2)) for i, (kind, a, b, more) in enumerate((
            ("ball", "a", "b", "anchor = [{0}, 0, 0.3]"), ("hinge", "b", "c", "anchor = [{0}, 0, 0.3]\naxis = [0, 1, 0]\nlimits = [-1, 1]"),
            ("slider", "c", "d", "axis = [1, 1, 0]\nlimits = [-0.001, 0.001]"),
            ("universal", "d", "e", "anchor = [{0}, 0, 0.3]\naxis = [0, 1, 0]\naxis2 = [0, 0, 1]\nmotor = {{ velocity = 1, max_force = 2 }}"),
            ("fixed", "e", "f", ""),
            ("hinge2", "f", "g", "anchor = [{0}, 0, 0.3]\naxis = [0, 0, 1]\naxis2 = [0, 1, 0]\nstiffness = 4000\ndamping = 100"))))


class Siconos(ProgramTest):
    def record(self, scene, frames, **options):
        settings = REFERENCE | {name.replace("_", "-"): value for name, value in options.items()}
        done = self.run_command([PBMPI, "--scene", scene, f"--frames={frames}", "--record", "contacts", "--output", "run.h5",
                                 *(f"--{name}={value}" for name, value in settings.items())])
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.path("run.h5")

    def problem(self, frame=0):
        steps = recorded_steps.Steps(self.path("run.h5"))
        problem = steps.problem(frame, 0, *steps.islands(frame, 0)[0])
        self.assertIsInstance(problem, recorded_steps.Problem, problem)
        return problem

    def test_a_ball_has_the_matrix_that_hands_compute(self):
        self.record(self.write("ball.toml", BALL), 1)
        problem = self.problem()
        W, q = problem.condensed()
        # 1/m + arm^2 / (2/5 m r^2) across: friction turns the ball as well. The contact lies half way between the surfaces.
        arm = RADIUS - DEPTH / 2
        across = 1 / MASS + arm**2 / (0.4 * MASS * RADIUS**2) + CFM / STEP
        self.assertLess(np.abs(W - np.diag([1 / MASS + SOFT / STEP, across, across])).max(), 1e-14)
        push = ERP / STEP * DEPTH
        self.assertAlmostEqual(q[0], -9.81 * STEP - push, delta=1e-14)
        self.assertAlmostEqual(np.hypot(*q[1:]), SPEED, delta=1e-14)
        self.assertEqual(problem.mu, [MU])
        # It slides: Coulomb's law, by hand.
        normal = (9.81 * STEP + push) / W[0, 0]
        self.assertLess(MU * normal * across, SPEED)
        self.assertAlmostEqual(problem.r[0], normal, delta=1e-12)
        self.assertLess(np.abs(problem.r[1:] + MU * normal * q[1:] / SPEED).max(), 1e-12)
        self.assertLess(solve.natural_map(W, q, problem.mu, problem.r), 1e-12)

    def test_what_parts_without_friction_solves_its_problem(self):
        nothing, apart = np.zeros(3), np.array([2.0, 0, 0])
        self.assertEqual(solve.natural_map(np.eye(3), apart, np.zeros(1), nothing), 0)
        self.assertEqual(solve.natural_map(np.eye(3), -apart, np.zeros(1), nothing), 1, "it must not sink in")
        self.assertEqual(solve.natural_map(np.eye(3), nothing, np.zeros(1), nothing), 0, "nor is anything divided by nothing")

    def test_velocities_follow_from_the_state_before_and_the_recorded_impulses(self):
        """To 1e-12 of the greatest velocity, with joints of all kinds: nothing that acts in the step is missing, and each row
        has the direction that it had in the solver."""
        self.record(self.write("chain.toml", CHAIN), 12)
        kinds = set(recorded_steps.Steps(self.path("run.h5")).joints.kind)
        self.assertEqual(kinds, {"ball", "hinge", "slider", "universal", "fixed", "hinge2"})
        contacts = 0
        for frame in range(12):
            if not len(recorded_steps.Steps(self.path("run.h5")).worlds_with_contacts(frame)):
                continue
            problem = self.problem(frame)
            contacts += len(problem.mu)
            self.assertLess(problem.forward, 1e-12 * max(1, np.abs(problem.v).max(), np.abs(problem.v_free).max()))
        self.assertGreater(contacts, 12)

    def test_rows_of_joints_hold_in_the_recorded_velocities(self):
        """Newton's method leaves nothing of their errors; a wrong aim would show in mm/s."""
        self.record(self.write("chain.toml", CHAIN), 3)
        problem = self.problem(2)
        W, q = problem.condensed()
        self.assertLess(np.abs(W @ problem.r + q - problem.u).max(), 1e-9)
        self.assertLess(np.abs(problem.velocities(problem.r) - problem.v).max(), 1e-8)

    def test_the_global_form_is_the_same_problem(self):
        self.record(self.write("chain.toml", CHAIN), 1)
        problem = self.problem()
        matrices, vectors, solution = fclib_export.whole(problem)
        M, H, G = matrices["M"], matrices["H"], matrices["G"]
        v, r, multipliers = solution["v"], solution["r"], solution["l"]
        self.assertLess(np.abs(M @ v - H @ r - G @ multipliers - vectors["f"]).max(), 1e-9)
        self.assertLess(np.abs(G.T @ v + vectors["b"]).max(), 1e-9)
        W, q = problem.condensed()
        self.assertLess(np.abs(solution["u"] - (W @ r + q)).max(), 1e-9)

    def test_libfclib_reads_what_is_written(self):
        if fclib_check.library() is None:
            self.skipTest("libfclib0 is not installed")
        self.record(self.write("chain.toml", CHAIN), 2)
        for form in ("local", "global"):
            os.mkdir(self.path(form))
            path = os.path.join(self.folder, form, "problem.hdf5")
            fclib_export.write(path, self.problem(1), form, "a chain")
            self.assertEqual(fclib_check.differences(path)[0], 0)

    def test_runs_that_hide_a_step_are_refused(self):
        """A frame of several steps, and a pyramid of friction."""
        for options in ({"steps_per_frame": 3}, {"law": "ode"}):
            self.record(self.write("ball.toml", BALL), 1, **options)
            with self.assertRaises(ValueError):
                recorded_steps.Steps(self.path("run.h5"))

    def test_siconos_finds_the_same_solution(self):
        try:
            import siconos.numerics as sn
        except ImportError:
            self.skipTest("python3-siconos is not installed")
        self.record(self.write("ball.toml", BALL), 4)
        done = self.run_command([sys.executable, os.path.join(SOURCE, "jobs/siconos/fclib_export.py"), "--output", "reference", "run.h5"])
        self.assertEqual(done.returncode, 0, done.stderr)
        paths = sorted(glob.glob(self.path("reference/*.hdf5")))
        self.assertEqual(len(paths), 4)
        for path in paths:
            problem = solve.Problem(path)
            force = problem.force(sn)
            mine = solve.natural_map(problem.W, problem.q, problem.mu, problem.r)
            self.assertLess(abs(solve.error_of(sn, problem, force, problem.r) - mine), 1e-13)
            r, error, _ = solve.solved(sn, problem, force, 1e-12, 1000)
            self.assertLess(error, 1e-8)
            self.assertLess(np.abs(r - problem.r).max(), 1e-8)
        done = self.run_command([sys.executable, os.path.join(SOURCE, "jobs/siconos/solve.py"), "--output", "table", "reference"])
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("table.json"), encoding="utf-8") as file:
            facts = json.load(file)["facts"]
        self.assertEqual((facts["problems"], facts["reference_below_bar"], facts["siconos_below_bar"]), (4, 4, 4))


if __name__ == "__main__":
    unittest.main()
