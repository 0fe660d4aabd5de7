"""Predictions of programs whose values are known: hits, errors, and what arrives in the program."""
import array
import os
import random
import unittest

from pbvalue import ToolTest, total

KERNELS = os.environ["PBMPI_KERNELS"]


def last_value_hits(values, threshold=0.0, ceiling=3, use=2, up=1, down=1):
    """(exact, fuzzy, wrong) of one last-value entry with a confidence counter, and what goes on into the program."""
    last, confidence, exact, fuzzy, wrong, arrived = None, 0, 0, 0, 0, []
    for value in values:
        arrives = value
        if last is not None:
            is_right = value == last or (threshold > 0 and abs(value - last) <= threshold)
            if confidence >= use:
                exact += value == last
                fuzzy += is_right and value != last
                wrong += not is_right
                arrives = last if is_right else value
            confidence = min(ceiling, confidence + up) if is_right else max(0, confidence - down)
        last = value
        arrived.append(arrives)
    return (exact, fuzzy, wrong), arrived


def counts(report, value_class):
    return tuple(total(report, value_class, name) for name in ("exact", "fuzzy", "wrong"))


class Hits(ToolTest):
    def move(self, kernel, values, *options, kind="d"):
        report, out = self.run_tool([KERNELS, kernel], *options, data=array.array(kind, values).tobytes())
        return report, list(array.array(kind, out))

    def test_a_constant_is_predicted_after_three_executions(self):
        report, arrived = self.move("doubles", [5.0] * 10)
        self.assertEqual(total(report, "fp_load", "executed"), 10)
        self.assertEqual(total(report, "fp_load", "repeated"), 9)
        # The first fills the entry; the second and third raise the confidence to 2, from which on it is used.
        self.assertEqual(counts(report, "fp_load"), (7, 0, 0))
        self.assertEqual(arrived, [5.0] * 10)

    def test_two_values_in_turn_are_never_predicted(self):
        report, _ = self.move("doubles", [1.0, 2.0] * 50)
        self.assertEqual(counts(report, "fp_load"), (0, 0, 0))

    def test_a_change_costs_one_misprediction(self):
        report, _ = self.move("doubles", [1.0] * 10 + [2.0] * 10)
        # 7 hits; the change is wrong and lowers the confidence from 3 to 2, which still is used.
        self.assertEqual(counts(report, "fp_load"), (7 + 9, 0, 1))

    def test_hits_of_a_random_walk_are_those_of_the_rule(self):
        draw = random.Random(7)
        values = [round(draw.gauss(0, 1)) / 4 for _ in range(2000)]
        for options, settings in (((), {}), (("--confidence-max=7", "--confidence-use=1", "--confidence-up=3", "--confidence-down=2"),
                                             {"ceiling": 7, "use": 1, "up": 3, "down": 2})):
            report, arrived = self.move("doubles", values, *options)
            self.assertEqual(counts(report, "fp_load"), last_value_hits(values, **settings)[0])
            self.assertEqual(arrived, values, "exact verification leaves every value")

    def test_threshold_0_is_exact_verification(self):
        values = [1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, -0.0, -0.0, -0.0, -0.0, 0.0, float("nan"), float("nan"), float("nan"),
                  float("nan"), float("inf"), float("inf"), float("inf"), float("inf"), 5e-324, 0.0] * 5
        data = array.array("d", values).tobytes()
        exact, out = self.run_tool([KERNELS, "doubles"], data=data)
        zero, out_of_zero = self.run_tool([KERNELS, "doubles"], "--threshold=0", data=data)
        self.assertEqual(exact["options"]["verify"], "exact")
        self.assertEqual(zero["options"]["verify"], "fuzzy")
        self.assertEqual(exact["sections"], zero["sections"])
        self.assertEqual(out, data)
        self.assertEqual(out_of_zero, data)

    def test_a_threshold_changes_values_within_it_and_no_others(self):
        draw = random.Random(3)
        for threshold in (1e-6, 1e-7):
            values = [1.0]  # a walk whose steps are now and then too long, and at times none
            for _ in range(3000):
                values.append(values[-1] + draw.choice((0, 0.5, 0.9, -0.9, 0.3, -3)) * threshold)
            report, arrived = self.move("doubles", values, f"--threshold={threshold:g}")
            expected, wanted = last_value_hits(values, threshold)
            self.assertEqual(counts(report, "fp_load"), expected)
            self.assertEqual(arrived, wanted)
            changed = [abs(a - b) for a, b in zip(arrived, values) if a != b]
            self.assertEqual(len(changed), expected[1])
            self.assertGreater(len(changed), 50)
            self.assertLessEqual(max(changed), threshold)
            self.assertAlmostEqual(total(report, "fp_load", "error_max") / max(changed), 1, places=12)
            self.assertAlmostEqual(total(report, "fp_load", "error_sum") / sum(changed), 1, places=9)

    def test_a_relative_threshold_is_of_the_computed_value(self):
        values = [1000.0, 1000.0, 1000.0, 1000.0005, 1000.0005, 1000.0005, 1000.01]
        report, arrived = self.move("doubles", values, "--threshold=1e-6", "--threshold-kind=relative")
        self.assertEqual(counts(report, "fp_load"), (2, 1, 1))
        self.assertEqual(arrived[3], 1000.0)
        self.assertEqual(arrived[6], 1000.01)
        report, arrived = self.move("doubles", values, "--threshold=1e-6")
        self.assertEqual(total(report, "fp_load", "fuzzy"), 0)
        self.assertEqual(arrived, values)

    def test_numbers_that_are_not_finite_are_never_near(self):
        values = [1e308] * 5 + [float("inf")] * 5 + [float("nan")] * 5
        report, arrived = self.move("doubles", values, "--threshold=1e300")
        self.assertEqual(total(report, "fp_load", "fuzzy"), 0)
        self.assertEqual(str(arrived), str(values))

    def test_single_precision_is_compared_as_such(self):
        values = [1.0, 1.0, 1.0, 1.0000001, 1.0000001, 2.0]
        report, arrived = self.move("floats", values, "--threshold=1e-6", kind="f")
        self.assertEqual(counts(report, "fp_load"), (1, 1, 1))
        self.assertEqual(arrived[3], 1.0)
        self.assertEqual(arrived[5], 2.0)

    def test_a_register_of_two_numbers_is_right_if_both_are(self):
        pairs = [(1.0, 2.0)] * 4 + [(1.0 + 1e-7, 2.0), (1.0 + 1e-7, 3.0), (1.0 + 1e-7, 3.0)]
        report, arrived = self.move("pairs", [x for pair in pairs for x in pair], "--threshold=1e-6")
        self.assertEqual(counts(report, "fp_load"), (2, 1, 1))
        self.assertEqual(arrived[8:10], [1.0, 2.0])
        self.assertEqual(arrived[10:12], [1.0 + 1e-7, 3.0])

    def test_bits_of_unknown_meaning_are_verified_exactly(self):
        values = [1.0, 2.0] * 4 + [1.0 + 1e-7, 2.0]
        report, arrived = self.move("bits", values, "--threshold=1e-6")
        self.assertEqual(counts(report, "fp_load"), (1, 0, 1))
        self.assertEqual(arrived, values)

    def test_results_of_arithmetic_and_integers_are_classes_of_their_own(self):
        values = [4.0] * 10
        report, _ = self.move("sums", values)
        self.assertEqual(counts(report, "fp_operation"), (7, 0, 0))
        self.assertEqual(total(report, "int_load", "executed"), 0)
        report, _ = self.move("sums", values, "--predict=all")
        self.assertEqual(counts(report, "fp_operation"), (7, 0, 0))
        self.assertEqual(counts(report, "int_load"), (7, 0, 0))
        report, _ = self.move("sums", values, "--predict=int")
        self.assertEqual(total(report, "fp_operation", "executed"), 0)
        self.assertEqual(counts(report, "int_load"), (7, 0, 0))

    def test_one_entry_holds_one_of_two_instructions(self):
        values = [3.0] * 20
        own_entries, _ = self.move("two", values, "--table-entries=0")
        self.assertEqual(counts(own_entries, "fp_load"), (34, 0, 0))
        for replacement in ("lru", "fifo", "random"):
            evicted, _ = self.move("two", values, "--table-entries=1", "--table-ways=1", f"--replacement={replacement}")
            self.assertEqual(total(evicted, "fp_load", "repeated"), 0, "each finds the other's entry, and takes its place")
        shared, _ = self.move("two", values, "--table-entries=1", "--table-ways=1", "--tag-bits=0")
        self.assertEqual(counts(shared, "fp_load"), (0, 0, 0), "without tags they share a value, and one is never the other's")
        shared, _ = self.move("two", [1.0] * 20, "--table-entries=1", "--table-ways=1", "--tag-bits=0")
        self.assertEqual(counts(shared, "fp_load"), (37, 0, 0), "the same value from both")

    def test_only_the_scope_is_predicted(self):
        data = array.array("d", [1.0] * 10).tobytes()
        for scope, phases in {"collision": {1}, "step": {2}, "all": {1, 2}, "frame": {0, 1, 2}}.items():
            for phase in (0, 1, 2):
                report, _ = self.run_tool([KERNELS, "doubles", 0, phase], f"--scope={scope}", data=data)
                self.assertEqual(total(report, "fp_load", "executed"), 10 if phase in phases else 0, (scope, phase))

    def test_each_process_has_the_same_random_bytes(self):
        shown = {self.run_tool([KERNELS, "random_bytes", 16])[1] for _ in range(2)}
        self.assertEqual(shown, {b"\x50" * 16})

    def test_options_that_cannot_be_are_refused(self):
        for option in ("--threshold=small", "--threshold=-1", "--table-entries=3", "--table-ways=3", "--confidence-use=9",
                       "--scope=half", "--model=a:window=0", "--model=a:wide=1", "--model=a:width=", "--model=a:width=2;window=3",
                       "--predictt=fp"):
            result = self.start([KERNELS, "doubles"], option)
            self.assertNotEqual(result.returncode, 0, option)
            self.assertIn(option.split("=")[0], result.stderr.decode(), option)


if __name__ == "__main__":
    unittest.main()
