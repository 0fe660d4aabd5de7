"""What docs/figures.py writes: the tables, each with its page and the programs that compute it, and the diagrams that are drawn of tables."""
import collections

from tables import (accuracy, bars, choices, effects, engines, engines_speed, exact, fronts, guards, kept, maps, paper, prediction, programs, scaling,
                    scenes, schemes, siconos, speed, stability)

# page: below the root. make: computes the lines of the table. has_clock: whether times are among its figures. commands: for
# a reader who wants to measure it by hand.
Entry = collections.namedtuple("Entry", "page make has_clock commands")

ENTRIES = {
    "islands": Entry("docs/scenes.md", scenes.islands, False,
                     ["pbmpi --scene SCENE --stepper quick", "jobs/paper/paper.py islands SCENE.h5"]),
    "plans": Entry(f"{kept.LONG}plans.md", scenes.plans, False, ["pbmpi --scene SCENE --describe"]),
    "effects": Entry(f"{kept.LONG}effects.md", effects.costs, True,
                     ["pbstudy effects --stepper sor --repeats 5", "pbreport effects.h5 --markdown"]),
    "saved": Entry("docs/effects.md", effects.saved, False, ["pbmpi --scene SCENE --effects +EFFECT", "pbmpi --scene SCENE --effects -EFFECT"]),
    "interest": Entry("docs/effects.md", effects.interest, True, ["tests/bench/interest.py 5"]),
    "nature": Entry("docs/accuracy.md", accuracy.nature, False,
                    ["pbstudy accuracy --stepper quick --iterations 20 --dt 0.01 --estimates 0 --own-iterations 0"]),
    "sensitivity": Entry("docs/accuracy.md", accuracy.sensitivity, False, ["docs/figures.py sensitivity"]),
    "front": Entry(f"{kept.LONG}front.md", accuracy.front, True,
                   ["pbstudy accuracy --stepper quick sor --law soft --precision double --iterations 5 20 80 --approach 0 --repeats 3"]),
    "held": Entry("docs/accuracy.md", accuracy.held, False, ["pbstudy stability --setting SETTING..."]),
    "fine": Entry("docs/accuracy.md", accuracy.fine, True,
                  ["pbstudy accuracy --stepper sor --law soft --precision double --substeps 14 --dt 0.01 --approach 0 10cm 2cm"]),
    "estimates": Entry(f"{kept.LONG}estimates.md", accuracy.estimates, False,
                       ["pbstudy accuracy --scene CrashSk CrashWa Fight --precision double --iterations 20 --substeps 1 14 --dt 0.01"]),
    "substeps": Entry(f"{kept.LONG}substeps.md", accuracy.substeps, False, ["bench_worlds --substeps 100CrSk 0 8",
                                                                            "bench_worlds --substeps 100CrSk 0 100"]),
    "exact": Entry(f"{kept.LONG}exact.md", exact.table, False, ["docs/tables/exact.py"]),
    "hard_map": Entry(f"{kept.LONG}hard_map.md", stability.hard_map, False, ["pbstudy stability",
                                                                             "pbreport stability.h5 --markdown"]),
    "joint_springs": Entry("docs/stability.md", stability.joint_springs, False,
                           ["pbstudy stability --setting sor \"sor iterations=16\" \"sor substeps=8\" ..."]),
    "by_step": Entry(f"{kept.LONG}by_step.md", stability.by_step, False, ["pbstudy stability --setting quick sor --dt 0.0001 ... 0.05"]),
    "island_shares": Entry("docs/stability.md", stability.island_shares, False,
                           ["pbstudy stability --most-work 300000 --setting sor \"sor tolerance=0.01mm\" ...",
                            "pbmpi --scene SCENE --warmup 150 --frames 10 --tolerance 0.01mm"]),
    "quiet": Entry("docs/stability.md", stability.quiet, True, ["bench_worlds --quiet SCENE SECONDS 10"]),
    "at_equal_time": Entry(f"{kept.LONG}at_equal_time.md", stability.at_equal_time, True,
                           ["pbstudy stability --most-work 300000 --setting quick \"sor substeps=20\" ..."]),
    "guards": Entry(f"{kept.LONG}guards.md", guards.guards, False, ["pbmpi --scene CASE --steps-per-frame 3 --stepper ..."]),
    "speed": Entry(f"{kept.LONG}speed.md", speed.against_bare, True,
                   ["bench_worlds SCENE 0 10 3", "pbstudy accuracy --scene SCENE"]),
    "prediction_small": Entry("docs/research/prediction.md", prediction.small, False,
                              ["jobs/paper/predict.py --scene 2-Cars --detail-scene none"]),
    "prediction_bars": Entry("docs/research/prediction.md", prediction.bars, True, ["jobs/paper/predict.py --jobs 2"]),
    "prediction_engines": Entry("docs/research/prediction.md", prediction.engines, True, ["jobs/paper/predict.py --jobs 2"]),
    "prediction_errors": Entry("docs/research/prediction.md", prediction.errors, True, ["jobs/paper/predict.py --jobs 2"]),
    "prediction_statements": Entry("docs/research/prediction.md", prediction.statements, True, ["jobs/paper/predict.py --jobs 2"]),
    "paper_counts": Entry(f"{kept.LONG}paper_counts.md", paper.counts, False, ["jobs/paper.sh --without-clock"]),
    "paper_clock": Entry(f"{kept.LONG}paper_clock.md", paper.clock, True, ["jobs/paper.sh"]),
    "paper_instructions": Entry(f"{kept.LONG}paper_instructions.md", paper.instructions, True, ["jobs/paper.sh"]),
    "paper_prediction": Entry(f"{kept.LONG}paper_prediction.md", paper.prediction, True, ["jobs/paper.sh --prediction"]),
    "paper_nothing": Entry(f"{kept.LONG}paper_nothing.md", paper.nothing, False, ["jobs/paper.sh --without-clock"]),
    "choices": Entry("docs/settings.md", choices.table, False, ["docs/figures.py front held fine speed hard_map at_equal_time"]),
    "engines_fronts": Entry(f"{kept.LONG}engines_fronts.md", engines.fronts, True,
                            ["pbstudy accuracy --stepper quick direct sor bullet mujoco ...", "pbreport engines accuracy.h5"]),
    "engines_own": Entry(f"{kept.LONG}engines_own.md", engines.own, False,
                         ["pbstudy accuracy --stepper quick direct sor bullet mujoco ...", "pbreport engines accuracy.h5"]),
    "engines_map": Entry("docs/engines.md", engines.hard_map, False,
                         [f"pbstudy stability --most-work {engines.MOST_WORK} --setting {' '.join(engines.MAP)}", "pbreport engines stability.h5"]),
    "engines_cases": Entry(f"{kept.LONG}engines_cases.md", engines.cases, False,
                           [f"pbstudy stability --most-work {engines.MOST_WORK} --setting {' '.join(engines.MAP)}"]),
    "engines_can": Entry("docs/engines.md", engines.can, False, ["pbreport engines accuracy.h5 stability.h5"]),
    "siconos_residuals": Entry("docs/research/siconos.md", siconos.residuals, True, ["jobs/siconos.sh"]),
    "siconos_counts": Entry("docs/research/siconos.md", siconos.counts, True, ["jobs/siconos.sh"]),
    "siconos_above": Entry("docs/research/siconos.md", siconos.above, True, ["jobs/siconos.sh"]),
    "scaling": Entry(f"{kept.LONG}scaling.md", scaling.scaling, True, [scaling.command(scaling.USUAL)]),
    "scaling_long": Entry("docs/scaling.md", scaling.scaling_long, True, [scaling.command(scaling.LONG)]),
    "forecast_traffic": Entry(f"{kept.LONG}forecast_traffic.md", scaling.forecast_traffic, False,
                              ["mpirun -n 2 pbstudy calibrate", "pbreport calibrate.h5 --worlds 10000 1000000"]),
    "forecast_times": Entry(f"{kept.LONG}forecast_times.md", scaling.forecast_times, True,
                            [f"mpirun -n 2 pbstudy calibrate --largest-ranks {scaling.LARGEST_RANKS}", "pbreport calibrate.h5"]),
    "engines_speed": Entry(f"{kept.LONG}engines_speed.md", engines_speed.speed, True, ["tests/bench/engines/engines.py --markdown"]),
    "engines_equal_gap": Entry(f"{kept.LONG}engines_equal_gap.md", engines_speed.equal_gap, True, ["tests/bench/engines/engines.py --markdown"]),
    "spaces": Entry("docs/scaling.md", speed.spaces, True, ["tests/bench/decompose.py 3"]),
}

# draw: gives the SVG of the origin of the first table (revision, machine) and of the rows of all of them; of nothing where it rests on no table. tables:
# names of ENTRIES.
Diagram = collections.namedtuple("Diagram", "draw tables")

# In docs/images, as NAME.svg.
DIAGRAMS = {
    **{f"engines-{scene}": Diagram(fronts.engines(scene), ["engines_fronts"]) for scene in ("CrashSk", "CrashWa", "Fight")},
    "engines-cases": Diagram(maps.engines, ["engines_cases"]),
    "scaling": Diagram(bars.scaling, ["scaling"]),
    "forecast": Diagram(bars.forecast, ["forecast_times"]),
    "accuracy": Diagram(fronts.settings, ["front"]),
    "hard-cases": Diagram(maps.settings, ["hard_map"]),
    "substeps": Diagram(bars.substeps, ["substeps"]),
    "effects": Diagram(bars.effects, ["effects"]),
    "runs": Diagram(schemes.runs, []),
    "frame": Diagram(schemes.frame, []),
    "step": Diagram(schemes.substeps, []),
    "paper": Diagram(bars.paper, ["paper_counts", "paper_clock", "paper_instructions", "paper_prediction"]),
}


def diagram_file(name):
    return programs.SOURCE / "docs/images" / f"{name}.svg"


def drawn(name):
    """The SVG of a diagram, of the tables as they are kept."""
    diagram = DIAGRAMS[name]
    places = [(ENTRIES[table].page, table) for table in diagram.tables]
    origin = [kept.origin(*places[0])] if places else []
    return diagram.draw(*origin, *(kept.rows(*place) for place in places))
