"""Rows of several files are indexed as one numpy array is."""
import os
import tempfile
import unittest

import h5py
import numpy as np
from pbmpi._rows import Piece, Rows


class Indexing(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = h5py.File(os.path.join(folder.name, "rows.h5"), "w")
        self.addCleanup(self.file.close)
        whole = np.arange(17 * 4 * 3, dtype="f8").reshape(17, 4, 3)
        self.file["a"], self.file["b"], self.file["c"] = whole[:8], whole[3:13], whole[10:]
        # Rows 0 to 7 from a, 8 to 11 from b, 12 to 15 from c; row 16 is not part of it.
        self.rows = Rows("rows", [Piece(self.file["a"], 0, 8), Piece(self.file["b"], 5, 4), Piece(self.file["c"], 2, 4)], "m")
        self.array = whole[:16]

    def test_every_kind_of_index_gives_what_numpy_gives(self):
        self.assertEqual((self.rows.shape, self.rows.ndim, len(self.rows), self.rows.dtype), ((16, 4, 3), 3, 16, np.float64))
        mask = np.arange(16) % 3 == 0
        slices = [slice(a, b, c) for a in (None, 0, 5, 9, -2, 40) for b in (None, 3, 8, 15, -1, 40) for c in (None, 1, 3, 7, -1, -4)]
        keys = [0, 7, 8, -1, np.int64(12), ..., (), *slices, mask, [3, 1, 14], [-1, 0], [], np.array([], dtype=int), (slice(None), 2), (-3, 1, 2),
                (3, ..., 0), (..., 1), (slice(2, 14, 5), slice(1, 3), 0), (slice(None), [2, 0]), (5, [3, 1]), (slice(None), slice(None, None, -1)),
                ([9, 2], 1), (mask, ..., 2), (slice(6, 10), np.array([True, False, True, False])), ([9, 2], [3, 0]), ([9, 2], [3, 0], 1),
                ([14, 1, 8], slice(None), [2, 0, 1]), (np.arange(16) < 4, np.arange(4)), ([9, 2], slice(None, None, -1)), (..., None), (4, None)]
        for key in keys:
            found, expected = self.rows[key], self.array[key]
            self.assertEqual(found.shape, expected.shape, key)
            self.assertTrue(np.array_equal(found, expected), key)

    def test_it_is_an_array_to_numpy_and_a_sequence_to_python(self):
        self.assertTrue(np.array_equal(np.asarray(self.rows), self.array))
        self.assertEqual(np.asarray(self.rows, dtype="f4").dtype, np.float32)
        self.assertEqual(sum(1 for _ in self.rows), 16)
        self.assertAlmostEqual(np.mean(self.rows), self.array.mean())

    def test_what_numpy_refuses_is_refused(self):
        for key in (16, -17, [16], (0, 0, 0, 0), np.array([True, False])):
            with self.assertRaises(IndexError, msg=key):
                self.rows[key]

    def test_rows_of_other_lengths_are_no_array(self):
        self.file["d"] = np.zeros((2, 5))
        with self.assertRaisesRegex(ValueError, "rows are .*one by one"):
            Rows("rows", [Piece(self.file["a"], 0, 8), Piece(self.file["d"], 0, 2)], "")


if __name__ == "__main__":
    unittest.main()
