"""Tables of what settings hold: the nine scenes at rest, and small cases that are known to be hard."""
import tomllib

import h5py
import numpy

from tables import programs

SETTINGS = (
    ("`quick`, 1 x 20", "--stepper quick"),
    ("`sor` double, 1 x 20", "--stepper sor"),
    ("`sor` single, 1 x 20", "--stepper sor --precision single"),
    ("`sor` double, 5 x 3", "--stepper sor --substeps 5 --iterations 3"),
    ("`sor` double, 1 x 80", "--stepper sor --iterations 80"),
    ("`sor` double, 8 x 3, warm start 1, factor 1",
     "--stepper sor --substeps 8 --iterations 3 --warm-start 1 --sor-factor 1"),
)
REST_SCENES = ("CrashWa", "Environ", "Battle2", "CrashSk", "Battle", "Fight")
REST_S = 10
SUNK_M = 0.05  # a third of the height of Environ's blocks; a head that sinks so far belongs to a human that falls


def actors_of(scene):
    """The actors of a scene file, those of its base included."""
    with open(programs.SOURCE / f"scenes/{scene}.toml", "rb") as file:
        text = tomllib.load(file)
    actors = actors_of(text["base"]) if "base" in text else {}
    for actor in text.get("actor", []):
        actors[actor["name"]] = {**actors.get(actor["name"], {}), **actor}
    return actors


def at_rest(scene):
    """A scene file in which nothing happens: no events, no speed; what would fly lies on the ground."""
    lines = [f'title = "{scene}, at rest"', f'base = "{scene}"', "[effects]", "events = false"]
    for name, actor in actors_of(scene).items():
        if "velocity" not in actor and "speed" not in actor:
            continue
        lines += ["[[actor]]", f'name = "{name}"']
        lines += ["speed = 0"] if "speed" in actor else []
        lines += ["velocity = [0, 0, 0]"] if "velocity" in actor else []
        if actor["type"] == "projectile":
            x, y, _ = actor["position"]
            lines += [f"position = [{x}, {y}, 0.1]"]
    return "\n".join(lines) + "\n"


def count_sunk(path):
    """Blocks of walls and heads of humans that have sunk, as "after half the run, at its end, of all"."""
    with h5py.File(path) as file:
        bodies = file["particles/bodies"]
        names, kinds = bodies["name"].asstr()[:], bodies["kind"].asstr()[:]
        start, height = bodies["initial_position"][:, 2], bodies["position/value"][:, :, 2]
    groups = {"blocks": kinds == "wall", "humans": numpy.array([name.endswith(".head") for name in names])}
    # A position that is no number counts as sunk.
    return {group: [int(sum(~(row[mask] > start[mask] - SUNK_M))) for row in height] + [int(sum(mask))]
            for group, mask in groups.items() if sum(mask)}


def run_s(folder, scene, options, seconds):
    """The file of a run of so many seconds of a scene file, in steps of 0.01 s; recorded are half the run and its end."""
    out = folder / "run.h5"
    half = round(seconds / 0.06)
    programs.pbmpi("--scene", scene, "--warmup", 0, "--frames", 2 * half, "--steps-per-frame", 3, "--dt", 0.01,
                   "--record-every", half, "--quiet", "-o", out, *options.split())
    return out


def rest():
    """What falls though nothing happens."""
    head, rows = {}, []
    with programs.Folder() as folder:
        for scene in REST_SCENES:
            (folder / f"{scene}-rest.toml").write_text(at_rest(scene), encoding="utf-8")
        for name, options in SETTINGS:
            cells = [name]
            for scene in REST_SCENES:
                path = run_s(folder, folder / f"{scene}-rest.toml", options, REST_S)
                for group, (half, end, total) in count_sunk(path).items():
                    head[f"{scene}: {total} {group}"] = True
                    cells.append(f"{half}, {end}")
            rows.append(cells)
    return programs.table(["", *head], rows)


def holds(options):
    """Whether nothing falls in any of the scenes at rest within half of the table's time."""
    with programs.Folder() as folder:
        for scene in REST_SCENES:
            (folder / "rest.toml").write_text(at_rest(scene), encoding="utf-8")
            counts = count_sunk(run_s(folder, folder / "rest.toml", options, REST_S))
            if any(half > 0 for half, _, _ in counts.values()):
                return False
    return True


def scene_text(*actors, joints=()):
    ground = {"name": "ground", "type": "ground"}
    text = 'title = "a hard case"\n'
    for kind, tables in (("actor", (ground, *actors)), ("joint", joints)):
        for entry in tables:
            text += f"[[{kind}]]\n" + "".join(f"{key} = {toml(value)}\n" for key, value in entry.items())
    return text


def toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(one)}" for key, one in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml, value)) + "]"
    return f'"{value}"' if isinstance(value, str) else str(value)


def box(name, position, mass, side=0.5):
    return {"name": name, "type": "box", "size": [side] * 3, "mass": mass, "position": position}


def column(*masses):
    """Boxes of 0.5 m on each other, the lowest first, each 1 cm out of line so that an order of contacts shows."""
    return scene_text(*(box(f"box{i}", [0.01 * (i % 2), 0, 0.25 + 0.5 * i], mass) for i, mass in enumerate(masses)))


def chain(num_links, end_mass):
    """Links of 0.2 m and 1 kg, level at the start, hung at one end, with a box at the other; nothing touches."""
    links = [{"name": f"link{i}", "type": "box", "size": [0.16, 0.05, 0.05], "mass": 1, "position": [0.1 + 0.2 * i, 0, 5]}
             for i in range(num_links)]
    end = box("end", [0.2 * num_links + 0.1, 0, 5], end_mass, 0.19)
    names = [link["name"] for link in links] + ["end"]
    joints = [{"name": "hold", "kind": "ball", "bodies": ["link0", "world"], "anchor": [0, 0, 5]}]
    joints += [{"name": f"ball{i}", "kind": "ball", "bodies": [names[i], names[i + 1]], "anchor": [0.2 * (i + 1), 0, 5]}
               for i in range(num_links)]
    return scene_text(*links, end, joints=joints)


BALL = scene_text({"name": "ball", "type": "sphere", "radius": 0.1, "mass": 1, "position": [0, 0, 2.1],
                   "material": {"mu": 0, "restitution": 1}})


def drift(path):
    """How far the body that moved most is from its start [mm], or "falls"."""
    with h5py.File(path) as file:
        bodies = file["particles/bodies"]
        shift = bodies["position/value"][-1] - bodies["initial_position"][:]
    way = max((row ** 2).sum() ** 0.5 for row in shift)
    return "falls" if not way < 0.25 else f"{programs.digits(1e3 * way)} mm"


def worst_gap(path):
    with h5py.File(path) as file:
        return f"{programs.digits(1e3 * file['observables/world/joint_gap'][:].max())} mm"


def energy(path):
    """The largest energy of a frame over the first's."""
    with h5py.File(path) as file:
        joules = file["observables/world/energy"][:, 0]
    return f"x {joules.max() / joules[0]:.2f}"


# Column of the table: (heading, scene, seconds, what is read from the file).
HARD = (
    ("column of 10 boxes, 10 s: drift", column(*[75] * 10), 10, drift),
    ("column of 15 boxes, 10 s: drift", column(*[75] * 15), 10, drift),
    ("100 kg on 1 kg, 10 s: drift", column(1, 100), 10, drift),
    ("chain of 10 links of 1 kg under 1 kg, 5 s: worst gap", chain(10, 1), 5, worst_gap),
    ("the same under 100 kg", chain(10, 100), 5, worst_gap),
    ("ball with restitution 1, 10 s: largest energy", BALL, 10, energy),
)


def hard():
    """Small cases that iterative solvers are known to find hard."""
    rows = []
    with programs.Folder() as folder:
        for name, options in SETTINGS:
            cells = [name]
            for number, (_, text, seconds, read) in enumerate(HARD):
                scene = folder / f"hard{number}.toml"
                scene.write_text(text, encoding="utf-8")
                cells.append(read(run_s(folder, scene, options, seconds)))
            rows.append(cells)
    return programs.table(["", *(heading for heading, *_ in HARD)], rows)
