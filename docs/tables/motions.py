"""Motions known in closed form: where each body of scenes/exact is at any time. SI units, world frame."""
import dataclasses
import tomllib

import h5py
import numpy as np

X, Z = np.array([1.0, 0, 0]), np.array([0, 0, 1.0])


@dataclasses.dataclass
class Body:
    """A body as the run's file has it at the start of the simulation."""
    mass: float  # kg
    inertia: np.ndarray  # [3][3] kg m2, about the centre of mass, body frame
    position: np.ndarray  # [3] m
    orientation: np.ndarray  # [4] (w, x, y, z)
    velocity: np.ndarray  # [3] m/s
    spin: np.ndarray  # [3] rad/s, world frame


class Start:
    """What a run's file says of its first world: `bodies` by name, `gravity` [3] m/s2, and the scene's text as `scene`."""

    def __init__(self, file):
        self.scene = tomllib.loads(file["parameters/scene_text"].asstr()[()])
        self.gravity = file["worlds/gravity"][0]
        group = file["particles/bodies"]
        columns = ("mass", "inertia", "initial_position", "initial_orientation", "initial_velocity", "initial_angular_velocity")
        names = group["name"].asstr()[:]
        self.bodies = {name: Body(*values) for name, *values in zip(names, *(group[column][:] for column in columns))}

    @property
    def g(self):
        """m/s2, downwards."""
        return -self.gravity[2]

    def only(self):
        """(name, body) of the scene's only body."""
        (item,) = self.bodies.items()
        return item

    def table(self, kind, name):
        """The scene's [[actor]] or [[joint]] of that name."""
        return next(one for one in self.scene[kind] if one["name"] == name)

    def radius(self, name):
        return self.table("actor", name)["radius"]

    def mu(self):
        return self.scene["pair"][0]["mu"]


def rotation(orientations):
    """[..., 3, 3] of quaternions [..., 4] (w, x, y, z): body frame to world frame."""
    w, x, y, z = np.moveaxis(np.asarray(orientations, float), -1, 0)
    rows = ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)), (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def about(axis, angles):
    """[..., 3, 3]: turns by `angles` [rad] about the unit vector `axis`."""
    half = np.asarray(angles)[..., None] / 2
    return rotation(np.concatenate([np.cos(half), np.sin(half) * axis], axis=-1))


def jacobi(u, m):
    """(K, am u, sn u, cn u, dn u) of parameter m = k^2 by the arithmetic-geometric mean: Abramowitz and Stegun, 16.4 and 17.6."""
    a, b, c, ratios = 1.0, (1 - m)**0.5, m**0.5, []
    while abs(c) > 1e-16 and len(ratios) < 12:
        a, b, c = (a + b) / 2, (a * b)**0.5, (a - b) / 2
        ratios.append(c / a)
    phi = 2**len(ratios) * a * np.asarray(u, float)
    for ratio in reversed(ratios):
        phi = (phi + np.arcsin(ratio * np.sin(phi))) / 2
    sn = np.sin(phi)
    return np.pi / (2 * a), phi, sn, np.cos(phi), np.sqrt(1 - m * sn * sn)


def integrals(function, ends):
    """The integral of `function` from 0 to each of `ends` (rising, from 0 or later on), by 20 points of Gauss between each two."""
    points, weights = np.polynomial.legendre.leggauss(20)
    begins = np.concatenate([[0.0], ends[:-1]])
    half = (ends - begins) / 2
    return np.cumsum((function((begins + half)[:, None] + half[:, None] * points) * weights).sum(axis=-1) * half)


def in_time(t, pieces):
    """[times][3]: of `pieces` (from s, position, velocity, acceleration) the last one that has begun, each from its own instant on."""
    path = np.empty((len(t), 3))
    for begin, x, v, a in pieces:
        s = t[t >= begin, None] - begin
        path[t >= begin] = x + v * s + a * s * s / 2
    return path


def flight(t, start):
    name, body = start.only()
    return {name: in_time(t, [(0, body.position, body.velocity, start.gravity)])}


def damped(t, start):
    """Where v' = g - c v leads: v = g / c + (v0 - g / c) exp(-c t)."""
    name, body = start.only()
    c, t = start.scene["linear_damping"], t[:, None]
    last = start.gravity / c
    return {name: body.position + last * t + (body.velocity - last) * (1 - np.exp(-c * t)) / c}


def drag(t, start):
    """From rest, v' = g - k v^2, k = rho Cd A / (2 m), for a ball Cd = 0.47 and A = pi r^2 (scenes/FORMAT.md)."""
    name, body = start.only()
    k = start.scene["air"]["density"] * 0.47 * np.pi * start.radius(name)**2 / (2 * body.mass)
    return {name: body.position - Z * np.log(np.cosh(t * (start.g * k)**0.5))[:, None] / k}


def bounce(t, start):
    """Parabolas, at each end of which the ball goes up with e times the speed at which it came."""
    name, body = start.only()
    e, radius = start.table("actor", name)["material"]["restitution"], start.radius(name)
    pieces, x, speed = [(0, body.position, body.velocity, start.gravity)], body.position * (1, 1, 0) + Z * radius, None
    at = (2 * (body.position[2] - radius) / start.g)**0.5
    speed = start.g * at
    while at < t[-1]:
        speed *= e
        pieces.append((at, x, speed * Z, start.gravity))
        at += 2 * speed / start.g
    return {name: in_time(t, pieces)}


def slide(t, start):
    """Slows down by mu g until it stands."""
    name, body = start.only()
    v, slowing = body.velocity, start.mu() * start.g
    stop = v[0] / slowing
    return {name: in_time(t, [(0, body.position, v, -slowing * X), (stop, body.position + v * stop / 2, 0 * v, 0 * v)])}


def roll(t, start):
    """Slows down by mu g, and its surface speeds up by 5/2 mu g, until they are one at 5/7 of the first speed."""
    name, body = start.only()
    v, slowing = body.velocity, start.mu() * start.g
    rolls = 2 * v[0] / (7 * slowing)
    return {name: in_time(t, [(0, body.position, v, -slowing * X), (rolls, body.position + v * rolls * 6 / 7, v * 5 / 7, 0 * v)])}


def down(t, start, share_of_gravity):
    """From rest down the board, by the share of gravity that `share_of_gravity`(angle, mu) gives."""
    name, body = start.only()
    turn = start.table("actor", "board")["rotation"]
    angle = np.radians(turn["angle"])
    acceleration = start.g * share_of_gravity(angle, start.mu())
    return {name: in_time(t, [(0, body.position, 0 * X, acceleration * (about(np.array(turn["axis"], float), angle) @ X))])}


def pendulum(t, start):
    """Turned by q about y from hanging: sin(q / 2) = k sn(w t + K) from rest; q = 2 am(q' t / 2) from the lowest point over the top."""
    name, body = start.only()
    lever = np.linalg.norm(body.position)
    w = (body.mass * start.g * lever / (body.inertia[1, 1] + body.mass * lever**2))**0.5
    if body.spin[1] == 0:
        k = np.sin(np.arctan2(-body.position[0], -body.position[2]) / 2)
        q = 2 * np.arcsin(k * jacobi(w * t + jacobi(0, k * k)[0], k * k)[2])
    else:
        q = 2 * jacobi(body.spin[1] * t / 2, (2 * w / body.spin[1])**2)[1]
    return {name: about(np.array([0, 1.0, 0]), q) @ (-lever * Z)}


def ladder(t, start):
    """From the vertical by q, a pendulum from rest at pi - q: its middle is at half its length times (sin q, cos q) from the corner."""
    name, body = start.only()
    radius, half = start.radius(name), start.table("actor", name)["length"] / 2
    w = (body.mass * start.g * half / (body.inertia[0, 0] + body.mass * half**2))**0.5
    k = np.cos(np.arctan2(body.position[0] - radius, body.position[2] - radius) / 2)
    q = np.pi - 2 * np.arcsin(k * jacobi(w * t + jacobi(0, k * k)[0], k * k)[2])
    return {name: np.stack([radius + half * np.sin(q), 0 * q, radius + half * np.cos(q)], axis=-1)}


def two_links(t, start):
    """M q'' + K q = 0 of small angles q from hanging, from rest, by its normal modes."""
    upper, lower = start.bodies.values()
    c = start.table("actor", "upper")["size"][2] / 2
    m, inertia = upper.mass, upper.inertia[1, 1]
    masses = np.array([[inertia + 5 * m * c * c, 2 * m * c * c], [2 * m * c * c, inertia + m * c * c]])
    root = np.linalg.inv(np.linalg.cholesky(masses))
    squares, modes = np.linalg.eigh(root @ np.diag([3.0, 1.0]) @ root.T * m * start.g * c)
    shapes = root.T @ modes
    q0 = [np.arctan2(-rod[0], -rod[2]) for rod in (upper.position, lower.position - 2 * upper.position)]
    q = np.cos(np.outer(t, squares**0.5)) * np.linalg.solve(shapes, q0) @ shapes.T
    middle = [c * np.stack([-np.sin(one), 0 * one, -np.cos(one)], axis=-1) for one in q.T]
    return {"upper": middle[0], "lower": 2 * middle[0] + middle[1]}


def euler(t, moments, spin):
    """[times][3] rad/s: the free body's spin about its principal axes, by Landau and Lifshitz, Mechanics, 37."""
    energy2, momentum2 = (moments * spin**2).sum(), ((moments * spin)**2).sum()
    order = np.argsort(moments)
    if momentum2 < energy2 * moments[order[1]]:
        order = order[::-1]
    i, w = moments[order], spin[order]
    sign = np.linalg.det(np.eye(3)[order])  # -1: the order is left-handed, which reverses the equations
    a = ((energy2 * i[2] - momentum2) / (i[0] * (i[2] - i[0])))**0.5
    b = ((energy2 * i[2] - momentum2) / (i[1] * (i[2] - i[1])))**0.5
    c = ((momentum2 - energy2 * i[0]) / (i[2] * (i[2] - i[0])))**0.5
    rate = ((i[2] - i[1]) * (momentum2 - energy2 * i[0]) / i.prod())**0.5
    m = (i[1] - i[0]) * (energy2 * i[2] - momentum2) / ((i[2] - i[1]) * (momentum2 - energy2 * i[0]))
    # (a cn, b sn, c dn) solves the equations of a right-handed order; so does what has the signs of two components changed.
    side = np.sign(w[2])
    turn = side * sign * (1 if i[2] > i[0] else -1)
    first = np.arctan2(turn * w[1] / b, w[0] / a)
    u = rate * t + np.sign(first) * integrals(lambda phi: 1 / np.sqrt(1 - m * np.sin(phi)**2), np.array([abs(first)]))[0]
    _, _, sn, cn, dn = jacobi(u, m)
    path = np.empty((*np.shape(t), 3))
    path[..., order[0]], path[..., order[1]], path[..., order[2]] = a * cn, turn * b * sn, side * c * dn
    return path


def free_turns(t, body):
    """[times][3][3]: the body's frame in the world. Its momentum L stays; the principal axis that has dn goes round L by a quadrature."""
    moments, first = np.diag(body.inertia), rotation(body.orientation)
    spin = first.T @ body.spin
    momentum = np.linalg.norm(moments * spin)
    axis = np.argmax(moments) if (moments * spin**2).sum() * np.sort(moments)[1] < momentum**2 else np.argmin(moments)

    def rate(times):
        along = moments[axis] * euler(times, moments, spin)[..., axis]**2
        return momentum * ((moments * spin**2).sum() - along) / (momentum**2 - moments[axis] * along)

    def triads(spins):
        z = moments * spins / momentum
        x = np.eye(3)[axis] - z[..., axis, None] * z
        x /= np.linalg.norm(x, axis=-1, keepdims=True)
        return np.stack([x, np.cross(z, x), z], axis=-1)

    angle = integrals(rate, t)
    world = about(first @ (moments * spin) / momentum, angle) @ first @ triads(spin)
    return world @ np.swapaxes(triads(euler(t, moments, spin)), -1, -2)


def disc_turns(t, body):
    """Spins about its axis at w3 (1 - I3 / I1), which goes round its momentum L at L / I1."""
    first = rotation(body.orientation)
    momentum = first @ (body.inertia @ (first.T @ body.spin))
    across, along = body.inertia[0, 0], body.inertia[2, 2]
    size = np.linalg.norm(momentum)
    return about(momentum / size, size / across * t) @ first @ about(Z, (1 - along / across) * (first.T @ body.spin)[2] * t)


def spin(t, start, turns):
    """The ends of arms of 1 m along x and z that turn with each body."""
    paths = {}
    for name, body in start.bodies.items():
        frames = turns(t, body)
        for arm, column in (("x", 0), ("z", 2)):
            paths[f"{name}:{arm}"] = body.position + frames[..., column]
    return paths


def top(t, start):
    """Goes round the vertical at the smaller W of I1 W^2 cos q - I3 w3 W + m g l = 0."""
    name, body = start.only()
    lever = np.linalg.norm(body.position)
    axis = body.position / lever
    across = body.inertia[0, 0] + body.mass * lever**2
    momentum = body.inertia[2, 2] * body.spin @ axis
    rate = (momentum - (momentum**2 - 4 * across * axis[2] * body.mass * start.g * lever)**0.5) / (2 * across * axis[2])
    return {name: about(Z, rate * t) @ body.position}


def impacts(t, start, restitution):
    """Balls on a line, from left to right: each two that meet part at `restitution` times their speed; of others nothing comes."""
    names = sorted(start.bodies, key=lambda name: start.bodies[name].position[0])
    m, x, v = (np.array([getattr(start.bodies[name], part) for name in names]) for part in ("mass", "position", "velocity"))
    reach = np.array([start.radius(name.split(".")[0]) for name in names])
    pieces = {name: [(0, x[n], v[n].copy(), 0 * X)] for n, name in enumerate(names)}
    at = 0.0
    while True:
        closing = v[:-1, 0] - v[1:, 0]
        waits = np.where(closing > 0, (x[1:, 0] - x[:-1, 0] - reach[1:] - reach[:-1]) / np.where(closing > 0, closing, 1), np.inf)
        first = int(np.argmin(waits))
        if at + waits[first] > t[-1]:
            return {name: in_time(t, pieces[name]) for name in names}
        at, x = at + waits[first], x + v * waits[first]
        pair = slice(first, first + 2)
        v[pair] += (1 + restitution) * closing[first] * np.outer([-m[first + 1], m[first]], X) / m[pair].sum()
        for n in (first, first + 1):
            pieces[names[n]].append((at, x[n], v[n].copy(), 0 * X))


def suspension(t, start):
    """m z'' = -k z - c z' - m g from z = 0, below critical damping."""
    joint, body = start.table("joint", "spring"), start.bodies["weight"]
    decay, square = joint["damping"] / (2 * body.mass), joint["stiffness"] / body.mass
    w = (square - decay**2)**0.5
    z = -start.g / square * (1 - np.exp(-decay * t) * (np.cos(w * t) + decay / w * np.sin(w * t)))
    return {"weight": body.position + np.outer(z, Z)}


def motor(t, start):
    """I q'' = M until q' is the motor's speed."""
    name, body = start.only()
    wanted = start.table("joint", "hinge")["motor"]
    rate = wanted["max_force"] / (body.inertia[2, 2] + body.mass * body.position @ body.position)
    reached = wanted["velocity"] / rate
    q = np.where(t < reached, rate * t * t / 2, wanted["velocity"] * (t - reached / 2))
    return {name: about(Z, q) @ body.position}


# scene: (times [s] rising, Start) -> {point: [times][3] m}. A point is a body's centre, or "body:x", the end of an arm of 1 m along its x axis.
MOTIONS = {
    "flight": flight,
    "damped": damped,
    "drag": drag,
    "bounce": bounce,
    "slide": slide,
    "roll": roll,
    "incline_stay": lambda t, start: down(t, start, lambda angle, mu: 0),
    "incline_slide": lambda t, start: down(t, start, lambda angle, mu: np.sin(angle) - mu * np.cos(angle)),
    "incline_roll": lambda t, start: down(t, start, lambda angle, mu: 5 / 7 * np.sin(angle)),
    "ladder": ladder,
    "pendulum": pendulum,
    "pendulum_over": pendulum,
    "two_links": two_links,
    "free_spin": lambda t, start: spin(t, start, free_turns),
    "disc_spin": lambda t, start: spin(t, start, disc_turns),
    "top": top,
    "cradle": lambda t, start: impacts(t, start, 1),
    "impact": lambda t, start: impacts(t, start, start.table("actor", "light")["material"]["restitution"]),
    "suspension": suspension,
    "motor": motor,
}


def recorded(file, points):
    """(times [s], {point: [times][3] m}) of a run's file."""
    group = file["particles/bodies"]
    done = file.attrs["frames_committed"] // file.attrs["record_every"]
    names = list(group["name"].asstr()[:])
    times, positions, orientations = (group[f"{part}"][:done] for part in ("position/time", "position/value", "orientation/value"))
    paths = {}
    for point in points:
        name, _, arm = point.partition(":")
        body = names.index(name)
        paths[point] = positions[:, body] + (rotation(orientations[:, body])[..., "xyz".index(arm)] if arm else 0)
    return times, paths


def error(path, scene):
    """(largest, rms) distance [m] over points and recorded instants of the run in `path` from the motion of that name."""
    with h5py.File(path) as file:
        times = file["particles/bodies/position/time"][:file.attrs["frames_committed"]]
        exact = MOTIONS[scene](times, Start(file))
        _, paths = recorded(file, exact)
    distances = np.array([np.linalg.norm(paths[point] - exact[point], axis=-1) for point in exact])
    return distances.max(), np.sqrt((distances**2).mean())
