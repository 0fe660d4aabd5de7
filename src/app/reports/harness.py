"""What the harness costs beside the physics, fitted to timed cases, and what a frame then takes, sends and holds on any number of ranks.

All worlds are alike, and each rank owns a block of them. Times are in seconds.
"""
import dataclasses
import math
from typing import NamedTuple

import numpy as np

FRAME_PARTS = ("step", "harness", "agreement", "gather", "unpack", "balance", "verdict")
USUAL_RADIX, USUAL_PIECE_BYTES = 32, 1 << 20  # of mpi/comm/tree_gather.h
AGREEMENT_BYTES, VERDICT_BYTES = 6 * 8, 32  # what mpi::FrameDriver sends in a frame

# Memory of a run, in bytes. Of a world on every rank: its owner; where its bodies begin, in the driver, in the file's setup and in its
# columns; and where its joints begin.
TABLE_BYTES = 4 + 3 * 8 + 8
# Of a world on root: its owner and cost, three frames' costs and their median, and the rebalancer's lists.
BALANCE_BYTES = 4 + 8 + 3 * 8 + 8 + 12
RESULT_BYTES = 104 + 104 + 160  # of a world's results at the end: as collected, joined, and written
MOTION_BYTES = 13 * 8  # of a body's position, orientation and both velocities
PHASE_BYTES = 10 * 8  # of a rank's phases in a frame (core/clock.h)


@dataclasses.dataclass
class Costs:
    """message_*: a message of k bytes takes overhead + (k - 1) byte + latency + overhead, and a rank receives one every `gap` at most:
    LogGP (A. Alexandrov, M. Ionescu, K. Schauser and C. Scheiman, "LogGP: incorporating long messages into the LogP model", SPAA 1995)."""
    message_latency: float = 0.0
    message_overhead: float = 0.0  # processor time to send or to receive
    message_gap: float = 0.0
    message_byte: float = 0.0
    frame: float = 0.0  # of a rank, whatever it owns
    world_frame: float = 0.0  # plus once a frame for each of its worlds
    world_step: float = 0.0  # plus for each step of a world, without its engine
    body_frame: float = 0.0  # plus once a frame for each body: gather and observers
    root_unpack_world: float = 0.0  # a world of another rank, read from the message
    root_unpack_body: float = 0.0  # plus for each of its bodies
    root_balance_world: float = 0.0  # for each world, when root decides whether worlds move
    root_balance_rank: float = 0.0  # plus for each rank
    table_world: float = 0.0  # every rank, at the start: for each world in the table of all worlds
    root_hash_world: float = 0.0  # at the end: to add a world's hash to the run's
    hash_body: float = 0.0  # the owner, at the end: for each body
    memory_rank: float = 0.0  # [B] of a rank that owns next to nothing
    memory_body: float = 0.0  # [B] plus for each body of its own

    def message(self):
        """Least time that a rank needs to receive one."""
        return max(self.message_overhead, self.message_gap)


# By timed part: the costs that its time is a sum of, and how often each counts in a case.
TERMS = {"frame": (("frame", "world_frame", "world_step", "body_frame"),
                   lambda case: (1, case.worlds, case.worlds * case.steps, case.worlds * case.bodies)),
         "unpack": (("root_unpack_world", "root_unpack_body"), lambda case: (case.worlds, case.worlds * case.bodies)),
         "balance": (("root_balance_world", "root_balance_rank"), lambda case: (case.worlds, case.ranks)),
         "table": (("table_world",), lambda case: (case.worlds,)),
         "hash": (("root_hash_world",), lambda case: (case.worlds,)),
         "bodies": (("hash_body",), lambda case: (case.worlds * case.bodies,)),
         "message": (("message", "message_byte"), lambda case: (1, case.bytes)),
         "send": (("message_overhead",), lambda case: (1,)),
         "receive": (("message_gap",), lambda case: (1,))}


def fit(terms, seconds):
    """Least squares of relative errors; a cost that would be negative is 0, and the others are fitted again. `terms`: [cases][costs]."""
    matrix = np.array(terms, dtype=float) / np.array(seconds)[:, None]
    scale = np.linalg.norm(matrix, axis=0)
    used = [place for place in range(matrix.shape[1]) if scale[place] > 0]
    while used:
        found = np.linalg.lstsq(matrix[:, used] / scale[used], np.ones(len(matrix)), rcond=None)[0]
        if found.min() >= 0:
            return [found[used.index(place)] / scale[place] if place in used else 0.0 for place in range(len(scale))]
        del used[found.argmin()]
    return [0.0] * len(scale)


def fit_costs(cases):
    """Parts that were not timed cost nothing. `cases` have part, ranks, worlds, bodies (of a world), steps (of a frame), bytes (of a
    message) and seconds."""
    found = {}
    for part, (names, terms_of) in TERMS.items():
        timed = [case for case in cases if case.part == part and case.seconds > 0]
        if timed:
            found.update(zip(names, map(float, fit(list(map(terms_of, timed)), [case.seconds for case in timed]))))
    whole = found.pop("message", 0.0)
    found["message_overhead"] = min(found.get("message_overhead", 0.0), whole / 2)
    found["message_latency"] = whole - 2 * found["message_overhead"]
    return Costs(**found)


@dataclasses.dataclass(frozen=True)
class Load:
    ranks: int
    worlds: int
    bodies: int  # of a world
    steps: int = 3  # of a frame
    step_s: float = 0.0  # of a world, in its engine

    def most_worlds(self):
        """That a rank owns; rank 0 does."""
        return -(-self.worlds // self.ranks)

    def world_bytes(self):
        """Sent to root in a frame: a number, and position and orientation of each body (mpi/frame/pose_gather.h)."""
        return 8 * (1 + 7 * self.bodies)


class Subtree(NamedTuple):
    """`ranks` ranks, of which the first hands on what all have; `place`: that of its number's lowest nonzero digit in the radix (root: a
    power that no rank reaches). The first `richer` ranks own a world more than the others."""
    place: int
    ranks: int
    richer: int


class Stream(NamedTuple):
    """When a rank begins to hand on, and when it is done [s], from the moment when all have packed; what it hands on [B]."""
    first_s: float
    last_s: float
    bytes: int


class Gather:
    """How poses and costs reach root: each rank but root sends to its parent what it and those below it have, in pieces. The parent has the
    same number in the radix but for the lowest nonzero digit, which is 0 (mpi/comm/tree_gather.h). `linear`: each rank sends all it has
    straight to root in one message, as Open MPI's MPI_Gatherv does."""

    def __init__(self, load, linear=False):
        self.load = load
        self.radix = max(load.ranks, 2) if linear else USUAL_RADIX
        self.piece_bytes = 1 << 62 if linear else USUAL_PIECE_BYTES
        place = 1
        while place < load.ranks:
            place *= self.radix
        self.root = Subtree(place, load.ranks, load.worlds % load.ranks)

    def children(self, tree):
        """[(count, child)] in the order in which a rank takes them: ascending; leaves that are alike together."""
        leaves = min(self.radix, tree.ranks, tree.place) - 1
        richer = min(max(tree.richer - 1, 0), leaves)
        found = [(richer, Subtree(1, 1, 1)), (leaves - richer, Subtree(1, 1, 0))]
        place = self.radix
        while place < min(tree.place, tree.ranks):
            for begin in range(place, min(self.radix * place, tree.ranks), place):
                ranks = min(place, tree.ranks - begin)
                found.append((1, Subtree(place, ranks, min(max(tree.richer - begin, 0), ranks))))
            place *= self.radix
        return [(count, child) for count, child in found if count > 0]

    def bytes_of(self, tree):
        return self.load.world_bytes() * (self.load.worlds // self.load.ranks * tree.ranks + tree.richer)

    def pieces(self, size):
        return -(-size // self.piece_bytes)

    def messages_below(self, tree, known):
        """(messages, bytes) that all ranks of a subtree but its first send. `known`: those of subtrees, of which most are alike."""
        if tree not in known:
            messages = size = 0
            for count, child in self.children(tree):
                below = self.messages_below(child, known)
                messages += count * (below[0] + self.pieces(self.bytes_of(child)))
                size += count * (below[1] + self.bytes_of(child))
            known[tree] = (messages, size)
        return known[tree]

    def seconds(self, costs):
        """Until root has received the last byte. A rank takes its children's streams in order, each message for the longer of overhead and
        gap; it hands a piece on as soon as it is full."""
        return self.received(self.root, 0, costs, {})[0] if self.load.ranks > 1 else 0.0

    def stream(self, tree, costs, known):
        if tree not in known:
            now, full, size = self.received(tree, self.bytes_of(Subtree(1, 1, min(tree.richer, 1))), costs, known)
            last = now + math.ceil(size / self.piece_bytes) * costs.message_overhead
            known[tree] = Stream(last if full is None else full + costs.message_overhead, last, size)
        return known[tree]

    def received(self, tree, size, costs, known):
        """(when the first rank has taken all [s], when its first piece was full [s] or None, bytes that it then has). `size`: its own;
        `known`: streams of subtrees."""
        now, full = 0.0, 0.0 if size >= self.piece_bytes else None
        for count, child in self.children(tree):
            stream = self.stream(child, costs, known)
            if stream.bytes == 0:
                continue
            busy = math.ceil(stream.bytes / self.piece_bytes) * costs.message() + stream.bytes * costs.message_byte
            arrival = stream.first_s + costs.message_latency
            last_bytes = min(stream.bytes, self.piece_bytes)  # not before the child's last piece has arrived
            earliest = stream.last_s + costs.message_latency + costs.message() + last_bytes * costs.message_byte
            for _ in range(count):
                begin = now if now > arrival else arrival
                now = begin + busy
                if now < earliest:
                    now = earliest
                if full is None and size + stream.bytes >= self.piece_bytes:
                    full = begin + (now - begin) * max(self.piece_bytes - size, 0) / stream.bytes
                size += stream.bytes
        return now, full, size


@dataclasses.dataclass
class Traffic:
    """Messages and bytes of a frame without output, estimate, rebalance or checkpoint: counted, not measured."""
    gather: tuple  # (messages, bytes) of poses and costs that all ranks send
    into_root: tuple  # the part of it that root receives
    busiest_rank_bytes: int  # sent by the rank, other than root, that sends the most
    all: tuple


def traffic_of(load, gather):
    into_root = [(count, gather.bytes_of(child)) for count, child in gather.children(gather.root)]
    poses = gather.messages_below(gather.root, {})
    agreement, verdict = messages_of_allreduce(load.ranks), load.ranks - 1  # a bcast with any tree
    return Traffic(poses, (sum(count * gather.pieces(size) for count, size in into_root), sum(count * size for count, size in into_root)),
                   max((size for _, size in into_root), default=0),
                   (poses[0] + agreement + verdict, poses[1] + AGREEMENT_BYTES * agreement + VERDICT_BYTES * verdict))


def messages_of_allreduce(ranks):
    """Of a small one, by recursive doubling (R. Thakur, R. Rabenseifner and W. Gropp, "Optimization of collective communication operations
    in MPICH", IJHPCA 19, 2005, section 4.5; Open MPI's component "tuned" does it so): of a power of two P of ranks each sends log2 P;
    those beyond it first give their values to a neighbour, and get the result from it at the end."""
    rounds = ranks.bit_length() - 1
    return (1 << rounds) * rounds + 2 * (ranks - (1 << rounds))


def rounds_of_allreduce(ranks):
    return ranks.bit_length() - 1 + (0 if ranks & (ranks - 1) == 0 else 2)


def frame_parts(load, costs, gather):
    """{part: seconds} of a frame. step: the rank with the most work, where all worlds cost the same; agreement and verdict: rounds of
    latency + 2 overhead, by recursive doubling and by a binomial tree."""
    worlds, bodies = load.most_worlds(), load.bodies
    parts = dict.fromkeys(FRAME_PARTS, 0.0)
    parts["step"] = worlds * load.steps * load.step_s
    parts["harness"] = costs.frame + worlds * (costs.world_frame + load.steps * costs.world_step + bodies * costs.body_frame)
    if load.ranks > 1:
        round_s = costs.message_latency + 2 * costs.message_overhead
        parts["agreement"] = rounds_of_allreduce(load.ranks) * round_s
        parts["gather"] = gather.seconds(costs)
        parts["unpack"] = (load.worlds - worlds) * (costs.root_unpack_world + bodies * costs.root_unpack_body)
        parts["balance"] = load.worlds * costs.root_balance_world + load.ranks * costs.root_balance_rank
        parts["verdict"] = (load.ranks - 1).bit_length() * round_s
    return parts


@dataclasses.dataclass
class Memory:
    """[B]; engines are not counted."""
    any_rank: float  # that is not root and writes no row
    root: float
    row_writer: float  # a rank that holds a whole row of the file's bodies (io/hdf5/growing_columns.h)


def memory_of(load, costs, gather, results_everywhere, frames):
    """`results_everywhere`: at the end each rank has the results of all worlds, not root alone; `frames`: measured ones, whose phases are
    joined at the end."""
    own_worlds, all_bytes = load.most_worlds(), load.worlds * load.world_bytes()
    at_end = load.worlds * RESULT_BYTES + frames * load.ranks * PHASE_BYTES
    handed_on = 2 * min(gather.piece_bytes, all_bytes) if load.ranks > gather.radix else 0
    any_rank = (costs.memory_rank + load.worlds * TABLE_BYTES + own_worlds * load.bodies * costs.memory_body
                + own_worlds * load.world_bytes() + handed_on + own_worlds * RESULT_BYTES)
    root = any_rank + 2 * all_bytes + load.worlds * BALANCE_BYTES + at_end
    any_rank += at_end if results_everywhere else 0
    return Memory(any_rank, root, any_rank + load.worlds * load.bodies * MOTION_BYTES)
