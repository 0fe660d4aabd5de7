"""Section 4.2, and what sections 5 and 6 say about it: Figure 6, parallel islands and spaces."""
from reports.words import percent

import figures
from statements.statement import CLOCK, FIGURE_6, NUM_SCENES, Answer, Statements, joined, over_scenes, rate

STATEMENTS = Statements()
BENEFIT = 1.5  # at this gain or above parallel islands count as a benefit, below as little improvement
SIMPLE = ("2-Cars", "10-Cars", "CrashSk")
OUR_PROCESSOR = "ours is taken to be no slower than the paper's 2.4 GHz Pentium 4"
CANNOT_TELL = "a faster processor cannot tell"

STATEMENTS.undecidable("4.2", "Figure 6: bars of frame rates", "printed without numbers",
                       "ours are in the page's figure; what the text says of them is judged below")


@STATEMENTS.judged_by("4.2", "2-Cars, 10-Cars and CrashSk are the simple scenes", "the three of the highest serial rate", CLOCK, FIGURE_6,
                      papers="these three")
def simplest_scenes(data):
    ordered = sorted(data.suite, key=lambda one: -one.serial.hz)
    return over_scenes([(one.scene, rate(one.serial.hz)) for one in ordered], sum(one.scene in SIMPLE for one in ordered[:3]) == 3, NUM_SCENES)


def by_failures(data, kind, scenes, satisfied_at_most, needed):
    """The paper says that its processor cannot do it; this can be judged only where ours cannot either."""
    meant = [(one.scene, getattr(one, kind).satisfied) for one in data.suite if scenes(one.scene)]
    if not meant:
        return None
    failing = sum(share <= satisfied_at_most for _, share in meant)
    text = f"satisfied: {joined([(scene, percent(share, 0)) for scene, share in meant])}"
    if len(meant) >= needed and failing < needed:
        return Answer(text, note=CANNOT_TELL)
    return Answer(text, failing == needed, len(meant), needed)


@STATEMENTS.judged_by("4.2", "one core satisfies none of the six other scenes", "confirmed if ours does not, either: a frame above 3.33 ms in each",
                      CLOCK, FIGURE_6, papers="none", remark=OUR_PROCESSOR)
def unsatisfied_scenes(data):
    return by_failures(data, "serial", lambda scene: scene not in SIMPLE, 0.999, 6)


def gain_of(one, kind):
    return getattr(one, kind).hz / one.serial.hz


@STATEMENTS.judged_by("4.2", "100CrSk: tremendous speedup from parallel threads", "ten times or more", CLOCK, FIGURE_6,
                      remark="a core for each island and each world's collision detection")
def worlds(data):
    one = data.find("100CrSk")
    if one is None:
        return None
    gained = gain_of(one, "spaces_parallel")
    return Answer(f"{gained:.1f} times; islands alone {gain_of(one, 'islands_parallel'):.1f}", gained >= 10)


def gains(data, scenes, benefits):
    found = [(one.scene, gain_of(one, "islands_parallel"), gain_of(one, "spaces_parallel")) for one in map(data.find, scenes) if one]
    return over_scenes([(scene, f"{islands:.2f}, {spaces:.2f}") for scene, islands, spaces in found],
                       all((spaces >= BENEFIT) == benefits for _, _, spaces in found), len(scenes))


@STATEMENTS.judged_by("4.2", "Battle and Fight benefit from parallel threads", "1.5 times or more in both", CLOCK, FIGURE_6,
                      remark="islands, then also spaces, in parallel over serial")
def gains_of_humans(data):
    return gains(data, ("Battle", "Fight"), True)


@STATEMENTS.judged_by("4.2", "Battle and Fight satisfy no frame, even in parallel", "confirmed if ours satisfies none, either", CLOCK, FIGURE_6,
                      papers="0 %", remark=OUR_PROCESSOR)
def humans_in_parallel(data):
    return by_failures(data, "spaces_parallel", lambda scene: scene in ("Battle", "Fight"), 0, 2)


@STATEMENTS.judged_by("4.2", "the remaining scenes see little or no improvement", "less than 1.5 times in each", CLOCK, FIGURE_6,
                      remark="islands, then also spaces, in parallel over serial")
def gains_of_the_rest(data):
    return gains(data, ("CrashWa", "Environ", "Battle2"), False)


@STATEMENTS.judged_by("4.2", "one extremely complex island dictates the frame rate, even in parallel",
                      "the longest island is more than half of the parallel frame in CrashWa", CLOCK, FIGURE_6, remark="its wall")
def one_large_island(data):
    one = data.find("CrashWa")
    return one and Answer(percent(one.longest_share_parallel, 0), one.longest_share_parallel > 0.5)


@STATEMENTS.judged_by("5", "even in parallel CrashWa, Environ, Battle, Fight and Battle2 are not satisfied",
                      "confirmed if ours does not, either: a frame above 3.33 ms in each", CLOCK, FIGURE_6, papers="none of five",
                      remark=OUR_PROCESSOR)
def distance(data):
    return by_failures(data, "spaces_parallel", lambda scene: scene in figures.SCENES, 0.999, len(figures.SCENES))


def slower_than(data, hz):
    """[(scene, rate)] where islands and spaces in parallel stay below."""
    return [(one.scene, rate(one.spaces_parallel.hz)) for one in data.suite if one.spaces_parallel.hz < hz]


@STATEMENTS.judged_by("5.2.1", "in parallel all scenes but one achieve 30 frames a second", "eight of nine or all", CLOCK, FIGURE_6,
                      papers="8 of 9", remark="this machine's processor")
def at_30_frames(data):
    if not data.suite:
        return None
    slow, num = slower_than(data, 30), len(data.suite)
    return Answer(f"{num - len(slow)} of {num}" + (f"; slower: {joined(slow)}" if slow else ""), len(slow) <= 1, num, NUM_SCENES)


@STATEMENTS.judged_by("5.2.1", "in parallel many scenes cannot achieve 300 frames a second", "confirmed if three or more of ours cannot, either",
                      CLOCK, FIGURE_6, papers="many", remark=OUR_PROCESSOR)
def at_300_frames(data):
    if not data.suite:
        return None
    slow = slower_than(data, 300)
    text = f"slower: {joined(slow)}" if slow else "all can"
    if len(slow) < 3 and len(data.suite) >= NUM_SCENES:
        return Answer(text, note=CANNOT_TELL)
    return Answer(text, True, len(data.suite), NUM_SCENES)


@STATEMENTS.judged_by("6", "parallel execution satisfies the requirements of several benchmarks",
                      "all frames of two scenes or more, and of more than with one core", CLOCK, FIGURE_6, papers="several",
                      remark="a core for each island and space, no overheads; this machine's processor")
def parallel_execution(data):
    if not data.suite:
        return None
    serial, parallel = (sum(getattr(one, kind).satisfied == 1 for one in data.suite) for kind in ("serial", "spaces_parallel"))
    text = f"{serial} scenes with one core, {parallel} in parallel"
    if serial >= NUM_SCENES:
        return Answer(text, note="none is left")
    return Answer(text, parallel >= 2 and parallel > serial, len(data.suite), NUM_SCENES)
