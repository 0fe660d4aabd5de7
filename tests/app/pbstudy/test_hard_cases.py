"""What holds today holds tomorrow: verdicts of the hard cases under the study's own settings, but for the largest cases.

known_failures.txt lists what does not pass. A case that fails and is not listed fails this test, and so does one that is
listed and passes: then the list is written anew (PBMPI_WRITE_KNOWN_FAILURES=1 in the environment) and shows in the commit what
became better or worse. Whether a failure is degraded or broken, and its number, is there to be read: falls are chaotic. So
are numbers near a limit, since sines of another processor's C library have other last bits: within a fifth of the limit a
case may be on either side of it.
"""
import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import BIN, ProgramTest  # noqa: E402

LIST = os.path.join(os.path.dirname(os.path.abspath(__file__)), "known_failures.txt")
MOST_WORK = 50_000  # bodies x steps: 77 cases, some 20 s on two cores
HEAD = "# Hard cases that do not pass: case | setting | verdict | what decided. See test_hard_cases.py.\n"


NEAR = 1.2  # of the limit, or its inverse


def is_clear(cell):
    """Whether the number that decided is well to one side of its limit."""
    value, limit = cell["value"], cell["right_up_to"]
    return value is None or limit == 0 or not limit / NEAR < value < limit * NEAR


def read_list():
    with open(LIST, encoding="utf-8") as file:
        rows = [line.rstrip("\n").split(" | ") for line in file if not line.startswith("#")]
    return {(case, setting) for case, setting, *_ in rows}


class HardCases(ProgramTest):
    def results(self):
        study = self.run_command(["mpirun", "-n", "2", os.path.join(BIN, "pbstudy"), "stability", "--most-work",
                                  str(MOST_WORK), "--output", "study.h5", "--quiet"])
        self.assertEqual(study.returncode, 0, study.stderr)
        report = self.json(self.report("study.h5", "--json"))
        return {(case["scene"], cell["setting"]): cell for case in report["cases"] for cell in case["results"]
                if cell["verdict"] != "n/a"}

    def test_what_passes_and_what_does_not_is_as_listed(self):
        results = self.results()
        failing = {key: cell for key, cell in results.items() if cell["verdict"] != "pass"}
        if os.environ.get("PBMPI_WRITE_KNOWN_FAILURES"):
            with open(LIST, "w", encoding="utf-8") as file:
                file.write(HEAD)
                for (case, setting), cell in failing.items():
                    number = "not finite" if cell["value"] is None else f"{cell['value']:.3g} {cell['unit']}".strip()
                    file.write(f"{case} | {setting} | {cell['verdict']} | {cell['decided_by']} {number}\n")
        known = read_list()
        clear = {key for key, cell in results.items() if is_clear(cell)}
        self.assertGreater(len(clear), 500, "cases were run")
        self.assertEqual(sorted((set(failing) - known) & clear), [], "these passed before, and fail now")
        passing = (known - set(failing)) & clear | known - set(results)
        self.assertEqual(sorted(passing), [], "these are listed as failures, and pass (or are gone): write the list anew")


if __name__ == "__main__":
    unittest.main()
