"""Section 3: the scenes, Table 1, and the mix of instructions."""
import math

from instructions import MIX, PAPER_MIX, mean_mix
from islands import PAPER
from statements.statement import COUNTS, FIGURE_3, FIGURE_6, INSTRUCTIONS, NUM_SCENES, Answer, Statements, is_near, joined, over_scenes

STATEMENTS = Statements()


def bodies_of(data, kind):
    """The numbers of bodies of actors of a kind, over all scenes."""
    return sorted({number for one in data.suite for number in one.actor_bodies.get(kind, ())})


@STATEMENTS.judged_by("3.2", "a human has 16 segments, a car five objects", "the same", COUNTS, FIGURE_6, papers="16; 5",
                      remark="wheels hang on hinge2 joints with a suspension, the paper's on sliders")
def actors(data):
    humans, cars = bodies_of(data, "human"), bodies_of(data, "car")
    if not humans or not cars:
        return None
    return Answer("; ".join(" or ".join(map(str, numbers)) for numbers in (humans, cars)), humans == [16] and cars == [5])


def of_the_paper(data):
    """The suite's scenes that are in Table 1, in its order."""
    return list(filter(None, map(data.find, PAPER)))


def islands_text(islands):
    return f"{islands.max:g}, {islands.min:g}, {islands.mean:.4g}, {islands.stddev:.3g}"


def add_islands(scene, papers):
    """The statement of one row of Table 1."""
    @STATEMENTS.judged_by("3.2", f"Table 1, {scene}: islands (max, min, avg, dev)",
                          "max, min and avg within 10 %; none deviates where the paper's do not", COUNTS, FIGURE_6,
                          papers=islands_text(papers))
    def islands(data):
        one = data.find(scene)
        if one is None:
            return None
        ours = one.islands
        near = all(is_near(getattr(ours, name), getattr(papers, name)) for name in ("max", "min", "mean"))
        note = "no five frames with a least number of 2 and a mean of 93 deviate by less than 45" if scene == "Battle" else ""
        return Answer(islands_text(ours), near and (papers.stddev > 0 or ours.stddev == 0), note=note)


for scene_of_paper, row_of_paper in PAPER.items():
    add_islands(scene_of_paper, row_of_paper.islands)


@STATEMENTS.judged_by("3.2", "Table 1: number of spaces", "the same, the larger where it has two", COUNTS, FIGURE_6,
                      papers="; ".join(f"{scene} {row.spaces}" for scene, row in PAPER.items()), remark="spaces = \"one\" in [run] takes them as one")
def number_of_spaces(data):
    ours = of_the_paper(data)
    return over_scenes([(one.scene, str(one.spaces)) for one in ours],
                       all(str(one.spaces) == PAPER[one.scene].spaces.rpartition(" ")[2] for one in ours), NUM_SCENES)


@STATEMENTS.judged_by("3.2", "Table 1: communication between spaces", "contacts across spaces where the paper has more than none, and only there",
                      COUNTS, FIGURE_6, papers="; ".join(f"{scene} {row.traffic}" for scene, row in PAPER.items()),
                      remark="contact points a step, of a frame's last steps")
def traffic(data):
    ours = of_the_paper(data)
    return over_scenes([(one.scene, f"{one.crossing:.3g}") for one in ours],
                       all((PAPER[one.scene].traffic == "none") == (one.crossing == 0) for one in ours), NUM_SCENES)


@STATEMENTS.judged_by("3.2", "Table 1: temporal behaviour",
                      "islands change after no measured frame where it is constant, after half of them where it is fast changing",
                      COUNTS, FIGURE_6, papers="2-Cars constant; CrashSk, Environ, Battle2 fast changing",
                      remark="words between the two are not judged")
def temporal_behaviour(data):
    found, is_same = [], True
    for scene in ("2-Cars", "CrashSk", "Environ", "Battle2"):
        one = data.find(scene)
        if one is None:
            continue
        numbers = one.islands_by_frame
        changes, steps = sum(a != b for a, b in zip(numbers, numbers[1:])), len(numbers) - 1
        found.append((scene, f"{changes} of {steps}"))
        is_same = is_same and (changes == 0 if scene == "2-Cars" else 2 * changes >= steps)
    return over_scenes(found, is_same, 4, "frames with another number: ")


def fewest_frames(islands):
    """The fewest frames that allow a row's least, or largest, number with its mean and deviation: one frame has that number, and the
    others lie together on the other side of the mean. All numbers are taken as rounded in favour of fewer."""
    if islands.stddev == 0:
        return 1
    rounded = 0.5 if islands.stddev == math.floor(islands.stddev) else 0.05
    away = max(islands.mean - islands.min, islands.max - islands.mean) - 0.5
    return math.ceil(1 + (away / (islands.stddev + rounded)) ** 2)


@STATEMENTS.judged_by("4.1", "Table 1 is of the five frames that are measured",
                      "five numbers can have the extremes, mean and deviation of every row", COUNTS, papers="5 frames",
                      remark="arithmetic on the paper's own numbers: deviation^2 (n - 1) >= (mean - min)^2 and (max - mean)^2")
def frames_of_table_1(_):
    fewest = {scene: fewest_frames(row.islands) for scene, row in PAPER.items()}
    too_few = [(scene, f"at least {frames}") for scene, frames in fewest.items() if frames > 5]
    return Answer(f"frames needed: {joined(too_few)}" if too_few else "all rows can", not too_few)


MIX_SAYS = ("3.3", "34 % floating point, 25 % integer, 6 % branches, 5 % stores, 30 % loads", "each within five points")
COLLISION_SAYS = ("3.3", "collision detection is 7 % of the instructions, 2 to 20 % by scene", "mean of 2 to 20 %")


def judge_mix(mixes):
    """Of the mean over the scenes' mixes."""
    if not mixes:
        return None
    ours = mean_mix(mixes)
    return Answer(", ".join(f"{100 * share:.0f} % {name}" for share, name in zip(ours, MIX)),
                  all(abs(share - papers) <= 0.05 for share, papers in zip(ours, PAPER_MIX)), len(mixes), NUM_SCENES)


def judge_collision_share(shares):
    """Of the scenes' shares of collision detection."""
    if not shares:
        return None
    mean = sum(shares) / len(shares)
    return Answer(f"{100 * mean:.0f} %, {100 * min(shares):.0f} to {100 * max(shares):.0f} %", 0.02 <= mean <= 0.20, len(shares), NUM_SCENES)


@STATEMENTS.judged_by(*MIX_SAYS, INSTRUCTIONS, FIGURE_3, papers="34, 25, 6, 5, 30 %",
                      remark="double precision, today's compiler; an access to memory counts besides the operation that makes it")
def mix_of_quick(data):
    return judge_mix([scene.quick.mix for scene in data.counts if scene.quick])


@STATEMENTS.judged_by(*COLLISION_SAYS, INSTRUCTIONS, FIGURE_3, papers="7 %, 2 to 20 %")
def collision_of_quick(data):
    return judge_collision_share([scene.quick.collision_share for scene in data.counts if scene.quick])


STATEMENTS.undecidable("3.3", "far more floating point than SPEC INT and MiBench, more integer than SPEC FP", "-",
                       "these suites are not run here")
STATEMENTS.undecidable("3.3", "PhysicsBench hits its caches often", "no number",
                       "the paper gives no rate, and the modelled caches' hits are in no file")
