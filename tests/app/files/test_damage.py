"""What has changed in a file since it was written is noticed when it is read."""
import os
import random
import shutil
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import PBREPORT, ProgramTest  # noqa: E402

RECORDED = ("--replicas", 3, "--decompose", "worlds", "--feec", "--record", "contacts,residuals")


class Damage(ProgramTest):
    def setUp(self):
        super().setUp()
        result = self.pbmpi(2, "--scene", "CrashSk", *RECORDED, "--output", "run.h5", "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)

    def refused(self, change, *words):
        shutil.copy(self.path("run.h5"), self.path("changed.h5"))
        with h5py.File(self.path("changed.h5"), "r+") as file:
            change(file)
        result = self.report("changed.h5", "--json")
        self.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
        for word in ("changed.h5", "damaged", *words):
            self.assertIn(word, result.stderr)

    def test_a_changed_number_of_every_table_is_noticed(self):
        with h5py.File(self.path("run.h5")) as file:
            tables = [file[f"checksums/{name}"].attrs["columns"].decode().split() for name in file["checksums"]]
        self.assertGreater(len(tables), 8)
        for columns in tables:
            if columns[0].startswith("/events/"):
                continue  # this run has none
            for column in columns:
                def change(file, column=column):
                    at = (len(file[column]) - 1,) + (0,) * (file[column].ndim - 1)
                    file[column][at] = file[column][at] + 1
                self.refused(change, "row", columns[0])

    def test_a_changed_contact_is_noticed(self):
        with h5py.File(self.path("run.h5")) as file:
            shape = file["contacts/point"].shape
        self.assertGreater(shape[0], 20)
        for row in (0, shape[0] // 2, shape[0] - 1):
            for column in (0, 12, shape[1] - 1):
                def change(file, at=(row, column)):
                    file["contacts/point"][at] = file["contacts/point"][at] + 1
                self.refused(change, "row", "contacts")

    def test_a_changed_parameter_column_attribute_or_name_is_noticed(self):
        def attribute(file):
            file["particles/bodies/mass"].attrs["unit"] = np.bytes_("lb")

        def parameter(file):
            file["parameters/iterations"][...] = 21

        def mass(file):
            file["particles/bodies/mass"][5] += 1

        def name(file):
            file.move("parameters/seed", "parameters/sead")

        def root(file):
            file.attrs.modify("seed", 2)
        for change in (attribute, parameter, mass, name, root):
            self.refused(change, "written once")

    def test_a_changed_end_is_noticed(self):
        def fewer(file):
            file.attrs.modify("frames_committed", 7)

        def other_hash(file):
            file.attrs.modify("state_hash", np.bytes_("0123456789abcdef"))

        def incomplete(file):
            file.attrs.modify("complete", 0)

        def breaks(file):
            file["events"].attrs.modify("num_joint_broken", 3)
        for change in (fewer, other_hash, incomplete, breaks):
            self.refused(change, "end")

    def test_a_file_of_an_older_layout_is_read(self):
        whole = self.json(self.report("run.h5", "--json"))
        with h5py.File(self.path("run.h5"), "r+") as file:
            del file["checksums"], file.attrs["checksum"], file.attrs["end_checksum"]
            file.attrs.modify("version", np.array([1, 3]))
        result = self.report("run.h5", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.json(result), whole)

    def test_a_flipped_bit_is_refused_or_changes_nothing(self):
        reference = self.report("run.h5", "--json").stdout
        with open(self.path("run.h5"), "rb") as file:
            whole = file.read()
        draw = random.Random(7)
        refused = 0
        for case in range(100):
            # The first part of the file has what describes the rest.
            at = draw.randrange(90_000 if case % 2 else len(whole))
            changed = bytearray(whole)
            changed[at] ^= 1 << draw.randrange(8)
            with open(self.path("run.h5"), "wb") as file:
                file.write(changed)
            # The message may name a thing by the name that was hit.
            result = self.run_command([PBREPORT, "run.h5", "--json"], errors="replace")
            self.assertIn(result.returncode, (0, 2), f"byte {at}: {result.stderr}")
            refused += result.returncode == 2
            if result.returncode == 0:
                self.assertEqual(result.stdout, reference, f"byte {at}")
        self.assertGreater(refused, 10)


if __name__ == "__main__":
    unittest.main()
