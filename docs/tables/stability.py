"""Tables of what settings hold: the map of the hard cases, the same over step lengths, and beside ODE at equal time."""
import json
import re
import statistics

import h5py

from tables import programs

# Cases of at most so many bodies x steps at their own step are tried at all step lengths.
SMALL_WORK = 12_000
MOST_WORK = "300000"  # leaves out the nine largest, which take longer than all others
STEPS_S = (0.0001, 0.0002, 0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05)
VERDICTS = ("pass", "degraded", "broken")


def study(folder, *options):
    """The file of `pbstudy stability`, run on two ranks: the numbers are those of any number of ranks."""
    path = folder / "stability.h5"
    programs.run(["mpirun", "-n", "2", programs.BIN / "pbstudy", "stability", "--progress", "never", "--quiet",
                  "-o", path, *options])
    return path


def cases(folder, *options):
    return json.loads(programs.pbreport(study(folder, *options), "--json"))["cases"]


def hard_map():
    """Every hard case under every setting of the study's own list."""
    with programs.Folder() as folder:
        head, *lines = programs.pbreport(study(folder), "--markdown").splitlines()
    return [head, *lines]


def largest_step(by_step, verdicts):
    """The step length up to which a case has one of these verdicts at every length."""
    largest = "none"
    for step_s in STEPS_S:
        if by_step[step_s] not in verdicts:
            break
        largest = f"{step_s:g} s"
    return largest


def by_step():
    """From which step length on the small cases break."""
    names = [case["scene"] for case in small_cases()]
    rows = {name: [f"`{name.split('/', 1)[1]}`"] for name in names}
    with programs.Folder() as folder:
        for stepper in ("quick", "sor"):
            found = cases(folder, "--scene", *names, "--setting", stepper, "--dt", *map(str, STEPS_S))
            for case in found:
                verdicts = {cell["dt_s"]: cell["verdict"] for cell in case["results"]}
                rows[case["scene"]] += [largest_step(verdicts, ("pass",)), largest_step(verdicts, ("pass", "degraded"))]
    head = ["case", "`quick`: right up to", "not broken up to", "`sor` double, 14 x 1: right up to", "not broken up to"]
    return programs.table(head, rows.values())


def small_cases():
    """Those that cost little at their own step, which is 0.01 s."""
    with programs.Folder() as folder:
        found = cases(folder, "--setting", "sor", "--most-work", str(SMALL_WORK))
    return [case for case in found if case["results"][0]["verdict"] != "n/a" and case["results"][0]["dt_s"] == 0.01]


def joint_springs():
    """Whether sweeps or substeps decide what stretches: verdict and largest joint gap."""
    names = [f"hard/{name}" for name in ("joints/chain20_100", "joints/chain20_1000", "joints/rope100", "joints/bridge30", "joints/net8",
                                         "joints/double_pendulum", "joints/limit_chains", "rest/CrashSk")]
    settings = ["sor", "sor iterations=16", "sor substeps=8", "sor substeps=32"]
    with programs.Folder() as folder:
        found = cases(folder, "--scene", *names, "--setting", *settings)
    rows = [[f"`{case['scene'].split('/', 1)[1]}`",
             *(f"{cell['verdict']}, {programs.millimetres(cell['metrics']['joint_gap'])}" for cell in case["results"])] for case in found]
    return programs.table(["verdict, largest joint gap [mm]", *(cell["setting"] for cell in found[0]["results"])], rows)


def island_shares():
    """What a tolerance holds of the hard cases, and the work that it leaves where scenes move and have calmed down."""
    settings = ["sor", *(f"sor tolerance={length}mm" for length in ("0.01", "0.03", "0.1")),
                "sor substeps=32", "sor substeps=32 tolerance=0.01mm"]
    scenes = (("100CrSk", "0", ()), ("Environ", "150", ()), ("Battle2", "150", ()), ("Warehouse", "40", ("--effects=-sleeping",)))
    with programs.Folder() as folder:
        found = [case for case in cases(folder, "--setting", *settings, "--most-work", MOST_WORK)
                 if case["results"][0]["verdict"] != "n/a"]
        rows = []
        for number, setting in enumerate(settings):
            verdicts = [case["results"][number]["verdict"] for case in found]
            options = [f"--{option}" for option in setting.split()[1:]]
            visits = [visits_of(folder, scene, "--warmup", warmup, *effects, *options) for scene, warmup, effects in scenes]
            rows.append([f"`{setting}`", *(verdicts.count(verdict) for verdict in VERDICTS), *visits])
    head = [f"row visits a step [1000]: {scene}{' without `sleeping`' if effects else ''}" for scene, _, effects in scenes]
    return programs.table(["setting", *VERDICTS, *head], rows)


def visits_of(folder, *run):
    """Row visits of all worlds in the last steps of ten frames, their mean, in thousands."""
    path = folder / "run.h5"
    path.unlink(missing_ok=True)
    programs.pbmpi("--scene", *run, "--frames", "10", "--quiet", "-o", path)
    with h5py.File(path) as file:
        return f"{file['observables/world/row_visits'][:][-10:].sum(axis=1).mean() / 1000:.0f}"


def quiet():
    """What a tolerance saves once little moves, and where all does, with the defects of both."""
    rows = []
    for scene, seconds in (("Environ", 5), ("Battle2", 5), ("Battle2", 30), ("Warehouse", 5), ("100CrSk", 0)):
        text = programs.run([programs.BENCH, "--quiet", scene, seconds, 10])
        found = re.search(r"time x ([\d.]+) \[([\d.]+), ([\d.]+)\] +row visits x ([\d.]+) +"
                          r"defect rms (\S+) mm, with the tolerance (\S+) mm", text)
        median, low, high, visits, without, tolerant = found.groups()
        name = {"Warehouse": "Warehouse without `sleeping`"}.get(scene, scene)
        rows.append([name, seconds, f"x {median} ({low} to {high})", f"x {visits}", without, tolerant])
    return programs.table(["scene", "from [s]", "time without over with", "row visits likewise", "defect rms without [mm]",
                           "with [mm]"], rows)


def at_equal_time():
    """What more substeps of `sor` hold, beside ODE, and the median of the ratios of their times of a step."""
    settings = ["quick", "sor law=ode", "sor law=ode iterations=80", "sor iterations=2"]
    settings += [f"sor precision={precision} substeps={substeps}"
                 for precision in ("double", "single") for substeps in (4, 8, 14, 20)]
    with programs.Folder() as folder:
        found = cases(folder, "--setting", *settings, "--most-work", MOST_WORK)
    found = [case for case in found if case["results"][0]["verdict"] != "n/a"]
    large = [case["results"] for case in found if case["bodies"] >= 10]  # else the time is that of what surrounds a step
    rows = []
    for number, cell in enumerate(found[0]["results"]):
        counts = [sum(case["results"][number]["verdict"] == verdict for case in found) for verdict in VERDICTS]
        ratio = statistics.median(results[number]["step_time_s"] / results[0]["step_time_s"] for results in large)
        rows.append([cell["setting"], *counts, f"x {ratio:.2f}"])
    return programs.table(["setting", *VERDICTS, "time of a step over `quick`'s"], rows)
