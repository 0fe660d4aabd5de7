"""Tables with a clock: steppers against the bare loop over ODE, and one world over ranks."""
import os
import re
import sys

from tables import programs

SCENES = ("CrashWa", "100CrSk")
# stepper, with ODE's law?, precision, substeps, iterations
SETTINGS = (("quick", False, "double", 1, 20), ("sor", False, "double", 14, 1), ("sor", False, "single", 14, 1),
            ("sor", True, "double", 1, 80), ("sor", True, "single", 1, 80))
REST_S = 5


def quick_against_bare(scene):
    """CPU time of `quick` against the bare loop: the median of the ratios of frames."""
    text = programs.run([programs.BENCH, scene, "0", "10", "3"])
    return float(re.search(r"^  quick  .*time x +([\d.]+)", text, re.MULTILINE)[1])


def settings_of(scenes, *options):
    """(scene, setting, case) of a study; each frame is timed alone on its core."""
    with programs.Folder() as folder:
        cases, _ = programs.accuracy_cases(folder, scenes, "--precision", "double", "single", "--iterations", "20", "80",
                                           "--substeps", "1", "14", "--max-sweeps", "80", "--estimates", "0", "--floor-seeds", "1",
                                           "--dt", "0.01", *options)
    return [(case["scene"], (case["stepper"], programs.has_ode_law(case), case["precision"], case["substeps"], case["iterations"]), case)
            for case in cases if case["kind"] == "setting"]


def holding():
    """Settings with which nothing falls in any of the nine scenes at rest."""
    felling = {setting for _, setting, case in settings_of(programs.SCENES, "--frames", "1", "--warmup", "0", "--repeats", "1",
                                                           "--rest-seconds", REST_S) if case["rest_fallen"] > 0}
    return set(SETTINGS) - felling


def against_bare():
    """Time and defect beside each other. A setting of `sor` with which anything falls in the scenes at rest has no figures."""
    holds = holding() | {SETTINGS[0]}
    rows = {}
    for scene in SCENES:
        bare = quick_against_bare(scene)
        cases = {setting: case for _, setting, case in settings_of([scene], "--repeats", "5", "--rest-seconds", "0")}
        quick_s = cases[SETTINGS[0]]["frame_time_median"]
        for setting in SETTINGS:
            case = cases[setting]
            figures = [f"x {bare * case['frame_time_median'] / quick_s:.2f}",
                       *(programs.millimetres(case[f"defect_body_position_{what}"]) for what in ("rms", "p99"))]
            rows.setdefault(programs.setting_name(case), []).extend(figures if setting in holds else ["does not hold", "", ""])
    head = ["substeps x iterations"]
    for scene in SCENES:
        head += [f"{scene}: time", "defect rms [mm]", "p99 [mm]"]
    return programs.table(head, [[name, *cells] for name, cells in rows.items()])


def spaces():
    """Two ranks against one, the world cut into spaces. On a busy machine ranks wait for each other's processor, and a ratio of
    their frame rates says nothing: then it is left out, and what remains is the bound of the same runs."""
    is_busy = os.getloadavg()[0] > os.cpu_count() / 4
    pattern = re.compile(r"^(\S+) +two ranks against one ([\d.]+) \(min ([\d.]+), max ([\d.]+),.*bound ([\d.]+) ", re.MULTILINE)
    rows = {}
    for simd in ("off", "auto"):
        text = programs.run([sys.executable, programs.SOURCE / "tests/bench/decompose.py", "3",
                             "CrashWa,Environ,Battle,Fight,Battle2", "--simd", simd])
        for scene, ratio, least, most, bound in pattern.findall(text):
            measured = "machine busy" if is_busy else f"{float(ratio):.2f} ({float(least):.2f} to {float(most):.2f})"
            rows.setdefault(scene, [scene]).extend((measured, bound))
    head = ["scene", "one lane: two ranks against one", "one lane: allowed", "widest: two ranks against one", "widest: allowed"]
    return programs.table(head, list(rows.values()))
