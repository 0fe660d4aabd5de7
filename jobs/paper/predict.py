#!/usr/bin/env python3
"""Measures what value prediction gains a frame of pbmpi, and what it does to its result: runs under the Valgrind tool pbvalue (docs/research/prediction.md).

The results of instructions are predicted, exactly (EVP) and within a threshold (FVP), and those that are near go on into the simulation. Counts hits,
instructions and the cycles of the paper's processor, and compares the result with the unpredicted run. Needs h5py, and the built pbmpi (PBMPI_BIN,
default build/release/bin). A case that has ended is kept beside the file until all have."""
import argparse
import contextlib
import datetime
import json
import multiprocessing
import pathlib
import shlex
import sys
import tempfile

sys.path.insert(1, str(pathlib.Path(__file__).resolve().parents[2] / "src/app"))  # the package reports

from reports.command_line import quantity  # noqa: E402
from reports.files import STUDY, BadInput, WriteError, require  # noqa: E402
from reports.words import plural  # noqa: E402

import runs  # noqa: E402
from study import cases, child, table_file  # noqa: E402
from study import runs as case_runs  # noqa: E402
from study import tables as case_tables  # noqa: E402
from suite import SCENES  # noqa: E402

TOOL = runs.BIN.parent / "lib/pbvalue"
VERSION = (1, 8)  # of the files of studies (io/SCHEMA.md)
MOST_WORLDS = 10  # 100CrSk has a hundred worlds that differ little; the default form takes ten of them


def parser():
    """Of the command line."""
    found = argparse.ArgumentParser(prog="predict.py", description=__doc__.partition("\n")[0], allow_abbrev=False)
    found.add_argument("--scene", nargs="+", default=SCENES, metavar="NAME|FILE", help="default: all nine")
    found.add_argument("--threshold", nargs="+", type=float, default=[1e-6, 1e-8, 1e-10, 1e-12], metavar="X",
                       help="thresholds of fuzzy prediction; the first is that of Figure 8; default: 1e-6 1e-8 1e-10 1e-12")
    found.add_argument("--detail-scene", default="CrashSk", metavar="NAME|none", help="the scene of the sensitivity table and of collision and forward "
                       "step alone, if it is among the scenes; default: CrashSk")
    found.add_argument("--full", action="store_true", help="all worlds of 100CrSk (default: 10 of 100), and cycles of all thresholds, of sor and of "
                       "quick in single precision")
    found.add_argument("--replicas", type=int, metavar="N", help="worlds of a case; default: the scene's, at most 10")
    found.add_argument("--frames", type=int, metavar="N", help="measured frames; default: the scene's")
    found.add_argument("--warmup", type=int, metavar="N", help="frames before them, without cycles; default: the scene's")
    found.add_argument("--seed", type=int, default=1, metavar="N", help="of the scene's variation and of the solver; default: 1")
    found.add_argument("--budget", metavar="TIME", help="the time that a frame may take, e.g. 3.33ms; default: a tenth of 1/30 s")
    found.add_argument("--tool-option", action="append", default=[], metavar="WORD", help="for pbvalue, e.g. --tool-option=--table-entries=0")
    found.add_argument("--time-limit", default="30min", metavar="TIME", help="a run that takes longer has not ended; default: 30min")
    found.add_argument("-j", "--jobs", type=int, default=1, metavar="N", help="cases that run at a time; default: 1")
    found.add_argument("-o", "--output", default="prediction.h5", metavar="FILE", help="HDF5 file of the study (io/SCHEMA.md); default: prediction.h5")
    found.add_argument("--resume", action="store_true", help="leave out the cases that a study of the same options and build has done before it ended")
    found.add_argument("--quiet", action="store_true", help="print nothing but errors")
    return found


def require_possible(options):
    for threshold in options.threshold:
        require(0 < threshold < float("inf"), f"--threshold {threshold:g}: it must be above 0")
    require(options.jobs >= 1, f"--jobs {options.jobs}: it must be at least 1")
    options.budget_s = quantity(options.budget, "time", "--budget") if options.budget else runs.BUDGET_S
    options.time_limit_s = quantity(options.time_limit, "time", "--time-limit")
    require((TOOL / "pbvalue-amd64-linux").exists(), f"this build has no Valgrind tool pbvalue ({TOOL}); install Debian's valgrind, and configure and "
                                                     "build again")
    require((TOOL / "default.supp").exists(), f"Valgrind is not installed, and pbvalue needs it ({TOOL}/default.supp leads nowhere); install Debian's "
                                              "valgrind")
    table_file.require_replaceable(options.output, STUDY)


def recorded_run(given, options, folder):
    """A run of the scene as it is: what it has, and the build's versions, are in its file."""
    words = [f"--{name}={value}" for name in ("replicas", "frames", "warmup") if (value := getattr(options, name)) is not None]
    name = pathlib.Path(folder, "scene")
    run = child.run([str(runs.BIN / "pbmpi"), "--scene", given, "--stepper", "quick", "--seed", str(options.seed), "--no-xdmf", "--progress", "never",
                     "--quiet", "--output", f"{name}.h5", *words], name, options.time_limit_s)
    require(run.exit_code == 0, run.errors.strip().removeprefix("pbmpi: "))
    return runs.Run(f"{name}.h5")


def scene_of(run, given, options):
    """What the cases of a scene share."""
    iterations = int(run.number("iterations"))
    require(iterations > 1, f"{run.scene}: one iteration has none below it")
    worlds = run.num_worlds if options.full or options.replicas else min(run.num_worlds, MOST_WORLDS)
    return {"name": run.scene, "given": given, "worlds": worlds, "warmup": int(run.number("warmup")), "frames": int(run.number("frames")),
            "steps_per_frame": int(run.number("steps_per_frame")), "iterations": iterations, "bodies": run.num_bodies // run.num_worlds,
            "in_detail": run.scene == options.detail_scene}


def plan_of(options):
    """(scenes, parameters of the file, attributes of its root)"""
    scenes, texts, run = [], {}, None
    for given in options.scene:
        with tempfile.TemporaryDirectory() as folder:
            run = recorded_run(given, options, folder)
        require(run.scene not in [scene["name"] for scene in scenes], f"--scene {given}: the study has a scene {run.scene} already; name it once")
        scenes.append(scene_of(run, given, options))
        texts[f"scene_text_{run.scene.replace('/', '.')}"] = run.parameter("scene_text")
    libraries = {name: text for name, text in run.parameters.items() if name == "library_ode"}
    parameters = {"seed": options.seed, "repeats": 1, "ranks": options.jobs, "floor_seeds": 0, "build": run.parameter("build"),
                  "budget_s": options.budget_s, "figure_threshold": options.threshold[0]} | libraries | texts
    return scenes, parameters, {name: run.attributes[name] for name in ("pbmpi_version", "git_revision")}


class Kept:
    """The outcomes of cases, a line each, in a file beside the study's. They belong to what `key` names."""

    def __init__(self, output, key, resumes):
        self.path, self.outcomes = pathlib.Path(f"{output}.cases"), {}
        head = json.dumps(key)
        if resumes and self.path.exists():
            first, *lines = self.path.read_text(encoding="utf-8").splitlines()
            require(first == head, f"{self.path}: it holds cases of another study (other options, scenes or another build); remove it, or leave "
                                   "--resume out")
            for line in lines:
                with contextlib.suppress(ValueError):  # of a line that a kill cut off
                    index, rows = json.loads(line)
                    self.outcomes[index] = rows
        self.path.write_text("".join(f"{line}\n" for line in (head, *map(json.dumps, self.outcomes.items()))), encoding="utf-8")

    def add(self, index, rows):
        self.outcomes[index] = rows
        with open(self.path, "a", encoding="utf-8") as file:
            file.write(json.dumps([index, rows]) + "\n")


class Worker:
    """A process that runs cases. `folder`: what its runs leave for later ones."""
    folder = None

    @staticmethod
    def start(parent):
        child.end_with_parent()
        Worker.folder = pathlib.Path(tempfile.mkdtemp(dir=parent))

    @staticmethod
    def rows(request):
        """(index, {table: rows}) of a case, or instead of the rows the message of a run that ended as none should."""
        try:
            return request["index"], case_tables.rows(request, case_runs.run_case(request, Worker.folder))
        except child.RunError as error:
            return request["index"], f"{request['scene']['name']}, {request['case']['name']}{error}"


def run_cases(requests, kept, options):
    """Scene by scene, the dearest first. Raises child.RunError for a run that ended as none should."""
    left = [one for one in requests if one["index"] not in kept.outcomes]
    left.sort(key=lambda one: (one["case"]["scene"], -one["case"]["cost"]))
    with tempfile.TemporaryDirectory(prefix="pbmpi-prediction-") as folder, multiprocessing.Pool(options.jobs, Worker.start, [folder]) as pool:
        for index, rows in pool.imap_unordered(Worker.rows, left):
            if isinstance(rows, str):
                raise child.RunError(rows)
            kept.add(index, rows)
            if not options.quiet:
                one = requests[index]
                print(f"predict.py: {one['scene']['name']}, {one['case']['name']}; {len(kept.outcomes)} of {len(requests)} cases done", file=sys.stderr)


def measure(options):
    scenes, parameters, attributes = plan_of(options)
    has_single = (runs.BIN / cases.ODE_SINGLE).exists()
    settings = {"thresholds": options.threshold, "tool_options": options.tool_option, "time_limit_s": options.time_limit_s, "seed": options.seed,
                "full": options.full}
    requests = [{"programs": str(runs.BIN), "tool": str(TOOL), "options": settings, "scene": scenes[case["scene"]], "case": case, "index": index}
                for index, case in enumerate(cases.cases_of(scenes, settings, has_single))]
    created = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    decides = {name: value for name, value in parameters.items() if name != "ranks"}
    kept = Kept(options.output, {"requests": requests, "parameters": decides} | attributes, options.resume)
    run_cases(requests, kept, options)
    columns = case_tables.columns([kept.outcomes[index] for index in range(len(requests))])
    attributes |= {"study": "prediction", "created": created, "command_line": shlex.join(["predict.py", *sys.argv[1:]])}
    table_file.write_tables(options.output, STUDY, VERSION, attributes, parameters, columns)
    kept.path.unlink()
    if not options.quiet:
        note = "" if has_single else f"no runs of quick in single precision: this build has no {cases.ODE_SINGLE} (jobs/ode_single.sh)\n"
        print(f"{len(requests)} cases of {plural(len(scenes), 'scene')} in {options.output}\n{note}next: jobs/paper/paper.py prediction "
              f"{options.output} --html prediction.html")


def main():
    options = parser().parse_args()
    try:
        require_possible(options)
        measure(options)
    except BadInput as error:
        print(f"predict.py: {error}", file=sys.stderr)
        return 2
    except (WriteError, child.RunError) as error:
        print(f"predict.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
