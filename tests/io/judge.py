"""Judges files of runs and studies from what stands in them, by formulas of its own: no code of pbmpi, no scene is read.

usage: judge.py run RUN.h5                   hash, energy, momentum, joint gaps, islands of each frame: as stored?
       judge.py diff RUN.h5 REFERENCE.h5     errors in the categories of the paper, in the words of `pbreport diff`
       judge.py study STUDY.h5 BUDGET_MS     Pareto fronts and the setting that fits the budget, as JSON"""
import json
import sys

import h5py
import numpy as np

POSITION_EDGES, TURN_EDGES = (0.01, 0.1, 1.0), (0.05, 0.25, 0.5)
POSITION_NAMES = ("< 1 cm", "1-10 cm", "10-100 cm", "> 100 cm", "inf/NaN")
TURN_NAMES = ("< 5 %", "5-25 %", "25-50 %", "> 50 %", "inf/NaN")


def fnv1a(words):
    value = 0xcbf29ce484222325
    for byte in b"".join(int(word).to_bytes(8, "little") for word in words):
        value = ((value ^ byte) * 0x100000001b3) & 0xffffffffffffffff
    return value


def bits(numbers):
    return np.ascontiguousarray(numbers, "<f8").view("<u8").ravel().tolist()


def times(q, r):
    """Products of quaternions (w, x, y, z)."""
    w = q[..., :1] * r[..., :1] - (q[..., 1:] * r[..., 1:]).sum(-1, keepdims=True)
    return np.concatenate([w, q[..., :1] * r[..., 1:] + r[..., :1] * q[..., 1:] + np.cross(q[..., 1:], r[..., 1:])], -1)


def inverse(q):
    return q * [1, -1, -1, -1]


def rotated(q, v):
    """Vectors in the frames of q, as the world sees them."""
    t = 2 * np.cross(q[..., 1:], v)
    return v + q[..., :1] * t + np.cross(q[..., 1:], t)


def norm(v):
    return np.sqrt((v * v).sum(-1))


def angle(q):
    return 2 * np.arctan2(norm(q[..., 1:]), np.abs(q[..., 0]))


def between(a, b):
    return np.arctan2(norm(np.cross(a, b)), (a * b).sum(-1))


class Joints:
    """Columns of /joints, and where the joints' bodies are; the world stands at the origin."""

    def __init__(self, file):
        table = {name: column[:] for name, column in file["joints"].items()}
        self.kind = np.array([kind.decode() for kind in table["kind"]])
        self.a, self.b = table["body_a"], table["body_b"]
        self.world = table["world"]
        bodies = file["particles/bodies"]
        start = self.poses(bodies["initial_position"][:], bodies["initial_orientation"][:])
        self.start_turn = times(inverse(start[1]), start[3])
        self.axis1, self.axis2 = table["axis1_a"], table["axis2_b"]
        self.axis1_in_b = rotated(inverse(start[3]), rotated(start[1], self.axis1))
        # What a slider and a fixed joint hold: the second centre as the first saw it; to the world, the first's place there.
        seen = rotated(inverse(start[1]), start[2] - start[0])
        by_centre, to_world = np.isin(self.kind, ("slider", "fixed"))[:, None], (self.b < 0)[:, None]
        self.in_a = np.where(by_centre, np.where(to_world, 0, seen), table["anchor_a"])
        self.in_b = np.where(by_centre, np.where(to_world, start[0], 0), table["anchor_b"])
        self.slides = (self.kind == "slider") | ((self.kind == "hinge2") & (table["stiffness"] > 0))

    def poses(self, position, orientation):
        """Of both bodies of each joint: positions and orientations."""
        def of(body):
            static = (body < 0)[:, None]
            return np.where(static, 0, position[body]), np.where(static, [1.0, 0, 0, 0], orientation[body])
        return (*of(self.a), *of(self.b))

    def gaps(self, position, orientation):
        """[J][3] m, in the frame of the first body."""
        pa, qa, pb, qb = self.poses(position, orientation)
        gap = self.in_a - rotated(inverse(qa), pb + rotated(qb, self.in_b) - pa)
        along = (gap * self.axis1).sum(-1, keepdims=True) * self.axis1
        return np.where(self.slides[:, None], gap - along, gap)

    def bends(self, position, orientation):
        """[J] rad by which a joint is turned where it must not turn."""
        pa, qa, pb, qb = self.poses(position, orientation)
        axis = rotated(qa, self.axis1)
        crossed = np.abs(between(axis, rotated(qb, self.axis2)) - between(self.axis1_in_b, self.axis2))
        whole = angle(times(inverse(self.start_turn), times(inverse(qa), qb)))
        # A pose that is not finite spoils what depends on a part of it only.
        spoilt = 0 * (pa.sum(-1) + qa.sum(-1) + pb.sum(-1) + qb.sum(-1))
        hinge = between(axis, rotated(qb, self.axis1_in_b))
        return spoilt + np.select([self.kind == "ball", self.kind == "hinge", np.isin(self.kind, ("universal", "hinge2"))],
                                  [0 * crossed, hinge, crossed], whole)


class Run:
    def __init__(self, path):
        self.file = file = h5py.File(path, "r")
        self.frames = int(file.attrs["frames_committed"])
        self.every = int(file.attrs["record_every"])
        bodies = file["particles/bodies"]
        self.rows = self.frames // self.every
        self.world = bodies["world"][:]
        self.num_worlds = len(file["worlds/gravity"])
        self.mass, self.inertia = bodies["mass"][:], bodies["inertia"][:]
        self.gravity = file["worlds/gravity"][:][self.world]
        self.joints = Joints(file)
        for name in ("position", "orientation", "velocity", "angular_velocity"):
            setattr(self, name, bodies[name]["value"][:self.rows])
        self.step = bodies["position/step"][:self.rows]
        self.measured = file["timings/frame/measured"][:self.frames]

    def frame_of(self, row):
        return (row + 1) * self.every - 1

    def broken_in(self, frame):
        table = self.file.get("observables/joint")
        if table is None or "broken_in" not in table:
            return np.full(len(self.joints.a), -1)
        return table["broken_in"][frame]

    def points(self, frame):
        """Column -> values of the frame's contacts."""
        first, count = self.file["contacts/frame/first"][frame], self.file["contacts/frame/count"][frame]
        names = self.file["contacts/point"].attrs["columns"].decode().split()
        return dict(zip(names, self.file["contacts/point"][first:first + count].T))

    def by_world(self, values):
        return np.array([np.add.reduce(values[self.world == w]) for w in range(self.num_worlds)])

    def energy(self, row):
        local = rotated(inverse(self.orientation[row]), self.angular_velocity[row])
        spin = (local[:, None, :] @ self.inertia @ local[:, :, None])[:, 0, 0]
        height = (self.gravity * self.position[row]).sum(-1)
        return self.by_world(self.mass * (0.5 * (self.velocity[row]**2).sum(-1) - height) + 0.5 * spin)

    def angular_momentum(self, row):
        local = rotated(inverse(self.orientation[row]), self.angular_velocity[row])
        spin = rotated(self.orientation[row], (self.inertia @ local[:, :, None])[:, :, 0])
        return self.by_world(spin + self.mass[:, None] * np.cross(self.position[row], self.velocity[row]))

    def joint_gap(self, row):
        gap = norm(self.joints.gaps(self.position[row], self.orientation[row]))
        gap[self.broken_in(self.frame_of(row)) >= 0] = 0
        return np.array([gap[self.joints.world == w].max(initial=0) for w in range(self.num_worlds)])

    def islands(self, frame):
        """Sets of bodies that joints and contacts of the frame's last step connect, of each world."""
        broken, last_step = self.broken_in(frame), self.file["timings/frame/step"][frame] - 1
        acts = ((broken < 0) | (broken >= last_step)) & (self.joints.b >= 0)
        points = self.points(frame)
        touch = points["body_b"] >= 0
        ends = [np.concatenate([joint[acts], points[name][touch].astype(int)])
                for joint, name in ((self.joints.a, "body_a"), (self.joints.b, "body_b"))]
        lowest = np.arange(len(self.world))
        while True:  # the lowest body of an island spreads over its links
            before = lowest.copy()
            least = np.minimum(lowest[ends[0]], lowest[ends[1]])
            np.minimum.at(lowest, ends[0], least)
            np.minimum.at(lowest, ends[1], least)
            lowest = lowest[lowest]
            if np.array_equal(lowest, before):
                break
        roots = np.flatnonzero(lowest == np.arange(len(lowest)))
        return np.bincount(self.world[roots], minlength=self.num_worlds)

    def state_hash(self):
        file, frame, row = self.file, self.frames - 1, self.rows - 1
        warm = file["parameters/stepper"][()] == b"sor" and file["parameters/law"][()] == b"soft"
        broken = self.broken_in(frame)
        geom_world = file["geoms/world"][:]
        frozen = {w: s for w, s, kind in zip(file["events/world"], file["events/step"], file["events/kind"]) if kind == b"frozen"}
        hashes = []
        for w in range(self.num_worlds):
            body, joint = np.flatnonzero(self.world == w), np.flatnonzero(self.joints.world == w)
            words = bits(np.concatenate([getattr(self, name)[row, body] for name in
                                         ("position", "orientation", "velocity", "angular_velocity")], axis=1))
            for local, one in enumerate(joint):
                words += [local, broken[one]] if broken[one] >= 0 else []
            if warm:
                words += self.memory(frame, w, body[0], np.flatnonzero(geom_world == w)[0], joint)
            hashes.append(fnv1a(words + ([frozen[w]] if w in frozen else [])))
        return f"{fnv1a(hashes):016x}"

    def memory(self, frame, world, first_body, first_geom, joints):
        if "contacts" not in self.file:
            sys.exit(f"judge.py: {self.file.filename}: the hash of this run has the forces of its contacts, which the file lacks; "
                     "record it with --record contacts")
        words, points = [], self.points(frame)
        for i in np.flatnonzero(points["world"] == world):
            b = points["body_b"][i]
            row = [points["geom_a"][i] - first_geom, points["geom_b"][i] - first_geom, points["body_a"][i] - first_body,
                   b - first_body if b >= 0 else -1]
            row += [points[f"arm_{axis}"][i] for axis in "xyz"] + [points["normal_force"][i]]
            words += bits(row + [points[f"friction_{axis}"][i] for axis in "xyz"])
        parts = [self.file[f"observables/joint/{name}"][frame][joints] for name in ("force", "torque", "control", "rotor", "angle")]
        for local, row in enumerate(np.concatenate(parts, axis=1)):
            words += [local] + bits(row) if any(bits(row)) else []
        return words


def judge_run(path):
    """Largest differences between what is recomputed and what the file says; each with the size of what was compared."""
    run, found = Run(path), {}

    def compare(name, mine, stored):
        size, apart = found.get(name, (0, 0))
        both = np.isfinite(mine) & np.isfinite(stored)
        assert np.array_equal(np.isfinite(mine), np.isfinite(stored)), name
        apart = max(apart, np.abs(np.where(both, mine - stored, 0)).max())
        found[name] = (max(size, np.abs(np.where(both, stored, 0)).max()), apart)

    seen = run.file["observables/world"]
    with np.errstate(invalid="ignore"):
        for row in range(run.rows):
            frame = run.frame_of(row)
            compare("energy", run.energy(row), seen["energy"][frame])
            compare("linear_momentum", run.by_world(run.mass[:, None] * run.velocity[row]), seen["linear_momentum"][frame])
            compare("angular_momentum", run.angular_momentum(row), seen["angular_momentum"][frame])
            compare("joint_gap", run.joint_gap(row), seen["joint_gap"][frame])
            if "contacts" in run.file:
                points = run.points(frame)
                awake = points["awake"] == 1
                deepest = [points["depth"][awake & (points["world"] == w)].max(initial=0) for w in range(run.num_worlds)]
                compare("islands", run.islands(frame), seen["islands"][frame])
                compare("contacts", np.bincount(points["world"][awake].astype(int), minlength=run.num_worlds), seen["contacts"][frame])
                compare("max_penetration", np.array(deepest), seen["max_penetration"][frame])
    hashed = run.state_hash()
    return {"state_hash": hashed, "as_stored": hashed == run.file.attrs["state_hash"].decode(), "differences": found}


def summary(errors, edges, scale, broken):
    """Categories of 5.3, and a class of its own for joints that are broken in one of the two."""
    finite = np.isfinite(errors)
    good = errors[finite]
    share = good * scale
    band = np.searchsorted(edges, share, side="right")
    if scale != 1:
        band[share == edges[-1]] = 2  # half a turn is no more than 50 %
    counts = [int(n) for n in np.bincount(band, minlength=4)] + [int((~finite).sum())]
    ordered = np.sort(good)
    place = 0.99 * (len(ordered) - 1)
    low = int(place) if len(ordered) else 0
    p99 = ordered[low] + (place - low) * (ordered[min(low + 1, len(ordered) - 1)] - ordered[low]) if len(ordered) else 0.0
    return {"count": len(errors) + broken, "rms": float(np.sqrt(np.mean(good**2))) if len(good) else 0.0, "p99": float(p99),
            "max": float(good.max(initial=0)), "bands": counts, "broken": broken}


def frame_errors(run, reference, row):
    """Errors of bodies, and of joints that hold in both; how many do not."""
    bodies = (run.position[row], run.orientation[row]), (reference.position[row], reference.orientation[row])
    broken = np.zeros(len(run.joints.a), bool)
    for one in (run, reference):
        steps = one.broken_in(one.frame_of(row))
        broken |= steps >= 0
    gaps = [reference.joints.gaps(*poses) for poses in bodies]
    bends = [reference.joints.bends(*poses) for poses in bodies]
    turn = times(inverse(bodies[0][1]), bodies[1][1])
    return {"body_position": norm(bodies[0][0] - bodies[1][0]), "body_orientation": angle(turn),
            "joint_position": norm(gaps[0] - gaps[1])[~broken], "joint_orientation": np.abs(bends[0] - bends[1])[~broken]}, int(
                broken.sum())


def judge_diff(run_path, reference_path):
    """Name -> summary over the measured frames that both have."""
    run, reference = Run(run_path), Run(reference_path)
    rows = [r for r in range(min(run.rows, reference.rows)) if reference.measured[reference.frame_of(r)]]
    with np.errstate(invalid="ignore"):
        frames = [frame_errors(run, reference, row) for row in rows]
    table = {}
    for name in frames[0][0]:
        errors = np.concatenate([errors[name] for errors, _ in frames])
        broken = sum(count for _, count in frames) if name.startswith("joint") else 0
        edges, scale = (POSITION_EDGES, 1) if name.endswith("position") else (TURN_EDGES, 0.5 / np.pi)
        table[name] = summary(errors, edges, scale, broken)
    return table


def judge_constraints(path):
    """Name -> summary of what a run's own joints and contacts ask for, over its measured frames."""
    run = Run(path)
    rows = [row for row in range(run.rows) if run.measured[run.frame_of(row)]]
    gaps, bends, depths, slips, broken = [], [], [], [], 0
    dt = run.file["parameters/dt"][()]
    with np.errstate(invalid="ignore"):
        for row in rows:
            frame = run.frame_of(row)
            holds = run.broken_in(frame) < 0
            broken += int((~holds).sum())
            gaps.append(norm(run.joints.gaps(run.position[row], run.orientation[row]))[holds])
            bends.append(run.joints.bends(run.position[row], run.orientation[row])[holds])
            if "contacts" not in run.file:
                continue
            points = run.points(frame)
            awake = points["awake"] == 1
            point, normal, friction = (np.stack([points[f"{name}_{axis}"][awake] for axis in "xyz"], axis=1)
                                       for name in ("position", "normal", "friction"))
            depths.append(np.maximum(points["depth"][awake], 0))
            speed = 0
            for body, sign in ((points["body_a"][awake].astype(int), 1), (points["body_b"][awake].astype(int), -1)):
                carried = run.velocity[row, body] + np.cross(run.angular_velocity[row, body], point - run.position[row, body])
                speed = speed + sign * np.where((body >= 0)[:, None], carried, 0)
            along = norm(speed - (speed * normal).sum(-1, keepdims=True) * normal)
            push = points["normal_force"][awake]
            sticks = (push > 0) & (norm(friction) < 0.99 * points["mu"][awake] * push)
            slips.append(dt * along[sticks])
    table = {"joint_gap": summary(np.concatenate(gaps), POSITION_EDGES, 1, broken),
             "joint_bend": summary(np.concatenate(bends), TURN_EDGES, 0.5 / np.pi, broken)}
    if depths:
        table["penetration"] = summary(np.concatenate(depths), POSITION_EDGES, 1, 0)
        table["slip"] = summary(np.concatenate(slips), POSITION_EDGES, 1, 0)
    return table


def diff_text(table, what="drift:"):
    """The lines of `pbreport diff` that show it."""
    lines = []
    for name, s in table.items():
        in_m = not name.endswith(("orientation", "bend"))
        counts = [f"{n} {band}" for n, band in zip(s["bands"], POSITION_NAMES if in_m else TURN_NAMES)]
        if s["broken"] > 0:
            counts.append(f"{s['broken']} broken")
        lines.append("%s %-17s rms %10.4g  p99 %10.4g  max %10.4g %-3s  (%s)" % (
            what, name, s["rms"], s["p99"], s["max"], "m" if in_m else "rad", ", ".join(counts)))
    return lines


def judge_nature(bodies):
    """Shares of the rows of /nature_bodies that nature determines to 1 mm, 1 cm and 10 cm: to a tenth of which two laws of sor agree, and
    each of them with itself in half as many steps."""
    soft, ode = bodies["soft"], bodies["ode"]
    with np.errstate(invalid="ignore"):
        uncertainty = np.max([norm(a - b) for a, b in ((soft, bodies["soft_halved"]), (ode, bodies["ode_halved"]), (soft, ode))], axis=0)
    finite = np.isfinite(uncertainty)
    assert np.array_equal(finite, np.isfinite(bodies["uncertainty"]))
    assert np.allclose(uncertainty[finite], bodies["uncertainty"][finite], rtol=1e-9, atol=1e-15)
    return [float((uncertainty < 0.1 * length_m).mean()) for length_m in (1e-3, 1e-2, 1e-1)]


def judge_study(path, budget_s):
    """Scene -> worst frame times and errors of its front, by rising time, the one that is chosen, the uncertainty of nature, and what it
    determines."""
    with h5py.File(path, "r") as file:
        cases, bodies = ({name: column[:] for name, column in file[table].items()} for table in ("cases", "nature_bodies"))
    time, error = cases["frame_time_worst"], cases["defect_body_position_rms"]
    kinds = ("body_position", "body_orientation", "joint_position", "joint_orientation")
    blown = sum(cases[f"defect_{kind}_bands"][:, 4] for kind in kinds) > 0
    falls = cases["rest_fallen"] > 0
    result = {}
    for scene in dict.fromkeys(cases["scene"]):
        mine = np.flatnonzero((cases["scene"] == scene) & (cases["kind"] == b"setting"))

        def front(candidates):
            return [i for i in candidates if not blown[i] and not any(
                (time[j], error[j], j) < (time[i], error[i], i) and error[j] <= error[i] for j in candidates if not blown[j])]
        points = sorted(front(mine), key=lambda i: time[i])
        within = [i for i in front([i for i in mine if not falls[i]]) if time[i] <= budget_s]
        chosen = min(within, key=lambda i: error[i], default=None)
        [nature] = np.flatnonzero((cases["scene"] == scene) & (cases["kind"] == b"nature"))
        result[scene.decode()] = {"uncertainty": float(error[nature]), "front": [[float(time[i]), float(error[i])] for i in points],
                                  "determined": judge_nature({name: column[bodies["scene"] == scene] for name, column in bodies.items()}),
                                  "chosen": None if chosen is None else [float(time[chosen]), float(error[chosen])]}
    return result


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "run":
        print(json.dumps(judge_run(sys.argv[2]), indent=1, default=float))
    elif len(sys.argv) == 4 and sys.argv[1] == "diff":
        print("\n".join(diff_text(judge_diff(*sys.argv[2:]))))
        for whose, path in zip(("run", "reference"), sys.argv[2:]):
            print("\n".join(diff_text(judge_constraints(path), f"constraints of the {whose}:")))
    elif len(sys.argv) == 4 and sys.argv[1] == "study":
        print(json.dumps(judge_study(sys.argv[2], 1e-3 * float(sys.argv[3])), indent=1))
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
