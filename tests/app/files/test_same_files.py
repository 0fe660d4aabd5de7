"""A run's file is the same for 1 to 4 ranks, byte for byte, but for clocks and for what says how the work was dealt out.

With --all every scene is stepped in every way; without, every scene in one way, for the paper's frames, and one scene in each of the others."""
import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import SCENES, ProgramTest  # noqa: E402
from same_files import content, differences  # noqa: E402

ALL = "--all" in sys.argv
RANKS = (1, 2, 3, 4)
CUT = ("--stepper", "sor", "--record", "contacts")
SOR, QUICK = ("--stepper", "sor", "--record", "contacts,residuals"), ("--stepper", "quick", "--record", "islands,contacts")
# Too few iterations in too long a step: joints gape in each of them, more often than /events has rows.
COARSE = ("--iterations", 1, "--substeps", 1, "--dt", 0.03)
# Name: options, and the scene of the short form. One world of several spaces is cut at these by 2 ranks and more.
WAYS = {
    "spaces": ((*CUT, "--replicas", 1, *(("--frames", 20) if ALL else ())), None),
    "spaces in single precision": ((*CUT, "--precision", "single", "--replicas", 1, "--frames", 20), "Battle2"),
    "spaces that sleep, with a field of interest": (
        (*CUT, "--law", "ode", "--replicas", 1, "--frames", 40, "--effects", "+sleeping,+field_of_interest,+drag"), "Environ"),
    "worlds, estimated": ((*SOR, "--replicas", 5, "--decompose", "worlds", "--feec", "--record-every", 3), "Fight"),
    "worlds that are refined": ((*SOR, *COARSE, "--frames", 20, "--replicas", 7, "--decompose", "worlds", "--on-blowup", "refine"), "CrashSk"),
    "worlds that are frozen": ((*SOR, *COARSE, "--frames", 20, "--replicas", 3, "--decompose", "worlds", "--on-blowup", "freeze"), "CrashWa"),
    "ODE, estimated": ((*QUICK, "--replicas", 3, "--feec"), "2-Cars"),
}


class SameFiles(ProgramTest):
    def test_the_file_of_a_run_is_the_same_for_1_to_4_ranks(self):
        for way, (options, only) in WAYS.items():
            for scene in SCENES if ALL or only is None else (only,):
                with self.subTest(scene=scene, way=way):
                    self.same_for_all_ranks("--scene", scene, *options)

    def test_rebalances_take_no_row_from_the_events_of_worlds(self):
        # So many that most have no row; 2 ranks share worlds out anew.
        one = self.same_for_all_ranks("--scene", "100CrSk", *SOR, *COARSE, "--frames", 20 if ALL else 8, "--on-blowup", "refine")
        self.assertGreater(one["/events@num_dropped"], 100)

    def same_for_all_ranks(self, *args):
        """What the run of one rank has in its file."""
        files = []
        for ranks in RANKS:
            name = f"run{ranks}.h5"
            result = self.pbmpi(ranks, *args, "--output", name, "--quiet")
            self.assertEqual(result.returncode, 0, result.stderr)
            files.append(content(self.path(name)))
            self.assertEqual(differences(files[0], files[-1]), [], f"1 rank and {ranks}")
        self.assertGreater(len(files[0]), 60, "the columns of the file, with their states and observables")
        return files[0]


if __name__ == "__main__":
    unittest.main(argv=[argument for argument in sys.argv if argument != "--all"])
