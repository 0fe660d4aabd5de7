"""Tables of what effects cost and save: `pbstudy effects`, the script about the field of interest, and runs."""
import re
import sys

import h5py

from tables import programs


def costs():
    """Share of the step and defect of each effect in each scene, `sor` in double precision."""
    with programs.Folder() as folder:
        path = programs.study("effects", folder, ["all"], "--stepper", "sor", "--repeats", "5", "--floor-seeds", "4")
        text = programs.pbreport(path, "--markdown")
    return [line for line in text.splitlines() if line.startswith("|")]


def interest():
    """What a field of interest saves in Environ, and how far the result is then off."""
    rows = []
    text = programs.run([sys.executable, programs.SOURCE / "tests/bench/interest.py", "5"])
    for about in text.split("Environ, all iterations within 10 m of ")[1:]:
        pattern = r"^  (\S.*?) +x ([\d.]+) .*rms ([\d.]+) mm, noise floor ([\d.]+) mm"
        for stepper, ratio, rms, floor in re.findall(pattern, about, re.MULTILINE):
            rows.append([about.split(":")[0], f"`{stepper}`", f"x {ratio}", rms, floor])
    head = ["all iterations within 10 m of", "stepper", "time of a step", "defect rms [mm]", "noise floor [mm]"]
    return programs.table(head, rows)


def saved():
    """What is left to do in Warehouse with sleeping, and in Stadium with a field of interest."""
    rows = []
    with programs.Folder() as folder:
        for scene, effect, stepper in (("Warehouse", "sleeping", "sor"), ("Stadium", "field_of_interest", "quick")):
            for sign in "+-":
                path = folder / f"{scene}{sign}.h5"
                programs.pbmpi("--scene", scene, "--stepper", stepper, "--effects", sign + effect, "--quiet", "-o", path)
                rows.append([f"{scene}, {'with' if sign == '+' else 'without'} `{effect}`", f"`{stepper}`", *left_to_do(path)])
    return programs.table(["scene", "stepper", "bodies that move", "of these with all iterations", "rows of a step"], rows)


def left_to_do(path):
    """Bodies that move, those that get all iterations, and rows of the last step of a frame: means over the measured frames."""
    with h5py.File(path) as file:
        measured = file["timings/frame/measured"][:].astype(bool)
        moving = (file["particles/bodies/velocity/value"][:][measured] != 0).any(axis=2).sum(axis=1).mean()
        inside = file["observables/interest/bodies_inside"][:][measured].mean() if "interest" in file["observables"] else moving
        rows = file["observables/world/rows"][:][measured].mean()
    return f"{moving:.0f}", f"{inside:.0f}", f"{rows:.0f}"
