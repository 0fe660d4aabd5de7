#!/usr/bin/env python3
"""Writes the tables of figures in the documents: what stands between `<!-- figures: NAME -->` and `<!-- end figures -->`.

Usage: docs/figures.py [--check | --without-clock] [NAME ...], after jobs/build.sh (PBMPI_BIN: another folder of the programs);
default: all tables, or all without a clock. Below each table stand its commands, the revision and, of a table with a clock, the machine and the day. --check
recomputes the tables without a clock, and fails with the names of those that differ from their page.
"""
import argparse
import collections
import os
import re
import sys

from tables import accuracy, effects, engines, engines_speed, exact, guards, paper, prediction, programs, scaling, scenes, siconos, speed, stability

# page: below the root. make: computes the lines of the table. has_clock: whether times are among its figures. commands: for
# a reader who wants to measure it by hand.
Entry = collections.namedtuple("Entry", "page make has_clock commands")

ENTRIES = {
    "islands": Entry("docs/scenes.md", scenes.islands, False,
                     ["pbmpi --scene SCENE --stepper quick", "jobs/paper/paper.py islands SCENE.h5"]),
    "plans": Entry("docs/effects.md", scenes.plans, False, ["pbmpi --scene SCENE --describe"]),
    "effects": Entry("docs/effects.md", effects.costs, True,
                     ["pbstudy effects --stepper sor --repeats 5", "pbreport effects.h5 --markdown"]),
    "saved": Entry("docs/effects.md", effects.saved, False, ["pbmpi --scene SCENE --effects +EFFECT", "pbmpi --scene SCENE --effects -EFFECT"]),
    "interest": Entry("docs/effects.md", effects.interest, True, ["tests/bench/interest.py 5"]),
    "nature": Entry("docs/accuracy.md", accuracy.nature, False,
                    ["pbstudy accuracy --stepper quick --iterations 20 --dt 0.01 --estimates 0 --own-iterations 0"]),
    "sensitivity": Entry("docs/accuracy.md", accuracy.sensitivity, False, ["docs/figures.py sensitivity"]),
    "front": Entry("docs/accuracy.md", accuracy.front, True,
                   ["pbstudy accuracy --stepper quick sor --law soft --precision double --iterations 5 20 80 --repeats 3"]),
    "held": Entry("docs/accuracy.md", accuracy.held, False, ["pbstudy stability --setting SETTING..."]),
    "fine": Entry("docs/accuracy.md", accuracy.fine, True,
                  [f"pbstudy accuracy --stepper sor --law soft --precision double --substeps 14 --dt 0.01 --approach 0 {accuracy.FINE}"]),
    "estimates": Entry("docs/accuracy.md", accuracy.estimates, False,
                       ["pbstudy accuracy --scene CrashSk CrashWa Fight --precision double --iterations 20 --substeps 1 14 --dt 0.01"]),
    "substeps": Entry("docs/accuracy.md", accuracy.substeps, False, ["bench_worlds --substeps 100CrSk 0 8",
                                                                     "bench_worlds --substeps 100CrSk 0 100"]),
    "exact": Entry("docs/accuracy.md", exact.table, False, ["docs/tables/exact.py"]),
    "hard_map": Entry("docs/stability.md", stability.hard_map, False, ["pbstudy stability",
                                                                       "pbreport stability.h5 --markdown"]),
    "joint_springs": Entry("docs/stability.md", stability.joint_springs, False,
                           ["pbstudy stability --setting sor \"sor iterations=16\" \"sor substeps=8\" ..."]),
    "by_step": Entry("docs/stability.md", stability.by_step, False, ["pbstudy stability --setting quick sor --dt 0.0001 ... 0.05"]),
    "island_shares": Entry("docs/stability.md", stability.island_shares, False,
                           ["pbstudy stability --most-work 300000 --setting sor \"sor tolerance=0.01mm\" ...",
                            "pbmpi --scene SCENE --warmup 150 --frames 10 --tolerance 0.01mm"]),
    "quiet": Entry("docs/stability.md", stability.quiet, True, ["bench_worlds --quiet SCENE SECONDS 10"]),
    "at_equal_time": Entry("docs/stability.md", stability.at_equal_time, True,
                           ["pbstudy stability --most-work 300000 --setting quick \"sor substeps=20\" ..."]),
    "guards": Entry("docs/guards.md", guards.guards, False, ["pbmpi --scene CASE --steps-per-frame 3 --stepper ..."]),
    "speed": Entry("docs/speed.md", speed.against_bare, True,
                   ["bench_worlds SCENE 0 10 3", "pbstudy accuracy --scene SCENE"]),
    "prediction_small": Entry("docs/prediction.md", prediction.small, False,
                              ["jobs/paper/predict.py --scene 2-Cars --detail-scene none"]),
    "prediction_bars": Entry("docs/prediction.md", prediction.bars, True, ["jobs/paper/predict.py --jobs 2"]),
    "prediction_engines": Entry("docs/prediction.md", prediction.engines, True, ["jobs/paper/predict.py --jobs 2"]),
    "prediction_errors": Entry("docs/prediction.md", prediction.errors, True, ["jobs/paper/predict.py --jobs 2"]),
    "prediction_statements": Entry("docs/prediction.md", prediction.statements, True, ["jobs/paper/predict.py --jobs 2"]),
    "paper_counts": Entry("docs/paper.md", paper.counts, False, ["jobs/paper.sh --without-clock"]),
    "paper_clock": Entry("docs/paper.md", paper.clock, True, ["jobs/paper.sh"]),
    "paper_instructions": Entry("docs/paper.md", paper.instructions, True, ["jobs/paper.sh"]),
    "paper_prediction": Entry("docs/paper.md", paper.prediction, True, ["jobs/paper.sh --prediction"]),
    "paper_nothing": Entry("docs/paper.md", paper.nothing, False, ["jobs/paper.sh --without-clock"]),
    "engines_fronts": Entry("docs/engines.md", engines.fronts, True,
                            ["pbstudy accuracy --stepper quick direct sor bullet mujoco ...", "pbreport engines accuracy.h5"]),
    "engines_own": Entry("docs/engines.md", engines.own, False,
                         ["pbstudy accuracy --stepper quick direct sor bullet mujoco ...", "pbreport engines accuracy.h5"]),
    "engines_map": Entry("docs/engines.md", engines.hard_map, False,
                         [f"pbstudy stability --most-work {engines.MOST_WORK} --setting {' '.join(engines.MAP)}", "pbreport engines stability.h5"]),
    "engines_can": Entry("docs/engines.md", engines.can, False, ["pbreport engines accuracy.h5 stability.h5"]),
    "siconos_residuals": Entry("docs/siconos.md", siconos.residuals, True, ["jobs/siconos.sh"]),
    "siconos_counts": Entry("docs/siconos.md", siconos.counts, True, ["jobs/siconos.sh"]),
    "siconos_above": Entry("docs/siconos.md", siconos.above, True, ["jobs/siconos.sh"]),
    "scaling": Entry("docs/scaling.md", scaling.scaling, True, [scaling.command(scaling.USUAL)]),
    "scaling_long": Entry("docs/scaling.md", scaling.scaling_long, True, [scaling.command(scaling.LONG)]),
    "forecast_traffic": Entry("docs/scaling.md", scaling.forecast_traffic, False,
                              ["mpirun -n 2 pbstudy calibrate", "pbreport calibrate.h5 --worlds 10000 1000000"]),
    "forecast_times": Entry("docs/scaling.md", scaling.forecast_times, True,
                            [f"mpirun -n 2 pbstudy calibrate --largest-ranks {scaling.LARGEST_RANKS}", "pbreport calibrate.h5"]),
    "engines_speed": Entry("docs/engines.md", engines_speed.speed, True, ["tests/bench/engines/engines.py --markdown"]),
    "engines_equal_gap": Entry("docs/engines.md", engines_speed.equal_gap, True, ["tests/bench/engines/engines.py --markdown"]),
    "spaces": Entry("docs/spaces.md", speed.spaces, True, ["tests/bench/decompose.py 3"]),
}


def block(name):
    """The pattern of a table's place: its opening marker, what stands between, its closing marker."""
    return re.compile(rf"(<!-- figures: {name} -->\n)(.*?)(<!-- end figures -->)", re.DOTALL)


def written(name):
    """The lines of the table as the page has it."""
    found = block(name).search((programs.SOURCE / ENTRIES[name].page).read_text(encoding="utf-8"))
    if not found:
        sys.exit(f"figures.py: {ENTRIES[name].page} has no place for '{name}'; write <!-- figures: {name} --> and "
                 "<!-- end figures --> there, on a line each")
    return [line for line in found[2].splitlines() if line.startswith("|")]


def caption(entry, busy):
    """`busy`: the load of the machine before the table was made."""
    commands = ", ".join(f"`{command}`" for command in entry.commands)
    if not entry.has_clock:
        return f"*{commands}; revision {programs.revision()}.*"
    return (f"*{commands}; revision {programs.revision()}, {programs.machine()}, {programs.today()}, "
            f"load of the machine {busy:.1f}.*")


def write(name):
    entry = ENTRIES[name]
    busy = os.getloadavg()[0]
    lines = entry.make()
    if not entry.has_clock and lines == written(name):
        return
    path = programs.SOURCE / entry.page
    text = "\n".join([*lines, "", caption(entry, busy)]) + "\n"
    page = path.read_text(encoding="utf-8")
    path.write_text(block(name).sub(lambda found: found[1] + text + found[3], page), encoding="utf-8")


def differs(name):
    """Whether the page has another table than the programs give now; shows the lines."""
    old, new = written(name), ENTRIES[name].make()
    if old == new:
        return False
    print(f"{ENTRIES[name].page}: table '{name}' differs; run docs/figures.py {name}")
    for line in old:
        if line not in new:
            print(f"- {line}")
    for line in new:
        if line not in old:
            print(f"+ {line}")
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--without-clock", action="store_true")
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(ENTRIES))
    arguments = parser.parse_args()
    unknown = [name for name in arguments.names if name not in ENTRIES]
    if unknown:
        parser.error(f"no table {', '.join(unknown)}; known: {', '.join(ENTRIES)}")
    names = arguments.names or list(ENTRIES)
    if arguments.check or arguments.without_clock:
        names = [name for name in names if not ENTRIES[name].has_clock]
    if arguments.check:
        return int(any([differs(name) for name in names]))
    for name in names:
        print(name, flush=True)
        write(name)
    return 0


if __name__ == "__main__":
    sys.exit(main())
