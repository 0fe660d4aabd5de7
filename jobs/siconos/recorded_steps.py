"""Recorded steps of pbmpi as problems of contacts with Coulomb's friction: one problem an island.

All follows from what a run's file has (io/SCHEMA.md); docs/research/siconos.md has the formulas. Needs a run with --record contacts and
--steps-per-frame 1, so that a step stands between two recorded states."""
import dataclasses

import h5py
import numpy as np


def times(q, r):
    """Products of quaternions (w, x, y, z)."""
    w = q[..., :1] * r[..., :1] - (q[..., 1:] * r[..., 1:]).sum(-1, keepdims=True)
    return np.concatenate([w, q[..., :1] * r[..., 1:] + r[..., :1] * q[..., 1:] + np.cross(q[..., 1:], r[..., 1:])], -1)


def inverse(q):
    return q * [1, -1, -1, -1]


def matrix(q):
    """Rotation matrices of unit quaternions."""
    w, x, y, z = np.moveaxis(np.asarray(q), -1, 0)
    return np.moveaxis(np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                                 [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                                 [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]), (0, 1), (-2, -1))


def across(n):
    """Two unit vectors across the unit vector n and each other."""
    p = np.cross(n, np.eye(3)[np.argmin(np.abs(n))])
    p /= np.linalg.norm(p)
    return p, np.cross(n, p)


@dataclasses.dataclass
class Problem:
    """u = H^T v + C r + w, M (v - v_free) = H r + G l, G^T v + D l = s; r and u of each contact (normal, two across) fulfil
    Coulomb's law. Velocities of n bodies: [6 n], linear before angular, of a body each."""
    world: int
    step: int          # done before this one
    bodies: np.ndarray
    inverse_mass: np.ndarray  # [n][6][6]
    H: np.ndarray      # [6 n][3 nc]
    C: np.ndarray      # [3 nc] s/kg
    w: np.ndarray      # [3 nc] m/s
    mu: np.ndarray     # [nc]
    G: np.ndarray      # [6 n][nj]
    D: np.ndarray      # [nj]
    s: np.ndarray      # [nj]
    v_free: np.ndarray
    v: np.ndarray      # [6 n] as recorded
    r: np.ndarray      # [3 nc] N s, as recorded
    forward: float     # largest distance of v_free from that of the state before, NaN if not known

    def times_inverse_mass(self, columns):
        n = len(self.bodies)
        return np.einsum("bij,bjk->bik", self.inverse_mass, columns.reshape(n, 6, -1)).reshape(6 * n, -1)

    @property
    def u(self):
        """Of the recorded velocities."""
        return self.H.T @ self.v + self.C * self.r + self.w

    def condensed(self):
        """W, q of u = W r + q, joints eliminated."""
        minv_h = self.times_inverse_mass(self.H)
        W = self.H.T @ minv_h + np.diag(self.C)
        q = self.H.T @ self.v_free + self.w
        if self.G.shape[1]:
            V, R = minv_h.T @ self.G, self.joint_matrix()
            solved = np.linalg.solve(R, np.column_stack([V.T, self.G.T @ self.v_free - self.s]))
            W, q = W - V @ solved[:, :-1], q - V @ solved[:, -1]
        return (W + W.T) / 2, q

    def joint_matrix(self):
        R = self.G.T @ self.times_inverse_mass(self.G)
        return (R + R.T) / 2 + np.diag(self.D)

    def velocities(self, r):
        """[6 n] after the impulses r, with joints that hold."""
        v = self.v_free + self.times_inverse_mass((self.H @ r)[:, None])[:, 0]
        if self.G.shape[1]:
            v = v + self.times_inverse_mass((self.G @ np.linalg.solve(self.joint_matrix(), self.s - self.G.T @ v))[:, None])[:, 0]
        return v


class Joints:
    """Rows of joints, as docs/research/siconos.md has them; limits and motors are taken as impulses that are known."""

    def __init__(self, file):
        self.table = {name: column[:] for name, column in file["joints"].items()}
        self.kind = [kind.decode() for kind in self.table["kind"]]
        bodies = file["particles/bodies"]
        x, q = bodies["initial_position"][:], bodies["initial_orientation"][:]
        self.start = [(x[a], q[a], x[b] if b >= 0 else np.zeros(3), q[b] if b >= 0 else np.array([1.0, 0, 0, 0]), b >= 0)
                      for a, b in zip(self.table["body_a"], self.table["body_b"])]
        self.of_world = [np.flatnonzero(self.table["world"] == w) for w in range(len(file["worlds/gravity"]))]

    def rows(self, j, xa, qa, xb, qb, k, cfm, h):
        """Lists of (J_a [6], J_b [6], compliance, aim), and of the two axes of limits and motors (J_a, J_b)."""
        t, kind = self.table, self.kind[j]
        xa0, qa0, xb0, qb0, two = self.start[j]
        Ra, Rb = matrix(qa), matrix(qb)
        rows, axes = [], []

        def line(direction, arm_a, arm_b, aim, c=cfm):
            rows.append((np.r_[direction, np.cross(arm_a, direction)], -np.r_[direction, np.cross(arm_b, direction)], c, aim))

        def turn(axis, aim):
            rows.append((np.r_[0, 0, 0, axis], -np.r_[0, 0, 0, axis], cfm, aim))
        if kind == "fixed":
            in_a, in_b = (matrix(qa0).T @ (xb0 - xa0), np.zeros(3)) if two else (np.zeros(3), xa0)
        else:
            in_a, in_b = t["anchor_a"][j], t["anchor_b"][j]
        arm_a, arm_b = Ra @ in_a, Rb @ in_b
        axis1, axis2 = Ra @ t["axis1_a"][j], Rb @ t["axis2_b"][j]
        if kind in ("ball", "hinge", "universal", "fixed", "hinge2"):
            gap = xb + arm_b - xa - arm_a
            stiffness, damping = t["stiffness"][j], t["damping"][j]
            directions = np.eye(3) if kind != "hinge2" else (axis1, *across(axis1))
            for i, d in enumerate(directions):
                if kind == "hinge2" and i == 0 and stiffness > 0:
                    total = h * stiffness + damping
                    line(d, arm_a, arm_b, stiffness / total * (d @ gap), 1 / (total * h))
                else:
                    line(d, arm_a, arm_b, k * (d @ gap))
        if kind == "slider":
            apart = xb - xa
            arm = apart / 2 if two else 0 * apart
            anchor_b = matrix(qb0).T @ (xa0 - xb0)
            for d in across(axis1):
                line(d, arm, -arm, k * (d @ (apart + Rb @ anchor_b)))  # both end in the middle of the bodies
            axes.append((np.r_[axis1, np.cross(arm, axis1)], np.r_[-axis1, np.cross(arm, axis1)]))
        if kind == "hinge":
            axis1_b = Rb @ matrix(qb0).T @ matrix(qa0) @ t["axis1_a"][j]
            error = np.cross(axis1, axis1_b)
            for d in across(axis1):
                turn(d, k * (error @ d))
        if kind in ("fixed", "slider"):
            start, now = times(inverse(qa0), qb0), times(inverse(qa), qb)
            whole = times(now, inverse(start))
            error = Ra @ whole[1:] * (-1 if whole[0] < 0 else 1)
            for d in range(3):
                turn(np.eye(3)[d], 2 * k * error[d])
        if kind in ("universal", "hinge2"):
            crossed = np.cross(axis1, axis2)
            sine, cosine = np.linalg.norm(crossed), axis1 @ axis2
            a1, a2 = matrix(qa0) @ t["axis1_a"][j], matrix(qb0) @ t["axis2_b"][j]
            cos0, sin0 = (a1 @ a2, np.linalg.norm(np.cross(a1, a2)))
            turn(crossed / sine, -k * cosine if kind == "universal" else k * (cos0 * sine - sin0 * cosine))
        if kind in ("hinge", "universal", "hinge2"):
            axes.append((np.r_[0, 0, 0, axis1], -np.r_[0, 0, 0, axis1]))
        if kind in ("universal", "hinge2"):
            axes.append((np.r_[0, 0, 0, axis2], -np.r_[0, 0, 0, axis2]))
        return rows, axes


class Steps:
    def __init__(self, path):
        self.file = file = h5py.File(path, "r")
        parameter = lambda name: file[f"parameters/{name}"][()]
        self.frames = int(file.attrs["frames_committed"])
        if file.attrs["record_every"] != 1 or file.attrs["first_frame"] != 0 or "contacts" not in file:
            raise ValueError(f"{path}: its contacts or states are not all there; record it with --record contacts, from the start")
        if self.frames and file["timings/frame/step"][0] != 1:
            raise ValueError(f"{path}: a frame has several steps; record it with --steps-per-frame 1")
        if "law" not in file["parameters"] or parameter("law") != b"coulomb":
            raise ValueError(f"{path}: its friction is no cone; record it with --law coulomb")
        self.dt = float(parameter("dt"))
        self.h = self.dt / int(parameter("substeps"))
        if self.h != self.dt:
            raise ValueError(f"{path}: its substeps are not in the file; record it with --substeps 1")
        bodies = file["particles/bodies"]
        self.world = bodies["world"][:]
        self.mass, self.inertia = bodies["mass"][:], bodies["inertia"][:]
        self.worlds = {name: column[:] for name, column in file["worlds"].items()}
        self.moving = {name: bodies[name]["value"] for name in ("position", "orientation", "velocity", "angular_velocity")}
        self.joints = Joints(file)
        self.columns = file["contacts/point"].attrs["columns"].decode().split()
        self.first, self.count = (file["contacts/frame"][name][:] for name in ("first", "count"))
        self.dropped = file["contacts/frame/dropped"][:]
        geoms = file["geoms"]
        self.restitution, self.actor, self.geom_world = geoms["restitution"][:], geoms["actor"][:], geoms["world"][:]
        pairs = file["pair_materials"]
        self.pairs = {(w, *sorted((a, b))): e for w, a, b, e in zip(*(pairs[name][:] for name in (
            "world", "actor_a", "actor_b", "restitution")))}

    def before(self, frame, name):
        return self.file[f"particles/bodies/initial_{name}"][:] if frame == 0 else self.moving[name][frame - 1]

    def points(self, frame):
        table = self.file["contacts/point"][self.first[frame]:self.first[frame] + self.count[frame]]
        return dict(zip(self.columns, table.T))

    def worlds_with_contacts(self, frame):
        points = self.points(frame)
        return np.unique(points["world"][points["awake"] == 1]).astype(int)

    def bounces(self, points, i):
        a, b = int(points["geom_a"][i]), int(points["geom_b"][i])
        given = self.pairs.get((self.geom_world[a], *sorted((self.actor[a], self.actor[b]))))
        return max(self.restitution[a], self.restitution[b]) if given is None else given

    def forces(self, frame, joints):
        tables = self.file["observables/joint"]
        return [tables[name][frame][joints] for name in ("force", "torque", "control")]

    def islands(self, frame, world):
        """Those with contacts, the largest first: bodies, rows of points(frame), joints of each."""
        points = self.points(frame)
        mine = np.flatnonzero((points["world"] == world) & (points["awake"] == 1))
        joints = self.joints.of_world[world]
        table = self.file.get("observables/joint")
        if table is not None and "broken_in" in table:
            broken = table["broken_in"][frame][joints]
            joints = joints[(broken < 0) | (broken >= frame)]
        root = {}

        def find(body):
            while root.setdefault(body, body) != body:
                body = root[body]
            return body
        links = [(int(points["body_a"][i]), int(points["body_b"][i])) for i in mine]
        held = [(int(self.joints.table["body_a"][j]), int(self.joints.table["body_b"][j])) for j in joints]
        for a, b in links + held:
            find(a)
            if b >= 0:
                root[find(a)] = find(b)
        islands = {}
        for i, (a, _) in zip(mine, links):
            islands.setdefault(find(a), []).append(i)
        order = sorted(islands, key=lambda one: (-len(islands[one]), one))
        return [(np.array(sorted(body for body in root if find(body) == island)), np.array(islands[island]),
                 [j for j, (a, _) in zip(joints, held) if find(a) == island]) for island in order]

    def problem(self, frame, world, bodies, contacts, joints):
        """Of an island; or, as text, why there is none."""
        if self.dropped[frame]:
            return "contacts found no room in the file"
        points, old = self.points(frame), {name: self.before(frame, name) for name in self.moving}
        h, law = self.h, {name: column[world] for name, column in self.worlds.items()}
        place = {body: k for k, body in enumerate(bodies)}
        n, nc = len(bodies), len(contacts)
        rotation = matrix(old["orientation"][bodies])
        inertia = rotation @ self.inertia[bodies] @ rotation.transpose(0, 2, 1)
        inverse_mass = np.zeros((n, 6, 6))
        inverse_mass[:, [0, 1, 2], [0, 1, 2]] = 1 / self.mass[bodies][:, None]
        inverse_mass[:, 3:, 3:] = np.linalg.inv(inertia)
        damping = np.exp(-h * np.r_[[law["linear_damping"]] * 3, [law["angular_damping"]] * 3])
        twist = lambda state: np.hstack([state["velocity"][bodies], state["angular_velocity"][bodies]])
        new = {name: self.moving[name][frame] for name in self.moving}
        v, v_old = (twist(new) / damping).ravel(), twist(old)
        if not np.isfinite(v).all():
            return "a number is not finite"
        x = old["position"]
        H, C, w = np.zeros((6 * n, 3 * nc)), np.zeros(3 * nc), np.zeros(3 * nc)
        r, mu = np.zeros(3 * nc), points["mu"][contacts]
        part = lambda name, i: np.array([points[f"{name}_{axis}"][i] for axis in "xyz"])
        forward = self.forward(law, v_old, inertia, v.shape)
        bouncing = False
        for c, i in enumerate(contacts):
            a, b, normal, at = int(points["body_a"][i]), int(points["body_b"][i]), part("normal", i), part("position", i)
            basis, depth = (normal, *across(normal)), points["depth"][i]
            impulse = part("impulse", i)
            for k, d in enumerate(basis):
                column = H[:, 3 * c + k].reshape(n, 6)
                column[place[a]] += np.r_[d, np.cross(at - x[a], d)]
                if b >= 0:
                    column[place[b]] -= np.r_[d, np.cross(at - x[b], d)]
                r[3 * c + k] = d @ impulse
            C[3 * c:3 * c + 3] = np.array([law["contact_cfm"], law["joint_cfm"], law["joint_cfm"]]) / h
            approach = H[:, 3 * c] @ v_old.ravel()
            bounce = -self.bounces(points, i) * approach if approach < -law["bounce_velocity"] else 0
            bouncing |= bounce > 0
            w[3 * c] = -(depth / h if depth < 0 else max(law["contact_erp"] / self.dt * depth, bounce))
        G, D, s, held, controls, pushes = [], [], [], np.zeros(6 * n), np.zeros(6 * n), []
        forces = self.forces(frame, joints) if joints else ([], [], [])
        for j, force, torque, control in zip(joints, *forces):
            a, b = int(self.joints.table["body_a"][j]), int(self.joints.table["body_b"][j])
            xb, qb = (x[b], old["orientation"][b]) if b >= 0 else (np.zeros(3), np.array([1.0, 0, 0, 0]))
            rows, axes = self.joints.rows(j, x[a], old["orientation"][a], xb, qb, law["joint_erp"] / h, law["joint_cfm"] / h, h)

            def spread(row):
                column = np.zeros((n, 6))
                column[place[a]] += row[0]
                if b >= 0:
                    column[place[b]] += row[1]
                return column.ravel()
            for row in rows:
                along = row[0][:3] @ force if row[0][:3].any() else row[0][3:] @ torque
                G.append(spread(row)), D.append(row[2]), s.append(row[3])
                held += h * along * G[-1]
            for k, (axis, one) in enumerate(zip(axes, control)):
                controls += h * one * spread(axis)
                if self.joints.table["motor_max_force"][j][k] > 0:
                    pushes.append(h * self.joints.table["motor_max_force"][j][k] * spread(axis))
        problem = Problem(world, frame, bodies, inverse_mass, H, C, w, mu, np.array(G).T.reshape(6 * n, -1), np.array(D), np.array(s),
                          0 * v, v, r, np.nan)
        problem.v_free = v - problem.times_inverse_mass((H @ r + held)[:, None])[:, 0]
        if forward is not None:
            apart = problem.v_free - forward - problem.times_inverse_mass(controls[:, None])[:, 0]
            if pushes and np.abs(apart).max() > 1e-9:
                # A motor at its joint's limit pushes with all it has, which no column of the file tells.
                pushed = problem.times_inverse_mass(np.array(pushes).T)
                apart = apart - pushed @ np.clip(np.rint(np.linalg.lstsq(pushed, apart, rcond=None)[0]), -1, 1)
            problem.forward = float(np.abs(apart).max())
        if bouncing and not problem.forward < 1e-9:
            return "something bounces in a step whose start is not in the file"
        return problem

    def forward(self, law, v_old, inertia, shape):
        """[6 n] velocities before any impulse, from the state before the step: gravity, and the implicit gyroscopic torque. None
        where air makes them others."""
        if law["air_density"] > 0:
            return None
        v = v_old.copy()
        momentum = np.einsum("bij,bj->bi", inertia, v[:, 3:])
        cross = np.zeros((len(v), 3, 3))
        for k in range(3):
            cross[:, :, k] = np.cross(momentum, np.eye(3)[k])
        v[:, 3:] = np.linalg.solve(inertia - self.dt * cross, momentum[:, :, None])[:, :, 0]
        v[:, :3] += self.h * law["gravity"]
        return v.reshape(shape)
