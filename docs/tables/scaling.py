"""Tables of what two ranks bring (jobs/scaling.sh), and of what more would (pbstudy calibrate)."""
import csv
import os
import subprocess

from tables import programs

USUAL = ("--repeats", "25", "--ranks", "1 2")
LONG = ("--repeats", "30", "--frames", "350", "--ranks", "1 2")
CASES = {LONG: ("100CrSk:worlds:100",)}  # where they are not those of the script
LARGEST_RANKS = 16384


def command(options):
    """As a reader types it."""
    words = " ".join(f'"{word}"' if " " in word else word for word in options)
    return " ".join(["jobs/scaling.sh", words, *(["OUTDIR", *CASES[options]] if options in CASES else [])])


def estimated(row, name):
    low, high = float(row[f"{name}_low"]), float(row[f"{name}_high"])
    return f"{float(row[name]):.2f} ({low:.2f} to {high:.2f})"


def percent(row, name):
    return f"{100 * float(row[name]):.0f} %"


def work_of(row):
    worlds = int(row["worlds"])
    if row["kind"] == "weak":
        return f"{row['scene']}, {worlds // int(row['ranks'])} worlds a rank"
    return f"{row['scene']}, {worlds} worlds" if worlds > 1 else f"{row['scene']}, cut into spaces"


def sweep(*options):
    """Rows of the points of a sweep."""
    with programs.Folder() as folder:
        out = folder / "out"
        done = subprocess.run([programs.SOURCE / "jobs/scaling.sh", *options, out, *CASES.get(options, ())],
                              capture_output=True, text=True, check=False, env={**os.environ, "PBMPI_BIN": str(programs.BIN)})
        if done.returncode != 0:
            raise SystemExit(done.stderr)
        return read_points(out / "scaling.csv")


def read_points(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def points_table(points):
    """Each point beside its base; a figure that the report holds back is not shown."""
    rows = []
    for row in points:
        if row["is_base"] == "1":
            continue
        is_cut = row["decomposition"] == "spaces"
        bound = float(row["island_bound"]) if is_cut else float(row["ideal_speed_up"])
        speed_up, efficiency = ((estimated(row, "speed_up"), estimated(row, "efficiency")) if row["reportable"] == "1"
                                else (f"not reportable: {row['doubts']}", ""))
        rows.append([work_of(row), row["ranks"] + (" (cut)" if is_cut else ""), row["repeats"], speed_up, f"{min(bound, float(row['ideal_speed_up'])):.2f}",
                     efficiency, *(percent(row, name) for name in ("load_balance", "serialisation", "transfer", "computation", "root_share")),
                     f"{float(row['messages']):.0f}", f"{1e-3 * float(row['bytes [B]']):.0f}"])
    head = ["work", "ranks", "runs", "speed-up", "bound", "efficiency", "load balance", "serialisation", "transfer", "computation", "root",
            "messages a frame", "kB a frame"]
    return programs.table(head, rows)


def scaling():
    return points_table(sweep(*USUAL))


def scaling_long():
    """Longer runs and more of them, for an interval that can be reported."""
    return points_table(sweep(*LONG))


def forecast(table, *question):
    """Rows of a table of pbreport calibrate."""
    with programs.Folder() as folder:
        study, rows = folder / "calibrate.h5", folder / "rows.csv"
        for command in (["mpirun", "-n", "2", programs.BIN / "pbstudy", "calibrate", "--largest-ranks", LARGEST_RANKS, "--quiet", "--output", study],
                        [programs.BIN / "pbreport", "calibrate", study, "--quiet", "--csv", rows, "--table", table, *question]):
            done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
            if done.returncode != 0:
                raise SystemExit(done.stderr)
        with open(rows, encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))


def forecast_traffic():
    """Counts, which need no clock."""
    rows = [[f"{int(row['worlds']):,}", f"{int(row['ranks']):,}", row["gather"], f"{int(row['messages_into_root']):,}",
             f"{1e-6 * float(row['bytes_into_root [B]']):,.4g}", f"{1e-6 * float(row['bytes_of_busiest_rank [B]']):,.4g}"]
            for row in forecast("forecasts", "--worlds", "10000", "1000000")]
    return programs.table(["worlds", "ranks", "gather", "messages into root", "MB into root", "MB sent by the busiest other rank"], rows)


def forecast_times():
    """The harness alone: what of a frame is left of the budget for physics."""
    def milliseconds(row, name):
        return f"{1e3 * float(row[f'{name}_time [s]']):.3g}"

    both = forecast("forecasts", "--worlds", "100", "1000", "10000", "1000000")
    by_way = {way: [row for row in both if row["gather"] == way] for way in ("flat", "tree")}
    rows = [[f"{int(tree['worlds']):,}", f"{int(tree['ranks']):,}", milliseconds(flat, "gather"), milliseconds(tree, "gather"),
             *(milliseconds(tree, part) for part in ("unpack", "balance", "harness")), milliseconds(flat, "frame"), milliseconds(tree, "frame"),
             tree["longest_part"]] for flat, tree in zip(by_way["flat"], by_way["tree"])]
    return programs.table(["worlds", "ranks", "gather, flat [ms]", "gather, tree [ms]", "unpack [ms]", "balance [ms]", "each rank's own [ms]",
                           "frame, flat [ms]", "frame, tree [ms]", "longest with a tree"], rows)
