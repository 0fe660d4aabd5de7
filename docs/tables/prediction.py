"""Tables of value prediction: `jobs/paper/predict.py`, its default form, and a small one whose figures have no clock."""
import functools
import json
import os
import pathlib

from tables import programs

# A study that is there already, for a writer who has just run it: the default form takes up to 20 minutes.
STUDY = "PBMPI_PREDICTION_STUDY"


@functools.cache
def default_form():
    """What `jobs/paper/paper.py prediction --json` says of the default form."""
    with programs.Folder() as folder:
        given = os.environ.get(STUDY)
        path = pathlib.Path(given) if given else folder / "prediction.h5"
        if not given:
            programs.predict("--jobs", 2, "-o", path)
        return json.loads(programs.paper("prediction", path, "--json"))


def per_cent(share, count=1):
    return "-" if share is None else f"{100 * share:.{count}f} %"


def bars():
    """Figure 8: frames a second on the modelled processor."""
    rows, names = [], []
    for scene in default_form()["scenes"]:
        names = list(scene["figure_8"])
        form = f"{scene['worlds']} x {scene['warmup']} + {scene['frames']}"
        cells = [programs.digits(bar["hz"], 3) if bar["hz"] else "-" for bar in scene["figure_8"].values()]
        rows.append([scene["scene"], form, *cells])
    return programs.table(["scene", "worlds x frames", *names], rows)


def engines():
    """Shares of floating-point results that are predicted right, exactly and within 1e-6, by engine."""
    rows = []
    for scene in default_form()["scenes"]:
        for engine, hits in scene["engines"].items():
            rows.append([scene["scene"], engine, per_cent(hits["exact"]["coverage"]), per_cent(hits["exact"]["hit_rate"]),
                         per_cent(hits["fuzzy"]["coverage"]), per_cent(hits["fuzzy"]["hit_rate"])])
    return programs.table(["scene", "engine", "exact: of all results", "of those guessed", "1e-6: of all results", "of those guessed"], rows)


def drift(metres):
    """A kilometre from where it should be nothing is left to measure, though the numbers are finite."""
    return "> 1 km" if metres > 1000 else programs.millimetres(metres)


def errors():
    """Drift of positions by threshold, beside the noise floor, and what blew up."""
    rows = []
    for scene in default_form()["scenes"]:
        runs = {run["name"]: run for run in scene["cases"]}
        cells = []
        for name in ("FVP6", "FVP8", "FVP10", "FVP12", "sor FVP6", "single FVP6"):
            run = runs.get(name)
            lost = run is not None and (not run["ended"] or run["nonfinite_frame"] is not None)
            cells.append("-" if run is None else "lost" if lost else drift(run["drift_m"]["rms"]))
        rows.append([scene["scene"], programs.millimetres(runs["FVP6"]["noise_floor_m"]["rms"]), *cells])
    return programs.table(["scene", "noise floor [mm]", "FVP6", "FVP8", "FVP10", "FVP12", "`sor` FVP6", "single FVP6"], rows)


def statements():
    rows = [[one["statement"], one["finding"], one["number"]] for one in default_form()["statements"]]
    return programs.table(["statement", "finding", "number"], rows)


def small():
    """Hits of 2-Cars by threshold: the same in each run."""
    with programs.Folder() as folder:
        path = folder / "prediction.h5"
        programs.predict("--scene", "2-Cars", "--detail-scene", "none", "-o", path)
        scene = json.loads(programs.paper("prediction", path, "--json"))["scenes"][0]
    rows = []
    for run in scene["cases"]:
        if run["stepper"] != "quick" or run["precision"] != "double" or "FEEC" in run["name"]:
            continue
        loads, operations = run["loads"], run["operations"]
        rows.append([run["name"], f"{run['instructions_per_frame'] / 1e6:.2f}", per_cent(loads["coverage"], 2), per_cent(loads["hit_rate"], 2),
                     per_cent(operations["coverage"], 2), per_cent(operations["hit_rate"], 2)])
    return programs.table(["case", "million instructions a frame", "loads: of all", "of those guessed", "arithmetic: of all", "of those guessed"], rows)
