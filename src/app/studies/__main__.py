"""python3 studies STEP FOLDER: one step of "pbstudy prediction", which calls it. STEP: cases, or run, which makes the runs of one case. FOLDER holds
request.json, the scenes as 0/NAME.toml ... and what the runs leave for later cases. The answer is printed as JSON; with exit code 1, why a run failed."""
import json
import pathlib
import sys

if __package__ in (None, ""):
    sys.path[0] = str(pathlib.Path(__file__).absolute().parents[1])

from studies import cases, child, runs, tables  # noqa: E402


def plan(request, _folder):
    """Cases, columns of the tables, and what to say at the end."""
    program = pathlib.Path(request["programs"], cases.ODE_SINGLE)
    planned = cases.cases_of(request["scenes"], request["options"], program.exists())
    note = "" if program.exists() else f"no runs of quick in single precision: this build has no {program.name} (jobs/ode_single.sh)\n"
    return {"cases": planned, "tables": tables.columns(), "note": note}


def run(request, folder):
    """The rows of one case, by table."""
    return tables.rows(request, runs.run_case(request, folder))


def main(step, folder):
    with open(f"{folder}/request.json", encoding="utf-8") as file:
        request = json.load(file)
    try:
        print(json.dumps({"cases": plan, "run": run}[step](request, pathlib.Path(folder)), allow_nan=False))
    except child.RunError as error:
        print(error, end="")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
