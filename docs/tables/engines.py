"""Tables of engines side by side: fronts and own solutions from `pbstudy accuracy`, what each holds of the hard cases, what it cannot express."""
import functools
import json

import h5py

from tables import programs, stability

SETTINGS = ("--iterations", "5", "20", "80", "--substeps", "1", "14", "--max-sweeps", "80", "--dt", "0.01", "--estimates", "0", "--precision", "double",
            "--own-most-iterations", "2560", "--floor-seeds", "1", "--repeats", "3", "--frames", "2",
            "--rest-seconds", "1", "--progress", "never", "--quiet")
ALL = ("quick", "direct", "sor", "bullet", "mujoco")
# Battle2: a step takes MuJoCo and `direct` seconds to tens of seconds.
STUDIES = ((("CrashSk", "CrashWa", "Fight"), ALL, ()), (("100CrSk",), ALL, ("--replicas", "8")), (("Battle2",), ("quick", "sor", "bullet"), ()))
MAP = ("quick", "direct", "sor", "bullet", "bullet iterations=40", "mujoco")
# Beyond so many bodies x steps a case takes MuJoCo minutes to hours.
MOST_WORK = "12000"


@functools.cache
def scenes():
    """Of the studies of accuracy, as `pbreport engines --json` has them."""
    found = []
    for names, steppers, options in STUDIES:
        with programs.Folder() as folder:
            path = folder / "accuracy.h5"
            programs.run(["mpirun", "-n", "2", programs.BIN / "pbstudy", "accuracy", "--scene", *names, "--stepper", *steppers, *SETTINGS, *options,
                          "-o", path])
            found.append(json.loads(programs.pbreport("engines", path, "--json")))
    return [scene for one in found for scene in one["scenes"]], [difference for one in found for difference in one["differences"]]


@functools.cache
def hard_cases():
    """Of the study of hard cases: counts by setting, differences, and {case: {setting: verdict}}."""
    with programs.Folder() as folder:
        path = stability.study(folder, "--most-work", MOST_WORK, "--setting", *MAP)
        found = json.loads(programs.pbreport("engines", path, "--json"))
        with h5py.File(path) as file:
            columns = [file["cases"][name].asstr()[:] for name in ("scene", "setting", "verdict")]
    verdicts = {}
    for scene, setting, verdict in zip(*columns):
        verdicts.setdefault(scene.removeprefix("hard/"), {})[setting] = verdict
    return found["hard_cases"], found["differences"], verdicts


def engines_of_scenes():
    for scene in scenes()[0]:
        for engine in scene["engines"]:
            yield scene, engine


def fronts():
    rows = []
    for scene, engine in engines_of_scenes():
        for point in engine["nature_front"]:
            rows.append([scene["scene"], f"`{engine['engine']}`", point["setting"].replace(", dt 0.01 s", ""),
                         programs.digits(1e3 * point["frame_time_s"]["worst"]), *(programs.millimetres(point[name]) for name in
                                                                                  ("nature_error_m", "own_error_m", "joint_gap_m"))])
    return programs.table(["scene", "engine", "setting", "worst frame [ms]", "error: nature [mm]", "error: own solution [mm]", "joint gap [mm]"], rows)


def own():
    rows = []
    for scene, engine in engines_of_scenes():
        solution = engine["own_solution"]
        rows.append([scene["scene"], f"`{engine['engine']}`", *(programs.millimetres(solution[name]) for name in
                                                                ("from_nature_m", "from_fewer_iterations_m", "noise_m")),
                     f"{engine['settings']}", f"{engine['not_finite']}, {engine['felled']}"])
    return programs.table(["scene", "engine", "from nature [mm]", "from itself with a quarter of the iterations [mm]", "noise [mm]",
                           "settings", "not finite, fell at rest"], rows)


def hard_map():
    settings = hard_cases()[0]
    groups = list(settings[0]["groups"])
    rows = []
    for one in settings:
        counts = [one["groups"][group] for group in groups] + [one["all"]]
        rows.append([one["setting"], *(" / ".join(str(count[verdict]) for verdict in stability.VERDICTS) for count in counts)])
    return programs.table(["pass / degraded / broken", *groups, "all"], rows)


def cases():
    """The verdict on each case under each engine; cases that are too large for this study are left out."""
    verdicts = {case: by_setting for case, by_setting in hard_cases()[2].items() if set(by_setting.values()) != {"n/a"}}
    settings = list(next(iter(verdicts.values())))
    return programs.table(["case", *settings], [[f"`{case}`", *by_setting.values()] for case, by_setting in sorted(verdicts.items())])


def can():
    rows, seen = [], {}
    for one in scenes()[1] + hard_cases()[1]:
        seen.setdefault((one["engine"], one["text"]), []).extend(one["scenes"])
    for (engine, text), names in sorted(seen.items()):
        names = list(dict.fromkeys(names))
        rows.append([f"`{engine}`", text, ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")])
    return programs.table(["engine", "what it takes otherwise, or not at all", "in"], rows)
