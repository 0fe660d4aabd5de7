"""What pbmpi says of its runs and studies is what judge.py, which shares no code with it, recomputes from their files.

usage: judge_test.py FOLDER_OF_PROGRAMS SCHEMA.md"""
import json
import os
import re
import subprocess
import sys
import tempfile

import h5py
import numpy as np

import judge

SCENES = ("2-Cars", "10-Cars", "CrashSk", "CrashWa", "Environ", "100CrSk", "Battle", "Fight", "Battle2")
# Another solver, a coarser one: its errors fill the categories. Joints of CrashWa's car break.
COARSE = ("--stepper", "quick", "--iterations", "4")


class Programs:
    def __init__(self, folder, scratch):
        self.folder, self.scratch = os.path.abspath(folder), scratch

    def run(self, program, *args):
        result = subprocess.run([os.path.join(self.folder, program), *map(str, args)], cwd=self.scratch, capture_output=True,
                                text=True, timeout=400, check=False)
        assert result.returncode == 0, (program, args, result.stderr)
        return result.stdout

    def path(self, name):
        return os.path.join(self.scratch, name)

    def record(self, name, *args):
        """The JSON summary of a run."""
        return json.loads(self.run("pbmpi", *args, "--record", "contacts", "--report", "json", "--output", name))


def assert_run(path, summary):
    """Every number to rounding; what is counted, compared or copied to the bit; the summary to the digits that it prints."""
    verdict = judge.judge_run(path)
    assert verdict["as_stored"] and verdict["state_hash"] == summary["state_hash"], path
    for name, (size, apart) in verdict["differences"].items():
        exact = name in ("islands", "contacts", "max_penetration")
        assert apart <= (0 if exact else 1e-12 * max(size, 1)), (path, name, size, apart)
    assert {"islands", "energy", "joint_gap"} <= set(verdict["differences"])
    run = judge.Run(path)
    rows = [row for row in range(run.rows) if run.measured[run.frame_of(row)]]
    gap = max(run.joint_gap(row).max() for row in rows)
    energy = run.energy(run.rows - 1).sum()
    kept = summary["invariants"]
    assert "%.2f" % (1e3 * gap) == "%.2f" % (1e3 * kept["max_joint_gap_m"]), (path, gap, kept)
    assert "%.1f" % energy == "%.1f" % kept["energy_j"], (path, energy, kept)
    return verdict


def assert_schema_hash(schema, path, expected):
    with open(schema, encoding="utf-8") as text:
        code = next(block for block in re.findall(r"```python\n(.*?)```", text.read(), re.S) if "state_hash" in block)
    scope = {}
    exec(code, scope)
    with h5py.File(path) as file:
        assert scope["state_hash"](file) == expected, path


def assert_diff(programs, run, reference):
    """The lines of the report, to the last digit; and its JSON. Returns the judge's table."""
    table = judge.judge_diff(programs.path(run), programs.path(reference))
    expected = judge.diff_text(table)
    for whose, path in (("run", run), ("reference", reference)):
        expected += judge.diff_text(judge.judge_constraints(programs.path(path)), f"constraints of the {whose}:")
    text = programs.run("pbreport", "diff", run, reference)
    lines = [line for line in text.splitlines() if line.startswith(("drift:", "constraints")) and "rms" in line]
    assert lines == expected, "\n".join(["pbreport:", *lines, "judge:", *expected])
    numbers = json.loads(programs.run("pbreport", "diff", run, reference, "--json"))
    for name, summary in table.items():
        for part in ("drift_by_frame", "drift_by_actor"):
            rows = [next(errors for kind, errors in row.items() if kind.startswith(name)) for row in numbers[part]]
            assert np.array_equal(np.sum([row["bands"] for row in rows], axis=0), summary["bands"]), (part, name)
            for what in ("broken", "count"):
                assert sum(row[what] for row in rows) == summary[what], (part, name)
    return table


def judge_scenes(programs, schema):
    """Returns how many joints were broken in one of two runs."""
    broken = 0
    for scene in SCENES:
        summary = programs.record("a.h5", "--scene", scene)
        assert_run(programs.path("a.h5"), summary)
        assert_schema_hash(schema, programs.path("a.h5"), summary["state_hash"])
        assert_run(programs.path("b.h5"), programs.record("b.h5", "--scene", scene, *COARSE))
        table = assert_diff(programs, "b.h5", "a.h5")
        counts = {name: summary["count"] for name, summary in table.items()}
        assert counts["joint_position"] == counts["joint_orientation"] and counts["body_position"] == counts["body_orientation"]
        broken += table["joint_position"]["broken"]
    return broken


def judge_sleepers(programs, schema):
    """Bodies that sleep, a field of interest, spaces: what a warm start remembers of sleepers is in the hash."""
    options = ("--scene", "Environ", "--frames", 40, "--effects", "+sleeping,+field_of_interest,+drag")
    summary = programs.record("asleep.h5", *options)
    assert_run(programs.path("asleep.h5"), summary)
    assert_schema_hash(schema, programs.path("asleep.h5"), summary["state_hash"])


def judge_study(programs):
    programs.run("pbstudy", "accuracy", "--scene", "CrashSk", "--iterations", 1, 4, "--substeps", 1, 2, "--repeats", 2,
                 "--nature-steps", 96, "--rest-seconds", 0, "--output", "study.h5")
    times = [point[0] for point in judge.judge_study(programs.path("study.h5"), 1)["CrashSk"]["front"]]
    assert len(times) > 1, "a front of one point would show little"
    for budget_s in (0.5 * min(times), 0.5 * (times[0] + times[-1]), 2 * max(times)):
        mine = judge.judge_study(programs.path("study.h5"), budget_s)["CrashSk"]
        (said,) = json.loads(programs.run("pbreport", "study.h5", "--budget", f"{1e6 * budget_s:.6f}us", "--json"))["scenes"]
        points = [[one["frame_time_s"]["worst"], one["error_m"]] for one in said["front"]]
        assert points == mine["front"], (points, mine["front"])
        assert said["uncertainty_m"] == mine["uncertainty"] > 0, (said["uncertainty_m"], mine["uncertainty"])
        assert np.allclose(list(said["determined"].values()), mine["determined"], rtol=1e-12), (said["determined"], mine["determined"])
        chosen = said.get("chosen")
        assert (chosen and [chosen["frame_time_s"]["worst"], chosen["error_m"]]) == mine["chosen"], budget_s


def main():
    with tempfile.TemporaryDirectory() as scratch:
        programs = Programs(sys.argv[1], scratch)
        assert judge_scenes(programs, sys.argv[2]) > 0, "a class without an entry is not checked"
        judge_sleepers(programs, sys.argv[2])
        judge_study(programs)


if __name__ == "__main__":
    main()
