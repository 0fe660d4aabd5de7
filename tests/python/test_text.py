"""Python values as options and as TOML, read back by Python's own reader of TOML."""
import math
import tomllib
import unittest

import numpy as np
from pbmpi._text import option_text, parameter_texts, settings_text, toml_text


def read_back(value):
    return tomllib.loads(f"value = {toml_text(value)}")["value"]


class Toml(unittest.TestCase):
    def test_values_are_read_back_as_they_were(self):
        for value in (True, False, 0, -7, 2**62, 0.1, -1e-300, 1e300, 5e-324, 1e16, 12.0, math.inf, "", "car", 'a "quoted" \\ text\n\t\x7f\x01',
                      "Größe", [], [0, 0, -1.62], [[1, 2], [3.5]], {"mu": 0.5, "two words": [True]}):
            self.assertEqual(read_back(value), value)
            self.assertIs(type(read_back(value)), type(value))
        self.assertTrue(math.isnan(read_back(math.nan)))

    def test_numbers_and_arrays_of_numpy_are_pythons(self):
        self.assertEqual(read_back(np.float64(0.1)), 0.1)
        self.assertEqual(read_back(np.float32(0.1)), float(np.float32(0.1)))
        self.assertEqual(read_back(np.array([[1, 2], [3, 4]])), [[1, 2], [3, 4]])
        self.assertIs(read_back(np.bool_(True)), True)

    def test_what_toml_does_not_have_is_refused_by_name(self):
        for value in (None, b"bytes", 1j, object(), [None]):
            with self.assertRaisesRegex(TypeError, "is no value of a scene"):
                toml_text(value)


class Settings(unittest.TestCase):
    def test_options_have_pbmpis_names_and_texts(self):
        self.assertEqual(settings_text({"solver_seed": 5, "stepper": "sor", "substeps": np.int64(4), "dt": 1e-5}),
                         {"solver-seed": "5", "stepper": "sor", "substeps": "4", "dt": "1e-05"})
        self.assertEqual(option_text("effects", {"friction": False, "sleeping": True}), "-friction,+sleeping")

    def test_values_that_no_option_has(self):
        for value in (None, True, [1], {"friction": "no"}):
            with self.assertRaisesRegex(TypeError, "substeps="):
                option_text("substeps", value)


class Parameters(unittest.TestCase):
    def test_dicts_of_worlds_and_of_columns_are_the_same(self):
        rows = [{"car.speed": 5, "car.heading": 0.5}, {"car.speed": 6, "car.heading": 1.5}]
        columns = {"car.speed": np.array([5, 6]), "car.heading": [0.5, 1.5]}
        self.assertEqual(parameter_texts(rows, 2), parameter_texts(columns, 2))
        self.assertEqual(parameter_texts(columns, 2)[1], {"car.speed": "6", "car.heading": "1.5"})
        self.assertEqual(parameter_texts([None, {}], 2), [{}, {}])
        self.assertEqual(parameter_texts(None, 2), [])

    def test_other_numbers_of_worlds(self):
        with self.assertRaisesRegex(ValueError, "they are 1; .*each of the 2 worlds"):
            parameter_texts([{}], 2)
        with self.assertRaisesRegex(ValueError, "equally long.*'a': 1, 'b': 2"):
            parameter_texts({"a": [1], "b": [1, 2]}, 2)


if __name__ == "__main__":
    unittest.main()
