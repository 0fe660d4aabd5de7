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
        case = {"stepper": "sor", "precision": "single", "substeps": 12.0, "iterations": 1.0, "law": "soft"}
        self.assertEqual(programs.setting_name(case), "`sor` single, 12 x 1")
        case = {**case, "substeps": 1.0, "iterations": 20.0, "law": "ode"}
        self.assertEqual(programs.setting_name(case), "`sor` single, 1 x 20, law ode")
        self.assertEqual(programs.setting_name({**case, "stepper": "quick"}), "`quick`, 1 x 20")

    def test_the_largest_step_is_that_up_to_which_all_shorter_ones_hold(self):
        verdicts = dict.fromkeys(stability.STEPS_S, "pass")
        self.assertEqual(stability.largest_step(verdicts, ("pass",)), "0.05 s")
        verdicts[0.002] = "degraded"
        self.assertEqual(stability.largest_step(verdicts, ("pass",)), "0.001 s")
        self.assertEqual(stability.largest_step(verdicts, ("pass", "degraded")), "0.05 s")
        verdicts[0.0001] = "broken"
        self.assertEqual(stability.largest_step(verdicts, ("pass", "degraded")), "none")


if __name__ == "__main__":
    unittest.main()
