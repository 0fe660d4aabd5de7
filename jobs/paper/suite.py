"""Tables 1 and 2 and Figure 6 of the paper: islands, cores and frame rates of its nine scenes, from runs with --record islands."""
import dataclasses
import heapq

from reports.files import require
from reports.samples import total

import runs
from islands import PAPER, Summary, summarize

TOLERANCE = 0.05  # how much later than the longest island a schedule may end: the repeatability of its time on a quiet machine
SCENES = list(PAPER)


def place_of(scene):
    """For sorting in the order of Table 1; other scenes come last."""
    return SCENES.index(scene) if scene in SCENES else len(SCENES)


@dataclasses.dataclass
class Rate:
    """A frame rate: the harmonic mean over the measured frames, and the share of those within the budget."""
    hz: float
    satisfied: float


def rate_of(seconds):
    return Rate(runs.harmonic_mean_hz(seconds), runs.satisfied_fraction(seconds))


@dataclasses.dataclass
class Work:
    """What the solver did in the profiled steps of a run's measured frames: of each island (rows, seconds of its solution alone)."""
    scene: str
    iterations: int = 0
    steps_per_frame: int = 0
    frame_s: float = 0  # mean
    islands: list = dataclasses.field(default_factory=list)  # [frames][islands]

    def cubed_rows(self):
        """Sum of rows^3 over the islands of a frame's steps, mean over the frames: the profiled step stands for all of its frame."""
        cubes = sum(rows ** 3 for step in self.islands for rows, _ in step)
        return self.steps_per_frame * cubes / len(self.islands) if self.islands else 0

    def most_rows(self):
        return max((rows for step in self.islands for rows, _ in step), default=0)

    def time_of_a_row(self):
        """Seconds of all islands divided by their rows; 0 without rows."""
        islands = [island for step in self.islands for island in step]
        rows = sum(rows for rows, _ in islands)
        return sum(seconds for _, seconds in islands) / rows if rows else 0


def islands_of(run, frame):
    """[(rows, seconds)] of the profiled step of a frame."""
    found = run.profile["island/bodies"][frame] > 0
    return list(zip(run.profile["island/rows"][frame][found].tolist(), run.profile["island/solve"][frame][found].tolist()))


def work_of(run):
    runs.require_profile(run)
    numbers = (int(run.parameter(name) or 0) for name in ("iterations", "steps_per_frame"))
    frames = run.measured_frames
    return Work(run.scene, *numbers, runs.mean(run.wall_s[frames]) if frames else 0, [islands_of(run, frame) for frame in frames])


@dataclasses.dataclass
class Suite:
    """A scene's numbers for Tables 1 and 2 and Figure 6."""
    scene: str
    islands: Summary
    spaces: int  # over all worlds
    crossing: float  # contact points between spaces a step, mean
    islands_by_frame: list
    cores: int = 0  # the fewest for full parallelism in every measured frame
    cores_mean: float = 0
    longest_share: float = 0  # time of the longest island over that of all, mean
    longest_share_parallel: float = 0  # the longest island over a frame with islands in parallel, mean
    spaces_share: float = 1  # collision detection with a core for each space over that in one piece, mean
    serial: Rate = None
    islands_parallel: Rate = None
    spaces_parallel: Rate = None
    collide_share_serial: float = 0
    collide_share_parallel: float = 0  # with islands in parallel
    work: Work = None
    events: dict = dataclasses.field(default_factory=dict)  # kind -> number
    actor_bodies: dict = dataclasses.field(default_factory=dict)
    bodies: int = 0


def makespan(lengths, cores):
    """Length of the schedule in which the jobs, longest first, each go to the core that is free first (Graham 1969)."""
    free_at, end = [0.0] * cores, 0.0
    for length in sorted(lengths, reverse=True):
        done = heapq.heappop(free_at) + length
        heapq.heappush(free_at, done)
        end = max(end, done)
    return end


def fewest_cores(lengths):
    """The fewest cores on which the schedule ends at most 5 % after its longest job; 0 without jobs that take time."""
    longest = max(lengths, default=0)
    if longest <= 0:
        return 0
    most = longest * (1 + TOLERANCE)
    cores = max(1, int(float(total(lengths)) / most * (1 - 1e-9)))  # no schedule is shorter than the mean load
    while makespan(lengths, cores) > most:
        cores += 1
    return cores


def shares_of(run, frame):
    """(longest island over all islands, collision detection with a core for each space over that in one piece) of the profiled step."""
    times = [seconds for _, seconds in islands_of(run, frame)]
    solve_s, serial_s = total(times), total(run.profile["space/collide"][frame])
    # One core a space: nothing crosses between worlds, so collision detection takes as long as the longest of all worlds.
    spaces = float(run.profile["space/collide_spaces"][frame].max()) / serial_s if serial_s > 0 else 1
    return max(times) / solve_s if solve_s > 0 else 1, spaces


def suite_of(run):
    """The run's numbers. Its frame has to be a serial time: one rank."""
    runs.require_profile(run)
    ranks = int(run.parameter("ranks"))
    require(ranks == 1, f"{run.path}: it was run on {ranks} ranks, whose times share the machine; use one rank")
    frames = run.measured_frames
    require(frames, f"{run.path}: the run ended in its warm-up; nothing was measured")
    crossing = [int(run.profile["space/cross_contacts"][frame].sum()) for frame in frames]
    found = Suite(run.scene, summarize(run.islands[frames]), run.num_worlds * max(1, int(run.number("num_spaces", 0))),
                  runs.mean(crossing), run.islands[frames].tolist(), work=work_of(run), events=run.events,
                  actor_bodies=run.actor_bodies, bodies=run.num_bodies)
    take_cores(run, frames, found)
    return found


def take_cores(run, frames, found):
    """Table 2 and Figure 6: the cost of each frame as measured, with a core for each island, and with one for each space besides."""
    cores = [fewest_cores([seconds for _, seconds in islands_of(run, frame)]) for frame in frames]
    shares = [shares_of(run, frame) for frame in frames]
    phases = [[float(run.phase_s[phase][frame]) for phase in runs.PHASES] for frame in frames]
    serial_s = [sum(times) for times in phases]
    collide_s, solve_s = ([times[runs.PHASES.index(phase)] for times in phases] for phase in ("collide", "solve"))
    islands_s = [serial - solve + solve * longest for serial, solve, (longest, _) in zip(serial_s, solve_s, shares)]
    spaces_s = [islands - collide + collide * spaces for islands, collide, (_, spaces) in zip(islands_s, collide_s, shares)]
    found.cores, found.cores_mean = max(cores), runs.mean(cores)
    found.longest_share, found.spaces_share = (runs.mean(one) for one in zip(*shares))
    found.longest_share_parallel = runs.mean([solve * longest / islands
                                              for solve, (longest, _), islands in zip(solve_s, shares, islands_s)])
    found.serial, found.islands_parallel, found.spaces_parallel = map(rate_of, (serial_s, islands_s, spaces_s))
    found.collide_share_serial = sum(collide_s) / sum(serial_s)
    found.collide_share_parallel = sum(collide_s) / sum(islands_s)


def cores_json(suite):
    """The row of a scene, as `paper.py cores --json` prints it."""
    row = PAPER.get(suite.scene)
    rates = {name: {"harmonic_mean_hz": rate.hz, "satisfied_fraction": rate.satisfied}
             for name, rate in (("serial", suite.serial), ("islands_parallel", suite.islands_parallel),
                                ("spaces_parallel", suite.spaces_parallel))}
    return {"scene": suite.scene, "cores": suite.cores, "cores_mean": suite.cores_mean, "tolerance": TOLERANCE,
            "paper_cores": row and row.cores, "longest_island_share": suite.longest_share, **rates,
            "collide_share": {"serial": suite.collide_share_serial, "islands_parallel": suite.collide_share_parallel}}


CORES_HEAD = ("cores: fewest in the worst measured frame and mean, makespan at most 5 % above the longest island\n"
              "scene     cores    mean  paper  longest            serial   islands parallel   + spaces parallel   "
              "collide: serial, parallel\n")


def cores_text(suite):
    """The row of a scene under CORES_HEAD."""
    row = PAPER.get(suite.scene)
    rates = "  ".join(f"{rate.hz:9.1f} Hz {100 * rate.satisfied:4.0f} %"
                      for rate in (suite.serial, suite.islands_parallel, suite.spaces_parallel))
    return (f"{suite.scene:<8}  {suite.cores:5d} {suite.cores_mean:7.1f}  {row.cores if row else '-':>5}   "
            f"{100 * suite.longest_share:4.0f} %  {rates}   {100 * suite.collide_share_serial:3.0f} % -> "
            f"{100 * suite.collide_share_parallel:3.0f} %\n")
