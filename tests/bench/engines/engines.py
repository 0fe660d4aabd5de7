#!/usr/bin/env python3
"""Engines side by side on one core: `tests/bench/engines/engines.py`, after jobs/build.sh with Python's module.

Each scene is stepped by each engine with several settings, one thread on one core. Each round steps the same frames with the default of
`sor` and with the setting, one after the other; what is compared is the ratio of the two, over the rounds its median: what else the machine does
passes over both. Beside the time stands the error of the same frames. A setting that the engine refuses, that takes longer than --step-limit a
step or does not stay finite has a row that says so. PBMPI_BIN: another folder of the programs.
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
BIN = pathlib.Path(os.environ.get("PBMPI_BIN", HERE.parents[2] / "build/release/bin")).resolve()
PYTHON = "/usr/bin/python3"  # Debian's own, for which the module is built
START_S = 60  # [s] that a process may take beside its steps


class Scene:
    """What is stepped: `frames` after `warmup`. `worlds`, `steps_per_frame`: None: the scene's. `at_rest`: nothing should move, so that a change
    of energy is an error. `jointed`: joints can open. `people`: humanoids in a world."""

    def __init__(self, scene, worlds, warmup, frames, *, dt=0.01, steps_per_frame=None, at_rest=False, jointed=True, people=0):
        self.task = {"scene": str(scene), "worlds": worlds, "warmup": warmup, "frames": frames, "dt": dt,
                     "steps_per_frame": steps_per_frame, "at_rest": at_rest}
        self.jointed, self.people = jointed, people


HUMANOIDS = HERE / "falling_humanoids.toml"
SCENES = {
    "100CrSk": Scene("100CrSk", 100, 3, 5),
    "CrashWa": Scene("CrashWa", 1, 3, 5),
    "humanoids": Scene(HUMANOIDS, 32, 24, 24, dt=0.005, people=3),
    "pyramid100": Scene("hard/rest/pyramid100", 1, 1, 4, at_rest=True, jointed=False),
    "pyramid15": Scene("hard/rest/pyramid15", 1, 1, 2, at_rest=True, jointed=False),
}
QUICK_SCENES = {
    "100CrSk": Scene("100CrSk", 2, 1, 2),
    "CrashWa": Scene("CrashWa", 1, 1, 1),
    "humanoids": Scene(HUMANOIDS, 1, 1, 2, dt=0.005, people=3),
    "pyramid100": Scene("hard/rest/pyramid100", 1, 1, 1, steps_per_frame=1, at_rest=True, jointed=False),
    "pyramid15": Scene("hard/rest/pyramid15", 1, 1, 1, steps_per_frame=1, at_rest=True, jointed=False),
}


class Setting:
    """`name` as the tables have it; `parts`: steps of the engine in one of the scene."""

    def __init__(self, name, parts=1, **options):
        self.name, self.parts, self.options = name, parts, options


def iterations(*counts, parts=1):
    """So many iterations in each of `parts` steps."""
    return [Setting(f"{count}" if parts == 1 else f"{parts} steps of {count}", parts, iterations=count) for count in counts]


# The first of each engine is its default.
SETTINGS = {
    "sor": [Setting("14 x 1"), Setting("single 14 x 1", precision="single"), Setting("8 x 1", substeps=8), Setting("16 x 1", substeps=16),
            Setting("32 x 1", substeps=32)],
    "quick": iterations(20, 5, 10, 50) + iterations(5, parts=2) + iterations(5, parts=4),
    "bullet": iterations(10, 2, 3, 4, 5, 20, 50) + iterations(5, 20, parts=2) + iterations(5, parts=4),
    "mujoco": iterations(100),
}
ENGINES = tuple(SETTINGS)
# How many times the default of `sor` should be ahead at equal joint gap.
AIMS = {(scene, engine): aim for scene, aim in (("100CrSk", 5), ("CrashWa", 2)) for engine in ("bullet", "mujoco")}
# With --quick: the default.
QUICK_SETTINGS = {engine: settings[:1] for engine, settings in SETTINGS.items()}


class Bench:
    def __init__(self, core, rounds, step_limit_s):
        self.core, self.rounds, self.step_limit_s = core, rounds, step_limit_s

    def window(self, scene, engine, setting):
        """What window.py says of the setting."""
        task = {**scene.task, "engine": engine, "options": setting.options, "parts": setting.parts, "base": SETTINGS["sor"][0].options,
                "core": self.core, "rounds": self.rounds, "step_limit": self.step_limit_s}
        steps = (scene.task["steps_per_frame"] or 6) * (scene.task["warmup"] + self.rounds * scene.task["frames"])
        try:
            result = subprocess.run([PYTHON, HERE / "window.py", json.dumps(task)], capture_output=True, text=True,
                                    check=False, env={**os.environ, "PBMPI_BIN": str(BIN)}, timeout=START_S + 2 * self.step_limit_s * steps)
        except subprocess.TimeoutExpired:
            return {"why_not": f"beyond {self.step_limit_s:g} s a step"}
        if result.returncode != 0:
            sys.exit(f"engines.py: {task['scene']}, {engine} {setting.name}: exit code {result.returncode}\n{result.stderr}")
        return json.loads(result.stdout)

    def row(self, key, scene, engine, setting, is_default):
        row = {"scene": key, "engine": engine, "setting": setting.name, "is_default": is_default, "people": scene.people}
        seen = self.window(scene, engine, setting)
        if "why_not" in seen:
            return {**row, "why_not": seen["why_not"]}
        is_base = engine == "sor" and is_default
        ratios = [1.0 if is_base else own_s / base_s for base_s, own_s in seen["pairs"]]
        start_j = seen["start_energy"]
        return {**row, "why_not": None, "ratio": statistics.median(ratios), "ratio_min": min(ratios), "ratio_max": max(ratios),
                "s_per_world_step": statistics.median(own_s for _, own_s in seen["pairs"]) / seen["world_steps"], "worlds": seen["worlds"],
                "joint_gap_m": seen["joint_gap"] if scene.jointed else None, "penetration_m": seen["max_penetration"],
                "energy_drift": None if start_j is None else (seen["energy"] - start_j) / abs(start_j),
                "contacts": seen["contacts"], "hash": seen["hash"]}


def errors_of(row):
    return [abs(row[name]) for name in ("joint_gap_m", "penetration_m", "energy_drift") if row[name] is not None]


def error_of(row):
    """By which settings are ordered: the joint gap, or the penetration where joints cannot open or there are none."""
    return row["penetration_m"] if row["joint_gap_m"] is None or row["joint_gap_m"] < 1e-6 else row["joint_gap_m"]


def is_beaten(one, other):
    """Whether the other setting of the same engine takes less time and has no larger error of any kind."""
    return (other["ratio"] < one["ratio"]
            and all(theirs <= mine * 1.02 + 1e-6 for mine, theirs in zip(errors_of(one), errors_of(other))))


def cheapest(rows, most_gap_m, most_penetration_m=float("inf")):
    """The setting that takes least time among those within both errors; None if there is none."""
    fitting = [row for row in rows if row["joint_gap_m"] <= most_gap_m and row["penetration_m"] <= most_penetration_m]
    return min(fitting, key=lambda row: row["ratio"], default=None)


def at_gap(scene, engine, ours, theirs):
    """One row of equal_gap()."""
    default = next(row for row in ours if row["is_default"])
    within = cheapest(theirs, default["joint_gap_m"])
    nearest = within or min(theirs, key=lambda row: row["joint_gap_m"])
    within_both = cheapest(theirs, default["joint_gap_m"], default["penetration_m"])
    best = cheapest(ours, default["joint_gap_m"])
    their_default = next((row for row in theirs if row["is_default"]), None)
    back = their_default and cheapest(ours, their_default["joint_gap_m"])
    return {"scene": scene, "engine": engine, "gap_m": default["joint_gap_m"], "penetration_m": default["penetration_m"],
            "setting": nearest["setting"], "reaches": within is not None, "its_gap_m": nearest["joint_gap_m"],
            "its_penetration_m": nearest["penetration_m"], "sor_ahead": nearest["ratio"],
            "setting_both": within_both and within_both["setting"], "sor_ahead_both": within_both and within_both["ratio"],
            "sor_best": best["setting"], "sor_best_ahead": nearest["ratio"] / best["ratio"],
            "their_gap_m": their_default and their_default["joint_gap_m"], "sor_setting": back and back["setting"],
            "sor_ahead_at_their_gap": back and their_default["ratio"] / back["ratio"]}


def equal_gap(rows):
    """At the joint gap of one engine's default the cheapest setting of the other, of `sor` in double precision and each other engine, both ways."""
    answers = []
    for scene in dict.fromkeys(row["scene"] for row in rows):
        done = [row for row in rows if row["scene"] == scene and row["why_not"] is None and row["joint_gap_m"] is not None]
        ours = [row for row in done if row["engine"] == "sor" and not row["setting"].startswith("single")]
        for engine in ENGINES[1:]:
            theirs = [row for row in done if row["engine"] == engine]
            if any(row["is_default"] for row in ours) and theirs:
                answers.append(at_gap(scene, engine, ours, theirs))
    return answers


def shown(result):
    """Rows for the page. Of `sor`: what no other of its settings beats. Of each other engine: its default, what equal_gap() names, the
    cheapest with no larger penetration than the default of `sor` where there are no joints, and the one with the least error."""
    done = [row for row in result["rows"] if row["why_not"] is None]
    named = {(one["scene"], one["engine"], one[name]) for one in result["equal_gap"] for name in ("setting", "setting_both")}

    def is_shown(row):
        if row["is_default"]:
            return True
        if row["why_not"] is not None:
            return False
        peers = [one for one in done if (one["scene"], one["engine"]) == (row["scene"], row["engine"])]
        if row["engine"] == "sor":
            return not any(is_beaten(row, other) for other in peers)
        if (row["scene"], row["engine"], row["setting"]) in named or row is min(peers, key=error_of):
            return True
        ours = [one for one in done if one["scene"] == row["scene"] and one["engine"] == "sor" and one["is_default"]]
        if row["joint_gap_m"] is not None or not ours:
            return False
        return row is min((one for one in peers if one["penetration_m"] <= ours[0]["penetration_m"]), key=lambda one: one["ratio"], default=None)

    return [row for row in result["rows"] if is_shown(row)]


def digits(value, count=2):
    """So many significant digits, without an exponent."""
    if value == 0:
        return "0"
    rounded = float(f"{value:.{count - 1}e}")
    return f"{rounded:,.{max(0, count - 1 - int(f'{rounded:e}'.split('e')[1]))}f}"


def millimetres(metres):
    return "-" if metres is None else digits(1e3 * metres) if abs(metres) >= 1e-6 else "< 0.001"


def speed_cells(row):
    name = f"`{row['engine']}` {row['setting']}" + (" (default)" if row["is_default"] else "")
    if row["why_not"] is not None:
        return [row["scene"], name, f"not run: {row['why_not'].split(';')[0]}", "", "", "", "", ""]
    per_s = 1 / row["s_per_world_step"]
    spread = "" if row["ratio_min"] == row["ratio_max"] else f" ({digits(row['ratio_min'])} to {digits(row['ratio_max'])})"
    people = digits(per_s * row["people"], 3) if row["people"] else "-"
    drift = "-" if row["energy_drift"] is None else f"{100 * row['energy_drift']:+.3f}"
    return [row["scene"], name, f"x {digits(row['ratio'])}{spread}", digits(per_s, 3), people, millimetres(row["joint_gap_m"]),
            millimetres(row["penetration_m"]), drift]


SPEED_HEAD = ["scene", "engine, setting", "time over `sor`'s default", "world-steps/s", "humanoid-steps/s", "joint gap [mm]",
              "penetration [mm]", "energy drift [%]"]
GAP_HEAD = ["scene", "engine", "gap of `sor`'s default [mm]", "cheapest setting within it", "its gap, penetration [mm]", "`sor`'s default ahead by",
            "aim", "within the penetration, too", "`sor`'s cheapest within it ahead by", "gap of the engine's default [mm]",
            "`sor`'s cheapest within that ahead by"]


def aim_text(one):
    """Whether `sor` is as far ahead as it should be."""
    aim = AIMS.get((one["scene"], one["engine"]))
    if aim is None:
        return "-"
    if one["sor_ahead"] >= aim:
        return f"{aim}: reached"
    return f"{aim}: short by {100 * (1 - one['sor_ahead'] / aim):.0f} %"


def gap_cells(one):
    both = "no setting" if one["setting_both"] is None else f"x {digits(one['sor_ahead_both'])} ({one['setting_both']})"
    back = "no setting of `sor`" if one["sor_setting"] is None else f"x {digits(one['sor_ahead_at_their_gap'])} ({one['sor_setting']})"
    return [one["scene"], f"`{one['engine']}`", millimetres(one["gap_m"]), one["setting"] if one["reaches"] else f"none; nearest: {one['setting']}",
            f"{millimetres(one['its_gap_m'])}, {millimetres(one['its_penetration_m'])}",
            f"x {digits(one['sor_ahead'])}" + ("" if one["reaches"] else " at a larger gap"), aim_text(one), both,
            f"x {digits(one['sor_best_ahead'])} ({one['sor_best']})", millimetres(one["their_gap_m"]), back]


def table(head, rows):
    """In Markdown, as lines."""
    return [f"| {' | '.join(cells)} |" for cells in (head, ["---"] * len(head), *rows)]


def speed_table(result):
    return table(SPEED_HEAD, [speed_cells(row) for row in shown(result)])


def gap_table(result):
    return table(GAP_HEAD, [gap_cells(one) for one in result["equal_gap"]])


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=3, metavar="N")
    parser.add_argument("--scenes", nargs="+", choices=SCENES, default=list(SCENES), metavar="SCENE", help=", ".join(SCENES))
    parser.add_argument("--engines", nargs="+", choices=ENGINES, default=list(ENGINES), metavar="ENGINE", help=", ".join(ENGINES))
    parser.add_argument("--core", type=int, default=max(os.sched_getaffinity(0)), help="the processor on which all run")
    parser.add_argument("--step-limit", type=float, default=1.0, metavar="SECONDS", help="what takes longer a step is not run")
    parser.add_argument("--quick", action="store_true", help="few worlds and steps, one round: whether all run")
    parser.add_argument("--json", metavar="FILE", help="all rows; -: to stdout")
    parser.add_argument("--markdown", action="store_true", help="tables of the page")
    arguments = parser.parse_args()
    if arguments.rounds < 1:
        parser.error("--rounds: at least one")
    return arguments


def main():
    arguments = parse()
    rounds, scenes, settings = ((1, QUICK_SCENES, QUICK_SETTINGS) if arguments.quick else (arguments.rounds, SCENES, SETTINGS))
    bench = Bench(arguments.core, rounds, arguments.step_limit)
    rows = []
    for key in arguments.scenes:
        for engine in arguments.engines:
            for setting in settings[engine]:
                print(f"{key}: {engine} {setting.name}", file=sys.stderr, flush=True)
                rows.append(bench.row(key, scenes[key], engine, setting, setting is settings[engine][0]))
    result = {"rounds": rounds, "rows": rows, "equal_gap": equal_gap(rows)}
    if arguments.json == "-":
        print(json.dumps(result, indent=1))
    elif arguments.json:
        pathlib.Path(arguments.json).write_text(json.dumps(result, indent=1), encoding="utf-8")
    if arguments.markdown or not arguments.json:
        for lines in (speed_table(result), gap_table(result)):
            print("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
