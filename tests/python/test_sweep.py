"""Settings compared: what does not depend on the clock."""
import unittest

import numpy as np
import pbmpi

from support import ARM

SMALL = {"frames": 4, "repeats": 1, "warmup": 1}


class Sweep(unittest.TestCase):
    def test_a_row_is_what_a_batch_of_these_settings_shows(self):
        table = pbmpi.sweep("CrashSk", {"substeps": [2, 8], "precision": ["double", "single"]}, worlds=2, seed=3, **SMALL)
        self.assertEqual(list(zip(table.substeps, table.precision)), [(2, "double"), (2, "single"), (8, "double"), (8, "single")])
        reference = pbmpi.Batch("CrashSk", 2, seed=3, substeps=8)
        others = [pbmpi.Batch("CrashSk", 2, seed=3, substeps=row.substeps, precision=row.precision) for row in table.itertuples()]
        squares, largest = np.zeros(4), np.zeros(4)
        for _ in range(SMALL["frames"]):
            for batch in (reference, *others):
                batch.step(3)
            for place, batch in enumerate(others):
                distance = np.sqrt(((batch.position - reference.position) ** 2).sum(axis=2))
                squares[place] += (distance**2).mean() / SMALL["frames"]
                largest[place] = max(largest[place], distance.max())
        self.assertEqual(table.hash.tolist(), [batch.hash() for batch in others])
        self.assertEqual(table.is_reference.tolist(), [False, False, True, False])
        self.assertEqual(table.attrs["reference"], {"substeps": 8, "precision": "double"})
        np.testing.assert_allclose(table.position_error_rms, np.sqrt(squares), rtol=1e-12)
        np.testing.assert_allclose(table.position_error_max, largest, rtol=1e-12)
        self.assertEqual(table.energy.tolist(), [batch.observable("energy").sum() for batch in others])
        self.assertEqual((table.attrs["units"]["energy"], table.attrs["units"]["hash"]), ("J", ""))
        for name in ("step_time", "frame_time", "frame_time_min", "frame_time_max"):
            self.assertTrue((table[name] > 0).all(), name)
        self.assertTrue((table.frame_time_min <= table.frame_time).all() and (table.frame_time <= table.frame_time_max).all())

    def test_shorter_steps_come_nearer_to_the_exact_fall_at_the_same_moments(self):
        # From rest semi-implicit Euler is g h t / 2 below the exact fall after t; h: the substep.
        table = pbmpi.sweep("arm", {"dt": [0.01, 0.005], "substeps": [1, 2]}, scene_text=ARM, worlds=1,
                            measure=lambda batch: {"z": batch.position[0, 1, 2]}, **SMALL)
        t = SMALL["frames"] * 0.03
        exact = 1 - 9.81 * t * t / 2
        h = table.dt / table.substeps
        np.testing.assert_allclose(exact - table.z, 9.81 * h * t / 2, rtol=0, atol=1e-12)
        self.assertEqual(table.is_reference.tolist(), [False, False, False, True])

    def test_a_reference_that_is_named_and_what_is_measured_by_name(self):
        table = pbmpi.sweep("CrashSk", {"substeps": [2, 4]}, worlds=2, measure=["contacts"], reference={"substeps": 16}, **SMALL)
        self.assertEqual((table.is_reference.any(), table.attrs["reference"]), (False, {"substeps": 16}))
        self.assertTrue((table.position_error_max > 0).all())
        batch = pbmpi.Batch("CrashSk", 2, substeps=2)
        batch.step(12)
        self.assertEqual(table.mean_contacts[0], batch.observable("contacts").mean())
        number = pbmpi.sweep("CrashSk", {"substeps": [2]}, worlds=1, measure=lambda of: of.steps[0], **SMALL)
        self.assertEqual(number.measure.tolist(), [12])

    def test_what_is_refused(self):
        for words, settings, options in (("no whole number", {"dt": [0.007]}, {}), ("has no value", {"substeps": []}, {}),
                                         ("frames=0", {"substeps": [1]}, {"frames": 0}), ("nonsense", {"nonsense": [1]}, {}),
                                         ("heat", {"substeps": [1]}, {"measure": ["heat"]})):
            with self.assertRaisesRegex(ValueError, words):
                pbmpi.sweep("CrashSk", settings, worlds=1, **{**SMALL, **options})


if __name__ == "__main__":
    unittest.main()
