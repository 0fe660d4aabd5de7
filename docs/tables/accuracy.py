"""Tables of what accuracy costs: errors by nature from `pbstudy accuracy`, and joint gaps from `bench_worlds --substeps`."""
import re
import sys

import h5py
import numpy as np

from tables import programs, stability

ONLY_SETTINGS = ("--own-iterations", "0", "--rest-seconds", "0")
# Step of the scene over the step, substeps x iterations.
LINES = (("quick", 1, 1, 20), ("quick", 1, 1, 80), ("quick", 4, 1, 20), ("sor", 1, 1, 1), ("sor", 1, 4, 1), ("sor", 1, 14, 1), ("sor", 2, 5, 1),
         ("sor", 2, 7, 1), ("sor", 4, 3, 1), ("sor", 4, 4, 1), ("sor", 4, 14, 1), ("sor", 8, 2, 1))
APPROACHES = ("0", "2cm")  # beside the default, 10 cm
HELD = {"sor": ("sor", 1, 14, 1), **{f"sor approach={length}": ("sor", 1, 14, 1) for length in APPROACHES},
        **{f"sor dt={0.01 / cut} substeps={substeps} approach=0": ("sor", cut, substeps, 1)
           for cut, substeps in ((2, 5), (2, 7), (4, 3), (4, 4))}}


def nature_file(folder):
    """The study of one setting: what nature is known to."""
    return programs.study("accuracy", folder, programs.SCENES, "--stepper", "quick", "--iterations", "20", "--dt", "0.01", "--repeats", "1",
                          "--estimates", "0", *ONLY_SETTINGS)


def nature():
    """How far nature is known in each scene."""
    with programs.Folder() as folder, h5py.File(nature_file(folder)) as file:
        frames = {name: column[:] for name, column in file["nature"].items()}
    columns = {scene: frames["scene"] == scene.encode() for scene in programs.SCENES}

    def of_frames(name, text):
        return ["{} to {}".format(*(text(limit(frames[name][rows])) for limit in (min, max))) for rows in columns.values()]

    def lengths(name):
        return of_frames(name, programs.millimetres)

    rows = [[f"steps of a frame, {way}", *of_frames(f"{way}_steps", str)] for way in ("soft", "ode")]
    rows += [[f"nine tenths of the bodies move by less [mm] with half as many, {way}", *lengths(f"{way}_halved_p90")] for way in ("soft", "ode")]
    rows.append(["nine tenths of the bodies end nearer [mm] than this by the two ways", *lengths("apart_p90")])
    rows += [[f"determined for {length} [%]", *(f"{100 * frames['determined'][rows, place].mean():.0f}" for rows in columns.values())]
             for place, length in enumerate(("1 mm", "1 cm", "10 cm"))]
    return programs.table(["nature", *programs.SCENES], rows)


def shifted_frames(scene, shift_m, steps=1536, frames=8, warmup=3, copies=8):
    """Distances [measured frames][bodies] (m) between a frame's end in nature's soft way and its end from a start where every body is shifted
    by about `shift_m` at random: the median over the shifted copies."""
    sys.path.insert(0, str(programs.BIN.parent / "python"))
    import pbmpi  # of the build that is measured

    batch = pbmpi.Batch(scene, copies, dt=0.03 / steps, substeps=1)
    random = np.random.default_rng(1)
    moved = []
    for _ in range(frames):
        shifts = shift_m * random.normal(size=batch.position.shape)
        shifts[0] = 0
        first = [np.repeat(array[:1], copies, axis=0) for array in (batch.position, batch.orientation, batch.velocity, batch.angular_velocity)]
        batch.set_state(first[0] + shifts, *first[1:])
        batch.step(steps)
        moved.append(np.median(np.linalg.norm(batch.position[1:] - batch.position[0], axis=2), axis=0))
    return np.array(moved[warmup:])


def sensitivity():
    """How much a shift of a frame's start grows until its end."""
    scenes = ("2-Cars", "10-Cars", "CrashSk", "CrashWa", "Battle", "Fight")
    growth = [f"{shifted_frames(scene, 1e-9).max() / 1e-9:,.0f}" for scene in scenes]
    shares = [100 * (shifted_frames(scene, 1e-6) > 1e-3).mean() for scene in scenes]
    return programs.table(["shift of the start", *scenes],
                          [["largest growth of 1 nm", *growth], ["bodies that 1 um moves by more than 1 mm [%]", *(f"{share:.0f}" for share in shares)]])


def setting_name(line):
    stepper, cut, substeps, iterations = line
    return f"`{stepper}`, {10 / cut:g} ms, {substeps} x {iterations}"


def setting_of(case):
    return case["stepper"], round(0.01 / case["dt"]), int(case["substeps"]), int(case["iterations"])


def front():
    """Error by nature and time of some settings in all scenes, each with one collision detection a step."""
    with programs.Folder() as folder:
        cases, _ = programs.accuracy_cases(folder, programs.SCENES, "--stepper", "quick", "sor", "--law", "soft", "--precision", "double",
                                           "--iterations", "5", "20", "80", "--substeps", "1", "2", "3", "4", "5", "7", "14", "--approach", "0",
                                           "--estimates", "0", "--rest-seconds", "0", "--repeats", "3")
    found = {(case["scene"], setting_of(case)): case for case in cases if case["kind"] == "setting"}
    unit = {scene: found[scene, ("quick", 1, 1, 20)]["frame_time_median"] for scene in programs.SCENES}

    def cell(scene, line):
        case = found[scene, line]
        return (f"{case['frame_time_median'] / unit[scene]:.2f}: {programs.millimetres(case['defect_body_position_rms'])}, "
                f"{programs.millimetres(case['defect_body_position_median'])}")

    return programs.table(["time over `quick`, 20 iterations: rms, median [mm]", *programs.SCENES],
                          [[setting_name(line), *(cell(scene, line) for scene in programs.SCENES)] for line in LINES])


def held():
    """How the settings of about the default's time fare on the hard cases."""
    with programs.Folder() as folder, h5py.File(stability.study(folder, "--setting", *HELD)) as file:
        verdicts, settings = (file["cases"][name].asstr()[:] for name in ("verdict", "setting"))
    of_setting = [verdicts[settings == name] for name in dict.fromkeys(settings)]
    counts = [[np.count_nonzero(verdicts == verdict) for verdict in stability.VERDICTS] for verdicts in of_setting]
    approach = {setting: f", `--approach {setting.split('approach=')[1]}`" for setting in HELD if "approach" in setting}
    names = [setting_name(line) + approach.get(setting, "") for setting, line in HELD.items()]
    return programs.table(["hard cases", *stability.VERDICTS], [[name, *count] for name, count in zip(names, counts)])


def fine():
    """What it buys and costs that islands in which bodies approach each other far take the step in pieces."""
    lengths_m = {"0": 0, "10cm": 0.1, "2cm": 0.02}
    with programs.Folder() as folder:
        cases, _ = programs.accuracy_cases(folder, programs.SCENES, "--stepper", "sor", "--law", "soft", "--precision", "double", "--substeps", "14",
                                           "--dt", "0.01", "--approach", *lengths_m, "--estimates", "0", "--repeats", "3", "--rest-seconds", "0")
    found = {(case["scene"], case["approach"]): case for case in cases if case["kind"] == "setting"}

    def errors(scene, length):
        return ", ".join(programs.millimetres(found[scene, lengths_m[length]][f"defect_body_position_{which}"]) for which in ("rms", "p90", "median"))

    def times(scene, length):
        return f"{found[scene, lengths_m[length]]['frame_time_median'] / found[scene, lengths_m['10cm']]['frame_time_median']:.2f}"

    return programs.table(["rms, 90th percentile, median [mm]", *programs.SCENES],
                          [[name, *(errors(scene, length) for scene in programs.SCENES)]
                           for name, length in (("default", "10cm"), *((f"`--approach {length}`", length) for length in APPROACHES))] +
                          [[f"time of `--approach {length}` over the default's", *(times(scene, length) for scene in programs.SCENES)]
                           for length in APPROACHES])


def estimates():
    """Estimated frames: the work that an estimate waits for, its error by nature, and that of the precise frame."""
    scenes = ("CrashSk", "CrashWa", "Fight")
    with programs.Folder() as folder:
        cases, _ = programs.accuracy_cases(folder, scenes, "--precision", "double", "--iterations", "20", "--substeps", "1", "14", "--dt", "0.01",
                                           "--rest-seconds", "0", "--repeats", "1")
    errors = {}
    for case in cases:
        if case["kind"] in ("estimate", "setting"):
            share = case["row_visits"] / frame_visits(case) if case["kind"] == "estimate" else 1
            line = (programs.setting_name(case), f"{case['estimate_iterations']:.0f}" if case["kind"] == "estimate" else "all")
            errors.setdefault(line, {})[case["scene"]] = (share, programs.millimetres(case["defect_body_position_rms"]))
    estimated = {name for name, count in errors if count != "all"}
    rows = []
    for line, by_scene in sorted((item for item in errors.items() if item[0][0] in estimated), key=lambda item: item[0][0]):
        shares = {f"{100 * share:.0f}" for share, _ in by_scene.values()}
        rows.append([*line, " to ".join(sorted({min(shares, key=float), max(shares, key=float)}, key=float)),
                     *(by_scene[scene][1] for scene in scenes)])
    return programs.table(["frames of", "iterations a step", "work [%] until it is there", *scenes], rows)


def frame_visits(case):
    """Row visits of the whole frame of an estimate's setting."""
    return case["rows"] * (case["iterations"] + (case["law"] == "soft")) * case["substeps"] * case["steps_per_frame"]


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
