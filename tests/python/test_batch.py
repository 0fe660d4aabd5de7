"""A batch in Python: the bits of pbmpi, arrays without a copy, worlds that begin anew, and what is refused."""
import copy
import gc
import pickle
import unittest

import numpy as np
import pbmpi

from support import ARM, PackageTest

FRAMES, WARMUP = 4, 3
ARRAYS = {"position": 3, "orientation": 4, "velocity": 3, "angular_velocity": 3}


class Bits(PackageTest):
    def test_the_hash_is_that_of_the_program(self):
        for settings in ({}, {"precision": "single"}, {"substeps": 3, "effects": {"friction": False}},
                         {"stepper": "quick"}):
            options = ["--effects=-friction" if name == "effects" else f"--{name.replace('_', '-')}={value}"
                       for name, value in settings.items()]
            expected = self.state_hash("--scene", "CrashSk", "--replicas", 3, "--frames", FRAMES, "--seed", 7, *options)
            batch = pbmpi.Batch("CrashSk", 3, seed=7, **settings)
            batch.step((WARMUP + FRAMES) * batch.steps_per_frame)
            self.assertEqual(batch.hash(), expected, settings)

    def test_one_call_of_many_steps_and_many_calls_have_the_same_bits(self):
        one, many = pbmpi.Batch("CrashSk", 2), pbmpi.Batch("CrashSk", 2)
        one.step(30)
        for _ in range(30):
            many.step()
        self.assertEqual(one.hash(), many.hash())
        self.assertEqual(one.steps.tolist(), [30, 30])

    def test_a_file_and_a_text_of_a_scene_are_the_same(self):
        of_file = pbmpi.Batch(self.write("arm.toml", ARM), 2)
        of_text = pbmpi.Batch("arm", 2, scene_text=ARM)
        for batch in (of_file, of_text):
            batch.step(9)
        self.assertEqual(of_file.hash(), of_text.hash())
        self.assertEqual(of_text.hash(0) != of_text.hash(1), True, "worlds draw what varies")
        self.assertRegex(of_text.hash(0), "^[0-9a-f]{16}$")


class Arrays(unittest.TestCase):
    def setUp(self):
        self.batch = pbmpi.Batch("arm", 3, scene_text=ARM)

    def test_shapes_types_and_names(self):
        for name, length in ARRAYS.items():
            array = getattr(self.batch, name)
            self.assertEqual((array.shape, array.dtype, array.flags.c_contiguous), ((3, 2, length), np.float64, True))
        self.assertEqual(self.batch.body_names, ["arm", "loose"])
        self.assertEqual((self.batch.num_worlds, self.batch.num_local_worlds, self.batch.num_bodies), (3, 3, 2))
        self.assertEqual(self.batch.world_ids.tolist(), [0, 1, 2])
        self.assertEqual((self.batch.dt, self.batch.steps_per_frame), (0.01, 3))

    def test_a_view_is_no_copy_and_shows_the_newer_state_once_the_property_is_read_again(self):
        for name in ARRAYS:
            before = getattr(self.batch, name)
            kept = before.copy()
            self.batch.step(5)
            self.assertTrue(np.array_equal(before, kept), "not refreshed before it is read")
            after = getattr(self.batch, name)
            self.assertTrue(np.shares_memory(before, after))
            self.assertEqual(before.ctypes.data, after.ctypes.data)
            self.assertTrue(np.array_equal(before, after))
            self.assertFalse(np.array_equal(before, kept), "something has moved")

    def test_nobody_writes_into_a_view(self):
        with self.assertRaisesRegex(ValueError, "read-only"):
            self.batch.position[0] = 1
        with self.assertRaises(ValueError):
            self.batch.position.setflags(write=True)

    def test_a_view_keeps_its_batch(self):
        view = self.batch.position
        expected = view.copy()
        self.batch = None
        gc.collect()
        _ = [pbmpi.Batch("arm", 3, scene_text=ARM, seed=seed) for seed in range(9)]  # takes memory that was given back
        self.assertTrue(np.array_equal(view, expected))

    def test_a_body_falls_as_it_should(self):
        # Semi-implicit Euler in substeps of h from rest: z = -g h^2 n (n + 1) / 2 after n substeps.
        h, n = 0.01 / 14, 14 * 30
        start = self.batch.position[0, 1, 2]
        self.batch.step(30)
        self.assertAlmostEqual(self.batch.position[0, 1, 2] - start, -9.81 * h * h * n * (n + 1) / 2, places=9)
        self.assertAlmostEqual(self.batch.velocity[0, 1, 2], -9.81 * 0.3, places=9)

    def test_observables_are_those_of_the_state(self):
        self.batch.step(6)
        seen = self.batch.observables()
        self.assertEqual(sorted(seen), sorted(self.batch.observable_names))
        self.assertEqual(seen["energy"].shape, (3,))
        self.assertEqual(seen["linear_momentum"].shape, (3, 3))
        momentum = 2 * self.batch.velocity[:, 0] + 1 * self.batch.velocity[:, 1]
        self.assertTrue(np.allclose(seen["linear_momentum"], momentum, rtol=0, atol=1e-12))
        with self.assertRaisesRegex(ValueError, "heat"):
            self.batch.observable("heat")


class Changes(unittest.TestCase):
    def setUp(self):
        self.batch = pbmpi.Batch("arm", 4, scene_text=ARM)

    def test_worlds_of_the_mask_begin_anew_and_the_others_go_on(self):
        untouched = pbmpi.Batch("arm", 4, scene_text=ARM)
        fresh = pbmpi.Batch("arm", 4, scene_text=ARM, seed=5, parameters={"world.gravity": [[0, 0, -1.62]] * 4})
        for batch in (self.batch, untouched):
            batch.step(20)
        mask = np.array([True, False, False, True])
        self.batch.reset(mask, seed=5, parameters=[{"world.gravity": [0, 0, -1.62]}, None, None, {"world.gravity": [0, 0, -1.62]}])
        self.assertEqual(self.batch.steps.tolist(), [0, 20, 20, 0])
        for batch in (self.batch, untouched, fresh):
            batch.step(10)
        for world, like in enumerate((fresh, untouched, untouched, fresh)):
            self.assertEqual(self.batch.hash(world), like.hash(world), world)
        self.assertNotEqual(fresh.hash(0), pbmpi.Batch("arm", 4, scene_text=ARM, seed=5).hash(0))

    def test_a_reset_without_arguments_is_the_start(self):
        self.batch.step(7)
        first = self.batch.hash()
        self.batch.reset()
        self.assertEqual(self.batch.steps.tolist(), [0] * 4)
        self.batch.step(7)
        self.assertEqual(self.batch.hash(), first)

    def test_a_state_that_is_put_back_is_the_state(self):
        self.batch.step(3)
        state = self.batch.state()
        self.batch.step(3)
        self.batch.set_state(**state)
        for name in ARRAYS:
            self.assertTrue(np.array_equal(getattr(self.batch, name), state[name]), name)

    def test_only_what_is_given_is_set_and_only_in_worlds_of_the_mask(self):
        before = self.batch.state()
        self.batch.set_state(velocity=before["velocity"].astype("f4") + [0, 0, 2], mask=[False, True, False, False])
        self.assertTrue(np.array_equal(self.batch.position, before["position"]))
        self.assertTrue(np.array_equal(self.batch.velocity[[0, 2, 3]], before["velocity"][[0, 2, 3]]))
        self.assertTrue(np.array_equal(self.batch.velocity[1, 1], [0, 0, 2]))

    def test_saved_worlds_go_on_with_the_same_bits(self):
        self.batch.step(11)
        saved = self.batch.save()
        self.assertIs(type(saved), bytes)
        self.batch.step(9)
        expected = self.batch.hash(), self.batch.position.copy()
        for given in (saved, bytearray(saved), memoryview(saved)):
            other = pbmpi.Batch("arm", 4, scene_text=ARM)
            other.load(given)
            self.assertEqual(other.steps.tolist(), [11] * 4)
            other.step(9)
            self.assertEqual(other.hash(), expected[0])
            self.assertTrue(np.array_equal(other.position, expected[1]))

    def test_copies_go_on_by_themselves(self):
        self.batch.reset([True, False, True, False], seed=3, parameters=[{"loose.mass": 2}] * 4)
        self.batch.step(5)
        copies = [copy.deepcopy(self.batch), pickle.loads(pickle.dumps(self.batch))]
        self.batch.step(5)
        for one in copies:
            self.assertNotEqual(one.hash(), self.batch.hash())
            one.step(5)
            self.assertEqual(one.hash(), self.batch.hash())
            self.assertEqual(repr(one), repr(self.batch))

    def test_copies_have_the_bodies_that_parameters_gave(self):
        batch = pbmpi.Batch("arm", 2, scene_text=ARM, parameters={"loose.copies": [2, 2], "loose.spacing": [[1, 0, 0]] * 2})
        batch.step(3)
        self.assertEqual(batch.num_bodies, 3)
        for one in (copy.deepcopy(batch), pickle.loads(pickle.dumps(batch))):
            self.assertEqual((one.hash(), one.settings), (batch.hash(), {}))

    def test_motors_aim_at_what_they_are_told(self):
        (motor,) = self.batch.motors
        self.assertEqual((motor.name, motor.max_force), ("shoulder", 50))
        speeds = np.array([[2.0], [-1.0], [0.0], [np.nan]])
        self.batch.set_motor_velocities(speeds)
        self.batch.step(100)
        # At rest in the motor's frame after 1 s: 50 N m turn 2/3 kg m^2 at up to 75 rad/s^2. NaN leaves the scene's 1 rad/s.
        turning = self.batch.angular_velocity[:, 0, 2]
        self.assertTrue(np.allclose(turning, [2, -1, 0, 1], rtol=0, atol=0.01), turning)
        self.batch.set_motor_velocities([0.5])
        self.batch.step(100)
        self.assertTrue(np.allclose(self.batch.angular_velocity[:, 0, 2], 0.5, rtol=0, atol=0.01))

    def test_efforts_and_forces_drive_what_joint_arrays_show(self):
        self.assertEqual(self.batch.joint_names, ["shoulder"])
        self.batch.set_motor_velocities([0])
        self.batch.set_forces(forces=np.zeros((4, 2, 3)), torques=None)
        self.batch.set_efforts([60])                # 10 N m more than the motor holds
        self.batch.step(10)
        speed, angle = self.batch.joint_velocity, self.batch.joint_position
        self.assertEqual((speed.shape, speed.flags.writeable), ((4, 1), False))
        self.assertTrue(np.allclose(speed[:, 0], self.batch.angular_velocity[:, 0, 2]))
        wanted = 10 / (2 * (1 + 0.01) / 12 + 2 * 0.25) * 0.1
        self.assertTrue(np.allclose(speed, wanted, rtol=0.1) and (angle > 0).all(), (speed, wanted))
        self.batch.set_efforts(None)
        self.batch.step(50)
        self.assertTrue(np.allclose(self.batch.joint_velocity, 0, atol=0.01))

    def test_it_says_what_it_is(self):
        batch = pbmpi.Batch("arm", 2, scene_text=ARM, seed=9, substeps=4)
        self.assertEqual(repr(batch), "<pbmpi.Batch 'arm' worlds=2 bodies=2 dt=0.01 seed=9, substeps=4>")
        self.assertEqual((batch.seed, batch.settings), (9, {"substeps": 4}))
        self.assertEqual(pbmpi.__version__, pbmpi.version())


class Refused(unittest.TestCase):
    def setUp(self):
        self.batch = pbmpi.Batch("arm", 3, scene_text=ARM)

    def check(self, error, words, call, *args, **options):
        before = self.batch.hash()
        with self.assertRaisesRegex(error, words):
            call(*args, **options)
        self.assertEqual(self.batch.hash(), before, "nothing has changed")

    def test_batches_that_cannot_be(self):
        for error, words, args in ((ValueError, "Nowhere", {"scene": "Nowhere"}), (ValueError, "worlds=0", {"worlds": 0}),
                                   (TypeError, "integer", {"worlds": 2.5}), (ValueError, "seed=-1", {"seed": -1}),
                                   (ValueError, "sub.?stepz", {"substepz": 4}), (ValueError, "substeps.*0", {"substeps": 0}),
                                   (TypeError, "substeps=None", {"substeps": None}),
                                   (ValueError, "each of the 2 worlds", {"worlds": 2, "parameters": [{}]}),
                                   (ValueError, "speeed", {"parameters": [{"car.speeed": 1}], "worlds": 1}),
                                   (TypeError, "one of mpi4py", {"communicator": 1})):
            with self.assertRaisesRegex(error, words, msg=args):
                pbmpi.Batch(**{"scene": "CrashSk", **args})

    def test_arrays_of_other_shapes_and_types(self):
        shape = re_text("position: its shape is (3, 2, 4); it must be [worlds][bodies][3] = (3, 2, 3)")
        self.check(ValueError, shape, self.batch.set_state, np.zeros((3, 2, 4)))
        self.check(ValueError, "orientation: its shape is .*3, 2, 4", self.batch.set_state, orientation=[1, 0, 0, 0])
        self.check(ValueError, "velocity: it is no array|velocity: its shape", self.batch.set_state, velocity=[[1], [2, 3]])
        for bad, kind in ((np.zeros((3, 2, 3), dtype=complex), "complex128"), (np.full((3, 2, 3), "a"), "<U1"),
                          (np.zeros((3, 2, 3), dtype=bool), "bool")):
            self.check(TypeError, f"velocity: it is of type {kind}; it must hold real numbers", self.batch.set_state, velocity=bad)
        self.check(ValueError, re_text("mask: its shape is (2,); it must be [worlds] = (3,)"), self.batch.reset, [True, False])
        self.check(TypeError, "mask: it is of type int64; .*steps >= 300", self.batch.reset, [0, 1, 2])
        self.check(ValueError, re_text("[worlds][motors] = (3, 1)"), self.batch.set_motor_velocities, np.zeros((1, 3)))
        self.check(ValueError, re_text("[motors] = (1,)"), self.batch.set_motor_velocities, [1, 2])

    def test_other_numbers(self):
        self.check(ValueError, "steps must be 0 or more", self.batch.step, -1)
        self.check(ValueError, "seed=", self.batch.reset, seed=2**64)
        self.check(ValueError, "they are 1; .*3 worlds", self.batch.reset, parameters=[{}])
        self.check(ValueError, "3.*world_ids", self.batch.hash, 3)

    def test_worlds_that_were_not_saved_by_such_a_batch(self):
        saved = self.batch.save()
        damaged = bytearray(saved)
        damaged[len(saved) // 2] ^= 1
        other = pbmpi.Batch("arm", 3, scene_text=ARM, substeps=4).save()
        for given in (b"", b"no such text", saved[:-1], bytes(damaged), other):
            self.check(ValueError, ".", self.batch.load, given)
        self.check(ValueError, "what save", self.batch.load, np.zeros(3))


def re_text(text):
    """A pattern of exactly this text."""
    return "".join("\\" + letter if letter in "()[].*+?" else letter for letter in text)


if __name__ == "__main__":
    unittest.main()
