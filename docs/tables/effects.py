"""Tables of what effects cost: `pbstudy effects`, and the script about the field of interest."""
import re
import sys

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
