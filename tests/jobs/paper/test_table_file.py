"""The file of jobs/paper/predict.py: types, seal, and what it never replaces."""
import os
import pathlib
import tempfile
import unittest

import h5py
import made_up  # noqa: F401  which adds the folder of what is tested
import numpy as np

from reports.files import BadInput
from reports.tables import Values
from study import table_file


class Hdf5(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    COLUMNS = {"frames": [Values("mean", "m", np.array([0.5, 1.5])), Values("count", "", np.array([2, 3], dtype="i4")),
                          Values("name", "", ["é", "wall"])], "none": [Values("name", "", [])]}

    def write_tables(self, name):
        table_file.write_tables(self.path(name), "pbmpi-study", (1, 8), {"pbmpi_version": "0.1.0"}, {"scene": ""}, self.COLUMNS)

    def test_has_int64_float64_and_fixed_texts_in_utf_8_with_units_in_ascii(self):
        self.write_tables("e.h5")
        with h5py.File(self.path("e.h5")) as file:
            self.assertEqual((file.attrs["filetype"], file.attrs["version"].tolist()), (b"pbmpi-study", [1, 8]))
            self.assertEqual([file[f"frames/{name}"].dtype.str for name in ("mean", "count", "name")], ["<f8", "<i8", "|S4"])
            self.assertEqual(file["frames/mean"].attrs["unit"], b"m")
            self.assertEqual(file["frames/name"].asstr()[:].tolist(), ["é", "wall"])
            self.assertEqual((file["parameters/scene"][()], file["none/name"].shape, file["none/name"].dtype.str), (b"", (0,), "|S1"))
            unit = file["frames/mean"].attrs.get_id("unit")
            for item, expected in ((file["frames/name"].id, h5py.h5t.CSET_UTF8), (file["parameters/scene"].id, h5py.h5t.CSET_UTF8),
                                   (file.attrs.get_id("filetype"), h5py.h5t.CSET_UTF8), (unit, h5py.h5t.CSET_ASCII)):
                found = item.get_type()
                self.assertEqual((found.get_cset(), found.get_strpad(), found.is_variable_str()), (expected, h5py.h5t.STR_NULLPAD, False))

    def test_replaces_one_of_its_own_and_keeps_its_permissions(self):
        self.write_tables("e.h5")
        os.chmod(self.path("e.h5"), 0o640)
        os.symlink("e.h5", self.path("link.h5"))
        self.write_tables("link.h5")
        self.assertTrue(os.path.islink(self.path("link.h5")))
        self.assertEqual(os.stat(self.path("e.h5")).st_mode & 0o777, 0o640)
        self.assertEqual(sorted(os.listdir(self.folder)), ["e.h5", "link.h5"])

    def test_replaces_nothing_else(self):
        for name, block, kind in (("plain", 0, None), ("other", 0, "solver-mesh"), ("block", 1024, None), ("run", 0, "pbmpi-run")):
            with h5py.File(self.path(name), "w", userblock_size=block) as file:
                file["measured"] = range(1000)
                if kind:
                    file.attrs["filetype"] = kind
        with open(self.path("text"), "w", encoding="utf-8") as file:
            file.write("notes of my own")
        with open(self.path("damaged"), "wb") as file:
            file.write(b"\x89HDF\r\n\x1a\n and no more")
        os.mkdir(self.path("folder"))
        reasons = {"plain": "no readable attribute filetype", "other": "of type solver-mesh, which", "block": "HDF5 file",
                   "run": "of type pbmpi-run", "text": "no HDF5 file", "damaged": "HDF5 file", "folder": "it is a directory",
                   "nowhere/e.h5": "there is no directory"}
        for name, words in reasons.items():
            before = pathlib.Path(self.path(name)).read_bytes() if os.path.isfile(self.path(name)) else None
            with self.assertRaisesRegex(BadInput, words):
                self.write_tables(name)
            self.assertEqual(pathlib.Path(self.path(name)).read_bytes() if before is not None else None, before)


class Seals(unittest.TestCase):
    def test_any_byte_matters(self):
        seal = table_file.seal_of(b"12345678")
        self.assertEqual((len(seal), seal[:8]), (24, b"PBMPISUM"))
        self.assertEqual(len({table_file.seal_of(data) for data in (b"12345678", b"12345679", b"1234567", b"12345678\0")}), 4)


if __name__ == "__main__":
    unittest.main()
