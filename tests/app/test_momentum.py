"""Linear and angular momentum of each frame in the file: what a world without outside forces keeps."""
import unittest

import h5py
import numpy as np

from harness import ProgramTest

# Rod and plank fly apart from all else; the two cubes meet off their centres and part spinning.
SCENE = """title = "weightless bodies"
gravity = [0, 0, 0]
spaces = ["rod", "left", "right"]
[[actor]]
name = "rod"
type = "box"
space = "rod"
size = [0.2, 0.3, 2]
mass = 5
position = [0, 8, 3]
velocity = [0.5, 0.25, -0.1]
angular_velocity = [3, 0.2, 1]
[[actor]]
name = "left"
type = "box"
space = "left"
size = [1, 1, 1]
mass = 4
position = [-2, 0, 3]
velocity = [3, 0, 0]
[[actor]]
name = "right"
type = "box"
space = "right"
size = [1, 1, 1]
mass = 10
position = [2, 0.4, 3.3]
velocity = [-2, 0, 0]
variation = { velocity = [0.1, 0.1, 0] }
"""
SIZES = {"rod": (0.2, 0.3, 2), "left": (1, 1, 1), "right": (1, 1, 1)}
RUN = ("--scene", "float.toml", "--frames", 60, "--effects", "-damping")


def turned(q, v):
    """v [..., 3] rotated by the unit quaternions q [..., (w, x, y, z)]."""
    axis = q[..., 1:]
    return v + 2 * np.cross(axis, np.cross(axis, v) + q[..., :1] * v)


def momenta(file):
    """Linear and angular momentum [T][W][3], worked out from the recorded motion."""
    bodies = file["particles/bodies"]
    position, q, velocity, spin = (bodies[f"{name}/value"][:]
                                   for name in ("position", "orientation", "velocity", "angular_velocity"))
    mass = bodies["mass"][:]
    size = np.array([SIZES[name.split(".")[0]] for name in bodies["actor"].asstr()[:]])
    inertia = mass[:, None] / 12 * (np.sum(size**2, axis=1, keepdims=True) - size**2)
    back = q * np.array([1, -1, -1, -1])
    of_body = (mass[:, None] * velocity,
               mass[:, None] * np.cross(position, velocity) + turned(q, inertia * turned(back, spin)))
    world = bodies["world"][:]
    return [np.stack([m[:, world == w].sum(axis=1) for w in range(world.max() + 1)], axis=1) for m in of_body]


class Momentum(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("float.toml", SCENE)

    def columns(self, ranks, *args):
        self.summary(ranks, *RUN, *args, "-o", "run.h5")
        with h5py.File(self.path("run.h5")) as file:
            world = file["observables/world"]
            self.assertGreater(world["contacts"][:].max(), 0, "the cubes meet")
            return (world["linear_momentum"][:], world["angular_momentum"][:], *momenta(file))

    def test_the_columns_are_those_of_the_recorded_motion_and_linear_momentum_stays(self):
        for stepper in ("quick", "direct", "sor"):
            linear, angular, linear_expected, angular_expected = self.columns(1, "--stepper", stepper, "--replicas", 3)
            self.assertEqual((linear.shape[1:], angular.shape[1:]), ((3, 3), (3, 3)))
            for found, expected in ((linear, linear_expected), (angular, angular_expected)):
                self.assertLess(np.abs(found - expected).max(), 1e-12 * np.abs(expected).max(), stepper)
            start = linear[:1]
            self.assertLess(np.linalg.norm(linear - start, axis=2).max(), 1e-12 * np.linalg.norm(start, axis=2).min(),
                            stepper)

    def test_1_to_4_ranks_give_the_same_bits(self):
        for args in (("--stepper", "quick", "--replicas", 5), ("--stepper", "sor", "--replicas", 5)):
            found = {tuple(column.tobytes() for column in self.columns(ranks, *args)[:2]) for ranks in (1, 2, 3, 4)}
            self.assertEqual(len(found), 1, args)

    def test_a_world_that_is_cut_has_the_bits_of_the_whole(self):
        runs = [(1, "worlds"), *((ranks, "spaces") for ranks in (1, 2, 3, 4))]
        found = {tuple(column.tobytes() for column in self.columns(ranks, "--stepper", "sor", "--decompose", cut)[:2])
                 for ranks, cut in runs}
        self.assertEqual(len(found), 1)


if __name__ == "__main__":
    unittest.main()
