"""Table of what two ranks bring: jobs/scaling.sh."""
import csv
import os
import subprocess

from tables import programs

REPEATS = 25


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


def scaling():
    """Each point beside its base; a figure that the report holds back is not shown."""
    with programs.Folder() as folder:
        done = subprocess.run([programs.SOURCE / "jobs/scaling.sh", "--repeats", str(REPEATS), "--ranks", "1 2", folder / "out"],
                              capture_output=True, text=True, check=False, env={**os.environ, "PBMPI_BIN": str(programs.BIN)})
        if done.returncode != 0:
            raise SystemExit(done.stderr)
        with open(folder / "out" / "scaling.csv", encoding="utf-8", newline="") as file:
            points = list(csv.DictReader(file))
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
