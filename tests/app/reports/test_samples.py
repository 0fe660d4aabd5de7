"""Order statistics and means over samples."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "src/app"))
from reports.samples import median_interval, quantile, total  # noqa: E402


class Samples(unittest.TestCase):
    def test_sums_are_in_order(self):
        self.assertEqual(total([1e16, 1.0, -1e16, 1.0]), 1.0)
        self.assertEqual(total([[1, 2], [3, 4]]).tolist(), [4, 6])
        self.assertEqual(total([]), 0)

    def test_quantiles_lie_between_order_statistics(self):
        values = [40, 10, 30, 20]
        self.assertEqual([quantile(values, q) for q in (0, 1, 0.5)], [10, 40, 25])
        self.assertAlmostEqual(quantile(values, 0.9), 37, 12)
        self.assertEqual((quantile([7], 0.99), quantile([], 0.5)), (7, 0))

    def test_the_interval_of_the_median_is_the_narrowest_that_is_sure_enough(self):
        # Outcomes of n tosses with at most k heads, n = 5: 1, 6; n = 6: 1, 7; n = 9: 1, 10, 46 of 2^n.
        for values, confidence, low, high, held in (([5, 3, 1, 2, 4], 0.95, 1, 5, 1 - 2 / 32), ([5, 3, 1, 2, 4], 0.5, 2, 4, 1 - 12 / 32),
                                                    ([6, 5, 3, 1, 2, 4], 0.95, 1, 6, 1 - 2 / 64), (range(1, 10), 0.95, 2, 8, 1 - 20 / 512),
                                                    (range(1, 10), 0.8, 3, 7, 1 - 92 / 512), ([7], 0.95, 7, 7, 0)):
            found = median_interval(values, confidence)
            self.assertEqual((found.low, found.high, found.confidence), (low, high, held), values)

    def test_long_samples_have_one_too(self):
        """Computed with fractions of whole numbers; 2^-2000 is below every double."""
        found = median_interval(range(2000), 0.95)
        self.assertEqual((found.low, found.high), (955, 1044))
        self.assertAlmostEqual(found.confidence, 0.9534471795082162, 12)


if __name__ == "__main__":
    unittest.main()
