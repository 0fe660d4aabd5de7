"""The cycle model on loops whose cycles are computed by hand.

Each expectation is of the difference between two lengths of a loop, so that its start (cold caches, branches not yet
learnt) and its end play no part.
"""
import os
import unittest

from pbvalue import ToolTest

KERNELS = os.environ["PBMPI_KERNELS"]
MODELS = ("--model=none", "--model=evp:predict=1")


class Cycles(ToolTest):
    def cycles_of_rounds(self, kernel, rounds, *options, start=400):
        """Cycles of so many more rounds, by model."""
        runs = [self.run_tool([KERNELS, kernel, start + more], *options)[0]["sections"][0]["cycles"] for more in (0, rounds)]
        return {name: runs[1][name] - runs[0][name] for name in runs[0]}

    def test_a_dependent_chain_takes_its_latency(self):
        # 14 multiplications of 4 cycles, one after the other.
        cycles = self.cycles_of_rounds("chain", 100, "--model=table_3", "--model=fast:fp_mul=2", "--model=narrow:width=1")
        self.assertEqual(cycles, {"table_3": 5600, "fast": 2800, "narrow": 5600})

    def test_independent_additions_take_the_width(self):
        # 14 additions, the counter and the branch: 16 micro-operations.
        cycles = self.cycles_of_rounds("independent", 100, "--model=table_3", "--model=narrow:width=4", "--model=single:width=1")
        self.assertEqual(cycles, {"table_3": 200, "narrow": 400, "single": 1600})

    def test_units_limit_what_issues(self):
        # 16 micro-operations of integers, on one unit in each of 4, 2 and 1 clusters.
        cycles = self.cycles_of_rounds("independent", 100, "--model=four:int_units=1", "--model=two:int_units=1,clusters=2",
                                       "--model=one:int_units=1,clusters=1")
        self.assertEqual(cycles, {"four": 400, "two": 800, "one": 1600})

    def test_perfect_prediction_breaks_a_chain(self):
        # Each product is 1: all are predicted, and 16 micro-operations a round take two cycles.
        cycles = self.cycles_of_rounds("chain", 100, *MODELS)
        self.assertEqual(cycles, {"none": 5600, "evp": 200})

    def test_without_predictions_the_chain_holds(self):
        cycles = self.cycles_of_rounds("chain", 100, "--predict=none", *MODELS)
        self.assertEqual(cycles, {"none": 5600, "evp": 5600})

    def test_a_walk_takes_the_latency_of_where_it_finds_its_lines(self):
        # Of 8 MB, each line for the first time; of 32 KB, more than the first level of 16 KB; of 8 KB.
        for kernel, latency in (("walk_memory", 160), ("walk_l2", 7), ("walk_l1", 2)):
            cycles = self.cycles_of_rounds(kernel, 1000, "--model=table_3", "--model=perfect:perfect_caches=1", start=2000)
            self.assertEqual(cycles, {"table_3": 1000 * latency, "perfect": 2000}, kernel)

    def test_a_load_waits_for_the_store_before_it(self):
        # A cycle for the store, and the latency of the first level for the load.
        cycles = self.cycles_of_rounds("through_memory", 100, "--model=table_3", "--model=slow:l1=5")
        self.assertEqual(cycles, {"table_3": 300, "slow": 600})

    def test_a_wrong_guess_of_a_branch_empties_the_front_end(self):
        report, _ = self.run_tool([KERNELS, "independent", 400], "--model=table_3", "--model=late:front_end=106",
                                  "--model=perfect:perfect_branches=1")
        section = report["sections"][0]
        wrong = section["branches_wrong"] + section["indirect_wrong"]
        self.assertGreater(section["branches_wrong"], 0)
        self.assertEqual(section["cycles"]["late"] - section["cycles"]["table_3"], 100 * wrong)
        self.assertLess(section["cycles"]["perfect"], section["cycles"]["table_3"])

    def test_sections_before_the_first_modelled_one_are_only_counted(self):
        report, _ = self.run_tool([KERNELS, "chain", 100], "--first-modelled=1", *MODELS)
        section = report["sections"][0]
        self.assertFalse(section["modelled"])
        self.assertNotIn("cycles", section)
        self.assertGreaterEqual(section["instructions"], 1600)
        report, _ = self.run_tool([KERNELS, "chain", 100], "--modelled=estimate", *MODELS)
        self.assertFalse(report["sections"][0]["modelled"])


if __name__ == "__main__":
    unittest.main()
