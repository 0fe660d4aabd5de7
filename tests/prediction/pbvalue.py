"""Starts programs under the Valgrind tool pbvalue. Shared by the tests of prediction."""
import json
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "app"))

from harness import alone  # noqa: E402

BIN = os.environ["PBMPI_BIN"]
TOOL_FOLDER = os.path.join(os.path.dirname(BIN), "lib", "pbvalue")
TIMEOUT_S = 250  # a hang, not a slow run: the longest takes seconds


class ToolTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="pbmpi-test-")
        self.addCleanup(holder.cleanup)
        self.folder = holder.name
        # Names are bound at the start: binding one when it is first called takes instructions that depend on the program's other names.
        self.environment = {**alone(self.folder), "LD_BIND_NOW": "1"}

    def path(self, name):
        return os.path.join(self.folder, name)

    def start(self, program, *options, data=b""):
        """The finished process of valgrind --tool=pbvalue, which writes out.json."""
        command = ["valgrind", "--quiet", "--tool=pbvalue", f"--pbvalue-out-file={self.path('out.json')}", *options, *map(str, program)]
        return subprocess.run(command, input=data, capture_output=True, env={**self.environment, "VALGRIND_LIB": TOOL_FOLDER},
                              cwd=self.folder, timeout=TIMEOUT_S, check=False)

    def run_tool(self, program, *options, data=b""):
        """(what the tool wrote, what the program wrote) of a run that must succeed."""
        result = self.start(program, *options, data=data)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.path("out.json"), encoding="utf-8") as file:
            return json.load(file), result.stdout


def total(report, value_class, number):
    """The sum over all sections."""
    return sum(section["classes"][value_class][number] for section in report["sections"])
