"""Table of what the guards of a run notice in the hard cases."""
import h5py

from tables import programs, stability

SETTINGS = (("`quick`", "--stepper quick"), ("`sor` double, 14 x 1", "--stepper sor"),
            ("`sor` double, 1 x 20, law ode", "--stepper sor --law ode"))
MOST_WORK = 300_000  # bodies x steps; larger cases are left out
STEPS_A_FRAME = 3


def first_trip(path):
    """The first guard that tripped in a run: "joint_gap of 'link.3' in step 17"; empty if none did."""
    with h5py.File(path) as file:
        events = file["events"]
        count = events.attrs["num_events"]
        for kind, name, step in zip(events["kind"].asstr()[:count], events["name"].asstr()[:count], events["step"][:count]):
            if kind in ("nonfinite", "joint_gap", "energy_gain", "passage"):
                return f"{kind}{' of `' + name + '`' if name else ''}, step {step}"
    return ""


def run(folder, case, options):
    path = folder / "run.h5"
    steps = round(case["seconds"] / case["results"][0]["dt_s"])
    try:
        programs.pbmpi("--scene", case["scene"], "--warmup", 0, "--frames", -(-steps // STEPS_A_FRAME), "--steps-per-frame",
                       STEPS_A_FRAME, "--quiet", "-o", path, *options.split())
    except SystemExit:
        pass  # a number that is not finite ends the run; its file says so
    return path


def guards():
    """The cases in which a guard trips, with the body or joint and the step."""
    rows = []
    with programs.Folder() as folder:
        # Nothing is run: the report says how long and how large each case is.
        for case in stability.cases(folder, "--setting", "sor", "--most-work", "1"):
            steps = case["seconds"] / case["results"][0]["dt_s"]
            if case["bodies"] * steps > MOST_WORK:
                continue
            cells = [first_trip(run(folder, case, options)) for _, options in SETTINGS]
            if any(cells):
                rows.append([f"`{case['scene'].split('/', 1)[1]}`", *cells])
    return programs.table(["case", *(name for name, _ in SETTINGS)], rows)
