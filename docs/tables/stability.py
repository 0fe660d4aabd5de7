"""Tables of what settings hold: the map of the hard cases, the same over step lengths, and beside ODE at equal time."""
import json
import statistics

from tables import programs

# Cases of at most so many bodies x steps at their own step are tried at all step lengths.
SMALL_WORK = 12_000
STEPS_S = (0.0001, 0.0002, 0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05)
VERDICTS = ("pass", "degraded", "broken")


def study(folder, *options):
    """The file of `pbstudy stability`, run on two ranks: the numbers are those of any number of ranks."""
    path = folder / "stability.h5"
    programs.run(["mpirun", "-n", "2", programs.BIN / "pbstudy", "stability", "--progress", "never", "--quiet", "--poses", "0",
                  "-o", path, *options])
    return path


def cases(folder, *options):
    return json.loads(programs.pbreport(study(folder, *options), "--json"))["cases"]


def hard_map():
    """Every hard case under every setting of the study's own list."""
    with programs.Folder() as folder:
        return programs.pbreport(study(folder), "--markdown").splitlines()


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
    head = ["case", "`quick`: right up to", "not broken up to", "`sor` double, 1 x 20: right up to", "not broken up to"]
    return programs.table(head, rows.values())


def small_cases():
    """Those that cost little at their own step, which is 0.01 s."""
    with programs.Folder() as folder:
        found = cases(folder, "--setting", "sor", "--most-work", str(SMALL_WORK))
    return [case for case in found if case["results"][0]["verdict"] != "n/a" and case["results"][0]["dt_s"] == 0.01]


def at_equal_time():
    """What more iterations of `sor` hold, beside ODE, and the median of the ratios of their times of a step."""
    settings = ["quick"] + [f"sor precision={precision} iterations={iterations}"
                            for precision in ("double", "single") for iterations in (20, 40, 80, 160)]
    with programs.Folder() as folder:
        found = cases(folder, "--setting", *settings, "--most-work", "300000")
    found = [case for case in found if case["results"][0]["verdict"] != "n/a"]
    large = [case["results"] for case in found if case["bodies"] >= 10]  # else the time is that of what surrounds a step
    rows = []
    for number, cell in enumerate(found[0]["results"]):
        counts = [sum(case["results"][number]["verdict"] == verdict for case in found) for verdict in VERDICTS]
        ratio = statistics.median(results[number]["step_time_s"] / results[0]["step_time_s"] for results in large)
        rows.append([cell["setting"], *counts, f"x {ratio:.2f}"])
    return programs.table(["setting", *VERDICTS, "time of a step over `quick`'s"], rows)
