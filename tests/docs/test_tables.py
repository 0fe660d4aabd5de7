"""How docs/figures.py writes numbers, names and scenes."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs"))

from tables import programs, stability  # noqa: E402


class Tables(unittest.TestCase):
    def test_a_number_has_its_significant_digits_and_no_exponent(self):
        for value, text in ((0, "0"), (0.00123, "0.0012"), (0.0996, "0.10"), (9.96, "10"), (126, "130"), (3617, "3,600")):
            self.assertEqual(programs.digits(value), text)

    def test_a_length_below_a_micrometre_is_not_told_in_digits(self):
        self.assertEqual(programs.millimetres(1e-9), "< 0.001")
        self.assertEqual(programs.millimetres(0.0169), "17")

    def test_a_setting_names_what_is_not_the_default(self):
        case = {"stepper": "sor", "precision": "single", "substeps": 8.0, "iterations": 3.0, "warm_start": 1.0, "sor_factor": 1.0}
        self.assertEqual(programs.setting_name(case), "`sor` single, 8 x 3, warm start 1, factor 1")
        case = {**case, "stepper": "quick", "substeps": 1.0, "iterations": 20.0, "warm_start": 0.0}
        self.assertEqual(programs.setting_name(case), "`quick`, 1 x 20")

    def test_a_scene_at_rest_takes_speed_from_whatever_moves_and_puts_rounds_on_the_ground(self):
        text = stability.at_rest("Battle")
        self.assertIn("events = false", text)
        moving = [actor for actor in stability.actors_of("Battle").values() if "velocity" in actor]
        self.assertEqual(text.count("velocity = [0, 0, 0]"), len(moving))
        self.assertEqual(text.count("position = "), sum(actor["type"] == "projectile" for actor in moving))
        self.assertIn("speed = 0\n", stability.at_rest("CrashSk"))


if __name__ == "__main__":
    unittest.main()
