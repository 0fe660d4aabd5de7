"""Instructions of a step, counted by callgrind: they do not change when an effect that nothing calls for is compiled in, and
hardly with one that the state does not arm.

Usage: step_counts_test.py PROGRAM PROGRAM_WITH_ONE_MORE_EFFECT (both made of count_steps.cpp)
"""
import collections
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "jobs"))
import figure3  # noqa: E402

AS_IS, EXTRA = sys.argv[1:3]


def count(program, scene, stepper, function, *choices):
    """What the program printed, and the instructions of a function of it by object file."""
    with tempfile.TemporaryDirectory(prefix="pbmpi-test-") as folder:
        dump = os.path.join(folder, "callgrind")
        # The environment lies on the stack: both programs get the same one. Names are bound at the start: binding one when it is
        # first called takes instructions that depend on the other names of the program.
        result = subprocess.run(["valgrind", "--quiet", "--tool=callgrind", f"--toggle-collect={function}*",
                                 "--dump-instr=yes", "--dump-line=no", "--compress-pos=no", "--compress-strings=no",
                                 f"--callgrind-out-file={dump}", program, scene, stepper, *choices], cwd=folder, timeout=240,
                                capture_output=True, text=True, check=False, env={"PATH": os.environ["PATH"], "LD_BIND_NOW": "1"})
        if result.returncode != 0:
            raise RuntimeError(result.stderr)
        by_object = collections.Counter()
        for (path, _), instructions in figure3.read_dump(dump)[0].items():
            name = pathlib.Path(path).name
            by_object["program" if path == program else name] += instructions
        return json.loads(result.stdout), by_object


@unittest.skipUnless(shutil.which("valgrind"), "no valgrind")
class StepCounts(unittest.TestCase):
    def counts(self, scene, stepper, function):
        plain, without = count(AS_IS, scene, stepper, function)
        more, with_extra = count(EXTRA, scene, stepper, function)
        self.assertEqual(more["effects"], plain["effects"] + 1, "the second program has one more effect")
        self.assertEqual(more["passes"], plain["passes"], "which nothing calls for")
        self.assertEqual(more["state_hash"], plain["state_hash"])
        return without, with_extra

    # To the last instruction, those of the C library too: count_steps.cpp sees to it that the heap lies the same.
    def test_an_effect_that_nothing_calls_for_adds_no_instruction_to_a_step_of_quick(self):
        without, with_extra = self.counts("CrashWa", "quick", "counted_steps")
        self.assertGreater(without.total(), 1e7, "15 steps of 191 bodies were counted")
        self.assertEqual(with_extra, without)

    def test_an_effect_that_nothing_calls_for_adds_no_instruction_to_a_step_of_sor(self):
        without, with_extra = self.counts("CrashWa", "sor", "counted_steps")
        self.assertGreater(without.total(), 1e7, "15 steps of 191 bodies were counted")
        self.assertEqual(with_extra, without)

    # What arms by the state has to compare: a pass over the bodies a step, a group of lanes at a time.
    def test_fast_bodies_cost_a_thousandth_of_a_step_in_which_nothing_is_fast(self):
        for scene in ("hard/rest/pyramid15", "hard/rest/Environ", "hard/rest/100CrSk"):
            with self.subTest(scene=scene):
                plain, without = count(AS_IS, scene, "sor", "counted_steps", "-fast_bodies")
                armed, with_effect = count(AS_IS, scene, "sor", "counted_steps", "+fast_bodies")
                self.assertEqual(armed["passes"], plain["passes"] + 1)
                self.assertEqual(armed["state_hash"], plain["state_hash"])
                self.assertGreater(with_effect.total(), without.total(), "it does compare")
                self.assertLess(with_effect.total(), 1.001 * without.total())

    def test_the_count_sees_a_single_look_through_the_registry(self):
        without, with_extra = self.counts("CrashSk", "quick", "counted_plan")
        self.assertGreater(with_extra["program"], without["program"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
