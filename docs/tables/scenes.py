"""Tables of the scenes: islands of the nine beside the paper's, and the step plans of all."""
import json
import re

from tables import programs


def islands():
    """Islands at the end of each measured frame, beside the paper's Table 1."""
    with programs.Folder() as folder:
        files = []
        for scene in programs.SCENES:
            files.append(folder / f"{scene}.h5")
            programs.pbmpi("--scene", scene, "--stepper", "quick", "--quiet", "-o", files[-1])
        found = json.loads(programs.paper("islands", *files, "--json"))
    rows = [[one["scene"], *(numbers(one[whose]) for whose in ("islands", "paper"))] for one in found]
    return programs.table(["scene", "islands: most, least, mean, deviation", "the paper's Table 1"], rows)


def numbers(of):
    return ", ".join(f"{of[name]:.{places}f}".rstrip("0").rstrip(".") if places else f"{of[name]:.0f}"
                     for name, places in (("max", 0), ("min", 0), ("mean", 1), ("stddev", 2)))


def plan_of(scene):
    """{pass: what it counts} as `pbmpi --describe` prints the plan; None where the reason begins with no number."""
    text = programs.pbmpi("--scene", scene, "--describe")
    lines = text.split("step plan:\n")[1].split("decomposition:")[0]
    return {name: int(count) if count else None
            for name, count in re.findall(r"^  (\w+) +\w+ +[^:]+: (\d+ )?", lines, re.MULTILINE)}


def effect_names():
    """All effects, in the order of the registry."""
    text = programs.pbmpi("--help", "all").split("--effects", 1)[1].split("\n  --", 1)[0].split("\n\n", 1)[0]
    words = re.sub(r"\s+", " ", text).split("they are ", 1)[1]
    return re.findall(r"\w+", words)


def plans():
    """What calls for each pass of a step, in each scene: how many things, or yes where nothing is counted."""
    scenes = programs.SCENES + programs.EFFECT_SCENES
    plans_of = {scene: {name: count or "yes" for name, count in plan_of(scene).items()} for scene in scenes}
    rows = [[f"`{effect}`", *(plans_of[scene].get(effect, "") for scene in scenes)] for effect in effect_names()]
    return programs.table(["", *scenes], rows)
