"""Tables of what accuracy costs: defects from `pbstudy accuracy`, and joint gaps from `bench_worlds --substeps`."""
import re

from tables import programs

# In the others the converged reference and its judges take half an hour.
REFERENCE_SCENES = ("2-Cars", "10-Cars", "CrashSk", "CrashWa", "Battle", "Fight")
ONE_STEP = ("--dt", "0.01", "--rest-seconds", "0")
ONLY_SETTINGS = ("--estimates", "0", "--reference-check", "0", *ONE_STEP)
QUICK_TO_MEASURE = ("--repeats", "1", "--floor-seeds", "1")


def defect(case):
    return [programs.millimetres(case[f"defect_body_position_{what}"]) for what in ("rms", "p99", "max")]


def crashwa():
    """Defects of some settings in CrashWa, and what they cost without a clock: visits of rows."""
    wanted = (("quick", False, 1, 1), ("quick", False, 1, 20), ("quick", False, 1, 80), ("sor", True, 1, 1), ("sor", True, 1, 20),
              ("sor", True, 1, 80), *(("sor", False, substeps, 1) for substeps in (1, 3, 7, 14, 28)))
    with programs.Folder() as folder:
        cases, _ = programs.accuracy_cases(folder, ["CrashWa"], "--precision", "double", "--iterations", "1", "20", "80",
                                           "--substeps", "1", "3", "7", "14", "28", "--max-sweeps", "80", *ONLY_SETTINGS,
                                           *QUICK_TO_MEASURE)
    found = {(case["stepper"], programs.has_ode_law(case), case["substeps"], case["iterations"]): case for case in cases
             if case["kind"] == "setting" and case["dt"] == 0.01}
    rows = [[programs.setting_name(found[key]), f"{found[key]['row_visits'] / 1000:,.0f}", *defect(found[key]),
             programs.millimetres(found[key]["joint_gap"])] for key in wanted]
    return programs.table(["substeps x iterations", "row visits a frame [1000]", "defect rms [mm]", "p99 [mm]", "most [mm]",
                           "joint gap [mm]"], rows)


def reference():
    """How far the reference itself is to be trusted, in each scene."""
    with programs.Folder() as folder:
        cases, scenes = programs.accuracy_cases(folder, REFERENCE_SCENES, "--stepper", "sor", "--precision", "double", "--iterations",
                                                "1", "--substeps", "1", "--max-sweeps", "1", "--estimates", "0", *ONE_STEP,
                                                "--repeats", "1", "--floor-seeds", "2")
    second = {case["scene"]: case["stepper"] for case in cases if case["kind"] == "second_method"}
    taken = [[name, *(text(scenes[scene]["reference"]) for scene in REFERENCE_SCENES)] for name, text in (
        ("left unsolved of a step [mm]", lambda account: programs.millimetres(account["residual_m"])),
        ("iterations a step", lambda account: f"{account['iterations']:,.0f}"))]
    lines = (("defect rms [mm] with another solver seed (the noise floor)", "noise_floor_m"),
             ("with thirty times as many iterations", "more_iterations_m"), ("of ODE", "second_method_m"),
             ("with half the step", "halved_dt_m"))
    rows = [[name, *(programs.millimetres(scenes[scene][key]) + (f" (`{second[scene]}`)" if key == "second_method_m" else "")
                     for scene in REFERENCE_SCENES)] for name, key in lines]
    return programs.table(["the reference", *REFERENCE_SCENES], [*taken, *rows])


def estimates():
    """Estimated frames: the work that an estimate waits for, and its defect."""
    scenes = ("CrashSk", "CrashWa", "Fight")
    with programs.Folder() as folder:
        cases, _ = programs.accuracy_cases(folder, scenes, "--precision", "double", "--iterations", "20", "--substeps", "1",
                                           "--reference-check", "0", *ONE_STEP, *QUICK_TO_MEASURE)
    found = {}
    for case in cases:
        if case["kind"] == "estimate":
            share = case["row_visits"] / frame_visits(case)
            line = (programs.setting_name(case), f"{case['estimate_iterations']:.0f}")
            found.setdefault(line, {})[case["scene"]] = (share, programs.millimetres(case["defect_body_position_rms"]))
    rows = []
    for line, by_scene in found.items():
        shares = {f"{100 * share:.0f}" for share, _ in by_scene.values()}
        rows.append([*line, " to ".join(sorted({min(shares, key=float), max(shares, key=float)}, key=float)),
                     *(by_scene[scene][1] for scene in scenes)])
    return programs.table(["frames of", "iterations a step", "work [%] until it is there", *scenes], rows)


def frame_visits(case):
    """Row visits of the whole frame of an estimate's setting."""
    return case["rows"] * (case["iterations"] + (case["law"] == "soft")) * case["substeps"] * case["steps_per_frame"]


def least_defect():
    """The least defect of each kind of setting within the time of the paper's estimate, quick with one iteration."""
    with programs.Folder() as folder:
        cases, _ = programs.accuracy_cases(folder, programs.SCENES, "--iterations", "1", "2", "3", "5", "10", "20", "40", "80",
                                           "--substeps", "1", "3", "7", "14", *ONLY_SETTINGS, "--repeats", "3", "--floor-seeds",
                                           "1")
    columns = [least_defects([case for case in cases if case["scene"] == scene and case["kind"] == "setting"])
               for scene in programs.SCENES]
    return programs.table(["defect rms [mm]", *programs.SCENES],
                          [[name, *(column[name] for column in columns)] for name in columns[0]])


def least_defects(cases):
    quick = next(case for case in cases if case["stepper"] == "quick" and case["iterations"] == 1)
    in_time = [case for case in cases if case["frame_time_median"] <= quick["frame_time_median"]]
    found = {"`quick`, 1 x 1": programs.millimetres(quick["defect_body_position_rms"])}
    for precision in ("double", "single"):
        of_sor = [case for case in in_time if case["stepper"] == "sor" and case["precision"] == precision]
        for name, fits in ((f"`sor` {precision}, 1 x N, law ode", lambda case: programs.has_ode_law(case) and case["substeps"] == 1),
                           (f"`sor` {precision}, M x N, law ode", lambda case: programs.has_ode_law(case) and case["substeps"] > 1),
                           (f"`sor` {precision}, M x 1", lambda case: not programs.has_ode_law(case))):
            fitting = [case["defect_body_position_rms"] for case in of_sor if fits(case)]
            found[name] = programs.millimetres(min(fitting)) if fitting else "-"
    return found


def substeps():
    """Joint gaps in 100CrSk by the number of substeps."""
    pattern = re.compile(r"^  (\S.*?) +frame .*joint gap rms +([\d.]+) mm.*deepest contact: mean +([\d.]+) mm", re.M)
    found = {}
    for frames in (8, 100):
        text = programs.run([programs.BENCH, "--substeps", "100CrSk", "0", str(frames)]).split("100CrSk, sor single")[0]
        for name, gap, depth in pattern.findall(text):
            found.setdefault(name, []).extend((gap, depth))
    rows = [[name, *cells] for name, cells in found.items()]
    return programs.table(["100CrSk, `sor` double", "8 frames: joint gap rms [mm]", "deepest contact, mean [mm]",
                           "100 frames: joint gap rms [mm]", "deepest contact, mean [mm]"], rows)
