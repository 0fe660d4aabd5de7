"""Artificial runs for the tests of the page: no engine, but poses with known values."""
import math

import h5py
import made_up
import numpy as np

CAR_START_X_M, CAR_SPEED_M_S = -4.0, 20.0
STEPS_PER_FRAME, DT_S, WARMUP = 3, 0.01, 3
SHARES = {"collide": 0.25, "islands": 0.05, "rows": 0.1, "solve": 0.35, "integrate": 0.05, "cross_space": 0, "ship": 0, "gather": 0.04, "wait": 0.1,
          "output": 0.02, "useful": 0.8}  # of a frame
ATTRIBUTES = {"scene": "Sample <crash>", "pbmpi_version": "0.0", "git_revision": "none", "created": "2006-01-01T00:00:00Z",
              "state_hash": "0123456789abcdef", "command_line": 'pbmpi --scene "Sample </script>"'}
SUMMARY = {"bodies": 204, "worlds": 4, "ranks": 2, "hosts": ["node1"], "stepper": "quick", "iterations": 20, "substeps": 1, "dt": 0.01,
           "frames": {"measured": 5}, "frame_rate": {"harmonic_mean_hz": 398.0, "satisfied_fraction": 0.8, "budget_s": 0.1 / 30},
           "frame_time_s": {"p50": 0.0021, "p99": 0.0041, "max": 0.0042},
           "efficiency": {"parallel": 0.76, "load_balance": 0.95, "communication": 0.8},
           "invariants": {"max_joint_gap_m": 0.0008, "max_penetration_m": 0.002}}
LIMBS = (("upper_arm", 0.22, 1.32, 0.05, 0.22), ("forearm", 0.24, 1.04, 0.04, 0.2), ("thigh", 0.1, 0.7, 0.08, 0.3), ("shin", 0.1, 0.29, 0.055, 0.32))


def turn(angle, axis):
    """A unit quaternion (w, x, y, z) about `axis`."""
    axis = np.array(axis, float) / np.linalg.norm(axis)
    return np.array([math.cos(angle / 2), *(math.sin(angle / 2) * axis)])


STILL, SIDEWAYS = turn(0, (1, 0, 0)), turn(math.pi / 2, (1, 0, 0))


def car():
    yield "car.chassis", "car", (CAR_START_X_M, 0, 0.75), "box", (3.6, 1.7, 0.7)
    for x in (-1.2, 1.2):
        for y in (-0.95, 0.95):
            yield f"car.wheel{int(x > 0)}{int(y > 0)}", "car", (CAR_START_X_M + x, y, 0.35), "cylinder", (0.35, 0.22, 0)


def human(name, x, y):
    yield f"{name}.head", "human", (x, y, 1.66), "sphere", (0.11, 0, 0)
    yield f"{name}.pelvis", "human", (x, y, 0.98), "box", (0.2, 0.32, 0.18)
    yield f"{name}.chest", "human", (x, y, 1.3), "capsule", (0.15, 0.22, 0)
    for side, which in ((-1, "right"), (1, "left")):
        for part, beside, z, radius, length in LIMBS:
            yield f"{name}.{which}_{part}", "human", (x, y + side * beside, z), "capsule", (radius, length, 0)


def wall():
    for row in range(5):
        for column in range(5):
            yield f"wall.brick{5 * row + column}", "wall", (3.4, (column - 2 + 0.5 * (row % 2)) * 0.62, 0.15 + 0.3 * row), "box", (0.3, 0.6, 0.29)


def bodies():
    """[(name, kind, position, shape, size)] of a world."""
    return [*car(), *human("human1", 0.6, -0.5), *human("human2", 0.9, 0.6), *wall(),
            ("ball.ball", "projectile", (4.6, -2.2, 0.9), "sphere", (0.3, 0, 0))]


def pose(body, world, place, time_s):
    """(position, orientation) after `time_s`: the car drives along +x at CAR_SPEED_M_S + 0.5 m/s for each world, other bodies stand until the
    car is near, and then fly and turn."""
    name, kind, position = body[:3]
    speed, position = CAR_SPEED_M_S + 0.5 * world, np.array(position, float)
    since = (CAR_START_X_M + speed * time_s - (position[0] - 2)) / speed
    if kind == "car":
        return position + [speed * time_s, 0, 0], SIDEWAYS if "wheel" in name else STILL
    if kind == "projectile":
        return position - [6 * time_s, 0, 0], STILL
    if since <= 0:
        return position, STILL
    return position + [since * 6 * position[2], (place % 5 - 2) * 2 * since, 2 * since], turn((4 + place % 7) * since, (0.2, 1, 0.1))


def columns_of_bodies(worlds, frames):
    found = [(world, place, body) for world in range(worlds) for place, body in enumerate(bodies())]
    steps = STEPS_PER_FRAME * np.arange(1, frames + 1)
    poses = [[pose(body, world, place, step * DT_S) for world, place, body in found] for step in (0, *steps.tolist())]
    position, orientation = (np.array([[one[part] for one in frame] for frame in poses]) for part in (0, 1))
    group = "particles__bodies__"
    return {group + "world": [world for world, *_ in found], group + "name": [body[0] for *_, body in found],
            group + "initial_position": position[0], group + "initial_orientation": orientation[0], group + "position__value": position[1:],
            group + "orientation__value": orientation[1:], group + "position__step": steps, group + "position__time": steps * DT_S}


def columns_of_geoms(worlds):
    found = []
    for world in range(worlds):
        found += [(world, -1, "ground", "plane", (0, 0, 0), (0, 0, 0), STILL),
                  (world, -1, "ramp", "box", (3, 1.6, 0.2), (1, 3.2, 0.4), turn(-0.26, (0, 1, 0)))]
        found += [(world, world * len(bodies()) + place, kind, shape, size, (0, 0, 0), STILL)
                  for place, (_, kind, _, shape, size) in enumerate(bodies())]
    names = ("world", "body", "kind", "shape", "size", "position", "orientation")
    return {f"geoms__{name}": values for name, values in zip(names, zip(*found))}


def columns_of_frames(worlds, frames, ranks):
    """Frame times round 2 ms with one late frame, and counts of worlds that fall as things collide."""
    frame, world, rank = np.arange(frames), np.arange(worlds), np.arange(ranks)
    wall = np.where(frame == 4, 4.1e-3, 2e-3) + 1e-4 * (frame % 3)
    each = np.ones((frames, worlds))
    found = {"islands": np.maximum(1, 3 - (frame[:, None] + world) // 4), "contacts": 8 + 3 * frame[:, None] + world % 3,
             "joint_gap": 1e-4 * (frame[:, None] + 1) * each, "max_penetration": 2e-3 * each, "energy": (1000 - 10 * frame[:, None]) * each,
             "linear_momentum": each[:, :, None] * [30.0, 40.0, 0]}
    of_ranks = {f"timings__rank__{name}": share * wall[:, None] * (1 - 0.1 * rank) for name, share in SHARES.items()}
    return {f"observables__world__{name}": values for name, values in found.items()} | of_ranks | {"timings__frame__wall": wall}


def write(path, worlds=4, frames=8, ranks=2, attributes=None, **others):
    """A run whose worlds have a ground plane, a ramp, a car, two humans, a wall and a ball. `others`: columns in the place of its own."""
    columns = columns_of_bodies(worlds, frames) | columns_of_geoms(worlds) | columns_of_frames(worlds, frames, ranks)
    columns |= {"events__frame": [2], "events__kind": ["rebalance"], "events__detail": ["1 world moved"], "ranks__host": ["node1"] * ranks}
    made_up.write_run(path, ranks, worlds, frames, WARMUP, {"iterations": 20, "scene_text": "# a scene"}, **(columns | others))
    with h5py.File(path, "a") as file:
        file["events"].attrs.update({"num_events": 1, "num_dropped": 0})
        file.attrs.update({name: np.bytes_(text) for name, text in ATTRIBUTES.items()})
        file.attrs.update(attributes or {})
    return str(path)
