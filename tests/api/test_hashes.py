"""A batch has the bits of a run of pbmpi: test_hashes.py BATCH_HASH."""
import json
import os
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "app"))
import harness  # noqa: E402

BATCH_HASH = sys.argv.pop(1)

# Scene, worlds, frames without warm-up, options. Environ has one space a room: pbmpi on one rank keeps it whole, too.
CASES = [
    ("CrashSk", 3, 8, {}),
    ("CrashSk", 2, 4, {"precision": "single", "substeps": "5", "iterations": "3"}),
    ("CrashSk", 2, 4, {"law": "ode", "precision": "single"}),
    ("CrashSk", 2, 4, {"stepper": "quick"}),
    ("CrashSk", 2, 2, {"stepper": "direct", "dt": "0.005", "effects": "+sleeping,-friction"}),
    ("100CrSk", 10, 2, {}),
    ("100CrSk", 5, 2, {"precision": "single", "solver-seed": "5"}),
    ("100CrSk", 5, 2, {"stepper": "quick", "iterations": "10"}),
    ("Environ", 1, 2, {}),
    ("Environ", 1, 2, {"precision": "single"}),
    ("Environ", 1, 2, {"stepper": "quick"}),
]


class HashTest(harness.ProgramTest):
    def test_a_batch_has_the_hash_of_a_run(self):
        for scene, worlds, frames, options in CASES:
            with self.subTest(scene=scene, options=options):
                arguments = [text for name, value in options.items() for text in ("--" + name + "=" + value,)]
                run = self.run_command([harness.PBMPI, "--scene", scene, "--replicas", str(worlds), "--warmup", "0", "--frames",
                                        str(frames), "--no-output", "--report", "json", *arguments])
                self.assertEqual(run.returncode, 0, run.stderr)
                batch = subprocess.run(
                    [BATCH_HASH, scene, str(worlds), str(3 * frames), *(f"{name}={value}" for name, value in options.items())],
                    capture_output=True, text=True, timeout=harness.TIMEOUT_S, check=False)
                self.assertEqual(batch.returncode, 0, batch.stderr)
                self.assertEqual(batch.stdout.strip(), json.loads(run.stdout)["state_hash"])


if __name__ == "__main__":
    unittest.main()
