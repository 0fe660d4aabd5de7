"""Rigid bodies and their joints: poses [bodies], position [..., 3] m and orientation [..., 4] (w, x, y, z), in the world frame.

Sums are added in the order of Eigen, so that numbers have the digits that pbmpi's own have."""
import math

import numpy as np

WITH_ANCHOR = ("ball", "hinge", "universal", "hinge2")
WITH_ORIENTATION = ("slider", "fixed")  # hold the initial relative orientation
LEAST_LENGTH_M = 0.01  # two joints at one point have no segment between them


def dot(a, b):
    product = a * b
    return product[..., 0] + (product[..., 1] + product[..., 2])


def norm(a):
    return np.sqrt(dot(a, a))


def cross(a, b):
    return np.stack([a[..., 1] * b[..., 2] - a[..., 2] * b[..., 1], a[..., 2] * b[..., 0] - a[..., 0] * b[..., 2],
                     a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]], -1)


def arctan2(y, x):
    """By the C library: numpy's has other last digits on some CPUs."""
    return np.array(list(map(math.atan2, y.tolist(), x.tolist())), float)


def rotate(q, v):
    twice = cross(q[..., 1:], v)
    twice = twice + twice
    return v + q[..., :1] * twice + cross(q[..., 1:], twice)


def conjugate(q):
    return q * [1, -1, -1, -1]


def product(a, b):
    """Of quaternions."""
    aw, ax, ay, az = np.moveaxis(a, -1, 0)
    bw, bx, by, bz = np.moveaxis(b, -1, 0)
    return np.stack([aw * bw - ax * bx - ay * by - az * bz, aw * bx + ax * bw + ay * bz - az * by,
                     aw * by + ay * bw + az * bx - ax * bz, aw * bz + az * bw + ax * by - ay * bx], -1)


def rotation_angle(a, b):
    """Of the shortest turn from a to b [rad]; NaN where one is not finite."""
    turn = product(conjugate(a), b)
    return np.where(np.isfinite(turn).all(-1), 2 * arctan2(norm(turn[..., 1:]), np.abs(turn[..., 0])), math.nan)


def angle_between(a, b):
    """Of two directions [rad]; exact for small angles, where acos loses half the digits."""
    return arctan2(norm(cross(a, b)), dot(a, b))


def distance(a, b):
    """NaN where the difference is not finite."""
    difference = a - b
    return np.where(np.isfinite(difference).all(-1), norm(difference), math.nan)


class Poses:
    """Of the bodies of a frame, and as the last one that of the world, at which -1 points."""

    def __init__(self, position, orientation):
        self.position = np.concatenate([position, np.zeros((1, 3))])
        self.orientation = np.concatenate([orientation, [[1.0, 0, 0, 0]]])

    def point(self, body, local):
        """In the world frame."""
        return self.position[body] + rotate(self.orientation[body], local)

    def into(self, body, direction):
        """A direction of the world frame in that of the body."""
        return rotate(conjugate(self.orientation[body]), direction)


class Joints:
    """The joints of a run's file, [J]; `start`: the initial Poses."""

    def __init__(self, run, start):
        self.kind = np.array(run.column("joints/kind"), object)
        self.body_a, self.body_b = run.column("joints/body_a"), run.column("joints/body_b")
        self.anchor_a, self.anchor_b = run.column("joints/anchor_a"), run.column("joints/anchor_b")
        self.axis1_a, self.axis2_b = run.column("joints/axis1_a"), run.column("joints/axis2_b")
        self.has_anchor = np.isin(self.kind, WITH_ANCHOR)
        self.slides = (self.kind == "slider") | ((self.kind == "hinge2") & (run.column("joints/stiffness") > 0))
        a, b = self.body_a, self.body_b
        in_world = (b < 0)[:, None]
        centre = rotate(conjugate(start.orientation[a]), start.position[b] - start.position[a])  # of b in the frame of a
        self.in_a = np.where(self.has_anchor[:, None], self.anchor_a, np.where(in_world, 0, centre))
        self.in_b = np.where(self.has_anchor[:, None], self.anchor_b, np.where(in_world, start.position[a], 0))
        axis1_in_b = start.into(b, rotate(start.orientation[a], self.axis1_a))
        self.is_hinge, self.is_angle = self.kind == "hinge", np.isin(self.kind, ("universal", "hinge2"))
        self.holds_orientation = np.isin(self.kind, WITH_ORIENTATION)
        self.axis_in_b = np.where(self.is_hinge[:, None], axis1_in_b, self.axis2_b)
        self.start_angle = np.where(self.is_angle, angle_between(axis1_in_b, self.axis2_b), 0)
        self.start_turn = product(conjugate(start.orientation[a]), start.orientation[b])

    def __len__(self):
        return len(self.kind)

    def gaps(self, poses):
        """[J][3] m, from b's point to a's, in the frame of a."""
        a, b = self.body_a, self.body_b
        gap = self.in_a - poses.into(a, poses.point(b, self.in_b) - poses.position[a])
        along = self.axis1_a * dot(self.axis1_a, gap)[:, None]
        return np.where(self.slides[:, None], gap - along, gap)

    def bends(self, poses):
        """[J] rad, about axes that the joint locks; NaN where a pose that matters is not finite."""
        a, b = self.body_a, self.body_b
        between = angle_between(rotate(poses.orientation[a], self.axis1_a), rotate(poses.orientation[b], self.axis_in_b))
        about_axis = np.where(self.is_hinge, between, np.where(self.is_angle, np.abs(between - self.start_angle), 0))
        finite = np.isfinite(poses.position).all(1) & np.isfinite(poses.orientation).all(1)
        about_axis = np.where(finite[a] & finite[b], about_axis, math.nan)
        turn = product(conjugate(poses.orientation[a]), poses.orientation[b])
        return np.where(self.holds_orientation, rotation_angle(self.start_turn, turn), about_axis)


class Segments:
    """The parts of humans between two joints, [S]: each a body, and two joints between it and other bodies."""

    def __init__(self, joints, is_human):
        of_body = {}
        for joint in np.flatnonzero(joints.has_anchor & (joints.body_b >= 0)).tolist():
            for body in (joints.body_a[joint], joints.body_b[joint]):
                of_body.setdefault(int(body), []).append(joint)
        ends = [(body, one, other) for body in np.flatnonzero(is_human).tolist() for place, one in enumerate(of_body.get(body, []))
                for other in of_body[body][place + 1:]]
        body, self.one, self.other = np.array(ends, int).reshape(-1, 3).T
        self.length = norm(anchors(joints, self.one, body)[0] - anchors(joints, self.other, body)[0])
        keep = self.length >= LEAST_LENGTH_M
        body, self.one, self.other, self.length = body[keep], self.one[keep], self.other[keep], self.length[keep]
        self.neighbours = [anchors(joints, joint, body)[1:] for joint in (self.one, self.other)]

    def stretch(self, poses, held):
        """By which share each is longer or shorter than it should be; only those whose joints hold. NaN: not finite."""
        first, second = (poses.point(body, anchor) for body, anchor in self.neighbours)
        across = first - second
        share = np.where(np.isfinite(across).all(1), np.abs(norm(across) / self.length - 1), math.nan)
        return share[held[self.one] & held[self.other]]


def anchors(joints, joint, body):
    """(anchor in the body's frame, the other body, anchor in its frame) of joints that hold these bodies."""
    is_a = joints.body_a[joint] == body
    of_a, of_b = joints.anchor_a[joint], joints.anchor_b[joint]
    other = np.where(is_a, joints.body_b[joint], joints.body_a[joint])
    return np.where(is_a[:, None], of_a, of_b), other, np.where(is_a[:, None], of_b, of_a)
