#!/usr/bin/env python3
"""What the paper says beside what was measured: its statements with their verdicts, its figures and its tables.

"Enabling Real-Time Physics Simulation in Future Interactive Entertainment", Yeh, Faloutsos, Reinman 2006. Needs h5py and numpy, and
the built pbreport (PBMPI_BIN, default build/release/bin)."""
import argparse
import os
import pathlib
import sys

sys.path.insert(1, str(pathlib.Path(__file__).resolve().parents[2] / "src/app"))  # the package reports

from reports.document import Report  # noqa: E402
from reports.files import BadInput, WriteError, require  # noqa: E402
from reports.command_line import deliver  # noqa: E402

import data  # noqa: E402
import figures  # noqa: E402
import instructions  # noqa: E402
import islands  # noqa: E402
import pages  # noqa: E402
import prediction  # noqa: E402
import runs  # noqa: E402
import statements  # noqa: E402
import suite  # noqa: E402


def run_paper(options):
    found = data.read(options.file)
    deliver(pages.paper_page(statements.judged(found), found), options)


def run_figures(options):
    recorded = [runs.Run(path) for path in options.file]
    deliver(pages.figure8_9_page(figures.scenes_of(recorded), recorded), options)


def run_figure3(options):
    counts, recorded = instructions.read_counts(options.file[0]), [runs.Run(path) for path in options.file[1:]]
    works = [suite.work_of(run) for run in recorded]
    deliver(pages.figure3_page(counts, works, [instructions.source_of(options.file[0]), *recorded]), options)


def pictures_of(folder, scenes):
    """[(scene, PNG)] of a folder with SCENE.png."""
    try:
        return [(one.scene, pathlib.Path(folder, f"{one.scene}.png").read_bytes()) for one in scenes]
    except OSError as error:
        raise BadInput(f"{error.filename}: {error.strerror}; make it with jobs/stills.sh, or leave --stills out") from None


def run_figure6(options):
    require(options.html, "--html is missing; name the page to write")
    recorded = [runs.Run(path) for path in options.file]
    scenes = [suite.suite_of(run) for run in recorded]
    report = pages.figure6_page(scenes, pictures_of(options.stills, scenes) if options.stills else [], recorded)
    report.head = f"{options.html}\n"
    deliver(report, options)


def run_islands(options):
    deliver(islands.report_of([islands.islands_of(runs.runs.Run(path)) for path in options.file]), options)


def run_cores(options):
    scenes = [suite.suite_of(runs.Run(path)) for path in options.file]
    text = suite.CORES_HEAD + "".join(map(suite.cores_text, scenes))
    deliver(Report("", "", [], [suite.cores_json(one) for one in scenes], text), options)


def run_prediction(options):
    require(len(options.file) == 1, f"'{options.file[-1]}' follows '{options.file[0]}': give one study")
    study = prediction.read_study(options.file[0], options.scene)
    deliver(pages.prediction_page(study), options, study.file.tables["cases"])


# Name, function, what it shows, files, what the page shows (empty: it has none), has it --json and --markdown?
COMMANDS = (
    ("paper", run_paper, "every statement of the paper with its verdict", "files or folders of jobs/paper.sh",
     "verdicts, and Figures 3, 6, 8 and 9", True),
    ("figures", run_figures, "Figures 8 and 9: frame rates, satisfied frames, and errors against 20 iterations. Several files of one kind are "
                             "repeats, and the time of a frame is the least of them", "runs of jobs/figure8_9.sh", "both figures", False),
    ("figure3", run_figure3, "Figure 3: instructions of a frame. Where direct was not counted it is extrapolated by the rows of the islands of "
                             "a run of the scene with --record islands", "figure3.json of jobs/figure3.sh, then runs", "the figure", False),
    ("figure6", run_figure6, "one page of Figure 6 and Tables 1 and 2", "runs with --record islands on one rank", "the figure and both tables",
     False),
    ("islands", run_islands, "Table 1: islands at the end of each measured frame, over all worlds", "runs", "", False),
    ("cores", run_cores, "Table 2: the fewest cores on which the islands of a step, longest first, take no longer than the longest of them, "
                         "and the frame rate (share of frames within 3.33 ms) if islands, then also spaces, had a core each",
     "runs with --record islands on one rank", "", False),
    ("prediction", run_prediction, "what value prediction gains a frame and does to its result", "the file of predict.py",
     "the bars of Figure 8, hits, errors, and the verdicts", True),
)


def parser():
    """Of the command line."""
    program = argparse.ArgumentParser(prog="paper.py", description=__doc__)
    commands = program.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, run, shows, files, on_page, has_forms in COMMANDS:
        command = commands.add_parser(name, help=shows.partition(":")[0], description=f"Shows {shows}.")
        command.set_defaults(run=run, json=False, markdown=False, quiet=False)
        command.add_argument("file", nargs="*", metavar="FILE", help=files)
        forms = command.add_mutually_exclusive_group()
        if has_forms or name in ("islands", "cores"):
            forms.add_argument("--json", action="store_true", help="print one JSON document")
        if has_forms:
            forms.add_argument("--markdown", action="store_true", help="print tables in Markdown")
        if on_page:
            command.add_argument("--html", metavar="OUT", help=f"write one self-contained page: {on_page}")
            command.add_argument("--quiet", action="store_true", help="print nothing but errors")
        if name == "figure6":
            command.add_argument("--stills", metavar="DIR", help="folder with SCENE.png: a picture of each scene for the page")
        if name == "prediction":
            command.add_argument("--scene", nargs="+", default=[], metavar="NAME", help="these scenes of the study only")
            command.add_argument("--csv", metavar="OUT", help="write all cases as comma-separated values")
    return program


def main():
    options = parser().parse_args()
    try:
        require(options.file, f"{options.command}: no file given; see --help")
        options.run(options)
    except BadInput as error:
        print(f"paper.py: {error}", file=sys.stderr)
        return 2
    except WriteError as error:
        print(f"paper.py: {error}", file=sys.stderr)
        return 1
    except BrokenPipeError:  # of a reader such as head
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as error:
        print(f"paper.py: {error.strerror or error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
