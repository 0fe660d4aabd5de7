"""Every option of pbmpi that changes a run is in the run's file and in --describe."""
import os
import re
import sys
import unittest

import h5py

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ProgramTest  # noqa: E402

# A value that is not the default, and what the run needs for it.
CHANGED = {
    "replicas": ("3", []), "parameters": ("worlds.csv", []), "world-range": ("1:2", ["--replicas", "3"]), "frames": ("2", []),
    "warmup": ("1", []), "seed": ("5", []), "effects": ("-friction", []), "stepper": ("quick", []), "law": ("ode", []),
    "dt": ("0.005", []), "iterations": ("3", []), "substeps": ("4", []), "tolerance": ("2cm", []), "approach": ("2cm", []), "precision": ("single", []),
    "simd": ("sse2", []), "threads": ("2", []), "solver-seed": ("9", []), "steps-per-frame": ("2", []), "on-blowup": ("stop", []),
    "feec": ("quick iterations=3", []), "decompose": ("worlds", []), "ranks-per-world": ("2", ["--scene", "Battle2", "--decompose", "spaces"]),
    "record-every": ("2", []), "record": ("contacts,residuals", []), "budget": ("7ms", []),
}
# These change nothing of what the file holds, but for its attribute command_line.
BESIDE = {"scene", "output", "no-output", "no-xdmf", "report", "max-time", "checkpoint", "checkpoint-every", "resume", "list-scenes",
          "describe", "help", "version", "config", "quiet", "progress"}
IN_FILE = {"parameters": "parameters_text", "feec": "estimate_iterations", "record": "record_residuals"}  # under another name


class Options(ProgramTest):
    def test_all_options_are_tried_here(self):
        names = re.findall(r"^ +(?:-\w, )?--([a-z-]+)", self.pbmpi(1, "--help", "all").stdout, re.MULTILINE)
        self.assertEqual(set(names), set(CHANGED) | BESIDE)
        self.assertLessEqual(len(set(names) - {"help", "version"}), 40, "more than people look through")

    def words(self, name):
        """A command line with the option."""
        value, others = CHANGED[name]
        words = [*others, f"--{name}={value}"]
        words += [] if "--scene" in others else ["--scene", "CrashSk"]
        return words + ([] if name == "frames" else ["--frames=1"])

    def test_each_is_in_the_file(self):
        self.write("worlds.csv", "car.speed\n9\n")
        for name in CHANGED:
            with self.subTest(option=name):
                result = self.pbmpi(1, *self.words(name), "--output", "run.h5", "--quiet")
                self.assertEqual(result.returncode, 0, result.stderr)
                with h5py.File(self.path("run.h5")) as file:
                    stored = file["parameters"][IN_FILE.get(name, name.replace("-", "_"))][()]
                    self.assertIn(f"--{name}", file.attrs["command_line"].decode())
                stored = stored.decode() if isinstance(stored, bytes) else stored
                if name == "simd":
                    self.assertTrue(stored.startswith("sse2"))
                elif name not in IN_FILE:
                    expected = {"tolerance": 0.02, "approach": 0.02, "budget": 0.007}.get(name, CHANGED[name][0])
                    self.assertEqual(type(expected)(stored), expected)

    def test_each_is_described(self):
        self.write("worlds.csv", "car.speed\n9\n")
        for name in CHANGED:
            with self.subTest(option=name):
                result = self.pbmpi(1, *self.words(name), "--describe")
                self.assertEqual(result.returncode, 0, result.stderr)
                [line] = [line for line in result.stdout.splitlines() if line.startswith("options:")]
                self.assertIn(f" --{name}", line)


if __name__ == "__main__":
    unittest.main()
