"""Starts the built programs, and writes tables in Markdown."""
import csv
import datetime
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("PBMPI_BIN", SOURCE / "build/release/bin")).resolve()
BENCH = BIN.parent / "tests/bench/bench_worlds"
SCENES = ("2-Cars", "10-Cars", "CrashSk", "CrashWa", "Environ", "100CrSk", "Battle", "Fight", "Battle2")
EFFECT_SCENES = ("Bowling", "Feathers", "Stadium", "Warehouse")

# Open MPI refuses root, and more ranks than cores, unless told otherwise.
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1", "PBMPI_BIN": str(BIN)}


class Folder(tempfile.TemporaryDirectory):
    """An empty folder for the files of one table, removed afterwards."""

    def __init__(self):
        super().__init__(prefix="pbmpi-figures-")

    def __enter__(self):
        return pathlib.Path(super().__enter__())


def run(command, **options):
    """What the command prints; ends this program with the command's message if it fails."""
    command = [str(word) for word in command]
    result = subprocess.run(command, capture_output=True, text=True, check=False, env=ENVIRONMENT, **options)
    if result.returncode != 0:
        raise SystemExit(f"figures.py: {' '.join(command)}: exit code {result.returncode}\n{result.stderr}")
    return result.stdout


def pbmpi(*options):
    return run([BIN / "pbmpi", *options])


def summary(*options):
    """The summary of a run, as `pbmpi --report json` prints it."""
    return json.loads(pbmpi(*options, "--no-output", "--report", "json"))


def pbreport(*options):
    return run([BIN / "pbreport", *options])


def paper(*options):
    """What jobs/paper/paper.py prints of the built programs' files."""
    return run([sys.executable, SOURCE / "jobs/paper/paper.py", *options])


def predict(*options):
    """Makes a study of value prediction."""
    run([sys.executable, SOURCE / "jobs/paper/predict.py", *options, "--quiet"])


def study(kind, folder, scenes, *options):
    """The file of `pbstudy KIND`."""
    path = folder / f"{kind}.h5"
    run([BIN / "pbstudy", kind, "--scene", *scenes, *options, "--progress", "never", "--quiet", "-o", path])
    return path


def accuracy_cases(folder, scenes, *options):
    """The cases of `pbstudy accuracy`, by nature alone, as rows of {column: text or number}, and {scene: what `pbreport --json` says of it}."""
    path = study("accuracy", folder, scenes, "--own-iterations", "0", *options)
    table = folder / "accuracy.csv"
    found = json.loads(pbreport(path, "--json", "--csv", table))["scenes"]
    with open(table, encoding="utf-8", newline="") as file:
        cases = [{name: number_or_text(value) for name, value in row.items()} for row in csv.DictReader(file)]
    return cases, {one["scene"]: one for one in found}


def number_or_text(text):
    try:
        return float(text)
    except ValueError:
        return text


def table(head, rows):
    """A table in Markdown, as lines."""
    return [f"| {' | '.join(map(str, cells))} |" for cells in (head, ["---"] * len(head), *rows)]


def digits(value, count=2):
    """A number with so many significant digits, without an exponent: 0.00123, 12, 3600."""
    if value == 0:
        return "0"
    rounded = float(f"{value:.{count - 1}e}")
    decimals = max(0, count - 1 - int(f"{rounded:e}".split("e")[1]))
    return f"{rounded:,.{decimals}f}"


def millimetres(metres, count=2):
    """Without unit; below a micrometre only that; "-" for None and what is not finite."""
    if metres is None or not math.isfinite(metres):
        return "-"
    return digits(1e3 * metres, count) if abs(metres) >= 1e-6 else "< 0.001"


def has_ode_law(case):
    return case["stepper"] == "sor" and case["law"] == "ode"


def setting_name(case):
    """As the pages call a setting: `quick`, 1 x 20; `sor` single, 14 x 1; `sor` single, 1 x 20, law ode."""
    kind = "`quick`" if case["stepper"] == "quick" else f"`sor` {case['precision']}"
    return f"{kind}, {case['substeps']:.0f} x {case['iterations']:.0f}{', law ode' if has_ode_law(case) else ''}"


def revision():
    """The revision that the programs were built from."""
    return re.search(r"\((\w+)", pbmpi("--version"))[1][:7]


def machine():
    """Cores, model of the processor, and the instruction set that `sor` uses on it."""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        model = re.search(r"^model name\s*: (.*)$", file.read(), re.MULTILINE)
    simd = summary("--scene", "CrashSk", "--frames", 1)["simd"]
    return f"{os.cpu_count()} cores, {model[1].strip() if model else os.uname().machine}, {simd}"


def today():
    return datetime.date.today().isoformat()
