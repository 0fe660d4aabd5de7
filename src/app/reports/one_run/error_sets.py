"""Errors of bodies and of constraints over the frames of runs, summarised in the paper's categories."""
import dataclasses
import math

import numpy as np

from reports.errors import Errors
from reports.one_run.rigid import cross, distance, dot, norm, rotation_angle
from reports.samples import total

POSITION_BANDS = ("< 1 cm", "1-10 cm", "10-100 cm", "> 100 cm", "inf/NaN")
ORIENTATION_BANDS = ("< 5 %", "5-25 %", "25-50 %", "> 50 %", "inf/NaN")  # of a full turn
POSITION_EDGES_M, ORIENTATION_EDGES = (0.01, 0.1, 1.0), (0.05, 0.25, 0.5)
NEARLY = 0.99  # of its limit: a pyramid holds more along its diagonal, so a contact that slides by this test may still stick, not the reverse
CONSTRAINTS = {"joint_gap": "m", "joint_bend": "rad", "penetration": "m", "slip": "m"}


def summarize(values, unit, broken=0):
    """Errors of numbers in "m" or "rad", one after the other."""
    finite = values[np.isfinite(values)]
    if unit == "m":
        places = np.searchsorted(POSITION_EDGES_M, finite, "right")
    else:
        share = finite / (2 * math.pi)  # of the shortest turn, at most one half
        places = np.where(share == ORIENTATION_EDGES[-1], 2, np.searchsorted(ORIENTATION_EDGES, share, "right"))
    bands = [*np.bincount(places, minlength=4).tolist(), len(values) - len(finite)]
    if len(finite) == 0:
        return Errors(0.0, 0.0, 0.0, bands, broken)
    ordered = np.sort(finite)
    place = 0.99 * (len(ordered) - 1)
    low, high = ordered[int(place)], ordered[min(int(place) + 1, len(ordered) - 1)]
    return Errors(math.sqrt(total(finite * finite) / len(finite)), float(low + (place - int(place)) * (high - low)), float(ordered[-1]), bands, broken)


def summarize_held(values, held, unit):
    """`values`, `held`: [frames][joints]; joints that are broken are a class of their own."""
    return summarize(values[held], unit, int(held.size - held.sum()))


@dataclasses.dataclass
class PoseErrors:
    """Of frames F: position [F][N] m, orientation [F][N] rad; gap [F][J] m, bend [F][J] rad, which tell only where held [F][J]."""
    position: np.ndarray
    orientation: np.ndarray
    gap: np.ndarray
    bend: np.ndarray
    held: np.ndarray

    def summary(self, frames=slice(None), bodies=slice(None), joints=slice(None)):
        """{kind: Errors} of some frames, bodies and joints."""
        held = self.held[frames][:, joints]
        return {"body_position": summarize(self.position[frames][:, bodies].ravel(), "m"),
                "body_orientation": summarize(self.orientation[frames][:, bodies].ravel(), "rad"),
                "joint_position": summarize_held(self.gap[frames][:, joints], held, "m"),
                "joint_orientation": summarize_held(self.bend[frames][:, joints], held, "rad")}


def pose_errors(run, reference, rows, group="particles/bodies"):
    """PoseErrors of a run against the precise poses of a reference in these rows; joints are those of the reference, and one that the run
    lacks does not hold."""
    joints, found = reference.joints, []
    places = run.places_of(reference)
    for row in rows:
        ours, theirs = run.poses(row, group), reference.poses(row)
        found.append((distance(ours.position, theirs.position)[:-1], rotation_angle(ours.orientation, theirs.orientation)[:-1],
                      distance(joints.gaps(ours), joints.gaps(theirs)), np.abs(joints.bends(ours) - joints.bends(theirs)),
                      np.append(run.held(row), False)[places] & reference.held(row)))
    empty = [np.zeros((0, len(reference.body_name)))] * 2 + [np.zeros((0, len(joints)))] * 2 + [np.zeros((0, len(joints)), bool)]
    return PoseErrors(*(map(np.array, zip(*found)) if found else empty))


@dataclasses.dataclass
class Constraints:
    """How far a run is from its own constraints: {kind: Errors} over the measured frames, of each row asked for, and of each actor. Contacts
    are there only if the run recorded them."""
    all: dict
    by_frame: list
    by_actor: list
    passages: int  # bodies that went through something, as the run's guards saw it


@dataclasses.dataclass
class Contacts:
    """Of some frames: depth [m], body_a, body_b (-1: static), and the slip [m], along the surface in the step, of those that should stick."""
    depth: np.ndarray
    body_a: np.ndarray
    body_b: np.ndarray
    slip: np.ndarray
    sticks: np.ndarray

    @classmethod
    def of_row(cls, run, row):
        points = run.contacts(row)
        body_a, body_b = points[:, 3].astype(int), points[:, 4].astype(int)
        centres, still = run.poses(row).position, np.zeros((1, 3))
        velocity, spin = (np.concatenate([run.recorded(f"particles/bodies/{name}/value", slice(row, row + 1))[0], still])
                          for name in ("velocity", "angular_velocity"))
        position, normal, friction = points[:, 6:9], points[:, 9:12], points[:, 18:21]
        speed_a, speed_b = (np.where((body < 0)[:, None], 0, velocity[body] + cross(spin[body], position - centres[body]))
                            for body in (body_a, body_b))
        speed = speed_a - speed_b
        slip = run.number("dt") * norm(speed - normal * dot(normal, speed)[:, None])
        sticks = (points[:, 17] > 0) & (norm(friction) < NEARLY * points[:, 13] * points[:, 17])
        return cls(np.maximum(points[:, 12], 0.0), body_a, body_b, slip, sticks)

    @classmethod
    def joined(cls, parts):
        return cls(*(np.concatenate([getattr(part, field.name) for part in parts]) for field in dataclasses.fields(cls)))

    def summary(self, chosen=slice(None)):
        return {"penetration": summarize(self.depth[chosen], "m"), "slip": summarize(self.slip[chosen][self.sticks[chosen]], "m")}

    def of_actors(self, of_body, num_actors):
        """For each actor the places of its contacts; one between two actors counts for both."""
        a, b = of_body[self.body_a], np.where(self.body_b < 0, -1, of_body[self.body_b])
        place = np.arange(len(a))
        has_other = (b >= 0) & (b != a)
        actor, place = np.concatenate([a, b[has_other]]), np.concatenate([place, place[has_other]])
        order = np.lexsort((place, actor))
        ends = np.searchsorted(actor[order], np.arange(num_actors + 1))
        return [place[order[first:last]] for first, last in zip(ends, ends[1:])]


def constraints_of(run, rows):
    """Constraints of a run; `rows`: those for by_frame. A joint counts for the actor of its first
    body, a contact for both actors."""
    joints, measured = run.joints, run.measured_rows(run.num_recorded)
    wanted = sorted({*rows.tolist(), *measured.tolist()})
    poses = [run.poses(row) for row in wanted]
    shape = (len(wanted), len(joints))
    gap = np.array([norm(joints.gaps(one)) for one in poses]).reshape(shape)
    bend = np.array([joints.bends(one) for one in poses]).reshape(shape)
    held = np.array([run.held(row) for row in wanted], bool).reshape(shape)
    contacts = [Contacts.of_row(run, row) for row in wanted] if run.has_contacts else []

    def summary(places, of_joints=slice(None)):
        some = held[places][:, of_joints]
        return {"joint_gap": summarize_held(gap[places][:, of_joints], some, "m"), "joint_bend": summarize_held(bend[places][:, of_joints], some, "rad")}

    by_frame = [summary([place]) | (contacts[place].summary() if contacts else {}) for place in np.searchsorted(wanted, rows).tolist()]
    actors, of_body = run.actors()
    places = np.searchsorted(wanted, measured)
    by_actor = [summary(places, np.flatnonzero(of_body[joints.body_a] == actor)) for actor in range(len(actors))]
    of_all = summary(places)
    if contacts:
        joined = Contacts.joined([contacts[place] for place in places] or [Contacts(*np.zeros((5, 0)))])
        joined.body_a, joined.body_b, joined.sticks = joined.body_a.astype(int), joined.body_b.astype(int), joined.sticks.astype(bool)
        of_all |= joined.summary()
        by_actor = [one | joined.summary(chosen) for one, chosen in zip(by_actor, joined.of_actors(of_body, len(actors)))]
    return Constraints(of_all, by_frame, by_actor, run.num_events("passage"))
