"""Every case at rest and the scenes of collisions by the engines that a build may lack: finite, or refused with what to do.

Usage: test_engine_cases.py [--all]; --all: each case with each engine (most of an hour), otherwise some that take seconds.
"""
import os
import re
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import harness  # noqa: E402

ALL = "--all" in sys.argv
STEPPERS = (("bullet",), ("mujoco",))
SOME = ("hard/rest/2-Cars", "hard/rest/CrashSk", "hard/rest/card_house", "hard/rest/column20", "hard/rest/plank_arch", "hard/rest/pyramid100",
        "hard/rest/spheres5", "CrashSk")
COLLISIONS = ("CrashSk", "100CrSk", "CrashWa", "Fight", "Battle2")
# More than MuJoCo can address: from the start, and once contacts have been found that the start does not have.
TOO_LARGE = ("hard/rest/pyramid100",)
GROWS = ("hard/rest/pyramid30_small",)
# A step takes MuJoCo seconds to tens of seconds.
SLOW = (*GROWS, "hard/rest/Battle2", "hard/rest/Battle2_humans", "hard/rest/Environ", "hard/rest/pyramid15", "hard/rest/wall400", "Battle2")


class Cases(harness.ProgramTest):
    def cases(self):
        listed = self.run_command([harness.PBMPI, "--list-scenes"]).stdout
        at_rest = re.findall(r"^  (hard/rest/\S+)", listed, re.MULTILINE)
        self.assertGreater(len(at_rest), 20)
        every = at_rest + list(COLLISIONS)
        self.assertEqual([name for name in (*SOME, *TOO_LARGE, *SLOW) if name not in every], [])
        return every if ALL else SOME

    def steppers(self):
        text = " ".join(self.pbmpi(1, "--help", "all").stdout.split())
        present = text.split("Steppers of other engines: ")[1].split("not in this build: ")[0]
        steppers = [words for words in STEPPERS if f"{words[0]} (" in present]
        if not steppers:
            self.skipTest("this build has neither Bullet nor MuJoCo")
        return steppers

    def frames(self, case, stepper):
        """The collisions as the scene has them, the others some."""
        if stepper == "mujoco" and case in SLOW:
            return ["--warmup", 0, "--frames", 1]
        return [] if case in COLLISIONS else ["--warmup", 0, "--frames", 10]

    def test_each_case_is_finite_or_refused_with_what_to_do(self):
        for case in self.cases():
            for stepper, *options in self.steppers():
                with self.subTest(case=case, stepper=stepper, options=options):
                    args = ["--scene", case, "--stepper", stepper, *options, *self.frames(case, stepper), "--no-output"]
                    if stepper == "mujoco" and case in (*TOO_LARGE, *GROWS):
                        result = self.pbmpi(1, *args)
                        self.assertIn(result.returncode, (2,) if case in TOO_LARGE else (0, 1), result.stderr)
                        if result.returncode != 0:
                            lines = [line for line in result.stderr.splitlines() if line.startswith("pbmpi: ")]
                            self.assertEqual(len(lines), 1, result.stderr)
                            self.assertRegex(lines[0], r"\d+ bodies .* GB.*; step it with sor or quick, or make the world smaller")
                        continue
                    summary = self.summary(1, *args)
                    self.assertEqual(summary["invariants"]["nonfinite_bodies"], 0)
                    self.assertEqual(summary["worlds_survived"], summary["worlds"])
                    self.assertGreater(summary["contacts"]["mean"], 0)


if __name__ == "__main__":
    if ALL:
        harness.TIMEOUT_S = 900
    unittest.main(argv=[word for word in sys.argv if word != "--all"])
