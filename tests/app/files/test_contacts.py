"""--record contacts: contacts of each frame's last step, and the forces of contacts and joints."""
import os
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ODE_LAW, ProgramTest  # noqa: E402

FRAMES = ("--steps-per-frame", 1, "--warmup", 0, "--frames", 40, "--record", "contacts", "--quiet")
# With many substeps velocities change by the forces of all, of which the file has the last.
STEPPERS = (("--stepper", "direct"), ("--stepper", "quick"), ODE_LAW)


def frame_contacts(run, frame):
    """Column -> values of the contacts of a frame."""
    first, count = run["contacts/frame/first"][frame], run["contacts/frame/count"][frame]
    names = run["contacts/point"].attrs["columns"].decode().split()
    return dict(zip(names, run["contacts/point"][first:first + count].T))


def vectors(contacts, name):
    return np.stack([contacts[f"{name}_{axis}"] for axis in "xyz"], axis=1)


def force_on_bodies(run, frame):
    """[N][3] N: gravity, contacts and joints."""
    mass = run["particles/bodies/mass"][:]
    force = mass[:, None] * run["worlds/gravity"][0]
    contacts = frame_contacts(run, frame)
    pushes = contacts["normal_force"][:, None] * vectors(contacts, "normal") + vectors(contacts, "friction")
    holds = run["observables/joint/force"][frame]
    for a, b, acts in ((contacts["body_a"], contacts["body_b"], pushes), (run["joints/body_a"], run["joints/body_b"], holds)):
        for first, second, act in zip(a, b, acts):
            force[int(first)] += act
            if second >= 0:
                force[int(second)] -= act
    return force


class Contacts(ProgramTest):
    def recorded(self, *args):
        result = self.pbmpi(1, *args, "--output", "run.h5")
        self.assertEqual(result.returncode, 0, result.stderr)
        return h5py.File(self.path("run.h5"))

    def test_mass_times_acceleration_is_gravity_and_the_recorded_forces(self):
        for stepper in STEPPERS:
            with self.recorded("--scene", "CrashSk", *stepper, *FRAMES) as run, self.subTest(stepper=stepper):
                velocity, mass = run["particles/bodies/velocity/value"][:], run["particles/bodies/mass"][:]
                dt, forces = run["parameters/dt"][()], 0
                for frame in range(1, len(velocity)):
                    change = mass[:, None] * (velocity[frame] - velocity[frame - 1]) / dt
                    force = force_on_bodies(run, frame)
                    # Rounding alone: the engines add impulses to velocities.
                    scale = 1 + np.abs(force).max()
                    self.assertLess(np.abs(change - force).max() / scale, 1e-8, frame)
                    forces += run["contacts/frame/count"][frame]
                self.assertGreater(forces, 200)

    def test_the_counts_and_the_deepest_contact_are_those_of_the_observables(self):
        for stepper in (("--stepper", "quick"), ("--stepper", "sor")):
            with self.recorded("--scene", "CrashSk", *stepper, "--record", "contacts", "--quiet") as run:
                seen = run["observables/world"]
                for frame in range(len(seen["contacts"])):
                    contacts = frame_contacts(run, frame)
                    self.assertEqual(len(contacts["depth"]), seen["contacts"][frame, 0])
                    self.assertEqual(max(contacts["depth"].max(initial=0), 0), seen["max_penetration"][frame, 0])
                    normal = vectors(contacts, "normal")
                    np.testing.assert_allclose(np.linalg.norm(normal, axis=1), 1, rtol=1e-5)
                    self.assertTrue(np.all(contacts["normal_force"] >= 0))
                    whole = contacts["normal_force"][:, None] * normal + vectors(contacts, "friction")
                    h = run["parameters/dt"][()] / run["parameters/substeps"][()]
                    np.testing.assert_array_equal(vectors(contacts, "impulse"), h * whole)

    def test_recording_moves_no_bit(self):
        for options in (*STEPPERS, ("--stepper", "sor"), ("--stepper", "sor", "--decompose", "spaces")):
            scene = "Battle2" if "spaces" in options else "CrashSk"
            ranks = 2 if "spaces" in options else 1
            hashes = {self.summary(ranks, "--scene", scene, *options, *recording)["state_hash"]
                      for recording in (("--no-output",), ("--record", "contacts", "--output", "run.h5"))}
            self.assertEqual(len(hashes), 1, options)

    def test_a_step_in_which_a_joint_broke_is_in_the_file(self):
        with self.recorded("--scene", "hard/joints/bridge30", "--stepper", "quick", "--frames", 3, "--quiet") as run:
            self.assertNotIn("observables/joint", run, "nothing can break, nothing is recorded")
        with self.recorded("--scene", "CrashWa", "--stepper", "sor", "--effects", "+breakable_joints", "--quiet") as run:
            self.assertTrue(np.all(run["observables/joint/broken_in"][:] >= -1))

    def test_without_a_file_there_is_nothing_to_record_into(self):
        result = self.pbmpi(1, "--scene", "CrashSk", "--record", "contacts", "--no-output")
        self.assertEqual(result.returncode, 2)
        self.assertIn("--no-output", result.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv)
